"""DYNE from scripts: its tables, results, links, restart and recombination."""

import numpy as np
import pytest
from script_runs import ran
from together import together

BAR = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; A = 0. 0. ; B = 8. 0. ; L = DROI 8 A B ;
MO = MODE L MECANIQUE ELASTIQUE BARR ;
MA = MATE MO 'YOUN' 64. 'NU' 0. 'SECT' 1. 'RHO' 1. ;
K = (RIGI MO MA) ET (BLOQ 'UX' A) ET (BLOQ 'UY' L) ; M = MASS MO MA ;
T = VIBR 'SIMU' 0.1 2 K M ; F = FORC 'FX' 4. (L POIN 'PROC' (5. 0.)) ;
"""


def run(script, tmp_path):
    return ran(script, output_directory=tmp_path).session.root


def test_pseudo_mode_completes_a_slow_answer_to_the_static_one(tmp_path):
    root = run(
        f"""{BAR}
        T . 'PSEUDO_MODES' = PSMO K (T . 'MODES') F ;
        C = CHAR F (EVOL 'MANU' (PROG 0. 200. 400.) (PROG 0. 1. 1.)) ;
        TC = TABL 'CHARGEMENT' ; TC . 'BASE_A' = PJBA T C ;
        R = DYNE 'DE_VOGELAERE' T TC 4000 0.1 100 ;
        U = RECO R T 300. C 'DEPL' ; V = RECO R T 300. 'DEPL' ; S = RESO K F ;
        EU = MAXI (U - S) 'ABS' 'AVEC' (MOTS 'UX') ; EV = MAXI (V - S) 'ABS' 'AVEC' (MOTS 'UX') ;
        XS = MAXI S 'ABS' 'AVEC' (MOTS 'UX') ;
        E1 = EVOL 'RECO' R T C 'DEPL' B 'UX' ; X1 = IPOL 300. E1 ; X2 = EXTR U B 'UX' ;
        N1 = DIME (EXTR E1 'ORDO') ; SC = EXTR S B 'UX' ;
        """,
        tmp_path,
    )
    scale = root.find("XS")
    assert root.find("EU") < 2e-3 * scale
    assert root.find("EV") > 2e-2 * scale
    assert root.find("X1") == pytest.approx(root.find("X2"))
    assert root.find("X2") == pytest.approx(4.0 * 5.0 / 64.0, rel=5e-3)
    assert root.find("N1") == 41


LINKED = f"""{BAR}
L1 = TABL 'LIAISON_ELEMENTAIRE' ; L1 . 'TYPE_LIAISON' = MOT 'POINT_PLAN' ; L1 . 'SUPPORT' = B ;
L1 . 'NORMALE' = 1. 0. ; L1 . 'RAIDEUR' = 1.E3 ; L1 . 'JEU' = 0.1 ;
L2 = TABL 'LIAISON_ELEMENTAIRE' ; L2 . 'TYPE_LIAISON' = MOT 'POINT_POINT' ;
L2 . 'POINT_A' = B ; L2 . 'POINT_B' = A ; L2 . 'NORMALE' = -1. 0. ; L2 . 'RAIDEUR' = 1.E3 ;
L2 . 'JEU' = 0.05 ; L2 . 'AMORTISSEMENT' = 0. ;
TL = TABL 'LIAISON' ; TL . 'LIAISON_B' = TABL 'LIAISON_B' ;
TL . 'LIAISON_B' . 1 = L1 ; TL . 'LIAISON_B' . 2 = L2 ;
TS = TABL 'SORTIE' ; TS . 'VARIABLE' = TABL 'VARIABLE' ; TS . 'VARIABLE' . 'ACCELERATION' = VRAI ;
TS . 'VARIABLE' . 'TRAVAIL_INTERIEUR' = VRAI ;
TS . 'LIAISON_B' = TABL 'LIAISON_B' ; TS . 'LIAISON_B' . L1 = VRAI ; TS . 'LIAISON_B' . L2 = VRAI ;
TI = TABL 'INITIAL' ;
TI . 'VITESSE' = MANU 'CHPO' (T . 'MODES' . 1 . 'POINT_REPERE') 1 'ALFA' 0.5 ;
"""


def test_links_push_by_their_overlap(tmp_path):
    root = run(LINKED + "R = DYNE 'DE_VOGELAERE' T TL TS TI 3000 0.01 ;", tmp_path)
    results = root.find("R")
    wall, points = results.get(root.find("L1")), results.get(root.find("L2"))
    u, f = (wall.get(i).values for i in ("UX", "FORCE_DE_CHOC"))
    np.testing.assert_allclose(f, -1e3 * np.maximum(u - 0.1, 0.0), atol=1e-9)
    a, b, fa, fb = (
        points.get(i).values
        for i in ("UX_POINT_A", "UX_POINT_B", "FORCE_DE_CHOC_POINT_A", "FORCE_DE_CHOC_POINT_B")
    )
    np.testing.assert_allclose(fa, -1e3 * np.maximum(b - a - 0.05, 0.0), atol=1e-9)
    np.testing.assert_allclose(fb, -fa)
    assert f.min() < -1.0
    assert fa.min() < -1.0
    assert points.has("VITESSE_NORMALE")
    assert not wall.has("VITESSE_NORMALE")
    assert results.get(2).has("ACCELERATION")


def test_run_goes_on_from_its_restart_table(tmp_path):
    root = run(
        f"""{LINKED}
        R = DYNE 'DE_VOGELAERE' T TL TI 600 0.01 ; P = DYNE 'DE_VOGELAERE' T TL TI 400 0.01 ;
        T2 = TABL 'INITIAL' ; T2 . 'REPRISE' = P . 'REPRISE' ;
        S = DYNE 'DE_VOGELAERE' T TL T2 200 0.01 ; X = R . 601 . 'VITESSE' ;
        D = MAXI ((S . 201 . 'VITESSE') - X) 'ABS' ; T3 = EXTR (S . 'TEMPS_DE_SORTIE') 201 ;
        """,
        tmp_path,
    )
    assert root.find("D") < 1e-12
    assert root.find("T3") == pytest.approx(6.0)


def test_lists_instead_of_fields(tmp_path):
    root = run(
        f"""{LINKED}
        TS . 'VARIABLE' . 'TYPE_SORTIE' = MOT 'LISTREEL' ; R = DYNE 'FOX_GOODWIN' T TS TI 50 0.01 ;
        Q = DYNE 'FOX_GOODWIN' T TI 50 0.01 ;
        W = R . 'VITESSE' . (T . 'MODES' . 1 . 'POINT_REPERE') ; N = DIME W ; X = EXTR W 51 ;
        E = EVOL 'SOLU' Q 'VITE' T 'ALFA' ; EY = EXTR E 'ORDO' 1 ; Y = EXTR EY 51 ;
        """,
        tmp_path,
    )
    assert root.find("N") == 51
    assert root.find("X") == pytest.approx(root.find("Y"))


# a disc of mass 2 and radius 0.3 that turns at 6 rad/s is laid on a plane and pressed by 20
WHEEL = """
OPTI DIME 2 ; A = 0. 0. ;
T = TABL 'BASE_MODALE' ; T . 'MODES' = TABL ;
REPE B 3 ;
  M = TABL 'MODE' ; M . 'NUMERO_MODE' = &B ; M . 'FREQUENCE' = 0. ;
  M . 'POINT_REPERE' = (FLOT &B) 9. ;
  M . 'MASSE_GENERALISEE' = EXTR (PROG 2. 2. 0.09) &B ;
  M . 'DEFORMEE_MODALE' = MANU 'CHPO' A 1 (EXTR (MOTS 'UX' 'UY' 'RZ') &B) 1. ;
  T . 'MODES' . &B = M ;
