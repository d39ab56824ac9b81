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
