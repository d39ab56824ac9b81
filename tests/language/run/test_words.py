"""Section 3: what a word stands for."""

from ssilang.language.values import Mot


def test_a_number_is_a_number_a_quoted_text_a_word(run):
    script = run("x = 1 ; y = 1. ; z = 'One' ;")
    assert [script.kind(n) for n in "xyz"] == ["ENTIER", "FLOTTANT", "MOT"]


def test_a_name_stands_for_its_object(run):
    assert run("a = 3 ; b = a ;")["b"] == 3


def test_an_unknown_name_is_a_word(run):
    value = run("b = ABRACADABRA ;")["b"]
    assert isinstance(value, Mot)
    assert value == "ABRACADABRA"


def test_keywords_need_no_quotes_in_either_case(run):
    assert len(run("x = prog 1. pas 1. 4. ;")["x"]) == 4


def test_a_variable_hides_the_operator_of_its_name(fails):
    assert fails("DIME = 1 ; x = «DIME» (PROG 1. 2.) ;") == "hidden-operator"


def test_the_quoted_operator_comes_back_behind_a_hiding_variable(run):
    assert run("DIME = 1 ; x = 'DIME' (PROG 1. 2.) ;")["x"] == 2


def test_a_quoted_operator_in_small_letters_is_not_one(run):
    assert run("x = 'dime' ;")["x"] == "dime"


def test_operators_are_known_by_four_letters(run):
    assert run("x = DIMENSION (PROG 1. 2. 3.) ;")["x"] == 3


def test_the_content_of_a_word_counts_not_its_spelling(run):
    assert run("t = MOT 'DIME' ; x = t (PROG 1. 2.) ;")["x"] == 2


def test_predefined_objects(run):
    script = run("a = VRAI ; b = FAUX ; c1 = PI ;")
    assert script["a"] is True
    assert script["b"] is False
    assert abs(script["c1"] - 3.141592653589793) < 1e-15


def test_predefined_objects_can_be_overwritten(run):
    assert run("PI = 3 ; x = PI ;")["x"] == 3


def test_values_are_bound_when_the_statement_runs(run):
    assert run("x = 0 ; REPE b 3 ; x = x + &b ; FIN b ;")["x"] == 6
