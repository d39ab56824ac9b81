"""Initial state of a motion: velocity that the supports allow, acceleration in equilibrium."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.dynamics.problem import Problem
from ssilang.kernel.errors import KernelError
from ssilang.kernel.joints.laws import respond
from ssilang.kernel.joints.response import interface_energies, interface_forces, local_jumps
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.sparse import sp


@dataclass(eq=False)
class JointState:
    """Jumps delta (size,), forces f (size,), local w, t (n_points, d), state; all converged."""

    delta: FloatArray
    f: FloatArray
    w: FloatArray
    t: FloatArray
    state: FloatArray
    D: FloatArray


def joint_state(problem: Problem) -> JointState:
    """Joints at the initial displacement, starting from the problem's state."""
    joints = problem.interface
    if joints is None:
        empty = np.zeros((0, 1))
        return JointState(np.zeros(0), np.zeros(0), empty, empty, empty, np.zeros((0, 1, 1)))
    n, d = joints.n_points, joints.dimension
    delta = joints.J @ problem.u
    w, t, D = np.zeros((n, d)), np.zeros((n, d)), np.zeros((n, d, d))
    state, f = np.zeros_like(problem.state), np.zeros(joints.size)
    local_jumps(joints.pairs, joints.B, delta, w)
    respond(joints.codes, w, problem.state, joints.parameters, t, state, D)
    interface_forces(joints.pairs, joints.B, joints.weights, t, f)
    return JointState(delta, f, w, t, state, D)


def admissible_velocity(problem: Problem) -> FloatArray:
    """The initial velocity, with that of supports that do not move set to zero."""
    rows = problem.constraints.C
    if rows.shape[0] == 0:
        return problem.v.copy()
    factors = problem.loading.at(problem.times[:2])
    moving = (problem.loading.imposed @ (factors[1] - factors[0])) != 0.0
    wanted = np.where(moving, rows @ problem.v, 0.0)
    excess = rows @ problem.v - wanted
    if not excess.any():
        return problem.v.copy()
    return problem.v - problem.constraints.particular(excess)


def initial_acceleration(problem: Problem, v: FloatArray, joints: JointState) -> FloatArray:
    """`M a = F - K u - C v - J^T f` on the motions that the supports leave.

    Motions without mass get none: their equilibrium is that of the next step.
    """
    import scipy.sparse.linalg as spla

    T = problem.constraints.T
    load = problem.loading.forces @ problem.loading.at(problem.times[:1])[0]
    rest = load - problem.K @ problem.u - problem.C @ v
    if problem.interface is not None:
        rest = rest - problem.interface.J.T @ joints.f
    mass = sp.csr_array(T.T @ problem.M @ T)
    heavy = np.flatnonzero(np.abs(mass.diagonal()) > 0.0)
    q = np.zeros(T.shape[1])
    if len(heavy):
        block = sp.csc_array(mass[heavy][:, heavy])
        try:
            q[heavy] = spla.splu(block).solve((T.T @ rest)[heavy])
        except RuntimeError:
            q[heavy] = np.linalg.lstsq(block.toarray(), (T.T @ rest)[heavy], rcond=1e-12)[0]
    if not np.isfinite(q).all():
        raise KernelError("the mass matrix is singular: no initial acceleration can be found")
    a: FloatArray = T @ q
    return a


def initial_energies(problem: Problem, v: FloatArray, joints: JointState) -> FloatArray:
    """Energies at the start, in the order of `compiled_loop` (no work done yet)."""
    stored = lost = 0.0
    p = problem.interface
    if p is not None:
        stored, lost = interface_energies(
            p.codes, p.parameters, p.weights, joints.w, joints.t, joints.state
        )
    kinetic = 0.5 * v @ (problem.M @ v)
    elastic = 0.5 * problem.u @ (problem.K @ problem.u)
    return np.array([kinetic, elastic, stored, lost, 0.0, 0.0])
