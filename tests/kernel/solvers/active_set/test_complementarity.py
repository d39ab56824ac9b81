"""Contact conditions against the enumeration of all active sets."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.solvers.active_set.complementarity import ContactProblem, solve_contact


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
    with pytest.raises(
        ConvergenceError, check=lambda e: e.code == "kernel.solvers.no-set-of-conditions-holds-body"
    ):
        solve_contact(problem(np.eye(3), np.zeros(3), B, np.array([1.0])))


def test_the_same_condition_twice_does_not_cycle():
    W = np.ones((2, 2))
    found = solve_contact(problem(W, np.array([-1.0, -1.0]), np.zeros((2, 0)), np.zeros(0)))
    assert found.p.sum() == pytest.approx(1.0)
