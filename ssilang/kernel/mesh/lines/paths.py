"""The shortest way along the lines of a network, such as the edges of a volume."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.mesh import Mesh


def network_of_lines(mesh: Mesh) -> bool:
    """Whether a mesh is of lines of one kind of which more than two meet somewhere."""
    if len(mesh.blocks) != 1 or mesh.blocks[0].cell_type not in ("SEG2", "SEG3"):
        return False
    _, count = np.unique(mesh.blocks[0].connectivity[:, [0, -1]], return_counts=True)
    return bool((count > 2).any())


def shortest_line(network: Mesh, start: int, end: int) -> Mesh:
    """Cells of a mesh of lines on the shortest way between two nodes, run through in that sense.

    Raises
    ------
    MeshError
        If the mesh is not of lines of one kind, or no way leads from one node to the other.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    block = network.single_block()
    if block.cell_type not in ("SEG2", "SEG3"):
        raise MeshError("kernel.mesh.line-of-segments-needed", kinds=block.cell_type)
    table = block.connectivity
    nodes, places = np.unique(table[:, [0, -1]], return_inverse=True)
    pairs = places.reshape(-1, 2)
    wanted = network.nodes.resolve(np.array([start, end]))
    ends = np.searchsorted(nodes, wanted)
    if (ends >= len(nodes)).any() or ends[0] == ends[1] or (nodes[ends] != wanted).any():
        raise MeshError("kernel.mesh.two-points-not-ends")
    gaps = np.diff(network.nodes.coordinates[nodes[pairs]], axis=1)[:, 0]
    lengths = np.maximum(np.linalg.norm(gaps, axis=1), np.finfo(float).tiny)
    graph = coo_array((lengths, pairs.T), shape=(len(nodes), len(nodes))).tocsr()
    search: Any = dijkstra  # its stubs know fewer kinds of graphs
    _, before = search(graph, directed=False, indices=int(ends[0]), return_predecessors=True)
    cells = {frozenset(map(int, pair)): i for i, pair in enumerate(pairs)}
    rows: list[int] = []
    turned: list[bool] = []
    at = int(ends[1])
    while at != ends[0]:
        previous = int(before[at])
        if previous < 0:
            raise MeshError("kernel.mesh.no-way-leads-along")
        row = cells[frozenset((previous, at))]
        rows.append(row)
        turned.append(bool(pairs[row, 0] != previous))
        at = previous
    order = np.array(rows[::-1])
    found = table[order]
    back = np.array(turned[::-1])
    found[back] = found[back][:, ::-1]
    return Mesh.of(network.nodes, block.cell_type, found, block.colours[order])
