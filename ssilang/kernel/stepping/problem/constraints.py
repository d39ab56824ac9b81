"""Conditions eliminated, `u = T q + particular(d)`; damping split by mass and stiffness.

Non-associated relations (RELA ... 'DUAL') push by `D^T lambda` with rows D that are not C:
equilibrium then holds on the motions V that D leaves, `V^T (K u - F) = 0`.
"""

from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.scientific import la, sp
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

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """lambda (n_rows,) with `D^T lambda = residual` (n,)."""

    def pushers(self, rows: IntArray) -> FloatArray:
        """Columns (n, m) whose products with a residual are some of its multipliers."""


class EliminatedConstraints:
    """Sparse elimination, for systems of any size."""

    def __init__(self, C: sp.csr_array) -> None:
        self.C = self.D = C
        elimination = eliminate(C)
        if not elimination.eliminated.all():
            raise KernelError("kernel.stepping.relation-too-many-unknowns")
        self.T = self.V = elimination.T
        self.particular, self.multipliers = elimination.particular, elimination.multipliers
        self.associated = True

    def pushers(self, rows: IntArray) -> FloatArray:
        """Columns (n, m): multipliers are the transpose of particular motions."""
        n_rows, n = self.C.shape
        found = np.zeros((n, len(rows)))
        for j, row in enumerate(rows.tolist()):
            found[:, j] = self.particular(np.eye(1, n_rows, row)[0])
        return found


class OrthogonalConstraints:
    """Dense orthogonal elimination, for small systems; redundant rows share their multipliers."""

    def __init__(self, C: sp.csr_array) -> None:
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
        return self._inverse @ d

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """lambda (n_rows,) with `C^T lambda = residual`, of least norm."""
        return self._inverse.T @ residual

    def pushers(self, rows: IntArray) -> FloatArray:
        """Columns (n, m) of the inverse."""
        return np.asarray(self._inverse[:, rows], float)


class NonAssociatedConstraints:
    """Conditions whose multipliers push by other rows: C gives the motions, D the forces.

    Raises
    ------
    KernelError
        If C and D leave different numbers of motions.
    """

    def __init__(self, C: sp.csr_array, D: sp.csr_array) -> None:
        self.C, self.D, self.associated = C, D, False
        moving, pushing = EliminatedConstraints(C), EliminatedConstraints(D)
        self.T, self.V = moving.T, pushing.T
        self.particular = moving.particular
        self.multipliers, self.pushers = pushing.multipliers, pushing.pushers
        if self.T.shape != self.V.shape:
            raise KernelError(
                "kernel.stepping.relations-leave-motions-duals",
                n_T=self.T.shape[1],
                n_V=self.V.shape[1],
            )


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


TURNS = 30
ROUNDING = 1e-13  # of the size of a term: what is left below it is none
FEW = 0.5  # share of the terms of C that may be left


def split_damping(
    C: sp.csr_array, M: sp.csr_array, K: sp.csr_array
) -> tuple[float, float, sp.csr_array]:
    """alpha, beta and the rest of `C = alpha M + beta K + rest`, all (n, n).

    Found from the images of one vector, by least absolute differences, so that dashpots on less
    than half of the unknowns do not count. A damping that is no such combination is all rest.
    """
    n = C.shape[0]
    if C.nnz == 0:
        return 0.0, 0.0, C
    x = np.random.default_rng(0).uniform(0.5, 1.5, n)
    columns: FloatArray = np.column_stack([M @ x, K @ x])
    image: FloatArray = C @ x
    sizes = np.abs(columns).max(axis=0)
    columns = columns / np.where(sizes > 0.0, sizes, 1.0)
    weights = np.ones(n)
    for _ in range(TURNS):
        left = image - columns @ _least_squares(columns, image, weights)
        weights = 1.0 / np.maximum(np.abs(left), 1e-14 * np.abs(image).max())
    near = np.abs(left) <= 1e-8 * np.abs(image).max()
    found = _least_squares(columns[near], image[near], np.ones(int(near.sum())))
    alpha, beta = (float(v) for v in found / np.where(sizes > 0.0, sizes, 1.0))
    rest = sp.csr_array(C - alpha * M - beta * K)
    size = np.abs(alpha) * M.diagonal() + np.abs(beta) * K.diagonal() + np.abs(C.diagonal())
    rows = np.repeat(np.arange(n), np.diff(rest.indptr))
    small = np.abs(rest.data) <= ROUNDING * np.sqrt(np.abs(size[rows] * size[rest.indices]))
    rest.data[small] = 0.0
    rest.eliminate_zeros()
    return (alpha, beta, rest) if rest.nnz <= FEW * C.nnz else (0.0, 0.0, C)


def _least_squares(columns: FloatArray, image: FloatArray, weights: FloatArray) -> FloatArray:
    root = np.sqrt(weights)
    found = np.linalg.lstsq(columns * root[:, None], image * root, rcond=1e-12)[0]
    return np.asarray(found, dtype=np.float64)
