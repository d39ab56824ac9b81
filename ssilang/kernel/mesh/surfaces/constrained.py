"""Triangles inside plane lines of which some end inside the domain or cut it in parts."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.surfaces.triangulate import delaunay_triangles, recover_segments


def is_closed(lines: Mesh) -> bool:
    """True if as many lines end at each node as a set of closed contours has: two."""
    cells = np.concatenate([b.connectivity[:, [0, -1]] for b in lines.blocks])
    _, times = np.unique(cells, return_counts=True)
    return bool((times == 2).all())


def triangulated_with_lines(lines: Mesh, dimension: int, colour: int = 0) -> Mesh:
    """TRI3 inside lines of SEG2, each of which is a side of triangles.

    Parameters
    ----------
    lines : Mesh
        Closed contours, with lines that hang from them, lie free inside or join two of their
        nodes. A contour inside another bounds a hole.
    dimension : int
        2: in the plane of the first two coordinates; 3: in the plane of the nodes.

    Raises
    ------
    MeshError
        If nothing is enclosed, the nodes are not in one plane or lines cross.
    """
    if any(b.cell_type != "SEG2" for b in lines.blocks):
        raise MeshError("kernel.mesh.lines-seg2-needed-triangulate")
    cells = np.concatenate([b.connectivity for b in lines.blocks])
    ids, local = np.unique(cells, return_inverse=True)
    segments = local.reshape(cells.shape).astype(np.int64)
    points = _flat(lines.nodes.coordinates[ids], dimension)
    triangles = recover_segments(points, delaunay_triangles(points), segments)
    inside = _enclosed(triangles, segments, len(ids))
    if not inside.any():
        raise MeshError("kernel.mesh.lines-enclose-nothing")
    return Mesh.of(lines.nodes, "TRI3", ids[triangles[inside]], colour)


def _flat(at: FloatArray, dimension: int) -> FloatArray:
    if dimension == 2:
        return at[:, :2].copy()
    centred = at - at.mean(axis=0)
    _, _, axes = np.linalg.svd(centred, full_matrices=False)
    extent = float(np.ptp(at, axis=0).max())
    off = float(np.abs(centred @ axes[2]).max())
    if off > 1e-3 * extent:
        raise MeshError("kernel.mesh.lines-not-plane-point", off=off)
    flat: FloatArray = centred @ axes[:2].T
    return flat


def _enclosed(triangles: IntArray, segments: IntArray, n: int) -> NDArray[np.bool_]:
    """Triangles in parts that an odd number of lines, the fewest, divides from the outside."""
    from scipy.sparse.csgraph import shortest_path

    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2) @ [n, 1]
    walls = np.sort(segments, axis=1) @ [n, 1]
    owner = np.repeat(np.arange(len(triangles)), 3)
    order = np.argsort(sides.ravel(), kind="stable")
    keys, owner = sides.ravel()[order], owner[order]
    pair = np.flatnonzero(keys[:-1] == keys[1:])
    first, second, key = owner[pair], owner[pair + 1], keys[pair]
    open_side = ~np.isin(key, walls)
    part = parts_of(len(triangles), (first[open_side], second[open_side]))
    n_parts = int(part.max()) + 1
    alone = np.ones(len(keys), dtype=bool)
    alone[pair] = alone[pair + 1] = False
    rim = part[owner[alone]]
    walled = np.isin(keys[alone], walls)
    # graph of parts across walls; number n_parts is the outside
    a = np.concatenate([part[first[~open_side]], rim])
    b = np.concatenate([part[second[~open_side]], np.full(len(rim), n_parts)])
    cost = np.concatenate([np.ones((~open_side).sum()), np.where(walled, 1.0, 1e-6)])
    kept = a != b
    graph = np.full((n_parts + 1, n_parts + 1), np.inf)
    np.minimum.at(graph, (a[kept], b[kept]), cost[kept])
    steps = shortest_path(graph, directed=False, indices=n_parts)
    inside: NDArray[np.bool_] = np.round(steps[part]) % 2 == 1
    return inside
