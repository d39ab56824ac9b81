"""The active set of rows that only push, compiled: relations, and springs that only push.

With the jumps g that the rows would end with if none of them pushed, and their flexibility Q
(positive definite; a spring's own 1/k on its diagonal), forces f and jumps obey

    jumps = g - Q f ,   jumps >= 0 ,   f <= 0 ,   f jumps = 0

so that the closed rows (set C) carry `f_C = Q_CC^-1 g_C`, and the open ones jump by
`g_O - Q_OC f_C`. Both maps are rows of Q exchanged on C: `[Q^-1, -Q^-1 Q_CO; Q_OC Q^-1, Schur]`. A
row that opens or closes is one more exchange, of rank one; a step without any is a product with
the rows of C. The answer is the only one: sets follow the signs, and after some turns one row at a
time, the first that is wrong (Murty's rule, which is finite). The set starts from that of the step
before.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.interface.copies import copy_rows

ALL_AT_ONCE = 20  # turns of a step that change all rows with the wrong sign
MOST_TURNS = 2000  # of a step: more only if rounding decides the signs
EXCHANGES = 64  # between two times that Q is exchanged anew: rounding does not grow


class ActiveSet(NamedTuple):
    """The exchanged matrix E on the set `closed`, its rows in `order[:n]`.

    `tally` holds n and the exchanges since E was made; the sign of what is less than `rounding` of
    the largest jump, or of the force `k` times it, is none.
    """

    Q: FloatArray  # (q, q)
    k: FloatArray  # (q,)
    E: FloatArray  # (q, q)
    closed: np.ndarray  # (q,) bool
    order: IntArray
    tally: IntArray
    free: FloatArray  # (q,) jumps without forces
    found: FloatArray  # (q,) forces of closed rows, jumps of open ones
    rounding: float


def active_set_of(Q: FloatArray, k: FloatArray, rounding: float) -> ActiveSet:
    """Rows that are all open."""
    q = len(k)
    return ActiveSet(
        Q, k, Q.copy(), np.zeros(q, bool), np.zeros(q, np.int64), np.zeros(2, np.int64),
        np.zeros(q), np.zeros(q), rounding,
    )  # fmt: skip


@compiled_fast
def _exchange(E: FloatArray, i: int) -> None:
    """Exchange force and jump of the row i in `E`; twice leads back."""
    inverse = 1.0 / E[i, i]
    row = E[i]
    for j in range(len(E)):
        if j != i:
            factor = E[j, i] * inverse
            line = E[j]
            for k in range(len(E)):
                line[k] -= factor * row[k]
            line[i] = factor
    for k in range(len(E)):
        row[k] *= -inverse
    row[i] = inverse


@compiled_fast
def list_closed(active: ActiveSet) -> None:
    """The closed rows into `order`."""
    n = 0
    for i in range(len(active.k)):
        if active.closed[i]:
            active.order[n] = i
            n += 1
    active.tally[0] = n


@compiled_fast
def anew(active: ActiveSet) -> None:
    """E from Q."""
    copy_rows(active.Q, active.E)
    for i in range(len(active.k)):
        if active.closed[i]:
            _exchange(active.E, i)
    active.tally[1] = 0


@compiled_fast
def _change(active: ActiveSet, i: int) -> None:
    active.closed[i] = not active.closed[i]
    _exchange(active.E, i)
    active.tally[1] += 1


@compiled_fast
def answer(active: ActiveSet, g: FloatArray, out: FloatArray) -> None:
    """Forces of closed rows and jumps of open ones, into `out`, for the jumps g without forces."""
    E, order, n = active.E, active.order, active.tally[0]
    for i in range(len(g)):
        out[i] = 0.0 if active.closed[i] else g[i]
    fours = n // 4 * 4
    for m in range(0, fours, 4):
        i0, i1, i2, i3 = order[m], order[m + 1], order[m + 2], order[m + 3]
        a, b, c, d = g[i0], g[i1], g[i2], g[i3]
        row0, row1, row2, row3 = E[i0], E[i1], E[i2], E[i3]
        for j in range(len(out)):
            out[j] += (row0[j] * a + row1[j] * b) + (row2[j] * c + row3[j] * d)
    for m in range(fours, n):
        row, a = E[order[m]], g[order[m]]
        for j in range(len(out)):
            out[j] += row[j] * a


@apart
@compiled_fast
def find_active(active: ActiveSet) -> int:
    """What is `found` under the jumps `free`; turns (<= 0: none found)."""
    turn, most, g, out = 0, 0.0, active.free, active.found
    for i in range(len(g)):
        most = max(most, abs(g[i]))
    if not np.isfinite(most):
        return 1
    while True:
        turn += 1
        answer(active, g, out)
        changed = False
        for i in range(len(g)):
            closed = active.closed[i]
            limit = active.rounding * most * (active.k[i] if closed else 1.0)
            if (closed and out[i] > limit) or (not closed and out[i] < -limit):
                _change(active, i)
                changed = True
                if turn > ALL_AT_ONCE:
                    break
        if not changed:
            return turn
        if turn == MOST_TURNS:
            return -turn
        if active.tally[1] > EXCHANGES:
            anew(active)
        list_closed(active)
