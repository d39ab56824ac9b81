"""VORO, and points as indices of tables."""

import pytest

DOMAIN = (
    "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; "
    "L = A D 3 (2. 0.) D 2 (2. 1.) D 3 (0. 1.) D 2 A ; "
    "P = 0.5 0.5 ; Q = 1.5 0.5 ; R = 1. 0.1 ; G = P ET Q ET R ; "
)


def test_cells_fill_the_domain_and_share_their_edges(found):
    whole, shared, beside, edges = found(
        DOMAIN + "T = VORO G L ; C = T . 'CELL' ; OPTI ELEM TRI3 ; "
        "D = (SURF (C . P . 'VISU')) ET (SURF (C . Q . 'VISU')) ET (SURF (C . R . 'VISU')) ; "
        "X1 = MESU D ; "
        "X2 = NBEL ((C . P . 'VISU') INTE (C . R . 'VISU')) ; "
        "X3 = NBEL (C . R . 'VOIS') ; X4 = NBEL (T . 'VISU') ;",
        "X1", "X2", "X3", "X4",
    )  # fmt: skip
    assert whole == pytest.approx(2.0, rel=1e-10)
    assert shared == 1
    assert beside == 2
    assert edges == 16  # 13 pieces of the contour, three edges that meet in a point


def test_a_point_is_the_same_index_however_it_was_got(found):
    script = (
        "OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ; L = DROI 1 P Q ; "
        "T = TABL ; T . P = 3 ; T . Q = 4 ; X = T . (L POIN 'INIT') ; Y = T . (L POIN 'FINA') ;"
    )
    assert found(script, "X", "Y") == (3, 4)


def test_an_index_that_is_missing_is_told_by_its_type(refused):
    told = refused("OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; T = TABL ; T . P = 3 ; X = T . «Q» ;")
    assert "the table has no index POINT" in told
    assert "object at" not in told
