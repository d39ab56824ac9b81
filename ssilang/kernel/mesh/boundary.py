"""Boundaries: contours of surfaces, envelopes of volumes, sharp edges."""

import math

import numpy as np

from ssilang.kernel.base.arrays import IntArray
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


def _boundary(mesh: Mesh, dimension: int, shared: tuple[int, int]) -> Mesh:
    blocks = []
    for name, (table, colours) in faces_of(mesh, dimension).items():
        counts, group = sharing(table)
        keep = np.flatnonzero((counts >= shared[0]) & (counts <= shared[1]))
        _, first = np.unique(group[keep], return_index=True)
        keep = keep[np.sort(first)]
        if len(keep):
            blocks.append(
                CellBlock.make(mesh.nodes, name, table[keep], colours[keep].astype(np.int8))
            )
    return Mesh(mesh.nodes, tuple(blocks))


_MANY = 2**31


def contour(mesh: Mesh) -> Mesh:
    """Edges of surface cells that belong to one cell only, in the cells' own order.

    Where cells of both senses meet, closed loops all run the way of their first edge.
    """
    found = _boundary(mesh, 2, (1, 1))
    blocks = []
    for block in found.blocks:
        table = block.connectivity
        _, times = np.unique(table[:, [0, -1]], return_counts=True)
        mixed = not np.array_equal(np.sort(table[:, 0]), np.sort(table[:, -1]))
        if mixed and (times == 2).all():
            turned = in_one_sense(table)
            block = CellBlock.make(mesh.nodes, block.cell_type, turned, block.colours)
        blocks.append(block)
    return Mesh(mesh.nodes, tuple(blocks))


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
    return _boundary(mesh, 2, (3, _MANY))


def envelope(mesh: Mesh) -> Mesh:
    """Faces of volume cells that belong to one cell only, oriented as the cells' faces are."""
    return _boundary(mesh, 3, (1, 1))


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
