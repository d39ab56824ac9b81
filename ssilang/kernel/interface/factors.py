"""The interface iteration of `condensed`, that keeps its factors while the tangents stay equal.

Between changes of contact the tangents of successive turns and steps are the same numbers: the
matrix `1 + S (c K - R)` is then factorised once. The answer is that of `iterate_interface`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.copies import copy_rows
from ssilang.kernel.interface.inverse import UPDATES, apply_inverse, is_few, update_point
from ssilang.kernel.interface.newton import (
    ACCEPTED,
    HOLDING_TURN,
    MOST_TURNS,
    PLAIN_TURNS,
    TOLERANCE,
    hold_shear,
    largest,
    release_shear,
)
from ssilang.kernel.interface.response import interface_response, interface_stiffness
from ssilang.kernel.solvers.dense import (
    factorise_dense,
    solve_factors,
    solve_factors_together,
)

LARGE = 300  # jumps from which factors are changed rather than made again
MOST_CHANGED = 4  # one of so many jumps may have changed


class Workspace(NamedTuple):
    """Arrays of an iteration on q jumps, d a point.

    Attributes
    ----------
    new, D, f, h : results
        States (n_points, N_STATE), tangents (n_points, d, d), forces (q,) and `h` of
        `iterate_interface`.
    r, dy, delta, K, A
        Room (q,) and (q, q); A holds factors.
    known, pivots
        Tangents of these factors (NaN: none yet), and their row exchanges (q,).

    From `LARGE` jumps on, points whose tangents differ from the factors' change the answer and not
    the factors (Woodbury): the rows of K are then answers to forces on their jumps, and `pivots`
    (2 q + 1,) goes on with the row of each jump, see `_answers`.
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
    K, A = np.zeros((q, q)), np.zeros((q, q))
    pivots = np.full(q if q < LARGE else 2 * q + 1, -1, np.int64)
    known = np.full_like(tangents, np.nan)
    return Workspace(np.zeros_like(state), tangents, f, h, r, dy, delta, K, A, known, pivots)


@compiled
def _residual(
    S: FloatArray, R: FloatArray, c: float, y: FloatArray, y0: FloatArray, f: FloatArray,
    f0: FloatArray, h: FloatArray, r: FloatArray,
) -> float:  # fmt: skip
    """h = c (f - f0) - R y and r = y - y0 + S h; returns max |r|."""
    for i in range(len(y)):
        h[i] = c * (f[i] - f0[i])
    if len(R):
        Ry = np.dot(R, y)
        for i in range(len(y)):
            h[i] -= Ry[i]
    Sh = np.dot(S, h)
    size = 0.0
    for i in range(len(y)):
        r[i] = y[i] - y0[i] + Sh[i]
        size = max(size, abs(r[i]))
    return size


@compiled
def _same(D: FloatArray, known: FloatArray, first: int, last: int) -> bool:
    """Whether the tangents of the points first to last are those known."""
    for p in range(first, last):
        for i in range(D.shape[1]):
            for j in range(D.shape[2]):
                if D[p, i, j] != known[p, i, j]:
                    return False
    return True


@compiled
def _times_stiffness(S: FloatArray, K: FloatArray, A: FloatArray) -> None:
    """A = 1 + S K, K being dense or with few terms a row."""
    n, terms = len(S), 0
    for k in range(n):
        for j in range(n):
            if K[k, j] != 0.0:
                terms += 1
    if 4 * terms > n * n:
        np.dot(S, K, A)
    else:
        start, column, value = np.zeros(n + 1, np.int64), np.empty(terms, np.int64), np.empty(terms)
        terms = 0
        for k in range(n):
            for j in range(n):
                if K[k, j] != 0.0:
                    column[terms], value[terms] = j, K[k, j]
                    terms += 1
            start[k + 1] = terms
        for i in range(n):
            for j in range(n):
                A[i, j] = 0.0
            for k in range(n):
                for e in range(start[k], start[k + 1]):
                    A[i, column[e]] += S[i, k] * value[e]
    for i in range(n):
        A[i, i] += 1.0


