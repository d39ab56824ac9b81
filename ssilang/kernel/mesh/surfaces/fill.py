"""A plane contour filled: points inside for a wanted size, and a cut in two where it is narrow."""

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.scientific import interpolate, spatial
from ssilang.kernel.mesh.boundary import chained
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.queries.select import crossing_inside, segment_distance
from ssilang.kernel.mesh.surfaces.triangulate import cross, triangulate_inside

_ROUNDS = 400


class SizeField:
    """Wanted size inside a contour: linear between the sizes at its points."""

    def __init__(self, points: FloatArray, sizes: FloatArray) -> None:
        # corners of a larger square with the mean size make the interpolation total

        low, high = points.min(axis=0), points.max(axis=0)
        middle, reach = (low + high) / 2, 3.0 * float((high - low).max())
        far = middle + reach * np.array([[-1.0, -1.1], [1.1, -1.0], [1.0, 1.1], [-1.1, 1.0]])
        values = np.concatenate([sizes, np.full(4, sizes.mean())])
        self._inside = interpolate.LinearNDInterpolator(np.vstack([points, far]), values)
        self._least = float(sizes.min())

    def __call__(self, p: FloatArray) -> FloatArray:
        """Sizes (m,) at positions (m, 2)."""
        return np.maximum(self._inside(p), self._least)


def mean_sizes(points: FloatArray, segments: IntArray) -> FloatArray:
    """Mean length of the segments (n, 2) at each point (m,)."""
    length = np.linalg.norm(points[segments[:, 1]] - points[segments[:, 0]], axis=1)
    total = np.bincount(segments.ravel(), np.repeat(length, 2), len(points))
    times = np.bincount(segments.ravel(), minlength=len(points))
    return total / np.maximum(times, 1)


def fill_contour(
    points: FloatArray, segments: IntArray, size: SizeField, squares: bool
) -> tuple[FloatArray, IntArray]:
    """Points added inside the contours by an advancing front, and the triangles.

    Parameters
    ----------
    points : array (m, 2)
        Of the contours; they come first in the result.
    segments : array (n, 2)
    squares : bool
        Place points so that triangles pair up into squares; else nearly equilateral triangles.

    Returns
    -------
    points : array (m + k, 2)
    triangles : array (t, 3)

    Notes
    -----
    In each round every triangle that is too large and touches the contour or a good triangle
    by a side proposes a point over that side (Rebay 1993 for the triangles); proposals too close
    to one another, to a point or to the contour are dropped. Then all is triangulated anew.
    """
    triangles = triangulate_inside(points, segments)
    a, b = points[segments[:, 0]], points[segments[:, 1]]
    for _ in range(_ROUNDS):
        proposals = _proposals(points, triangles, size, squares)
        fresh = _accepted(proposals, points, a, b, size)
        if not len(fresh):  # the front is done: what is still too large gets its centre
            fresh = _accepted(_large_centres(points, triangles, size, squares), points, a, b, size)
        if not len(fresh):
            break
        points = np.vstack([points, fresh])
        triangles = triangulate_inside(points, segments)
    return points, triangles


def _circumscribed(points: FloatArray, triangles: IntArray) -> tuple[FloatArray, FloatArray]:
    """Circumcentres (t, 2) and circumradii (t,)."""
    a = points[triangles[:, 0]]
    u, v = points[triangles[:, 1]] - a, points[triangles[:, 2]] - a
    twice = 2.0 * cross(u, v)
    uu, vv = (u * u).sum(axis=1), (v * v).sum(axis=1)
    arm = np.column_stack([v[:, 1] * uu - u[:, 1] * vv, u[:, 0] * vv - v[:, 0] * uu])
    arm /= np.where(twice == 0.0, 1e-300, twice)[:, None]
    return a + arm, np.linalg.norm(arm, axis=1)


