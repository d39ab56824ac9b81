"""Load steps and time steps of problems with plastic bodies."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import ConvergenceError, KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.impact import ImpactRule
from ssilang.kernel.interface.response import interface_energies
from ssilang.kernel.plasticity.bulk import Bulk, State
from ssilang.kernel.plasticity.newton import BulkSolver
from ssilang.kernel.plasticity.snapshot import NOTHING, BulkSnapshot
from ssilang.kernel.plasticity.solving.accelerated import AcceleratedSolver, is_accelerated
from ssilang.kernel.plasticity.solving.dense import DenseSolver, is_small
from ssilang.kernel.statics.stepping import hand_over, lost, recorded, through
from ssilang.kernel.stepping.effective import effective_matrix, effective_of
from ssilang.kernel.stepping.keeping import Keeper, KeptSteps, leaves, memory, rebuilt, recall
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem import initial
from ssilang.kernel.stepping.problem.initial import accelerated, with_contact
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import (
    SparseLoop,
    StepOutcome,
    balance,
    lose,
    support_work,
)
from ssilang.kernel.stepping.run import History, Progress
from ssilang.kernel.stepping.snapshot import Observer, snapshot_of
from ssilang.kernel.stepping.state import (
    ELASTIC,
    EXTERNAL,
    LOST,
    STORED,
    Motion,
)
from ssilang.messages.message import Sentence

HALVINGS = 7
"""How often a step that does not converge is cut in two."""
MANY = 1_000
"""Unknowns from which steps keep a factor; below, factors take less than the loading of code."""
WORTH = 30_000
"""Points times steps from which a zone is worth the loading of compiled code."""
SAME_STEP = 1e-9
"""Relative difference below which two steps of time share their matrix."""


@dataclass(eq=False)
class BulkRun:
    """A calculation under way: `motion` and `state` are those of the last accepted step.

    Motions carry the bodies' internal `force` (n,) from step to step; `full` asks for Newton's
    method on all unknowns where steps could keep a factor.
    """

    problem: Problem
    bulk: Bulk
    state: State
    observers: tuple[Observer, ...] = ()
    progress: Progress | None = None
    lost: float = 0.0
    residuals: list[list[float]] = field(default_factory=list)
    last: tuple[FloatArray, FloatArray] | None = None
    keeper: Keeper | None = None
    full: bool = False
    motion: Motion = field(init=False)
    force: FloatArray = field(init=False)
    begun: State = field(init=False)

    def __post_init__(self) -> None:
        p, self.begun = self.problem, self.state
        self.force, self._energy = self.bulk.force(self.state), (self.state, np.nan)
        if p.scheme.conserving or p.scheme.adaptive:
            raise KernelError("kernel.plasticity.plastic-bodies-stepped-newmark")
        self.motion = initial.motion_at_rest(p)
        self.motion.energies[ELASTIC] += self.stored()

    def stored(self) -> float:
        """Energy that the bodies store now."""
        if self._energy[0] is not self.state or np.isnan(self._energy[1]):
            self._energy = (self.state, self.bulk.stored(self.state))
        return self._energy[1]

    def imbalance(self, force: FloatArray, factors: FloatArray) -> FloatArray:
        """Internal forces less loads (n,), without inertia; `force` is that of the bodies."""
        p, m = self.problem, self.motion
        rest: FloatArray = p.K @ m.u + force - p.loading.forces @ factors
        return rest + p.interface.J.T @ m.f if p.interface else rest

    def account(self, before: float, work: float) -> None:
        """Energies of bodies and joints after a step; `before` was the bodies' stored energy."""
        p, m = self.problem, self.motion
        stored = self.stored()
        self.lost += work - (stored - before)
        m.energies[ELASTIC] = 0.5 * m.u @ (p.K @ m.u) + stored
        joints = p.interface
        m.energies[LOST] = 0.0
        if joints:
            m.energies[STORED], m.energies[LOST] = interface_energies(
                joints.points, m.w, m.t, m.state
            )
        m.energies[LOST] += self.lost

    def accept(
        self, solver: BulkSolver, du: FloatArray, before: FloatArray, after: FloatArray,
        pushed: FloatArray,
    ) -> None:  # fmt: skip
        """Take a step du (n,) between load factors; `pushed` is what contact pushed with before."""
        p, m = self.problem, self.motion
        stored, old, driven = self.stored(), m.reaction.copy(), self.bulk.pushed(self.state)
        m.u[:] += du
        self.state = solver.state
        m.reaction[:] = self.imbalance(solver.force, after)
        driven = 0.5 * (driven + self.bulk.pushed(self.state))
        m.energies[EXTERNAL] += du @ (p.loading.forces @ (0.5 * (before + after)) + driven)
        mean, dd = 0.5 * (pushed + m.contact), p.constraints.C @ du
        reaction = 0.5 * (old + m.reaction)
        m.energies[EXTERNAL] += support_work(p, reaction, mean, du, dd, after - before)
        if p.contact:
            self.lost += p.contact.rubbed(mean, du)
        self.account(stored, solver.work)

    def memory(self) -> dict[str, Any]:
        """What the next step depends on beside the motion."""
        last = None if self.last is None else leaves(self.last)
        state = leaves(self.state)
        return {"lost": self.lost, "last": last, "state": state, "force": self.force.copy()}

    def recall(self, kept: dict[str, Any]) -> None:
        """Go on with what an earlier run kept."""
        self.lost, self.state = kept["lost"], rebuilt(self.state, kept["state"])
        self.force = kept["force"]
        self.last = None if kept["last"] is None else (kept["last"][0], kept["last"][1])

    def save(self, step: int) -> None:
        """Hand the state to the observers."""
        hand_over(self.observers, step, self.snapshot)

    def snapshot(self, step: int) -> BulkSnapshot:
        """A copy of the state."""
        parts = vars(snapshot_of(self.problem, self.motion, step))
        return BulkSnapshot(**parts, bulk=self.bulk, bulk_state=self.state)


