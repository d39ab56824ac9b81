"""Nodes of a line doubled inside a surface, so that the surface opens along it (DEDO)."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.mesh.mesh import CellBlock, Mesh


def cut_open(surface: Mesh, line: Mesh) -> tuple[Mesh, Mesh]:
    """The surface opened along a line, and the line on its new nodes.

    A node of the line is doubled where the line separates the cells around it (an end inside
    the surface, the tip of a crack, stays single). Cells to the left of the line keep the old
    nodes.

    Raises
    ------
    MeshError
        If the line is not made of edges of the surface, or has a branch.
    """
    block = line.single_block()
    if block.cell_type not in ("SEG2", "SEG3"):
        raise MeshError("kernel.mesh.line-seg2-seg3-needed")
    ends, times = np.unique(block.connectivity[:, [0, -1]], return_counts=True)
    if (times > 2).any():
        node = line.nodes.told(ends[times > 2][0])
        raise MeshError("kernel.mesh.line-branches-node", ends=node)
    right = _right_cells(surface, block)
    nodes = surface.nodes
    on_line = np.unique(block.connectivity)
    image = np.arange(len(nodes), dtype=np.int64)
    opened = [n for n in on_line.tolist() if n in right]
    if not opened:
        raise MeshError("kernel.mesh.line-not-separate-cells")
    old = np.array(opened, dtype=np.int64)
    image[old] = nodes.add(nodes.coordinates[old].copy(), nodes.density[old].copy())
    blocks = []
    for k, cells in enumerate(surface.blocks):
        table = cells.connectivity.copy()
        for n in opened:
            rows = np.array([c for b, c in right[n] if b == k], dtype=np.int64)
            table[rows] = np.where(table[rows] == n, image[n], table[rows])
        blocks.append(CellBlock.make(nodes, cells.cell_type, table, cells.colours))
    new_line = CellBlock.make(nodes, block.cell_type, image[block.connectivity], block.colours)
    return Mesh(nodes, tuple(blocks)), Mesh(nodes, (new_line,))


def _right_cells(surface: Mesh, line: CellBlock) -> dict[int, set[tuple[int, int]]]:
    """For each node that the line opens: the cells (block, row) around it on the right."""
    edge_cells: dict[tuple[int, int], list[tuple[int, int]]] = {}
    around: dict[int, set[tuple[int, int]]] = {}
    on_line = set(np.unique(line.connectivity).tolist())
    for k, block in enumerate(surface.blocks):
        if block.kind.dimension != 2 or block.kind.joint:
            continue
        touching = np.flatnonzero(np.isin(block.connectivity, list(on_line)).any(axis=1))
        for row in touching.tolist():
            nodes = block.connectivity[row]
            for node in set(nodes.tolist()) & on_line:
                around.setdefault(node, set()).add((k, row))
            for _, face in block.kind.faces:
                a, b = int(nodes[face[0]]), int(nodes[face[-1]])
                edge_cells.setdefault((min(a, b), max(a, b)), []).append((k, row))
    cut = {(min(a, b), max(a, b)): (a, b) for a, b in line.connectivity[:, [0, -1]].tolist()}
    if any(edge not in edge_cells for edge in cut):
        raise MeshError("kernel.mesh.line-not-made-edges")
    seeds = _seeds(surface, line, cut, edge_cells)
    found: dict[int, set[tuple[int, int]]] = {}
    for node, cells in around.items():
        side = _side(sorted(cells), edge_cells, set(cut), seeds.get(node, set()))
        if side and side != cells:
            found[node] = side
    return found


def _seeds(
    surface: Mesh,
    line: CellBlock,
    cut: dict[tuple[int, int], tuple[int, int]],
    edge_cells: dict[tuple[int, int], list[tuple[int, int]]],
) -> dict[int, set[tuple[int, int]]]:
    """Cells that touch the line by an edge from its right, for each node of the edge."""
    xyz = surface.nodes.coordinates
    seeds: dict[int, set[tuple[int, int]]] = {}
    members = {tuple(sorted((r[0], r[-1]))): r for r in line.connectivity.tolist()}
    for edge, (a, b) in cut.items():
        way = xyz[b] - xyz[a]
        for k, row in edge_cells[edge]:
            centre = xyz[surface.blocks[k].connectivity[row]].mean(axis=0) - xyz[a]
            if way[0] * centre[1] - way[1] * centre[0] < 0:
                for node in members[edge]:
                    seeds.setdefault(node, set()).add((k, row))
    return seeds


def _side(
    cells: list[tuple[int, int]],
    edge_cells: dict[tuple[int, int], list[tuple[int, int]]],
    cut: set[tuple[int, int]],
    seeds: set[tuple[int, int]],
) -> set[tuple[int, int]]:
    """Cells joined to the seeds by edges that the line does not cut."""
    number = {c: i for i, c in enumerate(cells)}
    links = [
        (number[a], number[b])
        for edge, owners in edge_cells.items()
        if edge not in cut and len(owners) == 2
        for a, b in [owners]
        if a in number and b in number
    ]
    table = np.array(links, dtype=np.int64).reshape(-1, 2)
    label = parts_of(len(cells), table.T)
    wanted: IntArray = np.unique([label[number[c]] for c in seeds if c in number])
    return {c for c in cells if label[number[c]] in wanted}
