"""Smoothed aggregation: matrices of coarser and coarser levels, and the cycle through them.

The prolongation is smoothed once. Levels are smoothed by Chebyshev polynomials of the fourth kind
(Lottes 2022, arXiv:2202.08830), which need the largest eigenvalue alone and are the same in any
order of rows: threads change no number.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.solvers.multigrid.products import (
    Backwards,
    galerkin,
    product,
    restricted,
    smoothed,
)
from ssilang.kernel.solvers.multigrid.rows import (
    Diagonal,
    Real,
    Rows,
    diagonal_of,
    divided,
    empty_rows,
    relaxed,
    rest_of,
)

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


COARSEST = 800  # unknowns of the level that is solved by a dense inverse
SHRINKS = 0.7  # share of the unknowns above which a coarser level is not worth it
DEGREE = 2  # of the smoothing polynomial: products before and after the coarser level
TURNS = 12  # of the power method
MARGIN = 1.15  # largest eigenvalue over what these turns find
LAST = 8  # smoothing steps on a level that is too large for an inverse and has no coarser one


@dataclass(frozen=True, eq=False)
class Level:
    """A matrix and what leads to the next coarser one (none on the last)."""

    A: Rows
    D: Diagonal
    largest: float
    P: Rows | None = None
    back: Backwards | None = None
    k: int = 1


@dataclass(frozen=True, eq=False)
class Hierarchy:
    """Levels from fine to coarse; the inverse of the last one if it is small enough."""

    levels: tuple[Level, ...]
    inverse: FloatArray | None

    def cycle(self, b: Real) -> Real:
        """An approximate solution of A x = b: a symmetric positive map of b, one V-cycle."""
        return self._cycle(0, b.astype(self.levels[0].A.values.dtype))

    def _cycle(self, depth: int, b: Real) -> Real:
        level = self.levels[depth]
        if depth + 1 == len(self.levels):
            if self.inverse is not None:
                return (self.inverse @ b).astype(b.dtype)
            return _polynomial(level, None, b, LAST)
        assert level.P is not None
        assert level.back is not None
        x = _polynomial(level, None, b, DEGREE)
        rest = restricted(level.P, level.back, rest_of(level.A, x, b), level.k)
        x = rest_of(level.P, -self._cycle(depth + 1, rest), x)
        return _polynomial(level, x, b, DEGREE)


def _polynomial(level: Level, x: Real | None, b: Real, degree: int) -> Real:
    """Smoothing steps from x (None: zero)."""
    A, D, largest = level.A, level.D, level.largest
    first = 4.0 / (3.0 * largest)
    if x is None:
        d = divided(A, D, b, first)
        x = d.copy()
    else:
        d = np.zeros_like(b)
        x = relaxed(A, D, x, b, d, 0.0, first)
    for k in range(1, degree):
        x = relaxed(A, D, x, b, d, (2 * k - 1) / (2 * k + 3), (8 * k + 4) / ((2 * k + 3) * largest))
    return x


def hierarchy_of(A: Rows, motions: FloatArray) -> Hierarchy:
    """Levels of a symmetric positive A (n, n) whose cheap motions are `motions` (n, k)."""
    levels: list[Level] = []
    while True:
        D = diagonal_of(A)
        largest = _largest_eigenvalue(A, D)
        n = int(A.first[-1])
        if n <= COARSEST:
            levels.append(Level(A, D, largest))
            return Hierarchy(tuple(levels), _inverse(A))
        aggregates, count = aggregates_of(A)
        k = motions.shape[1]
        if count == 0 or count * k > SHRINKS * n:
            levels.append(Level(A, D, largest))
            return Hierarchy(tuple(levels), None)
        start, motions = tentative(A, aggregates, count, motions)
        P = smoothed(A, D, start, k, count, 4.0 / (3.0 * largest))
        back = Backwards(P, k, count)
        levels.append(Level(A, D, largest, P, back, k))
        A = galerkin(P, back, product(A, P, k, count), k)


def _largest_eigenvalue(A: Rows, D: Diagonal) -> float:
    """Of `D^-1 A`, a little more rather than less."""
    n = int(A.first[-1])
    kind: Any = A.values.dtype
    x = np.random.default_rng(0).standard_normal(n).astype(kind)
    none, size = np.zeros(n, kind), 1.0
    for _ in range(TURNS):
        x /= np.linalg.norm(x) or 1.0
        x = divided(A, D, rest_of(A, x, none))
        size = float(np.linalg.norm(x))
    return MARGIN * (size or 1.0)


def _inverse(A: Rows) -> FloatArray:
    """Dense inverse; motions that meet less than rounding leave are held by that."""
    n = int(A.first[-1])
    dense = np.zeros((n, n))
    for g in range(len(A.first) - 1):
        rows = slice(int(A.first[g]), int(A.first[g + 1]))
        own = A.values[A.at[g] : A.at[g + 1]].reshape(rows.stop - rows.start, -1)
        dense[rows, A.columns[A.ptr[g] : A.ptr[g + 1]]] = own
    dense = 0.5 * (dense + dense.T)
    values, vectors = np.linalg.eigh(dense)
    least = 8.0 * np.finfo(A.values.dtype).eps * values.max(initial=0.0)
    return (vectors / np.maximum(values, least or 1.0)) @ vectors.T
