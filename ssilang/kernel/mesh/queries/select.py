"""Cells and nodes picked from a mesh by what they touch, hold, or lie near to."""

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.mesh.boundary import sharing
from ssilang.kernel.mesh.changes.split import tetrahedra
from ssilang.kernel.mesh.combine import take
from ssilang.kernel.mesh.lines.curves import unit_vector
from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def resting_on(mesh: Mesh, ids: IntArray, strictly: bool) -> Mesh:
    """Cells with all nodes (strictly) or one node at least (else) among `ids` (m,)."""
    inside = np.zeros(len(mesh.nodes), dtype=bool)
    inside[mesh.nodes.resolve(ids)] = True
    test = np.all if strictly else np.any
    return take(mesh, lambda b: test(inside[b.connectivity], axis=1))


def containing(mesh: Mesh, position: FloatArray, every: bool = False) -> Mesh:
    """The first cell (every cell) that contains a position (3,), boundary included."""
    found = take(mesh, lambda b: cells_containing(b, position))
    if every or not found.blocks:
        return found
    return Mesh(mesh.nodes, (found.blocks[0].some(slice(1)),))


def cells_containing(block: CellBlock, position: FloatArray) -> BoolArray:
    """Which cells (n,) contain a position (3,); quadratic cells count with straight sides."""
    x = block.coordinates
    size = np.linalg.norm(x.max(axis=1) - x.min(axis=1), axis=1)
    tolerance = 1e-8
    if block.kind.dimension == 0:
        scale = max(1.0, float(np.abs(position).max()))
        return np.asarray(np.linalg.norm(x[:, 0] - position, axis=1) <= tolerance * scale)
    corners = x[:, list(block.kind.corners)]
    inside = np.zeros(len(block), dtype=bool)
    for simplex in simplices(block):
        weights, off = feet(corners[:, list(simplex)], position)
        within = (weights >= -tolerance).all(axis=1) & (weights.sum(axis=1) <= 1.0 + tolerance)
        inside |= within & (off <= 10 * tolerance * size)
    return inside


# corners of simplices that make up a cell: enough for point location in cells with flat sides
_SIMPLICES: dict[int, dict[int, tuple[tuple[int, ...], ...]]] = {
    1: {2: ((0, 1),)},
    3: {
        4: ((0, 1, 2, 3),),
        5: ((0, 1, 2, 4), (0, 2, 3, 4)),
        6: ((0, 1, 2, 3), (1, 2, 3, 4), (2, 3, 4, 5)),
        8: ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)),
    },
}


def simplices(block: CellBlock) -> tuple[tuple[int, ...], ...]:
    """Triangles or tetrahedra that fill a cell, as places among its corners."""
    count = len(block.kind.corners)
    if block.kind.dimension == 2:  # polygons are convex
        return tuple((0, i, i + 1) for i in range(1, count - 1))
    return _SIMPLICES[block.kind.dimension][count]


_FLAT = 1e-14  # of the product of a simplex' squared sides: without measure


