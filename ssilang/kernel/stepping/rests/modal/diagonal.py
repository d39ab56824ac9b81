"""Predict, advance and account on coordinates in which mass, damping and stiffness are diagonal.

All loops on such coordinates take these verbs, on ranges of coordinates whose arrays stay in the
nearest cache; they differ in what the interface or the relations make of the prediction.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled_fast, compiled_inline
from ssilang.kernel.stepping.newmark import Newmark
from ssilang.kernel.stepping.state import DAMPED, ELASTIC, EXTERNAL, KINETIC, Motion
from ssilang.kernel.stepping.verbs import advance, from_past


class Diagonal(NamedTuple):
    """Diagonals (r,) of mass, damping and stiffness, inverse P of the step's matrix."""

    m: FloatArray
    c: FloatArray
    k: FloatArray
    P: FloatArray


class Sweep(NamedTuple):
    """Vectors (r,) that each step overwrites.

    `du` are the increments, `g` the interface's forces on the coordinates, `load0` and `load1` the
    loads at both ends; `sums` (4,) gather the parts of the energies that `account` takes; `end` are
    the coordinates that the prediction leads to, for loops that need them.
    """

    du: FloatArray
    g: FloatArray
    load0: FloatArray
    load1: FloatArray
    sums: FloatArray
    end: FloatArray


def diagonal_of(n: Newmark, m: FloatArray, c: FloatArray, k: FloatArray) -> Diagonal:
    """The diagonals with the inverse of the step's matrix."""
    return Diagonal(m, c, k, 1.0 / (n.mass * m + n.damping * c + n.end * k))


def sweep_of(size: int) -> Sweep:
    """Room for r coordinates."""
    du, g, load0, load1, end = (np.zeros(size) for _ in range(5))
    return Sweep(du, g, load0, load1, np.zeros(4), end)


@compiled_fast
def next_load(
    forces: FloatArray, factors: FloatArray, load0: FloatArray, load1: FloatArray
) -> None:
    """The loads at the end of the next step; those of the last one become its first."""
    for i in range(len(load1)):
        load0[i] = load1[i]
        load1[i] = 0.0
    for j in range(len(factors)):
        part, factor = forces[j], factors[j]
        for i in range(len(load1)):
            load1[i] += part[i] * factor


@compiled_inline
def predict(
    n: Newmark, diagonal: Diagonal, x: Motion, sweep: Sweep, held: float, first: int, last: int
) -> None:
    """Increments of a step of the coordinates from `first` to `last`, by what is known of it.

    `held` is the part of the interface's forces g that stays as it is through the step.
    """
    m, c, k = diagonal.m[first:last], diagonal.c[first:last], diagonal.k[first:last]
    u, v, a, P = x.u[first:last], x.v[first:last], x.a[first:last], diagonal.P[first:last]
    du, g = sweep.du[first:last], sweep.g[first:last]
    load0, load1 = sweep.load0[first:last], sweep.load1[first:last]
    for i in range(len(du)):
        r = from_past(n, m[i] * v[i], m[i] * a[i], c[i] * v[i], c[i] * a[i])
        du[i] = P[i] * (r - k[i] * u[i] - held * g[i] + n.end * load1[i] + n.start * load0[i])


@compiled_inline
def advance_range(
    n: Newmark, diagonal: Diagonal, x: Motion, sweep: Sweep, first: int, last: int
) -> float:
    """The motion after the increments, its energies into `sums`; finite if the motion is."""
    m, c, k = diagonal.m[first:last], diagonal.c[first:last], diagonal.k[first:last]
    u, v, a, du = x.u[first:last], x.v[first:last], x.a[first:last], sweep.du[first:last]
    load0, load1 = sweep.load0[first:last], sweep.load1[first:last]
    kinetic, elastic, damped, external, size = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(len(u)):
        move, v0 = du[i], v[i]
        u1 = u[i] + move
        v1, a[i] = advance(n, move, v0, a[i])
        u[i], v[i] = u1, v1
        kinetic += m[i] * v1 * v1
        elastic += k[i] * u1 * u1
        damped += c[i] * move * (v0 + v1)
        external += move * (load0[i] + load1[i])
        size += abs(u1)
    sweep.sums[0] += kinetic
    sweep.sums[1] += elastic
    sweep.sums[2] += damped
    sweep.sums[3] += external
    return size


@compiled_inline
def account(x: Motion, sweep: Sweep) -> None:
    """Energies of the step from the sums, which become zero."""
    sums = sweep.sums
    x.energies[KINETIC], x.energies[ELASTIC] = 0.5 * sums[0], 0.5 * sums[1]
    x.energies[DAMPED] += 0.5 * sums[2]
    x.energies[EXTERNAL] += 0.5 * sums[3]
    for i in range(len(sums)):
        sums[i] = 0.0


@compiled_fast
def add_jumps(Jt: FloatArray, du: FloatArray, y: FloatArray) -> None:
    """y += J du, four coordinates at a time: y is read and written less often."""
    fours = len(du) // 4 * 4
    for i in range(0, fours, 4):
        a, b, c, d = du[i], du[i + 1], du[i + 2], du[i + 3]
        row0, row1, row2, row3 = Jt[i], Jt[i + 1], Jt[i + 2], Jt[i + 3]
        for j in range(len(y)):
            y[j] += (row0[j] * a + row1[j] * b) + (row2[j] * c + row3[j] * d)
    for i in range(fours, len(du)):
        for j in range(len(y)):
            y[j] += Jt[i, j] * du[i]
