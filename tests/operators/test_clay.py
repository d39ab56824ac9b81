"""A triaxial test on clay in PASAPAS: pressed by forces, sheared by a displacement."""

import pytest


def test_a_drained_triaxial_test_ends_in_the_critical_state(found):
    """Normally consolidated at s3, then shortened: q = 3 M s3 / (3 - M) where nothing changes."""
    script = (
        "OPTI DIME 2 MODE AXIS ELEM QUA4 ; B = DROI 1 (0. 0.) (1. 0.) ; S = B TRAN 1 (0. 1.) ; "
        "H = S POIN 'DROIT' (0. 1.) (1. 1.) 1.E-6 ; C = DROI 1 (1. 0.) (1. 1.) ; "
        "ELIM 1.E-6 (S ET C) ; M = MODE S MECANIQUE ELASTIQUE PLASTIQUE CAM_CLAY ; "
        "A = MATE M 'YOUN' 2.E7 'NU' 0.3 'E0' 1. 'M' 1. 'P0' 1.E5 'KAPA' 0.05 'LAMD' 0.2 "
        "'G1' 8.E6 ; BH = BLOQ 'UZ' H ; T = TABL ; T . 'MODELE' = M ; "
        "T . 'CARACTERISTIQUES' = A ; T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UZ' B) ET BH ET "
        "(BLOQ 'UR' (S POIN 'DROIT' (0. 0.) (0. 1.) 1.E-6)) ; "
        "T . 'CHARGEMENT' = (CHAR 'MECA' (PRES 'MASS' M C 2.E5) (EVOL 'MANU' (PROG 0. 1. 2.) "
        "(PROG 0. 1. 1.))) ET (CHAR 'DIMP' (DEPI BH -1.) (EVOL 'MANU' (PROG 0. 1. 2.) "
        "(PROG 0. 0.1 0.9))) ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 2. ; PASAPAS T ; "
        "SC = T . 'CONTRAINTES' . 20 ; SR = EXTR SC 'SMRR' 1 1 1 ; SZ = EXTR SC 'SMZZ' 1 1 1 ; "
        "V = EXTR (T . 'VARIABLES_INTERNES' . 20) 'VPLA' 1 1 1 ; "
    )
    sr, sz, lost = found(script, "SR", "SZ", "V")
    assert abs(sr) == pytest.approx(2e5, rel=1e-4)
    assert abs(sz - sr) == pytest.approx(3 * 2e5 / (3 - 1), rel=2e-2)
    assert lost > 0.05
