"""Small problems as dense arrays for the compiled loop."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.loop import StepOperators, System, run_dense, sweep_of
from ssilang.kernel.stepping.state import Motion, Outcome, Recorder
from ssilang.kernel.stepping.track import View, whole_view

# The dense loop on all unknowns, where supports move.


class DenseLoop:
    """Steps of one dt."""

    remembered = ("_work",)

    def __init__(self, problem: Problem, motion: Motion, effective: Effective) -> None:
        self._system = system_of(problem)
        self._operators = operators_of(problem, effective)
        self._joints = joints_of(problem)
        self._motion = motion
        self._work = workspace(motion.w.shape, len(motion.f))

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

    def view(self, unknowns: IntArray) -> View:
        """Unknowns as they are."""
        return whole_view(self._motion, unknowns)


def system_of(problem: Problem) -> System:
    """Matrices, loads and conditions, dense."""
    rows = problem.constraints.C.toarray()
    n_rows, n = rows.shape
    multipliers = np.array([problem.constraints.multipliers(e) for e in np.eye(n)])
    return System(
        problem.K.toarray(),
        problem.M.toarray(),
        problem.C.toarray(),
        jumps_of(problem),
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
    return StepOperators(
        newmark_of(problem.scheme, effective.dt),
        np.ascontiguousarray(P),
        np.ascontiguousarray(Q.T),
        np.ascontiguousarray(effective.Y),
        effective.S,
        effective.R if effective.R.any() else np.zeros((0, 0)),
    )


def jumps_of(problem: Problem) -> FloatArray:
    """Rows J (q, n) of the interface, none without joints."""
    joints = problem.interface
    return np.zeros((0, problem.numbering.size)) if joints is None else joints.J.toarray()


def joints_of(problem: Problem) -> Joints:
    """Points of the interface, none without joints."""
    if problem.interface is not None:
        return problem.interface.points
    empty, none = np.zeros((0, 0)), np.zeros(0, dtype=np.int64)
    return Joints(np.zeros((0, 1), np.int64), np.zeros((0, 1, 1)), np.zeros(0), none, empty)
