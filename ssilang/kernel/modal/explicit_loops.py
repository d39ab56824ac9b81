"""Compiled loops of the time stepping on modes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.modal.link_laws import link_forces
from ssilang.kernel.modal.links import LinkArrays


class System(NamedTuple):
    """Damping and stiffness (n, n), and inverses of the matrices that accelerations come from.

    `half` of the half step (De Vogelaere), `full` of the step.
    """

    inverse: FloatArray
    half: FloatArray
    full: FloatArray
    C: FloatArray
    K: FloatArray


class Loads(NamedTuple):
    """Forces (p, n) and their values at each half step (p, 2 steps + 1)."""

    spaces: FloatArray
    amplitudes: FloatArray


class Plan(NamedTuple):
    """Start and step (s), number of steps, steps from one saved to the next, Newmark's beta."""

    start: float
    h: float
    steps: int
    every: int
    beta: float


class Motion(NamedTuple):
    """What goes on from step to step: q, v, acceleration and q of the half step before, links."""

    q: FloatArray
    v: FloatArray
    before: FloatArray
    q_before: FloatArray
    has_before: bool
    links: FloatArray


class Saved(NamedTuple):
    """Values (m, 8, n) and records of links (m, L, RECORDS) of the saved steps."""

    values: FloatArray
    records: FloatArray


@compiled
def outer_force(loads: Loads, i: int) -> FloatArray:
    """Force on the modes at the half step i."""
    spaces, amplitudes = loads.spaces, loads.amplitudes
    f = np.zeros(spaces.shape[1])
    for p in range(spaces.shape[0]):
        for j in range(spaces.shape[1]):
            f[j] += amplitudes[p, i] * spaces[p, j]
    return f


@compiled
def times_vector(A: FloatArray, x: FloatArray) -> FloatArray:
    """`A x` without BLAS: the matrices are small."""
    y = np.zeros(len(x))
    for i in range(len(x)):
        for j in range(len(x)):
            y[i] += A[i, j] * x[j]
    return y


@compiled
def de_vogelaere(
    system: System, loads: Loads, plan: Plan, links: LinkArrays, motion: Motion, saved: Saved
) -> None:
    """De Vogelaere's scheme of fourth order, damping implicit in the velocities.

    The half velocity takes a parabola through the accelerations at -1/2, 0 and 1/2.
    """
    C, K, t0, h, steps, every = system.C, system.K, plan.start, plan.h, plan.steps, plan.every
    q, v, before, q_before, state = motion.q, motion.v, motion.before, motion.q_before, motion.links
    values, records = saved.values, saved.records
    n = len(q)
    fl, record = np.zeros(n), np.zeros((len(links.kinds), records.shape[2]))
    if not motion.has_before:
        q_before[:] = q - 0.5 * h * v
    link_forces(q, (q - q_before) / (0.5 * h), t0, links, state, record, fl)
    fe = outer_force(loads, 0)
    inner = fl - times_vector(C, v) - times_vector(K, q)
    a = times_vector(system.inverse, fe + inner)
    if not motion.has_before:
        before[:] = a
        q_before[:] = q - 0.5 * h * v + h * h / 8.0 * a
        f = fe + fl - times_vector(K, q_before) - times_vector(C, v - 0.5 * h * a)
        before[:] = times_vector(system.inverse, f)
    work_out, work_in = np.zeros(n), np.zeros(n)
    values[0, 0], values[0, 1], values[0, 2] = q, v, q_before
    values[0, 3], values[0, 4], values[0, 5] = v - 0.5 * h * a, a, before
    records[0] = record
    for k in range(1, steps + 1):
        t = t0 + (k - 1) * h
        qh = q + 0.5 * h * v + h * h / 24.0 * (4.0 * a - before)
        link_forces(qh, (qh - q) / (0.5 * h), t + 0.5 * h, links, state, record, fl)
        feh = outer_force(loads, 2 * k - 1)
        known = v + h / 24.0 * (8.0 * a - before)
        ah = times_vector(system.half, feh + fl - times_vector(K, qh) - times_vector(C, known))
        vh = known + 5.0 * h / 24.0 * ah
        innerh = fl - times_vector(C, vh) - times_vector(K, qh)
        work_out += 0.5 * (fe + feh) * (qh - q)
        work_in += 0.5 * (inner + innerh) * (qh - q)
        q1 = q + h * v + h * h / 6.0 * (a + 2.0 * ah)
        link_forces(q1, (q1 - qh) / (0.5 * h), t + h, links, state, record, fl)
        fe = outer_force(loads, 2 * k)
        known = v + h / 6.0 * (a + 4.0 * ah)
        a = times_vector(system.full, fe + fl - times_vector(K, q1) - times_vector(C, known))
        v[:] = known + h / 6.0 * a
        inner = fl - times_vector(C, v) - times_vector(K, q1)
        work_out += 0.5 * (fe + feh) * (q1 - qh)
        work_in += 0.5 * (inner + innerh) * (q1 - qh)
        q[:], before[:], q_before[:] = q1, ah, qh
        if k % every == 0:
            i = k // every
            values[i, 0], values[i, 1], values[i, 2], values[i, 3] = q, v, qh, vh
            values[i, 4], values[i, 5], values[i, 6], values[i, 7] = a, ah, work_out, work_in
            records[i] = record


