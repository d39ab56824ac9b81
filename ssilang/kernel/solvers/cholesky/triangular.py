"""Solves with the panels of `multifrontal`: forward and backward over a range of supernodes."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast, compiled_threaded
from ssilang.kernel.solvers.cholesky.multifrontal import WIDTH, Panels
from ssilang.kernel.solvers.cholesky.panel_products import (
    subtract,
    subtract_transposed,
    times_lower,
    times_upper,
)

TOGETHER = 16  # panels whose block has an inverse of its own: more are read twice


@apart
@compiled_fast
def forward(
    L: Panels, begin: int, end: int, x: FloatArray, beyond: int, sums: FloatArray,
    local: FloatArray,
) -> None:  # fmt: skip
    """x = L^-1 x on the supernodes begin to end; rows from `beyond` on are added to `sums`.

    `local` is room for the rows of one supernode.
    """
    for s in range(begin, end):
        c0, k, low = L.first[s], L.first[s + 1] - L.first[s], L.ptr[s]
        below = L.ptr[s + 1] - low
        m, pos = k + below, L.at[s]
        for i in range(k):
            local[i] = x[c0 + i]
        for i in range(k, m):
            local[i] = 0.0
        for k0 in range(0, k, WIDTH):
            k1 = min(k0 + WIDTH, k)
            w = k1 - k0
            times_lower(L.values, pos, w, local, k0)
            subtract(L.values, pos + w * w, w, m - k1, local, k0, k1)
            pos += w * (m - k0)
        for i in range(k):
            x[c0 + i] = local[i]
        for i in range(below):
            row = L.rows[low + i]
            if row < beyond:
                x[row] += local[k + i]
            else:
                sums[row] += local[k + i]


@apart
@compiled_fast
def backward(
    L: Panels, begin: int, end: int, z: FloatArray, x: FloatArray, local: FloatArray
) -> None:
    """x = L^-T z on the supernodes begin to end, x being known on the rows below them."""
    for s in range(end - 1, begin - 1, -1):
        c0, k, low = L.first[s], L.first[s + 1] - L.first[s], L.ptr[s]
        below = L.ptr[s + 1] - low
        m, pos = k + below, L.at[s + 1]
        for i in range(k):
            local[i] = z[c0 + i]
        for i in range(below):
            local[k + i] = x[L.rows[low + i]]
        k1 = k
        while k1 > 0:
            w = k1 % WIDTH
            if w == 0:
                w = WIDTH
            k0 = k1 - w
            pos -= w * (m - k0)
            subtract_transposed(L.values, pos + w * w, w, m - k1, local, k0, k1)
            times_upper(L.values, pos, w, local, k0)
            k1 = k0
        for i in range(k):
            x[c0 + i] = local[i]


@compiled
def forward_runs(L: Panels, runs: IntArray, x: FloatArray, local: FloatArray) -> None:
    """`forward` on some supernodes, `runs` (k, 2) of them in a row, with all above them."""
    n = len(x)
    for i in range(len(runs)):
        forward(L, runs[i, 0], runs[i, 1], x, n, x, local)


@compiled
def backward_runs(L: Panels, runs: IntArray, x: FloatArray, local: FloatArray) -> None:
    """`backward` in place on some supernodes, `runs` (k, 2) of them in a row."""
    for i in range(len(runs) - 1, -1, -1):
        backward(L, runs[i, 0], runs[i, 1], x, x, local)


@compiled
def solve_column(L: Panels, b: FloatArray, local: FloatArray) -> None:
    """b = (L L^T)^-1 b."""
    count, n, start = len(L.first) - 1, len(b), L.first[0]  # not 0: a literal is a type of its own
    forward(L, start, count, b, n, b, local)
    backward(L, start, count, b, b, local)


def solve_columns(L: Panels, b: FloatArray, begin: int, end: int, missing: int = 0) -> None:
    """b = (L L^T)^-1 b for many columns b, on the supernodes begin to end, by BLAS.

    `b` (n - missing, k) lacks its first rows, those before the supernode `begin`. Rows below a
    supernode are gathered once for all its panels.
    """
    for s in range(begin, end):
        own, below, panels = _panels(L, s, b, missing)
        under = b[below]
        for k0, k1, block, inside, P in panels:
            x = own[k0:k1] = block @ own[k0:k1]
            if k1 < len(own):
                own[k1:] -= inside.T @ x
            if len(below):
                under -= P.T @ x
        b[below] = under
    for s in range(end - 1, begin - 1, -1):
        own, below, panels = _panels(L, s, b, missing)
        under = b[below]
        for k0, k1, block, inside, P in reversed(panels):
            x = own[k0:k1]
            if k1 < len(own):
                x -= inside @ own[k1:]
            if len(below):
                x -= P @ under
            own[k0:k1] = block.T @ x


Panel = tuple[int, int, FloatArray, FloatArray, FloatArray]


def _panels(
    L: Panels, s: int, b: FloatArray, missing: int
) -> tuple[FloatArray, IntArray, list[Panel]]:
    """Rows of b that are a supernode's own, places of those below, and its panels.

    Of each: its first and last column, the inverse of its block (w, w), its rows (w, m) in the
    supernode and below.
    """
    c0, c1, pos = int(L.first[s]), int(L.first[s + 1]), int(L.at[s])
    below = L.rows[L.ptr[s] : L.ptr[s + 1]] - missing
    found = list[Panel]()
    for k0 in range(0, c1 - c0, WIDTH):
        k1 = min(k0 + WIDTH, c1 - c0)
        w, m = k1 - k0, c1 - c0 - k1 + len(below)
        block = L.values[pos : pos + w * w].reshape(w, w)
        P = L.values[pos + w * w : pos + w * (w + m)].reshape(w, m)
        inside = c1 - c0 - k1
        found.append((k0, k1, block, P[:, :inside], P[:, inside:]))
        pos += w * (w + m)
    return b[c0 - missing : c1 - missing], below, found


class Supernode(NamedTuple):
    """Columns of a factor with the same rows, for solves of very many columns."""

    begin: int
    end: int
    inverse: FloatArray  # (w, w) of their own block
    below: IntArray  # (m,) other rows
    P: FloatArray  # (w, m)


def supernodes(L: Panels, kind: Any) -> Iterator[Supernode]:
    """The supernodes of a factor in another precision, those of many panels in parts."""
    for s in range(len(L.first) - 1):
        begin, end = int(L.first[s]), int(L.first[s + 1])
        _, below, panels = _panels(L, s, np.zeros(0), 0)
        for first in range(0, len(panels), TOGETHER):
            part = panels[first : first + TOGETHER]
            start, stop = part[0][0], part[-1][1]
            inverse = np.eye(stop - start)
            for k0, k1, block, inside, _ in part:
                own, later = inverse[k0 - start : k1 - start], inverse[k1 - start :]
                own[:] = block @ own
                later -= inside[:, : len(later)].T @ own
            P = np.concatenate(
                [np.hstack([inside[:, stop - k1 :], P]) for _, k1, _, inside, P in part]
            )
            rows = np.concatenate([np.arange(begin + stop, end), below])
            yield Supernode(begin + start, begin + stop, inverse.astype(kind), rows, P.astype(kind))


def solve_together(L: Sequence[Supernode], b: FloatArray) -> None:
    """b = (L L^T)^-1 b for very many columns b (n, k)."""
    rows = [max(x) for x in zip(*(s.P.shape for s in L), strict=True)]
    room, under = (np.empty((n, b.shape[1]), b.dtype) for n in rows)
    for s in L:
        x = b[s.begin : s.end]
        x[:] = np.matmul(s.inverse, x, out=room[: len(x)])
        _subtract_rows(b, s.below, np.matmul(s.P.T, x, out=under[: len(s.below)]))
    for s in reversed(L):
        x = b[s.begin : s.end]
        below = np.take(b, s.below, axis=0, out=under[: len(s.below)], mode="clip")  # at once
        x -= np.matmul(s.P, below, out=room[: len(x)])
        x[:] = np.matmul(s.inverse.T, x, out=room[: len(x)])


@compiled_threaded
def _subtract_rows(b: FloatArray, rows: IntArray, what: FloatArray) -> None:
    """b[rows] -= what."""
    for i in range(len(rows)):
        row, less = b[rows[i]], what[i]
        for j in range(len(less)):
            row[j] -= less[j]


def longest(L: Panels) -> int:
    """Rows and columns of the largest supernode: the room that solves need."""
    return int((np.diff(L.first) + np.diff(L.ptr)).max(initial=1))
