"""Rings about the axis (CERC) against a ring of wire: stiffness, pulsation, yield."""

import numpy as np
import pytest
from script_runs import found

RING = (
    "OPTI DIME 2 MODE AXIS ; P = {r} 0. ;"
    "M = MODE (MANU POI1 P) 'MECANIQUE' 'ELASTIQUE' {law} 'CERC' ;"
    "A = MATE M 'YOUN' 2.E11 'NU' 0.3 'SECT' 1.E-4 'RHO' 7800. {values} ; B = BLOQ 'UZ' P ;"
)


def test_a_ring_widens_by_f_r_over_2_pi_e_s():
    """1 kN all round: u = F r / (2 pi E S), the force in the ring is F / 2 pi."""
    script = RING.format(r=2.0, law="", values="") + (
        "K = RIGI M A ; U = RESO (K ET B) (MANU 'CHPO' P 1 'FR' 1000.) ; X = EXTR U 'UR' P ;"
        "S = SIGM M A U ; N = EXTR S 'EFFX' 1 1 1 ; F = EXTR (BSIG M S) 'FR' P ;"
    )
    widening, force, inner = found(script, "X", "N", "F")
    assert widening == pytest.approx(1000.0 * 2.0 / (2.0 * np.pi * 2e11 * 1e-4), rel=1e-12)
    assert force == pytest.approx(1000.0 / (2.0 * np.pi), rel=1e-12)
    assert inner == pytest.approx(1000.0, rel=1e-12)


def test_a_ring_breathes_at_the_speed_of_sound_over_its_radius():
    """Frequency sqrt(E / rho) / (2 pi r); tension N stiffens by N / (E S)."""
    script = RING.format(r=2.0, law="", values="") + (
        "K = (RIGI M A) ET B ; W = MASS M A ; F = VIBR 'PROC' (PROG 400.) K W ;"
        "X = F . 'MODES' . 1 . 'FREQUENCE' ; S = SIGM M A (MANU 'CHPO' P 2 'UR' 2.E-3 'UZ' 0.) ;"
        "G = VIBR 'PROC' (PROG 400.) (K ET (KSIG M S)) W ; Y = G . 'MODES' . 1 . 'FREQUENCE' ;"
    )
    free, tight = found(script, "X", "Y")
    assert free == pytest.approx(np.sqrt(2e11 / 7800.0) / (4.0 * np.pi), rel=1e-9)
    assert tight / free == pytest.approx(np.sqrt(1.0 + 1e-3), rel=1e-9)


def test_a_ring_yields_as_a_wire():
    """Strain 0.002 beyond 0.001 at the slope E H / (E + H)."""
    law, values = "'PLASTIQUE' 'CINEMATIQUE'", "'SIGY' 2.E8 'H' 2.E10"
    script = RING.format(r=2.0, law=law, values=values) + (
        "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; C = BLOQ 'UR' P ;"
        "T . 'BLOCAGES_MECANIQUES' = B ET C ; T . 'TEMPS_CALCULES' = PROG 0. 1. ;"
        "T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI C 4.E-3) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;"
        "PASAPAS T ; N = EXTR (T . 'CONTRAINTES' . 1) 'EFFX' 1 1 1 ;"
    )
    force = found(script, "N")
    slope = 2e11 * 2e10 / (2e11 + 2e10)
    assert force == pytest.approx(1e-4 * (2e8 + slope * 1e-3), rel=1e-9)


def test_a_ring_in_a_harmonic_lengthens_by_both_displacements():
    """A ring in translation (n = 1) carries nothing; n = 2 has the energy of the wire's strain.

    Tension stiffens by what turns: N times half of the squared slopes, summed over the turn.
    """
    r, n, u, w, v = 2.0, 2, 1e-3, 4e-4, -3e-4
    move = "U = MANU 'CHPO' P 3 'UR' {0} 'UZ' {1} 'UT' {2} ; K = RIGI M A ; S = SIGM M A U ;"
    script = (
        RING.replace("MODE AXIS", "MODE FOUR {n}")
        .partition(" B = ")[0]
        .replace("{r}", f"{r}")
        .replace("{law}", "")
        .replace("{values}", "")
    )
    energy = "E = YTMX U U K ; W = YTMX U U (MASS M A) ; G = YTMX U U (KSIG M S) ;"
    still = script.replace("{n}", "1") + move.format(1e-3, 0.0, -1e-3)
    assert abs(found(still + "N = EXTR S 'EFFX' 1 1 1 ;", "N")) < 1e-6
    turned = script.replace("{n}", f"{n}") + move.format(u, w, v) + energy
    stretched, moving, tight = found(turned, "E", "W", "G")
    t = (np.arange(360) + 0.5) * np.pi / 180.0
    c, s, ds = np.cos(n * t), np.sin(n * t), r * np.pi / 180.0
    strain = (u * c + n * v * c) / r
    turning = ((-n * u * s - v * s) / r) ** 2 + (n * w * s / r) ** 2
    tension = 2e7 * (u + n * v) / r
    assert stretched == pytest.approx(2e7 * np.sum(strain**2) * ds, rel=1e-9)
    mass = 0.78 * np.sum((u * c) ** 2 + (w * c) ** 2 + (v * s) ** 2) * ds
    assert moving == pytest.approx(mass, rel=1e-9)
    assert tight == pytest.approx(tension * np.sum(strain**2 + turning) * ds, rel=1e-9)