@apart
@compiled
def _factorise(
    pairs: IntArray, B: FloatArray, weights: FloatArray, S: FloatArray, R: FloatArray, c: float,
    D: FloatArray, K: FloatArray, A: FloatArray, known: FloatArray, pivots: IntArray,
) -> bool:  # fmt: skip
    """Factors of `1 + S (c K - R)` in A."""
    n = len(S)
    interface_stiffness(pairs, B, weights, D, K)
    for i in range(n):
        for j in range(n):
            K[i, j] *= c
            if len(R):
                K[i, j] -= R[i, j]
    _times_stiffness(S, K, A)
    for i in range(n, len(pivots)):
        pivots[i] = -1
    good = factorise_dense(A, pivots)
    for i in range(D.shape[0]):
        for j in range(D.shape[1]):
            for k in range(D.shape[2]):
                known[i, j, k] = D[i, j, k] if good else np.nan
    return good


@compiled
def _changed(pairs: IntArray, D: FloatArray, known: FloatArray, n: int) -> tuple[IntArray, int]:
    """Place (n,) of each jump among those of points whose tangent changed, -1 elsewhere."""
    place, count, d = np.full(n, -1, np.int64), 0, D.shape[1]
    for p in range(D.shape[0]):
        if not _same(D, known, p, p + 1):
            for a in range(pairs.shape[1]):
                for i in range(d):
                    if place[pairs[p, a] * d + i] < 0:
                        place[pairs[p, a] * d + i] = count
                        count += 1
    return place, count


