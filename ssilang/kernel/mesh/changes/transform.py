"""Moved copies of meshes, and nodes moved in place.

Meshes that follow some of their nodes, and nodes put in the middle of their neighbours.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import entries, parts_of
from ssilang.kernel.base.scientific import spla
from ssilang.kernel.base.sparse import assemble_triplets, sp
from ssilang.kernel.mesh.boundary import contour, edges, envelope
from ssilang.kernel.mesh.generators.sweep import corresponding_nodes, rotate
from ssilang.kernel.mesh.lines.curves import plane_normal, unit_vector
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.queries.select import simplices

# positions (m, 3) -> positions (m, 3)
PointMap = Callable[[FloatArray], FloatArray]


def shift(vector: FloatArray) -> PointMap:
    """Translation by `vector` (3,)."""
    return lambda x: x + vector


def turn(angle: float, origin: FloatArray, axis: FloatArray) -> PointMap:
    """Rotation by `angle` degrees about the axis through `origin`.

    Raises
    ------
    MeshError
        If the axis has no length.
    """
    unit = unit_vector(axis, "kernel.mesh.two-points-axis-rotation")
    return lambda x: rotate(x, math.radians(angle), origin, unit)


def mirror_point(centre: FloatArray) -> PointMap:
    """Symmetry about a point (3,)."""
    return lambda x: 2.0 * centre - x


def mirror_line(a: FloatArray, b: FloatArray) -> PointMap:
    """Symmetry about the line through two points (3,)."""
    unit = unit_vector(b - a, "kernel.mesh.two-points-line-coincide")

    def image(x: FloatArray) -> FloatArray:
        foot = a + ((x - a) @ unit)[:, None] * unit
        return 2.0 * foot - x

    return image


def mirror_plane(a: FloatArray, b: FloatArray, c: FloatArray) -> PointMap:
    """Symmetry about the plane through three points (3,)."""
    unit = plane_normal(a, b, c)
    return lambda x: x - 2.0 * ((x - a) @ unit)[:, None] * unit


def scaling(ratio: float, centre: FloatArray) -> PointMap:
    """Homothety of `ratio` about `centre` (3,)."""
    return lambda x: centre + ratio * (x - centre)


def affinity(ratio: float, origin: FloatArray, towards: FloatArray) -> PointMap:
    """Stretching by `ratio` along the direction origin -> towards; `origin` (3,) stays."""
    unit = unit_vector(towards - origin, "kernel.mesh.two-points-direction-coincide")
    return lambda x: x + (ratio - 1.0) * ((x - origin) @ unit)[:, None] * unit


@dataclass
class NodeCopier:
    """Copies nodes through a map, each node once however many meshes hold it.

    Attributes
    ----------
    image : PointMap
        From the positions (m, 3) of the originals to those of the copies.
    by_node : function of array (m,) to array (m, 3) or None
        Replaces `image` where copies depend on the node, not only on its position.
    copies : dict
        Original node -> copy, filled on the way.
    """

    nodes: NodeTable
    image: PointMap | None = None
    by_node: Callable[[IntArray], FloatArray] | None = None
    copies: dict[int, int] = field(default_factory=dict)

    def of_nodes(self, ids: IntArray) -> IntArray:
        """Copies of node numbers (any shape), made where they do not exist yet."""
        resolved = self.nodes.resolve(ids)
        flat, first, where = np.unique(resolved, return_index=True, return_inverse=True)
        met = flat[np.argsort(first)].tolist()
        fresh = np.array([n for n in met if n not in self.copies], dtype=np.int64)
        if len(fresh):
            if self.by_node is not None:
                moved = self.by_node(fresh)
            else:
                assert self.image is not None
                moved = self.image(self.nodes.coordinates[fresh].copy())
            made = self.nodes.add(moved, self.nodes.density[fresh].copy())
            self.copies.update(zip(fresh.tolist(), made.tolist(), strict=True))
        table = np.array([self.copies[n] for n in flat.tolist()], dtype=np.int64)
        return table[where.reshape(resolved.shape)]

    def point(self, point: Point) -> Point:
        """Copy of a point."""
        return Point(self.nodes, int(self.of_nodes(np.array([point.node]))[0]))

    def block(self, block: CellBlock) -> CellBlock:
        """Copy of a block."""
        return CellBlock.make(
            block.nodes, block.cell_type, self.of_nodes(block.connectivity), block.colours
        )

    def mesh(self, mesh: Mesh) -> Mesh:
        """Copy of a mesh with its sides."""
        blocks = tuple(self.block(b) for b in mesh.blocks)
        return Mesh(mesh.nodes, blocks, tuple(self.mesh(s) for s in mesh.sides))


def mapping_between(first: Mesh, second: Mesh) -> NodeCopier:
    """The copier that takes the nodes of one mesh to those of a mesh of the same structure.

    Raises
    ------
    MeshError
        When it is later asked for a node that `first` does not hold.
    """
    target = corresponding_nodes(first, second)
    pairs = dict(zip(first.node_ids.tolist(), target.tolist(), strict=True))

    def refuse(ids: IntArray) -> FloatArray:
        raise MeshError("kernel.mesh.node-not-belong-mesh", ids=first.nodes.told(ids[0]))

    return NodeCopier(first.nodes, by_node=refuse, copies=pairs)


def move(nodes: NodeTable, ids: IntArray, image: PointMap) -> None:
    """Move nodes (m,) in place."""
    ids = np.unique(nodes.resolve(ids))
    nodes.coordinates[ids] = image(nodes.coordinates[ids].copy())


def affine_through(old: FloatArray, new: FloatArray, dimension: int) -> PointMap:
    """The affine map that takes points `old` (n, 3) to `new` (n, 3), n <= dimension + 1.

    With fewer points than an affine map needs, the rest is the identity on the directions
    orthogonal to those given.

    Raises
    ------
    MeshError
        With too many points or points that are affinely dependent.
    """
    if len(old) != len(new) or len(old) == 0:
        raise MeshError("kernel.mesh.map-takes-many-points", n_old=len(old), n_new=len(new))
    if len(old) > dimension + 1:
        raise MeshError(
            "kernel.mesh.most-points-define-map", dimension=dimension + 1, n_old=len(old)
        )
    before, after = (old[1:] - old[0]).T, (new[1:] - new[0]).T
    linear = np.eye(3)
    if before.size:
        if np.linalg.matrix_rank(before) < before.shape[1]:
            raise MeshError("kernel.mesh.points-define-map-line")
        inverse = np.linalg.pinv(before)
        linear = after @ inverse + np.eye(3) - before @ inverse
    return lambda x: new[0] + (x - old[0]) @ linear.T


def straighten_middles(mesh: Mesh) -> None:
    """Move the middle nodes of quadratic edges onto the mediator planes of their ends, in place."""
    for block in edges(mesh).blocks:
        if block.cell_type != "SEG3":
            continue
        a, m, b = np.moveaxis(block.coordinates, 1, 0)
        chord = b - a
        square = np.maximum((chord * chord).sum(axis=1, keepdims=True), 1e-300)
        off = ((m - 0.5 * (a + b)) * chord).sum(axis=1, keepdims=True) / square
        mesh.nodes.coordinates[block.connectivity[:, 1]] = m - off * chord


def quarter_middles(mesh: Mesh, tip: IntArray, at: float) -> None:
    """Move middle nodes of the edges that leave a crack's tip or front, in place (Barsoum 1976).

    Parameters
    ----------
    tip : array of int
        Nodes of the tip; edges between two of them keep theirs.
    at : float
        Coordinate along the edge, 0 in its middle and 1 at the tip; 0.5 is the quarter point.
    """
    for block in edges(mesh).blocks:
        if block.cell_type != "SEG3":
            continue
        held = np.isin(block.connectivity[:, [0, 2]], tip)
        leaving = held[:, 0] != held[:, 1]
        a, _, b = np.moveaxis(block.coordinates[leaving], 1, 0)
        share = np.where(held[leaving, :1], 1.0 - at, 1.0 + at) / 2.0
        mesh.nodes.coordinates[block.connectivity[leaving, 1]] = a + share * (b - a)


def to_cylindrical(origin: FloatArray, axis: FloatArray, zero: FloatArray) -> PointMap:
    """Map to (r, theta in degrees within -180..180, z) about an axis.

    Parameters
    ----------
    zero : array (3,)
        A vector that gives theta = 0 (its part along the axis is dropped).
    """
    up = unit_vector(axis, "kernel.mesh.axis-cylindrical-coordinates-no")
    first = unit_vector(zero - (zero @ up) * up, "kernel.mesh.point-theta-lies-axis")
    second = np.cross(up, first)

    def image(x: FloatArray) -> FloatArray:
        arm = x - origin
        a, b = arm @ first, arm @ second
        return np.column_stack([np.hypot(a, b), np.degrees(np.arctan2(b, a)), arm @ up])

    return image


def from_cylindrical(x: FloatArray) -> FloatArray:
    """Map (r, theta in degrees, z) (m, 3) back to cartesian coordinates, same origin and z."""
    angle = np.radians(x[:, 1])
    return np.column_stack([x[:, 0] * np.cos(angle), x[:, 0] * np.sin(angle), x[:, 2]])


def followed(
    mesh: Mesh, masters: IntArray, places: FloatArray, even: bool = False
) -> tuple[IntArray, FloatArray]:
    """Nodes (n,) of a mesh and where they go (n, 3) when some of them go to given places.

    The displacement of the others is harmonic (each component solves Laplace's equation by linear
    elements), so that a homogeneous motion of the boundary is followed exactly.

    Parameters
    ----------
    masters : array (m,); places : array (m, 3)
        Nodes and where they go; masters outside the mesh do not count.
    even : bool
        True: then each inner node that is no master goes to the mean of its neighbours.

    Raises
    ------
    MeshError
        Without masters in the mesh, if a part of it has none, or for cells that have neither
        area nor volume.
    """
    nodes = mesh.sorted_node_ids
    xyz = mesh.nodes.coordinates[nodes]
    if not len(nodes):
        raise MeshError("kernel.mesh.mesh-empty-no-nodes")
    place = np.searchsorted(nodes, masters)
    here = nodes[np.minimum(place, len(nodes) - 1)] == masters
    held, target = place[here], places[here]
    if not len(held):
        raise MeshError("kernel.mesh.none-master-nodes-belongs")
    fixed = np.zeros(len(nodes), bool)
    fixed[held] = True
    motion = np.zeros((len(nodes), 3))
    motion[held] = target - xyz[held]
    motion = _solved(_stiffness(mesh, nodes), motion, fixed)
    moved = xyz + motion
    if even:
        skin = envelope(mesh) if mesh.dimension == 3 else contour(mesh)
        rim = np.isin(nodes, skin.node_ids)
        moved = _solved(_graph(mesh, nodes), moved, fixed | rim)
    return nodes, moved


def _solved(A: sp.csr_array, values: FloatArray, fixed: np.ndarray) -> FloatArray:
    """Values (n, 3) with A values = 0 at the rows that are not fixed."""
    free = np.flatnonzero(~fixed)
    if not len(free):
        return values
    known = np.flatnonzero(fixed)
    part = parts_of(len(values), entries(A))
    if len(np.unique(part[known])) <= part.max():
        raise MeshError("kernel.mesh.part-mesh-no-master")
    found = spla.splu(sp.csc_array(A[free][:, free])).solve(-(A[free][:, known] @ values[known]))
    result = values.copy()
    result[free] = found
    return result


def _stiffness(mesh: Mesh, nodes: IntArray) -> sp.csr_array:
    """Stiffness (n, n) of Laplace's equation on the simplices of the cells."""
    places, terms = [], []
    for block in mesh.blocks:
        if block.kind.dimension < 2 or block.kind.joint or block.kind.degree > 1:
            raise MeshError("kernel.mesh.cells-type-cannot-follow", cell_type=block.cell_type)
        for local in simplices(block):
            table = block.connectivity[:, list(local)]
            places.append(np.searchsorted(nodes, table).astype(np.int32))
            terms.append(_simplex_terms(block, table))
    return assemble_triplets(places, terms, len(nodes))


