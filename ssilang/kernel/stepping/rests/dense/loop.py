"""The whole time loop, compiled, for small systems with dense matrices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.newton import Workspace, solve_interface
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    accept,
    interface_energies,
)

N_ENERGIES = 6
KINETIC, ELASTIC, STORED, LOST, DAMPED, EXTERNAL = range(N_ENERGIES)


class System(NamedTuple):
    """What does not change with dt: dense matrices (n, n), loads, conditions, scheme."""

    K: FloatArray
    M: FloatArray
    C: FloatArray
    J: FloatArray  # (q, n), jumps of the interface
    damped: bool
    forces: FloatArray  # (n, k)
    imposed: FloatArray  # (n_rows, k)
    rows: FloatArray  # (n_rows, n)
    multipliers: FloatArray  # (n_rows, n): reactions of the rows from forces on the unknowns
    scheme: FloatArray  # alpha_m, alpha_f, beta, gamma


class StepOperators(NamedTuple):
    """What depends on dt: `du = P r + Q dd - Y h`."""

    dt: float
    P: FloatArray  # (n, n)
    Q: FloatArray  # (n, n_rows)
    Y: FloatArray  # (n, q)
    S: FloatArray  # (q, q)
    R: FloatArray  # (q, q)


class Scratch(NamedTuple):
    """Vectors (n,) that each step overwrites."""

    pv: FloatArray
    px: FloatArray
    tmp: FloatArray
    old: FloatArray


class Motion(NamedTuple):
    """The current state, changed in place."""

    u: FloatArray
    v: FloatArray
    a: FloatArray
    delta: FloatArray
    f: FloatArray
    w: FloatArray
    t: FloatArray
    state: FloatArray
    reaction: FloatArray  # (n,) M a + C v + K u + J^T f - F of the last step
    energies: FloatArray  # (N_ENERGIES,)
    contact: FloatArray  # (m,) reactions of unilateral relations (none in the compiled loop)


class Saved(NamedTuple):
    """Where the saved steps go, one row each."""

    u: FloatArray
    v: FloatArray
    a: FloatArray
    reaction: FloatArray
    w: FloatArray
    t: FloatArray
    state: FloatArray
    contact: FloatArray


@compiled
def _times_vector(A: FloatArray, x: FloatArray, out: FloatArray) -> None:
    for i in range(A.shape[0]):
        total = 0.0
        for j in range(A.shape[1]):
            total += A[i, j] * x[j]
        out[i] = total


@compiled
def _form(A: FloatArray, x: FloatArray) -> float:
    """x^T A x."""
    total = 0.0
    for i in range(A.shape[0]):
        row = 0.0
        for j in range(A.shape[1]):
            row += A[i, j] * x[j]
        total += row * x[i]
    return total


@compiled
def _copy(source: FloatArray, target: FloatArray) -> None:
    for i in range(source.shape[0]):
        target[i] = source[i]


@compiled
def _add(target: FloatArray, factor: float, source: FloatArray) -> None:
    for i in range(source.shape[0]):
        target[i] += factor * source[i]


@compiled
def _finite(x: FloatArray) -> bool:
    for i in range(x.shape[0]):  # noqa: SIM110
        if not np.isfinite(x[i]):
            return False
    return True


@compiled
def _keep(motion: Motion, saved: Saved, row: int) -> None:
    """Put the current state into a row of the saved ones."""
    for i in range(len(motion.u)):
        saved.u[row, i], saved.v[row, i] = motion.u[i], motion.v[i]
        saved.a[row, i], saved.reaction[row, i] = motion.a[i], motion.reaction[i]
    for i in range(motion.w.shape[0]):
        for j in range(motion.w.shape[1]):
            saved.w[row, i, j], saved.t[row, i, j] = motion.w[i, j], motion.t[i, j]
        for j in range(motion.state.shape[1]):
            saved.state[row, i, j] = motion.state[i, j]


@compiled
def _account(
    system: System,
    joints: Joints,
    motion: Motion,
    du: FloatArray,
    dd: FloatArray,
    load0: FloatArray,
    load1: FloatArray,
    dt: float,
    scratch: Scratch,
) -> None:
    """Reactions and energies of the new state.

    Work is that of mean forces on the increment, exact for the average acceleration.
    """
    n = len(du)
    old, tmp = scratch.old, scratch.tmp
    _copy(motion.reaction, old)
    _times_vector(system.M, motion.a, motion.reaction)
    _times_vector(system.K, motion.u, tmp)
    elastic, external = 0.0, 0.0
    for i in range(n):
        elastic += 0.5 * tmp[i] * motion.u[i]
        external += 0.5 * (load0[i] + load1[i]) * du[i]
        motion.reaction[i] += tmp[i] - load1[i]
    if system.damped:
        _times_vector(system.C, motion.v, tmp)
        _add(motion.reaction, 1.0, tmp)
        motion.energies[DAMPED] += _form(system.C, du) / dt
    for j in range(len(motion.f)):
        if motion.f[j] != 0.0:
            for i in range(n):
                motion.reaction[i] += system.J[j, i] * motion.f[j]
    for row in range(len(dd)):
        if dd[row] != 0.0:
            for i in range(n):
                mean = 0.5 * (old[i] + motion.reaction[i])
                external += dd[row] * system.multipliers[row, i] * mean
    motion.energies[KINETIC] = 0.5 * _form(system.M, motion.v)
    motion.energies[ELASTIC] = elastic
    motion.energies[EXTERNAL] += external
    if len(motion.f):
        stored, lost = interface_energies(joints, motion.w, motion.t, motion.state)
        motion.energies[STORED], motion.energies[LOST] = stored, lost


@compiled
def _predict(
    system: System,
    motion: Motion,
    load0: FloatArray,
    load1: FloatArray,
    dt: float,
    r: FloatArray,
    scratch: Scratch,
) -> None:
    """Right-hand side r of `A du + c J^T (f1 - f0) = r`."""
    am, af, beta, gamma = system.scheme[0], system.scheme[1], system.scheme[2], system.scheme[3]
    v, a, n = motion.v, motion.a, len(r)
    pv, px, tmp = scratch.pv, scratch.px, scratch.tmp
    for i in range(n):
        pv[i] = (1 - am) * (v[i] / (beta * dt) + (0.5 / beta - 1) * a[i]) - am * a[i]
        px[i] = (1 - af) * (
            (1 - gamma / beta) * v[i] + dt * (1 - 0.5 * gamma / beta) * a[i]
        ) + af * v[i]
    _times_vector(system.M, pv, r)
    _times_vector(system.K, motion.u, tmp)
    for i in range(n):
        r[i] += (1 - af) * load1[i] + af * load0[i] - tmp[i]
    if system.damped:
        _times_vector(system.C, px, tmp)
        for i in range(n):
            r[i] -= tmp[i]
    for j in range(len(motion.f)):
        if motion.f[j] != 0.0:
            for i in range(n):
                r[i] -= system.J[j, i] * motion.f[j]


@compiled
def _advance(system: System, motion: Motion, du: FloatArray, dt: float) -> None:
    """Displacement, velocity and acceleration after the increment du."""
    beta, gamma = system.scheme[2], system.scheme[3]
    for i in range(len(du)):
        v0, a0 = motion.v[i], motion.a[i]
        motion.u[i] += du[i]
        motion.v[i] = gamma / (beta * dt) * du[i] + (1 - gamma / beta) * v0
        motion.v[i] += dt * (1 - 0.5 * gamma / beta) * a0
        motion.a[i] = (du[i] / dt - v0) / (beta * dt) - (0.5 / beta - 1) * a0


@compiled
def march(
    system: System,
    step: StepOperators,
    joints: Joints,
    motion: Motion,
    newton: Workspace,
    factors: FloatArray,
    save: IntArray,
    saved: Saved,
    history: FloatArray,
) -> tuple[int, int, float]:
    """Steps of one dt.

    Parameters
    ----------
    factors : array (n_steps + 1, k)
        Load factors at the times, the first being that of the current state.
    save : array (n_steps,)
        Row of `saved` for each step, -1 for none.
    history : array (n_steps, N_ENERGIES)
        Energies after each step.

    Returns
    -------
    done, turns, residual
        Steps done, and the largest number of Newton turns in a step (<= 0: the step after
        `done` did not converge, with this residual).
    """
    delta, f = motion.delta, motion.f
    n, q, dt = len(motion.u), len(delta), step.dt
    load0, load1 = np.zeros(n), np.zeros(n)
    r, du, tmp, dd = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(len(system.rows))
    trial, now = newton.trial, InterfaceState(delta, f, motion.w, motion.t, motion.state)
    condensed = Condensed(step.S, step.R, 1 - system.scheme[1])
    scratch = Scratch(np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n))
    worst = 0
    _times_vector(system.forces, factors[0], load0)
    for k in range(len(save)):
        _times_vector(system.forces, factors[k + 1], load1)
        _predict(system, motion, load0, load1, dt, r, scratch)
        _times_vector(step.P, r, du)
        if len(dd):
            _times_vector(system.imposed, factors[k + 1], dd)
            for row in range(len(dd)):
                for i in range(n):
                    dd[row] -= system.rows[row, i] * motion.u[i]
            _times_vector(step.Q, dd, tmp)
            _add(du, 1.0, tmp)
        if q:
            _times_vector(system.J, du, trial.y0)
            _copy(trial.y0, trial.y)
            turns, residual = solve_interface(joints, condensed, now, newton)
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            _times_vector(step.Y, trial.h, tmp)
            _add(du, -1.0, tmp)
            accept(trial, now)
        _advance(system, motion, du, dt)
        if not _finite(motion.u):
            return k, -1, np.inf
        _account(system, joints, motion, du, dd, load0, load1, dt, scratch)
        _copy(motion.energies, history[k])
        if save[k] >= 0:
            _keep(motion, saved, save[k])
        _copy(load1, load0)
    return len(save), worst, 0.0
