"""Section 8: tables."""

import pytest


def test_a_table_may_carry_a_subtype(run):
    script = run("t = TABL 'MODAL' ; x = t . 'SOUSTYPE' ;")
    assert script["x"] == "MODAL"


@pytest.mark.parametrize("index", ["1", "1.5", "'word'", "VRAI", "(PROG 1.)"])
def test_any_object_is_an_index(run, index):
    assert run(f"t = TABL ; i = {index} ; t . i = 8 ; x = t . i ;")["x"] == 8


def test_integer_and_real_indices_differ(run):
    script = run("t = TABL ; t . 1 = 'i' ; t . 1.0 = 'r' ; x = t . 1 ; y = t . 1.0 ;")
    assert (script["x"], script["y"]) == ("i", "r")


def test_objects_are_indices_by_identity(fails):
    assert fails("t = TABL ; t . (PROG 1.) = 8 ; x = t . «(PROG 1.)» ;") == "no-index"


def test_trailing_blanks_of_an_index_do_not_count(run):
    assert run("t = TABL ; t . 'AB' = 1 ; x = t . 'AB  ' ;")["x"] == 1


def test_quoted_indices_keep_their_case(fails):
    assert fails("t = TABL ; t . 'ab' = 1 ; x = t . «AB» ;") == "no-index"


def test_an_unquoted_index_is_the_value_of_its_name(run):
    assert run("t = TABL ; n = 3 ; t . n = 'three' ; x = t . 3 ;")["x"] == "three"


def test_an_unquoted_index_without_value_is_a_word(run):
    assert run("t = TABL ; t . ALPHA = 2 ; x = t . 'ALPHA' ;")["x"] == 2


def test_loop_counters_are_indices(run):
    assert run("t = TABL ; REPE b 3 ; t . &b = &b * &b ; FIN b ; x = t . 3 ;")["x"] == 9


def test_inner_tables_must_exist(fails):
    assert fails("t = TABL ; t . «'A'» . 1 = 3 ;") == "no-inner-table"


def test_an_index_that_is_missing_is_an_error(fails):
    assert fails("t = TABL ; x = t . «'NO'» ;") == "no-index"


def test_access_binds_tighter_than_operators(run):
    assert run("t = TABL ; t . 'L' = PROG 1. 2. 3. ; n = DIME t . 'L' ;")["n"] == 3


def test_a_procedure_in_a_table_is_called(run):
    text = "DEBP TWICE a*ENTIER ; b = 2 * a ; FINP b ; t = TABL ; t . 'P' = MOT TWICE ;"
    assert run(text + "x = t . 'P' 4 ;")["x"] == 8


def test_tables_are_shared_with_procedures(run):
    text = "DEBP FILL t*TABLE ; t . 'X' = 5 ; FINP ; u = TABL ; FILL u ; x = u . 'X' ;"
    assert run(text)["x"] == 5


def test_exis_oubl_and_dime_on_indices(run):
    script = run(
        "t = TABL ; t . 1 = 1 ; t . 'A' = 2 ; a = EXIS t 1 ; n = DIME t ;"
        "OUBL t 1 ; b = EXIS t 1 ; m = DIME t ;"
    )
    assert (script["a"], script["n"], script["b"], script["m"]) == (True, 2, False, 1)


def test_inde_gives_the_table_of_indices(run):
    script = run("t = TABL ; t . 'A' = 1 ; t . 'B' = 2 ; i = INDE t ; n = DIME i ; x = i . 2 ;")
    assert script["n"] == 2
    assert script["x"] == "B"


def test_what_is_no_table_has_no_index(fails):
    assert fails("t = 3 ; x = «t» . 1 ;") == "not-a-table"
