"""Volumes inside closed surfaces, filled with tetrahedra by a weighted Delaunay triangulation."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.base.scientific import optimize, sp, spatial
from ssilang.kernel.mesh.surfaces.fill import mean_sizes, without_unused
from ssilang.kernel.mesh.surfaces.triangulate import cross

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
    # Spheres inside which points of weight zero would lie below a triangle's function.
    corners = ((points[triangles] - frame.origin[:, None]) ** 2).sum(axis=2) - weights[triangles]
    gram = np.einsum("nik,njk->nij", frame.edges, frame.edges)
    rise = corners[:, 1:] - corners[:, :1]
    part = np.linalg.solve(gram, rise[..., None])[..., 0]
    gradient = np.einsum("ni,nik->nk", part, frame.edges) + slopes[:, None] * frame.normal
    square = (gradient**2).sum(axis=1) / 4.0 + corners[:, 0]
    centres, radii = frame.origin + gradient / 2.0, np.sqrt(np.maximum(square, 0.0))
    return LiftedFaces(weights, centres, radii)


def _neighbours(
    points: FloatArray, triangles: IntArray, reach: FloatArray
) -> tuple[IntArray, IntArray]:
    """Pairs (triangle, point) to keep apart."""
    centres, radii = small_spheres(points, triangles)
    found = spatial.cKDTree(points).query_ball_point(centres, reach * radii)
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
    def of(cls, points: FloatArray, triangles: IntArray) -> "_Frame":
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
    half = sp.coo_array((v, (i, j)), shape=(n, m + t + 1)).tocsc()
    # weights and slopes as differences of positive parts, whose sum is the price
    free = half[:, : m + t]
    table: Any = sp.hstack([free, -free, half[:, m + t :]]).tocsr()
    h = np.sqrt(frame.size)
    at = np.full(m, np.inf)
    np.minimum.at(at, triangles.ravel(), np.repeat(h, 3))
    price = np.concatenate([1.0 / at**2, 0.3 / h])
    limit = np.concatenate([np.full(m, 1.0), np.full(t, 2.0)])
    cost = np.concatenate([price, price, [-1e4 * len(price)]])
    upper = np.concatenate([limit, limit, [_CLEARANCE]])
    bounds = np.column_stack([np.zeros(len(upper)), upper])
    found = optimize.linprog(cost, A_ub=table, b_ub=gap, bounds=bounds.tolist(), method="highs")
    if found.x is None:
        return 0.0, np.zeros(m), np.zeros(t)
    x = np.asarray(found.x[: m + t] - found.x[m + t : -1])
    return float(found.x[-1]), x[:m], x[m:]


_ROUNDS = 10


def tetrahedralize(points: FloatArray, triangles: IntArray) -> tuple[FloatArray, IntArray]:
    """Tetrahedra inside a closed surface, whose triangles they keep.

    Parameters
    ----------
    points : array (m, 3)
        Of the surface; they come first in the result.
    triangles : array (t, 3)
        In any sense; every side belongs to an even number of them.

    Returns
    -------
    points : array (m + k, 3)
        With the points added inside, about as far apart as those of the surface nearby.
    tetrahedra : array (n, 4)
        With positive volume.

    Raises
    ------
    MeshError
        If the surface is not closed, or some of its triangles are not found in the
        triangulation (thin parts, very unequal neighbours).

    Notes
    -----
    The triangulation is regular (weighted Delaunay), computed as the lower convex hull of the
    lifted points; the weights are those for which the surface's triangles are faces of it
    (`lift_faces`). A lattice of points is put inside, out of the spheres of the triangles.
    """
    _check_closed(points, triangles)
    low, high = points.min(axis=0), points.max(axis=0)
    scale = float((high - low).max())
    unit = (points - (low + high) / 2) / scale
    lattice = _inner_points(unit, triangles)
    reach = np.full(len(triangles), 1.02)
    # far smaller than the clearance of the faces: four points of a plane on one circle, which
    # would give a cell without volume, are told apart
    disorder = np.random.default_rng(2).uniform(-1.0, 1.0, len(unit))
    disorder *= 1e-4 * _sizes(unit, triangles) ** 2
    for _ in range(_ROUNDS):
        lifted = lift_faces(unit, triangles, reach)
        inner = _outside_spheres(lattice, lifted.centres, lifted.radii, 1.02)
        every = np.vstack([unit, inner])
        cells = _regular_triangulation(every, lifted.weights + disorder)
        size = int(max(cells.max(), triangles.max())) + 1
        have = _codes(_faces(cells), size)
        lost = ~np.isin(_codes(np.sort(triangles, axis=1), size), have)
        if not lost.any():
            kept = _inside_cells(every, cells, unit, triangles)
            points, (kept,) = without_unused(every * scale + (low + high) / 2, [kept], len(points))
            return points, kept
        reach[lost] *= 1.4
    raise MeshError("kernel.mesh.triangles-surface-cannot-kept", n_lost=int(lost.sum()))


def _check_closed(points: FloatArray, triangles: IntArray) -> None:
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, times = np.unique(sides, axis=0, return_counts=True)
    if not len(triangles) or (times % 2 == 1).any():
        lone = int((times % 2 == 1).sum())
        where = points[edges[times % 2 == 1][0, 0]] if lone else np.zeros(3)
        raise MeshError("kernel.mesh.surface-not-closed-sides", lone=lone, where=where)


def _outside_spheres(
    positions: FloatArray, centres: FloatArray, radii: FloatArray, factor: float
) -> FloatArray:
    """Positions that lie in none of the spheres enlarged by a factor."""
    if not len(positions):
        return positions
    hit = spatial.cKDTree(positions).query_ball_point(centres, factor * radii)
    free = np.ones(len(positions), dtype=bool)
    free[np.unique(np.concatenate([np.asarray(h, dtype=np.int64) for h in hit]))] = False
    return positions[free]


def _sizes(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Mean length of the sides at each point, shape (m,)."""
    return mean_sizes(points, triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2))


