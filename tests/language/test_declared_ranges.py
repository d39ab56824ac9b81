"""Ranges of entries and operands: declared once, held by one check, for every declaration."""

import ast
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
from ssilang.language.registry import arguments_in, operators_by_family
from ssilang.language.run.session import Session
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SsiError
from ssilang.language.values import ListReel, type_of
from ssilang.language.vocabulary import words
from ssilang.language.vocabulary.entries import declared_names, read_declaration
from ssilang.language.vocabulary.entry_checks import checked
from ssilang.language.vocabulary.terms import ANY_NUMBER, UNSAID, Range, read_range
from ssilang.messages.message import sentence
from ssilang.operators.loader import load_operators
from ssilang.operators.workspace import open_session

NUMBERS = ("FLOTTANT", "ENTIER", "LISTREEL", "LISTENTI")
SENSELESS = (math.nan, math.inf, -math.inf, -1e300, -1.0, 0.0, 0.3, 1.0, 91.0, 1e6)


def belongs(bound: Range, value: float) -> bool:
    """Whether a number is in a range, by what help prints of it."""
    text = bound.text("x")
    if bound.carried or (bound.nought and value == 0):
        return True
    return math.isfinite(value) and (not text or eval(text.replace("|x|", "abs(x)"), {"x": value}))


def tried(types, value):
    """The number as each type that an entry takes it in; a list has it at its end."""
    if "FLOTTANT" in types:
        yield float(value)
    if "ENTIER" in types and math.isfinite(value) and value == int(value):
        yield int(value)
    if "LISTREEL" in types:
        yield ListReel(np.array([value]))


ENTRIES = [
    e
    for name in declared_names()
    for e in read_declaration(name).entries
    if e.is_read and set(e.types) & set(NUMBERS)
]
RANGED = [e for e in ENTRIES if e.range != UNSAID]
BOUNDED = [e for e in RANGED if e.range != ANY_NUMBER]


def test_every_number_says_what_makes_sense():
    """A range, what is usual, or that any number does: nothing is left open."""
    assert len(ENTRIES) > 500
    told = [".".join(e.path) for e in ENTRIES if e.range == e.usual == UNSAID]
    assert not told
    assert len(operands()) > 400
    told = [
        f"{name} {a.name}" for (name, _), a in operands().items() if a.range == a.usual == UNSAID
    ]
    assert not told
    numbers = [w for w in words("parameter") if w.unit is not None and w.kind != "unused"]
    assert len(numbers) > 180
    assert not [w.name for w in numbers if w.range == w.usual == UNSAID]


def test_every_entry_with_a_range_refuses_what_is_outside_of_it():
    session, tries, refused = open_session(Session()), 0, 0
    for entry in RANGED:
        bounded = entry.range != ANY_NUMBER
        for number in SENSELESS:
            for value in tried(entry.types, number):
                tries += bounded
                data = {"procedure": "P", "operator": "P"}
                if belongs(entry.range, number):
                    checked(session, entry, value, entry.path, **data)
                    continue
                with pytest.raises(SsiError) as caught:
                    checked(session, entry, value, entry.path, **data)
                refused += bounded
                for language in ("en", "fr"):
                    said = render(caught.value, language, ())
                    assert entry.index in said or entry.index in "I*", said
    assert len(BOUNDED) > 200
    assert refused > 0.5 * tries


@together(
    "values, code",
    [
        ([], "increasing"),
        ([1.0, 3.0, 2.0], "increasing"),
        ([1.0, 2.0, 2.0], "increasing"),
        ([math.nan, 1.0], "finite"),
    ],
)
def test_lists_that_must_increase_are_refused_where_they_do_not(values, code):
    session = open_session(Session())
    rising = [e for e in BOUNDED if e.range.increasing]
    assert len(rising) >= 5
    for entry in rising:
        with pytest.raises(SsiError, check=lambda e: e.code == f"entry-not-{code}"):
            checked(session, entry, ListReel(np.array(values)), entry.path, procedure="P")


