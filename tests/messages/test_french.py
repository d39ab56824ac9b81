"""Every text has its French and its English; what a run prints speaks one language."""

import io
import re
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import fields
from pathlib import Path

from together import together

from ssilang.cli.check import check_source
from ssilang.cli.helping import show_help
from ssilang.cli.run import RunOptions, run_text
from ssilang.language.registry import OPERATORS, Argument, Operator
from ssilang.language.say.diagnostics import render
from ssilang.language.text.source import Source
from ssilang.messages import message
from ssilang.messages.message import Translated, french
from ssilang.operators.loader import load_operators

_FILES = sorted((Path(message.__file__).parent / "french").glob("*.toml"))


def texts_in(declared: object) -> Iterator[str]:
    """English lines of a declaration, and of all that it holds."""
    if isinstance(declared, Translated):
        yield from declared.en.split("\n")
        for field in fields(declared):  # type: ignore[arg-type]
            yield from texts_in(getattr(declared, field.name))
    elif isinstance(declared, Mapping):
        yield from texts_in(tuple(declared.values()))
    elif isinstance(declared, tuple):
        for part in declared:
            yield from texts_in(part)


def operators() -> list[Operator]:
    load_operators()
    return [o for name, o in OPERATORS.items() if o.name == name]


def declared() -> set[str]:
    """All English lines that operators and their forms declare."""
    forms = [form for operator in operators() for form in operator.forms]
    found = {t for form in forms for t in texts_in((form.entries or (), form.when))}
    for name, module in list(sys.modules.items()):  # what operators read by hand
        if name.startswith("ssilang.operators"):
            held = (v for v in vars(module).values() if isinstance(v, Argument | dict))
            found |= {t for v in held for t in texts_in(v)}
    return found - {""}


def kept() -> Counter[str]:
    """English lines of the files of French texts, how often each."""
    return Counter(en for f in _FILES for en in tomllib.loads(f.read_text(encoding="utf-8")))


def test_every_text_has_its_french():
    assert not sorted(t for t in declared() if not french(t).strip())


def test_every_french_text_has_its_english():
    assert not set(kept()) - declared()


def test_a_text_stands_in_one_file():
    assert not [en for en, times in kept().items() if times > 1]


def test_every_operator_and_no_other_has_help_in_both_languages():
    forms = {}
    for operator in operators():
        assert all(x.strip() for x in (operator.help.en, operator.help.fr, operator.help.syntax))
        functions = {form.page[-1] for form in operator.forms}
        forms[operator.family, operator.name] = functions | {"en", "fr", "syntax"}
    for path in (Path(message.__file__).parent / "pages").glob("*.toml"):
        for name, texts in tomllib.loads(path.read_text(encoding="utf-8")).items():
            assert set(texts) <= forms[path.stem, name]
            for said in (texts, *(t for t in texts.values() if isinstance(t, dict))):
                lines = [str(said.get(language, "")).split("\n") for language in ("en", "fr")]
                assert len(lines[0]) == len(lines[1]), name


ENGLISH = """the of and with from value cell cells node nodes unknown unknowns item items line lines
curve title word words elapsed processor still named symmetric check tolerance expected time
multiplier loading field object stands error warning wanted"""
FRENCH = """le la les des du de et avec valeur valant maille mailles élément éléments noeud noeuds
inconnue inconnues ligne lignes courbe titre mot mots écoulé processeur encore nommé symétrique
contrôle tolérance attendu temps multiplicateur champ objet erreur avertissement attendait"""
TELLTALE = {"en": frozenset(ENGLISH.split()), "fr": frozenset(FRENCH.split())}
"""Words that only one of the two languages has."""

PLATE = """
OPTI DIME 2 ELEM QUA4 MODE PLAN CONT ;
P1 = 0. 0. ; L1 = DROI 2 P1 (1. 0.) ; S1 = L1 TRAN 2 (0. 1.) ;
MO1 = MODE S1 MECANIQUE ELASTIQUE ; MA1 = MATE MO1 YOUN 1. NU 0.3 RHO 1. ;
B1 = BLOQ L1 DEPL ; K1 = (RIGI MO1 MA1) ET B1 ; F1 = FORC FX 1. P1 ;
E1 = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 2.) ;
"""

SCRIPTS = {
    "numbers": "LIST 3 ; LIST 2.5 ; LIST VRAI ; LIST 'abc' ; "
    "LIST (PROG 1. 2.) ; LIST (LECT 1) ; LIST (MOTS 'A') ; LIST 'RESU' (PROG 1.) ;",
    "tables": "T = TABL ; T . 1 = PROG 1. ; T . 'X' = TABL ; LIST T ; LIST T 2 ; LIST ; "
    "LIST *TABLE ; DEBP P A*ENTIER ; MESS A ; FINP ; LIST P ; LIST 'RESU' P ; "
    "DEBM NAIT ; %V = 1 ; %METHODE DIT P ; FINM ; O = OBJE NAIT ; LIST O ;",
    "meshes": PLATE + "LIST P1 ; LIST L1 ; LIST 'RESU' S1 ; VERM (L1 ET (INVE L1)) ;",
    "matrices": PLATE + "LIST K1 ; LIST 'RESU' B1 ;",
    "fields": PLATE + "LIST MO1 ; LIST MA1 ; LIST F1 ; LIST (RESO K1 (F1 * 0.)) ;",
    "curves": PLATE + "LIST E1 ; LIST (CHAR MECA F1 E1) ; LIST (CHAR MECA F1 E1) ;",
    "session": "TEMP ; ERRE -5 ; ERRE -12345 ;",
    "checks": "T = TABL ; @VERIFIE T 'abc' 2. 2. 0.1 'RELA' ; @VERIFIE T 'abc' 2. 2. 0.1 ; "
    "@BILAN T ;",
    "errors": "A = PROG 1. 2. ; B = A + (PROG 1.) ;",
    "division": "A = 1 / 0 ;",
    "refused": PLATE + "LIST (RIGI MO1 F1) ;",
}


def foreign(text: str, language: str) -> set[str]:
    """Words of the other language in a text; what a script quotes is in capitals or 'abc'."""
    other = "fr" if language == "en" else "en"
    return set(re.findall(r"\w+", text)) & TELLTALE[other]


@together("language", ["en", "fr"])
@together("script", sorted(SCRIPTS))
def test_a_run_speaks_its_language(script: str, language: str, tmp_path: Path) -> None:
    options = RunOptions(tmp_path, language=language)
    result = run_text(SCRIPTS[script], options=options)
    text = f"{result.output}\n{result.message}"
    assert bool(result.message) == (script in ("errors", "division", "refused"))
    assert not foreign(text, language), text
    other = "fr" if language == "en" else "en"
    assert foreign(text, other), "no word that tells the language"


@together("language", ["en", "fr"])
def test_warnings_speak_the_language(language: str) -> None:
    problems, _ = check_source(Source("script", "A = 3 / 2 ; DENS = 4. ; MESS A ;"))
    assert [p.severity for p in problems].count("warning") >= 2
    text = "\n".join(render(p, language) for p in problems)
    assert not foreign(text, language), text
    assert text.count({"en": "warning:", "fr": "avertissement :"}[language]) >= 2


@together("language", ["en", "fr"])
@together("word", ["", "DENS", "JOINT_SDM", "ACTI3", "qqqqq"])
def test_help_speaks_its_language(word: str, language: str) -> None:
    out = io.StringIO()
    show_help(word, language, out)
    assert not foreign(re.sub(r"(?m)^.*'.*$", "", out.getvalue()), language), out.getvalue()
