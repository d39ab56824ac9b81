"""Factors of other tangents, used on by iterations."""

import numpy as np
import pytest
from references.soil_block import FRICTION, soil_block

from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.factors.krylov import WORTH, new_krylov, pays, solve_iterated
from ssilang.kernel.interface.factors.lu import LU, factorise
from ssilang.kernel.interface.response import interface_stiffness


@pytest.fixture(scope="module")
def changed():
    """Joints, compliance, tangents of factors and others near them, the factors."""
    whole = soil_block(steps=2, joint=FRICTION).interface
    joints, q, random = whole.points, whole.size, np.random.default_rng(1)
    root = random.standard_normal((q, q))
    S = 1e-9 * (root @ root.T / q + np.eye(q))
    shape = (whole.n_points, whole.dimension)
    known = 1e8 * np.tile(np.eye(shape[1]), (shape[0], 1, 1))
    D = known * (1 + 0.3 * random.standard_normal((shape[0], 1, 1)))
    D += 2e7 * random.standard_normal(known.shape)
    lu = LU(np.zeros((q, q)), np.zeros(q, np.int64))
    condensed = Condensed(S, np.zeros((0, 0)), 1.0)
    assert factorise(joints, condensed, known, lu)
    return joints, condensed, known, D, lu, shape


def test_iterations_solve_with_the_new_tangents(changed):
    joints, condensed, known, D, _, shape = changed
    S, condensed = condensed.S, condensed._replace(c=0.7)
    q = len(S)
    K = np.zeros((q, q))
    interface_stiffness(joints, D, K)
    b = np.random.default_rng(2).standard_normal(q)
    exact = np.linalg.solve(np.eye(q) + 0.7 * S @ K, b)  # c = 0.7 of both
    fresh = LU(np.zeros((q, q)), np.zeros(q, np.int64))
    assert factorise(joints, condensed, known, fresh)
    krylov, x = new_krylov(shape, q), b.copy()
    krylov = krylov._replace(V=np.zeros((q + 1, q)))
    assert solve_iterated(joints, condensed, D, known, fresh, krylov, x, 1e-10)
    np.testing.assert_allclose(x, exact, atol=1e-8 * np.abs(exact).max())
    assert 1 < krylov.spent[0] < q


def test_what_takes_too_many_turns_leaves_the_right_side(changed):
    joints, condensed, known, D, lu, shape = changed
    S = condensed.S
    b = np.random.default_rng(2).standard_normal(len(S))
    krylov, x = new_krylov(shape, len(S))._replace(V=np.zeros((3, len(S)))), b.copy()
    assert not solve_iterated(joints, condensed, D, known, lu, krylov, x, 1e-10)
    np.testing.assert_array_equal(x, b)
    assert krylov.spent[0] == 2


def test_tangents_that_come_again_get_factors_once_iterations_have_cost_as_much(changed):
    _, (S, *_), known, D, _, shape = changed
    krylov = new_krylov(shape, len(S))
    assert pays(krylov, D)
    assert pays(krylov, D)
    krylov.spent[0] = len(S) // WORTH + 1
    assert not pays(krylov, D)
    assert pays(krylov, known)  # others: sliding points change theirs at each turn
    assert not pays(krylov, known)