def test_defaults_lie_in_their_range():
    for entry in BOUNDED:
        if isinstance(entry.fallback, int | float) and not isinstance(entry.fallback, bool):
            assert belongs(entry.range, entry.fallback), entry.path


@together(
    "text, inside, outside",
    [
        ("> 0", [1e-9, 5], [0, -1]),
        (">= 1", [1, 2], [0]),
        ("0 <= x < 0.5", [0, 0.49], [0.5, -1e-9]),
        ("-90 < x < 90", [-89, 89], [90, -90]),
        ("<= 0.5", [-3, 0.5], [0.51]),
        ("increasing", [-5, 5], []),
        ("increasing > 0", [1], [0]),
        ("!= 0", [-1, 1e-300], [0, 0.0]),
        ("any", [-1e300, 0, 10**400], []),
    ],
)
def test_a_range_is_read_as_it_is_written(text, inside, outside):
    bound = read_range(text)
    assert bound.increasing is text.startswith("increasing")
    assert all(v in bound for v in inside)
    assert not any(v in bound for v in outside)
    assert not any(map(bound.__contains__, [math.nan]))


def operands():
    load_operators()
    found = {}
    for group in operators_by_family().values():
        for o in group:
            for form in o.forms:
                for a in arguments_in(form.entries or ()):
                    if a.types != ("*",) and set(a.types) & set(NUMBERS):
                        found[o.name, id(a)] = a
    return found


def test_ranges_of_operands_are_of_numbers_and_hold_their_defaults():
    ranged = list(operands().values())
    assert sum(a.range not in (UNSAID, ANY_NUMBER) for a in ranged) > 200
    for a in ranged:
        bound = a.range if a.range != UNSAID else a.usual
        for number in SENSELESS:
            for value in tried(a.types, number):
                flaw = bound.flaw(value, a.name)
                assert (flaw is None) is belongs(bound, number), (a.name, number)
        if isinstance(a.default, float) and a.range != UNSAID and a.default:
            assert belongs(a.range, a.default), a.name


def reads_past_declarations(module):
    """Places where an operator's code reads numbers by their types alone, and the types."""
    for node in ast.walk(ast.parse(Path(module.__file__).read_text(encoding="utf-8"))):
        match node:
            case ast.Call(ast.Attribute(attr="read" | "required" | "optional" | "all"), args):
                parts = [n for a in args for n in ast.walk(a)]
                said = {n.value for n in parts if isinstance(n, ast.Constant)}
                held = [vars(module).get(n.id) for n in parts if isinstance(n, ast.Name)]
                said.update(*(t for t in held if isinstance(t, tuple)))
                if said & set(NUMBERS):
                    yield f"{module.__name__}:{node.lineno}", said


def test_operators_that_read_by_hand_take_numbers_as_declared():
    load_operators()
    known = [m for n, m in sys.modules.items() if n.startswith("ssilang.operators")]
    assert len(known) > 180
    past = {at: said for m in known for at, said in reads_past_declarations(m)}
    # what is written for people may be infinite: no number is calculated with
    assert {at.split(":")[0] for at in past} == {"ssilang.operators.texts.words"}, past


NAN = "X = EXTR ((PROG 0.) / (PROG 0.)) 1 ; XL = (PROG 1. 0.) / (PROG 1. 0.) ; "
CURVE = "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'UX' 1. ; S = SUIT C C ; "


@together(
    "text",
    """Z = PROG 0. 'PAS' X 1. ;| Z = PROG 1. 'PAS' 1. 'GEOM' X 3. ;| Z = PROG 'SINU' X XL ;
Z = PROG 'SINU' 1. 'PHAS' X XL ;| Z = PROG 'LINE' 'A' X XL ;| Z = EVOL 'TEMP' S XL 'UX' P ;
OPTI 'DENS' X ;| OPTI 'PREC' X ;| Z = EXIS XL X ;| Z = EXIS XL 1. X ;
Z = VIDE 'TABULER' XL 'MAILLAGE' ;| DENS X ;| Z = P PLUS (X 0.) ;| Z = MANU 'CHPO' P 'UX' X ;
Z = COLI C X C X ;| Z = RACP X 1. 2. ;| Z = CERC 4 'ROTA' X P (2. 0.) ;""".replace("\n", "|").split(
        "|"
    ),
)
def test_what_is_no_number_is_refused_where_it_stands(text):
    (error,) = run_text(NAN + CURVE + text).errors
    assert error.span.text in ("X", "XL", "X 0."), render(error, "en", ())
    assert error.code in (
        "out-of-range",
        "not-finite",
        "kernel.mesh.node-out-of-range",
        "operand-not-finite",
    )


