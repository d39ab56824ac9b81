"""Shells of bricks and cubic triangles as scripts use them."""

import numpy as np
import pytest
from scipy.linalg import expm
from script_runs import ran
from together import together

STRIP = """OPTI DIME 3 ELEM CUB8 ;
P1 = 0. 0. 0. ; P2 = 10. 0. 0. ;
S1 = (P1 DROI 10 P2) TRAN 2 (0. 1. 0.) ;
V1 = S1 VOLU 'TRAN' 1 (0. 0. 0.1) ;
MO = MODE V1 MECANIQUE ELASTIQUE SHB8 ;
MA = MATE MO YOUN 2.E11 NU 0. RHO 7800. ;
PE = V1 POIN PLAN P1 (0. 1. 0.) (0. 0. 1.) 1.E-6 ;
K = (RIGI MO MA) ET (BLOQ DEPL PE) ;
"""


def value(text, name, tmp_path):
    return ran(text, output_directory=tmp_path).session.root.find(name)


@together("side, sign", [("EXTERNE", -1), ("INTERNE", 1)])
def test_pressure_on_a_face_of_a_shell_of_bricks_bends_it(side, sign, tmp_path):
    text = STRIP + f"U = RESO K (PRES 'SHB8' MO 1000. '{side}') ;\n"
    text += "X = EXTR U UZ (V1 POIN PROC (10. 0. 0.)) ; "
    theory = 1000.0 * 10**4 / (8 * 2e11 * 0.1**3 / 12)
    assert value(text, "X", tmp_path) == pytest.approx(sign * theory, rel=5e-3)


def test_shell_of_bricks_balances_its_load_and_gives_skin_stress_at_nodes(tmp_path):
    text = STRIP + "F = PRES 'SHB8' MO 1000. 'EXTERNE' ; U = RESO K F ; S = SIGM MO MA U ;\n"
    text += "R = REDU ((BSIG MO S) - F) (DIFF PE (CHAN POI1 V1)) ; X = MAXI ABS R ;\n"
    text += "Y = MAXI (EXCO SMXX (CHAN 'CHPO' MO S)) ; "
    result = ran(text, output_directory=tmp_path)
    assert result.session.root.find("X") < 1e-5  # of 1 000 a node
    # moment at the middle of the first cell, to which the node's value is carried
    skin = 1000.0 * 9.5**2 / 2 * 0.05 / (0.1**3 / 12)
    assert result.session.root.find("Y") == pytest.approx(skin, rel=0.01)


def test_tube_of_cubic_triangles_buckles_under_pressure_that_follows(tmp_path):
    text = """OPTI DIME 3 ELEM QUA4 ;
    C = (0. 1. 0.) CERC 16 (0. 0. 0.) (0. 0. 1.) ;
    S = C TRAN 1 (0.1 0. 0.) ; T = CHAN TRI3 S ;
    E = S COTE 3 ;
    MO = MODE T MECANIQUE ELASTIQUE ISOTROPE COQ3 ;
    LO = MODE T CHARGEMENT PRESSION COQ3 ;
    MA = MATE MO YOUN 2.E11 NU 0.3 EPAI 0.05 ;
    P1 = C POIN 'INIT' ; P2 = C POIN 'FINA' ;
    Q1 = E POIN PROC (0.1 1. 0.) ; Q2 = E POIN PROC (0.1 0. 1.) ;
    CL = (BLOQ (C ET E) 'UX' 'RY' 'RZ') ET (BLOQ P1 'UZ' 'RX') ET (BLOQ Q1 'UZ' 'RX') ;
    CL = CL ET (BLOQ P2 'UY' 'RX') ET (BLOQ Q2 'UY' 'RX') ;
    K = (RIGI MO MA) ET CL ;
    U = RESO K (BSIG LO (PRES LO 'PRES' -1.E6)) ;
    KS = KSIG (SIGM MO MA U) MO MA FLAM ;
    KP = KP LO (MANU 'CHPO' T 1 'SCAL' -1.E6) FLAM ;
    M1 = VIBR PROC (PROG 0.4) (KP ET (-1. * KS)) K ;
    M2 = VIBR PROC (PROG 0.4) (-1. * KS) K ;
    X1 = (2. * PI * (M1 . 'MODES' . 1 . 'FREQUENCE')) ** 2 ;
    X2 = (2. * PI * (M2 . 'MODES' . 1 . 'FREQUENCE')) ** 2 ; """
    result = ran(text, output_directory=tmp_path)
    following, dead = (result.session.root.find(n) for n in ("X1", "X2"))
    exact = 2e11 / (4 * (1 - 0.09)) * 0.05**3 / 1e6  # 3 D / R^3
    assert following == pytest.approx(exact, rel=0.05)
    assert dead / following == pytest.approx(4 / 3, rel=5e-3)


