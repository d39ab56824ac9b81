"""The whole time loop of unilateral relations, compiled, on diagonal coordinates.

The coordinates z are orthonormal in the step's matrix: an increment is the force itself, and the
flexibility of the rows `W = G G^T` is theirs for all steps. A step asks for reactions p of

    w = q + W p >= 0 ,   p >= 0 ,   w p = 0

with the gaps q that it would end with without them. The set of rows that push starts from that of
the step before: all wrong rows change at once, one at a time after some turns (Murty's rule). W is
regular here, so the reactions are those of any other order. Velocities are corrected as `impact`
says.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fast, compiled_fused
from ssilang.kernel.stepping.rests.dense.loop import DAMPED, ELASTIC, EXTERNAL, KINETIC

ALL_AT_ONCE = 20  # turns that may change several rows; later ones change a single row
ROUNDING = 1e-12  # of the largest reaction or gap


class Stops(NamedTuple):
    """Diagonal matrices (r,), rows of the relations, loads, for one step length.

    `W` (m, m) is the flexibility, of a penalty's springs too (`stiffness` > 0); `by_closing` and
    `by_lasting` (r, m) are the motions that change velocities of rows that close and that stay
    closed, `closing` and `lasting` (m, m) what they do on the rows; none: no columns.
    """

    m: FloatArray
    c: FloatArray
    k: FloatArray
    G: FloatArray  # (m, r)
    W: FloatArray
    forces: FloatArray  # (n_loads, r)
    imposed: FloatArray  # (m, n_loads)
    by_closing: FloatArray
    closing: FloatArray
    by_lasting: FloatArray
    lasting: FloatArray
    scheme: FloatArray  # alpha_m, alpha_f, beta, gamma
    dt: float
    stiffness: float


class Moving(NamedTuple):
    """The state, changed in place."""

    z: FloatArray  # (3, r) displacement, velocity, acceleration
    p: FloatArray  # (m,)
    closed: np.ndarray  # (m,) rows that pushed in the last step
    energies: FloatArray


class Held(NamedTuple):
    """Rows that push, the factor of their flexibility, and room."""

    active: np.ndarray  # (m,) bool
    factored: np.ndarray  # (m,) bool: rows whose flexibility is in L
    L: FloatArray  # (m, m)
    rows: IntArray  # (m,) the active ones
    x: FloatArray  # (m,)
    w: FloatArray  # (m,)


class ContactRowsKept(NamedTuple):
    """Where the saved steps go, one row each."""

    z: FloatArray  # (n_rows, 3, r)
    p: FloatArray


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
def _pushes(W: FloatArray, q: FloatArray, held: Held, p: FloatArray) -> int:
    """Reactions p of the active rows, gaps w of all; the number of active rows, < 0: singular."""
    n, changed = 0, False
    for i in range(len(q)):
        if held.active[i]:
            held.rows[n] = i
            held.x[n] = -q[i]
            n += 1
        changed = changed or held.active[i] != held.factored[i]
    if changed:
        if not factorise(W, held.rows, n, held.L):
            return -1
        held.factored[:] = held.active
    solve(held.L, n, held.x)
    p[:] = 0.0
    held.w[:] = q
    for j in range(n):
        row, push = held.rows[j], held.x[j]
        p[row] = push
        for i in range(len(q)):
            held.w[i] += W[i, row] * push
    return n


@compiled_fused
def react(W: FloatArray, q: FloatArray, held: Held, p: FloatArray) -> int:
    """Reactions p (m,) for gaps q (m,); turns taken, <= 0 if there are none."""
    m = len(q)
    for turn in range(1, 51 + 20 * m):
        if _pushes(W, q, held, p) < 0:
            return -turn
        size, push = 0.0, 0.0
        for i in range(m):
            size = max(size, abs(q[i]), abs(held.w[i]))
            push = max(push, abs(p[i]))
        first, wrong = -1, 0
        for i in range(m):
            pulls = held.active[i] and p[i] < -ROUNDING * push
            crosses = not held.active[i] and held.w[i] < -ROUNDING * size
            if not (pulls or crosses):
                continue
            wrong += 1
            if turn <= ALL_AT_ONCE:
                held.active[i] = not held.active[i]
            elif first < 0 or (crosses and held.active[first]):
                first = i
        if first >= 0:
            held.active[first] = not held.active[first]
        if not wrong:
            for i in range(m):
                p[i] = max(p[i], 0.0)
            return turn
    return 0


@compiled_fused
def _turn_round(
    G: FloatArray, by: FloatArray, H: FloatArray, chosen: np.ndarray, factor: float,
    rate: FloatArray, v: FloatArray, held: Held,
) -> None:  # fmt: skip
    """Change velocities of the chosen rows by `factor` times themselves, relative to `rate`."""
    n = 0
    for i in range(len(chosen)):
        if chosen[i]:
            held.rows[n] = i
            total = -rate[i]
            for j in range(len(v)):
                total += G[i, j] * v[j]
            held.x[n] = factor * total
            n += 1
    if n == 0:
        return
    L = np.empty((n, n))
    if not factorise(H, held.rows, n, L):
        v[:] = np.nan
        return
    solve(L, n, held.x)
    for i in range(n):
        row, part = held.rows[i], held.x[i]
        for j in range(len(v)):
            v[j] += by[j, row] * part


@compiled_fused
def _impacts(stops: Stops, x: Moving, rate: FloatArray, held: Held) -> None:
    """Velocities of rows that close, and of those that stay closed; the new set of closed rows."""
    m = len(x.p)
    now, closing, lasting = x.p > 0.0, np.zeros(m, np.bool_), np.zeros(m, np.bool_)
    for i in range(m):
        closing[i] = now[i] and not x.closed[i]
        lasting[i] = now[i] and x.closed[i]
    x.closed[:] = now
    if stops.by_closing.shape[1]:
        _turn_round(stops.G, stops.by_closing, stops.closing, closing, -2.0, rate, x.z[1], held)
    if stops.by_lasting.shape[1]:
        _turn_round(stops.G, stops.by_lasting, stops.lasting, lasting, -1.0, rate, x.z[1], held)


@compiled_fast
def _loads(forces: FloatArray, factors: FloatArray, load: FloatArray) -> None:
    load[:] = 0.0
    for c in range(len(factors)):
        for i in range(len(load)):
            load[i] += forces[c, i] * factors[c]


@compiled_fast
def _rows_of(G: FloatArray, z: FloatArray, out: FloatArray) -> None:
    """out += G z."""
    for i in range(len(out)):
        row, total = G[i], 0.0
        for j in range(len(z)):
            total += row[j] * z[j]
        out[i] += total


@compiled_fast
def _free(
    stops: Stops, z: FloatArray, load0: FloatArray, load1: FloatArray, du: FloatArray
) -> None:
    """Increments of a step without reactions."""
    am, af, beta, gamma = stops.scheme[0], stops.scheme[1], stops.scheme[2], stops.scheme[3]
    mass_v, mass_a = (1 - am) / (beta * stops.dt), (1 - am) * (0.5 / beta - 1) - am
    damping_v = (1 - af) * (1 - gamma / beta) + af
    damping_a = (1 - af) * stops.dt * (1 - 0.5 * gamma / beta)
    u, v, a = z[0], z[1], z[2]
    for i in range(len(du)):
        r = stops.m[i] * (mass_v * v[i] + mass_a * a[i]) - stops.k[i] * u[i]
        r -= stops.c[i] * (damping_v * v[i] + damping_a * a[i])
        du[i] = r + (1 - af) * load1[i] + af * load0[i]


@compiled_fast
def _advance(stops: Stops, z: FloatArray, du: FloatArray) -> None:
    beta, gamma, dt = stops.scheme[2], stops.scheme[3], stops.dt
    rate, keep, drift = gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    bend, slow, late = 1 / (beta * dt**2), 1 / (beta * dt), 0.5 / beta - 1
    u, v, a = z[0], z[1], z[2]
    for i in range(len(du)):
        v0, a0 = v[i], a[i]
        u[i] += du[i]
        v[i] = rate * du[i] + keep * v0 + drift * a0
        a[i] = bend * du[i] - slow * v0 - late * a0


@compiled_fast
def _account(
    stops: Stops, x: Moving, du: FloatArray, v0: FloatArray, load0: FloatArray, load1: FloatArray
) -> float:
    """Energies of a step; a number that is finite if the motion is."""
    kinetic, elastic, damped, external, size = 0.0, 0.0, 0.0, 0.0, 0.0
    u, v = x.z[0], x.z[1]
    for i in range(len(du)):
        kinetic += stops.m[i] * v[i] * v[i]
        elastic += stops.k[i] * u[i] * u[i]
        damped += stops.c[i] * du[i] * (v0[i] + v[i])
        external += du[i] * (load0[i] + load1[i])
        size += abs(u[i]) + abs(v[i])
    x.energies[KINETIC], x.energies[ELASTIC] = 0.5 * kinetic, 0.5 * elastic
    x.energies[DAMPED] += 0.5 * damped
    x.energies[EXTERNAL] += 0.5 * external
    return size


@compiled_fast
def march_contact(
    stops: Stops, x: Moving, held: Held, factors: FloatArray, save: IntArray,
    kept: ContactRowsKept, history: FloatArray,
) -> tuple[int, int, float]:  # fmt: skip
    """As `compiled_loop.march`."""
    m, r = stops.G.shape
    du, v0, load0, load1 = np.zeros(r), np.zeros(r), np.zeros(r), np.zeros(r)
    gap, q, rise, rate, before = np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m)
    worst = 0
    _loads(stops.forces, factors[0], load1)
    _rows_of(stops.G, x.z[0], gap)  # without what is imposed
    for k in range(len(save)):
        load0[:] = load1
        _loads(stops.forces, factors[k + 1], load1)
        _free(stops, x.z, load0, load1, du)
        for i in range(m):
            shift, late = 0.0, 0.0
            for c in range(stops.imposed.shape[1]):
                shift += stops.imposed[i, c] * factors[k + 1, c]
                late += stops.imposed[i, c] * (factors[k + 1, c] - factors[k, c])
            rise[i], rate[i], q[i] = late, late / stops.dt, gap[i] - shift
        _rows_of(stops.G, du, q)
        before[:], v0[:] = x.p, x.z[1]
        turns = react(stops.W, q, held, x.p)
        if turns <= 0:
            return k, turns - 1, 1.0
        worst = max(worst, turns)
        for i in range(m):
            if x.p[i] > 0.0:
                for j in range(r):
                    du[j] += stops.G[i, j] * x.p[i]
        _advance(stops, x.z, du)
        _rows_of(stops.G, du, gap)
        _impacts(stops, x, rate, held)
        size = _account(stops, x, du, v0, load0, load1)
        if not np.isfinite(size):
            return k, -1, np.inf
        for i in range(m):
            x.energies[EXTERNAL] += 0.5 * (before[i] + x.p[i]) * rise[i]
            if stops.stiffness > 0.0:  # what is closed has the gap -p / stiffness
                x.energies[ELASTIC] += 0.5 * x.p[i] ** 2 / stops.stiffness
        history[k] = x.energies
        if save[k] >= 0:
            kept.z[save[k]], kept.p[save[k]] = x.z, x.p
    return len(save), worst, 0.0
