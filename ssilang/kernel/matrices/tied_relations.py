"""Relations that tie nodes together: rigid bodies, common values, meshes hooked onto others."""

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.matrices.location import locate
from ssilang.kernel.matrices.matrix import Relations
from ssilang.kernel.matrices.relations import Term, across, joined, relation_rows, rows_from_table
from ssilang.kernel.mesh.changes.degree import known_middles
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def same_value(table: NodeTable, nodes: IntArray, unknown: str) -> Relations:
    """`u_i = u_1` for all nodes but the first (ENSE); refuses a single node."""
    if len(nodes) < 2:
        raise MeshError("kernel.matrices.common-motion-needs-least")
    return relation_rows(table, [Term(1.0, unknown, nodes[1:]), Term(-1.0, unknown, nodes[:1])])


def rigid_with_rotations(
    table: NodeTable,
    turning: IntArray,
    following: IntArray,
    displacement: Sequence[str],
    rotation: Sequence[str],
) -> Relations:
    """Small rigid motion of nodes about a master, the first of `turning` (CORI 'ROTA').

    `u_i = u_m + theta_m x (x_i - x_m)` for all nodes, `theta_i = theta_m` for the other turning
    ones. `following` nodes have displacements only.
    """
    master = turning[:1]
    others = np.concatenate([turning[1:], np.setdiff1d(following, turning)])
    if len(turning) == 0 or len(others) == 0:
        raise MeshError("kernel.matrices.rigid-body-needs-least")
    arm = table.coordinates[others] - table.coordinates[master]
    levers = np.cross(np.eye(3)[-len(rotation) :, None], arm)  # about Z alone in the plane
    rows = [
        relation_rows(
            table,
            [
                Term(1.0, name, others),
                Term(-1.0, name, master),
                *(
                    Term(-part, turn, master)
                    for turn, part in zip(rotation, levers[:, :, axis], strict=True)
                    if part.any()
                ),
            ],
        )
        for axis, name in enumerate(displacement)
    ]
    if len(turning) > 1:
        rows += [same_value(table, turning, turn) for turn in rotation]
    return joined(rows)


def rigid_by_distances(
    table: NodeTable, nodes: IntArray, displacement: Sequence[str], check: bool = True
) -> Relations:
    """Small rigid motion of nodes by constant distances (CORI 'DEPL').

    A base of dim + 1 nodes far from each other is made rigid by all its distances; each other
    node keeps its distances to the dim base nodes that fix it best.

    Raises
    ------
    MeshError
        If `check` and the nodes do not span the space.
    """
    if len(nodes) < 2:
        raise MeshError("kernel.matrices.rigid-body-needs-least")
    dim = len(displacement)
    x = table.coordinates[nodes][:, :dim]
    base = _spread_base(x, dim)
    if len(base) < dim + 1 and check:
        raise MeshError("kernel.matrices.rigid-body-distances-needs", plane=dim == 2)
    pairs = [np.array(list(combinations(base, 2)), dtype=np.int64).reshape(-1, 2)]
    others = np.setdiff1d(np.arange(len(nodes)), base)
    pairs.append(_best_ties(x, others, base, dim))
    start, end = np.concatenate(pairs).T
    along = x[start] - x[end]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    return rows_from_table(
        table,
        nodes[np.concatenate([np.tile(start[:, None], dim), np.tile(end[:, None], dim)], axis=1)],
        (*displacement, *displacement),
        np.concatenate([along, -along], axis=1),
    )


def _spread_base(x: FloatArray, dim: int) -> IntArray:
    """Up to dim + 1 nodes, each as far as can be from the span of those before."""
    base = [int(np.argmax(np.linalg.norm(x - x.mean(axis=0), axis=1)))]
    rest = x - x[base[0]]
    size = np.linalg.norm(rest, axis=1).max()
    for _ in range(dim):
        distance = np.linalg.norm(rest, axis=1)
        new = int(np.argmax(distance))
        if distance[new] <= 1e-8 * size:
            break
        base.append(new)
        unit = rest[new] / distance[new]
        rest = rest - np.outer(rest @ unit, unit)
    return np.array(base, dtype=np.int64)


