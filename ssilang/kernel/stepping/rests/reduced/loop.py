"""The compiled loop on reduced coordinates with a damping that is not diagonal in them.

On the coordinates mass and stiffness are diagonal, and the damping is a diagonal and
`B^T sense B`, B with one row for each direction in which dashpots pull. Their forces phi stand in a
step as those of the interface do, and are linear: with `S = R P R^T` for the rows R = (J; B), w the
dashpots' velocities that the state of before brings and g = (1 - alpha_f) gamma / (beta dt),

    phi = E (w + g (y_B - S_BJ h)) ,   E = sense (1 + g S_BB sense)^-1

they are eliminated from the interface's compliance once for a step length. Supports may move: their
loads stand among the others, `lift` holds the jumps that they make.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_state
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
from ssilang.kernel.stepping.rests.modal.loop import BLOCK, ModalRows, add_jumps, next_load


class Reduced(NamedTuple):
    """Diagonal matrices (r,), rows of the interface and of the dashpots, loads."""

    m: FloatArray
    c: FloatArray
    k: FloatArray
    Rt: FloatArray  # (r, q + d), columns of J and of B
    sense: FloatArray  # (d,)
    forces: FloatArray  # (n_loads, r)
    lift: FloatArray  # (q, n_loads), or no columns
    scheme: FloatArray  # alpha_m, alpha_f, beta, gamma


class ReducedStep(NamedTuple):
    """What depends on dt."""

    dt: float
    P: FloatArray  # (r,) of `dq = P r`
    S: FloatArray  # (q, q) compliance of the interface with the dashpots
    E: FloatArray  # (d, d)
    SJB: FloatArray  # (q, d)
    SBB: FloatArray  # (d, d)
    rate: float  # g


class Room(NamedTuple):
    """Vectors that each step overwrites."""

    du: FloatArray  # (r,)
    g: FloatArray  # (r,) forces of the joints on the coordinates
    y: FloatArray  # (q + d,) jumps and dashpots' motions under the loads alone
    load0: FloatArray  # (r,)
    load1: FloatArray  # (r,)
    late: FloatArray  # (d,) w
    phi: FloatArray  # (d,)
    z: FloatArray  # (d,) motions of the dashpots in the step


class Pull(NamedTuple):
    """Velocities and accelerations of the dashpots, each (d,)."""

    v: FloatArray
    a: FloatArray


def reduced_step(model: Reduced, dt: float, q: int) -> ReducedStep:
    """What a step dt needs; q rows are the interface's."""
    am, af, beta, gamma = model.scheme
    rate = (1 - af) * gamma / (beta * dt)
    P = 1.0 / ((1 - am) / (beta * dt**2) * model.m + (1 - af) * model.k + rate * model.c)
    S = model.Rt.T @ (P[:, None] * model.Rt)
    SJB, SBB = np.ascontiguousarray(S[:q, q:]), np.ascontiguousarray(S[q:, q:])
    d = len(model.sense)
    E = model.sense[:, None] * np.linalg.inv(np.eye(d) + rate * SBB * model.sense)
    E = np.ascontiguousarray(0.5 * (E + E.T))
    own = np.ascontiguousarray(S[:q, :q] - rate * SJB @ E @ SJB.T)
    return ReducedStep(dt, P, own, E, SJB, SBB, rate)


@compiled_fast
def _predict(
    model: Reduced, step: ReducedStep, x: Motion, room: Room, first: int, last: int
) -> None:
    """Increments under the loads alone, the joints' forces left as they are; y += R du."""
    am, af, beta, gamma = model.scheme[0], model.scheme[1], model.scheme[2], model.scheme[3]
    mass_v, mass_a = (1 - am) / (beta * step.dt), (1 - am) * (0.5 / beta - 1) - am
    damping_v = (1 - af) * (1 - gamma / beta) + af
    damping_a = (1 - af) * step.dt * (1 - 0.5 * gamma / beta)
    for i in range(first, last):
        v, a = x.v[i], x.a[i]
        r = model.m[i] * (mass_v * v + mass_a * a) - model.c[i] * (damping_v * v + damping_a * a)
        r += (1 - af) * room.load1[i] + af * room.load0[i] - model.k[i] * x.u[i] - room.g[i]
        room.du[i] = step.P[i] * r
    add_jumps(model.Rt[first:last], room.du[first:last], room.y)


