"""Loads of COQ2 do the work of its cubic deflection: what few uneven cells must give exactly."""

import pytest

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