def step_bulk_statics(run: BulkRun) -> History:
    """Equilibrium at each time; a step that does not converge is cut in two, again and again.

    Raises
    ------
    ConvergenceError
        Where no equilibrium is found: a limit load, most often.
    """
    problem = run.problem
    factors = problem.loading.at(problem.times)
    with recorded(problem, run.observers) as history:
        solver = newton_solver(problem, problem.K, 1.0, run.bulk, run.state)
        _name(run, history, solver)
        run.motion.reaction[:] = run.imbalance(solver.force, factors[0])
        _through(run, history, solver, lambda k: _static_step(run, solver, history, k, factors))
    return history


def _name(run: BulkRun, history: History, solver: BulkSolver | type[BulkSolver]) -> None:
    history.loop = f"{solver.loop} (plastic bodies: {run.bulk.words})"
    history.solver = solver.factor
    history.method = Sentence(solver.said)


def _through(
    run: BulkRun, history: History, solver: BulkSolver | SparseLoop, step: Callable[[int], None]
) -> None:
    """All steps, and what went beyond curves in them."""
    steps = KeptSteps(run.keeper, history, run.motion, solver, run)
    through(steps, step, run.save, run.progress)
    history.beyond = run.bulk.beyond_curves(run.begun, run.state)


def _static_step(
    run: BulkRun, solver: BulkSolver, history: History, k: int, factors: FloatArray
) -> None:
    """From one time to the next, in as many parts as it takes."""
    times, done, length, solver.state = run.problem.times, 0.0, 1.0, run.state
    while done < 1.0:
        end = min(done + length, 1.0)
        before = (1 - done) * factors[k - 1] + done * factors[k]
        after = (1 - end) * factors[k - 1] + end * factors[k]
        solver.time = float((1 - end) * times[k - 1] + end * times[k])
        outcome = _increment(run, solver, before, after)
        run.residuals.append(solver.residuals)
        if outcome.turns > 0:
            history.iterations = max(history.iterations, outcome.turns)
            done, length = end, min(2 * length, 1.0)
            continue
        length = 0.5 * length
        if length < 0.5**HALVINGS:
            if not outcome.turns:  # singular: of what nothing holds, from the first step on
                virgin = run.bulk.respond(run.bulk.unloaded(), 0.0 * run.motion.u, times[0])
                effective_of(run.problem, run.problem.K + virgin.tangent, 1.0, 1.0)
            if run.problem.interface and not (run.motion.t[:, -1] < 0.0).any():
                raise lost(run.problem, run.motion, k, outcome)
            told = {"k": k, "time": solver.time, "residual": outcome.residual}
            told |= {"n_residuals": len(solver.residuals), "halvings": HALVINGS}
            raise ConvergenceError("kernel.plasticity.load-step-time-no", **told)


