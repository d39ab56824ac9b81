"""Unilateral relations of two sides: no node, or in the mean no cell, goes into the other body.

For points x of one side (the slave), with shape functions N there and M at their feet on the
other (the master), n the master's outer normal:

    sum_i w_i n . (N_i u_s - M_i u_m) >= sum_i w_i (distance - gap_i)

The formulations differ by the points and weights: nodes one by one (MESC), both ways round
(SYME), the mean over each slave cell (FAIB), means weighted by the nodes' shape functions (MORT).
Slips, along which friction pushes, are the same sums across n.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.contact.rows import Friction
from ssilang.kernel.elements.shapes.quadrature import quadrature
from ssilang.kernel.matrices.matrix import Relations
from ssilang.kernel.matrices.relations import across, joined, rows_from_table
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

OUTSIDE = 1e-6
"""How far out of a cell, in its own coordinates, a point still projects onto it."""
FACING = -0.1
"""Cosine of normals above which two sides do not face each other."""
BEHIND = 0.5
"""Depth under a cell, in its size, beyond which a point is on the other side of the body."""


@dataclass(frozen=True, eq=False)
class Side:
    """Straight cells of a side: segments in the plane, triangles in space.

    Attributes
    ----------
    cells : array (n_cells, k)
        Nodes; the outer normal is to the right of a segment's travel, and by the right hand
        about a triangle.
    corners : array (n_cells, k, dim)
    normals : array (n_cells, dim)
    sizes : array (n_cells,)
        Length, or area.
    """

    cells: IntArray
    corners: FloatArray
    normals: FloatArray
    sizes: FloatArray


def side_of(mesh: Mesh, dimension: int) -> Side:
    """The cells of a mesh of lines (plane) or triangles (space; quadrangles are cut in two).

    Raises
    ------
    MeshError
        For other cells.
    """
    wanted = {2: ("SEG2",), 3: ("TRI3", "QUA4")}[dimension]
    parts: list[IntArray] = []
    for block in mesh.blocks:
        if block.cell_type not in wanted:
            raise MeshError(
                "kernel.contact.side-contact-made-not", wanted=wanted, cell_type=block.cell_type
            )
        c = block.connectivity
        parts += [c] if block.cell_type != "QUA4" else [c[:, [0, 1, 2]], c[:, [0, 2, 3]]]
    cells = np.concatenate(parts)
    corners = mesh.nodes.coordinates[cells][..., :dimension]
    along = np.diff(corners, axis=1)
    if dimension == 2:
        normals = np.stack([along[:, 0, 1], -along[:, 0, 0]], axis=1)
        sizes = np.linalg.norm(normals, axis=1)
    else:
        normals = np.cross(along[:, 0], along[:, 1])
        sizes = 0.5 * np.linalg.norm(normals, axis=1)
    if (sizes <= 0).any():
        raise MeshError("kernel.contact.side-contact-cell-without")
    return Side(cells, corners, normals / np.linalg.norm(normals, axis=1, keepdims=True), sizes)


@dataclass(frozen=True, eq=False)
class Projection:
    """Where points fall on a side."""

    cell: IntArray  # (n,) cell, -1 for none
    shapes: FloatArray  # (n, k) shape functions there
    gap: FloatArray  # (n,) distance along the cell's normal, negative inside the body


def project(side: Side, points: FloatArray, normals: FloatArray) -> Projection:
    """The nearest facing cell for each point.

    Parameters
    ----------
    points : array (n, dim)
    normals : array (n, dim)
        Outer normals of the side that the points belong to.
    """
    # shape functions (n, n_cells, k) of the feet of points on the cells' planes
    first = side.corners[:, 0]
    edges = side.corners[:, 1:] - first[:, None]
    metric = np.einsum("cid,cjd->cij", edges, edges)
    offset = points[:, None] - first[None]
    right = np.einsum("ncd,cid->nci", offset, edges)
    local = np.einsum("cij,ncj->nci", np.linalg.inv(metric), right)
    shapes = np.concatenate([1 - local.sum(axis=2, keepdims=True), local], axis=2)
    gap = np.einsum("ncd,cd->nc", offset, side.normals)
    inside = (shapes >= -OUTSIDE).all(axis=2)
    against = normals @ side.normals.T <= FACING
    scale = side.sizes ** (1 / (points.shape[1] - 1))
    good = inside & against & (gap >= -BEHIND * scale)
    cost = np.where(good, np.abs(gap), np.inf)
    best = cost.argmin(axis=1)
    rows = np.arange(len(points))
    found = np.isfinite(cost[rows, best])
    return Projection(np.where(found, best, -1), shapes[rows, best], gap[rows, best])


NOTHING = 1e-13
"""Coefficients (of a mean: at most 1) that are rounding."""


@dataclass(frozen=True, eq=False)
class ContactRelations:
    """Relations `>= distances`, one for each multiplier, and their friction if there is any."""

    relations: Relations
    distances: FloatArray
    friction: Friction | None = None


@dataclass(frozen=True)
class Rubbing:
    """Coulomb's friction of two sides."""

    coefficient: float
    cohesion: float = 0.0  # a stress
    turned: bool = False  # whether the model turns about its axis: areas are those of rings


