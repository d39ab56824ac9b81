"""The whole time loop, compiled, for small systems with dense matrices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.compiled import compiled
from ssilang.kernel.joints.condensed import solve_interface
from ssilang.kernel.joints.response import interface_energies
from ssilang.kernel.mesh.nodes import FloatArray, IntArray

N_ENERGIES = 7
KINETIC, ELASTIC, STORED, LOST, DAMPED, EXTERNAL, RESIDUAL = range(N_ENERGIES)


class System(NamedTuple):
    """What does not change with dt: dense matrices (n, n), loads, conditions, scheme."""

    K: FloatArray
    M: FloatArray
    C: FloatArray
    damped: bool
    forces: FloatArray  # (n, k)
    imposed: FloatArray  # (n_rows, k)
    rows: FloatArray  # (n_rows, n)
    supported: bool  # some imposed value changes: supports do work
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


class Saved(NamedTuple):
    """Where the saved steps go, one row each."""

    u: FloatArray
    v: FloatArray
    a: FloatArray
    reaction: FloatArray
    w: FloatArray
    t: FloatArray
    state: FloatArray


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
    K, M, C, P, Q = system.K, system.M, system.C, step.P, step.Q
    u, v, a, delta, f = motion.u, motion.v, motion.a, motion.delta, motion.f
    n, q, dt = len(u), len(delta), step.dt
    am, af, beta, gamma = system.scheme[0], system.scheme[1], system.scheme[2], system.scheme[3]
    load0, load1 = np.zeros(n), np.zeros(n)
    px, pv, r, du, tmp = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    dd, v0, a0 = np.zeros(len(system.rows)), np.zeros(n), np.zeros(n)
    y0, y, h, f1 = np.zeros(q), np.zeros(q), np.zeros(q), np.zeros(q)
    new, D = np.zeros_like(motion.state), np.zeros((len(motion.w), motion.w.shape[1], q and motion.w.shape[1]))
    worst = 0
    _times_vector(system.forces, factors[0], load0)
    for k in range(len(save)):
        _times_vector(system.forces, factors[k + 1], load1)
        for i in range(n):
            v0[i], a0[i] = v[i], a[i]
            pv[i] = (1 - am) * (v[i] / (beta * dt) + (0.5 / beta - 1) * a[i]) - am * a[i]
            px[i] = (1 - af) * (
                (1 - gamma / beta) * v[i] + dt * (1 - 0.5 * gamma / beta) * a[i]
            ) + af * v[i]
        _times_vector(M, pv, r)
        _times_vector(K, u, tmp)
        for i in range(n):
            r[i] += (1 - af) * load1[i] + af * load0[i] - tmp[i]
        if system.damped:
            _times_vector(C, px, tmp)
            for i in range(n):
                r[i] -= tmp[i]
        for j in range(q):
            if f[j] != 0.0:
                for i in range(n):
                    r[i] -= joints.J[j, i] * f[j]
        _times_vector(P, r, du)
        if len(dd):
            _times_vector(system.imposed, factors[k + 1], dd)
            for row in range(len(dd)):
                for i in range(n):
                    dd[row] -= system.rows[row, i] * u[i]
            _times_vector(Q, dd, tmp)
            for i in range(n):
                du[i] += tmp[i]
        if q:
            _times_vector(joints.J, du, y0)
            y[:] = y0
            turns, residual = solve_interface(
                joints.pairs, joints.B, joints.weights, joints.codes, joints.p, step.S, step.R,
                1 - af, delta, f, motion.state, y0, y, motion.w, motion.t, new, D, f1, h,
            )  # fmt: skip
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            _times_vector(step.Y, h, tmp)
            for i in range(n):
                du[i] -= tmp[i]
            delta += y
            f[:] = f1
            motion.state[:, :] = new
        for i in range(n):
            u[i] += du[i]
            v[i] = gamma / (beta * dt) * du[i] + (1 - gamma / beta) * v0[i]
            v[i] += dt * (1 - 0.5 * gamma / beta) * a0[i]
            a[i] = (du[i] / dt - v0[i]) / (beta * dt) - (0.5 / beta - 1) * a0[i]
        if not np.isfinite(u).all():
            return k, -1, np.inf
        _account(system, joints, motion, du, v0, load0, load1, r, step, px, pv)
        history[k] = motion.energies
        if save[k] >= 0:
            row = save[k]
            saved.u[row], saved.v[row], saved.a[row] = u, v, a
            saved.reaction[row] = motion.reaction
            saved.w[row], saved.t[row], saved.state[row] = motion.w, motion.t, motion.state
        load0[:] = load1
    return len(save), worst, 0.0
