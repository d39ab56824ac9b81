"""Checks of a text that was changed: what is not read again is what it was."""

import io
import os
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from together import together

from ssilang.cli.check import check_source
from ssilang.cli.checking import walk
from ssilang.cli.checking.sound import SoundStatements
from ssilang.cli.editor.problems import Findings, find_problems
from ssilang.cli.run import RunOptions, make_session, run_text
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source, Span

ROOT = Path(__file__).parents[3]
DECK = """OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ;
P1 = 0. 0. ; P2 = 1. 0. ; L1 = P1 DROI 4 P2 ; S1 = L1 TRAN 2 (0. 1.) ;
DEBP RATIO A*FLOTTANT B/FLOTTANT P*PROCEDUR ;
  SI (EXIS B) ; R = A / B ; SINON ; R = P A ; FINSI ;
FINP R ;
DEBP TWICE A*FLOTTANT ; R = 2. * A ; FINP R ;
T1 = TABL ; T1 . 'LIST' = PROG 1. PAS 0.5 4. ; W = MOT 'PROG' ; N0 = 3 ;
REPE B1 N0 ;
  X = EXTR T1 . 'LIST' &B1 ; M = MOT 'PROG' ; V = M X ; @VERIFIE T1 'x' X X 1.E-3 ;
  SI (X > 2.) ; ITER B1 ; FINSI ;
  Y = (TWICE X) + (X ** 2) + (N0 / 2) ; MESS 'x = ' X*20 ' l''essai' V Y ;
FIN B1 ;
MO = MODE S1 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 1. 'NU' 0.3 ; RI = RIGI MO MA ;
"""
WORDS = (
    "1", "2.", "'A'", "'DIME'", "N0", "A", "P1", "S1", "W", "X", "TWICE", "RATIO", "PROG", "DROI",
    "TEXT", "ET", "+", "@VERIFIE",
)  # fmt: skip
STATEMENTS = (
    "X = 'A'", "N0 = 2.", "N0 = 'PROG'", "OPTI DIME 3", "LIRE Z", "REST", "TWICE = 4", "W = 3",
    "OUBL P1", "P1 = 0. 0. 0.", "TWICE = TWICE 1.", "FIN", "FINSI", "SI (N0 EGA 1)", "REPE B2 2",
    "DEBP TWICE A*MAILLAGE", "FINP A", "T1 = 3", "S1 = TABL", "DROI = 1", "MESS 3 4",
)  # fmt: skip


def look(text: str, sound: SoundStatements | None = None) -> Findings:
    return find_problems(Source("deck", text), "en", sound=sound)


def edited(data: st.DataObject, text: str) -> str:
    """A statement taken out, put in or moved, or a word replaced; mostly a sound text."""
    statements = text.split(" ;")
    at = data.draw(st.integers(0, len(statements) - 2))
    kind = data.draw(st.sampled_from(("out", "in", "word", "word", "move")))
    if kind == "in":
        statements.insert(at, "\n" + data.draw(st.sampled_from(STATEMENTS)))
    elif kind == "word":
        words = statements[at].split(" ")
        words[data.draw(st.integers(0, len(words) - 1))] = data.draw(st.sampled_from(WORDS))
        statements[at] = " ".join(words)
    else:
        taken = statements.pop(at)
        if kind == "move":
            statements.insert(data.draw(st.integers(0, len(statements) - 1)), taken)
    return " ;".join(statements)


@settings(max_examples=40)
@given(st.data())
def test_a_changed_text_has_the_problems_of_a_new_one(data):
    sound, text = SoundStatements(), DECK
    look(text, sound)
    for _ in range(data.draw(st.integers(1, 5))):
        text = edited(data, text)
        assert look(text, sound) == look(text)


@pytest.fixture
def read(monkeypatch):
    """Texts of the statements that are read, as the checker reads them."""
    found: list[str] = []
    whole = walk.Checker._read

    def action(self, statement, scope):
        found.append(statement.span.text)
        return whole(self, statement, scope)

    monkeypatch.setattr(walk.Checker, "_read", action)
    return found


def test_only_what_a_change_reaches_is_read_again(read):
    """In a deck of the repository: one statement, and those that read what it gives."""
    text = (ROOT / "cases/club_cast3m_2014/club_b_sdm.ssi").read_text(encoding="utf-8")
    sound = SoundStatements()
    look(text, sound)
    whole = len(read)
    assert whole > 50
    read.clear()
    look(text.replace("* ", "* a remark more: ", 1), sound)
    assert read == []
    old, new = "DUREE = 1. ;", "DUREE = 2. ;"
    assert text.count(old) == 1
    look(text.replace(old, new), sound)
    assert read[0] == new.removesuffix(" ;")
    assert all("DUREE" in statement for statement in read)
    assert len(read) < whole / 5


