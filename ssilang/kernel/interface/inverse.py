"""The condensed interface of few jumps: `Y = (1 + S (c K - R))^-1 S`, kept while points change.

K is the stiffness of the tangents `known`. A point whose tangent changes by dD changes K by
`w B^T dD B`, of the rank of dD at most, and Y by

    Y - Y B^T (1 + M N)^-1 M B Y ,   M = c w dD ,   N = B Y B^T

which costs two products of q^2 numbers for each row of dD, where new factors cost q^3. Newton's
direction is `-(1 + S (c K - R))^-1 r = Y (c K - R) r - r`.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.interface.copies import clear

FEW = 160  # jumps up to which Y is kept
UPDATES = 64  # between two times that Y is made anew: rounding does not grow
VANISHING = 1e-10  # of the largest number of `1 + M N`: a pivot from which Y is made anew


@compiled_fast
def is_few(q: int) -> bool:
    """Whether an interface of q jumps keeps Y."""
    return q <= FEW


@compiled_fast
def _rows_of(pairs: IntArray, B: FloatArray, Y: FloatArray, rows: FloatArray) -> None:
    """rows (d, q) = B Y of one point."""
    d = len(B)
    clear(rows)
    for a in range(d):
        row = rows[a]
        for pair in range(len(pairs)):
            for j in range(d):
                value = B[a, pair * d + j]
                if value != 0.0:
                    line = Y[pairs[pair] * d + j]
                    for k in range(len(line)):
                        row[k] += value * line[k]


@compiled_fast
def _columns_of(pairs: IntArray, B: FloatArray, Y: FloatArray, columns: FloatArray) -> None:
    """columns (d, q) = (Y B^T)^T of one point."""
    d = len(B)
    clear(columns)
    for a in range(d):
        column = columns[a]
        for pair in range(len(pairs)):
            for j in range(d):
                value, at = B[a, pair * d + j], pairs[pair] * d + j
                if value != 0.0:
                    for k in range(len(column)):
                        column[k] += value * Y[k, at]


@compiled_fast
def _solve_small(A: FloatArray, X: FloatArray) -> bool:
    """A X = X in place, by elimination with row exchanges; False if a pivot nearly vanishes."""
    n, top = len(A), 1.0
    for i in range(n):
        for j in range(n):
            top = max(top, abs(A[i, j]))
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(A[i, k]) > abs(A[pivot, k]):
                pivot = i
        if not abs(A[pivot, k]) > VANISHING * top:
            return False
        for j in range(n):
            A[k, j], A[pivot, j] = A[pivot, j], A[k, j]
            X[k, j], X[pivot, j] = X[pivot, j], X[k, j]
        for i in range(n):
            if i != k:
                factor = A[i, k] / A[k, k]
                for j in range(n):
                    A[i, j] -= factor * A[k, j]
                    X[i, j] -= factor * X[k, j]
    for i in range(n):
        for j in range(n):
            X[i, j] /= A[i, i]
    return True


@compiled_fast
def update_point(
    pairs: IntArray, B: FloatArray, weight: float, D: FloatArray, known: FloatArray, Y: FloatArray,
    room: FloatArray,
) -> bool:  # fmt: skip
    """Y after the tangent of a point went from `known` to D; `weight` holds c.

    `room` is (2, d, q). False, and Y as it was, if the update is not safe.
    """
    d, rows, columns = len(B), room[0], room[1]
    E, T = np.zeros((d, d)), np.zeros((d, d))
    for i in range(d):
        for j in range(d):
            E[i, j] = weight * (D[i, j] - known[i, j])
    _rows_of(pairs, B, Y, rows)
    _columns_of(pairs, B, Y, columns)
    for i in range(d):
        for j in range(d):
            T[i, j] = 1.0 if i == j else 0.0
            for k in range(d):  # M (B Y) B^T
                product = 0.0
                for pair in range(len(pairs)):
                    for at in range(d):
                        product += rows[k, pairs[pair] * d + at] * B[j, pair * d + at]
                T[i, j] += E[i, k] * product
    if not _solve_small(T, E):
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


@compiled_fast
def apply_inverse(
    pairs: IntArray, B: FloatArray, weights: FloatArray, D: FloatArray, R: FloatArray, c: float,
    Y: FloatArray, g: FloatArray, x: FloatArray,
) -> None:  # fmt: skip
    """`x := (1 + S (c K - R))^-1 x = x - Y (c K - R) x`, K of the tangents D; g is room (q,)."""
    n, d, _ = B.shape
    for i in range(len(x)):
        g[i] = 0.0
        for j in range(len(R)):
            g[i] -= R[i, j] * x[j]
    for p in range(n):
        for i in range(d):
            force = 0.0
            for k in range(d):
                if D[p, i, k] != 0.0:
                    jump = 0.0
                    for pair in range(pairs.shape[1]):
                        for j in range(d):
                            jump += B[p, k, pair * d + j] * x[pairs[p, pair] * d + j]
                    force += D[p, i, k] * jump
            if force != 0.0:
                force *= c * weights[p]
                for pair in range(pairs.shape[1]):
                    for j in range(d):
                        g[pairs[p, pair] * d + j] += force * B[p, i, pair * d + j]
    for i in range(len(x)):
        total, row = 0.0, Y[i]
        for j in range(len(g)):
            total += row[j] * g[j]
        x[i] -= total