FIN B ;
L1 = TABL 'LIAISON_ELEMENTAIRE' ; L1 . 'TYPE_LIAISON' = MOT 'CERCLE_PLAN_FROTTEMENT' ;
L1 . 'SUPPORT' = A ; L1 . 'RAYON_SUPPORT' = 0.3 ; L1 . 'NORMALE' = 0. -1. ; L1 . 'RAIDEUR' = 1.E5 ;
L1 . 'JEU' = 0. ; L1 . 'COEFFICIENT_GLISSEMENT' = 0.2 ; L1 . 'COEFFICIENT_ADHERENCE' = 0.2 ;
L1 . 'RAIDEUR_TANGENTIELLE' = -1.E5 ; L1 . 'AMORTISSEMENT_TANGENTIEL' = 1.E-3 ;
TL = TABL 'LIAISON' ; TL . 'LIAISON_B' = TABL 'LIAISON_B' ; TL . 'LIAISON_B' . 1 = L1 ;
TS = TABL 'SORTIE' ; TS . 'LIAISON_B' = TABL 'LIAISON_B' ; TS . 'LIAISON_B' . L1 = VRAI ;
C = TABL 'CHARGEMENT' ;
C . 'BASE_A' = CHAR (MANU 'CHPO' (T . 'MODES' . 2 . 'POINT_REPERE') 1 'FALF' -20.
  'NATURE' 'DISCRET') (EVOL 'MANU' (PROG 0. 10.) (PROG 1. 1.)) ;
