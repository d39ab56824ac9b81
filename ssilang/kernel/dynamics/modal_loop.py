"""The whole time loop, compiled, on coordinates in which mass, damping and stiffness are diagonal.

The steps are those of `compiled_loop`; the interface is that of the whole model, seen through the
reduced vectors (jumps `J q`, compliance `J P J^T`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.compiled import compiled
from ssilang.kernel.dynamics.compiled_loop import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
    Joints,
    Motion,
)
from ssilang.kernel.joints.condensed_cached import iterate_cached
from ssilang.kernel.joints.response import interface_energies
from ssilang.kernel.mesh.nodes import FloatArray, IntArray


class Modal(NamedTuple):
    """Diagonal matrices (r,), interface and loads on r reduced coordinates."""

    m: FloatArray
    c: FloatArray
    k: FloatArray
    J: FloatArray  # (q, r)
    Jt: FloatArray  # (r, q)
    forces: FloatArray  # (r, n_loads)
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


@compiled
def _right_side(
    modal: Modal, dt: float, x: Motion, load0: FloatArray, load1: FloatArray, g: FloatArray,
    r: FloatArray,
) -> None:  # fmt: skip
    """r of `A dq + c J^T (f1 - f0) = r`; g = J^T f0."""
    am, af, beta, gamma = modal.scheme[0], modal.scheme[1], modal.scheme[2], modal.scheme[3]
    mass_v, mass_a = (1 - am) / (beta * dt), (1 - am) * (0.5 / beta - 1) - am
    damping_v = (1 - af) * (1 - gamma / beta) + af
    damping_a = (1 - af) * dt * (1 - 0.5 * gamma / beta)
    for i in range(len(r)):
        r[i] = (
            modal.m[i] * (mass_v * x.v[i] + mass_a * x.a[i])
            - modal.c[i] * (damping_v * x.v[i] + damping_a * x.a[i])
            - modal.k[i] * x.u[i]
            - g[i]
            + (1 - af) * load1[i]
            + af * load0[i]
        )


@compiled
def _advance(
    modal: Modal, dt: float, x: Motion, du: FloatArray, load0: FloatArray, load1: FloatArray
) -> float:
    """Motion and energies after the increment; returns a number that is finite if they are."""
    beta, gamma = modal.scheme[2], modal.scheme[3]
    kinetic, elastic, damped, external, size = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(len(du)):
        v0, a0 = x.v[i], x.a[i]
        x.u[i] += du[i]
        v1 = gamma / (beta * dt) * du[i] + (1 - gamma / beta) * v0
        v1 += dt * (1 - 0.5 * gamma / beta) * a0
        x.v[i] = v1
        x.a[i] = (du[i] / dt - v0) / (beta * dt) - (0.5 / beta - 1) * a0
        kinetic += modal.m[i] * v1 * v1
        elastic += modal.k[i] * x.u[i] * x.u[i]
        damped += modal.c[i] * du[i] * (v0 + v1)
        external += du[i] * (load0[i] + load1[i])
        size += abs(x.u[i])
    x.energies[KINETIC], x.energies[ELASTIC] = 0.5 * kinetic, 0.5 * elastic
    x.energies[DAMPED] += 0.5 * damped
    x.energies[EXTERNAL] += 0.5 * external
    return size


@compiled
def march_modal(
    modal: Modal,
    step: ModalStep,
    joints: Joints,
    x: Motion,
    factors: FloatArray,
    save: IntArray,
    rows: ModalRows,
    history: FloatArray,
) -> tuple[int, int, float]:
    """As `compiled_loop.march`; `x` and the rows hold reduced coordinates."""
    n, q, d, dt = len(x.u), len(x.delta), x.w.shape[1], step.dt
    share = 1 - modal.scheme[1]
    r, du, g1, load1 = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    y, f1, h = np.zeros(q), np.zeros(q), np.zeros(q)
    new = np.zeros((x.state.shape[0], x.state.shape[1]))
    D = np.zeros((x.w.shape[0], d, d))
    known = np.full((x.w.shape[0], d, d), np.nan)
    rq, dyq, deltaq, pivots = np.zeros(q), np.zeros(q), np.zeros(q), np.zeros(q, np.int64)
    Kq, Aq = np.zeros((q, q)), np.zeros((q, q))
    g = np.dot(modal.Jt, x.f) if q else np.zeros(n)
    load0 = np.dot(modal.forces, factors[0])
    worst = 0
    for k in range(len(save)):
        load1 = np.dot(modal.forces, factors[k + 1])
        _right_side(modal, dt, x, load0, load1, g, r)
        for i in range(n):
            du[i] = step.P[i] * r[i]
        if q:
            y0 = np.dot(modal.J, du)
            for i in range(q):
                y[i] = y0[i]
            turns, residual = iterate_cached(
                joints.pairs, joints.B, joints.weights, joints.codes, joints.p, step.S, share,
                x.delta, x.f, x.state, y0, y, x.w, x.t, new, D, f1, h, rq, dyq, deltaq, Kq, Aq,
                known, pivots,
            )  # fmt: skip
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            g1 = np.dot(modal.Jt, f1)
            for i in range(n):
                du[i] -= step.P[i] * share * (g1[i] - g[i])
            g = g1
            for i in range(q):
                x.delta[i] += y[i]
                x.f[i] = f1[i]
            x.state[:, :] = new
            rows.jumps[k] = x.w
        if not np.isfinite(_advance(modal, dt, x, du, load0, load1)):
            return k, -1, np.inf
        if q:
            stored, lost = interface_energies(
                joints.codes, joints.p, joints.weights, x.w, x.t, x.state
            )
            x.energies[STORED], x.energies[LOST] = stored, lost
        history[k] = x.energies
        if save[k] >= 0:
            row = save[k]
            rows.u[row], rows.v[row], rows.a[row] = x.u, x.v, x.a
            rows.w[row], rows.t[row], rows.state[row] = x.w, x.t, x.state
        load0 = load1
    return len(save), worst, 0.0