@dataclass(frozen=True, eq=False)
class _Points:
    """Points of a slave side: cell, shape functions, row of the relation they go into, weight."""

    cell: IntArray
    shapes: FloatArray
    row: IntArray
    weight: FloatArray


def contact_relations(
    table: NodeTable,
    unknowns: tuple[str, ...],
    master: Mesh,
    slave: Mesh,
    method: str,
    distance: float = 0.0,
    rubbing: Rubbing | None = None,
) -> ContactRelations | None:
    """Relations of two sides as they lie now; None where no point faces the other side.

    Parameters
    ----------
    unknowns : tuple of str
        Displacements along the axes.
    method : str
        'MESC', 'SYME', 'FAIB' or 'MORT'.
    distance : float
        Least distance to keep.
    rubbing : Rubbing, optional
        Friction; limits of cohesion are stresses times the areas that the relations stand for.
    """
    dimension = len(unknowns)
    a, b = side_of(master, dimension), side_of(slave, dimension)
    pairs = [(a, b)] if method != "SYME" else [(a, b), (b, a)]
    parts = (_rows(one, other, _POINTS[method](one, other), distance) for one, other in pairs)
    kept = [p for p in parts if p is not None]
    if not kept:
        return None
    relations = joined([_as_relations(table, unknowns, p.nodes, p.normals, 1) for p in kept])
    least = np.concatenate([p.least for p in kept])
    friction = _friction(table, unknowns, kept, relations, rubbing) if rubbing else None
    return ContactRelations(relations, least, friction)


def _friction(
    table: NodeTable,
    unknowns: tuple[str, ...],
    parts: "list[Rows]",
    relations: Relations,
    rubbing: Rubbing,
) -> Friction:
    """Slips of all relations, across their normals."""
    slips, areas, width = [], [], len(unknowns) - 1
    for p in parts:
        n, nodes, d = p.normals.shape
        rows = np.stack(p.slips, axis=1).reshape(n * width, nodes, d)
        slips.append(_as_relations(table, unknowns, p.nodes, rows, 0))
        areas.append(p.area * (2 * np.pi * p.radius if rubbing.turned else 1.0))
    area = np.concatenate(areas)
    return Friction(
        joined(slips),
        width,
        np.full(len(area), rubbing.coefficient),
        rubbing.cohesion * area,
        relations.raw_multipliers,
        None,
        np.zeros(len(area)),
    )


def _node_points(master: Side, slave: Side) -> _Points:
    """Each node once, seen from the first cell that has it facing."""
    k = slave.cells.shape[1]
    nodes = slave.cells.ravel()
    cell = np.repeat(np.arange(len(slave.cells)), k)
    shapes = np.tile(np.eye(k), (len(slave.cells), 1))
    _, row = np.unique(nodes, return_inverse=True)
    return _Points(cell, shapes, row.ravel(), np.full(len(nodes), -1.0))


def _inner_points(master: Side, slave: Side) -> _Points:
    """Points that integrate over the slave's cells, each cell a row."""
    if slave.cells.shape[1] == 2:
        return _pieces(master, slave)
    rule = quadrature("triangle", 7)
    shapes = np.column_stack([1 - rule.points.sum(axis=1), rule.points])
    n, p = len(slave.cells), len(rule.points)
    cell = np.repeat(np.arange(n), p)
    weight = np.tile(rule.weights / rule.weights.sum(), n) * slave.sizes[cell]
    return _Points(cell, np.tile(shapes, (n, 1)), cell, weight)


def _pieces(master: Side, slave: Side) -> _Points:
    """Two Gauss points on each piece of a segment between the feet of the master's nodes."""
    start = slave.corners[:, 0]
    along = slave.corners[:, 1] - start
    ends = master.corners.reshape(-1, start.shape[1])
    feet = np.einsum("cnd,cd->cn", ends[None] - start[:, None], along)
    feet = np.clip(feet / np.einsum("cd,cd->c", along, along)[:, None], 0.0, 1.0)
    cuts = np.sort(np.column_stack([np.zeros(len(start)), feet, np.ones(len(start))]), axis=1)
    length = np.diff(cuts, axis=1)
    middle = 0.5 * (cuts[:, 1:] + cuts[:, :-1])
    cell, piece = np.nonzero(length > 1e-9)
    half = 0.5 * length[cell, piece]
    s = (middle[cell, piece][:, None] + half[:, None] * np.array([-1, 1]) / np.sqrt(3)).ravel()
    cell, weight = np.repeat(cell, 2), np.repeat(half, 2) * slave.sizes[np.repeat(cell, 2)]
    return _Points(cell, np.stack([1 - s, s], axis=1), cell, weight)


def _weighted_points(master: Side, slave: Side) -> _Points:
    """Points that integrate each node's shape function over the slave: a row a node."""
    inner = _inner_points(master, slave)
    k = slave.cells.shape[1]
    _, place = np.unique(slave.cells, return_inverse=True)
    row = place.reshape(slave.cells.shape)[inner.cell]
    return _Points(
        np.repeat(inner.cell, k),
        np.repeat(inner.shapes, k, axis=0),
        row.ravel(),
        (inner.shapes * inner.weight[:, None]).ravel(),
    )


