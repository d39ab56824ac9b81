"""Compiled loops of the time stepping on modes."""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.copies import copy_rows, copy_state
from ssilang.kernel.modal.link_laws import LinkArrays, link_forces, times_vector


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


class Work(NamedTuple):
    """Forces of links, damping and stiffness times motion, all forces, velocity seen by the links.

    Each (n,); `record` (L, RECORDS) is what the links tell of the last evaluation.
    """

    links: FloatArray
    Cv: FloatArray
    Kq: FloatArray
    total: FloatArray
    rate: FloatArray
    record: FloatArray


@compiled
def new_work(n: int, count: int, saved: Saved) -> Work:
    """Room for what each evaluation of forces needs, of n modes and `count` links."""
    record = np.zeros((count, saved.records.shape[2]))
    return Work(np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n), record)


@compiled
def outer_force(loads: Loads, i: int, f: FloatArray) -> None:
    """Force on the modes at the half step i, into `f` (n,)."""
    spaces, amplitudes = loads.spaces, loads.amplitudes
    for j in range(len(f)):
        f[j] = 0.0
        for p in range(spaces.shape[0]):
            f[j] += amplitudes[p, i] * spaces[p, j]


@compiled
def inner_force(system: System, q: FloatArray, v: FloatArray, work: Work, f: FloatArray) -> None:
    """Forces of links, dampers and springs, into `f` (n,)."""
    times_vector(system.C, v, work.Cv)
    times_vector(system.K, q, work.Kq)
    for j in range(len(f)):
        f[j] = work.links[j] - work.Cv[j] - work.Kq[j]


@compiled
def acceleration(
    inverse: FloatArray, system: System, q: FloatArray, v: FloatArray, outer: FloatArray,
    work: Work, a: FloatArray,
) -> None:  # fmt: skip
    """Acceleration under all forces, into `a` (n,)."""
    times_vector(system.K, q, work.Kq)
    times_vector(system.C, v, work.Cv)
    for j in range(len(a)):
        work.total[j] = outer[j] + work.links[j] - work.Kq[j] - work.Cv[j]
    times_vector(inverse, work.total, a)


@compiled
def links_push(
    q: FloatArray, q_before: FloatArray, dt: float, t: float, links: LinkArrays, state: FloatArray,
    work: Work,
) -> None:  # fmt: skip
    """Forces of the links, into `work.links`; they see the velocity since `q_before`."""
    for j in range(len(q)):
        work.rate[j] = (q[j] - q_before[j]) / dt
    link_forces(q, work.rate, t, links, state, work.record, work.links)


@compiled
def add_work(
    work: FloatArray, force: FloatArray, last: FloatArray, q: FloatArray, q_last: FloatArray
) -> None:
    """Add the work of a force between two displacements, by the trapezoidal rule."""
    for j in range(len(q)):
        work[j] += 0.5 * (last[j] + force[j]) * (q[j] - q_last[j])


@compiled
def de_vogelaere(
    system: System, loads: Loads, plan: Plan, links: LinkArrays, motion: Motion, saved: Saved
) -> None:
    """De Vogelaere's scheme of fourth order, damping implicit in the velocities.

    The half velocity takes a parabola through the accelerations at -1/2, 0 and 1/2.
    """
    t0, h = plan.start, plan.h
    q, v, before, q_before, state = motion.q, motion.v, motion.before, motion.q_before, motion.links
    n = len(q)
    work = new_work(n, len(links.kinds), saved)
    fe, feh, inner, innerh = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    a, ah, vh, known = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    qh, q1, v_before = np.zeros(n), np.zeros(n), np.zeros(n)
    work_out, work_in = np.zeros(n), np.zeros(n)
    # the start: accelerations now and half a step before
    if not motion.has_before:
        for j in range(n):
            q_before[j] = q[j] - 0.5 * h * v[j]
    links_push(q, q_before, 0.5 * h, t0, links, state, work)
    outer_force(loads, 0, fe)
    inner_force(system, q, v, work, inner)
    for j in range(n):
        work.total[j] = fe[j] + inner[j]
    times_vector(system.inverse, work.total, a)
    if not motion.has_before:
        for j in range(n):
            q_before[j] = q[j] - 0.5 * h * v[j] + h * h / 8.0 * a[j]
            v_before[j] = v[j] - 0.5 * h * a[j]
        acceleration(system.inverse, system, q_before, v_before, fe, work, before)
    for j in range(n):
        v_before[j] = v[j] - 0.5 * h * a[j]
    for variable, vector in enumerate((q, v, q_before, v_before, a, before)):
        copy_state(vector, saved.values[0, variable])
    copy_rows(work.record, saved.records[0])
    for k in range(1, plan.steps + 1):
        t = t0 + (k - 1) * h
        # half a step: displacement, links, acceleration, velocity
        for j in range(n):
            qh[j] = q[j] + 0.5 * h * v[j] + h * h / 24.0 * (4.0 * a[j] - before[j])
            known[j] = v[j] + h / 24.0 * (8.0 * a[j] - before[j])
        links_push(qh, q, 0.5 * h, t + 0.5 * h, links, state, work)
        outer_force(loads, 2 * k - 1, feh)
        acceleration(system.half, system, qh, known, feh, work, ah)
        for j in range(n):
            vh[j] = known[j] + 5.0 * h / 24.0 * ah[j]
        inner_force(system, qh, vh, work, innerh)
        add_work(work_out, feh, fe, qh, q)
        add_work(work_in, innerh, inner, qh, q)
        # the whole step, from its start with what the half step gave
        for j in range(n):
            q1[j] = q[j] + h * v[j] + h * h / 6.0 * (a[j] + 2.0 * ah[j])
            known[j] = v[j] + h / 6.0 * (a[j] + 4.0 * ah[j])
        links_push(q1, qh, 0.5 * h, t + h, links, state, work)
        outer_force(loads, 2 * k, fe)
        acceleration(system.full, system, q1, known, fe, work, a)
        for j in range(n):
            v[j] = known[j] + h / 6.0 * a[j]
        inner_force(system, q1, v, work, inner)
        add_work(work_out, feh, fe, q1, qh)
        add_work(work_in, innerh, inner, q1, qh)
        copy_state(q1, q)
        copy_state(ah, before)
        copy_state(qh, q_before)
        if k % plan.every == 0:
            i = k // plan.every
            for variable, vector in enumerate((q, v, qh, vh, a, ah, work_out, work_in)):
                copy_state(vector, saved.values[i, variable])
            copy_rows(work.record, saved.records[i])


