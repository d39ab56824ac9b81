"""Contact between sides: patch tests of all formulations, openings, sliding, refusals."""

import pytest

PLANE = """
OPTI DIME 2 ELEM QUA4 MODE PLAN CONT ;
A = DROI 7 (-5. 1.) (5. 1.) ; S = A TRAN 5 (0. 10.) ;
C = DROI 5 (-10. .9998) (10. .9998) ; Z = C TRAN 2 (0. -4.) ;
M = (MODE S MECANIQUE ELASTIQUE) ET (MODE Z MECANIQUE ELASTIQUE) ;
G = MATE M YOUN 1.E3 NU .3 ;
TOP = BLOQ UY (COTE 3 S) ; LEFT = BLOQ UX (COTE 4 S) ; BASE = BLOQ UX UY Z ;
T = TABLE ; T.CARACTERISTIQUES = G ; T.BLOCAGES_MECANIQUES = TOP ET LEFT ET BASE ;
T.TEMPS_CALCULES = PROG 0. 1. 2. ;
T.CHARGEMENT = CHAR DIMP (DEPI TOP -1.E-3) (EVOL MANU (PROG 0. 1. 2.) (PROG 0. 1. .1)) ;
"""
# A runs to the right: its body lies on the left, the other on the right, as it must


@pytest.mark.parametrize("method", ["FAIB", ""])
def test_uniform_pressure_passes_between_meshes_that_do_not_match(found, method):
    low, high, opened = found(
        PLANE + f"T.MODELE = M ET (MODE (INVE C) CONTACT UNILATERAL A {method}) ; PASAPAS T ; "
        "Y = EXCO SMYY (REDU (T.CONTRAINTES . 1) (MODE S MECANIQUE ELASTIQUE)) ; "
        "A1 = MINI Y ; A2 = MAXI Y ; O = MAXI (T.CONTRAINTES . 2) ABS ;",
        "A1",
        "A2",
        "O",
    )
    wanted = -1e3 * (1e-3 - 2e-4) / 10
    assert (low, high) == pytest.approx((wanted, wanted), rel=1e-8)
    assert opened == pytest.approx(0.0, abs=1e-12)


def test_least_distance_is_kept(found):
    low, high = found(
        PLANE + "K = MODE (INVE C) CONTACT UNILATERAL A 'FAIBLE' ; "
        "T.CARACTERISTIQUES = G ET (MATE K JEU (MANU CHML K JEU 1.E-4)) ; "
        "T.MODELE = M ET K ; PASAPAS T ; "
        "Y = EXCO SMYY (REDU (T.CONTRAINTES . 1) (MODE S MECANIQUE ELASTIQUE)) ; "
        "A1 = MINI Y ; A2 = MAXI Y ;",
        "A1",
        "A2",
    )
    wanted = -1e3 * (1e-3 - 1e-4) / 10
    assert (low, high) == pytest.approx((wanted, wanted), rel=1e-8)


def test_body_free_to_slide_is_held_by_contact_alone(found):
    """Nothing stops the block along the surface, and no load drives it there."""
    low, side = found(
        PLANE.replace("TOP ET LEFT ET BASE", "BASE")
        + "T.CHARGEMENT = CHAR MECA (PRES MASS M 2. (COTE 3 S)) "
        "(EVOL MANU (PROG 0. 2.) (PROG 0. 2.)) ; "
        "T.MODELE = M ET (MODE (INVE C) CONTACT A FAIB) ; PASAPAS T ; "
        "Y = EXCO SMYY (REDU (T.CONTRAINTES . 2) (MODE S MECANIQUE ELASTIQUE)) ; A1 = MINI Y ; "
        "R = MAXI (EXCO UX (T.DEPLACEMENTS . 2)) ABS ;",
        "A1",
        "R",
    )
    assert low == pytest.approx(-4.0, rel=1e-6)
    assert side < 1.0


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
