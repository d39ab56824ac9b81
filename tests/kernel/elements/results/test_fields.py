"""Fields in cells: supports, tensors, gradients, thermal strains, integrals, reduction."""

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.loads.thermal import thermal_strain
from ssilang.kernel.elements.results.integrals import green_strain, integrals
from ssilang.kernel.elements.results.supports import (
    cells_of_nodal,
    field_on_mesh,
    field_on_model,
    model_on_mesh,
    moved,
    nodal_of_cells,
)
from ssilang.kernel.elements.solids.gradients import (
    gradient_names,
    gradient_values,
)
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from tests.kernel.elements.samples import ELASTIC, PLANE, SPACE, cell_zone, field, material

_ONE_POINT = ("Q4RI", "TRI3", "TET4")


def _mode(element):
    return Mode.PLANE_STRAIN if element in PLANE else Mode.THREE_DIMENSIONAL


def _strip(n=3):
    """A strip of n unit squares."""
    table = NodeTable()
    x = np.arange(n + 1.0)
    low = table.add(np.column_stack([x, 0 * x]))
    high = table.add(np.column_stack([x, 0 * x + 1]))
    cells = np.column_stack([low[:-1], low[1:], high[1:], high[:-1]])
    return Zone(
        CellBlock.make(table, "QUA4", cells), "MECANIQUE", ELASTIC, "QUA4", Mode.PLANE_STRESS
    )


# one stress point cannot carry a linear field
@together("element", [e for e in (*PLANE, *SPACE) if e not in _ONE_POINT])
@together("target", ["NOEUD", "GRAVITE", "RIGIDITE", "MASSE", "STRESSES"])
def test_a_linear_field_survives_every_change_of_support(element, target):
    zone = cell_zone(element, _mode(element))
    nodal = field(zone, SCAL=lambda x: 2.0 + x[:, 0] - 3 * x[:, 1] + 0.5 * x[:, 2])
    at_points = cells_of_nodal(Model((zone,)), nodal, "STRESSES")
    direct = cells_of_nodal(Model((zone,)), nodal, target)
    there = moved(Model((zone,)), at_points, target)
    np.testing.assert_allclose(
        there.blocks[0].components["SCAL"], direct.blocks[0].components["SCAL"], atol=1e-10
    )
    back = nodal_of_cells(Model((zone,)), at_points)
    np.testing.assert_allclose(
        back.components["SCAL"].values, nodal.components["SCAL"].values, atol=1e-10
    )


def test_nodes_take_the_mean_or_the_sum_of_their_cells():
    zone = _strip(2)
    one = CellField((cell_block(zone, ("SCAL",), np.array([[[1.0]], [[3.0]]]), "GRAVITE"),))
    mean = nodal_of_cells(Model((zone,)), one).components["SCAL"]
    total = nodal_of_cells(Model((zone,)), one, "SOMM").components["SCAL"]
    shared = 1  # the node between both cells
    assert mean.at(np.array([0, shared, 2])).tolist() == [1.0, 2.0, 3.0]
    assert total.at(np.array([0, shared, 2])).tolist() == [1.0, 4.0, 3.0]


@together("element", ["QUA8", "CU20", "TE10"])
def test_gradient_of_a_linear_field_and_its_second_order_strain(element):
    mode = _mode(element)
    zone = cell_zone(element, mode)
    d = mode.dimension
    H = np.array([[0.1, 0.2, -0.3], [0.05, -0.1, 0.4], [0.25, 0.07, 0.03]])[:d, :d]
    names = ("UX", "UY", "UZ")[:d]
    u = field(zone, **{n: (lambda x, r=r: x[:, :d] @ r) for n, r in zip(names, H, strict=True)})
    G = gradient_values(zone, u)
    for i, label in enumerate(gradient_names(zone)):
        row, axis = names.index(label[:2]), "XYZ".index(label[3])
        np.testing.assert_allclose(G[:, i], H[row, axis], atol=1e-12)
    green = (H + H.T + H.T @ H) / 2
    block = green_strain(zone, u)
    assert block.components["EPXX"][0, 0] == pytest.approx(green[0, 0])
    assert block.components["GAXY"][0, 0] == pytest.approx(2 * green[0, 1])


