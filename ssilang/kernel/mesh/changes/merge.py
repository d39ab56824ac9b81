"""Merging of nodes that lie close to each other (ELIM), and cells that this degenerates (REGE).

Nodes of a line doubled inside a surface, so that the surface opens along it (DEDO).
"""

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.changes.degree import middle_places
from ssilang.kernel.mesh.combine import take, union
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def merge_close(nodes: NodeTable, ids: IntArray, tolerance: float) -> None:
    """Merge the nodes (m,) that are less than `tolerance` apart; the oldest of each group stays."""
    ids = np.unique(nodes.resolve(ids))
    _check(tolerance)
    pairs = spatial.cKDTree(nodes.coordinates[ids]).query_pairs(tolerance, output_type="ndarray")
    if not len(pairs):
        return
    label = parts_of(len(ids), pairs.T)
    oldest = np.full(label.max() + 1, np.iinfo(np.int64).max)
    np.minimum.at(oldest, label, ids)
    kept = oldest[label]
    gone = kept != ids
    nodes.merge(kept[gone], ids[gone])


def merge_between(nodes: NodeTable, first: IntArray, second: IntArray, tolerance: float) -> None:
    """Merge nodes of one set with nodes of another, less than `tolerance` apart; nodes of the
    same set stay distinct.

    Each node goes with the nearest free one of the other set, else onto one that both have.
    """
    _check(tolerance)
    a, b = np.unique(nodes.resolve(first)), np.unique(nodes.resolve(second))
    common = np.intersect1d(a, b)
    a, b = np.setdiff1d(a, common), np.setdiff1d(b, common)
    tree = spatial.cKDTree(nodes.coordinates[b])
    near = spatial.cKDTree(nodes.coordinates[a]).sparse_distance_matrix(
        tree, tolerance, output_type="coo_matrix"
    )
    order = np.argsort(near.data, kind="stable")
    rows, columns = near.row[order], near.col[order]
    free_a, free_b = np.ones(len(a), dtype=bool), np.ones(len(b), dtype=bool)
    pairs = []
    for i, j in zip(rows.tolist(), columns.tolist(), strict=True):
        if free_a[i] and free_b[j]:
            free_a[i] = free_b[j] = False
            pairs.append((a[i], b[j]))
    if len(common):
        left = np.concatenate([a[free_a], b[free_b]])
        gap, at = spatial.cKDTree(nodes.coordinates[common]).query(nodes.coordinates[left])
        pairs += zip(left[gap < tolerance], common[np.asarray(at)[gap < tolerance]], strict=True)
    table = np.sort(np.array(pairs, dtype=np.int64).reshape(-1, 2), axis=1)
    nodes.merge(table[:, 0], table[:, 1])


def _check(tolerance: float) -> None:
    if tolerance <= 0.0:
        raise MeshError("kernel.mesh.nodes-merged-within-positive")


# what a cell with one (or, for volumes, two) vanished edge becomes: type of the cell ->
# (pairs of local nodes that coincide -> type and local nodes of the new cell)
_Collapse = dict[tuple[tuple[int, int], ...], tuple[str, tuple[int, ...]]]


def _collapse(kind: str, name: str, kept: tuple[int, ...], *pairs: tuple[int, int]) -> _Collapse:
    """What a cell is where the corners of pairs coincide: corners `kept`, and middles of edges."""
    corner, middle = CELL_TYPES[kind].corners, {}
    if CELL_TYPES[kind].degree > 1:
        middle = {frozenset((a, b)): m for m, a, b in middle_places(kind)}
    same = {a: [a, *(b for pair in pairs if a in pair for b in pair if b != a)] for a in kept}
    of = dict(zip(CELL_TYPES[name].corners, kept, strict=True))
    local = {i: corner[k] for i, k in of.items()}
    for m, i, j in middle_places(name) if middle else []:
        ways = (frozenset((corner[a], corner[b])) for a in same[of[i]] for b in same[of[j]])
        local[m] = next(middle[way] for way in ways if way in middle)
    vanished = tuple((corner[a], corner[b]) for a, b in pairs)
    return {vanished: (name, tuple(local[m] for m in range(len(local))))}


