"""Rotation and stretch of a gradient, and the components that a mode gives it."""

import numpy as np
import pytest
from refusing import refusal
from script_runs import ran
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.solids.finite_motion import (
    gradient_components,
    polar,
    transformation,
    work,
)
from ssilang.kernel.elements.solids.gradients import gradient_names
from ssilang.kernel.elements.solids.solid import kinematics
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode
from tests.kernel.elements.samples import cell_zone


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
