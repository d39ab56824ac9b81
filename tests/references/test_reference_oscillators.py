"""CLUB CAST3M cases: energy, continuity, series compliance, the figures that all schemes see."""

import numpy as np
import pytest

from .oscillators import MASS, PULSATION, ClubA, ClubB, ClubC, series_stiffness


def test_club_a_keeps_its_energy_and_reflects_at_each_impact():
    case, t = ClubA(), np.linspace(0.0, 0.4, 4001)
    energy = case.energy(t)
    assert np.ptp(energy) < 1e-12 * energy[0]
    impacts = case.impacts(0.4)
    assert len(impacts) == 8
    before, after = case.motion(impacts - 1e-9)[1], case.motion(impacts + 1e-9)[1]
    assert after == pytest.approx(-before, rel=1e-7)
    assert np.all(before < 0.0)
    assert after - before == pytest.approx(case.impact_impulse, rel=1e-7)


def test_club_b_is_continuous_and_keeps_its_energy():
    case, t = ClubB(), np.linspace(0.0, 1.0, 20001)
    u, v = case.motion(t)
    energy = 0.5 * MASS * v**2 + 0.5 * case.k_s * u**2 + 0.5 * case.k_y * np.minimum(u, 0) ** 2
    assert np.ptp(energy) < 1e-12 * case.energy
    assert np.max(np.abs(np.diff(u))) < 1.01 * np.max(np.abs(v)) * (t[1] - t[0])


def test_club_b_oscillates_at_the_two_known_half_periods():
    case = ClubB()
    assert case.w_open == pytest.approx(PULSATION, rel=1e-14)
    closed = case.openings(1.0)[:5] - case.closings(1.0)[:5]
    assert closed == pytest.approx(np.pi / case.w_closed)
    assert np.diff(case.closings(1.0)) == pytest.approx(case.period)


def test_massless_soil_node_behind_a_joint_is_the_series_spring():
    # statics of a massless node at u_s: k_j min(u - u_s, 0) = k_s u_s; while u < 0 the joint is
    # closed and the force is that of the two in series; while u > 0 both are unloaded
    k_joint, k_soil = 3.0e7, 7.3888e6
    for u in (-2e-3, 0.0, 1e-3):
        soil = k_joint * u / (k_joint + k_soil) if u < 0.0 else 0.0
        force = k_joint * min(u - soil, 0.0)
        assert force == pytest.approx(k_soil * soil, abs=1e-9)
        assert force == pytest.approx(series_stiffness(k_joint, k_soil) * min(u, 0.0), abs=1e-9)


def test_club_c_energy_continuity_and_periodicity():
    case, t = ClubC(), np.linspace(0.0, 1.0, 20001)
    u, v = case.motion(t)
    k = np.where(u < 0.0, case.k_y, 0.0)
    energy = 0.5 * case.mass * v**2 + 0.5 * k * u**2 + case.mass * case.gravity * u
    assert np.ptp(energy) < 1e-11 * (energy[0] + 0.5 * case.mass * case.gravity**2 / case.w**2)
    assert u[0] == pytest.approx(-4.0 * case.settlement)
    assert v[0] == 0.0
    later = case.motion(t[:5000] + case.period)[0]
    assert later == pytest.approx(u[:5000], abs=1e-14)


def test_club_c_times_depend_on_the_frequency_only():
    soft, stiff = ClubC(k_y=1e5, gravity=3.0), ClubC(k_y=1e9)
    assert soft.openings(1.0) == pytest.approx(stiff.openings(1.0), rel=1e-14)
    assert soft.closings(1.0) == pytest.approx(stiff.closings(1.0), rel=1e-14)


def test_average_acceleration_converges_to_club_b_at_second_order():
    """Errors published for this case at 1, 0.5 and 0.25 ms: 2.5e-2, 6.3e-3, 1.6e-3."""
    case, errors = ClubB(), []
    for dt in (1e-3, 5e-4, 2.5e-4):
        n = round(1.0 / dt)
        u = np.empty(n + 1)
        u[0], v = case.u0, 0.0
        a = -case.k_s * u[0] / case.mass
        for i in range(n):
            push = case.mass * (4.0 * u[i] / dt**2 + 4.0 * v / dt + a)
            trial = push / (4.0 * case.mass / dt**2 + case.k_s)
            if trial < 0.0:
                trial = push / (4.0 * case.mass / dt**2 + case.k_s + case.k_y)
            u[i + 1] = trial
            new = 2.0 * (trial - u[i]) / dt - v
            v, a = new, 2.0 * (new - v) / dt - a
        exact = case.motion(dt * np.arange(n + 1))[0]
        errors.append(np.max(np.abs(u - exact)) / np.max(np.abs(exact)))
    assert errors == pytest.approx([2.5e-2, 6.3e-3, 1.6e-3], rel=0.03)
