"""Bars and beams against beam theory."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.beams.fibre_section import FibreSection, fibre_places
from ssilang.kernel.elements.loads.loads import line_load
from ssilang.kernel.elements.results.integrals import green_strain, green_stress
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from tests.kernel.elements.samples import ELASTIC, field, line_zone, material, solved

E, NU, A, IY, IZ, J, L = 2.0e11, 0.25, 0.02, 3e-5, 5e-5, 6e-5, 3.0
SECTION = {"YOUN": E, "NU": NU, "RHO": 7800.0, "SECT": A, "INRY": IY, "INRZ": IZ, "TORS": J}
AXIS = np.array([2.0, 1.0, 2.0]) / 3.0


def _clamped(zone, mat, load):
    """Displacements under nodal forces, the first node being fixed."""
    return solved(zone, mat, lambda numbering: numbering.nodes == 0, load)


def _free_parts(blocks, is_free):
    """Dense matrices of element blocks on the unknowns (node, name) that are free."""
    parts = [Matrix(block.table, (block,)) for block in blocks]
    numbering = numbering_of(*parts)
    names = [numbering.unknowns[c] for c in numbering.codes]
    free = np.array([is_free(*at) for at in zip(numbering.nodes, names, strict=True)])
    return [assemble(a, numbering).toarray()[np.ix_(free, free)] for a in parts]


def _force(zone, node, **values):
    return NodeField.of(
        zone.cells.nodes, np.array([node]), {k: np.array([v]) for k, v in values.items()}, "DISCRET"
    )


def test_beam_in_the_plane_bends_exactly_with_one_element():
    zone = line_zone("POUT", [(0, 0), (L * 0.6, L * 0.8)], Mode.PLANE_STRESS)
    mat = material(zone, YOUN=E, NU=NU, SECT=A, INRZ=IZ)
    P = 1e3
    u = _clamped(zone, mat, _force(zone, 1, FX=-0.8 * P, FY=0.6 * P))
    tip = np.array([1])
    across = -0.8 * u.values_at("UX", tip) + 0.6 * u.values_at("UY", tip)
    np.testing.assert_allclose(across, P * L**3 / (3 * E * IZ), rtol=1e-12)
    np.testing.assert_allclose(u.values_at("RZ", tip), P * L**2 / (2 * E * IZ), rtol=1e-12)
    stress = families.stress(zone, mat, u)
    np.testing.assert_allclose(stress.components["MOMZ"], [[P * L, 0.0]], atol=1e-8 * P)
    np.testing.assert_allclose(stress.components["EFFY"], P, rtol=1e-9)


def test_beam_in_space_bends_about_the_axis_that_vect_shows():
    zone = line_zone("POUT", [(0, 0, 0), (0, 0, L)], Mode.THREE_DIMENSIONAL)
    mat = material(zone, **SECTION, VX=1.0, VY=0.0, VZ=0.0)  # local y is the global x
    u = _clamped(zone, mat, _force(zone, 1, FX=1e3, FY=1e3, MZ=50.0))
    tip = np.array([1])
    np.testing.assert_allclose(u.values_at("UX", tip), 1e3 * L**3 / (3 * E * IZ), rtol=1e-12)
    np.testing.assert_allclose(u.values_at("UY", tip), 1e3 * L**3 / (3 * E * IY), rtol=1e-12)
    np.testing.assert_allclose(
        u.values_at("RZ", tip), 50.0 * L / (E / (2 * (1 + NU)) * J), rtol=1e-12
    )


def test_sheared_section_adds_its_deflection():
    zone = line_zone("POUT", [(0, 0), (L, 0)], Mode.PLANE_STRESS)
    mat = material(zone, YOUN=E, NU=NU, SECT=A, INRZ=IZ, SECY=A / 1.2)
    u = _clamped(zone, mat, _force(zone, 1, FY=1e3))
    G = E / (2 * (1 + NU))
    expected = 1e3 * L**3 / (3 * E * IZ) + 1e3 * L / (G * A / 1.2)
    np.testing.assert_allclose(u.values_at("UY", np.array([1])), expected, rtol=1e-12)


def test_timoshenko_elements_converge_at_second_order():
    errors = []
    for n in (8, 16):
        zone = line_zone("TIMO", [(x, 0) for x in np.linspace(0, L, n + 1)], Mode.PLANE_STRESS)
        mat = material(zone, YOUN=E, NU=NU, SECT=A, INRZ=IZ)
        u = _clamped(zone, mat, _force(zone, n, FY=1e3))
        exact = 1e3 * L**3 / (3 * E * IZ) + 1e3 * L / (E / (2 * (1 + NU)) * A)
        errors.append(abs(u.values_at("UY", np.array([n]))[0] / exact - 1))
    assert errors[1] < 0.27 * errors[0] < 0.27 * 0.01


def test_uniform_load_on_a_beam_gives_the_exact_tip_deflection():
    zone = line_zone("POUT", [(0, 0), (0.4 * L, 0), (L, 0)], Mode.PLANE_STRESS)
    mat = material(zone, YOUN=E, NU=NU, SECT=A, INRZ=IZ)
    load = line_load(Model((zone,)), np.array([0.0, -500.0, 0.0]))
    u = _clamped(zone, mat, load)
    tip = np.array([2])
    np.testing.assert_allclose(u.values_at("UY", tip), -500.0 * L**4 / (8 * E * IZ), rtol=1e-11)
    np.testing.assert_allclose(u.values_at("RZ", tip), -500.0 * L**3 / (6 * E * IZ), rtol=1e-11)
    assert load.components["FY"].values.sum() == pytest.approx(-500.0 * L)


def test_projected_load_counts_the_projected_length():
    zone = line_zone("POUT", [(0, 0), (3, 4)], Mode.PLANE_STRESS)
    load = line_load(Model((zone,)), np.array([0.0, -1.0, 0.0]), np.array([0.0, 1.0, 0.0]))
    assert load.components["FY"].values.sum() == pytest.approx(-3.0)


def test_sections_of_a_beam_turn_with_its_slope():
    # simply supported Rayleigh beam: w^2 = E I k^4 / (rho A (1 + r^2 k^2))
    n = 12
    zone = line_zone("POUT", [(x, 0) for x in np.linspace(0, L, n + 1)], Mode.PLANE_STRESS)
    thick = SECTION | {"INRZ": A * (L / 20) ** 2}
    mat = material(zone, **thick)
    blocks = families.stiffness(zone, mat), families.mass(zone, mat)
    k, m = _free_parts(blocks, lambda node, u: u == "RZ" or (u == "UY" and node not in (0, n)))
    omega = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(m, k)).real)[:2])
    wave = np.array([1.0, 2.0]) * np.pi / L
    rayleigh = E * (L / 20) ** 2 * wave**4 / (7800 * (1 + (L / 20) ** 2 * wave**2))
    np.testing.assert_allclose(omega, np.sqrt(rayleigh), rtol=2e-4)


def test_normal_force_works_on_the_turning_of_timoshenko_sections():
    zone = line_zone("TIMO", [(0, 0), (0.5, 0)], Mode.PLANE_STRESS)
    mat = material(zone, **SECTION)
    pull = CellField((material(zone, EFFX=3.0).blocks[0],), "CONTRAINTES")
    block = families.geometric_stiffness(zone, pull, mat)
    turned = np.array([0, 0, 0, 0, 0, 0.2])  # UX UY RZ at each end: only the second turns
    work = turned @ block.values[0] @ turned
    assert work == pytest.approx(3.0 * IZ / A * (0.2 / 0.5) ** 2 * 0.5)


def test_euler_buckling_load_from_the_geometric_stiffness():
    n = 8
    zone = line_zone("POUT", [(x, 0) for x in np.linspace(0, L, n + 1)], Mode.PLANE_STRESS)
    mat = material(zone, **SECTION)
    compression = CellField((material(zone, EFFX=-1.0).blocks[0],), "CONTRAINTES")
    blocks = families.stiffness(zone, mat), families.geometric_stiffness(zone, compression, mat)
    k, g = _free_parts(blocks, lambda node, name: node != 0)
    factors = 1 / np.linalg.eigvals(np.linalg.solve(k, -g)).real.max()
    assert factors == pytest.approx(np.pi**2 * E * IZ / (4 * L**2), rel=1e-4)


@together("stretch", [1.0, 1.3])
def test_second_order_strain_of_a_turned_bar_is_that_of_its_stretch(stretch):
    zone = line_zone("BARR", [(0, 0), (1, 2)], Mode.PLANE_STRESS)
    c, s = stretch * np.cos(0.7) - 1, stretch * np.sin(0.7)
    u = field(zone, UX=lambda x: c * x[:, 0] - s * x[:, 1], UY=lambda x: s * x[:, 0] + c * x[:, 1])
    exact = 0.5 * (stretch**2 - 1)
    np.testing.assert_allclose(green_strain(zone, u).components["EPSS"], exact, atol=1e-14)
    pulled = green_stress(zone, material(zone, YOUN=E, NU=NU, SECT=A), u).components["EFFX"]
    np.testing.assert_allclose(pulled, E * A * exact, atol=1e-14 * E * A)


def test_a_beam_without_its_inertia_is_refused():
    zone = line_zone("POUT", [(0, 0), (1, 0)], Mode.PLANE_STRESS)
    with pytest.raises(MaterialError, match="INRZ"):
        families.stiffness(zone, material(zone, YOUN=E, NU=NU, SECT=A))


def test_strains_of_a_sheared_section_are_its_forces_over_its_rigidities():
    """A cantilever under an end force: shear T / (G SECY) all along, curvature M / (E I)."""
    zone = line_zone("POUT", [(0, 0), (L, 0)], Mode.PLANE_STRESS)
    mat = material(zone, YOUN=E, NU=NU, SECT=A, INRZ=IZ, SECY=A / 1.2)
    load = _force(zone, 1, FX=2e3, FY=1e3)
    strain = families.strain(zone, _clamped(zone, mat, load), mat).components
    G = E / (2 * (1 + NU))
    np.testing.assert_allclose(strain["EPS"], 2e3 / (E * A), rtol=1e-9)
    np.testing.assert_allclose(np.abs(strain["GXY"]), 1e3 / (G * A / 1.2), rtol=1e-9)
    curvature = np.abs(strain["CZ"][0])
    np.testing.assert_allclose(curvature, [1e3 * L / (E * IZ), 0.0], atol=1e-9 * curvature[0])


def test_the_energy_of_a_section_is_that_of_its_fibres():
    rng, n = np.random.default_rng(3), 7
    (y, z), areas, (young, along_y, along_z) = (
        rng.uniform(-1.0, 2.0, (2, n)), rng.uniform(1.0, 2.0, n), rng.uniform(1.0, 9.0, (3, n)),
    )  # fmt: skip
    moduli = np.column_stack([young, along_y, along_z])
    section = FibreSection(np.column_stack([y, z]), areas, moduli, ())
    for strain in rng.standard_normal((6, 6)):
        pulled, sheared_y, sheared_z, twist, about_y, about_z = strain
        stretch = pulled + z * about_y - y * about_z
        slides = (sheared_y - z * twist, sheared_z + y * twist)
        energy = areas @ (young * stretch**2 + along_y * slides[0] ** 2 + along_z * slides[1] ** 2)
        assert strain @ section.rigidity @ strain == pytest.approx(energy, rel=1e-12)


@together("sense", [1, -1])
def test_areas_of_fibres_are_those_of_their_cells_whichever_way_round(sense):
    table = NodeTable()
    ids = table.add(np.array([[1.0, 0.0], [4.0, 0.0], [4.0, 2.0], [1.0, 2.0]]))
    block = CellBlock.make(table, "QUA4", ids[::sense][None])
    zone = Zone(block, "MECANIQUE", ELASTIC, "QUAS", Mode.THREE_DIMENSIONAL)
    places, areas = fibre_places(zone, "STRESSES")
    np.testing.assert_allclose(areas.sum(axis=1), 6.0)
    np.testing.assert_allclose(np.einsum("cp,cpi->ci", areas, places), [[15.0, 6.0]])
