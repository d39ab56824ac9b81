"""MINI and MAXI in time with duals, full Newton, adapted steps and plastic bodies."""

import numpy as np
import pytest

DROP = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0. 0. ; Q = 0. 1. ;
R = (APPU 'UY' 400. P) ET (APPU 'UY' 30. Q) ; B = BLOQ MINI 'UY' P ;
C = MANU 'RIGI' 'TYPE' 'RIGIDITE' (P D 1 Q) (MOTS 'UY') (PROG 900. -900. 900.) ;
M = (MASS 'UY' 2. P) ET (MASS 'UY' 1. Q) ; T = TABL ;
T . 'RIGIDITE_CONSTANTE' = R ET C ; T . 'BLOCAGES_MECANIQUES' = B ;
T . 'MASSE_CONSTANTE' = M ; T . 'DYNAMIQUE' = VRAI ;
T . 'TEMPS_CALCULES' = PROG 0. PAS .01 1. ; T . 'DEPLACEMENTS' = TABL ;
T . 'DEPLACEMENTS' . 0 = MANU 'CHPO' (P ET Q) 1 'UY' .05 ;
T . 'CHARGEMENT' = CHAR 'MECA' (FORC 'FY' -40. P) (EVOL MANU (PROG 0. 9.) (PROG 1. 1.)) ;
"""
HISTORY = """
N = DIME (T . 'DEPLACEMENTS') ; L = PROG ;
REPE I N ; L = L ET (EXTR (T . 'DEPLACEMENTS' . (&I - 1)) 'UY' P) ; FIN I ;
E = T . 'ENERGIES' . 'ECART' ; F = MAXI E ABS ;
"""


def test_full_newton_makes_the_same_steps_as_the_condensed_relations(found):
    first = found(DROP + "PASAPAS T ;" + HISTORY, "L").values
    full = found(DROP + "T . 'NEWTON_COMPLET' = VRAI ; PASAPAS T ;" + HISTORY, "L").values
    assert (np.abs(first) < 1e-12).any(), "it lands"
    assert full == pytest.approx(first, abs=1e-11)


def test_adapted_steps_find_the_impact_between_the_instants(found):
    """Against the same motion in steps 16 times shorter."""
    fine = DROP.replace("PAS .01", "PAS .000625")
    exact = found(fine + "PASAPAS T ;" + HISTORY, "L").values[::16]
    plain = found(DROP + "PASAPAS T ;" + HISTORY, "L").values
    fitted = found(DROP + "T . 'PAS_ADAPTE' = VRAI ; PASAPAS T ;" + HISTORY, "L").values
    early = slice(0, 35)  # impacts of an undamped chain tear solutions apart later on
    error = [np.abs(x - exact)[early].max() for x in (plain, fitted)]
    assert error[1] < 0.5 * error[0]


LEVER = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ;
R = (APPU 'UX' 100. P) ET (APPU 'UX' 50. Q) ;
K = MANU 'RIGI' 'TYPE' 'RIGIDITE' (P D 1 Q) (MOTS 'UX') (PROG 30. -30. 30.) ;
B = RELA 'MAXI' (MANU 'CHPO' Q 1 'UX' 1.) 'DUAL' (MANU 'CHPO' P 1 'FX' {push}) ;
F = FORC 'FX' 10. Q ; D = DEPI B .02 ;
U = RESO (R ET K ET B) (F ET D) ; T = TABL ;
T . 'RIGIDITE_CONSTANTE' = R ET K ; T . 'BLOCAGES_MECANIQUES' = B ;
E = EVOL MANU (PROG 0. 1.) (PROG 0. 1.) ; T . 'TEMPS_CALCULES' = PROG 0. .1 .5 1. ;
T . 'CHARGEMENT' = (CHAR 'MECA' F E) ET (CHAR 'DIMP' D (EVOL MANU (PROG 0. 1.) (PROG 1. 1.))) ;
PASAPAS T ; V = T . 'DEPLACEMENTS' . 3 ; X = EXTR V 'UX' P ; Y = EXTR V 'UX' Q ;
A = EXTR U 'UX' P ; Z = EXTR U 'UX' Q ; W = EXTR (REAC B V) 'FX' P ;
"""


def test_relation_with_a_dual_pushes_where_the_dual_says(found):
    """A stop at Q whose reaction acts on P: the same in steps as by RESO."""
    x, y, a, z, push = found(LEVER.format(push=-1.0), "X", "Y", "A", "Z", "W")
    assert (x, y) == pytest.approx((a, z), rel=1e-10)
    assert y == pytest.approx(0.02)
    # P: (100 + 30) x - 30 y = push ; Q: (50 + 30) y - 30 x = 10
    assert x == pytest.approx((80 * 0.02 - 10) / 30)
    assert push == pytest.approx(130 * x - 30 * 0.02)


def test_an_elastic_block_rocks_on_rigid_stops_and_keeps_its_energy(found):
    """Feet close one after the other and stay closed."""
    off, most = found(
        "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; "
        "L1 = DROI 3 (0. 0.) (1. 0.) ; S1 = L1 TRAN 6 (0. 3.) ; "
        "MO = MODE S1 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 2.E9 'NU' 0.2 'RHO' 2500. ; "
        "M1 = MASS MO MA ; T = TABL ; T . 'MASS' = M1 ; "
        "T . 'RIGI' = (RIGI MO MA) ET (BLOQ 'MINI' 'UY' L1) ET (BLOQ 'UX' (POIN L1 1)) ; "
        "T . 'DEPL' = (NOMC 'UY' (0.01 * (COOR 1 S1))) ET (NOMC 'UX' (-0.01 * (COOR 2 S1))) ; "
        "T . 'VITE' = 0. * (T . 'DEPL') ; "
        "T . 'CHAR' = CHAR 'MECA' (M1 * (NOMC 'UY' ((0. * (COOR 1 S1)) - 9.81))) ; "
        "T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 5.E-4 0.5 ; T2 = DYNAMIC T ; "
        "X = MAXI (ABS (T . 'ENERGIES' . 'ECART')) ; Y = MAXI (T . 'ENERGIES' . 'CINETIQUE') ;",
        "X",
        "Y",
    )
    assert off < 0.03 * most
