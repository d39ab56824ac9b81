"""Loads of COQ2, rings and soils by hand: work of uneven cells, buckling, weights, free fields."""

import numpy as np
import pytest
from script_runs import found, ran
from together import together

from ssilang.cli.run import run_text

TUBE = (
    "OPTI DIME 2 MODE {mode} ELEM SEG2 ; P0 = 2. 0. ; P1 = 2. 0.3 ; P2 = 2. 1.7 ; P3 = 2. 2. ; "
    "S = (P0 DROI 1 P1) ET (P1 DROI 1 P2) ET (P2 DROI 1 P3) ; "
    "M = MODE S MECANIQUE ELASTIQUE COQ2 ; A = MATE M YOUN 7.E9 NU 0.3 EPAI 0.01 ; "
)
LOADS = {
    "PRES": "F = PRES COQU M 5.E4 'NORM' ;",
    "FSUR": "F = FSUR COQU M (-5.E4 0.) ;",
    "BSIG": "L = MODE S CHARGEMENT PRESSION COQ2 ; F = BSIG L (PRES L 'PRES' 5.E4) ;",
}


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("mode", ["AXIS", "FOUR 0"])
def test_a_free_tube_under_pressure_widens_without_bending(found, mode, load):
    """As much everywhere, u = -p r^2 / (E h), however uneven the cells are."""
    first, last, most, bent = found(
        TUBE.format(mode=mode) + LOADS[load] + "U = RESO ((RIGI M A) ET (BLOQ P0 'UZ')) F ; "
        "X = EXTR U 'UR' P0 ; Y = EXTR U 'UR' P2 ; R = MAXI (ABS (EXCO 'RT' U)) ; "
        "B = MAXI (ABS (EXCO 'M11' (SIGM M A U))) ;",
        "X", "Y", "R", "B",
    )  # fmt: skip
    assert [first, last] == pytest.approx([-5e4 * 4.0 / 7e9 / 0.01] * 2, rel=1e-9)
    assert most < 1e-12
    assert bent < 1e-6


@pytest.mark.parametrize(
    ("mode", "width", "stiffer"),
    [("PLAN CONT", "'DIM3' 0.4", 1.0), ("PLAN DEFO", "", 1 / (1 - 0.3**2))],
)
@pytest.mark.parametrize("load", ["PRES COQU M 60. (0. 1.) A", "FSUR COQU M (0. 60.) A"])
def test_one_cell_is_a_whole_cantilever(found, mode, width, stiffer, load):
    """q L^4 / (8 E I) and q L^3 / (6 E I) at the tip, q L^2 / 2 at the wall of the whole width."""
    down, turn, wall = found(
        f"OPTI DIME 2 MODE {mode} ELEM SEG2 ; P0 = 1. 2. ; P1 = 4. 2. ; S = P0 DROI 1 P1 ; "
        f"M = MODE S MECANIQUE ELASTIQUE COQ2 ; A = MATE M YOUN 2.E9 NU 0.3 EPAI 0.1 {width} ; "
        f"W = BLOQ P0 'UX' 'UY' 'RZ' ; F = {load} ; U = RESO ((RIGI M A) ET W) F ; "
        "X = EXTR U 'UY' P1 ; Y = EXTR U 'RZ' P1 ; Z = EXTR (REAC U W) 'MZ' P0 ;",
        "X", "Y", "Z",
    )  # fmt: skip
    bending = 2e9 * 0.1**3 / 12 * stiffer
    assert down == pytest.approx(60.0 * 3.0**4 / 8 / bending, rel=1e-9)
    assert turn == pytest.approx(60.0 * 3.0**3 / 6 / bending, rel=1e-9)
    assert wall == pytest.approx(-60.0 * 3.0**2 / 2 * (0.4 if width else 1.0), rel=1e-9)


SLOPE = (
    "OPTI DIME 3 MODE TRID ELEM {cell} ; A = 0. 0. 0. ; B = 3. 0. 4. ; "
    "S = (A DROI 2 B) TRAN 3 (0. 2. 0.) ; M = MODE S MECANIQUE {shell} ; "
)
AREA, NORMAL = 10.0, np.array([-0.8, 0.0, 0.6])


def _moved(vector):
    return f"(MANU 'CHPO' S 3 'UX' {vector[0]} 'UY' {vector[1]} 'UZ' {vector[2]})"


@pytest.mark.parametrize(("cell", "shell"), [("TRI3", "DKT"), ("TRI3", "DST"), ("QUA4", "COQ4")])
@pytest.mark.parametrize("vector", [(1.0, 0.0, 0.0), (0.2, -0.5, 0.9), (0.6, 0.0, 0.8)])
def test_without_a_direction_the_sides_stand_on_springs(found, cell, shell, vector):
    work = found(
        SLOPE.format(cell=cell, shell=shell) + f"U = {_moved(vector)} ; X = XTMX U (KP M 7.) ;", "X"
    )
    assert work == pytest.approx(7.0 * AREA * (NORMAL @ vector) ** 2, abs=1e-12)