def _proposals(
    points: FloatArray, triangles: IntArray, size: SizeField, squares: bool
) -> FloatArray:
    """New positions (k, 2), best first."""
    centres, radii = _circumscribed(points, triangles)
    wanted = size(points[triangles].mean(axis=1))
    ideal = wanted / (2.0**0.5 if squares else 3.0**0.5)
    large = radii > 1.3 * ideal
    # in the sense of their large triangle, whose other neighbour is good or none
    sides, owner, twin, paired = sides_and_twins(triangles)
    front = large[owner] & ~(paired & large[owner[twin]])
    edge, owner = sides[front], owner[front]
    if not len(edge):
        return np.empty((0, 2))
    p, q = points[edge[:, 0]], points[edge[:, 1]]
    middle, half = (p + q) / 2, np.linalg.norm(q - p, axis=1) / 2
    normal = np.column_stack([-(q - p)[:, 1], (q - p)[:, 0]]) / (2 * half)[:, None]
    h = size(middle)
    order = np.argsort(half)
    if squares:
        made = np.stack([p + h[:, None] * normal, q + h[:, None] * normal], axis=1)
        return np.vstack([made[order].reshape(-1, 2), _far_centres(centres, radii, ideal, large)])
    reach = np.linalg.norm(centres[owner] - middle, axis=1)
    radius = np.maximum(h / 3.0**0.5, half)
    radius = np.minimum(radius, (half**2 + reach**2) / np.maximum(2 * reach, 1e-300))
    rise = radius + np.sqrt(np.maximum(radius**2 - half**2, 0.0))
    made = middle + rise[:, None] * normal
    return np.vstack([made[order], _far_centres(centres, radii, ideal, large)])


def _large_centres(
    points: FloatArray, triangles: IntArray, size: SizeField, squares: bool
) -> FloatArray:
    """Circumcentres of triangles that are too large, the largest first."""
    centres, radii = _circumscribed(points, triangles)
    excess = radii / size(points[triangles].mean(axis=1)) * (2.0 if squares else 3.0) ** 0.5
    pick = np.flatnonzero((excess > 1.4) & (excess < 8.0))
    return centres[pick[np.argsort(-excess[pick])]]


def _far_centres(
    centres: FloatArray, radii: FloatArray, ideal: FloatArray, large: np.ndarray
) -> FloatArray:
    """Circumcentres of triangles that are still more than twice too large, the largest first.

    They come behind the front's own proposals and fill what the front leaves.
    """
    excess = radii / ideal
    pick = np.flatnonzero(large & (excess > 1.9) & (excess < 4.0))
    return centres[pick[np.argsort(-excess[pick])]]


def sides_and_twins(triangles: IntArray) -> tuple[IntArray, IntArray, IntArray, BoolArray]:
    """Sides (3 n, 2) in the sense of their triangles, these, and the reverse sides where they are.

    Sides from corner 0 to 1 of all triangles come first, then from 1 to 2 and from 2 to 0.
    """
    n = int(triangles.max(initial=0)) + 1
    sides = np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    owner = np.tile(np.arange(len(triangles)), 3)
    code, reverse = sides @ [n, 1], sides @ [1, n]
    order = np.argsort(code)
    twin = order[np.minimum(np.searchsorted(code[order], reverse), len(code) - 1)]
    return sides, owner, twin, code[twin] == reverse


def _accepted(
    proposals: FloatArray, points: FloatArray, a: FloatArray, b: FloatArray, size: SizeField
) -> FloatArray:
    """Proposals that are inside and far enough from points, from the contour and one another."""
    if not len(proposals):
        return proposals
    inside = crossing_inside(proposals, a, b)
    proposals = proposals[inside]
    if not len(proposals):
        return proposals
    h = size(proposals)
    far, _ = spatial.cKDTree(points).query(proposals)
    good = (far > 0.62 * h) & (segment_distance(proposals, a, b) > 0.5 * h)
    proposals, h = proposals[good], h[good]
    if not len(proposals):
        return proposals
    free = np.ones(len(proposals), dtype=bool)
    near = spatial.cKDTree(proposals).query_ball_point(proposals, 0.72 * h)
    for i, rows in enumerate(near):
        if free[i]:
            free[rows] = False
            free[i] = True
    return proposals[free]


def without_unused(
    points: FloatArray, cells: list[IntArray], fixed: int
) -> tuple[FloatArray, list[IntArray]]:
    """The points that cells use, the first `fixed` in any case, and the cells on them."""
    kept = np.zeros(len(points), dtype=bool)
    kept[:fixed] = True
    for table in cells:
        kept[table] = True
    fresh = np.cumsum(kept) - 1
    return points[kept], [fresh[table] for table in cells]


def smooth(
    points: FloatArray, links: IntArray, fixed: int, rounds: int = 4, weight: float = 0.7
) -> FloatArray:
    """Points after the first `fixed` drawn towards the mean of their neighbours.

    Parameters
    ----------
    links : array (n, 2)
        Sides of the mesh, each once.
    """
    points = points.copy()
    m = len(points)
    ends = np.concatenate([links[:, 0], links[:, 1]])
    others = np.concatenate([links[:, 1], links[:, 0]])
    times = np.maximum(np.bincount(ends, minlength=m), 1)
    for _ in range(rounds):
        mean = np.column_stack([np.bincount(ends, points[others, k], m) / times for k in (0, 1)])
        points[fixed:] += weight * (mean[fixed:] - points[fixed:])
    return points


