"""Rotation, stretch and gradients in every hypothesis; generalised plane strain."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
from refusing import refusal
from script_runs import ran
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.elements.results.frames import points_of
from ssilang.kernel.elements.solids.finite_motion import (
    gradient_components,
    polar,
    transformation,
    work,
)
from ssilang.kernel.elements.solids.gradients import (
    gradient_names,
    logarithmic_strain,
    scalar_gradient,
)
from ssilang.kernel.elements.solids.solid import kinematics
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.mesh.mesh import Point
from tests.kernel.elements.samples import cell_zone, field, material


def turn(axis: tuple[float, float, float], angle: float) -> np.ndarray:
    """Rodrigues' rotation."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def test_a_gradient_is_a_rotation_times_a_stretch() -> None:
    """F is put together from a known rotation and a known symmetric stretch."""
    U = np.array([[1.5, 0.2, -0.1], [0.2, 0.8, 0.3], [-0.1, 0.3, 2.0]])
    R = turn((1.0, -2.0, 0.5), 0.7)
    found_R, found_U = polar(np.stack([R @ U, R, U, np.eye(3)]))
    np.testing.assert_allclose(found_R, np.stack([R, R, np.eye(3), np.eye(3)]), atol=1e-14)
    np.testing.assert_allclose(found_U, np.stack([U, np.eye(3), U, np.eye(3)]), atol=1e-14)


@together("bad", [np.diag([1.0, 1.0, -1.0]), np.zeros((3, 3)), np.full((3, 3), np.nan)])
def test_a_volume_that_is_turned_inside_out_is_refused(bad: np.ndarray) -> None:
    with refusal(FieldError, "kernel.elements.gradient-motion-determinant-not"):
        polar(bad)


@together(
    "element, mode, F",
    [
        ("QUA4", Mode.PLANE_STRAIN, [[1.2, 0.3, 0.0], [-0.1, 0.9, 0.0], [0.0, 0.0, 1.0]]),
        ("QUA4", Mode.PLANE_STRESS, [[0.7, 0.1, 0.0], [0.2, 1.4, 0.0], [0.0, 0.0, 1.0]]),
        ("QUA8", Mode.AXISYMMETRIC, [[1.2, 0.3, 0.0], [-0.1, 0.9, 0.0], [0.0, 0.0, 1.3]]),
        ("CUB8", Mode.THREE_DIMENSIONAL, [[1.2, 0.3, 0.4], [-0.1, 0.9, 0.5], [0.6, -0.2, 1.1]]),
    ],
)
def test_a_gradient_is_given_by_its_components_or_by_those_of_a_displacement(element, mode, F):
    """A plane keeps its thickness, a ring has the stretch of its circumference."""
    zone = cell_zone(element, mode)
    whole = np.tile(np.array(F), (1, 4, 1, 1))
    given = gradient_components(zone, whole)
    np.testing.assert_allclose(transformation(zone, given, False), whole, atol=1e-15)
    moved = gradient_components(zone, whole - np.eye(3))
    np.testing.assert_allclose(transformation(zone, moved, True), whole, atol=1e-15)


_PLANE = (
    "OPTI DIME 2 ELEM QUA4 MODE PLAN CONT ; S = (DROI 2 (0. 0.) (1. 0.)) TRAN 2 (0. 1.) ;"
    "X Y = COOR S ; U0 = (NOMC 'UX' ((0.01 * X) + (0.02 * Y))) + (NOMC 'UY' (-0.02 * Y)) ;"
    "U = (NOMC 'UX' ((3. * X) + Y)) + (NOMC 'UY' ((2. * X) - Y)) ;"
)
_RING = (
    "OPTI DIME 2 ELEM QUA4 MODE AXIS ; S = (DROI 2 (1. 0.) (2. 0.)) TRAN 2 (0. 1.) ;"
    "X Y = COOR S ; U0 = NOMC 'UR' (0.01 * X) ;"
    "U = (NOMC 'UR' (2. * X)) + (NOMC 'UZ' ((3. * X) + Y)) ;"
)


@together(
    "element, mode",
    [("QUA4", Mode.PLANE_STRAIN), ("TRI6", Mode.AXISYMMETRIC), ("TET4", Mode.THREE_DIMENSIONAL)],
)
def test_stresses_work_on_gradients_term_by_term(element, mode):
    zone, rng = cell_zone(element, mode), np.random.default_rng(6)
    n = len(support_rule(element, "STRESSES").weights)
    d = mode.dimension
    s, H = rng.standard_normal((2, 1, n, 3, 3))
    if d == 2:
        s[..., 2, :2] = s[..., :2, 2] = H[..., 2, :2] = H[..., :2, 2] = 0.0
        H[..., 2, 2] *= mode is Mode.AXISYMMETRIC
    s = s + np.swapaxes(s, -1, -2)
    pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
    stress = {
        name: s[..., i, j] for name, (i, j) in zip(kinematics(zone).stresses, pairs, strict=False)
    }
    rows = [(i, j) for i in range(d) for j in range(d)] + [(2, 2)] * (mode is Mode.AXISYMMETRIC)
    gradient = {name: H[..., i, j] for name, (i, j) in zip(gradient_names(zone), rows, strict=True)}
    fields = [
        CellField((CellFieldBlock(zone.cells, given, "STRESSES", element),))
        for given in (stress, gradient)
    ]
    found, support = work(zone, *fields)
    np.testing.assert_allclose(found, np.einsum("cpij,cpij->cp", s, H), rtol=1e-12)
    assert support == "STRESSES"


