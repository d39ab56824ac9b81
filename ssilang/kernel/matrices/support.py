"""The mesh that a matrix stands on, to draw it."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.combine import poi1, union
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def support_mesh(matrix: Matrix) -> Mesh:
    """Cells of the zones, points or segments of other blocks, points of the relations."""
    table = matrix.table
    parts = [_block_mesh(table, b) for b in matrix.blocks]
    held = [r.nodes for r in matrix.relations]
    if held:
        parts.append(poi1(table, np.unique(np.concatenate(held)), 2))
    filled = [p for p in parts if p.blocks]
    return union(*filled, as_given=True) if filled else Mesh(table, ())


def _block_mesh(table: NodeTable, block: ElementMatrices) -> Mesh:
    if block.zone is not None:
        return Mesh(table, (block.zone.cells,))
    nodes = block.nodes
    if nodes.shape[1] == 1:
        return poi1(table, nodes[:, 0])
    if nodes.shape[1] == 2:
        return Mesh.of(table, "SEG2", nodes)
    return poi1(table, np.unique(nodes))
