"""Impedances, and PASAPAS under OPTI 'MODE' 'FREQ', against closed forms."""

import numpy as np
import pytest

POINT = """
OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; G1 = MANU POI1 P1 ;
{model}
OPTI MODE FREQ ;
T1 = TABL ; T1 . 'MODELE' = MO ; T1 . 'CARACTERISTIQUES' = CA ;
T1 . 'CHARGEMENT' = CHAR MECA (MANU 'CHPO' P1 1 '{force}' 2. 'NATURE' 'DISCRET')
  (EVOL MANU (PROG 0. 100.) (PROG 1. 1.)) ;
T1 . 'TEMPS_CALCULES' = PROG 0.5 1. 2. 5. ; {more}
PASAPAS T1 ;
UR = PROG ; UI = PROG ;
REPE I 4 ; U = T1 . 'DEPLACEMENTS' . &I ;
  UR = UR ET (EXTR U '{unknown}' P1) ; UI = UI ET (EXTR U 'I{unknown}' P1) ; FIN I ;
"""
FREQUENCIES = np.array([0.5, 1.0, 2.0, 5.0])
W = 2.0 * np.pi * FREQUENCIES


def response(found, model, more="", force="FX", unknown="UX"):
    real, imaginary = found(
        POINT.format(model=model, more=more, force=force, unknown=unknown), "UR", "UI"
    )
    return np.array(real.values) + 1j * np.array(imaginary.values)


AMOR = "T1 . 'AMORTISSEMENT' = AMOR MO CA ;"


@pytest.mark.parametrize(
    ("law", "parameters", "more", "stiffness"),
    [
        ("VOIGT", "VISC 12.", AMOR, 400.0 + 12.0j * W),
        ("REUSS", "VISC 12.", "", 1.0 / (1.0 / 400.0 + 1.0 / (12.0j * W))),
        ("COMPLEXE", "VISC 12.", AMOR, 400.0 + 12.0j * W),
        ("COMPLEXE", "VISC 12.", "", 400.0),  # numbers count by a matrix alone, and this is told
        ("", "AMOR 5.", AMOR, 400.0 + 4.0j * W),  # per cent of the critical one
    ],
)
def test_springs_and_dashpots_stand_beside_or_behind_each_other(
    found, law, parameters, more, stiffness
):
    model = f"MO = MODE G1 MECANIQUE ELASTIQUE IMPEDANCE {law} (MOTS UX) ;"
    u = response(found, f"{model} CA = MATE MO RAID 400. MASS 4. {parameters} ;", more)
    np.testing.assert_allclose(u, 2.0 / (stiffness - 4.0 * W**2), rtol=1e-12)


# Rocking disc on a cone (Meek and Wolf): S = K [1 + b2/3 (-1 + i b)/(1 + b2)], b = w z0 / c,
# b2 = b^2, is exactly a spring K with a dashpot that pulls a free mass (the "monkey tail").
SOIL = "K = 9.E8 ; Z = 3. ; CS = 150. ; J = 2.E6 ;"
CONE = (
    SOIL + "FF = PROG 0. PAS 0.1 6. ; B = FF * (2. * PI * Z / CS) ; B2 = B * B ;"
    "SH = B2 / (B2 + 1.) / 3. ; KF = K * (1. - SH) ; CF = SH * (K * Z / CS) ;"
    "MO = MODE G1 MECANIQUE ELASTIQUE IMPEDANCE COMPLEXE (MOTS RZ) ;"
    "CA = MATE MO MASS J MOCO ((EVOL MANU 'FREQ' FF 'MOCO' KF) ET"
    " (EVOL MANU 'FREQ' FF 'VISC' CF)) ;"
)
TAIL = (
    SOIL + "P2 = 1. 0. ; G2 = MANU POI1 P2 ; L1 = MANU SEG2 P1 P2 ;"
    "M1 = MODE G1 MECANIQUE ELASTIQUE IMPEDANCE (MOTS RZ) ; C1 = MATE M1 RAID K MASS J ;"
    "M2 = MODE G2 MECANIQUE ELASTIQUE IMPEDANCE (MOTS RZ) ;"
    "C2 = MATE M2 RAID 0. MASS (K * Z * Z / CS / CS / 3.) ;"
    "M3 = MODE L1 MECANIQUE ELASTIQUE IMPEDANCE VOIGT (MOTS RZ) (MOTS RZ) ;"
    "C3 = MATE M3 RAID 0. VISC (K * Z / CS / 3.) ;"
    "MO = M1 ET M2 ET M3 ; CA = C1 ET C2 ET C3 ;"
)


def test_disc_on_a_cone_is_the_disc_with_a_monkey_tail(found):
    cone = response(found, CONE, force="MZ", unknown="RZ")
    tail = response(found, TAIL, "T1 . 'AMORTISSEMENT' = AMOR MO CA ;", force="MZ", unknown="RZ")
    np.testing.assert_allclose(cone, tail, rtol=1e-10)
    b = W * 3.0 / 150.0
    stiffness = 9e8 * (1.0 + b**2 / 3.0 * (-1.0 + 1j * b) / (1.0 + b**2))
    np.testing.assert_allclose(cone, 2.0 / (stiffness - 2e6 * W**2), rtol=1e-10)


