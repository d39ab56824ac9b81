"""Two cubes with contact between their sides: they press on each other and do not pull."""

import pytest

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
