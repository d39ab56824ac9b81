"""MATE 'TRAC': a tension test in the place of the hardening curve."""

import numpy as np
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


STRAINS = np.array([0.0, 1e-3, 2e-2, 1e-1])
COLD, WARM = np.array([0.0, 200e6, 300e6, 340e6]), np.array([0.0, 200e6, 220e6, 230e6])


def curve(stresses):
    x, y = (" ".join(map(repr, v.tolist())) for v in (STRAINS, stresses))
    return f"(EVOL 'MANU' 'EPS' (PROG {x}) 'SIG' (PROG {y}))"


@pytest.mark.parametrize("share", [0.0, 0.25])
def test_a_pulled_bar_follows_its_tension_curve(found, share):
    """Alone, or between those of two temperatures: as far from both at the same plastic strain."""
    between = f"NUAG 'COMP' 'T' 0. 100. 'COMP' 'TRAC' {curve(COLD)} {curve(WARM)}"
    there = f"MA = VARI 'NUAG' M MA (MANU 'CHPO' L 1 'T' {100 * share}) 'STRESSES' ; "
    text = material(between) + there if share else material(curve(COLD))
    stress = found(text + PULLED, "X")
    at, parts = 0.03 - stress / 200e9, (COLD, WARM)
    flow = [np.interp(at, (STRAINS - part / 200e9)[1:], part[1:]) for part in parts]
    assert stress == pytest.approx((1 - share) * flow[0] + share * flow[1], rel=1e-6)
