"""Cells of one degree made of cells of the other: middles added or dropped."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

QUADRATIC = {
    "SEG2": "SEG3",
    "TRI3": "TRI6",
    "QUA4": "QUA8",
    "TET4": "TE10",
    "PRI6": "PR15",
    "PYR5": "PY13",
    "CUB8": "CU20",
}
LINEAR = {v: k for k, v in QUADRATIC.items()}


def linear(mesh: Mesh) -> Mesh:
    """Each quadratic cell replaced by the linear one on its corners."""
    parts = [Mesh(mesh.nodes, (_linear_block(b),)) for b in mesh.blocks]
    return union(*parts, as_given=True) if parts else mesh


def quadratic(mesh: Mesh, lines: Mesh | None = None) -> Mesh:
    """Each linear cell replaced by the quadratic one; an edge gets one node in its middle.

    Parameters
    ----------
    lines : Mesh or None
        SEG3 (or TRI6, QUA8 by their sides) whose middles are used where their edges are met;
        other middles are new nodes.

    Raises
    ------
    MeshError
        For cells that have no quadratic counterpart (joints).
    """
    todo = [b for b in mesh.blocks if b.kind.degree == 1 and b.kind.dimension > 0]
    for block in todo:
        if block.cell_type not in QUADRATIC:
            raise MeshError("kernel.mesh.cells-type-no-quadratic", cell_type=block.cell_type)
    if not todo:
        return mesh
    pairs = np.concatenate([_edge_pairs(b).reshape(-1, 2) for b in todo])
    edges, which = np.unique(np.sort(pairs, axis=1), axis=0, return_inverse=True)
    middles = _middles(mesh, edges, lines)[which.ravel()]
    blocks, start = [], 0
    for block in mesh.blocks:
        if not any(block is b for b in todo):
            blocks.append(block)
            continue
        name = QUADRATIC[block.cell_type]
        count = CELL_TYPES[name].n_nodes - block.kind.n_nodes
        part = middles[start : start + count * len(block)].reshape(len(block), count)
        start += count * len(block)
        blocks.append(_with_middles(block, name, part))
    return union(*(Mesh(mesh.nodes, (b,)) for b in blocks), as_given=True)


def _middles(mesh: Mesh, edges: IntArray, lines: Mesh | None) -> IntArray:
    """Middle nodes (e,) of edges (e, 2): those of `lines`, or new ones."""
    nodes = mesh.nodes
    middle = np.full(len(edges), -1, dtype=np.int64)
    if lines is not None:
        known = _known_middles(lines)
        size = int(max(edges.max(), known[:, :2].max(initial=0))) + 1
        code, wanted = known[:, :2] @ [size, 1], edges @ [size, 1]
        order = np.argsort(code)
        place = np.minimum(np.searchsorted(code[order], wanted), len(code) - 1)
        met = code[order][place] == wanted
        middle[met] = known[order, 2][place[met]]
    fresh = edges[middle < 0]
    middle[middle < 0] = nodes.add(
        nodes.coordinates[fresh].mean(axis=1), nodes.density[fresh].mean(axis=1)
    )
    return middle


def _known_middles(lines: Mesh) -> IntArray:
    """Rows (ends in increasing order, middle) of the edges of quadratic cells."""
    parts = [np.empty((0, 3), dtype=np.int64)]
    for block in lines.blocks:
        if block.kind.degree == 2 and not block.kind.joint:
            for m, a, b in middle_places(block.cell_type):
                ends = np.sort(block.connectivity[:, [a, b]], axis=1)
                parts.append(np.column_stack([ends, block.connectivity[:, m]]))
    return np.concatenate(parts)


def _linear_block(block: CellBlock) -> CellBlock:
    name = LINEAR.get(block.cell_type)
    if name is None:
        return block
    table = block.connectivity[:, list(block.kind.corners)]
    return CellBlock.make(block.nodes, name, table, block.colours)


def middle_places(cell_type: str) -> list[tuple[int, int, int]]:
    """For a quadratic cell: local number of each middle and of the two corners beside it."""
    kind = CELL_TYPES[cell_type]
    if kind.dimension == 1:
        return [(1, 0, 2)]
    around = tuple(range(2 * len(kind.corners)))
    rings = [around] if kind.dimension == 2 else [f for _, f in kind.faces]
    found: dict[int, tuple[int, int, int]] = {}
    for face in rings:
        ring = face[: len(face) // 2 * 2]  # without the node in the middle of a complete face
        for k in range(1, len(ring), 2):
            found[ring[k]] = (ring[k], ring[k - 1], ring[(k + 1) % len(ring)])
    return [found[m] for m in sorted(found)]


def _edge_pairs(block: CellBlock) -> IntArray:
    """Corner nodes (n_cells, n_middles, 2) beside each middle that the cells will get."""
    name = QUADRATIC[block.cell_type]
    corner = {local: k for k, local in enumerate(CELL_TYPES[name].corners)}
    places = [(corner[a], corner[b]) for _, a, b in middle_places(name)]
    return block.connectivity[:, places]


def _with_middles(block: CellBlock, name: str, middles: IntArray) -> CellBlock:
    kind = CELL_TYPES[name]
    table = np.empty((len(block), kind.n_nodes), dtype=np.int64)
    table[:, list(kind.corners)] = block.connectivity
    table[:, [m for m, _, _ in middle_places(name)]] = middles
    return CellBlock.make(block.nodes, name, table, block.colours)
