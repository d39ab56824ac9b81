"""The interface iteration of `condensed`, that keeps its factors while the tangents stay equal.

Between changes of contact the tangents of successive turns and steps are the same numbers: the
matrix `1 + S (c K - R)` is then factorised once. The answer is that of `solve_interface`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.compiled import compiled, compiled_fast
from ssilang.kernel.joints.condensed import (
    ACCEPTED,
    HOLDING_TURN,
    MOST_TURNS,
    PLAIN_TURNS,
    TOLERANCE,
    hold_shear,
    largest,
    release_shear,
)
from ssilang.kernel.joints.response import interface_response, interface_stiffness
from ssilang.kernel.mesh.nodes import FloatArray, IntArray

BLOCK = 32  # columns factorised together


class Workspace(NamedTuple):
    """Arrays of an iteration on q jumps, d a point.

    Attributes
    ----------
    new, D, f, h : results
        States (n_points, N_STATE), tangents (n_points, d, d), forces (q,) and `h` of
        `solve_interface`.
    r, dy, delta, K, A
        Room (q,) and (q, q); A holds factors.
    known, pivots
        Tangents of these factors (NaN: none yet), and their row exchanges.
    """

    new: FloatArray
    D: FloatArray
    f: FloatArray
    h: FloatArray
    r: FloatArray
    dy: FloatArray
    delta: FloatArray
    K: FloatArray
    A: FloatArray
    known: FloatArray
    pivots: IntArray


def workspace(q: int, w: FloatArray, state: FloatArray) -> Workspace:
    """Room for q jumps, local jumps w (n_points, d), states (n_points, N_STATE); no factors."""
    tangents = np.zeros((*w.shape, w.shape[1]))
    f, h, r, dy, delta = (np.zeros(q) for _ in range(5))
    K, A, pivots = np.zeros((q, q)), np.zeros((q, q)), np.zeros(q, np.int64)
    known = np.full_like(tangents, np.nan)
    return Workspace(np.zeros_like(state), tangents, f, h, r, dy, delta, K, A, known, pivots)


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


@compiled_fast
def factorise_dense(A: FloatArray, pivots: IntArray) -> bool:
    """LU with row exchanges in place, by blocks of columns; False if a pivot vanishes."""
    n, top = A.shape[0], 0.0
    for i in range(n):
        for j in range(n):
            top = max(top, abs(A[i, j]))
    for k0 in range(0, n, BLOCK):
        k1 = min(k0 + BLOCK, n)
        if not _factorise_columns(A, k0, k1, top, pivots):
            return False
        if k1 < n:
            for k in range(k0, k1):
                for i in range(k + 1, k1):
                    for j in range(k1, n):
                        A[i, j] -= A[i, k] * A[k, j]
            left = np.ascontiguousarray(A[k1:, k0:k1])
            A[k1:, k1:] -= np.dot(left, np.ascontiguousarray(A[k0:k1, k1:]))
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


@compiled
def _residual(
    S: FloatArray, R: FloatArray, c: float, y: FloatArray, y0: FloatArray, f: FloatArray,
    f0: FloatArray, h: FloatArray, r: FloatArray,
) -> float:  # fmt: skip
    """h = c (f - f0) - R y and r = y - y0 + S h; returns max |r|."""
    for i in range(len(y)):
        h[i] = c * (f[i] - f0[i])
    if len(R):
        h -= np.dot(R, y)
    Sh = np.dot(S, h)
    size = 0.0
    for i in range(len(y)):
        r[i] = y[i] - y0[i] + Sh[i]
        size = max(size, abs(r[i]))
    return size


@compiled
def _same(D: FloatArray, known: FloatArray) -> bool:
    a, b = D.ravel(), known.ravel()
    for i in range(len(a)):  # noqa: SIM110
        if a[i] != b[i]:
            return False
    return True


@compiled
def _factorise(
    pairs: IntArray, B: FloatArray, weights: FloatArray, S: FloatArray, R: FloatArray, c: float,
    D: FloatArray, K: FloatArray, A: FloatArray, known: FloatArray, pivots: IntArray,
) -> bool:  # fmt: skip
    """Factors of `1 + S (c K - R)` in A, unless those of the same tangents D are there."""
    if _same(D, known):
        return True
    interface_stiffness(pairs, B, weights, D, K)
    for i in range(len(S)):
        for j in range(len(S)):
            K[i, j] *= c
    if len(R):
        K -= R
    A[:, :] = np.dot(S, K)
    for i in range(len(S)):
        A[i, i] += 1.0
    if factorise_dense(A, pivots):
        known[:] = D
        return True
    known[:] = np.nan
    return False


@compiled
def iterate_cached(
    pairs: IntArray,
    B: FloatArray,
    weights: FloatArray,
    codes: IntArray,
    p: FloatArray,
    S: FloatArray,
    R: FloatArray,
    c: float,
    delta0: FloatArray,
    f0: FloatArray,
    state: FloatArray,
    y0: FloatArray,
    y: FloatArray,
    w: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    f: FloatArray,
    h: FloatArray,
    r: FloatArray,
    dy: FloatArray,
    delta: FloatArray,
    K: FloatArray,
    A: FloatArray,
    known: FloatArray,
    pivots: IntArray,
) -> tuple[int, float]:
    """As `iterate_interface`; `known` (as D) and `pivots` belong to the factors in A.

    `known` filled with NaN says that there are no factors yet; an R without rows is zero.
    """
    n = y.shape[0]
    for i in range(n):
        delta[i] = delta0[i] + y[i]
    interface_response(pairs, B, weights, codes, p, delta, state, w, t, new, D, f)
    size = _residual(S, R, c, y, y0, f, f0, h, r)
    scale = max(largest(y0), largest(delta0), 1e-300)
    for turn in range(1, MOST_TURNS + 1):
        scale = max(scale, largest(y))
        if turn == HOLDING_TURN:
            interface_response(pairs, B, weights, codes, p, delta0, state, w, t, new, D, f)
            if hold_shear(codes, p, t, state):
                for i in range(n):
                    y[i] = y0[i]
                    delta[i] = delta0[i] + y[i]
            interface_response(pairs, B, weights, codes, p, delta, state, w, t, new, D, f)
            size = _residual(S, R, c, y, y0, f, f0, h, r)
        if size <= TOLERANCE * scale:
            release_shear(state, new)
            return turn, size / scale
        if not _factorise(pairs, B, weights, S, R, c, D, K, A, known, pivots):
            release_shear(state, new)
            return 0, size / scale
        for i in range(n):
            dy[i] = -r[i]
        solve_factors(A, pivots, dy)
        before, length = size, 1.0
        for halving in range(12):
            for i in range(n):
                y[i] += length * dy[i]
                delta[i] = delta0[i] + y[i]
            interface_response(pairs, B, weights, codes, p, delta, state, w, t, new, D, f)
            size = _residual(S, R, c, y, y0, f, f0, h, r)
            if turn <= PLAIN_TURNS or size < before or halving == 11:
                break
            for i in range(n):
                y[i] -= length * dy[i]
            length *= 0.5
        if length * largest(dy) <= 1e-14 * scale and size <= ACCEPTED * scale:
            release_shear(state, new)
            return turn, size / scale
    release_shear(state, new)
    return -MOST_TURNS, size / scale