TI = TABL 'INITIAL' ;
TI . 'VITESSE' = MANU 'CHPO' (T . 'MODES' . 3 . 'POINT_REPERE') 1 'ALFA' 6. ;
TI . 'DEPLACEMENT' = MANU 'CHPO' (T . 'MODES' . 2 . 'POINT_REPERE') 1 'ALFA' -2.E-4 ;
"""


def test_turning_disc_laid_on_a_plane_ends_up_rolling(tmp_path):
    script = f"""{WHEEL}
    R = DYNE 'DE_VOGELAERE' T TL C TI TS 4000 2.E-4 4000 ;
    X = EXTR (R . 2 . 'VITESSE') 'ALFA' (T . 'MODES' . 1 . 'POINT_REPERE') ;
    W = EXTR (R . 2 . 'VITESSE') 'ALFA' (T . 'MODES' . 3 . 'POINT_REPERE') ;
    """
    root = run(script, tmp_path)
    # momentum and moment of momentum: a third of the speed of turning stays, and it rolls
    x, w = root.find("X"), root.find("W")
    assert 0.09 * (6.0 - w) == pytest.approx(-2.0 * x * 0.3, rel=1e-9)
    assert w == pytest.approx(2.0, rel=1e-3)  # regularised friction fades as it comes near
    assert x == pytest.approx(-2.0 * 0.3, rel=1e-3)


def test_sliding_disc_slows_down_by_its_friction(tmp_path):
    root = run(WHEEL + "R = DYNE 'DE_VOGELAERE' T TL C TI TS 500 2.E-4 50 ;", tmp_path)
    link = root.find("R").get(root.find("L1"))
    times = 0.01 * np.arange(11)
    turned = link.get("RZ_POINT_FIBRE_NEUTRE").values
    # 0.2 x 20 N at the radius 0.3 over the inertia 0.09
    np.testing.assert_allclose(turned, 6 * times - 0.5 * 4 * 0.3 / 0.09 * times**2, rtol=1e-6)
    np.testing.assert_allclose(np.abs(link.get("FORCE_DE_CHOC_NORMALE").values), 20.0, rtol=1e-9)


# --- lines, bodies that turn, polynomials, tables PASAPAS ----------------------------------------

MASS = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0.3 0.10013 ; PX = 0. 0. ; PY = 0. 0. ;
TM = TABL 'BASE_DE_MODES' ;
TM . 1 = TABL 'MODE' ; TM . 1 . 'POINT_REPERE' = PX ; TM . 1 . 'FREQUENCE' = 0. ;
TM . 1 . 'MASSE_GENERALISEE' = 2. ;
TM . 1 . 'DEFORMEE_MODALE' = MANU 'CHPO' P 3 'UX' 1. 'UY' 0. 'RZ' 0. ;
TM . 2 = TABL 'MODE' ; TM . 2 . 'POINT_REPERE' = PY ; TM . 2 . 'FREQUENCE' = 0. ;
TM . 2 . 'MASSE_GENERALISEE' = 2. ;
TM . 2 . 'DEFORMEE_MODALE' = MANU 'CHPO' P 3 'UX' 0. 'UY' 1. 'RZ' 0. ;
TB = TABL 'BASE_MODALE' ; TB . 'MODES' = TM ;
TI = TABL 'INITIAL' ;
TI . 'VITESSE' = (MANU 'CHPO' PX 1 'ALFA' 0.5) ET (MANU 'CHPO' PY 1 'ALFA' -1.) ;
L1 = TABL 'LIAISON_ELEMENTAIRE' ; TL = TABL 'LIAISON' ; TL . 'LIAISON_B' = TABL 'LIAISON_B' ;
TL . 'LIAISON_B' . 1 = L1 ; TV = TABL 'VARIABLE' ;
TS = TABL 'SORTIE' ; TS . 'LIAISON_B' = TABL 'LIAISON_B' ; TS . 'LIAISON_B' . L1 = TV ;
TV . 'FORCE_DE_CHOC_NORMALE' = VRAI ; TV . 'FORCE_DE_CHOC_TANGENTIELLE' = VRAI ;
L1 . 'COEFFICIENT_GLISSEMENT' = 0.2 ; L1 . 'COEFFICIENT_ADHERENCE' = 0.2 ;
L1 . 'RAIDEUR_TANGENTIELLE' = -1. ; L1 . 'AMORTISSEMENT_TANGENTIEL' = 1.E-3 ;
"""
LINE = """
L1 . 'TYPE_LIAISON' = MOT 'LIGNE_LIGNE_FROTTEMENT' ; L1 . 'LIGNE_MAITRE' = {line} ;
L1 . 'LIGNE_ESCLAVE' = P ; L1 . 'RAIDEURS' = MANU 'CHPO' P 1 'RAID' 5.E4 ;
TV . 'CHPOINT_FORCE_DE_CHOC' = VRAI ;
"""


@pytest.mark.parametrize(
    "line", ["DROI 3 (2. 0.) (-1. 0.)", "(DROI 1 (0.31 0.) (-1. 0.)) ET (DROI 2 (2. 0.) (0.31 0.))"]
)
def test_a_node_strikes_a_line_as_it_strikes_a_plane(line, tmp_path):
    root = run(
        MASS
        + LINE.format(line=line)
        + """
        ELIM (L1 . 'LIGNE_MAITRE') 1.E-9 ;
        R = DYNE 'DE_VOGELAERE' TB TI TL TS 1500 1.E-4 ; F = R . L1 . 'FORCE_DE_CHOC_NORMALE' ;
        X = R . L1 . 'CHPOINT_FORCE_DE_CHOC' . 1100 ;
        FN = EXTR X P 'NORM' ; FT = EXTR X P 'TANG' ; F1 = EXTR F 1100 ;
        L1 . 'TYPE_LIAISON' = MOT 'POINT_PLAN_FROTTEMENT' ; L1 . 'SUPPORT' = P ;
        L1 . 'NORMALE' = 0. -1. ; L1 . 'JEU' = 0.10013 ; L1 . 'RAIDEUR' = 5.E4 ;
        OUBL TV 'CHPOINT_FORCE_DE_CHOC' ;
        S = DYNE 'DE_VOGELAERE' TB TI TL TS 1500 1.E-4 ; G = S . L1 . 'FORCE_DE_CHOC_NORMALE' ;
        V = (R . 1501 . 'VITESSE') - (S . 1501 . 'VITESSE') ; D = MAXI V 'ABS' ;
        VY = EXTR (R . 1501 . 'VITESSE') PY 'ALFA' ; VX = EXTR (R . 1501 . 'VITESSE') PX 'ALFA' ;
        """,
        tmp_path,
    )
    np.testing.assert_allclose(root.find("F").values, root.find("G").values, atol=1e-6)
    assert root.find("D") < 1e-9
    assert root.find("FN") == pytest.approx(root.find("F1"))
    assert root.find("FT") == pytest.approx(0.2 * abs(root.find("FN")))
    # a rebound without loss; friction takes its share of twice the impulse
    assert root.find("VY") == pytest.approx(1.0, rel=1e-5)
    assert root.find("VX") == pytest.approx(0.5 - 0.2 * 2.0, rel=1e-3)


