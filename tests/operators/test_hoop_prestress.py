"""KSIG of rings on Fourier harmonics: rigid motions do no work, rings buckle at known pressures."""

import numpy as np
import pytest
from script_runs import found
from together import together

RADIUS, YOUNG = 100.0, 20000.0
RING = (
    "OPTI DIME 2 MODE FOUR 0 ELEM QUA8 ; LB = DROI 2 (99.5 0.) (100.5 0.) ; "
    "S = LB TRAN 2 (0. 1.) ; M = MODE S MECANIQUE ELASTIQUE ; "
    f"OPTI MODE FOUR NOHARM ; A = MATE M 'YOUN' {YOUNG} 'NU' 0. ; "
    "B = (BLOQ 'UZ' LB) ET (BLOQ 'UZ' (S COTE 3)) ; OPTI MODE FOUR 0 ; "
    "K0 = (RIGI M A) ET B ET (BLOQ 'UT' S) ; "
    "G = SIGM M A (RESO K0 (PRES 'MASS' M 1. (S COTE 2))) ; "
)


@together("harmonic", [2, 3, 5])
def test_rings_buckle_under_dead_pressure(harmonic):
    """Inextensional modes turn by w (n^2 - 1) / (n R): p = n^2 E (h / R)^3 / 12."""
    frequency = found(
        RING + f"OPTI MODE FOUR {harmonic} ; KG = KSIG M A (-1. * G) 'FLAM' ; "
        "T = VIBR 'SIMU' 0.01 1 ((RIGI M A) ET B) KG ; F = T . 'MODES' . 1 . 'FREQUENCE' ;",
        "F",
    )
    pressure = harmonic**2 * YOUNG / RADIUS**3 / 12
    assert (2 * np.pi * frequency) ** 2 == pytest.approx(pressure, rel=0.015)


@together("harmonic, motion", [(1, "'UR' 1. 'UZ' 0. 'UT' -1."), (0, "'UR' 0. 'UZ' 1. 'UT' 0.")])
def test_translations_do_no_work_on_the_hoop_stress(harmonic, motion):
    work, scale = (
        found(
            RING + f"OPTI MODE FOUR {harmonic} ; KG = KSIG M G A ; "
            f"W = XTMX (MANU 'CHPO' S 3 {field} 'NATU' 'DIFFUS') KG ;",
            "W",
        )
        for field in (motion, "'UR' 1. 'UZ' 0. 'UT' 0.")
    )
    assert abs(work) < 1e-9 * abs(scale)