def _increment(
    run: BulkRun, solver: BulkSolver, before: FloatArray, after: FloatArray
) -> StepOutcome:
    p, m = run.problem, run.motion
    r = -run.imbalance(solver.force, after)
    dd = p.loading.imposed @ after - p.constraints.C @ m.u
    change = after - before
    solver.guess = _carried_on(run.last, change)
    pushed = m.contact.copy()
    gap = p.contact.gaps(m.u, after) if p.contact else NOTHING
    outcome = solver.solve(m, r, dd, gap)
    if outcome.turns <= 0 or not np.isfinite(outcome.du).all():
        return outcome if outcome.turns <= 0 else StepOutcome(outcome.du, -1, np.inf)
    run.accept(solver, outcome.du, before, after, pushed)
    run.last = (outcome.du, change)
    return outcome


def _carried_on(
    last: tuple[FloatArray, FloatArray] | None, change: FloatArray
) -> FloatArray | None:
    """The last increment, in proportion to that of the loads, while these go on the same way."""
    if last is None:
        return None
    du, old = last
    size = float(old @ old)
    ratio = float(change @ old) / size if size > 0 else 0.0
    same = np.abs(change - ratio * old).max(initial=0.0) <= 1e-6 * np.abs(change).max(initial=0.0)
    return ratio * du if ratio > 0 and same else None


def integrate_bulk(run: BulkRun) -> History:
    """Motion over all times, Newton's method on all unknowns at each step.

    Raises
    ------
    ConvergenceError
        If a step does not converge; says at which time.
    """
    factors = run.problem.loading.at(run.problem.times)
    with recorded(run.problem, run.observers) as history:
        _name(run, history, BulkSolver)
        _start(run, factors[0])
        loop = _BulkLoop(run)
        _through(run, history, loop, lambda k: _moving_step(run, loop, history, k, factors))
    return history


def _moving_step(
    run: BulkRun, loop: "_BulkLoop", history: History, k: int, factors: FloatArray
) -> None:
    """The step that ends at time k."""
    times = run.problem.times
    outcome = loop.step(float(times[k - 1]), float(times[k]), factors[k - 1 : k + 1])
    if outcome.turns <= 0 or not np.isfinite(run.motion.u).all():
        told = {"k": k, "times": times[k], "residual": outcome.residual, "turns": -outcome.turns}
        raise ConvergenceError("kernel.plasticity.step-time-no-equilibrium", **told)
    history.iterations = max(history.iterations, outcome.turns)
    _name(run, history, loop.solver)


def _start(run: BulkRun, factors: FloatArray) -> None:
    """Initial velocity, acceleration, reactions, kinetic energy."""
    p, m = run.problem, run.motion
    m.v[:] = initial.admissible_velocity(p)
    rest = run.imbalance(run.force, factors) + p.C @ m.v
    m.a[:], m.contact[:] = with_contact(p, m.v, accelerated(p, -rest), initial.closed_at_start(p))
    m.reaction[:] = rest + p.M @ m.a
    m.energies[0] = 0.5 * m.v @ (p.M @ m.v)


def newton_solver(
    problem: Problem, A: sp.csr_array, share: float, bulk: Bulk, state: State
) -> BulkSolver:
    """Newton's method on all unknowns, with dense matrices where these are few."""
    chosen = DenseSolver if is_small(problem, bulk) else BulkSolver
    return chosen(problem, A, share, bulk, state)


