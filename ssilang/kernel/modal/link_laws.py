"""Forces of links, compiled: contacts, friction, plastic springs, couplings of modes."""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled

(
    PLANE, CIRCLE, LINE, RING, POWER, SINE, COSINE, COSINE_OF_TIME, SINE_OF_TIME, VELOCITY,
    POLYNOMIAL,
) = range(11)  # fmt: skip
CONTACTS = (PLANE, CIRCLE, LINE, RING)

# columns of the numbers of a link
(
    NX, NY, NZ, GAP, STIFF, DAMP, EX, EY, EZ, OUTSIDE, PERMANENT, PLASTIC, KINEMATIC, FRICTION,
    SLIDE, STICK, TANGENT, TANGENT_DAMP, DX, DY, DZ, FACTOR, EXPONENT, FREQUENCY, RADIUS, FIRST,
    LAST, IF_TOUCHED, COLUMNS,
) = range(29)  # fmt: skip
# columns of the state of a link: plastic part, its cumulated value, contact and adherence,
# anchor of adherence, force there, time there, last sliding direction
XP, CUMULATED, TOUCHES, STICKS, A0, F0, T0, S0, STATES = 0, 1, 2, 3, 4, 7, 10, 11, 14
# columns of what is recorded: relative motion, normal force, tangential force, normal and sliding
# velocities, power of wear, plastic part, its cumulated value, norm of the force, velocity where a
# circle touches, moment of the force about its centre
(
    X, _, _, FN, FT, _, _, VN, VT, WEAR, PLASTIC_PART, PLASTIC_SUM, FORCE, VC, _, _, MC, _, _,
    RECORDS,
) = range(20)  # fmt: skip


class Points(NamedTuple):
    """Points whose place counts: of lines, and of rigid bodies that turn.

    Rows of their motion (N, 3, n), places at rest (N, 3), the mode that turns their body (-1 where
    none does), its axis and their place from its centre (N, 3).
    """

    rows: FloatArray
    places: FloatArray
    spins: IntArray
    axes: FloatArray
    arms: FloatArray


class LinkArrays(NamedTuple):
    """Links as arrays: kinds (L,), rows (L, 3, n), numbers (L, COLUMNS), conditions (L, G).

    `ends` (L, 2) are points, -1 where there is none, with `signs`; `terms` (L, k, 5) ends with
    modes -1; `segments` (S, 4) as `segments_of` makes them.
    """

    kinds: IntArray
    receives: FloatArray
    sees: FloatArray
    numbers: FloatArray
    law_sizes: IntArray
    laws: FloatArray
    conditions: IntArray
    groups: IntArray
    turns: FloatArray
    ends: IntArray
    signs: FloatArray
    terms: FloatArray
    points: Points
    segments: IntArray


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
def _flow(k: float, x: float, row: FloatArray, law: FloatArray, size: int, s: FloatArray) -> float:
    """Force of a spring k at an overlap x, none where it has parted (k = 0), once it has flowed."""
    force = k * (x - s[XP])
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
        flow = min(over / (k + slope + 1e-300), room)
        s[XP] += pushing * flow
        s[CUMULATED] += flow
        force = k * (x - s[XP])
    return float(force)


@compiled
def plastic_force(x: float, row: FloatArray, law: FloatArray, size: int, s: FloatArray) -> float:
    """Force of an elastic-plastic spring at an overlap x; its plastic part moves in `s`.

    Where it may not pull it parts once its force has gone, flowing until then.
    """
    k = (law[1, 1] - law[0, 1]) / (law[1, 0] - law[0, 0])
    start, total = s[XP], s[CUMULATED]
    force = _flow(k, x, row, law, size, s)
    if force > 0.0 or row[PERMANENT] != 0.0:
        return float(force)
    s[XP], s[CUMULATED] = start, total
    _flow(0.0, x, row, law, size, s)
    return 0.0


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
def turn(
    points: Points, p: int, q: FloatArray, sign: float, x: FloatArray, rows: FloatArray
) -> None:
    """Add what the rotation of its body, however large, moves a point by, and its rows."""
    m = points.spins[p]
    if m < 0:
        return
    e, arm, turned = points.axes[p], points.arms[p], np.empty(3)
    sine, cosine = np.sin(q[m]), np.cos(q[m])
    along = e[0] * arm[0] + e[1] * arm[1] + e[2] * arm[2]
    for i in range(3):  # Rodrigues
        j, k = (i + 1) % 3, (i + 2) % 3
        turned[i] = cosine * arm[i] + sine * (e[j] * arm[k] - e[k] * arm[j])
        turned[i] += (1.0 - cosine) * along * e[i]
        x[i] += sign * (turned[i] - arm[i])
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        rows[i, m] += sign * (e[j] * turned[k] - e[k] * turned[j])


