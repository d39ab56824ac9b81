"""Isolated masses on bearings in scripts: periods, decay by friction, an integrated Bouc-Wen."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

G, MASS = 9.81, 1e5
POINTS = {2: ("0. 0.", "0. 0.1"), 3: ("0. 0. 0.", "0. 0. 0.1")}


def isolated(law, given, dimension=2):
    """A mass on one bearing, its lower point held."""
    low, high = POINTS[dimension]
    names = "'UX' 'UY'" if dimension == 2 else "'UX' 'UY' 'UZ'"
    return (
        f"OPTI DIME {dimension} ELEM SEG2 ; P0 = {low} ; P = {high} ; L = DROI 1 P0 P ; "
        f"M = MODE L 'MECANIQUE' 'ELASTIQUE' '{law}' 'JOI1' ; A = MATE M {given} ; T = TABL ; "
        f"T . 'RIGI' = (RIGI M A) ET (BLOQ P0 {names}) ; T . 'MASS' = MASS 'DEPL' {MASS} P ; "
        "T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; "
    )


def released(u0, kn, steps, dt):
    """Let go from u0, its weight on the bearing; displacements X, and what was lost E."""
    weight = MASS * G
    return (
        f"T . 'DEPL' = MANU 'CHPO' P 2 'UX' {u0} 'UY' {u0**2 / 4 - weight / kn!r} ; "
        f"T . 'CHAR' = CHAR 'MECA' (FORC (0. {-weight!r}) P) (EVOL 'MANU' (PROG 0. 100.) "
        f"(PROG 1. 1.)) ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' {dt} {steps * dt!r} ; "
        "T . 'PAS_SAUVES' = 'TOUS' ; R = DYNAMIC T ; X = PROG ; "
        f"REPE B {steps + 1} ; X = X ET (EXTR (R . &B . 'DEPL') P 'UX') ; FIN B ; "
        "E = MAXI (T . 'ENERGIES' . 'DISSIPEE') 'ABS' ; "
    )


def test_a_slider_swings_with_the_period_of_a_pendulum(found):
    """2 pi sqrt(R / g) for small swings; no energy is lost."""
    kn, dt = 1e8, 0.01
    script = isolated("APPUI_PENDULE", f"'KN' {kn} 'KS' 1.E8 'RAYO' 2. 'FROT' 0.")
    x, lost = found(script + released(0.01, kn, 380, dt), "X", "E")
    u, t = x.values, dt * np.arange(381)
    falls = np.flatnonzero((u[:-1] > 0) & (u[1:] <= 0))
    times = t[falls] + dt * u[falls] / (u[falls] - u[falls + 1])
    # average acceleration lengthens a period of 284 steps by (pi / 284)^2 / 3
    assert np.diff(times)[0] == pytest.approx(2 * math.pi * math.sqrt(2.0 / G), rel=2e-4)
    assert np.abs(u).max() < 0.01 * 1.001
    assert lost == 0.0


def test_friction_takes_the_same_off_each_swing(found):
    """Coulomb: each half swing is shorter by 2 mu R."""
    kn, dt, mu = 1e8, 0.01, 0.004
    script = isolated("APPUI_PENDULE", f"'KN' {kn} 'KS' 1.E9 'RAYO' 2. 'FROT' {mu}")
    u = found(script + released(0.1, kn, 450, dt), "X").values
    inner = np.flatnonzero(np.diff(u[:-1]) * np.diff(u[1:]) <= 0) + 1
    tops = np.abs(np.array([0.1, *u[inner[np.abs(u[inner]) > 0.02]]]))[:4]
    np.testing.assert_allclose(np.diff(tops), -2 * mu * 2.0, rtol=0.02)


def test_a_core_in_both_directions_moves_as_an_integrated_bouc_wen(found):
    """DYNAMIC against Runge and Kutta on the five equations of a mass on lead and rubber."""
    ks, kpos, qd, steps = 1.1e7, 1e6, 5e4, 350
    uy = qd / (ks - kpos)
    script = isolated("APPUI_PLOMB", f"'KN' 1.E9 'KS' {ks} 'QD' {qd} 'KPOS' {kpos} 'ETA' 2.", 3)
    script += (
        "LI = PROG 0. 'PAS' 0.002 0.7 ; F1 = SIN (LI * 360.) ; F2 = SIN (LI * 500.) ; "
        f"T . 'CHAR' = (CHAR 'MECA' (FORC (1.5E5 0. 0.) P) (EVOL 'MANU' LI F1)) ET "
        "(CHAR 'MECA' (FORC (0. 1.E5 0.) P) (EVOL 'MANU' LI F2)) ; "
        "T . 'TEMPS_CALCULES' = LI ; T . 'PAS_SAUVES' = 'TOUS' ; R = DYNAMIC T ; "
        f"X = PROG ; Y = PROG ; REPE B {steps + 1} ; D = R . &B . 'DEPL' ; "
        "X = X ET (EXTR D P 'UX') ; Y = Y ET (EXTR D P 'UY') ; FIN B ; "
    )
    x, y = (v.values for v in found(script, "X", "Y"))

    def rates(t, s):
        u, v, z = s[:2], s[2:4], s[4:]
        push = [1.5e5 * math.sin(2 * math.pi * t), 1e5 * math.sin(math.radians(500 * t))]
        turn = z @ v
        c = 1.0 if turn > 0 else 0.0
        return np.concatenate([v, (push - kpos * u - qd * z) / MASS, (v - turn * c * z) / uy])

    at = np.linspace(0.0, 0.7, steps + 1)
    own = solve_ivp(rates, (0, 0.7), np.zeros(6), t_eval=at, rtol=1e-6, atol=1e-9, max_step=2e-2)
    size = np.abs(own.y[:2]).max()
    assert size > 10 * uy
    np.testing.assert_allclose(x, own.y[0], atol=5e-3 * size)
    np.testing.assert_allclose(y, own.y[1], atol=5e-3 * size)
