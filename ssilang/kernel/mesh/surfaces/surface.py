"""Surfaces inside closed contours, of triangles, paired to quadrangles, or whole polygons.

A mesh as a surface (a line in the plane) of flat facets, for projections on it.
"""

from collections import deque

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import chained, envelope, walked
from ssilang.kernel.mesh.cells import POLYGON_SIDES
from ssilang.kernel.mesh.changes.degree import quadratic
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.surfaces import fill
from ssilang.kernel.mesh.surfaces.analytic import Shape
from ssilang.kernel.mesh.surfaces.charts import Chart
from ssilang.kernel.mesh.surfaces.grid import grid_surface
from ssilang.kernel.mesh.surfaces.triangulate import cross

MOST_SIDES = 12
FLATTEST = 0.05
"""Least sine of the angle between two sides in a row."""


def join_triangles(points: FloatArray, triangles: IntArray, fixed: int) -> dict[int, IntArray]:
    """Polygons by number of sides, and the triangles that are left.

    Parameters
    ----------
    points : array (m, 2)
    triangles : array (t, 3)
        Anticlockwise.
    fixed : int
        The first points lie on the contour and stay.

    Returns
    -------
    dict of int to array (n, sides)
        Node numbers anticlockwise. The nodes in the middle of polygons are in none of them.

    Notes
    -----
    In a regular net of triangles every third node, taken in rings from the first one, is the
    middle of a hexagon and no triangle is left.
    """
    ring = _rings(triangles)
    taken = np.zeros(len(points), dtype=bool)  # in a polygon's middle, or beside one
    used: set[int] = set()
    found: dict[int, list[list[int]]] = {}
    for node in _in_rings(ring, fixed):
        around = ring[node]
        corners = _closed([pair for _, pair in around])
        if taken[node] or corners is None or not 4 < len(corners) <= MOST_SIDES:
            continue
        if any(t in used for t, _ in around) or not _convex(points[corners]):
            continue
        used.update(t for t, _ in around)
        taken[corners] = True
        found.setdefault(len(corners), []).append(corners)
    rest = [t for t in range(len(triangles)) if t not in used]
    tables = {n: np.array(rows, dtype=np.int64) for n, rows in sorted(found.items())}
    if rest:
        tables = {3: triangles[rest]} | tables
    return tables


def _rings(triangles: IntArray) -> dict[int, list[tuple[int, tuple[int, int]]]]:
    """For each node its triangles and the side of each that faces it."""
    ring: dict[int, list[tuple[int, tuple[int, int]]]] = {}
    for t, (a, b, c) in enumerate(triangles.tolist()):
        for node, side in ((a, (b, c)), (b, (c, a)), (c, (a, b))):
            ring.setdefault(node, []).append((t, side))
    return ring


def _in_rings(ring: dict[int, list[tuple[int, tuple[int, int]]]], fixed: int) -> list[int]:
    """Inner nodes, each followed by those two sides away: the middles of a regular net first."""
    order: list[int] = []
    seen: set[int] = set()
    for start in sorted(n for n in ring if n >= fixed):
        queue = deque([start])
        while queue:
            node = queue.popleft()
            if node in seen or node < fixed:
                continue
            seen.add(node)
            order.append(node)
            near = {p for _, pair in ring[node] for p in pair}
            queue += sorted(_across(ring, node) - near)
    return order


def _across(ring: dict[int, list[tuple[int, tuple[int, int]]]], node: int) -> set[int]:
    """Nodes that face this one over a side of its ring: the middles of neighbouring hexagons."""
    facing = set()
    for t, (p, q) in ring[node]:
        for other, (a, b) in ring[p]:
            if other != t and q in (a, b):
                facing.add(a + b - q)
    return facing - {node}


def _closed(sides: list[tuple[int, int]]) -> list[int] | None:
    """Corners in order when the sides form one loop."""
    following = dict(sides)
    start = sides[0][0]
    corners = [start]
    while len(corners) <= len(sides):
        step = following.get(corners[-1])
        if step is None:
            return None
        if step == start:
            return corners if len(corners) == len(sides) else None
        corners.append(step)
    return None


def _convex(corners: FloatArray) -> bool:
    way = np.roll(corners, -1, axis=0) - corners
    way /= np.linalg.norm(way, axis=1)[:, None]
    before = np.roll(way, 1, axis=0)
    return bool(cross(before, way).min() > FLATTEST)


