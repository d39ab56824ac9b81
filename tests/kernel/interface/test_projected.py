"""Stiff joints that rub: the start by projected forces, held against Coulomb's law itself."""

import numpy as np
from references.iterations import at_rest, compiled_newton
from together import together

from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.laws.columns import N_STATE, LawCode, Parameter, Variable
from ssilang.kernel.interface.newton import find_start, is_stiff, set_shares, workspace
from ssilang.kernel.interface.response import Joints, accept

MU = 0.5


def points(n, k, mu=MU):
    """n points in space, each of a pair of its own, normal last; shear as stiff as the normal."""
    p = np.zeros((n, len(Parameter)))
    p[:, [Parameter.KN, Parameter.KS1, Parameter.KS1 + 1]] = k
    p[:, Parameter.FROT] = mu
    return Joints(
        np.arange(n)[:, None], np.tile(np.eye(3), (n, 1, 1)), np.ones(n),
        np.full(n, LawCode.SDM, np.int64), p,
    )  # fmt: skip


def compliance(n, seed=1):
    """A full compliance (3 n, 3 n) of which each jump feels some 1e-9 m/N."""
    root = np.random.default_rng(seed).standard_normal((3 * n, 3 * n))
    return 1e-9 * (root @ root.T / (3 * n) + 0.2 * np.eye(3 * n))


def coulomb(w, slip, k, mu=MU):
    """Tractions (n, 3) by the law as it is written: no tension, shear in a cone."""
    normal = k * np.minimum(w[:, 2], 0.0)
    elastic = k * (w[:, :2] - slip)
    size = np.linalg.norm(elastic, axis=1)
    held = np.minimum(1.0, mu * -normal / np.maximum(size, 1e-300))
    return np.column_stack([elastic * held[:, None], normal])


def walk(k, steps, start=True):
    """Turns of steps under random pushes; each end fulfils law and equilibrium."""
    n = 12
    joints, S = points(n, k), compliance(n)
    condensed = Condensed(S, np.zeros((0, 0)), 1.0)
    now, work = at_rest(joints, 3 * n, np.zeros((n, N_STATE))), workspace((n, 3), 3 * n)
    if not start:
        work.shares[:] = 1.0
    random, turns = np.random.default_rng(3), []
    for _ in range(steps):
        push = random.standard_normal((n, 3)) * [1.0, 1.0, 0.5] - [0.0, 0.0, 0.4]
        y0 = S @ (1e5 * push.ravel())
        slip = now.state[:, [Variable.SLIP1, Variable.SLIP1 + 1]].copy()
        turns.append(compiled_newton(joints, condensed, now, y0, work))
        y, force = work.trial.y, now.f
        t = coulomb(work.trial.w, slip, k)
        size = np.abs(t).max()
        np.testing.assert_allclose(work.trial.t, t, atol=1e-9 * size)
        unbalanced = y + S @ (t.ravel() - force) - y0
        assert np.abs(unbalanced).max() <= 1e-9 * max(np.abs(y0).max(), np.abs(y).max())
        accept(work.trial, now)
    return np.array(turns)


def test_stiff_joints_take_few_turns():
    """Joints 300 times as stiff as what they stand on: Newton alone goes round between sets."""
    led, alone = walk(3e11, 40), walk(3e11, 40, start=False)
    assert (led > 0).all()
    assert led.max() <= 5
    assert alone.max() > 12  # else this shows nothing


@together("k", [1e9, 1e13])
def test_any_stiffness_ends_in_the_law(k):
    assert (walk(k, 10) > 0).all()


def test_where_no_start_is_found_the_one_given_stays():
    """Much friction: three of twelve pushes go round between the same points for ever."""
    joints, found = points(3, 1e11, 3.0), []
    for seed in range(12):
        S, work = compliance(3, seed), workspace((3, 3), 9)
        condensed, y = Condensed(S, np.zeros((0, 0)), 1.0), work.trial.y
        push = np.random.default_rng(seed).standard_normal((3, 3)) * [1.0, 1.0, 0.5]
        work.trial.y0[:] = y[:] = y0 = S @ (1e5 * (push - [0.0, 0.0, 0.4]).ravel())
        set_shares(joints, condensed, work.shares)
        now = at_rest(joints, 9, np.zeros((3, N_STATE)))
        found.append(find_start(joints, condensed, now, work.trial, work.factors, work.shares))
        left = y + S @ coulomb(y.reshape(3, 3), np.zeros((3, 2)), 1e11, 3.0).ravel() - y0
        ends = np.abs(left).max() <= 1e-6 * np.abs(y0).max()
        assert ends if found[-1] else np.array_equal(y, y0)
    assert found.count(0) == 3


def test_only_stiff_points_that_rub_without_cohesion_get_a_share():
    S = compliance(4)
    joints = points(4, 1e11)
    p = joints.p
    p[1, Parameter.FROT] = -1.0  # holds whatever pulls
    p[2, Parameter.FU], p[2, Parameter.GF] = 1e3, 1.0
    p[3, Parameter.KN] = 1e3  # soft across, stiff along
    rho = np.empty((4, 3))
    set_shares(joints, Condensed(S, np.zeros((0, 0)), 1.0), rho)
    felt = 1e11 * np.diag(S).reshape(4, 3)
    expected = np.ones((4, 3))
    expected[0] = [1 / felt[0, :2].max()] * 2 + [1 / felt[0, 2]]
    expected[3, :2] = 1 / felt[3, :2].max()
    np.testing.assert_allclose(rho, expected, rtol=1e-12)
    assert is_stiff(rho)
    assert not is_stiff(np.ones((4, 3)))