def test_a_line_gets_what_it_gives(tmp_path):
    root = run(
        f"""{MASS}
        A = DROI 2 (2. 0.) (-1. 0.) ; PA = 0. 0. ; TM . 3 = TABL 'MODE' ;
        TM . 3 . 'POINT_REPERE' = PA ; TM . 3 . 'FREQUENCE' = 0. ;
        TM . 3 . 'MASSE_GENERALISEE' = 3. ;
        TM . 3 . 'DEFORMEE_MODALE' = MANU 'CHPO' A 2 'UX' 0. 'UY' 1. ;
        """
        + LINE.format(line="A")
        + """
        L1 . 'COEFFICIENT_GLISSEMENT' = 0. ; L1 . 'SYMETRIE' = MOT 'LOCALE' ;
        L1 . 'LIGNE_ESCLAVE' = MANU 'SEG2' P (P PLUS (0.05 0.)) ;
        B = L1 . 'LIGNE_ESCLAVE' ;
        TM . 1 . 'DEFORMEE_MODALE' = MANU 'CHPO' B 2 'UX' 1. 'UY' 0. ;
        TM . 2 . 'DEFORMEE_MODALE' = MANU 'CHPO' B 2 'UX' 0. 'UY' 1. ;
        L1 . 'RAIDEURS' = MANU 'CHPO' (A ET B) 1 'RAID' 5.E4 ; OUBL TV 'CHPOINT_FORCE_DE_CHOC' ;
        R = DYNE 'DE_VOGELAERE' TB TI TL TS 1500 1.E-4 ;
        V2 = EXTR (R . 1501 . 'VITESSE') PY 'ALFA' ; V3 = EXTR (R . 1501 . 'VITESSE') PA 'ALFA' ;
        """,
        tmp_path,
    )
    # elastic shock of masses 2 and 3
    assert root.find("V2") == pytest.approx((2.0 - 3.0) / 5.0 * -1.0, rel=1e-4)
    assert root.find("V3") == pytest.approx(2.0 * 2.0 / 5.0 * -1.0, rel=1e-4)


def test_a_line_in_a_ring_is_pushed_back(tmp_path):
    root = run(
        """
        OPTI DIME 3 MODE TRID ELEM SEG2 ; A = DROI 2 (-1. 0. 0.) (1. 0. 0.) ; P = 0.5 0. 0. ;
        PY = 0. 0. 0. ; TM = TABL 'BASE_DE_MODES' ; TM . 1 = TABL 'MODE' ;
        TM . 1 . 'POINT_REPERE' = PY ; TM . 1 . 'FREQUENCE' = 0. ;
        TM . 1 . 'MASSE_GENERALISEE' = 2. ;
        TM . 1 . 'DEFORMEE_MODALE' = MANU 'CHPO' A 3 'UX' 0. 'UY' 0.6 'UZ' 0.8 ;
        TB = TABL 'BASE_MODALE' ; TB . 'MODES' = TM ;
        TI = TABL 'INITIAL' ; TI . 'VITESSE' = MANU 'CHPO' PY 1 'ALFA' 1. ;
        L1 = TABL 'LIAISON_ELEMENTAIRE' ; TL = TABL 'LIAISON' ;
        L1 . 'TYPE_LIAISON' = MOT 'LIGNE_CERCLE_FROTTEMENT' ; L1 . 'LIGNE_MAITRE' = A ;
        L1 . 'LIGNE_ESCLAVE' = P ; L1 . 'NORMALE' = 1. 0. 0. ; L1 . 'RAYON' = 0.05 ;
        L1 . 'RAIDEURS' = MANU 'CHPO' P 1 'RAID' 2.E4 ; L1 . 'COEFFICIENT_GLISSEMENT' = 0. ;
        L1 . 'COEFFICIENT_ADHERENCE' = 0. ; L1 . 'RAIDEUR_TANGENTIELLE' = -1. ;
        L1 . 'AMORTISSEMENT_TANGENTIEL' = 1. ;
        TL . 'LIAISON_B' = TABL 'LIAISON_B' ; TL . 'LIAISON_B' . 1 = L1 ;
        TS = TABL 'SORTIE' ; TS . 'LIAISON_B' = TABL 'LIAISON_B' ; TS . 'LIAISON_B' . L1 = VRAI ;
        R = DYNE 'DE_VOGELAERE' TB TI TL TS 820 2.E-4 ;
        F = R . L1 . 'FORCE_DE_CHOC_NORMALE' ;
        L1 . 'INVERSION' = VRAI ; L1 . 'LIGNE_ESCLAVE' = DROI 1 (-2. 0. 0.) (3. 0. 0.) ;
        L1 . 'RAIDEURS' = MANU 'CHPO' A 1 'RAID' 2.E4 ;
        S = DYNE 'DE_VOGELAERE' TB TI TL TS 820 2.E-4 ; G = S . L1 . 'FORCE_DE_CHOC_NORMALE' ;
        """,
        tmp_path,
    )
    # a spring beyond the gap, then the same speed back; three nodes in a cylinder are three springs
    for force, k in ((root.find("F").values, 2e4), (root.find("G").values, 6e4)):
        t = 2e-4 * np.arange(821)
        w = np.sqrt(k / 2.0)
        pressed = np.where(
            (t > 0.05) & (t < 0.05 + np.pi / w), -np.sin(w * (t - 0.05)) * k / w, 0.0
        )
        np.testing.assert_allclose(force, pressed, atol=2e-2 * k / w)
        assert force.min() == pytest.approx(-k / w, rel=1e-3)


