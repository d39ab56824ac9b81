"""Two surfaces of triangles, in space, cut along the lines where they cross."""

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.queries.select import places_once, segment_distance
from ssilang.kernel.mesh.surfaces.triangulate import doubled_areas, recover_segments

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
    middle_a, middle_b = a.mean(axis=1), b.mean(axis=1)
    reach_a = np.linalg.norm(a - middle_a[:, None], axis=2).max(axis=1)
    reach_b = np.linalg.norm(b - middle_b[:, None], axis=2).max(axis=1)
    found = spatial.cKDTree(middle_b).query_ball_point(middle_a, reach_a + reach_b.max())
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
    return (h > 0).all(axis=1) | (h < 0).all(axis=1) | (h == 0).all(axis=1)


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
    return (vectors * way).sum(axis=1)


def _further(p: FloatArray, q: FloatArray, way: FloatArray) -> FloatArray:
    """Of each pair of points, the one further along."""
    return np.where(_along(q - p, way)[:, None] > 0, q, p)


SAME_PLACE = 1e-9
"""Points closer than this share of the smallest bounding box are one point."""
ON_SIDE = 4.0
"""Points are on a side within so many times that: joined points have moved that little."""


def crossed(first: Mesh, second: Mesh) -> tuple[Mesh, Mesh, Mesh, Mesh]:
    """Both surfaces with their triangles cut along the common lines, and those lines.

    The surfaces keep their own nodes: the third mesh is the lines by nodes of the first surface,
    the fourth the same lines by nodes of the second. Triangles that are not cut stay as they are.
    Parts where the surfaces lie in each other give no line; surfaces that do not cross give
    empty lines.

    Raises
    ------
    MeshError
        If other cells than TRI3 are given.
    """
    nodes = first.nodes
    a, b = _triangles(first), _triangles(second)
    xyz = nodes.coordinates
    rows_a, rows_b, ends = crossing_segments(xyz[a], xyz[b])
    boxes = [float(np.ptp(xyz[t.ravel()], axis=0).max()) for t in (a, b)]
    near = SAME_PLACE * min(boxes)
    points, pieces = places_once(ends.reshape(-1, 3), near)
    new_a, line_a = _imprint(first, a, rows_a, points, pieces.reshape(-1, 2), near)
    new_b, line_b = _imprint(second, b, rows_b, points, pieces.reshape(-1, 2), near)
    return new_a, new_b, line_a, line_b


def _triangles(surface: Mesh) -> IntArray:
    kinds = {b.cell_type for b in surface.blocks}
    if kinds != {"TRI3"}:
        raise MeshError("kernel.mesh.surfaces-tri3-needed-cross", kinds=sorted(kinds))
    return np.vstack([b.connectivity for b in surface.blocks])


def _imprint(
    surface: Mesh,
    table: IntArray,
    rows: IntArray,
    points: FloatArray,
    pieces: IntArray,
    near: float,
) -> tuple[Mesh, Mesh]:
    """A surface cut along segments, and the line that they make.

    Parameters
    ----------
    table : array (n, 3)
        Triangles of the surface.
    rows : array (k,)
        Triangle in which each segment lies.
    points, pieces : array (p, 3), array (k, 2)
        Places, and the segments between them.
    """
    nodes = surface.nodes
    ids = _nodes_at(surface, points, near)
    marks = ids[pieces]
    inside: dict[int, list[tuple[int, int]]] = {}
    for row, (p, q) in zip(rows.tolist(), marks.tolist(), strict=True):
        held = inside.setdefault(row, [])
        if p != q and not {(p, q), (q, p)} & set(held):
            held.append((p, q))
    on_sides = _on_sides(nodes.coordinates, table, inside, near)
    colours = np.concatenate([b.colours for b in surface.blocks])
    made, parent = [], []
    for row, corners in enumerate(table.tolist()):
        ring = _ring(nodes.coordinates, corners, on_sides)
        if len(ring) == 3 and row not in inside:
            fresh = [corners]
        else:
            segments = inside.get(row, [])
            fresh = _cut_in_two(ring, corners, segments) or _cut(
                nodes.coordinates, ring, corners, on_sides, segments
            )
        made.extend(fresh)
        parent.extend([row] * len(fresh))
    line = _walk({(min(p, q), max(p, q)): (p, q) for s in inside.values() for p, q in s})
    cut = Mesh.of(nodes, "TRI3", np.array(made, dtype=np.int64), colours[parent])
    return cut, Mesh.of(nodes, "SEG2", line) if len(line) else Mesh(nodes, ())


def _nodes_at(surface: Mesh, points: FloatArray, near: float) -> IntArray:
    """Nodes of the surface at places, new ones where it has none."""
    nodes, own = surface.nodes, surface.node_ids
    if not len(points):
        return np.empty(0, dtype=np.int64)
    gap, nearest = spatial.cKDTree(nodes.coordinates[own]).query(points)
    ids: IntArray = own[nearest]
    new = gap > near
    ids[new] = nodes.add(points[new], nodes.density[ids[new]])
    return ids


Sides = dict[tuple[int, int], set[int]]


def _on_sides(
    xyz: FloatArray, table: IntArray, inside: dict[int, list[tuple[int, int]]], near: float
) -> Sides:
    """Nodes of the segments that lie on sides of triangles, by side."""
    found: Sides = {}
    for row, segments in inside.items():
        corners = table[row].tolist()
        met = sorted({p for s in segments for p in s} - set(corners))
        for k in range(3):
            p, q = corners[k], corners[(k + 1) % 3]
            away = segment_distance(xyz[met], xyz[[p]], xyz[[q]])
            on = {node for node, d in zip(met, away.tolist(), strict=True) if d <= ON_SIDE * near}
            if on:
                found.setdefault((min(p, q), max(p, q)), set()).update(on)
    return found


