"""The step by Newton's method on all unknowns: plastic bodies and joints together."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.response import Trial, new_trial
from ssilang.kernel.plasticity.bulk import Answer, Bulk, State
from ssilang.kernel.plasticity.solving.positive import PositiveFactors
from ssilang.kernel.solvers.backends import DISSECTION, dissection_pays
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.full_newton import FullNewtonSolver
from ssilang.kernel.stepping.rests.sparse.loop import StepOutcome
from ssilang.kernel.stepping.state import Motion

TURNS = 30
TOLERANCE = 1e-10
"""Residual over the forces at play; Newton's last step leaves far less."""
STALLED = 1e-7
"""Residual that is accepted where rounding (stiff on soft) keeps Newton from the tolerance."""
RIGID = 1e-5
"""Share of stiffness times displacement below which forces are those of a body that only moves."""
SEARCHES = 4
PATIENCE = 8
"""Turns after which the residual must have fallen below a tenth of what it was at their start."""


@dataclass(frozen=True, eq=False)
class BulkTrial:
    """A displacement under trial: answers of bodies and joints, what is out of balance.

    `free` (n,) is that without contact, `pushed` (size,) the reactions and frictions of contact.
    """

    du: FloatArray
    answer: Answer
    K: sp.csr_array | FloatArray
    joints: Trial
    rest: FloatArray
    residual: float
    free: FloatArray
    pushed: FloatArray

    @property
    def size(self) -> float:
        return float(np.linalg.norm(self.rest))