@together("text", ["MESS X ;", "Z = MASQ XL 'EGSUPE' 1. ;", "LIST XL ;", "Z = EVOL 'MANU' XL XL ;"])
def test_what_came_of_a_division_by_zero_may_be_looked_at(text):
    ran(NAN + text)


RECORD = "EA = EVOL 'MANU' 'TEMP' (PROG 0. 'PAS' 0.01 2.) 'ACCE' (SIN (PROG 0. 'PAS' 20. 4000.)) ; "
BODY = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; L = DROI 2 (0. 0.) (2. 0.) ; S = L TRAN 1 (0. 1.) ; "
    "M = MODE S 'MECANIQUE' 'ELASTIQUE' ; A = MATE M 'YOUN' 1.E8 'NU' 0.3 'RHO' 2000. ; "
    "K = (RIGI M A) ET (BLOQ 'DEPL' L) ; MA = MASS M A ; "
)
MOTION = BODY + (
    "T = TABL ; T . 'RIGI' = K ; T . 'MASS' = MA ; T . 'CHAR' = CHAR 'MECA' (FORC (1. 0.) "
    "(S POIN 'PROC' (0. 1.))) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ; "
    "T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ; "
)
SOIL = (
    "OPTI DIME 3 ; T = TABL ; T . 'FORME' = 'DISQUE' ; T . 'RAYON' = 2. ; T . 'YOUNG' = 1.E8 ; "
    "T . 'POISSON' = 0.3 ; T . 'MASSE_VOLUMIQUE' = 2000. ; T . 'FREQUENCE' = 1. ; "
)
JOINT = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L1 = DROI 2 (0. 0.) (1. 0.) ; L2 = L1 PLUS (0. 0.) ; "
    "M = MODE (RACC 1.E-4 L1 L2) 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI2' ; "
)
BEARING = (
    "OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (0. 0.1) ; "
    "M = MODE L 'MECANIQUE' 'ELASTIQUE' 'APPUI_PLOMB' 'JOI1' ; "
)
PROBES = {
    BODY: """B = MATE M 'YOUN' 1.E8 'NU' 0.3 'RHO' -2. ;| B = MATE M 'YOUN' 1.E8 'NU' 0.7 ;
B = MATE M 'YOUN' -1. 'NU' 0.3 ;| C = MASS 'DEPL' -10. S ;
C = AMOR 'DEPL' -10. S ;| ELIM S -1.E-3 ;| D = DROI 0 (0. 0.) (1. 0.) ;
DENS -1. ;| B = VIBR 'SIMUL' 1. 0 K MA ;| B = VIBR 'SIMUL' 1. -2 K MA ;
B = VIBR 'SIMUL' -1. 2 K MA ;| B = VIBR 'SIMUL' 1. 2 K MA ; C = AMOR B (PROG -5. 5.) ;
SORT 'BILA' 'x' 1. 1. -0.1 ;| L1 = DROI (0. 0.) (1. 0.) 'DINI' -0.1 'DFIN' 0.2 ;
X = EGA 1. 2. -1. ;""",
    MOTION: """T . 'TEMPS_CALCULES' = PROG 0. 1. 0.5 ;| T . 'TEMPS_CALCULES' = PROG 0. ;
T . 'TEMPS_CALCULES' = PROG ;| T . 'RHO_INF' = 2. ;| T . 'ALPHA_F' = 0.9 ;| T . 'GAMMA' = 0.2 ;
T . 'GAMMA' = 0.5 ; T . 'BETA' = -1. ;| T . 'PAS_SAUVES' = 0 ;| T . 'REDUCTION' = -1. ;
T . 'CONTACT' = MOT 'PENALITE' ; T . 'COEFFICIENT' = -1. ;| T . 'TEMPS_SAUVES' = PROG 50. ;""",
    RECORD: """Z = SPO EA 'AMOR' (PROG 5.) 'FREQ' (PROG 1. 2.) ;
Z = SPO EA 'AMOR' (PROG 0.05) 'FREQ' (PROG -1. 2.) ;
Z = SPO EA 'AMOR' (PROG 0.05) 'FREQ' (PROG 0. 2.) ;| Z = TFR 0 EA ;| X = COMT EA 200. ;
Z = OSCI EA 'FREQ' 0. 'AMOR' 0.05 ;| Z = OSCI EA 'FREQ' 2. 'AMOR' -0.05 ;""",
    SOIL: """T . 'POISSON' = 0.6 ;| T . 'YOUNG' = 0. ;| T . 'RAYON' = -2. ;
T . 'AMORTISSEMENT' = 5. ;| T . 'AMORTISSEMENT' = 0.6 ;| T . 'ENFONCEMENT' = -1. ;""",
    JOINT: """A = MATE M 'KN' 0. 'KS' 1.E8 ;| A = MATE M 'KN' -1.E8 'KS' 1.E8 ;
A = MATE M 'KN' 1.E9 'KS' 1.E8 'FROT' 30. ;| A = MATE M 'KN' 1.E9 'KS' 1.E8 'FROT' -0.3 ;""",
    BEARING: """A = MATE M 'KN' 1.E9 'KS' 1.E7 'QD' -1. 'KPOS' 1.E6 ;
A = MATE M 'KN' 1.E9 'KS' 1.E7 'QD' 1. 'KPOS' 1.E8 ;
A = MATE M 'KN' 1.E9 'KS' 1.E7 'QD' 1. 'KPOS' 1.E6 'BETA' 0.2 ;""",
}
RUN = {MOTION: "R = DYNAMIC T ;", SOIL: "R = IMPEDSOL T ;"}


