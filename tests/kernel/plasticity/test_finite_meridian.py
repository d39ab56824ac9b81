"""Strips of shells COQ2 in finite displacements: against beams, energies, forces handed over."""

import numpy as np
import pytest
from script_runs import finder
from together import together

from ssilang.kernel.elements.families import family_of, stress
from ssilang.kernel.plasticity.finite import finite_plane_shell

SHELLS = """
OPTI DIME 2 MODE PLAN {mode} ELEM SEG2 ;
P1 = 0. 0. ; P2 = 6. 8. ; L1 = DROI 5 P1 P2 ;
MO = MODE L1 'MECANIQUE' 'ELASTIQUE' {element} ;
MA = MATE MO 'YOUN' 1.E7 'NU' {nu} {section} ;
"""
STEPS = """
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' 'ROTA' P1 ; T . 'GRANDS_DEPLACEMENTS' = VRAI ;
T . 'CHARGEMENT' = CHAR 'MECA' (FORC (-900. 200.) P2) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 0.5 1. ;
PASAPAS T ;
"""
SHELL = "'EPAI' 0.2"
BEAM = "'SECT' 0.2 'INRZ' (0.2 ** 3 / 12.)"


def test_a_strip_bends_as_a_beam(tmp_path):
    ends = []
    for element, section in (("COQ2", SHELL), ("POUT", BEAM)):
        text = SHELLS.format(mode="CONT", element=element, nu="0.", section=section) + STEPS
        find = finder(text, tmp_path)
        field, node = find("T").get("DEPLACEMENTS").get(2), np.array([find("P2").node])
        ends.append([field.values_at(c, node)[0] for c in ("UX", "UY", "RZ")])
    assert ends[0] == pytest.approx(ends[1], rel=1e-8)
    assert abs(ends[0][2]) > 0.3


@together("mode", ["CONT", "DEFO"])
def test_small_displacements_give_the_usual_stresses(tmp_path, mode):
    text = SHELLS.format(mode=mode, element="COQ2", nu="0.3", section=SHELL)
    text += "U = 1.E-6 * (RESO ((RIGI MO MA) ET (BLOQ 'DEPL' 'ROTA' P1)) (FORC (3. 50.) P2)) ;"
    find = finder(text, tmp_path)
    zone, material = find("MO").zones[0], find("MA")
    usual = np.stack(list(stress(zone, material, find("U")).components.values()), axis=1)
    shell = finite_plane_shell(zone, material, usual.shape[2])
    u = family_of(zone).layout(zone).gather(find("U"))
    # what is of second order in the displacements is left
    np.testing.assert_allclose(shell.shown(u), usual, atol=1e-3 * np.abs(usual).max())


def test_forces_hold_the_stresses_handed_over(tmp_path):
    find = finder(SHELLS.format(mode="DEFO", element="COQ2", nu="0.3", section=SHELL), tmp_path)
    zone, material = find("MO").zones[0], find("MA")
    rng = np.random.default_rng(3)
    count = stress(zone, material, run_zero(find)).components["N11"].shape[1]
    shell = finite_plane_shell(zone, material, count)
    u = 0.3 * rng.normal(size=(5, 6))
    given = rng.normal(size=shell.initial.shape) * 1e3
    loaded = shell.stressed(given, u)
    np.testing.assert_allclose(loaded.shown(u), given, atol=1e-7)
    # the chord carries them: at rest, what the usual element makes of them less its shear
    at_rest = shell.stressed(given, np.zeros((5, 6))).forces(np.zeros((5, 6)))
    from ssilang.kernel.elements.zone_fields import zone_field

    usual = family_of(zone).force_vectors(zone, given, zone_field(zone, material))
    np.testing.assert_allclose(at_rest, usual, atol=1e-8 * np.abs(usual).max())
    h = 1e-6
    for j in range(6):
        shift = np.zeros((5, 6))
        shift[1, j] = h
        slope = (loaded.stored(u + shift) - loaded.stored(u - shift)) / (2 * h)
        assert loaded.forces(u)[1, j] == pytest.approx(slope, rel=1e-5, abs=1.0)


def run_zero(find):
    from ssilang.kernel.fields.node_field import NodeField

    return NodeField(find("MO").zones[0].cells.nodes, {}, "DIFFUS")
