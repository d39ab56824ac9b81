"""The whole time loop, compiled, for one coordinate and at most one joint that only opens.

The steps are those of `scalar_loop`. While the joint stays open, or stays closed, a step is one and
the same linear map; in the new acceleration, `share = 1 - alpha_f` and k with the closed joint's,

    D a1 = (D - m - share (c dt + k dt^2 / 2)) a - (c + share k dt) v - k u + load ,
    D = (1 - alpha_m) m + share (gamma dt c + beta dt^2 k) ,

so that the new u, v, a follow from the old ones by a few fused products side by side. A step that
finds the joint beyond its branch is made again by the law.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fused
from ssilang.kernel.interface.copies import copy_rows
from ssilang.kernel.interface.laws.sdm_law import normal_energy, opening_loss
from ssilang.kernel.stepping.rests.dense.loop import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
)
from ssilang.kernel.stepping.rests.modal.one_spring import (
    MOST_TURNS,
    Line,
    LineRows,
    LineState,
    Spring,
    closed_form,
)

STIFFEST = 10.0  # angle (rad) of a step beyond which rounding shows in the acceleration's form


class Mode(NamedTuple):
    """The coordinate: its diagonals, the jump it gives the joint, the scheme's numbers."""

    m: float
    c: float
    k: float
    b: float
    dt: float
    am: float
    af: float
    beta: float
    gamma: float


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
    m, c, b, dt = mode.m, mode.c, mode.b, mode.dt
    fc, weight = spring.fc, spring.weight
    held, side, limit, known = 0.0, 1.0, -np.inf, True
    if weight > 0.0:
        if spring.k * w <= fc:
            held, side, limit = spring.k, -1.0, fc / spring.k
        else:
            limit = xi if fc < 0.0 else 0.0
            known = spring.fu == 0.0 and t == 0.0 and w >= limit
    share, kappa = 1 - mode.af, weight * held
    k = mode.k + kappa * b * b
    D = (1 - mode.am) * m + share * dt * (mode.gamma * c + mode.beta * dt * k)
    ca = share * dt * ((mode.gamma - 1) * c + (mode.beta - 0.5) * dt * k) - mode.am * m
    offset = 0.0
    if weight > 0.0:
        stored = normal_energy(w, t, xi, spring.k, fc) - 0.5 * held * w * w
        offset = weight * (stored + opening_loss(xi, spring.fu, spring.gf))
    fits = known and m > 0.0 and k * dt * dt <= STIFFEST**2 * m
    return Branch(
        fits, -k / D, -(c + share * dt * k) / D, ca / D, 1.0 / D, -kappa * b * (w - b * u) / D,
        held, side, limit, offset,
    )  # fmt: skip


@compiled
def general_of(mode: Mode, spring: Spring) -> General:
    """What a step by the law needs."""
    m, c, beta, gamma, dt = mode.m, mode.c, mode.beta, mode.gamma, mode.dt
    share, mass = 1 - mode.af, 1 - mode.am
    p = 1.0 / (mass / (beta * dt**2) * m + share * (gamma / (beta * dt) * c + mode.k))
    keep, drift = 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    pv = mass / (beta * dt) * m - (share * keep + mode.af) * c
    pa = (mass * (0.5 / beta - 1) - mode.am) * m - share * drift * c
    pf = p * mode.b
    s = mode.b * pf * share * spring.weight
    closed = spring.fc / spring.k + s * spring.fc if spring.fc < 0.0 else 0.0
    return General(-p * mode.k, p * pv, p * pa, p, pf, s, 1 / (1 + s * spring.k), closed)


