"""Conditions of a time-stepping problem, eliminated: `u = T q + particular(d)`."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ssilang.kernel.errors import KernelError
from ssilang.kernel.matrices.assembly import ConstraintRows
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.solvers.elimination import eliminate
from ssilang.kernel.sparse import sp


class Constraints(Protocol):
    """Equality conditions `C u = d` with the motions that they leave."""

    C: sp.csr_array
    T: sp.csr_array

    def particular(self, d: FloatArray) -> FloatArray:
        """A displacement (n,) with `C u = d`."""
        ...

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """lambda (n_rows,) with `C^T lambda = residual` (n,)."""
        ...


class EliminatedConstraints:
    """Sparse elimination, for systems of any size."""

    def __init__(self, C: sp.csr_array) -> None:
        self.C = C
        self._elimination = eliminate(C)
        if not self._elimination.eliminated.all():
            raise KernelError(
                "a relation with too many unknowns cannot be eliminated from a time-stepping "
                "problem",
                "split it, or write it on fewer unknowns",
            )
        self.T = self._elimination.T

    def particular(self, d: FloatArray) -> FloatArray:
        """A displacement (n,) with `C u = d`."""
        return self._elimination.particular(d)

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """lambda (n_rows,) with `C^T lambda = residual`."""
        return self._elimination.multipliers(residual)


class OrthogonalConstraints:
    """Dense orthogonal elimination, for small systems; redundant rows share their multipliers."""

    def __init__(self, C: sp.csr_array) -> None:
        import scipy.linalg as la

        self.C = C
        dense = C.toarray()
        n = dense.shape[1]
        fixed = np.flatnonzero((dense != 0).any(axis=0))
        basis = la.null_space(dense[:, fixed]) if len(fixed) and len(dense) else np.eye(len(fixed))
        free = np.setdiff1d(np.arange(n), fixed)
        T = np.zeros((n, len(free) + basis.shape[1]))
        T[free, np.arange(len(free))] = 1.0
        T[np.ix_(fixed, np.arange(len(free), T.shape[1]))] = basis
        self.T = sp.csr_array(T)
        self._inverse = la.pinv(dense) if dense.size else np.zeros((n, len(dense)))

    def particular(self, d: FloatArray) -> FloatArray:
        """A displacement (n,) with `C u = d`."""
        found: FloatArray = self._inverse @ d
        return found

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """lambda (n_rows,) with `C^T lambda = residual`, of least norm."""
        found: FloatArray = self._inverse.T @ residual
        return found


def constraints_of(rows: ConstraintRows, small: bool) -> Constraints:
    """Eliminated equality conditions.

    Raises
    ------
    KernelError
        For non-associated relations.
    """
    if not rows.associated:
        raise KernelError("non-associated relations are not solved in time-stepping problems")
    return OrthogonalConstraints(rows.C) if small else EliminatedConstraints(rows.C)


def check_values(constraints: Constraints, imposed: FloatArray) -> None:
    """Refuse imposed values (n_rows, k) that redundant conditions contradict.

    Raises
    ------
    KernelError
        Naming the first such row.
    """
    for d in imposed.T:
        gap = np.abs(constraints.C @ constraints.particular(d) - d)
        wrong = np.flatnonzero(gap > 1e-9 * np.abs(d).max(initial=0.0))
        if len(wrong):
            raise KernelError(
                f"condition {wrong[0] + 1} contradicts others: its imposed value cannot be met"
            )