@compiled
def newmark(
    system: System, loads: Loads, plan: Plan, links: LinkArrays, motion: Motion, saved: Saved
) -> None:
    """Newmark's scheme with gamma 1/2; links push where the step is predicted to end."""
    t0, h, beta = plan.start, plan.h, plan.beta
    q, v, before, q_before, state = motion.q, motion.v, motion.before, motion.q_before, motion.links
    n = len(q)
    work = new_work(n, len(links.kinds), saved)
    fe, fe1, inner, inner1 = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    a, a1, v1, known = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    guess, q1, qh, vh, ah = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    work_out, work_in = np.zeros(n), np.zeros(n)
    # the start
    if not motion.has_before:
        for j in range(n):
            q_before[j] = q[j] - h * v[j]
    links_push(q, q_before, h, t0, links, state, work)
    outer_force(loads, 0, fe)
    inner_force(system, q, v, work, inner)
    for j in range(n):
        work.total[j] = fe[j] + inner[j]
    times_vector(system.inverse, work.total, a)
    for j in range(n):
        qh[j] = q[j] - 0.5 * h * v[j] + h * h / 8.0 * a[j]
        vh[j] = v[j] - 0.5 * h * a[j]
    for variable, vector in enumerate((q, v, qh, vh, a, a)):
        copy_state(vector, saved.values[0, variable])
    copy_rows(work.record, saved.records[0])
    for k in range(1, plan.steps + 1):
        # predictor
        for j in range(n):
            guess[j] = q[j] + h * v[j] + 0.5 * h * h * a[j]
            q1[j] = q[j] + h * v[j] + h * h * (0.5 - beta) * a[j]
            known[j] = v[j] + 0.5 * h * a[j]
        links_push(guess, q, h, t0 + k * h, links, state, work)
        outer_force(loads, 2 * k, fe1)
        # corrector
        acceleration(system.full, system, q1, known, fe1, work, a1)
        for j in range(n):
            q1[j] += beta * h * h * a1[j]
            v1[j] = known[j] + 0.5 * h * a1[j]
        inner_force(system, q1, v1, work, inner1)
        add_work(work_out, fe1, fe, q1, q)
        add_work(work_in, inner1, inner, q1, q)
        if k % plan.every == 0:
            i = k // plan.every
            for j in range(n):
                qh[j] = 0.5 * (q[j] + q1[j]) - h / 8.0 * (v1[j] - v[j])
                vh[j] = 0.5 * (v[j] + v1[j])
                ah[j] = 0.5 * (a[j] + a1[j])
            for variable, vector in enumerate((q1, v1, qh, vh, a1, ah, work_out, work_in)):
                copy_state(vector, saved.values[i, variable])
            copy_rows(work.record, saved.records[i])
        copy_state(q, q_before)
        copy_state(a, before)
        copy_state(q1, q)
        copy_state(v1, v)
        copy_state(a1, a)
        copy_state(inner1, inner)
        copy_state(fe1, fe)
