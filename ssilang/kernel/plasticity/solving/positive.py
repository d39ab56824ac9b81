"""Newton's steps of large yielding bodies by Cholesky factors, in one order of elimination.

The terms of a tangent are found once: each turn adds numbers to places that do not change.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.multifrontal import NotPositiveError, TooLargeError
from ssilang.kernel.stepping.effective import ordering_of
from ssilang.kernel.stepping.problem.problem import Problem

ROWS = 100_000  # elements whose places are looked up together


@dataclass(frozen=True, eq=False)
class Pattern:
    """Where the element matrices of some blocks go in a CSR matrix (n, n).

    Attributes
    ----------
    indptr, indices : arrays
        Of the matrix, columns of a row increasing.
    slots : tuple of array (n_cells, m, m)
        The term that each entry of a block's element matrices is part of.
    """

    indptr: NDArray[np.int32]
    indices: NDArray[np.int32]
    slots: tuple[NDArray[np.int32], ...]

    @classmethod
    def of(cls, like: sp.csr_array, places: Sequence[NDArray[np.int32]]) -> "Pattern":
        """The pattern of an assembled matrix, for element matrices at places (n_cells, m)."""
        like.sort_indices()
        n = like.shape[0]
        rows = np.repeat(np.arange(n, dtype=np.int64), np.diff(like.indptr))
        keys = rows * n + like.indices
        slots = tuple(_slots(keys, block.astype(np.int64), n) for block in places)
        return cls(like.indptr, like.indices, slots)

    def matrix(self, data: FloatArray) -> sp.csr_array:
        """The matrix of terms (nnz,)."""
        n = len(self.indptr) - 1
        made = sp.csr_array((data, self.indices, self.indptr), shape=(n, n))
        made.has_canonical_format = True
        return made

    def blank(self) -> FloatArray:
        """Terms (nnz,) to add to."""
        return np.zeros(len(self.indices))

    def add(self, data: FloatArray, block: int, values: FloatArray) -> None:
        """Element matrices (n_cells, m, m) of a block into the terms."""
        data += np.bincount(self.slots[block].ravel(), values.ravel(), len(data))


def _slots(keys: NDArray[np.int64], places: NDArray[np.int64], n: int) -> NDArray[np.int32]:
    found = np.empty((*places.shape, places.shape[1]), np.int32)
    for low in range(0, len(places), ROWS):
        part = places[low : low + ROWS]
        found[low : low + ROWS] = np.searchsorted(keys, part[:, :, None] * n + part[:, None, :])
    return found


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
