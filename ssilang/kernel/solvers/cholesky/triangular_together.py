"""Solves of `triangular` for several vectors: each panel is read once for all, four at a time."""

from __future__ import annotations

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.solvers.cholesky.multifrontal import WIDTH, Panels
from ssilang.kernel.solvers.cholesky.triangular import backward, forward

FOUR = 4


@compiled_fast
def _times_lower(values: FloatArray, pos: int, b: FloatArray, k0: int, k1: int) -> None:
    """As `panel_products.times_lower`, on the columns k0 to k1 of four vectors."""
    w = k1 - k0
    b0, b1, b2, b3 = b[0, k0:k1], b[1, k0:k1], b[2, k0:k1], b[3, k0:k1]
    for i in range(w - 1, -1, -1):
        t0, t1, t2, t3 = 0.0, 0.0, 0.0, 0.0
        row = values[pos + i * w : pos + i * w + i + 1]
        for e in range(i + 1):
            t0 += row[e] * b0[e]
            t1 += row[e] * b1[e]
            t2 += row[e] * b2[e]
            t3 += row[e] * b3[e]
        b0[i], b1[i], b2[i], b3[i] = t0, t1, t2, t3


@compiled_fast
def _times_upper(values: FloatArray, pos: int, b: FloatArray, k0: int, k1: int) -> None:
    """As `panel_products.times_upper`, on the columns k0 to k1 of four vectors."""
    w = k1 - k0
    b0, b1, b2, b3 = b[0, k0:k1], b[1, k0:k1], b[2, k0:k1], b[3, k0:k1]
    for i in range(w):
        t0, t1, t2, t3 = b0[i], b1[i], b2[i], b3[i]
        row = values[pos + i * w : pos + i * w + i + 1]
        b0[i], b1[i], b2[i], b3[i] = 0.0, 0.0, 0.0, 0.0
        for e in range(i + 1):
            b0[e] += row[e] * t0
            b1[e] += row[e] * t1
            b2[e] += row[e] * t2
            b3[e] += row[e] * t3


@compiled_fast
def _subtract(values: FloatArray, pos: int, x: FloatArray, k0: int, k1: int, m: int) -> None:
    """x[k1:m] -= P^T x[k0:k1] for four vectors."""
    y0, y1, y2, y3 = x[0, k1:m], x[1, k1:m], x[2, k1:m], x[3, k1:m]
    n, j = m - k1, k0
    while j + 3 < k1:
        p0, p1 = values[pos : pos + n], values[pos + n : pos + 2 * n]
        p2, p3 = values[pos + 2 * n : pos + 3 * n], values[pos + 3 * n : pos + 4 * n]
        a0, a1, a2, a3 = x[0, j], x[0, j + 1], x[0, j + 2], x[0, j + 3]
        b0, b1, b2, b3 = x[1, j], x[1, j + 1], x[1, j + 2], x[1, j + 3]
        c0, c1, c2, c3 = x[2, j], x[2, j + 1], x[2, j + 2], x[2, j + 3]
        d0, d1, d2, d3 = x[3, j], x[3, j + 1], x[3, j + 2], x[3, j + 3]
        for i in range(n):
            e0, e1, e2, e3 = p0[i], p1[i], p2[i], p3[i]
            y0[i] -= e0 * a0 + e1 * a1 + e2 * a2 + e3 * a3
            y1[i] -= e0 * b0 + e1 * b1 + e2 * b2 + e3 * b3
            y2[i] -= e0 * c0 + e1 * c1 + e2 * c2 + e3 * c3
            y3[i] -= e0 * d0 + e1 * d1 + e2 * d2 + e3 * d3
        pos += 4 * n
        j += 4
    while j < k1:
        p0 = values[pos : pos + n]
        a0, b0, c0, d0 = x[0, j], x[1, j], x[2, j], x[3, j]
        for i in range(n):
            e0 = p0[i]
            y0[i] -= e0 * a0
            y1[i] -= e0 * b0
            y2[i] -= e0 * c0
            y3[i] -= e0 * d0
        pos += n
        j += 1


@compiled_fast
def _take_off(x: FloatArray, j: int, a: float, b: float, c: float, d: float) -> None:
    x[j] -= a
    x[j + 1] -= b
    x[j + 2] -= c
    x[j + 3] -= d


@compiled_fast
def _subtract_transposed(
    values: FloatArray, pos: int, x: FloatArray, k0: int, k1: int, m: int
) -> None:
    """x[k0:k1] -= P x[k1:m] for four vectors."""
    y0, y1, y2, y3 = x[0, k1:m], x[1, k1:m], x[2, k1:m], x[3, k1:m]
    n, j = m - k1, k0
    # four columns of P with four vectors: sixteen sums that stay in registers
    while j + 3 < k1:
        p0, p1 = values[pos : pos + n], values[pos + n : pos + 2 * n]
        p2, p3 = values[pos + 2 * n : pos + 3 * n], values[pos + 3 * n : pos + 4 * n]
        a0, a1, a2, a3, b0, b1, b2, b3 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        c0, c1, c2, c3, d0, d1, d2, d3 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for i in range(n):
            e0, e1, e2, e3 = p0[i], p1[i], p2[i], p3[i]
            f0, f1, f2, f3 = y0[i], y1[i], y2[i], y3[i]
            a0 += e0 * f0
            a1 += e1 * f0
            a2 += e2 * f0
            a3 += e3 * f0
            b0 += e0 * f1
            b1 += e1 * f1
            b2 += e2 * f1
            b3 += e3 * f1
            c0 += e0 * f2
            c1 += e1 * f2
            c2 += e2 * f2
            c3 += e3 * f2
            d0 += e0 * f3
            d1 += e1 * f3
            d2 += e2 * f3
            d3 += e3 * f3
        _take_off(x[0], j, a0, a1, a2, a3)
        _take_off(x[1], j, b0, b1, b2, b3)
        _take_off(x[2], j, c0, c1, c2, c3)
        _take_off(x[3], j, d0, d1, d2, d3)
        pos += 4 * n
        j += 4
    # columns left over, one by one
    while j < k1:
        p0 = values[pos : pos + n]
        s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
        for i in range(n):
            s0 += p0[i] * y0[i]
            s1 += p0[i] * y1[i]
            s2 += p0[i] * y2[i]
            s3 += p0[i] * y3[i]
        x[0, j] -= s0
        x[1, j] -= s1
        x[2, j] -= s2
        x[3, j] -= s3
        pos += n
        j += 1


