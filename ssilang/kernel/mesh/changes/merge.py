"""Merging of nodes that lie close to each other (ELIM), and cells that this degenerates (REGE)."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.changes.degree import middle_places
from ssilang.kernel.mesh.combine import take, union
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def merge_close(nodes: NodeTable, ids: IntArray, tolerance: float) -> int:
    """Merge the nodes (m,) that are less than `tolerance` apart; the oldest of each group stays.

    Returns
    -------
    int
        Number of nodes that vanished.
    """
    from scipy.spatial import cKDTree

    ids = np.unique(nodes.resolve(ids))
    _check(tolerance)
    if len(ids) < 2:
        return 0
    pairs = cKDTree(nodes.coordinates[ids]).query_pairs(tolerance, output_type="ndarray")
    return _merge_groups(nodes, ids, pairs)


def merge_between(nodes: NodeTable, first: IntArray, second: IntArray, tolerance: float) -> int:
    """Merge nodes of one set with nodes of another, less than `tolerance` apart; nodes of the
    same set stay distinct.

    Each node goes with the nearest free one of the other set.

    Returns
    -------
    int
        Number of nodes that vanished.
    """
    from scipy.spatial import cKDTree

    _check(tolerance)
    a, b = np.unique(nodes.resolve(first)), np.unique(nodes.resolve(second))
    common = np.intersect1d(a, b)
    a, b = np.setdiff1d(a, common), np.setdiff1d(b, common)
    if not len(a) or not len(b):
        return 0
    tree = cKDTree(nodes.coordinates[b])
    near = cKDTree(nodes.coordinates[a]).sparse_distance_matrix(
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
    if not pairs:
        return 0
    table = np.sort(np.array(pairs, dtype=np.int64), axis=1)
    nodes.merge(table[:, 0], table[:, 1])
    return len(table)


def _check(tolerance: float) -> None:
    if tolerance <= 0.0:
        raise MeshError("kernel.mesh.nodes-merged-within-positive")


def _merge_groups(nodes: NodeTable, ids: IntArray, pairs: IntArray) -> int:
    if not len(pairs):
        return 0
    label = parts_of(len(ids), pairs.T)
    oldest = np.full(label.max() + 1, np.iinfo(np.int64).max)
    np.minimum.at(oldest, label, ids)
    kept = oldest[label]
    gone = kept != ids
    nodes.merge(kept[gone], ids[gone])
    return int(gone.sum())


# what a cell with one (or, for volumes, two) vanished edge becomes: type of the cell ->
# (pairs of local nodes that coincide -> type and local nodes of the new cell)
_Collapse = dict[tuple[tuple[int, int], ...], tuple[str, tuple[int, ...]]]


def _polygon_collapses(n: int, degree: int, smaller: str) -> _Collapse:
    """Collapse of each edge of a polygon of n corners: the edge's second corner and middle go."""
    rules: _Collapse = {}
    size = n * degree
    for i in range(n):
        a, b = i * degree, (i + 1) * degree % size
        kept = (a, *((b + 1 + k) % size for k in range(size - degree - 1)))
        rules[((a, b),)] = (smaller, kept)
    return rules


def _triangle_collapses(degree: int) -> _Collapse:
    """A triangle whose edge vanished is the segment from that edge to the opposite corner."""
    n = 3 * degree
    rules: _Collapse = {}
    for i in range(3):
        a, b, c = (degree * ((i + k) % 3) for k in range(3))
        rules[((a, b),)] = ("SEG2", (b, c)) if degree == 1 else ("SEG3", (b, (b + 1) % n, c))
    return rules


def _brick_collapses() -> _Collapse:
    """A brick with two parallel edges vanished, side by side on a face, is a prism."""
    rules: _Collapse = {}
    brick = ((0, 1, 2, 3), (4, 5, 6, 7))
    frames = (  # the three ways to see a brick as two opposite faces, all right-handed
        brick,
        ((0, 4, 5, 1), (3, 7, 6, 2)),
        ((0, 3, 7, 4), (1, 2, 6, 5)),
    )
    for low, high in frames:
        for i in range(4):
            a, b, c, d = (low[(i + k) % 4] for k in range(4))
            e, f, g, h = (high[(i + k) % 4] for k in range(4))
            rules[((a, b), (e, f))] = ("PRI6", (a, c, d, e, g, h))
    return rules


def _quadratic_brick_collapses() -> _Collapse:
    """The same with middle nodes: CU20 to PR15."""
    corner = CELL_TYPES["CU20"].corners
    middle = {frozenset((a, b)): m for m, a, b in middle_places("CU20")}
    rules: _Collapse = {}
    for pairs, (_, prism) in _brick_collapses().items():
        a, c, d, e, g, h = (corner[k] for k in prism)
        b, f = (corner[pair[1]] for pair in pairs)  # merged with a and e

        def between(i: int, j: int) -> int:
            return middle[frozenset((i, j))]

        local = (
            *(a, between(b, c), c, between(c, d), d, between(d, a)),
            *(between(a, e), between(c, g), between(d, h)),
            *(e, between(f, g), g, between(g, h), h, between(h, e)),
        )
        rules[tuple((corner[i], corner[j]) for i, j in pairs)] = ("PR15", local)
    return rules


_COLLAPSES: dict[str, _Collapse] = {
    "SEG2": {((0, 1),): ("POI1", (0,))},
    "TRI3": _triangle_collapses(1),
    "TRI6": _triangle_collapses(2),
    "QUA4": _polygon_collapses(4, 1, "TRI3"),
    "QUA8": _polygon_collapses(4, 2, "TRI6"),
    "CUB8": _brick_collapses(),
    "CU20": _quadratic_brick_collapses(),
}


def regenerate(mesh: Mesh) -> Mesh:
    """Cells in which nodes coincide replaced by simpler ones (QUA4 by TRI3, CUB8 by PRI6 ...)."""
    parts = []
    for block in mesh.blocks:
        parts += [Mesh(mesh.nodes, (b,)) for b in _regenerated(block)]
    return union(*parts, as_given=True) if parts else mesh


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
