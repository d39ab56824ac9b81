"""Meshes of curves: straight, broken, parametrised; the shortest way along a network of lines.

Tangents, normals and binormals along lines.
"""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.scientific import csgraph, sp
from ssilang.kernel.mesh.boundary import walked
from ssilang.kernel.mesh.lines.subdivision import Subdivision
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable, told_coordinates

# fractions (m,) of the way along the curve -> positions (m, 3)
CurveMap = Callable[[FloatArray], FloatArray]


def mesh_curve(
    nodes: NodeTable,
    curve: CurveMap,
    start: int,
    end: int | None,
    cuts: Subdivision,
    quadratic: bool = False,
    colour: int = 0,
) -> Mesh:
    """A line of SEG2 or SEG3 along a curve, between existing nodes.

    Parameters
    ----------
    curve : function of array (m,) to array (m, 3)
        Position at a fraction of the way.
    start : int
        Node at fraction 0.
    end : int or None
        Node at fraction 1; None creates it.
    """
    steps = _with_middles(cuts) if quadratic else cuts.fractions
    inner = steps[1:] if end is None else steps[1:-1]
    made = nodes.add(curve(inner), cuts.density(inner)) if len(inner) else np.empty(0, np.int64)
    chain = np.concatenate([[start], made, [] if end is None else [end]]).astype(np.int64)
    return chain_mesh(nodes, chain, quadratic, colour)


def chain_mesh(nodes: NodeTable, chain: IntArray, quadratic: bool, colour: int = 0) -> Mesh:
    """A line through the nodes `chain` (m,), middles included when quadratic.

    Raises
    ------
    MeshError
        With fewer than two nodes, or an even number of them for SEG3.
    """
    if len(chain) < 2 or (quadratic and len(chain) % 2 == 0):
        raise MeshError(
            "kernel.mesh.line-needs-points-got", quadratic=quadratic, n_chain=len(chain)
        )
    step = 2 if quadratic else 1
    columns = [chain[k : len(chain) - step + k : step] for k in range(step + 1)]
    return Mesh.of(nodes, "SEG3" if quadratic else "SEG2", np.column_stack(columns), colour)


def end_sizes(nodes: NodeTable, start: int, end: int) -> tuple[float, float]:
    """The densities that two nodes carry."""
    return float(nodes.density[start]), float(nodes.density[end])


def different_nodes(nodes: NodeTable, start: int, end: int) -> None:
    """Refuse a line from a node to itself."""
    if start == end:
        raise MeshError("kernel.mesh.line-starts-ends-same", start=nodes.told(start))


def line_chain(line: Mesh) -> IntArray:
    """Nodes of a line in the order and sense of its cells, middles included, shape (m,).

    A closed line repeats its first node at the end. Where cells run against each other, the sense
    is the first one's.

    Raises
    ------
    MeshError
        If the mesh is not one connected line.
    """
    if any(b.cell_type not in ("SEG2", "SEG3") for b in line.blocks) or not line.blocks:
        kinds = [b.cell_type for b in line.blocks]
        raise MeshError("kernel.mesh.line-of-segments-needed", kinds=kinds)
    table = line.single_block().connectivity
    if not np.array_equal(table[1:, 0], table[:-1, -1]):
        table = _in_order(table, line.nodes)
    return np.concatenate([table[:, :-1].ravel(), table[-1:, -1]])


def _in_order(table: IntArray, nodes: NodeTable) -> IntArray:
    """Cells (n, 2 or 3) of one line, one behind the other, in the sense of the first of them."""
    ends, counts = np.unique(table[:, [0, -1]], return_counts=True)
    found, order = walked(table, np.append(ends[counts == 1], table[0, 0])[:1])
    if len(order) != len(table) or counts.max() > 2:
        raise MeshError("kernel.mesh.line-cells-not-follow", twice=_met_twice(table, nodes))
    return found if found[order == 0][0, 0] == table[0, 0] else found[::-1, ::-1]


def _met_twice(table: IntArray, nodes: NodeTable) -> str:
    """Where two ends of the parts of a line are different nodes at one place; '' nowhere."""
    ends, cells = np.unique(table[:, [0, -1]], return_counts=True)
    at = nodes.coordinates[ends[cells == 1]]
    apart = np.linalg.norm(at[:, None] - at[None], axis=2)
    length = np.linalg.norm(np.ptp(nodes.coordinates[ends], axis=0))
    first, second = np.nonzero(np.triu(apart <= 1e-9 * length, k=1))
    return told_coordinates(nodes.shown(at[first[0]])) if len(second) else ""


