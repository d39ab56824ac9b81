"""The whole time loop, compiled, for one coordinate and at most one joint that only opens.

The joint is one point of the Strong Discontinuity law whose shear cannot move: its normal law is
piecewise linear, so the step's equation

    w + S c W t(w) = w_free ,   w_free = w_0 + y_0 + S c f_0

(W weight of the point, S compliance, c share of the joint in the scheme's balance) has its answer
in closed form; softening alone takes a scalar Newton iteration. While the joint stays open, or
stays closed, a step is one and the same linear map; in the new acceleration, `end = 1 - alpha_f`
and k with the closed joint's,

    D a1 = (D - m - end (c dt + k dt^2 / 2)) a - (c + end k dt) v - k u + load ,
    D = (1 - alpha_m) m + end (gamma dt c + beta dt^2 k) ,

so that the new u, v, a follow from the old ones by a few fused products side by side. A step that
finds the joint beyond its branch is made again by the law.
"""

import math
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast, compiled_fused
from ssilang.kernel.interface.copies import copy_rows
from ssilang.kernel.interface.laws.sdm_law import normal_energy, normal_law, opening_loss
from ssilang.kernel.stepping.newmark import Newmark
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
from ssilang.kernel.stepping.verbs import advance, from_past

MOST_TURNS = 60
CLOSE = 1e-15  # of the jump: last change of the iteration on softening
STIFFEST = 10.0  # angle (rad) of a step beyond which rounding shows in the acceleration's form


class Spring(NamedTuple):
    """The joint: weight, k, FU, GF, FC; all zero for none."""

    weight: float
    k: float
    fu: float
    gf: float
    fc: float


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


class Mode(NamedTuple):
    """The coordinate: its diagonals, the jump b it gives the joint."""

    m: float
    c: float
    k: float
    b: float
    newmark: Newmark


class Branch(NamedTuple):
    """A linear step `a1 = cu u + cv v + ca a + push load + constant`, traction `k w`.

    It holds while `side (w - limit) > 0`, never if not `fits`; the joint's energy is
    `0.5 W k w^2 + offset`.
    """

    fits: bool
    cu: float
    cv: float
    ca: float
    push: float
    constant: float
    k: float
    side: float
    limit: float
    offset: float


class General(NamedTuple):
    """A step by the law: `du = pu u + pv v + pa a + p load - pf f`, and `closed_form`'s numbers."""

    pu: float
    pv: float
    pa: float
    p: float
    pf: float
    s: float
    soft: float
    closed: float


State = tuple[float, float, float, float, float, float]
"""u, v, a of the coordinate, w, t, xi of the joint."""


@compiled
def branch_of(mode: Mode, spring: Spring, x: State) -> Branch:
    """The branch on which a step ended."""
    u, _, _, w, t, xi = x
    m, c, b, n = mode.m, mode.c, mode.b, mode.newmark
    fc, weight = spring.fc, spring.weight
    held, side, limit, known = 0.0, 1.0, -np.inf, True
    if weight > 0.0:
        if spring.k * w <= fc:
            held, side, limit = spring.k, -1.0, fc / spring.k
        else:
            limit = xi if fc < 0.0 else 0.0
            known = spring.fu == 0.0 and t == 0.0 and w >= limit
    kappa = weight * held
    k = mode.k + kappa * b * b
    D = n.inertia_end * m + n.end * (n.v_a1 * c + n.u_a1 * k)
    ca = -n.end * (n.v_a0 * c + n.u_a0 * k) - n.inertia_start * m
    offset = 0.0
    if weight > 0.0:
        stored = normal_energy(w, t, xi, spring.k, fc) - 0.5 * held * w * w
        offset = weight * (stored + opening_loss(xi, spring.fu, spring.gf))
    fits = known and m > 0.0 and k * n.dt * n.dt <= STIFFEST**2 * m
    return Branch(
        fits, -k / D, -(c + n.end * n.dt * k) / D, ca / D, 1.0 / D, -kappa * b * (w - b * u) / D,
        held, side, limit, offset,
    )  # fmt: skip


@compiled
def general_of(mode: Mode, spring: Spring) -> General:
    """What a step by the law needs."""
    m, c, n = mode.m, mode.c, mode.newmark
    p = 1.0 / (n.mass * m + n.damping * c + n.end * mode.k)
    pv, pa = p * from_past(n, m, 0.0, c, 0.0), p * from_past(n, 0.0, m, 0.0, c)
    pf = p * mode.b
    s = mode.b * pf * n.end * spring.weight
    closed = spring.fc / spring.k + s * spring.fc if spring.fc < 0.0 else 0.0
    return General(-p * mode.k, pv, pa, p, pf, s, 1 / (1 + s * spring.k), closed)


@compiled_fused
def by_law(mode: Mode, spring: Spring, g: General, x: State, load: float) -> State:
    """One step whatever the branch; w is not a number if the law has no answer."""
    u, v, a, w, t, xi = x
    change = 0.0
    move = g.pu * u + g.pv * v + g.pa * a + g.p * load - g.pf * (spring.weight * t)
    if spring.weight > 0.0:
        old = t
        w, t, xi = closed_form(w + g.s * t + mode.b * move, g.s, g.soft, g.closed, xi, spring)
        change = mode.newmark.end * spring.weight * (t - old)
    move -= g.pf * change
    v1, a1 = advance(mode.newmark, move, v, a)
    return u + move, v1, a1, w, t, xi


