"""Boundaries: contours of surfaces, envelopes of volumes, sharp edges."""

import math

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import BoolArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.combine import take
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def faces_of(mesh: Mesh, dimension: int) -> dict[str, tuple[IntArray, IntArray]]:
    """All faces of the cells of one dimension: type -> (connectivity, colours), with repeats."""
    found: dict[str, tuple[list[IntArray], list[IntArray]]] = {}
    for block in mesh.blocks:
        if block.kind.dimension != dimension or block.kind.joint:
            continue
        table = block.connectivity
        for name, local in block.kind.faces:
            tables, colours = found.setdefault(name, ([], []))
            tables.append(table[:, list(local)])
            colours.append(block.colours.astype(np.int64))
    return {k: (np.concatenate(t), np.concatenate(c)) for k, (t, c) in found.items()}


def sharing(table: IntArray) -> tuple[IntArray, IntArray]:
    """For faces (n, k): how many faces lie on the same nodes, and a group number, both (n,)."""
    _, group, counts = np.unique(
        np.sort(table, axis=1), axis=0, return_inverse=True, return_counts=True
    )
    group = group.ravel()
    return counts[group], group


def faces_inside(faces: Mesh, mesh: Mesh) -> int:
    """How many of some faces have cells of the mesh on both sides."""
    count = 0
    for block in faces.blocks:
        own = block.connectivity
        known, _ = faces_of(mesh, block.kind.dimension + 1).get(block.cell_type, (own[:0], own))
        together, _ = sharing(np.concatenate([known, own]))
        count += int((together[len(known) :] - sharing(own)[0] > 1).sum())
    return count


_MANY = 2**31


def contour(mesh: Mesh) -> Mesh:
    """Edges of surface cells that belong to one cell only, walked along end to end.

    The walk starts at the first corner met (of all cells the first corners, then the second ones),
    and its first edge keeps the sense of its cell: the loop follows it, whatever way the others
    are described.
    """
    return _walked(mesh, (1, 1))


def _walked(mesh: Mesh, shared: tuple[int, int]) -> Mesh:
    """Edges that as many surface cells have, in the order and sense of a walk along them."""
    edges, corners, colours = _edges_of_surfaces(mesh)
    counts, group = sharing(edges)
    keep = np.flatnonzero((counts >= shared[0]) & (counts <= shared[1]))
    keep = keep[np.sort(np.unique(group[keep], return_index=True)[1])]
    order, turned = _walk(edges[keep][:, [0, 2]], corners)
    found = np.where(turned[:, None], edges[keep][order][:, ::-1], edges[keep][order])
    shades, plain = colours[keep][order], found[:, 1] < 0
    parts = (("SEG2", plain, [0, 2]), ("SEG3", ~plain, [0, 1, 2]))
    blocks = [
        CellBlock.make(mesh.nodes, name, found[some][:, columns], shades[some])
        for name, some, columns in parts
        if some.any()
    ]
    return Mesh(mesh.nodes, tuple(blocks))


def _edges_of_surfaces(mesh: Mesh) -> tuple[IntArray, IntArray, NDArray[np.int8]]:
    """Edges (start, middle or -1, end) cell by cell, their corners as met, their colours."""
    edges, corners, colours = [], [], []
    for block in mesh.blocks:
        if block.kind.dimension != 2 or block.kind.joint:
            continue
        sides = np.array([local for _, local in block.kind.faces])
        if sides.shape[1] == 2:
            rows = np.insert(block.connectivity[:, sides], 1, -1, axis=2)
        else:
            rows = block.connectivity[:, sides]
        edges.append(rows.reshape(-1, 3))
        corners.append(block.connectivity[:, list(block.kind.corners)].T.ravel())
        colours.append(np.repeat(block.colours, len(sides)))
    if not edges:
        return np.empty((0, 3), np.int64), np.empty(0, np.int64), np.empty(0, np.int8)
    return np.concatenate(edges), np.concatenate(corners), np.concatenate(colours)


