"""The step by Newton's method on all unknowns, refactorised at each iteration (comparison)."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.dynamics.compiled_loop import Motion
from ssilang.kernel.dynamics.problem import Problem
from ssilang.kernel.dynamics.sparse_loop import StepOutcome
from ssilang.kernel.joints.response import interface_response, interface_stiffness
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.solvers.backends import SingularFactorError, factorise
from ssilang.kernel.sparse import sp

MOST_TURNS = 40
TOLERANCE = 1e-12


class FullNewtonSolver:
    """`A du + c J^T (f(delta_0 + J du) - f_0) = r`, tangent of the joints included."""

    def __init__(self, problem: Problem, A: sp.csr_array, share: float) -> None:
        self.A, self.share, self.constraints = A, share, problem.constraints
        self.interface = problem.interface

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """Newton from the linear prediction with the joints as they are."""
        du = self.constraints.particular(dd)
        f, new = np.zeros_like(motion.f), np.zeros_like(motion.state)
        residual = np.inf
        for turn in range(1, MOST_TURNS + 1):
            K, force = self._joints(motion, du, f, new)
            rest = self.constraints.V.T @ (r - self.A @ du - force)
            scale = np.abs(r).max(initial=0.0) + np.abs(self.A @ du).max(initial=0.0)
            residual = float(np.abs(rest).max(initial=0.0)) / max(scale, 1e-300)
            if turn > 1 and residual <= TOLERANCE:
                self._commit(motion, du, f, new)
                return StepOutcome(du, turn, residual)
            T, V = self.constraints.T, self.constraints.V
            try:
                factor = factorise(sp.csr_array(V.T @ (self.A + K) @ T), False)
            except SingularFactorError:
                return StepOutcome(du, 0, residual)
            du = du + T @ factor.solve(rest)
        return StepOutcome(du, -MOST_TURNS, residual)

    def _joints(
        self, motion: Motion, du: FloatArray, f: FloatArray, new: FloatArray
    ) -> tuple[sp.csr_array, FloatArray]:
        joints, n = self.interface, len(du)
        if joints is None:
            return sp.csr_array((n, n)), np.zeros(n)
        delta = motion.delta + joints.J @ du
        D = np.zeros((*motion.w.shape, motion.w.shape[1]))
        interface_response(
            joints.pairs, joints.B, joints.weights, joints.codes, joints.parameters, delta,
            motion.state, motion.w, motion.t, new, D, f,
        )  # fmt: skip
        K = np.zeros((joints.size, joints.size))
        interface_stiffness(joints.pairs, joints.B, joints.weights, D, K)
        tangent = sp.csr_array(joints.J.T @ sp.csr_array(self.share * K) @ joints.J)
        return tangent, self.share * (joints.J.T @ (f - motion.f))

    def _commit(self, motion: Motion, du: FloatArray, f: FloatArray, new: FloatArray) -> None:
        if self.interface is not None:
            motion.delta[:] += self.interface.J @ du
            motion.f[:], motion.state[:, :] = f, new