@compiled_fused
def by_law(mode: Mode, spring: Spring, g: General, x: State, load: float) -> State:
    """One step whatever the branch; w is not a number if the law has no answer."""
    u, v, a, w, t, xi = x
    dt, beta, gamma, change = mode.dt, mode.beta, mode.gamma, 0.0
    move = g.pu * u + g.pv * v + g.pa * a + g.p * load - g.pf * (spring.weight * t)
    if spring.weight > 0.0:
        old = t
        w, t, xi = closed_form(w + g.s * t + mode.b * move, g.s, g.soft, g.closed, xi, spring)
        change = (1 - mode.af) * spring.weight * (t - old)
    move -= g.pf * change
    v1 = gamma / (beta * dt) * move + (1 - gamma / beta) * v + dt * (1 - 0.5 * gamma / beta) * a
    a1 = 1 / (beta * dt**2) * move - 1 / (beta * dt) * v - (0.5 / beta - 1) * a
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
def _load(line: Line, factors: FloatArray, step: int) -> float:
    total = 0.0
    for j in range(line.forces.shape[0]):
        total += line.forces[j, 0] * factors[step, j]
    return total


@compiled_fused
def march_mode(
    line: Line, dt: float, spring: Spring, x: LineState, factors: FloatArray, save: IntArray,
    rows: LineRows, history: FloatArray,
) -> tuple[int, int, float]:  # fmt: skip
    """As `scalar_loop.march_line`, for one mode; `save` is the row of each step, or less than 0."""
    am, af, beta, gamma = line.scheme[0], line.scheme[1], line.scheme[2], line.scheme[3]
    m, c, k, weight = line.m[0], line.c[0], line.k[0], spring.weight
    b = line.b[0] if weight > 0.0 else 0.0
    mode = Mode(m, c, k, b, dt, am, af, beta, gamma)
    u, v, a, w, t, xi = x.u[0], x.v[0], x.a[0], x.joint[0], x.joint[1], x.joint[2]
    general, now = general_of(mode, spring), branch_of(mode, spring, (u, v, a, w, t, xi))
    du, dv, da = beta * dt * dt, gamma * dt, (0.5 - beta) * dt * dt
    lag, share, per_step = (1 - gamma) * dt, 1 - af, 1 / dt
    damped, external, worst = x.energies[DAMPED], x.energies[EXTERNAL], x.balance[1]
    start, base, follows = x.balance[0], w - b * u, spring.fc < 0.0
    loaded, keeps, limit = line.forces.shape[0] > 0, len(history) > 0, now.limit
    load0, load1, load = 0.0, 0.0, 0.0
    if loaded:
        load0 = _load(line, factors, 0)
    for step in range(len(save)):
        if loaded:
            load1 = _load(line, factors, step + 1)
            load = share * load1 + af * load0
        a1 = (now.cu * u + (now.push * load + now.constant)) + (now.cv * v + now.ca * a)
        u1 = u + (dt * v + (da * a + du * a1))
        v1 = v + (lag * a + dv * a1)
        w1 = b * u1 + base
        if now.fits and now.side * (w1 - limit) > 0.0:
            w, t, xi = w1, now.k * w1, max(xi, w1)
            if follows:
                limit = max(limit, w1) if now.side > 0.0 else limit
        else:
            u1, v1, a1, w, t, xi = by_law(mode, spring, general, (u, v, a, w, t, xi), load)
            if not np.isfinite(w):
                return step, -MOST_TURNS, abs(u)
            now, base = branch_of(mode, spring, (u1, v1, a1, w, t, xi)), w - b * u1
            limit = now.limit
        move = u1 - u
        u, v, a = u1, v1, a1
        damped += (c * per_step) * move * move
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
            store((u, v, a, w, t, xi), mode, spring, (damped, external), history[step])
        if save[step] >= 0:
            row = save[step]
            rows.u[row, 0], rows.v[row, 0], rows.a[row, 0] = u, v, a
            rows.joint[row, 0], rows.joint[row, 1], rows.joint[row, 2] = w, t, xi
    x.u[0], x.v[0], x.a[0], x.joint[0], x.joint[1], x.joint[2] = u, v, a, w, t, xi
    store((u, v, a, w, t, xi), mode, spring, (damped, external), x.energies)
    x.balance[1] = worst
    return len(save), 1, 0.0


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
