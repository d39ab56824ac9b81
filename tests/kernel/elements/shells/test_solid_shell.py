"""SHB8, the shell on bricks, against patch tests, beam theory and a pinched cylinder."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.elements import families
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.elements.loads.thermal import thermal_strain
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from tests.kernel.elements.samples import ELASTIC, cell_zone, field, material, solved

E, NU = 2.0e6, 0.3


def bricks(nx, ny, place):
    """One layer of nx x ny bricks; `place` maps (s, t, z) in [0, 1] x [0, 1] x [-1/2, 1/2]."""
    table = NodeTable()
    S, T, Z = np.meshgrid(
        np.linspace(0, 1, nx + 1), np.linspace(0, 1, ny + 1), [-0.5, 0.5], indexing="ij"
    )
    ids = table.add(place(S.ravel(), T.ravel(), Z.ravel())).reshape(S.shape)
    round_ = (ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:])
    cells = np.column_stack([c[..., side].ravel() for side in (0, 1) for c in round_])
    block = CellBlock.make(table, "CUB8", cells)
    return Zone(block, "MECANIQUE", ELASTIC, "SHB8", Mode.THREE_DIMENSIONAL)


def distorted_plate(h):
    """3 x 3 bricks on 2 x 1.4, the inner nodes moved in the plane."""
    moves = np.random.default_rng(5).uniform(-0.12, 0.12, (16, 2))

    def place(s, t, z):
        i, j = np.round(3 * s).astype(int), np.round(3 * t).astype(int)
        inner = (i > 0) & (i < 3) & (j > 0) & (j < 3)
        shift = moves[4 * i + j] * inner[:, None]
        return np.column_stack([2 * s + shift[:, 0], 1.4 * t + shift[:, 1], h * z])

    return bricks(3, 3, place)


def residual_inside(zone, mat, u):
    """Largest force at the nodes off the contour, relative to the largest of all."""
    forces = families.internal_forces(zone, CellField((families.stress(zone, mat, u),)))
    nodes = np.arange(len(zone.cells.nodes.coordinates))
    x = zone.cells.nodes.coordinates
    inside = (x[:, 0] > 1e-9) & (x[:, 0] < 2 - 1e-9) & (x[:, 1] > 1e-9) & (x[:, 1] < 1.4 - 1e-9)
    f = np.stack([forces.values_at(n, nodes) for n in ("FX", "FY", "FZ")], axis=1)
    return np.abs(f[inside]).max() / np.abs(f).max()


def places(zone, numbering):
    """Coordinates of the unknowns of a zone."""
    return zone.cells.nodes.coordinates[numbering.nodes]


def bent(zone, length):
    """Deflection of the far end of a strip under a force of one there; its start is held."""
    tip = np.flatnonzero(zone.cells.nodes.coordinates[:, 0] > length - 1e-9)
    load = NodeField.of(zone.cells.nodes, tip, {"FZ": np.full(4, 0.25)}, "DISCRET")
    mat = material(zone, YOUN=E, NU=0.0)
    u = solved(zone, mat, lambda m: places(zone, m)[:, 0] < 1e-9, load)
    return u.values_at("UZ", tip).mean()


def test_constant_strain_passes_through_any_brick_and_is_held_by_nothing():
    zone = cell_zone("SHB8", Mode.THREE_DIMENSIONAL)
    u = field(
        zone,
        UX=lambda x: 1e-3 * x[:, 0] + 4e-4 * x[:, 1],
        UY=lambda x: -2e-4 * x[:, 1] + 5e-4 * x[:, 2],
        UZ=lambda x: 7e-4 * x[:, 2] + 2e-4 * x[:, 0],
    )
    strain = families.strain(zone, u).components
    exact = {"EPXX": 1e-3, "EPYY": -2e-4, "EPZZ": 7e-4, "GAXY": 4e-4, "GAXZ": 2e-4, "GAYZ": 5e-4}
    for name, value in exact.items():
        np.testing.assert_allclose(strain[name], value, atol=1e-15)
    held = np.concatenate([v for n, v in strain.items() if n.startswith("GH")])
    assert len(held) == 7
    assert np.abs(held).max() < 1e-15


@together("h", [0.2, 0.002])
def test_membrane_and_bending_patches_are_in_balance_on_a_distorted_mesh(h):
    zone = distorted_plate(h)
    mat = material(zone, YOUN=E, NU=NU)
    stretched = field(
        zone,
        UX=lambda x: 1e-3 * x[:, 0] + 4e-4 * x[:, 1],
        UY=lambda x: -2e-4 * x[:, 1],
        UZ=lambda x: 0 * x[:, 2],
    )
    kx, ky, kxy = 1e-3, -4e-4, 6e-4
    bent = field(
        zone,
        UX=lambda x: (kx * x[:, 0] + kxy * x[:, 1] / 2) * x[:, 2],
        UY=lambda x: (ky * x[:, 1] + kxy * x[:, 0] / 2) * x[:, 2],
        UZ=lambda x: -(kx * x[:, 0] ** 2 + ky * x[:, 1] ** 2 + kxy * x[:, 0] * x[:, 1]) / 2,
    )
    assert residual_inside(zone, mat, stretched) < 1e-10
    strain = families.strain(zone, bent).components
    z = 0.5 * h * np.polynomial.legendre.leggauss(5)[0]
    for name, k in {"EPXX": kx, "EPYY": ky, "GAXY": kxy}.items():
        np.testing.assert_allclose(strain[name], k * z + 0 * strain[name], atol=1e-9 * h)
    assert residual_inside(zone, mat, bent) < 1e-6  # round-off grows as the square of 1/h


@together("h, rtol", [(1.0, 0.01), (0.1, 0.004), (0.01, 0.004)])
def test_clamped_strip_bends_like_a_beam_at_any_thinness(h, rtol):
    L, n = 10.0, 10
    zone = bricks(n, 1, lambda s, t, z: np.column_stack([L * s, t, h * z]))
    theory = L**3 / (3 * E * h**3 / 12) + L / (E / 2 * h)
    assert bent(zone, L) == pytest.approx(theory, rel=rtol)


def test_strip_of_skew_bricks_does_not_lock():
    L, h, n = 10.0, 0.05, 10

    def place(s, t, z):
        lean = 0.3 * np.where(np.round(n * s) % 2, 1, -1) * (s > 0.01) * (s < 0.99)
        return np.column_stack([L * s + lean * (2 * t - 1), t, h * z])

    found = bent(bricks(n, 1, place), L)
    assert found == pytest.approx(L**3 / (3 * E * h**3 / 12), rel=0.02)


def pinched(n):
    """Deflection under the load of a cylinder pinched between end diaphragms, n x n on 1/8."""
    R, L, h, young = 300.0, 600.0, 3.0, 3e6

    def place(s, t, z):
        r, a = R + h * z, np.pi / 2 * t
        return np.column_stack([r * np.cos(a), r * np.sin(a), L / 2 * s])

    def fixed(numbering):
        x, y, z = places(zone, numbering).T
        names = np.array(numbering.unknowns)[numbering.codes]
        held = (z < 1e-6) & (names != "UZ")  # diaphragm
        for name, plane in (("UX", x < 1e-6), ("UY", y < 1e-6), ("UZ", z > L / 2 - 1e-6)):
            held |= plane & (names == name)
        return held

    zone = bricks(n, n, place)
    x = zone.cells.nodes.coordinates
    under = np.flatnonzero((x[:, 2] > L / 2 - 1e-6) & (x[:, 1] < 1e-6))
    load = NodeField.of(zone.cells.nodes, under, {"FX": np.full(2, -0.125)}, "DISCRET")
    u = solved(zone, material(zone, YOUN=young, NU=0.3), fixed, load)
    return -u.values_at("UX", under).mean()


def test_pinched_cylinder_tends_to_the_known_deflection():
    reference = 1.8248e-5  # Belytschko et al. 1985, the series of Lindberg et al. 1969
    found = [pinched(n) / reference for n in (8, 16, 32)]
    assert found[0] < found[1] < found[2]
    assert found[1] > 0.9
    assert found[2] == pytest.approx(1.0, abs=0.03)


def test_mass_is_the_matter_and_a_free_rise_of_temperature_makes_no_stress_across():
    zone = distorted_plate(0.2)
    mat = material(zone, YOUN=E, NU=NU, RHO=5.0, ALPH=1e-5)
    block = families.mass(zone, mat)
    rows = [i for i, u in enumerate(block.unknowns) if u == "UZ"]
    assert block.values[:, rows][:, :, rows].sum() == pytest.approx(5.0 * 2 * 1.4 * 0.2)
    hot = field(zone, T=lambda x: 20 + 0 * x[:, 0])
    rise = thermal_strain(zone, mat, hot)
    np.testing.assert_allclose(rise[:, :3], 2e-4, rtol=1e-12)
    assert not rise[:, 3:].any()


def test_strip_buckles_at_eulers_load():
    L, h, n = 10.0, 0.1, 16
    zone = bricks(n, 1, lambda s, t, z: np.column_stack([L * s, t, h * z]))
    mat = material(zone, YOUN=E, NU=0.0)
    K = Matrix(zone.cells.nodes, (families.stiffness(zone, mat),))
    pressed = families.stress(
        zone, mat, field(zone, UX=lambda x: -x[:, 0] / (E * h), UY=lambda x: 0 * x[:, 0])
    )  # unit force over the section
    G = Matrix(zone.cells.nodes, (families.geometric_stiffness(zone, CellField((pressed,)), mat),))
    numbering = numbering_of(K, G)
    free = places(zone, numbering)[:, 0] > 1e-9
    k, g = (assemble(m, numbering).toarray()[np.ix_(free, free)] for m in (K, G))
    load = 1 / np.linalg.eigvals(np.linalg.solve(k, -g)).real.max()
    assert load == pytest.approx(np.pi**2 * E * h**3 / 12 / (2 * L) ** 2, rel=0.01)


def test_stresses_of_each_layer_work_on_what_turns_by_the_layer_s_share():
    zone = bricks(2, 1, lambda s, t, z: np.column_stack([3.0 * s, 2.0 * t, 0.4 * z]))
    _, weights = np.polynomial.legendre.leggauss(5)
    stress = np.array([1.0, -3.0, 2.0, 5.0, 7.0]) * np.array([[1.0], [2.0]])
    blank = families.stress(zone, material(zone, YOUN=E, NU=0.0), field(zone, UX=lambda x: x[:, 0]))
    given = {n: stress if n == "SMXX" else 0.0 * v for n, v in blank.components.items()}
    pressed = CellField((CellFieldBlock(zone.cells, given, blank.support, "SHB8"),))
    block = families.geometric_stiffness(zone, pressed, material(zone, YOUN=E, NU=0.0))
    layout = Layout(block.table, block.raw_nodes, block.local, block.unknowns)
    u = layout.gather(field(zone, UZ=lambda x: x[:, 0]))
    found = np.einsum("ci,cij,cj->c", u, block.values, u)
    np.testing.assert_allclose(found, 1.5 * 2.0 * 0.4 * stress @ (weights / 2.0))
