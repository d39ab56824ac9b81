"""Contact with and without friction: all conditions hold; small ones by all active sets."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.solvers.active_set import coulomb
from ssilang.kernel.solvers.active_set.complementarity import ContactProblem, solve_contact
from ssilang.kernel.solvers.active_set.coulomb import CoulombProblem, solve_coulomb


def flexibility(n, rng):
    A = rng.normal(size=(n, n))
    return A @ A.T / n + 0.3 * np.eye(n)


def held(m, width, mu, rng):
    n = m * (1 + width)
    W = np.vstack([flexibility(n, rng), np.zeros((m, n))])
    q = np.concatenate([rng.normal(size=n), np.zeros(m)])
    none = np.zeros((n + m, 0))
    full = np.full(m, 1.0)
    return CoulombProblem(
        W, q, none, none[:n], np.zeros(0), m, width, np.arange(m), mu * full, 0.0 * full
    )


def check(problem, found):
    m, n, d = problem.n_normal, problem.n_forces, problem.width
    seen = problem.q + problem.W @ found.forces + problem.B @ found.a
    p, w = found.forces[:m], seen[:m]
    tau, s = found.forces[m:].reshape(-1, d), seen[m:n].reshape(-1, d)
    size = max(np.abs(problem.q).max(), np.abs(found.forces).max())
    assert (p >= 0).all()
    assert (w >= -1e-9 * size).all()
    assert abs(p @ w) <= 1e-8 * size**2
    limit = np.where(p > 0, problem.coefficient * p + problem.constant, 0.0)
    length = np.linalg.norm(tau, axis=1)
    assert (length <= limit + 1e-9 * size).all()
    slipping = np.linalg.norm(s, axis=1) > 1e-7 * size
    assert length[slipping] == pytest.approx(limit[slipping], abs=1e-8 * size)
    work = np.einsum("kd,kd->k", tau, s)[slipping]  # friction against the slip, along it
    assert work == pytest.approx(-(length * np.linalg.norm(s, axis=1))[slipping], abs=1e-7 * size)


@together("width", [1, 2])
@together("mu", [0.0, 0.3, 1.0])
def test_conditions_hold_for_random_bodies(width, mu):
    rng = np.random.default_rng(17)
    for m in (1, 2, 5, 12):
        for _ in range(5):
            problem = held(m, width, mu, rng)
            found = solve_coulomb(problem)
            check(problem, found)
            for force, length in ((3e-8, 2e5), (5e9, 1e-4)):
                other = solve_coulomb(in_units(problem, force, length))
                np.testing.assert_allclose(other.forces / force, found.forces, atol=1e-8)
                assert (other.sticking == found.sticking).all()
                assert other.turns <= found.turns + 2


def in_units(problem, force, length):
    """The same bodies, their numbers in other units."""
    p = problem
    return replace(
        p, W=p.W * length / force, q=p.q * length, B=p.B * length, r=p.r * force,
        constant=p.constant * force,
    )  # fmt: skip


def all_sticking(forces, width, rng):
    """Four places that rub on three motions alone, held by forces that are shared at will."""
    m, n = 4, len(forces)
    rows = np.zeros((n, m + 3))
    rows[:m, :m] = np.eye(m)
    rows[m:, m:] = rng.normal(size=(n - m, 3))
    W = np.vstack([rows @ flexibility(m + 3, rng) @ rows.T, np.zeros((m, n))])
    none, full = np.zeros((n + m, 0)), np.ones(m)
    return CoulombProblem(
        W, -W @ forces, none, none[:n], np.zeros(0), m, width, np.arange(m), full, 0 * full
    )


@together("width", [1, 2])
def test_redundant_frictions_do_not_follow_rounding(width):
    """Places outnumber what the body can do: what they share stays when rounding changes.

    The rows that count have a condition below 1e5: 1e-15 of the motions is 1e-10 of the forces.
    """
    rng = np.random.default_rng(3)
    for _ in range(10):
        given = np.concatenate([10.0 + rng.random(4), 0.3 * rng.normal(size=4 * width)])
        problem = all_sticking(given, width, rng)
        found = solve_coulomb(problem)
        check(problem, found)
        assert found.sticking.all()
        kept = np.linalg.svd(problem.W)[1]
        assert kept[-1] < 1e-12 < 1e-5 < kept[6] / kept[0]
        for _ in range(3):
            other = replace(problem, q=problem.q * (1 + 1e-15 * rng.normal(size=len(problem.q))))
            np.testing.assert_allclose(
                solve_coulomb(other).forces, found.forces, rtol=0, atol=1e-9 * given.max()
            )


def test_states_found_by_trying_all_of_them():
    """Open, sticking and sliding both ways at each of three places in the plane."""
    rng = np.random.default_rng(5)
    for _ in range(20):
        problem = held(3, 1, 0.25, rng)
        trials = (tried(problem, states) for states in product(range(4), repeat=3))
        wanted = [x for x in trials if x]
        found = solve_coulomb(problem).forces
        assert min(np.abs(found - x[0]).max() for x in wanted) < 1e-9


def tried(problem, states):
    n, m = problem.n_forces, problem.n_normal
    A, b = np.eye(n), np.zeros(n)
    for i, state in enumerate(states):
        if state > 0:
            A[i], b[i] = problem.W[i], -problem.q[i]
        if state == 1:
            A[m + i], b[m + i] = problem.W[m + i], -problem.q[m + i]
        if state > 1:
            A[m + i, i] = (1 if state == 2 else -1) * problem.coefficient[i]
    x = np.linalg.solve(A, b)
    seen = problem.q[:n] + problem.W[:n] @ x
    for i, state in enumerate(states):
        p, tau, w, s = x[i], x[m + i], seen[i], seen[m + i]
        good = w >= 0 if state == 0 else p >= 0
        if state == 1:
            good &= abs(tau) <= problem.coefficient[i] * p
        if state > 1:
            good &= tau * s <= 0
        if not good:
            return None
    return (x,)


def test_body_held_by_friction_alone():
    """A weight 10 on a rough table pushed by 2: friction takes it below the limit; not 4."""
    W = np.array([[0.1, 0.0], [0.0, 0.2], [0.0, 0.0]])
    B = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]])
    problem = CoulombProblem(
        W, np.zeros(3), B, B[:2], np.array([-10.0, 2.0]), 1, 1, np.array([0]), np.array([0.3]),
        np.zeros(1),
    )  # fmt: skip
    for force, length in ((1.0, 1.0), (3e-8, 2e5), (5e9, 1e-4)):
        found = solve_coulomb(in_units(problem, force, length))
        assert found.forces / force == pytest.approx([10.0, -2.0])
        assert found.sticking.all()
        pushed = replace(problem, r=np.array([-10.0, 4.0]))
        with refusal(ConvergenceError, "kernel.solvers.no-state-contact-friction"):
            solve_coulomb(in_units(pushed, force, length))
    bound = replace(held(2, 1, 9.0, np.random.default_rng(3)), q=np.r_[-9.0, -8.0, 0, 0, 0, 0])
    swept = coulomb._Solver(bound).sweep(np.zeros(4))  # all touches and sticks: equations alone
    np.testing.assert_allclose(bound.W[:4] @ swept, -bound.q[:4], atol=1e-8)
    solver = coulomb._Solver(problem)
    swept = solver.sweep(np.zeros(4))  # over springs of a hundredth
    np.testing.assert_allclose(swept, [10.0, -2.0, -1.0, 0.4], rtol=0.05)
    for forces, off in (([10.0, -2.0], 0), ([12.0, -2.0], 2), ([10.0, -1.0], 1)):
        x = np.concatenate([forces, -problem.W[:2] @ forces])  # in place, whatever the balance
        assert solver.violation(solver.trial(x)) == pytest.approx(off / (10.0 + forces[0]))


def enumerate_sets(W, q, B, r, E=None, equality=None):
    """The first active set that meets every sign, by brute force."""
    m, k = B.shape
    E = B if E is None else E
    always = np.zeros(m, bool) if equality is None else equality
    for choice in product([False, True], repeat=m):
        on = np.flatnonzero(choice)
        if not np.all(np.array(choice)[always]):
            continue
        system = np.block([[W[np.ix_(on, on)], B[on]], [E[on].T, np.zeros((k, k))]])
        right = -np.concatenate([q[on], r])
        if system.size and np.linalg.matrix_rank(system) < len(right):
            continue
        x = np.linalg.solve(system, right)
        p = np.zeros(m)
        p[on] = x[: len(on)]
        w = q + W @ p + B @ x[len(on) :]
        if p[~always].min(initial=0.0) >= -1e-9 and w.min() >= -1e-9:
            return p, w
    return None


def problem(W, q, B, r):
    return ContactProblem(W, q, B, B, r, np.zeros(len(q), bool))


@settings(max_examples=120, deadline=None)
@given(st.integers(2, 7), st.integers(1, 2), st.integers(0, 10**6))
def test_a_body_resting_on_its_conditions_finds_its_supports(m, k, seed):
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(m, m))
    x = np.sort(rng.uniform(-1.0, 1.0, m))
    B = np.column_stack([np.ones(m), x])[:, :k]
    weights = rng.uniform(0.1, 1.0, m)  # the load lies between the supports: equilibrium exists
    W, q, r = A @ A.T + 0.1 * np.eye(m), rng.normal(size=m), -B.T @ weights
    expected = enumerate_sets(W, q, B, r)
    found = solve_contact(problem(W, q, B, r))
    w = q + W @ found.p + B @ found.a
    assert found.p.min() >= -1e-8
    assert w.min() >= -1e-8
    assert abs(found.p @ w) < 1e-7
    if expected is not None:
        np.testing.assert_allclose(found.p, expected[0], atol=1e-6)


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 7), st.integers(0, 10**6), st.sampled_from([1e-9, 1.0, 1e6]))
def test_unsymmetric_rows_of_which_some_must_hold_from_any_start(m, seed, unit):
    """Whatever the unit of the forces; rows push otherwise than they measure."""
    rng = np.random.default_rng(seed)
    A, skew = rng.normal(size=(m, m)), rng.normal(size=(m, m))
    W, q = A @ A.T + 0.1 * np.eye(m) + 0.3 * (skew - skew.T), rng.normal(size=m)
    equality, start, none = rng.uniform(size=m) < 0.3, rng.uniform(size=m) < 0.5, np.zeros((m, 0))
    p, w = enumerate_sets(W, q, none, np.zeros(0), equality=equality)
    given = ContactProblem(W / unit, q, none, none, np.zeros(0), equality)
    for first in (None, start):
        found = solve_contact(given, first)
        np.testing.assert_allclose(found.p / unit, p, atol=1e-7)
        np.testing.assert_allclose(q + W @ found.p / unit, w, atol=1e-7)
        assert found.active[equality].all()
        assert (found.p[~found.active] == 0.0).all()


def test_a_body_pulled_off_its_conditions_has_no_equilibrium():
    B = np.ones((3, 1))
    with refusal(ConvergenceError, "kernel.solvers.no-set-of-conditions-holds-body"):
        solve_contact(problem(np.eye(3), np.zeros(3), B, np.array([1.0])))


def test_the_same_condition_twice_does_not_cycle():
    W = np.ones((2, 2))
    found = solve_contact(problem(W, np.array([-1.0, -1.0]), np.zeros((2, 0)), np.zeros(0)))
    assert found.p.sum() == pytest.approx(1.0)
