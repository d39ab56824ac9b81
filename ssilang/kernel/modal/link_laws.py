"""Forces of links, compiled: contacts, friction, plastic springs, couplings of modes."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.modal.links import (
    A0,
    CIRCLE,
    COSINE,
    COSINE_OF_TIME,
    CUMULATED,
    DAMP,
    DX,
    EX,
    EXPONENT,
    F0,
    FACTOR,
    FN,
    FORCE,
    FREQUENCY,
    FRICTION,
    FT,
    GAP,
    KINEMATIC,
    NX,
    NY,
    NZ,
    OUTSIDE,
    PERMANENT,
    PLANE,
    PLASTIC,
    PLASTIC_PART,
    PLASTIC_SUM,
    POWER,
    S0,
    SINE,
    SINE_OF_TIME,
    SLIDE,
    STICK,
    STICKS,
    STIFF,
    T0,
    TANGENT,
    TANGENT_DAMP,
    TOUCHES,
    VN,
    VT,
    WEAR,
    XP,
    LinkArrays,
    X,
)


@compiled
def on_law(x: float, law: FloatArray, size: int) -> float:
    """Force at an overlap, straight lines between the points and beyond the last."""
    i = 1
    while i < size - 1 and x > law[i, 0]:
        i += 1
    slope = (law[i, 1] - law[i - 1, 1]) / (law[i, 0] - law[i - 1, 0])
    return float(law[i - 1, 1] + slope * (x - law[i - 1, 0]))


@compiled
def strength(
    p: float, law: FloatArray, size: int, upwards: bool
) -> tuple[float, float, float, float]:
    """Force of the plastic part of a law at a plastic displacement p, slope and ends of its line.

    At a corner: of the line that follows `upwards`, else of the one before.
    """
    k = (law[1, 1] - law[0, 1]) / (law[1, 0] - law[0, 0])
    for i in range(2, size):
        begin, end = law[i - 1, 0] - law[i - 1, 1] / k, law[i, 0] - law[i, 1] / k
        near = p * (1.0 + 1e-12) if upwards else p * (1.0 - 1e-12)
        if near < end or i == size - 1:
            slope = (law[i, 1] - law[i - 1, 1]) / (end - begin)
            if i == size - 1:
                end = np.inf
            return law[i - 1, 1] + slope * (p - begin), slope, begin, end
    return law[1, 1], 0.0, 0.0, np.inf


@compiled
def plastic_force(x: float, row: FloatArray, law: FloatArray, size: int, s: FloatArray) -> float:
    """Force of an elastic-plastic spring at an overlap x; its plastic part moves in `s`."""
    k = (law[1, 1] - law[0, 1]) / (law[1, 0] - law[0, 0])
    force = k * (x - s[XP])
    if row[PERMANENT] == 0.0 and force <= 0.0:
        return 0.0
    for _ in range(2 * size + 2):  # each pass leaves one line of the law, down and up again
        if row[KINEMATIC] != 0.0:
            p = abs(s[XP])
            sign = np.sign(s[XP]) if p > 1e-12 * law[1, 0] else np.sign(force)
            now, slope, begin, end = strength(p, law, size, True)
            back = sign * (now - law[1, 1])
            pushing = np.sign(force - back)
            over = abs(force - back) - law[1, 1]
            room = end - p
            if pushing * sign < 0.0:
                now, slope, begin, end = strength(p, law, size, False)
                room = p - begin
        else:
            now, slope, begin, end = strength(s[CUMULATED], law, size, True)
            pushing = np.sign(force)
            over = abs(force) - now
            room = end - s[CUMULATED]
        if over <= 1e-12 * law[1, 1]:
            break
        flow = min(over / (k + slope), room)
        s[XP] += pushing * flow
        s[CUMULATED] += flow
        force = k * (x - s[XP])
    return float(force)


@compiled
def normal_force(
    x: float, v: float, row: FloatArray, law: FloatArray, size: int, s: FloatArray
) -> float:
    """Push of the obstacle at an overlap x (positive when in touch) and its rate v."""
    permanent = row[PERMANENT] != 0.0
    if row[PLASTIC] != 0.0:
        force = plastic_force(x, row, law, size, s)
        touches = permanent or force > 0.0
    else:
        touches = permanent or x > 0.0
        force = 0.0
        if touches:
            force = row[STIFF] * x if size == 0 else np.sign(x) * on_law(abs(x), law, size)
    if not touches:
        return 0.0
    force += row[DAMP] * v
    return float(force if permanent else max(0.0, force))


@compiled
def friction(
    push: float, xt: FloatArray, vt: FloatArray, drive: FloatArray, t: float, row: FloatArray,
    s: FloatArray,
) -> tuple[float, float, float]:  # fmt: skip
    """Tangential force by sticking springs (Antunes) or a regularised sliding law (Oden).

    `xt` and `vt` are the tangential motion and the sliding velocity over an obstacle that moves at
    the velocity `drive`.
    """
    speed = np.sqrt(vt[0] * vt[0] + vt[1] * vt[1] + vt[2] * vt[2])
    slide = row[SLIDE] * push
    if row[TANGENT] < 0.0:
        limit = row[TANGENT_DAMP]
        part = speed / limit
        if speed == 0.0:
            return 0.0, 0.0, 0.0
        size = slide * (2.0 - part) * part if part < 1.0 else slide
        return -size * vt[0] / speed, -size * vt[1] / speed, -size * vt[2] / speed
    if s[TOUCHES] == 0.0:  # a new contact sticks
        s[STICKS], s[T0] = 1.0, t
        for i in range(3):
            s[A0 + i], s[F0 + i] = xt[i], 0.0
    if s[STICKS] == 0.0:
        back = vt[0] * s[S0] + vt[1] * s[S0 + 1] + vt[2] * s[S0 + 2] <= 0.0
        if not back:
            for i in range(3):
                s[S0 + i] = vt[i] / speed
            return -slide * vt[0] / speed, -slide * vt[1] / speed, -slide * vt[2] / speed
        s[STICKS], s[T0] = 1.0, t
        for i in range(3):
            s[A0 + i], s[F0 + i] = xt[i], -slide * s[S0 + i]
    f = np.empty(3)
    for i in range(3):
        moved = xt[i] - s[A0 + i] - drive[i] * (t - s[T0])
        f[i] = s[F0 + i] - row[TANGENT] * moved - row[TANGENT_DAMP] * vt[i]
    size = np.sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2])
    if size > row[STICK] * push:
        s[STICKS] = 0.0
        for i in range(3):
            s[S0 + i] = -f[i] / size
            f[i] *= slide / size
    return f[0], f[1], f[2]


@compiled
def contact(
    links: LinkArrays, i: int, x: FloatArray, v: FloatArray, t: float, s: FloatArray,
    f: FloatArray, record: FloatArray,
) -> None:  # fmt: skip
    """Force of link i, a plane or a circle, on a relative motion; fills `f` and `record`."""
    kind, row = links.kinds[i], links.numbers[i]
    n = np.empty(3)
    overlap = 0.0
    if kind == PLANE:
        for c in range(3):
            n[c] = row[NX + c]
            overlap += x[c] * n[c]
        overlap -= row[GAP]
    else:
        along = x[0] * row[NX] + x[1] * row[NY] + x[2] * row[NZ]
        for c in range(3):
            n[c] = x[c] - along * row[NX + c] - row[EX + c]
        radius = np.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
        sense = -1.0 if row[OUTSIDE] != 0.0 else 1.0
        overlap = sense * (radius - row[GAP])
        for c in range(3):
            n[c] = sense * n[c] / radius if radius > 0.0 else 0.0
    rate = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    push = normal_force(overlap, rate, row, links.laws[i], links.law_sizes[i], s)
    for c in range(3):
        f[c] = -push * n[c]
    record[FN], record[VN] = -push, rate
    record[PLASTIC_PART], record[PLASTIC_SUM] = s[XP], s[CUMULATED]
    if row[FRICTION] != 0.0 and push > 0.0:
        drive = velocity_of_obstacle(kind, n, row)
        ft, speed = rub(push, n, x, v, drive, t, row, s)
        for c in range(3):
            f[c] += ft[c]
            record[FT + c] = ft[c]
        record[VT], record[WEAR] = speed, push * speed
    s[TOUCHES] = 1.0 if push > 0.0 else 0.0


@compiled
def velocity_of_obstacle(kind: int, n: FloatArray, row: FloatArray) -> FloatArray:
    """Velocity of the plane, or of the turning circle (its speed is in DX) along its tangent."""
    if kind == PLANE:
        return row[DX : DX + 3].copy()
    out = np.empty(3)
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        out[i] = row[DX] * (row[NX + j] * n[k] - row[NX + k] * n[j])
    return out


@compiled
def rub(
    push: float, n: FloatArray, x: FloatArray, v: FloatArray, drive: FloatArray, t: float,
    row: FloatArray, s: FloatArray,
) -> tuple[tuple[float, float, float], float]:  # fmt: skip
    """Friction of a contact, and the speed of sliding."""
    xn = x[0] * n[0] + x[1] * n[1] + x[2] * n[2]
    vn = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    xt, vt = np.empty(3), np.empty(3)
    for i in range(3):
        xt[i] = x[i] - xn * n[i]
        vt[i] = v[i] - vn * n[i] - drive[i]
    ft = friction(push, xt, vt, drive, t, row, s)
    sliding = row[TANGENT] < 0.0 or s[STICKS] == 0.0
    speed: float = np.sqrt(vt[0] ** 2 + vt[1] ** 2 + vt[2] ** 2) if sliding else 0.0
    return ft, speed


@compiled
def coupling(kind: int, x: float, v: float, t: float, row: FloatArray) -> float:
    """Force of a coupling of modes on the displacement x and velocity v of another."""
    factor = row[FACTOR]
    if kind == POWER:
        return float(factor * x ** row[EXPONENT])
    if kind == SINE:
        return float(factor * np.sin(x))
    if kind == COSINE:
        return float(factor * np.cos(x))
    if kind == COSINE_OF_TIME:
        return float(factor * np.cos(row[FREQUENCY] * t) * x)
    if kind == SINE_OF_TIME:
        return float(factor * np.sin(row[FREQUENCY] * t) * x)
    return float(factor * v)


@apart
@compiled
def link_forces(
    q: FloatArray, v: FloatArray, t: float, links: LinkArrays,
    state: FloatArray, record: FloatArray, total: FloatArray,
) -> None:  # fmt: skip
    """Forces of all links on the modes, into `total` (n,); `state` and `record` are filled."""
    kinds, receives, sees = links.kinds, links.receives, links.sees
    count, n = receives.shape[0], q.shape[0]
    total[:] = 0.0
    forces = np.zeros((count, 3))
    for i in range(count):
        x, rate = np.zeros(3), np.zeros(3)
        for c in range(3):
            for j in range(n):
                x[c] += sees[i, c, j] * q[j]
                rate[c] += sees[i, c, j] * v[j]
            record[i, X + c] = x[c]
        record[i, FN : FORCE + 1] = 0.0
        if kinds[i] <= CIRCLE:
            contact(links, i, x, rate, t, state[i], forces[i], record[i])
        else:
            forces[i, 0] = coupling(kinds[i], x[0], rate[0], t, links.numbers[i])
            record[i, FN], record[i, VN] = forces[i, 0], rate[0]
        record[i, FORCE] = np.sqrt(forces[i, 0] ** 2 + forces[i, 1] ** 2 + forces[i, 2] ** 2)
    for i in range(count):
        acts = True
        for k in range(count):
            pushes = record[k, FORCE] > 1e-20
            wanted = links.conditions[i, k]
            if (wanted == 1 and not pushes) or (wanted == -1 and pushes):
                acts = False
        if acts:
            for c in range(3):
                for j in range(n):
                    total[j] += receives[i, c, j] * forces[i, c]
