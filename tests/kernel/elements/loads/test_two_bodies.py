"""Loads on two bodies of unlike cells: their work on any displacement against plain integrals."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.elements.catalog import ELEMENTS, support_rule
from ssilang.kernel.elements.loads import loads
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
from ssilang.kernel.elements.zone_fields import carry, cell_rows, transfer_matrix, zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from tests.kernel.elements.samples import ELASTIC

X, W = np.polynomial.legendre.leggauss(5)
X, W = (X + 1) / 2, W / 2
FLAT = [[0, 0], [2, 0.3], [2.4, 2], [-0.2, 1.5], [4.1, -0.1], [3.9, 1.2]]
PLANES = (Mode.PLANE_STRAIN, Mode.PLANE_STRESS, Mode.AXISYMMETRIC)


class Bodies:
    """A quadrangle and two triangles, or a brick and two prisms over them."""

    def __init__(self, mode):
        self.mode, self.space = mode, mode is Mode.THREE_DIMENSIONAL
        x = FLAT + np.array([3.0, 0.0])
        nodes = NodeTable()
        if self.space:
            top = np.column_stack([x * [1.1, 0.9] + 0.2, 1.5 + 0.1 * x[:, 0]])
            x = np.concatenate([np.column_stack([x, 0 * x[:, 0]]), top])
        self.ids = nodes.add(x)
        self.nodes, self.x = nodes, nodes.coordinates
        quad, tri = np.array([[0, 1, 2, 3]]), np.array([[1, 4, 2], [4, 5, 2]])
        if self.space:
            quad, tri = (np.hstack([t, t + 6]) for t in (quad, tri))
        kinds = ("CUB8", "PRI6") if self.space else ("QUA4", "TRI3")
        self.zones = tuple(
            Zone(CellBlock.make(nodes, k, self.ids[t]), "MECANIQUE", ELASTIC, k, mode)
            for k, t in zip(kinds, (quad, tri), strict=True)
        )
        self.model = Model(self.zones)
        rng = np.random.default_rng(1)
        self.names = ("UR", "UZ") if mode is Mode.AXISYMMETRIC else ("UX", "UY", "UZ")
        self.names = self.names[: 3 if self.space else 2]
        self.v = rng.standard_normal((len(self.ids), len(self.names)))
        self.p = rng.uniform(1.0, 2.0, len(self.ids))

    def sides(self):
        """Some outer sides of both bodies, one walked inwards: their nodes, an inner point each."""
        if not self.space:
            table = [[0, 1], [3, 0], [1, 4], [4, 5]]
            inner = [[0, 1, 2, 3], [0, 1, 2, 3], [1, 4, 2], [4, 5, 2]]
        else:
            table = [[0, 1, 7, 6], [0, 3, 9, 6], [1, 4, 10, 7], [1, 4, 2], [0, 1, 2, 3]]
            inner = [[*range(4), *range(6, 10)]] * 2 + [[1, 4, 2, 7, 10, 8]] * 2
            inner.append(inner[0])
        return table, [self.x[i].mean(axis=0) for i in inner]

    def mesh(self, table):
        kinds: dict = {}
        for side in table:
            kind = {2: "SEG2", 3: "TRI3", 4: "QUA4"}[len(side)]
            kinds.setdefault(kind, []).append(self.ids[side])
        return Mesh(self.nodes, tuple(CellBlock.make(self.nodes, k, np.array(t))
                                      for k, t in kinds.items()))  # fmt: skip

    def points(self, side, inner):
        """Points of a side: shapes (k,), vector area outwards times weight."""
        x = self.x[side]
        for i, a in enumerate(X):
            for j, b in enumerate(X if self.space else X[:1]):
                w = W[i] * (W[j] if self.space else 1.0)
                if len(side) == 2:
                    N, normal = np.array([1 - a, a]), np.cross(x[1] - x[0], [0, 0, 1.0])
                elif len(side) == 3:  # a square folded onto the triangle
                    N = np.array([1 - a, a * (1 - b), a * b])
                    normal = a * np.cross(x[1] - x[0], x[2] - x[0])
                else:
                    N = np.array([(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b])
                    one = (1 - b) * (x[1] - x[0]) + b * (x[2] - x[3])
                    two = (1 - a) * (x[3] - x[0]) + a * (x[2] - x[1])
                    normal = np.cross(one, two)
                if self.mode is Mode.AXISYMMETRIC:
                    w *= 2 * np.pi * (N @ x)[0]
                out = np.sign((x.mean(axis=0) - inner) @ normal)
                yield N, w * out * normal

    def work(self, forces):
        """Of nodal forces on the displacements."""
        names = ["F" + n[1] for n in self.names]
        return sum(forces.values_at(n, self.ids) @ self.v[:, i] for i, n in enumerate(names))


MODES = (*PLANES, Mode.THREE_DIMENSIONAL)


@together("mode", MODES)
@together("given", ["number", "nodes", "cells", "cell"])
def test_pressures_work_on_the_sides_of_all_bodies(mode, given):
    b = Bodies(mode)
    table, inner = b.sides()
    faces, p = b.mesh(table), b.p
    value = 1.7
    if given == "nodes":
        value = NodeField.of(b.nodes, b.ids, {"SCAL": b.p}, "DIFFUS")
    elif given != "number":  # cells in another order, their nodes turned
        blocks = []
        for block in faces.blocks:
            raw = np.roll(block.raw[::-1], 1, axis=1)
            values = b.p[raw] if given == "cells" else b.p[raw].mean(axis=1)[:, None]
            cells = CellBlock.make(b.nodes, block.cell_type, raw)
            blocks.append(CellFieldBlock(cells, {"PRES": values}))
        value = CellField(tuple(blocks))
    expected = 0.0
    for side, centre in zip(table, inner, strict=True):
        at = {"number": np.full(len(side), 1.7), "cell": np.full(len(side), p[side].mean())}
        for N, n in b.points(side, centre):
            expected -= (N @ at.get(given, p[side])) * (n[: len(b.names)] @ (N @ b.v[side]))
    got = loads.pressure(b.model, faces, value)
    assert b.work(got) == pytest.approx(expected, rel=1e-10)
    assert got.nature == "DISCRET"


@together("mode", MODES)
@together("given", ["vector", "forces", "displacements"])
def test_tractions_work_on_the_sides_of_all_bodies(mode, given):
    b = Bodies(mode)
    d = len(b.names)
    q = np.random.default_rng(2).uniform(1, 2, (len(b.ids), d))
    if given == "vector":
        q[:] = [0.3, -0.8, 1.1][:d]
    named = [("F" if given == "forces" else "U") + n[1] for n in b.names]
    value = NodeField.of(b.nodes, b.ids, dict(zip(named, q.T, strict=True)), "DIFFUS")
    table, inner = b.sides()
    thick = np.array([0.4, 0.4, 0.7, 0.9]) if mode is Mode.PLANE_STRESS else np.ones(5)
    expected = sum(
        thick[k] * np.linalg.norm(n) * ((N @ q[side]) @ (N @ b.v[side]))
        for k, (side, centre) in enumerate(zip(table, inner, strict=True))
        for N, n in b.points(side, centre)
    )
    blocks = [
        CellFieldBlock(z.cells, {"DIM3": t[:, None]}, "GRAVITE")
        for z, t in zip(b.zones, (thick[:1], thick[2:4]), strict=True)
    ]
    material = CellField(tuple(blocks), "CARACTERISTIQUES")
    traction = np.array([0.3, -0.8, 1.1]) if given == "vector" else value
    found = loads.traction(b.model, b.mesh(table), traction, material)
    # the area of a crooked side in space is no polynomial
    assert b.work(found) == pytest.approx(expected, rel=1e-5 if b.space else 1e-10)


@together("mode", PLANES)
@together("cells", [False, True])
def test_volume_forces_work_on_all_bodies(mode, cells):
    b = Bodies(mode)
    q = np.random.default_rng(2).uniform(1, 2, (len(b.ids), 2))
    names = ["F" + n[1] for n in b.names]
    thick = np.array([0.4, 0.7, 0.9]) if mode is Mode.PLANE_STRESS else np.ones(3)
    material = CellField(
        tuple(CellFieldBlock(z.cells, {"DIM3": t[:, None]}, "GRAVITE")
              for z, t in zip(b.zones, (thick[:1], thick[1:]), strict=True)), "CARACTERISTIQUES",
    )  # fmt: skip
    expected = 0.0
    for cell, t in zip(([0, 1, 2, 3], [1, 4, 2], [4, 5, 2]), thick, strict=True):
        space = Bodies(Mode.PLANE_STRAIN)
        space.space = True  # the rule of a face, in the plane
        space.mode = mode
        for N, n in space.points(cell, np.array([0.0, 0.0, -1.0])):
            expected += t * np.linalg.norm(n) * ((N @ q[cell]) @ (N @ b.v[cell]))
    if cells:
        density = CellField(tuple(
            CellFieldBlock(z.cells, {n: q[z.cells.connectivity, i] for i, n in enumerate(names)},
                           "NOEUD") for z in b.zones
        ))  # fmt: skip
    else:
        density = NodeField.of(b.nodes, b.ids, dict(zip(names, q.T, strict=True)), "DIFFUS")
    found = loads.body_force(b.model, density, material)
    # rules of the cells are not exact for the square of a bilinear field on a crooked ring
    assert b.work(found) == pytest.approx(expected, rel=2e-3)
    one = loads.body_force(Model(b.zones[1:]), density, material)
    assert b.work(one) != pytest.approx(expected, rel=0.1)


def test_volume_forces_that_name_nothing_or_stand_on_no_body_are_refused():
    b = Bodies(Mode.PLANE_STRAIN)
    wrong = NodeField.of(b.nodes, b.ids, {"FZ": b.p}, "DIFFUS")
    with pytest.raises(FieldError, match="FX"):
        loads.body_force(b.model, wrong)
    line = Zone(CellBlock.make(b.nodes, "SEG2", np.array([[0, 1]])), "MECANIQUE", ELASTIC, "BARR",
                Mode.PLANE_STRAIN)  # fmt: skip
    force = NodeField.of(b.nodes, b.ids, {"FX": b.p}, "DIFFUS")
    with pytest.raises(MeshError, match="BARR"):
        loads.body_force(Model((line,)), force)
    with pytest.raises(MeshError, match="QUA4"):
        loads.line_load(b.model, np.array([1.0, 0, 0]))
    with pytest.raises(MeshError, match="shell"):
        loads.shell_load(b.model, 1.0)
    with pytest.raises(MeshError, match="pipe"):
        loads.pipe_pressure(b.model, CellField((), ""))


def test_volume_forces_of_two_plates_are_those_of_their_matter():
    """Linear densities on triangles: the mean of their corners times area and thickness."""
    b = Bodies(Mode.PLANE_STRAIN)
    cells = b.zones[1].cells
    zone = Zone(cells, "MECANIQUE", ELASTIC, "DKT", Mode.THREE_DIMENSIONAL)
    thick = np.array([[0.3], [0.5]])
    material = CellField((CellFieldBlock(cells, {"EPAI": thick}, "GRAVITE", "DKT"),))
    names = ("FX", "FY", "FZ")
    q = np.random.default_rng(4).uniform(1, 2, (len(b.ids), 3))
    density = NodeField.of(b.nodes, b.ids, dict(zip(names, q.T, strict=True)), "DIFFUS")
    found = loads.body_force(Model((zone,)), density, material)
    corners = b.x[cells.connectivity]
    sides = corners[:, 1:] - corners[:, :1]
    area = 0.5 * np.abs(np.cross(sides[:, 0], sides[:, 1]))[:, 2]
    wanted = (area * thick[:, 0]) @ q[cells.connectivity].mean(axis=1)
    got = [found.components[n].values.sum() for n in names]
    np.testing.assert_allclose(got, wanted)


@together("mode", [Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL])
def test_sides_loaded_by_a_field_are_the_outer_ones_that_it_covers(mode):
    b = Bodies(mode)
    on = [0, 1, 4] if mode is Mode.PLANE_STRAIN else [0, 1, 6, 7, 4, 10]
    field = NodeField.of(b.nodes, b.ids[on], {"SCAL": b.p[on]}, "DIFFUS")
    found = loads.loaded_faces(b.model, field)
    sides = {tuple(sorted(c)) for k in found.blocks for c in k.connectivity.tolist()}
    assert sides == ({(0, 1), (1, 4)} if len(on) == 3 else {(0, 1, 6, 7), (1, 4, 7, 10)})
    inside = NodeField.of(b.nodes, b.ids[[1, 2]], {"SCAL": b.p[:2]}, "DIFFUS")
    with pytest.raises(MeshError, match="outer"):
        loads.loaded_faces(b.model, inside)
    line = CellBlock.make(b.nodes, "SEG2", b.ids[[[1, 2]]])  # of a field in cells: its own, once
    held = [CellFieldBlock(line, {n: np.ones((1, 1))}, "NOEUD", "") for n in ("A", "B")]
    assert loads.loaded_faces(b.model, CellField(tuple(held), "")).blocks == (line,)
    cells = b.zones[0].cells  # of a field in the model's cells: where it is not nought
    sucked = np.where(np.isin(cells.connectivity, b.ids[on]), -b.p[cells.connectivity], 0.0)
    nodal = loads.on_sides(b.model, CellField((CellFieldBlock(cells, {"P": sucked}, "NOEUD"),)))
    at = b.ids[np.intersect1d(on, cells.connectivity)]
    assert sorted(nodal.node_ids.tolist()) == at.tolist()
    np.testing.assert_allclose(nodal.values_at("P", at), -b.p[at])


# --- what a field in cells says on a zone --------------------------------------------------


def test_values_of_several_blocks_are_put_together_cell_by_cell():
    b = Bodies(Mode.PLANE_STRAIN)
    zone = b.zones[1]
    cells = zone.cells.connectivity
    parts = [CellBlock.make(b.nodes, "TRI3", np.roll(cells[[k]], 1, axis=1)) for k in (1, 0)]
    one = CellFieldBlock(parts[0], {"A": np.array([[5.0]]), "B": np.array([[1.0]])}, "GRAVITE")
    two = CellFieldBlock(parts[1], {"A": np.array([[7.0]])}, "GRAVITE")
    seen = zone_field(zone, CellField((one, two), ""))
    assert seen.raw("A")[0].tolist() == [[7.0], [5.0]]
    assert seen.names == ("A", "B")
    assert "A" in seen
    assert "B" in seen
    assert "C" not in seen
    with pytest.raises(FieldError, match="B"):
        seen.raw("B")
    np.testing.assert_allclose(seen.matrix(("C", "A"), "GRAVITE")[:, :, 0], [[0, 7], [0, 5]])
    assert cell_rows(parts[0], zone.cells).tolist() == [-1, 0]
    assert cell_rows(b.zones[0].cells, zone.cells).tolist() == [-1, -1]


def test_curves_that_vary_inside_a_cell_and_wrong_numbers_of_points_are_refused():
    curve = np.array([[object(), object(), object()]])
    with pytest.raises(FieldError, match="curve"):
        carry(curve, "TRI3", "NOEUD", "RIGIDITE")
    assert carry(curve[:, :1], "TRI3", "NOEUD", "RIGIDITE") is not None
    with pytest.raises(FieldError, match="QUA4"):
        carry(np.ones((1, 3)), "QUA4", "NOEUD", "RIGIDITE")


@pytest.mark.parametrize("source", ["STRESSES", "RIGIDITE", "MASSE"])
def test_what_is_alike_at_all_points_is_so_at_the_nodes(source):
    """Of thick shells too, whose points stand above one another."""
    for element in ELEMENTS:
        sums = transfer_matrix(element, source, "NOEUD").sum(axis=1)
        np.testing.assert_allclose(sums, 1.0, atol=1e-11, err_msg=element)


@pytest.mark.parametrize("element", ["COQ8", "COQ6"])
def test_nodes_of_thick_shells_have_the_mean_of_both_sides(element):
    """A membrane force that goes linearly over the cell; moments leave nothing."""
    at = REFERENCE_CELLS[ELEMENTS[element].cell_type].nodes[:, :2]
    points = support_rule(element, "STRESSES").points[:, :2]
    slopes, half = np.array([2.0, -3.0]), len(points) // 2
    side = np.where(np.arange(len(points)) < half, -5.0, 5.0)
    found = transfer_matrix(element, "STRESSES", "NOEUD") @ (7.0 + points @ slopes + side)
    np.testing.assert_allclose(found, 7.0 + at @ slopes, atol=1e-11)


def test_a_square_over_a_line_becomes_the_nearest_line():
    """The straight line nearest to x^2 over -1 to 1 is 1/3; of x^3 it is 3 x / 5."""
    x = support_rule("COQ2", "STRESSES").points[:, 0]
    matrix = transfer_matrix("COQ2", "STRESSES", "NOEUD")
    np.testing.assert_allclose(matrix @ x**2, [1 / 3, 1 / 3], atol=1e-12)
    np.testing.assert_allclose(matrix @ x**3, [-0.6, 0.6], atol=1e-12)
