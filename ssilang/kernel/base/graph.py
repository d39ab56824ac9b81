"""Which things hang together: parts of a graph.

scipy's function imports all of scipy.linalg with it, 0.04 s of each run.
"""

from typing import cast

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.sparse import sp

AT_ONCE = 1 << 21  # links looked at together: large stiffnesses have a hundred million


def parts_of(n: int, *links: tuple[IntArray, IntArray] | IntArray) -> IntArray:
    """Part (0, 1 ...) of each of n things, in the order in which parts appear.

    Each part is named after its first thing: a part hooks on the least of its neighbours, then all
    look up whom they hang on (Shiloach and Vishkin, 1982).

    Parameters
    ----------
    links : pairs of arrays (m,), or arrays (2, m)
        Which two things belong together.
    """
    first = np.arange(n, dtype=np.int64)
    for one, other in links:
        for start in range(0, len(one), AT_ONCE):
            _join(first, one[start : start + AT_ONCE], other[start : start + AT_ONCE])
    return np.unique(first, return_inverse=True)[1].astype(np.int64)


def _join(first: IntArray, one: IntArray, other: IntArray) -> None:
    """The first thing (n,) of each one's part, changed in place by links."""
    while True:
        a, b = first[one], first[other]
        apart = a != b
        if not apart.any():
            return
        one, other, a, b = one[apart], other[apart], a[apart], b[apart]
        np.minimum.at(first, np.maximum(a, b), np.minimum(a, b))
        while not np.array_equal(above := first[first], first):
            first[:] = above


def chains(rows: sp.csr_array) -> tuple[IntArray, IntArray]:
    """Links between neighbours of what each row (m, n) couples: entries that are not zero."""
    row, column = entries(rows)
    same = row[1:] == row[:-1]
    return column[:-1][same], column[1:][same]


def entries(matrix: sp.csr_array) -> tuple[IntArray, IntArray]:
    """Row and column of each entry (m, n) that is not zero, row by row."""
    column, there = cast(IntArray, matrix.indices), matrix.data != 0.0  # narrow: may be long
    row = np.repeat(np.arange(matrix.shape[0], dtype=column.dtype), np.diff(matrix.indptr))
    return (row, column) if there.all() else (row[there], column[there])
