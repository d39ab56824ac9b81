"""Several motions on the same springs that only push: the steps of `normal_loop`, side by side.

Each motion has its own set of closed springs and its own loads. The products with the springs'
rows J are those of two matrices, one row a motion, so that J is read once for all of them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.stepping.rests.dense.loop import DAMPED, ELASTIC, EXTERNAL, KINETIC, STORED
from ssilang.kernel.stepping.rests.modal.loop import Modal, ModalStep, next_load
from ssilang.kernel.stepping.rests.modal.springs import Contact, anew, list_closed, settle


class SpringMotions(NamedTuple):
    """State of motions, one a row, changed in place."""

    u: FloatArray  # (m, r)
    v: FloatArray
    a: FloatArray
    delta: FloatArray  # (m, q)
    f: FloatArray
    xi: FloatArray
    energies: FloatArray  # (m, N_ENERGIES)


class SpringRows(NamedTuple):
    """Where kept steps go: motion, row of the motion, coordinate or spring."""

    u: FloatArray  # (m, n_rows, r)
    v: FloatArray
    a: FloatArray
    delta: FloatArray  # (m, n_rows, q)
    f: FloatArray
    xi: FloatArray


class Ends(NamedTuple):
    """How motions ended: see `compiled_loop.march`."""

    steps: IntArray  # (m,)
    turns: IntArray
    residual: FloatArray


@compiled_fast
def _begin(
    modal: Modal, step: ModalStep, u: FloatArray, v: FloatArray, a: FloatArray, g: FloatArray,
    load0: FloatArray, load1: FloatArray, du: FloatArray, end: FloatArray,
) -> None:  # fmt: skip
    """Increments of the next step without its springs at the end, and what they lead to."""
    am, af, beta, gamma = modal.scheme[0], modal.scheme[1], modal.scheme[2], modal.scheme[3]
    mass_v, mass_a = (1 - am) / (beta * step.dt), (1 - am) * (0.5 / beta - 1) - am
    damping_v = (1 - af) * (1 - gamma / beta) + af
    damping_a = (1 - af) * step.dt * (1 - 0.5 * gamma / beta)
    P, m, c, k = step.P, modal.m, modal.c, modal.k
    for i in range(len(du)):
        r = m[i] * (mass_v * v[i] + mass_a * a[i]) - c[i] * (damping_v * v[i] + damping_a * a[i])
        du[i] = P[i] * (r - k[i] * u[i] - af * g[i] + (1 - af) * load1[i] + af * load0[i])
        end[i] = u[i] + du[i]


@compiled_fast
def _end(
    modal: Modal, step: ModalStep, u: FloatArray, v: FloatArray, a: FloatArray, g: FloatArray,
    load0: FloatArray, load1: FloatArray, du: FloatArray, energies: FloatArray,
) -> float:  # fmt: skip
    """The motion after a step that the springs end with g; a number that is finite if it is."""
    beta, gamma, dt = modal.scheme[2], modal.scheme[3], step.dt
    rate, keep, drift = gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    bend, slow, late = 1 / (beta * dt**2), 1 / (beta * dt), 0.5 / beta - 1
    P, m, c, k, share = step.P, modal.m, modal.c, modal.k, 1 - modal.scheme[1]
    kinetic, elastic, damped, external, size = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(len(u)):
        move, v0, a0 = du[i] - share * P[i] * g[i], v[i], a[i]
        u1 = u[i] + move
        v1 = rate * move + keep * v0 + drift * a0
        a[i] = bend * move - slow * v0 - late * a0
        u[i], v[i] = u1, v1
        kinetic += m[i] * v1 * v1
        elastic += k[i] * u1 * u1
        damped += c[i] * move * move
        external += move * (load0[i] + load1[i])
        size += abs(u1)
    energies[KINETIC], energies[ELASTIC] = 0.5 * kinetic, 0.5 * elastic
    energies[DAMPED] += damped / dt
    energies[EXTERNAL] += 0.5 * external
    return size


@compiled_fast
def _springs(
    contact: Contact, jumps: FloatArray, answer: FloatArray, delta: FloatArray, f: FloatArray,
    xi: FloatArray, energies: FloatArray,
) -> int:  # fmt: skip
    """Forces, jumps and largest openings of the springs at a step's end; see `settle`."""
    turns, stored = settle(contact, jumps, answer), 0.0
    for i in range(len(f)):
        closed = contact.closed[i]
        f[i] = min(answer[i], 0.0) if closed else 0.0
        delta[i] = f[i] / contact.k[i] if closed else answer[i]
        xi[i] = max(xi[i], delta[i])
        stored += f[i] * f[i] / contact.k[i]
    energies[STORED] = 0.5 * stored
    return turns


