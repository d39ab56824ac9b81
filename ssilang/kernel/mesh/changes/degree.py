"""Cells of one degree made of cells of the other: middles added or dropped.

Complete quadratic cells (TRI7 QUA9 TE15 PY19 PR21 CU27) and the linear cells inside them.
"""

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.cells import CELL_TYPES, COMPLETE, LINEAR_CELLS, CellType
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

LINEAR = {k: v for k, v in LINEAR_CELLS.items() if v != k and k not in COMPLETE.values()}
QUADRATIC = {v: k for k, v in LINEAR.items()}


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
        kind = CELL_TYPES[name]
        table = np.empty((len(block), kind.n_nodes), dtype=np.int64)
        table[:, list(kind.corners)] = block.connectivity
        table[:, [m for m, _, _ in middle_places(name)]] = part
        blocks.append(CellBlock.make(block.nodes, name, table, block.colours))
    return union(*(Mesh(mesh.nodes, (b,)) for b in blocks), as_given=True)


def _middles(mesh: Mesh, edges: IntArray, lines: Mesh | None) -> IntArray:
    """Middle nodes (e,) of edges (e, 2): those of `lines`, or new ones."""
    nodes = mesh.nodes
    middle = np.full(len(edges), -1, dtype=np.int64)
    if lines is not None:
        known = known_middles(lines)
        size = int(max(edges.max(), known[:, :2].max(initial=0))) + 1
        code, wanted = known[:, :2] @ [size, 1], edges @ [size, 1]
        order = np.argsort(code)
        place = np.minimum(np.searchsorted(code[order], wanted), len(code) - 1)
        met = code[order][place] == wanted
        middle[met] = known[order, 2][place[met]]
    fresh = edges[middle < 0]
    middle[middle < 0] = nodes.add_between(fresh)
    return middle


def known_middles(lines: Mesh) -> IntArray:
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


def complete(mesh: Mesh) -> Mesh:
    """Each cell replaced by the complete quadratic one; a common face gets one node only."""
    whole = quadratic(mesh)
    todo = [b for b in whole.blocks if b.cell_type in COMPLETE]
    faces = [_corners_of_faces(b) for b in todo]
    flat = [f.reshape(-1, f.shape[-1]) for f in faces]
    corners = np.concatenate(flat) if flat else np.empty((0, 4), dtype=np.int64)
    unique, which = np.unique(corners, axis=0, return_inverse=True)
    made = mesh.nodes.add_between(unique)[which.ravel()]
    parts, start = [], 0
    for block in whole.blocks:
        if block.cell_type not in COMPLETE:
            parts.append(block)
            continue
        count = CELL_TYPES[COMPLETE[block.cell_type]].n_nodes - block.kind.n_nodes - 1
        middles = made[start : start + count * len(block)].reshape(len(block), count)
        start += count * len(block)
        centre = mesh.nodes.add_between(block.connectivity[:, list(block.kind.corners)])
        table = np.column_stack([block.connectivity, middles, centre])
        parts.append(CellBlock.make(mesh.nodes, COMPLETE[block.cell_type], table, block.colours))
    return union(*(Mesh(mesh.nodes, (b,)) for b in parts), as_given=True) if parts else mesh


def _corners_of_faces(block: CellBlock) -> IntArray:
    """Corners (n_cells, n_faces, 4) of the faces of volumes, sorted, -1 where there are three."""
    if block.kind.dimension < 3:
        return np.empty((len(block), 0, 4), dtype=np.int64)
    table = np.full((len(block), len(block.kind.faces), 4), -1, dtype=np.int64)
    for i, (_, local) in enumerate(block.kind.faces):
        places = list(local[::2])
        table[:, i, : len(places)] = block.connectivity[:, places]
    return np.sort(table, axis=-1)


Places = list[tuple[int, ...]]


def taken_apart(block: CellBlock, target: str) -> Mesh:
    """Linear cells on all nodes of complete cells.

    TET4, PYR5 stand on the triangles, quadrangles between a corner, the middles beside it and
    those of the faces, with the middle of the cell as apex; a CUB8 fills each corner. Plane cells
    become the triangles or quadrangles that such volumes would have on them.

    Raises
    ------
    MeshError
        If the cells cannot be taken apart into that type.
    """
    kind = block.kind
    rule = _RULES.get((target, kind.dimension))
    places = rule(kind) if rule is not None else []
    if not places:
        raise MeshError("kernel.mesh.cells-type-cannot-changed", name=kind.name, target=target)
    table = block.connectivity[:, places].reshape(-1, len(places[0]))
    name = CELL_TYPES[target].name if kind.dimension == 3 else _FLAT[target]
    return Mesh.of(block.nodes, name, table, np.repeat(block.colours, len(places)))


_FLAT = {"TRI3": "TRI3", "QUA4": "QUA4", "TET4": "TRI3", "PYR5": "QUA4", "CUB8": "QUA4"}


def _triangles_on(face: tuple[int, ...]) -> Places:
    """The triangles of a complete face, oriented as it is."""
    *ring, centre = face
    return [(a, b, centre) for a, b in zip(ring, [*ring[1:], ring[0]], strict=True)]


def _quadrangles_on(face: tuple[int, ...]) -> Places:
    """The quadrangle at each corner of a complete face, from the corner, oriented as it is."""
    *ring, centre = face
    return [(ring[k], ring[k + 1], centre, ring[k - 1]) for k in range(0, len(ring), 2)]


def _tetrahedra(kind: CellType) -> Places:
    centre = kind.n_nodes - 1
    return [(b, a, c, centre) for _, face in kind.faces for a, b, c in _triangles_on(face)]


def _pyramids(kind: CellType) -> Places:
    centre = kind.n_nodes - 1
    return [(a, d, c, b, centre) for _, face in kind.faces for a, b, c, d in _quadrangles_on(face)]


def _bricks(kind: CellType) -> Places:
    """One brick a corner, of cells three faces of which meet at each corner; else none."""
    quads = [quad for _, face in kind.faces for quad in _quadrangles_on(face)]
    bricks: Places = []
    for corner in kind.corners:
        mine = [quad for quad in quads if quad[0] == corner]
        if len(mine) != 3:
            return []
        (_, first, below, last), *others = mine
        # of the two other faces at the corner one holds `first`, one `last`; both the third edge
        side = {
            middle: face for _, a, face, b in others for middle in (a, b) if middle in (first, last)
        }
        (third,) = {m for _, a, _, b in others for m in (a, b)} - {first, last}
        top = (third, side[last], kind.n_nodes - 1, side[first])
        bricks.append((corner, last, below, first, *top))
    return bricks


def _itself(kind: CellType) -> tuple[int, ...]:
    return tuple(range(kind.n_nodes))


_RULES: dict[tuple[str, int], Callable[[CellType], Places]] = {
    ("TRI3", 2): lambda kind: _triangles_on(_itself(kind)),
    ("TET4", 2): lambda kind: _triangles_on(_itself(kind)),
    ("QUA4", 2): lambda kind: _quadrangles_on(_itself(kind)),
    ("PYR5", 2): lambda kind: _quadrangles_on(_itself(kind)),
    ("CUB8", 2): lambda kind: _quadrangles_on(_itself(kind)),
    ("TET4", 3): _tetrahedra,
    ("PYR5", 3): _pyramids,
    ("CUB8", 3): _bricks,
}
