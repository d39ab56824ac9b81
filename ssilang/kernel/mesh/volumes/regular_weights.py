"""Weights of points for which given triangles are faces of the regular triangulation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError

_CLEARANCE = 0.003  # wanted height over a face's plane in the lifted space, in squared sizes
_LEAST = 1e-6  # clearance below which rounding could undo the result


@dataclass(frozen=True)
class LiftedFaces:
    """Weights, and for each triangle a sphere that keeps all other points outside.

    Attributes
    ----------
    weights : array (m,)
    centres, radii : array (t, 3), array (t,)
        A point of weight zero must be outside of all spheres to leave the triangles in place.
    """

    weights: FloatArray
    centres: FloatArray
    radii: FloatArray


def small_spheres(points: FloatArray, triangles: IntArray) -> tuple[FloatArray, FloatArray]:
    """Centres (t, 3) and radii (t,) of the smallest spheres through triangles."""
    a = points[triangles[:, 0]]
    u, v = points[triangles[:, 1]] - a, points[triangles[:, 2]] - a
    normal = np.cross(u, v)
    square = np.maximum((normal**2).sum(axis=1, keepdims=True), 1e-300)
    uu, vv = ((x * x).sum(axis=1, keepdims=True) for x in (u, v))
    arm = np.cross(uu * v - vv * u, normal) / (2.0 * square)
    return a + arm, np.linalg.norm(arm, axis=1)


def lift_faces(points: FloatArray, triangles: IntArray, reach: FloatArray) -> LiftedFaces:
    """Find the weights by a linear programme.

    Parameters
    ----------
    points : array (m, 3)
        In a box of size about 1.
    triangles : array (t, 3)
    reach : array (t,)
        Points nearer to a triangle's smallest sphere than this, in radii, are kept off it.

    Raises
    ------
    MeshError
        If there are no such weights: no regular triangulation holds these triangles.

    Notes
    -----
    Lifted to the heights |x|**2 - w, the triangles are faces of the lower hull when for each an
    affine function takes the heights of its corners and stays below those of all other points.
    Such a function has one free slope s, across the triangle's plane: the unknowns are the
    weights, the slopes and the clearance. The clearance is maximised up to a limit first, then
    weights and slopes are made small, so that most spheres are the smallest ones.
    """
    face, other = _neighbours(points, triangles, reach)
    frame = _Frame.of(points, triangles)
    if not len(face):
        centres, radii = small_spheres(points, triangles)
        return LiftedFaces(np.zeros(len(points)), centres, radii)
    clearance, weights, slopes = _programme(points, triangles, frame, face, other)
    if clearance < _LEAST:
        raise MeshError("kernel.mesh.no-weights-keep-triangles")
    centres, radii = _orthospheres(points, triangles, frame, weights, slopes)
    return LiftedFaces(weights, centres, radii)


def _neighbours(
    points: FloatArray, triangles: IntArray, reach: FloatArray
) -> tuple[IntArray, IntArray]:
    """Pairs (triangle, point) to keep apart."""
    from scipy.spatial import cKDTree

    centres, radii = small_spheres(points, triangles)
    found = cKDTree(points).query_ball_point(centres, reach * radii)
    counts = np.array([len(f) for f in found])
    face = np.repeat(np.arange(len(triangles)), counts)
    other = np.concatenate([np.asarray(f, dtype=np.int64) for f in found])
    own = (triangles[face] == other[:, None]).any(axis=1)
    return face[~own], other[~own]


@dataclass(frozen=True)
class _Frame:
    """Local axes of triangles: two edges, unit normals and squared sizes."""

    origin: FloatArray
    edges: FloatArray  # (t, 2, 3)
    normal: FloatArray
    size: FloatArray

    @classmethod
    def of(cls, points: FloatArray, triangles: IntArray) -> _Frame:
        x = points[triangles]
        edges = x[:, 1:] - x[:, :1]
        normal = np.cross(edges[:, 0], edges[:, 1])
        area = np.linalg.norm(normal, axis=1)
        return cls(x[:, 0], edges, normal / np.maximum(area, 1e-300)[:, None], area)

    def shares(self, face: IntArray, position: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Barycentric shares (n, 3) in the planes of triangles, and heights over them (n,)."""
        edges = self.edges[face]
        arm = position - self.origin[face]
        gram = np.einsum("nik,njk->nij", edges, edges)
        right = np.einsum("nik,nk->ni", edges, arm)
        part = np.linalg.solve(gram, right[..., None])[..., 0]
        shares = np.column_stack([1.0 - part.sum(axis=1), part])
        return shares, (arm * self.normal[face]).sum(axis=1)


def _programme(
    points: FloatArray, triangles: IntArray, frame: _Frame, face: IntArray, other: IntArray
) -> tuple[float, FloatArray, FloatArray]:
    """Clearance, weights (m,) and slopes (t,)."""
    from scipy.optimize import linprog
    from scipy.sparse import coo_array, hstack

    m, t, n = len(points), len(triangles), len(face)
    shares, height = frame.shares(face, points[other])
    # heights over the corner a: |x - a|**2, exact for close points
    origin = frame.origin[face]
    lifted = ((points[other] - origin) ** 2).sum(axis=1)
    corners = ((points[triangles[face]] - origin[:, None]) ** 2).sum(axis=2)
    gap = lifted - (shares * corners).sum(axis=1)
    rows = np.arange(n)
    entries = [(rows, other, np.ones(n)), (rows, m + face, height)]
    entries += [(rows, triangles[face, k], -shares[:, k]) for k in range(3)]
    entries.append((rows, np.full(n, m + t), frame.size[face]))
    i, j, v = (np.concatenate([e[k] for e in entries]) for k in range(3))
    half = coo_array((v, (i, j)), shape=(n, m + t + 1)).tocsc()
    # weights and slopes as differences of positive parts, whose sum is the price
    free = half[:, : m + t]
    table: Any = hstack([free, -free, half[:, m + t :]]).tocsr()
    h = np.sqrt(frame.size)
    at = np.full(m, np.inf)
    np.minimum.at(at, triangles.ravel(), np.repeat(h, 3))
    price = np.concatenate([1.0 / at**2, 0.3 / h])
    limit = np.concatenate([np.full(m, 1.0), np.full(t, 2.0)])
    cost = np.concatenate([price, price, [-1e4 * len(price)]])
    upper = np.concatenate([limit, limit, [_CLEARANCE]])
    bounds = np.column_stack([np.zeros(len(upper)), upper])
    found = linprog(cost, A_ub=table, b_ub=gap, bounds=bounds.tolist(), method="highs")
    if found.x is None:
        return 0.0, np.zeros(m), np.zeros(t)
    x = np.asarray(found.x[: m + t] - found.x[m + t : -1])
    return float(found.x[-1]), x[:m], x[m:]


def _orthospheres(
    points: FloatArray,
    triangles: IntArray,
    frame: _Frame,
    weights: FloatArray,
    slopes: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Spheres inside which points of weight zero would lie below a triangle's function."""
    corners = ((points[triangles] - frame.origin[:, None]) ** 2).sum(axis=2) - weights[triangles]
    gram = np.einsum("nik,njk->nij", frame.edges, frame.edges)
    rise = corners[:, 1:] - corners[:, :1]
    part = np.linalg.solve(gram, rise[..., None])[..., 0]
    gradient = np.einsum("ni,nik->nk", part, frame.edges) + slopes[:, None] * frame.normal
    square = (gradient**2).sum(axis=1) / 4.0 + corners[:, 0]
    return frame.origin + gradient / 2.0, np.sqrt(np.maximum(square, 0.0))
