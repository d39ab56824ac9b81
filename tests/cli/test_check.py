"""Checking without running: what it finds, and that it raises no false alarm."""

import io
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


@together(
    "text, code",
    [
        ("X = PORG 1. 2. ; MESS X ;", "unknown-operator"),
        ("X = (PORG 1. 2.) ; MESS X ;", "unknown-operator"),
        ("T = TABL ; T . 'A' = PORG 1. 2. ;", "unknown-operator"),
        ("SI (PORG 1. 2.) ; FINSI ;", "unknown-operator"),
        ("DEBP P A*ENTIER ; B = PORG A ; FINP B ; X = P 1 ; MESS X ;", "unknown-operator"),
        ("X = 1 + VRAI ; MESS X ;", "no-rule"),
        ("OPTI DIME 2 ; P = 0. 0. ; B = BLOQ 'UX' P ; N = NBEL B ; MESS N ;", "wrong-argument"),
        ("OPTI DIME 2 ; P = 0. 0. ; B = SYMT 'DEPL' P ; MESS B ;", "missing-argument"),
        ("X = 1. + ; MESS X ;", "two-operands"),
        ("A = 2. ; X = -A ; MESS X ;", "two-operands"),
        ("A = 2 ; X = A -1 ; MESS X ;", "glued-sign"),
        ("X = A + 1 ; MESS X ;", "unknown-operator"),
        ("X = A + 1 ; A = 2 ; MESS X ;", "set-later"),
        ("T . 'A' = 1 ;", "undefined-table"),
        ("T = 3 ; X = T . 1 ; MESS X ;", "not-a-table"),
        ("SI 3 ; FINSI ;", "condition"),
        ("SI ; FINSI ;", "condition"),
        ("SI () ; FINSI ;", "condition"),
        ("REPE B MANY ; FIN B ;", "undefined-name"),
        ("REPE B VRAI ; FIN B ;", "loop-count"),
        ("REPE B 2 ; QUIT C1 ; FIN B ;", "no-such-loop"),
        ("REPE B 2 ; ITER C1 ; FIN B ;", "no-such-loop"),
        ("A B = 1 + 2 ; MESS A B ;", "no-result"),
        ("A = 1. 2. 3. 4. ; MESS A ;", "excess"),
        ("OPTI DIME 3 ; P = 1. 2. ; MESS (TYPE P) ;", "third-coordinate"),
        ("DEBP P A*ENTIER ; FINP A ; X = P 'B' ; MESS X ;", "missing-parameter"),
        ("DEBP P A*ENTIER ; FINP A ; X = P ; MESS X ;", "missing-parameter"),
        ("SI VRAI ; X = 1 ;", "unclosed-block"),
        ("X = (1 + 2 ;", "unclosed-paren"),
        ("X = FLUX 1 2 ; MESS X ;", "unknown-operator"),
        ("L = PROG 1. ; X = FLUX (L ET L) ; MESS X ;", "unknown-operator"),
        ("L = PROG 1. ; K = L ET 2. ; X = FLUX K ; MESS X ;", "unknown-operator"),
        ("L = PROG 1. ; X = L ET (FLUX 'DEPL' L) ; MESS X ;", "unknown-operator"),
        ("L = PROG 1. ; X = L ET FLUX (L ET L) ; MESS X ;", "unknown-operator"),
        ("L = PROG 1. ; X = (L ET L) FLUX 'DEPL' ; MESS X ;", "unknown-operator"),
        ("FLUX 1 ;", "unknown-operator"),
        ("L = MOTS 'UX' ; M = EXTR L 1 ; X = M EGA 'UX' ; MESS X ;", "unread-operator"),
        ("L = MOTS 'UX' ; X = EXTR L 1 EGA 'UX' ; MESS X ;", "unread-operator"),
        ("SI FOO ; FINSI ;", "unknown-operator"),
        ("X = ((ABSENT ET 1) . 'A') ; MESS X ;", "unread-operator"),
    ],
)
def test_finds(text, code):
    assert code in codes(text)


