"""Forces of the conditions at instants of a motion, from its balance."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.stepping.problem.problem import Problem


def reactions(
    problem: Problem, u: FloatArray, v: FloatArray, a: FloatArray, t: FloatArray, loads: FloatArray
) -> FloatArray:
    """`M a + C v + K u + J^T f - F` of several instants, one a row."""
    p = problem
    total: FloatArray = (p.M @ a.T + p.C @ v.T + p.K @ u.T).T - loads
    if p.interface is not None:
        total = total + joint_forces(problem, t) @ p.interface.J
    return total


def joint_forces(problem: Problem, t: FloatArray) -> FloatArray:
    """Forces (n_rows, q) on the jumps of the interface from tractions (n_rows, n_points, d)."""
    joints = problem.interface
    assert joints is not None
    d, x = joints.dimension, joints.points
    local = np.einsum("p,rpi,pik->rpk", x.weights, t, x.B)
    places = (x.pairs[:, :, None] * d + np.arange(d)).reshape(len(x.pairs), -1)
    f = np.zeros((len(t), joints.size))
    np.add.at(f, (np.arange(len(t))[:, None, None], places[None]), local)
    return f
