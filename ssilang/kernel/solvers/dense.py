"""Dense products and factors in compiled code: LU with row exchanges, one right side or many."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast

BLOCK = 32  # columns factorised together
WIDE = 96  # of large matrices: the rest is read as many times less
LARGE = 512  # rows of a large matrix


@apart
@compiled
def multiply(A: FloatArray, B: FloatArray, product: FloatArray) -> None:
    """Product A B by BLAS: the way there takes longer to compile than most of its callers."""
    np.dot(A, B, product)


@compiled_fast
def subtract_from(target: FloatArray, product: FloatArray, row: int, column: int) -> None:
    """Subtract a matrix from the part of another that starts at (row, column)."""
    for i in range(product.shape[0]):
        for j in range(product.shape[1]):
            target[row + i, column + j] -= product[i, j]


@compiled
def _part(A: FloatArray, i0: int, i1: int, j0: int, j1: int) -> FloatArray:
    """A copy of rows i0 to i1, columns j0 to j1."""
    part = np.empty((i1 - i0, j1 - j0))
    for i in range(i0, i1):
        for j in range(j0, j1):
            part[i - i0, j - j0] = A[i, j]
    return part


@compiled_fast
def _factorise_columns(A: FloatArray, k0: int, k1: int, top: float, pivots: IntArray) -> bool:
    """LU of the columns k0 to k1, rows exchanged as a whole; False if a pivot vanishes."""
    n = A.shape[0]
    for k in range(k0, k1):
        pivot = k
        for i in range(k + 1, n):
            if abs(A[i, k]) > abs(A[pivot, k]):
                pivot = i
        pivots[k] = pivot
        if abs(A[pivot, k]) <= 1e-15 * top:
            return False
        if pivot != k:
            for j in range(n):
                A[k, j], A[pivot, j] = A[pivot, j], A[k, j]
        inverse = 1.0 / A[k, k]
        for i in range(k + 1, n):
            factor = A[i, k] * inverse
            A[i, k] = factor
            if factor != 0.0:
                for j in range(k + 1, k1):
                    A[i, j] -= factor * A[k, j]
    return True


@apart
@compiled_fast
def factorise_dense(A: FloatArray, pivots: IntArray) -> bool:
    """LU with row exchanges in place, by blocks of columns; False if a pivot vanishes."""
    n, top = A.shape[0], 0.0
    width = BLOCK if n < LARGE else WIDE
    for i in range(n):
        for j in range(n):
            top = max(top, abs(A[i, j]))
    for k0 in range(0, n, width):
        k1 = min(k0 + width, n)
        if not _factorise_columns(A, k0, k1, top, pivots):
            return False
        if k1 < n:
            for k in range(k0, k1):
                for i in range(k + 1, k1):
                    for j in range(k1, n):
                        A[i, j] -= A[i, k] * A[k, j]
            product = np.empty((n - k1, n - k1))
            multiply(_part(A, k1, n, k0, k1), _part(A, k0, k1, k1, n), product)
            subtract_from(A, product, k1, k1)
    return True


@compiled_fast
def solve_factors(A: FloatArray, pivots: IntArray, b: FloatArray) -> None:
    """Solve with the factors of `factorise_dense`, in place."""
    n = A.shape[0]
    for k in range(n):
        p = pivots[k]
        if p != k:
            b[k], b[p] = b[p], b[k]
    for i in range(n):
        total = b[i]
        for j in range(i):
            total -= A[i, j] * b[j]
        b[i] = total
    for k in range(n - 1, -1, -1):
        total = b[k]
        for j in range(k + 1, n):
            total -= A[k, j] * b[j]
        b[k] = total / A[k, k]


@apart
@compiled_fast
def solve_factors_together(A: FloatArray, pivots: IntArray, X: FloatArray) -> None:
    """As `solve_factors` for the columns of X (n, k); the factors are read once."""
    n, count = X.shape
    for k in range(n):
        p = pivots[k]
        if p != k:
            for c in range(count):
                X[k, c], X[p, c] = X[p, c], X[k, c]
    for i in range(n):
        x = X[i]
        for j in range(i):
            value, y = A[i, j], X[j]
            for c in range(count):
                x[c] -= value * y[c]
    for i in range(n - 1, -1, -1):
        x = X[i]
        for j in range(i + 1, n):
            value, y = A[i, j], X[j]
            for c in range(count):
                x[c] -= value * y[c]
        inverse = 1.0 / A[i, i]
        for c in range(count):
            x[c] *= inverse
