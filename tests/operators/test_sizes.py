"""TAIL 'DIAMETRE_MIN' on cells of known heights."""

import pytest
from script_runs import found


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
