"""Small problems as dense arrays for the compiled loop."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.loop import Joints, StepOperators, System


def system_of(problem: Problem) -> System:
    """Matrices, loads and conditions, dense."""
    rows = problem.constraints.C.toarray()
    n_rows, n = rows.shape
    multipliers = np.array([problem.constraints.multipliers(e) for e in np.eye(n)])
    return System(
        problem.K.toarray(),
        problem.M.toarray(),
        problem.C.toarray(),
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
        np.ascontiguousarray(effective.R),
    )


def joints_of(problem: Problem) -> Joints:
    """Interface arrays, empty without joints."""
    joints = problem.interface
    if joints is None:
        empty, none = np.zeros((0, 0)), np.zeros(0, dtype=np.int64)
        pairs = np.zeros((0, 1), dtype=np.int64)
        n = problem.numbering.size
        return Joints(np.zeros((0, n)), pairs, np.zeros((0, 1, 1)), np.zeros(0), none, empty[:, :0])
    return Joints(
        joints.J.toarray(),
        joints.pairs,
        joints.B,
        joints.weights,
        joints.codes,
        np.ascontiguousarray(joints.parameters),
    )
