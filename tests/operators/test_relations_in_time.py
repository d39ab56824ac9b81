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
