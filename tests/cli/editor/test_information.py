"""What is told of a word: the page, entry, keyword or name that it is where it stands."""

from functools import cache
from pathlib import Path

import pytest
from together import together

from ssilang.cli.editor.complete import candidates
from ssilang.cli.editor.document import Document
from ssilang.cli.editor.information import Reader, markdown, signatures
from ssilang.cli.editor.problems import find_problems
from ssilang.language.registry import find_operator
from ssilang.language.run.library import Library
from ssilang.language.say.reference import find_page, page_text
from ssilang.operators.loader import load_operators

DECK = """OPTI DIME 2 ELEM SEG2 MODE PLAN DEFO ;
DEBP ZHALF X*FLOTTANT ; SI (X > 1.) ; X = X / 2. ; FINSI ; REPE BX 2 ; Y = X +
  &BX ; FIN BX ; FINP Y ;
L = DROI 3 (0. 0.) (1. 0.) ; M = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
A = MATE M 'YOUN' 1. 'SECT' 2. ; X = ZHALF 4. ; E = EVOL 'MANUEL' 'LEGE' 'e' (PROG 0.) (PROG 1.) ;
T1 = TABL ; T1 . 'PAS_SAUVES' = 2 ; T1 . 'RIGI' = RIGI M A ; T2 = DYNAMIC T1 ;
G = L POIN 'PROC' (0. 0.) ; K = VIBR 'SIMU' 1. 3 ; DROI = 3 ;
"""


@cache
def library():
    load_operators()
    return Library(Path())


def reader(language):
    document = Document.of(DECK, None, library().standard_names)
    return Reader(document, find_problems(document.source, language), library(), language)


@together(
    "word, number, told",
    [
        ("DIME", 1, ("**DIME : option of OPTI**\n\nNumber of dimensions of space: 1, 2 or 3.",
                     "**DIME : option d'OPTI**\n\nNombre de dimensions de l'espace : 1, 2 ou 3.")),
        ("2", 1, None), ("0.", 1, None),
        ("ZHALF", 2, ("**ZHALF** (procedure of line 2)\n\n```ssi\nDEBP ZHALF X*FLOTTANT ;\n```",
                      "**ZHALF** (procédure de la ligne 2)\n\n")),
        ("X >", 1, ("**X** (argument, line 2)\n\n```ssi\nDEBP ZHALF", "**X** (argument, ligne 2)")),
        ("BX ;", 2, ("**&BX** (loop of line 2)\n\n```ssi\nREPE BX 2 ;\n```",
                     "**&BX** (boucle de la ligne 2)")),
        ("&BX", 1, ("**&BX** (loop of line 2)", "**&BX** (boucle de la ligne 2)")),
        ("Y ;", 1, ("**Y** (first given at line 2)\n\n```ssi\nY = X +\n  &BX ;\n```",
                    "**Y** (donné d'abord à la ligne 2)")),
        ("M A", 1, ("**M** : MMODEL (first given at line 4)\n\n```ssi\nM = MODE L", "**M** : MM")),
        ("A ;", 1, ("**A** : MCHAML (first given at line 5)", "**A** : MCHAML (")),
        ("X = Z", 1, ("**X** (first given at line 5)\n\n```ssi\nX = ZHALF 4. ;\n```",
                      "**X** (donné d'abord à la ligne 5)")),
        ("POIN", 1, ("**POIN", "**POIN")),
        ("'BARR'", 1, ("**BARR : element of structures**", "**BARR : élément de structure")),
        ("'YOUN'", 1, ("**YOUN : parameter of MATE or CARA**\n\nYoung's modulus.",
                       "**YOUN : paramètre de MATE ou CARA**")),
        ("'LEGE'", 1, ("**'LEGE'** : EVOLUTION", "**'LEGE'** : EVOLUTION")),
        ("'SIMU'", 1, ("**'SIMU'** : VIBRATION\n\n```text\n'SIMU'\n  frequency      FLOTTANT: ",
                       "**'SIMU'** : VIBRATION\n\n```text\n'SIMU'\n  frequency      FLOTTANT: fr")),
        ("'PAS_SAUVES'", 1,
         ("**DYNAMIC . 'PAS_SAUVES'** : ENTIER or MOT\n\none step in so many, all of them or the "
          "last alone go to the table\n\nDefault 4 ; 'TOUS' 'FINAL'",
          "**DYNAMIC . 'PAS_SAUVES'** : ENTIER ou MOT\n\n")),
        ("'RIGI'", 1, ("**DYNAMIC . 'RIGI'** : RIGIDITE\n\nstiffness, with supports",
                       "**DYNAMIC . 'RIGI'** : RIGIDITE\n\nrigidité, avec les appuis")),
        ("DYNAMIC", 1, ("**DYNAMIC : calculation in time, step by step [procedures]**\n\n",
                        "**DYNAMIC : ")),
        ("SI (", 1, ("**SI : ", "**SI : structure d'un jeu de données**\n\nSI LOG1 ; ... SINON")),
    ],
)  # fmt: skip
def test_what_a_word_is_where_it_stands(word, number, told):
    at = -1
    for _ in range(number):
        at = DECK.index(word, at + 1)
    end = at + len(word.split(" ")[0])
    for language, begins in zip(("en", "fr"), told or (None, None), strict=True):
        for offset in (at + (word[0] == "&"), end):  # right behind a word is at it
            found = reader(language).hover(offset)
            assert (found is None) == (begins is None)
            if found is not None:
                assert found[0].startswith(begins), found[0][:300]
                assert found[1:] == (at, end)


