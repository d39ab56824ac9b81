"""Factor of a symmetric matrix that is positive but for small groups of unknowns, negative ones.

Histories of stress in a matched layer are such groups, of three each. They are eliminated first, by
themselves; what is left is positive and goes to the solvers of positive matrices.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.backends import factorise
from ssilang.kernel.solvers.factor import Factor, Ordering, Solver

LARGEST = 12
"""Unknowns of a group."""


class SmallGroupsFactor:
    """Factor of A (n, n), symmetric, whose unknowns `groups` (m,) are in small negative groups.

    Raises
    ------
    SingularFactorError
        If a group is large or not negative, or what is left is not positive.
    """

    def __init__(
        self,
        A: sp.csr_array,
        groups: IntArray,
        solver: Solver | str | None = None,
        ordering: Ordering | None = None,
    ) -> None:
        self._groups = groups
        self._rest = np.setdiff1d(np.arange(A.shape[0]), groups)
        self._inverse = _inverse_of_groups(sp.csr_array(A[groups][:, groups]))
        self._ties = sp.csr_array(A[groups][:, self._rest])
        self._across = sp.csr_array(self._ties.T)
        left = A[self._rest][:, self._rest] - self._across @ self._inverse @ self._ties
        part = None if ordering is None else ordering.of(self._rest.astype(np.int64))
        self.inner: Factor = factorise(sp.csr_array(left), True, solver, part)
        self.name = f"{self.inner.name} + 3 x 3"

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b."""
        x = np.empty_like(b, dtype=float)
        own = self._inverse @ b[self._groups]
        rest = self.inner.solve(b[self._rest] - self._across @ own)
        x[self._rest] = rest
        x[self._groups] = own - self._inverse @ (self._ties @ rest)
        return x


def _inverse_of_groups(A: sp.csr_array) -> sp.csr_array:
    """Inverse (m, m) of a matrix of small negative blocks."""
    from scipy.sparse.csgraph import connected_components

    count, label = connected_components(A, directed=False)
    size = np.bincount(label, minlength=count)
    if size.max(initial=0) > LARGEST:
        raise SingularFactorError("a group of unknowns is large")
    order = np.argsort(label, kind="stable")
    first = np.concatenate([[0], np.cumsum(size)[:-1]])
    place = np.empty(len(label), np.int64)
    place[order] = np.arange(len(label)) - np.repeat(first, size)
    blocks = np.zeros((count, size.max(initial=0), size.max(initial=0)))
    terms = sp.coo_array(A)
    rows, columns = terms.coords
    np.add.at(blocks, (label[rows], place[rows], place[columns]), terms.data)
    spare = np.arange(blocks.shape[1]) >= size[:, None]
    group, at = np.nonzero(spare)
    blocks[group, at, at] = -1.0
    try:
        np.linalg.cholesky(-blocks)
    except np.linalg.LinAlgError as error:
        raise SingularFactorError(str(error)) from None
    inverse = np.linalg.inv(blocks)
    group, i, j = np.nonzero(inverse * ~(spare[:, :, None] | spare[:, None, :]))
    member = np.full(blocks.shape[:2], -1)
    member[label, place] = np.arange(len(label))
    found = sp.coo_array(
        (inverse[group, i, j], (member[group, i], member[group, j])), shape=A.shape
    )
    return sp.csr_array(found)
