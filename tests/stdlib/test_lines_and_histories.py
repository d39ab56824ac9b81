"""FREPART HAUBAN ROTA_IMP against closed forms."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve
from script_runs import found


def cable(span, rise, weight, stiffness, rest):
    """Ordinates and tensions at 41 places of equal rest lengths, by integration and shooting."""

    def steps(s, state, horizontal, vertical):
        up = vertical + weight * s
        tension = np.hypot(horizontal, up)
        return np.array([horizontal, up]) / tension * (1 + tension / stiffness)

    def integrated(forces):
        return solve_ivp(
            steps, (0, rest), [0, 0], args=tuple(forces), rtol=1e-11, atol=1e-11,
            t_eval=np.linspace(0, rest, 41),
        )  # fmt: skip

    start = [weight * span, -0.5 * weight * rest + weight * rise]
    forces = fsolve(lambda f: integrated(f).y[:, -1] - (span, rise), start, xtol=1e-12)
    way = integrated(forces)
    return way.y[1], np.hypot(forces[0], forces[1] + weight * way.t)


@pytest.mark.parametrize(
    ("dimension", "first", "second", "stiffness"),
    [
        (2, "(3. 1.)", "(103. 31.)", 2e6),
        (2, "(103. 31.)", "(3. 1.)", 4e4),
        (3, "(3. 2. 1.)", "(63. 82. 31.)", 4e4),
    ],
)
def test_cable_is_the_elastic_catenary(dimension, first, second, stiffness):
    mode = "MODE PLAN CONT" if dimension == 2 else ""
    z, t, length, points, kept = found(
        f"OPTI DIME {dimension} {mode} ELEM QUA8 ; P1 = {first} ; P2 = {second} ;"
        f"G M C = HAUBAN P1 P2 {stiffness} 50. 106. 40 ; Z1 = COOR {dimension} G ;"
        "Z = EXTR Z1 'VALE' 'SCAL' G ;"
        "T = EXTR (CHAN 'CHPO' M C) 'VALE' 'EFFX' G ; L = MESU G ; N = NBEL G ; E = VALE 'ELEM' ;",
        "Z", "T", "L", "N", "E",
    )  # fmt: skip
    assert (points, kept) == (40, "QUA8")
    z, tension = np.array(z.values), np.array(t.values)
    z, tension = (z, tension) if z[0] < z[-1] else (z[::-1], tension[::-1])
    heights, pulls = cable(100, 30, 50, stiffness, 106)
    np.testing.assert_allclose(z, 1 + heights, atol=1e-6)
    np.testing.assert_allclose(tension[1:-1], pulls[1:-1], rtol=1e-4)
    chords = (tension[1:] + tension[:-1]) / 2 / stiffness + 1
    assert length == pytest.approx(np.sum(chords) * 106 / 40, rel=1e-4)


def test_imposed_rotation_leaves_radius_and_axis_free():
    values = found(
        "OPTI DIME 3 ELEM CUB8 ; P1 = 1. 1. 0. ; P2 = 1. 1. 3. ;"
        "L = DROI 2 (3. 1. 0.) (5. 1. 0.) ; S = TRAN 2 L (0. 1. 0.) ;"
        "V = VOLU 'TRAN' 1 S (0. 0. 1.) ;"
        "MO = MODE V 'MECANIQUE' 'ELASTIQUE' ; K = RIGI MO (MATE MO 'YOUN' 1. 'NU' 0.3) ;"
        "R C = ROTA_IMP 40. P1 P2 L ;"
        "Q = POIN L 2 ;"
        "U = RESO (K ET R ET (BLOQ 'UZ' V) ET (RIGI 'DEPL' 1.E-6 V)) C ;"
        "X = EXTR U 'UX' Q ; Y = EXTR U 'UY' Q ; D = Q MOIN P1 ; E = COOR 1 D ; F = COOR 2 D ;",
        "X", "Y", "E", "F",
    )  # fmt: skip
    x, y, dx, dy = values
    turned = np.degrees(np.arctan2(y + dy, x + dx) - np.arctan2(dy, dx))
    assert turned == pytest.approx(40, abs=1e-6)
