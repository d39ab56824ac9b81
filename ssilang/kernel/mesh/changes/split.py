"""Cells cut into simpler ones: quadrangles into triangles, bricks into tetrahedra."""

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.mesh.cells import CELL_TYPES, LINEAR_CELLS
from ssilang.kernel.mesh.combine import join_blocks
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

# the two ways of cutting a quadrangle: along corners 1-3 and along corners 2-4
_LINEAR = (((0, 1, 2), (0, 2, 3)), ((0, 1, 3), (1, 2, 3)))
# the same for QUA8, node 8 being the new middle of the diagonal
_QUADRATIC = (
    ((0, 1, 2, 3, 4, 8), (4, 5, 6, 7, 0, 8)),
    ((0, 1, 2, 8, 6, 7), (2, 3, 4, 5, 6, 8)),
)


def split_quadrangles(mesh: Mesh) -> Mesh:
    """Each quadrangle cut into two triangles, the diagonal alternating from cell to cell.

    QUA8 get a new node in the middle. Other cells are kept.
    """
    merged: dict[str, list[CellBlock]] = {}
    for block in mesh.blocks:
        made = _split_block(block) if block.cell_type in ("QUA4", "QUA8") else block
        merged.setdefault(made.cell_type, []).append(made)
    return Mesh(mesh.nodes, tuple(join_blocks(parts) for parts in merged.values()), mesh.sides)


def _split_block(block: CellBlock) -> CellBlock:
    table = block.connectivity
    if block.cell_type == "QUA8":
        table = np.column_stack([table, block.nodes.add_between(table[:, [1, 5]])])
    ways = _QUADRATIC if block.cell_type == "QUA8" else _LINEAR
    other = np.arange(len(table)) % 2 == 1
    width = len(ways[0][0])
    cells = np.empty((len(table), 2, width), dtype=np.int64)
    for way, rows in zip(ways, (~other, other), strict=True):
        for k in range(2):
            cells[rows, k] = table[np.ix_(rows, way[k])]
    return CellBlock.make(
        block.nodes,
        "TRI6" if width == 6 else "TRI3",
        cells.reshape(-1, width),
        np.repeat(block.colours, 2),
    )


def tetrahedra(block: CellBlock) -> CellBlock:
    """Tetrahedra on the corners of 3D cells, adjacent cells agreeing on face diagonals.

    Each cell is the union of the cones from its smallest node over the faces that do not hold it,
    quadrangular faces being cut along the diagonal from their own smallest node: a face is then
    cut in the same way from both of its sides.
    """
    kind = CELL_TYPES[LINEAR_CELLS[block.cell_type]]
    corners = block.connectivity[:, list(block.kind.corners)]
    apex = corners.argmin(axis=1)
    parts, colours = [], []
    for local in range(kind.n_nodes):
        rows = corners[apex == local]
        for _, face in kind.faces:
            if local in face or not len(rows):
                continue
            triangles = _face_triangles(rows[:, list(face)])
            each = len(triangles) // len(rows)
            tip = np.repeat(rows[:, local], each)
            parts.append(np.column_stack([triangles[:, [0, 2, 1]], tip]))
            colours.append(np.repeat(block.colours[apex == local], each))
    return CellBlock.make(block.nodes, "TET4", np.concatenate(parts), np.concatenate(colours))


def _face_triangles(face: IntArray) -> IntArray:
    """Triangles of faces (n, 3 or 4), the two of one quadrangle next to each other."""
    if face.shape[1] == 3:
        return face
    turned = (face.argmin(axis=1)[:, None] + np.arange(4)) % 4
    quad = np.take_along_axis(face, turned, axis=1)
    return quad[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