@compiled_fast
def _held_back(model: Reduced, step: ReducedStep, room: Room, pull: Pull, q: int) -> None:
    """w of the step, phi without a change of the joints' forces; takes its jumps off y."""
    af, beta, gamma = model.scheme[1], model.scheme[2], model.scheme[3]
    old, bent = (1 - af) * (1 - gamma / beta) + af, (1 - af) * step.dt * (1 - 0.5 * gamma / beta)
    d = len(room.phi)
    for i in range(d):
        room.late[i] = old * pull.v[i] + bent * pull.a[i]
        room.z[i] = room.late[i] + step.rate * room.y[q + i]
    room.phi[:] = np.dot(step.E, room.z)
    if q:
        room.y[:q] -= np.dot(step.SJB, room.phi)


@compiled_fast
def _pulled(model: Reduced, step: ReducedStep, room: Room, pull: Pull, h: FloatArray) -> float:
    """phi and z for the change h of the joints' forces, then `pull`; twice the energy lost."""
    beta, gamma, dt, q = model.scheme[2], model.scheme[3], step.dt, len(h)
    if q:
        moved = np.dot(h, step.SJB)
        room.phi[:] -= step.rate * np.dot(step.E, moved)
        for i in range(len(moved)):
            room.z[i] = room.y[q + i] - moved[i]
    else:
        room.z[:] = room.y
    room.z[:] -= np.dot(step.SBB, room.phi)
    lost = 0.0
    for i in range(len(room.z)):
        z, v, a = room.z[i], pull.v[i], pull.a[i]
        pull.v[i] = gamma / (beta * dt) * z + (1 - gamma / beta) * v
        pull.v[i] += dt * (1 - 0.5 * gamma / beta) * a
        pull.a[i] = z / (beta * dt**2) - v / (beta * dt) - (0.5 / beta - 1) * a
        lost += model.sense[i] * z * (v + pull.v[i])
    return lost


@compiled_fast
def _correct(
    model: Reduced, step: ReducedStep, f: FloatArray, room: Room, first: int, last: int
) -> None:
    """Increments of some coordinates under the joints' new forces f and the dashpots'."""
    share, q = 1 - model.scheme[1], len(f)
    for i in range(first, last):
        row, g, back = model.Rt[i], 0.0, 0.0
        for j in range(q):
            g += row[j] * f[j]
        for j in range(len(room.phi)):
            back += row[q + j] * room.phi[j]
        room.du[i] -= step.P[i] * (share * (g - room.g[i]) + back)
        room.g[i] = g


@compiled_fast
def _advance(model: Reduced, dt: float, x: Motion, room: Room, first: int, last: int) -> float:
    """Motion and energies of some coordinates; returns a number that is finite if they are."""
    beta, gamma = model.scheme[2], model.scheme[3]
    rate, keep, drift = gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    bend, slow, late = 1 / (beta * dt**2), 1 / (beta * dt), 0.5 / beta - 1
    kinetic, elastic, damped, external, size = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(first, last):
        du, v0, a0 = room.du[i], x.v[i], x.a[i]
        u = x.u[i] + du
        v = rate * du + keep * v0 + drift * a0
        x.u[i], x.v[i], x.a[i] = u, v, bend * du - slow * v0 - late * a0
        kinetic += model.m[i] * v * v
        elastic += model.k[i] * u * u
        damped += model.c[i] * du * (v0 + v)
        external += du * (room.load0[i] + room.load1[i])
        size += abs(u)
    x.energies[KINETIC] += 0.5 * kinetic
    x.energies[ELASTIC] += 0.5 * elastic
    x.energies[DAMPED] += 0.5 * damped
    x.energies[EXTERNAL] += 0.5 * external
    return size


