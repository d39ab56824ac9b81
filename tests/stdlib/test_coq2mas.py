"""COQ2MAS: layers of shells as solids: volume, motion, stresses layer by layer."""

import numpy as np
import pytest
from script_runs import found
from together import together

# two layers 0.1 and 0.2 thick on a plate 2 x 1, a common middle at z = 0
LAYERS = (
    "OPTI DIME 3 ELEM QUA4 ; S = (DROI 4 (0. 0. 0.) (2. 0. 0.)) TRAN 2 (0. 1. 0.) ; C2 = S COTE 2 ;"
    "C4 = S COTE 4 ; {} "
    "M1 = MODE S MECANIQUE ELASTIQUE {} 'CONS' 'BAS' ; "
    "M2 = MODE S MECANIQUE ELASTIQUE {} 'CONS' 'HAUT' ; M = M1 ET M2 ; "
    "A = (MATE M1 'YOUN' 2.E11 'NU' 0. 'EPAI' 0.1 'EXCE' -0.1) ET "
    "(MATE M2 'YOUN' 2.E11 'NU' 0. 'EPAI' 0.2 'EXCE' 0.05) ; T = TABL ; "
)
QUADS = LAYERS.format("", "COQ4", "COQ4")
LOADED = (
    "U = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' C4)) "
    "((FORC (1.E5 0. 0.) C2) ET (FORC (0. 0. 2.E4) C2)) ; "
    "T . 'DEPLACEMENTS' = TABL ; T . 'DEPLACEMENTS' . 5 = U ; "
    "T . 'CONTRAINTES' = TABL ; T . 'CONTRAINTES' . 5 = SIGM M A U ; "
)
CALL = "V = COQ2MAS M A T ; X = MESU V ; "


def heights(mesh):
    return mesh.nodes.coordinates[mesh.sorted_node_ids][:, 2]


@together("change, element", [("", "COQ4"), ("S = CHAN TRI3 S ;", "DST"), ("", "COQ4 DKT")])
def test_volume_is_area_times_thickness_at_the_right_height(change, element):
    script = LAYERS.format(change, element, element) + CALL + (
        "L1 = T . 'MAILLAGE_VOLUMIQUE' . 1 ; X1 = MESU L1 ; F = T . 'MAILLAGE_FIBRE_MOYENNE' . 2 ; "
    )  # fmt: skip
    whole, first, x, x1, middle = found(script, "V", "L1", "X", "X1", "F")
    assert x == pytest.approx(0.3 * 2.0)
    assert x1 == pytest.approx(0.1 * 2.0)
    assert (heights(first).min(), heights(first).max()) == pytest.approx((-0.15, -0.05))
    assert heights(whole).max() == pytest.approx(0.15)
    np.testing.assert_allclose(heights(middle), 0.05)


def test_layers_of_a_tube_have_their_radii():
    script = (
        "OPTI DIME 3 ELEM QUA4 ; C = (1. 0. 0.) CERC 40 (0. 0. 0.) (0. 1. 0.) ; "
        "S = C TRAN 2 (0. 0. 1.) ; M = MODE S MECANIQUE ELASTIQUE COQ4 ; T = TABL ; "
        "A = MATE M 'YOUN' 1. 'NU' 0. 'EPAI' 0.1 'EXCE' 0.2 ; V = COQ2MAS M A T ; X = MESU V ; "
    )
    mesh, volume = found(script, "V", "X")
    places = mesh.nodes.coordinates[mesh.sorted_node_ids]
    r = np.linalg.norm(places[:, :2], axis=1)
    low, high = (1.15, 1.25) if r.max() > 1.0 else (0.75, 0.85)
    # ends of the arc have the normal of one cell alone
    np.testing.assert_allclose(np.minimum(abs(r - low), abs(r - high)), 0.0, atol=1e-4)
    assert volume == pytest.approx(np.pi / 4 * (high**2 - low**2), rel=5e-3)


