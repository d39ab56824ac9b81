"""Steps with kept factors are those of fresh ones."""

import numpy as np
import pytest
from references.iterations import KINDS, at_rest, compiled_newton, plain_newton, room
from references.soil_block import FRICTION, soil_block

from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.factors.changed import DONE, forget_changes, solve_changed
from ssilang.kernel.interface.factors.lu import factorise
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.interface.response import accept, interface_stiffness
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


def test_factors_that_changed_tangents_correct():
    """Few points change at a time: Woodbury's formula gives the step of fresh factors."""
    whole = soil_block(steps=2, size=(168, 4, 166), joint=FRICTION).interface
    joints, q, random = whole.points, whole.size, np.random.default_rng(1)
    root = random.standard_normal((q, q))
    S = 1e-9 * (0.05 * root @ root.T / q + np.eye(q))
    condensed = Condensed(S, np.zeros((0, 0)), 1.0)
    now, work = at_rest(joints, q, whole.initial_state()), workspace(whole.B.shape[:2], q)
    held = work.factors.changes.held
    y0, corrected, fresh = np.tile([0.0, -1e-3], q // 2), 0, 0
    for step in range(60):
        turns = compiled_newton(joints, condensed, now, y0, work)
        plain_turns, plain = plain_newton(joints, condensed, now, y0)
        assert 0 < turns <= plain_turns + 1  # still Newton's steps
        size = np.abs(plain.y).max()
        np.testing.assert_allclose(work.trial.y, plain.y, atol=1e-11 * size)
        corrected += held[0] > 0
        fresh += held[0] == 0
        y0 = np.tile([0.0, -1e-3], q // 2)
        y0[2 * (step // 4 % (q // 2)) + 1] = 2e-3 if step % 4 < 2 else -1e-3  # one pair opens
    assert corrected > 20
    assert fresh >= 1


def test_changed_tangents_of_no_symmetry_are_solved_with_exactly():
    """One point, then three of which it is one, by factors of the tangents before."""
    whole = soil_block(steps=2, size=(24, 4, 22), joint=FRICTION).interface
    joints, q, random = whole.points, whole.size, np.random.default_rng(1)
    root = random.standard_normal((q, q))
    condensed = Condensed(1e-9 * (root @ root.T / q + np.eye(q)), np.zeros((0, 0)), 0.7)
    factors = room(joints, q, "changed LU").factors
    lu, changes = factors.lu, factors.changes
    known = 1e8 * random.standard_normal((len(joints.weights), 2, 2))
    assert factorise(joints, condensed, known, lu)
    forget_changes(changes)
    D, K = known.copy(), np.zeros((q, q))
    for points in ([5], [3, 5, 9]):
        D[points] = 1e8 * random.standard_normal((len(points), 2, 2))
        interface_stiffness(joints, D, K)
        b = random.standard_normal(q)
        x = b.copy()
        assert solve_changed(joints, condensed, D, known, lu, changes, x) == DONE
        exact = np.linalg.solve(np.eye(q) + condensed.S @ (0.7 * K), b)
        np.testing.assert_allclose(x, exact, atol=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("n", [33, 600])
def test_many_right_sides_and_wide_blocks(n):
    random = np.random.default_rng(0)
    A, B = random.standard_normal((n, n)), random.standard_normal((n, 7))
    factors, X, pivots = A.copy(), B.copy(), np.zeros(n, dtype=np.int64)
    assert factorise_dense(factors, pivots)
    solve_factors_together(factors, pivots, X)
    np.testing.assert_allclose(A @ X, B, atol=1e-9)