_WORST = 0.15  # quadrangles with a corner further than this part of 90 degrees from flat are made


def pair_triangles(points: FloatArray, triangles: IntArray) -> tuple[IntArray, IntArray]:
    """Quadrangles (q, 4) from pairs of adjacent triangles, squarest first, and the rest.

    Parameters
    ----------
    points : array (m, 2)
    triangles : array (t, 3)
        Anticlockwise.

    Returns
    -------
    quadrangles : array (q, 4)
    triangles : array (r, 3)
    """
    left, right, quads = _pairs(triangles)
    if not len(quads):
        return np.empty((0, 4), dtype=np.int64), triangles
    shape = squareness(points, quads)
    free = np.ones(len(triangles), dtype=bool)
    chosen = []
    for k in np.argsort(-shape, kind="stable").tolist():
        if shape[k] < _WORST:
            break
        if free[left[k]] and free[right[k]]:
            free[left[k]] = free[right[k]] = False
            chosen.append(k)
    return quads[chosen], triangles[free]


def squareness(points: FloatArray, quads: IntArray) -> FloatArray:
    """1 for rectangles, 0 or less when a corner is flat or re-entrant, shape (q,)."""
    x = points[quads]
    before, after = np.roll(x, 1, axis=1) - x, np.roll(x, -1, axis=1) - x
    angle = np.arctan2(cross(after, before), (after * before).sum(axis=2)) % (2 * np.pi)
    return 1.0 - np.abs(angle - np.pi / 2).max(axis=1) / (np.pi / 2)