@together(
    "text, code",
    [
        ("X = 1 / 2 ; MESS X ;", "integer-division"),
        ("N = 7 ; X = N / 2 ; MESS X ;", "integer-division"),
        ("X = 1 ;", "unused-name"),
        ("T = TABL ; T . 'A' = TABL ; T . 'A' . 1 = 2 ;", "unused-name"),
        ("X = FLUX 1. ; X = 2 ; MESS X ;", "not-built-yet"),
        ("DENS = 0.1 ; MESS DENS ;", "shadowed-operator"),
        ("LENGTH = 3. ; X = PROG LENGTH LENGHT ; MESS X ;", "perhaps-misspelt"),
        ("LENGTH = 3. ; X = MOTS LENGHT 'MANU' ; MESS LENGTH X ;", "perhaps-misspelt"),
        ("DEBP PROG A ; MESS A ; FINP ; PROG 1. ;", "shadowed-operator"),
        ("DEBP @VERIFIE ; FINP ;", "overrides-procedure"),
        ("DEBP P X Y ; Z = MATE X SORT Y YOUM 2. ; FINP Z ; A = P 1 2 ; MESS A ;", "near-word"),
    ],
)
def test_warns(text, code):
    problems, _ = check_source(Source("test", text))
    assert [p.code for p in problems] == [code]
    assert problems[0].severity == "warning"


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
    ],
)
def test_what_is_given_anew_and_not_used_is_told_where_it_is_given(text, name):
    (found,) = [e for e in check_source(Source("test", text))[0] if e.code == "stale-name"]
    assert found.span.text == name
    assert text[: found.span.start].count(f"{name} = ") == 1


CALLED = "T = TABL ; T . 'CHARGEMENT' = C ; PASAPAS T ; "


@together(
    "text, told",
    [
        (CALLED + "T . 'CHARGEMENT' = (T . 'CHARGEMENT') ET D ; MESS (T . 'TEMPS' . 1) ;", True),
        (CALLED + "T . 'TEMPS_CALCULES' = L ; PASAPAS T ;", False),
        (CALLED + "REPE B 2 ; T . 'CHARGEMENT' = D ; PASAPAS T ; FIN B ;", False),
        (CALLED + "T . 'CHARGEMENT' = D ; MESS (T . 'CHARGEMENT') ;", False),
        (CALLED + "T . 'CHARGEMENT' = D ; U = COPI T ; PASAPAS U ;", False),
        (CALLED + "T . 'CHARGEMENT' = D ; SAUV ;", False),
        (CALLED + "T . 'MY_OWN' = 3 ;", False),
        ("DEBP RUNS ; PASAPAS T ; FINP ; " + CALLED + "T . 'CHARGEMENT' = D ; RUNS ;", False),
    ],
)
def test_an_entry_that_comes_behind_the_call_it_is_for_is_told(text, told):
    assert ("entry-behind-call" in codes(text)) == told


@together(
    "text, told",
    [
        ("T . 'RIGI' = K ; T . 'MASS' = M ; T . 'RIGI' = K ET B ;", True),
        ("T . 'RIGI' = K ; T . 'RIGI' = (T . 'RIGI') ET B ;", False),
        ("T . 'RIGI' = K ; DYNAMIC T ; T . 'RIGI' = K ET B ;", False),
        ("T . 'RIGI' = K ; T = TABL ; T . 'RIGI' = K ET B ;", False),
        ("T . 'RIGI' = K ; SI X ; T . 'RIGI' = B ; FINSI ;", False),
        ("T . 'RIGI' = K ; REPE B 2 ; T . 'RIGI' = B ; DYNAMIC T ; FIN B ;", False),
        ("U = T ; T . 'RIGI' = K ; DYNAMIC U ; T . 'RIGI' = B ;", False),
        ("DEBP RUNS ; PASAPAS T ; FINP ; T . 'RIGI' = K ; RUNS ; T . 'RIGI' = B ;", False),
    ],
)
def test_an_entry_that_is_set_twice_and_not_read_between_is_told(text, told):
    assert ("entry-twice" in codes("T = TABL ; " + text)) == told


@together(
    "text",
    [
        STALE + "A = MATE M 'KN' 2. ; K = RIGI M A ; MESS K ;",
        STALE + "REPE B 3 ; K = RIGI M A ; A = MATE M 'KN' 2. ; MESS K ; FIN B ;",
        STALE + "A = MATE M 'KN' 2. ; MESS 'the last of A' ;",
        STALE + "A = MATE M 'KN' 2. ; LIST ;",
        STALE + "DEBP USES X*MAILLAGE ; A = MATE X 'KN' 2. ; B = RIGI X A ; FINP B ; MESS A ;",
        STALE + "I = 1 ; MESS I ; I = 2 ;",
        STALE + "K = K ET (APPU 'UX' 1. P) ; MESS K ;",
        STALE + "L = K ET K ; MESS L ; L = (PROG 1.) ET L ;",
        "DEBP USES ; U = RESO K F ; FINP U ; " + STALE + "X = USES ; K = RIGI M A ; MESS X USES ;",
    ],
)
def test_what_is_given_anew_and_used_is_not_told(text):
    assert "stale-name" not in codes(text)


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