class _BulkLoop(SparseLoop):
    """The steps of `SparseLoop` with the bodies' forces among the loads."""

    def __init__(self, run: BulkRun) -> None:
        super().__init__(run.problem, run.motion)
        self.bulk_run = run
        self._solvers: list[tuple[float, BulkSolver, ImpactRule | None]] = []
        self._closed = initial.closed_at_start(run.problem)
        self._increments = np.zeros((0, run.problem.numbering.size))
        self._carries = type(run.bulk) is Bulk and not run.problem.contact
        self._begin()

    def memory(self) -> dict[str, Any]:
        """Relations that are closed, and what the solvers of the step lengths remember."""
        solvers = [{"dt": dt, "kept": memory(solver)} for dt, solver, _ in self._solvers]
        increments = self._increments.copy()
        return {"closed": self._closed.copy(), "solvers": solvers, "increments": increments}

    def recall(self, kept: dict[str, Any]) -> None:
        """Go on from a motion that was put back."""
        self._closed[:], self._increments = kept["closed"], kept["increments"]
        for known in kept["solvers"]:
            recall(self._solver(known["dt"])[0], known["kept"])
        self._begin()

    def _solver(self, dt: float) -> tuple[BulkSolver, ImpactRule | None]:
        for known, solver, impact in self._solvers:
            if abs(known - dt) <= SAME_STEP * dt:
                return solver, impact
        share = 1 - self.problem.scheme.alpha_f
        A = effective_matrix(self.problem, dt)
        solver = self._made(A, dt, share)
        impact = None
        if self.problem.contact:
            effective = effective_of(self.problem, A, dt, share)
            impact = ImpactRule(self.problem, effective, self.problem.contact, self._closed)
        self._solvers = [*self._solvers[-3:], (dt, solver, impact)]
        return solver, impact

    def _guess(self, dt: float) -> FloatArray | None:
        """The increment of a step as those of the last two go on, None where contact may change.

        Points that flow have the tangent of flow from the first turn on.
        """
        if not self._carries or len(self._increments) < 2:
            return None
        return dt * (2 * self._increments[1] - self._increments[0])

    @property
    def solver(self) -> BulkSolver:
        """What solved the last steps."""
        return self._solvers[-1][1]

    def _made(self, A: sp.csr_array, dt: float, share: float) -> BulkSolver:
        bulk, state = self.bulk_run.bulk, self.bulk_run.state
        if self.bulk_run.full or self.problem.numbering.size < MANY:
            return newton_solver(self.problem, A, share, bulk, state)
        if is_accelerated(self.problem, bulk, A):
            return AcceleratedSolver(self.problem, A, dt, share, bulk, state)
        return BulkSolver(self.problem, A, share, bulk, state)

    def step(self, start: float, end: float, factors: FloatArray) -> StepOutcome:
        """One step of time."""
        p, m, run, dt = self.problem, self.motion, self.bulk_run, end - start
        solver, impact = self._solver(dt)
        solver.state, solver.time = run.state, end
        solver.force = old = run.force
        load0, load1 = factors @ p.loading.forces.T
        n = newmark_of(p.scheme, dt)
        r = self._predict(n, load0 - old, load1 - old)
        dd = p.loading.imposed @ factors[1] - p.constraints.C @ m.u
        pushed = m.contact.copy()
        solver.guess = self._guess(dt)
        outcome = solver.solve(m, r, dd, self._gap(factors[1]))
        if outcome.turns <= 0:
            return outcome
        self._increments = np.stack([*self._increments[-1:], outcome.du / dt])
        stored, driven = run.stored(), run.bulk.pushed(run.state)
        run.state, run.force = solver.state, solver.force
        driven = driven + run.bulk.pushed(run.state)
        self._advance(n, outcome.du)
        before, work = balance(m.energies), None
        if impact is not None:
            work = impact.correct(m, p.contact.imposed @ (factors[1] - factors[0]) / dt)
        # the bodies' forces are no loads: their part in the work of the loads is taken back
        loads = np.stack([load0 - old, load1 - solver.force])
        self._account(n, outcome.du, dd, loads, pushed, factors)
        if p.contact:
            run.lost += p.contact.rubbed(0.5 * (pushed + m.contact), outcome.du)
        m.energies[EXTERNAL] += 0.5 * outcome.du @ (old + solver.force + driven)
        run.account(stored, solver.work)
        if work is not None:
            run.lost += lose(m, work, before)
        return outcome


def run_bulk(
    problem: Problem,
    bulk: Bulk,
    state: State,
    observers: Sequence[Observer] = (),
    progress: Progress | None = None,
    dynamic: bool = False,
    keeper: Keeper | None = None,
    full: bool = False,
) -> History:
    """Step a problem with plastic bodies through its times."""
    if type(bulk) is Bulk and bulk.least * len(problem.times) > WORTH:
        bulk = replace(bulk, least=WORTH // len(problem.times))
    run = BulkRun(problem, bulk, state, tuple(observers), progress, keeper=keeper, full=full)
    return integrate_bulk(run) if dynamic else step_bulk_statics(run)