def line_ends(line: Mesh) -> tuple[int, int]:
    """First node of the first cell and last node of the last cell.

    Raises
    ------
    MeshError
        If the mesh holds other cells than SEG2, SEG3 or POI1.
    """
    if not line.blocks or any(b.kind.dimension > 1 or b.kind.joint for b in line.blocks):
        raise MeshError("kernel.mesh.line-set-points-needed")
    first, last = line.blocks[0].connectivity, line.blocks[-1].connectivity
    return int(first[0, 0]), int(last[-1, -1])


def _with_middles(cuts: Subdivision) -> FloatArray:
    steps = np.empty(2 * cuts.count + 1)
    steps[::2] = cuts.fractions
    steps[1::2] = cuts.middles
    return steps


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
    graph = sp.coo_array((lengths, pairs.T), shape=(len(nodes), len(nodes))).tocsr()
    search: Any = csgraph.dijkstra  # its stubs know fewer kinds of graphs
    _, before = search(graph, directed=False, indices=int(ends[0]), return_predecessors=True)
    cells, way = {frozenset(pair): i for i, pair in enumerate(pairs.tolist())}, [int(ends[1])]
    while way[-1] != ends[0]:
        way.append(int(before[way[-1]]))
        if way[-1] < 0:
            raise MeshError("kernel.mesh.no-way-leads-along")
    rows = np.array([cells[frozenset(pair)] for pair in pairwise(way)])
    found, order = walked(table[rows], wanted[:1])
    return Mesh.of(network.nodes, block.cell_type, found, block.colours[rows[order]])


_STRAIGHT = 1e-9  # bends (in radians) below which a line counts as straight


def frenet_frames(line: Mesh) -> tuple[IntArray, FloatArray]:
    """Nodes (n,) of one or several lines and their frames (n, 3, 3): rows t, n, b.

    At inner nodes the tangent and the normal are those of the circle through a node and its two
    neighbours; at a free end the tangent is the cell's direction, and the binormal the neighbour's
    as far as it is across. Where a line is straight the binormal is the nearest to the z axis.

    Raises
    ------
    MeshError
        If cells are no lines, or a node has more than one cell before or after it.
    """
    before, after = _neighbours(line)
    ids = np.flatnonzero((before >= 0) | (after >= 0))
    xyz = line.nodes.coordinates
    both = (before[ids] >= 0) & (after[ids] >= 0)
    frames = np.zeros((len(ids), 3, 3))
    u, v = xyz[ids] - xyz[before[ids]], xyz[after[ids]] - xyz[ids]
    tangent, bend = _circle(u[both], v[both])
    frames[both, 0], frames[both, 1] = tangent, bend
    ends = ids[~both]
    other = np.maximum(before, after)[ends]
    chord = np.where(before[ends, None] < 0, 1.0, -1.0) * (xyz[other] - xyz[ends])
    chord /= np.linalg.norm(chord, axis=1, keepdims=True)
    near = frames[np.searchsorted(ids, other)]
    frames[~both, 0] = chord
    frames[~both, 1] = np.cross(np.cross(near[:, 0], near[:, 1]), chord)
    # Normals made orthogonal and unit, binormals from them.
    t, n = frames[:, 0], frames[:, 1]
    n -= (n * t).sum(axis=1, keepdims=True) * t
    size = np.linalg.norm(n, axis=1)
    straight = size < _STRAIGHT
    along_z = np.abs(t[:, 2]) > 1.0 - 1e-9
    up = np.where(along_z[:, None], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])
    n[straight] = np.cross(up[straight], t[straight])
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    frames[:, 2] = np.cross(t, n)
    return ids, frames


def _neighbours(line: Mesh) -> tuple[IntArray, IntArray]:
    """Node before and node after each node of the table, -1 where there is none."""
    if not line.n_cells:
        raise MeshError("kernel.mesh.mesh-empty-no-line")
    pairs = []
    for block in line.blocks:
        if block.cell_type not in ("SEG2", "SEG3"):
            raise MeshError("kernel.mesh.line-needed-mesh-holds", cell_type=block.cell_type)
        table = block.connectivity
        pairs += [table[:, k : k + 2] for k in range(table.shape[1] - 1)]
    table = np.concatenate(pairs)
    for column, ending in ((0, False), (1, True)):
        ids, times = np.unique(table[:, column], return_counts=True)
        if (times > 1).any():
            node = line.nodes.told(ids[times > 1][0])
            raise MeshError("kernel.mesh.several-cells-node-line", ending=ending, node=node)
    before = np.full(len(line.nodes), -1, dtype=np.int64)
    after = before.copy()
    after[table[:, 0]], before[table[:, 1]] = table[:, 1], table[:, 0]
    return before, after


def _circle(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit tangents and bends at the middle of two chords (m, 3) each."""
    h, k = (np.linalg.norm(x, axis=1, keepdims=True) for x in (u, v))
    tangent = u / h**2 + v / k**2
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    return tangent, v / k - u / h
