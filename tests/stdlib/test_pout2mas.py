"""POUT2MAS COQ2MAS: beams and shells as solids: volume, motion, stresses on skin and in layers."""

import numpy as np
import pytest
from script_runs import found
from together import together

BEAM = (
    "OPTI DIME 3 ELEM SEG2 ; L = DROI 4 (1. 0. 0.) (1. 2. 0.) ; "
    "M = MODE L MECANIQUE ELASTIQUE {} ; A = MATE M 'YOUN' 2.E11 'NU' 0.3 'RHO' 1. {} ; "
    "T = TABL ; T . 'POUTRE' = TABL ; T . 'TUYAU' = TABL ; T . 'TUYAU' . 'NCIRC' = 32 ; "
    "T . 'POUTRE' . 'NCIRC' = 32 ; T . 'POUTRE' . 'NY' = 2 ; T . 'POUTRE' . 'NZ' = 3 ; "
)
RECTANGLE = "'SECT' 0.06 'INRY' 4.5E-4 'INRZ' 2.E-4 'TORS' 1.E-3 'VECT' (0. 0. 1.)"


def test_rectangle_has_the_inertias_of_the_beam():
    script = BEAM.format("POUT", RECTANGLE) + (
        "T . 'POUTRE' . 'RECTANGULAIRE' = VRAI ; V = POUT2MAS M A 'MASSIF' T ; X = MESU V ; "
        "N = NBEL V ; "
    )
    mesh, volume, n = found(script, "V", "X", "N")
    assert volume == pytest.approx(0.06 * 2.0)  # 0.2 x 0.3
    assert n == 4 * 2 * 3
    places = mesh.nodes.coordinates[mesh.sorted_node_ids]
    # VECT says that the local y is the vertical: half of 0.2 along z, half of 0.3 along x
    np.testing.assert_allclose(places.min(axis=0), [1 - 0.15, 0.0, -0.1], atol=1e-12)
    np.testing.assert_allclose(places.max(axis=0), [1 + 0.15, 2.0, 0.1], atol=1e-12)


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


FIBRES = (
    "OPTI DIME 3 ELEM QUA4 ; S = (DROI 1 (-0.05 -0.1 0.) (0.05 -0.1 0.)) TRAN 8 (0. 0.2 0.) ; "
    "MS = MODE S MECANIQUE ELASTIQUE PLASTIQUE PARFAIT_UNI QUAS ; "
    "MP = MODE (MANU 'POI1' (0. 0.05 0.)) MECANIQUE ELASTIQUE POJS ; "
    "AS = (MATE MS 'YOUN' 2.E10 'NU' 0.3 'ALPY' 1. 'ALPZ' 1. 'SIGY' 2.E7 'H' 0.) ET "
    "(MATE MP 'YOUN' 2.E11 'NU' 0.3 'ALPY' 0. 'ALPZ' 0. 'SECT' 1.E-4) ; OPTI ELEM SEG2 ; "
    "L = DROI 4 (0. 0. 0.) (2. 0. 0.) ; "
    "M = MODE L MECANIQUE ELASTIQUE SECTION PLASTIQUE SECTION TIMO ; "
    "A = MATE M 'MODS' (MS ET MP) 'MATS' AS 'VECT' (0. 1. 0.) ; "
    "CL = BLOQ (POIN 1 L) 'DEPL' 'ROTA' ; "
    "T = TABL ; T . 'MODELE' = M ; T . 'CARACTERISTIQUES' = A ; T . 'BLOCAGES_MECANIQUES' = CL ; "
    "T . 'CHARGEMENT' = CHAR 'MECA' (FORC (0. 0. 5.E3) (POIN 5 L)) (EVOL 'MANU' (PROG 0. 1.) "
    "(PROG 0. 1.)) ; T . 'TEMPS_CALCULES' = PROG 0.5 1. ; PASAPAS T ; "
)


def test_fibres_carry_their_stresses_to_the_sections():
    script = FIBRES + (
        "P = TABL ; P . 'VONS' = TABL ; P . 'VONS' . 2 = T . 'VARIABLES_INTERNES' . 2 ; "
        "P . 'DEPLACEMENTS' = T . 'DEPLACEMENTS' ; P . 'MATS' = A ; "
        "V = POUT2MAS M A 'GAUSS' P ; W = P . 'VONS_3D' . 2 ; "
        "SC = (EXCO 'SMXX' W 'SCAL') ; "
        "Q = EXCO 'YOUN' (P . 'MATS_3D' . 1) ; HI = MAXI Q ; LO = MINI Q ; "
        "U = P . 'DEPLACEMENTS_3D' . 2 ; N = NBEL V ; "
    )
    w, high, low, n, mesh, u = found(script, "W", "HI", "LO", "N", "V", "U")
    assert n == 4 * 9
    assert (high, low) == pytest.approx((2e11, 2e10))
    ids = mesh.sorted_node_ids
    at = mesh.nodes.coordinates[ids]
    assert sorted(set(np.round(at[:, 0], 9))) == pytest.approx([0.25, 0.75, 1.25, 1.75])
    top = ids[np.argmin(np.linalg.norm(at - [1.75, 0.05, 0.1], axis=1))]
    # elastic there: M z / I with the steel point at z = 0.05 in the concrete
    ea, es = 2e10 * 0.02 + 2e7, 2e7 * 0.05
    ei = 2e10 * 0.1 * 0.2**3 / 12 + 2e7 * 0.05**2 - es**2 / ea
    stress = -2e10 * (5e3 * 0.25) / ei * (0.1 - es / ea)
    assert w.values_at("SMXX", np.array([top]))[0] == pytest.approx(stress, rel=1e-6)
    assert np.isfinite(u.values_at("UZ", ids)).all()


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
