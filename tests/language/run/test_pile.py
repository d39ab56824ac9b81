"""Section 5: the pile of operands and the first unread word."""

import pytest


@pytest.mark.parametrize(
    ("phrase", "value"),
    [
        ("1 + 2 * 3", 9), ("3 + 5 * 8", 64), ("2 ** 2 + 1", 5), ("2 + 1 ** 2", 9),
        ("1 + (2 * 3)", 7), ("10 - 2 - 3", 5), ("2 * 3 - 1 / 5", 1), ("-1 * 4 + 2", -2),
    ],
)  # fmt: skip
def test_phrases_run_from_left_to_right_without_precedence(run, phrase, value):
    assert run(f"x = {phrase} ;")["x"] == value


def test_names_give_the_same_as_numbers(run):
    assert run("a = 1 ; b = 2 ; c1 = 3 ; x = a + b * c1 ;")["x"] == 9


def test_comparison_comes_last_when_written_last(run):
    assert run("a = 3 ; b = 4 ; x = a + b > 6 ;")["x"] is True


def test_comparison_in_the_middle_is_a_type_error(fails):
    assert fails("a = 3 ; x = a «> 2 + 1» ;") == "no-rule"


def test_prefix_infix_and_postfix_are_one_thing(run):
    script = run("x = + 1 2 ; y = 1 + 2 ; z = 1 2 + ;")
    assert script["x"] == script["y"] == script["z"] == 3


def test_operators_of_meshing_take_their_points_from_both_sides(run):
    script = run(
        "OPTI DIME 2 ELEM SEG2 ; p = 0. 0. ; q = 1. 0. ;"
        "n1 = NBEL (DROI 10 p q) ; n2 = NBEL (p DROI 10 q) ; n3 = NBEL (p q 10 DROI) ;"
    )
    assert script["n1"] == script["n2"] == script["n3"] == 10


def test_only_the_first_unread_word_is_looked_at(fails):
    assert fails("m = MOT 'abc' ; x = m «EGA» 'abc' ;") == "unread-operator"


def test_comparison_of_words_is_written_in_front(run):
    assert run("m = MOT 'abc' ; x = EGA m 'abc' ;")["x"] is True


def test_arguments_are_found_by_type_in_any_order(run):
    script = run("x = EXTR (PROG 4. 5. 6.) 2 ; y = EXTR 2 (PROG 4. 5. 6.) ;")
    assert script["x"] == script["y"] == 5.0


@pytest.mark.parametrize("phrase", ["EXTR l1 2 «-» 1.", "EXTR l1 2 «*» 3."])
def test_extr_ends_the_phrase(fails, phrase):
    assert fails(f"l1 = PROG 4. 5. 6. ; x = {phrase} ;") == "unread-operator"


def test_a_parenthesised_extr_can_go_on(run):
    assert run("l1 = PROG 4. 5. 6. ; x = (EXTR l1 2) - 1. ;")["x"] == 4.0


def test_mot_ends_the_phrase_so_its_result_is_not_an_operator(run):
    assert run("x = MOT 'DIME' ;")["x"] == "DIME"


def test_results_come_in_front_of_what_is_left(run):
    assert len(run("x = 3. PROG ;")["x"]) == 1


def test_prog_collects_the_results_of_a_procedure(run):
    text = "DEBP SQUARES n*ENTIER ; REPE b n ; RESP (&b * &b * 1.) ; FIN b ; FINP ;"
    assert list(run(text + "l1 = SQUARES 4 PROG ;")["l1"].values) == [1.0, 4.0, 9.0, 16.0]


def test_a_star_in_prog_repeats(run):
    assert list(run("n = 3 ; x = PROG n * 2.5 1. ;")["x"].values) == [2.5, 2.5, 2.5, 1.0]


def test_the_star_of_a_repetition_may_be_quoted(run):
    assert list(run("n = 2 ; x = 'PROG' n '*' 1.5 ;")["x"].values) == [1.5, 1.5]


def test_a_real_argument_takes_an_integer(run):
    assert run("x = SIN 90 ;")["x"] == pytest.approx(1.0)


def test_a_misspelt_operator_is_named_with_the_nearest(tmp_path):
    from ssilang.cli.run import run_text

    result = run_text("x = PORG 1. 2. ;", output_directory=tmp_path)
    assert result.errors[0].code == "unknown-operator"
    assert "PROG" in result.message


def test_an_object_that_a_parenthesis_leaves_unread_is_warned_of_once(run):
    text = "l = PROG 1. ; m = PROG 2. ; n = PROG 3. ; REPE b 2 ; x = (l ET m n) ; FIN b ;"
    script = run(text)
    assert list(script["x"].values) == [1.0, 2.0]
    (warning,) = script.result.session.warnings
    assert (warning.code, warning.span.text) == ("unread-object", "n")


@pytest.mark.parametrize(
    "inside", ["l m", "DIME l «3»", "3 + 1 «-1»", "DIME l «word»", "DIME l «k»"]
)
def test_a_scalar_or_a_word_too_many_in_a_parenthesis_is_refused(fails, inside):
    assert fails(f"k = 3 ; l = PROG 1. ; m = PROG 2. ; x = ({inside}) ;") in (
        "excess",
        "unknown-operator",
        "glued-sign",
    )
