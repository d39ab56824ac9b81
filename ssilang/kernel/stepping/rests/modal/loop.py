"""The whole time loop, compiled, on coordinates in which mass, damping and stiffness are diagonal.

The steps are those of `compiled_loop`; the interface is that of the whole model, seen through the
reduced vectors (jumps `J q`, compliance `J P J^T`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_rows, copy_state
from ssilang.kernel.interface.factors import is_factorised, solve_known
from ssilang.kernel.interface.newton import Workspace, solve_interface
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    accept,
    interface_energies,
)
from ssilang.kernel.stepping.rests.dense.loop import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
    Motion,
)

BLOCK = 128  # coordinates whose rows of Jt stay in the nearest cache


class Modal(NamedTuple):
    """Diagonal matrices (r,), interface and loads on r reduced coordinates."""

    m: FloatArray
    c: FloatArray
    k: FloatArray
    J: FloatArray  # (q, r)
    Jt: FloatArray  # (r, q)
    forces: FloatArray  # (n_loads, r)
    scheme: FloatArray  # alpha_m, alpha_f, beta, gamma


class ModalStep(NamedTuple):
    """What depends on dt: `dq = P r`, compliance S of the interface."""

    dt: float
    P: FloatArray  # (r,)
    S: FloatArray  # (q, q)


class ModalRows(NamedTuple):
    """Where steps go: jumps of all, the rest of those that are kept, one row each."""

    jumps: FloatArray  # (n_steps, n_points, d)
    u: FloatArray
    v: FloatArray
    a: FloatArray
    w: FloatArray
    t: FloatArray
    state: FloatArray


class Sweep(NamedTuple):
    """Vectors that each step overwrites."""

    du: FloatArray  # (r,) increments, first without the change of the joints' forces
    g: FloatArray  # (r,) forces of the joints on the coordinates
    y0: FloatArray  # (q,) jumps of du
    load0: FloatArray  # (r,)
    load1: FloatArray  # (r,)


@compiled_fast
def next_load(
    forces: FloatArray, factors: FloatArray, load0: FloatArray, load1: FloatArray
) -> None:
    """The loads at the end of the next step; those of the last one become its first."""
    for i in range(len(load1)):
        load0[i] = load1[i]
        load1[i] = 0.0
    for j in range(len(factors)):
        part, factor = forces[j], factors[j]
        for i in range(len(load1)):
            load1[i] += part[i] * factor


@compiled_fast
def add_jumps(Jt: FloatArray, du: FloatArray, y: FloatArray) -> None:
    """y += J du, four coordinates at a time: y is read and written less often."""
    fours = len(du) // 4 * 4
    for i in range(0, fours, 4):
        a, b, c, d = du[i], du[i + 1], du[i + 2], du[i + 3]
        row0, row1, row2, row3 = Jt[i], Jt[i + 1], Jt[i + 2], Jt[i + 3]
        for j in range(len(y)):
            y[j] += (row0[j] * a + row1[j] * b) + (row2[j] * c + row3[j] * d)
    for i in range(fours, len(du)):
        for j in range(len(y)):
            y[j] += Jt[i, j] * du[i]


@compiled_fast
def _predict(modal: Modal, step: ModalStep, x: Motion, sweep: Sweep, first: int, last: int) -> None:
    """`du = P r` of `A du + c J^T (f1 - f0) = r`, the joints' forces left as they are; y0 += J du.

    Some coordinates only: those from `first` to `last`.
    """
    am, af, beta, gamma = modal.scheme[0], modal.scheme[1], modal.scheme[2], modal.scheme[3]
    mass_v, mass_a = (1 - am) / (beta * step.dt), (1 - am) * (0.5 / beta - 1) - am
    damping_v = (1 - af) * (1 - gamma / beta) + af
    damping_a = (1 - af) * step.dt * (1 - 0.5 * gamma / beta)
    du, g, P = sweep.du[first:last], sweep.g[first:last], step.P[first:last]
    m, c, k = modal.m[first:last], modal.c[first:last], modal.k[first:last]
    u, v, a = x.u[first:last], x.v[first:last], x.a[first:last]
    load0, load1 = sweep.load0[first:last], sweep.load1[first:last]
    for i in range(len(du)):
        r = m[i] * (mass_v * v[i] + mass_a * a[i]) - c[i] * (damping_v * v[i] + damping_a * a[i])
        du[i] = P[i] * (r - k[i] * u[i] - g[i] + (1 - af) * load1[i] + af * load0[i])
    add_jumps(modal.Jt[first:last], du, sweep.y0)


@compiled_fast
def _correct(
    modal: Modal, step: ModalStep, f: FloatArray, sweep: Sweep, first: int, last: int
) -> None:
    """The joints' new forces f into g and the increments of some coordinates."""
    share, Jt = 1 - modal.scheme[1], modal.Jt[first:last]
    du, old, P = sweep.du[first:last], sweep.g[first:last], step.P[first:last]
    fours = len(du) // 4 * 4
    for i in range(0, fours, 4):  # four sums at a time: f is read less often
        a, b, c, d = 0.0, 0.0, 0.0, 0.0
        row0, row1, row2, row3 = Jt[i], Jt[i + 1], Jt[i + 2], Jt[i + 3]
        for j in range(len(f)):
            a += row0[j] * f[j]
            b += row1[j] * f[j]
            c += row2[j] * f[j]
            d += row3[j] * f[j]
        _turn_force(du, old, P, share, i, a)
        _turn_force(du, old, P, share, i + 1, b)
        _turn_force(du, old, P, share, i + 2, c)
        _turn_force(du, old, P, share, i + 3, d)
    for i in range(fours, len(du)):
        g = 0.0
        for j in range(len(f)):
            g += Jt[i, j] * f[j]
        _turn_force(du, old, P, share, i, g)


