"""What is wrong with a mesh: repeated cells, neighbours of other degrees, faces that do not fit."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.mesh.changes.degree import middle_places
from ssilang.kernel.mesh.combine import cell_keys, poi1, take
from ssilang.kernel.mesh.mesh import CellBlock, Mesh


def repeated_cells(mesh: Mesh) -> Mesh:
    """Cells that stand on the nodes of an earlier cell of their type."""

    def again(block: CellBlock) -> IntArray:
        first = np.unique(cell_keys(block), return_index=True)[1]
        return np.setdiff1d(np.arange(len(block)), first)

    return take(mesh, again)


def unmatched_middles(mesh: Mesh) -> Mesh:
    """Middles of quadratic cells on edges that linear cells have too, as POI1."""
    straight = [np.empty((0, 2), dtype=np.int64)]
    bent = [np.empty((0, 3), dtype=np.int64)]
    for block in mesh.blocks:
        table = block.connectivity
        if block.kind.degree == 2 and not block.kind.joint:
            for middle, a, b in middle_places(block.cell_type):
                ends = np.sort(table[:, [a, b]], axis=1)
                bent.append(np.column_stack([ends, table[:, middle]]))
        elif block.kind.dimension == 1:
            straight.append(table)
        elif block.kind.dimension > 1:
            for _, face in block.kind.faces:
                ring = (
                    [face] if len(face) == 2 else list(zip(face, face[1:] + face[:1], strict=True))
                )
                straight += [table[:, list(pair)] for pair in ring]
    edges = np.unique(np.sort(np.concatenate(straight), axis=1), axis=0)
    middles = np.unique(np.concatenate(bent), axis=0)
    size = len(mesh.nodes)
    met = np.isin(middles[:, 0] * size + middles[:, 1], edges[:, 0] * size + edges[:, 1])
    return poi1(mesh.nodes, middles[met, 2])


def unfit_faces(mesh: Mesh) -> Mesh:
    """Triangular faces of volumes whose corners all belong to a quadrangular face of another."""
    faces: dict[int, list[IntArray]] = {3: [], 4: []}
    for block in mesh.blocks:
        if block.kind.dimension == 3:
            for kind, face in block.kind.faces:
                corners = list(face[:: 1 if kind in ("TRI3", "QUA4") else 2])
                corners = corners[: 3 if kind.startswith("TRI") else 4]
                faces[len(corners)].append(block.connectivity[:, corners])
    if not faces[3] or not faces[4]:
        return Mesh(mesh.nodes, ())
    triangles, quads = np.concatenate(faces[3]), np.concatenate(faces[4])
    halves = np.concatenate([np.delete(quads, k, axis=1) for k in range(4)])
    block = CellBlock.make(mesh.nodes, "TRI3", triangles)
    within = np.isin(cell_keys(block), cell_keys(CellBlock.make(mesh.nodes, "TRI3", halves)))
    return take(Mesh(mesh.nodes, (block,)), lambda _: within)
