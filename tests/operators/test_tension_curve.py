"""MATE 'TRAC': a tension test in the place of the hardening curve."""

import pytest

BAR = (
    "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; B = 1. 0. ; L = DROI 1 A B ; "
    "M = MODE L MECANIQUE ELASTIQUE PLASTIQUE ISOTROPE BARR ; "
)
PULLED = (
    "BA = BLOQ 'UX' 'UY' A ; BB = BLOQ 'UX' B ; BC = BLOQ 'UY' B ; "
    "E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.) ; "
    "C = CHAR 'DIMP' (DEPI BB 0.03) E ; T = TABL ; T . 'MODELE' = M ; "
    "T . 'CARACTERISTIQUES' = MA ; T . 'BLOCAGES_MECANIQUES' = BA ET BB ET BC ; "
    "T . 'CHARGEMENT' = C ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ; PASAPAS T ; "
    "X = MAXI (EXCO 'EFFX' (T . 'CONTRAINTES' . 10)) ; "
)


def material(curve, young="200.E9"):
    return BAR + f"MA = MATE M 'YOUN' {young} 'NU' 0.3 'SECT' 1. 'TRAC' ({curve}) ; "


def test_a_pulled_bar_follows_its_tension_curve(found):
    curve = "EVOL 'MANU' (PROG 0. 1.E-3 2.E-2 1.E-1) (PROG 0. 200.E6 300.E6 340.E6)"
    stress = found(material(curve) + PULLED, "X")
    assert stress == pytest.approx(300.0e6 + (0.03 - 0.02) / (0.1 - 0.02) * 40.0e6, rel=1e-6)
