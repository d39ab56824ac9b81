"""Two cubes with contact between their sides; CONSERVATIF, duals, adapted steps, plastic bodies."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
from ssilang.language.say.diagnostics import sentence

# a rigid block on two stops, tilted, its weight pulling it back: rocks for ever
BLOCK = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; PC = 0. 0. ;
R = (BLOQ 'UX' PC) ET (RELA 'MINI' 'UY' PC + 1.5 'RZ' PC) ET (RELA 'MINI' 'UY' PC - 1.5 'RZ' PC) ;
T = TABL ; T . 'RIGI' = R ; T . 'MASS' = (MASS 'DEPL' 1.E5 PC) ET (MASS 'ROTA' 8.E5 PC) ;
T . 'DEPL' = (MANU 'CHPO' PC 1 'UY' 0.015) ET (MANU 'CHPO' PC 1 'RZ' 0.01) ;
T . 'CHAR' = CHAR 'MECA' (FORC (0. -9.81E5) PC) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 2.E-3 3. ; T . 'CONSERVATIF' = VRAI ;
"""
END = """ T2 = DYNAMIC T ; LE = T . 'ENERGIES' . 'ECART' ; LC = T . 'ENERGIES' . 'CINETIQUE' ;
LTH = EXTR (EVOL 'TEMP' T2 'DEPL' 'RZ' PC) 'ORDO' ; """


@pytest.mark.parametrize("method", ["LAGRANGE", "AUGMENTE", "UZAWA", "PENALITE"])
def test_a_rocking_block_keeps_its_energy_whatever_the_method(found, method):
    extra = f"T . 'CONTACT' = MOT '{method}' ; T . 'COEFFICIENT' = 1.E9 ; "
    if method == "UZAWA":
        extra = "T . 'CONTACT' = MOT 'UZAWA' ; "
    gap, kinetic, theta = found(BLOCK + extra + END, "LE", "LC", "LTH")
    assert np.abs(gap.values).max() <= 1e-10 * kinetic.values.max()
    assert np.abs(theta.values).max() <= 0.0100001
    assert (theta.values < -1e-3).any()
    assert (theta.values > 1e-3).any()


@pytest.mark.parametrize(
    ("entry", "warned"), [("", False), ("FAUX", False), ("VRAI", True), ("MOT 'RIGIDITE'", True)]
)
def test_a_velocity_correction_beside_it_has_no_effect_and_is_warned_of(entry, warned):
    text = BLOCK.replace("2.E-3 3.", "1.E-3 0.1") + (
        f"T . 'VITEUNIL' = {entry} ; " if entry else ""
    )
    result = ran(text + END)
    said = " ".join(sentence(w, "en")[0] for w in result.session.warnings)
    assert ("'VITEUNIL' has no effect" in said) is warned


@together(
    "entries, told",
    [
        ("", False),
        ("T . 'CONSERVATIF' = VRAI ; ", False),
        ("T . 'VITEUNIL' = FAUX ; ", True),
        ("T . 'CONTACT' = MOT 'PENALITE' ; T . 'COEFFICIENT' = 1.E9 ; ", True),
    ],
)
def test_energy_that_impacts_create_is_told_in_every_method(entries, told):
    """The block gains more than it had: measured by what it was given, not by its later fall."""
    text = BLOCK.replace("T . 'CONSERVATIF' = VRAI ;", entries).replace("2.E-3 3.", "1.E-2 3.")
    result = run_text(text + END)
    codes = [w.code for w in result.session.warnings]
    assert ("operators.dynamics.impacts-change-energy" in codes) is told, codes
    share = result.session.statistics["calculations"][0]["energy_imbalance"]
    assert (share > 0.3) is told


