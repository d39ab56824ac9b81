"""Complete quadratic cells (TRI7, QUA9, TE15, PR21, CU27) and the linear cells inside them."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.errors import MeshError
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.degree import quadratic
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import IntArray, NodeTable

COMPLETE = {"TRI6": "TRI7", "QUA8": "QUA9", "TE10": "TE15", "PR15": "PR21", "CU20": "CU27"}


def complete(mesh: Mesh) -> Mesh:
    """Each cell replaced by the complete quadratic one; a common face gets one node only."""
    whole = quadratic(mesh)
    todo = [b for b in whole.blocks if b.cell_type in COMPLETE]
    faces = [_corners_of_faces(b) for b in todo]
    flat = [f.reshape(-1, f.shape[-1]) for f in faces]
    corners = np.concatenate(flat) if flat else np.empty((0, 4), dtype=np.int64)
    unique, which = np.unique(corners, axis=0, return_inverse=True)
    made = _middles(mesh.nodes, unique)[which.ravel()]
    parts, start = [], 0
    for block in whole.blocks:
        if block.cell_type not in COMPLETE:
            parts.append(block)
            continue
        count = CELL_TYPES[COMPLETE[block.cell_type]].n_nodes - block.kind.n_nodes - 1
        middles = made[start : start + count * len(block)].reshape(len(block), count)
        start += count * len(block)
        centre = _middles(mesh.nodes, block.connectivity[:, list(block.kind.corners)])
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


def _middles(nodes: NodeTable, corners: IntArray) -> IntArray:
    """New nodes in the middle of corners (m, k), -1 standing for none."""
    there = (corners >= 0)[..., None]
    count = there.sum(axis=1)
    xyz = (nodes.coordinates[corners] * there).sum(axis=1) / count
    size = (nodes.density[corners][..., None] * there).sum(axis=1) / count
    return nodes.add(xyz, size[:, 0]) if len(corners) else np.empty(0, dtype=np.int64)


def taken_apart(block: CellBlock, target: str) -> Mesh:
    """Linear cells on all nodes of complete cells: simplices (6 in TRI7, 48 in CU27), QUA4, CUB8.

    Raises
    ------
    MeshError
        If the cells cannot be taken apart into that type.
    """
    kind = block.kind
    if target in ("TRI3", "QUA4") and kind.dimension == 2:
        places = _triangles(2 * len(kind.corners)) if target == "TRI3" else _quadrangles(kind.name)
    elif target == "TET4" and kind.dimension == 3:
        places = _tetrahedra(kind.name)
    elif target == "CUB8" and kind.name == "CU27":
        places = _BRICKS
    else:
        raise MeshError(f"cells of type {kind.name} cannot be changed into {target}")
    table = block.connectivity[:, places].reshape(-1, len(places[0]))
    return Mesh.of(block.nodes, target, table, np.repeat(block.colours, len(places)))


def _triangles(around: int) -> list[tuple[int, ...]]:
    return [(k, (k + 1) % around, around) for k in range(around)]


def _quadrangles(name: str) -> list[tuple[int, ...]]:
    if name != "QUA9":
        raise MeshError(f"cells of type {name} cannot be changed into QUA4")
    return [(k, k + 1, 8, (k - 1) % 8) for k in (0, 2, 4, 6)]


def _tetrahedra(name: str) -> list[tuple[int, ...]]:
    kind = CELL_TYPES[name]
    centre = kind.n_nodes - 1
    return [
        (face[b], face[a], face[c], centre)
        for _, face in kind.faces
        for a, b, c in _triangles(len(face) - 1)
    ]


def _bricks() -> list[tuple[int, ...]]:
    """The eight bricks of a CU27: corner, middles of edges and faces, centre of each eighth."""
    grid = [(x, y, z) for z in (0, 2) for x, y in ((0, 0), (2, 0), (2, 2), (0, 2))]
    kind = CELL_TYPES["CU27"]
    place = {c: local for local, c in zip(kind.corners, grid, strict=True)}
    at = {local: c for c, local in place.items()}
    for _, face in kind.faces:
        for k in range(1, 8, 2):
            a, b = at[face[k - 1]], at[face[(k + 1) % 8]]
            place[tuple((np.add(a, b) // 2).tolist())] = face[k]
        a, b = at[face[0]], at[face[4]]
        place[tuple((np.add(a, b) // 2).tolist())] = face[8]
    place[1, 1, 1] = 26
    ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
    return [
        tuple(place[x + i, y + j, z + k] for k in (0, 1) for i, j in ring)
        for z in (0, 1)
        for y in (0, 1)
        for x in (0, 1)
    ]


_BRICKS = _bricks()