def test_stresses_of_layers_are_those_of_one_bent_and_pulled_section():
    script = QUADS + LOADED + CALL + "".join(
        f"{name} = EXTR (T . 'CONTRAINTES_{where}' . 5 . {layer}) 'SMXX' P ; "
        for name, where, layer in (
            ("P = (T . 'MAILLAGE_FIBRE_SUPERIEURE' . 2) POIN 'PROC' (1. 0.5 1.) ; A1",
             "FIBRE_SUPERIEURE", 2),
            ("P = (T . 'MAILLAGE_FIBRE_MOYENNE' . 1) POIN 'PROC' (1. 0.5 1.) ; A2",
             "FIBRE_MOYENNE", 1),
            ("P = (T . 'MAILLAGE_FIBRE_INFERIEURE' . 1) POIN 'PROC' (1. 0.5 1.) ; A3",
             "VOLUMIQUE", "'TOTAL'"),
            ("P = (T . 'MAILLAGE_FIBRE_INFERIEURE' . 2) POIN 'PROC' (1. 0.5 1.) ; A4",
             "FIBRE_INFERIEURE", 2),
        )
    )  # fmt: skip
    top, middle, bottom, joint = found(script, "A1", "A2", "A3", "A4")
    # at the node in the middle of the length; equal nodal forces are not quite a uniform load
    n, m = 1e5, 2e4 * 1.0
    for stress, z in ((top, 0.15), (middle, -0.1), (bottom, -0.15), (joint, -0.05)):
        assert abs(stress - n / 0.3) == pytest.approx(abs(m * z / (0.3**3 / 12)), rel=2e-2)
        assert (stress - n / 0.3) * z < 0  # lifting the end pulls the lower side


def test_motion_of_faces_is_that_of_the_shell_and_its_rotation():
    script = QUADS + LOADED + CALL + (
        "P = (T . 'MAILLAGE_FIBRE_SUPERIEURE' . 2) POIN 'PROC' (2. 0.5 1.) ; Q = S POIN 'PROC' "
        "(2. 0.5 0.) ; X = EXTR (T . 'DEPLACEMENTS_VOLUMIQUE' . 5 . 'TOTAL') 'UX' P ; "
        "Y = EXTR U 'UX' Q ; R = EXTR U 'RY' Q ; "
        "P = (T . 'MAILLAGE_FIBRE_MOYENNE' . 1) POIN 'PROC' (2. 0.5 0.) ; "
        "Z = EXTR (T . 'DEPLACEMENTS_FIBRE_MOYENNE' . 5 . 1) 'UX' P ; "
    )  # fmt: skip
    x, y, r, z = found(script, "X", "Y", "R", "Z")
    assert abs(r) > 1e-6
    assert (x, z) == pytest.approx((y + 0.15 * r, y - 0.1 * r), rel=1e-9)


def test_relations_tie_the_solid_to_the_shell():
    script = QUADS + LOADED + "T . 'RELATION_3D' = VRAI ; " + CALL + (
        "R = T . 'RELATION_3D' ; Y = RESO ((RIGI M A) ET (BLOQ 'DEPL' 'ROTA' C4) ET R) "
        "((FORC (1.E5 0. 0.) C2) ET (FORC (0. 0. 2.E4) C2)) ; "
        "W = T . 'DEPLACEMENTS_VOLUMIQUE' . 5 . 'TOTAL' ; "
    )  # fmt: skip
    w, y, mesh = found(script, "W", "Y", "V")
    ids = mesh.sorted_node_ids
    for name in ("UX", "UZ"):
        scale = np.abs(w.values_at(name, ids)).max()
        np.testing.assert_allclose(
            y.values_at(name, ids), w.values_at(name, ids), atol=1e-9 * scale
        )


def test_second_call_keeps_the_meshes_and_takes_new_fields():
    script = QUADS + LOADED + CALL + (
        "V1 = V ; D1 = T . 'DEPLACEMENTS_VOLUMIQUE' . 5 . 'TOTAL' ; "
        "T . 'DEPLACEMENTS' . 6 = 2. * U ; V = COQ2MAS M A T ; "
        "D2 = T . 'DEPLACEMENTS_VOLUMIQUE' . 6 . 'TOTAL' ; X = MAXI 'ABS' ((2. * D1) - D2) ; "
        "Y = MAXI 'ABS' D2 ; "
    )  # fmt: skip
    first, second, x, y = found(script, "V1", "V", "X", "Y")
    assert set(first.sorted_node_ids) == set(second.sorted_node_ids)
    assert y > 0
    assert x == pytest.approx(0.0, abs=1e-12 * y)