def test_with_a_direction_forces_point_along_the_normal(found):
    """Forces RG (u . v) A n, of whatever length the direction is; symmetric unless asked."""
    u, v = np.array([0.2, -0.5, 0.9]), np.array([0.0, 0.6, 0.8])
    values = found(
        SLOPE.format(cell="TRI3", shell="DKT")
        + f"U = {_moved(u)} ; F = RESU ((KP M 7. 'ASYM' (0. 3. 4.)) * U) ; P = EXTR F 'MAIL' ; "
        "P = P POIN 1 ; X1 = EXTR F 'FX' P ; X2 = EXTR F 'FY' P ; X3 = EXTR F 'FZ' P ; "
        "G = RESU ((KP (0. 0.6 0.8) M 7.) * U) ; Q = (EXTR G 'MAIL') POIN 1 ; "
        "Y1 = EXTR G 'FX' Q ; Y2 = EXTR G 'FY' Q ; Y3 = EXTR G 'FZ' Q ;",
        "X1", "X2", "X3", "Y1", "Y2", "Y3",
    )  # fmt: skip
    K = 7.0 * AREA * np.outer(NORMAL, v)
    assert values[:3] == pytest.approx(K @ u, abs=1e-12)
    assert values[3:] == pytest.approx((K + K.T) / 2 @ u, abs=1e-12)


RADIUS, YOUNG = 100.0, 20000.0
RING = (
    "OPTI DIME 2 MODE FOUR 0 ELEM QUA8 ; LB = DROI 2 (99.5 0.) (100.5 0.) ; "
    "S = LB TRAN 2 (0. 1.) ; M = MODE S MECANIQUE ELASTIQUE ; "
    f"OPTI MODE FOUR NOHARM ; A = MATE M 'YOUN' {YOUNG} 'NU' 0. ; "
    "B = (BLOQ 'UZ' LB) ET (BLOQ 'UZ' (S COTE 3)) ; OPTI MODE FOUR 0 ; "
    "K0 = (RIGI M A) ET B ET (BLOQ 'UT' S) ; "
    "G = SIGM M A (RESO K0 (PRES 'MASS' M 1. (S COTE 2))) ; "
)


@together("harmonic", [2, 3, 5])
def test_rings_buckle_under_dead_pressure(harmonic):
    """Inextensional modes turn by w (n^2 - 1) / (n R): p = n^2 E (h / R)^3 / 12."""
    frequency = found(
        RING + f"OPTI MODE FOUR {harmonic} ; KG = KSIG M A (-1. * G) 'FLAM' ; "
        "T = VIBR 'SIMU' 0.01 1 ((RIGI M A) ET B) KG ; F = T . 'MODES' . 1 . 'FREQUENCE' ;",
        "F",
    )
    pressure = harmonic**2 * YOUNG / RADIUS**3 / 12
    assert (2 * np.pi * frequency) ** 2 == pytest.approx(pressure, rel=0.015)


@together("harmonic, motion", [(1, "'UR' 1. 'UZ' 0. 'UT' -1."), (0, "'UR' 0. 'UZ' 1. 'UT' 0.")])
def test_translations_do_no_work_on_the_hoop_stress(harmonic, motion):
    work, scale = (
        found(
            RING + f"OPTI MODE FOUR {harmonic} ; KG = KSIG M G A ; "
            f"W = XTMX (MANU 'CHPO' S 3 {field} 'NATU' 'DIFFUS') KG ;",
            "W",
        )
        for field in (motion, "'UR' 1. 'UZ' 0. 'UT' 0.")
    )
    assert abs(work) < 1e-9 * abs(scale)


COLUMN = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L = DROI 3 (0. 0.) (3. 0.) ; S = TRAN 4 L (0. -4.) ; "
    "M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 2.E8 'NU' 0.3 'RHO' 2000. ; "
    "Z = MANU 'CHPO' S 2 'UX' 1.E-3 'UY' 2.E-3 ; W = TABL ; REPE B 3 ; I = TABL ; "
    "I . 'TEMP' = 1. * &B ; I . 'DEPL' = &B * Z ; I . 'VITE' = Z ; I . 'ACCE' = -1. * &B * Z ; "
    "W . &B = I ; FIN B ; T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; "
    "T . 'RIGI' = RIGI M A ; T . 'MASS' = MASS M A ; T . 'FREQUENCE' = 10. ; T . 'MOUVEMENT' = W ; "
)
FREE_FIELD = {
    "ZDRM": "T . 'COUCHE' = S ; T . 'INTERIEUR' = COTE 3 S ; ",
    "ZBOR": "T . 'FRONTIERE' = COTE 2 S ; T . 'AMORTISSEURS' = AMOR M (COTE 2 S) A ; ",
}
WHOLE = "T . 'COLONNE' = COTE 2 S ; "


@together("column", ["", WHOLE])
@together("operator", FREE_FIELD)
def test_a_motion_that_is_known_everywhere_loads(operator, column):
    done = ran(
        f"{COLUMN}{FREE_FIELD[operator]}{column}C = {operator} T ; "
        "X = MAXI (RESU (TIRE C 2.)) 'ABS' ;"
    )
    assert done.session.root.find("X") > 0.0


@together("column", ["", WHOLE])
@together("operator", FREE_FIELD)
@together("of", ["DEPL", "VITE", "ACCE"])
@together("part", ["EXCO 'UX' Z 'UX'", "EXCO 'UY' Z 'UY'", "REDU Z (COTE 1 S)"])
def test_a_motion_that_is_not_known_somewhere_is_refused(operator, column, of, part):
    lost = f"I = W . 2 ; I . '{of}' = {part} ; "
    done = run_text(f"{COLUMN}{lost}{FREE_FIELD[operator]}{column}C = {operator} T ;")
    assert [e.code for e in done.errors] == ["kernel.waves.motion-not-known"], done.message