@together(
    "text, exact",
    [
        # stresses 1, -2 and 1 in shear: 1 (3^2 + 2^2) - 2 (1^2 + 1^2) + 2 (3 - 2)
        (_PLANE, 11.0),
        # radial and hoop stress 1: (2^2 + 3^2) + 2^2 over the volume 3 pi of the ring
        (_RING, 17.0 * 3.0 * np.pi),
    ],
)
def test_stresses_work_on_the_squares_of_gradients(text, exact, tmp_path):
    """U K U of the geometric stiffness: the integral of s_ij U_k,i U_k,j, for linear U."""
    text += (
        "M = MODE S 'MECANIQUE' 'ELASTIQUE' ; A = MATE M 'YOUN' 100. 'NU' 0. ;"
        "Z = XTMX U (KSIG M (SIGM M A U0)) ;"
    )
    result = ran(text, tmp_path)
    assert result.session.root.find("Z") == pytest.approx(exact, rel=1e-12)


MODE = Mode.GENERALISED_PLANE_STRAIN
E, NU = 3e7, 0.2


@pytest.fixture(params=["QUA4", "TRI6", "QUA8"])
def zone(request):
    plain = cell_zone(request.param, MODE)
    node = int(plain.cells.nodes.add(np.array([[0.7, -0.4]]))[0])
    return replace(plain, options={"DPGE": Point(plain.cells.nodes, node)})


def motion(zone, u, section):
    """Displacements of the cell's nodes and UZ RX RY of the section's."""
    table = zone.cells.nodes
    nodes = np.sort(zone.cells.connectivity[0])
    parts = {n: NodeValues(nodes, u(table.coordinates[nodes])[:, i]) for i, n in
             enumerate(("UX", "UY"))}  # fmt: skip
    own = np.array([zone.options["DPGE"].number])
    parts |= {n: NodeValues(own, np.array([v])) for n, v in
              zip(("UZ", "RX", "RY"), section, strict=True)}  # fmt: skip
    return NodeField(table, parts, "DIFFUS")


def test_forces_on_the_section_are_the_resultants_of_the_stresses_across(zone):
    given = material(zone, YOUN=E, NU=NU)
    u = motion(zone, lambda x: x[:, :2] * [1e-3, -2e-3], (2e-3, 5e-4, -3e-4))
    stress = families.stress(zone, given, u)
    forces = families.internal_forces(zone, CellField((stress,)), given)
    K = families.stiffness(zone, given)
    layout = Layout(zone.cells.nodes, K.raw_nodes, K.local, K.unknowns)
    exact = layout.scatter(np.einsum("cij,cj->ci", K.values, layout.gather(u)))
    nodes = np.unique(K.raw_nodes)
    for name in ("FX", "FY", "FZ", "MX", "MY"):
        np.testing.assert_allclose(
            forces.values_at(name, nodes), exact.values_at(name, nodes), atol=1e-6
        )
    w = families.integration_weights(zone, "STRESSES", given)[0]
    x, s = points_of(zone, "STRESSES")[0], stress.components["SMZZ"][0]
    at = np.array([zone.options["DPGE"].number])
    for name, arm in (("FZ", 1.0), ("MX", x[:, 1] + 0.4), ("MY", 0.7 - x[:, 0])):
        assert forces.values_at(name, at)[0] == pytest.approx((w * s * arm).sum(), rel=1e-9)


@together("element, mode", [("QUA8", Mode.PLANE_STRAIN), ("CU20", Mode.THREE_DIMENSIONAL)])
def test_a_linear_component_has_one_gradient(element, mode):
    zone = cell_zone(element, mode)
    found = scalar_gradient(zone, field(zone, T=lambda x: 3 * x[:, 0] - 2 * x[:, 1] + x[:, 2]), "T")
    d = mode.dimension
    np.testing.assert_allclose(
        found[0], np.broadcast_to(np.array([3.0, -2.0, 1.0])[:d, None], found[0].shape)
    )


@together("of_displacement", [False, True])
@together("mode", [Mode.PLANE_STRAIN, Mode.PLANE_STRESS, Mode.AXISYMMETRIC, Mode.THREE_DIMENSIONAL])
def test_logarithmic_strains_are_those_of_the_matrix_logarithm(mode, of_displacement):
    space = mode is Mode.THREE_DIMENSIONAL
    zone = cell_zone("CUB8" if space else "QUA4", mode)
    d = 3 if space else 2
    rng = np.random.default_rng(1)
    p = 4
    F = np.eye(3)[None] + 0.0 * np.ones((p, 1, 1))
    F[:, :d, :d] += 0.3 * rng.standard_normal((p, d, d))
    if mode is Mode.AXISYMMETRIC:
        F[:, 2, 2] = rng.uniform(0.8, 1.3, p)
    given = F - np.eye(3) if of_displacement else F
    flat = given[:, :d, :d].reshape(p, -1).T
    if mode is Mode.AXISYMMETRIC:
        flat = np.vstack([flat, given[:, 2, 2]])
    assert len(flat) == len(gradient_names(zone))
    found = logarithmic_strain(zone, flat[None], of_displacement)
    for k in range(p):
        E = 0.5 * la.logm(F[k].T @ F[k])
        rows = [E[0, 0], E[1, 1], E[2, 2], 2 * E[0, 1], 2 * E[0, 2], 2 * E[1, 2]]
        np.testing.assert_allclose(found[0, :, k], rows[: found.shape[1]], atol=1e-10)
