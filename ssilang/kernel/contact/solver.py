"""A step with unilateral relations and friction beside the joints, on the interface's unknowns.

With the flexibilities of joints (J), of what forces push by (P) and of what is seen (G: gaps,
slips, tensions) from one factorisation,

    y = y_0 - S_JJ h + S_JP lam          h = c (f - f_0) - R y
    g = g_0 - S_GJ h + S_GP lam          lam = (reactions p, frictions)

the joints' law is linearised at each turn and eliminated; the problem that is left in lam is
solved by active sets, with friction by Newton's method on projections (Josephy and Newton).
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.contact.conserving import ConservingSolver
from ssilang.kernel.contact.rows import BoolArray, ContactRows
from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.interface import response
from ssilang.kernel.solvers.active_set.complementarity import ContactProblem, solve_contact
from ssilang.kernel.solvers.active_set.contact_methods import METHODS
from ssilang.kernel.solvers.active_set.coulomb import CoulombProblem, solve_coulomb
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import CondensedSolver, StepOutcome, StepSolver
from ssilang.kernel.stepping.state import Motion

MOST_TURNS = 40
TOLERANCE = 1e-12
DRIVEN = 1e-6
"""Share of the work of the loads on free motions above which they drive one that nothing stops."""
UNSTOPPED = 1e-9
"""Share of the largest motion of the relations under which a free motion meets none of them."""


class ContactForces:
    """Finds reactions and frictions from what is seen without them and the flexibility."""

    remembered = ("active", "last")

    def __init__(self, contact: ContactRows, options: ContactOptions) -> None:
        self.contact, self.options = contact, options
        self.active: BoolArray | None = None
        self.last: FloatArray | None = None

    def held(self, W: FloatArray, q: FloatArray) -> FloatArray:
        """Forces (size,) for `seen = q + W forces`."""
        if self.contact.friction:
            return self.with_motions(W, q, np.zeros((len(q), 0)), np.zeros((W.shape[1], 0)))[0]
        found = METHODS[self.options.method](W, q, self.options.coefficient, self.active)
        self.active = found.active
        return found.p

    def with_motions(
        self,
        W: FloatArray,
        q: FloatArray,
        B: FloatArray,
        E: FloatArray,
        r: FloatArray | None = None,
    ) -> tuple[FloatArray, FloatArray]:
        """Forces, and amplitudes a of free motions on which loads do the work r (none: held).

        `seen = q + W forces + B a`, `r + E^T forces = 0`.
        """
        work = np.zeros(0) if r is None else r
        friction, m = self.contact.friction, len(self.contact)
        if not friction:
            found = solve_contact(ContactProblem(W, q, B, E, work, np.zeros(m, bool)), self.active)
            self.active = found.active
            return found.p, found.a
        if self.options.method == "PENALITE":
            W = W.copy()
            W[np.arange(m), np.arange(m)] += 1.0 / (self.options.coefficient or np.inf)
        problem = CoulombProblem(
            W, q, B, E, work, m, friction.width, friction.normal, friction.coefficient,
            friction.constant,
        )  # fmt: skip
        rubbing = solve_coulomb(problem, self.last)
        self.last = rubbing.forces
        return rubbing.forces, rubbing.a


class ContactSolver:
    """Steps with unilateral relations by multipliers (the exact conditions)."""

    remembered = ("forces",)

    def __init__(self, problem: Problem, effective: Effective, contact: ContactRows) -> None:
        self.effective, self.contact = effective, contact
        self.interface = problem.interface
        self.share = 1 - problem.scheme.alpha_f
        self.free: FloatArray = effective.constraints.T @ effective.inverse.kernel
        self.Y = effective.solve(contact.pushing.T.toarray())
        self.S = contact.seen @ self.Y
        self.forces = ContactForces(contact, problem.contact_options)

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """The step's increment; also `motion.contact`, the reactions and frictions.

        `gap` (m,) are the gaps for the imposed values at the end of the step and du = 0.
        """
        du = self.effective.solve(r)
        if dd.any():
            du = du + self.effective.imposed(dd)
        g0 = self.contact.at_rest(motion.u, gap) + self.contact.seen @ du
        if self.free.shape[1]:
            return self._held_by_contact(motion, r, du, g0)
        if not self.interface:
            found = self.forces.held(self.S, g0)
            motion.contact[:] = found
            return StepOutcome(du + self.Y @ found, 1, 0.0)
        return self._with_joints(motion, du, g0)

    def _held_by_contact(
        self, motion: Motion, r: FloatArray, du: FloatArray, g0: FloatArray
    ) -> StepOutcome:
        """Bodies that move freely but for the relations: their motions are unknowns too."""
        stopped = stopped_motions(self.contact, self.free)
        free = self.free @ stopped
        work = self.free.T @ r
        left = work - stopped @ (stopped.T @ work)
        if np.abs(left).max(initial=0.0) > DRIVEN * np.abs(work).max(initial=0.0):
            return StepOutcome(du, 0, float(np.abs(left).max()))
        rows = self.contact
        found, a = self.forces.with_motions(
            self.S, g0, rows.seen @ free, rows.pushing @ free, free.T @ r
        )
        motion.contact[:] = found
        moved = self.effective.solve(r + rows.pushing.T @ found) - self.effective.solve(r)
        return StepOutcome(du + moved + free @ a, 1, 0.0)

    def _with_joints(self, motion: Motion, du: FloatArray, g0: FloatArray) -> StepOutcome:
        joints, e, seen = self.interface, self.effective, self.contact.seen
        SJP, SGJ = joints.J @ self.Y, seen @ e.Y
        trial, found = response.new_trial(motion.w.shape, joints.size), motion.contact.copy()
        now = motion.joints
        y0, y = trial.y0, trial.y
        y0[:] = joints.J @ du
        y[:] = y0
        K = np.zeros((joints.size, joints.size))
        residual = np.inf
        for turn in range(1, MOST_TURNS + 1):
            response.interface_response(joints.points, motion.state, motion.delta + y, trial)
            h = self.share * (trial.f - motion.f) - e.R @ y
            rest = y - (y0 - e.S @ h + SJP @ found)
            scale = max(np.abs(y).max(), np.abs(motion.delta).max(), np.abs(y0).max(), 1e-300)
            residual = float(np.abs(rest).max() / scale)
            if turn > 1 and residual <= TOLERANCE:
                motion.contact[:] = found
                response.accept(trial, now)
                return StepOutcome(du - e.Y @ h + self.Y @ found, turn, residual)
            response.interface_stiffness(joints.points, trial.D, K)
            tangent = self.share * K - e.R
            inverse = np.linalg.inv(np.eye(joints.size) + e.S @ tangent)
            # y = base + slope forces with the law linearised
            base = inverse @ (y0 - e.S @ (h - tangent @ y))
            slope = inverse @ SJP
            W = self.S - SGJ @ (tangent @ slope)
            q = g0 - SGJ @ (h + tangent @ (base - y))
            found = self.forces.held(W, q)
            y[:] = base + slope @ found
        return StepOutcome(du, -MOST_TURNS, residual)


def stopped_motions(contact: ContactRows, free: FloatArray) -> FloatArray:
    """The combinations (f, j) of free motions (n, f) that relations or friction stop.

    A cylinder on a smooth flat slides freely: nothing says how far, and no load drives it there.
    """
    B = contact.pushing @ free
    _, sizes, motions = np.linalg.svd(B, full_matrices=False)
    return motions[sizes > UNSTOPPED * sizes.max(initial=0.0)].T


def step_solver(problem: Problem, effective: Effective) -> StepSolver:
    """The condensed interface, with active sets where there are unilateral relations."""
    if not problem.contact:
        return CondensedSolver(problem, effective)
    if problem.scheme.conserving:
        return ConservingSolver(problem, effective, problem.contact)
    return ContactSolver(problem, effective, problem.contact)
