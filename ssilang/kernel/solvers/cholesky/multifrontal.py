"""Cholesky factors of a sparse matrix by fronts, on a tree of supernodes (Duff and Reid 1983).

The columns of a supernode have the same rows below it. They are kept in panels of `WIDTH`
columns: the inverse of the diagonal block, then the rows below it, column after column, so that
a solve reads the factor once, from one end to the other, without an index an entry.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart, later
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.base.memory import fits
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.cholesky.dissection import Tree
from ssilang.kernel.solvers.dense import multiply, subtract_from

WIDTH = 32
BLAS_ROWS = 192  # rows of a front from which BLAS is called
BLAS_NUMBERS = 4096  # of a panel from which BLAS is called
BLOCK = 128  # columns of a front whose update of the rest is one product


class NotPositiveError(Exception):
    """A pivot is not positive."""


class TooLargeError(Exception):
    """The factor takes more bytes than it may; whether memory would hold it."""

    def __init__(self, n_bytes: float, fits: bool) -> None:
        super().__init__(f"{n_bytes:g} bytes")
        self.n_bytes, self.fits = n_bytes, fits


class Panels(NamedTuple):
    """A factor L of A[order][:, order] = L L^T."""

    first: IntArray  # (n_supernodes + 1,) first column of each
    ptr: IntArray  # (n_supernodes + 1,) where the rows of each begin
    rows: NDArray[np.signedinteger[Any]]  # (ptr[-1],) rows below each supernode, increasing
    at: IntArray  # (n_supernodes + 1,) where the values of each start
    values: FloatArray  # (at[-1],)


class Updates(NamedTuple):
    """What supernodes leave to those of their first rows below, -1 for none."""

    child: IntArray  # (n_supernodes,) the last one whose update each takes
    sibling: IntArray  # (n_supernodes,) the one that is taken after each
    spot: IntArray  # (n_supernodes,) where the update of each waits on the stack


class Columns(NamedTuple):
    """The lower triangle of a matrix, column after column."""

    indptr: IntArray
    indices: IntArray
    data: FloatArray


def factorise_panels(A: sp.csr_array, tree: Tree, most: float = np.inf) -> Panels:
    """Factors of a symmetric positive A (n, n) in the order of a tree.

    Raises
    ------
    NotPositiveError
        If a pivot is not positive.
    TooLargeError
        If memory would not hold the factor and what is needed to make it, or that takes more
        than `most` bytes.
    """
    plan = _planned(A, tree)
    held = fits(plan.n_bytes)
    if plan.n_bytes > most or not held:
        raise TooLargeError(plan.n_bytes, held)
    panels = Panels(tree.first, plan.ptr, plan.rows, plan.at, np.zeros(plan.at[-1]))
    room = np.zeros(plan.waiting), np.zeros(plan.front), np.zeros((2, A.shape[0]), np.int64)
    bad = _factorise(plan.columns, panels, plan.updates, *room)
    if bad >= 0 or not np.isfinite(panels.values[-1:]).all():
        raise NotPositiveError(f"pivot {bad} is not positive")
    return panels


class _Plan(NamedTuple):
    """Where the numbers of a factor stand, and what it takes to make it."""

    columns: Columns
    updates: Updates
    ptr: IntArray
    rows: NDArray[np.signedinteger[Any]]
    at: IntArray
    waiting: int
    front: int

    @property
    def n_bytes(self) -> float:
        return 8.0 * (float(self.at[-1]) + self.waiting + self.front)


def factor_bytes(A: sp.csr_array, tree: Tree) -> float:
    """What the factor in the order of a tree would take while it is made."""
    return _planned(A, tree).n_bytes


def _planned(A: sp.csr_array, tree: Tree) -> _Plan:
    lower = sp.csr_array(sp.triu(A[tree.order][:, tree.order]))  # its rows are columns of tril
    indptr, indices = lower.indptr.astype(np.int64), lower.indices.astype(np.int64)
    ptr, rows, above = _rows_below(tree, indptr, indices)
    k, below = np.diff(tree.first), np.diff(ptr)  # where the panels of each begin
    whole, rest = np.divmod(k, WIDTH)
    sizes = WIDTH * whole * (k + below) - WIDTH**2 * (whole * (whole - 1) // 2)
    sizes += rest * (rest + below)
    rows, at = rows.astype(np.int32), np.append(0, np.cumsum(sizes))
    updates, waiting, front = _updates(tree.first, ptr, above)
    return _Plan(Columns(indptr, indices, lower.data), updates, ptr, rows, at, waiting, front)


def _rows_below(
    tree: Tree, indptr: IntArray, indices: IntArray
) -> tuple[IntArray, IntArray, IntArray]:
    """`ptr` and `rows` of the panels, and the supernode of each one's first row, -1 without rows.

    Rows of a supernode are those of its columns and of the supernodes just below it; it stands in
    one of the levels of the tree, those below it in deeper ones.
    """
    first, n, count = tree.first, len(indptr) - 1, len(tree.first) - 1
    owner, depth = np.repeat(np.arange(count), np.diff(first)), _depths(tree.parent)
    columns = sp.csr_array((np.ones(n, np.float32), np.arange(n), first), shape=(count, n))
    pattern = sp.csr_array((np.ones(len(indices), np.float32), indices, indptr), shape=(n, n))
    own = sp.csr_array(columns @ pattern)
    node, row = np.repeat(np.arange(count), np.diff(own.indptr)), own.indices.astype(np.int64)
    waiting = [np.zeros(0, np.int64)] * (depth.max(initial=-1) + 1)
    above, found = np.full(count, -1), [np.zeros(0, np.int64)]
    for level in reversed(range(len(waiting) + 1)):
        # those above are given what stands below them too: a number tells a supernode and a row
        below = row >= first[node + 1]
        given, to = node[below] * n + row[below], depth[node[below]]
        for one in np.flatnonzero(np.bincount(to)):
            waiting[one] = np.append(waiting[one], given[to == one])
        if level == 0:
            break
        ordered = np.sort(waiting[level - 1])  # np.unique takes ten times as long
        found.append(ordered[np.diff(ordered, prepend=-1) > 0])
        node, row = np.divmod(found[-1], n)
        is_first = np.diff(node, prepend=-1) > 0
        above[node[is_first]] = owner[row[is_first]]
        node = above[node]
    node, rows = np.divmod(np.sort(np.concatenate(found)), n)
    return np.searchsorted(node, np.arange(count + 1)), rows, above


def _depths(parent: IntArray) -> IntArray:
    """Number of supernodes above each."""
    depth, at = np.zeros(len(parent), np.int64), parent
    while (at >= 0).any():
        depth += at >= 0
        at = np.where(at >= 0, parent[at], -1)
    return depth


def _updates(first: IntArray, ptr: IntArray, above: IntArray) -> tuple[Updates, int, int]:
    """Where updates wait, the numbers that do so at most, and those of the largest front."""
    below = np.diff(ptr)
    stack, waiting, most, spot = list[int](), 0, 0, np.zeros(len(below), np.int64)
    size, taker = (below**2).tolist(), above.tolist()
    for s in range(len(size)):
        # what lies on top is free when it was taken
        while stack and taker[stack[-1]] <= s:
            waiting -= size[stack.pop()]
        if size[s]:
            stack.append(s)
            spot[s] = waiting
            waiting += size[s]
            most = max(most, waiting)
    order = np.argsort(above, kind="stable")
    order = order[above[order] >= 0]
    is_last = np.diff(above[order], append=-1) != 0
    child, sibling = np.full(len(above), -1), np.full(len(above), -1)
    child[above[order[is_last]]] = order[is_last]
    sibling[order[1:][~is_last[:-1]]] = order[:-1][~is_last[:-1]]
    front = int(((np.diff(first) + below) ** 2).max(initial=0))
    return Updates(child, sibling, spot), most, front


@compiled
def _gather(A: Columns, c0: int, c1: int, where: IntArray, F: FloatArray) -> None:
    """The matrix's own columns into a front; F[j, i] is row i of column j."""
    indptr, indices, data = A.indptr, A.indices, A.data
    for j in range(c0, c1):
        for q in range(indptr[j], indptr[j + 1]):
            F[j - c0, where[indices[q]]] = data[q]


