"""Two cubes with contact between their sides: they press on each other and do not pull."""

import pytest

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
