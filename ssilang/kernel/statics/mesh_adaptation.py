"""Displacements that make cells regular and equal in a metric (W. Huang, JCP 174, 2001).

With A = dx / dxi of a point of a cell towards the regular cell of measure one, J = det A, M the
metric and rho = sqrt(det M), what is made small is the integral over the regular cells of

    rho J (theta t^p + (1 - 2 theta) d^p (J rho)^-gamma),  t = tr(A^-1 M^-1 A^-T),  p = d gamma / 2

by Newton's method, in which cells whose second derivative is indefinite count by its positive part.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.shapes.quadrature import quadrature
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS, shape_gradients
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.statics.linear import linear_system

UNKNOWNS = ("UX", "UY", "UZ")
_HALVINGS, _SMALL = 30, 1e-9
_ROOT = np.sqrt(3.0)
_POINTS = {"triangle": 3, "quadrangle": 4, "tetrahedron": 4, "prism": 6, "hexahedron": 8}
# sides of the regular cell along the axes of its reference, before its measure is made one
_REGULAR = {
    "triangle": [[1.0, 0.5], [0.0, _ROOT / 2]],
    "tetrahedron": [[1.0, 0.5, 0.5], [0.0, _ROOT / 2, _ROOT / 6], [0.0, 0.0, np.sqrt(2 / 3)]],
    "prism": [[1.0, 0.5, 0.0], [0.0, _ROOT / 2, 0.0], [0.0, 0.0, 0.5]],
}


@cache
def _regular(cell_type: str) -> tuple[FloatArray, FloatArray]:
    """Gradients (n_points, n_nodes, d) by the coordinates of the regular cell, weights."""
    shape = REFERENCE_CELLS[cell_type].shape
    if shape not in _POINTS:
        raise MeshError("kernel.mesh.cells-type-cannot-follow", cell_type=cell_type)
    rule = quadrature(shape, _POINTS[shape])
    d = rule.points.shape[1]
    frame = np.array(_REGULAR.get(shape, np.eye(d)))
    frame /= (np.linalg.det(frame) * rule.weights.sum()) ** (1.0 / d)
    weights = rule.weights / rule.weights.sum()
    return shape_gradients(cell_type, rule.points) @ np.linalg.inv(frame), weights


@dataclass(frozen=True, eq=False)
class _Cells:
    """A block with the metric (n_cells, d, d) of its cells, theta and the power gamma."""

    block: CellBlock
    metric: FloatArray
    theta: float
    gamma: float

    def places(self, x: FloatArray) -> FloatArray:
        """A (n_cells, n_points, d, d) for coordinates (n_nodes_of_table, d)."""
        gradients, _ = _regular(self.block.cell_type)
        return np.einsum("cnd,qne->cqde", x[self.block.connectivity], gradients)

    def density(self, A: FloatArray) -> tuple[FloatArray, FloatArray]:
        """What is integrated (n_cells, n_points), and its derivative by A."""
        d, theta, gamma = A.shape[-1], self.theta, self.gamma
        M, p = self.metric[:, None], d * gamma / 2
        rho, J, C = np.sqrt(np.linalg.det(M)), np.linalg.det(A), np.linalg.inv(A)
        turned = np.swapaxes(C, -1, -2)
        S = C @ np.linalg.inv(M) @ turned
        t = np.trace(S, axis1=-2, axis2=-1)
        even = (1 - 2 * theta) * d**p * (J * rho) ** -gamma
        value = rho * J * (theta * t**p + even)
        first = rho * J * (theta * t**p + (1 - gamma) * even)
        second = 2 * rho * J * theta * p * t ** (p - 1)
        return value, first[..., None, None] * turned - second[..., None, None] * (turned @ S)

    def newton(self, A: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Derivative (n_cells, n_nodes, d) of the integral, positive part of the second one."""
        gradients, weights = _regular(self.block.cell_type)
        d, size = A.shape[-1], 1e-5 * np.linalg.norm(A, axis=(-2, -1))[..., None, None]
        T = np.empty((*A.shape[:2], d * d, d * d))
        for k, unit in enumerate(np.eye(d * d).reshape(-1, d, d)):
            change = self.density(A + size * unit)[1] - self.density(A - size * unit)[1]
            T[..., k] = (change / (2 * size)).reshape(*A.shape[:2], d * d)
        values, vectors = np.linalg.eigh((T + np.swapaxes(T, -1, -2)) / 2)
        values = np.maximum(values, 1e-6 * values[..., -1:])
        T = (vectors * values[..., None, :]) @ np.swapaxes(vectors, -1, -2)
        T = T.reshape(*A.shape[:2], d, d, d, d)
        pull = np.einsum("q,cqde,qne->cnd", weights, self.density(A)[1], gradients)
        K = np.einsum("q,qne,cqdefg,qmg->cndmf", weights, gradients, T, gradients, optimize=True)
        n = pull.shape[1] * d
        return pull, K.reshape(len(K), n, n)


