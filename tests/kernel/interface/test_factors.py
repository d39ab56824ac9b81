"""The interface iteration that keeps its factors gives what the one without does."""

import numpy as np
import pytest
from references.iterations import solve_interface
from references.soil_block import FRICTION, soil_block

from ssilang.kernel.interface.factors import iterate_cached
from ssilang.kernel.solvers.dense import (
    factorise_dense,
    solve_factors,
    solve_factors_together,
)


@pytest.mark.parametrize("n", [9, 32, 33, 100])
def test_factors_solve(n):
    random = np.random.default_rng(0)
    A, b = random.standard_normal((n, n)), random.standard_normal(n)
    factors, x, pivots = A.copy(), b.copy(), np.zeros(n, dtype=np.int64)
    assert factorise_dense(factors, pivots)
    solve_factors(factors, pivots, x)
    np.testing.assert_allclose(A @ x, b, atol=1e-11)


def test_a_singular_matrix_has_no_factors():
    assert not factorise_dense(np.ones((3, 3)), np.zeros(3, dtype=np.int64))


@pytest.mark.parametrize("words", [(), ("CISAILLEMENT_ELASTIQUE",)])
def test_a_walk_of_steps_agrees(words):
    given = {"KN": 2e8, "KS": 1e8} if words else FRICTION
    joints = soil_block(steps=2, joint=given, words=words).interface
    q, n, d = joints.size, joints.n_points, joints.dimension
    random = np.random.default_rng(1)
    root = random.standard_normal((q, q))
    S, share = 1e-9 * (root @ root.T / q + np.eye(q)), 1.0
    state, f0, delta = joints.initial_state(), np.zeros(q), np.zeros(q)
    known, pivots = np.full((n, d, d), np.nan), np.zeros(q, dtype=np.int64)
    K, A = np.zeros((q, q)), np.zeros((q, q))
    args = (
        joints.pairs, joints.B, joints.weights, joints.codes,
        np.ascontiguousarray(joints.parameters), S,
    )  # fmt: skip
    for _ in range(40):
        y0 = 1e-3 * random.standard_normal(q)
        found = []
        for cached in (True, False):
            w, t, D = np.zeros((n, d)), np.zeros((n, d)), np.zeros((n, d, d))
            new, f, h, y = np.zeros_like(state), np.zeros(q), np.zeros(q), y0.copy()
            step = (delta, f0, state.copy(), y0, y, w, t, new, D, f, h)
            if cached:
                work = (np.zeros(q), np.zeros(q), np.zeros(q), K, A, known, pivots)
                turns, _ = iterate_cached(*args, np.zeros((0, 0)), share, *step, *work)
            else:
                turns, _ = solve_interface(*args, np.zeros((q, q)), share, *step)
            assert turns > 0
            found.append((y, f, new))
        (y, f, new), (y_plain, f_plain, new_plain) = found
        np.testing.assert_allclose(y, y_plain, atol=1e-11 * np.abs(y_plain).max())
        np.testing.assert_allclose(f, f_plain, atol=1e-9 * np.abs(f_plain).max() + 1e-9)
        np.testing.assert_allclose(new, new_plain, atol=1e-9 * np.abs(new_plain).max() + 1e-15)
        delta, f0, state = 0.9 * delta + y_plain, f_plain, new_plain


def test_factors_that_changed_tangents_correct():
    """Few points change at a time: Woodbury's formula gives the step of fresh factors."""
    joints = soil_block(steps=2, size=(168, 4, 166), joint=FRICTION).interface
    q, n, d = joints.size, joints.n_points, joints.dimension
    random = np.random.default_rng(1)
    root = random.standard_normal((q, q))
    S = 1e-9 * (0.05 * root @ root.T / q + np.eye(q))
    known, pivots = np.full((n, d, d), np.nan), np.full(2 * q + 1, -1, dtype=np.int64)
    K, A = np.zeros((q, q)), np.zeros((q, q))
    args = (
        joints.pairs, joints.B, joints.weights, joints.codes,
        np.ascontiguousarray(joints.parameters), S,
    )  # fmt: skip
    state, f0, delta = joints.initial_state(), np.zeros(q), np.zeros(q)
    y0, corrected, fresh = np.tile([0.0, -1e-3], q // 2), 0, 0
    for step in range(60):
        found = []
        for cached in (True, False):
            w, t, D = np.zeros((n, d)), np.zeros((n, d)), np.zeros((n, d, d))
            new, f, h, y = np.zeros_like(state), np.zeros(q), np.zeros(q), y0.copy()
            given = (delta, f0, state.copy(), y0, y, w, t, new, D, f, h)
            if cached:
                work = (np.zeros(q), np.zeros(q), np.zeros(q), K, A, known, pivots)
                turns, _ = iterate_cached(*args, np.zeros((0, 0)), 1.0, *given, *work)
            else:
                turns, _ = solve_interface(*args, np.zeros((q, q)), 1.0, *given)
            assert turns > 0
            found.append((turns, y))
        (turns, y), (plain_turns, plain) = found
        assert turns <= plain_turns + 1  # still Newton's steps
        np.testing.assert_allclose(y, plain, atol=1e-11 * np.abs(plain).max())
        corrected += pivots[2 * q] >= 0
        fresh += pivots[2 * q] < 0
        y0 = np.tile([0.0, -1e-3], q // 2)
        y0[2 * (step // 4 % (q // 2)) + 1] = 2e-3 if step % 4 < 2 else -1e-3  # one pair opens
    assert corrected > 20
    assert fresh >= 1


@pytest.mark.parametrize("n", [33, 600])
def test_many_right_sides_and_wide_blocks(n):
    random = np.random.default_rng(0)
    A, B = random.standard_normal((n, n)), random.standard_normal((n, 7))
    factors, X, pivots = A.copy(), B.copy(), np.zeros(n, dtype=np.int64)
    assert factorise_dense(factors, pivots)
    solve_factors_together(factors, pivots, X)
    np.testing.assert_allclose(A @ X, B, atol=1e-9)
