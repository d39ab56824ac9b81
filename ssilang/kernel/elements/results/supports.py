"""Fields in cells carried to other supports and nodes, or restricted to a mesh or a model."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.catalog import support_rule, support_shapes
from ssilang.kernel.elements.zone_fields import carry, cell_rows, zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable

NONE_IF_ELASTIC = ("VARIABLES INTERNES", "DEFORMATIONS INELASTIQUES")
"""Titles of fields that elastic bodies have none of."""


def moved(model: Model, field: CellField, target: Support, title: str | None = None) -> CellField:
    """The field at the points of another support, on the zones of a model where it stands."""
    blocks = [b for z in model.zones for b in _moved_zone(z, field, target)]
    if not blocks and field.title not in NONE_IF_ELASTIC:
        raise FieldError("kernel.elements.field-no-value-cells")
    return CellField(tuple(blocks), field.title if title is None else title)


def _moved_zone(zone: Zone, field: CellField, target: Support) -> list[CellFieldBlock]:
    seen = zone_field(zone, field)
    components = {}
    p = len(support_rule(zone.element, target))
    for name in seen.names:
        values, source = seen.raw(name)
        found = carry(values, zone.element, source, target)
        width = 1 if found.dtype == object else p
        components[name] = np.broadcast_to(found, (len(zone.cells), max(width, found.shape[1])))
    if not components:
        return []
    return [zone.block(components, target)]


def nodal_of_cells(
    model: Model, field: CellField, rule: Literal["MOYE", "SOMM"] = "MOYE"
) -> NodeField:
    """A nodal field: mean (or sum) of the values that the cells around a node have there."""
    return nodal_of_field(moved(model, field, "NOEUD"), rule)


def nodal_of_field(field: CellField, rule: Literal["MOYE", "SOMM"] = "MOYE") -> NodeField:
    """The same for a field that stands at nodes."""
    parts: dict[str, list[tuple[IntArray, FloatArray]]] = {}
    table: NodeTable | None = None
    for block in field.blocks:
        table = block.cells.nodes
        nodes = block.cells.connectivity
        for name, values in block.components.items():
            if values.dtype == object:
                continue
            if values.shape[1] > 1 and nodes.shape[1] == 2 * values.shape[1]:  # joints
                values = np.tile(values, 2)
            at = np.broadcast_to(values, nodes.shape)
            parts.setdefault(name, []).append((nodes.ravel(), at.ravel()))
    if table is None:
        raise FieldError("kernel.elements.field-empty")
    made = {n: _gathered(p, rule) for n, p in parts.items()}
    return NodeField(table, made, "DIFFUS")


def _gathered(
    parts: list[tuple[IntArray, FloatArray]], rule: Literal["MOYE", "SOMM"]
) -> NodeValues:
    nodes, values = (np.concatenate(both) for both in zip(*parts, strict=True))
    sums = NodeValues.summed(nodes, values)
    times = np.unique(nodes, return_counts=True)[1] if rule == "MOYE" else 1.0
    return NodeValues(sums.nodes, sums.values / times)


def cells_of_nodal(
    model: Model, field: NodeField, target: Support = "NOEUD", title: str = ""
) -> CellField:
    """A field in cells interpolated from a nodal field; components absent on a zone are left out.

    Absent values count as zero in cells where the component is defined at some node. Joints take
    the mean of both sides; where a field stands on one side alone, the value of that side.
    """
    blocks = []
    for zone in model.zones:
        shapes = support_shapes(zone.element, target)
        half = shapes.shape[1]
        components = {}
        for name, values in _at_cell_nodes(zone.cells, field).items():
            if values.shape[1] == 2 * half:
                # a node without values takes those of the one that it faces
                there = np.isin(zone.cells.connectivity, field.components[name].nodes)
                values = np.where(there, values, np.roll(values, half, axis=1))
                if target == "NOEUD":
                    components[name] = values
                    continue
                values = (values[:, :half] + values[:, half:]) / 2
            components[name] = values @ shapes.T
        if components:
            blocks.append(zone.block(components, target))
    return CellField(tuple(blocks), title)


def cells_of_mesh(mesh: Mesh, field: NodeField, title: str = "") -> CellField:
    """A field at the nodes of the cells of a mesh."""
    blocks = []
    for cells in mesh.blocks:
        components = _at_cell_nodes(cells, field)
        if components:
            blocks.append(CellFieldBlock(cells, components, "NOEUD"))
    return CellField(tuple(blocks), title)


def _at_cell_nodes(cells: CellBlock, field: NodeField) -> dict[str, FloatArray]:
    """Values (n_cells, n_nodes) of the components defined at some node of the cells."""
    nodes = cells.connectivity
    out = {}
    for name, part in field.components.items():
        if np.isin(nodes, part.nodes).any():
            out[name] = part.at(nodes)
    return out


def point_coordinates(field: CellField) -> list[tuple[CellFieldBlock, FloatArray]]:
    """Coordinates (n_cells, n_points, 3) of the points on which each block stands."""
    out = []
    for block in field.blocks:
        if block.support == "NOEUD" or not block.element:
            out.append((block, block.cells.coordinates))
            continue
        shapes = support_shapes(block.element, block.support)
        corners = block.cells.coordinates
        half = shapes.shape[1]
        if corners.shape[1] == 2 * half:
            corners = (corners[:, :half] + corners[:, half:]) / 2
        out.append((block, np.einsum("pk,ckd->cpd", shapes, corners)))
    return out


def values_at_points(field: CellField) -> NodeField:
    """A nodal field on new nodes, one at each point that carries the field."""
    parts: dict[str, list[tuple[IntArray, FloatArray]]] = {}
    for block, x in point_coordinates(field):
        n, p, _ = x.shape
        nodes = block.cells.nodes.add(x.reshape(-1, 3))
        for name, values in block.components.items():
            flat = np.broadcast_to(values, (n, p)).astype(float).ravel()
            parts.setdefault(name, []).append((nodes, flat))
    if not parts:
        raise FieldError("kernel.elements.field-empty")
    made = {n: NodeValues(*map(np.concatenate, zip(*p, strict=True))) for n, p in parts.items()}
    return NodeField(field.blocks[0].cells.nodes, made, "DIFFUS")


def model_on_mesh(model: Model, mesh: Mesh) -> Model:
    """Zones restricted to the cells of a mesh; none on an empty one.

    Raises
    ------
    FieldError
        If the mesh has cells, none of which belongs to the model.
    """
    zones: list[Zone] = []
    for zone in model.zones:
        for kept in _rows_in(mesh, zone.cells):
            same = len(kept) == len(zone.cells) and np.array_equal(kept, np.arange(len(kept)))
            cells = zone.cells if same else zone.cells.some(kept)
            zones.append(replace(zone, cells=cells))
    if not zones and mesh.n_cells:
        raise FieldError("kernel.elements.no-cell-mesh-belongs")
    return Model(tuple(zones))


def _rows_in(mesh: Mesh, cells: CellBlock) -> Iterator[IntArray]:
    """Rows of cells that a mesh has, for each of its blocks that has some."""
    for block in mesh.blocks:
        rows = cell_rows(cells, block)
        if (kept := rows[rows >= 0]).size:
            yield kept


def field_on_mesh(field: CellField, mesh: Mesh) -> CellField:
    """Blocks of a field in cells restricted to the cells of a mesh.

    None where all its cells are elastic, of a field that elastic bodies have none of.

    Raises
    ------
    FieldError
        If no cell of another field is the mesh's.
    """
    blocks = []
    for block in field.blocks:
        for kept in _rows_in(mesh, block.cells):
            full = {
                n: np.broadcast_to(v, (len(block.cells), v.shape[1]))[kept]
                for n, v in block.components.items()
            }
            blocks.append(replace(block, cells=block.cells.some(kept), components=full))
    if not blocks and field.title not in NONE_IF_ELASTIC:
        raise FieldError("kernel.elements.no-cell-mesh-belongs-to-support")
    return CellField(tuple(blocks), field.title)


def field_on_model(field: CellField, model: Model) -> CellField:
    """The field on the very cells of a model's zones."""
    blocks = []
    for zone in model.zones:
        seen = zone_field(zone, field)
        by_support: dict[Support, dict[str, np.ndarray]] = {}
        for name in seen.names:
            values, support = seen.raw(name)
            by_support.setdefault(support, {})[name] = values
        element = next((b.element for b, _ in seen.parts if b.element), zone.element)
        blocks += [
            CellFieldBlock(zone.cells, components, support, element, zone.constituent)
            for support, components in by_support.items()
        ]
    if not blocks and field.title not in NONE_IF_ELASTIC:
        raise FieldError("kernel.elements.field-no-value-cells")
    return CellField(tuple(blocks), field.title)
