"""The condensed interface of few jumps: `Y = (1 + S (c K - R))^-1 S`, kept while points change.

K is the stiffness of the tangents that Y belongs to. A point whose tangent changes by dD changes K
by `w B^T dD B`, of the rank of dD at most, and Y by

    Y - Y B^T (1 + M N)^-1 M B Y ,   M = c w dD ,   N = B Y B^T

which costs two products of q^2 numbers for each row of dD, where new factors cost q^3. Newton's
direction is `-(1 + S (c K - R))^-1 r = Y (c K - R) r - r`.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart, later, seldom
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_rows, dot, is_equal
from ssilang.kernel.interface.factors.newton_matrix import newton_matrix
from ssilang.kernel.interface.response import Joints, add_stiffness_forces
from ssilang.kernel.solvers.dense import factorise_dense, solve_factors_together

UPDATES = 64  # between two times that Y is made anew: rounding does not grow
PLAIN = 64  # jumps up to which Y is made by plain elimination
NOTHING = 1e-15  # of the largest number: a pivot of a singular matrix
VANISHING = 1e-10  # of the largest number of `1 + M N`: a pivot from which Y is made anew


class Inverse(NamedTuple):
    """Y, and what is overwritten."""

    Y: FloatArray  # (q, q)
    room: FloatArray  # (q,)
    updates: IntArray  # (1,) how many points were changed since Y was made
    # (q, q) Newton's, of which Y is made by plain elimination; no rows where that is done by blocks
    matrix: FloatArray
    rows: FloatArray  # (2, d, q) `B Y` and `(Y B^T)^T` of one point
    changes: FloatArray  # (2, d, d) of one point's tangent, and the matrix of their solution


def inverse_of(Y: FloatArray, d: int) -> Inverse:
    """Of points in d directions."""
    q = len(Y)
    m = q if q <= PLAIN else 0
    return Inverse(
        Y, np.zeros(q), np.zeros(1, np.int64), np.zeros((m, m)), np.zeros((2, d, q)),
        np.zeros((2, d, d)),
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

    False, and Y as it was, if the update is not safe.
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
    if not solve_small(T, E, VANISHING):
        return False
    for i in range(d):
        for j in range(d):
            if E[i, j] != 0.0:
                left, right = columns[i], rows[j]
                for k in range(len(Y)):
                    factor, line = E[i, j] * left[k], Y[k]
                    for at in range(len(right)):
                        line[at] -= factor * right[at]
    return True


@seldom
@compiled
def update_inverse(
    joints: Joints, condensed: Condensed, D: FloatArray, known: FloatArray, inverse: Inverse
) -> bool:
    """Y, that belongs to the tangents `known`, becomes that of D, as do these; False if none is."""
    n, d, changed, Y = len(condensed.S), D.shape[1], 0, inverse.Y
    for p in range(D.shape[0]):
        if not is_equal(D[p], known[p]):
            changed += 1
    if changed == 0:
        return True
    # point by point, as long as that is cheaper and safe
    if known[0, 0, 0] == known[0, 0, 0] and 3 * d * changed <= 2 * n:
        good = inverse.updates[0] + changed <= UPDATES
        for p in range(D.shape[0]):
            if good and not is_equal(D[p], known[p]):
                weight = condensed.c * joints.weights[p]
                good = update_point(joints.pairs[p], joints.B[p], weight, D[p], known[p], inverse)
                if good:
                    inverse.updates[0] += 1
                    copy_rows(D[p], known[p])
        if good:
            return True
    # else anew
    if n <= PLAIN:
        good = make_anew(joints, condensed, D, inverse)
    else:
        good = make_by_blocks(joints, condensed, D, Y)
    for p in range(D.shape[0]):
        if good:
            copy_rows(D[p], known[p])
        else:
            known[p, 0, 0] = np.nan
    if good:
        inverse.updates[0] = 0
    return good


@apart
@compiled
def make_anew(joints: Joints, condensed: Condensed, D: FloatArray, inverse: Inverse) -> bool:
    """Y of the tangents D; False if there is none."""
    newton_matrix(joints, condensed, D, inverse.matrix)
    copy_rows(condensed.S, inverse.Y)
    return solve_small(inverse.matrix, inverse.Y, NOTHING)


@seldom
@compiled
def make_by_blocks(joints: Joints, condensed: Condensed, D: FloatArray, Y: FloatArray) -> bool:
    """As `make_anew`, by factors that read large matrices less often, in the precision of Y."""
    A, order = np.empty(Y.shape, Y.dtype), np.empty(len(Y), np.int64)
    newton_matrix(joints, condensed, D, A)
    if not factorise_dense(A, order):
        return False
    copy_rows(condensed.S, Y)
    solve_factors_together(A, order, Y)
    return True


@compiled_fast
def apply_inverse(
    joints: Joints, condensed: Condensed, D: FloatArray, inverse: Inverse, x: FloatArray
) -> None:
    """`x := (1 + S (c K - R))^-1 x = x - Y (c K - R) x`, K of the tangents D that Y belongs to."""
    R, Y, g = condensed.R, inverse.Y, inverse.room
    for i in range(len(x)):
        g[i] = 0.0
        for j in range(len(R)):
            g[i] -= R[i, j] * x[j]
    add_stiffness_forces(joints, condensed.c, D, x, g)
    for i in range(len(x)):
        x[i] -= dot(Y[i], g)
