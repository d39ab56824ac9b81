"""Small problems as dense arrays, and their whole time loop, compiled."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_state, dot
from ssilang.kernel.interface.newton import Workspace, solve_interface, workspace
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    accept,
    interface_energies,
)
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.newmark import Newmark, newmark_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
    Motion,
    Outcome,
    Recorder,
)
from ssilang.kernel.stepping.track import View, whole_view
from ssilang.kernel.stepping.verbs import advance, end_of_step

# The dense loop on all unknowns, where supports move.


class DenseLoop:
    """Steps of one dt."""

    remembered = ("_work",)

    def __init__(self, problem: Problem, motion: Motion, effective: Effective) -> None:
        self._system = system_of(problem)
        self._operators = operators_of(problem, effective)
        self._joints = joints_of(problem)
        self._motion = motion
        self._work = workspace(motion.w.shape, len(motion.f), problem.scheme.conserving)

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps on the whole problem's arrays."""
        return run_dense(
            self._system,
            self._operators,
            self._joints,
            self._motion,
            sweep_of(self._system),
            self._work,
            factors,
            recorder,
        )

    def renew(self, problem: Problem) -> None:
        """Go on with other loads, all else being the same."""
        loads = (problem.loading.forces, problem.loading.imposed)
        forces, imposed = (np.ascontiguousarray(x) for x in loads)
        self._system = self._system._replace(forces=forces, imposed=imposed)

    def view(self, unknowns: IntArray) -> View:
        """Unknowns as they are."""
        return whole_view(self._motion, unknowns)


def system_of(problem: Problem) -> System:
    """Matrices, loads and conditions, dense."""
    rows = problem.constraints.C.toarray()
    n_rows, n = rows.shape
    multipliers = np.array([problem.constraints.multipliers(e) for e in np.eye(n)])
    joints = problem.interface
    return System(
        problem.K.toarray(),
        problem.M.toarray(),
        problem.C.toarray(),
        np.zeros((0, problem.numbering.size)) if joints is None else joints.J.toarray(),
        problem.C.nnz > 0,
        np.ascontiguousarray(problem.loading.forces),
        np.ascontiguousarray(problem.loading.imposed),
        rows,
        np.ascontiguousarray(multipliers.reshape(n, n_rows).T),
    )


def operators_of(problem: Problem, effective: Effective) -> StepOperators:
    """Inverse on the admissible motions and response to imposed values, dense."""
    n, n_rows = problem.numbering.size, problem.constraints.C.shape[0]
    P = effective.solve(np.eye(n))
    Q = np.array([effective.imposed(e) for e in np.eye(n_rows)]).reshape(n_rows, n)
    R = effective.R if effective.R.any() else np.zeros((0, 0))
    return StepOperators(
        newmark_of(problem.scheme, effective.dt),
        np.ascontiguousarray(P),
        np.ascontiguousarray(Q.T),
        np.ascontiguousarray(effective.Y),
        Condensed(effective.S, R, 1 - problem.scheme.alpha_f),
    )


def joints_of(problem: Problem) -> Joints:
    """Points of the interface, none without joints."""
    if problem.interface is not None:
        return problem.interface.points
    empty, none = np.zeros((0, 0)), np.zeros(0, dtype=np.int64)
    return Joints(np.zeros((0, 1), np.int64), np.zeros((0, 1, 1)), np.zeros(0), none, empty)


class System(NamedTuple):
    """What does not change with dt: dense matrices (n, n), loads, conditions."""

    K: FloatArray
    M: FloatArray
    C: FloatArray
    J: FloatArray  # (q, n), jumps of the interface
    damped: bool
    forces: FloatArray  # (n, k)
    imposed: FloatArray  # (n_rows, k)
    rows: FloatArray  # (n_rows, n)
    multipliers: FloatArray  # (n_rows, n): reactions of the rows from forces on the unknowns


class StepOperators(NamedTuple):
    """What depends on dt: `du = P r + Q dd - Y h`."""

    newmark: Newmark
    P: FloatArray  # (n, n)
    Q: FloatArray  # (n, n_rows)
    Y: FloatArray  # (n, q)
    condensed: Condensed


class Sweep(NamedTuple):
    """Vectors that each step overwrites."""

    r: FloatArray  # (n,) right-hand side
    du: FloatArray  # (n,)
    dd: FloatArray  # (n_rows,) increments of the imposed values
    load0: FloatArray  # (n,)
    load1: FloatArray  # (n,)
    v0: FloatArray  # (n,) velocity at the step's start
    past: FloatArray  # (n,) room
    product: FloatArray  # (n,) room
    old: FloatArray  # (n,) reaction at the step's start


def sweep_of(system: System) -> Sweep:
    """Room for a system."""
    n = len(system.M)
    r, du, load0, load1, v0, past, product, old = (np.zeros(n) for _ in range(8))
    return Sweep(r, du, np.zeros(len(system.rows)), load0, load1, v0, past, product, old)


@compiled_fast
def _times_vector(A: FloatArray, x: FloatArray, out: FloatArray) -> None:
    for i in range(A.shape[0]):
        out[i] = dot(A[i], x)


@compiled_fast
def _form(A: FloatArray, x: FloatArray) -> float:
    """x^T A x."""
    total = 0.0
    for i in range(A.shape[0]):
        total += dot(A[i], x) * x[i]
    return total


@compiled
def _add(target: FloatArray, factor: float, source: FloatArray) -> None:
    for i in range(source.shape[0]):
        target[i] += factor * source[i]


@compiled
def _finite(x: FloatArray) -> bool:
    for i in range(x.shape[0]):  # noqa: SIM110
        if not np.isfinite(x[i]):
            return False
    return True


