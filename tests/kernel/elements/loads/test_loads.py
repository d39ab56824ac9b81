"""Loads on sides and volumes against their resultants; absorbing boundaries against impedances."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.boundary import absorbing_boundary
from ssilang.kernel.elements.loads.loads import body_force, pressure
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from tests.kernel.elements.samples import PLANE, SPACE, cell_zone, field, material

P = 7.0


def _skin(zone):
    kinds: dict[str, list] = {}
    nodes = zone.cells.connectivity
    for kind, local in zone.cells.kind.faces:
        kinds.setdefault(kind, []).append(nodes[:, list(local)])
    table = zone.cells.nodes
    blocks = [CellBlock.make(table, k, np.concatenate(v)) for k, v in kinds.items()]
    return Mesh(table, tuple(blocks))


def _mode(element):
    return Mode.PLANE_STRAIN if element in PLANE else Mode.THREE_DIMENSIONAL


@together("element", [*PLANE, *SPACE])
def test_pressure_all_around_is_in_balance_with_minus_the_identity(element):
    zone = cell_zone(element, _mode(element))
    got = pressure(Model((zone,)), _skin(zone), P)
    n, names = len(zone.cells), families.family_of(zone).stress_names(zone)
    components = {k: np.full((n, 1), -P if i < 3 else 0.0) for i, k in enumerate(names)}
    stress = CellField((CellFieldBlock(zone.cells, components, "GRAVITE", element),))
    expected = families.internal_forces(zone, stress)
    for name, part in expected.components.items():
        exact = 1e-12 if "RI" not in element and element not in ("C20R", "P15R") else 1e-9
        np.testing.assert_allclose(got.values_at(name, part.nodes), part.values, atol=exact * 50)


def test_pressure_on_a_ring_counts_the_circumference():
    zone = cell_zone("QUA8", Mode.AXISYMMETRIC)
    got = pressure(Model((zone,)), _skin(zone), P)
    assert got.components["FZ"].values.sum() == pytest.approx(0.0, abs=1e-10)
    section = cell_zone("QUA8", Mode.PLANE_STRAIN)  # the same shape: its weights are the area
    area = families.integration_weights(section, "RIGIDITE").sum()
    assert got.components["FR"].values.sum() == pytest.approx(-2 * np.pi * P * area, rel=1e-10)


@together("element", [*PLANE, *SPACE])
def test_weight_equals_mass_times_gravity(element):
    zone = cell_zone(element, _mode(element))
    name = "FY" if element in PLANE else "FZ"
    density = field(zone, **{name: lambda x: -9.81 * 2.5})
    got = body_force(Model((zone,)), density)
    mass = families.mass(zone, material(zone, RHO=2.5))
    column = [i for i, u in enumerate(mass.unknowns) if u == "U" + name[1]]
    nodal = mass.values[0][np.ix_(column, column)].sum(axis=1) * -9.81
    np.testing.assert_allclose(
        got.values_at(name, zone.cells.connectivity[0]), nodal, rtol=1e-9, atol=1e-9
    )


def test_a_surface_off_the_model_is_refused():
    zone = cell_zone("QUA4", Mode.PLANE_STRAIN)
    far = zone.cells.nodes.add([[9.0, 9.0], [8.0, 9.0]])
    with pytest.raises(MeshError, match="no side"):
        pressure(Model((zone,)), Mesh.of(zone.cells.nodes, "SEG2", far[None]), P)


def test_a_pressure_of_two_components_is_refused():
    zone = cell_zone("QUA4", Mode.PLANE_STRAIN)
    two = NodeField.of(zone.cells.nodes, np.arange(4), {"A": np.ones(4), "B": np.ones(4)}, "DIFFUS")
    with pytest.raises(FieldError, match="one component"):
        pressure(Model((zone,)), _skin(zone), two)


def test_absorbing_boundary_has_the_impedance_of_the_medium():
    zone = cell_zone("QUA8", Mode.PLANE_STRAIN)
    E, nu, rho = 1e8, 0.3, 1800.0
    nodes = zone.cells.connectivity[0]
    side = Mesh.of(zone.cells.nodes, "SEG3", nodes[None, :3])
    beside = cell_zone("TRI3", Mode.PLANE_STRAIN)  # a body without sides there, nor parameters
    C = absorbing_boundary(Model((beside, zone)), side, material(zone, YOUN=E, NU=nu, RHO=rho))
    (block,) = C.blocks
    ends = zone.cells.coordinates[0, [0, 2], :2]
    t = ends[1] - ends[0]
    length = np.linalg.norm(t)
    t = t / length
    n = np.array([t[1], -t[0]])
    vs = np.sqrt(E / (2 * (1 + nu)) / rho)
    vp = vs * np.sqrt(2 * (1 - nu) / (1 - 2 * nu))
    for direction, speed in ((t, vs), (n, vp)):
        v = np.tile(direction, 3)
        assert v @ block.values[0] @ v == pytest.approx(rho * speed * length, rel=1e-12)