@together("aim", ["(0. 0. -1.)", "'POINT' (5. 0.5 -9.)"])
def test_shells_of_bricks_are_turned_to_go_across_along_a_direction(aim, tmp_path):
    text = STRIP + f"V2 = ORIE V1 {aim} ; F1 = FACE 1 V2 ; F2 = FACE 2 V2 ;\n"
    text += "Z1 = MAXI (COOR 3 F1) ; Z2 = MAXI (COOR 3 F2) ; W1 = MESU V1 ; W2 = MESU V2 ;\n"
    text += "M2 = MODE V2 MECANIQUE ELASTIQUE SHB8 ; A2 = MATE M2 YOUN 2.E11 NU 0. ;\n"
    text += "K2 = (RIGI M2 A2) ET (BLOQ DEPL PE) ; P2 = POIN V2 PROC (10. 0. 0.) ;\n"
    text += "X = EXTR (RESO K2 (PRES 'SHB8' M2 1000. 'INTERNE')) UZ P2 ; "
    result = ran(text, output_directory=tmp_path)
    z1, z2, w1, w2, x = (result.session.root.find(n) for n in ("Z1", "Z2", "W1", "W2", "X"))
    assert (z1, z2) == pytest.approx((0.1, 0.0))
    assert w2 == pytest.approx(w1)
    # the first face is now the upper one: the pressure pushes down
    assert x == pytest.approx(-1000.0 * 10**4 / (8 * 2e11 * 0.1**3 / 12), rel=5e-3)


@together(
    "cells, held, named",
    [
        ("G = MANU 'POI1' P ;", "", ""),
        ("G = MANU 'SEG2' P (1. 0.) ;", "ET (BLOQ 'UX' (1. 0.))", "'BARR'"),
    ],
)
def test_a_spring_and_a_dashpot_in_series_move_in_time_as_maxwell_says(cells, held, named):
    """`m v' = -f, f' = k v - (k / c) f`, by the exponential of its matrix."""
    k, c = 400.0, 12.0
    hold = "" if not held else "ET (BLOQ 'UX' (G POIN 2))"
    result = ran(
        f"OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0. 0. ; {cells} "
        f"MO = MODE G 'MECANIQUE' 'ELASTIQUE' 'IMPEDANCE' 'REUSS' {named} (MOTS UX) ; "
        f"CA = MATE MO 'RAID' {k} 'VISC' {c} ; T1 = TABL ; "
        f"T1 . 'RIGI' = (RIGI MO CA) {hold} ; T1 . 'AMOR' = AMOR MO CA ; "
        "T1 . 'MASS' = MASS 'UX' 1. P ; T1 . 'VITE' = MANU 'CHPO' P 'UX' 1. ; "
        "T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 0.5 ; T2 = DYNAMIC T1 ; "
        "E1 = EVOL 'TEMP' T2 'DEPL' 'UX' P ;"
    )
    told = ["operators.models.element-of-impedances"] if named else []
    assert [w.code for w in result.session.warnings if ".models." in w.code] == told
    part = result.session.root.find("E1").parts[0]
    motion = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [0.0, k, -k / c]])
    exact = [(expm(motion * t) @ [0.0, 1.0, 0.0])[0] for t in part.abscissas]
    np.testing.assert_allclose(part.ordinates, exact, atol=1e-5)
    assert exact[-1] > 0.08  # it stays there: nothing pulls it back


