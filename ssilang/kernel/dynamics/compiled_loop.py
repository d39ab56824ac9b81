"""The whole time loop, compiled, for small systems with dense matrices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.compiled import compiled
from ssilang.kernel.joints.condensed import solve_interface
from ssilang.kernel.joints.response import interface_energies
from ssilang.kernel.mesh.nodes import FloatArray, IntArray

N_ENERGIES = 6
KINETIC, ELASTIC, STORED, LOST, DAMPED, EXTERNAL = range(N_ENERGIES)


class System(NamedTuple):
    """What does not change with dt: dense matrices (n, n), loads, conditions, scheme."""

    K: FloatArray
    M: FloatArray
    C: FloatArray
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


class Joints(NamedTuple):
    """Interface arrays (see `Interface`)."""

    J: FloatArray  # (q, n)
    pairs: IntArray
    B: FloatArray
    weights: FloatArray
    codes: IntArray
    p: FloatArray


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
def _account(
    system: System,
    joints: Joints,
    motion: Motion,
    du: FloatArray,
    dd: FloatArray,
    load0: FloatArray,
    load1: FloatArray,
    dt: float,
) -> None:
    """Reactions and energies of the new state.

    Work is that of mean forces on the increment, exact for the average acceleration.
    """
    n = len(du)
    old = motion.reaction.copy()
    tmp = np.zeros(n)
    _times_vector(system.M, motion.a, motion.reaction)
    _times_vector(system.K, motion.u, tmp)
    elastic, external = 0.0, 0.0
    for i in range(n):
        elastic += 0.5 * tmp[i] * motion.u[i]
        external += 0.5 * (load0[i] + load1[i]) * du[i]
        motion.reaction[i] += tmp[i] - load1[i]
    if system.damped:
        _times_vector(system.C, motion.v, tmp)
        motion.reaction[:] += tmp
        motion.energies[DAMPED] += _form(system.C, du) / dt
    for j in range(len(motion.f)):
        if motion.f[j] != 0.0:
            for i in range(n):
                motion.reaction[i] += joints.J[j, i] * motion.f[j]
    for row in range(len(dd)):
        if dd[row] != 0.0:
            for i in range(n):
                mean = 0.5 * (old[i] + motion.reaction[i])
                external += dd[row] * system.multipliers[row, i] * mean
    motion.energies[KINETIC] = 0.5 * _form(system.M, motion.v)
    motion.energies[ELASTIC] = elastic
    motion.energies[EXTERNAL] += external
    if len(motion.f):
        stored, lost = interface_energies(
            joints.codes, joints.p, joints.weights, motion.w, motion.t, motion.state
        )
        motion.energies[STORED], motion.energies[LOST] = stored, lost


@compiled
def _predict(
    system: System,
    joints: Joints,
    motion: Motion,
    load0: FloatArray,
    load1: FloatArray,
    dt: float,
    r: FloatArray,
) -> None:
    """Right-hand side r of `A du + c J^T (f1 - f0) = r`."""
    am, af, beta, gamma = system.scheme[0], system.scheme[1], system.scheme[2], system.scheme[3]
    v, a, n = motion.v, motion.a, len(r)
    pv, px, tmp = np.zeros(n), np.zeros(n), np.zeros(n)
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
                r[i] -= joints.J[j, i] * motion.f[j]


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
    y0, y, h, f1 = np.zeros(q), np.zeros(q), np.zeros(q), np.zeros(q)
    d = motion.w.shape[1]
    new, D = np.zeros_like(motion.state), np.zeros((len(motion.w), d, d))
    worst = 0
    _times_vector(system.forces, factors[0], load0)
    for k in range(len(save)):
        _times_vector(system.forces, factors[k + 1], load1)
        _predict(system, joints, motion, load0, load1, dt, r)
        _times_vector(step.P, r, du)
        if len(dd):
            _times_vector(system.imposed, factors[k + 1], dd)
            for row in range(len(dd)):
                for i in range(n):
                    dd[row] -= system.rows[row, i] * motion.u[i]
            _times_vector(step.Q, dd, tmp)
            du += tmp
        if q:
            _times_vector(joints.J, du, y0)
            y[:] = y0
            turns, residual = solve_interface(
                joints.pairs, joints.B, joints.weights, joints.codes, joints.p, step.S, step.R,
                1 - system.scheme[1], delta, f, motion.state, y0, y, motion.w, motion.t, new, D,
                f1, h,
            )  # fmt: skip
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            _times_vector(step.Y, h, tmp)
            du -= tmp
            delta += y
            f[:] = f1
            motion.state[:, :] = new
        _advance(system, motion, du, dt)
        if not np.isfinite(motion.u).all():
            return k, -1, np.inf
        _account(system, joints, motion, du, dd, load0, load1, dt)
        history[k] = motion.energies
        if save[k] >= 0:
            row = save[k]
            saved.u[row], saved.v[row], saved.a[row] = motion.u, motion.v, motion.a
            saved.reaction[row] = motion.reaction
            saved.w[row], saved.t[row], saved.state[row] = motion.w, motion.t, motion.state
        load0[:] = load1
    return len(save), worst, 0.0