BODY = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; G = 1. 0.5 ; P = 1.3 0.9 ; PX = 0. 0. ; PY = 0. 0. ;
PR = 0. 0. ; C = G ET P ; TM = TABL 'BASE_DE_MODES' ;
REPE B 3 ; TM . &B = TABL 'MODE' ; TM . &B . 'FREQUENCE' = 0. ;
TM . &B . 'MASSE_GENERALISEE' = 2. ; FIN B ; TM . 3 . 'MASSE_GENERALISEE' = 0.1 ;
TM . 1 . 'POINT_REPERE' = PX ; TM . 2 . 'POINT_REPERE' = PY ; TM . 3 . 'POINT_REPERE' = PR ;
TM . 1 . 'DEFORMEE_MODALE' = MANU 'CHPO' C 3 'UX' 1. 'UY' 0. 'RZ' 0. ;
TM . 2 . 'DEFORMEE_MODALE' = MANU 'CHPO' C 3 'UX' 0. 'UY' 1. 'RZ' 0. ;
TM . 3 . 'DEFORMEE_MODALE' = MANU 'CHPO' C 3 'UX' 0. 'UY' 0. 'RZ' 4. ;
TM . 3 . 'CORPS_RIGIDE' = MOT 'VRAI' ; TM . 3 . 'CENTRE_DE_GRAVITE' = G ;
TB = TABL 'BASE_MODALE' ; TB . 'MODES' = TM ;
TI = TABL 'INITIAL' ;
TI . 'VITESSE' = (MANU 'CHPO' PX 1 'ALFA' 0.7) ET (MANU 'CHPO' PR 1 'ALFA' 9.) ;
L1 = TABL 'LIAISON_ELEMENTAIRE' ; TL = TABL 'LIAISON' ; TL . 'LIAISON_B' = TABL 'LIAISON_B' ;
TL . 'LIAISON_B' . 1 = L1 ; L1 . 'TYPE_LIAISON' = MOT 'POINT_PLAN' ; L1 . 'SUPPORT' = P ;
L1 . 'NORMALE' = 0.6 0.8 ; L1 . 'LIAISON_PERMANENTE' = VRAI ; L1 . 'JEU' = 0. ;
L1 . 'RAIDEUR' = {stiffness} ;
TS = TABL 'SORTIE' ; TS . 'LIAISON_B' = TABL 'LIAISON_B' ; TS . 'LIAISON_B' . L1 = VRAI ;
R = DYNE 'DE_VOGELAERE' TB TI TL TS 2000 1.E-3 ;
"""


IN_SPACE = [  # the same about x
    ("DIME 2 MODE PLAN DEFO", "DIME 3 MODE TRID"), ("= 0. 0.", "= 0. 0. 0."), ("= 0.6", "= 0. 0.6"),
    ("= 1. 0.5", "= 0. 1. 0.5"), ("= 1.3", "= 0. 1.3"), ("'UY'", "'UZ'"), ("'UX'", "'UY'"),
    ("'RZ'", "'RX'"),
]  # fmt: skip
PAIR = "L1 . 'TYPE_LIAISON' = MOT 'POINT_POINT' ; L1 . 'POINT_A' = P ; L1 . 'POINT_B' = G ; "
CIRCLE = (
    "L1 . 'TYPE_LIAISON' = MOT 'CERCLE_PLAN_FROTTEMENT' ; L1 . 'RAYON_SUPPORT' = 0.1 ; "
    "L1 . 'COEFFICIENT_GLISSEMENT' = 0. ; L1 . 'COEFFICIENT_ADHERENCE' = 0. ; "
    "L1 . 'RAIDEUR_TANGENTIELLE' = -1. ; L1 . 'AMORTISSEMENT_TANGENTIEL' = 1.E-9 ; "
)


@together("axes", ["XYZ", "YZX"])
@together("tail, before", [("", ""), ("_POINT_A", PAIR), ("_POINT_FIBRE_NEUTRE", CIRCLE)])
def test_a_point_of_a_body_that_turns_goes_on_its_circle(axes, tail, before, tmp_path):
    t = 1e-3 * np.arange(2001)
    c, s = np.cos(9.0 * t), np.sin(9.0 * t)
    script = BODY.format(stiffness="1.E-9").replace("R = DYNE", before + "R = DYNE")
    for plane, space in IN_SPACE if axes == "YZX" else ():
        script = script.replace(plane, space)
    root = run(script, tmp_path)
    link = root.find("R").get(root.find("L1"))
    x, y = 0.7 * t + 0.3 * (c - 1.0) - 0.4 * s, 0.4 * (c - 1.0) + 0.3 * s
    for name, way in zip(axes, (x, y, 0.0 * t), strict=True):
        np.testing.assert_allclose(link.get(f"U{name}{tail}").values, way, atol=1e-6)
    if before == CIRCLE:
        np.testing.assert_allclose(link.get(f"R{axes[2]}{tail}").values, 9.0 * t, atol=1e-6)


def test_a_spring_at_a_body_that_turns_keeps_energy(tmp_path):
    root = run(
        f"""{BODY.format(stiffness="40.")}
        V1 = PROG ; V2 = PROG ; V3 = PROG ; REPE B 2001 ; V = R . &B . 'VITESSE' ;
        V1 = V1 ET (PROG (EXTR V PX 'ALFA')) ; V2 = V2 ET (PROG (EXTR V PY 'ALFA')) ;
        V3 = V3 ET (PROG (EXTR V PR 'ALFA')) ; FIN B ; F = R . L1 . 'FORCE_DE_CHOC' ;
        """,
        tmp_path,
    )
    v1, v2, v3, f = (root.find(n).values for n in ("V1", "V2", "V3", "F"))
    energy = v1**2 + v2**2 + 0.05 * v3**2 + 0.5 * f**2 / 40.0
    np.testing.assert_allclose(energy, 0.49 + 0.05 * 81.0, rtol=1e-6)
    assert np.ptp(v3) > 1.0
    assert np.ptp(v2) > 0.1


def test_a_circle_that_turns_touches_a_fixed_circle(tmp_path):
    root = run(
        f"""{BODY.format(stiffness="500.").replace("R = DYNE", "* R = DYNE")}
        OUBL TM . 3 'CORPS_RIGIDE' ;
        TM . 3 . 'DEFORMEE_MODALE' = MANU 'CHPO' C 3 'UX' 0. 'UY' 0. 'RZ' 1. ;
        OPTI DIME 3 ; L1 . 'NORMALE' = 0. 0. 1. ; L1 . 'EXCENTRATION' = 0. 0.01 0. ; OPTI DIME 2 ;
        L1 . 'TYPE_LIAISON' = MOT 'CERCLE_CERCLE_FROTTEMENT' ; L1 . 'SUPPORT' = G ;
        L1 . 'RAYON_SUPPORT' = 0.3 ; L1 . 'RAYON_BUTEE' = 0.4 ; L1 . 'LIAISON_PERMANENTE' = FAUX ;
        L1 . 'COEFFICIENT_GLISSEMENT' = 0.25 ; L1 . 'COEFFICIENT_ADHERENCE' = 0.25 ;
        L1 . 'RAIDEUR_TANGENTIELLE' = -1. ; L1 . 'AMORTISSEMENT_TANGENTIEL' = 1.E-2 ;
        R = DYNE 'DE_VOGELAERE' TB TI TL TS 300 1.E-3 ;
        """,
        tmp_path,
    )
    link = root.find("R").get(root.find("L1"))
    get = {n: link.get(n).values for n in (
        "UX_POINT_FIBRE_NEUTRE", "UY_POINT_FIBRE_NEUTRE", "VX_POINT_CONTACT", "VY_POINT_CONTACT",
        "FORCE_DE_CHOC_NORMALE", "FORCE_DE_CHOC_TANGENTIELLE", "MZ_POINT_FIBRE_NEUTRE",
        "RZ_POINT_FIBRE_NEUTRE",
    )}  # fmt: skip
    away = np.stack([get["UX_POINT_FIBRE_NEUTRE"], get["UY_POINT_FIBRE_NEUTRE"] - 0.01])
    size = np.linalg.norm(away, axis=0)
    push = 500.0 * np.maximum(size - 0.1, 0.0)
    np.testing.assert_allclose(get["FORCE_DE_CHOC_NORMALE"], -push, atol=1e-9)
    assert push.max() > 1.0
    slides = push > 0.1
    np.testing.assert_allclose(get["FORCE_DE_CHOC_TANGENTIELLE"][slides], 0.25 * push[slides])
    np.testing.assert_allclose(
        np.abs(get["MZ_POINT_FIBRE_NEUTRE"][slides]), 0.3 * 0.25 * push[slides]
    )
    # the edge moves by the rotation too: v + w z x 0.3 n
    n = away / size
    spin = np.gradient(get["RZ_POINT_FIBRE_NEUTRE"], 1e-3)
    vx = np.gradient(get["UX_POINT_FIBRE_NEUTRE"], 1e-3) - spin * 0.3 * n[1]
    np.testing.assert_allclose(get["VX_POINT_CONTACT"][slides], vx[slides], atol=3e-2)


def test_a_polynomial_is_a_product_of_powers(tmp_path):
    root = run(
        f"""{MASS}
        L1 = TABL 'LIAISON_ELEMENTAIRE' ; L1 . 'TYPE_LIAISON' = MOT 'POLYNOMIALE' ;
        L1 . 'SUPPORT' = PY ; L1 . 'COEFFICIENT' = -3. ;
        L1 . PX = TABL 'CONTRIBUTION' ; L1 . PX . 'EXPOSANT_DEPLACEMENT' = 2. ;
        L1 . PX . 'JEU_DEPLACEMENT' = 0.1 ; L1 . PY = TABL 'CONTRIBUTION' ;
        L1 . PY . 'EXPOSANT_VITESSE' = 1. ; L1 . PY . 'JEU_VITESSE' = -0.2 ;
        TL . 'LIAISON_A' = TABL 'LIAISON_A' ; OUBL TL 'LIAISON_B' ; TL . 'LIAISON_A' . 1 = L1 ;
        TS . 'LIAISON_A' = TABL 'LIAISON_A' ; OUBL TS 'LIAISON_B' ; TS . 'LIAISON_A' . L1 = VRAI ;
        TS . 'VARIABLE' = TABL 'VARIABLE' ; TS . 'VARIABLE' . 'TYPE_SORTIE' = MOT 'LISTREEL' ;
        R = DYNE 'DE_VOGELAERE' TB TI TL TS 1000 1.E-3 ; F = R . L1 . 'FORCE_POLYNOMIALE' ;
        X = R . 'DEPLACEMENT' . PX ; V = R . 'VITESSE' . PY ;
        """,
        tmp_path,
    )
    x, v = root.find("X").values, root.find("V").values
    # the velocity that links see is the change over the last half step
    expected = -3.0 * np.maximum(x - 0.1, 0.0) ** 2 * np.maximum(-0.2 - v, 0.0)
    np.testing.assert_allclose(root.find("F").values, expected, atol=1e-4)
    assert v[-1] < -1.05


OF_MODELS = """
OPTI ELEM POI1 ; M1 = MODE (MANU 'POI1' PX) 'MECANIQUE' 'ELASTIQUE' 'MODAL' ;
M2 = MODE (MANU 'POI1' PY) 'MECANIQUE' 'ELASTIQUE' 'MODAL' ;
A = (MATE M1 'FREQ' 0. 'MASS' 2. 'DEFO' (TM . 1 . 'DEFORMEE_MODALE')) ET
    (MATE M2 'FREQ' 0. 'MASS' 2. 'DEFO' (TM . 2 . 'DEFORMEE_MODALE')) ;
