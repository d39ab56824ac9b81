"""A deck of two bodies on unilateral joints, pushed to and fro until they rock."""

ROCKING = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; T = TABL ;
PC = 0. 0. ; PG = 0. 3. ; PL = -1. 0. ; PR = 1. 0. ; PSL = -1. -1. ; PSR = 1. -1. ;
JOI = (MANU 'SEG2' PSL PL) ET (MANU 'SEG2' PSR PR) ;
MOJ = MODE JOI 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
BLO = (BLOQ 'UX' 'UY' (PSL ET PSR)) ET (BLOQ 'UX' (PL ET PR ET PC)) ;
BLO = BLO ET (RELA 'UY' PL - 'UY' PC + 1. 'RZ' PC) ET (RELA 'UY' PR - 'UY' PC - 1. 'RZ' PC) ;
BLO = BLO ET (RELA 'UY' PG - 'UY' PC) ET (RELA 'UX' PG + 3. 'RZ' PC) ;
T . 'MASS' = (MASS 'DEPL' 1.E5 PG) ET (MASS 'ROTA' 1.E5 PC) ;
T . 'RIGI' = BLO ; T . 'MODELE' = MOJ ; T . 'CARACTERISTIQUES' = MATE MOJ 'KN' 1.E8 'KS' 0. ;
T . 'VITE' = MANU 'CHPO' PG 1 'UX' 0.3 ;
T . 'CHAR' = (CHAR 'MECA' (FORC (0. -1.E6) PG)) ET
  (CHAR 'MECA' (FORC (2.E5 0.) PG) (EVOL 'MANU' (PROG 0. 0.3 0.6 9.) (PROG 0. 1. -1. 0.5))) ;
T . 'TEMPS_CALCULES' = PROG 0. PAS 0.005 0.5 ; T . 'PAS_SAUVES' = 3 ; T . 'EXTREMES' = VRAI ;
T . 'PAS_SAUVES_VTK' = 40 ; T . 'MAILLAGE_VTK' = JOI ; T . 'FICHIER_VTK' = 'rock' ;
T . 'PAS_SAUVES_CSV' = 2 ; T . 'MAILLAGE_CSV' = PG ET PC ; T . 'FICHIER_CSV' = 'rock' ;
"""
