"""The kept response of a condensed interface follows changes of its points."""

import numpy as np
from together import together

from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.factors.changed import correct_changes
from ssilang.kernel.interface.factors.inverse import (
    PLAIN,
    apply_inverse,
    make_plain,
    new_inverse,
    update_point,
)
from ssilang.kernel.interface.factors.kept import (
    UPDATES,
    follow_points,
    list_others,
    new_factors,
    solve_tangent,
)
from ssilang.kernel.interface.response import Joints, interface_stiffness

SHARE = 0.9


def interface(rng, d=2, n_pairs=5):
    """Two pairs a point, their compliance, weights, first tangents (one point open)."""
    q = d * n_pairs
    pairs = np.array([[i, i + 1] for i in range(n_pairs - 1)] * 2, dtype=np.int64)
    B = rng.normal(size=(len(pairs), d, 2 * d))
    X = rng.normal(size=(q, q))
    D = rng.normal(size=(len(pairs), d, d))  # not symmetric, as with friction
    D = 0.3 * D + 3.0 * np.eye(d)
    D[0] = 0.0
    weights, codes = rng.uniform(0.5, 2.0, len(pairs)), np.zeros(len(pairs), np.int64)
    return Joints(pairs, B, weights, codes, np.zeros((len(pairs), 1))), X @ X.T / q, D


def matrix(joints, condensed, D):
    S, R, c, *_ = condensed
    K = np.zeros_like(S)
    interface_stiffness(joints, D, K)
    return np.eye(len(S)) + S @ (c * K - (R if np.size(R) else 0.0))


@together("few", [False, True])
@together("d", [2, 3])
def test_response_follows_points_that_change(d, few):
    rng = np.random.default_rng(d)
    joints, S, D = interface(rng, d)
    condensed = Condensed(S, 0.1 * np.eye(len(S)), SHARE)
    inverse = new_inverse(len(S), d, few=few)
    Y = inverse.Y
    if few:
        assert make_plain(joints, condensed, D, inverse)
    else:
        Y[:] = np.linalg.solve(matrix(joints, condensed, D), S)
    for turn in range(40):
        p, new = turn % len(D), D.copy()
        new[p] = 0.0 if turn % 3 == 0 else 2.5 * np.eye(d) + 0.2 * rng.normal(size=(d, d))
        if turn % 3 == 1:
            new[p, 0, 0] = 0.0  # slides: a change of lower rank
        weight = SHARE * joints.weights[p]
        assert update_point(joints.pairs[p], joints.B[p], weight, new[p], D[p], inverse)
        D = new
        truth = np.linalg.solve(matrix(joints, condensed, D), S)
        np.testing.assert_allclose(Y, truth, atol=1e-10 * np.abs(truth).max())
        x = rng.normal(size=len(S))
        solved = x.copy()
        apply_inverse(joints, condensed, D, inverse, solved)
        exact = np.linalg.solve(matrix(joints, condensed, D), x)
        np.testing.assert_allclose(solved, exact, atol=1e-10 * np.abs(exact).max())


@together("spread, enough, good", [(0, 1e-12, True), (3, 1e-17, False)])
def test_a_correction_that_takes_too_many_turns_leaves_what_was_asked(spread, enough, good):
    """All points change, alike or by six orders; no turn ends below the last digit."""
    rng = np.random.default_rng(5)
    joints, S, D = interface(rng, 2, 40)
    condensed, factors = Condensed(S, np.zeros((0, 0)), SHARE), new_factors(D.shape[:2], len(S))
    assert follow_points(joints, condensed, factors, D, list_others(factors, D)) == 0
    known, asked = D.copy(), rng.normal(size=len(S))
    D += (10.0 ** rng.uniform(-spread, spread, len(D)))[:, None, None] * np.eye(2)
    found, solved = asked.copy(), asked.copy()
    inverse, changed = factors.inverse, factors.changed
    done = correct_changes(joints, condensed, D, known, inverse, changed, found, enough)
    assert done == good
    exact = np.linalg.solve(matrix(joints, condensed, D), asked)
    assert solve_tangent(joints, condensed, factors, D, solved, enough)
    np.testing.assert_allclose(solved, exact, atol=1e-9 * np.abs(exact).max())
    if good:
        np.testing.assert_allclose(found, exact, atol=1e-9 * np.abs(exact).max())
    else:
        np.testing.assert_array_equal(found, asked)


@together("n_pairs", [5, PLAIN // 2, PLAIN // 2 + 1, 60])
@together("excess", [0.1, 0.0])
def test_response_is_made_anew_by_elimination_or_by_blocks(n_pairs, excess):
    rng = np.random.default_rng(n_pairs)
    joints, S, D = interface(rng, 2, n_pairs)
    R = excess * np.eye(len(S)) if excess else np.zeros((0, 0))
    factors = new_factors(D.shape[:2], len(S), few=10**6)
    factors.updates[0] = 1
    condensed = Condensed(S, R, SHARE)
    assert follow_points(joints, condensed, factors, D, list_others(factors, D)) == 0
    truth = np.linalg.solve(matrix(joints, (S, excess * np.eye(len(S)), SHARE), D), S)
    np.testing.assert_allclose(factors.inverse.Y, truth, atol=1e-9 * np.abs(truth).max())
    np.testing.assert_array_equal(factors.tangents, D)
    counts = [0]
    for turn in range(UPDATES + 1):  # one point a turn, and none twice in the same way
        D[turn % len(D)] = (2.0 + 0.01 * turn) * np.eye(2)
        assert follow_points(joints, condensed, factors, D, list_others(factors, D)) == 0
        counts.append(factors.updates[0])
    assert counts == [*range(UPDATES + 1), 0]


@together("n", [1, PLAIN + 1])
def test_no_response_is_made_of_a_singular_matrix(n):
    """S = 1, tangents of -1: `1 + S D` vanishes."""
    pairs = np.arange(n, dtype=np.int64)[:, None]
    joints = Joints(pairs, np.ones((n, 1, 1)), np.ones(n), np.zeros(n, np.int64), np.zeros((n, 1)))
    factors, D = new_factors((n, 1), n), -np.ones((n, 1, 1))
    alone = Condensed(np.eye(n), np.zeros((0, 0)), 1.0)
    assert follow_points(joints, alone, factors, D, list_others(factors, D)) < 0
    assert np.isnan(factors.tangents[0]).all()


def test_change_that_makes_the_interface_singular_is_refused():
    """One jump, S = 1: a tangent of -1 makes `1 + S D` vanish; Y stays as it was."""
    pairs, one = np.zeros((1, 1), np.int64), np.ones((1, 1))
    inverse = new_inverse(1, 1)
    inverse.Y[:] = one
    assert not update_point(pairs[0], one, 1.0, -one, 0.0 * one, inverse)
    assert inverse.Y[0, 0] == 1.0
