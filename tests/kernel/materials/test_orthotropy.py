"""Elasticity along axes of its own, in bodies, shells and joints: against tensors of rank four."""

import itertools

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.loads.thermal import given_strain, temperature, thermal_strain
from ssilang.kernel.elements.shells.flat_shell import flat_frames
from ssilang.kernel.elements.shells.shell_section import section_moduli, transverse_moduli
from ssilang.kernel.elements.solids.solid_moduli import (
    hooke_block,
    inverted,
    moduli_from_field,
    solid_compliance,
    solid_moduli,
)
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface import family as _joints  # noqa: F401
from ssilang.kernel.materials.axes import Directions, axis_parameters, integration_points
from ssilang.kernel.materials.elasticity import (
    isotropic_compliance,
    isotropic_moduli,
    orthotropic_compliance,
    reduced_moduli,
    rotated_moduli,
)
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.materials.parameters import geometric_names, known_names, material_names
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from tests.kernel.elements.samples import TILT, cell_zone, line_zone, material, tilted_plate

WOOD = {"YG1": 12e9, "YG2": 1e9, "YG3": 0.8e9, "NU12": 0.3, "NU23": 0.4, "NU13": 0.25,
        "G12": 0.7e9, "G23": 0.1e9, "G13": 0.6e9}  # fmt: skip
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
FIRST, SECOND = np.array([1.0, 2.0, 0.5]), np.array([0.3, -1.0, 2.0])
SPACE = Mode.THREE_DIMENSIONAL


def frame(first, second):
    x = first / np.linalg.norm(first)
    z = np.cross(x, second) / np.linalg.norm(np.cross(x, second))
    return np.stack([x, np.cross(z, x), z])


def rank_four(D):
    C = np.zeros((3, 3, 3, 3))
    for (a, (i, j)), (b, (k, m)) in itertools.product(enumerate(PAIRS), enumerate(PAIRS)):
        C[i, j, k, m] = C[j, i, k, m] = C[i, j, m, k] = C[j, i, m, k] = D[a, b]
    return C


def turned(D, R):
    """Moduli along the rows of R, seen in the global axes."""
    C = np.einsum("abcd,ai,bj,ck,dl->ijkl", rank_four(D), R, R, R, R)
    return np.array([[C[i, j, k, m] for k, m in PAIRS] for i, j in PAIRS])


def wood():
    """Moduli of WOOD in its own axes, from strains under one stress after the other."""
    S = np.zeros((6, 6))
    w = WOOD
    for i in range(3):
        S[i, i] = 1 / w[f"YG{i + 1}"]
    for i, j in ((0, 1), (0, 2), (1, 2)):
        S[i, j] = S[j, i] = -w[f"NU{i + 1}{j + 1}"] / w[f"YG{i + 1}"]
    S[3, 3], S[4, 4], S[5, 5] = 1 / w["G12"], 1 / w["G13"], 1 / w["G23"]
    return np.linalg.inv(S)


def zone_of(element, mode, kind, seed=1):
    zone = cell_zone(element, mode, seed)
    return Zone(zone.cells, "MECANIQUE", ("ELASTIQUE", kind), element, mode)


def with_axes(zone, directions, **given):
    axes, support = axis_parameters(zone, directions)
    values = {k: np.full((len(zone.cells), 1), float(v)) for k, v in given.items()}
    return CellField((
        CellFieldBlock(zone.cells, values, "GRAVITE", zone.element),
        CellFieldBlock(zone.cells, axes, support, zone.element),
    ), "CARACTERISTIQUES")  # fmt: skip


def any_moduli():
    a = np.random.default_rng(4).standard_normal((6, 6))
    return 1e9 * (a @ a.T + 6 * np.eye(6))


def laws(flat=False):
    D = any_moduli()
    if flat:  # what shears across does not know of the plane
        D[:4, 4:] = D[4:, :4] = 0.0
    terms = {f"D{i + 1}{j + 1}": D[i, j] for i in range(6) for j in range(i + 1)}
    fibre = np.zeros((6, 6))
    fibre[0, 0] = 3e9
    return {"ORTHOTROPE": (WOOD, wood()), "ANISOTROPE": (terms, D),
            "UNIDIRECTIONNEL": ({"YOUN": 3e9}, fibre)}  # fmt: skip


