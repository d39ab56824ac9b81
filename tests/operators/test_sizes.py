"""TAIL 'DIAMETRE_MIN' on cells of known heights."""

import math

import pytest
from script_runs import found

from ssilang.cli.run import run_text


@pytest.mark.parametrize(
    ("mesh", "want"),
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


def test_other_elements_and_directions_are_refused():
    line = "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0. 0.) (2. 0.) ; "
    line += "M = MODE L MECANIQUE ELASTIQUE BARR ; "
    result = run_text(line + "A = TAIL 'DIAMETRE_MIN' M ;")
    assert result.exit_code == 1
    assert "not solid" in result.message
    result = run_text(line + "A = TAIL 'DIRECTION' M ;")
    assert result.exit_code == 1
    assert "only 'DIAMETRE_MIN'" in result.message
