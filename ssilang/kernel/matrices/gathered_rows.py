"""Assembly row by row, compiled: the way of large systems.

A triplet list sorts every term of every element; here each row gathers its terms once from the
elements around its node, so that the cost is one pass over the terms and no copy of them. Where
the unknowns of each node follow one another, the rows of a node are gathered together: they have
the same columns, and those come in runs.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.sparse import sp

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
        run = _run(block)
        order = _by_node(block, run)
        heads = np.ascontiguousarray(block[:, order[::run]])
        start = np.zeros(n + 1, dtype=np.int64)
        np.cumsum(np.bincount(heads.ravel(), minlength=n), out=start[1:])
        users = _Users(start, _sorted_users(heads.ravel(), start))
        lengths = _row_lengths(heads, users, heads.shape[1], n)
        if run > 1:
            spread = lengths.copy()  # of the heads of runs, to all rows of the run
            for i in range(1, run):
                spread[i:] += lengths[: len(lengths) - i]
            lengths = run * spread
        indptr = np.zeros(n + 1, dtype=np.int64)
        np.cumsum(lengths, out=indptr[1:])
        indices = np.empty(indptr[-1], dtype=np.int32)
        data = np.zeros(indptr[-1])
        elements = _Elements(heads, order, run, np.ascontiguousarray(matrices))
        _fill(elements, users, indptr, indices, data)
        if indptr[-1] < 2**31:
            indptr = indptr.astype(np.int32)
        part = sp.csr_array((data, indices, indptr), shape=(n, n))
        part.has_sorted_indices = True
        total = part if total is None else total + part
    return sp.csr_array((n, n)) if total is None else total


def _run(places: Index) -> int:
    """Unknowns that follow one another at each node of each element (1: none do so everywhere).

    Nodes must not share unknowns otherwise than whole: the first of a run is never inside another.
    """
    if places.size == 0:
        return 1
    for run in (6, 3, 2):
        if places.shape[1] % run:
            continue
        order = _by_node(places[:1], run)
        heads = places[:, order[::run]]
        if all((places[:, order[i::run]] == heads + i).all() for i in range(1, run)):
            first = np.zeros(int(places.max()) + 1, bool)
            first[heads] = True
            if (np.diff(np.flatnonzero(first)) >= run).all():
                return run
    return 1


def _by_node(places: Index, run: int) -> NDArray[np.int64]:
    """Rows of the element matrices such that the runs of unknowns lie side by side."""
    if run == 1:
        return np.arange(places.shape[1])
    return np.argsort(places[0], kind="stable")


class _Users(NamedTuple):
    """Element rows that stand on each unknown: `rows[start[i]:start[i + 1]]`, flat numbers."""

    start: NDArray[np.int64]
    rows: NDArray[np.int64]


class _Elements(NamedTuple):
    """Places of the heads of runs, order and length of the runs, the elements' matrices."""

    heads: Index
    order: NDArray[np.int64]
    run: int
    values: FloatArray


@compiled
def _sorted_users(flat: Index, start: NDArray[np.int64]) -> NDArray[np.int64]:
    users = np.empty(len(flat), dtype=np.int64)
    free = start[:-1].copy()
    for k in range(len(flat)):
        users[free[flat[k]]] = k
        free[flat[k]] += 1
    return users


@compiled
def _row_lengths(places: Index, users: _Users, width: int, n: int) -> NDArray[np.int64]:
    """Number of distinct columns of each row."""
    start, rows = users
    lengths = np.zeros(n, dtype=np.int64)
    seen = np.full(n, -1, dtype=np.int32)
    for row in range(n):
        for k in range(start[row], start[row + 1]):
            cell = rows[k] // width
            for j in range(width):
                column = places[cell, j]
                if seen[column] != row:
                    seen[column] = row
                    lengths[row] += 1
    return lengths


@compiled
def _fill(
    elements: _Elements,
    users: _Users,
    indptr: NDArray[np.int64],
    indices: Index,
    data: FloatArray,
) -> None:
    """Columns and sums of each row, `run` rows at a time."""
    heads, order, run, values = elements
    start, rows = users
    n, width = len(indptr) - 1, heads.shape[1]
    place, found = np.full(n, -1, dtype=np.int64), np.empty(n, dtype=np.int32)
    for row in range(n):
        if start[row] == start[row + 1]:
            continue
        first, count = indptr[row], 0
        for k in range(start[row], start[row + 1]):
            cell = rows[k] // width
            for j in range(width):
                head = heads[cell, j]
                if place[head] < first:
                    place[head] = first
                    found[count] = head
                    count += 1
        found[:count].sort()
        length = count * run
        for k in range(count):
            place[found[k]] = first + k * run
        for i in range(run):
            at = indptr[row + i]
            for k in range(count):
                for j in range(run):
                    indices[at + k * run + j] = found[k] + j
        for k in range(start[row], start[row + 1]):
            cell, node = rows[k] // width, rows[k] % width
            for i in range(run):
                terms, shift = values[cell, order[node * run + i]], i * length
                for j in range(width):
                    at = place[heads[cell, j]] + shift
                    for e in range(run):
                        data[at + e] += terms[order[j * run + e]]
