"""Joint meshes between facing meshes, segments (RACC) or facets (LIAI), and their pairing."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.mesh.boundary import contour, envelope
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import told_coordinates
from ssilang.kernel.mesh.orientation import flipped_order, orient, reversed_line, surface_normals
from ssilang.kernel.mesh.queries.select import feet

_POINTS = 8  # looked at on a segment; 16 on a triangle
_ALIGNED = 0.7  # cosine between the normals of cells that face each other


@dataclass(frozen=True)
class Simplices:
    """Straight segments or triangles of cells: corners (m, 2 or 3, 3), the cell of each (m,)."""

    corners: FloatArray
    cell: IntArray

    @classmethod
    def of(cls, blocks: Iterable[tuple[CellBlock, IntArray]]) -> "Simplices":
        """Those of the given rows of blocks of lines, or of facets (quadrangles are halved)."""
        made = list(_straight(blocks))
        cells, before = [], 0
        for _, rows in made:
            cells.append(np.unique(rows, return_inverse=True)[1] + before)
            before = int(cells[-1].max()) + 1
        return cls(np.concatenate([x for x, _ in made]), np.concatenate(cells))

    def vectors(self) -> FloatArray:
        """Along a segment, or normal to a triangle, (m, 3): as long as the measure."""
        edges = self.corners[:, 1:] - self.corners[:, :1]
        return edges[:, 0] if edges.shape[1] == 1 else np.cross(edges[:, 0], edges[:, 1]) / 2.0

    def measures(self) -> FloatArray:
        """Lengths or areas (m,)."""
        return np.asarray(np.linalg.norm(self.vectors(), axis=1))


def _straight(
    blocks: Iterable[tuple[CellBlock, IntArray]],
) -> Iterator[tuple[FloatArray, IntArray]]:
    for block, rows in blocks:
        corners = block.coordinates[rows][:, list(block.kind.corners)]
        if corners.shape[1] < 4:
            yield corners, rows
        else:
            halves = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
            yield halves, np.concatenate([rows, rows])


def _samples(corners: int) -> FloatArray:
    """Barycentric coordinates (p, corners) of points that stand for equal parts."""
    if corners == 2:
        t = (np.arange(_POINTS) + 0.5) / _POINTS
        return np.column_stack([1.0 - t, t])
    n = 4
    up = [(i + 1 / 3, j + 1 / 3) for i in range(n) for j in range(n - i)]
    down = [(i + 2 / 3, j + 2 / 3) for i in range(n) for j in range(n - 1 - i)]
    xy = np.array(up + down) / n
    return np.column_stack([1.0 - xy.sum(axis=1), xy])


def facing_parts(ours: Simplices, theirs: Simplices, tolerance: float) -> FloatArray:
    """Part (m,) of each of our simplices that one of theirs faces within a distance, 0 to 1.

    A point faces a simplex if its foot lies inside of it, not beyond its edges, and the two are
    nearly parallel: neighbours in one line, or round a corner, do not face each other.
    """
    weights = _samples(ours.corners.shape[1])
    points = np.einsum("pk,mkx->mpx", weights, ours.corners)
    centres = theirs.corners.mean(axis=1)
    radius = np.linalg.norm(theirs.corners - centres[:, None], axis=2).max() + tolerance
    found = spatial.cKDTree(centres).query_ball_point(points.reshape(-1, 3), radius)
    rows = np.repeat(np.arange(len(found)), [len(f) for f in found])
    met = np.zeros(len(found), dtype=bool)
    if len(rows):
        partner = np.concatenate([np.asarray(f, dtype=np.int64) for f in found])
        foot, off = feet(theirs.corners[partner], points.reshape(-1, 3)[rows])
        faces = (foot >= 0.0).all(axis=1) & (foot.sum(axis=1) <= 1.0) & (off <= tolerance)
        own, other = _unit(ours.vectors())[rows // len(weights)], _unit(theirs.vectors())[partner]
        faces &= np.abs((own * other).sum(axis=1)) > _ALIGNED
        np.logical_or.at(met, rows, faces)
    return np.asarray(met.reshape(len(points), -1).mean(axis=1))


def _unit(vectors: FloatArray) -> FloatArray:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(length > 0.0, length, 1.0)


_JOINTS = {
    "SEG2": "RAC2",
    "SEG3": "RAC3",
    "TRI3": "LIA3",
    "QUA4": "LIA4",
    "TRI6": "LIA6",
    "QUA8": "LIA8",
}
_ROUNDING = 1e-9
"""Sides that stand apart by the very tolerance are within it, however they were moved there."""
_NORMAL_TO_FACE = 1e-6  # gaps smaller than this part of the cell size count as closed


def joint_mesh(first: Mesh, second: Mesh, tolerance: float, part: bool = False) -> Mesh:
    """Joint cells between the cells of two meshes that face each other.

    A joint is made for every cell of `first` that has a cell of `second` of the same type whose
    nodes lie, one by one, within `tolerance`. Its first half is the cell of `first`, its second
    half the nodes of the other cell in the corresponding order, whatever their own order was.

    The order of the first half fixes the normal: to the left of the line's direction in the
    plane, by the right-hand rule on a facet. Where the two sides are apart (a gap), the first
    half is turned if need be so that the normal points from `second` to `first`; where they
    coincide the direction of `first` is taken as given.

    Parameters
    ----------
    part : bool
        Whether cells may face each other without being joined, where they do not fit together.

    Raises
    ------
    MeshError
        If the tolerance is not positive, the meshes are not of lines or facets, no cell of
        one is close enough to a cell of the other, or cells face each other that do not fit.
    """
    if tolerance <= 0.0:
        raise MeshError("kernel.mesh.facing-cells-paired-within")
    tolerance *= 1 + _ROUNDING
    made, joined = [], _Joined(first, second)
    for block in first.blocks:
        joint = _JOINTS.get(block.cell_type)
        if joint is None:
            raise MeshError("kernel.mesh.no-joint-cell-made", cell_type=block.cell_type)
        for other in second.blocks:
            if other.cell_type == block.cell_type:
                rows, partner, theirs = _paired(block, other, tolerance)
                if len(rows):
                    joined.take(block, rows, other, theirs)
                    made.append(_oriented(block, joint, rows, partner))
    if not part:
        joined.refuse_misfits(tolerance)
    if not made:
        raise MeshError("kernel.mesh.no-cell-first-mesh", tolerance=tolerance)
    return union(*(Mesh(first.nodes, (b,)) for b in made), as_given=True)


class _Joined:
    """Which cells of two sides have a joint."""

    def __init__(self, first: Mesh, second: Mesh) -> None:
        self.sides = (first, second)
        self.taken = [{id(b): np.zeros(len(b), dtype=bool) for b in m.blocks} for m in self.sides]

    def take(self, block: CellBlock, rows: IntArray, other: CellBlock, theirs: IntArray) -> None:
        """Rows of a block of the first side, and of one of the second, are joined."""
        self.taken[0][id(block)][rows] = True
        self.taken[1][id(other)][theirs] = True

    def refuse_misfits(self, tolerance: float) -> None:
        """Raise the error for cells that face each other and have no joint."""
        left = [self._cells(side, taken=False) for side in (0, 1)]
        if left[0] is None or left[1] is None:
            return
        ours = facing_parts(left[0], left[1], tolerance)
        if not ours.any():
            return
        theirs = facing_parts(left[1], left[0], tolerance)
        joined, measure = self._cells(0, taken=True), left[0].measures()
        centre = left[0].corners[int(np.argmax(ours))].mean(axis=0)
        raise MeshError(
            "kernel.mesh.sides-do-not-fit",
            surface=left[0].corners.shape[1] > 2,
            joined=0.0 if joined is None else float(joined.measures().sum()),
            apart=float(ours @ measure),
            n_first=len(np.unique(left[0].cell[ours > 0.0])),
            n_second=len(np.unique(left[1].cell[theirs > 0.0])),
            place=told_coordinates(self.sides[0].nodes.shown(centre)),
            tolerance=tolerance,
        )

    def _cells(self, side: int, taken: bool) -> Simplices | None:
        blocks = [
            (b, np.flatnonzero(self.taken[side][id(b)] == taken)) for b in self.sides[side].blocks
        ]
        blocks = [(b, rows) for b, rows in blocks if len(rows) and b.cell_type in _JOINTS]
        return Simplices.of(blocks) if blocks else None


def _paired(
    block: CellBlock, other: CellBlock, tolerance: float
) -> tuple[IntArray, IntArray, IntArray]:
    """Cells of `block` that have a partner (m,), the partner's nodes (m, k) in their order, and
    the partner (m,)."""
    tree = spatial.cKDTree(other.coordinates.mean(axis=1))
    centres = block.coordinates.mean(axis=1)
    near = tree.query_ball_point(centres, tolerance)
    rows = np.repeat(np.arange(len(block)), [len(c) for c in near])
    candidates = np.concatenate([np.asarray(c, dtype=np.int64) for c in near])
    if not len(rows):
        return rows, np.empty((0, block.kind.n_nodes), dtype=np.int64), rows
    ours = block.coordinates[rows]
    theirs = other.coordinates[candidates]
    order, worst = _best_order(ours, theirs, block)
    good = worst <= tolerance
    best = np.lexsort((worst, rows))
    best = best[good[best]]
    best = best[np.sort(np.unique(rows[best], return_index=True)[1])]
    partner = np.take_along_axis(other.connectivity[candidates[best]], order[best], axis=1)
    return rows[best], partner, candidates[best]


def _renumberings(n_nodes: int, degree: int, dimension: int) -> list[list[int]]:
    """Orders in which the nodes of the same cell may stand: turned round, and reversed."""
    if dimension == 1:
        return [list(range(n_nodes)), list(range(n_nodes - 1, -1, -1))]
    turns = [[(start + k) % n_nodes for k in range(n_nodes)] for start in range(0, n_nodes, degree)]
    return turns + [[t[-k % n_nodes] for k in range(n_nodes)] for t in turns]


def _oriented(block: CellBlock, joint: str, rows: IntArray, partner: IntArray) -> CellBlock:
    upper = block.connectivity[rows]
    xyz = block.nodes.coordinates
    gap = (xyz[upper] - xyz[partner]).mean(axis=1)
    normal, size = _normals(block, rows)
    away = (gap * normal).sum(axis=1)
    against = away < -_NORMAL_TO_FACE * size
    flipped = list(flipped_order(block.cell_type))
    upper = np.where(against[:, None], upper[:, flipped], upper)
    partner = np.where(against[:, None], partner[:, flipped], partner)
    return CellBlock.make(block.nodes, joint, np.hstack([upper, partner]), block.colours[rows])


def _normals(block: CellBlock, rows: IntArray) -> tuple[FloatArray, FloatArray]:
    """Unit normals (m, 3) and sizes (m,) of the first faces."""
    if block.kind.dimension == 1:
        x = block.coordinates[rows]
        chord = x[:, -1] - x[:, 0]
        size = np.linalg.norm(chord, axis=1)
        normal = np.column_stack([-chord[:, 1], chord[:, 0], 0.0 * size])
    else:
        normal = surface_normals(block)[rows]
        size = np.sqrt(np.linalg.norm(normal, axis=1))
    return _unit(normal), size


def joints_inside(mesh: Mesh, tolerance: float) -> Mesh:
    """Joint cells between the boundary cells of a mesh that face one another.

    For parts that touch without sharing nodes: each pair of coincident edges (2D) or faces (3D)
    of different cells gives one joint, whose normal points into the body of its first half.

    Raises
    ------
    MeshError
        If no two boundary cells face each other within the tolerance.
    """
    body = orient(mesh, mesh.dimension)
    skin = reversed_line(envelope(body)) if mesh.dimension == 3 else contour(body)
    made = []
    for block in skin.blocks:
        rows, partner = _facing_pairs(block, tolerance)
        if len(rows):
            made.append(_oriented(block, _JOINTS[block.cell_type], rows, partner))
    if not made:
        raise MeshError("kernel.mesh.no-two-boundaries-inside", tolerance=tolerance)
    return union(*(Mesh(mesh.nodes, (b,)) for b in made), as_given=True)


def _facing_pairs(block: CellBlock, tolerance: float) -> tuple[IntArray, IntArray]:
    """Cells of a block that face a later one (m,), and the nodes of that one in their order."""
    tree = spatial.cKDTree(block.coordinates.mean(axis=1))
    pairs = tree.query_pairs(tolerance, output_type="ndarray")
    if not len(pairs):
        return np.empty(0, dtype=np.int64), np.empty((0, block.kind.n_nodes), dtype=np.int64)
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    order, worst = _best_order(
        block.coordinates[pairs[:, 0]], block.coordinates[pairs[:, 1]], block
    )
    good = worst <= tolerance
    partner = np.take_along_axis(block.connectivity[pairs[good, 1]], order[good], axis=1)
    return pairs[good, 0].astype(np.int64), partner


def _best_order(
    ours: FloatArray, theirs: FloatArray, block: CellBlock
) -> tuple[IntArray, FloatArray]:
    """For pairs of cells: the node order of the second closest to the first, and its gap."""
    worst = np.full(len(ours), np.inf)
    order = np.zeros((len(ours), block.kind.n_nodes), dtype=np.int64)
    for turn in _renumberings(block.kind.n_nodes, block.kind.degree, block.kind.dimension):
        gap = np.linalg.norm(ours - theirs[:, turn], axis=2).max(axis=1)
        better = gap < worst
        worst[better] = gap[better]
        order[better] = turn
    return order, worst