@compiled_fast
def _wrong(contact: Contact, jumps: FloatArray, answer: FloatArray) -> float:
    """Largest wrong sign of an answer, of the largest jump."""
    wrong, largest = 0.0, 0.0
    for i in range(len(jumps)):
        wrong = max(wrong, answer[i] / contact.k[i] if contact.closed[i] else -answer[i])
        largest = max(largest, abs(jumps[i]))
    return wrong / largest


@compiled_fast
def march_springs(
    modal: Modal,
    step: ModalStep,
    k: FloatArray,
    x: SpringMotions,
    factors: FloatArray,
    save: IntArray,
    rows: SpringRows,
    history: FloatArray,
    ends: Ends,
) -> None:
    """Step m motions as `march_normal` steps one; a motion that fails stops alone.

    Parameters
    ----------
    k : array (q,)
        Stiffness of the springs.
    factors : array (m, n_steps + 1, n_loads)
    save : array (m, n_steps)
        Row of each step, -1 for those that are not kept.
    history : array (m, n_steps, N_ENERGIES)
    """
    count, n, q, steps = x.u.shape[0], x.u.shape[1], len(k), save.shape[1]
    du, end, g = np.zeros((count, n)), np.zeros((count, n)), np.zeros((count, n))
    load0, load1 = np.zeros((count, n)), np.zeros((count, n))
    jumps, answer = np.zeros((count, q)), np.zeros((count, q))
    Q, E, closed = (1 - modal.scheme[1]) * step.S, np.zeros((count, q, q)), x.f < 0.0
    order, tally = np.zeros((count, q), np.int64), np.zeros((count, 2), np.int64)
    for i in range(q):
        Q[i, i] += 1.0 / k[i]
    np.dot(x.f, modal.J, g)
    for j in range(count):
        contact = Contact(Q, k, E[j], closed[j], order[j], tally[j])
        anew(contact)
        list_closed(contact)
        next_load(modal.forces, factors[j, 0], load0[j], load1[j])
        next_load(modal.forces, factors[j, min(1, steps)], load0[j], load1[j])
        _begin(modal, step, x.u[j], x.v[j], x.a[j], g[j], load0[j], load1[j], du[j], end[j])
        ends.steps[j], ends.turns[j] = steps, 1
    for s in range(steps):
        np.dot(end, modal.Jt, jumps)
        for j in range(count):
            if ends.steps[j] == steps:
                contact = Contact(Q, k, E[j], closed[j], order[j], tally[j])
                turns = _springs(
                    contact, jumps[j], answer[j], x.delta[j], x.f[j], x.xi[j], x.energies[j]
                )
                if turns < 0:
                    ends.steps[j], ends.turns[j] = s, turns
                    ends.residual[j] = _wrong(contact, jumps[j], answer[j])
                else:
                    ends.turns[j] = max(ends.turns[j], turns)
        np.dot(x.f, modal.J, g)
        for j in range(count):
            if ends.steps[j] == steps:
                u, v, a = x.u[j], x.v[j], x.a[j]
                energies = x.energies[j]
                size = _end(modal, step, u, v, a, g[j], load0[j], load1[j], du[j], energies)
                if not np.isfinite(size):
                    ends.steps[j], ends.turns[j], ends.residual[j] = s, -1, np.inf
                    continue
                for i in range(len(energies)):
                    history[j, s, i] = energies[i]
                if save[j, s] >= 0:
                    _keep(x, rows, j, save[j, s])
                next_load(modal.forces, factors[j, min(s + 2, steps)], load0[j], load1[j])
                _begin(modal, step, u, v, a, g[j], load0[j], load1[j], du[j], end[j])


@compiled_fast
def _keep(x: SpringMotions, rows: SpringRows, j: int, row: int) -> None:
    for i in range(x.u.shape[1]):
        rows.u[j, row, i] = x.u[j, i]
        rows.v[j, row, i] = x.v[j, i]
        rows.a[j, row, i] = x.a[j, i]
    for i in range(x.f.shape[1]):
        rows.delta[j, row, i] = x.delta[j, i]
        rows.f[j, row, i] = x.f[j, i]
        rows.xi[j, row, i] = x.xi[j, i]