def adapted(
    mesh: Mesh,
    metrics: list[FloatArray],
    theta: float,
    gamma: float,
    conditions: Matrix,
    imposed: NodeField | None,
    directions: tuple[int, ...],
    most: int,
) -> NodeField:
    """Displacement of the nodes of a mesh.

    Parameters
    ----------
    metrics : list of arrays (n_cells, d, d)
        For each block of the mesh, in length^-2.
    theta : float
        Weight of the regularity of cells against their equality, 0 to 1.
    gamma : float
        Power of both, above 1.
    conditions : Matrix; imposed : NodeField or None
        Conditions on the displacements, with their values.
    directions : tuple of int
        Axes along which nodes may move.
    most : int
        Most steps.

    Raises
    ------
    MeshError
        If a cell is turned over, or of a type without a regular shape.
    """
    d = metrics[0].shape[-1]
    cells = [_Cells(b, m, theta, gamma) for b, m in zip(mesh.blocks, metrics, strict=True)]
    x = mesh.nodes.coordinates[:, :d].copy()
    start = x.copy()
    total = _total(cells, x)
    if not np.isfinite(total):
        raise MeshError("kernel.mesh.cells-turned-over")
    for _ in range(most):
        matrix, pull = _system(cells, x, directions, conditions)
        numbering = assembly.numbering_of(matrix)
        rows = assembly.constraint_matrix(matrix, numbering)
        codes = np.array([numbering.code(UNKNOWNS[k]) for k in directions])
        place = numbering.index(mesh.sorted_node_ids[:, None], codes)
        moved = np.ix_(mesh.sorted_node_ids, np.array(directions))
        force, gone = np.zeros(numbering.size), np.zeros(numbering.size)
        force[place], gone[place] = -pull[moved], (x - start)[moved]
        wanted = np.zeros(len(rows.multipliers))
        if imposed is not None:
            wanted = assembly.imposed_values(imposed, rows.multipliers)
        left = wanted - rows.C @ gone
        met = float(np.abs(left).max(initial=0.0)) <= 1e-9 * float(np.ptp(start, axis=0).max())
        step = np.zeros_like(x)
        step[moved] = linear_system(matrix).solve(force, left).u[place]
        for k in range(_HALVINGS):
            trial = x + step / 2**k
            value = _total(cells, trial)
            if value < total or (not met and np.isfinite(value)):
                break
        else:
            break
        x, total = trial, value
        if np.abs(step).max() <= _SMALL * np.ptp(start, axis=0).max():
            break
    nodes = mesh.sorted_node_ids
    moves = {UNKNOWNS[k]: (x - start)[nodes, k] for k in directions}
    return NodeField.of(mesh.nodes, nodes, moves, "DIFFUS")


def _total(cells: list[_Cells], x: FloatArray) -> float:
    """The integral; infinite where a cell is turned over."""
    total = 0.0
    for part in cells:
        A = part.places(x)
        if not (np.linalg.det(A) > 0).all():
            return np.inf
        total += float((part.density(A)[0] @ _regular(part.block.cell_type)[1]).sum())
    return total


def _system(
    cells: list[_Cells], x: FloatArray, directions: tuple[int, ...], conditions: Matrix
) -> tuple[Matrix, FloatArray]:
    """Second derivatives with the conditions, first derivative at each node of the table."""
    pull, blocks = np.zeros_like(x), []
    d = x.shape[1]
    for part in cells:
        table = part.block.connectivity
        own, K = part.newton(part.places(x))
        np.add.at(pull, table, own)
        n = table.shape[1]
        kept: IntArray = np.flatnonzero(np.isin(np.tile(np.arange(d), n), directions))
        unknowns = tuple(UNKNOWNS[k % d] for k in kept)
        duals = tuple(u.replace("U", "F") for u in unknowns)
        values = K[:, kept][:, :, kept]
        blocks.append(ElementMatrices(part.block.nodes, table, kept // d, unknowns, duals, values))
    made = Matrix(conditions.table, (*blocks, *conditions.blocks), conditions.relations)
    return made, pull