@compiled
def newmark(
    system: System, loads: Loads, plan: Plan, links: LinkArrays, motion: Motion, saved: Saved
) -> None:
    """Newmark's scheme with gamma 1/2; links push where the step is predicted to end."""
    C, K, t0, h, steps, every = system.C, system.K, plan.start, plan.h, plan.steps, plan.every
    q, v, before, q_before, state = motion.q, motion.v, motion.before, motion.q_before, motion.links
    values, records, beta = saved.values, saved.records, plan.beta
    n = len(q)
    fl, record = np.zeros(n), np.zeros((len(links.kinds), records.shape[2]))
    if not motion.has_before:
        q_before[:] = q - h * v
    link_forces(q, (q - q_before) / h, t0, links, state, record, fl)
    fe = outer_force(loads, 0)
    inner = fl - times_vector(C, v) - times_vector(K, q)
    a = times_vector(system.inverse, fe + inner)
    work_out, work_in = np.zeros(n), np.zeros(n)
    values[0, 0], values[0, 1], values[0, 2] = q, v, q - 0.5 * h * v + h * h / 8.0 * a
    values[0, 3], values[0, 4], values[0, 5] = v - 0.5 * h * a, a, a
    records[0] = record
    for k in range(1, steps + 1):
        guess = q + h * v + 0.5 * h * h * a
        link_forces(guess, (guess - q) / h, t0 + k * h, links, state, record, fl)
        fe1 = outer_force(loads, 2 * k)
        q1 = q + h * v + h * h * (0.5 - beta) * a
        known = v + 0.5 * h * a
        a1 = times_vector(system.full, fe1 + fl - times_vector(K, q1) - times_vector(C, known))
        q1 += beta * h * h * a1
        v1 = known + 0.5 * h * a1
        inner1 = fl - times_vector(C, v1) - times_vector(K, q1)
        work_out += 0.5 * (fe + fe1) * (q1 - q)
        work_in += 0.5 * (inner + inner1) * (q1 - q)
        if k % every == 0:
            i = k // every
            values[i, 0], values[i, 1], values[i, 4] = q1, v1, a1
            values[i, 2] = 0.5 * (q + q1) - h / 8.0 * (v1 - v)
            values[i, 3], values[i, 5] = 0.5 * (v + v1), 0.5 * (a + a1)
            values[i, 6], values[i, 7] = work_out, work_in
            records[i] = record
        q_before[:], before[:] = q, a
        q[:], v[:], a, inner, fe = q1, v1, a1, inner1, fe1
