"""Checking without running: what it finds, and that it raises no false alarm."""

import io
import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from together import together

from ssilang.cli.check import check_file, check_source
from ssilang.cli.run import run_text
from ssilang.language.say.diagnostics import render
from ssilang.language.text.source import Source
from ssilang.language.text.source_files import read_source
from ssilang.operators.loader import load_operators

_ROOT = Path(__file__).resolve().parents[2]
_DECK = """OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ;
P1 = 0. 0. ; P2 = 1. 0. ; L1 = P1 DROI 4 P2 ; S1 = L1 TRAN 2 (0. 1.) ;
DEBP RATIO A*FLOTTANT B/FLOTTANT P*PROCEDUR ;
  SI (EXIS B) ; R = A / B ; SINON ; R = P A ; FINSI ;
FINP R ;
T1 = TABL ; T1 . 'LIST' = PROG 1. PAS 0.5 4. ; T2 = TEXT 'DIME' ;
REPE B1 (DIME T1 . 'LIST') ;
  X = EXTR T1 . 'LIST' &B1 ; N = T2 T1 . 'LIST' ; M = MOT 'PROG' ; V = M X ;
  SI (X > 2.) ; ITER B1 ; FINSI ;
  Y = (RATIO X 2.) + (X ** 2) ; MESS 'x = ' X*20 ' l''essai' N V Y ;
FIN B1 ;
"""

load_operators()


def codes(text: str) -> list[str]:
    problems, _ = check_source(Source("test", text))
    return [p.code for p in problems]


def errors(source: Source) -> list[str]:
    problems, names = check_source(source)
    return [render(p, "en", names) for p in problems if p.severity == "error"]


TEXTS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))["texts"]
ROWS = [
    (group.get("before", "") + text, code, group["how"])
    for group in TEXTS
    for text, code in group["rows"].items()
]


@together("text, code, how", ROWS, by=lambda row: row[1])
def test_it_is_told_of_what_it_should_be(text, code, how):
    problems, _ = check_source(Source("test", text))
    found = [p.code for p in problems]
    if how == "silent":
        assert code not in (*found, *(p.severity for p in problems))
    elif how == "among":
        assert code in found
    else:
        beside = "unused-name" if how == "but for names" else ""
        told = [(p.code, p.severity) for p in problems if p.code != beside]
        assert told == [(code, "warning")][: bool(code)]


def test_signs_in_an_order_that_is_no_other_language_s_are_noted_once():
    text = (
        "A = 3. ;\nX = 1. + A * 0.5 ;\nY = PROG (A - (X / 2.) / A) ((A * X) ** 2) ;\n"
        "SI (X > (A * X ** 2)) ; MESS X ; FINSI ;\nMESS (A * X / 2. + 1.) Y (X + (A * 2.)) ;\n"
    )
    (note,), _ = check_source(Source("test", text))
    assert (note.code, note.severity, note.span.text) == ("left-to-right", "note", "1. + A * 0.5")
    assert note.data["places"] == [
        "1. + A * 0.5 = (1. + A) * 0.5 (2)",
        "A - (X / 2.) / A = (A - (X / 2.)) / A (3)",
        "A * X ** 2 = (A * X) ** 2 (4)",
    ]
    assert "note: operations go from left to right: 1. + A" in render(note)
    assert "remarque : les opérations vont de gauche à droite : 1. + A" in render(note, "fr")


STALE = "A = MATE M 'KN' 1. ; K = RIGI M A ; MESS K ; "


@pytest.mark.parametrize(
    ("text", "name"),
    [
        (STALE + "A = MATE M 'KN' 2. ; MESS K ;", "A"),
        (
            STALE + "T = TABL ; T . 'A' = A ; REPE B 3 ; A = MATE M 'KN' 2. ; DYNAMIC T ; FIN B ;",
            "A",
        ),
        (STALE + "SI (EGA X 1) ; K = RIGI M A ; FINSI ;", "K"),
        (STALE + "B = VIBR K ; K = K ET (APPU 'UX' 1. P) ; MESS B ;", "K"),
        (STALE + "K = (RIGI M A) ET (BLOQ 'UX' P) ;", "K"),
        (
            "E = LIRE 'PEER' 'a' ; C = CHAR F E ; REPE B 2 ; E = LIRE 'PEER' 'b' ; FIN B ;",
            "E",
        ),
    ],
)
def test_what_is_given_anew_and_not_used_is_told_where_it_is_given(text, name):
    (found,) = [e for e in check_source(Source("test", text))[0] if e.code == "stale-name"]
    assert found.span.text == name
    assert text[: found.span.start].count(f"{name} = ") == 1


