"""Nested dissection: an elimination order with little fill-in, as a tree of supernodes.

The unknowns of a point stay together. A set of points is cut at the middle of one of the axes;
the points of one half that touch the other are its separator, numbered behind both halves, which
are cut in turn (George 1973). Each separator and each part too small to be cut is a supernode.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.sparse import sp

LEAF = 10  # points below which a part is not cut: more fill-in, fewer and larger supernodes
THIN = 0.3  # axes along which a part is shorter than this of its longest are not cut


@dataclass(frozen=True, eq=False)
class Tree:
    """Order of elimination.

    Attributes
    ----------
    order : array (n,)
        Unknown at each place.
    first : array (n_supernodes + 1,)
        First place of each supernode; descendants stand right before their ancestor.
    parent : array (n_supernodes,)
        Supernode that separated it from others, -1 for roots.
    """

    order: IntArray
    first: IntArray
    parent: IntArray


def dissection(A: sp.csr_array, points: FloatArray, last: IntArray) -> Tree:
    """Order the unknowns of a symmetric matrix A (n, n).

    Parameters
    ----------
    points : array (n, d)
        Coordinates of each unknown.
    last : array of int
        Unknowns that stand at the end, together, as the root of the tree.
    """
    n = A.shape[0]
    ending = np.zeros(n, bool)
    ending[last] = True
    size = np.abs(points).max(initial=0.0) or 1.0
    _, group = np.unique(np.round(points / size, 10), axis=0, return_inverse=True)
    group = 2 * group.ravel() + ending
    _, member, group = np.unique(group, return_index=True, return_inverse=True)
    graph = _quotient(A, group, len(member))
    ptr, neighbours = graph.indptr.astype(np.int64), graph.indices.astype(np.int64)
    sequence, start, parent = _dissect(
        ptr, neighbours, np.ascontiguousarray(points[member], dtype=float), ending[member], LEAF
    )
    by = np.argsort(start, kind="stable")
    renumbered = np.full(len(by) + 1, -1, np.int64)
    renumbered[by] = np.arange(len(by))
    place = np.empty(len(member), np.int64)
    place[sequence] = np.arange(len(member))
    sizes = np.bincount(group, minlength=len(member))[sequence]
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    first = np.concatenate([offsets[start[by]], [n]]).astype(np.int64)
    return Tree(np.argsort(place[group], kind="stable"), first, renumbered[parent[by]])


def _quotient(A: sp.csr_array, group: IntArray, count: int) -> sp.csr_array:
    """Graph (count, count) of groups of unknowns."""
    n = A.shape[0]
    members = sp.csr_array((np.ones(n, np.float32), (np.arange(n), group)), shape=(n, count))
    pattern = sp.csr_array((np.ones(A.nnz, np.float32), A.indices, A.indptr), shape=A.shape)
    return sp.csr_array(members.T @ pattern @ members)


@compiled
def _sides(
    ptr: IntArray, neighbours: IntArray, order: IntArray, lo: int, hi: int, keys: FloatArray,
    cut: float, side: IntArray,
) -> tuple[int, int, int]:  # fmt: skip
    """Sides of a cut: 0 below it, 1 above; 3 and 2 are those of each that touch the other side.

    Returns how many are below, marked 2, marked 3; `side` is -1 elsewhere.
    """
    below, above_touching, below_touching = 0, 0, 0
    for i in range(lo, hi):
        side[order[i]] = 0 if keys[i - lo] < cut else 1
    for i in range(lo, hi):
        v = order[i]
        mine = side[v]
        below += 1 - mine
        for k in range(ptr[v], ptr[v + 1]):
            s = side[neighbours[k]]
            if s >= 0 and (s if s < 2 else 3 - s) != mine:
                if mine == 1:
                    side[v] = 2
                    above_touching += 1
                else:
                    side[v] = 3
                    below_touching += 1
                break
    return below, above_touching, below_touching


@compiled
def _middle(keys: FloatArray, size: int) -> float:
    """Value that has size // 2 of the first keys before it in their order (Hoare's selection).

    The keys change places. NumPy's `partition` takes seconds to compile.
    """
    low, high, wanted = 0, size - 1, size // 2
    while low < high:
        i, j, pivot = low, high, keys[(low + high) // 2]
        while i <= j:
            while keys[i] < pivot:
                i += 1
            while keys[j] > pivot:
                j -= 1
            if i <= j:
                keys[i], keys[j] = keys[j], keys[i]
                i += 1
                j -= 1
        if wanted <= j:
            high = j
        elif wanted >= i:
            low = i
        else:
            break
    return float(keys[wanted])


@compiled
def _best_cut(
    ptr: IntArray, neighbours: IntArray, points: FloatArray, order: IntArray, lo: int, hi: int,
    keys: FloatArray, side: IntArray,
) -> tuple[int, float]:  # fmt: skip
    """Axis and position of the cut with the fewest separating points, axis -1 if none cuts."""
    size, d = hi - lo, points.shape[1]
    spans, widest = np.empty(d), 0.0
    for a in range(d):
        low, high = points[order[lo], a], points[order[lo], a]
        for i in range(lo, hi):
            low, high = min(low, points[order[i], a]), max(high, points[order[i], a])
        spans[a] = high - low
        widest = max(widest, spans[a])
    best, axis, position = -1, -1, 0.0
    for a in range(d):
        if spans[a] == 0.0 or spans[a] < THIN * widest:
            continue
        for i in range(lo, hi):
            keys[i - lo] = points[order[i], a]
        cut = _middle(keys, size) - 1e-9 * widest
        for i in range(lo, hi):
            keys[i - lo] = points[order[i], a]
        below, above_touching, below_touching = _sides(
            ptr, neighbours, order, lo, hi, keys, cut, side
        )
        if below == 0 or below == size:
            continue
        score = min(above_touching, below_touching)
        if min(below, size - below) < 0.3 * size:
            score *= 2
        if best < 0 or score < best:
            best, axis, position = score, a, cut
    return axis, position


@compiled
def _dissect(
    ptr: IntArray, neighbours: IntArray, points: FloatArray, ending: np.ndarray, leaf: int
) -> tuple[IntArray, IntArray, IntArray]:
    """Points in their order; first place and parent of each supernode, not yet sorted."""
    n = len(ending)
    order, side, keys = np.empty(n, np.int64), np.full(n, -1, np.int64), np.empty(n)
    upper = np.empty(n, np.int64)
    start, parent = np.empty(2 * n + 2, np.int64), np.empty(2 * n + 2, np.int64)
    stack = np.empty((2 * n + 2, 3), np.int64)
    count, depth, m, end = 0, 1, 0, n
    # those that shall come last make the root
    for i in range(n):
        if ending[i]:
            end -= 1
            order[end] = i
        else:
            order[m] = i
            m += 1
    if m < n:
        start[0], parent[0], count = m, -1, 1
    stack[0, 0], stack[0, 1], stack[0, 2] = 0, m, count - 1
    while depth > 0:
        depth -= 1
        lo, hi, above = stack[depth, 0], stack[depth, 1], stack[depth, 2]
        if hi <= lo:
            continue
        axis, cut = -1, 0.0
        if hi - lo > leaf:
            axis, cut = _best_cut(ptr, neighbours, points, order, lo, hi, keys, side)
        # few points, or none that a cut would part: a leaf
        if axis < 0:
            for i in range(lo, hi):
                side[order[i]] = -1
            start[count], parent[count] = lo, above
            count += 1
            continue
        # the smaller of both borders of the cut separates its sides
        for i in range(lo, hi):
            keys[i - lo] = points[order[i], axis]
        _, high, low = _sides(ptr, neighbours, order, lo, hi, keys, cut, side)
        separating = 2 if high <= low else 3
        # order: lower side, upper side, what separates them
        a, b, c = lo, 0, 0
        for i in range(lo, hi):
            v = order[i]
            s = side[v]
            side[v] = -1
            if s == separating:
                c += 1
                upper[hi - lo - c] = v
            elif s == 0 or s == 3:
                order[a] = v
                a += 1
            else:
                upper[b] = v
                b += 1
        for i in range(b):
            order[a + i] = upper[i]
        for i in range(c):
            order[hi - c + i] = upper[hi - lo - c + i]
        # a supernode of it, then both sides by turns
        if c > 0:
            start[count], parent[count] = hi - c, above
            above = count
            count += 1
        stack[depth, 0], stack[depth, 1], stack[depth, 2] = lo, a, above
        stack[depth + 1, 0], stack[depth + 1, 1], stack[depth + 1, 2] = a, hi - c, above
        depth += 2
    return order, start[:count], parent[:count]
