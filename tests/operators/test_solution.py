"""SOLUTION: modes by hand, joined, read, as a table, with stresses."""

import pytest
from script_runs import ran

MODES = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L = DROI 2 (0. 0.) (4. 0.) ;
M = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; A = MATE M 'YOUN' 6. 'NU' 0. 'SECT' 1. 'RHO' 1. ;
K = (RIGI M A) ET (BLOQ 'UX' (0. 0.)) ; U = NOMC 'UX' ((COOR 1 L) * 0.25) ;
V = NOMC 'UX' (COOR 1 L) ; S = (MANU 'MODE' 'NUME' 7 1.5 2. 0.1 0.2 U) ET (MANU 'MODE' 3. 4. V) ;
"""


def run(script, tmp_path):
    return ran(script, output_directory=tmp_path).session.root


def test_a_solution_of_vibr_is_the_table_of_vibr(tmp_path):
    root = run(
        f"""{MODES}
        MA = MASS M A ; K = K ET (BLOQ 'UY' L) ; B = VIBR 'SIMU' 0.1 2 K MA ;
        T = TRADUIRE (SIGS M A (VIBR 'SIMU' 0.1 2 K MA 'SOLU')) ;
        F1 = T . 1 . 'FREQUENCE' ; F2 = B . 'MODES' . 1 . 'FREQUENCE' ;
        U1 = T . 2 . 'DEFORMEE_MODALE' ; U2 = B . 'MODES' . 2 . 'DEFORMEE_MODALE' ;
        S1 = MAXI (T . 2 . 'CONTRAINTE_MODALE') 'ABS' ; S2 = MAXI (SIGM M A U2) 'ABS' ;
        Q1 = T . 2 . 'DEPLACEMENTS_GENERALISES' . 1 ;
        Q2 = B . 'MODES' . 2 . 'DEPLACEMENTS_GENERALISES' . 1 ;
        D = (MAXI (U1 - U2) 'ABS') ; E = (MAXI (U1 + U2) 'ABS') ;
        N = DIME (VIBR 'SIMU' 0.1 2 K MA 'SOLU') ;
        """,
        tmp_path,
    )
    assert root.find("F1") == pytest.approx(root.find("F2"))
    assert min(root.find("D"), root.find("E")) < 1e-9
    assert root.find("S1") == pytest.approx(root.find("S2"))
    assert abs(root.find("Q1")) == pytest.approx(abs(root.find("Q2")))
    assert root.find("N") == 2