_POINTS: dict[str, Callable[[Side, Side], _Points]] = {
    "MESC": _node_points,
    "SYME": _node_points,
    "FAIB": _inner_points,
    "MORT": _weighted_points,
}
METHODS = tuple(_POINTS)


@dataclass(frozen=True, eq=False)
class Rows:
    """Relations of two sides.

    Attributes
    ----------
    nodes : array (k,)
    normals : array (r, k, dim)
        Coefficients of the gaps.
    slips : tuple of array (r, k, dim)
        Of the slips along dim - 1 directions across the mean normal of each row.
    least, area, radius : arrays (r,)
        Least values, area that each row stands for, its mean first coordinate.
    """

    nodes: IntArray
    normals: FloatArray
    slips: tuple[FloatArray, ...]
    least: FloatArray
    area: FloatArray
    radius: FloatArray


def _rows(master: Side, slave: Side, points: _Points, distance: float) -> Rows | None:
    """Nodes (r,), coefficients (r, nodes, dim) of the relations, and the least values (r,)."""
    corners = slave.corners[points.cell]
    x = np.einsum("nk,nkd->nd", points.shapes, corners)
    found = project(master, x, slave.normals[points.cell])
    seen = np.flatnonzero(found.cell >= 0)
    if points.weight[:1].tolist() == [-1.0]:  # nodes: the first facing cell stands for each
        _, first = np.unique(points.row[seen], return_index=True)
        seen = seen[first]
    if len(seen) == 0:
        return None
    weight = np.abs(points.weight[seen])
    rows, row = np.unique(points.row[seen], return_inverse=True)
    whole = np.bincount(row, weight, len(rows))
    weight = weight / whole[row]
    area: FloatArray = whole.astype(np.float64)
    if points.weight[:1].tolist() == [-1.0]:
        share = slave.sizes[points.cell] / slave.cells.shape[1]
        area = np.bincount(points.row, share)[rows].astype(np.float64)
    slave_points = _Points(points.cell[seen], points.shapes[seen], row, weight)
    faced = Projection(found.cell[seen], found.shapes[seen], found.gap[seen])
    return _gathered(master, slave, slave_points, faced, distance, area)


def _gathered(
    master: Side, slave: Side, points: _Points, faced: Projection, distance: float, area: FloatArray
) -> Rows:
    """Sums over the points of each row, that all face the master."""
    normal, row, weight = master.normals[faced.cell], points.row, points.weight
    own, other = slave.cells[points.cell], master.cells[faced.cell]
    nodes = np.concatenate([own, other], axis=1)
    shapes = np.concatenate([points.shapes, -faced.shapes], axis=1)
    unique, place = np.unique(nodes, return_inverse=True)
    place = place.reshape(nodes.shape)
    n, d = int(row.max()) + 1, normal.shape[1]

    def gathered(directions: FloatArray) -> FloatArray:
        values = (weight[:, None] * shapes)[..., None] * directions[:, None, :]
        table = np.zeros((n, len(unique), d))
        np.add.at(table, (np.repeat(row, nodes.shape[1]), place.ravel()), values.reshape(-1, d))
        return table

    def mean(values: FloatArray) -> FloatArray:
        return np.bincount(row, weight * values, n).astype(np.float64)

    middle = np.stack([mean(normal[:, i]) for i in range(d)], axis=1)
    middle /= np.linalg.norm(middle, axis=1, keepdims=True)
    slips = tuple(gathered(t[row]) for t in across(middle))
    x = np.einsum("nk,nkd->nd", points.shapes, slave.corners[points.cell])
    least = mean(distance - faced.gap)
    return Rows(unique, gathered(normal), slips, least, area, mean(x[:, 0]))


def _as_relations(
    table: NodeTable, unknowns: tuple[str, ...], nodes: IntArray, values: FloatArray, sense: int
) -> Relations:
    """One relation a row; zero coefficients are left out."""
    n, d = len(values), len(unknowns)
    flat = np.where(np.abs(values) > NOTHING, values, 0.0).reshape(n, -1)
    columns = np.broadcast_to(np.repeat(nodes, d), flat.shape)
    return rows_from_table(table, columns, unknowns * len(nodes), flat, sense)


# How unilateral relations are enforced: a script's choice, free of heavy imports.


@dataclass(frozen=True)
class ContactOptions:
    """How unilateral relations are enforced."""

    method: str = "LAGRANGE"  # 'LAGRANGE', 'PENALITE', 'AUGMENTE' or 'UZAWA'
    coefficient: float | None = None  # penalty or augmentation
    correction: str = "FAUX"  # 'FAUX', 'MASSE' or 'RIGIDITE': of velocities when a relation closes
    persistent: bool = False  # relative velocity of relations that stay closed set to zero
    modified_mass: bool = False  # mass taken off the contact unknowns