def _pairs(triangles: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Adjacent triangles (numbers, numbers) and the quadrangle that each pair makes."""
    sides, owner, twin, paired = fill.sides_and_twins(triangles)
    apex = np.concatenate([triangles[:, 2], triangles[:, 0], triangles[:, 1]])
    pick = np.flatnonzero(paired & (owner < owner[twin]))
    other = twin[pick]
    quads = np.column_stack([sides[pick, 0], apex[other], sides[pick, 1], apex[pick]])
    return owner[pick], owner[other], quads


def contour_cells(contour: Mesh) -> IntArray:
    """Cells (n, 2 or 3) of a closed contour, ends first and last.

    Raises
    ------
    MeshError
        If it holds other cells than lines of one degree, or is not closed.
    """
    lines = [b for b in contour.blocks if b.cell_type in ("SEG2", "SEG3")]
    if not lines or len({b.cell_type for b in lines}) > 1:
        kinds = [b.cell_type for b in contour.blocks]
        raise MeshError("kernel.mesh.contour-seg2-seg3-needed", kinds=kinds)
    cells = np.concatenate([b.connectivity for b in lines])
    leaving, arriving = np.sort(cells[:, 0]), np.sort(cells[:, -1])
    if not np.array_equal(leaving, arriving):
        ends, times = np.unique(cells[:, [0, -1]], return_counts=True)
        open_ends = ends[times % 2 == 1]
        if len(open_ends):
            told = [contour.nodes.told(n) for n in open_ends[:4]]
            raise MeshError("kernel.mesh.contour-not-closed-line", nodes=told)
        if (times != 2).any():
            raise MeshError("kernel.mesh.lines-contour-not-run")
        return walked(cells, cells[:, 0])[0]
    return cells


def contour_chart_data(contour: Mesh) -> tuple[FloatArray, FloatArray]:
    """Positions (m, 3) of a contour's nodes and its directed straight segments (n, 2, 3)."""
    cells = contour_cells(contour)
    xyz = contour.nodes.coordinates
    pairs = np.vstack([cells[:, k : k + 2] for k in range(cells.shape[1] - 1)])
    return xyz[np.unique(cells)].copy(), xyz[pairs].copy()


def fill_surface(
    contour: Mesh,
    chart: Chart,
    surface: str,
    colour: int = 0,
    sizes: tuple[FloatArray, FloatArray] | None = None,
) -> Mesh:
    """The mesh inside a contour, described in the contour's sense.

    Parameters
    ----------
    chart : Chart
        Lays the surface flat; the outer contour turns anticlockwise in it.
    surface : str
        'TRI3', 'TRI6', 'QUA4', 'QUA8' or 'POLY'; quadrangles and polygons leave some
        triangles. A contour of SEG3 gives quadratic cells, one of SEG2 linear cells in any case.
    sizes : (array (m, 3), array (m,)) or None
        Positions and wanted sizes there; None takes the lengths of the contour's sides.
    """
    nodes = contour.nodes
    cells = contour_cells(contour)
    if surface == "POLY" and cells.shape[1] > 2:
        raise MeshError("kernel.mesh.polygons-straight-sides-contour")
    if surface.startswith("QUA") and sizes is None:
        regular = _as_grid(contour, chart, colour)
        if regular is not None:
            return Mesh(nodes, regular.blocks, (contour,))
    ids, local = np.unique(cells[:, [0, -1]], return_inverse=True)
    segments = local.reshape(-1, 2).astype(np.int64)
    flat = chart.flatten(nodes.coordinates[ids].copy())
    a, b = flat[segments[:, 0]], flat[segments[:, 1]]
    turned = cross(a, b).sum() < 0
    if turned:
        flat = flat * [1.0, -1.0]
    at, wanted = (flat, fill.mean_sizes(flat, segments))
    if sizes is not None:
        at, wanted = chart.flatten(sizes[0]), sizes[1]
        at = at * [1.0, -1.0] if turned else at
    squares = surface.startswith("QUA")
    points, triangles = fill.fill_contour(flat, segments, fill.SizeField(at, wanted), squares)
    points = fill.smooth(points, fill.certain_sides(points, triangles), len(flat))
    if surface == "POLY":
        polygons = [*join_triangles(points, triangles, len(flat)).values()]
        points, polygons = fill.without_unused(points, polygons, len(flat))
    else:
        polygons = [triangles]
    if squares:
        quads, rest = pair_triangles(points, triangles)
        polygons = [quads, rest]
    links = np.unique(np.vstack([fill.sides_of(p) for p in polygons if len(p)]), axis=0)
    if squares:
        points = fill.smooth(points, links, len(flat))
    new = points[len(flat) :] * ([1.0, -1.0] if turned else [1.0, 1.0])
    made = nodes.add(chart.lift(new), fill.mean_sizes(points, links)[len(flat) :])
    table = np.concatenate([ids, made])
    tables = [_from_smallest(table[p]) for p in polygons if len(p)]
    names = {3: "TRI3", 4: "QUA4"} | {n: name for name, n in POLYGON_SIDES.items()}
    blocks = tuple(CellBlock.make(nodes, names[t.shape[1]], t, colour) for t in tables)
    mesh = Mesh(nodes, blocks)
    if cells.shape[1] == 3:
        before = len(nodes)
        mesh = quadratic(mesh, contour)
        fresh = nodes.coordinates[before:]
        fresh[:] = chart.lift(chart.flatten(fresh.copy()))
    return Mesh(nodes, mesh.blocks, (contour,))


def _from_smallest(polygons: IntArray) -> IntArray:
    """Polygons (n, k) turned so that each starts with its oldest node."""
    k = polygons.shape[1]
    start = np.asarray(polygons.argmin(axis=1), dtype=np.int64)
    return np.take_along_axis(polygons, (start[:, None] + np.arange(k)) % k, axis=1)


def _as_grid(contour: Mesh, chart: Chart, colour: int) -> Mesh | None:
    """A grid, when the contour is one loop of four corners whose opposite sides match."""
    cells = contour_cells(contour)
    name = "SEG2" if cells.shape[1] == 2 else "SEG3"
    block = chained(Mesh.of(contour.nodes, name, cells)).single_block()
    table = block.connectivity
    if not np.array_equal(table[:, -1], np.roll(table[:, 0], -1)):
        return None
    way = chart.flatten(contour.nodes.coordinates[table[:, -1]].copy())
    way -= chart.flatten(contour.nodes.coordinates[table[:, 0]].copy())
    before = np.roll(way, 1, axis=0)
    turn = np.arctan2(cross(before, way), (before * way).sum(axis=1))
    corners = np.flatnonzero(np.abs(turn) > np.pi / 4)
    counts = np.diff(np.append(corners, corners[:1] + len(table)))
    if len(corners) != 4 or not np.array_equal(counts[:2], counts[2:]):
        return None
    sides = []
    for start, count in zip(corners, counts, strict=True):
        rows = np.arange(int(start), int(start) + int(count)) % len(table)
        sides.append(Mesh.of(contour.nodes, block.cell_type, table[rows]))
    made = grid_surface(sides, chart, colour, rings=True)
    quads = made.single_block().connectivity[:, :: 1 if block.cell_type == "SEG2" else 2]
    ids, local = np.unique(quads, return_inverse=True)
    flat = chart.flatten(contour.nodes.coordinates[ids].copy())
    sense = float(np.sign(turn[corners].sum()))
    shape = squareness(flat * [1.0, sense], local.reshape(quads.shape).astype(np.int64))
    return made if shape.min() > 0.4 else None


_EDGE = 1e-9  # how far outside of a facet a hit still counts, relative to the facet
_AT_ONCE = 2_000_000  # pairs of a ray and a facet looked at together


def facet_shape(mesh: Mesh) -> Shape:
    """The skin of volumes, the surfaces and the lines of a mesh; distances are not known.

    A cell with more than three nodes is a fan of triangles around the mean of its nodes, a
    quadratic line its two halves.

    Raises
    ------
    MeshError
        If the mesh has only points.
    """
    blocks = (*mesh.blocks, *envelope(mesh).blocks)
    flat = [_triangles(b.coordinates) for b in blocks if b.kind.dimension == 2]
    lines = [_segments(b.coordinates) for b in blocks if b.kind.dimension == 1]
    if not flat and not lines:
        raise MeshError("kernel.mesh.no-facets-to-project-on")
    corners = np.concatenate([*flat, *lines])

    def hit(x: FloatArray, rays: FloatArray) -> FloatArray:
        count = max(1, _AT_ONCE // len(corners))
        parts = [
            _nearest_hit(x[k : k + count], rays[k : k + count], corners)
            for k in range(0, len(x), count)
        ]
        return np.concatenate(parts) if parts else x

    return Shape(lambda x: np.full(len(x), np.nan), hit)


def _triangles(nodes: FloatArray) -> FloatArray:
    """Triangles (t, 3, 3) of cells (n, k, 3) whose nodes go round them."""
    if nodes.shape[1] == 3:
        return nodes
    following = np.roll(nodes, -1, axis=1)
    middle = np.broadcast_to(nodes.mean(axis=1, keepdims=True), nodes.shape)
    return np.stack([nodes, following, middle], axis=2).reshape(-1, 3, 3)


def _segments(nodes: FloatArray) -> FloatArray:
    """Lines of the plane as triangles (t, 3, 3) that stand on it: what crosses them in it."""
    ends = np.stack([nodes[:, :-1], nodes[:, 1:]], axis=2).reshape(-1, 2, 3)
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    above = ends[:, 0] + length[:, None] * np.array([0.0, 0.0, 1.0])
    return np.concatenate([ends, above[:, None]], axis=1)


def _nearest_hit(x: FloatArray, rays: FloatArray, corners: FloatArray) -> FloatArray:
    """Where lines through positions (m, 3) along rays (m, 3) meet triangles (t, 3, 3), or NaN.

    T. Moeller, B. Trumbore, Fast minimum storage ray-triangle intersection, 1997.
    """
    origin = corners[:, 0]
    one, two = corners[:, 1] - origin, corners[:, 2] - origin
    across = np.cross(rays[:, None], two[None])  # (m, t, 3)
    volume = np.einsum("td,mtd->mt", one, across)
    size = np.linalg.norm(np.cross(one, two), axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        arm = x[:, None] - origin[None]
        first = np.einsum("mtd,mtd->mt", arm, across) / volume
        turned = np.cross(arm, one[None])
        second = np.einsum("md,mtd->mt", rays, turned) / volume
        way = np.einsum("td,mtd->mt", two, turned) / volume
        inside = (first >= -_EDGE) & (second >= -_EDGE) & (first + second <= 1 + _EDGE)
    inside &= np.abs(volume) > 1e-12 * size
    away = np.where(inside, np.abs(way), np.inf)
    best = np.argmin(away, axis=1)
    rows = np.arange(len(x))
    made: FloatArray = x + way[rows, best, None] * rays
    made[~np.isfinite(away[rows, best])] = np.nan
    return made
