"""Constrained Delaunay triangulation of plane points inside closed contours.

Triangles refined, or inside plane lines of which some end inside or cut the domain in parts.
"""

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.mesh.boundary import contour
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.queries.select import crossing_inside
from ssilang.kernel.mesh.surfaces.charts import plane_chart
from ssilang.kernel.mesh.surfaces.fill import SizeField, boundary_sizes, fill_contour
from ssilang.kernel.mesh.surfaces.surface import contour_cells, contour_chart_data


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
    from scipy.spatial import Delaunay, QhullError

    low, high = points.min(axis=0), points.max(axis=0)
    middle, reach = (low + high) / 2, 8.0 * float((high - low).max())
    far = middle + reach * np.array([[-1.0, -0.9], [1.0, -1.1], [0.9, 1.0], [-1.1, 1.1]])
    try:
        table = Delaunay(np.vstack([points, far]) - middle).simplices.astype(np.int64)
    except QhullError as error:
        raise MeshError("kernel.mesh.points-contour-cannot-triangulated") from error
    table = table[(table < len(points)).all(axis=1)]
    areas = doubled_areas(points, table)
    table[areas < 0] = table[areas < 0][:, ::-1]
    return table


def doubled_areas(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Twice the signed areas of triangles (t, 3) of points (m, 2)."""
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    return _cross(b - a, c - a)


def _cross(u: FloatArray, v: FloatArray) -> FloatArray:
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
    side = _cross(way[None], points - points[a])
    tiny = 1e-12 * float(way @ way)
    hit = np.zeros(len(triangles), dtype=bool)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        p, q = triangles[:, i], triangles[:, j]
        free = (p != a) & (p != b) & (q != a) & (q != b)
        apart = side[p] * side[q] < 0
        s = points[q] - points[p]
        over = _cross(s, points[a] - points[p]) * _cross(s, points[b] - points[p]) < 0
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
    return np.asarray(centred @ axes[:2].T)


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
    return np.asarray(np.round(steps[part]) % 2 == 1)


def refined_triangles(
    mesh: Mesh, ids: IntArray, sizes: FloatArray, colour: int = 0, limit: int | None = None
) -> Mesh:
    """A plane mesh of TRI3 with points added inside until its triangles have the wanted sizes.

    Parameters
    ----------
    ids, sizes : array (n,)
        Nodes of the mesh, which are all kept, and the sizes wanted there; where none is (0),
        the border's sides say it.
    limit : int, optional
        Most nodes of the result: the sizes grow alike until it is kept.

    Raises
    ------
    MeshError
        If the mesh has more nodes than that already.
    """
    if limit is not None and limit < len(ids):
        raise MeshError("kernel.mesh.limit-below-nodes", limit=limit, n_nodes=len(ids))
    border = contour(mesh)
    chart = plane_chart(*contour_chart_data(border))
    nodes = mesh.nodes
    edge = contour_cells(border)
    first = np.unique(edge)
    every = np.concatenate([first, np.setdiff1d(ids, first)])
    number = np.zeros(int(every.max()) + 1, dtype=np.int64)
    number[every] = np.arange(len(every))
    flat = chart.flatten(nodes.coordinates[every].copy())
    at = chart.flatten(nodes.coordinates[ids].copy())
    own = boundary_sizes(flat, number[edge])[number[ids]]
    sizes = np.where(sizes > 0.0, sizes, own)
    known = sizes > 0.0  # within the border those without a size follow the others
    at, sizes = at[known], sizes[known]
    field = SizeField(at, sizes)
    points, triangles = fill_contour(flat, number[edge], field, squares=False)
    while limit is not None and len(points) > limit:
        sizes = sizes * max(1.1, np.sqrt(len(points) / limit))
        field = SizeField(at, sizes)
        points, triangles = fill_contour(flat, number[edge], field, squares=False)
    fresh = points[len(every) :]
    made = nodes.add(chart.lift(fresh), field(fresh)) if len(fresh) else fresh[:, 0].astype(int)
    table = np.concatenate([every, made])
    return Mesh.of(nodes, "TRI3", table[triangles], colour)


def delaunay_mesh(mesh: Mesh, dimension: int, colour: int = 0) -> Mesh:
    """The Delaunay triangulation of a mesh's nodes: TRI3 in 2D, TET4 in 3D.

    Raises
    ------
    MeshError
        If the points are too few or lie in one line or plane.
    """
    from scipy.spatial import Delaunay, QhullError

    ids = mesh.node_ids
    if not len(ids):
        raise MeshError("kernel.mesh.mesh-empty-nothing-triangulate")
    at = mesh.nodes.coordinates[ids, :dimension]
    try:
        cells = Delaunay(at).simplices.astype(np.int64)
    except QhullError as error:
        raise MeshError("kernel.mesh.points-too-few-line") from error
    arms = at[cells[:, 1:]] - at[cells[:, :1]]
    negative = np.linalg.det(arms) < 0
    cells[negative, :2] = cells[negative, 1::-1]
    return Mesh.of(mesh.nodes, "TRI3" if dimension == 2 else "TET4", ids[cells], colour)
