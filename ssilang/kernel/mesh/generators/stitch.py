"""Triangles between two lines, and cells joined to a point."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.changes.degree import linear, quadratic
from ssilang.kernel.mesh.combine import take, union
from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.mesh.mesh import Mesh

_CONES = {"POI1": "SEG2", "SEG2": "TRI3", "TRI3": "TET4", "QUA4": "PYR5"}


def stitch(first: Mesh, second: Mesh, colour: int = 0) -> Mesh:
    """Triangles between two lines described in the same sense, whatever their numbers of cells.

    SEG3 give TRI6. At each step the line goes on whose new triangle has the shorter new side.
    """
    nodes = first.nodes
    a, b = (line_chain(linear(m)) for m in (first, second))
    table = _zip(nodes.coordinates[a], nodes.coordinates[b])
    ids = np.concatenate([a, b])[table]
    ids = ids[(ids != np.roll(ids, 1, axis=1)).all(axis=1)]  # the lines may share their ends
    if not len(ids):
        raise MeshError("kernel.mesh.two-lines-same-nothing")
    made = Mesh.of(nodes, "TRI3", ids, colour)
    lines = union(first, second, as_given=True)
    return quadratic(made, lines) if first.single_block().cell_type == "SEG3" else made


def _zip(a: FloatArray, b: FloatArray) -> IntArray:
    """Triangles (t, 3) on points numbered along a, then along b."""
    i = j = 0
    n, m = len(a), len(b)
    rows = []
    while i < n - 1 or j < m - 1:
        along_a = np.linalg.norm(a[i + 1] - b[j]) if i < n - 1 else np.inf
        along_b = np.linalg.norm(a[i] - b[j + 1]) if j < m - 1 else np.inf
        if along_a <= along_b:
            rows.append((i, i + 1, n + j))
            i += 1
        else:
            rows.append((i, n + j + 1, n + j))
            j += 1
    return np.array(rows, dtype=np.int64)


def cone(mesh: Mesh, apex: int) -> Mesh:
    """Cells of `mesh` joined to a node: POI1 to SEG2, SEG2 to TRI3, TRI3 to TET4, QUA4 to PYR5.

    SEG3 give TRI6, whose new sides are straight. Cells that hold the node are left out.

    Raises
    ------
    MeshError
        For other types of cells, or when nothing is left.
    """
    away = take(mesh, lambda b: ~(b.connectivity == apex).any(axis=1))
    parts = []
    for block in away.blocks:
        if block.cell_type == "SEG3":
            line = Mesh(mesh.nodes, (block,))
            parts.append(quadratic(cone(linear(line), apex), line))
            continue
        name = _CONES.get(block.cell_type)
        if name is None:
            raise MeshError("kernel.mesh.cells-type-cannot-joined", cell_type=block.cell_type)
        tip = np.full((len(block), 1), apex)
        table = np.hstack([block.connectivity, tip])
        parts.append(Mesh.of(mesh.nodes, name, table, block.colours))
    if not parts:
        raise MeshError("kernel.mesh.no-cell-mesh-away")
    return union(*parts, as_given=True)