def _ring(xyz: FloatArray, corners: list[int], on_sides: Sides) -> list[int]:
    """Nodes around a triangle, those on its sides included."""
    ring: list[int] = []
    for k in range(3):
        p, q = corners[k], corners[(k + 1) % 3]
        between = on_sides.get((min(p, q), max(p, q)), ())
        ring += [p, *sorted(between, key=lambda n: float(np.linalg.norm(xyz[n] - xyz[p])))]
    return ring


def _cut_in_two(
    ring: list[int], corners: list[int], segments: list[tuple[int, int]]
) -> list[list[int]]:
    """The commonest cut, one segment from side to side: a corner, and a quadrangle in two.

    The quadrangle is cut from the first corner of the parent that it has. Empty where the
    segment starts at a corner, or the ring has other nodes.
    """
    new = [node for node in ring if node not in corners]
    if len(ring) != 5 or len(segments) != 1 or set(segments[0]) != set(new):
        return []
    at = [ring.index(node) for node in new]
    if at[1] - at[0] == 2:
        tip, rest = ring[at[0] : at[1] + 1], ring[at[1] :] + ring[: at[0] + 1]
    else:
        tip, rest = ring[at[1] :] + ring[: at[0] + 1], ring[at[0] : at[1] + 1]
    start = min((rest.index(c) for c in corners if c in rest), key=lambda k: corners.index(rest[k]))
    a, b, c, d = rest[start:] + rest[:start]
    return [tip, [a, b, c], [a, c, d]]


def _cut(
    xyz: FloatArray,
    ring: list[int],
    corners: list[int],
    on_sides: Sides,
    segments: list[tuple[int, int]],
) -> list[list[int]]:
    """Triangles, turning as the parent, of a triangle that has segments in it.

    The sides that carry nodes are bent outwards a little, so that the ring is strictly convex
    and a Delaunay triangulation has all its sides; the least bend that leaves every triangle
    upright is as good as the next, so smaller ones are tried where a large one fails.

    Raises
    ------
    MeshError
        If the segments cross each other.
    """
    keys = [(min(p, q), max(p, q)) for p, q in _turns(corners)]
    along = [on_sides.get(key, set()) | set(key) for key in keys]
    across = [s for s in segments if not any(s[0] in side and s[1] in side for side in along)]
    every = ring + sorted({p for s in segments for p in s} - set(ring))
    place = {node: i for i, node in enumerate(every)}
    flat = _flattened(xyz, every, corners)
    wanted = [(place[p], place[q]) for p, q in _turns(ring) + across]
    for bend in (1e-2, 1e-4, 1e-6):
        table = _delaunay_cut(_bent(flat, ring, corners, place, bend), np.array(wanted))
        if (doubled_areas(flat, table) > 0).all():
            return [[every[k] for k in row] for row in table.tolist()]
    raise MeshError("kernel.mesh.triangle-surface-cuts-cannot")


def _turns(ring: list[int]) -> list[tuple[int, int]]:
    return list(zip(ring, [*ring[1:], ring[0]], strict=True))


def _flattened(xyz: FloatArray, every: list[int], corners: list[int]) -> FloatArray:
    """Coordinates (m, 2) in the triangle's plane, in which it turns anticlockwise."""
    o, p, q = xyz[corners]
    x = (p - o) / np.linalg.norm(p - o)
    y = (q - o) - ((q - o) @ x) * x
    axes = np.column_stack([x, y / np.linalg.norm(y)])
    return (xyz[every] - o) @ axes


def _bent(
    flat: FloatArray, ring: list[int], corners: list[int], place: dict[int, int], bend: float
) -> FloatArray:
    """The same places, those on the sides moved outwards on parabolas."""
    bent = flat.copy()
    at = 0
    for p, q in _turns(corners):
        a, b = flat[place[p]], flat[place[q]]
        out = np.array([b[1] - a[1], a[0] - b[0]])
        at += 1
        while at < len(ring) and ring[at] != q:
            s = float((flat[place[ring[at]]] - a) @ (b - a)) / float((b - a) @ (b - a))
            bent[place[ring[at]]] += bend * 4.0 * s * (1.0 - s) * out
            at += 1
    return bent


def _delaunay_cut(points: FloatArray, segments: IntArray) -> IntArray:
    """Anticlockwise Delaunay triangles (t, 3) of a convex cloud that have the segments."""
    table = spatial.Delaunay(points).simplices.astype(np.int64)
    turned = doubled_areas(points, table) < 0
    table[turned] = table[turned][:, ::-1]
    return recover_segments(points, table, segments)


def _walk(pieces: dict[tuple[int, int], tuple[int, int]]) -> IntArray:
    """Segments (k, 2), each once, one behind the other as far as they go."""
    left = dict(pieces)
    around: dict[int, list[tuple[int, int]]] = {}
    for pair in left:
        for node in pair:
            around.setdefault(node, []).append(pair)
    ends = [n for n, keys in around.items() if len(keys) != 2]
    walked: list[tuple[int, int]] = []
    for start in [*ends, *around]:
        at = start
        while (key := next((k for k in around[at] if k in left), None)) is not None:
            del left[key]
            following = key[1] if key[0] == at else key[0]
            walked.append((at, following))
            at = following
    return np.array(walked, dtype=np.int64).reshape(-1, 2)