def _polygon_collapses(kind: str, smaller: str) -> _Collapse:
    """Of each edge of a polygon: a quadrangle keeps its first corner, a triangle the second."""
    n, rules = len(CELL_TYPES[kind].corners), _Collapse()
    for i in range(n):
        a, b, *others = ((i + k) % n for k in range(n))
        rules |= _collapse(kind, smaller, (a if n > 3 else b, *others), (a, b))
    return rules


def _brick_collapses(kind: str, prism: str) -> _Collapse:
    """A brick with two parallel edges vanished, side by side on a face, is a prism."""
    rules = _Collapse()
    frames = (  # the three ways to see a brick as two opposite faces, all right-handed
        ((0, 1, 2, 3), (4, 5, 6, 7)),
        ((0, 4, 5, 1), (3, 7, 6, 2)),
        ((0, 3, 7, 4), (1, 2, 6, 5)),
    )
    for low, high in frames:
        for i in range(4):
            a, b, c, d = (low[(i + k) % 4] for k in range(4))
            e, f, g, h = (high[(i + k) % 4] for k in range(4))
            rules |= _collapse(kind, prism, (a, c, d, e, g, h), (a, b), (e, f))
    return rules


def _prism_collapses(kind: str, tetrahedron: str, pyramid: str) -> _Collapse:
    """A prism on an axis: with two upright edges or a triangle vanished a tetrahedron.

    With one upright edge vanished it is a pyramid.
    """
    rules = _Collapse()
    for low, high in ((0, 3), (3, 0)):
        turn = (0, 1, 2) if low == 0 else (0, 2, 1)
        kept = (*(low + k for k in turn), high)
        pairs = ((high, high + 1), (high, high + 2))
        rules |= _collapse(kind, tetrahedron, kept, *pairs)
    around = [(k, (k + 1) % 3, (k + 2) % 3) for k in range(3)]
    for a, b, c in around:
        rules |= _collapse(kind, tetrahedron, (a, b, c, c + 3), (a, a + 3), (b, b + 3))
    for a, b, c in around:
        rules |= _collapse(kind, pyramid, (b, b + 3, c + 3, c, a), (a, a + 3))
    return rules


_COLLAPSES: dict[str, _Collapse] = {
    "SEG2": {((0, 1),): ("POI1", (0,))},
    "SEG3": {
        ((0, 1),): ("SEG2", (1, 2)),
        ((1, 2),): ("SEG2", (0, 1)),
        ((0, 2),): ("SEG2", (0, 1)),
    },
    "TRI3": _polygon_collapses("TRI3", "SEG2"),
    "TRI6": _polygon_collapses("TRI6", "SEG3"),
    "TRI7": _polygon_collapses("TRI7", "SEG3"),
    "QUA4": _polygon_collapses("QUA4", "TRI3"),
    "QUA8": _polygon_collapses("QUA8", "TRI6"),
    "QUA9": _polygon_collapses("QUA9", "TRI6"),
    "CUB8": _brick_collapses("CUB8", "PRI6"),
    "CU20": _brick_collapses("CU20", "PR15"),
    "PRI6": _prism_collapses("PRI6", "TET4", "PYR5"),
    "PR15": _prism_collapses("PR15", "TE10", "PY13"),
}


def regenerate(mesh: Mesh) -> Mesh:
    """Cells in which nodes coincide replaced by simpler ones (QUA4 by TRI3, CUB8 by PRI6 ...)."""
    parts = [Mesh(mesh.nodes, (b,)) for block in mesh.blocks for b in _regenerated(block)]
    made = union(*parts, as_given=True) if parts else mesh
    same = [b.cell_type for b in made.blocks] == [b.cell_type for b in mesh.blocks]
    return mesh if same else made


