"""Bodies in a turning frame and beams that turn: work on rigid motions and by the mass itself."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.beams.rotating import (
    corotational,
    cross_matrix,
    gyroscopic,
    inertia_coupling,
)
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode
from tests.kernel.elements.samples import cell_zone, line_zone
from tests.kernel.elements.samples import material as constant
from tests.kernel.elements.test_every_element import Two, turned

A = np.array([[0.7, -1.2, 0.4], [2.1, 1.3, -0.6], [0.5, 0.9, -1.1]])
SPACE = Mode.THREE_DIMENSIONAL
ELEMENTS = [(e, SPACE) for e in ("CUB8", "PR15", "BARR", "TIMO", "DKT", "DST", "COQ4", "COQ8")]
ELEMENTS += [("QUA8", Mode.PLANE_STRAIN), ("TRI3", Mode.PLANE_STRESS)]


def with_speed(two, **more):
    """The parameters of two beams and how fast they turn."""
    (block,) = two.material.blocks
    block.components.update({"OMEG": np.array([[3.0], [7.0]]), **more})
    return CellField((block,), "CARACTERISTIQUES")


@together("element, mode", ELEMENTS)
def test_coupling_is_the_mass_between_each_pair_of_directions(element, mode):
    two = Two(element, mode, turned(0.4, mode))
    coupled = inertia_coupling(two.zone, two.material, A)
    mass = families.mass(two.zone, two.material)
    rng = np.random.default_rng(3)
    f, g = rng.standard_normal((2, 2, len(coupled.local)))
    names, local = np.array(coupled.unknowns), coupled.local

    def along(values, name):
        """Values of nodes on one unknown."""
        at = np.zeros((2, len(names)))
        mine = np.flatnonzero(names == name)
        at[:, mine] = values[:, local[mine]]
        return at

    flat = ("UX", "UY", "UZ")[: 3 if mode is SPACE else 2]
    for a, one in enumerate(flat):
        for b, other in enumerate(flat):
            found = np.einsum("ci,cij,cj->c", along(f, one), coupled.values, along(g, other))
            plain = np.einsum("ci,cij,cj->c", along(f, one), mass.values, along(g, one))
            np.testing.assert_allclose(found, A[a, b] * plain, atol=1e-9 * np.abs(plain).max())
    turning = [i for i, n in enumerate(names) if n[0] == "R"]
    assert not coupled.values[:, turning].any()
    assert not coupled.symmetric
    assert inertia_coupling(two.zone, two.material, A + A.T).symmetric


def rigid(two, w, t):
    """Displacements and rotations (cells, rows) of a turn w and a slide t, nodes by node."""
    x = two.zone.cells.coordinates
    u = np.cross(w, x) + t
    return np.concatenate([u, np.broadcast_to(w, u.shape)], axis=2).reshape(len(x), -1)


W = (np.array([0.3, -0.8, 0.5]), np.array([-0.6, 0.2, 0.9]))
T = (np.array([0.1, 0.7, -0.4]), np.array([0.8, -0.3, 0.2]))


@together("element", ["POUT", "TUYA"])
def test_beams_count_the_mass_on_their_line(element):
    two = Two(element, SPACE, turned(0.4, SPACE))
    coupled = inertia_coupling(two.zone, two.material, A)
    a, b = (rigid(two, w, t) for w, t in zip(W, T, strict=True))
    mass = np.einsum("ci,cij,cj->c", *(rigid(two, 0 * W[0], np.array([1.0, 0, 0])),
                                       families.mass(two.zone, two.material).values,
                                       rigid(two, 0 * W[0], np.array([1.0, 0, 0]))))  # fmt: skip
    x = two.zone.cells.coordinates
    expected = 0.0
    for s, share in ((0.0, 1 / 6), (0.5, 4 / 6), (1.0, 1 / 6)):  # Simpson is exact
        at = (1 - s) * x[:, 0] + s * x[:, 1]
        u, v = (np.cross(w, at) + t for w, t in zip(W, T, strict=True))
        expected = expected + share * np.einsum("ci,ij,cj->c", u, A, v)
    found = np.einsum("ci,cij,cj->c", a, coupled.values, b)
    np.testing.assert_allclose(found, mass * expected, rtol=1e-10)


@together("element", ["POUT", "TIMO", "TUYA"])
def test_a_turning_section_answers_a_tilt_by_a_moment_about_the_other_axis(element):
    two = Two(element, SPACE, turned(0.4, SPACE))
    field = with_speed(two)
    block = gyroscopic(two.zone, field)
    x = two.zone.cells.coordinates
    L = np.linalg.norm(x[:, 1] - x[:, 0], axis=1)
    axis = (x[:, 1] - x[:, 0]) / L[:, None]
    given = {k: v[:, 0] for k, v in two.material.blocks[0].components.items()}
    if element == "TUYA":
        r, h = given["RAYO"], given["EPAI"]
        polar = np.pi / 2 * (r**4 - (r - h) ** 4)
    else:
        polar = given["INRY"] + given["INRZ"]
    a, b = (rigid(two, w, t) for w, t in zip(W, T, strict=True))
    found = np.einsum("ci,cij,cj->c", a, block.values, b)
    spin = given["RHO"] * polar * given["OMEG"] * L
    np.testing.assert_allclose(found, spin * (axis @ np.cross(*W)), rtol=1e-8)
    np.testing.assert_allclose(block.values, -np.swapaxes(block.values, 1, 2), atol=1e-9)
    assert not block.symmetric


def test_a_damping_that_turns_pushes_by_what_the_turn_moves():
    two = Two("TIMO", SPACE, turned(0.4, SPACE))
    field = with_speed(two)
    damping = families.mass(two.zone, two.material)
    block = corotational(two.zone, damping, field)
    x = two.zone.cells.coordinates
    axis = (x[:, 1] - x[:, 0]) / np.linalg.norm(x[:, 1] - x[:, 0], axis=1)[:, None]
    u = np.random.default_rng(1).standard_normal((2, 4, 3))  # of two nodes, moves and turns
    w = np.array([3.0, 7.0])[:, None] * axis
    carried = np.cross(w[:, None], u).reshape(2, 12)
    np.testing.assert_allclose(
        np.einsum("cij,cj->ci", block.values, u.reshape(2, 12)),
        -np.einsum("cij,cj->ci", damping.values, carried),
    )
    assert not block.symmetric


def test_frames_that_couple_a_harmonic_or_elements_that_do_not_turn_are_refused():
    np.testing.assert_allclose(cross_matrix(W[0]) @ T[0], np.cross(W[0], T[0]))
    zone = cell_zone("QUA4", Mode.AXISYMMETRIC)
    field = constant(zone, RHO=2.0)
    with pytest.raises(FieldError, match="turning"):
        inertia_coupling(zone, field, A)
    block = inertia_coupling(zone, field, np.diag([1.0, 2.0, 3.0]))
    mass = families.mass(zone, field).values
    factor = {"UR": 1.0, "UT": 2.0, "UZ": 3.0}
    np.testing.assert_allclose(block.values, mass * [factor[n] for n in block.unknowns])
    for made in (gyroscopic, lambda z, f: corotational(z, block, f)):
        with pytest.raises(FieldError, match="QUA4"):
            made(zone, field)
    ring = line_zone("COQ2", [[1.0, 0.0], [1.0, 2.0]], Mode.AXISYMMETRIC)
    with pytest.raises(FieldError, match="COQ2"):
        inertia_coupling(ring, constant(ring, RHO=1.0, EPAI=0.1), np.eye(3))
