"""The whole time loop, compiled, for a few diagonal coordinates and one joint that only opens.

The steps are those of `loop`. The joint is one point of the Strong Discontinuity law whose
shear cannot move: its normal law is piecewise linear, so the step's equation

    w + S c W t(w) = w_free ,   w_free = w_0 + y_0 + S c f_0

(W weight of the point, S compliance, c share of the joint in the scheme's balance) has its answer
in closed form; softening alone takes a scalar Newton iteration.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.interface.copies import copy_state
from ssilang.kernel.interface.laws.sdm_law import normal_energy, normal_law, opening_loss
from ssilang.kernel.stepping.newmark import Newmark, from_past
from ssilang.kernel.stepping.rests.modal.diagonal import Diagonal
from ssilang.kernel.stepping.state import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
    Motion,
    Recorder,
)
from ssilang.kernel.stepping.verbs import advance, keep, tap

MOST_TURNS = 60
CLOSE = 1e-15  # of the jump: last change of the iteration on softening


class Spring(NamedTuple):
    """The joint: weight, k, FU, GF, FC; all zero for none."""

    weight: float
    k: float
    fu: float
    gf: float
    fc: float


class Line(NamedTuple):
    """Modes seen by the joint: diagonals (r,), jump b of each, loads (n_loads, r)."""

    newmark: Newmark
    diagonal: Diagonal
    b: FloatArray
    forces: FloatArray


@compiled_fast
def closed_form(
    free: float, s: float, soft: float, closed: float, xi: float, spring: Spring
) -> tuple[float, float, float]:
    """w, t, xi of `w + s t(w) = free`, s = S c W >= 0; w is not a number if none was found.

    `soft` is `1 / (1 + s k)`; the point is closed for `free <= closed`.
    """
    k, fu, fc = spring.k, spring.fu, spring.fc
    if fu == 0.0 and free >= xi:
        return free, 0.0, free
    if free <= closed:
        w = free * soft
        return w, k * w, xi
    if free <= xi:
        slope = -k * fc / (k * xi - fc) if fc < 0.0 else 0.0
        w = (free + s * slope * xi) / (1.0 + s * slope)
        return w, slope * (w - xi), xi
    w = (free + s * k * xi) * soft
    if k * (w - xi) <= fu * math.exp(-fu / spring.gf * xi):
        return w, k * (w - xi), xi
    return _softening(free, s, xi, w, spring)


@compiled_fast
def _softening(
    free: float, s: float, xi: float, w: float, spring: Spring
) -> tuple[float, float, float]:
    """Newton's method on the softening branch, from the elastic answer w."""
    for _ in range(MOST_TURNS):
        t, new, slope = normal_law(w, xi, spring.k, spring.fu, spring.gf, spring.fc)
        change = (free - w - s * t) / (1.0 + s * slope)
        w += change
        if abs(change) <= CLOSE * max(abs(w), abs(free)):
            t, new, slope = normal_law(w, xi, spring.k, spring.fu, spring.gf, spring.fc)
            return w, t, new
    return math.nan, 0.0, xi


class LinearStep(NamedTuple):
    """Increments `du = pu u + pv v + pa a + P load - pf f` (r,), and `closed_form`'s numbers.

    `du` and the loads at both ends, `load0` and `load1` (r,), each step overwrites.
    """

    pu: FloatArray
    pv: FloatArray
    pa: FloatArray
    pf: FloatArray
    s: float
    soft: float
    closed: float
    du: FloatArray
    load0: FloatArray
    load1: FloatArray


def linear_step(line: Line, spring: Spring) -> LinearStep:
    """What the past and the joint's force f make of each coordinate."""
    n, diagonal, none = line.newmark, line.diagonal, np.zeros(len(line.b))
    m, c, P = diagonal.m, diagonal.c, diagonal.P
    pf = line.b * P
    s, closed = float(line.b @ pf) * n.end * spring.weight, 0.0
    if spring.fc < 0.0:
        closed = spring.fc / spring.k + s * spring.fc
    return LinearStep(
        -P * diagonal.k, P * from_past(n, m, none, c, none), P * from_past(n, none, m, none, c),
        pf, s, 1.0 / (1.0 + s * spring.k), closed, none, none.copy(), none.copy(),
    )  # fmt: skip