@compiled
def _stiffness_change(
    pairs: IntArray, B: FloatArray, weights: FloatArray, c: float, D: FloatArray, known: FloatArray,
    place: IntArray, count: int,
) -> FloatArray:  # fmt: skip
    """Change (count, count) of `c K` since the factors, on the changed jumps."""
    change, d, m = np.zeros((count, count)), D.shape[1], pairs.shape[1]
    for p in range(D.shape[0]):
        if _same(D, known, p, p + 1):
            continue
        for i in range(d):
            for j in range(d):
                value = c * weights[p] * (D[p, i, j] - known[p, i, j])
                if value != 0.0:
                    for a in range(m * d):
                        row = place[pairs[p, a // d] * d + a % d]
                        part = value * B[p, i, a]
                        for b in range(m * d):
                            change[row, place[pairs[p, b // d] * d + b % d]] += part * B[p, j, b]
    return change


@compiled
def _answers(
    S: FloatArray, place: IntArray, K: FloatArray, A: FloatArray, pivots: IntArray
) -> bool:
    """Rows `A^-1 S e_j` of K for the changed jumps j; False if there is no room left.

    `pivots[n + j]` is the row of jump j, -1 for none, `pivots[2 n]` one less than their number.
    """
    n, wanted = len(S), 0
    for j in range(n):
        if place[j] >= 0 and pivots[n + j] < 0:
            wanted += 1
    held = pivots[2 * n] + 1
    if held + wanted > n // MOST_CHANGED:
        return False
    if wanted == 0:
        return True
    X, fresh = np.empty((n, wanted)), 0
    for j in range(n):
        if place[j] >= 0 and pivots[n + j] < 0:
            for i in range(n):
                X[i, fresh] = S[i, j]
            pivots[n + j] = held + fresh
            fresh += 1
    solve_factors_together(A, pivots, X)
    for e in range(wanted):
        for i in range(n):
            K[held + e, i] = X[i, e]
    pivots[2 * n] = held + wanted - 1
    return True


@compiled
def _solve_changed(
    place: IntArray, change: FloatArray, K: FloatArray, pivots: IntArray, x: FloatArray
) -> bool:
    """x = (A + S E change E^T)^-1 A x, from `x - Z (1 + change E^T Z)^-1 change E^T x`."""
    n, count = len(x), len(change)
    jumps = np.empty(count, np.int64)
    for j in range(n):
        if place[j] >= 0:
            jumps[place[j]] = j
    right, own = np.empty(count), np.empty((count, count))
    for a in range(count):
        right[a] = x[jumps[a]]
        for b in range(count):
            own[a, b] = K[pivots[n + jumps[b]], jumps[a]]
    small = np.dot(change, own)
    right = np.dot(change, right)
    for a in range(count):
        small[a, a] += 1.0
    order = np.empty(count, np.int64)
    if not factorise_dense(small, order):
        return False
    solve_factors(small, order, right)
    for a in range(count):
        row = pivots[n + jumps[a]]
        for i in range(n):
            x[i] -= right[a] * K[row, i]
    return True


@apart
@compiled
def _changed_step(
    pairs: IntArray, B: FloatArray, weights: FloatArray, S: FloatArray, c: float, D: FloatArray,
    K: FloatArray, A: FloatArray, known: FloatArray, pivots: IntArray, x: FloatArray,
) -> int:  # fmt: skip
    """`_newton_step` by changed factors: 1 if done, 0 without answer, -1 if too much changed."""
    n = len(x)
    place, count = _changed(pairs, D, known, n)
    if count > n // MOST_CHANGED or not _answers(S, place, K, A, pivots):
        return -1
    change = _stiffness_change(pairs, B, weights, c, D, known, place, count)
    solve_factors(A, pivots, x)
    return 1 if _solve_changed(place, change, K, pivots, x) else 0


@apart
@compiled
def _kept_answer(
    pairs: IntArray, B: FloatArray, weights: FloatArray, S: FloatArray, R: FloatArray, c: float,
    D: FloatArray, K: FloatArray, Y: FloatArray, known: FloatArray, pivots: IntArray,
) -> bool:  # fmt: skip
    """`Y = (1 + S (c K - R))^-1 S` of the tangents D, see `updated`; False if there is none."""
    n, d, changed = len(S), D.shape[1], 0
    for p in range(D.shape[0]):
        if not _same(D, known, p, p + 1):
            changed += 1
    if changed == 0:
        return True
    if known[0, 0, 0] == known[0, 0, 0] and 3 * d * changed <= 2 * n:
        room, good = np.empty((2, d, n)), pivots[0] + changed <= UPDATES
        for p in range(D.shape[0]):
            if good and not _same(D, known, p, p + 1):
                good = update_point(pairs[p], B[p], c * weights[p], D[p], known[p], Y, room)
                if good:
                    pivots[0] += 1
                    copy_rows(D[p], known[p])
        if good:
            return True
    factors = np.empty((n, n))
    if not _factorise(pairs, B, weights, S, R, c, D, K, factors, known, pivots):
        return False
    copy_rows(S, Y)
    solve_factors_together(factors, pivots, Y)
    pivots[0] = 0
    return True


@compiled
def solve_known(
    pairs: IntArray, B: FloatArray, weights: FloatArray, R: FloatArray, c: float, A: FloatArray,
    known: FloatArray, pivots: IntArray, room: FloatArray, x: FloatArray,
) -> None:  # fmt: skip
    """x = (1 + S (c K - R))^-1 x, K of the tangents `known`; `room` is (q,)."""
    if is_few(len(x)):
        apply_inverse(pairs, B, weights, known, R, c, A, room, x)
    else:
        solve_factors(A, pivots, x)


@apart
@compiled
def _newton_step(
    pairs: IntArray, B: FloatArray, weights: FloatArray, S: FloatArray, R: FloatArray, c: float,
    D: FloatArray, K: FloatArray, A: FloatArray, known: FloatArray, pivots: IntArray,
    x: FloatArray,
) -> bool:  # fmt: skip
    """x = (1 + S (c K - R))^-1 x by the factors at hand, changed ones, or new ones.

    Few jumps keep `(1 + S (c K - R))^-1 S` in A instead.
    """
    n = len(x)
    if is_few(n):
        room = np.empty(n)
        if not _kept_answer(pairs, B, weights, S, R, c, D, K, A, known, pivots):
            return False
        solve_known(pairs, B, weights, R, c, A, known, pivots, room, x)
        return True
    same = _same(D, known, n - n, len(D))
    if not same and len(pivots) > n and known[0, 0, 0] == known[0, 0, 0]:
        solved = _changed_step(pairs, B, weights, S, c, D, K, A, known, pivots, x)
        if solved >= 0:
            return solved > 0
    if not same and not _factorise(pairs, B, weights, S, R, c, D, K, A, known, pivots):
        return False
    solve_factors(A, pivots, x)
    return True


@apart
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

    `known` filled with NaN says that there are no factors yet; an R without rows is zero. See
    `Workspace` for longer `pivots`.
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
        for i in range(n):
            dy[i] = -r[i]
        if not _newton_step(pairs, B, weights, S, R, c, D, K, A, known, pivots, dy):
            release_shear(state, new)
            return 0, size / scale
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