@together("kind", laws())
@together("mode", [SPACE, Mode.PLANE_STRAIN, Mode.PLANE_STRESS, Mode.AXISYMMETRIC])
def test_moduli_of_bodies_turn_as_tensors_do(kind, mode):
    flat = mode is not SPACE
    given, local = laws(flat)[kind]
    zone = zone_of("QUA4" if flat else "CUB8", mode, kind)
    directions = Directions(FIRST * [1, 1, 0 if flat else 1], None if flat else SECOND, angle=20.0)
    R = frame(directions.first, [0, 0, 1.0] if flat else SECOND)
    if flat:
        R = frame(directions.first, np.array([-directions.first[1], directions.first[0], 0.0]))
    c, s = np.cos(np.radians(20)), np.sin(np.radians(20))
    R = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1.0]]) @ R
    whole = turned(local, R)
    field = with_axes(zone, directions, **given)
    found = solid_moduli(zone, zone_field(zone, field), "RIGIDITE")[0, 0]
    expected = whole[:4, :4] if flat else whole
    if mode is Mode.PLANE_STRESS:
        k = [0, 1, 3]
        inner = whole[np.ix_(k, k)] - np.outer(whole[k, 2], whole[2, k]) / (whole[2, 2] or 1.0)
        expected = np.zeros((4, 4))
        expected[np.ix_(k, k)] = inner
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(whole).max())
    if kind == "UNIDIRECTIONNEL":
        return
    S = solid_compliance(zone, zone_field(zone, field), "RIGIDITE")[0, 0]
    if mode is Mode.PLANE_STRESS:  # EPZZ follows
        own = np.linalg.inv(whole)
        np.testing.assert_allclose(S[:, :2], own[:4, :2], rtol=1e-9, atol=1e-22)
        np.testing.assert_allclose(S[:, 3], own[:4, 3], rtol=1e-9, atol=1e-22)
    else:
        np.testing.assert_allclose(S @ found, np.eye(len(S)), atol=1e-9)


def test_anisotropic_bodies_without_axes_stand_in_the_global_ones():
    given, local = laws()["ANISOTROPE"]
    zone = zone_of("CUB8", SPACE, "ANISOTROPE")
    field = material(zone, **given)
    np.testing.assert_allclose(solid_moduli(zone, zone_field(zone, field), "RIGIDITE")[0, 0], local)
    with pytest.raises(MaterialError, match="axes"):
        solid_moduli(zone_of("CUB8", SPACE, "ORTHOTROPE"), zone_field(zone, material(zone, **WOOD)),
                     "RIGIDITE")  # fmt: skip
    with pytest.raises(MaterialError, match="POREUX"):
        solid_moduli(zone_of("CUB8", SPACE, "POREUX"), zone_field(zone, field), "RIGIDITE")
    with pytest.raises(MaterialError, match="CUB8"):
        inverted(zone, np.zeros((1, 1, 6, 6)))
    np.testing.assert_allclose(
        inverted(zone, local[None, None])[0, 0] @ local, np.eye(6), atol=1e-9
    )


def test_matrices_of_hooke_are_kept_by_cell_and_point():
    zone = zone_of("QUA4", Mode.PLANE_STRAIN, "ISOTROPE")
    moduli = np.random.default_rng(1).standard_normal((1, 4, 4, 4))
    field = CellField((hooke_block(zone, moduli, "RIGIDITE"),))
    found = moduli_from_field(zone_field(zone, field), "STRESSES")
    np.testing.assert_array_equal(found, moduli)
    one = CellField((hooke_block(zone, moduli[:, :1], "RIGIDITE"),))
    assert moduli_from_field(zone_field(zone, one), "MASSE").shape == (1, 1, 4, 4)
    assert moduli_from_field(zone_field(zone, None), "MASSE") is None
    with pytest.raises(Exception, match="MASSE"):
        moduli_from_field(zone_field(zone, field), "MASSE")


# --- axes of bodies round an axis, of shells, of joints ------------------------------


def points(zone, support):
    from ssilang.kernel.materials.axes import integration_points

    return integration_points(zone, support)[0]


def test_radial_axes_in_space_run_along_the_axis_then_towards_it():
    zone = zone_of("CUB8", SPACE, "ORTHOTROPE")
    a, b = np.array([0.3, -0.5, 0.2]), np.array([1.0, 0.4, 2.0])
    values, support = axis_parameters(zone, Directions(a, b, radial=True))
    along = (b - a) / np.linalg.norm(b - a)
    for k, x in enumerate(points(zone, support)):
        out = (x - a) - (x - a) @ along * along
        v1, v2 = ([values[f"V{i}{c}"][0, min(k, values[f"V{i}{c}"].shape[1] - 1)] for c in "XYZ"]
                  for i in (1, 2))  # fmt: skip
        np.testing.assert_allclose(v1, along, atol=1e-12)
        np.testing.assert_allclose(v2, -out / np.linalg.norm(out), atol=1e-12)
    with pytest.raises(MaterialError, match="two"):
        axis_parameters(zone, Directions(a, None, radial=True))


