"""Shape of cells by coordinates (n_cells, n_nodes, dim) of their nodes: indicators, heights.

What is wrong with a mesh: repeated cells, neighbours of other degrees, faces that do not fit.
"""

from itertools import combinations
from math import factorial

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.changes.degree import known_middles
from ssilang.kernel.mesh.combine import cell_keys, poi1, take
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

TINY = 1e-300


def _simplex_measure(corners: FloatArray, metric: FloatArray | None = None) -> FloatArray:
    """Length, area or volume (n,) of simplices (n, k + 1, dim), by the Gram determinant."""
    edges = corners[:, 1:] - corners[:, :1]
    long = edges if metric is None else edges @ metric
    gram = np.linalg.det(long @ np.swapaxes(edges, 1, 2))
    return np.asarray(np.sqrt(np.maximum(gram, 0.0)) / factorial(edges.shape[1]))


def _edges(corners: FloatArray) -> FloatArray:
    pairs = combinations(range(corners.shape[1]), 2)
    return np.stack([np.linalg.norm(corners[:, i] - corners[:, j], axis=1) for i, j in pairs], 1)


def aspect_ratio(corners: FloatArray) -> FloatArray:
    """Longest edge over shortest height, 1 for an equilateral simplex; infinite without measure."""
    k = corners.shape[1] - 1
    measure = _simplex_measure(corners)
    sides = [np.delete(corners, i, axis=1) for i in range(k + 1)]
    base = np.max([_simplex_measure(s) for s in sides], axis=0)
    height = k * measure / np.maximum(base, TINY)
    regular = np.sqrt((k + 1) / (2.0 * k))  # height of the regular simplex of edge one
    with np.errstate(divide="ignore"):
        return np.asarray(regular * _edges(corners).max(axis=1) / height)


def skewness(corners: FloatArray) -> FloatArray:
    """Lacking share of the measure of the regular simplex of the same circumscribed sphere."""
    k = corners.shape[1] - 1
    edges = corners[:, 1:] - corners[:, :1]
    gram = edges @ np.swapaxes(edges, 1, 2)
    flat = np.linalg.det(gram) <= 1e-14 * np.abs(gram).max(axis=(1, 2)) ** k
    safe = np.where(flat[:, None, None], np.eye(k), gram)
    # the centre c = sum s_i e_i has 2 c . e_j = |e_j|^2
    share = np.linalg.solve(2.0 * safe, np.einsum("nii->ni", safe)[..., None])[..., 0]
    radius2 = np.einsum("ni,nij,nj->n", share, safe, share)
    side2 = radius2 * 2.0 * (k + 1) / k  # edge of the regular simplex in that sphere
    regular = np.sqrt((k + 1) / 2.0**k) / factorial(k)
    best = regular * side2 ** (k / 2.0)
    return np.where(flat, 1.0, np.clip((best - _simplex_measure(corners)) / best, 0.0, 1.0))


def flatness(corners: FloatArray) -> FloatArray:
    """100 for a plane quadrangle, less in proportion to the angle of its normals at two corners."""
    x = np.zeros((*corners.shape[:2], 3))
    x[..., : corners.shape[2]] = corners
    one = np.cross(x[:, 1] - x[:, 0], x[:, 3] - x[:, 0])
    two = np.cross(x[:, 3] - x[:, 2], x[:, 1] - x[:, 2])
    size = np.linalg.norm(one, axis=1) * np.linalg.norm(two, axis=1)
    cosine = np.einsum("nd,nd->n", one, two) / np.maximum(size, TINY)
    return np.asarray(100.0 * (1.0 - np.arccos(np.clip(cosine, -1.0, 1.0)) / np.pi))


def quality_in_metric(corners: FloatArray, metric: FloatArray | None) -> FloatArray:
    """Quality (n,) of simplices from 0 (no measure) to 1 (equilateral, edges of the length 1).

    The shape counts by the mean ratio (measure to the power 2 / d over the mean square of the
    edges, 1 for an equilateral cell: Liu and Joe, BIT 34, 1994), its size s (root of the mean
    square of the edges) by the smaller of s and 1 / s; without metric the size does not count.

    Parameters
    ----------
    corners : array (n, d + 1, dim)
    metric : array (n, dim, dim) or None
        Edges e have the length sqrt(e M e).
    """
    d = corners.shape[1] - 1
    measure = _simplex_measure(corners, metric)
    pairs = combinations(range(d + 1), 2)
    edges = np.stack([corners[:, j] - corners[:, i] for i, j in pairs], axis=1)
    long = edges if metric is None else edges @ metric
    square = (long * edges).sum(axis=2).mean(axis=1)
    unit = np.sqrt(d + 1.0) / (factorial(d) * np.sqrt(2.0) ** d)  # equilateral of edge 1
    shape = (measure / unit) ** (2.0 / d) / np.maximum(square, TINY)
    if metric is None:
        return np.asarray(shape)
    size = np.sqrt(square)
    return np.asarray(shape * np.minimum(size, 1.0 / np.maximum(size, TINY)))


