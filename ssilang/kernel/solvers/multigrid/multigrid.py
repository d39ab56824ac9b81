"""Krylov iterations with algebraic multigrid, where a factor would take too much memory or time.

Smoothed aggregation (Vanek, Mandel, Brezina 1996) needs the motions that cost next to no energy:
the rigid ones of the body, given at each unknown. The levels are of single precision, the iteration
of double; where single precision does not do, the levels are made again in double.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.factor import RESIDUAL
from ssilang.kernel.solvers.multigrid.hierarchy import Hierarchy, hierarchy_of
from ssilang.kernel.solvers.multigrid.rows import grouped, rest_of, rows_of

RESTART = 40  # vectors that are kept

Map = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, eq=False)
class Found:
    """What an iteration ends with: x (n,), turns, |b - A x|, whether that is small enough."""

    x: FloatArray
    turns: int
    residual: float
    converged: bool


def conjugate_gradients(
    multiply: Map, coarser: Map, b: FloatArray, enough: float, most: int
) -> Found:
    """Solve A x = b, A symmetric positive, until the norm of the residual is `enough`.

    `coarser` may differ a little from turn to turn (it is of single precision): directions are
    made orthogonal with the change of the residual (Notay 2000).
    """
    x, r = np.zeros_like(b), b.copy()
    size = float(np.linalg.norm(r))
    p, before, old = np.zeros_like(b), 1.0, r
    for turn in range(most + 1):
        if size <= enough:
            return Found(x, turn, size, True)
        if turn == most:
            break
        z = np.asarray(coarser(r), dtype=float)
        now = float(r @ z)
        p *= (now - float(old @ z)) / before if turn else 0.0
        p += z
        Ap = multiply(p)
        curve = float(p @ Ap)
        if not curve > 0.0 or not np.isfinite(curve):
            break  # no positive matrix
        step = float(p @ r) / curve
        x += step * p
        old = r
        r = r - step * Ap
        before, size = now, float(np.linalg.norm(r))
    return Found(x, turn, size, False)


def minimal_residuals(
    multiply: Map, coarser: Map, b: FloatArray, enough: float, most: int
) -> Found:
    """As `conjugate_gradients` for any A (Saad 1993, flexible GMRES), begun anew now and then."""
    x, r, turns = np.zeros_like(b), b.copy(), 0
    size = float(np.linalg.norm(r))
    while size > enough and turns < most:
        V, Z = [r / size], []
        H = np.zeros((RESTART + 1, RESTART))
        for k in range(RESTART):
            Z.append(np.asarray(coarser(V[k]), dtype=float))
            w = multiply(Z[k])
            for _ in range(2):  # Gram and Schmidt, twice
                for i in range(k + 1):
                    part = float(V[i] @ w)
                    H[i, k] += part
                    w -= part * V[i]
            H[k + 1, k] = np.linalg.norm(w)
            turns += 1
            wanted = np.zeros(k + 2)
            wanted[0] = size
            y = np.linalg.lstsq(H[: k + 2, : k + 1], wanted, rcond=None)[0]
            left = float(np.linalg.norm(wanted - H[: k + 2, : k + 1] @ y))
            if left <= 0.5 * enough or turns >= most or H[k + 1, k] <= 1e-15 * size:
                break
            V.append(w / H[k + 1, k])
        for z, part in zip(Z, y, strict=True):
            x += part * z
        r = b - multiply(x)
        before, size = size, float(np.linalg.norm(r))
        if not size < before:
            break  # it leads nowhere
    return Found(x, turns, size, size <= enough)


MOST_TURNS = 300
FEW_TURNS = 150  # within which it must converge where a factor could be had
FREE = 1e-13  # energy of a rigid motion (diagonal one) below which it is free: rounding errors
ALIKE = 1e-8  # singular value, of the largest, below which rigid motions say the same


class MultigridFactor:
    """A hierarchy of coarser matrices instead of a factor; symmetric positive matrices.

    Parameters
    ----------
    A : csr array (n, n)
    rigid : array (n, k) or None
        Rigid motions of the unknowns, in the unknowns of A; None for constant ones.
    nodes : array (n,) or None
        Node of each unknown, those of one node side by side.
    tolerance : float
        Norm of the residual, of that of the second member, at which an iteration ends.

    Raises
    ------
    KernelError
        If A is not taken for positive.
    """

    name = "multigrid"

    def __init__(
        self, A: sp.csr_array, positive: bool, rigid: FloatArray | None = None,
        nodes: IntArray | None = None, tolerance: float = RESIDUAL,
    ) -> None:  # fmt: skip
        if not positive:
            raise KernelError("kernel.solvers.multigrid-solves-symmetric-positive")
        if not (A.diagonal() > 0.0).all():
            raise SingularFactorError("a diagonal term is not positive")
        n = A.shape[0]
        starts = np.arange(n) if nodes is None else np.flatnonzero(np.diff(nodes, prepend=-1))
        self._first = np.append(starts, n).astype(np.int64)
        self._motions = np.ones((n, 1)) if rigid is None else _independent(rigid)
        self._matrix = A
        self.tolerance = tolerance
        self.turns = 0
        self.hierarchy = self._levels(np.float32)
        at = A.indptr.astype(np.int64)
        columns = A.indices.astype(np.int32, copy=False)
        self._rows = rows_of(np.arange(n + 1), at, columns, at, A.data)

    def _levels(self, kind: Any) -> Hierarchy:
        return hierarchy_of(grouped(self._matrix, self._first, kind), self._motions)

    def in_double(self) -> None:
        """Make the levels again in double precision."""
        self.hierarchy = self._levels(np.float64)

    def multiply(self, x: FloatArray) -> FloatArray:
        """`A x`."""
        return -rest_of(self._rows, x, np.zeros_like(x))

    def converges(self) -> bool:
        """Whether it does, for any second member."""
        b = np.random.default_rng(0).standard_normal(len(self._motions))
        size = float(np.linalg.norm(b))
        enough = self.tolerance * size
        return conjugate_gradients(
            self.multiply, self.hierarchy.cycle, b, enough, FEW_TURNS
        ).converged

    def free_motions(self) -> FloatArray:
        """Rigid motions (n, p) that meet no stiffness, orthonormal."""
        B = self._motions
        image = np.column_stack([self.multiply(np.ascontiguousarray(x)) for x in B.T])
        values, vectors = np.linalg.eigh(B.T @ image)
        return B @ vectors[:, values < FREE]

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b, b (n,) or (n, k).

        Raises
        ------
        KernelError
            If the iteration does not converge: a free motion, or a matrix that is not positive.
        """
        if b.ndim == 2:
            return np.column_stack([self.solve(column) for column in b.T])
        size = float(np.linalg.norm(b))
        found = self._solved(b, size)
        if not found.converged and self.hierarchy.levels[0].A.values.dtype != np.float64:
            self.in_double()
            found = self._solved(b, size)
        self.turns = found.turns
        if not found.converged:
            raise KernelError(
                "kernel.solvers.multigrid-did-not-converge", most_turns=found.turns,
                residual=found.residual / size, tolerance=self.tolerance,
            )  # fmt: skip
        return found.x

    def _solved(self, b: FloatArray, size: float) -> Found:
        return conjugate_gradients(
            self.multiply, self.hierarchy.cycle, b, self.tolerance * size, MOST_TURNS
        )


def _independent(rigid: FloatArray) -> FloatArray:
    """An orthonormal basis of the columns that say something of their own."""
    left, size, _ = np.linalg.svd(rigid, full_matrices=False)
    basis: FloatArray = left[:, size > ALIKE * size.max(initial=0.0)]
    return np.ascontiguousarray(basis)