def _inner_points(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Lattice points inside, their spacing following the sizes of the surface nearby."""
    used = np.unique(triangles)
    sizes = _sizes(points, triangles)[used]
    tree = spatial.cKDTree(points[used])
    least, largest = float(sizes.min()), float(sizes.max())
    chosen = np.empty((0, 3))
    for level in range(int(np.log2(largest / least) + 1e-9), -1, -1):
        step = least * 2.0**level
        lattice = _lattice(points.min(axis=0), points.max(axis=0), step * 1.25)
        found = tree.query(lattice, k=min(6, len(used)))
        reach, near = np.asarray(found[0]), np.asarray(found[1])
        weight = 1.0 / np.maximum(reach, 1e-12) ** 2
        wanted = (weight * sizes[near]).sum(axis=1) / weight.sum(axis=1)
        upper = np.inf if step * 2 > largest else 2.0 * step
        fit = (wanted >= (step if level else 0.0)) & (wanted < upper) & (reach[:, 0] > 0.6 * wanted)
        lattice, wanted = lattice[fit], wanted[fit]
        if len(chosen) and len(lattice):
            apart, _ = spatial.cKDTree(chosen).query(lattice)
            lattice = lattice[apart > 0.8 * wanted]
        lattice = _outside_spheres(lattice, *small_spheres(points, triangles), 1.02)
        lattice = lattice[ray_inside(lattice, points, triangles)]
        chosen = np.vstack([chosen, lattice])
    return chosen


def _lattice(low: FloatArray, high: FloatArray, edge: float) -> FloatArray:
    """Body-centred cubic lattice of a box, nearest neighbours 0.87 `edge` apart."""
    count = (high - low) / edge
    if float(np.prod(np.maximum(count, 1.0))) > 5e6:
        raise MeshError("kernel.mesh.surface-asks-more-ten")
    starts = low + 0.5 * edge * (count % 1.0)
    axes = [np.arange(a, b, edge) for a, b in zip(starts, high, strict=True)]
    corners = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    lattice = np.vstack([corners, corners + 0.5 * edge])
    # a little disorder: points of a plane on one circle would give cells without volume
    return lattice + np.random.default_rng(1).uniform(-0.03, 0.03, lattice.shape) * edge


def ray_inside(positions: FloatArray, points: FloatArray, triangles: IntArray) -> BoolArray:
    """Which positions (n, 3) a closed surface holds: parity of crossings of a ray."""
    way = np.array([0.26856, 0.53242, 0.80248])  # along no axis or diagonal
    first = np.cross(way, [1.0, 0.0, 0.0])
    frame = np.column_stack([first, np.cross(way, first), way])
    corners, at = (points @ frame)[triangles], positions @ frame
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    twice = cross(b - a, c - a)
    inside = np.zeros(len(at), dtype=bool)
    for rows in np.array_split(np.arange(len(at)), max(1, len(at) * len(triangles) // 2_000_000)):
        p = at[rows, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            s, t = cross(p - a, c - a) / twice, cross(b - a, p - a) / twice
        height = a[:, 2] + s * (b - a)[:, 2] + t * (c - a)[:, 2]
        hit = (s >= 0) & (t >= 0) & (s + t <= 1) & (height > p[..., 2])
        inside[rows] = hit.sum(axis=1) % 2 == 1
    return inside


def _regular_triangulation(points: FloatArray, weights: FloatArray) -> IntArray:
    """Cells (n, 4) of the weighted Delaunay triangulation; missing weights are zero.

    Eight far points, numbered last, surround the others.
    """
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
    far = signs * [[3.0, 3.1, 2.9]] + 0.01 * np.arange(8)[:, None]
    every = np.vstack([points, far])
    lift = (every**2).sum(axis=1)
    lift[: len(weights)] -= weights
    try:
        hull = spatial.ConvexHull(np.column_stack([every, lift]), qhull_options="Qt Q12")
    except spatial.QhullError as error:
        raise MeshError("kernel.mesh.points-surface-cannot-triangulated") from error
    return hull.simplices[hull.equations[:, 3] < -1e-12].astype(np.int64)


def _faces(cells: IntArray) -> IntArray:
    """Faces (4 n, 3) of cells, nodes increasing."""
    return np.sort(cells[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3), axis=1)


def _codes(faces: IntArray, size: int) -> IntArray:
    """One number a face."""
    return (faces[:, 0] * size + faces[:, 1]) * size + faces[:, 2]


def _inside_cells(
    points: FloatArray, cells: IntArray, surface: FloatArray, triangles: IntArray
) -> IntArray:
    """Cells inside the surface, turned to positive volume."""
    size = int(cells.max()) + 1
    codes = _codes(_faces(cells), size)
    walls = np.isin(codes, _codes(np.sort(triangles, axis=1), size))
    owner = np.repeat(np.arange(len(cells)), 4)
    order = np.argsort(codes, kind="stable")
    pair = np.flatnonzero((codes[order][1:] == codes[order][:-1]) & ~walls[order][1:])
    one, two = owner[order][pair], owner[order][pair + 1]
    label = parts_of(len(cells), (one, two))
    outer = np.unique(label[(cells >= len(points)).any(axis=1)])
    x = points[np.where(cells < len(points), cells, 0)]
    arms = x[:, 1:] - x[:, :1]
    volume = np.einsum("ni,ni->n", np.cross(arms[:, 0], arms[:, 1]), arms[:, 2])
    keep = np.zeros(int(label.max()) + 1, dtype=bool)
    for part in np.setdiff1d(label, outer):
        rows = np.flatnonzero(label == part)
        largest = rows[np.abs(volume[rows]).argmax()]
        if np.abs(volume[largest]) > 1e-12:
            keep[part] = ray_inside(x[largest].mean(axis=0)[None], surface, triangles)[0]
    kept = keep[label]
    made: IntArray = cells[kept]
    negative = volume[kept] < 0
    made[negative] = made[negative][:, [0, 2, 1, 3]]
    return made