CONES = "OPTI DIME 2 ; P = 0. 0. ; K = TABL ; K . 'UX' = 2. ; K . 'UY' = 3. ; K . 'RZ' = 4. ; "
SOIL = CONES + "M = MODE (MANU 'POI1' P) 'MECANIQUE' ; G0 = 1.E8 ; "
TURNED = CONES.replace("DIME 2", "DIME 3").replace("0. 0.", "0. 0. 0.")


@together(
    "text, code",
    [
        (CONES + "MESS (APPU 'UX' (K . 'UY') P) ;", "spring-of-another"),
        (CONES + "MESS ((AMOR 'UY' K . 'UY' P) ET (AMOR 'RZ' K . 'UX' P)) ;", "spring-of-another"),
        (TURNED + "MESS (APPU 'UZ' (K . 'UX') P) ;", "spring-of-another"),
        (SOIL + "MESS (MATE M 'NU' 0.3 'YOUN' G0) ;", "shear-for-young"),
        (SOIL + "MESS (MATE M 'NU' 0.3 'YOUN' (2.6 * G0)) ;", ""),
        (CONES + "K . 'FREQUENCE' = 2. * PI * 1.5 ; MESS K ;", "pulsation-for-frequency"),
        (CONES + "K . 'FREQUENCES' = PI * 2 * (PROG 1. 2.) ; MESS K ;", "pulsation-for-frequency"),
        (CONES + "MESS (APPU 'UX' (K . 'UX') P) ; C = AMOR 'UX' 'RZ' (K . 'UX') P ; MESS C ;", ""),
        (CONES + "MESS (APPU 'UX' (2. * (K . 'UY')) P) ;", ""),
        (CONES + "I = 'UY' ; MESS (APPU 'UX' (K . I) P) ;", ""),
        (TURNED + "MESS ((APPU 'UX' (K . 'UY') P) ET (APPU 'UY' (K . 'UX') P)) ;", ""),
        (CONES + "W = 9. ; K . 'FREQUENCE' = W / (2. * PI) ; MESS K ;", ""),
        (CONES + "K . 'PULSATION' = 2. * PI * 1.5 ; K . 'FREQUENCE' = 1.5 ; MESS K ;", ""),
        (CONES + "W = 2. * PI * 1.5 ; K . 'FREQUENCES' = (2. * PI * W) / 39.478 ; MESS K ;", ""),
    ],
)  # fmt: skip
def test_springs_by_the_number_of_another_way_and_pulsations_are_told(text, code):
    found = [p.code for p in check_source(Source("test", text))[0]]
    assert {*found} - {"left-to-right", "unused-name"} == {*([code] if code else [])}


@together(
    "text",
    [
        "X = 2. ** 1.5 / 2. ; MESS X ;",
        "X = 3. * 1. ; MESS X ;",
        "X = 1. * 3. + 2. ; MESS X ;",
        "X = 3. * 1. / 2. ; MESS X ;",
        "CHARGE = 3. ; MESS CHARGE ;",
        "ECOU = 3. ; MESS ECOU ;",
    ],
)
def test_a_one_by_itself_and_operators_that_nothing_calls_for_names_are_not_told(text):
    assert not [p for p in check_source(Source("test", text))[0] if p.code != "left-to-right"]


@pytest.mark.parametrize(
    "text", ["X = RELA 1. 'UX' P - 2. 'UX' Q * 3. ;", "X = 2. * 3. + 4. ;", "X = 1. - 2. + 3. ;"]
)
def test_signs_in_the_order_of_other_languages_are_not_noted(text):
    assert "left-to-right" not in codes(text)


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


