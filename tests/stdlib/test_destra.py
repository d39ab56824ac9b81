"""DESTRA: the curves of TRACHIS drawn, or their extremes written."""

import pytest
from script_runs import ran

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
