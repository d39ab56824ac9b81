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


def test_a_label_of_a_check_may_begin_as_an_operator_does(run):
    script = run("T = TABL ; @VERIFIE T 'MODE 1 frequency' 1. 1. 0.1 ;")
    assert any(line.startswith("MODE 1 frequency") for line in script.lines)


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
