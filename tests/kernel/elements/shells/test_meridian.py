"""Shells of a meridian: their mass, in the plane and round an axis, on rigid motions."""

import itertools

import numpy as np
from together import together

from ssilang.kernel.elements import families
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.shells.meridian_shell import meridian_forces
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.mesh.mesh import Point
from tests.kernel.elements.samples import line_zone, material

POINTS = np.array([[1.0, 0.2], [1.5, 0.9], [2.4, 1.0]])
RHO, H = 2.5, 0.1
X, W = np.polynomial.legendre.leggauss(6)


def integral(f, weight):
    """Of a function of positions along both cells."""
    total = []
    for a, b in itertools.pairwise(POINTS):
        at = a + (X[:, None] + 1) / 2 * (b - a)
        total.append((W / 2 * np.linalg.norm(b - a) * f(at) * weight(at)).sum())
    return np.array(total)


def squared(block, x, u, turn=0.0, around=0.0):
    """`v B v` of each cell, v of motions u(x) along the meridian, a turn, one round the axis."""
    v = np.zeros((len(x), len(block.unknowns)))
    for i, (node, name) in enumerate(zip(block.local, block.unknowns, strict=True)):
        if node == 2:  # the section's own motion
            continue
        at = u(x[:, node])
        value = {"UX": at[:, 0], "UR": at[:, 0], "UY": at[:, 1], "RZ": turn, "RT": turn,
                 "UT": around}  # fmt: skip
        v[:, i] = value.get(name, at[:, 1] if name == "UZ" else 0.0)
    return np.einsum("ci,cij,cj->c", v, block.values, v)


def turning(x, centre=(0.3, 1.7)):
    """A turn about a point, from the first axis to the second."""
    arm = x - np.array(centre)
    return np.stack([-arm[:, 1], arm[:, 0]], axis=1)


WAYS = together(
    "mode, harmonic, weight",
    [
        (Mode.PLANE_STRAIN, 0, lambda x: 1.0),
        (Mode.PLANE_STRESS, 0, lambda x: 0.4),
        (Mode.GENERALISED_PLANE_STRAIN, 0, lambda x: 1.0),
        (Mode.AXISYMMETRIC, 0, lambda x: 2 * np.pi * x[:, 0]),
        (Mode.FOURIER, 0, lambda x: 2 * np.pi * x[:, 0]),
        (Mode.FOURIER, 2, lambda x: np.pi * x[:, 0]),
    ],
)


@WAYS
def test_mass_is_that_of_the_matter_on_slides_and_turns(mode, harmonic, weight):
    zone = line_zone("COQ2", POINTS, mode)
    if mode is Mode.FOURIER:
        zone.options["harmonic"] = harmonic
    given = {"RHO": RHO, "EPAI": H} | ({"DIM3": 0.4} if mode is Mode.PLANE_STRESS else {})
    block = families.mass(zone, material(zone, **given))
    x = zone.cells.coordinates[:, :, :2]
    matter = RHO * H * integral(lambda x: np.ones(len(x)), weight)
    slide = np.array([0.6, -0.8])
    np.testing.assert_allclose(squared(block, x, lambda x: np.broadcast_to(slide, x.shape)), matter)
    if mode is Mode.FOURIER:
        still = squared(block, x, lambda x: 0 * x, around=1.0)
        np.testing.assert_allclose(still, matter)
    if mode is Mode.PLANE_STRESS:  # each cell has its own width
        own = material(zone, **given | {"YOUN": 7.0, "NU": 0.2})
        whole = [of(zone, own).values for of in (families.mass, families.stiffness)]
        own.blocks[0].components["DIM3"][:, 0] = 0.4 * np.array([1.0, 2.5])
        for of, one in zip((families.mass, families.stiffness), whole, strict=True):
            np.testing.assert_allclose(of(zone, own).values, one * [[[1.0]], [[2.5]]], rtol=1e-12)
    sign = -1.0 if mode in (Mode.AXISYMMETRIC, Mode.FOURIER) else 1.0
    expected = RHO * H * integral(lambda x: (turning(x) ** 2).sum(axis=1), weight)
    found = [squared(block, x, turning, s * sign) for s in (1.0, -1.0)]
    best = min(found, key=lambda e: abs(e - expected).max())
    np.testing.assert_allclose(best, expected, rtol=2e-3)  # a rule of few points on the ring
    np.testing.assert_allclose(block.values, np.swapaxes(block.values, 1, 2), atol=1e-12)


@WAYS
def test_a_force_along_the_meridian_works_on_a_turn_of_it(mode, harmonic, weight):
    """Its length and width times the force times the square of the turn."""
    zone = line_zone("COQ2", POINTS, mode)
    zone.options.update(harmonic=harmonic, DPGE=Point(zone.cells.nodes, 0))
    names = families.family_of(zone).stress_names(zone)
    forces = {n: np.full((2, 1), 3.0 * (n == "N11")) for n in names}
    given = {"DIM3": np.array([[0.4], [0.4]])} if mode is Mode.PLANE_STRESS else {}
    fields = [CellFieldBlock(zone.cells, v, "GRAVITE", "COQ2") for v in (forces, given)]
    force, material = (CellField((block,)) for block in fields)
    block = families.geometric_stiffness(zone, force, material)
    x = zone.cells.coordinates[:, :, :2]
    expected = 3.0 * integral(lambda x: np.ones(len(x)), weight)
    np.testing.assert_allclose(squared(block, x, turning, 1.0), expected)


def test_loads_push_as_they_are_round_the_axis_and_by_the_width_of_each_cell():
    for mode, d in ((Mode.FOURIER, 3), (Mode.PLANE_STRESS, 2)):
        zone = line_zone("COQ2", POINTS, mode)
        zone.options["harmonic"] = 1
        pushed = np.random.default_rng(3).normal(size=(2, len(support_rule("COQ2", "MASSE")), d))
        width = np.array([[0.4], [0.9]]) if d == 2 else np.ones((2, 1))
        block = CellFieldBlock(zone.cells, {"DIM3": width}, "GRAVITE", "COQ2")
        found = meridian_forces(zone, pushed, zone_field(zone, CellField((block,))))
        names = ("FR", "FZ", "FT") if d == 3 else ("FX", "FY")
        total = [found.components[n].values.sum() for n in names]
        np.testing.assert_allclose(total, (pushed * width[..., None]).sum(axis=(0, 1)))
