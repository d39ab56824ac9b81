"""A step with unilateral relations beside the joints, on the interface's unknowns.

With the flexibilities of joints (J) and relations (G) from one factorisation,

    y = y_0 - S_JJ h + S_JG p          h = c (f - f_0) - R y
    g = g_0 - S_GJ h + S_GG p >= 0     p >= 0     p . g = 0

the joints' law is linearised at each turn and eliminated; the complementarity problem that is
left in p is solved by active sets (Josephy and Newton's method).
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.dynamics.compiled_loop import Motion
from ssilang.kernel.dynamics.contact import BoolArray, ContactRows
from ssilang.kernel.dynamics.effective import Effective
from ssilang.kernel.dynamics.problem import Problem
from ssilang.kernel.dynamics.sparse_loop import StepOutcome
from ssilang.kernel.joints.response import interface_response, interface_stiffness
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.solvers.complementarity import ContactProblem, solve_contact
from ssilang.kernel.solvers.contact_methods import METHODS

MOST_TURNS = 40
TOLERANCE = 1e-12
DRIVEN = 1e-6
"""Share of the work of the loads on free motions above which they drive one that nothing stops."""
UNSTOPPED = 1e-9
"""Share of the largest motion of the relations under which a free motion meets none of them."""


class ContactSolver:
    """Steps with unilateral relations by multipliers (the exact conditions)."""

    def __init__(self, problem: Problem, effective: Effective, contact: ContactRows) -> None:
        self.effective, self.contact = effective, contact
        self.interface = problem.interface
        self.share = 1 - problem.scheme.alpha_f
        self.free: FloatArray = effective.constraints.T @ effective.inverse.kernel
        self.YG = effective.solve(contact.G.T.toarray())
        self.SGG = contact.G @ self.YG
        self.options = problem.contact_options
        self.active: BoolArray | None = None

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """The step's increment; also `motion.contact`, the reactions p.

        `gap` (m,) are the gaps for the imposed values at the end of the step and du = 0.
        """
        du = self.effective.solve(r)
        if dd.any():
            du = du + self.effective.imposed(dd)
        g0 = gap + self.contact.G @ du
        if self.free.shape[1]:
            return self._held_by_contact(motion, r, du, g0)
        if self.interface is None:
            p = self._complementarity(self.SGG, g0)
            motion.contact[:] = p
            return StepOutcome(du + self.YG @ p, 1, 0.0)
        return self._with_joints(motion, du, g0)

    def _held_by_contact(
        self, motion: Motion, r: FloatArray, du: FloatArray, g0: FloatArray
    ) -> StepOutcome:
        """Bodies that move freely but for the relations: their motions are unknowns too."""
        stopped = self._stopped()
        free = self.free @ stopped
        work = self.free.T @ r
        left = work - stopped @ (stopped.T @ work)
        if np.abs(left).max(initial=0.0) > DRIVEN * np.abs(work).max(initial=0.0):
            return StepOutcome(du, 0, float(np.abs(left).max()))
        B = self.contact.G @ free
        problem = ContactProblem(self.SGG, g0, B, B, free.T @ r, np.zeros(len(g0), dtype=bool))
        found = solve_contact(problem, self.active)
        self.active = found.active
        motion.contact[:] = found.p
        moved = self.effective.solve(r + self.contact.G.T @ found.p) - self.effective.solve(r)
        return StepOutcome(du + moved + free @ found.a, found.iterations, 0.0)

    def _stopped(self) -> FloatArray:
        """The free motions (k, j) that some relation stops; the others stay at rest.

        A cylinder on a flat slides freely: nothing says how far, and no load drives it there.
        """
        B = self.contact.G @ self.free
        _, sizes, motions = np.linalg.svd(B, full_matrices=False)
        found: FloatArray = motions[sizes > UNSTOPPED * sizes.max(initial=0.0)].T
        return found

    def _complementarity(self, W: FloatArray, q: FloatArray) -> FloatArray:
        found = METHODS[self.options.method](W, q, self.options.coefficient, self.active)
        self.active = found.active
        return found.p

    def _with_joints(self, motion: Motion, du: FloatArray, g0: FloatArray) -> StepOutcome:
        joints, e, G = self.interface, self.effective, self.contact.G
        assert joints is not None
        SJG, SGJ = joints.J @ self.YG, G @ e.Y
        y0 = joints.J @ du
        y, p = y0.copy(), motion.contact.copy()
        f, new = np.zeros_like(motion.f), np.zeros_like(motion.state)
        D = np.zeros((*motion.w.shape, motion.w.shape[1]))
        K = np.zeros((joints.size, joints.size))
        residual = np.inf
        for turn in range(1, MOST_TURNS + 1):
            interface_response(
                joints.pairs, joints.B, joints.weights, joints.codes, joints.parameters,
                motion.delta + y, motion.state, motion.w, motion.t, new, D, f,
            )  # fmt: skip
            h = self.share * (f - motion.f) - e.R @ y
            rest = y - (y0 - e.S @ h + SJG @ p)
            scale = max(np.abs(y).max(), np.abs(motion.delta).max(), np.abs(y0).max(), 1e-300)
            residual = float(np.abs(rest).max() / scale)
            if turn > 1 and residual <= TOLERANCE:
                motion.contact[:] = p
                motion.delta[:] += y
                motion.f[:], motion.state[:, :] = f, new
                return StepOutcome(du - e.Y @ h + self.YG @ p, turn, residual)
            interface_stiffness(joints.pairs, joints.B, joints.weights, D, K)
            tangent = self.share * K - e.R
            inverse = np.linalg.inv(np.eye(joints.size) + e.S @ tangent)
            # y = base + slope p with the law linearised
            base = inverse @ (y0 - e.S @ (h - tangent @ y))
            slope = inverse @ SJG
            W = self.SGG - SGJ @ (tangent @ slope)
            q = g0 - SGJ @ (h + tangent @ (base - y))
            p = self._complementarity(W, q)
            y = base + slope @ p
        return StepOutcome(du, -MOST_TURNS, residual)
