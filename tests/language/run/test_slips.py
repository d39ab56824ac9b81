"""What beginners write: the right statement beside each slip is accepted."""

import pytest
from script_runs import failed
from together import together

from ssilang.cli.run import run_text

SPELLINGS = ("'MASSE'", "MASSE", "masse", "(MOT 'MASSE')", "MOT 'MASSE'", "W")


@pytest.mark.parametrize("value", SPELLINGS)
def test_an_entry_takes_its_declared_word_though_an_operator_has_that_name(value, run):
    script = run(f"W = MOT 'MASSE' ; T = TABL ; T . 'VITEUNIL' = {value} ;")
    assert script.at("T", "VITEUNIL").upper() == "MASSE"
    free = run(f"W = MOT 'MASSE' ; T = TABL ; T . 'MOVA' = {value} ;")  # any variable's name
    assert free.at("T", "MOVA").upper() == "MASSE"


@pytest.mark.parametrize("value", ["'MASSE'", "MASSE"])
def test_an_entry_that_declares_no_such_word_runs_the_operator(value, fails):
    assert fails(f"T = TABL ; T . 'AUTRE' = {value} ;") == "missing-argument"


def test_an_operator_that_needs_nothing_runs(run):
    assert run("T = TABL ; T . 'VITEUNIL' = 'TABL' ;").kind("T") == "TABLE"


def test_a_label_of_several_words_is_no_operator(run):
    script = run("L = 'MODE 1 frequency' ; T = MOTS L 'TABL of all' ; MESS L ;")
    assert script.lines == ["MODE 1 frequency"]
    assert [str(w) for w in script["T"].values] == ["MODE 1 frequency", "TABL of all"]


def test_a_label_of_a_check_may_begin_as_an_operator_does(run):
    script = run("T = TABL ; @VERIFIE T 'MODE 1 frequency' 1. 1. 0.1 ;")
    assert any(line.startswith("MODE 1 frequency") for line in script.lines)


@pytest.mark.parametrize(
    ("script", "said"),
    [("X Y = 2 5 ; MESS X Y ;", "25"), ("OPTI DIME 2 ; P = (0,5) ; MESS (ENTI (COOR 2 P)) ;", "5"),
     ("L = LECT 1,2,3 ; MESS (EXTR L 3) ;", "3"), ("L = LECT 2, 5 ; MESS (DIME L) ;", "2"),
     ("MESS 'sizes 2,5' ;", "sizes 2,5"), ("* 2,5\nX = 1 ; MESS X ;", "1"),
     ("COMM 2,5 ; MESS 4 ;", "4"), ("X = 1 ; MESS X ; FIN ; 2,5", "1")],
)  # fmt: skip
def test_commas_that_separate_are_none_of_a_decimal(script, said, run):
    assert [line.strip() for line in run(script).lines if line.strip()] == [said]


def test_what_is_only_printed_has_its_commas_for_blanks(run):
    script = run("MESS 'theory' 46,8 ;\nX = 1 ; 'MESS' 2,5 ' ' X ;")
    assert script.lines == ["theory468", "25 1"]
    assert [w.code for w in script.result.session.warnings] == ["comma-in-print"] * 2


@pytest.mark.parametrize(
    ("phrase", "line"), [("'a' * SAUT 2 LIGN", "a*SAUT2LIGN"), ("3 / 'b'", "3/b"), ("3 *", "3*")]
)
def test_a_mark_without_a_column_is_printed(phrase, line, run):
    assert run(f"MESS {phrase} ;").lines == [line]
    assert run(f"X = CHAI {phrase} ;")["x"] == line


def test_an_end_of_a_condition_that_nothing_begins_is_told_and_left_out(run):
    script = run(
        "X = 1 ; FINSI ; SI (X EGA 1) ; Y = 2 ; FINSI ; 'FINS' ; "
        "REPE B 3 ; X = X + 1 ; FINS ; FIN B ;"
    )
    assert (script["x"], script["y"]) == (4, 2)
    warnings = script.result.session.warnings
    assert [(w.code, w.span.start) for w in warnings] == [
        ("finsi-without-si", 8),
        ("finsi-without-si", 47),
        ("finsi-without-si", 79),
    ]