@compiled_fast
def _turn(
    model: Reduced, step: ReducedStep, x: Motion, f: FloatArray, factors: FloatArray, room: Room,
    work: FloatArray, predict: bool,
) -> float:  # fmt: skip
    """End of a step under the joints' forces f and prediction of the next, block by block."""
    n, size = len(x.u), 0.0
    x.energies[KINETIC], x.energies[ELASTIC] = 0.0, 0.0
    room.y[:] = 0.0
    for first in range(0, n, BLOCK):
        last = min(first + BLOCK, n)
        _correct(model, step, f, room, first, last)
        size += _advance(model, step.dt, x, room, first, last)
        for c in range(len(work)):
            for i in range(first, last):
                work[c] += model.forces[c, i] * room.du[i]
        if predict:
            load0, load1 = room.load0[first:last], room.load1[first:last]
            next_load(model.forces[:, first:last], factors, load0, load1)
            _predict(model, step, x, room, first, last)
    return size


@compiled_fast
def march_reduced(
    model: Reduced, step: ReducedStep, joints: Joints, x: Motion, pull: Pull, newton: Workspace,
    factors: FloatArray, save: IntArray, rows: ModalRows, history: FloatArray, works: FloatArray,
) -> tuple[int, int, float]:  # fmt: skip
    """As `march_modal`; `works` (2, n_steps, n_loads or 0) as in `march_interleaved`."""
    n, q, steps = len(x.u), len(x.delta), len(save)
    d, share, worst = len(model.sense), 1 - model.scheme[1], 0
    room = Room(
        np.zeros(n), np.zeros(n), np.zeros(q + d), np.zeros(n), np.zeros(n), np.zeros(d),
        np.zeros(d), np.zeros(d),
    )  # fmt: skip
    h = np.zeros(q)
    trial = newton.trial
    now = InterfaceState(x.delta, x.f, x.w, x.t, x.state)
    condensed = Condensed(step.S, np.zeros((0, 0)), share)
    _correct(model, step, x.f, room, 0, n)
    room.du[:] = 0.0
    next_load(model.forces, factors[0], room.load0, room.load1)
    next_load(model.forces, factors[min(1, steps)], room.load0, room.load1)
    _predict(model, step, x, room, 0, n)
    for k in range(steps):
        for c in range(model.lift.shape[1]):
            for i in range(q):
                room.y[i] += model.lift[i, c] * (factors[k + 1, c] - factors[k, c])
        if d:
            _held_back(model, step, room, pull, q)
        if q:
            copy_state(room.y[:q], trial.y0)
            copy_state(trial.y0, trial.y)
            if is_factorised(newton.factors):  # starts where the last tangents lead
                solve_known(joints, condensed, newton.factors, trial.y)
            turns, residual = solve_interface(joints, condensed, now, newton)
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            for i in range(q):
                h[i] = share * (trial.f[i] - x.f[i])
            accept(trial, now)
            if len(rows.jumps):
                rows.jumps[k] = x.w
        if d:
            x.energies[DAMPED] += 0.5 * _pulled(model, step, room, pull, h)
        size = _turn(
            model, step, x, x.f, factors[min(k + 2, steps)], room, works[0, k], k + 1 < steps
        )
        for c in range(min(model.lift.shape[1], works.shape[2])):
            for i in range(q):
                works[1, k, c] += model.lift[i, c] * x.f[i]
        if not np.isfinite(size):
            return k, -1, np.inf
        if q:
            stored, lost = interface_energies(joints, x.w, x.t, x.state)
            x.energies[STORED], x.energies[LOST] = stored, lost
        history[k] = x.energies
        if save[k] >= 0:
            row = save[k]
            rows.u[row], rows.v[row], rows.a[row] = x.u, x.v, x.a
            rows.w[row], rows.t[row], rows.state[row] = x.w, x.t, x.state
    return steps, worst, 0.0