def feet(corners: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Feet of points (n, 3) or (3,) in simplices (n, d + 1, 3): weights (n, d), distances (n,).

    The weights are those of the corners but the first. The distance to a flat one is infinite.
    """
    edges = corners[:, 1:] - corners[:, :1]
    gram = np.einsum("nid,njd->nij", edges, edges)
    flat = np.linalg.det(gram) <= _FLAT * np.einsum("nii->ni", gram).prod(axis=1)
    gram[flat] = np.eye(edges.shape[1])
    arm = points - corners[:, 0]
    weights = np.linalg.solve(gram, np.einsum("nid,nd->ni", edges, arm)[..., None])[..., 0]
    off = np.linalg.norm(arm - np.einsum("ni,nid->nd", weights, edges), axis=1)
    return weights, np.where(flat, np.inf, off)


def stretch(line: Mesh, start: int, end: int) -> Mesh:
    """The part of a line from one of its nodes to another, described from start to end.

    On a closed line the part follows the line's own direction; on an open one it is turned when
    `end` stands before `start`.

    Raises
    ------
    MeshError
        If the nodes are not ends of the line's cells.
    """
    block = line.single_block()
    chain = line_chain(line)
    step = block.kind.n_nodes - 1
    stops = chain[::step]
    closed = stops[0] == stops[-1]
    i, j = (_stop(line.nodes, stops[:-1] if closed else stops, node) for node in (start, end))
    n = len(block)
    if i == j:
        raise MeshError("kernel.mesh.two-points-line-part")
    if closed or i < j:
        cells = np.arange(i, j if j > i else j + n) % n
        table, colours = block.connectivity[cells], block.colours[cells]
    else:
        cells = np.arange(i - 1, j - 1, -1)
        table, colours = block.connectivity[cells][:, ::-1], block.colours[cells]
    return Mesh.of(line.nodes, block.cell_type, table, colours)


def _stop(nodes: NodeTable, stops: IntArray, node: int) -> int:
    found = np.flatnonzero(stops == node)
    if not len(found):
        raise MeshError("kernel.mesh.node-no-end-cell", node=nodes.told(node))
    return int(found[0])


def nearest_node(mesh: Mesh, position: FloatArray) -> int:
    """The node of a mesh nearest to a position (3,); the first one when several are.

    Raises
    ------
    MeshError
        If the mesh is empty.
    """
    ids = mesh.node_ids
    if not len(ids):
        raise MeshError("kernel.mesh.mesh-empty-no-nearest")
    return int(ids[np.linalg.norm(mesh.nodes.coordinates[ids] - position, axis=1).argmin()])


def junctions(mesh: Mesh) -> IntArray:
    """Nodes where more than two cells meet, increasing."""
    ends = [b.connectivity[:, [0, -1]] for b in mesh.blocks if b.kind.dimension == 1]
    others = [b.connectivity for b in mesh.blocks if b.kind.dimension != 1]
    parts = [t.ravel() for t in (*ends, *others)]
    if not parts:
        return np.empty(0, dtype=np.int64)
    ids, times = np.unique(np.concatenate(parts), return_counts=True)
    return ids[times > 2]


def inside_contour(
    positions: FloatArray, contour: Mesh, strict: bool, near: float = 0.0
) -> BoolArray:
    """Which positions (m, 3) lie inside closed plane lines; on the line counts unless `strict`.

    The plane is that of the contour (its mean plane); quadratic sides count as two straight
    ones. What is as `near` (m) as that to the line lies on it.
    """
    starts, ends = _segments(contour)
    origin = starts.mean(axis=0)
    normal = np.cross(starts - origin, ends - origin).sum(axis=0)
    unit = unit_vector(normal, "kernel.mesh.selecting-contour-encloses-no-area")
    frame = np.column_stack(plane_axes(unit))
    p, a, b = ((x - origin) @ frame for x in (positions, starts, ends))
    scale = float(np.ptp(a, axis=0).max())
    inside = crossing_inside(p, a, b)
    border = segment_distance(p, a, b) <= max(near, 1e-9 * scale)
    flat = np.abs((positions - origin) @ unit) <= 1e-6 * scale
    return np.asarray(flat & (inside & ~border if strict else inside | border))


def plane_axes(normal: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors that make a direct frame with a unit normal; x and y for the z axis."""
    axis = np.zeros(3)
    axis[int(np.argmin(np.abs(normal)))] = 1.0
    if abs(normal[2]) > 0.9999999:
        axis = np.array([1.0, 0.0, 0.0])
    first = axis - (axis @ normal) * normal
    first /= np.linalg.norm(first)
    return first, np.cross(normal, first)


def _segments(line: Mesh) -> tuple[FloatArray, FloatArray]:
    lines = [b.coordinates for b in line.blocks_of(1)]
    if not lines:
        raise MeshError("kernel.mesh.contour-made-lines-needed")
    starts, ends = (np.concatenate([x[:, k].reshape(-1, 3) for x in lines])
                    for k in (slice(-1), slice(1, None)))  # fmt: skip
    return starts, ends


def crossing_inside(p: FloatArray, a: FloatArray, b: FloatArray) -> BoolArray:
    """Even-odd test of points (m, 2) in the polygon of the segments a-b (n, 2)."""
    inside = np.zeros(len(p), dtype=bool)
    for rows in np.array_split(np.arange(len(p)), max(1, len(p) * len(a) // 2_000_000)):
        x, y = p[rows, 0, None], p[rows, 1, None]
        across = (a[:, 1] > y) != (b[:, 1] > y)
        rise = np.where(b[:, 1] == a[:, 1], 1.0, b[:, 1] - a[:, 1])
        cut = a[:, 0] + (y - a[:, 1]) * (b[:, 0] - a[:, 0]) / rise
        inside[rows] = (across & (x < cut)).sum(axis=1) % 2 == 1
    return inside


def segment_distance(p: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """Distance of points (m, 2 or 3) to the nearest of the segments a-b (n, 2 or 3)."""
    nearest = np.full(len(p), np.inf)
    way = b - a
    square = np.maximum((way * way).sum(axis=1), 1e-300)
    for rows in np.array_split(np.arange(len(p)), max(1, len(p) * len(a) // 2_000_000)):
        arm = p[rows, None] - a
        t = np.clip((arm * way).sum(axis=2) / square, 0.0, 1.0)
        nearest[rows] = np.linalg.norm(arm - t[..., None] * way, axis=2).min(axis=1)
    return nearest


def places_once(points: FloatArray, near: float) -> tuple[FloatArray, IntArray]:
    """Points (p, d), the first of those that hang together, nearer than that; each one's (m,)."""
    pairs = spatial.cKDTree(points).query_pairs(near, output_type="ndarray")
    part = parts_of(len(points), pairs.T)
    return points[np.unique(part, return_index=True)[1]], part


_OPPOSITE = ((1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2))
"""Corners of the face opposite each corner of a tetrahedron."""


def inside_volume(positions: FloatArray, volume: Mesh, margin: float) -> BoolArray:
    """Which positions (m, 3) lie in the 3D cells of a mesh, quadratic cells with straight sides.

    Parameters
    ----------
    margin : float
        Tolerance on barycentric coordinates: positive takes points slightly outside, negative
        leaves those out that are as near to the skin, and none within.
    """
    tables = [tetrahedra(b).connectivity for b in volume.blocks if b.kind.dimension == 3]
    if not tables:
        raise MeshError("kernel.mesh.mesh-volume-cells-needed")
    cells = np.concatenate(tables)
    corners = volume.nodes.coordinates[cells]
    centres = corners.mean(axis=1)
    reach = np.linalg.norm(corners - centres[:, None], axis=2).max(axis=1) * (1 + abs(margin) * 4)
    inverse = np.linalg.inv(np.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2))
    inside, near = np.zeros((2, len(positions)), dtype=bool)
    outer, slack = None, margin
    if margin < 0.0:  # a point may be near the skin in any of the cells that it is in
        outer, slack = sharing(cells[:, _OPPOSITE].reshape(-1, 3))[0].reshape(-1, 4) == 1, 1e-9
    tree = spatial.cKDTree(positions)
    for k, rows in enumerate(tree.query_ball_point(centres, reach)):
        todo = np.array([r for r in rows if outer is not None or not inside[r]], dtype=np.int64)
        if len(todo):
            weights = (positions[todo] - corners[k, 0]) @ inverse[k].T
            weights = np.column_stack([1.0 - weights.sum(axis=1), weights])
            good = (weights >= -slack).all(axis=1)
            inside[todo[good]] = True
            if outer is not None:
                near[todo] |= good & (weights[:, outer[k]] < -margin).any(axis=1)
    return inside & ~near
