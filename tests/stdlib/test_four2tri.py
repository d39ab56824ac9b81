"""TRAC3D_2 TRAC3D FOUR2TRI: fields of revolution and of harmonics in space."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
from tests.windows import needs_window

PLANE = (
    "OPTI DIME 2 MODE FOUR 3 ELEM QUA8 ; L0 = DROI 2 (0. 0.) (2. 0.) ; S1 = TRAN 2 L0 (0. 1.) ;"
    "OPTI ELEM SEG3 ; L1 = DROI 2 (2. 1.) (2. 3.) ; G = S1 ET L1 ; ELIM 1.E-6 G ;"
    "R Z = COOR G ; T = TABL ; T . 'MAILLAGE' = G ; D = TABL ; T . 'DEPLACEMENTS' = D ;"
    "D . 1 = (NOMC 'UR' (R * R)) ET (NOMC 'UT' (R * Z)) ET (NOMC 'UZ' (R * (Z + 2.))) ;"
    "T . 'CHPO_SYME' = TABL ; T . 'CHPO_SYME' . 1 = NOMC 'P' (R * Z) ;"
    "T . 'CHPO_ANTI' = TABL ; T . 'CHPO_ANTI' . 1 = NOMC 'P' (R + Z) ;"
)


def field(result, name, component, mesh="M"):
    value = result.session.root.find(name)
    nodes = result.session.root.find(mesh).sorted_node_ids
    return value.values_at(component, nodes)


def solved(script):
    result = ran(script)
    mesh = result.session.root.find("M")
    return result, mesh.nodes.coordinates[mesh.sorted_node_ids]


def expected(r, t, z, n):
    even, odd = (np.cos(n * t), np.sin(n * t)) if n >= 0 else (np.sin(-n * t), np.cos(n * t))
    turning = np.ones_like(t) if n == 0 else odd
    return r * r * even, r * z * turning, r * (z + 2) * even, r * z * even, (r + z) * odd


@together("n", [0, 1, 3, -2])
@together("upright", [False, True])
def test_fields_in_space(n, upright):
    """The harmonic 3 by the older form."""
    angles, scalars = "(PROG 0. PAS 30. 180.) ;", PLANE
    call = f"T . 'ANGLES' = {angles} FOUR2TRI T {n} ; M = T . 'MAILLAGE_3D' ;"
    if n == 3:
        scalars = PLANE.replace("CHPO_SYME", "CHAMPS_POINTS_SYMETRIQUES")
        scalars = scalars.replace("CHPO_ANTI", "CHAMPS_POINTS_ANTISYMETRIQUES")
        call = f"MO = MODE S1 'MECANIQUE' 'ELASTIQUE' ; M = FOUR2TRI MO T {n} {angles}"
    script = scalars + (
        f"T . 'REDRESSE' = {'VRAI' if upright else 'FAUX'} ; T . 'ELIM' = 1.E-8 ; {call}"
        "U = T . 'DEPLACEMENTS_3D' . 1 ; A = T . 'CHPO_SYME_3D' . 1 ; B = T . 'CHPO_ANTI_3D' . 1 ;"
        "H = T . 'ANGLE_3D' ;"
    )
    if n == 3:
        script = script.replace("T . 'CHPO_", "T . 'CHAMPS_POINTS_")
    result, points = solved(script)
    x, y, z = points.T if upright else (points[:, 0], -points[:, 2], points[:, 1])
    r, t = np.hypot(x, y), np.arctan2(y, np.where(np.hypot(x, y) > 1e-9, x, 1))
    ur, ut, uz, even, odd = expected(r, t, z, n)
    ux, uy = ur * np.cos(t) - ut * np.sin(t), ur * np.sin(t) + ut * np.cos(t)
    names = ["UX", "UY", "UZ"] if upright else ["UX", "UZ", "UY"]
    turned = uy if upright else -uy
    for name, exact in zip(names, (ux, turned, uz), strict=True):
        np.testing.assert_allclose(field(result, "U", name), exact, atol=1e-6)
    np.testing.assert_allclose(field(result, "A", "P"), even, atol=1e-6)
    np.testing.assert_allclose(field(result, "B", "P"), odd, atol=1e-6)
    np.testing.assert_allclose(field(result, "H", "SCAL"), np.degrees(t), atol=1e-6)


def test_whole_turn_closes_and_has_the_volume_of_the_body():
    result, points = solved(
        PLANE + "T . 'ELIM' = 1.E-8 ; FOUR2TRI T ; M = T . 'MAILLAGE_3D' ;"
        "V = MESU (T . 'MAILLAGE_3D_MASSIF') ; N = NBNO M ;"
        "P = NBNO ((T . 'MAILLAGE_3D_COQUE') POIN 'DROIT' (2. 0. 0.) (2. 1. 0.) 1.E-6) ;"
    )
    root = result.session.root
    assert len(np.unique(np.round(points, 6), axis=0)) == root.find("N")
    assert root.find("V") == pytest.approx(np.pi * 4, rel=0.02)
    assert root.find("P") == 5


@together("angles", [(0, 10, 90), (-30, 0, 45, 50, 200), (200, 300, 350, 460, 520)])
@together("upright", [False, True])
def test_sections_stand_at_the_angles_asked_for(angles, upright):
    listed = " ".join(f"{a}." for a in angles)
    result, points = solved(
        f"OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; T = TABL ;"
        f"T . 'MAILLAGE' = S ; T . 'REDRESSE' = {'VRAI' if upright else 'FAUX'} ;"
        f"T . 'ANGLES' = PROG {listed} ; FOUR2TRI T ; M = T . 'MAILLAGE_3D' ; V = MESU M ;"
        "X = COOR 1 S ; Y = COOR 2 S ; A = (MAXI X) - (MINI X) ; B = (MAXI Y) - (MINI Y) ;"
    )
    x, y = (points[:, 0], points[:, 1]) if upright else (points[:, 0], -points[:, 2])
    off = np.hypot(x, y) > 1e-9
    turned = np.degrees(np.arctan2(y[off], x[off])) % 360
    wanted = np.array(angles) % 360
    gap = np.abs(turned[:, None] - wanted)
    nearest = np.minimum(gap, 360 - gap)
    assert np.all(nearest.min(axis=1) < 1e-6)
    assert np.all(nearest.min(axis=0) < 1e-6)
    # a cell of one sector between radii a and b: half the sine of the angle by b^2 - a^2
    root, exact = result.session.root, 0.5 * np.sum(np.sin(np.radians(np.diff(angles)))) * 4
    assert root.find("V") == pytest.approx(exact)
    assert (root.find("A"), root.find("B")) == (2, 1)


def test_a_second_call_keeps_the_mesh():
    result, _ = solved(
        PLANE + "T . 'ANGLES' = PROG 0. 45. 90. ; T . 'ELIM' = 1.E-8 ; FOUR2TRI T 1 ;"
        "M = T . 'MAILLAGE_3D' ; U1 = T . 'DEPLACEMENTS_3D' . 1 ; FOUR2TRI T 3 ;"
        "N = T . 'MAILLAGE_3D' ; U = U1 + (T . 'DEPLACEMENTS_3D' . 1) ; Q = MAXI U ;"
    )
    assert result.session.root.find("M") is result.session.root.find("N")


def made(script):
    result = ran(script)
    mesh = result.session.root.find("M")
    nodes = mesh.sorted_node_ids
    x, y, z = mesh.nodes.coordinates[nodes].T
    return result.session.root, nodes, np.hypot(x, y), np.arctan2(y, x), z


def test_displacements_of_a_harmonic():
    root, nodes, r, t, z = made(
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
    root, nodes, r, t, z = made(
        plane + "T = TRAC3D_2 S C 180. 6 1 ; M = T . 'MAILLAGE' ; D = T . 'CONTRAINTE' ;"
    )
    d = root.find("D")
    np.testing.assert_allclose(d.values_at("SMRR", nodes), r * np.cos(t), atol=1e-9)
    np.testing.assert_allclose(d.values_at("SMZT", nodes), (r + z) * np.sin(t), atol=1e-9)
    root, nodes, r, t, z = made(
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
    root, nodes, r, _, z = made(
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
        root, nodes, r, _, _ = made(
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