@pytest.mark.parametrize(
    ("text", "wrong", "meant"),
    [
        ("H = 2. ; V = 3. * H ** 1. / 2. ; MESS V ;", "H ** 1.", "H ** (1. / 2.)"),
        ("Z = 2. ; E = 9. * 1. + (Z / 10.) ; MESS E ;", "9. * 1.", "9. * (1. + (Z / 10.))"),
    ],
)
def test_a_one_that_belongs_to_what_follows_is_noted(text, wrong, meant):
    (note,) = [p for p in check_source(Source("test", text))[0] if p.code != "left-to-right"]
    assert (note.code, note.severity) == ("one-changes-nothing", "note")
    assert (note.data["wrong"], note.data["meant"]) == (wrong, meant)


@pytest.mark.parametrize("given", ["SI (Y > 0.) ; {} FINSI ;", "SI (X > 0.) ; FINSI ; {}", "{}"])
def test_values_known_where_no_condition_asks_for_them_are_checked(given):
    entry = given.format("T . 'REDUCTION' = X ;")
    assert "entry-out-of-range" in codes(f"X = 0. ; Y = 1. ; T = TABL ; {entry} DYNAMIC T ;")


def test_several_errors_in_one_pass():
    found = codes("X = PORG 1. ;\nY = 1 + VRAI ;\nSI 3 ; MESS X Y ; FINSI ;\nZ = -Y ; MESS Z ;\n")
    assert found == ["unknown-operator", "no-rule", "condition", "two-operands"]


@together(
    "text, severities",
    [
        ("SI (Y > 0.) ; T = TABL ; SINON ; T . 1 = 2 ; T . 2 = 3 ; FINSI ;", ["warning"]),
        ("SI (Y > 0.) ; SI VRAI ; X = ABS T ; FINSI ; FINSI ; T = 3. ;", ["warning"]),
        ("SI (Y > 0.) ; REPE B T ; MESS 1 ; FIN B ; SINON ; T = 3 ; FINSI ;", ["warning"]),
        ("SI FAUX ; T . 1 = 2 ; X = PORG 1. ; FINSI ; T = TABL ;", ["warning", "warning"]),
        ("SI VRAI ; MESS 1 ; SINON ; X = ABS T ; FINSI ; T = 3. ;", ["warning"]),
        # these are errors of any run, or no name of another branch
        ("SI VRAI ; T . 1 = 2 ; FINSI ; T = TABL ;", ["error"]),
        ("SI FAUX ; T = TABL ; SINON ; T . 1 = 2 ; FINSI ;", ["error"]),
        ("T . 1 = 2 ; SI (Y > 0.) ; T = TABL ; FINSI ;", ["error"]),
        ("SI (Y > 0.) ; X = PORG 1. ; FINSI ;", ["error"]),
        ("SI (Y > 0.) ; ABRA . 1 = 2 ; FINSI ;", ["error"]),
    ],
)
def test_a_name_of_another_branch_is_an_error_where_all_runs_read_it(text, severities):
    problems, _ = check_source(Source("test", f"Y = 1. ; {text}"))
    assert [p.severity for p in problems if p.code != "unused-name"] == severities
    told = [render(p, "en", ()) for p in problems if p.severity == "warning"]
    assert all("takes this branch" in w for w in told if "gets a value" not in w)


def test_an_operator_out_of_scope_is_named_with_its_subject():
    (message,) = errors(Source("test", "X = CAPA 1. 2. ; MESS X ;"))
    assert "CAPA is a Cast3M operator (heat), out of ssilang's scope" in message


@pytest.mark.parametrize("names", [("CO2", "CO3"), ("BAR", "JOI")])
def test_a_name_that_a_keyword_takes_as_it_is_is_not_near_another(names):
    made = [f"M{i} = MODE S 'MECANIQUE' 'ELASTIQUE' CONS {n} ;" for i, n in enumerate(names)]
    assert "near-word" not in codes(f"DEBP P S ; {' '.join(made)} FINP M0 M1 ; X Y = P 1 ;")
    assert "near-word" in codes("OPTI ELME SEG2 ;")