MODES = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; A = 0. 0. ; B = 1. 0. ; L1 = DROI 1 A B ;
M1 = MODE L1 MECANIQUE ELASTIQUE POUT ;
C1 = MATE M1 YOUN 2.E11 NU .3 RHO 7800. SECT .01 INRZ 1.E-5 ;
K1 = (RIGI M1 C1) ET (BLOQ DEPL ROTA A) ET (BLOQ UX B) ; G1 = MASS M1 C1 ;
F1 = MANU 'CHPO' B 1 'FY' 1.E4 'NATURE' 'DISCRET' ; E1 = EVOL MANU (PROG 0. 1.E5) (PROG 1. 1.) ;
OPTI MODE FREQ ; T1 = TABL ; T1 . 'RIGIDITE_CONSTANTE' = K1 ; T1 . 'MASSE_CONSTANTE' = G1 ;
T1 . 'CHARGEMENT' = CHAR MECA F1 E1 ; T1 . 'TEMPS_CALCULES' = PROG 10. 300. ;
T1 . 'AMORTISSEMENT' = 1.E-4 * K1 ;
PASAPAS T1 ;
V1 = VIBR 'SIMU' 1. 2 K1 G1 ;
REPE I 2 ; E = V1 . 'MODES' . &I ;
  Q = MODE (MANU POI1 (E . 'POINT_REPERE')) MECANIQUE ELASTIQUE MODAL ;
  C = MATE Q FREQ (E . 'FREQUENCE') MASS (E . 'MASSE_GENERALISEE') DEFO (E . 'DEFORMEE_MODALE') ;
  SI (EGA &I 1) ; MO = Q ; CA = C ; SINO ; MO = MO ET Q ; CA = CA ET C ; FINS ;
FIN I ;
T2 = TABL ; T2 . 'MODELE' = MO ; T2 . 'CARACTERISTIQUES' = CA ;
T2 . 'CHARGEMENT' = CHAR MECA (PJBA F1 MO CA) E1 ; T2 . 'TEMPS_CALCULES' = PROG 10. 300. ;
T2 . 'AMORTISSEMENT' = 1.E-4 * (RIGI MO CA) ;
PASAPAS T2 ;
UA = T1 . 'DEPLACEMENTS' . 2 ; UB = RECO MO CA (T2 . 'DEPLACEMENTS' . 2) ;
X1 = EXTR UA UY B ; X2 = EXTR UA IUY B ; Y1 = EXTR UB UY B ; Y2 = EXTR UB IUY B ;
"""


def test_all_modes_give_the_response_of_the_whole(found):
    x1, x2, y1, y2 = found(MODES, "X1", "X2", "Y1", "Y2")
    assert complex(y1, y2) == pytest.approx(complex(x1, x2), rel=1e-8)
    assert abs(x2) > 1e-3 * abs(x1)


def test_frequencies_of_the_default_sweep_show_the_resonance(found):
    frequencies, tip = found(
        "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; G1 = MANU POI1 P1 ;"
        "MO = MODE G1 MECANIQUE ELASTIQUE IMPEDANCE (MOTS UX) ; CA = MATE MO RAID 400. MASS 4. ;"
        "OPTI MODE FREQ ; T1 = TABL ; T1 . 'MODELE' = MO ; T1 . 'CARACTERISTIQUES' = CA ;"
        "T1 . 'CHARGEMENT' = CHAR MECA (MANU 'CHPO' P1 1 FX 1. 'NATURE' 'DISCRET')"
        " (EVOL MANU (PROG 0. 2.) (PROG 1. 1.)) ; PASAPAS T1 ;"
        "F = PROG ; U = PROG ; N = (DIME (T1 . 'TEMPS')) - 1 ;"
        "REPE I N ; F = F ET (T1 . 'TEMPS' . &I) ;"
        " U = U ET (EXTR (T1 . 'DEPLACEMENTS' . &I) UX P1) ; FIN I ;",
        "F",
        "U",
    )
    f, u = np.array(frequencies.values), np.array(tip.values)
    natural = 10.0 / (2.0 * np.pi)
    assert f[-1] == pytest.approx(2.0)
    assert np.abs(f / natural - 1.0).min() == pytest.approx(0.002, rel=0.1)
    middle = 0.5 * (f[1:] + f[:-1])
    exact = 1.0 / (400.0 - 4.0 * (2.0 * np.pi * middle) ** 2)
    away = np.abs(middle / natural - 1.0) > 0.003
    np.testing.assert_allclose((0.5 * (u[1:] + u[:-1]))[away], exact[away], rtol=3e-3)


TWO = """
OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; G1 = MANU POI1 P1 ;
MA = MODE G1 MECANIQUE ELASTIQUE IMPEDANCE (MOTS UX) {first} ; CA = MATE MA RAID 3. ;
MB = MODE G1 MECANIQUE ELASTIQUE IMPEDANCE (MOTS UY) {second} ; CB = MATE MB RAID 7. ;
K = RIGI (MA ET MB) (CA ET CB) ; U = RESO K (MANU 'CHPO' P1 2 FX 1. FY 1. 'NATURE' 'DISCRET') ;
X = EXTR U UX P1 ; Y = EXTR U UY P1 ;
"""


@pytest.mark.parametrize(("first", "second"), [("", ""), ("CONS 'A'", "CONS 'B'")])
def test_impedances_on_one_point_keep_their_own_parameters(found, first, second):
    """Told apart by their unknowns, or by the constituents that a script names."""
    x, y = found(TWO.format(first=first, second=second), "X", "Y")
    assert (x, y) == pytest.approx((1.0 / 3.0, 1.0 / 7.0))
