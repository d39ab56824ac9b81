"""Forms of operators: powers of matrices, curves past a field's support, models dealt out."""

import numpy as np
import pytest
from script_runs import ran

from ssilang.language.say.diagnostics import sentence


def test_curve_is_zero_where_the_field_is_not_and_says_so():
    result = ran(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0 0) (1 0) ; X = COOR 1 (L ELEM 2) ; "
        "E = EVOL 'CHPO' (X + 1.) 'SCAL' L ;"
    )
    part = result.session.root.find("E").parts[0]
    np.testing.assert_allclose(part.ordinates, [0, 1.25, 1.5, 0, 0])
    said = [sentence(w, "en")[0] for w in result.session.warnings]
    assert any("no value of SCAL at 3 of the 5" in s for s in said)


@pytest.mark.parametrize("how", ["'ARLE' M 2", "2 M"])
def test_model_is_dealt_out_zone_by_zone(found, how):
    script = (
        "OPTI DIME 2 ELEM QUA4 ; L = DROI 5 (0 0) (1 0) ; S = TRAN 1 L (0. 1.) ; "
        "M = (MODE S MECANIQUE ELASTIQUE) ET (MODE (CONT S) MECANIQUE ELASTIQUE BARR) ; "
        f"T = PART 'NESC' {how} ; A = T . 1 ; B = T . 2 ; "
    )
    a, b = found(script, "A", "B")
    assert [len(z.cells) for z in a.zones] == [3, 6]
    assert [len(z.cells) for z in b.zones] == [2, 6]
    assert [z.element for z in a.zones] == ["QUA4", "BARR"]


def test_curves_in_cells_through_fields(found, refused):
    start = (
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0. 0.) (1. 0.) ; "
        "M = MODE L MECANIQUE ELASTIQUE BARR ; "
        "A = MANU 'CHML' M 'REPA' 'YOUN' (PROG 3. 4.) 'GRAVITE' ; "
    )
    first, second, name = found(
        start + "C = MANU 'CHML' 'EVOL' 'T' 20. A 100. (0.5 * A) ; "
        "X1 = IPOL 60. (EXTR C 'YOUN' 1 1 1) ; T = TABL ; T . 1. = A ; T . 2. = 3. * A ; "
        "X2 = IPOL 1.5 (EXTR (MANU T 'CHML' 'EVOL' 'T') 'YOUN' 1 2 1) ; "
        "N = EXTR (EXTR C 'DEVA') 1 ;",
        "X1", "X2", "N",
    )  # fmt: skip
    assert (first, second) == pytest.approx((2.25, 8.0))
    assert str(name).rstrip() == "T"
    assert "increase" in refused(start + "C = «MANU» 'CHML' 'EVOL' 'T' 20. A 10. A ;")
    said = refused(start + "C = «MANU» 'CHML' 'EVOL' 'T' 20. A 30. (NOMC 'NU' A) ;")
    assert "one component" in said


# --- lists and loadings by lists ----------------------------------------------------------------


# --- what there is ------------------------------------------------------------------------------


def test_whether_an_object_is_of_a_type_and_a_file_there(found, tmp_path):
    (tmp_path / "here.txt").write_text("1\n")
    script = (
        "X = 2. ; A = EXIS X * FLOTTANT ; B = EXIS X*'ENTIER' ; C = EXIS UNKNOWN * MOT ;"
        "OPTI SORT 'there.csv' ; SORT 'EXCE' (EVOL 'MANU' (PROG 1.) (PROG 2.)) ;"
        "D = EXIS 'there.csv' * 'FICHIER' ; E = EXIS 'gone.csv' * FICHIER ;"
    )
    assert found(script, *"ABCDE") == (True, False, True, True, False)