_UNKNOWN = (
    "OPTI DIME 2 ; T = TABL ; T . 1 = 3. ; T . 2 = MOT 'DIME' ; A = 2. ; N = 2 ; W = MOT 'FOO' ; "
    "E = TEXT '1. 2.' ; F = TEXT '+ 1.' ; L = PROG 1. 2. ; "
)
_EITHER = "SI VRAI ; OPTI DIME 2 ; SINO ; OPTI DIME 3 ; FINS ; "


@together(
    "phrase, code",
    [
        *((phrase, "unknown-operator") for phrase in (
            "X = FOO T . 1", "X = 'FOO' T . 1", "X = FOO E", "X = FOO F", "X = FOO (T . 2 L)",
            "X = (EXTR L 1) FOO T . 1", "X = COOR 1 (FOO T . 1)", "SI (FOO T . 1) ; FINS",
            "X = P T . 1", "X = 'FOO' 1. 2.", "X = (1. 2.) FOO", "X = (A + 1.) FOO",
        )),
        *((phrase, "excess") for phrase in (
            "X = 1. 2. 3.", "X = (1. 2.) 3.", "X = 2. W", "X = VRAI 2.", "X = COOR 1 (1. 2. 3.)",
            f"{_EITHER} X = 1. 2. 3. 4.", "OPTI DIME 3 ; X = 1. 2. 3. 4.", "X = W W W",
        )),
        *((phrase, "") for phrase in (
            "X Y = W T . 1", "X Y Z = W FOO T . 1", "X Y = (T . 2 L) FOO", "X = T . 2 L", "X = E",
            "X = T . 1", "X = T . 1 T . 1", "X = (A + 1.) N", "X = (A + 1.) T . 1", "X = 2. F",
            "X Y = VRAI 2.",
            "X Y = A N ; Z = X + Y", "X = 1. 2. ; Y = COOR 2 X", "X = COOR 1 (T . 1 T . 1)",
            f"{_EITHER} X = 1. 2. ; Y = COOR 1 X", f"{_EITHER} X Y = 1. 2. ; Z = X + Y",
            "OPTI DIME 3 ; X Y = 1. 2. ; Z = X + Y", "OPTI DIME 3 ; X = 1. 2. 3. ; Y = COOR 3 X",
        )),
        ("SI (1. 2.) ; FINS", "condition"), ("X = COOR 1 (1.)", "wrong-argument"),
        ("OPTI DIME 3 ; X = A N", "third-coordinate"), ("X Y = 3.", "no-result"),
    ],
)  # fmt: skip
def test_what_a_phrase_leaves_is_judged_as_by_a_run(phrase, code):
    text = f"{_UNKNOWN}{phrase} ;"
    problems, _ = check_source(Source("test", text))
    done = run_text(text)
    for told in (problems, done.errors):
        assert [p.code for p in told if p.severity == "error"] == [code][: bool(code)]
    assert done.exit_code == bool(code)


_BODY = "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = (DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ; "


@together(
    "text, code, place",
    [
        ("M = MODE S THERMIQUE ;", "operators.models.formulation-not-available", "THERMIQUE"),
        ("M = MODE S 'POREUX' ;", "operators.models.formulation-not-available", "'POREUX'"),
        ("M = MODE S MECANIQUE ELASTIQUE ENDOMMAGEMENT RICRAG ;",
         "operators.models.behaviour-not-available", "RICRAG"),
        ("M = MODE S LIAISON PROFIL_PROFIL EXTERIEUR ;",
         "operators.models.link-not-available", "PROFIL_PROFIL"),
        ("M = MODE S MECANIQUE ELASTIQUE PLASTIQUE PARFAIT BAEX ;",
         "operators.models.element-not-built", "BAEX"),
        ("M = MODE L MECANIQUE ELASTIQUE PLASTIQUE DRUCKER_PARFAIT POUT ;",
         "kernel.materials.sections-no-plastic", "MODE"),
        ("T . 'LAGRANGIEN' = MOT 'JADIS' ; PASAPAS T ;", "entry-value", "T . 'LAGRANGIEN'"),
    ],
)  # fmt: skip
def test_finds_what_a_run_refuses_of_a_model(text, code, place):
    text = _BODY + "L = DROI 1 (0. 0.) (1. 0.) ; M = 0 ; T = TABL ; " + text + " LIST M ; LIST L ;"
    found = [p for p in check_source(Source("test", text))[0] if p.severity == "error"]
    assert [(p.code, p.span.text) for p in found] == [(code, place)]


@together(
    "path",
    sorted(_ROOT.glob("cases/**/*.ssi")) + sorted(_ROOT.glob("stdlib/*.ssi")),
    by=lambda p: p.parent.name,
)
def test_sound_decks_pass(path):
    assert errors(read_source(path)) == []


