"""Symmetric matrices in blocks of few singular vectors, as compliances of bodies are.

What is far away is smooth: rows are put in clusters of near places, and blocks of two clusters have
few singular values that count (Amestoy et al. 2015, 10.1137/120903476).
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import SINGLE, FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled_threaded
from ssilang.kernel.base.scientific import la, spatial

CLUSTER = 192  # rows, at most but for those of one place


class LowRank(NamedTuple):
    """Blocks of the lower triangle, row by row; of no matrix if there are no values."""

    order: IntArray  # (n,) rows of the matrix, those of a cluster one after another
    first: IntArray  # (c + 1,) where clusters begin in it
    ranks: IntArray  # (c (c + 1) / 2, 2) vectors of each block: a few, all; 0, -1: it is whole
    values: FloatArray  # whole blocks, or pairs of columns and rows


NONE = LowRank(
    np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2), np.int64), np.zeros(0, SINGLE)
)  # fmt: skip


def low_rank(A: FloatArray, places: FloatArray, few: float, least: float) -> LowRank:
    """A symmetric matrix (n d, n d) whose rows belong to places (n, dimension), d to each.

    Blocks have its precision; `few` and `least` are norms of what few and all vectors leave out.
    """
    n, d = len(places), len(A) // len(places)
    clusters = 1 << max(0, int(np.ceil(np.log2(n * d / CLUSTER))))
    near = spatial.cKDTree(places, leafsize=1).indices
    parts = [(d * p[:, None] + np.arange(d)).ravel() for p in np.array_split(near, clusters)]
    few, least = few / np.sqrt(clusters), least / np.sqrt(clusters)  # a row's blocks add up
    ranks, values = list[tuple[int, int]](), list[FloatArray]()
    for i, rows in enumerate(parts):
        for columns in parts[: i + 1]:
            block = A[np.ix_(rows, columns)]
            U, s, V = la.svd(block, full_matrices=False)
            left = np.sqrt(np.cumsum(s[::-1] ** 2))[::-1]
            count = int((left > least).sum())
            whole = rows is columns or count * sum(block.shape) > block.size
            ranks.append((0, -1) if whole else (int((left > few).sum()), count))
            pairs = np.hstack([(U * s).T, V])[:count]
            values.append((block if whole else pairs).ravel())
    first = np.cumsum([0, *map(len, parts)])
    return LowRank(np.concatenate(parts), first, np.array(ranks), np.concatenate(values))


@seldom
@compiled_threaded
def add_low_rank_product(A: LowRank, few: bool, x: FloatArray, y: FloatArray) -> None:
    """y += A x in the precision of x, by few vectors of each block or by all.

    Several x and y (c n,) stand one after another: each block is read once for all of them.
    """
    size, block, at, zero = len(A.order), 0, 0, x.dtype.type(0.0)
    xs = x.reshape((-1, size))[:, A.order]
    ys = np.zeros(xs.shape, x.dtype)
    for i in range(len(A.first) - 1):
        i0, n = A.first[i], A.first[i + 1] - A.first[i]
        for j in range(i + 1):
            j0, m, count = A.first[j], A.first[j + 1] - A.first[j], A.ranks[block, 1]
            for k in range(i0, i0 + n if count < 0 else i0):
                row = A.values[at : at + m]
                for c in range(len(xs)):
                    xj, yj = xs[c, j0 : j0 + m], ys[c, j0 : j0 + m]
                    x_k, y_k = xs[c, k] if i != j else zero, zero
                    for e in range(m):
                        y_k += row[e] * xj[e]
                        yj[e] += row[e] * x_k
                    ys[c, k] += y_k
                at += m
            after = at + max(count, 0) * (n + m)
            for _ in range(A.ranks[block, 0] if few else count):
                u, v = A.values[at : at + n], A.values[at + n : at + n + m]
                for c in range(len(xs)):
                    xi, yi = xs[c, i0 : i0 + n], ys[c, i0 : i0 + n]
                    xj, yj = xs[c, j0 : j0 + m], ys[c, j0 : j0 + m]
                    s, t = zero, zero
                    for e in range(n):
                        s += u[e] * xi[e]
                    for e in range(m):
                        t += v[e] * xj[e]
                    for e in range(n):
                        yi[e] += u[e] * t
                    for e in range(m):
                        yj[e] += v[e] * s
                at += n + m
            at, block = after, block + 1
    for c in range(len(xs)):
        for i in range(size):
            y[c * size + A.order[i]] += ys[c, i]
