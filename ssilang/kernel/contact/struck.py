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
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled_fused
from ssilang.kernel.contact.active_set import ActiveSet, answer, find_active

COUPLED = 1e-6  # of the flexibilities of two rows: an impulse on one moves the other
APART = 1e-8  # added to the diagonal of W, whose rows may depend on one another; taken back after
TURNS = 4  # that take it back: each leaves APART of what is left
ROUNDING = 1e-12  # of the largest velocity
STILL = 1e-9  # of the velocity that a row would have without the last reactions: none


@seldom
@compiled_fused
def strike(
    W: FloatArray, c: FloatArray, v: FloatArray, closing: np.ndarray, held: np.ndarray,
    body: np.ndarray, struck: np.ndarray, impulse: FloatArray,
) -> int:  # fmt: skip
    """Rows of the bodies that are struck while they are held, and what stops them.

    Parameters
    ----------
    W : array (m, m)
        Flexibilities of the rows by the mass.
    c, v : arrays (m,)
        Velocities at the step's end without its last reactions, and with them.
    closing, held : arrays (m,) of bool
        Rows that push since this step, and since before; both: rows that were turned round and
        push all the same.
    body, struck : arrays (m,) of bool, overwritten
        Rows of such bodies that touch; those of them that have an impulse.
    impulse : array (m,), overwritten
        Impulses that bring the struck rows from v to rest.

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
    for i in range(n):
        active.free[i] = c[rows[i]]
        before[i] = v[rows[i]]
    find_active(active)
    _rest(W, rows, active, before, found)
    few = 0
    for i in range(n):
        if active.closed[i]:
            struck[rows[i]], impulse[rows[i]] = True, found[i]
            few += 1
    return few


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
            left[i] = v[i]
            for j in range(n):
                left[i] += W[rows[i], rows[j]] * impulse[j]
        answer(active, left, change)
        for i in range(n):
            if active.closed[i]:
                impulse[i] -= change[i]