@compiled
def _extend_add(
    U: FloatArray, rows: IntArray, where: IntArray, local: IntArray, F: FloatArray
) -> None:
    """Add the update of a child; `local` is overwritten."""
    n = len(rows)
    for i in range(n):
        local[i] = where[rows[i]]
    for j in range(n):
        f = F[local[j]]
        for i in range(j, n):
            f[local[i]] += U[j, i]


@compiled
def _diagonal_block(F: FloatArray, k0: int, k1: int, inverse: FloatArray) -> int:
    """Factor a block in place, put the inverse of its factor; index of a bad pivot or -1."""
    for j in range(k0, k1):
        if not F[j, j] > 0.0:
            return j
        pivot = np.sqrt(F[j, j])
        F[j, j] = pivot
        for i in range(j + 1, k1):
            F[j, i] /= pivot
        for e in range(j + 1, k1):
            for i in range(e, k1):
                F[e, i] -= F[j, e] * F[j, i]
    w = k1 - k0
    for j in range(w):
        inverse[j, j] = 1.0 / F[k0 + j, k0 + j]
        for i in range(j + 1, w):
            total = 0.0
            for e in range(j, i):
                total += F[k0 + e, k0 + i] * inverse[e, j]
            inverse[i, j] = -total / F[k0 + i, k0 + i]
    return -1


@later
@compiled_fast
def _panel_together(F: FloatArray, k0: int, k1: int, inverse: FloatArray, P: FloatArray) -> None:
    """`_panel` by BLAS."""
    right = np.empty(P.shape)
    for a in range(P.shape[0]):
        for i in range(P.shape[1]):
            right[a, i] = F[k0 + a, k1 + i]
    multiply(inverse, right, P)