@together("radial", [False, True])
@together("outside", [None, 1.0])
def test_first_axes_of_shells_are_projections_turned_about_the_side_named(radial, outside):
    zone = tilted_plate("DKT", ("ELASTIQUE", "ORTHOTROPE"))
    up = TILT[:, 2]
    given = Directions(FIRST, None, radial, 25.0, None if outside is None else up + 0.1 * FIRST)
    values = axis_parameters(zone, given)[0]
    frames = flat_frames(zone)[0]
    for k in range(2):
        v1 = values["V1X"][k, 0] * frames[k, 0] + values["V1Y"][k, 0] * frames[k, 1]
        vector = zone.cells.coordinates[k].mean(axis=0) - FIRST if radial else FIRST
        flat = vector - vector @ up * up
        flat /= np.linalg.norm(flat)
        sense = 1.0 if outside else np.sign(frames[k, 2] @ up)
        c, s = np.cos(np.radians(25)), np.sin(np.radians(25))
        np.testing.assert_allclose(v1, c * flat + s * sense * np.cross(up, flat), atol=1e-12)
    with pytest.raises(MaterialError, match="normal"):
        axis_parameters(zone, Directions(up, None))


def test_moduli_of_shells_turn_with_their_axes():
    zone = tilted_plate("DKT", ("ELASTIQUE", "ORTHOTROPE"))
    given = {k: WOOD[k] for k in ("YG1", "YG2", "NU12", "G12", "G13", "G23")} | {"EPAI": 0.2}
    field = with_axes(zone, Directions(FIRST, None, angle=10.0), **given)
    seen = zone_field(zone, field)
    found = section_moduli(zone, seen, "STRESSES")
    across = transverse_moduli(zone, seen, "STRESSES")
    q = np.linalg.inv([[1 / 12e9, -0.3 / 12e9, 0], [-0.3 / 12e9, 1 / 1e9, 0], [0, 0, 1 / 0.7e9]])
    D = np.zeros((6, 6))
    D[np.ix_([0, 1, 3], [0, 1, 3])] = q
    for k in range(2):
        c, s = seen.at("V1X", "GRAVITE")[k, 0], seen.at("V1Y", "GRAVITE")[k, 0]
        R = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1.0]])
        Q = turned(D, R)[np.ix_([0, 1, 3], [0, 1, 3])]
        row = min(k, len(found) - 1)
        np.testing.assert_allclose(found[row, 0, :3, :3], 0.2 * Q, rtol=1e-9, atol=1)
        np.testing.assert_allclose(found[row, 0, 3:, 3:], 0.2**3 / 12 * Q, rtol=1e-9, atol=1)
        G = R[:2, :2].T @ np.diag([0.6e9, 0.1e9]) @ R[:2, :2]
        np.testing.assert_allclose(across[min(k, len(across) - 1), 0], 5 / 6 * 0.2 * G)


@pytest.mark.parametrize("element", ["DKT", "COQ3"])
@pytest.mark.parametrize("skins", [False, True])
def test_layers_of_one_direction_are_bars_side_by_side(element, skins):
    zone = tilted_plate(element, ("ELASTIQUE", "UNIDIRECTIONNEL"))
    given = {"YOUN": 2e11, "ALPH": 1.2e-5, "EPAI": 3e-4}
    field = with_axes(zone, Directions(FIRST, None, angle=10.0), **given)
    seen = zone_field(zone, field)
    found = section_moduli(zone, seen, "STRESSES")
    nodes = np.arange(len(zone.cells.nodes))
    parts = {"T": 40.0, "TINF": 30.0, "TSUP": 50.0} if skins else {"T": 40.0}
    heat = NodeField.of(
        zone.cells.nodes, nodes, {n: np.full(len(nodes), v) for n, v in parts.items()}, "DIFFUS"
    )
    strain = thermal_strain(zone, field, heat)
    for k in range(len(zone.cells)):
        c, s = seen.at("V1X", "GRAVITE")[k, 0], seen.at("V1Y", "GRAVITE")[k, 0]
        along = np.array([c * c, s * s, c * s])  # the strain along the layer by EPSS EPTT GAST
        forces = found[min(k, len(found) - 1), 0]
        np.testing.assert_allclose(forces[:3, :3], 6e7 * np.outer(along, along), atol=1e-3)
        np.testing.assert_allclose(forces[3:, 3:], 4.5e-1 * np.outer(along, along), atol=1e-11)
        np.testing.assert_allclose(strain[k, :3, 0] @ along, 4.8e-4)
        np.testing.assert_allclose(strain[k, :3, 0] @ [s * s, c * c, -c * s], 0.0, atol=1e-18)
        np.testing.assert_allclose(strain[k, 3:6, 0] @ along, 0.8 * skins, atol=1e-15)


