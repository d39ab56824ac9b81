"""Aggregates of nodes, and the motions that cost next to no energy on them.

Vanek, Mandel, Brezina (1996): a node and its neighbours become one node of the next coarser level,
whose unknowns are the amplitudes of these motions (the rigid ones) on the aggregate.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.solvers.multigrid.rows import Rows, empty_rows

WEAK = 0.02  # size of a coupling, of the geometric mean of both diagonals, below which it is none
ALONE = -1
LEFT = 1e-8  # of a motion, below which those before it say the same of an aggregate


def aggregates_of(A: Rows) -> tuple[IntArray, int]:
    """Aggregate of each group (n_groups,), ALONE where it couples with none, and their number."""
    n = len(A.first) - 1
    group = np.repeat(np.arange(n), np.diff(A.first))
    ptr, near = np.zeros(n + 1, np.int64), np.zeros(len(A.columns), np.int32)
    _strong_neighbours(A, group, WEAK**2, ptr, near)
    found = np.full(n, ALONE, np.int64)
    count = _aggregate(ptr, near, found)
    return found, count


@compiled
def _strong_neighbours(
    A: Rows, group: IntArray, weak: float, ptr: IntArray, near: NDArray[np.int32]
) -> None:
    """Groups that couple strongly with each, one after another, from ptr on."""
    n = len(A.first) - 1
    own = np.zeros(n)
    total = np.zeros(n)
    for g in range(n):
        own[g] = _coupling(A, g, A.first[g], A.first[g + 1])
    count = 0
    for g in range(n):
        begin, width = A.ptr[g], A.ptr[g + 1] - A.ptr[g]
        for k in range(width):
            j = group[A.columns[begin + k]]
            for r in range(A.first[g + 1] - A.first[g]):
                value = A.values[A.at[g] + r * width + k]
                total[j] += value * value
        for k in range(width):
            j = group[A.columns[begin + k]]
            if j != g and total[j] > weak * np.sqrt(own[g] * own[j]):
                near[count] = j
                count += 1
            total[j] = 0.0
        ptr[g + 1] = count


@compiled
def _coupling(A: Rows, g: int, low: int, high: int) -> float:
    """Sum of squares of the values of a group in columns low to high."""
    begin, width, total = A.ptr[g], A.ptr[g + 1] - A.ptr[g], 0.0
    for k in range(width):
        if low <= A.columns[begin + k] < high:
            for r in range(A.first[g + 1] - A.first[g]):
                value = A.values[A.at[g] + r * width + k]
                total += value * value
    return total


@compiled
def _aggregate(ptr: IntArray, near: NDArray[np.int32], found: IntArray) -> int:
    """Whole neighbourhoods first, then what is left joins one of them, then the rest."""
    n, count = len(found), 0
    for g in range(n):
        free = ptr[g + 1] > ptr[g] and found[g] < 0
        for k in range(ptr[g], ptr[g + 1]):
            free = free and found[near[k]] < 0
        if free:
            found[g] = count
            for k in range(ptr[g], ptr[g + 1]):
                found[near[k]] = count
            count += 1
    whole = count
    joined = np.full(n, -1, np.int64)
    for g in range(n):
        if found[g] < 0:
            for k in range(ptr[g], ptr[g + 1]):
                if 0 <= found[near[k]] < whole:
                    joined[g] = found[near[k]]
    for g in range(n):
        if joined[g] >= 0:
            found[g] = joined[g]
    for g in range(n):
        if found[g] < 0 and ptr[g + 1] > ptr[g]:
            found[g] = count
            for k in range(ptr[g], ptr[g + 1]):
                if found[near[k]] < 0:
                    found[near[k]] = count
            count += 1
    return count


def tentative(
    A: Rows, aggregates: IntArray, count: int, motions: FloatArray
) -> tuple[Rows, FloatArray]:
    """Orthonormal motions (n, m) of the aggregates, and `motions` (n, k) in them (m, k).

    Motions that others say already on a small aggregate are zero there.
    """
    k = motions.shape[1]
    ptr = np.concatenate([[0], np.cumsum(np.where(aggregates == ALONE, 0, k))]).astype(np.int64)
    P = empty_rows(A.first, ptr, A.values.dtype)
    own = aggregates[aggregates != ALONE]
    P.columns[:] = (own[:, None] * k + np.arange(k)).ravel()
    order = np.argsort(aggregates, kind="stable")[np.sum(aggregates == ALONE) :]
    starts = np.concatenate([[0], np.cumsum(np.bincount(own, minlength=count))]).astype(np.int64)
    coarse = np.zeros((count * k, k))
    _orthonormal(P, order, starts, np.ascontiguousarray(motions), coarse)
    return P, coarse


@compiled
def _orthonormal(
    P: Rows, order: IntArray, starts: IntArray, motions: FloatArray, coarse: FloatArray
) -> None:
    """Gram and Schmidt's method, twice, aggregate by aggregate."""
    width = motions.shape[1]
    for a in range(len(starts) - 1):
        size = 0
        for s in range(starts[a], starts[a + 1]):
            size += P.first[order[s] + 1] - P.first[order[s]]
        Q, at = np.empty((width, size)), 0
        for s in range(starts[a], starts[a + 1]):
            for i in range(P.first[order[s]], P.first[order[s] + 1]):
                for c in range(width):
                    Q[c, at] = motions[i, c]
                at += 1
        for c in range(width):
            before = _norm(Q[c])
            for _ in range(2):
                for e in range(c):
                    part = 0.0
                    for i in range(size):
                        part += Q[e, i] * Q[c, i]
                    for i in range(size):
                        Q[c, i] -= part * Q[e, i]
                    coarse[a * width + e, c] += part
            after = _norm(Q[c])
            if after <= LEFT * before:
                for i in range(size):
                    Q[c, i] = 0.0
                continue
            for i in range(size):
                Q[c, i] /= after
            coarse[a * width + c, c] = after
        at = 0
        for s in range(starts[a], starts[a + 1]):
            for i in range(P.first[order[s] + 1] - P.first[order[s]]):
                for c in range(width):
                    P.values[P.at[order[s]] + i * width + c] = Q[c, at]
                at += 1


@compiled
def _norm(x: FloatArray) -> float:
    total = 0.0
    for i in range(len(x)):
        total += x[i] * x[i]
    return float(np.sqrt(total))
