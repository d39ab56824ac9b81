"""The whole time loop, compiled, for diagonal coordinates on springs that only push.

The springs are points of the Strong Discontinuity law without strength, closing traction and
shear: `f = k min(jump, 0)`. The steps are those of `modal_loop`. With the jumps g that the end of
a step would have without its springs, and their compliance `S = J P J^T`,

    jumps = g - c S f,   f_i = k_i jumps_i of closed springs, 0 of open ones,   c = 1 - alpha_f

so that the closed springs (set C) carry `f_C = Q_CC^-1 g_C` with `Q = 1/k + c S`, and the open ones
jump by `g_O - Q_OC f_C`. Both maps are rows of Q exchanged on C: `[Q^-1, -Q^-1 Q_CO; Q_OC Q^-1,
Schur]`. A spring that opens or closes is one more exchange, of rank one; a step without any is a
product with the rows of C. Each step ends at the only answer (Q is positive definite): sets follow
the signs, and after some turns one spring at a time, the first that is wrong (Murty's rule, which
is finite).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.interface.copies import copy_rows, copy_state, largest
from ssilang.kernel.interface.laws.columns import Variable
from ssilang.kernel.stepping.rests.dense.loop import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    STORED,
    Motion,
)
from ssilang.kernel.stepping.rests.modal.loop import (
    Modal,
    ModalRows,
    ModalStep,
    add_jumps,
    next_load,
)

BLOCK = 64  # coordinates whose rows of J and Jt stay in the nearest cache
ALL_AT_ONCE = 20  # turns of a step that change all springs with the wrong sign
MOST_TURNS = 2000  # of a step: more only if rounding decides the signs
EXCHANGES = 64  # between two times that Q is exchanged anew: rounding does not grow
WRONG = 1e-14  # of the largest jump, or of the force that makes it: a sign that is not rounding


class Contact(NamedTuple):
    """The springs' exchanged matrix E on the set `closed`, its springs in `order[:n]`.

    `tally` holds n and the exchanges since E was made.
    """

    Q: FloatArray  # (q, q)
    k: FloatArray  # (q,)
    E: FloatArray  # (q, q)
    closed: np.ndarray
    order: IntArray
    tally: IntArray


class Released(NamedTuple):
    """Vectors that each step overwrites."""

    du: FloatArray  # (r,) increments without the springs' forces at the end
    end: FloatArray  # (r,) coordinates with them
    g: FloatArray  # (r,) forces of the springs on the coordinates
    load0: FloatArray  # (r,)
    load1: FloatArray  # (r,)
    jumps: FloatArray  # (q,) of `end`


@compiled_fast
def _exchange(E: FloatArray, i: int) -> None:
    """Exchange force and jump of the spring i in `E`; twice leads back."""
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
def list_closed(contact: Contact) -> None:
    n = 0
    for i in range(len(contact.k)):
        if contact.closed[i]:
            contact.order[n] = i
            n += 1
    contact.tally[0] = n


@compiled_fast
def anew(contact: Contact) -> None:
    """E from Q."""
    copy_rows(contact.Q, contact.E)
    for i in range(len(contact.k)):
        if contact.closed[i]:
            _exchange(contact.E, i)
    contact.tally[1] = 0


@compiled_fast
def _change(contact: Contact, i: int) -> None:
    contact.closed[i] = not contact.closed[i]
    _exchange(contact.E, i)
    contact.tally[1] += 1


@compiled_fast
def _solve(contact: Contact, g: FloatArray, out: FloatArray) -> None:
    """Forces of closed springs and jumps of open ones."""
    E, order, n = contact.E, contact.order, contact.tally[0]
    for i in range(len(g)):
        out[i] = 0.0 if contact.closed[i] else g[i]
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


@compiled_fast
def settle(contact: Contact, g: FloatArray, out: FloatArray) -> int:
    """The springs' answer in `out` (see `_solve`) to the jumps g; its turns (< 0: none found)."""
    turn, most = 0, 0.0
    for i in range(len(g)):
        most = max(most, abs(g[i]))
    if not np.isfinite(most):
        return 1
    while True:
        turn += 1
        _solve(contact, g, out)
        changed = False
        for i in range(len(g)):
            closed = contact.closed[i]
            limit = WRONG * most * (contact.k[i] if closed else 1.0)
            if (closed and out[i] > limit) or (not closed and out[i] < -limit):
                _change(contact, i)
                changed = True
                if turn > ALL_AT_ONCE:
                    break
        if not changed:
            return turn
        if turn == MOST_TURNS:
            return -turn
        if contact.tally[1] > EXCHANGES:
            anew(contact)
        list_closed(contact)


