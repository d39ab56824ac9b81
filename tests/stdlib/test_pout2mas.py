"""POUT2MAS: beams as solids: their volume, their motion, the stresses on their skin."""

import numpy as np
import pytest
from script_runs import found

BEAM = (
    "OPTI DIME 3 ELEM SEG2 ; L = DROI 4 (1. 0. 0.) (1. 2. 0.) ; "
    "M = MODE L MECANIQUE ELASTIQUE {} ; A = MATE M 'YOUN' 2.E11 'NU' 0.3 'RHO' 1. {} ; "
    "T = TABL ; T . 'POUTRE' = TABL ; T . 'TUYAU' = TABL ; T . 'TUYAU' . 'NCIRC' = 32 ; "
    "T . 'POUTRE' . 'NCIRC' = 32 ; T . 'POUTRE' . 'NY' = 2 ; T . 'POUTRE' . 'NZ' = 3 ; "
)
RECTANGLE = "'SECT' 0.06 'INRY' 4.5E-4 'INRZ' 2.E-4 'TORS' 1.E-3 'VECT' (0. 0. 1.)"


@pytest.mark.parametrize("element", ["POUT", "TIMO"])
def test_stress_on_the_skin_is_that_of_bending_and_pulling(element):
    script = BEAM.format(element, RECTANGLE) + (
        "U = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' (POIN 1 L))) ((FORC (0. 1.E5 0.) (POIN 5 L)) "
        "ET (MOME (3.E4 0. 2.E4) (POIN 5 L))) ; T . 'POUTRE' . 'RECTANGULAIRE' = VRAI ; "
        "T . 'DEPLACEMENTS' = TABL ; T . 'DEPLACEMENTS' . 7 = U ; "
        "T . 'CONTRAINTES' = TABL ; T . 'CONTRAINTES' . 7 = SIGM M A U ; "
        "V = POUT2MAS M A 'MASSIF' T ; S = T . 'CONTRAINTES_3D' . 7 ; "
        "HI = MAXI (EXCO 'SMXX' S) ; LO = MINI (EXCO 'SMXX' S) ; D = T . 'DEFORMEE' . 7 ; "
        "W = T . 'DEPLACEMENTS_3D' . 7 ; "
    )
    high, low, w, u, mesh, line, stress = found(script, "HI", "LO", "W", "U", "V", "L", "S")
    bent = 3e4 * 0.1 / 2e-4 + 2e4 * 0.15 / 4.5e-4
    assert high == pytest.approx(1e5 / 0.06 + bent)
    assert low == pytest.approx(1e5 / 0.06 - bent)
    # the motion along the beam of a corner at its end: that of the line and its rotations
    ids = mesh.sorted_node_ids
    at = mesh.nodes.coordinates[ids]
    corner = ids[np.argmin(np.linalg.norm(at - [1.15, 2.0, 0.1], axis=1))]
    end = line.blocks[0].connectivity[-1, -1]
    rx, rz, uy = (u.values_at(n, np.array([end]))[0] for n in ("RX", "RZ", "UY"))
    assert w.values_at("UY", np.array([corner]))[0] == pytest.approx(uy + rz * 0.15 - rx * 0.1)
    # the moment about X presses the upper side, that about Z pulls the side of X
    sigma = 1e5 / 0.06 + 2e4 * 0.15 / 4.5e-4 - 3e4 * 0.1 / 2e-4
    assert stress.values_at("SMXX", np.array([corner]))[0] == pytest.approx(sigma)


def test_relations_hold_the_sections_on_the_beam():
    script = BEAM.format("TIMO", RECTANGLE) + (
        "U = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' (POIN 1 L))) (FORC (1. 2. 3.) (POIN 5 L)) ; "
        "T . 'DEPLACEMENTS' = TABL ; T . 'DEPLACEMENTS' . 1 = U ; T . 'RELATION_3D' = VRAI ; "
        "V = POUT2MAS M A 'MASSIF' T ; R = T . 'RELATION_3D' ; "
        "Y = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' (POIN 1 L)) ET R) (FORC (1. 2. 3.) "
        "(POIN 5 L)) ; W = T . 'DEPLACEMENTS_3D' . 1 ; "
    )
    w, y, mesh = found(script, "W", "Y", "V")
    ids = mesh.sorted_node_ids
    for name in ("UX", "UY", "UZ"):
        scale = np.abs(w.values_at(name, ids)).max()
        np.testing.assert_allclose(
            y.values_at(name, ids), w.values_at(name, ids), atol=1e-9 * scale
        )


def test_pipe_and_disc_have_the_volume_of_polygons():
    pipe = BEAM.format("TUYA", "'RAYO' 0.2 'EPAI' 0.05")
    share = 16 * np.sin(2 * np.pi / 32)  # area of the polygon over r^2
    x = found(pipe + "X = MESU (POUT2MAS M A 'MASSIF' T) ; ", "X")
    assert x == pytest.approx(share * (0.2**2 - 0.15**2) * 2.0)
    inertia = np.pi * 0.1**4 / 4
    disc = BEAM.format("POUT", f"'SECT' 0.03 'INRY' {inertia} 'INRZ' {inertia} 'TORS' 1.")
    x = found(disc + "X = MESU (POUT2MAS M A 'MASSIF' T) ; ", "X")
    assert x == pytest.approx(share * 0.1**2 * 2.0)
    x = found(disc + "V = POUT2MAS M A T ; X = MESU V ; ", "X")
    assert x == pytest.approx(share * 0.1**2 * 8)  # both ends of four beams
