"""Assembly row by row, compiled: the way of large systems.

A triplet list sorts every term of every element; here each row gathers its terms once from the
elements around its node, so that the cost is one pass over the terms and no copy of them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.compiled import compiled
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.sparse import sp

Index = NDArray[np.int32]


def assemble_rows(
    places: list[NDArray[np.int32]], values: list[FloatArray], n: int
) -> sp.csr_array:
    """Sum of element matrices as CSR (n, n), indices sorted.

    Parameters
    ----------
    places : list of array (n_cells, m)
        Unknown of each row of each element matrix, one array a block.
    values : list of array (n_cells, m, m)
    n : int
        Number of unknowns.
    """
    total: sp.csr_array | None = None
    for block, matrices in zip(places, values, strict=True):
        start, users = _users(block, n)
        width = block.shape[1]
        lengths = _row_lengths(block, start, users, width, n)
        indptr = np.zeros(n + 1, dtype=np.int64)
        np.cumsum(lengths, out=indptr[1:])
        indices = np.empty(indptr[-1], dtype=np.int32)
        data = np.zeros(indptr[-1])
        _fill(block, start, users, width, indptr, indices, data, np.ascontiguousarray(matrices))
        if indptr[-1] < 2**31:
            indptr = indptr.astype(np.int32)
        part = sp.csr_array((data, indices, indptr), shape=(n, n))
        part.has_sorted_indices = True
        total = part if total is None else total + part
    return sp.csr_array((n, n)) if total is None else total


def _users(places: Index, n: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Element rows that stand on each unknown: users[start[i]:start[i + 1]], flat row numbers."""
    start = np.zeros(n + 1, dtype=np.int64)
    np.cumsum(np.bincount(places.ravel(), minlength=n), out=start[1:])
    return start, _sorted_users(places.ravel(), start)


@compiled
def _sorted_users(flat: Index, start: NDArray[np.int64]) -> NDArray[np.int64]:
    users = np.empty(len(flat), dtype=np.int64)
    free = start[:-1].copy()
    for k in range(len(flat)):
        users[free[flat[k]]] = k
        free[flat[k]] += 1
    return users


@compiled
def _row_lengths(
    places: Index, start: NDArray[np.int64], users: NDArray[np.int64], width: int, n: int
) -> NDArray[np.int64]:
    """Number of distinct columns of each row."""
    lengths = np.zeros(n, dtype=np.int64)
    seen = np.full(n, -1, dtype=np.int32)
    for row in range(n):
        for k in range(start[row], start[row + 1]):
            cell = users[k] // width
            for j in range(width):
                column = places[cell, j]
                if seen[column] != row:
                    seen[column] = row
                    lengths[row] += 1
    return lengths


@compiled
def _fill(
    places: Index,
    start: NDArray[np.int64],
    users: NDArray[np.int64],
    width: int,
    indptr: NDArray[np.int64],
    indices: Index,
    data: FloatArray,
    values: FloatArray,
) -> None:
    """Columns and sums of each row."""
    n = len(indptr) - 1
    place = np.full(n, -1, dtype=np.int64)
    for row in range(n):
        first, free = indptr[row], indptr[row]
        for k in range(start[row], start[row + 1]):
            cell = users[k] // width
            for j in range(width):
                column = places[cell, j]
                if place[column] < first:
                    place[column] = first
                    indices[free] = column
                    free += 1
        indices[first:free].sort()
        for k in range(first, free):
            place[indices[k]] = k
        for k in range(start[row], start[row + 1]):
            cell, i = users[k] // width, users[k] % width
            for j in range(width):
                data[place[places[cell, j]]] += values[cell, i, j]
