"""Dense products and factors in compiled code: LU with row exchanges, one right side or many."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast

BLOCK = 32  # columns factorised together
WIDE = 96  # of large matrices: the rest is read as many times less
LARGE = 512  # rows of a large matrix
ROWS = 64  # rows that are brought up to date together


@apart
@compiled
def multiply(A: FloatArray, B: FloatArray, product: FloatArray) -> None:
    """Product A B by BLAS: the way there takes longer to compile than most of its callers."""
    np.dot(A, B, product)


@compiled_fast
def subtract_from(target: FloatArray, product: FloatArray, row: int, column: int) -> None:
    """Subtract a matrix from the part of another that starts at (row, column)."""
    for i in range(product.shape[0]):
        to, by = target[row + i, column:], product[i]
        for j in range(len(by)):
            to[j] -= by[j]


@compiled_fast
def _subtract_product(
    A: FloatArray, i0: int, i1: int, j0: int, j1: int, right: FloatArray, X: FloatArray, column: int
) -> None:
    """Rows i0 to i1 of X, from a column on, less those of A, columns j0 to j1, times `right`."""
    part = A[i0:i1, j0:j1].copy()
    product = np.empty((i1 - i0, right.shape[1]), A.dtype)
    multiply(part, right, product)
    subtract_from(X, product, i0, column)


@compiled_fast
def _exchange(X: FloatArray, i: int, j: int) -> None:
    """Exchange two rows."""
    if i != j:
        for c in range(X.shape[1]):
            X[i, c], X[j, c] = X[j, c], X[i, c]


@compiled_fast
def _factorise_columns(P: FloatArray, top: float, exchanges: IntArray) -> bool:
    """LU of some columns, the rows of P, with exchanges of rows; False if a pivot vanishes."""
    width, n = P.shape
    for k in range(width):
        column, pivot = P[k], k
        for i in range(k + 1, n):
            if abs(column[i]) > abs(column[pivot]):
                pivot = i
        exchanges[k] = pivot
        if abs(column[pivot]) <= 1e-15 * top:
            return False
        if pivot != k:
            for j in range(width):
                P[j, k], P[j, pivot] = P[j, pivot], P[j, k]
        below, largest = column[k + 1 :], column[k]
        for i in range(n - k - 1):
            below[i] /= largest
        for j in range(k + 1, width):
            other, factor = P[j, k + 1 :], P[j, k]
            for i in range(n - k - 1):
                other[i] -= factor * below[i]
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
        P = A[k0:, k0:k1].T.copy()
        if not _factorise_columns(P, top, pivots[k0:k1]):
            return False
        for k in range(k0, k1):
            pivots[k] += k0
            _exchange(A, k, pivots[k])
        for i in range(k0, n):
            for j in range(k0, k1):
                A[i, j] = P[j - k0, i - k0]
        # the rows of the block, then what is below them, some rows at a time: they stay near
        for i in range(k0 + 1, k1):
            row = A[i, k1:]
            for k in range(k0, i):
                factor, above = A[i, k], A[k, k1:]
                for j in range(n - k1):
                    row[j] -= factor * above[j]
        right = A[k0:k1, k1:].copy()
        for i0 in range(k1, n, ROWS):
            _subtract_product(A, i0, min(i0 + ROWS, n), k0, k1, right, A, k1)
    return True


@apart
@compiled_fast
def solve_factors_together(A: FloatArray, pivots: IntArray, X: FloatArray) -> None:
    """Solve with the factors of `factorise_dense` for the columns of X (n, k), in place."""
    n, count = X.shape
    for k in range(n):
        _exchange(X, k, pivots[k])
    for i0 in range(0, n, BLOCK):
        i1 = min(i0 + BLOCK, n)
        _subtract_product(A, i0, i1, 0, i0, X[:i0], X, 0)
        for i in range(i0, i1):
            x = X[i]
            for j in range(i0, i):
                value, y = A[i, j], X[j]
                for c in range(count):
                    x[c] -= value * y[c]
    for i0 in range((n - 1) // BLOCK * BLOCK, -1, -BLOCK):
        i1 = min(i0 + BLOCK, n)
        _subtract_product(A, i0, i1, i1, n, X[i1:], X, 0)
        for i in range(i1 - 1, i0 - 1, -1):
            x, pivot = X[i], A[i, i]
            for j in range(i + 1, i1):
                value, y = A[i, j], X[j]
                for c in range(count):
                    x[c] -= value * y[c]
            for c in range(count):
                x[c] /= pivot
