"""DYNE from scripts: its tables, results, links, restart and recombination."""

import numpy as np
import pytest

from ssilang.cli.run import run_text

BAR = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; A = 0. 0. ; B = 8. 0. ; L = DROI 8 A B ;
MO = MODE L MECANIQUE ELASTIQUE BARR ;
MA = MATE MO 'YOUN' 64. 'NU' 0. 'SECT' 1. 'RHO' 1. ;
K = (RIGI MO MA) ET (BLOQ 'UX' A) ET (BLOQ 'UY' L) ; M = MASS MO MA ;
T = VIBR 'SIMU' 0.1 2 K M ; F = FORC 'FX' 4. (L POIN 'PROC' (5. 0.)) ;
"""


def run(script, tmp_path):
    result = run_text(script, output_directory=tmp_path)
    assert result.exit_code == 0, result.message
    return result.session.root


def test_pseudo_mode_completes_a_slow_answer_to_the_static_one(tmp_path):
    root = run(
        BAR
        + """
        T . 'PSEUDO_MODES' = PSMO K (T . 'MODES') F ;
        C = CHAR F (EVOL 'MANU' (PROG 0. 200. 400.) (PROG 0. 1. 1.)) ;
        TC = TABL 'CHARGEMENT' ; TC . 'BASE_A' = PJBA T C ;
        R = DYNE 'DE_VOGELAERE' T TC 4000 0.1 10 ;
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
    assert root.find("N1") == 401


LINKED = (
    BAR
    + """
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
)


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
        LINKED
        + """
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
        LINKED
        + """
        TS . 'VARIABLE' . 'TYPE_SORTIE' = MOT 'LISTREEL' ; R = DYNE 'FOX_GOODWIN' T TS TI 50 0.01 ;
        Q = DYNE 'FOX_GOODWIN' T TI 50 0.01 ;
        W = R . 'VITESSE' . 1 ; N = DIME W ; X = EXTR W 51 ;
        E = EVOL 'SOLU' Q 'VITE' T 'ALFA' ; EY = EXTR E 'ORDO' 1 ; Y = EXTR EY 51 ;
        """,
        tmp_path,
    )
    assert root.find("N") == 51
    assert root.find("X") == pytest.approx(root.find("Y"))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ("L1 . 'TYPE_LIAISON' = MOT 'LIGNE_LIGNE_FROTTEMENT' ;", "it may be"),
        ("L1 . 'NORMALE' = 0. 0. ;", "has no length"),
        ("L1 . 'RAIDEUR' = -1. ;", "has no positive stiffness"),
        ("OUBL L1 'RAIDEUR' ;", "the link has no 'RAIDEUR'"),
        ("OUBL L1 'NORMALE' ;", "marks no mode"),
    ],
)
def test_faulty_links_are_named(change, sentence, tmp_path):
    script = LINKED + change + " R = DYNE 'DE_VOGELAERE' T TL TI 3 0.01 ;"
    result = run_text(script, output_directory=tmp_path)
    assert result.exit_code == 1
    assert sentence in result.message


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
    script = (
        WHEEL
        + """
    R = DYNE 'DE_VOGELAERE' T TL C TI TS 4000 2.E-4 4000 ;
    X = EXTR (R . 2 . 'VITESSE') 'ALFA' (T . 'MODES' . 1 . 'POINT_REPERE') ;
    W = EXTR (R . 2 . 'VITESSE') 'ALFA' (T . 'MODES' . 3 . 'POINT_REPERE') ;
    """
    )
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


@pytest.mark.parametrize("change", ["L1 . 'RAYON_SUPPORT' = 0. ;", "OUBL L1 'RAYON_SUPPORT' ;"])
def test_disc_on_a_plane_wants_its_radius(change, tmp_path):
    script = WHEEL + change + "R = DYNE 'DE_VOGELAERE' T TL C TI TS 3 1.E-4 ;"
    result = run_text(script, output_directory=tmp_path)
    assert result.exit_code == 1
    assert "RAYON_SUPPORT" in result.message
