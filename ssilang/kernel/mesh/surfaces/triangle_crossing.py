"""Segments in which triangles in space cross."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray

FLAT = 1e-10
"""Distances below this share of the largest triangle's size count as none (rounding of 1e-16
times coordinates a thousand times that size, with room)."""


def crossing_segments(a: FloatArray, b: FloatArray) -> tuple[IntArray, IntArray, FloatArray]:
    """Segments common to the triangles of two surfaces.

    Two triangles of planes that cross share at most one segment: each meets the line where the
    planes cross along an interval, and the segment is what the intervals share (Moller 1997).
    Triangles of one plane, and triangles that touch in one point, give none.

    Parameters
    ----------
    a, b : array (m, 3, 3), array (n, 3, 3)
        Corners of the triangles.

    Returns
    -------
    rows of a (k,), rows of b (k,), ends of the segments (k, 2, 3)
    """
    i, j = _near_pairs(a, b)
    size = max(float(np.ptp(a, axis=1).max(initial=0.0)), float(np.ptp(b, axis=1).max(initial=0.0)))
    tiny = FLAT * size
    to_b, to_a = _heights(a[i], b[j], tiny), _heights(b[j], a[i], tiny)
    met = ~(_apart(to_b) | _apart(to_a))
    i, j, to_b, to_a = i[met], j[met], to_b[met], to_a[met]
    way = np.cross(_normals(a[i]), _normals(b[j]))
    way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-300)
    low_a, high_a = _interval(a[i], to_b, way)
    low_b, high_b = _interval(b[j], to_a, way)
    low = _further(low_a, low_b, way)
    high = _further(high_a, high_b, -way)
    long = _along(high - low, way) > 10.0 * tiny
    return i[long], j[long], np.stack([low[long], high[long]], axis=1)


def _near_pairs(a: FloatArray, b: FloatArray) -> tuple[IntArray, IntArray]:
    """Rows of triangles whose boxes overlap."""
    from scipy.spatial import cKDTree

    middle_a, middle_b = a.mean(axis=1), b.mean(axis=1)
    reach_a = np.linalg.norm(a - middle_a[:, None], axis=2).max(axis=1)
    reach_b = np.linalg.norm(b - middle_b[:, None], axis=2).max(axis=1)
    found = cKDTree(middle_b).query_ball_point(middle_a, reach_a + reach_b.max())
    i = np.repeat(np.arange(len(a)), [len(f) for f in found])
    j = np.array([k for f in found for k in f], dtype=np.int64)
    room = 1e-9 * float(reach_a.max())
    over = (a[i].min(axis=1) <= b[j].max(axis=1) + room) & (
        b[j].min(axis=1) <= a[i].max(axis=1) + room
    )
    kept = over.all(axis=1)
    return i[kept], j[kept]


def _normals(t: FloatArray) -> FloatArray:
    n = np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
    unit: FloatArray = n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-300)
    return unit


def _heights(corners: FloatArray, t: FloatArray, tiny: float) -> FloatArray:
    """Signed distances (k, 3) of corners (k, 3, 3) to the planes of triangles (k, 3, 3)."""
    h: FloatArray = np.einsum("kcx,kx->kc", corners - t[:, :1], _normals(t))
    h[np.abs(h) <= tiny] = 0.0
    return h


def _apart(h: FloatArray) -> BoolArray:
    """Triangles wholly on one side of the other's plane, or wholly in it."""
    away: BoolArray = (h > 0).all(axis=1) | (h < 0).all(axis=1) | (h == 0).all(axis=1)
    return away


def _interval(t: FloatArray, h: FloatArray, way: FloatArray) -> tuple[FloatArray, FloatArray]:
    """First and last points (k, 3) along `way` of triangles on the other's plane."""
    i, j = [0, 1, 2], [1, 2, 0]
    cut = h[:, i] * h[:, j] < 0
    share = h[:, i] / np.where(cut, h[:, i] - h[:, j], 1.0)
    on_sides = t[:, i] + share[..., None] * (t[:, j] - t[:, i])
    points = np.concatenate([t, on_sides], axis=1)
    valid = np.concatenate([h == 0, cut], axis=1)
    place = np.einsum("kcx,kx->kc", points - t[:, :1], way)
    each = np.arange(len(t))
    first = points[each, np.where(valid, place, np.inf).argmin(axis=1)]
    last = points[each, np.where(valid, place, -np.inf).argmax(axis=1)]
    return first, last


def _along(vectors: FloatArray, way: FloatArray) -> FloatArray:
    found: FloatArray = (vectors * way).sum(axis=1)
    return found


def _further(p: FloatArray, q: FloatArray, way: FloatArray) -> FloatArray:
    """Of each pair of points, the one further along."""
    return np.where(_along(q - p, way)[:, None] > 0, q, p)
