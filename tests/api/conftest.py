"""One small run for all tests: a mass of 1 kg on a bar of 100 N/m, let go at 0.1 m."""

import pytest

import ssilang

OSCILLATOR = """OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
A0 = 0.1 ;
P0 = 0. 0. ; P1 = 1. 0. ; L = P0 D 1 P1 ; G0 = 0. 0. ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
MA = MATE MO 'YOUN' 100. 'NU' 0. 'SECT' 1. 'RHO' 0. ;
RI = (RIGI MO MA) ET (BLOQ 'DEPL' P0) ET (BLOQ 'UY' P1) ; MS = MASS 'DEPL' 1. P1 ;
T1 = TABL ; T1 . 'RIGI' = RI ; T1 . 'MASS' = MS ;
T1 . 'DEPL' = MANU 'CHPO' P1 1 'UX' A0 ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.002 1. ; T1 . 'PAS_SAUVES' = 10 ;
T2 = DYNAMIC T1 ;
U0 = RESO RI (MANU 'CHPO' P1 1 'FX' 5.) ;
SIG = SIGM MO MA U0 ;
SORT 'BILA' 'peak' (MAXI (EXTR (EVOL 'TEMP' T2 'DEPL' 'UX' P1) 'ORDO')) A0 1.E-9 ;
SORT 'BILA' 'mass' 2. 1. 0.5 ;
DESS (EVOL 'TEMP' T2 'DEPL' 'UX' P1) ;
MESS 'done' ;
"""


@pytest.fixture(scope="module")
def swing():
    """The run, with 0.2 m in place of 0.1."""
    return ssilang.run(OSCILLATOR, A0=0.2)


@pytest.fixture
def oscillator():
    """The deck."""
    return OSCILLATOR
