"""The whole time loop of unilateral relations, compiled, on diagonal coordinates.

The coordinates z are orthonormal in the step's matrix: an increment is the force itself, and the
flexibility of the rows `W = G G^T` is theirs for all steps. A step asks for reactions p of

    w = q + W p >= 0 ,   p >= 0 ,   w p = 0

with the gaps q that it would end with without them, by `active_set` (f = -p). W is regular here,
so the reactions are those of any other order. Velocities are corrected as `impact` and `struck`
say.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart, seldom
from ssilang.kernel.base.compiled.compiler import compiled_fast, compiled_fused
from ssilang.kernel.contact.active_set import ActiveSet, find_active
from ssilang.kernel.contact.struck import COUPLED, STILL, press, slow_down, strike
from ssilang.kernel.interface.copies import copy_state
from ssilang.kernel.stepping.newmark import Newmark
from ssilang.kernel.stepping.rests.modal.diagonal import (
    Diagonal,
    Sweep,
    account,
    advance_range,
    next_load,
    predict,
    sweep_of,
)
from ssilang.kernel.stepping.state import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    Motion,
    Recorder,
)
from ssilang.kernel.stepping.verbs import end_of_step

ROUNDING = 1e-12  # of the largest gap, or of a pivot


class VelocityChange(NamedTuple):
    """How velocities of chosen rows change: motions `by` (r, m), what they do on the rows `on`.

    No columns: they do not. The rows' velocities change by `factor` times themselves.
    """

    by: FloatArray
    on: FloatArray
    factor: float


class Stops(NamedTuple):
    """Diagonals, rows of the relations, loads, for one step length.

    `closed` (m,) are the rows that pushed in the last step; `closing` and `lasting` change
    velocities of rows that close and that stay closed, `struck` of those that strike a body while
    others hold it; `slowing` (r,) is damping over mass; `stiffness` is that of a penalty, or zero.
    """

    newmark: Newmark
    diagonal: Diagonal
    G: FloatArray  # (m, r)
    forces: FloatArray  # (n_loads, r)
    imposed: FloatArray  # (m, n_loads)
    closing: VelocityChange
    lasting: VelocityChange
    struck: VelocityChange
    slowing: FloatArray
    stiffness: float
    closed: np.ndarray


class Room(NamedTuple):
    """Vectors that each step overwrites; of m rows but for the velocities `v` (r,) of before.

    `gap` without what is imposed, `rise` and `rate` of that, reactions `before`, rows that
    `closing` and `lasting` say; `chosen` rows, their changes of velocity `x`, factors `L` (m, m).
    """

    sweep: Sweep
    v: FloatArray
    gap: FloatArray
    rise: FloatArray
    rate: FloatArray
    before: FloatArray
    closing: np.ndarray
    lasting: np.ndarray
    chosen: IntArray
    x: FloatArray
    L: FloatArray


def room_of(m: int, r: int) -> Room:
    """Room for m rows on r coordinates."""
    gap, rise, rate, before, x = (np.zeros(m) for _ in range(5))
    closing, lasting = (np.zeros(m, bool) for _ in range(2))
    chosen, L = np.zeros(m, np.int64), np.zeros((m, m))
    return Room(sweep_of(r), np.zeros(r), gap, rise, rate, before, closing, lasting, chosen, x, L)


@compiled_fused
def factorise(A: FloatArray, rows: IntArray, n: int, L: FloatArray) -> bool:
    """Cholesky factor of the first n `rows` and columns of A into L; False if not positive."""
    for i in range(n):
        for j in range(i + 1):
            total = A[rows[i], rows[j]]
            for k in range(j):
                total -= L[i, k] * L[j, k]
            if i > j:
                L[i, j] = total / L[j, j]
            elif total <= ROUNDING * A[rows[i], rows[i]]:
                return False
            else:
                L[i, i] = np.sqrt(total)
    return True


@compiled_fused
def solve(L: FloatArray, n: int, x: FloatArray) -> None:
    """x = (L L^T)^-1 x, the first n."""
    for i in range(n):
        for k in range(i):
            x[i] -= L[i, k] * x[k]
        x[i] /= L[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            x[i] -= L[k, i] * x[k]
        x[i] /= L[i, i]


@compiled_fused
def _change_velocity(
    G: FloatArray, change: VelocityChange, wanted: np.ndarray, room: Room, v: FloatArray
) -> None:
    """Change velocities of the rows that are wanted, relative to their rate."""
    n, rows, x, L = 0, room.chosen, room.x, room.L
    for i in range(len(wanted)):
        if wanted[i]:
            rows[n] = i
            total = -room.rate[i]
            for j in range(len(v)):
                total += G[i, j] * v[j]
            x[n] = change.factor * total
            n += 1
    if n == 0:
        return
    if not factorise(change.on, rows, n, L):
        v[:] = np.nan
        return
    solve(L, n, x)
    for i in range(n):
        row, part = rows[i], x[i]
        for j in range(len(v)):
            v[j] += change.by[j, row] * part


@apart
@compiled_fused
def _impacts(stops: Stops, Q: FloatArray, x: Motion, room: Room) -> float:
    """Velocities of rows that close, and of those that stay closed; the new set of closed rows.

    The work of moving stops on bodies that were struck while they were held; NaN: none was.
    """
    m, closed, rate, strikes = len(x.contact), stops.closed, room.rate, False
    closing, lasting = room.closing, room.lasting
    for i in range(m):
        now = x.contact[i] > 0.0
        closing[i] = now and not closed[i]
        lasting[i] = now and closed[i]
    work = np.nan
    if stops.struck.by.shape[1]:
        for i in range(m):
            if closing[i]:
                strikes = strikes or _joins(stops, closing, i)
            elif lasting[i]:
                strikes = strikes or _stays(stops, Q, x, rate, i)
    if strikes:
        work = _strike(stops, Q, x, rate, closing)
    for i in range(m):
        closed[i] = x.contact[i] > 0.0
        lasting[i] = lasting[i] and closed[i]
    if stops.closing.by.shape[1]:
        _change_velocity(stops.G, stops.closing, closing, room, x.v)
    if stops.lasting.by.shape[1]:
        _change_velocity(stops.G, stops.lasting, lasting, room, x.v)
    return work


@compiled_fused
def _joins(stops: Stops, closing: np.ndarray, i: int) -> bool:
    """Whether a row that closes moves one that was closed."""
    W = stops.struck.on
    for j in range(len(closing)):
        if stops.closed[j] and not closing[j] and W[i, j] ** 2 > COUPLED**2 * W[i, i] * W[j, j]:
            return True
    return False


@compiled_fast
def _stays(stops: Stops, Q: FloatArray, x: Motion, rate: FloatArray, i: int) -> bool:
    """Whether a row was turned round and pushes all the same: it moves, and does not rebound."""
    if rate[i] != 0.0:
        return False
    row, v, push = stops.G[i], 0.0, 0.0
    for j in range(len(x.v)):
        v += row[j] * x.v[j]
    for j in range(len(x.contact)):
        push += Q[i, j] * x.contact[j]
    c = v - stops.newmark.v_du * push
    return c <= 0.0 and abs(v) > STILL * abs(c)


@seldom
@compiled_fused
def _strike(stops: Stops, Q: FloatArray, x: Motion, rate: FloatArray, closing: np.ndarray) -> float:
    """Bodies that are struck while they are held; their rows no longer count as `closing`."""
    m, G, W, n = len(x.contact), stops.G, stops.struck.on, stops.newmark
    body, struck, strikes = np.zeros(m, np.bool_), np.zeros(m, np.bool_), closing.copy()
    impulse, change = np.zeros(m), np.zeros(m)
    v = np.dot(G, x.v) - rate
    c = v - n.v_du * np.dot(Q, x.contact)
    held = stops.closed & ~closing & (c <= 0.0)
    for i in range(m):
        if held[i] and x.contact[i] > 0.0:
            strikes[i] = _stays(stops, Q, x, rate, i)
    step = np.array([1.0 / n.v_du, n.a_du / n.v_du])
    a = np.dot(G, x.a)
    if strike(W, Q, c, v, a, step, strikes, held, body, struck, impulse) == 0:
        return np.nan
    _push(stops, x, impulse)
    press(W, np.dot(G, x.a), struck, x.contact, change)
    x.a[:] += np.dot(stops.struck.by, change)
    x.contact[:] += change
    closing &= ~body
    work = np.dot(rate, impulse - 0.5 * n.dt * change)
    slow_down(W, np.dot(G, x.v) - rate, np.dot(G, x.a), v * step[0], body, struck, impulse)
    _push(stops, x, impulse)
    return float(work + np.dot(rate, impulse))


@compiled_fused
def _push(stops: Stops, x: Motion, impulse: FloatArray) -> None:
    """Velocities and accelerations after impulses (m,) on the rows."""
    move = np.dot(stops.struck.by, impulse)
    x.v[:] += move
    x.a[:] -= stops.slowing * move


@compiled_fast
def _rows_of(G: FloatArray, z: FloatArray, out: FloatArray) -> None:
    """out += G z."""
    for i in range(len(out)):
        row, total = G[i], 0.0
        for j in range(len(z)):
            total += row[j] * z[j]
        out[i] += total


@compiled_fast
def _correct_energies(stops: Stops, x: Motion, v0: FloatArray, du: FloatArray) -> float:
    """Kinetic and damped energies with the velocities that impacts changed; finite if they are."""
    m, c = stops.diagonal.m, stops.diagonal.c
    kinetic, damped, size = 0.0, 0.0, 0.0
    for i in range(len(du)):
        kinetic += m[i] * x.v[i] * x.v[i]
        damped += c[i] * du[i] * (x.v[i] - v0[i])
        size += abs(x.v[i])
    x.energies[KINETIC] = 0.5 * kinetic
    x.energies[DAMPED] += 0.5 * damped
    return size


@compiled_fused
def _total(energies: FloatArray) -> float:
    """What a motion keeps."""
    total: float = -energies[EXTERNAL]
    for i in range(EXTERNAL):
        total += energies[i]
    return total


@compiled_fast
def run_contact(
    stops: Stops, rows: ActiveSet, x: Motion, room: Room, factors: FloatArray, to: Recorder
) -> tuple[int, int, float]:
    """As `run_reduced`, with relations in place of joints."""
    n, diagonal, sweep, v1 = stops.newmark, stops.diagonal, room.sweep, room.v
    m, r = stops.G.shape
    start = r - r  # not a literal: that is a type, and code, of its own
    gap, rise, rate, before = room.gap, room.rise, room.rate, room.before
    worst, corrected = 0, stops.closing.by.shape[1] + stops.lasting.by.shape[1] > 0
    next_load(stops.forces, factors[0], sweep.load0, sweep.load1)
    balance = _total(x.energies)
    _rows_of(stops.G, x.u, gap)  # without what is imposed
    for k in range(len(to.row)):
        # predict: increments without reactions, and the gaps that they lead to
        next_load(stops.forces, factors[k + 1], sweep.load0, sweep.load1)
        predict(n, diagonal, x, sweep, 0.0, start, r)
        for i in range(m):
            shift, late = 0.0, 0.0
            for c in range(stops.imposed.shape[1]):
                shift += stops.imposed[i, c] * factors[k + 1, c]
                late += stops.imposed[i, c] * (factors[k + 1, c] - factors[k, c])
            rise[i], rate[i], rows.free[i] = late, late / n.dt, gap[i] - shift
        _rows_of(stops.G, sweep.du, rows.free)
        # solve: the rows that push
        copy_state(x.contact, before)
        turns = find_active(rows)
        if turns <= 0:
            return k, turns, 1.0
        worst = max(worst, turns)
        for i in range(m):
            x.contact[i] = max(-rows.found[i], 0.0) if rows.closed[i] else 0.0
            if x.contact[i] > 0.0:
                for j in range(r):
                    sweep.du[j] += stops.G[i, j] * x.contact[i]
        # advance, correct the velocities, account
        size = advance_range(n, diagonal, x, sweep, start, r)
        account(x, sweep)
        _rows_of(stops.G, sweep.du, gap)
        copy_state(x.v, v1)
        work = _impacts(stops, rows.Q, x, room)
        if corrected:
            size += _correct_energies(stops, x, v1, sweep.du)
        if not np.isfinite(size):
            return k, -1, np.inf
        for i in range(m):
            x.energies[EXTERNAL] += 0.5 * (before[i] + x.contact[i]) * rise[i]
            if stops.stiffness > 0.0:  # what is closed has the gap -p / stiffness
                x.energies[ELASTIC] += 0.5 * x.contact[i] ** 2 / stops.stiffness
        total = _total(x.energies)
        if not np.isnan(work):  # what the step's balance lacks went with the impact
            x.energies[EXTERNAL] += work
            lost = max(balance - total + work, 0.0)
            x.energies[LOST] += lost
            total += lost - work
        balance = total
        end_of_step(x, to, k)
    return len(to.row), worst, 0.0
