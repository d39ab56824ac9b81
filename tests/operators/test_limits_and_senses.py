"""PILE SENS: limits of strains, senses of contours, differences, by hand."""

import pytest
from script_runs import found, refused


def test_strain_may_go_up_to_the_first_limit():
    """eps = x - 1/2 + X (x - 3/2) on 0 < x < 2: at x = 0 the limit -3 leaves X = 5/3."""
    script = (
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
        "E = CHAN 'CHAM' (COOR 1 S) S ; X = PILE (E - 0.5) (E - 1.5) 3. ; "
    )
    assert found(script, "X") == pytest.approx(5.0 / 3.0)
    assert "nothing limits" in refused(script + "Y = PILE E (0. * E) 1. ;")


def test_senses_of_contours():
    script = (
        "OPTI DIME 2 ELEM {} ; C = CERC 8 'ROTA' 360. (1. 0.) (0. 0.) 'ELIM' ; "
        "D = INVE (CERC 6 'ROTA' 360. (9. 0.) (8. 0.) 'ELIM') ; T = SENS (CCON (C ET D)) ; "
        "A = T . 1 ; B = T . 2 ;"
    )
    assert found(script.format("SEG2"), "A", "B") == (1, -1)
    assert found(script.format("SEG3"), "A", "B") == (1, -1)


def test_contour_may_be_open_along_the_axis():
    script = (
        "OPTI DIME 2 MODE AXIS ELEM SEG2 ; L = (0. 0.) DROI 1 (2. 0.) DROI 1 (2. 3.) DROI 1 (0. "
        "3.) ; "
        "T = TABL ; T . 1 = L ; T . 2 = INVE L ; U = SENS T ; A = U . 1 ; B = U . 2 ;"
    )
    assert found(script, "A", "B") == (1, -1)


def test_differences_are_averaged_cell_by_cell():
    script = (
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
        "E = CHAN 'CHAM' (COOR 1 S) S ; T = SENS (3. * E) E ; A = T . 1 ; B = T . 2 ; N = DIME T ;"
    )
    assert found(script, "A", "B", "N") == pytest.approx((1.0, 3.0, 2))
