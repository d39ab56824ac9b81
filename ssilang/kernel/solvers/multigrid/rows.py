"""Sparse matrices whose rows come in groups (the unknowns of a node) with the same columns.

The columns are read once a group and the values lie side by side, so that a product is some short
dense ones. Values may be of single precision; sums are then too.
"""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.compiled.compiler import compiled, compiled_threaded
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.base.threads import in_parts

Real = NDArray[Any]
"""An array of numbers of single or double precision."""
Index = NDArray[np.int32]


class Rows(NamedTuple):
    """A matrix (n, m) by groups of rows."""

    first: IntArray  # (n_groups + 1,) first row of each group
    ptr: IntArray  # (n_groups + 1,) where its columns start
    columns: Index  # (ptr[-1],) of int32
    at: IntArray  # (n_groups + 1,) where its values start, row after row
    values: Real  # (at[-1],)
    width: int  # most columns of a group
    height: int  # most rows of a group


def empty_rows(first: IntArray, ptr: IntArray, kind: Any) -> Rows:
    """Rows with so many columns a group, all zero."""
    sizes = np.diff(first) * np.diff(ptr)
    at = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    return rows_of(first, ptr, np.zeros(ptr[-1], np.int32), at, np.zeros(at[-1], kind))


def rows_of(first: IntArray, ptr: IntArray, columns: Index, at: IntArray, values: Real) -> Rows:
    """Rows of these arrays."""
    width, height = (int(np.diff(x).max(initial=0)) for x in (ptr, first))
    return Rows(first, ptr, columns, at, values, width, height)


def grouped(A: sp.csr_array, first: IntArray, kind: Any) -> Rows:
    """A csr matrix (sorted columns) by groups; rows of a group share the union of their columns."""
    indptr, indices = A.indptr.astype(np.int64), A.indices.astype(np.int32, copy=False)
    seen = np.full(A.shape[1], -1, np.int64)
    ptr = np.zeros(len(first), np.int64)
    _count_columns(indptr, indices, first, seen, ptr)
    made = empty_rows(first, np.cumsum(ptr), kind)
    seen[:] = -1
    _fill_groups(indptr, indices, A.data, seen, made)
    return made


@compiled
def _count_columns(
    indptr: IntArray, indices: Index, first: IntArray, seen: IntArray, ptr: IntArray
) -> None:
    for g in range(len(first) - 1):
        count = 0
        for k in range(indptr[first[g]], indptr[first[g + 1]]):
            if seen[indices[k]] != g:
                seen[indices[k]] = g
                count += 1
        ptr[g + 1] = count


@compiled
def _fill_groups(indptr: IntArray, indices: Index, data: Real, place: IntArray, to: Rows) -> None:
    """Columns in the order of their first mention (that of the first row, nearly always sorted)."""
    for g in range(len(to.first) - 1):
        begin, width = to.ptr[g], to.ptr[g + 1] - to.ptr[g]
        count = 0
        for i in range(to.first[g], to.first[g + 1]):
            base = to.at[g] + (i - to.first[g]) * width
            for k in range(indptr[i], indptr[i + 1]):
                j = indices[k]
                if place[j] < begin:
                    place[j] = begin + count
                    to.columns[begin + count] = j
                    count += 1
                to.values[base + place[j] - begin] += data[k]


@compiled_threaded
def _rest(A: Rows, x: Real, b: Real, local: Real, out: Real, low: int, high: int) -> None:
    """`out = b - A x` on groups low to high; room for `width` numbers."""
    base = A.at[low]
    for g in range(low, high):
        begin, width = A.ptr[g], A.ptr[g + 1] - A.ptr[g]
        columns = A.columns[begin : begin + width]
        for k in range(width):
            local[k] = x[columns[k]]
        for i in range(A.first[g], A.first[g + 1]):
            out[i] = b[i] - _dot(A.values[base : base + width], local)
            base += width


@compiled_threaded
def _dot(row: Real, x: Real) -> float:
    total: float = row.dtype.type(0)
    for k in range(len(row)):
        total += row[k] * x[k]
    return total