L = MODE (MANU 'POI1' P) 'LIAISON' 'LIGNE_LIGNE' 'FROTTEMENT' ; TO = TABL ; TO . L = TV ;
AL = MATE L 'LIMA' (L1 . 'LIGNE_MAITRE') 'LIES' P 'RAID' (L1 . 'RAIDEURS') 'GLIS' 0.2
     'ADHE' 0.2 'RTAN' -1. 'ATAN' 1.E-3 'SORT' TO ;
"""
"""The modes and the link of a line as models."""


def test_models_of_a_table_pasapas_are_the_tables_of_the_other_form(tmp_path):
    root = run(
        MASS
        + LINE.format(line="DROI 3 (2. 0.) (-1. 0.)")
        + """
        R = DYNE 'DE_VOGELAERE' TB TI TL TS 1500 1.E-4 3 ; F = R . L1 . 'FORCE_DE_CHOC_NORMALE' ;
        D = R . 401 . 'DEPLACEMENT' ;
        """
        + OF_MODELS
        + """
        T = TABL 'PASAPAS' ; T . 'MODELE' = M2 ET L ET M1 ; T . 'CARACTERISTIQUES' = A ET AL ;
        T . 'VITESSES' = TABL ; T . 'VITESSES' . 0 = TI . 'VITESSE' ; T . 'NOMBRE_PAS' = 1500 ;
        T . 'PAS_DE_TEMPS' = 1.E-4 ; T . 'PAS_DE_SORTIE' = 3 ; DYNE 'DE_VOGELAERE' T ;
        G = T . 'LIAISONS' . L . 'FORCE_DE_CHOC_NORMALE' ; X = T . 'TEMPS' . 500 ;
        H = MAXI ((T . 'REPRISE_DYNE' . 'VITESSE') - (R . 'REPRISE' . 'VITESSE')) 'ABS' ;
        E = MAXI ((T . 'DEPLACEMENTS' . 400) - D) 'ABS' ;
        C = CHAR (MANU 'CHPO' PX 1 'FALF' 3.) (EVOL 'MANU' (PROG 0. 1.) (PROG 1. 0.5)) ;
        TC = TABL 'CHARGEMENT' ; TC . 'BASE_A' = C ; TI = TABL 'INITIAL' ;
        TI . 'REPRISE' = R . 'REPRISE' ; R = DYNE 'DE_VOGELAERE' TB TI TL TC 600 1.E-4 3 ;
        T . 'INIT_DYNE' = T . 'REPRISE_DYNE' ; T . 'CHARGEMENT' = C ; T . 'NOMBRE_PAS' = 600 ;
        T . 'SORTIE' = TABL ; T . 'SORTIE' . 'VARIABLE' = TABL ;
        T . 'SORTIE' . 'VARIABLE' . 'VITESSE' = FAUX ; DYNE 'DE_VOGELAERE' T ;
        W = MAXI ((T . 'DEPLACEMENTS' . 200) - (R . 201 . 'DEPLACEMENT')) 'ABS' ;
        N = DIME (T . 'VITESSES') ; Y = T . 'TEMPS' . 200 ;
        """,
        tmp_path,
    )
    assert root.find("X") == pytest.approx(0.15)
    assert root.find("F").values.min() < -100.0
    np.testing.assert_allclose(root.find("G").values, root.find("F").values)
    assert max(root.find("E"), root.find("H"), root.find("W")) < 1e-12
    assert (root.find("N"), root.find("Y")) == (0, pytest.approx(0.21))


@pytest.mark.parametrize(("first", "of_first"), [("", ""), ("1.E-4", "1 2")])
def test_pasapas_steps_models_of_links(first, of_first, tmp_path):
    """Results of the first step hold those of the start too."""
    root = run(
        MASS
        + LINE.format(line="DROI 3 (2. 0.) (-1. 0.)")
        + """
        R = DYNE 'DE_VOGELAERE' TB TI TL TS 1500 1.E-4 ; F = R . L1 . 'FORCE_DE_CHOC_NORMALE' ;
        W = EXTR F 1021 ; V = R . 1501 . 'VITESSE' ;
        """
        + OF_MODELS
        + """
        T = TABL 'PASAPAS' ; T . 'MODELE' = M1 ET M2 ET L ; T . 'CARACTERISTIQUES' = A ET AL ;
        T . 'VITESSES' = TABL ; T . 'VITESSES' . 0 = TI . 'VITESSE' ; T . 'DYNAMIQUE' = VRAI ;
        T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-4 0.15 ;
        T . 'TEMPS_SAUVES' = PROG 0. {first} 6.E-3 'PAS' 6.E-3 0.15 ; PASAPAS T ;
        N = DIME (T . 'TEMPS') ; S = EXTR (T . 'VARIABLES_INTERNES' . (N - 9)) 'SLIA' 3 1 1 ;
        X = EXTR (S . 'FORCE_DE_CHOC_NORMALE') 1 ;
        Y = EXTR (S . 'CHPOINT_FORCE_DE_CHOC' . 1) P 'NORM' ;
        E = MAXI ((T . 'VITESSES' . (N - 1)) - V) 'ABS' ;
        L0 = R . L1 . 'FORCE_DE_CHOC_NORMALE' ; LF = PROG ;
        REPE b (N - 1) ;
          S = EXTR (T . 'VARIABLES_INTERNES' . &b) 'SLIA' 3 1 1 ;
          LF = LF ET (S . 'FORCE_DE_CHOC_NORMALE') ;
        FIN b ;
        LW = EXTR L0 (LECT {of_first} 61 'PAS' 60 1501) ; D = MAXI (LF - LW) 'ABS' ;
        """.replace("{first}", first).replace("{of_first}", of_first),
        tmp_path,
    )
    assert root.find("D") < 1e-9
    assert root.find("X") < -50.0
    assert root.find("X") == pytest.approx(root.find("W"))
    assert root.find("Y") == pytest.approx(root.find("W"))
    assert root.find("E") < 1e-9


STEPPED = (
    MASS
    + LINE.format(line="DROI 3 (2. 0.) (-1. 0.)")
    + OF_MODELS
    + """
