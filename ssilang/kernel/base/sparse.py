"""Sparse matrices, `sp` being scipy's module of them: products, and sums of element matrices."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.scientific import sp

__all__ = ["assemble_triplets", "for_products", "sp"]

SMALL = 160
"""Rows and columns up to which a dense product takes less than scipy's call of a sparse one.

Seven diagonals: 8.3 us sparse and 3.8 dense at 160, 5.4 and 12.5 at 240.
"""


def for_products(A: Any) -> Any:
    """A sparse matrix that multiplies many vectors: a dense array where it is small."""
    return A.toarray() if max(A.shape) <= SMALL else sp.csr_array(A)


def assemble_triplets(
    places: list[NDArray[np.int32]], values: list[FloatArray], n: int
) -> sp.csr_array:
    """Sum of element matrices (n_cells, m, m) at places (n_cells, m) by a list of triplets."""
    rows = [np.repeat(p, p.shape[1], axis=1).ravel() for p in places]
    columns = [np.tile(p, (1, p.shape[1])).ravel() for p in places]
    if not values:
        return sp.csr_array((n, n))
    terms = np.concatenate([v.ravel() for v in values])
    total = sp.coo_array((terms, (np.concatenate(rows), np.concatenate(columns))), shape=(n, n))
    assembled: sp.csr_array = total.tocsr()
    assembled.sum_duplicates()
    return assembled
