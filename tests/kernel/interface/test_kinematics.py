"""Patch tests of the joints: any face, rule, rotation; orientation and areas refused."""

import numpy as np
import pytest
from references.assembled import Bench
from refusing import refusal
from scipy.spatial.transform import Rotation
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.families import stiffness
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.interface.elements import with_rule
from ssilang.kernel.interface.family import JointFamily
from ssilang.kernel.interface.kinematics import joint_cells
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.mesh.mesh import CellBlock

FACES = {
    "JOI2": ("RAC2", "SEG2", Mode.PLANE_STRAIN),
    "JOI3": ("RAC3", "SEG3", Mode.PLANE_STRAIN),
    "JOT3": ("LIA3", "TRI3", Mode.THREE_DIMENSIONAL),
    "JOI4": ("LIA4", "QUA4", Mode.THREE_DIMENSIONAL),
    "JOT6": ("LIA6", "TRI6", Mode.THREE_DIMENSIONAL),
    "JOI8": ("LIA8", "QUA8", Mode.THREE_DIMENSIONAL),
}
NODAL = ("JOI2", "JOI3", "JOT3", "JOI4")
AREA = {"SEG2": 2.0, "SEG3": 2.0, "TRI3": 0.5, "TRI6": 0.5, "QUA4": 4.0, "QUA8": 4.0}


def rotation(d: int) -> np.ndarray:
    if d == 2:
        c, s = np.cos(0.7), np.sin(0.7)
        return np.array([[c, -s], [s, c]])
    return Rotation.from_rotvec([0.4, -0.9, 0.3]).as_matrix()


def one_joint(element: str, rule: str = "GAUSS", reverse: bool = False, gap: float = 0.0):
    """One joint, its reference face stretched by 3 and turned; (zone, x, R)."""
    cell, face, mode = FACES[element]
    d = mode.dimension
    plane = 3.0 * REFERENCE_CELLS[face].nodes
    x = np.zeros((len(plane), d))
    x[:, : d - 1] = plane
    R = rotation(d)
    normal = R[:, -1]
    x = x @ R.T
    bench = Bench(mode)
    upper = [bench.node(*(p + gap * normal)) for p in x]
    lower = [bench.node(*p) for p in x]
    sides = [*lower, *upper] if reverse else [*upper, *lower]
    zone = bench.joint(cell, sides, with_rule(element, rule), KN=5.0, KS=2.0)
    return zone, bench.characteristics, x, R


CASES = [(e, "GAUSS") for e in FACES] + [(e, "LOBATTO") for e in NODAL]


@together("element", FACES)
@together("support", ["NOEUD", "GRAVITE"])
def test_jumps_at_nodes_and_in_the_middle_are_those_of_the_sides_there(element, support):
    """Of a jump that is linear along the face, which a middle weighs by its area."""
    zone, material, x, R = one_joint(element)
    d = x.shape[1]
    slope = np.random.default_rng(7).standard_normal((d, d))
    u = np.concatenate([0.3 + x @ slope, np.zeros_like(x)]).ravel()
    made = JointFamily().strain_operator(zone, zone_field(zone, material), support, slice(None))
    found = (made.matrix[0] @ u).T  # of points: (n, d), the normal last
    face = FACES[element][1]
    at = x if support == "NOEUD" else x.mean(axis=0)[None]
    jump = 0.3 + at @ slope
    np.testing.assert_allclose(found[:, -1], jump @ R[:, -1], atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), np.linalg.norm(jump, axis=1))
    assert made.weights.sum() == pytest.approx(AREA[face] * 3.0 ** (d - 1))


@together("turned", [False, True])
def test_at_its_nodes_a_bent_joint_has_the_frames_of_its_nearest_points(turned):
    x = np.array([[0.0, 0.0], [1.2, 0.8], [2.0, 2.4]])[:: -1 if turned else 1]
    bench = Bench()
    sides = [bench.node(*p) for _ in range(2) for p in x]
    zone = bench.joint("RAC3", sides, "JOI3", KN=5.0, KS=2.0)
    own = zone_field(zone, bench.characteristics)
    joints = joint_cells(zone, own)
    places = joints.shape @ x
    nearest = np.linalg.norm(x[:, None] - places, axis=2).argmin(axis=1)
    assert len({*nearest}) > 1
    made = JointFamily().strain_operator(zone, own, "NOEUD", slice(None)).matrix[0]
    for move in np.eye(2):
        found = (made @ np.concatenate([np.tile(move, 3), np.zeros(6)])).T
        np.testing.assert_allclose(found, joints.frames[0, nearest] @ move, atol=1e-15)


