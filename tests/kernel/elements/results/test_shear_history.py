"""Largest shear strain over a motion."""

import numpy as np
from script_runs import finder, found

_BLOCK = (
    "OPTI DIME 3 ELEM CU20 ; L = DROI 1 (0. 0. 0.) (1. 0. 0.) ; S = TRAN 1 L (0. 2. 0.) ;"
    "V = VOLU 'TRAN' 2 S (0.3 0. 3.) ; M = MODE V MECANIQUE ELASTIQUE ; X Y Z = COOR V ;"
)


def largest(script):
    field = found(script, "G")
    return np.concatenate([b.components["SCAL"].ravel() for b in field.blocks])


def test_simple_shear_is_its_own_strain_and_the_largest_counts():
    script = _BLOCK + "U = NOMC 'UY' (Z * 3.E-3) ; G = ZGAM M (SUIT U (U * -2.) (U * 0.5)) ;"
    np.testing.assert_allclose(largest(script), 6e-3)


def test_any_linear_motion_gives_the_deviator():
    gradient = np.array([[1.0, 2, -1], [0, -2, 3], [4, 1, 5]]) * 1e-4
    words = " ET ".join(
        f"(NOMC 'U{a}' ((X * {g[0]}) + (Y * {g[1]}) + (Z * {g[2]})))"
        for a, g in zip("XYZ", gradient, strict=True)
    )
    e = (gradient + gradient.T) / 2
    e -= np.eye(3) * np.trace(e) / 3
    script = _BLOCK + f"G = ZGAM M (SUIT ({words})) ;"
    np.testing.assert_allclose(largest(script), np.sqrt(2 * (e * e).sum()))


def test_recorded_motion_gives_what_its_fields_give():
    script = _BLOCK + (
        "A = MATE M 'YOUN' 1.E7 'NU' 0.3 'RHO' 2000. ; T = TABL ;"
        "T . 'RIGI' = (RIGI M A) ET (BLOQ 'DEPL' S) ; T . 'MASS' = MASS M A ;"
        "T . 'VITE' = NOMC 'UY' (Z * Z) ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.002 'NPAS' 20 ;"
        "T . 'PAS_SAUVES' = MOT 'TOUS' ; R = DYNAMIC T ; G = ZGAM M R ; L = SUIT ;"
        " REPE K 21 ; L = L ET (R . &K . 'DEPL') ;"
        "FIN K ; G2 = ZGAM M L ; D = MAXI (ABS (G - G2)) ; E = MINI G2 ;"
    )
    find = finder(script)
    assert find("D") < 1e-12 * find("E")
    assert find("E") > 1e-5


def test_round_solids_count_the_hoop():
    script = (
        "OPTI DIME 2 MODE AXIS ELEM QUA8 ; S = TRAN 1 (DROI 1 (1. 0.) (2. 0.)) (0. 1.) ;"
        "M = MODE S MECANIQUE ELASTIQUE ; R = COOR 1 S ; G = ZGAM M (SUIT (NOMC UR (R * 3.E-3))) ;"
    )
    # strains (3, 0, 3): deviator (1, -2, 1)
    np.testing.assert_allclose(largest(script), 1e-3 * np.sqrt(2 * 6))