C = CHAR (MANU 'CHPO' PX 1 'FALF' 3.) (EVOL 'MANU' (PROG 0. 0.2) (PROG 1. 9.)) ;
DEBP TABD ;
  T = TABL 'PASAPAS' ; T . 'MODELE' = M1 ET M2 ET L ; T . 'CARACTERISTIQUES' = A ET AL ;
  T . 'VITESSES' = TABL ; T . 'VITESSES' . 0 = TI . 'VITESSE' ; T . 'DYNAMIQUE' = VRAI ;
  T . 'CHARGEMENT' = C ;
FINP T ;
T = TABD ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-4 0.15 ;
T . 'TEMPS_SAUVES' = PROG 0. 'PAS' 6.E-3 0.15 ; PASAPAS T ; V = T . 'VITESSES' . 25 ;
F = EXTR (T . 'VARIABLES_INTERNES' . 17) 'SLIA' 3 1 1 ;
F = EXTR (F . 'FORCE_DE_CHOC_TANGENTIELLE') 1 ;
S = TABD ; S . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-4 {cut} ;
S . 'TEMPS_SAUVES' = PROG 0. 'PAS' 6.E-3 {cut} ; PASAPAS S ;
"""
)


@together(
    "cut, between", [(0.096, ""), (0.102, "OPTI SAUV 'r' ; SAUV ; OUBL S ; OPTI REST 'r' ; REST ;")]
)
def test_links_go_on_from_the_last_results_of_the_table(cut, between, tmp_path):
    """Two calls, the second in the midst of the contact, are one."""
    root = run(
        STEPPED.format(cut=cut)
        + f"{between} S . 'TEMPS_CALCULES' = PROG {cut} 'PAS' 1.E-4 0.15 ;"
        + f"S . 'TEMPS_SAUVES' = PROG {cut} 'PAS' 6.E-3 0.15 ; PASAPAS S ;"
        """
        N = DIME (S . 'TEMPS') ; T0 = S . 'TEMPS' . 1 ; T1 = S . 'TEMPS' . 25 ;
        G = EXTR (S . 'VARIABLES_INTERNES' . 17) 'SLIA' 3 1 1 ;
        G = EXTR (G . 'FORCE_DE_CHOC_TANGENTIELLE') 1 ;
        E = MAXI ((S . 'VITESSES' . 25) - V) 'ABS' ;
        D = MAXI ((S . 'DEPLACEMENTS' . 3) - (T . 'DEPLACEMENTS' . 3)) 'ABS' ;
        """,
        tmp_path,
    )
    assert (root.find("N"), root.find("T0"), root.find("T1")) == (
        26, pytest.approx(6e-3), pytest.approx(0.15)
    )  # fmt: skip
    assert abs(root.find("F")) > 10.0
    assert root.find("G") == pytest.approx(root.find("F"), rel=1e-9)
    assert max(root.find("E"), root.find("D")) < 1e-9


def test_links_go_on_with_another_step(tmp_path):
    """The half step before has another length then, which must not pass for a velocity."""
    root = run(
        f"""{STEPPED.format(cut=0.096)}
        S . 'TEMPS_CALCULES' = PROG 0.096 'PAS' 5.E-5 0.15 ; S . 'TEMPS_SAUVES' = PROG 0.15 ;
        PASAPAS S ; E = MAXI ((S . 'VITESSES' . 17) - V) 'ABS' ;
        """,
        tmp_path,
    )
    assert root.find("E") < 2e-3


def test_steps_of_links_begin_where_the_times_do(tmp_path):
    root = run(
        f"""{STEPPED.format(cut=0.006)}
        S = TABD ; C = CHAR (MANU 'CHPO' PX 1 'FALF' 2.) (EVOL 'MANU' (PROG -1. 1.) (PROG 1. -1.)) ;
        S . 'CHARGEMENT' = C ; S . 'TEMPS_CALCULES' = PROG -1. 'PAS' 1.E-3 -0.9 ; PASAPAS S ;
        X = EXTR (S . 'VITESSES' . 100) 'ALFA' PX ; Y = S . 'TEMPS' . 100 ;
        """,
        tmp_path,
    )
    assert root.find("Y") == pytest.approx(-0.9)
    assert root.find("X") == pytest.approx(0.5 + (1.0 - 0.9**2) / 2.0)
