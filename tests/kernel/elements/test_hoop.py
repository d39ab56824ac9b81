"""Rings about the axis (CERC) against a ring of wire: stiffness, pulsation, yield."""

import numpy as np
import pytest
from script_runs import found

RING = (
    "OPTI DIME 2 MODE AXIS ; P = {r} 0. ;"
    "M = MODE (MANU POI1 P) 'MECANIQUE' 'ELASTIQUE' 'CERC' ;"
    "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'SECT' 1.E-4 'RHO' 7800. ; B = BLOQ 'UZ' P ;"
)


def test_a_ring_breathes_at_the_speed_of_sound_over_its_radius():
    """Frequency sqrt(E / rho) / (2 pi r); tension N stiffens by N / (E S)."""
    script = RING.format(r=2.0) + (
        "K = (RIGI M A) ET B ; W = MASS M A ; F = VIBR 'PROC' (PROG 400.) K W ;"
        "X = F . 'MODES' . 1 . 'FREQUENCE' ; S = SIGM M A (MANU 'CHPO' P 2 'UR' 2.E-3 'UZ' 0.) ;"
        "G = VIBR 'PROC' (PROG 400.) (K ET (KSIG M S)) W ; Y = G . 'MODES' . 1 . 'FREQUENCE' ;"
    )
    free, tight = found(script, "X", "Y")
    assert free == pytest.approx(np.sqrt(2e11 / 7800.0) / (4.0 * np.pi), rel=1e-9)
    assert tight / free == pytest.approx(np.sqrt(1.0 + 1e-3), rel=1e-9)