def _walk(ends: IntArray, corners: IntArray) -> tuple[IntArray, BoolArray]:
    """Edges (n, 2) in the order of a walk, and which of them it goes backwards.

    Parameters
    ----------
    ends : array (n, 2)
    corners : array (m,)
        Nodes, repeats allowed, in the order in which walks start.
    """
    at_node: dict[int, list[int]] = {}
    for i, pair in enumerate(ends.tolist()):
        for node in pair:
            at_node.setdefault(node, []).append(i)
    rows = ends.tolist()
    met = [c for c in dict.fromkeys(corners.tolist()) if c in at_node]
    heads = [c for c in met if len(at_node[c]) == 1 and rows[at_node[c][0]][0] == c]
    used, order, turned = [False] * len(rows), [], []
    for here in [*heads, *met]:
        first = True
        while left := [i for i in at_node[here] if not used[i]]:
            i = left[0]
            used[i] = True
            order.append(i)
            backwards = rows[i][0] != here
            stays = first and backwards and len(left) > 1  # enters the start, where the walk goes on
            turned.append(backwards and not stays)
            if not stays:
                here = rows[i][0] if backwards else rows[i][1]
            first = False
    return np.array(order, dtype=np.int64), np.array(turned, dtype=bool)


def in_one_sense(cells: IntArray) -> IntArray:
    """Cells of closed loops, all turned the way of the first of their loop."""
    at_node: dict[int, list[int]] = {}
    for i, (a, b) in enumerate(cells[:, [0, -1]].tolist()):
        at_node.setdefault(a, []).append(i)
        at_node.setdefault(b, []).append(i)
    turned = cells.copy()
    waiting = set(range(len(cells)))
    while waiting:
        i = min(waiting)
        while i in waiting:
            waiting.discard(i)
            end = int(turned[i, -1])
            i = next(j for j in at_node[end] if j != i)
            if i in waiting and turned[i, 0] != end:
                turned[i] = turned[i, ::-1]
    return turned


def inner_contour(mesh: Mesh) -> Mesh:
    """Edges where three or more surface cells meet."""
    return _walked(mesh, (3, _MANY))


def envelope(mesh: Mesh) -> Mesh:
    """Faces of volume cells that belong to one cell only, oriented as the cells' faces are."""
    blocks = []
    for name, (table, colours) in faces_of(mesh, 3).items():
        keep = np.flatnonzero(sharing(table)[0] == 1)
        if len(keep):
            blocks.append(
                CellBlock.make(mesh.nodes, name, table[keep], colours[keep].astype(np.int8))
            )
    return Mesh(mesh.nodes, tuple(blocks))


def lone_surfaces(mesh: Mesh) -> Mesh:
    """Surface cells whose nodes no other surface cell of the same type shares."""
    blocks = (b for b in mesh.blocks if b.kind.dimension == 2 and not b.kind.joint)
    flat = Mesh(mesh.nodes, tuple(blocks))
    return take(flat, lambda b: sharing(b.connectivity)[0] == 1)


def chained(mesh: Mesh) -> Mesh:
    """A mesh of SEG2 or SEG3 with the cells put end to end, closed loops one after the other.

    The sense of the cells is kept; the first loop starts with the first cell. Open pieces start
    at a node where no cell ends.
    """
    blocks = tuple(_chain_block(b) for b in mesh.blocks)
    return Mesh(mesh.nodes, blocks, mesh.sides)


def _chain_block(block: CellBlock) -> CellBlock:
    table = block.connectivity
    leaving: dict[int, list[int]] = {}
    for i, node in enumerate(table[:, 0].tolist()):
        leaving.setdefault(node, []).append(i)
    for cells in leaving.values():
        cells.reverse()
    ends = set(table[:, -1].tolist())
    heads = [i for i, node in enumerate(table[:, 0].tolist()) if node not in ends]
    used = np.zeros(len(table), dtype=bool)
    order: list[int] = []
    for first in [*heads, *range(len(table))]:
        cell = first
        while cell >= 0 and not used[cell]:
            used[cell] = True
            order.append(cell)
            following = leaving.get(int(table[cell, -1]), [])
            while following and used[following[-1]]:
                following.pop()
            cell = following[-1] if following else -1
    return CellBlock.make(block.nodes, block.cell_type, table[order], block.colours[order])


