"""The loops that run steps of one length, behind one interface; which one a problem gets."""

from __future__ import annotations

from typing import cast

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.contact.impact import ImpactRule
from ssilang.kernel.contact.modal import ContactLoop, contact_loop, takes
from ssilang.kernel.contact.rows import BoolArray
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.stepping.effective import effective_matrix, effective_of
from ssilang.kernel.stepping.problem.problem import SMALL, Problem
from ssilang.kernel.stepping.rests.conserving import ConservingLoop
from ssilang.kernel.stepping.rests.dense.arrays import joints_of, operators_of, system_of
from ssilang.kernel.stepping.rests.dense.loop import Motion, Saved, march
from ssilang.kernel.stepping.rests.dense.still_supports import ReducedLoop, supports_are_still
from ssilang.kernel.stepping.rests.modal.modes import SmallLoop, modes_of
from ssilang.kernel.stepping.rests.sparse.adaptive import AdaptiveLoop
from ssilang.kernel.stepping.rests.sparse.loop import SparseLoop, StepSolver
from ssilang.kernel.stepping.step_solvers import step_solver


class ConservingEngine:
    """The energy-conserving loop."""

    name = "conserving"

    def __init__(
        self, problem: Problem, motion: Motion, dt: float, full: bool, closed: BoolArray
    ) -> None:
        effective = effective_of(problem, effective_matrix(problem, dt), dt, 2.0)
        self.solver = effective.inverse.factor.name
        self._loop = ConservingLoop(problem, motion, effective)

    def renew(self, problem: Problem) -> None:
        """Go on with other loads, all else being the same."""
        self._loop.problem = problem

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        return self._loop.march(factors, save, saved, history)


class AdaptiveEngine:
    """Steps split at contact events."""

    name = "adaptive"

    def __init__(
        self, problem: Problem, motion: Motion, dt: float, full: bool, closed: BoolArray
    ) -> None:
        self._loop = AdaptiveLoop(problem, motion, dt, closed)
        self.solver = self._loop.solver

    def renew(self, problem: Problem) -> None:
        """Go on with other loads, all else being the same."""
        self._loop.problem = self._loop.loop.problem = problem

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        return self._loop.march(factors, save, saved, history)


class DenseEngine:
    """The compiled loop; a light one takes an empty history of energies."""

    name = "compiled"
    light = False

    def __init__(
        self, problem: Problem, motion: Motion, dt: float, full: bool, closed: BoolArray
    ) -> None:
        share = 1 - problem.scheme.alpha_f
        effective = effective_of(problem, effective_matrix(problem, dt), dt, share)
        self.solver = effective.inverse.factor.name
        self._reduced: ReducedLoop | SmallLoop | None = None
        modes = modes_of(problem, effective)
        if modes is not None:
            self._reduced = SmallLoop(problem, motion, effective, modes)
            self.light = self._reduced.light
            return
        if supports_are_still(problem):
            self._reduced = ReducedLoop(problem, motion, effective)
            return
        self._system = system_of(problem)
        self._operators = operators_of(problem, effective)
        self._joints = joints_of(problem)
        self._motion = motion
        self._newton = workspace(motion.w.shape, len(motion.f))

    def watch(self, balance: FloatArray) -> None:
        """Keep the sum of energies at the start and the largest departure from it in `balance`."""
        if isinstance(self._reduced, SmallLoop):
            self._reduced.balance = balance

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        if self._reduced is not None:
            return self._reduced.march(factors, save, saved, history)
        return march(
            self._system,
            self._operators,
            self._joints,
            self._motion,
            self._newton,
            factors,
            save,
            saved,
            history,
        )