@together("element, rule", CASES)
def test_uniform_jump_gives_uniform_traction_and_its_resultant(element, rule):
    zone, material, x, R = one_joint(element, rule)
    d = x.shape[1]
    cells = joint_cells(zone, zone_field(zone, material))
    area = AREA[FACES[element][1]] * 3.0 ** (d - 1)
    assert cells.weights.sum() == pytest.approx(area, rel=1e-13)
    jump = R @ np.array([0.3, -0.2, 0.7][-d:])
    K = stiffness(zone, material).values[0]
    u = np.concatenate([np.tile(jump, len(x)), np.zeros(x.size)])
    force = (K @ u).reshape(2, -1, d)
    local = R.T @ jump * np.array([2.0, 2.0, 5.0][-d:])
    np.testing.assert_allclose(force[0].sum(axis=0), area * (R @ local), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(force[1].sum(axis=0), -force[0].sum(axis=0), rtol=1e-12)


@together("element, rule", CASES)
def test_rigid_motion_gives_no_force(element, rule):
    zone, material, x, _ = one_joint(element, rule)
    d = x.shape[1]
    W = np.array([[0.0, -0.4], [0.4, 0.0]])
    if d == 3:
        W = np.cross(np.eye(3), [0.1, -0.3, 0.4])
    u = (x @ W.T + np.array([0.2, -0.1, 0.5])[:d]).ravel()
    K = stiffness(zone, material).values[0]
    assert np.abs(K @ np.concatenate([u, u])).max() < 1e-12 * np.abs(K).max()


@together("element, rule", CASES)
def test_linear_opening_has_the_exact_moment(element, rule):
    zone, material, x, R = one_joint(element, rule)
    d = x.shape[1]
    s = x @ R[:, 0]  # opening grows along the first tangent
    cells = joint_cells(zone, zone_field(zone, material))
    at = np.einsum("gm,m->g", cells.shape, s)
    K = stiffness(zone, material).values[0]
    upper = (s[:, None] * R[:, -1]).ravel()
    force = (K @ np.concatenate([upper, 0 * upper])).reshape(2, -1, d)[0]
    moment = s @ (force @ R[:, -1])
    assert moment == pytest.approx(5.0 * cells.weights[0] @ at**2, rel=1e-12)
    if rule == "GAUSS":
        width = {"SEG": 2 / 3, "QUA": 4 / 3, "TRI": 1 / 12}[FACES[element][1][:3]]
        assert moment == pytest.approx(5.0 * width * 3.0 ** (d + 1), rel=1e-12)


@together("element", FACES)
def test_reversed_joint_is_refused_when_it_has_a_thickness(element):
    zone, material, _, _ = one_joint(element, reverse=True, gap=0.05)
    with pytest.raises(MeshError) as error:
        joint_cells(zone, zone_field(zone, material))
    assert "exchange" in error.value.hint
    one_joint(element, gap=0.05)


def test_merged_sides_and_flat_joints_are_refused():
    zone, material, _, _ = one_joint("JOI2")
    raw = zone.cells.raw[0]
    zone.cells.nodes.merge(raw[:2], raw[2:])
    with pytest.raises(MeshError, match="same nodes"):
        joint_cells(zone, zone_field(zone, material))
    bench = Bench()
    a, b, c, e = (bench.node(0.0, 0.0) for _ in range(4))
    flat = bench.joint("RAC2", [a, b, c, e], "JOI2", KN=1.0, KS=1.0)
    with pytest.raises(MeshError, match="no area"):
        joint_cells(flat, None)


def test_axisymmetric_joint_weighs_a_whole_turn():
    bench = Bench(Mode.AXISYMMETRIC)
    top = [bench.node(r, 0.0) for r in (1.0, 3.0)]
    soil = [bench.node(r, 0.0) for r in (1.0, 3.0)]
    zone = bench.joint("RAC2", [*top, *soil], "JOI2", KN=1.0, KS=1.0)
    assert joint_cells(zone, None).weights.sum() == pytest.approx(np.pi * (9 - 1), rel=1e-13)
    assert JointFamily().layout(zone).unknowns[:2] == ("UR", "UZ")


def test_two_points_take_the_users_direction():
    bench = Bench(Mode.THREE_DIMENSIONAL)
    a, b = bench.node(0.0, 0.0, 0.0), bench.node(0.0, 0.0, 0.0)
    block = CellBlock.make(bench.table, "SEG2", np.array([[a, b]]))
    zone = Zone(block, "MECANIQUE", ("ELASTIQUE", "JOINT_SDM"), "JOI1", bench.mode)
    values = {"V1Z": 2.0, "V1X": 0.0, "V1Y": 0.0, "V2X": 1.0, "V2Y": 0.0, "V2Z": 0.3}
    field = CellField((CellFieldBlock(block, {k: np.full((1, 1), v) for k, v in values.items()}),))
    frame = joint_cells(zone, zone_field(zone, field)).frames[0, 0]
    np.testing.assert_allclose(frame, [[1, 0, 0], [0, 1, 0], [0, 0, 1]], atol=1e-15)
    with pytest.raises(MeshError, match="no length"):
        joint_cells(zone, None)


@together("mode", [Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL])
def test_axes_of_two_points_are_those_of_the_line_between_them(mode):
    """The normal goes from the first to the second; in the plane the tangent is 90 degrees on."""
    d = mode.dimension
    bench = Bench(mode)
    step = np.array([3.0, 4.0, 12.0][:d])
    ends = [bench.node(*np.zeros(d)), bench.node(*step)]
    zone = bench.joint("SEG2", ends, "JOI1", KN=1.0, KS=1.0)
    (frame,) = joint_cells(zone).frames[0]
    normal = step / np.linalg.norm(step)
    np.testing.assert_allclose(frame[-1], normal, rtol=1e-14)
    np.testing.assert_allclose(frame @ frame.T, np.eye(d), atol=1e-14)
    assert np.linalg.det(frame) == pytest.approx(1.0 if d == 3 else -1.0)
    if d == 2:
        np.testing.assert_allclose(frame[0], [-0.8, 0.6], rtol=1e-14)


@together("angle, refused", [(0.0, False), (115.0, False), (125.0, True)])
def test_a_direction_that_turns_its_back_on_the_second_point_is_refused(angle, refused):
    """A JOI1 that opens from its first point to its second; more than 120 degrees off is inside
    out."""
    bench = Bench()
    block = CellBlock.make(
        bench.table, "SEG2", np.array([[bench.node(0.0, 0.0), bench.node(3.0, 0.0)]])
    )
    zone = Zone(block, "MECANIQUE", ("ELASTIQUE", "JOINT_SDM"), "JOI1", bench.mode)
    turned = {"V1X": np.cos(np.radians(angle)), "V1Y": np.sin(np.radians(angle))}
    field = CellField((CellFieldBlock(block, {k: np.full((1, 1), v) for k, v in turned.items()}),))
    if refused:
        with refusal(MeshError, "kernel.interface.joint-joi1-normal-goes"):
            joint_cells(zone, zone_field(zone, field))
    else:
        (frame,) = joint_cells(zone, zone_field(zone, field)).frames[0]
        np.testing.assert_allclose(frame[-1], list(turned.values()), atol=1e-15)


@together("side", [1e-3, 1.0, 1e4])
def test_thickness_counts_against_the_length_of_a_cell(side):
    """A gap of a millionth of the side shows which way a joint opens, in any unit of length."""
    bench = Bench(Mode.THREE_DIMENSIONAL)
    square = np.array([[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]])
    ends = [[bench.node(*p, z) for p in square] for z in (0.0, -1e-6 * side)]
    zone = bench.joint("LIA4", [*ends[1], *ends[0]], "JOI4", KN=1.0, KS=1.0)
    with refusal(MeshError, "kernel.interface.joint-normal-goes-first"):
        joint_cells(zone, None)
    right = bench.joint("LIA4", [*ends[0], *ends[1]], "JOI4", KN=1.0, KS=1.0)
    assert joint_cells(right, None).weights.sum() == pytest.approx(side**2)