@compiled
def store(x: State, mode: Mode, spring: Spring, work: tuple[float, float], to: FloatArray) -> None:
    """Energies of an instant; `work` is what was damped, and done from outside."""
    u, v, _, w, t, xi = x
    to[KINETIC], to[ELASTIC] = 0.5 * mode.m * v * v, 0.5 * mode.k * u * u
    to[STORED], to[LOST] = 0.0, 0.0
    to[DAMPED], to[EXTERNAL] = work
    if spring.weight > 0.0:
        to[STORED] = spring.weight * normal_energy(w, t, xi, spring.k, spring.fc)
        to[LOST] = spring.weight * opening_loss(xi, spring.fu, spring.gf)


@compiled
def _load(forces: FloatArray, factors: FloatArray, step: int) -> float:
    total = 0.0
    for j in range(len(forces)):
        total += forces[j] * factors[step, j]
    return total


@compiled_fused
def run_one_mode(
    mode: Mode, spring: Spring, forces: FloatArray, x: Motion, factors: FloatArray, to: Recorder
) -> tuple[int, int, float]:
    """As `run_reduced`, on jumps w and tractions t (1, 1), the opening xi as the state (1, 1).

    `forces` (n_loads,) are the loads on the coordinate. Steps without room for their energies leave
    those of the end alone, and the balance.
    """
    m, c, k, b, n, weight, row = (
        mode.m, mode.c, mode.k, mode.b, mode.newmark, spring.weight, to.row,
    )  # fmt: skip
    u, v, a, w, t, xi = x.u[0], x.v[0], x.a[0], x.w[0, 0], x.t[0, 0], x.state[0, 0]
    general, now = general_of(mode, spring), branch_of(mode, spring, (u, v, a, w, t, xi))
    damped, external, worst = x.energies[DAMPED], x.energies[EXTERNAL], to.balance[1]
    start, base, follows, half = to.balance[0], w - b * u, spring.fc < 0.0, 0.5 * c
    loaded, keeps, limit = len(forces) > 0, len(to.energies) > 0, now.limit
    load0, load1, load = 0.0, 0.0, 0.0
    if loaded:
        load0 = _load(forces, factors, 0)
    for step in range(len(row)):
        if loaded:
            load1 = _load(forces, factors, step + 1)
            load = n.end * load1 + n.start * load0
        # predict and advance on the branch of the step before, by accelerations
        a1 = (now.cu * u + (now.push * load + now.constant)) + (now.cv * v + now.ca * a)
        u1 = u + (n.dt * v + (n.u_a0 * a + n.u_a1 * a1))
        v1 = v + (n.v_a0 * a + n.v_a1 * a1)
        w1 = b * u1 + base
        if now.fits and now.side * (w1 - limit) > 0.0:
            w, t, xi = w1, now.k * w1, max(xi, w1)
            if follows:
                limit = max(limit, w1) if now.side > 0.0 else limit
        else:  # solve: the joint has left its branch
            u1, v1, a1, w, t, xi = by_law(mode, spring, general, (u, v, a, w, t, xi), load)
            if not np.isfinite(w):
                return step, -MOST_TURNS, abs(u)
            now, base = branch_of(mode, spring, (u1, v1, a1, w, t, xi)), w - b * u1
            limit = now.limit
        # account
        move = u1 - u
        damped += half * move * (v + v1)
        u, v, a = u1, v1, a1
        if loaded:
            external += 0.5 * move * (load0 + load1)
            load0 = load1
        elastic = k * u * u + weight * now.k * w * w
        total = 0.5 * (m * v * v + elastic) + (now.offset + (damped - external))
        apart = abs(total - start)
        if not apart <= worst:
            if not np.isfinite(apart):
                return step, -1, np.inf
            worst = apart
        if keeps:
            store((u, v, a, w, t, xi), mode, spring, (damped, external), to.energies[step])
        if row[step] >= 0:
            at = row[step]
            to.u[at, 0], to.v[at, 0], to.a[at, 0] = u, v, a
            to.w[at, 0, 0], to.t[at, 0, 0], to.state[at, 0, 0] = w, t, xi
        if to.tap.row[step] >= 0:
            at = to.tap.row[step]
            to.tap.u[at, 0], to.tap.v[at, 0], to.tap.a[at, 0] = u, v, a
            if weight > 0.0:
                to.tap.w[at, 0, 0], to.tap.t[at, 0, 0], to.tap.state[at, 0, 0] = w, t, xi
    x.u[0], x.v[0], x.a[0], x.w[0, 0], x.t[0, 0], x.state[0, 0] = u, v, a, w, t, xi
    store((u, v, a, w, t, xi), mode, spring, (damped, external), x.energies)
    to.balance[1] = worst
    return len(row), 1, 0.0


@compiled
def carry(map: FloatArray, save: IntArray, x: FloatArray, rows: FloatArray) -> None:
    """States x (2, k) led on by a linear map (2, 2) a step, put into rows (2, n, k).

    For motions that follow Newmark's formulas without moving.
    """
    done = 0
    for step in range(len(save)):
        if save[step] >= 0 or step == len(save) - 1:
            _lead(map, step + 1 - done, x)
            done = step + 1
            if save[step] >= 0:
                copy_rows(x, rows[:, save[step]])


@compiled
def _lead(map: FloatArray, count: int, x: FloatArray) -> None:
    """x = map^count x, by squares."""
    p, q, r, s = map[0, 0], map[0, 1], map[1, 0], map[1, 1]
    while count > 0:
        if count % 2 == 1:
            for i in range(x.shape[1]):
                v, a = x[0, i], x[1, i]
                x[0, i], x[1, i] = p * v + q * a, r * v + s * a
        p, q, r, s = p * p + q * r, q * (p + s), r * (p + s), s * s + q * r
        count //= 2