@compiled_fast
def _push(
    modal: Modal, step: ModalStep, contact: Contact, f: FloatArray, out: Released, first: int,
    last: int,
) -> None:  # fmt: skip
    """The springs' new forces f into g and the increments of some coordinates."""
    g, order, n, J = out.g[first:last], contact.order, contact.tally[0], modal.J
    for i in range(len(g)):
        g[i] = 0.0
    fours = n // 4 * 4
    for m in range(0, fours, 4):
        i0, i1, i2, i3 = order[m], order[m + 1], order[m + 2], order[m + 3]
        a, b, c, d = f[i0], f[i1], f[i2], f[i3]
        row0, row1 = J[i0, first:last], J[i1, first:last]
        row2, row3 = J[i2, first:last], J[i3, first:last]
        for j in range(len(g)):
            g[j] += (row0[j] * a + row1[j] * b) + (row2[j] * c + row3[j] * d)
    for m in range(fours, n):
        row, a = J[order[m], first:last], f[order[m]]
        for j in range(len(g)):
            g[j] += row[j] * a
    du, P, share = out.du[first:last], step.P[first:last], 1 - modal.scheme[1]
    for i in range(len(g)):
        du[i] -= share * P[i] * g[i]


@compiled_fast
def _release(
    modal: Modal, step: ModalStep, x: Motion, out: Released, first: int, last: int
) -> None:
    """Increments of the next step without its springs at the end; their jumps are added up."""
    am, af, beta, gamma = modal.scheme[0], modal.scheme[1], modal.scheme[2], modal.scheme[3]
    mass_v, mass_a = (1 - am) / (beta * step.dt), (1 - am) * (0.5 / beta - 1) - am
    damping_v = (1 - af) * (1 - gamma / beta) + af
    damping_a = (1 - af) * step.dt * (1 - 0.5 * gamma / beta)
    du, g, P, end = out.du[first:last], out.g[first:last], step.P[first:last], out.end[first:last]
    m, c, k = modal.m[first:last], modal.c[first:last], modal.k[first:last]
    u, v, a = x.u[first:last], x.v[first:last], x.a[first:last]
    load0, load1 = out.load0[first:last], out.load1[first:last]
    for i in range(len(du)):
        r = m[i] * (mass_v * v[i] + mass_a * a[i]) - c[i] * (damping_v * v[i] + damping_a * a[i])
        du[i] = P[i] * (r - k[i] * u[i] - af * g[i] + (1 - af) * load1[i] + af * load0[i])
        end[i] = u[i] + du[i]
    add_jumps(modal.Jt[first:last], end, out.jumps)


@compiled_fast
def _advance(
    modal: Modal, dt: float, x: Motion, out: Released, first: int, last: int, sums: FloatArray
) -> None:
    """Motion of some coordinates; their energies, and something finite if they are, into sums."""
    beta, gamma = modal.scheme[2], modal.scheme[3]
    rate, keep, drift = gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    bend, slow, late = 1 / (beta * dt**2), 1 / (beta * dt), 0.5 / beta - 1
    u, v, a, du = x.u[first:last], x.v[first:last], x.a[first:last], out.du[first:last]
    m, c, k = modal.m[first:last], modal.c[first:last], modal.k[first:last]
    load0, load1 = out.load0[first:last], out.load1[first:last]
    kinetic, elastic, damped, external, size = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(len(u)):
        move, v0, a0 = du[i], v[i], a[i]
        u1 = u[i] + move
        v1 = rate * move + keep * v0 + drift * a0
        a[i] = bend * move - slow * v0 - late * a0
        u[i], v[i] = u1, v1
        kinetic += m[i] * v1 * v1
        elastic += k[i] * u1 * u1
        damped += c[i] * move * move
        external += move * (load0[i] + load1[i])
        size += abs(u1)
    sums[0] += kinetic
    sums[1] += elastic
    sums[2] += damped
    sums[3] += external
    sums[4] += size