def test_free_thermal_expansion_causes_no_stress():
    zone = cell_zone("QUA8", Mode.PLANE_STRESS)
    mat = material(zone, YOUN=2e11, NU=0.3, ALPH=1e-5, TALP=20.0)
    eps = thermal_strain(zone, mat, field(zone, T=lambda x: 120.0))
    np.testing.assert_allclose(eps[0, :, 0], [1e-3, 1e-3, 1e-3, 0.0], atol=1e-15)
    u = field(zone, UX=lambda x: 1e-3 * x[:, 0], UY=lambda x: 1e-3 * x[:, 1])
    strains = CellField((families.strain(zone, u),))
    total = families.elastic_stress(zone, mat, strains).components["SMXX"]
    thermal = CellField((_strain_block(zone, eps),))
    np.testing.assert_allclose(
        total, families.elastic_stress(zone, mat, thermal).components["SMXX"], rtol=1e-9
    )


def _strain_block(zone, values):
    return cell_block(zone, families.family_of(zone).strain_names(zone), values)


def test_strains_of_stresses_undo_stresses_of_strains():
    zone = cell_zone("QUA8", Mode.PLANE_STRESS)
    mat = material(zone, YOUN=2e11, NU=0.3)
    u = field(zone, UX=lambda x: 1e-3 * x[:, 0] ** 2, UY=lambda x: 2e-4 * x[:, 0] * x[:, 1])
    strain = families.strain(zone, u)
    stress = families.stress(zone, mat, u)
    back = families.elastic_strain(zone, mat, CellField((stress,)))
    for name in ("EPXX", "EPYY", "GAXY"):
        np.testing.assert_allclose(back.components[name], strain.components[name], atol=1e-12)
    out = -0.3 / 2e11 * (stress.components["SMXX"] + stress.components["SMYY"])
    np.testing.assert_allclose(back.components["EPZZ"], out, atol=1e-12)


def test_integral_of_a_coordinate_is_the_first_moment():
    zone = _strip(3)
    nodal = field(zone, SCAL=lambda x: x[:, 0])
    cells = cells_of_nodal(Model((zone,)), nodal)
    np.testing.assert_allclose(integrals(zone, cells, "SCAL"), [0.5, 1.5, 2.5])
    thick = material(zone, DIM3=0.5)
    np.testing.assert_allclose(integrals(zone, cells, "SCAL", thick), [0.25, 0.75, 1.25])
    assert integrals(zone, cells, "NONE") is None
    zone, random = cell_zone("QUA8", Mode.PLANE_STRAIN), np.random.default_rng(2)
    for support in ("RIGIDITE", "STRESSES", "MASSE"):  # of no polynomial: by their own points
        weights = families.family_of(zone).weights(zone, zone_field(zone, None), support)
        at = {"SCAL": random.uniform(1.0, 2.0, weights.shape)}
        given = CellField((CellFieldBlock(zone.cells, at, support, zone.element),))
        np.testing.assert_allclose(integrals(zone, given, "SCAL"), (weights * at["SCAL"]).sum())


def test_a_field_follows_the_reduction_of_its_model():
    zone = _strip(3)
    table = zone.cells.nodes
    part = Mesh.of(table, "QUA4", zone.cells.connectivity[[2, 0]])
    model = model_on_mesh(Model((zone,)), part)
    values = CellField((material(zone, YOUN=1.0).blocks[0],))
    values.blocks[0].components["YOUN"][:] = [[1.0], [2.0], [3.0]]
    small = field_on_model(values, model)
    assert small.blocks[0].components["YOUN"].ravel().tolist() == [3.0, 1.0]
    assert zone_field(model.zones[0], values).at("YOUN", "RIGIDITE").ravel().tolist() == [3.0, 1.0]
    on_mesh = field_on_mesh(values, part)
    assert on_mesh.blocks[0].components["YOUN"].ravel().tolist() == [3.0, 1.0]
    with refusal(FieldError, "kernel.elements.no-cell-mesh-belongs"):
        model_on_mesh(model, Mesh.of(table, "QUA4", zone.cells.connectivity[[1]]))


def test_stress_points_of_beams_are_their_nodes():
    assert support_rule("POUT", "STRESSES").points.ravel().tolist() == [-1.0, 1.0]
