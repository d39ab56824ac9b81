"""Forces of the conditions at instants of a motion, from its balance; closed joints' stiffness."""

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import Motion, Recorder


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


def closed_stiffness(problem: Problem) -> sp.csr_array:
    """The stiffness (n_y, n_y) with closed joints on the motions that the supports leave."""
    T = problem.constraints.T
    return sp.csr_array(T.T @ closed_forces(problem, T))


def closed_forces(problem: Problem, motions: Any) -> Any:
    """What stiffness and closed joints hold motions (n, ...) with, sparse as they are."""
    forces, joints = problem.K @ motions, problem.interface
    if joints is None:
        return forces
    return forces + joints.J.T @ (sp.csr_array(joints.closed_stiffness()) @ (joints.J @ motions))


# Supports that do not move take no part in loops on coordinates; their reactions follow.


def supports_are_still(problem: Problem) -> bool:
    """Whether no support moves, now or later, and the motions left are orthonormal."""
    C, T = problem.constraints.C, problem.constraints.T
    still = not problem.loading.imposed.any() and not np.any(C @ problem.u)
    return still and np.allclose((T.T @ T).toarray(), np.eye(T.shape[1]), atol=1e-13)


def keep_reactions(problem: Problem, factors: FloatArray, kept: Recorder) -> None:
    """Reactions of kept instants, from equilibrium."""
    if len(kept.u):
        loads = factors[1:][kept.row >= 0] @ problem.loading.forces.T
        kept.reaction[:] = reactions(problem, kept.u, kept.v, kept.a, kept.t, loads)


def react(problem: Problem, m: Motion, factors: FloatArray) -> None:
    """Reactions of the motion at load factors (k,), from equilibrium."""
    loads = problem.loading.forces @ factors
    now = (x[None] for x in (m.u, m.v, m.a, m.t, loads))
    m.reaction[:] = reactions(problem, *now)[0]
