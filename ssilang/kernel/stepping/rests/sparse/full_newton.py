"""The step by Newton's method on all unknowns, refactorised at each iteration (comparison)."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.solver import ContactForces, stopped_motions
from ssilang.kernel.interface.interface import Interface, joint_stiffness
from ssilang.kernel.interface.response import (
    Trial,
    accept,
    interface_response,
    new_trial,
)
from ssilang.kernel.solvers.backends import factorise
from ssilang.kernel.solvers.cholesky.inverse import invert
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import StepOutcome
from ssilang.kernel.stepping.state import Motion

MOST_TURNS = 40
TOLERANCE = 1e-12


class FullNewtonSolver:
    """`A du + c J^T (f(delta_0 + J du) - f_0) = r`, tangent of the joints included.

    Unilateral relations and friction push besides: each turn finds their forces on the
    linearised system, gaps and slips being linear in du.
    """

    remembered: tuple[str, ...] = ("forces",)

    def __init__(self, problem: Problem, A: sp.csr_array, share: float) -> None:
        self.A, self.share, self.constraints = A, share, problem.constraints
        self.solver = problem.solver
        self.interface, self.contact = problem.interface, problem.contact
        self.forces = ContactForces(self.contact, problem.contact_options)

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """Newton from the linear prediction with the joints as they are."""
        du = self.constraints.particular(dd)
        trial = new_trial(motion.w.shape, len(motion.f))
        pushed = motion.contact.copy()
        residual = np.inf
        for turn in range(1, MOST_TURNS + 1):
            K, force = self._joints(motion, du, trial)
            free = r - self.A @ du - force
            rest = self.constraints.V.T @ (free + self.contact.pushing.T @ pushed)
            scale = np.abs(r).max(initial=0.0) + np.abs(self.A @ du).max(initial=0.0)
            scale += np.abs(pushed).max(initial=0.0)
            residual = float(np.abs(rest).max(initial=0.0)) / max(scale, 1e-300)
            if turn > 1 and residual <= TOLERANCE:
                motion.contact[:] = pushed
                self._commit(motion, trial)
                return StepOutcome(du, turn, residual)
            try:
                step, pushed = self._turn(motion, self.A + K, free, du, gap, pushed)
            except SingularFactorError:
                return StepOutcome(du, 0, residual)
            du = du + step
        return StepOutcome(du, -MOST_TURNS, residual)

    def _turn(
        self,
        motion: Motion,
        A: sp.csr_array,
        free: FloatArray,
        du: FloatArray,
        gap: FloatArray,
        pushed: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:
        """Increment of du for what is out of balance without contact, and the contact forces."""
        T, V = self.constraints.T, self.constraints.V
        matrix = sp.csr_array(V.T @ A @ T)
        if not self.contact:
            return T @ factorise(matrix, False, self.solver).solve(V.T @ free), pushed
        inverse, rows = invert(matrix, False, self.solver), self.contact
        kernel: FloatArray = T @ inverse.kernel
        motions = kernel @ stopped_motions(rows, kernel) if kernel.shape[1] else kernel
        if motions.shape[1] < kernel.shape[1]:
            raise SingularFactorError("free motions")
        step = T @ inverse.solve(V.T @ free)
        Y = T @ inverse.solve(V.T @ rows.pushing.T.toarray())
        q = rows.at_rest(motion.u, gap) + rows.seen @ (du + step)
        W = rows.seen @ Y
        if not motions.shape[1]:
            found = self.forces.held(W, q)
            return step + Y @ found, found
        found, a = self.forces.with_motions(
            W, q, rows.seen @ motions, rows.pushing @ motions, motions.T @ free
        )
        moved = T @ inverse.solve(V.T @ (free + rows.pushing.T @ found))
        return moved + motions @ a, found

    def _joints(
        self, motion: Motion, du: FloatArray, trial: Trial
    ) -> tuple[sp.csr_array, FloatArray]:
        joints, n = self.interface, len(du)
        if not joints:
            return sp.csr_array((n, n)), np.zeros(n)
        trial.y[:] = joints.J @ du
        trial.delta[:] = motion.delta + trial.y
        interface_response(joints.points, motion.state, trial.delta, trial)
        tangent = sp.csr_array(joints.J.T @ self._joint_stiffness(joints, trial) @ joints.J)
        return tangent, self.share * (joints.J.T @ (trial.f - motion.f))

    def _joint_stiffness(self, joints: Interface, trial: Trial) -> sp.csr_array:
        """Stiffness on the jumps; of the closed joints before anything has moved.

        A joint that is neither pressed nor open has two tangents; that of the open one may leave
        a body free that the loads go on to press.
        """
        if not trial.delta.any():
            return self.share * joints.closed_stiffness()
        return self.share * joint_stiffness(joints.points, trial.D, joints.size)

    def _commit(self, motion: Motion, trial: Trial) -> None:
        if self.interface:
            accept(trial, motion.joints)
