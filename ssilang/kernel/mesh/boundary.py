"""Boundaries: contours of surfaces, envelopes of volumes, sharp edges."""

import math

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.combine import take
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import surface_normals


def faces_of(mesh: Mesh, dimension: int) -> dict[str, tuple[IntArray, IntArray]]:
    """All faces of the cells of one dimension: type -> (connectivity, colours), with repeats."""
    found: dict[str, tuple[list[IntArray], list[IntArray]]] = {}
    for block in mesh.blocks_of(dimension):
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


def contour(mesh: Mesh, shared: tuple[float, float] = (1, 1)) -> Mesh:
    """Edges of surface cells that belong to one cell only, walked along end to end.

    `shared` says how many cells they belong to, at least and at most, where it is not one.

    The walk starts at the first corner met (of all cells the first corners, then the second ones),
    and its first edge keeps the sense of its cell: the loop follows it, whatever way the others
    are described.
    """
    edges, corners, colours = _edges_of_surfaces(mesh)
    counts, group = sharing(edges)
    keep = np.flatnonzero((counts >= shared[0]) & (counts <= shared[1]))
    keep = keep[np.sort(np.unique(group[keep], return_index=True)[1])]
    starts, first = np.unique(corners, return_index=True)
    found, order = walked(edges[keep], starts[np.argsort(first)])
    shades, plain = colours[keep][order], found[:, 1] < 0
    straight = CellBlock.make(mesh.nodes, "SEG2", found[plain][:, [0, 2]], shades[plain])
    curved = CellBlock.make(mesh.nodes, "SEG3", found[~plain], shades[~plain])
    return Mesh(mesh.nodes, tuple(b for b in (straight, curved) if len(b)))


def _edges_of_surfaces(mesh: Mesh) -> tuple[IntArray, IntArray, NDArray[np.int8]]:
    """Edges (start, middle or -1, end) cell by cell, their corners as met, their colours."""
    edges, corners, colours = [], [], []
    for block in mesh.blocks_of(2):
        rows = block.connectivity[:, [local for _, local in block.kind.faces]]
        if rows.shape[2] == 2:
            rows = np.insert(rows, 1, -1, axis=2)
        edges.append(rows.reshape(-1, 3))
        corners.append(block.connectivity[:, list(block.kind.corners)].T.ravel())
        colours.append(np.repeat(block.colours, rows.shape[1]))
    if not edges:
        return np.empty((0, 3), np.int64), np.empty(0, np.int64), np.empty(0, np.int8)
    return np.concatenate(edges), np.concatenate(corners), np.concatenate(colours)


def walked(cells: IntArray, corners: IntArray, turning: bool = True) -> tuple[IntArray, IntArray]:
    """Lines' cells (n, k) end to end, turned as a walk along them goes, and their old places (n,).

    Parameters
    ----------
    corners : array (m,)
        Nodes in the order in which walks start; the ends from which an open line leaves come first.
    turning : bool
        False: the walk goes along cells in their own sense alone.
    """
    at_node: dict[int, list[int]] = {}
    rows = cells[:, [0, -1]].tolist()
    for i, pair in enumerate(rows):
        for node in pair if turning else pair[:1]:
            at_node.setdefault(node, []).append(i)
    met = [c for c in corners.tolist() if c in at_node]
    ends = {b for _, b in rows}
    heads = [c for c in met if c not in ends and (len(at_node[c]) == 1 or not turning)]
    used = [False] * len(rows)
    order: list[int] = []
    turned: list[bool] = []
    for here in [*heads, *met]:
        first = True
        while left := [i for i in at_node.get(here, ()) if not used[i]]:
            i = left[0]
            used[i] = True
            order.append(i)
            backwards = rows[i][0] != here
            stays = first and backwards and len(left) > 1  # enters the start, left by another
            turned.append(backwards and not stays)
            if not stays:
                here = rows[i][0] if backwards else rows[i][1]
            first = False
    found = cells[order]
    found[turned] = found[turned][:, ::-1]
    return found, np.array(order, dtype=np.int64)


def inner_contour(mesh: Mesh) -> Mesh:
    """Edges where three or more surface cells meet."""
    return contour(mesh, (3, np.inf))


def envelope(mesh: Mesh) -> Mesh:
    """Faces of volume cells that belong to one cell only, oriented as the cells' faces are."""
    return take(_all_faces(mesh), lambda b: sharing(b.connectivity)[0] == 1)


def _all_faces(mesh: Mesh) -> Mesh:
    """Faces of volume cells, those between two cells twice."""
    made = [
        CellBlock.make(mesh.nodes, name, table, colours.astype(np.int8))
        for name, (table, colours) in faces_of(mesh, 3).items()
    ]
    return Mesh(mesh.nodes, tuple(made))


def lone_cells(mesh: Mesh, dimension: int = 2) -> Mesh:
    """Surfaces, or lines or points, whose nodes no other cell of the same type shares."""
    flat = Mesh(mesh.nodes, mesh.blocks_of(dimension))
    return take(flat, lambda b: sharing(b.connectivity)[0] == 1)


def chained(mesh: Mesh) -> Mesh:
    """A mesh of SEG2 or SEG3 with the cells put end to end, closed loops one after the other.

    The sense of the cells is kept; the first loop starts with the first cell. Open pieces start
    at a node where no cell ends.
    """
    blocks = []
    for b in mesh.blocks:
        found, order = walked(b.connectivity, b.connectivity[:, 0], turning=False)
        blocks.append(CellBlock.make(b.nodes, b.cell_type, found, b.colours[order]))
    return Mesh(mesh.nodes, tuple(blocks), mesh.sides)


def edges(mesh: Mesh) -> Mesh:
    """All edges of the cells, each once, as SEG2 or SEG3 (lines themselves included)."""
    tables: dict[str, list[IntArray]] = {}
    flat = [(k, t) for m in (mesh, _all_faces(mesh)) for k, (t, _) in faces_of(m, 2).items()]
    flat += [(b.cell_type, b.connectivity) for b in mesh.blocks if b.cell_type[:3] == "SEG"]
    for name, table in flat:
        tables.setdefault(name, []).append(table)
    return _each_once(mesh.nodes, tables)


def faces(mesh: Mesh) -> Mesh:
    """All faces of volume cells, each once, and the surface cells themselves."""
    tables: dict[str, list[IntArray]] = {k: [t] for k, (t, _) in faces_of(mesh, 3).items()}
    for block in mesh.blocks_of(2):
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
    skin = Mesh(mesh.nodes, envelope(mesh).blocks + mesh.blocks_of(2))
    if not skin.blocks:
        raise MeshError("kernel.mesh.edges-sought-volumes-surfaces")
    rows, normals, middles = _skin_edges(skin)
    _, group = sharing(rows)
    total = np.zeros((group.max() + 1, 3))
    np.add.at(total, group, normals)
    n_faces = np.bincount(group)
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
        area = surface_normals(block)
        unit = area / np.maximum(np.linalg.norm(area, axis=1), 1e-300)[:, None]
        for _, face in block.kind.faces:
            rows.append(block.connectivity[:, [face[0], face[-1]]])
            normals.append(unit)
            middle = block.connectivity[:, face[1]] if len(face) == 3 else None
            middles.append(np.full(len(block), -1) if middle is None else middle)
    return np.concatenate(rows), np.concatenate(normals), np.concatenate(middles)