def _regenerated(block: CellBlock) -> list[CellBlock]:
    left = np.ones(len(block), dtype=bool)
    table = block.connectivity
    made = []
    for pairs, (cell_type, local) in _COLLAPSES.get(block.cell_type, {}).items():
        hit = left & np.all([table[:, i] == table[:, j] for i, j in pairs], axis=0)
        if hit.any():
            made.append(
                CellBlock.make(
                    block.nodes, cell_type, table[hit][:, list(local)], block.colours[hit]
                )
            )
            left &= ~hit
    rest = take(Mesh(block.nodes, (block,)), lambda _: left).blocks
    return [*rest, *made]


def repeated_nodes(mesh: Mesh) -> int:
    """Number of cells in which a node stands twice."""
    total = 0
    for block in mesh.blocks:
        table = np.sort(block.connectivity, axis=1)
        total += int((table[:, 1:] == table[:, :-1]).any(axis=1).sum())
    return total


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
    nodes, where = surface.nodes, [b.connectivity for b in surface.blocks]
    right = _right_places(surface, block)
    old = np.unique(np.concatenate([table.ravel() for table in where])[right])
    if not len(old):
        raise MeshError("kernel.mesh.line-not-separate-cells")
    image = np.arange(len(nodes), dtype=np.int64)
    image[old] = nodes.add(nodes.coordinates[old].copy(), nodes.density[old].copy())
    blocks = []
    for cells, table in zip(surface.blocks, where, strict=True):
        own, right = right[: table.size].reshape(table.shape), right[table.size :]
        moved = np.where(own, image[table], table)
        blocks.append(CellBlock.make(nodes, cells.cell_type, moved, cells.colours))
    new_line = CellBlock.make(nodes, block.cell_type, image[block.connectivity], block.colours)
    return Mesh(nodes, tuple(blocks)), Mesh(nodes, (new_line,))


def _right_places(surface: Mesh, line: CellBlock) -> BoolArray:
    """Places in the cells, one after the other, of nodes that the line opens, on its right."""
    xyz, on_line, size = surface.nodes.coordinates, line.connectivity, len(surface.nodes)
    nodes, flat, centres = [], [], []
    sides = [np.empty((0, 4), np.int64)]  # ends in increasing order, a node of the side, its place
    start = 0
    for block in surface.blocks:
        table, plane = block.connectivity, block.kind.dimension == 2 and not block.kind.joint
        places = start + np.arange(table.size).reshape(table.shape)
        for _, face in block.kind.faces if plane else ():
            ends = np.sort(table[:, [face[0], face[-1]]], axis=1)
            sides += [np.column_stack([ends, table[:, i], places[:, i]]) for i in face]
        nodes.append(table.ravel())
        flat.append(np.full(table.size, plane))
        centres.append(np.repeat(block.coordinates.mean(axis=1), table.shape[1], axis=0))
        start += table.size
    node, near = np.concatenate(nodes), np.concatenate(sides)
    near = near[np.isin(near[:, 2], on_line)]
    cut, code = np.sort(on_line[:, [0, -1]], axis=1) @ [size, 1], near[:, :2] @ [size, 1]
    if not np.isin(cut, code).all():
        raise MeshError("kernel.mesh.line-not-made-edges")
    whole, joined = near[np.isin(code, cut)], near[~np.isin(code, cut)]
    order = np.argsort(cut)
    a, b = on_line[order[np.searchsorted(cut[order], whole[:, :2] @ [size, 1])]][:, [0, -1]].T
    way, off = xyz[b] - xyz[a], np.concatenate(centres)[whole[:, 3]] - xyz[a]
    seeds = whole[way[:, 0] * off[:, 1] - way[:, 1] * off[:, 0] < 0, 3]
    # places of one node in two cells hang together by a side of both that the line does not cut
    _, which, counts = np.unique(joined[:, :3], axis=0, return_inverse=True, return_counts=True)
    pairs = joined[np.argsort(which.ravel(), kind="stable"), 3]
    pairs = pairs[np.repeat(counts == 2, counts)].reshape(-1, 2)
    part = parts_of(len(node), pairs.T)
    around = np.concatenate(flat) & np.isin(node, on_line)
    right = around & np.isin(part, part[seeds])
    opened: BoolArray = right & np.isin(node, node[around & ~right])
    return opened
