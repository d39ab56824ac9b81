"""Steps with kept factors are those of fresh ones."""

import numpy as np
import pytest
from references.iterations import KINDS, at_rest, compiled_newton, plain_newton, room
from references.soil_block import FRICTION, soil_block
from together import together

from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.factors.changed import ALL, CALLS, LONG, MOST_TURNS
from ssilang.kernel.interface.factors.kept import LONG_WORTH, is_factorised, solve_tangent
from ssilang.kernel.interface.response import accept, interface_stiffness
from ssilang.kernel.solvers.dense import (
    factorise_dense,
    solve_factors_together,
)
from ssilang.kernel.solvers.low_rank import add_low_rank_product, low_rank


def test_a_singular_matrix_has_no_factors():
    assert not factorise_dense(np.ones((3, 3)), np.zeros(3, dtype=np.int64))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("words", [(), ("CISAILLEMENT_ELASTIQUE",)])
def test_a_walk_of_steps_agrees(words, kind):
    given = {"KN": 2e8, "KS": 1e8} if words else FRICTION
    whole = soil_block(steps=2, joint=given, words=words).interface
    joints, q, random = whole.points, whole.size, np.random.default_rng(1)
    root = random.standard_normal((q, q))
    condensed = Condensed(1e-9 * (root @ root.T / q + np.eye(q)), np.zeros((0, 0)), 1.0)
    now, work = at_rest(joints, q, whole.initial_state()), room(joints, q, kind)
    for _ in range(40):
        y0 = 1e-3 * random.standard_normal(q)
        assert compiled_newton(joints, condensed, now, y0, work) > 0
        trial, (_, plain) = work.trial, plain_newton(joints, condensed, now, y0)
        np.testing.assert_allclose(trial.y, plain.y, atol=1e-11 * np.abs(plain.y).max())
        np.testing.assert_allclose(trial.f, plain.f, atol=1e-9 * np.abs(plain.f).max() + 1e-9)
        size = np.abs(plain.state).max()
        np.testing.assert_allclose(trial.state, plain.state, atol=1e-9 * size + 1e-15)
        accept(plain, now)
        now.delta[:] -= 0.1 * (now.delta - plain.y)


