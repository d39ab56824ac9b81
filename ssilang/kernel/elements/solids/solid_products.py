"""Stiffness of many continuous elements with the same moduli at all points of a cell, compiled.

The moduli are taken out of the integral: of node a, unknown i and node b, unknown j

    K[ai, bj] = C[i, k, j, l] H[ak, bl] ,   H[ak, bl] = sum over points of w N_a,k N_b,l

so that the sum over points is one of products of gradients, a sixth of that of B^T D B in space.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.elements.shapes.quadrature import Rule
from ssilang.kernel.elements.shapes.reference import shape_gradients
from ssilang.kernel.elements.solids.kinematics import SolidKinematics


def gradient_moduli(kinematics: SolidKinematics, moduli: FloatArray) -> FloatArray:
    """C (n, d^2, d^2), rows (i, j), columns (k, l), from moduli (n, 1, s, s) of the strains."""
    d = kinematics.dimension
    strain = np.zeros((len(kinematics.strains), d, d))
    for row, unknown, axis, _ in kinematics.terms:
        if isinstance(axis, int):
            strain[row, unknown, axis] = 1.0
    C = np.einsum("rik,crs,sjl->cijkl", strain, moduli[:, 0], strain, optimize=True)
    return np.ascontiguousarray(C.reshape(len(moduli), d * d, d * d))


def stiffness_of(
    cell_type: str, rule: Rule, table: FloatArray, cells: IntArray, C: FloatArray
) -> FloatArray | None:
    """Stiffness matrices (n_cells, n_rows, n_rows), None if a cell is folded.

    Parameters
    ----------
    table : array (n_nodes, 3)
        Coordinates.
    cells : array (n_cells, k)
        Nodes of the cells.
    C : array (n_cells or 1, d^2, d^2)
        Of `gradient_moduli`.
    """
    reference = np.ascontiguousarray(shape_gradients(cell_type, rule.points).transpose(0, 2, 1))
    m = cells.shape[1] * reference.shape[1]
    values = np.empty((len(cells), m, m))
    cells = np.ascontiguousarray(cells, dtype=np.int64)
    whole = _sum_points(reference, rule.weights, np.ascontiguousarray(table), cells, C, values)
    return values if whole else None


@compiled_fast
def _cofactors(J: FloatArray, cofactors: FloatArray) -> float:
    """Determinant of a matrix of one to three rows; its cofactors, transposed inverse times it."""
    d = J.shape[0]
    if d == 1:
        cofactors[0, 0] = 1.0
        return float(J[0, 0])
    if d == 2:
        cofactors[0, 0], cofactors[0, 1] = J[1, 1], -J[1, 0]
        cofactors[1, 0], cofactors[1, 1] = -J[0, 1], J[0, 0]
        return float(J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0])
    det = 0.0
    for i in range(3):
        e, f = (i + 1) % 3, (i + 2) % 3
        for j in range(3):
            g, h = (j + 1) % 3, (j + 2) % 3
            cofactors[i, j] = J[e, g] * J[f, h] - J[e, h] * J[f, g]
    for j in range(3):
        det += J[0, j] * cofactors[0, j]
    return det


@compiled_fast
def _gradients(
    reference: FloatArray, table: FloatArray, nodes: IntArray, J: FloatArray, inverse: FloatArray,
    g: FloatArray, volumes: FloatArray,
) -> bool:  # fmt: skip
    """Gradients g (p, d k), by x first, and |Jacobians| (p,) of a cell; False if it is folded."""
    points, d, k = reference.shape
    low, high, least = np.inf, -np.inf, np.inf
    for p in range(points):
        for i in range(d):
            for j in range(d):
                total = 0.0
                for a in range(k):
                    total += reference[p, i, a] * table[nodes[a], j]
                J[i, j] = total
        det = _cofactors(J, inverse)
        low, high, least = min(low, det), max(high, det), min(least, abs(det))
        volumes[p] = abs(det)
        if det == 0.0:
            return False
        for j in range(d):
            for a in range(k):
                g[p, j * k + a] = 0.0
            for i in range(d):
                s = inverse[i, j] / det
                for a in range(k):
                    g[p, j * k + a] += s * reference[p, i, a]
    return low * high > 0.0 and least > 1e-14 * max(abs(low), abs(high))


@compiled_fast
def _sum_points(
    reference: FloatArray, weights: FloatArray, table: FloatArray, cells: IntArray, C: FloatArray,
    values: FloatArray,
) -> bool:  # fmt: skip
    """Fill the matrices; False at the first folded cell."""
    points, d, k = reference.shape
    J, inverse = np.empty((d, d)), np.empty((d, d))
    g, volumes = np.empty((points, d * k)), np.empty(points)
    H, row = np.empty(d * d * k), np.empty(k)
    for c in range(len(cells)):
        if not _gradients(reference, table, cells[c], J, inverse, g, volumes):
            return False
        moduli = C[c % len(C)]
        for a in range(k):
            H[:] = 0.0
            for p in range(points):
                w = weights[p] * volumes[p]
                for i in range(d):
                    s = w * g[p, i * k + a]
                    for q in range(d * k):
                        H[i * d * k + q] += s * g[p, q]
            for i in range(d):
                for j in range(d):
                    row[:] = 0.0
                    for e in range(d * d):
                        s = moduli[i * d + j, e]
                        if s != 0.0:
                            for b in range(k):
                                row[b] += s * H[e * k + b]
                    for b in range(k):
                        values[c, a * d + i, b * d + j] = row[b]
    return True
