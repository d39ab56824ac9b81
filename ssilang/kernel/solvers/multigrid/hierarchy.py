"""Smoothed aggregation: matrices of coarser and coarser levels, and the cycle through them.

The prolongation is smoothed once. Levels are smoothed by Chebyshev polynomials of the fourth kind
(Lottes 2022, arXiv:2202.08830), which need the largest eigenvalue alone and are the same in any
order of rows: threads change no number.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.solvers.multigrid.aggregation import aggregates_of, tentative
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
    relaxed,
    rest_of,
)

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

    @property
    def n_bytes(self) -> int:
        """Memory of all levels."""
        parts = [a for x in self.levels for r in (x.A, x.P) if r is not None for a in r]
        return sum(a.nbytes for a in parts if isinstance(a, np.ndarray))

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
    found: FloatArray = (vectors / np.maximum(values, least or 1.0)) @ vectors.T
    return found
