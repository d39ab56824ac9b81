"""Mohr-Coulomb joints: path of Cast3M's elementary test, dilatancy, tangent, energy."""

from functools import partial

import numpy as np
import pytest
from references import law_points
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.laws.columns import Variable
from ssilang.kernel.interface.laws.mohr_law import check_mohr_parameters

MOHR = 2
parameters = partial(law_points.table_of, KN=100.0, KS1=50.0, KS2=50.0, TPHI=1.0, FROT=-1.0)
answer, walk = partial(law_points.answer, MOHR), partial(law_points.walk, MOHR)


def test_slip_under_falling_pressure_then_opening():
    path = [[0, -0.1], [0.1, -0.1], [0.3, -0.1], [0.3, -0.05], [0.3, 0.1]]
    t, state = walk(path, parameters())
    np.testing.assert_allclose(t[:, 1], [-10, -10, -10, -5, 0], atol=1e-12)
    np.testing.assert_allclose(t[:, 0], [0, 5, 10, 5, 0], atol=1e-12)
    np.testing.assert_allclose(state[:, Variable.SLIP1], [0, 0, 0.1, 0.2, 0.3], atol=1e-14)
    np.testing.assert_allclose(state[:, Variable.OPENING], [0, 0, 0, 0, 0.1], atol=1e-14)
    assert state[-1, Variable.STATUS] == 1
    again, _, _ = answer(np.array([[0.3, -0.02]]), state[-1:], parameters())
    np.testing.assert_allclose(again, [[0.0, -2.0]], atol=1e-12)


def test_dilatant_slip_opens_the_joint_and_stays_on_the_cone():
    p = parameters(TPSI=0.3, COHE=1.0)
    s = np.linspace(0, 1, 50)
    t, state = walk(np.stack([s, np.full(50, -0.1)], 1), p)
    sliding = state[:, Variable.SLIP1] > 0
    np.testing.assert_allclose(t[sliding, 0], 1.0 - t[sliding, 1], rtol=1e-12)
    np.testing.assert_allclose(state[:, Variable.XI], 0.3 * state[:, Variable.SLIP1], rtol=1e-12)


def test_faces_lifted_by_their_own_slip_still_carry_shear():
    """Slip s of 0.1 - 2 / 100 leaves the shear at the cohesion and lifts by as much: no pressure.

    KS 100, COHE 2 and a dilatancy of 45 degrees; what stands in between is on the cone.
    """
    p = parameters(KS1=100.0, TPSI=1.0, COHE=2.0)
    t, state = walk([[0.1, 0.05]], p)
    np.testing.assert_allclose(t, [[3.5, -1.5]], rtol=1e-12)  # slip 0.065 lifts 0.065
    t, state = walk([[0.1, 0.08], [0.1, 0.08]], p)
    np.testing.assert_allclose(t, [[2.0, 0.0], [2.0, 0.0]], atol=1e-12)
    np.testing.assert_allclose(state[:, Variable.XI], 0.08, rtol=1e-12)
    t, state = walk([[0.1, 0.09]], p)  # beyond what the slip lifts: no strength, open
    np.testing.assert_array_equal(t, [[0.0, 0.0]])
    assert state[-1, Variable.STATUS] == 1


def test_tension_stops_at_the_strength_and_its_opening_stays():
    p = parameters(COHE=10.0, FTRC=2.0)
    t, state = walk([[0, 0.1], [0, 0.05]], p)
    assert t[0, 1] == pytest.approx(2.0)
    assert state[0, Variable.XI] == pytest.approx(0.08)
    assert t[1, 1] == pytest.approx(-3.0)


def test_second_normal_stiffness_beyond_a_closing():
    t, _ = walk([[0, -0.05], [0, -0.2]], parameters(ECN=0.1, EF=500.0))
    np.testing.assert_allclose(t[:, 1], [-5.0, -10.0 - 50.0], rtol=1e-12)


@together(
    "path, given, plastic",
    [
        # slip of 0.1 - 0.01 / 0.5 at the pressure 1: dilatancy lifts by its tangent times the slip
        ([[0.1, -0.01]], {}, [[0.08, 0.0]]),
        ([[0.06, 0.08, -0.01]], {}, [[0.048, 0.064, 0.0]]),
        # tension of 1 at most: 0.03 - 0.01 stay open; what closes again adds nothing
        ([[0.0, 0.03], [0.0, 0.01]], {"COHE": 9.0, "FTRC": 1.0}, [[0.0, 0.02]]),
        # there and back again: lengths add up
        ([[0.1, -0.01], [-0.1, -0.01]], {}, [[0.08, 0.0], [-0.16, 0.0]]),
    ],
)
def test_cumulated_plastic_jump_is_the_length_of_its_path(path, given, plastic):
    """`sqrt(2/3)` of it; KN 100, KS 50, Coulomb's tangent 1: slip ends at `t = 100 * 0.01`."""
    _, states = walk(np.array(path), parameters(**given))
    length = sum(np.sqrt(2 / 3) * np.linalg.norm(step) for step in plastic)
    assert states[-1, Variable.CUMULATED] == pytest.approx(length, rel=1e-12)


def test_dilatant_slip_counts_its_opening_in_the_cumulated_jump():
    _, states = walk(np.array([[0.1, -0.01]]), parameters(TPSI=0.4))
    slip, lift = states[-1, Variable.SLIP1], states[-1, Variable.XI]
    assert lift == pytest.approx(0.4 * slip)
    assert states[-1, Variable.CUMULATED] == pytest.approx(np.sqrt(2 / 3) * np.hypot(slip, lift))


@together("wrong", [{"KN": 0.0}, {"COHE": -1.0}, {"FNE": 1.0, "QT": 200.0}])
def test_inadmissible_parameters_are_refused(wrong):
    with pytest.raises(
        MaterialError, check=lambda e: e.code == "kernel.interface.joint-parameter-must"
    ):
        check_mohr_parameters(parameters(**wrong))


def test_compression_that_yielded_yields_on_along_the_same_line():
    """Steps do not matter: t = -(FNE + QT (w - FNE / KN)), back on KN from any point of it."""
    p = parameters(FNE=5.0, QT=10.0)
    w = np.array([-0.04, -0.08, -0.12, -0.15, -0.13, -0.17])
    t, states = walk([[0, x] for x in w], p)
    line = -(5.0 + 10.0 * (-w - 0.05))
    wanted = np.where(w > -0.05, 100.0 * w, line)
    wanted[4] = line[3] + 100.0 * 0.02
    np.testing.assert_allclose(t[:, 1], wanted, rtol=1e-12)
    plastic = -w + t[:, 1] / 100.0
    np.testing.assert_allclose(states[:, Variable.DAMAGE], plastic, rtol=1e-12, atol=1e-15)
