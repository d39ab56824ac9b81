"""Conditions of a time-stepping problem, eliminated: `u = T q + particular(d)`.

Non-associated relations (RELA ... 'DUAL') push by `D^T lambda` with rows D that are not C:
equilibrium then holds on the motions V that D leaves, `V^T (K u - F) = 0`.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.matrices.assembly import ConstraintRows, Numbering
from ssilang.kernel.solvers.cholesky.elimination import eliminate


class Constraints(Protocol):
    """Equality conditions `C u = d` with the motions that they leave.

    Attributes
    ----------
    C, D : csr arrays (n_rows, n)
        Conditions, and the forces of their multipliers; the same but for non-associated ones.
    T, V : csr arrays (n, r)
        Motions that C leaves, and motions on which equilibrium is written.
    """

    C: sp.csr_array
    D: sp.csr_array
    T: sp.csr_array
    V: sp.csr_array
    associated: bool

    def particular(self, d: FloatArray) -> FloatArray:
        """A displacement (n,) with `C u = d`."""
        ...

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """lambda (n_rows,) with `D^T lambda = residual` (n,)."""
        ...

    def pushers(self, rows: IntArray) -> FloatArray:
        """Columns (n, m) whose products with a residual are some of its multipliers."""
        ...


class EliminatedConstraints:
    """Sparse elimination, for systems of any size."""

    def __init__(self, C: sp.csr_array) -> None:
        self.C = self.D = C
        self._elimination = eliminate(C)
        if not self._elimination.eliminated.all():
            raise KernelError("kernel.stepping.relation-too-many-unknowns")
        self.T = self.V = self._elimination.T
        self.associated = True

    def particular(self, d: FloatArray) -> FloatArray:
        """A displacement (n,) with `C u = d`."""
        return self._elimination.particular(d)

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """lambda (n_rows,) with `C^T lambda = residual`."""
        return self._elimination.multipliers(residual)

    def pushers(self, rows: IntArray) -> FloatArray:
        """Columns (n, m): multipliers are the transpose of particular motions."""
        return _particulars(self, rows)


class OrthogonalConstraints:
    """Dense orthogonal elimination, for small systems; redundant rows share their multipliers."""

    def __init__(self, C: sp.csr_array) -> None:
        import scipy.linalg as la

        self.C = self.D = C
        dense = C.toarray()
        n = dense.shape[1]
        fixed = np.flatnonzero((dense != 0).any(axis=0))
        basis = la.null_space(dense[:, fixed]) if len(fixed) and len(dense) else np.eye(len(fixed))
        free = np.setdiff1d(np.arange(n), fixed)
        T = np.zeros((n, len(free) + basis.shape[1]))
        T[free, np.arange(len(free))] = 1.0
        T[np.ix_(fixed, np.arange(len(free), T.shape[1]))] = basis
        self.T = self.V = sp.csr_array(T)
        self.associated = True
        self._inverse = la.pinv(dense) if dense.size else np.zeros((n, len(dense)))

    def particular(self, d: FloatArray) -> FloatArray:
        """A displacement (n,) with `C u = d`."""
        found: FloatArray = self._inverse @ d
        return found

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """lambda (n_rows,) with `C^T lambda = residual`, of least norm."""
        found: FloatArray = self._inverse.T @ residual
        return found

    def pushers(self, rows: IntArray) -> FloatArray:
        """Columns (n, m) of the inverse."""
        return self._inverse[:, rows]


class NonAssociatedConstraints:
    """Conditions whose multipliers push by other rows: C gives the motions, D the forces.

    Raises
    ------
    KernelError
        If C and D leave different numbers of motions.
    """

    def __init__(self, C: sp.csr_array, D: sp.csr_array) -> None:
        self.C, self.D, self.associated = C, D, False
        self._moving, self._pushing = EliminatedConstraints(C), EliminatedConstraints(D)
        self.T, self.V = self._moving.T, self._pushing.T
        if self.T.shape != self.V.shape:
            raise KernelError(
                "kernel.stepping.relations-leave-motions-duals",
                n_T=self.T.shape[1],
                n_V=self.V.shape[1],
            )

    def particular(self, d: FloatArray) -> FloatArray:
        """A displacement (n,) with `C u = d`."""
        return self._moving.particular(d)

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """lambda (n_rows,) with `D^T lambda = residual`."""
        return self._pushing.multipliers(residual)

    def pushers(self, rows: IntArray) -> FloatArray:
        """Columns (n, m), those of the rows that push."""
        return self._pushing.pushers(rows)


def _particulars(constraints: Constraints, rows: IntArray) -> FloatArray:
    """Particular motions (n, m) of unit values of some rows."""
    n_rows, n = constraints.C.shape
    found = np.zeros((n, len(rows)))
    for j, row in enumerate(rows.tolist()):
        found[:, j] = constraints.particular(np.eye(1, n_rows, row)[0])
    return found


def constraints_of(rows: ConstraintRows, small: bool) -> Constraints:
    """Eliminated equality conditions."""
    if not rows.associated:
        return NonAssociatedConstraints(rows.C, rows.D)
    return OrthogonalConstraints(rows.C) if small else EliminatedConstraints(rows.C)


def check_values(constraints: Constraints, imposed: FloatArray, numbering: Numbering) -> None:
    """Refuse imposed values (n_rows, k) that redundant conditions contradict.

    Raises
    ------
    KernelError
        Naming the unknowns of the worst such row.
    """
    for d in imposed.T:
        gap = np.abs(constraints.C @ constraints.particular(d) - d)
        wrong = np.flatnonzero(gap > 1e-9 * np.abs(d).max(initial=0.0))
        if len(wrong):
            worst = int(np.argmax(gap))
            names = [numbering.label(int(i)) for i in constraints.C[[worst]].indices[:6]]
            raise KernelError(
                "kernel.stepping.conditions-contradict-cannot-take", names=names, d=d[worst]
            )
