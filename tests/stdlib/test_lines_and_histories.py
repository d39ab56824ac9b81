"""FREPART HAUBAN ROTA_IMP TRACHIS TRACHIT against closed forms."""

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


HISTORY = (
    "OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; L = DROI 4 (0. 0.) (2. 0.) ; X = COOR 1 L ;"
    "T = TABL ; T . 'TEMPS' = TABL ; T . 'DE' = TABL ;"
    "REPE B 4 ; I = &B - 1 ; T . 'TEMPS' . I = 0.5 * I ;"
    "T . 'DE' . I = (NOMC 'UX' (X * I)) ET (NOMC 'UY' (X * X * I)) ; FIN B ;"
)


def test_curves_along_a_line():
    n, e, a, b = found(
        HISTORY + "R = TRACHIS T 'DE' L (LECT 1 3) (MOTS 'UY') 'PREF' 'depl' 'UNIT' 'ms' ;"
        "N = DIME R ; E = R . 2 . 'VALEUR' ; A = R . 2 . 'LEGEND1' ; B = R . 2 . 'LEGEND2' ;",
        "N", "E", "A", "B",
    )  # fmt: skip
    assert n == 2
    x = np.linspace(0, 2, 5)
    np.testing.assert_allclose(e.parts[0].abscissas, x)
    np.testing.assert_allclose(e.parts[0].ordinates, 3 * x**2)
    assert str(a) == "depl"
    assert str(b).replace(" ", "") == "UYt=1.50000E+03ms"


def test_curves_along_a_line_by_times_and_names():
    n, e, b = found(
        HISTORY + "R = TRACHIS T 'DE' L (PROG 0.5) (MOTS 'UX' 'UY') (MOTS 'HORI' 'VERT') ;"
        "N = DIME R ; E = R . 1 . 'VALEUR' ; B = R . 2 . 'LEGEND2' ;",
        "N", "E", "B",
    )  # fmt: skip
    assert n == 2
    np.testing.assert_allclose(e.parts[0].ordinates, np.linspace(0, 2, 5))
    assert str(b).startswith("VERT t=")


def test_curves_in_time_at_points():
    n, e, a, b = found(
        HISTORY + "C = TABL 'NOM_COMPOSANTE' ; C . 2 = 'monte' ; P = TABL 'NOM_POINT' ;"
        "P . 5 = 'bout' ; R = TRACHIT T 'DE' L C P 'PREF' 'u' ; N = DIME R ;"
        "E = R . 10 . 'VALEUR' ; A = R . 10 . 'LEGEND2' ; B = R . 4 . 'LEGEND2' ;",
        "N", "E", "A", "B",
    )  # fmt: skip
    assert n == 10
    np.testing.assert_allclose(e.parts[0].abscissas, [0, 0.5, 1, 1.5])
    np.testing.assert_allclose(e.parts[0].ordinates, [0, 4, 8, 12])
    assert (str(a), str(b)) == ("monte bout", "UX PT 4")


BENDING = """
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = ((0. 0.) DROI 4 (4. 0.)) TRAN 2 (0. 1.) ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; T = TABL 'PASAPAS' ; T . 'MODELE' = MO ; LD = COTE 2 S ;
T . 'CARACTERISTIQUES' = MATE MO 'YOUN' 1.E3 'NU' 0. ; B = BLOQ 'DEPL' (COTE 4 S) ;
T . 'BLOCAGES_MECANIQUES' = B ; U = BLOQ 'UX' LD ; T . 'BLOCAGES_MECANIQUES' = B ET U ;
T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI U 0.2) (EVOL 'MANU' (PROG 0. 2.) (PROG 0. 2.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 1. 2. ; PASAPAS T ;
"""


def test_displacements_of_pasapas_along_a_line_and_in_time():
    # the index spells an operator, and its fields hold multipliers that no line has
    n, along, legend, m, history = found(
        BENDING + "R = TRACHIS T 'DEPLACEMENTS' (COTE 1 S) ; N = DIME R ; DESTRA R ; "
        "E = R . 3 . 'VALEUR' ; A = MOT R . 3 . 'LEGEND1' ; "
        "Q = TRACHIT T 'DEPLACEMENTS' LD ; M = DIME Q ; F = Q . 1 . 'VALEUR' ; DESTRA Q ; ",
        "N", "E", "A", "M", "F",
    )  # fmt: skip
    assert (n, m, str(legend)) == (6, 6, "DEPLACEMENTS")
    np.testing.assert_allclose(along.parts[0].ordinates, 0.05 * np.arange(5), atol=1e-12)
    np.testing.assert_allclose(history.parts[0].ordinates, [0, 0.2, 0.4], atol=1e-12)