@pytest.mark.parametrize("stiffness", [4.0e6, 1.0e6])
def test_the_energy_that_a_run_closes_with_is_what_impacts_leave(stiffness):
    """A mass that a record drives against a stop: off for single steps, and back behind them."""
    result = run_text(
        "OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; P = 0. 0. ; "
        f"K = APPU 'UX' {stiffness} P ; MS = MASS 'DEPL' 1.E5 P ; STOP = BLOQ 'UX' 'MAXI' P ; "
        "T = TABL ; T . 'RIGI' = K ET STOP ET (BLOQ 'UY' P) ; T . 'MASS' = MS ; "
        "T . 'AMOR' = 0.6 * MS ; LT = PROG 0. PAS 0.005 8. ; "
        "LA = 2. * LT * (EXP (-0.5 * LT)) * (SIN (396. * LT)) ; "
        "T . 'CHAR' = (CHAR 'DIMP' (DEPI STOP 0.02) (EVOL 'MANU' (PROG 0. 99.) (PROG 1. 1.))) ET "
        "(CHAR 'MECA' (MS * (MANU 'CHPO' P 1 'UX' -1.)) (EVOL 'MANU' 'TEMP' LT 'ACCE' LA)) ; "
        "T . 'TEMPS_CALCULES' = PROG 0. PAS 1.E-3 8. ; DYNAMIC T ; E = T . 'ENERGIES' . 'ECART' ;"
    )
    off = np.abs(result.session.root.find("E").values)
    (line,) = result.session.statistics["calculations"]
    assert line["energy_imbalance"] < 0.05
    assert line["energy_imbalance_joules"] < 0.3 * off.max()
    assert line["energy_imbalance_joules"] >= np.median(off[len(off) // 2 :]) * 0.5
    assert not result.session.warnings


DROP = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0. 0. ; Q = 0. 1. ;
R = (APPU 'UY' 400. P) ET (APPU 'UY' 30. Q) ; B = BLOQ MINI 'UY' P ;
C = MANU 'RIGI' 'TYPE' 'RIGIDITE' (P D 1 Q) (MOTS 'UY') (PROG 900. -900. 900.) ;
M = (MASS 'UY' 2. P) ET (MASS 'UY' 1. Q) ; T = TABL ;
T . 'RIGIDITE_CONSTANTE' = R ET C ; T . 'BLOCAGES_MECANIQUES' = B ;
T . 'MASSE_CONSTANTE' = M ; T . 'DYNAMIQUE' = VRAI ;
T . 'TEMPS_CALCULES' = PROG 0. PAS .01 1. ; T . 'DEPLACEMENTS' = TABL ;
T . 'DEPLACEMENTS' . 0 = MANU 'CHPO' (P ET Q) 1 'UY' .05 ;
T . 'CHARGEMENT' = CHAR 'MECA' (FORC 'FY' -40. P) (EVOL MANU (PROG 0. 9.) (PROG 1. 1.)) ;
"""
HISTORY = """
N = DIME (T . 'DEPLACEMENTS') ; L = PROG ;
REPE I N ; L = L ET (EXTR (T . 'DEPLACEMENTS' . (&I - 1)) 'UY' P) ; FIN I ;
E = T . 'ENERGIES' . 'ECART' ; F = MAXI E ABS ;
"""


def test_full_newton_makes_the_same_steps_as_the_condensed_relations(found):
    first = found(DROP + "PASAPAS T ;" + HISTORY, "L").values
    full = found(DROP + "T . 'NEWTON_COMPLET' = VRAI ; PASAPAS T ;" + HISTORY, "L").values
    assert (np.abs(first) < 1e-12).any(), "it lands"
    assert full == pytest.approx(first, abs=1e-11)


def test_adapted_steps_find_the_impact_between_the_instants(found):
    """Against the same motion in steps 16 times shorter."""
    fine = DROP.replace("PAS .01", "PAS .000625")
    exact = found(fine + "PASAPAS T ;" + HISTORY, "L").values[::16]
    plain = found(DROP + "PASAPAS T ;" + HISTORY, "L").values
    fitted = found(DROP + "T . 'PAS_ADAPTE' = VRAI ; PASAPAS T ;" + HISTORY, "L").values
    early = slice(0, 35)  # impacts of an undamped chain tear solutions apart later on
    error = [np.abs(x - exact)[early].max() for x in (plain, fitted)]
    assert error[1] < 0.5 * error[0]


LEVER = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ;
R = (APPU 'UX' 100. P) ET (APPU 'UX' 50. Q) ;
K = MANU 'RIGI' 'TYPE' 'RIGIDITE' (P D 1 Q) (MOTS 'UX') (PROG 30. -30. 30.) ;
B = RELA 'MAXI' (MANU 'CHPO' Q 1 'UX' 1.) 'DUAL' (MANU 'CHPO' P 1 'FX' {push}) ;
F = FORC 'FX' 10. Q ; D = DEPI B .02 ;
U = RESO (R ET K ET B) (F ET D) ; T = TABL ;
T . 'RIGIDITE_CONSTANTE' = R ET K ; T . 'BLOCAGES_MECANIQUES' = B ;
E = EVOL MANU (PROG 0. 1.) (PROG 0. 1.) ; T . 'TEMPS_CALCULES' = PROG 0. .1 .5 1. ;
T . 'CHARGEMENT' = (CHAR 'MECA' F E) ET (CHAR 'DIMP' D (EVOL MANU (PROG 0. 1.) (PROG 1. 1.))) ;
PASAPAS T ; V = T . 'DEPLACEMENTS' . 3 ; X = EXTR V 'UX' P ; Y = EXTR V 'UX' Q ;
A = EXTR U 'UX' P ; Z = EXTR U 'UX' Q ; W = EXTR (REAC B V) 'FX' P ;
"""


def test_relation_with_a_dual_pushes_where_the_dual_says(found):
    """A stop at Q whose reaction acts on P: the same in steps as by RESO."""
    x, y, a, z, push = found(LEVER.format(push=-1.0), "X", "Y", "A", "Z", "W")
    assert (x, y) == pytest.approx((a, z), rel=1e-10)
    assert y == pytest.approx(0.02)
    # P: (100 + 30) x - 30 y = push ; Q: (50 + 30) y - 30 x = 10
    assert x == pytest.approx((80 * 0.02 - 10) / 30)
    assert push == pytest.approx(130 * x - 30 * 0.02)


SPACE = """
OPTI DIME 3 ELEM CUB8 MODE TRID ;
S1 = (DROI 2 (0 0 0) (1 0 0)) TRAN 2 (0 1 0) ; V1 = S1 VOLU TRAN 2 (0 0 1) ;
S2 = (DROI 3 (0 0 1.) (1 0 1.)) TRAN 3 (0 1 0) ; V2 = S2 VOLU TRAN 2 (0 0 1) ;
M = (MODE V1 MECANIQUE ELASTIQUE) ET (MODE V2 MECANIQUE ELASTIQUE) ;
G = MATE M YOUN 1.E3 NU 0. ;
F1 = FACE 2 V1 ; F2 = INVE S2 ; TOP = FACE 2 V2 ;
B = (BLOQ UZ S1) ET (BLOQ UX UY V1) ET (BLOQ UX UY V2) ; D = BLOQ UZ TOP ;
"""


def test_two_cubes_press_on_each_other(found):
    low, high = found(
        SPACE.replace("DROI 3", "DROI 2").replace("TRAN 3", "TRAN 2")
        + "K = MODE F1 CONTACT UNILATERAL F2 MORT ; "
        "U = RESO ((RIGI (M ET K) G) ET B ET D) (DEPI D -.02) ; S = EXCO SMZZ (SIGM M G U) ; "
        "A1 = MINI S ; A2 = MAXI S ;",
        "A1", "A2",
    )  # fmt: skip
    assert (low, high) == pytest.approx((-10.0, -10.0), rel=1e-8)


def test_two_cubes_do_not_pull(found):
    size = found(
        SPACE + "K = MODE F1 CONTACT UNILATERAL F2 MESC ; "
        "U = RESO ((RIGI (M ET K) G) ET B ET D) (DEPI D .02) ; E = MAXI (SIGM M G U) ABS ;",
        "E",
    )
    assert size < 1e-9


STRIPS = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
S1 = (DROI 2 (0 0) (2 0)) TRAN 2 (0 1) ; S2 = (DROI 3 (0 1) (2 1)) TRAN 2 (0 1) ;
A = COTE 3 S1 ; B = COTE 1 S2 ; M = MODE (S1 ET S2) MECANIQUE ELASTIQUE ;
G = MATE M YOUN 1.E3 NU 0. ;
H = (BLOQ UY (COTE 1 S1)) ET (BLOQ UX (S1 ET S2)) ; D = BLOQ UY (COTE 3 S2) ;
T = TABL ; T . MODELE = M ET K ; T . BLOCAGES_MECANIQUES = H ET D ;
T . CHARGEMENT = CHAR DIMP (DEPI D -.02) (EVOL MANU (PROG 0. 1.) (PROG 0. 1.)) ;
T . TEMPS_CALCULES = PROG 0. 1. ; T . CARACTERISTIQUES = G ET (MATE K JEU J) ; PASAPAS T ;
L = COOR 1 B ; U = RESU ((EXCO UY (T . DEPLACEMENTS . 1) ) * L) ; S = MAXI U ;
""".partition("T = TABL ;")


@pytest.mark.parametrize("method", ["SYME", "MESC", "FAIB"])
def test_a_mesh_of_earlier_years_is_the_contact_of_its_sides(found, method):
    setting, table, run = STRIPS
    mesh = f"C = (IMPO MAIL {method} .5 A B) COUL ROUG ; K = MODE C CONTACT UNILATERAL ;"
    field = mesh + "J = MANU CHML C JEU 0.004 ;"
    model = f"K = MODE A CONTACT UNILATERAL B {method} ; J = 0.004 ;"
    sums = [found(f"{setting} {how} {table} {run}", "S") for how in (field, model)]
    assert sums[0] == pytest.approx(sums[1], rel=1e-12)
    closed = found(f"{setting} {mesh} J = 0. ; {table} {run}", "S")
    assert abs(closed - sums[0]) > 0.1 * abs(closed)  # the gap that is kept counts


def test_sides_of_a_mesh_are_in_contact_once(found):
    """However often a mesh of them, or of a part of them, was made before."""
    count = "G R = IMPO BLOC C ; {} = NBNO (EXTR R MAIL UNIL) ; "
    text = (
        STRIPS[0]
        + "C = IMPO MAIL MESC A B ; "
        + count.format("N1")
        + "X = IMPO MAIL MESC .3 A B ; Y = IMPO MAIL MESC (A ELEM 1) B ; "
        + "REPE I 2 ; C = IMPO MAIL MESC A B ; FIN I ; "
        + count.format("N2")
        + "C = IMPO MAIL SYME A B ; "
        + count.format("N3")
        + "C = IMPO MAIL MESC B A ; "
        + count.format("N4")
    )
    once, again, both, turned = found(text, "N1", "N2", "N3", "N4")
    assert (once, again, both, turned) == (4, 4, 7, 3)


def test_two_meshes_of_sides_are_two_contacts(found):
    text = """
    OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; O = 0 0 ;
    S1 = (DROI 1 O (1 0)) TRAN 1 (0 1) ; S2 = (DROI 1 (0 1.1) (1 1.1)) TRAN 1 (0 1) ;
    S3 = (DROI 1 (0 2.2) (1 2.2)) TRAN 1 (0 1) ; M = MODE (S1 ET S2 ET S3) MECANIQUE ELASTIQUE ;
    C = (IMPO MAIL MESC (COTE 3 S1) (COTE 1 S2)) ET (IMPO MAIL MESC (COTE 3 S2) (COTE 1 S3)) ;
    K = MODE C CONTACT UNILATERAL ; G = MATE M YOUN 1.E3 NU 0. ;
    D = BLOQ UY (COTE 3 S3) ; W = RIGI UY 1.E-3 (COTE 1 S2) ;
    B = (BLOQ UY (COTE 1 S1)) ET (BLOQ UX (S1 ET S2 ET S3)) ; T = TABL ; T . MODELE = M ET K ;
    T . RIGIDITE_CONSTANTE = W ; T . BLOCAGES_MECANIQUES = B ET D ; T . CARACTERISTIQUES = G ;
    T . CHARGEMENT = CHAR DIMP (DEPI D -.23) (EVOL MANU (PROG 0. 1.) (PROG 0. 1.)) ;
    T . TEMPS_CALCULES = PROG 0. 1. ; PASAPAS T ;
    X = EXCO SMYY (T . CONTRAINTES . 1) ; A1 = MINI X ; A2 = MAXI X ;
    """
    assert found(text, "A1", "A2") == pytest.approx((-10.0, -10.0), rel=1e-4)
