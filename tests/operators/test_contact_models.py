"""Two cubes with contact between their sides: they press on each other and do not pull."""

import pytest

SPACE = """
OPTI DIME 3 ELEM CUB8 MODE TRID ;
S1 = (DROI 2 (0 0 0) (1 0 0)) TRAN 2 (0 1 0) ; V1 = S1 VOLU TRAN 2 (0 0 1) ;
S2 = (DROI 3 (0 0 1.) (1 0 1.)) TRAN 3 (0 1 0) ; V2 = S2 VOLU TRAN 2 (0 0 1) ;
M = (MODE V1 MECANIQUE ELASTIQUE) ET (MODE V2 MECANIQUE ELASTIQUE) ;
G = MATE M YOUN 1.E3 NU 0. ;
F1 = FACE 2 V1 ; F2 = INVE S2 ; TOP = FACE 2 V2 ;
B = (BLOQ UZ S1) ET (BLOQ UX UY V1) ET (BLOQ UX UY V2) ; D = BLOQ UZ TOP ;
"""


def test_two_cubes_press_on_each_other(found):
    low, high = found(
        SPACE.replace("DROI 3", "DROI 2").replace("TRAN 3", "TRAN 2")
        + "K = MODE F1 CONTACT UNILATERAL F2 MORT ; "
        "U = RESO ((RIGI (M ET K) G) ET B ET D) (DEPI D -.02) ; S = EXCO SMZZ (SIGM M G U) ; "
        "A1 = MINI S ; A2 = MAXI S ;",
        "A1", "A2",
    )  # fmt: skip
    assert (low, high) == pytest.approx((-10.0, -10.0), rel=1e-8)


def test_two_cubes_do_not_pull(found):
    size = found(
        SPACE + "K = MODE F1 CONTACT UNILATERAL F2 MESC ; "
        "U = RESO ((RIGI (M ET K) G) ET B ET D) (DEPI D .02) ; E = MAXI (SIGM M G U) ABS ;",
        "E",
    )
    assert size < 1e-9
