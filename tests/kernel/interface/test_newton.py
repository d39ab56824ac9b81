"""The interface's Newton against plain numpy; the start by projected forces, by Coulomb's law."""

import numpy as np
import pytest
from references.assembled import Bench
from references.iterations import KINDS, at_rest, compiled_newton, plain_newton, room
from together import together

from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.interface import interface_of
from ssilang.kernel.interface.laws.columns import N_STATE, LawCode, Parameter, Variable
from ssilang.kernel.interface.newton import (
    HOLDING_TURN,
    find_start,
    is_stiff,
    set_shares,
    solve_interface,
    workspace,
)
from ssilang.kernel.interface.response import Joints, accept
from ssilang.kernel.matrices.assembly import numbering_of


@together("kind", KINDS)
@together("held", [False, True])
@together("extra", [{}, {"FROT": 0.5}, {"FU": 1e4, "GF": 5.0, "FC": -1e3}])
def test_one_step_agrees(extra, held, kind):
    bench, cells = Bench(), 12
    top = [bench.node(i / cells, 0.0) for i in range(cells + 1)]
    soil = [bench.node(i / cells, 0.0) for i in range(cells + 1)]
    quads = [[top[i], top[i + 1], soil[i], soil[i + 1]] for i in range(cells)]
    zone = bench.joint("RAC2", quads, "JOI2", KN=1e9, KS=5e8, **extra)
    for n in (*top, *soil):
        bench.spring(1.0, n, unknown="UX")
        bench.spring(1.0, n, unknown="UY")
    whole = interface_of((zone,), bench.characteristics, numbering_of(bench.stiffness))
    joints, q = whole.points, whole.size
    rng = np.random.default_rng(4)
    A = rng.standard_normal((q, q))
    S = (A @ A.T / q + np.eye(q)) * 1e-8
    R = 1e6 * np.eye(q) if held else np.zeros((0, 0))
    y0 = rng.standard_normal(q) * 1e-4
    condensed = Condensed(S, R, 1.0, half=held)
    now, work = at_rest(joints, q, whole.initial_state()), room(joints, q, kind)
    assert compiled_newton(joints, condensed, now, y0, work) > 0
    trial, (_, plain) = work.trial, plain_newton(joints, condensed, now, y0)
    assert np.abs(trial.y - y0 + S @ trial.h).max() < 1e-9 * np.abs(y0).max()
    assert (trial.t[:, 1] < 0).any()
    assert (trial.t[:, 1] >= 0).any()
    for name in ("y", "t", "state", "h"):
        one, two = getattr(trial, name), getattr(plain, name)
        np.testing.assert_allclose(one, two, rtol=1e-7, atol=1e-9 * max(np.abs(two).max(), 1e-30))
    accept(trial, now)
    np.testing.assert_array_equal(now.delta, trial.delta)
    np.testing.assert_array_equal(now.state, trial.state)
    if kind == "inverse" and not extra:  # no point changes: the last tangents lead to the end
        assert compiled_newton(joints, condensed, now, 1e-6 * y0, work) == 1


ONE_POINT = Joints(
    np.zeros((1, 1), dtype=np.int64),
    np.eye(2)[None],
    np.ones(1),
    np.ones(1, dtype=np.int64),
    # KN, KS1, KS2, FU, GF, FC, FROT, SHEAR
    np.array([[1.0, 1.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0]]),
)


@together("kind", KINDS)
def test_a_step_with_no_consistent_shear_keeps_that_of_its_start(kind):
    """Closed, the shear opens the joint; open, nothing does: the law alone has no solution.

    With S = [[1, s], [s, 1]], KN = KS = 1, a start closed by 1 and y0 = (push, 1.9): open, the
    normal jump is 1.9 - 1 - 1 < 0; closed, a negative push makes it positive.
    """
    condensed = Condensed(np.array([[1.0, 0.9], [0.9, 1.0]]), np.zeros((0, 0)), 1.0)
    now = at_rest(ONE_POINT, 2, np.zeros((1, N_STATE)))
    now.delta[:] = now.f[:] = 0.0, -1.0
    found = []
    for push in np.linspace(-6.0, 6.0, 241):
        y0, work = np.array([push, 1.9]), room(ONE_POINT, 2, kind)
        turns = compiled_newton(ONE_POINT, condensed, now, y0, work)
        y, f, new = work.trial.y, work.trial.f, work.trial.state
        assert turns > 0
        assert y + condensed.S @ (f - now.f) == pytest.approx(y0, abs=1e-10)
        assert new[0, Variable.HELD] == 0.0
        assert not now.state.any()
        if turns >= HOLDING_TURN:
            found.append(push)
            assert f[0] == pytest.approx(now.delta[0] + y[0])  # shear still transmitted
            assert f[1] == 0.0  # on a joint that opens
            assert now.delta[1] + y[1] >= 0.0
    assert found, "no step needed its shear held: the case proves nothing"


@together("kind", KINDS)
def test_an_interface_that_loses_its_stiffness_says_so(kind):
    """One elastic jump, S = 1, R = 2, K = 1: `1 + S (K - R)` vanishes; 1 is left of a jump of 5."""
    joints = Joints(
        np.zeros((1, 1), dtype=np.int64), np.ones((1, 1, 1)), np.ones(1),
        np.zeros(1, dtype=np.int64), np.ones((1, 20)),
    )  # fmt: skip
    now, work = at_rest(joints, 1, np.zeros((1, N_STATE))), room(joints, 1, kind)
    condensed = Condensed(np.ones((1, 1)), np.array([[2.0]]), 1.0)
    now.delta[:] = now.f[:] = -5.0
    work.trial.y0[:] = work.trial.y[:] = 1.0
    assert solve_interface(joints, condensed, now, work) == (0, 0.2)


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