@compiled_fast
def _account(x: Motion, contact: Contact, f: FloatArray, dt: float, sums: FloatArray) -> None:
    stored = 0.0
    for i in range(len(f)):
        stored += f[i] * f[i] / contact.k[i]
    x.energies[KINETIC], x.energies[ELASTIC] = 0.5 * sums[0], 0.5 * sums[1]
    x.energies[STORED] = 0.5 * stored
    x.energies[DAMPED] += sums[2] / dt
    x.energies[EXTERNAL] += 0.5 * sums[3]


@compiled_fast
def _save(
    x: Motion, weights: FloatArray, f: FloatArray, xi: FloatArray, rows: ModalRows, row: int
) -> None:
    copy_state(x.u, rows.u[row])
    copy_state(x.v, rows.v[row])
    copy_state(x.a, rows.a[row])
    copy_rows(x.state, rows.state[row])
    for i in range(len(f)):
        rows.w[row, i, 0], rows.t[row, i, 0] = x.delta[i], f[i] / weights[i]
        rows.state[row, i, Variable.XI] = xi[i]


@compiled_fast
def march_normal(
    modal: Modal,
    step: ModalStep,
    weights: FloatArray,
    k: FloatArray,
    x: Motion,
    factors: FloatArray,
    save: IntArray,
    rows: ModalRows,
    history: FloatArray,
) -> tuple[int, int, float]:
    """As `march_modal`, J being the springs' jumps, `k` their stiffness and `weights` their areas.

    The state changes in xi, the largest opening, alone.
    """
    n, q, steps, worst, share = len(x.u), len(k), len(save), 1, 1 - modal.scheme[1]
    out = Released(np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(q))
    Q, answer, f, xi, sums = np.zeros((q, q)), np.zeros(q), np.zeros(q), np.zeros(q), np.zeros(5)
    copy_state(x.f, f)
    contact = Contact(Q, k, np.zeros((q, q)), f < 0.0, np.zeros(q, np.int64), np.zeros(2, np.int64))
    for i in range(q):
        for j in range(q):
            Q[i, j] = share * step.S[i, j]
        Q[i, i] += 1.0 / k[i]
        xi[i] = x.state[i, Variable.XI]
    anew(contact)
    list_closed(contact)
    start = n - n  # not a literal: that is a type, and code, of its own
    _push(modal, step, contact, f, out, start, n)  # the forces at the start, for alpha_f
    next_load(modal.forces, factors[0], out.load0, out.load1)
    next_load(modal.forces, factors[min(1, steps)], out.load0, out.load1)
    _release(modal, step, x, out, start, n)
    for s in range(steps):
        turns = settle(contact, out.jumps, answer)
        if turns < 0:
            wrong = 0.0
            for i in range(q):
                wrong = max(wrong, answer[i] / k[i] if contact.closed[i] else -answer[i])
            return s, turns, wrong / largest(out.jumps)
        worst = max(worst, turns)
        for i in range(q):
            closed = contact.closed[i]
            f[i] = min(answer[i], 0.0) if closed else 0.0
            x.delta[i] = f[i] / k[i] if closed else answer[i]
            xi[i] = max(xi[i], x.delta[i])
            out.jumps[i] = 0.0
        for i in range(5):
            sums[i] = 0.0
        for first in range(0, n, BLOCK):
            last = min(first + BLOCK, n)
            _push(modal, step, contact, f, out, first, last)
            _advance(modal, step.dt, x, out, first, last, sums)
            if s + 1 < steps:
                load0, load1 = out.load0[first:last], out.load1[first:last]
                next_load(modal.forces[:, first:last], factors[s + 2], load0, load1)
                _release(modal, step, x, out, first, last)
        if not np.isfinite(sums[4]):
            return s, -1, np.inf
        _account(x, contact, f, step.dt, sums)
        copy_state(x.energies, history[s])
        if save[s] >= 0:
            _save(x, weights, f, xi, rows, save[s])
    for i in range(q):
        x.f[i], x.w[i, 0], x.t[i, 0] = f[i], x.delta[i], f[i] / weights[i]
        x.state[i, Variable.XI] = xi[i]
    return steps, worst, 0.0