@apart
@compiled_fast
def _panel(F: FloatArray, k0: int, k1: int, inverse: FloatArray, P: FloatArray) -> None:
    """Rows below a factorised block: P = inverse F[k0:k1, k1:]."""
    w, m = P.shape
    if w * m > BLAS_NUMBERS:
        _panel_together(F, k0, k1, inverse, P)
        return
    for a in range(w):
        p = P[a]
        for e in range(a + 1):
            t = inverse[a, e]
            f = F[k0 + e, k1:]
            for i in range(m):
                p[i] += t * f[i]


@later
@compiled_fast
def _update_together(F: FloatArray, k0: int, k1: int, limit: int) -> None:
    """`_update` by BLAS."""
    m = F.shape[0]
    for j0 in range(k1, limit, BLOCK):
        left = np.empty((min(BLOCK, limit - j0), k1 - k0))
        right = np.empty((k1 - k0, m - j0))
        for k in range(k0, k1):
            for i in range(j0, m):
                right[k - k0, i - j0] = F[k, i]
            for i in range(left.shape[0]):
                left[i, k - k0] = F[k, j0 + i]
        product = np.empty((left.shape[0], right.shape[1]))
        multiply(left, right, product)
        subtract_from(F, product, j0, j0)


@apart
@compiled_fast
def _update(F: FloatArray, k0: int, k1: int, limit: int) -> None:
    """F[j, i] -= sum_k F[k, j] F[k, i], k from k0 to k1, columns j to limit, rows i >= j."""
    m = F.shape[0]
    if m - k1 > BLAS_ROWS:
        _update_together(F, k0, k1, limit)
        return
    for j in range(k1, limit):
        f = F[j, j:]
        k = k0
        while k + 3 < k1:
            a0, a1, a2, a3 = F[k, j], F[k + 1, j], F[k + 2, j], F[k + 3, j]
            p0, p1, p2, p3 = F[k, j:], F[k + 1, j:], F[k + 2, j:], F[k + 3, j:]
            for i in range(m - j):
                f[i] -= a0 * p0[i] + a1 * p1[i] + a2 * p2[i] + a3 * p3[i]
            k += 4
        while k < k1:
            a0 = F[k, j]
            p0 = F[k, j:]
            for i in range(m - j):
                f[i] -= a0 * p0[i]
            k += 1


@apart
@compiled
def _columns(F: FloatArray, k: int, pos: int, values: FloatArray) -> int:
    """Factorise the first k columns of a front, put their panels; a bad pivot or -1."""
    m = F.shape[0]
    for block in range(0, k, BLOCK):
        end = min(block + BLOCK, k)
        for k0 in range(block, end, WIDTH):
            k1 = min(k0 + WIDTH, k)
            w = k1 - k0
            inverse = values[pos : pos + w * w].reshape((w, w))
            bad = _diagonal_block(F, k0, k1, inverse)
            if bad >= 0:
                return bad
            pos += w * w
            P = values[pos : pos + w * (m - k1)].reshape((w, m - k1))
            if m > k1:
                _panel(F, k0, k1, inverse, P)
                for a in range(w):
                    for i in range(m - k1):
                        F[k0 + a, k1 + i] = P[a, i]
                _update(F, k0, k1, end)
            pos += w * (m - k1)
        _update(F, block, end, m)
    return -1


@compiled
def _factorise(
    A: Columns, panels: Panels, updates: Updates, stack: FloatArray, work: FloatArray,
    places: IntArray,
) -> int:  # fmt: skip
    """Fill the panels; the column of a bad pivot or -1.

    `stack` holds updates of supernodes until those above take them, `work` one front, `places`
    (2, n) a row's place in it.
    """
    first, ptr, rows, where = panels.first, panels.ptr, panels.rows, places[0]
    for s in range(len(first) - 1):
        # a front of the supernode's columns and the rows below them; `where` is a row's place in it
        c0, k, below = first[s], first[s + 1] - first[s], ptr[s + 1] - ptr[s]
        m = k + below
        F = work[: m * m].reshape((m, m))
        for j in range(m):
            for i in range(j, m):
                F[j, i] = 0.0
        for j in range(k):
            where[c0 + j] = j
        for i in range(below):
            where[rows[ptr[s] + i]] = k + i
        # filled by the matrix and by the updates of the supernodes below
        _gather(A, c0, c0 + k, where, F)
        c = updates.child[s]
        while c >= 0:
            size, spot = ptr[c + 1] - ptr[c], updates.spot[c]
            U = stack[spot : spot + size * size].reshape((size, size))
            _extend_add(U, rows[ptr[c] : ptr[c + 1]], where, places[1], F)
            c = updates.sibling[c]
        bad = _columns(F, k, panels.at[s], panels.values)
        if bad >= 0:
            return int(c0 + bad)
        # what is left of the front waits on the stack
        if below > 0:
            spot = updates.spot[s]
            U = stack[spot : spot + below * below].reshape((below, below))
            for j in range(below):
                for i in range(j, below):
                    U[j, i] = F[k + j, k + i]
    return -1