def certain_sides(points: FloatArray, triangles: IntArray) -> IntArray:
    """Sides (n, 2) of Delaunay triangles, each once, but for those between four on one circle.

    Either diagonal of four points on a circle will do; which one stands must not draw points.
    """
    corners = points[triangles]
    u, v = (np.roll(corners, -k, axis=1) - corners for k in (1, 2))  # towards the opposite side
    opposite = (u * v).sum(axis=2) / cross(u, v)
    sides = np.sort(np.stack([np.roll(triangles, -k, axis=1) for k in (1, 2)], axis=2), axis=2)
    found, inverse = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
    inverse = inverse.ravel()
    both = np.bincount(inverse) == 2
    tied = np.abs(np.bincount(inverse, opposite.ravel())) < 1e-9  # sum of cotangents
    return found[~(both & tied)]


def sides_of(cells: IntArray) -> IntArray:
    """Sides (n, 2) of polygons (c, k), each once."""
    k = cells.shape[1]
    table = np.vstack([cells[:, [i, (i + 1) % k]] for i in range(k)])
    return np.unique(np.sort(table, axis=1), axis=0)


def split_contour(contour: Mesh, first: Mesh, second: Mesh) -> tuple[Mesh, Mesh, Mesh]:
    """The segment from `first` to `second`, the contour that holds it and the one that holds its
    inverse, both in the sense of the contour given.

    A line that is not closed (one that an axis of revolution closes) gives a line and a contour.

    Raises
    ------
    MeshError
        If the contour is no single line of SEG2, if one of the sets has no node on it, or the two
        nodes are neighbours on it.
    """
    nodes = contour.nodes
    ring = _in_order(contour)
    closed = ring[0] == ring[-1]
    chain = ring[:-1] if closed else ring
    a, b = _nearest(nodes.coordinates, _on(chain, first, "second"), _on(chain, second, "third"))
    i, j = int(np.flatnonzero(chain == a)[0]), int(np.flatnonzero(chain == b)[0])
    if abs(i - j) == 1 or (closed and abs(i - j) == len(chain) - 1):
        raise MeshError("kernel.mesh.nearest-nodes-neighbours-contour", a=a + 1, b=b + 1)
    if closed:
        chain = np.roll(chain, -i)
        j = (j - i) % len(chain)
        away, home = np.append(chain[: j + 1], a), np.append(chain[j:], [a, b])
        parts = (_line(home), _line(away))
    elif i < j:
        parts = (_line(np.concatenate([chain[: i + 1], chain[j:]])),
                 _line(np.append(chain[i : j + 1], a)))  # fmt: skip
    else:
        parts = (_line(np.append(chain[j : i + 1], b)),
                 _line(np.concatenate([chain[: j + 1], chain[i:]])))  # fmt: skip
    colour = contour.blocks[0].colours[0]
    made = [Mesh.of(nodes, "SEG2", cells, int(colour)) for cells in (np.array([[a, b]]), *parts)]
    return made[0], made[1], made[2]


def _line(chain: IntArray) -> IntArray:
    return np.column_stack([chain[:-1], chain[1:]])


def _in_order(contour: Mesh) -> IntArray:
    """Nodes along the line, the first again at the end of a closed one."""
    if any(b.cell_type != "SEG2" for b in contour.blocks) or not contour.n_cells:
        raise MeshError("kernel.mesh.contour-seg2-needed")
    cells = chained(contour).single_block().connectivity
    if not np.array_equal(cells[1:, 0], cells[:-1, 1]):
        raise MeshError("kernel.mesh.contour-not-line")
    return np.append(cells[:, 0], cells[-1, 1])


def _on(chain: IntArray, mesh: Mesh, which: str) -> IntArray:
    found = np.intersect1d(chain, mesh.sorted_node_ids)
    if not len(found):
        raise MeshError("kernel.mesh.mesh-no-node-contour", which=which)
    return found


def _nearest(x: np.ndarray, first: IntArray, second: IntArray) -> tuple[int, int]:
    """The two different nodes of smallest distance."""
    away = np.linalg.norm(x[first][:, None] - x[second][None], axis=2)
    away[first[:, None] == second[None]] = np.inf
    if not np.isfinite(away).any():
        raise MeshError("kernel.mesh.two-meshes-same-node")
    i, j = np.unravel_index(int(away.argmin()), away.shape)
    return int(first[i]), int(second[j])