@compiled_threaded
def _relax(
    A: Rows, inverse: Real, at: IntArray, x: Real, b: Real, d: Real, new: Real, old: float,
    fresh: float, local: Real, rest: Real, low: int, high: int,
) -> None:  # fmt: skip
    """`d = old d + fresh D^-1 (b - A x)`, `new = x + d`, D the diagonal blocks of the groups."""
    base = A.at[low]
    for g in range(low, high):
        begin, width = A.ptr[g], A.ptr[g + 1] - A.ptr[g]
        start, size = A.first[g], A.first[g + 1] - A.first[g]
        columns = A.columns[begin : begin + width]
        for k in range(width):
            local[k] = x[columns[k]]
        for i in range(size):
            rest[i] = b[start + i] - _dot(A.values[base : base + width], local)
            base += width
        for i in range(size):
            row = inverse[at[g] + i * size : at[g] + (i + 1) * size]
            d[start + i] = old * d[start + i] + fresh * _dot(row, rest)
            new[start + i] = x[start + i] + d[start + i]


@compiled_threaded
def _divide(
    first: IntArray, inverse: Real, at: IntArray, b: Real, factor: float, out: Real, low: int,
    high: int,
) -> None:  # fmt: skip
    """`out = factor D^-1 b`."""
    for g in range(low, high):
        start, size = first[g], first[g + 1] - first[g]
        for i in range(size):
            row = inverse[at[g] + i * size : at[g] + (i + 1) * size]
            out[start + i] = factor * _dot(row, b[start : start + size])


def rest_of(A: Rows, x: Real, b: Real) -> Real:
    """`b - A x`."""
    out = np.empty_like(b)

    def part(low: int, high: int) -> None:
        _rest(A, x, b, np.empty(A.width, x.dtype), out, low, high)

    in_parts(part, A.at)
    return out


class Diagonal(NamedTuple):
    """Inverses of the diagonal blocks of groups, one after another from `at` (n_groups + 1,) on."""

    inverse: Real
    at: IntArray


def diagonal_of(A: Rows) -> Diagonal:
    """Inverses of the diagonal blocks; zero for groups without stiffness."""
    sizes = np.diff(A.first)
    at = np.concatenate([[0], np.cumsum(sizes**2)]).astype(np.int64)
    blocks = np.zeros(at[-1])
    _take_blocks(A, at, blocks)
    for size in np.unique(sizes):
        own = np.flatnonzero(sizes == size)
        places = at[own][:, None] + np.arange(size**2)
        blocks[places] = _inverses(blocks[places].reshape(-1, size, size)).reshape(len(own), -1)
    return Diagonal(blocks.astype(A.values.dtype), at)


def _inverses(blocks: NDArray[np.float64]) -> NDArray[np.float64]:
    """Inverses of blocks (k, b, b), of zero for unknowns without stiffness."""
    own = np.diagonal(blocks, axis1=1, axis2=2)
    dead = own <= 0.0
    filled = blocks.copy()
    rows = np.arange(blocks.shape[1])
    filled[:, rows, rows] = np.where(dead, 1.0, own)
    found = np.asarray(np.linalg.inv(filled), dtype=float)
    found[:, rows, rows] -= np.where(dead, 1.0, 0.0)
    return found


@compiled
def _take_blocks(A: Rows, at: IntArray, blocks: Real) -> None:
    for g in range(len(A.first) - 1):
        start, end = A.first[g], A.first[g + 1]
        width = A.ptr[g + 1] - A.ptr[g]
        for k in range(width):
            j = A.columns[A.ptr[g] + k]
            if start <= j < end:
                for i in range(end - start):
                    blocks[at[g] + i * (end - start) + j - start] = A.values[
                        A.at[g] + i * width + k
                    ]


def relaxed(
    A: Rows, D: Diagonal, x: Real, b: Real, d: Real, old: float, fresh: float
) -> Real:  # fmt: skip
    """A step of a polynomial smoother: the next x; d is changed in place."""
    new = np.empty_like(x)
    kind = A.values.dtype.type

    def part(low: int, high: int) -> None:
        local, rest = np.empty(A.width, kind), np.empty(A.height, kind)
        _relax(A, D.inverse, D.at, x, b, d, new, kind(old), kind(fresh), local, rest, low, high)

    in_parts(part, A.at)
    return new


def divided(A: Rows, D: Diagonal, b: Real, factor: float = 1.0) -> Real:
    """`factor D^-1 b`."""
    out = np.empty_like(b)
    kind = A.values.dtype.type
    in_parts(partial(_divide, A.first, D.inverse, D.at, b, kind(factor), out), D.at)
    return out