@together(
    "text",
    [
        "X = ABRACADABRA ; MESS X ;",
        "T = TABL ; T . FOO = 1 ; MESS T . FOO ;",
        "DEBP P A*ENTIER ; B = A + GLOBAL ; FINP B ; GLOBAL = 2 ; X = P 1 ; MESS X ;",
        "REPE B 3 ; SI (&B > 1) ; X = X + 1 ; SINON ; X = 0 ; FINSI ; FIN B ; MESS X ;",
        "L = PROG 1. ; SI VRAI ; MESS 1 ; SINON ; X = 2. * L ; FINSI ; Y = X * L ; LIST Y ;",
        "OPTI 'ACQU' 'f' ; ACQU N*ENTIER ; X = N + 1 ; MESS X ;",
        "REST ; X = RESTORED + 1 ; MESS X ;",
        "FIN ; X = PORG 1. ;",
        "REST ; P = 0. -1.E6 0. ; MESS P ;",
        "OPTION DIMENSION 3 ; P = 0. -1.E6 0. ; MESS (TYPE P) ;",
        "NOMM 'ABC' 3 ; X = ABC + 1 ; MESS X ;",
        "T = TEXT '1 + 2' ; X = T * 3 ; MESS X ;",
        "T = TEXT 'A = 3 + 4' ; T ; MESS (A + 1) ;",
        "M = MOT 'PROG' ; X = M 1. 2. ; MESS X ;",
        "OPTI DIME 2 ; P = 1. 2. ; Q = P PLUS (1. 0.) ; MESS (COOR 1 Q) ;",
        "T = TABL ; T . 1 = MOT 'X' ; Y = T . 1 3 ; MESS Y ;",
        "T = TEXT '1 +' ; X = (T 3) ; MESS X ;",
        "T = TABL ; T . 1 = TEXT '1 +' ; X = (T . 1 3) ; MESS X ;",
        "X Y = MAXI (EVOL 'MANU' (PROG 1. 2.) (PROG 1. 2.)) ; MESS X Y ;",
        "DEBP P A/ENTIER ; B = 0 ; SI (EXIS A) ; B = A + 1 ; FINSI ; FINP B ; X = P ; MESS X ;",
        "DEBP P ; ARGU A*ENTIER ; FINP A ; X = P 3 ; MESS X ;",
        "I = 7 ; J = 2 ; K = I * 2 / J ; MESS K ;",
        "REPE BLOC1 3 ; SI (&BLOC1 > 1) ; QUIT BLOC1 ; FINSI ; FIN BLOC1 ;",
        "DEBP P X Y ; Z = MATE X 'YOUNG' Y 'ALPHA' 1. 'CREF' 2. ; FINP Z ; A = P 1 2 ; MESS A ;",
        "DEBP P A*ENTIER ; SI (A EGA 2) ; QUIT B ; FINSI ; FINP ; REPE B 4 ; P &B ; FIN B ;",
        "REPE B 4 ; REPE C 2 ; SI (&C EGA 2) ; quit B ; FINSI ; FIN C ; FIN B ;",
        "L = MOTS 'CARA' 'YUON' ; MESS L (MOTS MATE YUON) ;",
        "DEBP AUTOPILO A*CHPOINT ; FINP 1. ;",
        "L = (MOT 'A') ET 'B' ; M = L ET (MOTS 'C') ; MESS (M 'ET' L) ;",
        f"X = {'(' * 300}1{')' * 300} ; MESS X ;",
        "X = 0. ; T = TABL ; SI (X > 0.) ; T . 'REDUCTION' = X ; FINSI ; DYNAMIC T ;",
        "REPE B 2 ; SI (&B EGA 2) ; Y = XYZ + 1. ; MESS Y ; FINSI ; REST ; FIN B ;",
    ],
)
def test_raises_no_false_alarm(text):
    assert errors(Source("test", text)) == []


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
_MODEL = "MO = MODE S MECANIQUE ELASTIQUE ; "
_CURVE = "(PROG 1. 2.) {} (PROG 3. 4.) ; LIST E ; "


@together(
    "text",
    [
        _MODEL + "YOUN1 = 2. ; ALPH1 = 1. ; A = MATE MO YOUNG YOUN1 NU 0. ALPHA ALPH1 ; LIST A ;",
        "EIX1 = 3. ; MESS EIX1 ; F = 1. ; E = EVOL MANU EIXX " + _CURVE.format("ALPHA"),
        "DUREE = 1. ; MESS DUREE ; E = EVOL ROUG MANU DUREX " + _CURVE.format("EPSIL"),
        "E = EVOL MANU UXX " + _CURVE.format("FXX"),
        "U = MANU CHML S EIXX 1. GIXY 2. ; LIST U ;",
        "ROSE1 = 1. ; MESS ROSE1 ; T = S COUL ROSE ; LIST T ; OPTI COUL VERT ;",
        "OPTI MODE PLAN GENE ; B = BLOQ RX UZ RY (S POIN 1) ; LIST B ;",
        "NOTRON = 3. ; L = MOTS NORTON ; MESS L NOTRON ;",
    ],
)
def test_words_of_operators_are_no_misspelt_names(text):
    problems, _ = check_source(Source("test", _BODY + text))
    assert [p.code for p in problems if p.code != "unused-name"] == []


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


@pytest.mark.parametrize("depth", [3_000, 50_000])
def test_any_depth_of_parentheses_is_answered(depth):
    assert codes(f"X = {'(' * depth}1{')' * depth} ; MESS X ;") in ([], ["nesting"])
