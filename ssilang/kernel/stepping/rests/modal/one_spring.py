"""The whole time loop, compiled, for a few diagonal coordinates and one joint that only opens.

The steps are those of `modal_loop`. The joint is one point of the Strong Discontinuity law whose
shear cannot move: its normal law is piecewise linear, so the step's equation

    w + S c W t(w) = w_free ,   w_free = w_0 + y_0 + S c f_0

(W weight of the point, S compliance, c share of the joint in the scheme's balance) has its answer
in closed form; softening alone takes a scalar Newton iteration.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.interface.laws.sdm_law import normal_energy, normal_law, opening_loss
from ssilang.kernel.stepping.rests.dense.loop import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
)

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
    """Modes seen by the joint: diagonals (r,), jump of each, loads (n_loads, r), scheme."""

    m: FloatArray
    c: FloatArray
    k: FloatArray
    b: FloatArray
    forces: FloatArray
    scheme: FloatArray


class LineState(NamedTuple):
    """State, changed in place: modes (r,), joint (w, t, xi), energies as in `compiled_loop`.

    `balance` is the sum of energies at the start of the run, and how far it was left at most.
    """

    u: FloatArray
    v: FloatArray
    a: FloatArray
    joint: FloatArray
    energies: FloatArray
    balance: FloatArray


class LineRows(NamedTuple):
    """Steps that are kept: modes (n, r), joints (n, 3)."""

    u: FloatArray
    v: FloatArray
    a: FloatArray
    joint: FloatArray


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


@compiled_fast
def march_line(
    line: Line,
    dt: float,
    P: FloatArray,
    spring: Spring,
    x: LineState,
    factors: FloatArray,
    save: IntArray,
    rows: LineRows,
    history: FloatArray,
) -> tuple[int, int, float]:
    """As `compiled_loop.march`; P (r,) is the inverse of the step's diagonal matrix.

    An empty history keeps no energies.
    """
    am, af, beta, gamma = line.scheme[0], line.scheme[1], line.scheme[2], line.scheme[3]
    rate, keep, drift = gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    bend, slow, late = 1 / (beta * dt**2), 1 / (beta * dt), 0.5 / beta - 1
    r, share, loads, per_step = len(x.u), 1 - af, line.forces.shape[0], 1 / dt
    # du = Pu u + Pv v + Pa a + Pf f + P (load)
    Pu, Pv, Pa, Pf = np.zeros(r), np.zeros(r), np.zeros(r), np.zeros(r)
    du, load0, load1 = np.zeros(r), np.zeros(r), np.zeros(r)
    compliance = 0.0
    for i in range(r):
        m, c = line.m[i], line.c[i]
        Pu[i] = -P[i] * line.k[i]
        Pv[i] = P[i] * ((1 - am) / (beta * dt) * m - (share * keep + af) * c)
        Pa[i] = P[i] * (((1 - am) * late - am) * m - share * drift * c)
        Pf[i] = P[i] * line.b[i]
        compliance += line.b[i] * Pf[i]
        for j in range(loads):
            load0[i] += line.forces[j, i] * factors[0, j]
    s = compliance * share * spring.weight
    soft, closed = 1.0 / (1.0 + s * spring.k), 0.0
    if spring.fc < 0.0:
        closed = spring.fc / spring.k + s * spring.fc
    w, t, xi = x.joint[0], x.joint[1], x.joint[2]
    damped, external = x.energies[DAMPED], x.energies[EXTERNAL]
    worst, keeps = x.balance[1], len(history) > 0
    for step in range(len(save)):
        f0 = spring.weight * t
        free = w + s * t
        for i in range(r):
            total = Pu[i] * x.u[i] + Pv[i] * x.v[i] + Pa[i] * x.a[i] - Pf[i] * f0
            if loads:
                load1[i] = 0.0
                for j in range(loads):
                    load1[i] += line.forces[j, i] * factors[step + 1, j]
                total += P[i] * (share * load1[i] + af * load0[i])
            du[i] = total
            free += line.b[i] * total
        change = 0.0
        if spring.weight > 0.0:
            old = t
            w, t, xi = closed_form(free, s, soft, closed, xi, spring)
            if not np.isfinite(w):
                return step, -1 if np.isfinite(free) else -MOST_TURNS, abs(free)
            change = share * spring.weight * (t - old)
        kinetic, elastic, size = 0.0, 0.0, 0.0
        for i in range(r):
            move = du[i] - Pf[i] * change
            v0, a0 = x.v[i], x.a[i]
            u1 = x.u[i] + move
            v1 = rate * move + keep * v0 + drift * a0
            x.u[i] = u1
            x.v[i] = v1
            x.a[i] = bend * move - slow * v0 - late * a0
            kinetic += line.m[i] * v1 * v1
            elastic += line.k[i] * u1 * u1
            damped += line.c[i] * move * move * per_step
            size += abs(u1)
            if loads:
                external += 0.5 * move * (load0[i] + load1[i])
                load0[i] = load1[i]
        if not np.isfinite(size):
            return step, -1, np.inf
        stored, lost = 0.0, 0.0
        if spring.weight > 0.0:
            stored = spring.weight * normal_energy(w, t, xi, spring.k, spring.fc)
            lost = spring.weight * opening_loss(xi, spring.fu, spring.gf)
        total = 0.5 * (kinetic + elastic) + stored + lost + damped - external
        worst = max(worst, abs(total - x.balance[0]))
        if keeps or step == len(save) - 1:
            x.energies[KINETIC], x.energies[ELASTIC] = 0.5 * kinetic, 0.5 * elastic
            x.energies[STORED], x.energies[LOST] = stored, lost
            x.energies[DAMPED], x.energies[EXTERNAL] = damped, external
            if keeps:
                for i in range(len(x.energies)):
                    history[step, i] = x.energies[i]
        if save[step] >= 0:
            row = save[step]
            for i in range(r):
                rows.u[row, i], rows.v[row, i], rows.a[row, i] = x.u[i], x.v[i], x.a[i]
            rows.joint[row, 0], rows.joint[row, 1], rows.joint[row, 2] = w, t, xi
    x.joint[0], x.joint[1], x.joint[2] = w, t, xi
    x.balance[1] = worst
    return len(save), 1, 0.0
