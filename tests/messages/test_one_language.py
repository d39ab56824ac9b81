"""What a run prints speaks one language: that of the run."""

import io
import re
from pathlib import Path

from together import together

from ssilang.cli.check import check_source
from ssilang.cli.helping import show_help
from ssilang.cli.run import RunOptions, run_text
from ssilang.language.say.diagnostics import render
from ssilang.language.text.source import Source

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
