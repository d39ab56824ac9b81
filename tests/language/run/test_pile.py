"""Section 5: the pile of operands and the first unread word; which forms are tried."""

import pytest
from together import together

from ssilang.cli.run import run_text
from ssilang.language.run.call import Call


@pytest.mark.parametrize(
    ("phrase", "value"),
    [
        ("1 + 2 * 3", 9), ("3 + 5 * 8", 64), ("2 ** 2 + 1", 5), ("2 + 1 ** 2", 9),
        ("1 + (2 * 3)", 7), ("10 - 2 - 3", 5), ("2 * 3 - 1 / 5", 1), ("-1 * 4 + 2", -2),
    ],
)  # fmt: skip
def test_phrases_run_from_left_to_right_without_precedence(run, phrase, value):
    assert run(f"x = {phrase} ;")["x"] == value


@pytest.mark.parametrize("phrase", ["EXTR l1 2 «-» 1.", "EXTR l1 2 «*» 3."])
def test_extr_ends_the_phrase(fails, phrase):
    assert fails(f"l1 = PROG 4. 5. 6. ; x = {phrase} ;") == "unread-operator"


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


@together("inside", ["l m", "DIME l «3»", "3 + 1 «-1»", "DIME l «word»", "DIME l «k»"])
def test_a_scalar_or_a_word_too_many_in_a_parenthesis_is_refused(fails, inside):
    assert fails(f"k = 3 ; l = PROG 1. ; m = PROG 2. ; x = ({inside}) ;") in (
        "excess",
        "unknown-operator",
        "glued-sign",
    )


@pytest.mark.parametrize(
    ("number", "script"),
    [("a0", "a0 = 2. ; p = a0. 0. ;"), ("(a0 - 1)", "a0 = 3. ; q = 0. ; p = (a0 - 1) . q ;")],
)
def test_a_dot_behind_a_number_separates_nothing(run, number, script):
    made = run(f"OPTI DIME 2 ; {script} x y = COOR p ;")
    assert (made["x"], made["y"]) == (2.0, 0.0)
    (warning,) = made.result.session.warnings
    assert (warning.code, warning.span.text) == ("dot-of-number", number)


@pytest.mark.parametrize(
    ("phrase", "value"),
    [
        ("n = 3 ; x = n. EGA 3", True),
        ("n = 3 ; x = n. ega 4", False),
        ("n = 3. ; x = n . NEG 3.", False),
    ],
)
def test_an_operator_behind_the_dot_of_a_number_is_one(run, phrase, value):
    from ssilang.cli.check import check_source
    from ssilang.language.text.source import Source

    made = run(f"{phrase} ;")
    assert made["x"] == value
    assert [w.code for w in made.result.session.warnings] == ["dot-of-number"]
    assert [p.code for p in check_source(Source("test", f"{phrase} ; MESS x ;"))[0]] == [
        "dot-of-number"
    ]


def test_a_counter_with_a_dot_is_compared(run):
    made = run("n = 0 ; REPE b 3 ; SI (&b. EGA 2) ; n = n + 10 ; SINO ; n = n + 1 ; FINS ; FIN b ;")
    assert made["n"] == 12


def test_a_dot_between_two_operands_of_an_operator_is_none_of_a_table(run):
    made = run("n = 3 ; l = PROG 4. 5. 6. ; t = TABL ; t . 1 = l ; x = EXTR n . t . 1 ;")
    assert made["x"] == 6.0


@together(
    "phrase", ["x = «a» . 'B'", "x = «a» . B", "x = «a» . 1", "x = SIN «a» . 1", "x = «a» . l"]
)
def test_an_index_of_a_number_that_nothing_reads_is_refused_as_one(fails, phrase):
    assert fails(f"a = 3 ; l = PROG 1. ; {phrase} ;") == "not-a-table"


@pytest.mark.parametrize("script", ["OPTI DIME 2 ; a = 2. ; p = a. 0. ; MESS (TYPE p) ;"])
def test_a_dot_behind_a_number_is_checked_as_it_runs(script):
    from ssilang.cli.check import check_source
    from ssilang.language.text.source import Source

    assert [p.code for p in check_source(Source("test", script))[0]] == ["dot-of-number"]


FIELD = "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 2 'UX' 3. 'UY' 4. ;\n"


@together(
    "phrase",
    ["X = BRUI 'BLAN' 'UNIF' 0. 1. 3", "X = EXCO C 'UX'", "X = EXCO C (MOTS 'UX')", "X = MAXI C"],
)
def test_no_error_is_made_where_a_later_form_fits(monkeypatch, phrase):
    made = []
    for name in ("missing", "error"):
        was = getattr(Call, name)
        monkeypatch.setattr(
            Call, name, lambda self, *a, was=was, **k: made.append(a) or was(self, *a, **k)
        )
    assert run_text(f"{FIELD}{phrase} ;").exit_code == 0
    assert not made


def test_one_place_reads_other_types_and_words_at_each_turn():
    script = (
        f"{FIELD}T = TABL ; T . 1 = MOT 'UX' ; T . 2 = MOTS 'UY' ; T . 3 = MOT 'UY' ; S = 0. ;\n"
        "REPE B 3 ; S = S + (MAXI (EXCO C (T . &B))) ; FIN B ;"
    )
    assert run_text(script).session.root.find("S") == 3.0 + 4.0 + 4.0


def test_the_error_is_the_same_the_second_time():
    first, second = (run_text("X = EXCO 3. 4. ;").message for _ in range(2))
    assert first == second
    assert "EXCO" in first