def _best_ties(x: FloatArray, others: IntArray, base: IntArray, dim: int) -> IntArray:
    """Pairs (node, base node), dim for each other node."""
    if len(others) == 0:
        return np.empty((0, 2), dtype=np.int64)
    away = x[others][:, None, :] - x[base][None, :, :]
    unit = away / np.linalg.norm(away, axis=2, keepdims=True)
    choices = list(combinations(range(len(base)), min(dim, len(base))))
    picks = np.array(choices, dtype=np.int64)
    gram = np.einsum("nci,ndi->ncd", unit, unit)
    volumes = np.stack([np.linalg.det(gram[:, c][:, :, c]) for c in picks], axis=1)
    best = picks[np.argmax(volumes, axis=1)]
    return np.stack([np.repeat(others, best.shape[1]), base[best].ravel()], axis=1)


def middle_nodes(mesh: Mesh, unknowns: Sequence[str]) -> Relations:
    """`u_middle = (u_a + u_b) / 2` on all edges of quadratic cells (MILI).

    Raises
    ------
    MeshError
        If the mesh has no quadratic cell.
    """
    edges = known_middles(mesh)
    if len(edges) == 0:
        raise MeshError("kernel.matrices.no-middle-node-mesh")
    _, first = np.unique(edges[:, 2], return_index=True)
    a, b, middle = edges[np.sort(first)].T
    return joined(
        [
            relation_rows(mesh.nodes, [Term(1.0, u, middle), Term(-0.5, u, a), Term(-0.5, u, b)])
            for u in unknowns
        ]
    )


def hooked(
    nodes: IntArray, mesh: Mesh, unknowns: Sequence[str], tolerance: float = 1e-5
) -> Relations:
    """Nodes follow the cells of `mesh` that they lie in (ACCRO); nodes outside are left free.

    Raises
    ------
    MeshError
        If no node lies in a cell.
    """
    own = np.setdiff1d(nodes, mesh.sorted_node_ids)
    rows = []
    for _, table, values in held(own, mesh, tolerance):
        rows += [
            rows_from_table(mesh.nodes, table, (u,) * table.shape[1], values) for u in unknowns
        ]
    if not rows:
        raise MeshError("kernel.matrices.no-node-first-mesh")
    return joined(rows)


def sliding(line: Mesh, mesh: Mesh, unknowns: Sequence[str], tolerance: float = 1e-5) -> Relations:
    """Nodes of a line follow the cells that they lie in, but for motion along the line (GLISSANT).

    The direction at a node is the mean of those of the line's cells that meet there.

    Raises
    ------
    MeshError
        If the first mesh is no line or no node of it lies in a cell.
    """
    dim = len(unknowns)
    own = np.setdiff1d(line.sorted_node_ids, mesh.sorted_node_ids)
    tangents = _line_tangents(line)[own, :dim]
    rows = []
    for inside, nodes, weights in held(own, mesh, tolerance):
        for normal in across(tangents[inside]):
            values = (normal[:, :, None] * weights[:, None, :]).reshape(len(nodes), -1)
            names = tuple(u for u in unknowns for _ in range(nodes.shape[1]))
            rows.append(rows_from_table(mesh.nodes, np.tile(nodes, (1, dim)), names, values))
    if not rows:
        raise MeshError("kernel.matrices.no-node-line-lies")
    return joined(rows)


def held(
    nodes: IntArray, mesh: Mesh, tolerance: float
) -> Iterator[tuple[NDArray[np.bool_], IntArray, FloatArray]]:
    """Nodes in cells, block by block: which of them, they and their cells' nodes, their weights."""
    found = locate(mesh, mesh.nodes.coordinates[nodes], tolerance)
    for block, (which, shapes) in zip(mesh.blocks, found, strict=True):
        inside = which >= 0
        if inside.any():
            table = np.column_stack([nodes[inside], block.connectivity[which[inside]]])
            weights = np.column_stack([np.ones(len(table)), -shapes[inside]])
            yield inside, table, np.where(np.abs(weights) < 1e-10, 0.0, weights)


def _line_tangents(line: Mesh) -> FloatArray:
    """Unit tangents (n_table, 3) at the nodes of a line, zero elsewhere."""
    total = np.zeros((len(line.nodes), 3))
    for block in line.blocks:
        if block.kind.dimension != 1 or block.kind.joint:
            raise MeshError(
                "kernel.matrices.sliding-relation-wants-line", cell_type=block.cell_type
            )
        x = block.coordinates
        along = x[:, -1] - x[:, 0]
        along = along / np.linalg.norm(along, axis=1, keepdims=True)
        np.add.at(total, block.connectivity.ravel(), np.repeat(along, x.shape[1], axis=0))
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return np.divide(total, length, out=np.zeros_like(total), where=length > 0.0)