def test_what_is_remembered_is_of_the_last_text(read):
    sound = SoundStatements()
    for text in ("X = 1 + 2 ; MESS X ;", "Y = 1 + 3 ; MESS Y ;", "X = 1 + 2 ; MESS X ;"):
        read.clear()
        look(text, sound)
        assert len(read) == 2


def test_a_problem_is_found_again_at_its_new_place():
    sound = SoundStatements()
    text = "X = 1 ; MESS X ;\nY = 3 + VRAI ; MESS Y ;"
    (first,) = look(text, sound).problems
    (second,) = look("\n\n" + text, sound).problems
    assert (first.code, first.start + 2) == (second.code, second.start) == ("no-rule", 23)


def test_procedures_beside_the_script_are_read_anew_when_they_change(tmp_path):
    deck, file = tmp_path / "deck.ssi", tmp_path / "@HALF.ssi"
    source = Source(str(deck), "X = @HALF 3. ; MESS X ;\n@VERIFIE (TABL) 'x' 1. 1. 1. ;", deck)
    sound = SoundStatements()

    def codes() -> list[str]:
        found = find_problems(source, "en", sound=sound)
        assert found == find_problems(source, "en")
        return [p.code for p in found.problems]

    assert codes()
    for i, (kind, wrong) in enumerate((("FLOTTANT", False), ("MAILLAGE", True))):
        file.write_text(f"DEBP @HALF A*{kind} ; R = A ; FINP R ;", encoding="utf-8")
        os.utime(file, ns=(i * 10**9, i * 10**9))
        assert ("missing-parameter" in codes()) is wrong
    file.write_text("* one\n* two\nDEBP @HALF A ;\n R = (A ; FINP R ;", encoding="utf-8")
    assert codes() == ["unclosed-paren"]
    (told,) = find_problems(source, "en").problems  # at no place of this text, nor mended there
    assert (told.start, told.end, told.fixes) == (0, 0, ())
    file.unlink()
    assert "unknown-operator" in codes()


@together(
    "between, sure",
    [
        ("X = 'a' ;", True),
        ("REPE B 0 ; X = 'a' ; FIN B ;", False),
        ("REPE B 2 ; QUIT B ; X = 'a' ; FIN B ;", False),
        ("SI (N0 > 1) ; X = 'a' ; FINS ;", False),
        ("SI (N0 > 1) ; X = 'a' ; SINO ; MESS 1 ; FINS ;", False),
        ("SI (N0 < 1) ; MESS 1 ; SINO ; X = 'a' ; FINS ;", False),
        ("SI (N0 > 1) ; X = 'a' ; SINO ; X = 'b' ; FINS ;", True),
        ("SI (N0 > 1) ; X = TABL ; SINO ; X = 2. ; FINS ;", False),
        ("REPE B 1 ; SI (N0 > 1) ; X = 'a' ; FINS ; FIN B ;", False),
        ("DEBP OTHER ; X = 'a' ; FINP ;", False),
        ("OTHER = 'X = 1' ; X = 'a' ;", True),
        ("X = 'a' ; X = 3. ;", False),
        ("Y W = 3. 'a' ; X = W ;", True),
        ("T1 = TABL ; T1 . 'X' = 'a' ;", False),
        ("OUBL X ; X = 'a' ;", True),
    ],
)
def test_a_name_is_of_a_type_where_it_is_so_whichever_way_is_taken(between, sure):
    text = f"N0 = 0 ; X = 1. ; {between} Z Y = IFRE X ; MESS Z Y ;"
    problems, _ = check_source(Source("deck", text))
    told = [p.code for p in problems if p.severity == "error"]
    assert told == (["wrong-argument"] if sure else [])
    if not sure:
        assert run_text(text).exit_code == 0


def test_many_problems_are_looked_at_once_each():
    """Thousands of names that nothing reads took minutes where each looked through all before."""

    class Looked(SsiError):
        looks = 0

        def __getattribute__(self, name):
            Looked.looks += name == "span"
            return super().__getattribute__(name)

    count = 300
    source = Source("script", "x" * count)
    checker = walk.Checker(make_session(source, RunOptions(), io.StringIO()))
    problems = [Looked("unused-name", Span(source, i, i + 1), name="X") for i in range(count)]
    Looked.looks = 0
    for problem in problems:
        checker._report(problem)
    assert len(checker.problems) == count
    assert Looked.looks < 10 * count