@compiled_fast
def _turn_force(
    du: FloatArray, old: FloatArray, P: FloatArray, share: float, i: int, g: float
) -> None:
    """The increment of a coordinate whose joints' force becomes g."""
    du[i] -= P[i] * share * (g - old[i])
    old[i] = g


@compiled_fast
def _advance(modal: Modal, dt: float, x: Motion, sweep: Sweep, first: int, last: int) -> float:
    """Motion and energies of some coordinates; returns a number that is finite if they are."""
    beta, gamma = modal.scheme[2], modal.scheme[3]
    rate, keep, drift = gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    bend, slow, late = 1 / (beta * dt**2), 1 / (beta * dt), 0.5 / beta - 1
    u, v, a, du = x.u[first:last], x.v[first:last], x.a[first:last], sweep.du[first:last]
    m, c, k = modal.m[first:last], modal.c[first:last], modal.k[first:last]
    load0, load1 = sweep.load0[first:last], sweep.load1[first:last]
    for i in range(len(u)):
        v0, a0 = v[i], a[i]
        u[i] += du[i]
        v[i] = rate * du[i] + keep * v0 + drift * a0
        a[i] = bend * du[i] - slow * v0 - late * a0
    kinetic, elastic, damped, external, size = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(len(u)):
        kinetic += m[i] * v[i] * v[i]
        elastic += k[i] * u[i] * u[i]
        damped += c[i] * du[i] * du[i]
        external += du[i] * (load0[i] + load1[i])
        size += abs(u[i])
    x.energies[KINETIC] += 0.5 * kinetic
    x.energies[ELASTIC] += 0.5 * elastic
    x.energies[DAMPED] += damped / dt
    x.energies[EXTERNAL] += 0.5 * external
    return size


@compiled_fast
def _turn(
    modal: Modal, step: ModalStep, x: Motion, f: FloatArray, factors: FloatArray, sweep: Sweep,
    predict: bool,
) -> float:  # fmt: skip
    """End of a step under the joints' forces f and prediction of the next, in one pass over Jt."""
    n, size = len(x.u), 0.0
    x.energies[KINETIC], x.energies[ELASTIC] = 0.0, 0.0
    for j in range(len(sweep.y0)):
        sweep.y0[j] = 0.0
    for first in range(0, n, BLOCK):
        last = min(first + BLOCK, n)
        _correct(modal, step, f, sweep, first, last)
        size += _advance(modal, step.dt, x, sweep, first, last)
        if predict:
            load0, load1 = sweep.load0[first:last], sweep.load1[first:last]
            next_load(modal.forces[:, first:last], factors, load0, load1)
            _predict(modal, step, x, sweep, first, last)
    return size


@compiled_fast
def _keep(x: Motion, rows: ModalRows, row: int) -> None:
    copy_state(x.u, rows.u[row])
    copy_state(x.v, rows.v[row])
    copy_state(x.a, rows.a[row])
    copy_rows(x.w, rows.w[row])
    copy_rows(x.t, rows.t[row])
    copy_rows(x.state, rows.state[row])


@compiled_fast
def march_modal(
    modal: Modal,
    step: ModalStep,
    joints: Joints,
    x: Motion,
    newton: Workspace,
    factors: FloatArray,
    save: IntArray,
    rows: ModalRows,
    history: FloatArray,
) -> tuple[int, int, float]:
    """As `compiled_loop.march`; `x` and the rows hold reduced coordinates."""
    for i in range(len(newton.trial.y0)):
        newton.trial.y0[i] = 0.0
    n, q, steps = len(x.u), len(x.delta), len(save)
    share, worst = 1 - modal.scheme[1], 0
    sweep = Sweep(np.zeros(n), np.zeros(n), newton.trial.y0, np.zeros(n), np.zeros(n))
    trial = newton.trial
    now = InterfaceState(x.delta, x.f, x.w, x.t, x.state)
    condensed = Condensed(step.S, np.zeros((0, 0)), share)
    start = n - n  # not a literal: that is a type, and code, of its own
    _correct(modal, step, x.f, sweep, start, n)
    next_load(modal.forces, factors[0], sweep.load0, sweep.load1)
    next_load(modal.forces, factors[min(1, steps)], sweep.load0, sweep.load1)
    _predict(modal, step, x, sweep, start, n)
    for k in range(steps):
        if q:
            copy_state(trial.y0, trial.y)
            if is_factorised(newton.factors):  # starts where the last tangents lead
                solve_known(joints, condensed, newton.factors, trial.y)
            turns, residual = solve_interface(joints, condensed, now, newton)
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            accept(trial, now)
            if len(rows.jumps):
                copy_rows(x.w, rows.jumps[k])
        size = _turn(modal, step, x, x.f, factors[min(k + 2, steps)], sweep, k + 1 < steps)
        if not np.isfinite(size):
            return k, -1, np.inf
        if q:
            stored, lost = interface_energies(joints, x.w, x.t, x.state)
            x.energies[STORED], x.energies[LOST] = stored, lost
        copy_state(x.energies, history[k])
        if save[k] >= 0:
            _keep(x, rows, save[k])
    return steps, worst, 0.0