def test_bodies_of_one_direction_expand_along_it():
    zone = zone_of("CUB8", SPACE, "UNIDIRECTIONNEL")
    field = with_axes(zone, Directions(FIRST, SECOND), YOUN=2e11, ALPH=1.2e-5)
    nodes = np.arange(len(zone.cells.nodes))
    heat = NodeField.of(zone.cells.nodes, nodes, {"T": np.full(len(nodes), 40.0)}, "DIFFUS")
    d = FIRST / np.linalg.norm(FIRST)
    expected = 4.8e-4 * np.array([*d * d, 2 * d[0] * d[1], 2 * d[0] * d[2], 2 * d[1] * d[2]])
    found = thermal_strain(zone, field, heat)[0]
    np.testing.assert_allclose(found, np.repeat(expected[:, None], found.shape[1], axis=1))


@together("space", [False, True])
def test_first_axes_of_joints_lie_in_their_surface(space):
    table = NodeTable()
    x = np.array([[0, 0, 0], [2, 0.3, 0], [1.7, 1.5, 0.0]])
    x = x @ TILT.T if space else x[:2]
    ids = table.add(np.concatenate([x, x]))
    kind, element = ("LIA3", "JOT3") if space else ("RAC2", "JOI2")
    zone = Zone(CellBlock.make(table, kind, ids[None]), "MECANIQUE", ("ELASTIQUE", "ORTHOTROPE"),
                element, SPACE if space else Mode.PLANE_STRAIN)  # fmt: skip
    first = FIRST if space else FIRST * [1, 1, 0]
    values, support = axis_parameters(zone, Directions(first, None, angle=30.0))
    assert support == "GRAVITE"
    up = np.cross(x[1] - x[0], x[2] - x[0]) if space else np.array([0, 0, 1.0])
    up = up / np.linalg.norm(up)
    v1 = np.array([values[f"V1{c}"][0, 0] for c in "XYZ"])
    unit = first / np.linalg.norm(first)
    third = np.cross(first, np.cross(up, first))
    third /= np.linalg.norm(third)
    c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
    np.testing.assert_allclose(v1, c * unit + s * np.cross(third, unit), atol=1e-12)


# --- expansion


@together("cells", [False, True])
def test_orthotropic_bodies_expand_along_their_axes(cells):
    zone = zone_of("CUB8", SPACE, "ORTHOTROPE")
    rates = np.array([3e-5, 1e-5, -2e-5])
    field = with_axes(zone, Directions(FIRST, SECOND), TALP=5.0,
                      **{f"ALP{i + 1}": a for i, a in enumerate(rates)})  # fmt: skip
    table = zone.cells.nodes
    x = table.coordinates
    given = NodeField.of(table, np.arange(8), {"T": 20.0 + 3 * x[:, 0] - x[:, 2]}, "DIFFUS")
    if cells:
        at = points(zone, "STRESSES")
        block = CellFieldBlock(zone.cells, {"X": (20.0 + 3 * at[:, 0] - at[:, 2])[None]},
                               "STRESSES", "CUB8")  # fmt: skip
        given = CellField((block,))
    strains = thermal_strain(zone, field, given)
    R = frame(FIRST, SECOND)
    E = R.T @ np.diag(rates) @ R
    at = points(zone, "STRESSES")
    rise = 20.0 + 3 * at[:, 0] - at[:, 2] - 5.0
    np.testing.assert_allclose(temperature(zone, given)[0], rise + 5.0)
    for row, (i, j) in enumerate(PAIRS):
        np.testing.assert_allclose(
            strains[0, row], E[i, j] * rise * (1 if i == j else 2), atol=1e-15
        )


def test_given_strains_are_zero_where_they_are_not_named():
    zone = zone_of("QUA4", Mode.PLANE_STRAIN, "ISOTROPE")
    block = CellFieldBlock(zone.cells, {"GAXY": np.array([[1.0, 2, 3, 4]]),
                                        "EPYY": np.array([[5.0]])}, "STRESSES", "QUA4")  # fmt: skip
    found = given_strain(zone, CellField((block,)))
    np.testing.assert_allclose(found[0], [[0] * 4, [5] * 4, [0] * 4, [1, 2, 3, 4]])
    other = zone_of("TRI3", Mode.PLANE_STRAIN, "ISOTROPE")
    assert not given_strain(other, CellField((block,))).any()