@pytest.mark.parametrize("few", [3e-2, 0.3])
@pytest.mark.parametrize("words", [(), ("CISAILLEMENT_ELASTIQUE",)])
def test_a_walk_of_steps_by_blocks_agrees(monkeypatch, words, few):
    """Directions by few vectors, what is left by all: to the digits of single precision."""
    monkeypatch.setattr("ssilang.kernel.solvers.low_rank.CLUSTER", 12)
    given = {"KN": 2e8, "KS": 1e8} if words else FRICTION
    whole = soil_block(steps=2, size=(24, 4, 22), joint=given, words=words).interface
    joints, q, random = whole.points, whole.size, np.random.default_rng(1)
    x = np.arange(q // 2)[:, None] % 17.0  # some stand in one place
    away = np.exp(-np.abs(x - x.T) / 3.0)
    S = 1e-9 * np.kron(away + np.eye(q // 2), [[1.0, 0.3], [0.3, 2.0]])
    size = np.linalg.norm(S, np.inf)
    blocks = low_rank(S, x, few * size, 1e-7 * size)
    assert (blocks.ranks[:, 0] < blocks.ranks[:, 1]).any()
    S = as_they_have_it(blocks)
    none, nowhere = np.zeros((0, 0)), np.full((q, q), np.nan)
    condensed = Condensed(nowhere, none, 0.7, blocks=blocks, tolerance=1e-9)
    now, work = at_rest(joints, q, whole.initial_state()), room(joints, q, "usual")
    work.shares[:] = 1.0
    states = set()
    for _ in range(40):
        y0 = 1e-3 * random.standard_normal(q)
        assert compiled_newton(joints, condensed, now, y0, work) > 0
        exact = condensed._replace(S=S)
        trial, (_, plain) = work.trial, plain_newton(joints, exact, now, y0)
        np.testing.assert_allclose(trial.y, plain.y, atol=1e-8 * np.abs(plain.y).max())
        np.testing.assert_allclose(trial.f, plain.f, atol=1e-7 * np.abs(plain.f).max())
        accept(plain, now)
        states.add((plain.t[:, 1] < 0.0).sum())
        now.delta[:] -= 0.1 * (now.delta - plain.y)
    assert len(states) > 5


def as_they_have_it(blocks):
    """The matrix (q, q) of blocks with all their vectors."""
    S = np.zeros(2 * [len(blocks.order)])
    for row, x in zip(S, np.eye(len(S)), strict=True):
        add_low_rank_product(blocks, False, x, row)
    return S


def test_blocks_that_take_too_many_turns_leave_it_to_an_inverse():
    """Tangents of any sign, so stiff that no value of the compliance is like another."""
    whole = soil_block(steps=2, size=(84, 4, 80)).interface
    joints, q, random = whole.points, whole.size, np.random.default_rng(3)
    assert q > 2 * MOST_TURNS
    U = np.linalg.qr(random.standard_normal((q, q)))[0]
    blocks = low_rank(
        1e-9 * U * np.geomspace(1.0, 1e-2, q) @ U.T, np.zeros((q // 2, 1)), 3e-12, 0.0
    )
    S, K = as_they_have_it(blocks), np.zeros((q, q))
    condensed = Condensed(S, np.zeros((0, 0)), 1.0, blocks=blocks)
    factors = room(joints, q, "usual").factors
    for stiff, exact in ((1e-6, False), (1.0, True), (1e-6, True)):
        D = stiff * 1e13 * random.standard_normal((len(joints.weights), 2, 2))
        interface_stiffness(joints, D, K)
        b = random.standard_normal(q)
        x = b.copy()
        assert solve_tangent(joints, condensed, factors, D, x, 1e-4)
        left = np.linalg.norm(x + S @ K @ x - b) / np.linalg.norm(b)
        assert left < (1e-6 if stiff == 1.0 else 1e-2)
        assert is_factorised(factors) == exact


@together("held", [False, True])
@together("kind, digits", [("LU", 1e-9), ("single LU", 1e-4)])
def test_changed_tangents_of_no_symmetry_are_solved_with(kind, digits, held):
    """Some points, others, all, those of the start: by a Y that was made once, then made anew."""
    whole = soil_block(steps=2, size=(24, 4, 22), joint=FRICTION).interface
    joints, q, random = whole.points, whole.size, np.random.default_rng(1)
    root = random.standard_normal((q, q))
    R = 2e7 * np.eye(q) if held else np.zeros((0, 0))
    condensed = Condensed(1e-9 * (root @ root.T / q + np.eye(q)), R, 0.7)
    factors = room(joints, q, kind).factors
    first = 3e8 * random.standard_normal((len(joints.weights), 2, 2))
    K, made = np.zeros((q, q)), []
    for points in ([], [5], [3, 5, 9], slice(None), []):
        D = first.copy()
        D[points] += 1e8 * random.standard_normal(D[points].shape)
        interface_stiffness(joints, D, K)
        b = random.standard_normal(q)
        x, whole_K = b.copy(), 0.7 * K - (R if held else 0.0)
        assert solve_tangent(joints, condensed, factors, D, x, 0.1 * digits)
        exact = np.linalg.solve(np.eye(q) + condensed.S @ whole_K, b)
        np.testing.assert_allclose(x, exact, atol=digits * np.abs(exact).max())
        made.append(factors.tangents.copy())
    assert all((first == D).all() for D in made)
    factors.changed.spent[LONG] = LONG_WORTH * q**3 + 1.0  # have cost as much as a new Y
    D = 2.0 * first
    assert solve_tangent(joints, condensed, factors, D, x, digits)
    np.testing.assert_array_equal(factors.tangents, D)
    assert factors.changed.spent[LONG] == 0.0


def test_what_takes_too_many_turns_gets_its_own_factors():
    whole = soil_block(steps=2, size=(24, 4, 22), joint=FRICTION).interface
    joints, q, random = whole.points, whole.size, np.random.default_rng(1)
    root = random.standard_normal((q, q))
    condensed = Condensed(1e-9 * (root @ root.T / q + np.eye(q)), np.zeros((0, 0)), 1.0)
    factors, b = room(joints, q, "LU").factors, random.standard_normal(q)
    changed = factors.changed._replace(V=np.zeros((3, q)))  # two turns
    factors, x, K = factors._replace(changed=changed), b.copy(), np.zeros((q, q))
    D = 1e9 * np.tile(np.eye(2), (len(joints.weights), 1, 1))
    assert solve_tangent(joints, condensed, factors, D, b.copy(), 1e-10)
    D *= random.uniform(0.1, 10.0, (len(D), 1, 1))
    assert solve_tangent(joints, condensed, factors, D, x, 1e-10)
    interface_stiffness(joints, D, K)
    np.testing.assert_allclose(x + condensed.S @ (K @ x), b, atol=1e-9)
    np.testing.assert_array_equal(factors.tangents, D)


@together("size", [(24, 4, 22), (40, 4, 30)])
def test_points_that_stay_are_taken_and_others_corrected_for(size):
    """One asked for twice; one that turns each time; all, by then worth a new response."""
    whole = soil_block(steps=2, size=size, joint=FRICTION).interface
    joints, q, random = whole.points, whole.size, np.random.default_rng(2)
    root = random.standard_normal((q, q))
    condensed = Condensed(1e-9 * (root @ root.T / q + np.eye(q)), np.zeros((0, 0)), 1.0)
    factors, K = room(joints, q, "usual").factors, np.zeros((q, q))
    first = 3e8 * np.tile(np.eye(2), (len(joints.weights), 1, 1))

    def solved(D):
        b = random.standard_normal(q)
        x = b.copy()
        assert solve_tangent(joints, condensed, factors, D, x, 1e-10)
        interface_stiffness(joints, D, K)
        np.testing.assert_allclose(x + condensed.S @ (K @ x), b, atol=1e-9 * np.abs(b).max())
        return int((factors.tangents != first).any(axis=(1, 2)).sum())

    D = first.copy()
    assert solved(D) == 0
    D[7] = 0.0
    assert solved(D) == 0  # corrected for
    # rows of two pairs, what is between, calls; then what is between in a turn for each direction
    assert factors.changed.spent[ALL] == 4 * (q + 4) + CALLS + 2 * 4 * 4
    assert solved(D) == 1  # asked for twice
    assert (factors.updates[0], factors.changed.spent[ALL]) == (1, 0.0)
    for turn in range(4):
        D[3] = (turn + 1) * 5e7 * np.ones((2, 2))
        assert solved(D) == 1
    D[:] = 0.0
    assert solved(D) == 1
    assert solved(D) == len(D)
    assert factors.updates[0] == 0  # made anew


@together("n", [9, 32, 33, 100, 600])
def test_many_right_sides_and_wide_blocks(n):
    random = np.random.default_rng(0)
    A, B = random.standard_normal((n, n)), random.standard_normal((n, 7))
    factors, X, pivots = A.copy(), B.copy(), np.zeros(n, dtype=np.int64)
    assert factorise_dense(factors, pivots)
    solve_factors_together(factors, pivots, X)
    np.testing.assert_allclose(A @ X, B, atol=1e-9)
