"""The response of a condensed interface: `Y = (1 + S (c K - R))^-1 S`, which follows its points.

K is the stiffness of the tangents that Y belongs to. A point whose tangent changes by dD changes K
by `w B^T dD B`, of the rank of dD at most, and Y by

    Y - Y B^T (1 + M N)^-1 M B Y ,   M = c w dD ,   N = B Y B^T

which costs a product of q^2 numbers for each row of dD, where new factors cost q^3. Newton's
direction is `-(1 + S (c K - R))^-1 r = Y (c K - R) r - r`. Directions need few digits, since
Newton's residual is made with S itself: Y may be of single precision.
"""

from typing import Any, NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart, later, seldom
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import add_product, copy_rows, copy_state
from ssilang.kernel.interface.factors.newton_matrix import newton_matrix
from ssilang.kernel.interface.response import (
    Joints,
    add_point_stiffness,
    add_stiffness_forces,
)
from ssilang.kernel.solvers.dense import factorise_dense, solve_factors_together

PLAIN = 64  # jumps up to which Y is made by plain elimination
NOTHING = 1e-15  # of the largest number: a pivot of a singular matrix
VANISHING = 1e-10  # of the largest number of `1 + M N`: a pivot from which Y is made anew


class Inverse(NamedTuple):
    """Y, and what is overwritten."""

    Y: FloatArray  # (q, q) of double or single precision
    x: FloatArray  # (q,) a vector on its way, of the precision of Y
    room: FloatArray  # (q,)
    rows: FloatArray  # (2, d, q) `B Y` and `(Y B^T)^T` of one point
    changes: FloatArray  # (2, d, d) of one point's tangent, and the matrix of their solution
    K: FloatArray  # (q, q) the stiffness `c K - R` itself beside few jumps, else no rows


def new_inverse(q: int, d: int, precision: Any = np.float64, few: bool = False) -> Inverse:
    """Room for q jumps of pairs of points in d directions; `few` jumps join many points."""
    return Inverse(
        np.zeros((q, q), precision), np.zeros(q, precision), np.zeros(q), np.zeros((2, d, q)),
        np.zeros((2, d, d)), np.zeros((q, q) if few else (0, 0)),
    )  # fmt: skip


@compiled_fast
def _products(pairs: IntArray, B: FloatArray, Y: FloatArray, room: FloatArray) -> None:
    """B Y and (Y B^T)^T of one point: room (2, d, q)."""
    d = len(B)
    for a in range(d):
        row, column = room[0, a], room[1, a]
        for k in range(len(Y)):
            row[k] = column[k] = 0.0
        for b in range(B.shape[1]):
            value, at = B[a, b], pairs[b // d] * d + b % d
            if value != 0.0:
                line = Y[at]
                for k in range(len(Y)):
                    row[k] += value * line[k]
                for k in range(len(Y)):
                    column[k] += value * Y[k, at]


@compiled_fast
def solve_small(A: FloatArray, X: FloatArray, least: float) -> bool:
    """A X = X in place, by elimination with row exchanges.

    A is (n, n), X (n, m); both are overwritten. False if a pivot is below `least`, a share of the
    largest number of A and of one.
    """
    n, m, top = len(A), X.shape[1], 1.0
    for i in range(n):
        for j in range(n):
            top = max(top, abs(A[i, j]))
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(A[i, k]) > abs(A[pivot, k]):
                pivot = i
        if not abs(A[pivot, k]) > least * top:
            return False
        for j in range(n):
            A[k, j], A[pivot, j] = A[pivot, j], A[k, j]
        for j in range(m):
            X[k, j], X[pivot, j] = X[pivot, j], X[k, j]
        for i in range(n):
            if i != k:
                factor = A[i, k] / A[k, k]
                for j in range(n):
                    A[i, j] -= factor * A[k, j]
                for j in range(m):
                    X[i, j] -= factor * X[k, j]
    for i in range(n):
        for j in range(m):
            X[i, j] /= A[i, i]
    return True


@later
@compiled_fast
def update_point(
    pairs: IntArray, B: FloatArray, weight: float, D: FloatArray, known: FloatArray,
    inverse: Inverse,
) -> bool:  # fmt: skip
    """Y after the tangent of a point went from `known` to D; `weight` holds c.

    False, and Y to be made anew, if the update is not safe.
    """
    d, rows, columns, Y = len(B), inverse.rows[0], inverse.rows[1], inverse.Y
    E, T = inverse.changes[0], inverse.changes[1]
    for i in range(d):
        for j in range(d):
            E[i, j] = weight * (D[i, j] - known[i, j])
    _products(pairs, B, Y, inverse.rows)
    for i in range(d):
        for j in range(d):
            T[i, j] = 1.0 if i == j else 0.0
            for k in range(d):  # M (B Y) B^T
                product = 0.0
                for b in range(B.shape[1]):
                    product += rows[k, pairs[b // d] * d + b % d] * B[j, b]
                T[i, j] += E[i, k] * product
    if len(inverse.K):
        add_point_stiffness(pairs, B, 1.0, E, inverse.K)
    if not solve_small(T, E, VANISHING):
        return False
    for k in range(len(Y)):
        line = Y[k]
        for j in range(d):
            factor, right = 0.0, rows[j]
            for i in range(d):
                factor += columns[i, k] * E[i, j]
            if factor != 0.0:
                for at in range(len(right)):
                    line[at] -= factor * right[at]
    return True


@seldom
@compiled
def make_plain(joints: Joints, condensed: Condensed, D: FloatArray, inverse: Inverse) -> bool:
    """Y of the tangents D; False if there is none."""
    Y, K = inverse.Y, inverse.K
    A = np.empty(Y.shape, Y.dtype)
    newton_matrix(joints, condensed, D, K if len(K) else np.empty(Y.shape), A)
    copy_rows(condensed.S, Y)
    return solve_small(A, Y, NOTHING)


@seldom
@compiled
def make_by_blocks(joints: Joints, condensed: Condensed, D: FloatArray, Y: FloatArray) -> bool:
    """As `make_plain`, by factors that read large matrices less often, in the precision of Y."""
    A, order = np.empty(Y.shape, Y.dtype), np.empty(len(Y), np.int64)
    newton_matrix(joints, condensed, D, np.empty(Y.shape), A)
    if not factorise_dense(A, order):
        return False
    copy_rows(condensed.S, Y)
    solve_factors_together(A, order, Y)
    return True


@compiled_fast
def subtract_jumps(inverse: Inverse, forces: FloatArray, x: FloatArray) -> None:
    """x -= Y forces."""
    copy_state(forces, inverse.x)
    add_product(-1.0, inverse.Y, inverse.x, x)


@compiled
def stiffness_forces(
    joints: Joints, condensed: Condensed, D: FloatArray, inverse: Inverse, x: FloatArray
) -> None:
    """`(c K - R) x` into the room, K of the tangents D that Y belongs to."""
    K, forces = inverse.K, inverse.room
    for i in range(len(x)):
        forces[i] = 0.0
    add_product(1.0, K, x, forces)
    if not len(K):
        add_product(-1.0, condensed.R, x, forces)
        add_stiffness_forces(joints, condensed.c, D, x, forces)


@apart
@compiled
def apply_inverse(
    joints: Joints, condensed: Condensed, D: FloatArray, inverse: Inverse, x: FloatArray
) -> None:
    """`x := (1 + S (c K - R))^-1 x = x - Y (c K - R) x`, K of the tangents D that Y belongs to."""
    stiffness_forces(joints, condensed, D, inverse, x)
    subtract_jumps(inverse, inverse.room, x)