def _simplex_terms(block: CellBlock, table: IntArray) -> FloatArray:
    """Stiffness (n, k, k) of triangles or tetrahedra (n, k)."""
    x = block.nodes.coordinates[table]
    edges = x[:, 1:] - x[:, :1]
    gram = edges @ edges.transpose(0, 2, 1)
    size = np.sqrt(np.maximum(np.linalg.det(gram), 0.0))
    flat = size <= 1e-14 * np.linalg.norm(edges, axis=-1).prod(axis=-1)
    if flat.any():
        raise MeshError(
            "kernel.mesh.cells-type-flat", n_flat=int(flat.sum()), cell_type=block.cell_type
        )
    away = np.insert(np.eye(table.shape[1] - 1), 0, -1.0, axis=1)  # from the first corner
    scaled: FloatArray = size[:, None, None] * (away.T @ np.linalg.inv(gram) @ away)
    return scaled


def _graph(mesh: Mesh, nodes: IntArray) -> sp.csr_array:
    """Number of neighbours on the diagonal, -1 for each neighbour."""
    pairs = np.concatenate([b.connectivity for b in edges(mesh).blocks])
    i, j = np.searchsorted(nodes, pairs).T
    ones = np.ones(len(i))
    links = sp.coo_array((ones, (i, j)), shape=(len(nodes), len(nodes))).tocsr()
    links = links + links.T
    return sp.csr_array(sp.diags_array(np.asarray(links.sum(axis=1)).ravel()) - links)