@compiled_fast
def run_one_spring(
    line: Line, spring: Spring, step: LinearStep, x: Motion, factors: FloatArray, to: Recorder
) -> tuple[int, int, float]:
    """As `run_modal`, on jumps w and tractions t (1, 1) and the opening xi as the state (1, 1).

    Steps without room for their energies leave those of the end alone, and the balance.
    """
    n, diagonal, b = line.newmark, line.diagonal, line.b
    r, loads, weight = len(x.u), line.forces.shape[0], spring.weight
    du, load0, load1 = step.du, step.load0, step.load1
    for i in range(r):
        load0[i] = 0.0
        for j in range(loads):
            load0[i] += line.forces[j, i] * factors[0, j]
    w, t, xi = x.w[0, 0], x.t[0, 0], x.state[0, 0]
    damped, external = x.energies[DAMPED], x.energies[EXTERNAL]
    worst, keeps, steps = to.balance[1], len(to.energies) > 0, len(to.row)
    for k in range(steps):
        # predict: increments and jump, the joint's force as it is
        f0, free = weight * t, w + step.s * t
        for i in range(r):
            move = step.pu[i] * x.u[i] + step.pv[i] * x.v[i] + step.pa[i] * x.a[i]
            move -= step.pf[i] * f0
            if loads:
                load1[i] = 0.0
                for j in range(loads):
                    load1[i] += line.forces[j, i] * factors[k + 1, j]
                move += diagonal.P[i] * (n.end * load1[i] + n.start * load0[i])
            du[i] = move
            free += b[i] * move
        # solve: the joint's law in closed form
        change = 0.0
        if weight > 0.0:
            old = t
            w, t, xi = closed_form(free, step.s, step.soft, step.closed, xi, spring)
            if not np.isfinite(w):
                return k, -1 if np.isfinite(free) else -MOST_TURNS, abs(free)
            change = n.end * weight * (t - old)
        # advance and account
        kinetic, elastic, size = 0.0, 0.0, 0.0
        for i in range(r):
            move, v0 = du[i] - step.pf[i] * change, x.v[i]
            u1 = x.u[i] + move
            v1, x.a[i] = advance(n, move, v0, x.a[i])
            x.u[i], x.v[i] = u1, v1
            kinetic += diagonal.m[i] * v1 * v1
            elastic += diagonal.k[i] * u1 * u1
            damped += 0.5 * diagonal.c[i] * move * (v0 + v1)
            size += abs(u1)
            if loads:
                external += 0.5 * move * (load0[i] + load1[i])
                load0[i] = load1[i]
        if not np.isfinite(size):
            return k, -1, np.inf
        stored, lost = 0.0, 0.0
        if weight > 0.0:
            stored = weight * normal_energy(w, t, xi, spring.k, spring.fc)
            lost = weight * opening_loss(xi, spring.fu, spring.gf)
        total = 0.5 * (kinetic + elastic) + stored + lost + damped - external
        worst = max(worst, abs(total - to.balance[0]))
        if keeps or k == steps - 1:
            x.energies[KINETIC], x.energies[ELASTIC] = 0.5 * kinetic, 0.5 * elastic
            x.energies[STORED], x.energies[LOST] = stored, lost
            x.energies[DAMPED], x.energies[EXTERNAL] = damped, external
            if keeps:
                copy_state(x.energies, to.energies[k])
        if to.row[k] >= 0 or to.tap.row[k] >= 0:
            x.w[0, 0], x.t[0, 0], x.state[0, 0] = w, t, xi
            if to.row[k] >= 0:
                keep(x, to, to.row[k])
            if to.tap.row[k] >= 0:
                tap(x, to.tap, to.tap.row[k])
    x.w[0, 0], x.t[0, 0], x.state[0, 0] = w, t, xi
    to.balance[1] = worst
    return steps, 1, 0.0


def step_one_spring(
    line: Line, spring: Spring, x: Motion, factors: FloatArray, to: Recorder
) -> tuple[int, int, float]:
    """Steps of a line by `run_one_spring`."""
    return run_one_spring(line, spring, linear_step(line, spring), x, factors, to)
