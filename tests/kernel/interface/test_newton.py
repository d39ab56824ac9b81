"""The interface's Newton gives the same whatever its factors, and what plain numpy does."""

import numpy as np
import pytest
from references.assembled import Bench
from references.iterations import KINDS, at_rest, compiled_newton, plain_newton, room
from together import together

from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.interface import interface_of
from ssilang.kernel.interface.laws.columns import N_STATE, Variable
from ssilang.kernel.interface.newton import HOLDING_TURN, solve_interface
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
    condensed = Condensed(S, R, 1.0)
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
