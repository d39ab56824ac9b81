"""TAIL 'DIAMETRE_MIN' on cells of known heights."""

import math

import pytest
from script_runs import found
from together import together


@together(
    "mesh, want",
    [
        ("DIME 2 ELEM QUA4 ; S = (DROI 1 (0. 0.) (2. 0.)) TRAN 1 (0. 0.3) ;", 0.3),
        ("DIME 2 ELEM QUA4 ; S = (DROI 1 (0. 0.) (2. 0.)) TRAN 1 (1. 1.) ;", 1.0),
        ("DIME 2 ELEM TRI3 ; S = MANU 'TRI3' (0. 0.) (3. 0.) (0. 4.) ;", 2.4),
        ("DIME 2 ELEM QUA8 ; S = (DROI 1 (0. 0.) (2. 0.)) TRAN 1 (0. 2.) ;", 1.0),
        (
            "DIME 3 ELEM CUB8 ; S = ((0. 0. 0.) DROI 1 (2. 0. 0.)) TRAN 1 (0. 3. 0.) ; "
            "S = VOLU 1 S 'TRAN' (0. 1. 0.5) ;",
            0.5,
        ),
        (
            "DIME 3 ELEM TET4 ; S = MANU 'TET4' (0. 0. 0.) (1. 0. 0.) (0. 1. 0.) (0. 0. 1.) ;",
            1.0 / math.sqrt(3.0),
        ),
    ],
)
def test_smallest_length_is_the_least_height(mesh, want):
    script = f"OPTI {mesh} A = TAIL 'DIAMETRE_MIN' (MODE S MECANIQUE ELASTIQUE) ; X = MAXI A ;"
    # a parallelepiped leaning by (0, 1, 0.5) over a face of 2 by 3: its height is 0.5
    assert found(script, "X") == pytest.approx(want)


def test_size_is_given_cell_by_cell():
    x, y, name = found(
        "OPTI DIME 2 ELEM QUA4 ; S = ((DROI 1 (0. 0.) (2. 0.)) TRAN 1 (0. 0.3)) ET "
        "((DROI 1 (5. 0.) (7. 0.)) TRAN 1 (0. 0.7)) ; "
        "A = TAIL 'DIAMETRE_MIN' (MODE S MECANIQUE ELASTIQUE) ; X = MINI A ; Y = MAXI A ; "
        "N = EXTR (EXTR A 'COMP') 1 ;",
        "X", "Y", "N",
    )  # fmt: skip
    assert (x, y) == pytest.approx((0.3, 0.7))
    assert str(name).strip() == "L"


def test_shells_and_beams_have_the_length_of_bending_waves():
    x, y, z = found(
        "OPTI DIME 3 ELEM QUA4 ; S = ((0. 0. 0.) DROI 1 (2. 0. 0.)) TRAN 1 (0. 0.5 0.) ; "
        "M = MODE S MECANIQUE ELASTIQUE COQ4 ; A = CARA M 'EPAI' 0.1 ; "
        "X = MAXI (EXCO 'L2H' (TAIL 'DIAMETRE_MIN' M A)) ; OPTI ELEM SEG2 ; "
        "L = DROI 2 (0. 0. 0.) (2. 0. 0.) ; N = MODE L MECANIQUE ELASTIQUE POUT ; "
        f"B = CARA N 'SECT' 0.06 'INRY' {0.2 * 0.3**3 / 12!r} 'INRZ' {0.3 * 0.2**3 / 12!r} "
        "'TORS' 1. ; C = TAIL 'DIAMETRE_MIN' N B ; "
        "Y = MAXI (EXCO 'L2H' C) ; Z = MINI (EXCO 'L' C) ;",
        "X", "Y", "Z",
    )  # fmt: skip
    assert x == pytest.approx(0.25 / 0.1)
    assert y == pytest.approx(1.0 / 0.3)
    assert z == pytest.approx(1.0)
