"""Beams of the plane in finite displacements roll up to a circle and to the elastica."""

import numpy as np
import pytest
from script_runs import finder

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


def tip(find):
    field, node = find("T").get("DEPLACEMENTS").get(10), np.array([find("P2").node])
    return [field.values_at(c, node)[0] for c in ("UX", "UY", "RZ")]


def test_end_moment_rolls_a_cantilever_to_a_circle(tmp_path):
    moment = 2 * np.pi * E * INERTIA / 10.0
    text = cantilever(f"MANU 'CHPO' P2 'MZ' {moment:.16g}", count=40) + "PASAPAS T ;"
    find = finder(text, tmp_path)
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
    find = finder(
        cantilever(f"FORC (0. {load:.16g}) P2", element=element) + "PASAPAS T ;", tmp_path
    )
    ux, uy, _ = tip(find)
    # Bisshopp and Drucker 1945; twenty chords, and 1 % of stretch and shear at most
    assert uy / 10.0 == pytest.approx(0.8106, rel=1.5e-2)
    assert -ux / 10.0 == pytest.approx(0.5545, rel=1.5e-2)
