"""Newton's steps of large yielding bodies by Cholesky factors, in one order of elimination."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.multifrontal import NotPositiveError, TooLargeError
from ssilang.kernel.stepping.effective import ordering_of
from ssilang.kernel.stepping.problem.problem import Problem

SYMMETRIC = 1e-12
"""Difference of a joint's stiffness and its transpose that is rounding, of its largest term."""


class PositiveFactors:
    """Solves with one symmetric tangent after the other.

    Tangents without softening are positive; what is not, beyond a limit load for example, is left
    to others.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self._first: DissectedFactor | None = None

    def solve(self, A: sp.csr_array, joints: sp.csr_array, free: FloatArray) -> FloatArray | None:
        """Admissible motion (n,) under forces (n,); None if A is not positive, or too large.

        `joints` is what of A may not be symmetric: friction.
        """
        if not _symmetric(joints):
            return None
        T = self.problem.constraints.T
        factor = self._factor(sp.csr_array(T.T @ A @ T))
        return None if factor is None else np.asarray(T @ factor.solve(T.T @ free))

    def _factor(self, matrix: sp.csr_array) -> DissectedFactor | None:
        order = None
        try:
            if self._first is not None:
                return self._first.another(matrix)
            order = ordering_of(self.problem, sp.csc_array((matrix.shape[0], 0)))
            if order is not None:
                self._first = DissectedFactor(matrix, order.points)
        except (NotPositiveError, TooLargeError):
            return None
        return self._first


def _symmetric(K: sp.csr_array) -> bool:
    if not K.nnz:
        return True
    return bool(abs(K - K.T).max() <= SYMMETRIC * np.abs(K.data).max())