def smallest_lengths(block: CellBlock) -> FloatArray:
    """Smallest length (n_cells,) of each cell: line, surface or volume.

    The least of the distances between two nodes, and from a node to the line or plane of a side
    that does not hold it (the mean plane of a side of four corners).
    """
    x = block.coordinates
    found = [_edges(x).min(axis=1)]
    for name, local in block.kind.faces if block.kind.dimension > 1 else ():
        corners = [local[k] for k in CELL_TYPES[name].corners]
        others = [k for k in range(x.shape[1]) if k not in local]
        if block.kind.dimension == 2:
            found += [_to_line(x[:, k], x[:, corners[0]], x[:, corners[1]]) for k in others]
        else:
            found += [_to_plane(x[:, k], x[:, corners]) for k in others]
    return np.min(found, axis=0)


def _to_line(p: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    along = (b - a) / np.linalg.norm(b - a, axis=-1)[:, None]
    across = (p - a) - ((p - a) * along).sum(axis=-1)[:, None] * along
    return np.asarray(np.linalg.norm(across, axis=-1))


def _to_plane(p: FloatArray, corners: FloatArray) -> FloatArray:
    """Distances (n,) of points (n, 3) to the mean planes of faces (n, k, 3)."""
    middle = corners.mean(axis=1)
    turning = corners - middle[:, None]
    normal = np.cross(turning, np.roll(turning, -1, axis=1)).sum(axis=1)
    unit = normal / np.linalg.norm(normal, axis=-1)[:, None]
    return np.asarray(np.abs(((p - middle) * unit).sum(axis=-1)))


def repeated_cells(mesh: Mesh) -> Mesh:
    """Cells that stand on the nodes of an earlier cell of their type."""

    def again(block: CellBlock) -> IntArray:
        first = np.unique(cell_keys(block), return_index=True)[1]
        return np.setdiff1d(np.arange(len(block)), first)

    return take(mesh, again)


def unmatched_middles(mesh: Mesh) -> Mesh:
    """Middles of quadratic cells on edges that linear cells have too, as POI1."""
    straight = [np.empty((0, 2), dtype=np.int64)]
    for block in mesh.blocks:
        table = block.connectivity
        if block.kind.degree == 2 and not block.kind.joint:
            continue
        if block.kind.dimension == 1:
            straight.append(table)
        elif block.kind.dimension > 1:
            for _, face in block.kind.faces:
                ring = (
                    [face] if len(face) == 2 else list(zip(face, face[1:] + face[:1], strict=True))
                )
                straight += [table[:, list(pair)] for pair in ring]
    edges = np.unique(np.sort(np.concatenate(straight), axis=1), axis=0)
    middles = np.unique(known_middles(mesh), axis=0)
    size = len(mesh.nodes)
    met = np.isin(middles[:, 0] * size + middles[:, 1], edges[:, 0] * size + edges[:, 1])
    return poi1(mesh.nodes, middles[met, 2])


def unfit_faces(mesh: Mesh) -> Mesh:
    """Triangular faces of volumes whose corners all belong to a quadrangular face of another."""
    faces: dict[int, list[IntArray]] = {3: [], 4: []}
    for block in mesh.blocks:
        if block.kind.dimension == 3:
            for kind, face in block.kind.faces:
                corners = [face[k] for k in CELL_TYPES[kind].corners]
                faces[len(corners)].append(block.connectivity[:, corners])
    if not faces[3] or not faces[4]:
        return Mesh(mesh.nodes, ())
    triangles, quads = np.concatenate(faces[3]), np.concatenate(faces[4])
    halves = np.concatenate([np.delete(quads, k, axis=1) for k in range(4)])
    block = CellBlock.make(mesh.nodes, "TRI3", triangles)
    within = np.isin(cell_keys(block), cell_keys(CellBlock.make(mesh.nodes, "TRI3", halves)))
    return take(Mesh(mesh.nodes, (block,)), lambda _: within)
