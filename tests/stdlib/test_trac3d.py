"""TRAC3D_2 and TRAC3D: fields of revolution and of harmonics in space."""

import numpy as np
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
from tests.windows import needs_window


def solved(script):
    result = ran(script)
    mesh = result.session.root.find("M")
    nodes = mesh.sorted_node_ids
    x, y, z = mesh.nodes.coordinates[nodes].T
    return result.session.root, nodes, np.hypot(x, y), np.arctan2(y, x), z


def test_displacements_of_a_harmonic():
    root, nodes, r, t, z = solved(
        "OPTI DIME 2 MODE FOUR 2 ELEM SEG2 ; L = DROI 3 (1. 0.) (2. 1.) ; R Z = COOR L ;"
        "U = (NOMC 'UR' R) ET (NOMC 'UT' Z) ET (NOMC 'UZ' (R * Z)) ET (NOMC 'RT' R) ;"
        "T = TRAC3D_2 L U 360. 12 2 ; M = T . 'MAILLAGE' ; D = T . 'DEPLACEMENT' ;"
    )
    d = root.find("D")
    radial, around = r * np.cos(2 * t), z * np.sin(2 * t)
    np.testing.assert_allclose(
        d.values_at("UX", nodes), radial * np.cos(t) - around * np.sin(t), atol=1e-9
    )
    np.testing.assert_allclose(
        d.values_at("UY", nodes), radial * np.sin(t) + around * np.cos(t), atol=1e-9
    )
    np.testing.assert_allclose(d.values_at("UZ", nodes), r * z * np.cos(2 * t), atol=1e-9)


def test_stresses_at_nodes_and_in_cells():
    plane = (
        "OPTI DIME 2 MODE FOUR 1 ELEM QUA4 ; S = TRAN 2 (DROI 2 (1. 0.) (3. 0.)) (0. 1.) ;"
        "R Z = COOR S ; C = (NOMC 'SMRR' R) ET (NOMC 'SMZT' (R + Z)) ;"
    )
    root, nodes, r, t, z = solved(
        plane + "T = TRAC3D_2 S C 180. 6 1 ; M = T . 'MAILLAGE' ; D = T . 'CONTRAINTE' ;"
    )
    d = root.find("D")
    np.testing.assert_allclose(d.values_at("SMRR", nodes), r * np.cos(t), atol=1e-9)
    np.testing.assert_allclose(d.values_at("SMZT", nodes), (r + z) * np.sin(t), atol=1e-9)
    root, nodes, r, t, z = solved(
        plane + "MO = MODE S MECANIQUE ELASTIQUE ; E = CHAN 'CHAM' C MO 'NOEUD' 'CONTRAINTES' ;"
        "T = TRAC3D_2 E MO 180. 6 1 ; M = T . 'MAILLAGE' ; MO3 = T . 'MODELE' ;"
        "D = CHAN 'CHPO' MO3 (T . 'CONTRAINTE') ; N = NBEL (EXTR MO3 'MAIL') ;"
    )
    d = root.find("D")
    assert root.find("N") == 4 * 6
    np.testing.assert_allclose(d.values_at("SMZT", nodes), (r + z) * np.sin(t), atol=1e-9)


@together("name", ["EPRR EPZZ DEFORMATION", "P PI FLUIDE"])
def test_other_fields_go_under_their_names(name):
    a, b, index = name.split()
    root, nodes, r, _, z = solved(
        "OPTI DIME 2 MODE AXIS ELEM QUA4 ; S = TRAN 1 (DROI 1 (1. 0.) (3. 0.)) (0. 1.) ;"
        f"R Z = COOR S ; C = (NOMC '{a}' R) ET (NOMC '{b}' Z) ;"
        f"T = TRAC3D_2 S C 90. 3 0 ; M = T . 'MAILLAGE' ; D = T . '{index}' ;"
    )
    np.testing.assert_allclose(root.find("D").values_at(a, nodes), r, atol=1e-9)
    np.testing.assert_allclose(root.find("D").values_at(b, nodes), z, atol=1e-9)


def test_creer_3d_is_the_same():
    plane = (
        "OPTI DIME 2 MODE AXIS ELEM QUA4 ; S = TRAN 1 (DROI 1 (1. 0.) (3. 0.)) (0. 1.) ;"
        "MO = MODE S MECANIQUE ELASTIQUE ; E = CHAN 'CHAM' (NOMC 'SMTT' (COOR 1 S)) MO 'NOEUD' ;"
    )
    for name in ("CREER_3D", "TRAC3D_2"):
        root, nodes, r, _, _ = solved(
            plane + f"T = {name} E MO 90. 3 0 ; M = T . 'MAILLAGE' ;"
            "D = CHAN 'CHPO' (T . 'MODELE') (T . 'CONTRAINTE') ;"
        )
        np.testing.assert_allclose(root.find("D").values_at("SMTT", nodes), r, atol=1e-9)
    assert "model" in run_text(plane + "T = CREER_3D E 90. 3 0 ;").message


@needs_window
def test_the_picture_is_drawn_and_options_come_back(tmp_path):
    result = ran(
        "OPTI DIME 2 MODE FOUR 3 ELEM SEG2 ; L = DROI 4 (1. 0.) (1. 2.) ; Z = COOR 2 L ;"
        "U = (NOMC 'UR' (Z * 0.1)) ET (NOMC 'UT' Z) ET (NOMC 'UZ' (Z * 0.)) ;"
        "TRAC3D L U 0.2 270. 12 3 10. -20. 15. FAUX ; D = VALE 'DIME' ; N = VALE 'MODE' 'FOUR' ;",
        output_directory=tmp_path,
    )
    assert (result.session.root.find("D"), result.session.root.find("N")) == (2, 3)
    assert list(tmp_path.glob("*.png"))
