"""Products of matrices by groups: `A P` and `P^T (A P)`, the columns of P in runs of k."""

from functools import partial

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.compiled.compiler import compiled, compiled_threaded
from ssilang.kernel.base.threads import in_parts
from ssilang.kernel.solvers.multigrid.rows import Diagonal, Index, Real, Rows, empty_rows


def product(A: Rows, P: Rows, k: int, count: int) -> Rows:
    """`A P`; `count` runs of k columns in P."""
    group = np.repeat(np.arange(len(P.first) - 1, dtype=np.int32), np.diff(P.first))
    widths = np.zeros(len(A.first), np.int64)

    def number(low: int, high: int) -> None:
        _count_runs(A, group, P, k, np.full(count, -1), widths, low, high)

    in_parts(number, A.at)
    made = empty_rows(A.first, np.cumsum(widths), A.values.dtype)

    def fill(low: int, high: int) -> None:
        places, local = np.full((2, count), -1), np.empty(P.width, A.values.dtype)
        _multiply(A, group, P, k, places, local, made, low, high)

    in_parts(fill, A.at)
    return made


@compiled_threaded
def _count_runs(
    A: Rows, group: Index, P: Rows, k: int, seen: IntArray, widths: IntArray, low: int,
    high: int,
) -> None:  # fmt: skip
    for g in range(low, high):
        total, last = 0, -1
        for q in range(A.ptr[g], A.ptr[g + 1]):
            h = group[A.columns[q]]
            if h == last:
                continue
            last = h
            for s in range(P.ptr[h], P.ptr[h + 1], k):
                run = P.columns[s] // k
                if seen[run] != g:
                    seen[run] = g
                    total += k
        widths[g + 1] = total


@compiled_threaded
def _place_runs(columns: Index, k: int, row: int, places: IntArray, used: int, to: Index) -> int:
    """Give the runs of some columns their places in a row, behind `used` others; how many now."""
    for s in range(0, len(columns), k):
        run = columns[s] // k
        if places[0, run] != row:
            places[0, run], places[1, run] = row, used
            for c in range(k):
                to[used + c] = run * k + c
            used += k
    return used