@together(
    "law, moves",
    [
        ("REUSS", [[0, 1, 0], [0, 0, -1], [0, 400, -400 / 12]]),
        ("VOIGT", [[0, 1], [-400, -12]]),
    ],
)
@together("damped", ["", "T1 . 'AMORTISSEMENT' = AMOR MO CA ;"])
def test_pasapas_has_the_dashpot_of_a_law_once(law, moves, damped):
    """Whether a matrix brings it or not: the exponential of the motion's matrix."""
    result = ran(
        "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0. 0. ; "
        f"MO = MODE P 'MECANIQUE' 'ELASTIQUE' 'IMPEDANCE' '{law}' (MOTS UX) ; "
        "CA = MATE MO 'RAID' 400. 'VISC' 12. 'MASS' 1. ; T1 = TABL ; T1 . 'MODELE' = MO ; "
        f"T1 . 'CARACTERISTIQUES' = CA ; T1 . 'DYNAMIQUE' = VRAI ; {damped} "
        "T1 . 'VITESSES' = TABL ; T1 . 'VITESSES' . 0 = MANU 'CHPO' P 'UX' 1. ; "
        "T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 0.1 ; PASAPAS T1 ; "
        "X = EXTR (T1 . 'DEPLACEMENTS' . 100) 'UX' P ;"
    )
    start = [0.0, 1.0, 0.0][: len(moves)]
    exact = (expm(np.array(moves) * 0.1) @ start)[0]
    assert result.session.root.find("X") == pytest.approx(exact, rel=1e-3)


def test_load_steps_tell_dashpots_that_have_no_rates():
    result = ran(
        "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0. 0. ; T1 = TABL ; "
        "MO = MODE P 'MECANIQUE' 'ELASTIQUE' 'IMPEDANCE' 'VOIGT' (MOTS UX) ; T1 . 'MODELE' = MO ; "
        "T1 . 'CARACTERISTIQUES' = MATE MO 'RAID' 400. 'VISC' 12. ; "
        "T1 . 'TEMPS_CALCULES' = PROG 0. 1. ; E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ; "
        "T1 . 'CHARGEMENT' = CHAR 'MECA' (FORC FX 4. P) E ; PASAPAS T1 ; "
    )
    codes = [w.code for w in result.session.warnings]
    assert "operators.statics.dashpots-at-rest" in codes


def test_pressure_on_shells_goes_towards_a_point(found, refused):
    script = (
        "OPTI DIME 3 MODE TRID ELEM QUA4 ; L = DROI 2 (0 0 0) (2 0 0) ; A = L TRAN 2 (0 1 0) ; "
        "B = A PLUS (0 0 1) ; M = MODE (A ET B) 'MECANIQUE' 'ELASTIQUE' 'COQ4' ; "
        "F = PRES 'COQU' M 3. 'POIN' (1. 0.5 0.5) (CARA M 'EPAI' 0.1) ; "
        "X = MAXI (RESU (REDU F A)) ; Y = MINI (RESU (REDU F B)) ; "
        "Z = MAXI 'ABS' (RESU (PRES 'COQU' M 3. 'NORM')) ; "
        "W = MINI (RESU (FSUR 'COQU' M (0. 0. -2.) (CARA M 'EPAI' 0.1))) ; "
    )
    assert found(script, "X", "Y", "Z", "W") == pytest.approx((6.0, -6.0, 12.0, -8.0))
    flat = script + "G = «PRES» 'COQU' M 3. 'POIN' (9. 9. 1.) ;"
    assert "4 shell cells lie along the vector" in refused(flat)
    steep = script + "G = PRES 'COQU' M 3. (1. 0. 0.03) ; H = «PRES» 'COQU' M 3. (1. 0. 0.01) ;"
    assert "8 shell cells" in refused(steep)