def test_an_else_of_no_condition_is_refused(fails):
    assert fails("«SINON» ;") == "stray-block-end"


@together(
    "script, words",
    [
        ("SI FAUX ; MESS 'a' «SINON» ; MESS 'b' ; FINSI ;", ["SINON"]),
        ("SI VRAI ; X = 2 * 3 «FINSI» ; FINSI ;", ["FINSI"]),
        ("REPE B 2 ; Y = &B + 1 «FIN» B ; FIN B ;", ["FIN"]),
        ("REPE B 2 ; Y = &B + 1 «QUIT» B ; FIN B ;", ["QUIT"]),
        ("REPE B 2 ; Y = &B + 1 «ITERER» 'B' ; FIN B ;", ["ITERER"]),
        ("REPE B 2 ; ITER = 'ITER' ; Y = ITER ITER ; FIN B ;", []),
        ("DEBP F A*ENTIER ; Y = A «FINP» Y ; FINP Y ; Z = F 3 ;", ["FINP"]),
        ("SI VRAI ; MESS 'SINON' ; FINSI ; B = 'FIN' ; MESS B ;", []),
        ("MESS 2\n«FIN» ;", ["FIN"]),
        ("FIN = 3. ; MESS FIN ; X = PROG 1. FIN ; FIN ;", []),
        ("T = TABL ; T . FIN = 2 ; REPE B 1 ; X = T . FIN B ; FIN B ;", []),
    ],
)
def test_a_word_of_a_block_inside_a_statement_is_told(script, words):
    result = run_text(script.replace("«", "").replace("»", ""))
    told = [w for w in result.session.warnings if w.code == "block-word-inside"]
    assert [w.data["word"] for w in told] == words
    assert [w.span.start for w in told] == [script.find("«")] * len(words)


@together(
    "script, word",
    [
        ("SI VRAI ; X = 2 * 3 FINSI ; FINSI ; MESS X ;", "FINSI"),
        ("X = 3 SI VRAI ; MESS 'on' ; FINSI ;", "SI"),
        ("X = 3 SINON ; MESS X ;", "SINON"),
        ("REPE B 2 ; X = 2 REPETER ; FIN B ;", "REPETER"),
        ("DEBP F A*ENTIER ; Y = A FINP ; FINP Y ; Z = F 3 ;", "FINP"),
        ("X = 2 + 1 FINMETH ;", "FINMETH"),
        ("X = 2 + 1 DEBPROC F ;", "DEBPROC"),
    ],
)
def test_a_word_of_a_block_is_no_operator_that_is_not_there(script, word):
    """The statement that takes it is refused at once, by a sentence that is true of it."""
    result = run_text(script)
    assert [(e.code, e.span.text) for e in result.errors] == [("unknown-operator", word)]
    assert f"{word} begins a statement" in result.message
    assert "that ssilang does not have" not in result.message


@pytest.mark.parametrize("script", ["X = 2,5 ;", "L = PROG 1. -2,5 ;", "X = (2,5E3 * 2) ;"])
def test_a_decimal_comma_is_refused_before_anything_runs(script):
    result = run_text(f"MESS 'begun' ; {script}")
    assert [e.code for e in result.errors] == ["decimal-comma"]
    assert result.output == ""


def test_a_text_over_several_lines_opens_no_false_quote():
    result = run_text("TITR 'two\nlines' ;\nX = 1. ;\nMESS 'open ;\nY = 2. ;\n")
    assert [e.code for e in result.errors] == ["unclosed-string"]
    assert "script:4:6" in result.message


@together("control", ["\x1b", "\x9b", "\x07", "\x00", "\u202e"])
def test_control_characters_reach_nobody_as_such(control):
    result = failed(f"MESS 'a{control}[31mred' ;\nMESS (L{control}[2J) ; X = {control}[31mfoo 3 ;")
    assert control not in result.output + result.message
    result = run_text(f"MESS 'a{control}[31mred\tb' ;")
    assert result.output == f"a{ascii(control)[1:-1]}[31mred\tb\n"
