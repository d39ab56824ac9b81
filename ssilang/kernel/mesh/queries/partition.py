"""Meshes taken apart into zones of cells that hang together."""

from itertools import combinations

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.base.scientific import csgraph, sp
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

_WIDTH = 4  # corners of the largest side of a cell


def connected(mesh: Mesh) -> list[Mesh]:
    """Parts of a mesh whose cells are joined by common nodes, in the order of their first cell."""
    if not mesh.n_cells:
        return []
    rows = [np.repeat(np.arange(len(b)), b.kind.n_nodes) for b in mesh.blocks]
    starts = _starts(mesh)
    cells = np.concatenate([r + s for r, s in zip(rows, starts, strict=True)])
    nodes = np.concatenate([b.connectivity.ravel() for b in mesh.blocks])
    return _zones(mesh, np.column_stack([cells, nodes + mesh.n_cells]))


def separated(
    mesh: Mesh,
    by_branching: bool = False,
    separator: Mesh | None = None,
    angle: float | None = None,
    folded: bool = False,
) -> list[Mesh]:
    """Parts of a mesh whose cells are joined by common sides (nodes of lines, edges, faces).

    Parameters
    ----------
    by_branching : bool
        Sides that belong to more than two cells do not join.
    separator : Mesh, optional
        Sides whose corners all belong to one cell of it do not join.
    angle : float, optional
        Degrees; lines and surfaces whose tangents, normals turn by more do not join.
    folded : bool
        With an angle: cells folded back on each other (180 degrees) do not join either.

    Raises
    ------
    MeshError
        If an angle is asked for in volumes.
    """
    if not mesh.n_cells:
        return []
    cells, names, which, counts = _sides(mesh)
    joins = np.ones(len(names), dtype=bool)
    if by_branching:
        joins &= counts <= 2
    if separator is not None:
        joins &= ~_within(names, separator)
    pairs = [_pairs(cells, which, counts, n) for n in np.unique(counts[joins]) if n > 1]
    found = [p[joins[side]] for p, side in pairs]
    links = np.concatenate([*found, np.empty((0, 2), dtype=np.int64)])
    if angle is not None:
        links = links[_smooth(mesh, links, angle, folded)]
    return _zones(mesh, links)


def scattered(mesh: Mesh, count: int) -> list[Mesh]:
    """Cells dealt out in turn to `count` parts (fewer if the mesh has fewer cells)."""
    return _by_label(mesh, np.arange(mesh.n_cells) % count)


def balanced(mesh: Mesh, count: int) -> list[Mesh]:
    """`count` parts (a power of two) of equal numbers of cells, halved across their longest way.

    Raises
    ------
    MeshError
        If the number of parts is not a power of two.
    """
    if count < 1 or count & (count - 1):
        raise MeshError("kernel.mesh.mesh-not-halved-parts", count=count)
    centres = np.concatenate([b.coordinates.mean(axis=1) for b in mesh.blocks])
    parts = [np.arange(mesh.n_cells)]
    while len(parts) < count:
        parts = [half for part in parts for half in _halves(part, centres)]
    label = np.empty(mesh.n_cells, dtype=np.int64)
    for number, part in enumerate(parts):
        label[part] = number
    return _by_label(mesh, label)


def _halves(cells: IntArray, centres: FloatArray) -> tuple[IntArray, IntArray]:
    if not len(cells):
        return cells, cells
    axis = int(np.ptp(centres[cells], axis=0).argmax())
    order = cells[np.argsort(centres[cells, axis], kind="stable")]
    middle = (len(cells) + 1) // 2
    return order[:middle], order[middle:]


def _starts(mesh: Mesh) -> IntArray:
    return np.cumsum([0, *(len(b) for b in mesh.blocks)])[:-1]


def _zones(mesh: Mesh, links: IntArray) -> list[Mesh]:
    """Meshes of the cells linked with each other; `links` (m, 2) may pass by other numbers."""
    size = int(max(links.max(initial=-1) + 1, mesh.n_cells))
    return _by_label(mesh, parts_of(size, links.T)[: mesh.n_cells])


def _by_label(mesh: Mesh, label: IntArray) -> list[Mesh]:
    """Meshes of the cells of each label, in the order in which the labels appear."""
    names, first, label = np.unique(label, return_index=True, return_inverse=True)
    parts: list[list[CellBlock]] = [[] for _ in names]
    for block, start in zip(mesh.blocks, _starts(mesh), strict=True):
        mine = label[start : start + len(block)]
        order = np.argsort(mine, kind="stable")
        ends = np.searchsorted(mine[order], np.arange(len(names) + 1))
        for number in np.unique(mine):
            parts[number].append(block.some(order[ends[number] : ends[number + 1]]))
    return [Mesh(mesh.nodes, tuple(parts[number])) for number in np.argsort(first)]