def test_entries_have_units_defaults_in_their_language_and_values():
    text = "T1 = TABL ; T1 . 'DEBU' = 1. ; T1 . 'ALPHA_F' = 1. ; T2 = DYNAMIC T1 ;"
    document = Document.of(text, None, library().standard_names)
    for language, said in (
        ("en", ["Unit s ; Default 0., or the first of INST if it is before",
                "Default average acceleration"]),
        ("fr", ["Unité s ; Défaut 0., ou le premier d", "Défaut accélération moyenne"]),
    ):  # fmt: skip
        own = Reader(document, find_problems(document.source, language), library(), language)
        for word, facts in zip(("'DEBU'", "'ALPHA_F'"), said, strict=True):
            told = own.hover(text.index(word) + 1)[0].split("\n")
            assert len(told) == 5
            assert told[-1].startswith(facts), told


@pytest.mark.parametrize("language", ["en", "fr"])
def test_a_page_beside_the_text_leaves_the_tables_of_all_laws_to_the_help(language):
    whole = page_text(find_page("MATE", {}), language)
    shown = reader(language).page("MATE")
    for parameter in ("NU ", "KN ", "RHO "):  # a line of a table for each law that has it
        lines = [line for line in whole.split("\n") if line.strip().startswith(parameter)]
        assert len(lines) > 1
        assert not any(line.strip() in shown for line in lines)
    assert "MATE" in shown.split("\n")[0]


def test_a_page_is_title_paragraph_and_the_rest_as_it_is():
    assert markdown("A : b\n\none\ntwo\n\nSyntax\n    x ;\n") == (
        "**A : b**\n\none two\n\n```text\nSyntax\n    x ;\n```"
    )
    assert markdown("A : b\n\none\n") == "**A : b**\n\none"


@together(
    "operator, typed, line",
    [
        ("EVOL", ["'EVOL'", "CHPO", "C"], "'CHPO'"),
        ("RIGI", ["DEPL", "UX"], "('DEPL')"),
        ("EVOL", ["TEMP", "D"], "'TEMP'"),
        ("EVOL", ["COMP", "LEGE"], "'COMP'"),
        ("VIBR", ["SIMULTANE"], "'SIMU"),
        ("FONC", ["SX"], "'SX'"),
    ],
)
def test_the_line_of_the_syntax_is_that_of_the_words_typed(operator, typed, line):
    load_operators()
    lines, best = signatures(find_operator(operator), typed)
    shown = find_operator(operator).help.syntax
    assert "\n".join(lines) == "\n".join(x.strip() for x in shown.split("\n") if x.strip())
    assert line in lines[best]
    assert best == next(i for i, x in enumerate(lines) if line in x)


def offered(text, language="en", path=None):
    document = Document.of(text, path, library().standard_names)
    return {c.label: c for c in candidates(document, len(text), library(), language)}


def test_parameters_offered_are_those_of_the_model_and_say_what_is_needed():
    head = "OPTI DIME 2 ELEM SEG2 MODE PLAN DEFO ; B = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
    head += "J = MODE N 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ; "
    bar, joint = offered(head + "A = MATE B '"), offered(head + "A = MATE J 'K", "fr")
    assert {"YOUN", "SECT", "RHO"} <= set(bar)
    assert not {"KN", "KS"} & set(bar)
    assert {"KN", "KS"} <= set(joint)
    assert "SECT" not in joint
    assert bar["SECT"].detail == "Area of the section (m2) (required)"
    assert bar["RHO"].detail == "Density (kg/m3)"
    assert joint["KN"].detail.endswith("(obligatoire)")
    assert (bar["SECT"].text, bar["SECT"].kind) == ("'SECT'", "word")
    spring = offered("S = MODE N 'IMPEDANCE' 'ELASTIQUE' ; A = MATE S '")
    assert {"RAID", "MASS", "AMOR"} <= set(spring)
    assert not {"YOUN", "KN"} & set(spring)
    every = offered("A = MATE X '")
    assert {"YOUN", "SECT", "KN"} <= set(every)


def test_files_offered_are_those_of_the_folder_and_one_below(tmp_path, monkeypatch):
    for name in ("b.csv", "a.msh", ".hidden", "in/c.at2", "in/deep/d.csv"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    found = offered("X = LIRE 'FER' '", path=tmp_path / "deck.ssi")
    files = {label: c for label, c in found.items() if c.kind == "file"}
    assert list(files) == ["a.msh", "b.csv", "in/c.at2"]
    assert files["in/c.at2"].text == "'in/c.at2'"
    assert not [c for c in offered("X = MOT '", path=tmp_path / "d").values() if c.kind == "file"]
    monkeypatch.setattr("ssilang.cli.editor.complete._MOST_FILES", 2)
    few = offered("X = LIRE 'FER' '", path=tmp_path / "deck.ssi").values()
    assert [c.label for c in few if c.kind == "file"] == ["a.msh", "b.csv"]


def test_a_name_is_offered_with_what_it_is_and_where_it_began():
    found = offered("ZA = 1 ;\nDEBP ZP ZX*ENTIER ;\n  ZI = 2 ;\n  ZA = 3 ; Z")
    shown = {c.label: c.detail for c in found.values() if c.label[0] == "Z" and len(c.label) == 2}
    assert shown == {"ZX": "parameter (2)", "ZI": "variable (3)", "ZA": "variable (4)",
                     "ZP": "procedure (2)"}  # fmt: skip
    assert (found["DROIT"].kind, found["REPETER"].kind) == ("operator", "control")
    behind = offered("ZA = 1 ;\nDEBP ZP ZX*ENTIER ;\n  ZI = 2 ;\nFINP ;\n")
    assert {c for c in behind if c[0] == "Z" and len(c) == 2} == {"ZA", "ZP"}
    twice = offered("ZA = 1 ;\nZA = 2 ;\n")["ZA"]
    assert twice.detail == "variable (1)"
    assert found["MAILLER"].kind == "procedure"