def edges(mesh: Mesh) -> Mesh:
    """All edges of the cells, each once, as SEG2 or SEG3 (lines themselves included)."""
    tables: dict[str, list[IntArray]] = {}
    skin = faces_of(mesh, 3)
    flat = [(k, t) for k, (t, _) in faces_of(mesh, 2).items()]
    surfaces = Mesh(
        mesh.nodes, tuple(CellBlock.make(mesh.nodes, k, t) for k, (t, _) in skin.items())
    )
    flat += [(k, t) for k, (t, _) in faces_of(surfaces, 2).items()]
    flat += [(b.cell_type, b.connectivity) for b in mesh.blocks if b.cell_type[:3] == "SEG"]
    for name, table in flat:
        tables.setdefault(name, []).append(table)
    return _each_once(mesh.nodes, tables)


def faces(mesh: Mesh) -> Mesh:
    """All faces of volume cells, each once, and the surface cells themselves."""
    tables: dict[str, list[IntArray]] = {k: [t] for k, (t, _) in faces_of(mesh, 3).items()}
    for block in mesh.blocks:
        if block.kind.dimension == 2 and not block.kind.joint:
            tables.setdefault(block.cell_type, []).append(block.connectivity)
    return _each_once(mesh.nodes, tables)


def _each_once(nodes: NodeTable, tables: dict[str, list[IntArray]]) -> Mesh:
    """Cells of tables by type, those with the same nodes once, in order of their first."""
    blocks = []
    for name, parts in tables.items():
        table = np.concatenate(parts)
        _, first = np.unique(np.sort(table, axis=1), axis=0, return_index=True)
        blocks.append(CellBlock.make(nodes, name, table[np.sort(first)]))
    return Mesh(nodes, tuple(blocks))


def sharp_edges(mesh: Mesh, angle: float = 20.0) -> Mesh:
    """Edges, as SEG2, where the skin turns by more than `angle` degrees, or where it ends.

    The skin is the envelope of the volume cells and the surface cells. Quadratic edges give two
    SEG2.

    Raises
    ------
    MeshError
        If the mesh has neither volumes nor surfaces.
    """
    skin = envelope(mesh)
    own = tuple(b for b in mesh.blocks if b.kind.dimension == 2 and not b.kind.joint)
    skin = Mesh(mesh.nodes, skin.blocks + own)
    if not skin.blocks:
        raise MeshError("kernel.mesh.edges-sought-volumes-surfaces")
    rows, normals, middles = _skin_edges(skin)
    _, group = sharing(rows)
    total = np.zeros((group.max() + 1, 3))
    np.add.at(total, group, normals)
    n_faces = np.zeros(group.max() + 1)
    np.add.at(n_faces, group, 1.0)
    # |n1 + n2| = 2 cos(half the angle between them)
    bend = np.linalg.norm(total, axis=1) < 2.0 * math.cos(math.radians(angle) / 2)
    sharp = (bend & (n_faces == 2)) | (n_faces != 2)
    keep = np.flatnonzero(sharp[group])
    keep = keep[np.sort(np.unique(group[keep], return_index=True)[1])]
    plain = rows[keep][middles[keep] < 0]
    curved, mid = rows[keep][middles[keep] >= 0], middles[keep][middles[keep] >= 0]
    halves = np.concatenate(
        [np.column_stack([curved[:, 0], mid]), np.column_stack([mid, curved[:, 1]])]
    )
    table = np.concatenate([plain, halves])
    return Mesh.of(mesh.nodes, "SEG2", table) if len(table) else Mesh(mesh.nodes, ())


def _skin_edges(skin: Mesh) -> tuple[IntArray, np.ndarray, IntArray]:
    """End nodes (n, 2), unit normals of the face (n, 3) and middle node or -1 (n,) of all edges."""
    rows, normals, middles = [], [], []
    for block in skin.blocks:
        corners = block.coordinates[:, list(block.kind.corners)]
        rays = corners - corners[:, :1]
        area = np.cross(rays[:, 1:-1], rays[:, 2:]).sum(axis=1)
        unit = area / np.maximum(np.linalg.norm(area, axis=1), 1e-300)[:, None]
        for _, face in block.kind.faces:
            rows.append(block.connectivity[:, [face[0], face[-1]]])
            normals.append(unit)
            middle = block.connectivity[:, face[1]] if len(face) == 3 else None
            middles.append(np.full(len(block), -1) if middle is None else middle)
    return np.concatenate(rows), np.concatenate(normals), np.concatenate(middles)
