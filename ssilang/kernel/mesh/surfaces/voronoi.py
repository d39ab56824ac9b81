"""Voronoi partition of a plane domain, with or without weights, cut at the domain's contour.

The cell of a germ p of weight w is where |x - p|^2 - w^2 is least. Along a line this power of each
germ is, but for a term that all share, a linear function: the cells that a side of the contour
crosses are the lower envelope of straight lines, and an edge between two cells is the stretch of
their bisector on which no third germ has less.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.mesh.queries.select import crossing_inside, places_once, segment_distance
from ssilang.kernel.mesh.surfaces.triangulate import cross

OUTSIDE = -1
_FEW = 12
_CLOSE = 1e-9
"""Length under which points are one, as a part of the domain's size."""


@dataclass(frozen=True, eq=False)
class VoronoiPartition:
    """Edges of cells.

    Attributes
    ----------
    points : array (n_points, 2)
        Those of the contour first.
    edges : array (n_edges, 2)
        Rows of `points`.
    owners : array (n_edges, 2)
        Germ whose cell is on the left of an edge, and on its right: `OUTSIDE` on the contour.
    """

    points: FloatArray
    edges: IntArray
    owners: IntArray


@dataclass(frozen=True, eq=False)
class _Powers:
    """Germs (n, 2) with |p|^2 - w^2 (n,): the power is constant - 2 p.x plus |x|^2."""

    germs: FloatArray
    constants: FloatArray

    def along(self, start: FloatArray, direction: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Values (n,) at a point of a line, and slopes (n,) along it."""
        return self.constants - 2.0 * self.germs @ start, -2.0 * self.germs @ direction


def voronoi_partition(
    germs: FloatArray, weights: FloatArray, corners: FloatArray, sides: IntArray
) -> VoronoiPartition:
    """Partition of the inside of a contour.

    Parameters
    ----------
    germs : array (n, 2)
        Each inside the contour.
    weights : array (n,)
        Lengths; all alike for the usual partition.
    corners : array (k, 2)
    sides : array (m, 2)
        Rows of `corners`; closed, all in one sense, holes in the other.

    Raises
    ------
    MeshError
        If germs lie outside or at one place, or a weight is too large beside another.
    """
    a, b = corners[sides[:, 0]], corners[sides[:, 1]]
    if cross(a, b).sum() < 0:
        sides = sides[:, ::-1]
        a, b = b, a
    size = float(np.ptp(corners, axis=0).max())
    _check(germs, weights, a, b, _CLOSE * size)
    middle = corners.mean(axis=0)  # powers far from the origin would lose digits
    powers = _Powers(germs - middle, ((germs - middle) ** 2).sum(axis=1) - weights**2)
    a, b = a - middle, b - middle
    pieces = [_along_side(powers, p, q) for p, q in zip(a, b, strict=True)]
    pieces += [_between(powers, i, j, a, b, _CLOSE * size) for i, j in _pairs(powers)]
    ends = np.concatenate([p[0] for p in pieces])
    owners = np.concatenate([p[1] for p in pieces])
    every = np.concatenate([corners - middle, ends.reshape(-1, 2)])
    points, numbers = places_once(every, 2 * _CLOSE * size)
    edges = numbers[len(corners) :].reshape(-1, 2)
    long = edges[:, 0] != edges[:, 1]
    return VoronoiPartition(points + middle, edges[long], owners[long])


def _check(
    germs: FloatArray, weights: FloatArray, a: FloatArray, b: FloatArray, close: float
) -> None:
    if not crossing_inside(germs, a, b).all():
        raise MeshError("kernel.mesh.germ-lies-outside-contour")
    i, j = np.triu_indices(len(germs), 1)
    squares = ((germs[i] - germs[j]) ** 2).sum(axis=1)
    if (squares <= close**2).any():
        raise MeshError("kernel.mesh.two-germs-lie-same")
    if (np.abs(weights[i] ** 2 - weights[j] ** 2) > squares * (1 + 1e-12)).any():
        raise MeshError("kernel.mesh.two-weights-differ-too")


def _pairs(powers: _Powers) -> list[tuple[int, int]]:
    """Germs whose cells may touch: sides of their regular triangulation."""
    n = len(powers.germs)
    if n > _FEW:
        lifted = np.column_stack([powers.germs, powers.constants])
        try:
            hull = spatial.ConvexHull(lifted / np.abs(lifted).max(axis=0))
        except spatial.QhullError:
            pass  # germs in line or on one circle
        else:
            faces = hull.simplices[hull.equations[:, 2] <= 1e-12]
            sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
            sides = np.unique(np.sort(sides, axis=1), axis=0)
            return [(int(i), int(j)) for i, j in sides]
    return list(combinations(range(n), 2))


def _along_side(powers: _Powers, a: FloatArray, b: FloatArray) -> tuple[FloatArray, IntArray]:
    """Pieces (m, 2, 2) of a side of the contour and whose cells (m, 2) lie there."""
    values, slopes = powers.along(a, b - a)
    lowest = np.lexsort((slopes, values))[0]
    cuts, cells = [0.0], [int(lowest)]
    while True:
        falling = np.flatnonzero(slopes < slopes[cells[-1]])
        gap = values[falling] - values[cells[-1]]
        at = gap / (slopes[cells[-1]] - slopes[falling])
        if not len(at) or at.min() >= 1.0:
            break
        tied = falling[at <= at.min() + 1e-14]
        cuts.append(float(at.min()))
        cells.append(int(tied[np.argmin(slopes[tied])]))
    cuts.append(1.0)
    x = a + np.asarray(cuts)[:, None] * (b - a)
    x[-1] = b
    owners = np.column_stack([cells, np.full(len(cells), OUTSIDE)])
    return np.stack([x[:-1], x[1:]], axis=1), owners


def _between(
    powers: _Powers, i: int, j: int, a: FloatArray, b: FloatArray, close: float
) -> tuple[FloatArray, IntArray]:
    """Edges (m, 2, 2) between two cells inside of the contour, the first cell on their left."""
    d = powers.germs[j] - powers.germs[i]
    reach = (powers.constants[j] - powers.constants[i] - 2.0 * d @ powers.germs[i]) / (2.0 * d @ d)
    start = powers.germs[i] + reach * d
    along = np.array([-d[1], d[0]]) / np.hypot(*d)
    values, slopes = powers.along(start, along)
    gap, slope = np.delete(values - values[i], [i, j]), np.delete(slopes - slopes[i], [i, j])
    if (gap[np.abs(slope) < 1e-300] < 0).any():
        return _no_edges()
    places = np.concatenate([a, b]) @ along - start @ along
    low, high = places.min() - 1.0, places.max() + 1.0
    rising, falling = slope > 0, slope < 0
    low = max([low, *(-gap[rising] / slope[rising])])
    high = min([high, *(-gap[falling] / slope[falling])])
    if high - low <= close:
        return _no_edges()
    sa, sb = (a - start) @ d, (b - start) @ d
    met = sa * sb <= 0
    met &= sa != sb
    share = sa[met] / (sa[met] - sb[met])
    crossing = (a[met] + share[:, None] * (b[met] - a[met]) - start) @ along
    cuts = np.unique(np.concatenate([[low, high], np.clip(crossing, low, high)]))
    cuts = cuts[np.concatenate([[True], np.diff(cuts) > close])]
    x = start + cuts[:, None] * along
    middles = (x[:-1] + x[1:]) / 2
    kept = crossing_inside(middles, a, b) & (segment_distance(middles, a, b) > close)
    ends = np.stack([x[:-1], x[1:]], axis=1)[kept]
    return ends, np.tile([i, j], (len(ends), 1))


def _no_edges() -> tuple[FloatArray, IntArray]:
    return np.empty((0, 2, 2)), np.empty((0, 2), dtype=np.int64)