@compiled
def times_vector(A: FloatArray, x: FloatArray, y: FloatArray) -> None:
    """`y = A x` without BLAS: the matrices are small."""
    for i in range(len(y)):
        y[i] = 0.0
        for j in range(len(x)):
            y[i] += A[i, j] * x[j]


@compiled
def places_now(points: Points, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Where the points are (N, 3), and the rows of their motion there (N, 3, n)."""
    places, rows = points.places.copy(), points.rows.copy()
    x = np.empty(3)
    for p in range(len(places)):
        times_vector(points.rows[p], q, x)
        turn(points, p, q, 1.0, x, rows[p])
        for c in range(3):
            places[p, c] += x[c]
    return places, rows


@compiled
def left_of(a: FloatArray, b: FloatArray, axis: FloatArray, n: FloatArray) -> None:
    """Unit normal of a segment to its left, seen against `axis`; nought for no length."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        n[i] = axis[j] * (b[k] - a[k]) - axis[k] * (b[j] - a[j])
    size = np.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
    for i in range(3):
        n[i] = n[i] / size if size > 0.0 else 0.0


@compiled
def on_line(
    links: LinkArrays, i: int, places: FloatArray, n: FloatArray
) -> tuple[float, int, float]:
    """How deep the point of link i is left of its line, on which segment, and where along it.

    `n` is the normal, into the obstacle. The nearest place of the line counts; at a corner of it
    the direction to the point, and beyond an end there is no obstacle.
    """
    row, segments, p = links.numbers[i], links.segments, places[links.ends[i, 0]]
    axis, w, m = row[NX : NX + 3], np.empty(3), np.empty(3)
    least, found, where = np.inf, -1, 0.0
    for s in range(int(row[FIRST]), int(row[LAST])):
        a, b = places[segments[s, 0]], places[segments[s, 1]]
        length = along = 0.0
        for c in range(3):
            length += (b[c] - a[c]) ** 2
            along += (b[c] - a[c]) * (p[c] - a[c])
        t = along / length if length > 0.0 else 0.0
        kept = min(1.0, max(0.0, t))
        away = 0.0
        for c in range(3):
            away += (p[c] - a[c] - kept * (b[c] - a[c])) ** 2
        if away < least:
            least, found, where = away, s, t
    if found < 0:
        return -np.inf, 0, 0.0
    a, b = places[segments[found, 0]], places[segments[found, 1]]
    left_of(a, b, axis, n)
    kept = min(1.0, max(0.0, where))
    overlap = off = 0.0
    for c in range(3):
        w[c] = p[c] - a[c] - kept * (b[c] - a[c])
        off += w[c] * axis[c]
    for c in range(3):
        w[c] -= off * axis[c]
        overlap += w[c] * n[c]
    if abs(where - kept) <= 1e-12:
        return overlap, found, kept
    other = segments[found, 2] if where < 0.0 else segments[found, 3]
    if other < 0:
        return -np.inf, found, kept
    left_of(places[segments[other, 0]], places[segments[other, 1]], axis, m)
    side = w[0] * (n[0] + m[0]) + w[1] * (n[1] + m[1]) + w[2] * (n[2] + m[2])
    size = np.sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
    if side <= 0.0 or size == 0.0:
        return -size, found, kept
    for c in range(3):
        n[c] = w[c] / size
    return size, found, kept


@compiled
def in_ring(
    links: LinkArrays, i: int, places: FloatArray, n: FloatArray
) -> tuple[float, int, float]:
    """How far a line is out of a ring about the point of link i: overlap, segment, place along it.

    `n` goes from the line to the ring's centre.
    """
    row, segments, p = links.numbers[i], links.segments, places[links.ends[i, 0]]
    w = np.empty(3)
    least, found, where = np.inf, -1, 0.0
    for s in range(int(row[FIRST]), int(row[LAST])):
        a, b = places[segments[s, 0]], places[segments[s, 1]]
        from_a = to_b = 0.0
        for c in range(3):
            from_a += (p[c] - a[c]) * row[NX + c]
            to_b += (b[c] - a[c]) * row[NX + c]
        if to_b == 0.0 or from_a / to_b < 0.0 or from_a / to_b > 1.0:
            continue
        t = from_a / to_b
        away = 0.0
        for c in range(3):
            w[c] = p[c] - a[c] - t * (b[c] - a[c])
            away += w[c] * w[c]
        away = np.sqrt(away)
        if away < least:
            least, found, where = away, s, t
            for c in range(3):
                n[c] = w[c] / away if away > 0.0 else 0.0
    return (least - row[GAP], found, where) if found >= 0 else (-np.inf, 0, 0.0)


@compiled
def overlap_of(
    links: LinkArrays, i: int, x: FloatArray, places: FloatArray, moving: FloatArray,
    acting: FloatArray, n: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """How far a contact is closed, its normal `n`, and the segment that it is on (-1: none).

    The rows `acting` (3, n) of LINE and RING are those of the point less those of the line.
    """
    kind, row = links.kinds[i], links.numbers[i]
    if kind == PLANE:
        overlap = -row[GAP]
        for c in range(3):
            n[c] = row[NX + c]
            overlap += x[c] * n[c]
        return overlap, -1
    if kind == CIRCLE:
        along = x[0] * row[NX] + x[1] * row[NY] + x[2] * row[NZ]
        for c in range(3):
            n[c] = x[c] - along * row[NX + c] - row[EX + c]
        radius = np.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
        sense = -1.0 if row[OUTSIDE] != 0.0 else 1.0
        for c in range(3):
            n[c] = sense * n[c] / radius if radius > 0.0 else 0.0
        return sense * (radius - row[GAP]), -1
    overlap, found, where = (
        on_line(links, i, places, n) if kind == LINE else in_ring(links, i, places, n)
    )
    if overlap == -np.inf:
        return overlap, -1
    a, b = links.segments[found, 0], links.segments[found, 1]
    for c in range(3):
        for j in range(acting.shape[1]):
            acting[c, j] -= (1.0 - where) * moving[a, c, j] + where * moving[b, c, j]
    return (overlap - row[GAP] if kind == LINE else overlap), found


@compiled
def contact(
    links: LinkArrays, i: int, q: FloatArray, v: FloatArray, t: float, x: FloatArray,
    places: FloatArray, moving: FloatArray, touched: IntArray, acting: FloatArray, s: FloatArray,
    f: FloatArray, record: FloatArray,
) -> None:  # fmt: skip
    """Force of link i, a contact, on a relative motion x; fills `f`, `record` and rows `acting`."""
    row = links.numbers[i]
    n, rate, arm = np.zeros(3), np.empty(3), np.zeros(3)
    overlap, found = overlap_of(links, i, x, places, moving, acting, n)
    if row[IF_TOUCHED] != 0.0 and touched[links.ends[i, 0]] == 0:
        overlap = -np.inf
    if row[RADIUS] != 0.0:  # the edge of a circle moves by its rotation too
        for c in range(3):
            arm[c] = row[RADIUS] * n[c]
        for j in range(len(q)):
            for c in range(3):
                k, m = (c + 1) % 3, (c + 2) % 3
                acting[c, j] += links.turns[i, k, j] * arm[m] - links.turns[i, m, j] * arm[k]
        times_vector(acting, q, x)
    times_vector(acting, v, rate)
    vn = rate[0] * n[0] + rate[1] * n[1] + rate[2] * n[2]
    push = 0.0
    if overlap > -np.inf:
        push = normal_force(overlap, vn, row, links.laws[i], links.law_sizes[i], s)
    for c in range(3):
        f[c] = -push * n[c]
        record[VC + c] = rate[c]
    record[FN], record[VN] = -push, vn
    record[PLASTIC_PART], record[PLASTIC_SUM] = s[XP], s[CUMULATED]
    if row[FRICTION] != 0.0 and push > 0.0:
        drive = velocity_of_obstacle(links.kinds[i], n, row)
        ft, speed = rub(push, n, x, rate, drive, t, row, s)
        for c in range(3):
            f[c] += ft[c]
            record[FT + c] = ft[c]
        record[VT], record[WEAR] = speed, push * speed
    for c in range(3):
        k, m = (c + 1) % 3, (c + 2) % 3
        record[MC + c] = arm[k] * f[m] - arm[m] * f[k]
    s[TOUCHES] = 1.0 if push > 0.0 else 0.0
    if found >= 0 and push > 0.0:
        touched[links.segments[found, 0]] = touched[links.segments[found, 1]] = 1


@compiled
def velocity_of_obstacle(kind: int, n: FloatArray, row: FloatArray) -> FloatArray:
    """Velocity of the plane, or of the turning circle (its speed is in DX) along its tangent."""
    if kind != CIRCLE:
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


@compiled
def positive_part(value: float, gap: float) -> float:
    """What a motion is beyond a gap, in the direction that the gap's sign says."""
    return max(0.0, value - gap if gap >= 0.0 else gap - value)


@compiled
def polynomial(links: LinkArrays, i: int, q: FloatArray, v: FloatArray) -> float:
    """Product of powers of the motions of modes beyond gaps."""
    force: float = links.numbers[i, FACTOR]
    for term in links.terms[i]:
        if term[0] >= 0.0:
            mode = int(term[0])
            force *= positive_part(q[mode], term[2]) ** term[1]
            force *= positive_part(v[mode], term[4]) ** term[3]
    return force


@apart
@compiled
def link_forces(
    q: FloatArray, v: FloatArray, t: float, links: LinkArrays,
    state: FloatArray, record: FloatArray, total: FloatArray,
) -> None:  # fmt: skip
    """Forces of all links on the modes, into `total` (n,); `state` and `record` are filled."""
    kinds, points = links.kinds, links.points
    count, n = len(kinds), len(q)
    total[:] = 0.0
    forces, x = np.zeros((count, 3)), np.zeros(3)
    pushes = np.zeros(links.conditions.shape[1])
    acting = links.receives.copy()
    places, moving = places_now(points, q)
    touched = np.zeros(len(places), dtype=np.int64)
    for i in range(count):
        times_vector(links.sees[i], q, x)
        record[i, FN:] = 0.0
        if kinds[i] <= RING:
            for j in range(2):
                if links.ends[i, j] >= 0:
                    turn(points, links.ends[i, j], q, links.signs[i, j], x, acting[i])
            for c in range(3):
                record[i, X + c] = x[c]
            contact(
                links, i, q, v, t, x, places, moving, touched, acting[i], state[i], forces[i],
                record[i],
            )  # fmt: skip
        else:
            record[i, X] = x[0]
            if kinds[i] == POLYNOMIAL:
                forces[i, 0] = polynomial(links, i, q, v)
            else:
                rate = 0.0
                for j in range(n):
                    rate += links.sees[i, 0, j] * v[j]
                record[i, VN] = rate
                forces[i, 0] = coupling(kinds[i], x[0], rate, t, links.numbers[i])
            record[i, FN] = forces[i, 0]
        record[i, FORCE] = np.sqrt(forces[i, 0] ** 2 + forces[i, 1] ** 2 + forces[i, 2] ** 2)
        pushes[links.groups[i]] = max(pushes[links.groups[i]], record[i, FORCE])
    for i in range(count):
        acts = True
        for g in range(len(pushes)):
            wanted = links.conditions[i, g]
            if (wanted == 1 and pushes[g] <= 1e-20) or (wanted == -1 and pushes[g] > 1e-20):
                acts = False
        if acts:
            for c in range(3):
                for j in range(n):
                    total[j] += acting[i, c, j] * forces[i, c]
