"""Section 9: SI, REPE, QUIT, ITER, FIN."""

import pytest
from together import together

from ssilang.cli.run import run_text


@pytest.mark.parametrize(("test", "value"), [("1 < 2", 1), ("1 > 2", 2)])
def test_si_runs_one_branch(run, test, value):
    assert run(f"SI ({test}) ; x = 1 ; SINON ; x = 2 ; FINSI ;")["x"] == value


@pytest.mark.parametrize("behind", ["QUITTER b", "ITER b", "MESS x", "'ERRE' 5"])
def test_a_directive_behind_the_condition_is_not_run(run, behind):
    text = f"x = 0 ; REPE b 3 ; SI (x < 2) {behind} ; x = x + 1 ; SINO ; x = x + 10 ; FINSI ;"
    text += "FIN b ;"
    assert run(text)["x"] == 12


def test_a_directive_behind_the_condition_is_warned_of_once(run):
    text = "x = 0 ; REPE b 3 ; SI (x < 2) QUITTER b ; x = x + 1 ; FINSI ; FIN b ;"
    assert [w.code for w in run(text).result.session.warnings] == ["behind-condition"]


@pytest.mark.parametrize("directive", ["LIST", "MENA", "RESP"])
def test_a_directive_alone_behind_the_condition_is_warned_of(run, directive):
    script = run(f"x = 0 ; SI (x < 2) {directive} ; x = 1 ; FINSI ;")
    assert [w.code for w in script.result.session.warnings] == ["behind-condition"]
    assert (script["x"], script.lines) == (1, [])


@pytest.mark.parametrize(
    ("condition", "code"),
    [
        ("«VRAIE»", "unknown-operator"),
        ("«RSEO» 3", "unknown-operator"),
        ("1.5", "condition"),
    ],
)
def test_a_word_that_is_no_condition_is_told_apart_from_a_value(fails, condition, code):
    assert fails(f"SI {condition} ; FINSI ;") == code


@pytest.mark.parametrize(
    "text",
    [
        "SA = STRU 1. 2. ; x = 3 ;",
        "SA = 2 * (STRU 1.) ; x = 3 ;",
        "SA SB = STRU 1. ; x = 3 ;",
        "SA = STRU 1. ; SA = 4 ; x = SA - 1 ;",
        "SA = 1 ; REPE b 3 ; SA = STRU 1. ; FIN b ; x = 3 ;",
        "DEBP P A*ENTIER ; SA = FLUX A ; B = A + 1 ; FINP B ; x = P 2 ;",
        "SA = STRU 1. ; DEBP P ; SA = 3 ; FINP SA ; x = P ;",
    ],
)
def test_what_is_not_built_stops_nothing_that_does_not_read_it(run, text):
    script = run(text)
    (warning,) = script.result.session.warnings
    assert (warning.code, warning.span.text in ("STRU", "FLUX")) == ("not-built-yet", True)
    assert script["x"] == 3


@together(
    "text, line",
    [
        ("SA = STRU 1. ;\n x = 3 ;\n MESS SA ;", 3),
        ("SA = STRU 1. ;\n x = SA + 1 ;", 2),
        ("SA = 5 ;\n SA = STRU 1. ;\n x = 2 * (SA + 1) ;", 3),
        ("SA = STRU 1. ;\n T = TABL ;\n x = T . SA ;", 3),
        ("SA = STRU 1. ;\n SI SA ; x = 1 ; FINSI ;", 2),
        ("SA = STRU 1. ;\n REPE b SA ; FIN b ;", 2),
        ("SA = STRU 1. ;\n DEBP P A*ENTIER ; FINP A ;\n x = P SA ;", 3),
        ("DEBP P ; SA = STRU 1. ;\n FINP SA ;\n x = P ;", 2),
    ],
)
def test_what_is_not_built_is_refused_at_its_own_place_where_it_is_read(text, line):
    done = run_text(text)
    (error,) = done.errors
    assert (done.exit_code, error.code, error.span.text) == (1, "unknown-operator", "STRU")
    assert f"SA, which it should give, is read at line {line}" in done.message


@together(
    "text",
    ["STRU 1. ;", "SA = STRV 1. ;", "T = TABL ; T . 1 = STRU 1. ;", "STRUC = 1 ; X = STRUD 1 ;"],
)
def test_what_does_something_or_is_misspelt_is_refused_at_once(fails, text):
    assert fails(text) == "unknown-operator"


def test_names_that_hold_nothing_are_neither_saved_nor_listed(run):
    script = run(
        "SB = 2 ; SA = STRU 1. ; OPTI SAUV 'a.sauv' ; SAUV ; OUBL SB ; LIST ;"
        "OPTI REST 'a.sauv' ; REST ; x = SB ;"
    )
    assert not any("SA " in line for line in script.lines)
    assert script["x"] == 2


@pytest.mark.parametrize("words", ["'SI' VRAI ; x = 1 ; 'FINSI'", "si VRAI ; x = 1 ; finsi",
                                   "SI VRAI ; x = 1 ; FINS"])  # fmt: skip
def test_control_words_quoted_small_or_short(run, words):
    assert run(f"{words} ;")["x"] == 1


def test_repe_counts_from_one(run):
    script = run("l1 = PROG ; REPE b 3 ; l1 = l1 ET (FLOT &b) ; FIN b ; n = &b ;")
    assert list(script["l1"].values) == [1.0, 2.0, 3.0]
    assert script["n"] == 4


@together(
    "text, x, missing",
    [
        ("REPE B 6 ; x = x + 1 ; FIN ; x = 10 ; FIN ;", 1, ["FIN B"]),
        ("SI VRAI ; x = 5 ; FIN ; x = 6 ;", 5, ["FINSI"]),
        ("SI FAUX ; x = 5 ; SINON ; x = 7 ; FIN ;", 7, ["FINSI"]),
        ("REPE B 3 ; x = x + 1 ; SI (x > 0) ; x = 9 ; FIN ;", 9, ["FINSI", "FIN B"]),
    ],
)
def test_fin_in_a_block_that_is_never_closed_ends_the_run(text, x, missing):
    done = run_text(f"x = 0 ; {text}")
    assert (done.exit_code, done.session.root.find("X")) == (0, x)
    assert [w.code for w in done.session.warnings] == ["unclosed-block"] * len(missing)
    assert [w.data["missing"] for w in done.session.warnings] == missing


@together(
    "text",
    ["SI FAUX ; x = 5 ; FIN ;", "REPE B 2 ; SI FAUX ; FIN ; FINSI ;", "DEBP P ; x = 1 ; FIN ;",
     "SI FAUX ; x = 5 ; FIN ; SINON ; x = 7 ;"],
)  # fmt: skip
def test_a_block_that_is_never_closed_is_refused_where_no_fin_is_met(fails, text):
    assert fails(text) == "unclosed-block"
