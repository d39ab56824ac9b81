"""Conjugate gradients with algebraic multigrid (pyamg), where memory would not hold a factor.

Smoothed aggregation (Vanek, Mandel, Brezina 1996) needs the motions that cost next to no energy:
the rigid ones of the body, given at each unknown.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.base.sparse import sp

RESIDUAL = 1e-12  # of the second member: what a direct solver leaves, or little more
MOST_TURNS = 500
ALIKE = 1e-8  # singular value, of the largest, below which rigid motions say the same


class MultigridFactor:
    """A hierarchy of coarser matrices instead of a factor; symmetric positive matrices.

    Parameters
    ----------
    A : csr array (n, n)
    positive : bool
    rigid : array (n, k) or None
        Rigid motions of the unknowns, in the unknowns of A; None for constant ones.

    Raises
    ------
    KernelError
        If A is not taken for positive.
    """

    name = "multigrid"

    def __init__(self, A: sp.csr_array, positive: bool, rigid: FloatArray | None = None) -> None:
        from pyamg import smoothed_aggregation_solver

        if not positive:
            raise KernelError("kernel.solvers.multigrid-solves-symmetric-positive")
        if not (A.diagonal() > 0.0).all():
            raise SingularFactorError("a diagonal term is not positive")
        matrix = sp.csr_matrix(A)
        for indices in ("indptr", "indices"):  # pyamg's are of 32 bits
            setattr(matrix, indices, getattr(matrix, indices).astype(np.int32))
        self._matrix = matrix
        hierarchy = smoothed_aggregation_solver(
            matrix, None if rigid is None else _independent(rigid), symmetry="symmetric",
            strength=("symmetric", {"theta": 0.0}), max_coarse=500,
        )  # fmt: skip
        self._coarser = hierarchy.aspreconditioner(cycle="V")

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b, b (n,) or (n, k).

        Raises
        ------
        KernelError
            If the iteration does not converge: a free motion, or a matrix that is not positive.
        """
        if b.ndim == 2:
            return np.column_stack([self.solve(column) for column in b.T])
        import scipy.sparse.linalg as spla

        x, left = spla.cg(
            self._matrix, b, rtol=RESIDUAL, atol=0.0, maxiter=MOST_TURNS, M=self._coarser
        )
        if left or not np.isfinite(x).all():
            raise KernelError("kernel.solvers.multigrid-did-not-converge", most_turns=MOST_TURNS)
        return np.asarray(x, dtype=float)


def _independent(rigid: FloatArray) -> FloatArray:
    """An orthonormal basis of the columns that say something of their own."""
    left, size, _ = np.linalg.svd(rigid, full_matrices=False)
    basis: FloatArray = left[:, size > ALIKE * size.max(initial=0.0)]
    return np.ascontiguousarray(basis)
