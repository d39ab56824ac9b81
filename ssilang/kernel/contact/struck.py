"""One body struck at several relations: a row closes while others hold the body.

Rows answer impulses by `W = G M^-1 G^T`. What strikes a body that rests on other rows does not
rebound (Housner 1963: a block that rocks lands on its other corner and stays, its momentum about
that corner is kept); a body that nothing holds is turned round, as `impact` says.
With the velocities c of the rows before, impulses are those of Moreau's law (1988) without
restitution:

    c + W P >= 0 ,   P >= 0 ,   P (c + W P) = 0

A row that holds is let go where the others' impulses lift it, and pressed where they push it on.
So is a row that was turned round and pushes in the next step all the same: it did not rebound.
What is struck then moves by the equilibrium with the reactions of the rows that stay.

Rows meet within a step, and the step is solved as if they met at its end. `strike` takes back what
loads did to the rows after they met, `slow_down` does it again with those that are left open: at
constant accelerations kinetic energies are right where the rows meet and where they are at the
step's end, whatever the step.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled_fused
from ssilang.kernel.contact.active_set import ActiveSet, anew, answer, find_active, list_closed

COUPLED = 1e-6  # of the flexibilities of two rows: an impulse on one moves the other
APART = 1e-8  # added to the diagonal of W, whose rows may depend on one another; taken back after
TURNS = 4  # that take it back: each leaves APART of what is left
ROUNDING = 1e-12  # of the largest velocity
STILL = 1e-9  # of the velocity that a row would have without the last reactions: none


@seldom
@compiled_fused
def strike(
    W: FloatArray, Q: FloatArray, c: FloatArray, v: FloatArray, a: FloatArray, step: FloatArray,
    closing: np.ndarray, held: np.ndarray, body: np.ndarray, struck: np.ndarray,
    impulse: FloatArray,
) -> int:  # fmt: skip
    """Rows of the bodies that are struck while they are held, and what stops them.

    Parameters
    ----------
    W, Q : arrays (m, m)
        Flexibilities of the rows by the mass, and by the step's matrix.
    c, v : arrays (m,)
        Velocities at the step's end without its last reactions, and with them.
    a : array (m,)
        Accelerations at the step's end.
    step : array (2,)
        Displacements and accelerations of a step by its change of velocity.
    closing, held : arrays (m,) of bool
        Rows that push since this step, and since before; both: rows that were turned round and
        push all the same.
    body, struck : arrays (m,) of bool, overwritten
        Rows of such bodies that touch; those of them that are brought to rest.
    impulse : array (m,), overwritten
        Impulses that bring the rows from v to their velocities after the impact.

    Returns
    -------
    int
        How many are struck.
    """
    m, rows = len(c), np.empty(len(c), np.int64)
    _bodies(W, closing, held, body)
    n = 0
    for i in range(m):
        struck[i], impulse[i] = False, 0.0
        if body[i]:
            rows[n] = i
            n += 1
    active, before, found = _active(W, rows, n), np.zeros(n), np.zeros(n)
    met = _meet(Q, c, v, a, step, rows, held, active.free)
    find_active(active)
    few = int(active.tally[0])
    for i in range(n):
        before[i], struck[rows[i]] = v[rows[i]], active.closed[i]
    if met:
        _rest(W, rows, active, active.free, found)
        for i in range(n):
            if not active.closed[i]:
                before[i] -= _answered(W, rows, active.free, found, i)
        _close(active, np.ones(n, np.bool_))
    _rest(W, rows, active, before, found)
    for i in range(n):
        if active.closed[i]:
            impulse[rows[i]] = found[i]
    return few


@compiled_fused
def _meet(
    Q: FloatArray, c: FloatArray, v: FloatArray, a: FloatArray, step: FloatArray, rows: IntArray,
    held: np.ndarray, speed: FloatArray,
) -> bool:  # fmt: skip
    """Velocities (n,) of the rows when they meet, while what holds the body holds on.

    The step has gone on as if nothing were met: at its end the closing rows would have come
    through by a depth, and loads would have done work on it, which is taken back. Rows that were
    turned round do not meet: theirs are velocities of the step's end.
    """
    n, before, after = len(speed), 0.0, 0.0
    active, kept, found = _active(Q, rows, n), np.zeros(n, np.bool_), np.zeros(n)
    for i in range(n):
        speed[i] = c[rows[i]]
        kept[i] = held[rows[i]]
    _close(active, kept)
    _rest(Q, rows, active, speed, found)
    for i in range(n):
        row, end = rows[i], _answered(Q, rows, speed, found, i)
        active.found[i] = end
        if kept[i] or end >= 0.0 or v[row] <= end:
            continue
        change = v[row] - end
        before += end**2
        after += max(end**2 + 2.0 * (a[row] - change * step[1]) * (change * step[0]), 0.0)
    if before == 0.0:
        return False
    for i in range(n):
        speed[i] = 0.0 if kept[i] else active.found[i] * np.sqrt(after / before)
    return True


@seldom
@compiled_fused
def slow_down(
    W: FloatArray, v: FloatArray, a: FloatArray, depth: FloatArray, body: np.ndarray,
    struck: np.ndarray, impulse: FloatArray,
) -> None:  # fmt: skip
    """Impulses (m,) for what loads did since rows met: others have opened by `depth` (m,) since.

    `v` and `a` (m,) are velocities just after the impact and accelerations.
    """
    rows, n, before, after = np.empty(len(v), np.int64), 0, 0.0, 0.0
    for i in range(len(v)):
        impulse[i] = 0.0
        if body[i]:
            rows[n] = i
            n += 1
        if body[i] and not struck[i] and v[i] > 0.0 and depth[i] > 0.0:
            before += v[i] ** 2
            after += max(v[i] ** 2 + 2.0 * a[i] * depth[i], 0.0)
    if before == 0.0:
        return
    active, change, found = _active(W, rows, n), np.zeros(n), np.zeros(n)
    for i in range(n):
        if not struck[rows[i]]:
            change[i] = (1.0 - np.sqrt(after / before)) * v[rows[i]]
    _close(active, np.ones(n, np.bool_))
    _rest(W, rows, active, change, found)
    for i in range(n):
        impulse[rows[i]] = found[i]


@compiled_fused
def _answered(W: FloatArray, rows: IntArray, v: FloatArray, impulse: FloatArray, i: int) -> float:
    """Velocity of the row i of `rows` after their impulses (n,), from v (n,)."""
    total = float(v[i])
    for j in range(len(v)):
        total += W[rows[i], rows[j]] * impulse[j]
    return total


@compiled_fused
def _close(active: ActiveSet, wanted: np.ndarray) -> None:
    """Exchange the rows that are wanted."""
    for i in range(len(wanted)):
        active.closed[i] = wanted[i]
    anew(active)
    list_closed(active)


@seldom
@compiled_fused
def press(
    W: FloatArray, a: FloatArray, struck: np.ndarray, reaction: FloatArray, change: FloatArray
) -> int:
    """Changes (m,) of the reactions of the struck rows, which press or move away from rest.

    `a` (m,) are the accelerations of the rows under `reaction` (m,).
    """
    rows, n = np.empty(len(a), np.int64), 0
    for i in range(len(a)):
        change[i] = 0.0
        if struck[i]:
            rows[n] = i
            n += 1
    active, found = _active(W, rows, n), np.zeros(n)
    for i in range(n):
        active.free[i] = a[rows[i]]
        for j in range(n):
            active.free[i] -= W[rows[i], rows[j]] * reaction[rows[j]]
    find_active(active)
    _rest(W, rows, active, active.free, found)
    for i in range(n):
        change[rows[i]] = max(found[i], 0.0) - reaction[rows[i]]
    return n


@compiled_fused
def _bodies(W: FloatArray, closing: np.ndarray, held: np.ndarray, body: np.ndarray) -> None:
    """Rows that move one another and of which some close while others hold."""
    m, label = len(closing), np.full(len(closing), -1)
    for first in range(m):
        body[first] = False
    for first in range(m):
        if label[first] >= 0 or not (closing[first] or held[first]):
            continue
        label[first], grown = first, True
        while grown:
            grown = False
            for i in range(m):
                if label[i] >= 0 or not (closing[i] or held[i]):
                    continue
                for j in range(m):
                    size = COUPLED * np.sqrt(W[i, i] * W[j, j])
                    if label[j] == first and abs(W[i, j]) > size:
                        label[i], grown = first, True
                        break
        some, others = False, False
        for i in range(m):
            some = some or (label[i] == first and closing[i])
            others = others or (label[i] == first and held[i])
        for i in range(m):
            if label[i] == first:
                body[i] = some and others


@compiled_fused
def _active(W: FloatArray, rows: IntArray, n: int) -> ActiveSet:
    """The first n `rows` of W, all open."""
    Q, k = np.zeros((n, n)), np.zeros(n)
    for i in range(n):
        for j in range(n):
            Q[i, j] = W[rows[i], rows[j]]
        Q[i, i] *= 1.0 + APART
        k[i] = 1.0 / Q[i, i]
    return ActiveSet(
        Q, k, Q.copy(), np.zeros(n, np.bool_), np.zeros(n, np.int64), np.zeros(2, np.int64),
        np.zeros(n), np.zeros(n), ROUNDING,
    )  # fmt: skip


@compiled_fused
def _rest(
    W: FloatArray, rows: IntArray, active: ActiveSet, v: FloatArray, impulse: FloatArray
) -> None:
    """Impulses (n,) of the closed rows that bring them from the velocities v (n,) to rest.

    A velocity that was left to rows that hold would change its sign at each step, and the
    acceleration would grow.
    """
    n = len(v)
    left, change = np.zeros(n), np.zeros(n)
    for i in range(n):
        impulse[i] = 0.0
    for _ in range(TURNS):
        for i in range(n):
            left[i] = _answered(W, rows, v, impulse, i)
        answer(active, left, change)
        for i in range(n):
            if active.closed[i]:
                impulse[i] -= change[i]
