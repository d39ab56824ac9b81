"""PASAPAS with GRANDS_DEPLACEMENTS: a stretched string that swings, refusals."""

import numpy as np
import pytest
from scipy.integrate import quad

from ssilang.cli.run import run_text

STRING = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; P1 = 0. 0. ; P2 = 2. 0. ; S = DROI 1 P1 P2 ;
M = MODE S MECANIQUE BARR ; A = MATE M 'YOUN' 1.E4 'NU' 0. 'SECT' 1. 'RHO' 0. ;
C = (BLOQ 'DEPL' P1) ET (BLOQ 'UX' P2) ; CY = BLOQ 'UY' P2 ;
T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; T . 'GRANDS_DEPLACEMENTS' = VRAI ;
T . 'BLOCAGES_MECANIQUES' = C ET CY ; T . 'CONTRAINTES' = TABL ;
T . 'CONTRAINTES' . 0 = MANU 'CHML' M 'EFFX' 50. 'TYPE' 'CONTRAINTES' 'STRESSES' ;
T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI CY 0.5) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0.5 1. ; PASAPAS T ;
"""


def run(script):
    result = run_text(script)
    assert result.exit_code == 0, result.message
    return result.session.root


def energy(u):
    """Of the string, 2 m long, 50 N, ES = 1e4 N."""
    longer = np.hypot(2.0, u) - 2.0
    return 50.0 * longer + 0.5 * 1e4 / 2.0 * longer**2


def test_released_string_swings_with_the_period_of_its_energy():
    root = run(
        STRING
        + """
    F = EXTR (T . 'REACTIONS' . 2) P2 'FY' ; N = MAXI (T . 'CONTRAINTES' . 2) ;
    T . 'DYNAMIQUE' = VRAI ; T . 'MASSE_CONSTANTE' = MASS 'UY' 3. P2 ;
    T . 'BLOCAGES_MECANIQUES' = C ;
    T . 'CHARGEMENT' = CHAR 'MECA' (FORC 'FY' 0. P2) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)) ;
    T . 'TEMPS_CALCULES' = PROG 1. PAS 0.002 2.2 ; PASAPAS T ;
    L = PROG ; X = PROG ; I = 1 ;
    REPE B 601 ; I = I + 1 ; L = L ET (T . 'TEMPS' . I) ;
      X = X ET (EXTR (T . 'DEPLACEMENTS' . I) P2 'UY') ; FIN B ; Z = T . 'CONTINUATION' . 'TEMPS' ;
    """
    )
    length = np.hypot(2.0, 0.5)
    pull = 50.0 + 1e4 * (length / 2.0 - 1.0)
    assert root.find("N") == pytest.approx(pull)
    assert root.find("F") == pytest.approx(pull * 0.5 / length)
    t, x = root.find("L").values, root.find("X").values
    assert x[0] == pytest.approx(0.5)
    whole = energy(0.5)
    turned = quad(
        lambda s: 0.5 * np.cos(s) / np.sqrt(2.0 / 3.0 * (whole - energy(0.5 * np.sin(s)))),
        0.0,
        np.pi / 2,
    )[0]  # a quarter of the period, u = 0.5 sin s
    down = np.flatnonzero((x[:-1] > 0) & (x[1:] <= 0))[0]
    crossed = t[down] + 0.002 * x[down] / (x[down] - x[down + 1]) - 1.0
    assert crossed == pytest.approx(turned, rel=2e-3)
    assert np.abs(x).max() == pytest.approx(0.5, rel=2e-3)
    assert root.find("Z") == pytest.approx(2.2)


def test_plates_are_refused_by_name():
    result = run_text(
        "OPTI DIME 3 ELEM TRI3 ; L = DROI 1 (0. 0. 0.) (1. 0. 0.) ; S = L TRAN 1 (0. 1. 0.) ;"
        "M = MODE S MECANIQUE DKT ; A = MATE M 'YOUN' 1.E4 'NU' 0. 'EPAI' 0.1 ;"
        "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ;"
        "T . 'GRANDS_DEPLACEMENTS' = VRAI ; T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' 'ROTA' L ;"
        "T . 'TEMPS_CALCULES' = PROG 0.5 1. ; PASAPAS T ;"
    )
    assert result.exit_code == 1
    assert "finite displacements are not built for DKT" in result.message