@apart
@compiled
def _predict(system: System, n: Newmark, x: Motion, sweep: Sweep) -> None:
    """Right-hand side r of `A du + end J^T (f1 - f0) = r`."""
    r, past, product = sweep.r, sweep.past, sweep.product
    for i in range(len(r)):
        past[i] = n.m_v * x.v[i] + n.m_a * x.a[i]
    _times_vector(system.M, past, r)
    _times_vector(system.K, x.u, product)
    for i in range(len(r)):
        r[i] += n.end * sweep.load1[i] + n.start * sweep.load0[i] - product[i]
    if system.damped:
        for i in range(len(r)):
            past[i] = n.c_v * x.v[i] + n.c_a * x.a[i]
        _times_vector(system.C, past, product)
        _add(r, -1.0, product)
    for j in range(len(x.f)):
        if x.f[j] != 0.0:
            for i in range(len(r)):
                r[i] -= system.J[j, i] * x.f[j]


@compiled
def _respond(
    system: System, step: StepOperators, x: Motion, factor: FloatArray, sweep: Sweep
) -> None:
    """Increment du under r and what is imposed, the joints' forces as they are."""
    _times_vector(step.P, sweep.r, sweep.du)
    dd = sweep.dd
    if len(dd) == 0:
        return
    _times_vector(system.imposed, factor, dd)
    for row in range(len(dd)):
        for i in range(len(x.u)):
            dd[row] -= system.rows[row, i] * x.u[i]
    _times_vector(step.Q, dd, sweep.product)
    _add(sweep.du, 1.0, sweep.product)


@compiled
def _advance(n: Newmark, x: Motion, sweep: Sweep) -> None:
    """Displacement, velocity and acceleration after the increment du."""
    for i in range(len(x.u)):
        du, v = sweep.du[i], x.v[i]
        x.u[i] += du
        x.v[i], x.a[i] = advance(n, du, v, x.a[i])
        sweep.v0[i] = v


@apart
@compiled
def _account(system: System, joints: Joints, b: float, x: Motion, sweep: Sweep) -> None:
    """Reactions, to the part b those of the start, and energies of the new state.

    Work is that of mean forces on the increment, exact for the average acceleration.
    """
    n, du, dd, product = len(x.u), sweep.du, sweep.dd, sweep.product
    copy_state(x.reaction, sweep.old)
    _times_vector(system.M, x.a, x.reaction)
    _times_vector(system.K, x.u, product)
    elastic, external, damped = 0.0, 0.0, 0.0
    for i in range(n):
        elastic += 0.5 * product[i] * x.u[i]
        external += 0.5 * (sweep.load0[i] + sweep.load1[i]) * du[i]
        x.reaction[i] += product[i] - (1.0 - b) * sweep.load1[i] - b * sweep.load0[i]
    if b > 0.0:
        _times_vector(system.K, du, product)
        _add(x.reaction, -b, product)
    if system.damped:
        _times_vector(system.C, x.v, product)
        _add(x.reaction, 1.0 - b, product)
        for i in range(n):
            damped += 0.5 * du[i] * product[i]
        _times_vector(system.C, sweep.v0, product)
        _add(x.reaction, b, product)
        for i in range(n):
            damped += 0.5 * du[i] * product[i]
        x.energies[DAMPED] += damped
    for j in range(len(x.f)):
        if x.f[j] != 0.0:
            for i in range(n):
                x.reaction[i] += system.J[j, i] * x.f[j]
    if b > 0.0:
        copy_state(x.reaction, sweep.old)
    for row in range(len(dd)):
        if dd[row] != 0.0:
            for i in range(n):
                mean = 0.5 * (sweep.old[i] + x.reaction[i])
                external += dd[row] * system.multipliers[row, i] * mean
    x.energies[KINETIC] = 0.5 * _form(system.M, x.v)
    x.energies[ELASTIC] = elastic
    x.energies[EXTERNAL] += external
    if len(x.f):
        stored, lost = interface_energies(joints, x.w, x.t, x.state)
        x.energies[STORED], x.energies[LOST] = stored, lost


@compiled
def run_dense(
    system: System,
    step: StepOperators,
    joints: Joints,
    motion: Motion,
    sweep: Sweep,
    work: Workspace,
    factors: FloatArray,
    to: Recorder,
) -> tuple[int, int, float]:
    """Steps of one dt; see `state.Outcome` for the result.

    Parameters
    ----------
    factors : array (n_steps + 1, k)
        Load factors at the times, the first being that of the current state.
    """
    scheme, trial, worst = step.newmark, work.trial, 0
    now = InterfaceState(motion.delta, motion.f, motion.w, motion.t, motion.state)
    _times_vector(system.forces, factors[0], sweep.load0)
    for k in range(len(to.row)):
        # predict: the past, the loads, and what supports impose
        _times_vector(system.forces, factors[k + 1], sweep.load1)
        _predict(system, scheme, motion, sweep)
        _respond(system, step, motion, factors[k + 1], sweep)
        if len(motion.f):  # solve: Newton's method on the interface
            _times_vector(system.J, sweep.du, trial.y0)
            copy_state(trial.y0, trial.y)
            turns, residual = solve_interface(joints, step.condensed, now, work)
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            _times_vector(step.Y, trial.h, sweep.product)
            _add(sweep.du, -1.0, sweep.product)
            accept(trial, now)
        _advance(scheme, motion, sweep)
        if not _finite(motion.u):
            return k, -1, np.inf
        _account(system, joints, scheme.before, motion, sweep)
        end_of_step(motion, to, k)
        copy_state(sweep.load1, sweep.load0)
    return len(to.row), worst, 0.0
