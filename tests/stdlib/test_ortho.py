"""@ORTHO: axes that follow a line; DESTRA: curves of TRACHIS."""

import pytest
from script_runs import found, ran

VALUES = "(PROG 2.E9 1.E9 1.5E9 0.2 0.1 0.15 5.E8 4.E8 3.E8 0. 0. 0. 2000.)"
NAMED = "'YG1' 2.E9 'YG2' 1.E9 'YG3' 1.5E9 'NU12' 0.2 'NU23' 0.1 'NU13' 0.15 'G12' 5.E8 'RHO' 2000."


@pytest.mark.parametrize("mode", ["PLAN CONT", "PLAN DEFO"])
def test_axes_of_a_straight_line_are_those_of_one_direction(mode):
    apart, size, mass = found(
        f"OPTI DIME 2 MODE {mode} ELEM QUA4 ; L = DROI 8 (0. 0.) (2. 1.) ; "
        "S = L TRAN 2 (-0.5 1.) ; T N B = @FRENET L ; "
        f"MA MO = @ORTHO S L T N 10. {VALUES} ; A = 10. + (ATG 0.5) ; "
        f"MB = MATE MO {NAMED} 'DIRECTION' ((COS A) (SIN A)) ; X Y = COOR S ; "
        "U = (NOMC 'UX' (X * Y)) ET (NOMC 'UY' (X - (Y * Y))) ; F = (RIGI MO MB) * U ; "
        "D = MAXI (ABS (((RIGI MO MA) * U) - F)) ; G = MAXI (ABS F) ; "
        "M = MAXI (ABS (((MASS MO MA) * U) - ((MASS MO MB) * U))) ;",
        "D", "G", "M",
    )  # fmt: skip
    assert apart < 1e-12 * size
    assert mass == pytest.approx(0.0, abs=1e-9)


def test_axes_in_space():
    apart, size = found(
        "OPTI DIME 3 ELEM CUB8 ; L = DROI 2 (0. 0. 0.) (1. 0. 0.) ; "
        "S = L TRAN 1 (0. 1. 0.) ; V = S VOLU 1 'TRAN' (0. 0. 1.) ; "
        "T = MANU 'CHPO' L 3 'TX' 0. 'TY' 0.6 'TZ' 0.8 ; "
        "N = MANU 'CHPO' L 3 'NX' 1. 'NY' 0. 'NZ' 0. ;"
        f"MA MO = @ORTHO V L T N 90. {VALUES} 'TRID' ; "
        f"MB = MATE MO {NAMED} 'G23' 4.E8 'G13' 3.E8 'DIRECTION' (1. 0. 0.) (0. -0.6 -0.8) ; "
        "X Y Z = COOR V ; U = (NOMC 'UX' (X * Z)) ET (NOMC 'UZ' (X - (Y * Z))) ; "
        "F = (RIGI MO MB) * U ; D = MAXI (ABS (((RIGI MO MA) * U) - F)) ; G = MAXI (ABS F) ;",
        "D", "G",
    )  # fmt: skip
    assert apart < 1e-10 * size


_TABLE = (
    "OPTI DIME 2 ELEM SEG2 ; L1 = DROI 4 (0. 0.) (1. 0.) ; X1 = COOR 1 L1 ; T2 = TABL ; "
    "T2 . 'TEMPS' = TABL ; T2 . 'CH' = TABL ; T2 . 'TEMPS' . 0 = 0. ; T2 . 'TEMPS' . 1 = 2. ; "
    "T2 . 'CH' . 0 = X1 + 1. ; T2 . 'CH' . 1 = X1 * 3. ; T1 = TRACHIS T2 'CH' L1 'PREF' 'Chill' ; "
)


@pytest.fixture
def unsaved():
    """Here pictures are written."""


@pytest.mark.parametrize(
    "call",
    [
        "DESTRA T1 ;",
        "DESTRA T1 'GRIL' 'LOGX' 'XBOR' 0.1 1. 'YBOR' 0. 4. 'TITX' 'place' 'REGU' 'NCLK' ;",
        "DESTRA T1 'CHOI' 2 'TITR' 'One' ;",
        "DESTRA T1 'CHOI' (LECT 1 2) ;",
        "S = TABL ; S . 1 = 'TIRR' ; S . 'TITRE' = TABL ; S . 'TITRE' . 1 = 'start' ; DESTRA T1 "
        "S ;",
        "DESTRA T1 (EVOL 'MANU' 'x' (PROG 0. 1.) 'straight' (PROG 0. 2.)) ;",
    ],
)
def test_curves_are_drawn(call, tmp_path):
    ran(_TABLE + call, output_directory=tmp_path)
    (picture,) = tmp_path.rglob("*.svg")
    assert picture.stat().st_size > 5000


def test_extremes_are_written_a_line_a_curve(tmp_path):
    result = ran(_TABLE + "DESTRA T1 'TABMIMA' ;", output_directory=tmp_path)
    head, *rows = result.output.strip().split("\n")
    assert head.split() == ["Chill", "minimum", "maximum"]
    assert [[float(v) for v in row.split()[-2:]] for row in rows] == [[1.0, 2.0], [0.0, 3.0]]
    assert not list(tmp_path.rglob("*.svg"))
