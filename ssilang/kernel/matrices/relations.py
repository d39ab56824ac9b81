"""Making relations: supports, sums over meshes, directions, symmetry planes.

All functions return `Relations` with multiplier nodes of their own, placed at the first node of
each row. Sense: 0 equality, +1 'MINI' (stays at or above), -1 'MAXI' (stays at or below).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.matrices import matrix
from ssilang.kernel.mesh.nodes import NodeTable

_ROUNDING = 1e-14  # of the largest coefficient: what a sum of others leaves


def translations(mode: Mode) -> tuple[str, ...]:
    """Names of the displacement unknowns ('DEPL')."""
    return NODE_TRANSLATIONS[mode]


def rotations(mode: Mode) -> tuple[str, ...]:
    """Names of the rotation unknowns ('ROTA')."""
    return NODE_ROTATIONS[mode]


def in_space(mode: Mode) -> tuple[str, ...]:
    """Displacements along the coordinate axes: without UT of Fourier modes."""
    return translations(mode)[: mode.dimension]


@dataclass(frozen=True, eq=False)
class Term:
    """`coefficient * unknown` at each of `nodes`: one term a row, or one node for all rows.

    `coefficients` is a number or an array (n,).
    """

    coefficients: float | FloatArray
    unknown: str
    nodes: IntArray


def relation_rows(table: NodeTable, terms: Sequence[Term], sense: int = 0) -> matrix.Relations:
    """Row i: the sum of the terms at their i-th nodes.

    Raises
    ------
    MeshError
        If the terms have different numbers of nodes, none of them 1.
    FieldError
        If every coefficient of a row is zero.
    """
    sizes = sorted({len(t.nodes) for t in terms} - {1}) or [1]
    if len(sizes) > 1 or not terms:
        raise MeshError("kernel.matrices.meshes-relation-nodes", sizes=sizes)
    n = sizes[0]
    coefficients = np.stack([np.broadcast_to(t.coefficients, n) for t in terms], axis=1)
    nodes = np.stack([np.broadcast_to(t.nodes, n) for t in terms], axis=1)
    return rows_from_table(table, nodes, tuple(t.unknown for t in terms), coefficients, sense)


def rows_from_table(
    table: NodeTable,
    nodes: IntArray,
    unknowns: tuple[str, ...],
    coefficients: FloatArray,
    sense: int = 0,
    multipliers: IntArray | None = None,
) -> matrix.Relations:
    """Rows with the same unknowns: nodes and coefficients (n_rows, n_terms); zeros are dropped.

    Multiplier nodes (n_rows,) are made where none are given.

    Raises
    ------
    FieldError
        If every coefficient of a row is zero, or one is no finite number.
    """
    for column, name in enumerate(unknowns):
        _finite(table, nodes[:, column], name, coefficients[:, column])
    kept = coefficients != 0.0
    counts = kept.sum(axis=1)
    if (counts == 0).any():
        node = table.told(nodes[np.argmin(counts), 0])
        raise FieldError("kernel.matrices.relation-node-no-coefficient", node=node)
    names = np.array(unknowns, dtype=object)
    where = np.broadcast_to(np.arange(len(unknowns)), kept.shape)[kept]
    own = _multiplier_nodes(table, nodes[:, 0]) if multipliers is None else multipliers
    return matrix.Relations(
        table, np.concatenate([[0], np.cumsum(counts)]).astype(np.int64), nodes[kept],
        tuple(names[where]), np.asarray(coefficients[kept], dtype=float), own,
        np.full(len(nodes), sense, dtype=np.int8),
    )  # fmt: skip


def saying_nothing(relations: matrix.Relations) -> IntArray:
    """Rows whose coefficients cancel: unknowns of theirs that stand there twice, of other signs."""
    rows = np.repeat(np.arange(len(relations)), np.diff(relations.row_start))
    names = np.unique(relations.unknowns, return_inverse=True)[1]
    keys = np.column_stack([rows, relations.nodes, names])
    places, which = np.unique(keys, axis=0, return_inverse=True)
    sums = np.abs(np.bincount(which.ravel(), relations.coefficients, len(places)))
    largest, left = np.zeros((2, len(relations)))
    np.maximum.at(largest, rows, np.abs(relations.coefficients))
    np.maximum.at(left, places[:, 0], sums)
    return np.flatnonzero(left <= _ROUNDING * largest)


def _finite(table: NodeTable, nodes: IntArray, unknown: str, factors: FloatArray) -> None:
    """Refuse factors that are NaN or infinite."""
    wrong = np.flatnonzero(~np.isfinite(factors))
    if len(wrong):
        node = table.told(int(nodes[wrong[0]]))
        raise FieldError("kernel.matrices.factor-not-finite", unknown=unknown, node=node)


def _multiplier_nodes(table: NodeTable, beside: IntArray) -> IntArray:
    return table.add(table.coordinates[table.resolve(beside)].copy())


def joined(parts: Sequence[matrix.Relations]) -> matrix.Relations:
    """Rows of all parts (at least one), one after the other, in one object."""
    starts = np.concatenate([[0], *(np.diff(p.row_start) for p in parts)]).cumsum()
    return matrix.Relations(
        parts[0].table,
        starts.astype(np.int64),
        np.concatenate([p.raw_nodes for p in parts]),
        tuple(u for p in parts for u in p.unknowns),
        np.concatenate([p.coefficients for p in parts]),
        np.concatenate([p.raw_multipliers for p in parts]),
        np.concatenate([p.sense for p in parts]),
    )


def blocked(
    table: NodeTable, nodes: IntArray, unknowns: Sequence[str], sense: int = 0
) -> matrix.Relations:
    """`u = d` for each unknown at each node: rows by unknown, then by node."""
    return joined([relation_rows(table, [Term(1.0, u, nodes)], sense) for u in unknowns])


def blocked_along(
    table: NodeTable,
    nodes: IntArray,
    unknowns: Sequence[str],
    directions: FloatArray,
    sense: int = 0,
) -> matrix.Relations:
    """`u . direction = d` with directions (n_nodes, dim) or (dim,), made of length one.

    Raises
    ------
    FieldError
        If a direction is zero.
    """
    d = np.broadcast_to(directions, (len(nodes), len(unknowns))).astype(float)
    length = np.linalg.norm(d, axis=1, keepdims=True)
    if (length == 0.0).any():
        node = table.told(nodes[int(np.argmin(length))])
        raise FieldError("kernel.matrices.direction-node-no-length", node=node)
    d = d / length
    d[np.abs(d) < 1e-15] = 0.0
    table_of_nodes = np.repeat(nodes[:, None], len(unknowns), axis=1)
    return rows_from_table(table, table_of_nodes, tuple(unknowns), d, sense)


def radial_directions(
    table: NodeTable, nodes: IntArray, centre: FloatArray, axis: FloatArray | None
) -> FloatArray:
    """Vectors (n, 3) from the centre, or from the line (centre, axis), to the nodes.

    Raises
    ------
    MeshError
        If a node lies on the centre or axis.
    """
    away = table.coordinates[nodes] - centre
    if axis is not None:
        unit = axis / np.linalg.norm(axis)
        away = away - np.outer(away @ unit, unit)
    distance = np.linalg.norm(away, axis=1)
    if (distance <= 1e-12 * max(distance.max(initial=0.0), 1e-300)).any():
        node = table.told(nodes[int(np.argmin(distance))])
        raise MeshError("kernel.matrices.node-lies-axis-no", node=node)
    return away


def orthoradial_directions(radial: FloatArray, axis: FloatArray | None) -> FloatArray:
    """Vectors (n, 3) normal to the radial ones and to the axis (Z in the plane)."""
    turn = np.array([0.0, 0.0, 1.0]) if axis is None else axis / np.linalg.norm(axis)
    return np.cross(turn, radial)


def from_field(
    field: NodeField, sense: int = 0, multiplier: IntArray | None = None
) -> matrix.Relations:
    """One row: the sum of all values of a field times the unknowns of their names.

    Raises
    ------
    FieldError
        If the field has no value other than zero, or one that is no finite number.
    """
    for name, part in field.components.items():
        _finite(field.table, part.nodes, name, part.values)
    parts = [(name, p.nodes[p.values != 0], p.values[p.values != 0])
             for name, p in field.components.items()]  # fmt: skip
    nodes = np.concatenate([n for _, n, _ in parts] or [np.empty(0, np.int64)])
    if len(nodes) == 0:
        raise FieldError("kernel.matrices.field-relation-no-coefficient")
    own = _multiplier_nodes(field.table, nodes[:1]) if multiplier is None else multiplier
    return matrix.Relations(
        field.table, np.array([0, len(nodes)]), nodes,
        tuple(name for name, n, _ in parts for _ in n), np.concatenate([v for _, _, v in parts]),
        own, np.array([sense], dtype=np.int8),
    )  # fmt: skip


def primal_names(field: NodeField) -> NodeField:
    """A field of forces (FX, MZ ...) under the names of the displacements they work on.

    Components that are no force's names stay as they are.
    """
    names = {dual: primal for primal, dual in matrix.PRIMAL_TO_DUAL.items()}
    parts = {names.get(name, name): part for name, part in field.components.items()}
    return NodeField(field.table, parts, field.nature)


# --- planes of symmetry ----------------------------------------------------------------------


def on_plane(
    table: NodeTable, nodes: IntArray, points: FloatArray, tolerance: float
) -> tuple[IntArray, FloatArray]:
    """Nodes within `tolerance` of the line (2 points) or plane (3 points), and its unit normal.

    Raises
    ------
    MeshError
        If the points coincide or lie on one line, or no node is near enough.
    """
    first, second = points[0], points[1] - points[0]
    other = points[2] - first if len(points) == 3 else np.array([0.0, 0.0, 1.0])
    normal = np.cross(second, other)
    length = float(np.linalg.norm(normal))
    if length <= 1e-12 * np.linalg.norm(second) * np.linalg.norm(other):
        raise MeshError("kernel.matrices.points-define-symmetry-line")
    normal = normal / length
    distance = np.abs((table.coordinates[nodes] - first) @ normal)
    near = nodes[distance <= tolerance]
    if len(near) == 0:
        if len(distance) == 0:
            raise MeshError("kernel.matrices.no-node-to-mirror")
        raise MeshError(
            "kernel.matrices.no-node-within-symmetry", tolerance=tolerance, nearest=distance.min()
        )
    return near, normal


def mirror_rows(
    table: NodeTable,
    nodes: IntArray,
    normal: FloatArray,
    displacement: Sequence[str],
    rotation: Sequence[str],
    mirrored: bool,
) -> matrix.Relations:
    """Conditions on a plane of symmetry (`mirrored`) or antisymmetry.

    Symmetry holds the displacement along the normal and the rotations about the axes in the
    plane; antisymmetry holds the others. In 2D the rotation is about an axis in the plane.
    """
    dim = len(displacement) or (3 if len(rotation) == 3 else 2)
    along, within = [normal[:dim]], across(normal[None, : max(dim, 2)])
    rows = [
        blocked_along(table, nodes, displacement, d)
        for d in (along if mirrored else within)
        if len(displacement)
    ]
    if len(rotation) == 3:
        turned = within if mirrored else along
        rows += [blocked_along(table, nodes, rotation, d) for d in turned]
    elif len(rotation) == 1 and mirrored:
        rows.append(blocked(table, nodes, rotation))
    if not rows:
        raise FieldError("kernel.matrices.antisymmetry-leaves-rotations-plane")
    return joined(rows)


def across(vectors: FloatArray) -> list[FloatArray]:
    """Unit vectors across unit vectors (n, dim): one in the plane, two in space."""
    if vectors.shape[1] == 2:
        return [np.stack([-vectors[:, 1], vectors[:, 0]], axis=1)]
    side = np.eye(3)[np.abs(vectors).argmin(axis=1)]
    first = np.cross(vectors, side)
    first = first / np.linalg.norm(first, axis=1, keepdims=True)
    return [first, np.cross(vectors, first)]


# --- springs to the ground -------------------------------------------------------------------


def springs(
    table: NodeTable, nodes: IntArray, unknowns: Sequence[str], stiffness: float,
    directions: FloatArray | None = None,
) -> matrix.Matrix:  # fmt: skip
    """A spring of the given stiffness at each node on each unknown, or along a direction.

    `directions` (n, dim) or (dim,) are made of length one.
    """
    m = len(unknowns)
    if directions is None:
        values = np.broadcast_to(np.eye(m), (len(nodes), m, m))
    else:
        d = np.broadcast_to(directions, (len(nodes), m))
        d = d / np.linalg.norm(d, axis=1, keepdims=True)
        values = d[:, :, None] * d[:, None, :]
    block = matrix.ElementMatrices(
        table, np.asarray(nodes)[:, None], np.zeros(m, dtype=np.int64), tuple(unknowns),
        tuple(matrix.dual_of(u) for u in unknowns), stiffness * values,
    )  # fmt: skip
    return matrix.Matrix(table, (block,))