class SparseEngine:
    """The loop on sparse matrices."""

    name = "condensed"

    def __init__(
        self, problem: Problem, motion: Motion, dt: float, full: bool, closed: BoolArray
    ) -> None:
        A = effective_matrix(problem, dt)
        share = 1 - problem.scheme.alpha_f
        self._step: StepSolver
        self._impact: ImpactRule | None = None
        if full:
            from ssilang.kernel.stepping.rests.sparse.full_newton import FullNewtonSolver

            self.solver, self.name = "SuperLU", "full Newton"
            self._step = FullNewtonSolver(problem, A, share)
        if not full or problem.contact is not None:
            effective = effective_of(problem, A, dt, share)
        if not full:
            self.solver = effective.inverse.factor.name
            self._step = step_solver(problem, effective)
        if problem.contact is not None:
            self._impact = ImpactRule(problem, effective, problem.contact, closed)
        self._loop, self._dt = SparseLoop(problem, motion), dt

    def renew(self, problem: Problem) -> None:
        """Go on with other loads, all else being the same."""
        self._loop.problem = problem

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        return self._loop.march(self._step, self._dt, factors, save, saved, history, self._impact)


class InterleavedEngine:
    """The compiled loop of large problems; the loop on sparse matrices for what it cannot do."""

    name = "condensed"

    def __init__(
        self, problem: Problem, motion: Motion, dt: float, full: bool, closed: BoolArray
    ) -> None:
        from ssilang.kernel.stepping.rests.sparse.interleaved import InterleavedLoop, fits

        share = 1 - problem.scheme.alpha_f
        effective = effective_of(problem, effective_matrix(problem, dt), dt, share)
        self.solver = effective.inverse.factor.name
        self._loop: InterleavedLoop | None = None
        if fits(problem, effective):
            self._loop = InterleavedLoop(problem, motion, effective)
            return
        self.name, self._dt = SparseEngine.name, dt
        self._step = step_solver(problem, effective)
        self._plain = SparseLoop(problem, motion)

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        if self._loop is not None:
            return self._loop.march(factors, save, saved, history)
        return self._plain.march(self._step, self._dt, factors, save, saved, history)


class ContactEngine:
    """The compiled loop of small problems with relations; the sparse one for what it cannot do."""

    name = "compiled"

    def __init__(
        self, problem: Problem, motion: Motion, dt: float, full: bool, closed: BoolArray
    ) -> None:
        share = 1 - problem.scheme.alpha_f
        effective = effective_of(problem, effective_matrix(problem, dt), dt, share)
        found = contact_loop(problem, motion, effective, closed)
        self._loop: ContactLoop | SparseEngine
        self._loop = found or SparseEngine(problem, motion, dt, full, closed)
        self.name = self.name if found else SparseEngine.name
        self.solver = effective.inverse.factor.name

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        return self._loop.march(factors, save, saved, history)


Engine = (
    DenseEngine | SparseEngine | ConservingEngine | AdaptiveEngine | InterleavedEngine
    | ContactEngine
)  # fmt: skip


RenewableEngine = SparseEngine | ConservingEngine | AdaptiveEngine


def renewable_kind(problem: Problem, full_newton: bool) -> type[RenewableEngine]:
    """As `kind_of`, for steps whose matrices and loads are made as the motion goes."""
    kind = kind_of(problem, full_newton)
    loads_fixed = kind in (DenseEngine, InterleavedEngine, ContactEngine)
    return SparseEngine if loads_fixed else cast("type[RenewableEngine]", kind)


def kind_of(problem: Problem, full_newton: bool) -> type[Engine]:
    """Which engine runs a problem.

    Raises
    ------
    KernelError
        For combinations that do not exist.
    """
    scheme, contact = problem.scheme, problem.contact
    if scheme.adaptive and (scheme.conserving or full_newton):
        raise KernelError("kernel.stepping.adapted-steps-condensed-interface")
    plain = contact is None or (contact.friction is None and contact.associated)
    if scheme.conserving and not plain:
        raise KernelError("kernel.stepping.conserving-step-no-friction")
    if scheme.adaptive and not (problem.interface is None and contact is None):
        return AdaptiveEngine
    if scheme.conserving:
        return ConservingEngine
    if problem.contact is not None and not full_newton and takes(problem):
        return ContactEngine
    if full_newton or problem.contact is not None:
        return SparseEngine
    few = problem.numbering.size <= SMALL or (problem.small and supports_are_still(problem))
    return DenseEngine if problem.small and few else InterleavedEngine
