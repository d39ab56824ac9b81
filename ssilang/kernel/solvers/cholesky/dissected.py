"""Sparse Cholesky of this house: nested dissection, fronts, panels; symmetric positive matrices."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.cholesky.dissection import Tree, dissection
from ssilang.kernel.solvers.cholesky.multifrontal import factorise_panels
from ssilang.kernel.solvers.cholesky.triangular import longest, solve_column, solve_columns

MANY = 8  # right-hand sides from which BLAS solves them together


class DissectedFactor:
    """Factor of a symmetric positive matrix.

    Parameters
    ----------
    points : array (n, d)
        Coordinates of the unknowns, by which they are ordered.
    last : array of int
        Unknowns eliminated last, together: the root of the tree.
    most : float
        Bytes that it may take.

    Raises
    ------
    NotPositiveError
        If the matrix is not positive.
    TooLargeError
        If it would take more memory than there is, or than it may.
    """

    name = "nested dissection"

    def __init__(
        self, A: sp.csr_array, points: FloatArray, last: IntArray | None = None,
        most: float = np.inf,
    ) -> None:  # fmt: skip
        nothing = np.zeros(0, np.int64)
        self._factorise(A, dissection(A, points, nothing if last is None else last), most)

    def _factorise(self, A: sp.csr_array, tree: Tree, most: float) -> None:
        self.tree, self.panels = tree, factorise_panels(A, tree, most)
        self.room = np.empty(longest(self.panels))

    def another(self, A: sp.csr_array) -> "DissectedFactor":
        """Factor of a matrix with the same unknowns and terms, in the same order."""
        made = DissectedFactor.__new__(DissectedFactor)
        made._factorise(A, self.tree, np.inf)
        return made

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b, b (n,) or (n, k)."""
        x = np.empty(b.shape)
        y = np.ascontiguousarray(b[self.tree.order], dtype=float)
        if y.ndim == 1:
            solve_column(self.panels, y, self.room)
        elif y.shape[1] >= MANY:
            solve_columns(self.panels, y, 0, len(self.panels.first) - 1)
        else:
            for j in range(y.shape[1]):
                column = y[:, j].copy()
                solve_column(self.panels, column, self.room)
                y[:, j] = column
        x[self.tree.order] = y
        return x
