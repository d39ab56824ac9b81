"""Nested dissection: an elimination order with little fill-in, as a tree of supernodes.

The unknowns of a point stay together. A set of points is cut at the middle of one of the axes;
the points of one half that touch the other are its separator, numbered behind both halves, which
are cut in turn (George 1973). Each separator and each part too small to be cut is a supernode.

All parts of a level are cut together by numpy, so that nothing waits to be compiled.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
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
    links = _links(A, group, len(member))
    sequence, start, parent = _dissect(links, points[member].astype(float), ending[member])
    by = np.argsort(start, kind="stable")
    renumbered = np.full(len(by) + 1, -1, np.int64)
    renumbered[by] = np.arange(len(by))
    place = np.empty(len(member), np.int64)
    place[sequence] = np.arange(len(member))
    sizes = np.bincount(group, minlength=len(member))[sequence]
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    first = np.concatenate([offsets[start[by]], [n]]).astype(np.int64)
    return Tree(np.argsort(place[group], kind="stable"), first, renumbered[parent[by]])


Links = tuple[IntArray, IntArray]
"""Both ends of each link."""


def _links(A: sp.csr_array, group: IntArray, count: int) -> Links:
    """Groups of unknowns that A links, each pair once."""
    n = A.shape[0]
    members = sp.csr_array((np.ones(n, np.float32), (np.arange(n), group)), shape=(n, count))
    pattern = sp.csr_array((np.ones(A.nnz, np.float32), A.indices, A.indptr), shape=A.shape)
    graph = sp.csr_array(members.T @ pattern @ members)
    ends = sp.triu(graph + graph.T, 1, format="coo").coords
    return ends[0].astype(np.int64), ends[1].astype(np.int64)


class _Parts(NamedTuple):
    """Parts of one level: first place, number of points, supernode that separated it from others.

    All are arrays (m,).
    """

    start: IntArray
    size: IntArray
    above: IntArray

    def only(self, chosen: BoolArray) -> _Parts:
        return _Parts(*(x[chosen] for x in self))

    def and_these(self, others: _Parts) -> _Parts:
        return _Parts(*map(np.append, self, others))


class _Points(NamedTuple):
    """Points of the parts of one level, part after part.

    Attributes
    ----------
    of : array (n,)
        Their numbers.
    first : array (m,)
        Place of the first point of each part.
    part : array (n,)
    links : Links
        Numbers of points that are linked, both of one part.
    """

    of: IntArray
    first: IntArray
    part: IntArray
    links: Links

    def numbers(self, chosen: BoolArray) -> IntArray:
        """How many chosen points are in each part."""
        return np.bincount(self.part[chosen], minlength=len(self.first))


BELOW, ABOVE, BETWEEN = range(3)
"""Kinds of points at a cut."""


class _Coordinate(NamedTuple):
    """One coordinate of all points: values that differ, and the place of each point's among them.

    `x` are those of the points, in their order.
    """

    x: FloatArray
    values: FloatArray
    ranks: IntArray


def _dissect(
    links: Links, points: FloatArray, ending: BoolArray
) -> tuple[IntArray, IntArray, IntArray]:
    """Points in their order; first place and parent of each supernode, not yet sorted."""
    n, m = len(ending), int(np.count_nonzero(~ending))
    # those that shall come last make the root
    order = np.concatenate([np.flatnonzero(~ending), np.flatnonzero(ending)[::-1]])
    root = [m] if m < n else []
    start, parent = np.array(root, np.int64), np.full(len(root), -1)
    parts = _Parts(*(np.array([x]) for x in (0, m, len(root) - 1))).only(np.array([m > 0]))
    axes = [_Coordinate(x, *np.unique(x, return_inverse=True)) for x in points.T.copy()]
    part_of = np.empty(n, np.int64)
    while len(parts.start):
        # parts of few points are leaves
        leaves, parts = parts.only(parts.size <= LEAF), parts.only(parts.size > LEAF)
        part = np.repeat(np.arange(len(parts.start)), parts.size)
        first = np.cumsum(parts.size) - parts.size
        place = np.arange(len(part)) + (parts.start - first)[part]
        here = order[place]
        part_of[:] = -1
        part_of[here] = part
        links = _inside(links, part_of)
        known = _Points(here, first, part, links)
        kind, cut = _best_cuts(known, parts.size, axes)
        # and those that no cut would part
        leaves, kept = leaves.and_these(parts.only(~cut)), cut[part]
        below, above, between = (known.numbers(kept & (kind == k)) for k in range(3))
        order[place[kept]] = here[_sorted(known, kind)][kept]
        start, parent = np.append(start, leaves.start), np.append(parent, leaves.above)
        # a supernode of the points between, then both sides
        made, upper, end = between > 0, parts.start + below, parts.start + below + above
        separated = np.where(made, len(start) - 1 + np.cumsum(made), parts.above)
        start, parent = np.append(start, end[made]), np.append(parent, parts.above[made])
        parts = _Parts(parts.start, below, separated).and_these(_Parts(upper, above, separated))
        parts = parts.only(parts.size > 0)
    return order, start, parent


def _inside(links: Links, part_of: IntArray) -> Links:
    """Links whose ends are of one part."""
    one, other = part_of[links[0]], part_of[links[1]]
    kept = (one == other) & (one >= 0)
    return links[0][kept], links[1][kept]


def _best_cuts(
    points: _Points, size: IntArray, axes: list[_Coordinate]
) -> tuple[IntArray, BoolArray]:
    """Kind of each point at the cut of its part that the fewest separate; which parts are cut."""
    best, kinds = np.full(len(size), -1), np.zeros(len(points.of), np.int64)
    if not len(size):
        return kinds, best >= 0
    spans = np.array([_spans(axis.x[points.of], points.first) for axis in axes])
    widest = spans.max(axis=0)
    for axis, span in zip(axes, spans, strict=True):
        cut = _middles(points, axis, size) - 1e-9 * widest
        upper = axis.x[points.of] >= cut[points.part]
        touching = _touching(points, upper, len(axis.x))
        below = points.numbers(~upper)
        above_touching, below_touching = (points.numbers(touching & u) for u in (upper, ~upper))
        score = np.minimum(above_touching, below_touching)
        score[np.minimum(below, size - below) < 0.3 * size] *= 2
        # the smaller of both borders of the cut separates its sides
        border = touching & (upper == (above_touching <= below_touching)[points.part])
        better = (span > 0.0) & (span >= THIN * widest) & (below > 0) & (below < size)
        better &= (best < 0) | (score < best)
        best[better] = score[better]
        kind = np.where(border, BETWEEN, np.where(upper, ABOVE, BELOW))
        kinds = np.where(better[points.part], kind, kinds)
    return kinds, best >= 0


def _spans(x: FloatArray, first: IntArray) -> FloatArray:
    return np.maximum.reduceat(x, first) - np.minimum.reduceat(x, first)


def _middles(points: _Points, axis: _Coordinate, size: IntArray) -> FloatArray:
    """Coordinate of each part that half of its points have before it."""
    many = len(axis.values)
    ordered = np.sort(points.part * many + axis.ranks[points.of])
    return axis.values[ordered[points.first + size // 2] % many]


def _touching(points: _Points, upper: BoolArray, n: int) -> BoolArray:
    """Which points of a side are linked to the other; n is the number of all points."""
    side, touching = np.empty(n, bool), np.zeros(n, bool)
    side[points.of] = upper
    one, other = points.links
    crossing = np.flatnonzero(side[one] != side[other])
    touching[one[crossing]] = touching[other[crossing]] = True
    return touching[points.of]


def _sorted(points: _Points, kind: IntArray) -> IntArray:
    """Points below the cut of each part, those above, then those between, from their end."""
    n = len(kind)
    number = np.arange(n)
    number[kind == BETWEEN] = n - 1 - number[kind == BETWEEN]
    return np.argsort((3 * points.part + kind) * n + number)
