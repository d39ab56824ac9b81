"""What is known of names in branches: a branch has its own knowledge; problems for programs."""

import json

import pytest
from together import together

from ssilang.cli.check import check_source
from ssilang.cli.checking.kinds import (
    ANY_WORD,
    SOMETHING,
    UNKNOWN,
    Scope,
    assigned_names,
    kind_word,
    same,
    typed,
)
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse
from ssilang.language.values import Mot


def test_what_a_procedure_reads_for_itself_hides_nothing_else():
    """ARGU shows its names, a number behind DONN is no file, EGA takes a tolerance, procedures may
    change the dimension."""
    text = (
        "DEBP TOTO ; ARGU A*MAILLAGE ; WTAB . 'K' = A ; B = ININLIN 1 A ; FINP B ;\n"
        "SI (EGA 1. 1. 1.E-9) ; OPTI DONN 5 ; FINSI ; X = TOTO ; LIST X ;\n"
        "OPTI DIME 2 ; DEBP DEEP ; OPTI DIME 3 ; FINP ; DEEP ; P = 0. 0. 1. ; LIST P ;"
    )
    (error,) = (p for p in check_source(Source("script", text))[0] if p.severity == "error")
    assert error.data["name"] == "ININLIN"


def test_a_branch_does_not_change_what_stands_before_it():
    before = Scope({"Z": 1, "A": Mot("W")}, True, 3, ("B1", "P1"))
    branch = before.copy()
    assert (branch.values, branch.open, branch.dimension, branch.inside) == (
        {"Z": 1, "A": "W"}, True, 3, ("B1", "P1")
    )  # fmt: skip
    branch.values["Z"] = 2
    branch.values["NEW"] = 2
    branch.forget(["A"])
    branch.open, branch.dimension = False, 2
    assert (before.values, before.open, before.dimension) == ({"Z": 1, "A": "W"}, True, 3)


@together(
    "a, b, known",
    [
        (3, 3, 3), (3, 4, typed("ENTIER")), (3, 3.0, UNKNOWN), (2.5, 2.5, 2.5),
        (Mot("A"), Mot("A"), Mot("A")), (Mot("A"), Mot("B"), ANY_WORD), (Mot("A"), 1, UNKNOWN),
        (typed("MAILLAGE"), typed("MAILLAGE"), typed("MAILLAGE")),
        (typed("MAILLAGE"), typed("CHPOINT"), UNKNOWN), (typed("ENTIER"), 3, typed("ENTIER")),
        (UNKNOWN, 3, UNKNOWN), (SOMETHING, SOMETHING, SOMETHING), (SOMETHING, 3, UNKNOWN),
        (True, True, True), (True, False, typed("LOGIQUE")), (True, 1, UNKNOWN),
    ],
)  # fmt: skip
def test_what_is_known_of_one_or_the_other(a, b, known):
    for found in (same(a, b), same(b, a)):
        assert type(found) is type(known)
        assert found is known or found == known


def test_types_without_a_stand_in():
    assert [typed(w) for w in ("MOT", "TEXTE", "ANNULE", "PROCEDUR", "")] == [
        ANY_WORD, *[UNKNOWN] * 4
    ]  # fmt: skip
    assert [kind_word(v) for v in (UNKNOWN, SOMETHING, typed("TABLE"), 1.5)] == [
        "", "", "TABLE", "FLOTTANT"
    ]  # fmt: skip


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(
    ("dimensions", "opened", "dimension", "open_"),
    [((2, 2), (False, False), 2, False), ((2, 3), (False, True), None, True),
     ((0, 0), (True, True), 0, True), ((None, 3), (True, False), None, True)],
)  # fmt: skip
def test_joined_branches(turned, dimensions, opened, dimension, open_):
    a = Scope({"Z": 1, "B": 2, "MINE": 5}, opened[0], dimensions[0])
    b = Scope({"B": 3, "Z": 1, "OTHER": 6}, opened[1], dimensions[1])
    a, b = (b, a) if turned else (a, b)
    kept = dict(b.values)
    a.join(b)
    assert (a.open, a.dimension) == (open_, dimension)
    assert a.values == {
        "Z": 1, "B": typed("ENTIER"), "MINE": UNKNOWN, "OTHER": UNKNOWN
    }  # fmt: skip
    assert b.values == kept


@together(
    "text, names",
    [
        ("Z A = 1 2 ; B . 1 = 2 ; 3 + 4 ;", {"Z", "A"}),
        ("SI VRAI ; Z = 1 ; SINON ; A = 1 ; FINSI ; M = 1 ;", {"Z", "A", "M"}),
        ("REPE LOOP 2 ; Z = 1 ; SI VRAI ; B = 2 ; FINSI ; FIN LOOP ;", {"&LOOP", "Z", "B"}),
        ("DEBP PROC X*ENTIER Y/MOT ; Z = X ; FINP Z ;", {"PROC", "X", "Y", "Z"}),
        ("ACQUERIR Z*ENTIER ; OBTE Q*FLOTTANT ;", {"Z", "Q", "ENTIER", "FLOTTANT"}),
    ],
)  # fmt: skip
def test_names_that_get_values(text, names):
    assert assigned_names(parse(Source("x", text)).body) == names


SCRIPT = "OPTI DIME 2 ELME SEG2 ;\nX = 1 / (2. ;\nFIN ;\n"


def test_json_has_places_and_fixes(ssilang, tmp_path):
    sound = tmp_path / "sound.ssi"
    sound.write_text("OPTI DIME 2 ELME SEG2 ;\nFIN ;\n")
    broken = tmp_path / "broken.ssi"
    broken.write_text(SCRIPT)
    outcome = ssilang("check", "--format", "json", str(sound), str(broken))
    assert outcome.code == 1
    first, second = json.loads(outcome.out)
    assert (first["file"], first["line"], first["column"]) == (str(sound), 1, 13)
    assert (first["severity"], first["code"]) == ("warning", "near-word")
    assert first["fixes"][0]["text"] == "ELEM"
    assert (second["line"], second["column"], second["code"]) == (2, 9, "unclosed-paren")
    assert second["fixes"][0]["column"] == 12


def test_notes_of_github_escape_what_ends_them(ssilang, tmp_path):
    deck = tmp_path / "a,b.ssi"
    deck.write_text(SCRIPT)
    outcome = ssilang("check", "--format", "github", str(deck))
    assert outcome.code == 1
    place, _, message = outcome.out.strip().removeprefix("::error ").partition("::")
    assert place.startswith(f"file={tmp_path}/a%2Cb.ssi,line=2,endLine=2,col=9,endColumn=10")
    assert message
    assert "\n" not in message


def test_nothing_wrong(ssilang, tmp_path):
    deck = tmp_path / "case.ssi"
    deck.write_text("MESS 1 ;\nFIN ;\n")
    outcome = ssilang("check", "--format", "json", str(deck))
    assert (outcome.code, json.loads(outcome.out)) == (0, [])
    assert ssilang("check", "--format", "github", str(deck)).out == ""
