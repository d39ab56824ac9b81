"""Flat triangular shells in finite displacements: rigid motions, a strip rolled up."""

import numpy as np
import pytest
from script_runs import finder

from ssilang.kernel.plasticity.finite_space_beam import rotation
from ssilang.kernel.plasticity.large.finite_plate import finite_plate

SHELL = """
OPTI DIME 3 MODE TRID ELEM TRI3 ;
L1 = DROI 1 (0. 0. 0.) (1. 0.2 0.1) ; S1 = L1 TRAN 1 (0.1 0.8 0.3) ;
MO = MODE S1 'MECANIQUE' 'ELASTIQUE' '{element}' ;
MA = MATE MO 'YOUN' 1.E6 'NU' 0.3 'EPAI' 0.1 ;
"""


def shells(tmp_path, element="DKT"):
    find = finder(SHELL.format(element=element), tmp_path)
    zone, material = find("MO").zones[0], find("MA")
    from ssilang.kernel.elements.families import integration_weights

    return finite_plate(zone, material, integration_weights(zone, "STRESSES", material).shape[1])


@pytest.mark.parametrize("element", ["DKT", "COQ3"])
def test_a_rigid_motion_makes_no_stress(tmp_path, element):
    shell = shells(tmp_path, element)
    v = np.array([[0.7, -1.1, 1.9]])
    R = rotation(v)[0]
    u = np.zeros((len(shell.ends), 3, 6))
    u[:, :, :3] = shell.ends @ (R - np.eye(3)).T + np.array([3.0, -2.0, 5.0])
    u[:, :, 3:] = v
    assert np.abs(shell.shown(u.reshape(-1, 18))).max() < 1e-7
    small = 1e-3 * np.random.default_rng(0).normal(size=(len(u), 18))
    turned = small.reshape(-1, 6, 3) @ R.T
    moved = u.copy()
    moved[:, :, :3] += turned[:, ::2]
    # rotations are one vector: a small turn in the moved frame comes in front of the large one
    flat = shell.shown(small * np.tile([1.0, 1, 1, 0, 0, 0], 3))
    np.testing.assert_allclose(shell.shown(moved.reshape(-1, 18)), flat, atol=1e-9)


def test_a_strip_under_an_end_moment_rolls_up(tmp_path):
    # EI = 1e4 0.1^3 2 / 12 = 5/3; a moment EI phi / L bends it into an arc of the angle phi
    found = {}
    for count in (5, 10):
        find = finder(
            f"""
            OPTI DIME 3 MODE TRID ELEM TRI3 ;
            L1 = DROI 2 (0. 0. 0.) (0. 2. 0.) ; S1 = L1 TRAN {count} (5. 0. 0.) ;
            L2 = COTE 3 S1 ; MO = MODE S1 'MECANIQUE' 'ELASTIQUE' 'DKT' ;
            MA = MATE MO 'YOUN' 1.E4 'NU' 0. 'EPAI' 0.1 ; X = 5. 1. 0. ;
            T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
            T . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' 'ROTA' L1) ET (BLOQ 'UY' 'RX' 'RZ' S1) ;
            M1 = -1. * (5. / 3.) * (PI / 2.) / 5. ; P1 = L2 POIN 'PROC' (5. 0. 0.) ;
            P2 = L2 POIN 'PROC' (5. 1. 0.) ; P3 = L2 POIN 'PROC' (5. 2. 0.) ;
            F = (MOME 'MY' (0.25 * M1) P1) ET (MOME 'MY' (0.5 * M1) P2)
                ET (MOME 'MY' (0.25 * M1) P3) ;
            T . 'CHARGEMENT' = CHAR 'MECA' F (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
            T . 'GRANDS_DEPLACEMENTS' = VRAI ; T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.5 1. ;
            PASAPAS T ; U = T . 'DEPLACEMENTS' . 2 ; A = EXTR U P2 'UX' ; B = EXTR U P2 'UZ' ;
            C = EXTR U P2 'RY' ; N = MAXI (EXCO 'M11' (T . 'CONTRAINTES' . 2)) 'ABS' ;
            """,
            tmp_path / str(count),
        )
        found[count] = np.array([find("A"), find("B"), find("C")])
    phi = np.pi / 2
    exact = np.array([5.0 * (np.sin(phi) / phi - 1.0), 5.0 * (1.0 - np.cos(phi)) / phi, -phi])
    errors = {c: np.abs(f - exact).max() for c, f in found.items()}
    assert errors[10] < 0.02
    assert errors[10] < 0.35 * errors[5] or errors[5] < 5e-3
