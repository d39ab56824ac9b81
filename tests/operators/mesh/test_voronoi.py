"""VORO, and points as indices of tables."""


def test_an_index_that_is_missing_is_told_by_its_type(refused):
    told = refused("OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; T = TABL ; T . P = 3 ; X = T . «Q» ;")
    assert "the table has no index POINT" in told
    assert "object at" not in told