_WORDS = "PROG DIME DROI A B T P1 'X' ( ) ; = . % + - * EGA ET SI FINSI REPE FIN QUIT 1 2. VRAI"
_PIECES = st.sampled_from(_WORDS.split())


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_any_mutation_of_a_deck_is_checked(data):
    text = _DECK
    for _ in range(data.draw(st.integers(1, 6))):
        at = data.draw(st.integers(0, len(text)))
        drop = data.draw(st.integers(0, 6))
        text = f"{text[:at]} {data.draw(_PIECES)} {text[at + drop :]}"
    for problem in check_source(Source("test", text))[0]:
        assert render(problem, "en")
        assert render(problem, "fr")


@together(
    "entry, near",
    [
        ("T1 . 'CHARGEMENT' = 1 ;", "CHAR"),
        ("T1 . 'CHARGEMENT' = 1 ; MESS (T1 . 'CHARGEMENT') ;", ""),
        ("T1 . 'RIGI' = 1 ;", ""),
        ("T1 . 'CHARGEMENT' = 1 ; T1 = TABL ; T1 . 'RIGI' = 1 ;", ""),
    ],
)
def test_entries_that_the_procedure_does_not_have_are_shown_where_they_are_written(entry, near):
    source = Source("script", f"T1 = TABL ; {entry} T2 = DYNAMIC T1 ; LIST T2 ;")
    problems, _ = check_source(source)
    found = [p for p in problems if p.code in ("entry-unknown", "entry-of-another")]
    assert [p.data["near"] for p in found] == ([near] if near else [])
    assert [p.span.text for p in found] == (["T1 . 'CHARGEMENT'"] if near else [])


@together(
    "script, code, place",
    [
        ("T1 . 'RIGI' = 1 ; T2 = DYNAMIC T1 ; LIST T2 ;", "entry-type", "T1 . 'RIGI'"),
        ("T1 . 'TEMPS_CALCULES' = 3. ; T2 = DYNAMIC T1 ; LIST T2 ;", "entry-type",
         "T1 . 'TEMPS_CALCULES'"),
        ("T1 . 'FORME' = 'RECTANGEL' ; T3 = COPI T1 ; T2 = @PASSAGE T3 ; LIST T2 ;",
         "entry-value-near", "T1 . 'FORME'"),
        ("T1 . 'DEMI_LONGEUR' = 3. ; T3 = COPI T1 ; LIST (@PASSAGE T3) ;", "entry-unknown",
         "T1 . 'DEMI_LONGEUR'"),
        ("T1 . 'GRANDS_DEPLACEMENTS' = 'VRAI' ; PASAPAS T1 ;", "word-of-truth",
         "T1 . 'GRANDS_DEPLACEMENTS'"),
    ],
)  # fmt: skip
def test_values_that_a_procedure_refuses_are_shown_where_they_are_given(script, code, place):
    problems, _ = check_source(Source("script", "T1 = TABL ; " + script))
    assert [(p.code, p.span.text) for p in problems] == [(code, place)]
    if problems[0].severity == "error":
        assert [e.code for e in run_text("T1 = TABL ; " + script).errors] == [code]


@together("value", ["1", "(1 + 1)", "2.5", "X0"])
def test_values_that_fit_an_entry_are_not_refused(value):
    script = f"X0 = EXTR (PROG 1.) 1 ; T1 = TABL ; T1 . 'ALPHA_F' = {value} ; T2 = DYNAMIC T1 ;"
    problems, _ = check_source(Source("script", script + " LIST T2 X0 ;"))
    assert problems == []


def test_names_that_nothing_reads_are_told_together_where_a_person_reads():
    def said(text: str) -> str:
        out = io.StringIO()
        assert not check_file(Source("test", text), False, "en", out)
        return out.getvalue()

    several = said("B = 1 ;\nMESS 'x' ;\nA = 2 ;\nC D = 3 4 ;\nMESS D ;\nA = 5 ;")
    assert several.count("warning") == 1
    assert "names get values that nothing reads: B (1), A (3)" in several
    assert "X gets a value that nothing reads" in said("X = 1 ;")


@pytest.mark.parametrize("depth", [300, 3_000, 50_000])
def test_any_depth_of_parentheses_is_answered(depth):
    told = codes(f"X = {'(' * depth}1{')' * depth} ; MESS X ;")
    assert told in ([], ["nesting"] if depth > 300 else [])
