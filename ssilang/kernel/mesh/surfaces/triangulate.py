"""Constrained Delaunay triangulation of plane points inside closed contours."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.mesh.queries.select import crossing_inside


def triangulate_inside(points: FloatArray, segments: IntArray) -> IntArray:
    """Triangles (t, 3), anticlockwise, of points (m, 2) inside the contours.

    Parameters
    ----------
    segments : array (n, 2)
        Sides of closed contours; all appear as sides of triangles. What is inside is decided by
        the even-odd rule.

    Raises
    ------
    MeshError
        If points coincide or contours cross.
    """
    triangles = recover_segments(points, delaunay_triangles(points), segments)
    centres = points[triangles].mean(axis=1)
    inside = crossing_inside(centres, points[segments[:, 0]], points[segments[:, 1]])
    return triangles[inside]


def delaunay_triangles(points: FloatArray) -> IntArray:
    """Delaunay triangles, anticlockwise, of points inside a far larger square.

    The square's corners keep the convex hull away from the points, so that points in line on
    the contour give no flat triangles.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    middle, reach = (low + high) / 2, 8.0 * float((high - low).max())
    far = middle + reach * np.array([[-1.0, -0.9], [1.0, -1.1], [0.9, 1.0], [-1.1, 1.1]])
    try:
        table = spatial.Delaunay(np.vstack([points, far]) - middle).simplices.astype(np.int64)
    except spatial.QhullError as error:
        raise MeshError("kernel.mesh.points-contour-cannot-triangulated") from error
    table = table[(table < len(points)).all(axis=1)]
    areas = doubled_areas(points, table)
    table[areas < 0] = table[areas < 0][:, ::-1]
    return table


def doubled_areas(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Twice the signed areas of triangles (t, 3) of points (m, 2)."""
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    return cross(b - a, c - a)


def cross(u: FloatArray, v: FloatArray) -> FloatArray:
    """Products u x v (...,) of vectors (..., 2) of the plane."""
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def recover_segments(points: FloatArray, triangles: IntArray, segments: IntArray) -> IntArray:
    """The triangulation changed where needed so that every segment is a side in it.

    Each missing segment: the triangles that it crosses are removed and the two polygons left on
    its sides triangulated anew (Anglada 1997).

    Raises
    ------
    MeshError
        If a segment passes through a point or cannot be brought in.
    """
    for a, b in _missing(triangles, segments):
        crossed = _crossed(points, triangles, a, b)
        hole = triangles[crossed]
        # Polygons on the two sides of a-b, each from one end to the other along the hole's edge.
        sides = np.vstack([hole[:, [0, 1]], hole[:, [1, 2]], hole[:, [2, 0]]]).tolist()
        inner = {(q, p) for p, q in sides}
        following = {p: q for p, q in sides if (p, q) not in inner}
        right, left = _along(following, a, b), _along(following, b, a)
        if len(left) + len(right) != len(following) + 2:
            raise MeshError("kernel.mesh.contour-crosses-itself")
        fresh = [*_fill_polygon(points, left), *_fill_polygon(points, right)]
        triangles = np.vstack([triangles[~crossed], np.array(fresh, dtype=np.int64)])
    if _missing(triangles, segments):
        raise MeshError("kernel.mesh.contour-crosses-itself-two")
    return triangles


def _missing(triangles: IntArray, segments: IntArray) -> list[tuple[int, int]]:
    sides = np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    size = int(max(sides.max(initial=0), segments.max())) + 1
    sides.sort(axis=1)
    wanted = np.sort(segments, axis=1)
    absent = ~np.isin(wanted @ [size, 1], sides @ [size, 1])
    return [(int(a), int(b)) for a, b in segments[absent]]


def _crossed(points: FloatArray, triangles: IntArray, a: int, b: int) -> np.ndarray:
    """Triangles with a side that the segment a-b crosses strictly."""
    way = points[b] - points[a]
    side = cross(way[None], points - points[a])
    tiny = 1e-12 * float(way @ way)
    hit = np.zeros(len(triangles), dtype=bool)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        p, q = triangles[:, i], triangles[:, j]
        free = (p != a) & (p != b) & (q != a) & (q != b)
        apart = side[p] * side[q] < 0
        s = points[q] - points[p]
        over = cross(s, points[a] - points[p]) * cross(s, points[b] - points[p]) < 0
        hit |= free & apart & over
    through = np.flatnonzero(np.abs(side) <= tiny)
    along = ((points[through] - points[a]) @ way) / float(way @ way)
    if ((along > 1e-9) & (along < 1 - 1e-9)).any() or not hit.any():
        raise MeshError("kernel.mesh.side-contour-passes-through")
    return hit


def _along(following: dict[int, int], start: int, end: int) -> list[int]:
    """The chain from one point to another."""
    chain = [start]
    while chain[-1] != end:
        if chain[-1] not in following or len(chain) > len(following):  # a loop apart
            raise MeshError("kernel.mesh.contour-crosses-itself")
        chain.append(following[chain[-1]])
    return chain


def _fill_polygon(points: FloatArray, chain: list[int]) -> list[tuple[int, int, int]]:
    """Delaunay triangles of the polygon that a chain closes with the side from last to first."""
    if len(chain) < 3:
        return []
    first, last = chain[0], chain[-1]
    best = 1
    for k in range(2, len(chain) - 1):
        # Whether the node lies inside the circle through the best triangle, anticlockwise.
        rows = points[[first, chain[best], last]] - points[chain[k]]
        table = np.column_stack([rows, (rows * rows).sum(axis=1)])
        if np.linalg.det(table) > 0.0:
            best = k
    return [
        *_fill_polygon(points, chain[: best + 1]),
        (first, chain[best], last),
        *_fill_polygon(points, chain[best:]),
    ]