@compiled_fast
def _forward_four(
    L: Panels, s: int, x: FloatArray, beyond: int, sums: FloatArray, local: FloatArray
) -> None:
    c0, k, low = L.first[s], L.first[s + 1] - L.first[s], L.ptr[s]
    below = L.ptr[s + 1] - low
    m, pos = k + below, L.at[s]
    for v in range(FOUR):
        for i in range(k):
            local[v, i] = x[v, c0 + i]
        for i in range(k, m):
            local[v, i] = 0.0
    for k0 in range(0, k, WIDTH):
        k1 = min(k0 + WIDTH, k)
        w = k1 - k0
        _times_lower(L.values, pos, local, k0, k1)
        _subtract(L.values, pos + w * w, local, k0, k1, m)
        pos += w * (m - k0)
    cut = low
    while cut < L.ptr[s + 1] and L.rows[cut] < beyond:
        cut += 1
    for v in range(FOUR):
        for i in range(k):
            x[v, c0 + i] = local[v, i]
    _add_rows(L.rows[low:cut], local[:, k:m], x)
    _add_rows(L.rows[cut : low + below], local[:, k + cut - low : m], sums)


@compiled_fast
def _add_rows(rows: IntArray, parts: FloatArray, x: FloatArray) -> None:
    """x[rows] += parts for four vectors."""
    x0, x1, x2, x3 = x[0], x[1], x[2], x[3]
    p0, p1, p2, p3 = parts[0], parts[1], parts[2], parts[3]
    for i in range(len(rows)):
        row = rows[i]
        x0[row] += p0[i]
        x1[row] += p1[i]
        x2[row] += p2[i]
        x3[row] += p3[i]


@compiled_fast
def _take_rows(rows: IntArray, x: FloatArray, parts: FloatArray) -> None:
    """parts = x[rows] of four vectors."""
    x0, x1, x2, x3 = x[0], x[1], x[2], x[3]
    p0, p1, p2, p3 = parts[0], parts[1], parts[2], parts[3]
    for i in range(len(rows)):
        row = rows[i]
        p0[i], p1[i], p2[i], p3[i] = x0[row], x1[row], x2[row], x3[row]


@compiled_fast
def _backward_four(L: Panels, s: int, z: FloatArray, x: FloatArray, local: FloatArray) -> None:
    c0, k, low = L.first[s], L.first[s + 1] - L.first[s], L.ptr[s]
    below = L.ptr[s + 1] - low
    m, pos = k + below, L.at[s + 1]
    for v in range(FOUR):
        for i in range(k):
            local[v, i] = z[v, c0 + i]
    _take_rows(L.rows[low : low + below], x, local[:, k:m])
    k1 = k
    while k1 > 0:
        w = k1 % WIDTH
        if w == 0:
            w = WIDTH
        k0 = k1 - w
        pos -= w * (m - k0)
        _subtract_transposed(L.values, pos + w * w, local, k0, k1, m)
        _times_upper(L.values, pos, local, k0, k1)
        k1 = k0
    for v in range(FOUR):
        for i in range(k):
            x[v, c0 + i] = local[v, i]


@compiled_fast
def forward_many(
    L: Panels, begin: int, end: int, x: FloatArray, beyond: int, sums: FloatArray,
    local: FloatArray,
) -> None:  # fmt: skip
    """As `triangular.forward` on vectors x (count, n), sums (count, n); `local` (4, room)."""
    count = len(x)
    fours = count // FOUR * FOUR
    for s in range(begin, end):
        for v in range(0, fours, FOUR):
            _forward_four(L, s, x[v : v + FOUR], beyond, sums[v : v + FOUR], local)
        for v in range(fours, count):
            forward(L, s, s + 1, x[v], beyond, sums[v], local[0])


@compiled_fast
def backward_many(
    L: Panels, begin: int, end: int, z: FloatArray, x: FloatArray, local: FloatArray
) -> None:
    """As `triangular.backward` on vectors z, x (count, n); `local` (4, room)."""
    count = len(x)
    fours = count // FOUR * FOUR
    for s in range(end - 1, begin - 1, -1):
        for v in range(0, fours, FOUR):
            _backward_four(L, s, z[v : v + FOUR], x[v : v + FOUR], local)
        for v in range(fours, count):
            backward(L, s, s + 1, z[v], x[v], local[0])
