"""CHAR and TIRE: loadings at a time, their parts."""

import pytest

LOAD = (
    "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; F = MANU 'CHPO' P 'FY' -10. 'NATURE' 'DISCRET' ; "
    "G = MANU 'CHPO' Q 'FY' 4. 'NATURE' 'DISCRET' ; "
    "E = EVOL 'MANU' (PROG 0. 2.) (PROG 0. 1.) ; "
)


@pytest.mark.parametrize(
    ("time", "expected"), [(0.0, 0.0), (0.5, -2.5), (2.0, -10.0), (9.0, -10.0)]
)
def test_loading_is_its_field_times_its_curve(time, expected, found):
    script = LOAD + f"C = CHAR 'MECA' F E ; X = EXTR (TIRE C {time}) 'FY' P ;"
    assert found(script, "X") == pytest.approx(expected)


def test_joined_loadings_add_up_or_are_taken_by_name(found):
    script = LOAD + "C = (CHAR 'MECA' F E) ET (CHAR 'SEIS' G E) ; "
    values = found(
        script + "A = RESU (TIRE C 1.) ; X1 = EXTR A 'VALE' 'FY' ; "
        "X2 = MAXI (TIRE C 1. 'SEIS') ; T = TIRE C 1. 'TABL' ; X3 = MINI (T . 'MECA') ; "
        "N = DIME C ; L = EXIS C 'SEIS' ; M = EXIS C 'PRES' ; K = DIME (ENLE C 'MECA') ;",
        "X1", "X2", "X3", "N", "L", "M", "K",
    )  # fmt: skip
    assert values[0].values.tolist() == [-3.0]
    assert values[1:] == (2.0, -5.0, 2, True, False, 1)


def test_fields_at_listed_times_are_interpolated(found):
    script = LOAD + (
        "TT = TABL ; TF = TABL ; TT . 0 = 0. ; TT . 1 = 1. ; TT . 2 = 3. ; "
        "TF . 0 = F ; TF . 1 = F * 2. ; TF . 2 = F * 6. ; C = CHAR 'MECA' TT TF ; "
        "A = EXTR (TIRE C 0.5) 'FY' P ; B = EXTR (TIRE C 2.) 'FY' P ; D = EXTR (TIRE C 5.) 'FY' P ;"
    )
    assert found(script, "A", "B", "D") == pytest.approx((-15.0, -40.0, -60.0))


def test_loading_becomes_tables_with_the_same_values(found):
    script = LOAD + (
        "C = (CHAR 'MECA' F E) ET (CHAR 'MECA' G E) ; D = CHAN 'TABL' C 'MECA' ; N = DIME D ; "
        "A = EXTR (TIRE C 1.3) 'FY' Q ; B = EXTR (TIRE D 1.3) 'FY' Q ; "
        "TT TF = EXTR C 'MECA' 'TABL' ; M = DIME TT ;"
    )
    n, a, b, m = found(script, "N", "A", "B", "M")
    assert (n, m) == (1, 2)
    assert a == pytest.approx(b)


def test_parts_of_a_loading(found):
    script = LOAD + (
        "C = (CHAR 'MECA' F E) ET (CHAR 'SEIS' G) ; L = EXTR C 'COMP' ; "
        "A = MINI (EXTR C 'CHAM') ; B = IPOL 1. (EXTR C 'EVOL' 1) ; D = DIME (EXTR C 'CHAR' 2) ;"
    )
    names, a, b, d = found(script, "L", "A", "B", "D")
    assert [str(w) for w in names.values] == ["MECA", "SEIS"]
    assert (a, b, d) == (-10.0, 0.5, 1)