@compiled_threaded
def _add_runs(local: Real, columns: Index, k: int, places: IntArray, to: Real) -> None:
    """Add values to their places in a row."""
    for s in range(0, len(columns), k):
        own = to[places[1, columns[s] // k] :]
        part = local[s:]
        for c in range(k):
            own[c] += part[c]


@compiled_threaded
def _add_times(factor: float, row: Real, to: Real) -> None:
    for c in range(len(row)):
        to[c] += factor * row[c]


@compiled_threaded
def _multiply(
    A: Rows, group: Index, P: Rows, k: int, places: IntArray, local: Real, to: Rows, low: int,
    high: int,
) -> None:  # fmt: skip
    """Values and columns of groups low to high."""
    for g in range(low, high):
        begin, width, own = A.ptr[g], A.ptr[g + 1] - A.ptr[g], to.ptr[g + 1] - to.ptr[g]
        named = to.columns[to.ptr[g] : to.ptr[g + 1]]
        q, used = 0, 0
        while q < width:
            # the columns q to end are unknowns of the group h of P
            h, end = group[A.columns[begin + q]], q + 1
            while end < width and group[A.columns[begin + end]] == h:
                end += 1
            runs = P.columns[P.ptr[h] : P.ptr[h + 1]]
            used = _place_runs(runs, k, g, places, used, named)
            n = len(runs)
            for r in range(A.first[g + 1] - A.first[g]):
                for c in range(n):
                    local[c] = 0
                for j in range(q, end):
                    base = P.at[h] + (A.columns[begin + j] - P.first[h]) * n
                    _add_times(A.values[A.at[g] + r * width + j], P.values[base : base + n], local)
                base = to.at[g] + r * own
                _add_runs(local, runs, k, places, to.values[base : base + own])
            q = end


@compiled_threaded
def _smooth(
    P: Rows, start: Rows, inverse: Real, at: IntArray, omega: float, rest: Real, low: int,
    high: int,
) -> None:  # fmt: skip
    """`P = start - omega D^-1 P` in place; the columns of `start` are among those of P."""
    for g in range(low, high):
        size, width = P.first[g + 1] - P.first[g], P.ptr[g + 1] - P.ptr[g]
        for q in range(width):
            for i in range(size):
                rest[i] = P.values[P.at[g] + i * width + q]
            for i in range(size):
                total = P.values.dtype.type(0)
                for j in range(size):
                    total += inverse[at[g] + i * size + j] * rest[j]
                P.values[P.at[g] + i * width + q] = -omega * total
        own = start.ptr[g + 1] - start.ptr[g]
        for q in range(width):
            for s in range(own):
                if start.columns[start.ptr[g] + s] == P.columns[P.ptr[g] + q]:
                    for i in range(size):
                        P.values[P.at[g] + i * width + q] += start.values[start.at[g] + i * own + s]


def smoothed(A: Rows, D: Diagonal, start: Rows, k: int, count: int, omega: float) -> Rows:
    """`(1 - omega D^-1 A) start`."""
    P = product(A, start, k, count)
    kind = A.values.dtype.type

    def part(low: int, high: int) -> None:
        _smooth(P, start, D.inverse, D.at, kind(omega), np.empty(P.height, kind), low, high)

    in_parts(part, P.at)
    return P


class Backwards:
    """The runs of each column of P: from `ptr` (count + 1,) on the groups, and where in them."""

    def __init__(self, P: Rows, k: int, count: int) -> None:
        runs = P.columns[::k] // k
        self.ptr = np.concatenate([[0], np.cumsum(np.bincount(runs, minlength=count))])
        self.groups = np.zeros(len(runs), np.int32)
        self.places = np.zeros(len(runs), np.int32)
        _turn(P, k, self.ptr[:-1].copy(), self.groups, self.places)


@compiled
def _turn(P: Rows, k: int, at: IntArray, groups: Index, places: Index) -> None:
    for g in range(len(P.first) - 1):
        for s in range(P.ptr[g], P.ptr[g + 1], k):
            run = P.columns[s] // k
            groups[at[run]], places[at[run]] = g, s - P.ptr[g]
            at[run] += 1


def galerkin(P: Rows, back: Backwards, AP: Rows, k: int) -> Rows:
    """`P^T (A P)` by groups of k."""
    count = len(back.ptr) - 1
    first = np.arange(0, k * count + 1, k, dtype=np.int64)
    widths, work = np.zeros(count + 1, np.int64), back.ptr * (10 * k * k)

    def number(low: int, high: int) -> None:
        _count_coarse(back.ptr, back.groups, AP, k, np.full(count, -1), widths, low, high)

    in_parts(number, work)
    made = empty_rows(first, np.cumsum(widths), P.values.dtype)

    def fill(low: int, high: int) -> None:
        places, local = np.full((2, count), -1), np.empty(AP.width, P.values.dtype)
        _gather(P, back.ptr, back.groups, back.places, AP, k, places, local, made, low, high)

    in_parts(fill, work)
    return made


@compiled_threaded
def _count_coarse(
    ptr: IntArray, groups: Index, AP: Rows, k: int, seen: IntArray, widths: IntArray, low: int,
    high: int,
) -> None:  # fmt: skip
    for a in range(low, high):
        total = 0
        for p in range(ptr[a], ptr[a + 1]):
            g = groups[p]
            for s in range(AP.ptr[g], AP.ptr[g + 1], k):
                run = AP.columns[s] // k
                if seen[run] != a:
                    seen[run] = a
                    total += k
        widths[a + 1] = total


@compiled_threaded
def _gather(
    P: Rows, ptr: IntArray, groups: Index, starts: Index, AP: Rows, k: int,
    places: IntArray, local: Real, to: Rows, low: int, high: int,
) -> None:  # fmt: skip
    for a in range(low, high):
        own, used = to.ptr[a + 1] - to.ptr[a], 0
        named = to.columns[to.ptr[a] : to.ptr[a + 1]]
        for p in range(ptr[a], ptr[a + 1]):
            g = groups[p]
            width, runs = P.ptr[g + 1] - P.ptr[g], AP.columns[AP.ptr[g] : AP.ptr[g + 1]]
            n = len(runs)
            used = _place_runs(runs, k, a, places, used, named)
            for e in range(k):
                for c in range(n):
                    local[c] = 0
                for r in range(P.first[g + 1] - P.first[g]):
                    base = AP.at[g] + r * n
                    value = P.values[P.at[g] + r * width + starts[p] + e]
                    _add_times(value, AP.values[base : base + n], local)
                base = to.at[a] + e * own
                _add_runs(local, runs, k, places, to.values[base : base + own])


def restricted(P: Rows, back: Backwards, r: Real, k: int) -> Real:
    """`P^T r`."""
    out = np.zeros(k * (len(back.ptr) - 1), r.dtype)
    work = back.ptr * (3 * k)
    in_parts(partial(_restrict, P, back.ptr, back.groups, back.places, r, k, out), work)
    return out


@compiled_threaded
def _restrict(
    P: Rows, ptr: IntArray, groups: Index, places: Index, r: Real, k: int, out: Real,
    low: int, high: int,
) -> None:  # fmt: skip
    for a in range(low, high):
        own = out[a * k : (a + 1) * k]
        for p in range(ptr[a], ptr[a + 1]):
            g = groups[p]
            width, base = P.ptr[g + 1] - P.ptr[g], P.at[g] + places[p]
            for i in range(P.first[g], P.first[g + 1]):
                _add_times(r[i], P.values[base : base + k], own)
                base += width
