"""The terms of a tangent, found once: each turn adds numbers to places that do not change."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp

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
    def of(cls, like: sp.csr_array, places: Sequence[NDArray[np.int32]]) -> Pattern:
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
