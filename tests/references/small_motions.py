"""Decks of one degree of freedom that moves: on a spring, on a joint that opens."""

OSCILLATOR = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
P = 0. 0. ; Q = -1. 0. ; L = DROI 1 Q P ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
MA = MATE MO 'YOUN' 4. 'NU' 0. 'SECT' 1. 'RHO' 0. ;
T1 = TABL ;
T1 . 'RIGI' = (RIGI MO MA) ET (BLOQ 'UX' 'UY' Q) ET (BLOQ 'UY' P) ;
T1 . 'MASS' = MASS 'DEPL' 1. P ;
T1 . 'VITE' = MANU 'CHPO' P 1 'UX' 1. ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.01 1. ;
"""

HOPPER = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;
SOL = 0. -1. ; P = 0. 0. ;
J = MANU 'SEG2' SOL P ;
MO = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
MA = MATE MO 'KN' 1000. 'KS' 0. ;
T1 = TABL ;
T1 . 'RIGI' = (BLOQ 'UX' 'UY' SOL) ET (BLOQ 'UX' P) ;
T1 . 'MASS' = MASS 'DEPL' 1. P ;
T1 . 'CHAR' = CHAR 'MECA' (FORC (0. -9.81) P) ;
T1 . 'DEPL' = MANU 'CHPO' P 1 'UY' -0.05 ;
T1 . 'MODELE' = MO ; T1 . 'CARACTERISTIQUES' = MA ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 0.5 ;
"""
