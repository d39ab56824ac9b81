"""The compiled loop on the motions that fixed supports leave, for small problems.

Supports that do not move take no part in the loop; displacements, and reactions from
equilibrium, are put back for the instants that are kept.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.arrays import joints_of, jumps_of
from ssilang.kernel.stepping.rests.dense.loop import Motion, Saved, StepOperators, System, march


def supports_are_still(problem: Problem) -> bool:
    """Whether no support moves, now or later, and the motions left are orthonormal."""
    C, T = problem.constraints.C, problem.constraints.T
    still = not problem.loading.imposed.any() and not np.any(C @ problem.u)
    return still and np.allclose((T.T @ T).toarray(), np.eye(T.shape[1]), atol=1e-13)


class ReducedLoop:
    """Steps of one dt on `u = T q`."""

    def __init__(self, problem: Problem, motion: Motion, effective: Effective) -> None:
        self.problem, self.motion = problem, motion
        self.T: FloatArray = problem.constraints.T.toarray()
        self.joints = joints_of(problem)
        self._newton = workspace(motion.w.shape, len(motion.f))
        n = self.T.shape[1]
        s = problem.scheme
        self.system = System(
            self._reduced(problem.K.toarray()),
            self._reduced(problem.M.toarray()),
            self._reduced(problem.C.toarray()),
            np.ascontiguousarray(jumps_of(problem) @ self.T),
            problem.C.nnz > 0,
            np.ascontiguousarray(self.T.T @ problem.loading.forces),
            np.zeros((0, problem.loading.forces.shape[1])),
            np.zeros((0, n)),
            np.zeros((0, n)),
            np.array([s.alpha_m, s.alpha_f, s.beta, s.gamma]),
        )
        self.step = StepOperators(
            effective.dt,
            np.ascontiguousarray(effective.inverse.solve(np.eye(n))),
            np.zeros((n, 0)),
            np.ascontiguousarray(self.T.T @ effective.Y),
            effective.S,
            effective.R if effective.R.any() else np.zeros((0, 0)),
        )

    def _reduced(self, A: FloatArray) -> FloatArray:
        return np.ascontiguousarray(self.T.T @ A @ self.T)

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        """As `compiled_loop.march`, on the whole problem's arrays."""
        m, n, rows = self.motion, self.T.shape[1], len(saved.u)
        few = Motion(
            self.T.T @ m.u, self.T.T @ m.v, self.T.T @ m.a, m.delta, m.f, m.w, m.t, m.state,
            np.zeros(n), m.energies, m.contact,
        )  # fmt: skip
        u, v, a, idle = (np.zeros((rows, n)) for _ in range(4))
        kept = Saved(u, v, a, idle, saved.w, saved.t, saved.state, saved.contact)
        outcome = march(
            self.system, self.step, self.joints, few, self._newton, factors, save, kept, history
        )
        m.u[:], m.v[:], m.a[:] = self.T @ few.u, self.T @ few.v, self.T @ few.a
        saved.u[:], saved.v[:], saved.a[:] = u @ self.T.T, v @ self.T.T, a @ self.T.T
        loads = factors[1:][save >= 0] @ self.problem.loading.forces.T
        saved.reaction[:] = reactions(
            self.problem, self.joints, saved.u, saved.v, saved.a, saved.t, loads
        )
        last = factors[outcome[0]] @ self.problem.loading.forces.T
        now = (x[None] for x in (m.u, m.v, m.a, m.t, last))
        m.reaction[:] = reactions(self.problem, self.joints, *now)[0]
        return outcome


def reactions(
    problem: Problem, joints: Joints, u: FloatArray, v: FloatArray, a: FloatArray, t: FloatArray,
    loads: FloatArray,
) -> FloatArray:  # fmt: skip
    """`M a + C v + K u + J^T f - F` of several instants, one a row."""
    p = problem
    total: FloatArray = (p.M @ a.T + p.C @ v.T + p.K @ u.T).T - loads
    if p.interface is not None:
        d = p.interface.dimension
        local = np.einsum("p,rpi,pik->rpk", joints.weights, t, joints.B)
        places = (joints.pairs[:, :, None] * d + np.arange(d)).reshape(len(joints.pairs), -1)
        f = np.zeros((len(u), p.interface.size))
        np.add.at(f, (np.arange(len(u))[:, None, None], places[None]), local)
        total = total + f @ p.interface.J
    return total