@together(
    "model, line",
    [
        (model, line.strip())
        for model, lines in PROBES.items()
        for line in lines.replace("\n", "|").split("|")
    ],
)
def test_senseless_numbers_are_told(model, line):
    result = run_text(model + line + RUN.get(model, ""))
    told = [*result.errors, *result.session.warnings]
    assert told
    value = result.errors[0] if result.errors else told[-1]
    said = render(value, "en", ())
    assert "object at" not in said
    assert "Traceback" not in said


@together("model", PROBES)
def test_the_models_themselves_are_told_nothing(model):
    result = ran(model + RUN.get(model, ""))
    assert not [w.code for w in result.session.warnings if "range" in w.code or "unusual" in w.code]


def test_no_message_shows_an_object():
    """Every type of the language is told by its word, wherever a sentence has it."""
    result = ran(
        MOTION + RECORD + "B = VIBR 'SIMUL' 1. 2 K MA ; U = RESO K (FORC (1. 0.) "
        "(S POIN 'PROC' (0. 1.))) ; LM = MOTS 'A' ; LE = LECT 1 2 ; LR = PROG 1. ; LC = SUIT U U ; "
        "DEBP PP X*FLOTTANT ; FINP X ; SI1 = SIGM M A U ; TX = TEXT 'A = 1' ; P = 0. 0. ;"
    )
    kinds = set()
    for value in result.session.root.variables.values():
        told = sentence("entry-value", {"procedure": value, "where": value, "given": value})
        assert "object at" not in told, told
        assert "array(" not in told, told
        kinds.add(type_of(value))
    assert {"TABLE", "MAILLAGE", "CHPOINT", "MCHAML", "MMODEL", "RIGIDITE", "EVOLUTIO"} <= kinds