class BulkSolver(FullNewtonSolver):
    """`A du + c (F_1 - F_0) + c J^T (f_1 - f_0) = r` with the tangents of bodies and joints.

    Attributes
    ----------
    state : State
        Of the bodies at the start of the step; an accepted step replaces it.
    force : array (n,)
        Internal forces of that state.
    work : float
        Of the stresses over the last accepted step.
    time : float
        At the end of the step.
    guess : array (n,) or None
        Increment to start from first; the elastic prediction is tried where it leads nowhere.
    residuals : list of float
        Of the iterations of the last step.
    extent : float
        Largest dimension of the bodies.
    """

    remembered: tuple[str, ...] = ("forces", "force")
    loop, factor, said = "full Newton", "SuperLU", "kernel.stepping.loop-full-newton"
    """What is told of it: names of method and linear solver, code of the sentence."""

    def __init__(
        self, problem: Problem, A: sp.csr_array, share: float, bulk: Bulk, state: State
    ) -> None:
        super().__init__(problem, A, share)
        self.bulk, self.state, self.force = bulk, state, bulk.force(state)
        self._positive = _positive_factors(problem, bulk)
        if self._positive is not None:
            self.factor = DISSECTION
        table = problem.numbering.table
        ends = table.coordinates[problem.numbering.nodes]
        self.extent = float(np.ptp(ends, axis=0).max(initial=0.0)) if len(ends) else 0.0
        self.work, self.time = 0.0, 0.0
        self.guess: FloatArray | None = None
        self.residuals: list[float] = []

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """Newton's method; commits joints and bodies if it converges."""
        if self.guess is not None:
            start = self.guess + self.constraints.particular(dd - self.constraints.C @ self.guess)
            outcome = self._newton(motion, r, start, gap)
            if outcome.turns > 0:
                return outcome
        held = self.constraints.particular(dd)
        free = type(self.bulk) is Bulk and self.bulk.free
        elastic = self.bulk.predicted(self.state, self.time) if free else None
        if elastic is not None:
            start, pushed = self._predicted(motion, r, held, gap, elastic)
            outcome = self._newton(motion, r, start, gap, pushed)
            if outcome.turns > 0:
                return outcome
        start, pushed = self._predicted(motion, r, held, gap) if held.any() else (held, None)
        return self._newton(motion, r, start, gap, pushed)

    def _predicted(
        self,
        motion: Motion,
        r: FloatArray,
        held: FloatArray,
        gap: FloatArray,
        answer: Answer | None = None,
    ) -> tuple[FloatArray, FloatArray | None]:
        """Increment (n,) that moves the supports by `held` with the tangents of the start.

        Support displacements on bodies that stay behind would strain what lies next to the
        supports far beyond what equilibrium does, and Newton's method would set out from there.
        `answer`, where given, is that of the bodies.
        """
        now = self._trial(motion, r, np.zeros_like(held), motion.contact.copy(), answer)
        try:
            step, pushed = self._corrected(motion, now, gap, held)
        except SingularFactorError:
            return held, None
        return held + step, pushed

    def _corrected(
        self, motion: Motion, now: BulkTrial, gap: FloatArray, held: FloatArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """What the tangents of a trial ask for beyond it, beside a motion of the supports.

        Raises
        ------
        SingularFactorError
        """
        whole = self.A + now.K + self.share * now.answer.tangent
        if self._positive is not None:
            free = now.free if held is None else now.free - whole @ held
            step = self._positive.solve(whole, sp.csr_array(now.K), free)
            if step is not None:
                return step, now.pushed
        if held is None:
            return self._turn(motion, whole, now.free, now.du, gap, now.pushed)
        return self._turn(motion, whole, now.free - whole @ held, held, gap, now.pushed)

    def _newton(
        self,
        motion: Motion,
        r: FloatArray,
        start: FloatArray,
        gap: FloatArray,
        pushed: FloatArray | None = None,
    ) -> StepOutcome:
        now = self._trial(motion, r, start, motion.contact.copy() if pushed is None else pushed)
        self.residuals = [now.residual]
        for turn in range(1, TURNS + 1):
            try:
                step, pushed = self._corrected(motion, now, gap)
            except SingularFactorError:
                if now.residual > TOLERANCE:
                    return StepOutcome(now.du, 0, now.residual)
                step, pushed = np.zeros_like(now.du), now.pushed  # all yields, and is in balance
            now = self._searched(motion, r, now, step, pushed)
            if not np.isfinite(now.residual):
                break
            self.residuals.append(now.residual)
            if now.residual <= TOLERANCE or self._stalled():
                motion.contact[:] = now.pushed
                self._commit(motion, now.joints)
                answer = now.answer
                self.state, self.force, self.work = answer.state, answer.force, answer.work
                return StepOutcome(now.du, turn, now.residual)
            if (
                self.bulk.searched
                and turn > PATIENCE
                and now.residual > 0.1 * self.residuals[-PATIENCE - 1]
            ):
                break
        return StepOutcome(now.du, 1 - len(self.residuals), self.residuals[-1])

    def _searched(
        self, motion: Motion, r: FloatArray, now: BulkTrial, step: FloatArray, pushed: FloatArray
    ) -> BulkTrial:
        """The step, halved while what is out of balance would grow.

        Finite displacements take whole steps: bending stretches at first, then falls at once. So
        does contact: parts of a step meet none of its conditions.
        """
        length, halved = 1.0, self.bulk.searched and not self.contact
        for _ in range(SEARCHES if halved else 1):
            found = self._trial(motion, r, now.du + length * step, pushed)
            if found.size < now.size or found.residual <= TOLERANCE:
                break
            length = 0.5 * length
        return found

    def _trial(
        self, motion: Motion, r: FloatArray, du: FloatArray, pushed: FloatArray,
        answer: Answer | None = None,
    ) -> BulkTrial:  # fmt: skip
        joints = new_trial(motion.w.shape, len(motion.f))
        answer = answer or self.bulk.respond(self.state, du, self.time)
        K, force = self._joints(motion, du, joints)
        linear = self.A @ du
        free = r - linear - force - self.share * (answer.force - self.force)
        push: FloatArray = self.contact.pushing.T @ pushed
        rest = self.constraints.V.T @ (free + push)
        parts = (r, linear, answer.force, self.force, force, push)
        stiff = max(float(np.abs(M.data).max(initial=0.0)) for M in (self.A, answer.tangent))
        # at a limit load displacements grow without end: none beyond the size of the body counts
        moved = min(float(np.abs(du).max(initial=0.0)), self.extent)
        floor = RIGID * stiff * moved
        scale = max(sum(float(np.abs(x).max(initial=0.0)) for x in parts), floor, 1e-300)
        residual = float(np.abs(rest).max(initial=0.0)) / scale
        return BulkTrial(du, answer, K, joints, rest, residual, free, pushed)

    def _stalled(self) -> bool:
        last = self.residuals[-3:]
        return len(last) == 3 and max(last) <= STALLED and last[-1] > 0.3 * last[0]


def _positive_factors(problem: Problem, bulk: Bulk) -> PositiveFactors | None:
    """Cholesky factors for large bodies with symmetric tangents and no contact."""
    plain = type(bulk) is Bulk and bulk.symmetric and not problem.contact
    if not plain or not problem.constraints.associated:
        return None
    if problem.solver.name not in (None, DISSECTION):
        return None
    if not dissection_pays(problem.numbering.size):
        return None

    return PositiveFactors(problem)
