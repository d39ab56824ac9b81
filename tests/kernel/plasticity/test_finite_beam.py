"""Beams of the plane in finite displacements: elastica, consistency, stresses handed over."""

import numpy as np
import pytest
from script_runs import ran

from ssilang.kernel.plasticity.finite_space_beam import finite_beam

E, SECTION, INERTIA = 1e7, 1.0, 1e-2
CANTILEVER = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
P1 = 0. 0. ; P2 = {end} ; L1 = DROI {count} P1 P2 ;
MO = MODE L1 'MECANIQUE' 'ELASTIQUE' {element} ;
MA = MATE MO 'YOUN' 1.E7 'NU' 0. 'SECT' 1. 'INRZ' 1.E-2 ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' 'ROTA' P1 ; T . 'GRANDS_DEPLACEMENTS' = VRAI ;
T . 'CHARGEMENT' = CHAR 'MECA' ({load}) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' {step} 1. ;
"""


def cantilever(load, end="10. 0.", count=20, element="POUT", step=0.1):
    return CANTILEVER.format(load=load, end=end, count=count, element=element, step=step)


def run(text, tmp_path):
    return ran(text, output_directory=tmp_path).session.root.find


def tip(find):
    field, node = find("T").get("DEPLACEMENTS").get(10), np.array([find("P2").node])
    return [field.values_at(c, node)[0] for c in ("UX", "UY", "RZ")]


def test_end_moment_rolls_a_cantilever_to_a_circle(tmp_path):
    moment = 2 * np.pi * E * INERTIA / 10.0
    text = cantilever(f"MANU 'CHPO' P2 'MZ' {moment:.16g}", count=40) + "PASAPAS T ;"
    find = run(text, tmp_path)
    ux, uy, turn = tip(find)
    assert turn == pytest.approx(2 * np.pi, rel=1e-9)
    assert ux == pytest.approx(-10.0, abs=1e-8)  # chords of equal turns close exactly
    assert uy == pytest.approx(0.0, abs=1e-8)
    forces = find("T").get("CONTRAINTES").get(10).blocks[0].components
    assert forces["MOMZ"] == pytest.approx(moment, rel=1e-8)
    assert np.abs(forces["EFFX"]).max() < 1e-6 * moment


@pytest.mark.parametrize("element", ["POUT", "TIMO"])
def test_tip_load_bends_a_cantilever_to_the_elastica(element, tmp_path):
    load = 10.0 * E * INERTIA / 100.0  # P L^2 / (E I) = 10
    find = run(cantilever(f"FORC (0. {load:.16g}) P2", element=element) + "PASAPAS T ;", tmp_path)
    ux, uy, _ = tip(find)
    # Bisshopp and Drucker 1945; twenty chords, and 1 % of stretch and shear at most
    assert uy / 10.0 == pytest.approx(0.8106, rel=1.5e-2)
    assert -ux / 10.0 == pytest.approx(0.5545, rel=1.5e-2)


def random_beams(tmp_path):
    find = run(cantilever("FORC (0. 1.) P2", end="3. 4.", count=3), tmp_path)
    return finite_beam(find("MO").zones[0], find("MA"), 2)


def test_forces_and_tangent_are_derivatives_of_the_energy(tmp_path):
    beam = random_beams(tmp_path)
    given = 1e3 * np.random.default_rng(2).normal(size=(3, 3, 2))
    lengths = np.linalg.norm(beam.span, axis=1)
    given[:, 0] = given[:, 0, :1]
    given[:, 1] = ((given[:, 2, 0] - given[:, 2, 1]) / lengths)[:, None]
    u = 0.3 * np.random.default_rng(1).normal(size=(3, 6))
    beam = beam.stressed(given, u)
    np.testing.assert_allclose(beam.shown(u), given, atol=1e-6)
    h, cell = 1e-5, np.arange(3) == 1
    for j in range(6):
        shift = np.zeros((3, 6))
        shift[cell, j] = h
        slope = (beam.stored(u + shift) - beam.stored(u - shift)) / (2 * h)
        assert beam.forces(u)[1, j] == pytest.approx(slope, rel=1e-6, abs=1.0)
        bend = (beam.forces(u + shift) - beam.forces(u - shift))[1] / (2 * h)
        np.testing.assert_allclose(beam.tangent(u)[1, :, j], bend, rtol=1e-6, atol=10.0)


def test_a_turned_beam_has_no_forces(tmp_path):
    beam = random_beams(tmp_path)
    for angle in (0.5, 3.0, 4.0, 9.0):
        c, s = np.cos(angle), np.sin(angle)
        turned = beam.span @ np.array([[c, s], [-s, c]])
        u = np.zeros((3, 6))
        u[:, 3:5], u[:, 2], u[:, 5] = turned - beam.span, angle, angle
        assert np.abs(beam.forces(u)).max() < 1e-6
