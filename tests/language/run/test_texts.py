"""Section 11: words, texts and what is printed."""

import pytest


def test_mess_prints_words_and_numbers_without_blanks(run):
    assert run("n = 3 ; MESS 'n=' n ' ok' ;").lines == ["n=3 ok"]


def test_mess_with_nothing_prints_an_empty_line(run):
    assert run("MESS ;").lines == [""]


def test_chai_joins_without_blanks(run):
    assert run("x = CHAI 'a' 1 'b' ;")["x"] == "a1b"


def test_chai_writes_reals_in_twelve_columns(run):
    assert run("x = CHAI 'v' 25.86 ;")["x"] == "v 2.58600E+01"


def test_chai_takes_a_format(run):
    assert run("x = CHAI 'FORMAT' '(F6.2)' 'v=' 25.86 ;")["x"] == "v= 25.86"


@pytest.mark.parametrize(
    ("phrase", "length"),
    [("'TOTO'*10", 10), ("'TOTO'/10", 13), ("'TITI' 'TOTO'<10", 14), ("'TITI' 'TOTO'>10", 17)],
)
def test_tab_marks_of_chai(run, phrase, length):
    assert len(run(f"x = CHAI {phrase} ;")["x"]) == length


def test_a_text_is_put_where_its_name_stands(run):
    assert run("t = TEXT '1 + 2' ; x = t * 4 ;")["x"] == 12


def test_a_text_may_hold_an_operator(run):
    assert run("t = TEXT 'DIME' ; x = t (PROG 1. 2.) ;")["x"] == 2


def test_an_empty_text_vanishes(run):
    assert run("t = TEXT ' ' ; x = PROG 1. t 2. ; n = DIME x ;")["n"] == 2


def test_erre_with_a_text_fails(fails):
    assert fails("«ERRE» 'out of range' ;") == "erre"


def test_erre_5_fails_and_erre_0_does_not(run, fails):
    assert fails("«ERRE» 5 ;") == "erre"
    run("ERRE 0 ;")


def test_nomm_gives_a_computed_name(run):
    assert run("NOMM (CHAI 'AB' 3) 7 ; x = AB3 ;")["x"] == 7


def test_type_exis_and_oubl(run):
    script = run(
        "a = 3 ; k = TYPE a ; e = EXIS a ; OUBL a ; f = TYPE a ; g = EXIS a ; h = EXIS b ;"
    )
    assert script["k"].rstrip() == "ENTIER"
    assert script["f"].rstrip() == "ANNULE"
    assert (script["e"], script["g"], script["h"]) == (True, False, True)


def test_a_forgotten_name_can_be_given_again_and_hides_no_operator(run, fails):
    assert run("MAXI = 3 ; OUBL MAXI ; x = MAXI (PROG 1. 2.) ; OUBL x ; x = 5 ;")["x"] == 5
    assert fails("a = 3 ; OUBL a ; b = «a + 1» ;") == "no-rule"


def test_a_text_spells_the_values_of_words_and_numbers(run):
    script = run(
        "I = 2 ; W = MOT '+ 3' ; T = TABL ; T . 1 = MOT '* 4' ; "
        "X = TEXT I W T . 1 ; I = 9 ; Y = X ;"
    )
    assert script["Y"] == 20