X, Y = np.array([2.0, 0, 0]), np.array([0, 3.0, 0])


def test_direction_is_normalised_and_turned():
    zone = cell_zone("QUA4", Mode.PLANE_STRAIN)
    for angle, expected in ((0.0, (1, 0)), (90.0, (0, 1)), (30.0, (np.sqrt(3) / 2, 0.5))):
        values, support = axis_parameters(zone, Directions(X, None, angle=angle))
        got = [values[n][0, 0] for n in ("V1X", "V1Y")]
        np.testing.assert_allclose(got, expected, atol=1e-15)
        assert support == "GRAVITE"


def test_axes_point_to_a_centre_in_the_plane_and_are_turned():
    zone, centre = cell_zone("QUA8", Mode.PLANE_STRAIN), np.array([1.0, -2.0, 0.0])
    values, support = axis_parameters(zone, Directions(centre, None, radial=True, angle=30.0))
    assert support == "RIGIDITE"
    way = (centre - integration_points(zone, support)) @ [1.0, 1j, 0.0] * np.exp(1j * np.pi / 6)
    way /= np.abs(way)
    np.testing.assert_allclose(values["V1X"] + 1j * values["V1Y"], way)


def test_space_needs_two_vectors_that_are_not_parallel():
    zone = cell_zone("CUB8", Mode.THREE_DIMENSIONAL)
    with pytest.raises(MaterialError, match="two vectors"):
        axis_parameters(zone, Directions(X, None))
    with pytest.raises(MaterialError, match="parallel"):
        axis_parameters(zone, Directions(X, X))
    values, _ = axis_parameters(zone, Directions(X, X + Y))
    assert values["V2Y"][0, 0] == pytest.approx(1.0)


def test_each_element_knows_its_parameters():
    beam = line_zone("POUT", [(0, 0, 0), (1, 0, 0)], Mode.THREE_DIMENSIONAL)
    assert geometric_names(beam).required == ("SECT", "INRY", "INRZ", "TORS")
    joint = line_zone("JOI1", [(0, 0), (1, 0)], Mode.PLANE_STRAIN, ("ELASTIQUE", "JOINT_SDM"))
    assert {"KN", "KS", "FU", "GF", "FC", "FROT"} <= set(known_names(joint))
    solid = cell_zone("QUA4", Mode.PLANE_STRAIN)
    assert material_names(solid).required == ("YOUN", "NU")
    assert "SECT" not in known_names(solid)


E, NU = np.array(3.0e10), np.array(0.2)
TIMBER = {
    k: np.array(v)
    for k, v in {
        "YG1": 12e9, "YG2": 1e9, "YG3": 0.8e9, "NU12": 0.3, "NU23": 0.4, "NU13": 0.25,
        "G12": 0.7e9, "G23": 0.1e9, "G13": 0.6e9,
    }.items()
}  # fmt: skip


def test_moduli_and_compliance_are_inverse():
    np.testing.assert_allclose(
        isotropic_moduli(E, NU) @ isotropic_compliance(E, NU), np.eye(6), atol=1e-12
    )


def test_isotropic_moduli_do_not_depend_on_axes():
    q, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    D = isotropic_moduli(E, NU)
    np.testing.assert_allclose(rotated_moduli(D, q.T), D, rtol=1e-9, atol=1e-3)


def test_quarter_turn_exchanges_the_orthotropic_axes():
    D = np.linalg.inv(orthotropic_compliance(TIMBER))
    turned = rotated_moduli(D, np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]]))
    order = [1, 0, 2, 3, 5, 4]
    np.testing.assert_allclose(turned, D[np.ix_(order, order)], rtol=1e-12, atol=1e-3)


def test_plane_stress_leaves_no_stress_across():
    D = reduced_moduli(isotropic_moduli(E, NU), Mode.PLANE_STRESS)
    k = E / (1 - NU**2)
    np.testing.assert_allclose(D[:2, :2], [[k, k * NU], [k * NU, k]])
    assert not D[2].any()
    assert not D[:, 2].any()


def test_unstable_orthotropic_constants_are_refused():
    with pytest.raises(MaterialError, match="stable"):
        orthotropic_compliance({**TIMBER, "NU12": np.array(4.0)})