def by_neighbours(block: CellBlock) -> CellBlock:
    """Cells in the order in which one comes from the first to all, from side to side.

    Each part of the mesh begins with its first cell.
    """
    n = len(block)
    cells, _, which, counts = _sides(Mesh(block.nodes, (block,)))
    pairs = [_pairs(cells, which, counts, m)[0] for m in np.unique(counts[counts > 1])]
    first, second = np.concatenate([np.empty((0, 2), dtype=np.int64), *pairs]).T
    links = sp.coo_array((np.ones(len(first)), (first, second)), shape=(n, n)).tocsr()
    found = np.zeros(n, dtype=bool)
    order: list[IntArray] = []
    while not found.all():
        start = int(np.argmin(found))
        met = csgraph.breadth_first_order(links, start, directed=False)[0]
        order.append(met.astype(np.int64))
        found[order[-1]] = True
    places = np.concatenate(order) if order else np.empty(0, dtype=np.int64)
    return block.some(places)


def _sides(mesh: Mesh) -> tuple[IntArray, IntArray, IntArray, IntArray]:
    """Cells (m,) of all sides, the sides' corners (n, 4), sorted, filled with -1; which of these
    each of the m is, and how many each of the n are."""
    owners, corners = [np.empty(0, np.int64)], [np.empty((0, _WIDTH), np.int64)]
    for block, start in zip(mesh.blocks, _starts(mesh), strict=True):
        for kind, local in block.kind.faces:
            places = [local[k] for k in CELL_TYPES[kind].corners]
            table = np.full((len(block), _WIDTH), -1, dtype=np.int64)
            table[:, : len(places)] = block.connectivity[:, places]
            corners.append(np.sort(table, axis=1))
            owners.append(np.arange(len(block)) + start)
    every = np.concatenate(corners)
    names, which, counts = np.unique(every, axis=0, return_inverse=True, return_counts=True)
    return np.concatenate(owners), names, which.ravel(), counts


def _within(sides: IntArray, separator: Mesh) -> BoolArray:
    """Sides all corners of which belong to one cell of the separator."""
    wanted = sides.max(axis=0, initial=0).max(initial=0)
    found = np.zeros(len(sides), dtype=bool)
    known = {tuple(side[side >= 0]): k for k, side in enumerate(sides)}
    sizes = {len(side) for side in known}
    for block in separator.blocks:
        table = np.sort(block.connectivity, axis=1)
        for row in table[table[:, 0] <= wanted].tolist():
            for size in sizes:
                for part in combinations(row, size):
                    if part in known:
                        found[known[part]] = True
    return found


def _pairs(cells: IntArray, which: IntArray, counts: IntArray, n: int) -> tuple[IntArray, IntArray]:
    """Every two cells of each side that `n` cells share, with the number of the side."""
    order = np.argsort(which, kind="stable")
    mine = order[counts[which[order]] == n].reshape(-1, n)
    first, second = np.triu_indices(n, 1)
    links = np.stack([cells[mine[:, first]], cells[mine[:, second]]], axis=-1)
    return links.reshape(-1, 2), np.repeat(which[mine[:, 0]], len(first))


def _smooth(mesh: Mesh, links: IntArray, angle: float, folded: bool) -> BoolArray:
    along = _directions(mesh)
    cosine = np.clip(np.einsum("ij,ij->i", along[links[:, 0]], along[links[:, 1]]), -1, 1)
    turn = np.degrees(np.arccos(cosine))
    if not folded:  # cells described in opposite senses are not folded
        turn = np.minimum(turn, np.where(turn > 180 - 1e-6, 0.0, turn))
    return turn <= angle


def _directions(mesh: Mesh) -> FloatArray:
    """Unit tangents of lines, normals of surfaces, shape (n_cells, 3)."""
    parts = [np.empty((0, 3))]
    for block in mesh.blocks:
        xyz = block.coordinates[:, list(block.kind.corners)]
        if block.kind.dimension == 3:
            raise MeshError("kernel.mesh.angles-lines-surfaces-mesh")
        if block.kind.dimension == 1:
            along = xyz[:, -1] - xyz[:, 0]
        else:
            along = np.cross(xyz[:, 1] - xyz[:, 0], xyz[:, -1] - xyz[:, 0])
        size = np.linalg.norm(along, axis=1, keepdims=True)
        parts.append(along / np.where(size > 0, size, 1.0))
    return np.concatenate(parts)
