"""Meshes cut by a plane: what lies behind it (COUP), what it crosses (SECT)."""

from __future__ import annotations

import numpy as np

from ssilang.io.plots.patches import Faces
from ssilang.io.plots.values import values_on
from ssilang.io.plots.view import Plane, View
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.changes.split import tetrahedra
from ssilang.kernel.mesh.combine import take
from ssilang.kernel.mesh.mesh import CellBlock, Mesh


def behind(mesh: Mesh, plane: Plane, view: View, positions: FloatArray) -> Mesh:
    """Cells whose middle lies behind the plane, seen from the eye.

    `positions` (all nodes of the table, 3) says where the nodes are drawn.
    """
    side = np.sign(plane.normal @ view.axes[2]) or 1.0
    return take(mesh, lambda b: side * plane.height(positions[b.connectivity].mean(axis=1)) <= 0)


def section_of(
    mesh: Mesh, plane: Plane, positions: FloatArray, values: FloatArray | None
) -> tuple[FloatArray, FloatArray | None, IntArray]:
    """Triangles in which a plane cuts the volumes of a mesh.

    Parameters
    ----------
    values : array (n_table,), optional
        Values at the nodes.

    Returns
    -------
    points : array (m, 3, 3)
    values : array (m, 3) or None
    colours : array (m,)
        Colour index of the cell that is cut.
    """
    parts = []
    for block in mesh.blocks:
        if block.kind.dimension != 3 or block.kind.joint:
            continue
        for colour in np.unique(block.colours):
            mine = block.colours == colour
            cells = CellBlock.make(mesh.nodes, block.cell_type, block.connectivity[mine])
            nodes = tetrahedra(cells)
            ends, weights = _cut(nodes, plane.height(positions[nodes]))
            parts.append((ends, weights, np.full(len(ends), int(colour))))
    if not parts:
        return np.empty((0, 3, 3)), None if values is None else np.empty((0, 3)), np.empty(0, int)
    ends, weights, colours = (np.concatenate(p) for p in zip(*parts, strict=True))
    points = _mixed(positions, ends, weights)
    found = None if values is None else _mixed(values, ends, weights)
    return points, found, colours


def _mixed(data: FloatArray, ends: IntArray, weights: FloatArray) -> FloatArray:
    """Data (n_table, ...) at points between the nodes `ends` (m, 3, 2)."""
    w = weights if data.ndim == 1 else weights[..., None]
    return np.asarray((1 - w) * data[ends[..., 0]] + w * data[ends[..., 1]])


# ends of the cut edges, nodes in order of height: one node below, three below, two and two
_ONE = ((0, 1), (0, 2), (0, 3))
_THREE = ((0, 3), (1, 3), (2, 3))
_TWO = (((0, 2), (0, 3), (1, 3)), ((0, 2), (1, 3), (1, 2)))


def _cut(nodes: IntArray, heights: FloatArray) -> tuple[IntArray, FloatArray]:
    """Edges (m, 3, 2) of the tetrahedra that the triangles' corners lie on, and where (m, 3)."""
    order = np.argsort(heights, axis=1)
    nodes = np.take_along_axis(nodes, order, axis=1)
    heights = np.take_along_axis(heights, order, axis=1)
    below = (heights < 0).sum(axis=1)
    ends, weights = [], []
    for count, triangles in ((1, (_ONE,)), (3, (_THREE,)), (2, _TWO)):
        rows = below == count
        for triangle in triangles:
            pairs = np.array(triangle)
            a, b = heights[rows][:, pairs[:, 0]], heights[rows][:, pairs[:, 1]]
            ends.append(nodes[rows][:, pairs])
            weights.append(-a / np.where(b > a, b - a, 1.0))
    return np.concatenate(ends), np.concatenate(weights)


def nodal_means(
    faces: list[Faces], field: NodeField | CellField, component: str, size: int
) -> FloatArray:
    """Values of a field at all nodes of a table (size,): means over the cells, NaN elsewhere."""
    if isinstance(field, NodeField):
        return field.values_at(component, np.arange(size), np.nan)
    total, count = np.zeros(size), np.zeros(size)
    for f in faces:
        values = values_on(f, field, component)
        known = np.isfinite(values)
        np.add.at(total, f.nodes[known], values[known])
        np.add.at(count, f.nodes[known], 1.0)
    return np.where(count > 0, total / np.maximum(count, 1.0), np.nan)
