"""Load steps of a static problem with joints: Newton's method on the condensed interface."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.contact.solver import step_solver
from ssilang.kernel.interface.interface import Interface, is_macro
from ssilang.kernel.interface.response import interface_energies
from ssilang.kernel.solvers.backends import MULTIGRID
from ssilang.kernel.solvers.cholesky.inverse import Inverse
from ssilang.kernel.statics.linear_motion import singular
from ssilang.kernel.stepping.effective import effective_of
from ssilang.kernel.stepping.keeping import Keeper, KeptSteps
from ssilang.kernel.stepping.newmark import Scheme
from ssilang.kernel.stepping.problem.initial import motion_at_rest
from ssilang.kernel.stepping.problem.plausibility import overloads
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.iterated import (
    IteratedSolver,
    iterated_system,
    pays,
)
from ssilang.kernel.stepping.rests.sparse.loop import NOTHING, StepOutcome, StepSolver, support_work
from ssilang.kernel.stepping.run import History, Progress
from ssilang.kernel.stepping.snapshot import Observer, Snapshot, snapshot_of
from ssilang.kernel.stepping.state import ELASTIC, EXTERNAL, LOST, N_ENERGIES, STORED, Motion

BALANCED = 1e-13
"""Imbalance over the loads taken for rounding."""
UNHELD = 1e-5
"""Imbalance over the forces, beyond which a step with joints is no equilibrium."""
FLOWN = 1e12
"""Traction that jumps would mean in closed joints, over the forces, beyond which nothing holds."""
HALVINGS = 6
"""Of a step with macro-elements that is too long."""
DRIVEN = 1e-9
"""Work of the loads on a free motion, over both norms, beyond which they drive it."""


def step_statics(
    problem: Problem,
    observers: Sequence[Observer] = (),
    progress: Progress | None = None,
    keeper: Keeper | None = None,
) -> History:
    """Equilibrium at each time of a problem, from its initial state on.

    The initial state is taken as it is; what is out of balance in it goes into the first step.

    Raises
    ------
    ConvergenceError
        If no equilibrium is found: says at which time, and whether the joints are all open.
    SingularMatrixError
        If bodies are free even with all joints closed.
    """
    motion, factors = motion_at_rest(problem), problem.loading.at(problem.times)
    motion.reaction[:] = _imbalance(problem, motion, factors[0])
    with recorded(problem, observers) as history:
        solver, inverse = _solver_of(problem)
        history.solver = MULTIGRID if inverse is None else inverse.factor.name
        history.loop = "static"

        def step(k: int) -> None:
            _check_balanced(problem, inverse, motion, factors[k])
            outcome = _at_load_step(problem, solver, motion, factors, k)
            history.iterations = max(history.iterations, outcome.turns)

        seen = partial(snapshot_of, problem, motion)
        save = partial(hand_over, observers, made=seen)
        through(KeptSteps(keeper, history, motion, solver), step, save, progress)
    return history


@contextmanager
def recorded(problem: Problem, observers: Sequence[Observer]) -> Iterator[History]:
    """The history of a run that begins; where it ends the observers are closed."""
    times, started = problem.times, time.perf_counter()
    history = History(times, np.zeros((len(times), N_ENERGIES)))
    try:
        yield history
    finally:
        for observer in observers:
            observer.close()
    history.seconds += time.perf_counter() - started


def through(
    steps: KeptSteps,
    step: Callable[[int], None],
    save: Callable[[int], None],
    progress: Progress | None,
) -> None:
    """All steps: note the energies of each, hand its state over, tell how far the run is."""
    energies, last = steps.history.energies, len(steps.history.times) - 1
    energies[0] = steps.motion.energies
    if not steps.go_on():
        save(0)
    with steps.going():
        for k in range(steps.done + 1, last + 1):
            with steps.step(k):
                step(k)
                energies[k] = steps.motion.energies
                save(k)
            if progress is not None:
                progress(k, last)
            steps.reached()


def _solver_of(problem: Problem) -> tuple[StepSolver, Inverse | None]:
    """What solves the steps: the condensed interface with its inverse, or multigrid."""
    if problem.interface and pays(problem, problem.K):
        return IteratedSolver(problem, iterated_system(problem, problem.K, 1.0), 1.0), None
    effective = effective_of(problem, problem.K, 0.0, 1.0, free=True)
    whole = replace(problem, scheme=Scheme())  # forces of the steps' ends, whatever scheme follows
    return step_solver(whole, effective), effective.inverse


def _at_load_step(
    problem: Problem, solver: StepSolver, motion: Motion, factors: FloatArray, k: int
) -> StepOutcome:
    """Equilibrium at time k; what fails says where."""
    try:
        outcome = _cut_step(problem, solver, motion, factors[k - 1 : k + 1], _cuts(problem))
    except ConvergenceError as failure:
        raise ConvergenceError(
            "kernel.statics.at-load-step", step=k, time=problem.times[k], failure=failure
        ) from None
    if outcome.turns <= 0:
        raise lost(problem, motion, k, outcome)
    return outcome


def _cuts(problem: Problem) -> int:
    """How often a step may be halved, or -1: whole footings lift off and yield within one."""
    joints = problem.interface
    return HALVINGS if any(is_macro(j.zone) for j in joints.joints) else -1


def _cut_step(
    problem: Problem, solver: StepSolver, motion: Motion, factors: FloatArray, cuts: int
) -> StepOutcome:
    """Equilibrium for the second of two rows of load factors, on the way in halves if need be.

    Where there is none, the motion stays at the last one.
    """
    before = [x.copy() for x in motion] if cuts >= 0 else []
    outcome = _step(problem, solver, motion, factors)
    if outcome.turns > 0 or cuts < 0:
        return outcome
    _go_back(motion, before)
    if not cuts:
        return outcome
    turns, middle = 0, factors.mean(axis=0)
    for half in (np.stack([factors[0], middle]), np.stack([middle, factors[1]])):
        outcome = _cut_step(problem, solver, motion, half, cuts - 1)
        if outcome.turns <= 0:
            return outcome
        turns += outcome.turns
    return replace(outcome, turns=turns)


def _imbalance(problem: Problem, motion: Motion, factors: FloatArray) -> FloatArray:
    rest = problem.K @ motion.u - problem.loading.forces @ factors
    return np.asarray(rest + problem.interface.J.T @ motion.f)


def _step(problem: Problem, solver: StepSolver, motion: Motion, factors: FloatArray) -> StepOutcome:
    """Equilibrium for the second of two rows of load factors."""
    r = -_imbalance(problem, motion, factors[1])
    dd = problem.loading.imposed @ factors[1] - problem.constraints.C @ motion.u
    contact = problem.contact
    gap = contact.gaps(motion.u, factors[1])
    pushed, lost = motion.contact.copy(), motion.energies[LOST]
    old_lost = _lost_in_joints(problem, motion)
    outcome = solver.solve(motion, r, dd, gap)
    if outcome.turns <= 0 or not np.isfinite(outcome.du).all():
        return outcome if outcome.turns <= 0 else StepOutcome(outcome.du, -1, np.inf)
    # what supports impose is no flight
    own = outcome.du - problem.constraints.particular(dd)
    if _flies_off(problem, own, factors[1]):
        return StepOutcome(outcome.du, 0, np.inf)
    old = motion.reaction.copy()
    motion.u[:] += outcome.du
    _polish(problem, solver, motion, factors[1])
    if not contact and problem.interface and _unheld(problem, motion, factors[1]):
        return StepOutcome(outcome.du, 0, np.inf)
    motion.reaction[:] = _imbalance(problem, motion, factors[1])
    mean = 0.5 * (factors[0] + factors[1])
    motion.energies[EXTERNAL] += outcome.du @ (problem.loading.forces @ mean)
    motion.energies[EXTERNAL] += support_work(
        problem, 0.5 * (old + motion.reaction), 0.5 * (pushed + motion.contact), outcome.du, dd,
        factors[1] - factors[0],
    )  # fmt: skip
    # loads that start out of balance grow, in the first step, from nothing
    if not contact and problem.constraints.associated:
        motion.energies[EXTERNAL] += 0.5 * old @ own
    motion.energies[ELASTIC] = 0.5 * motion.u @ (problem.K @ motion.u)
    if contact and problem.contact_options.method == "PENALITE":
        motion.energies[ELASTIC] += contact.penalty_energy(
            contact.gaps(motion.u, factors[1]), problem.contact_options.coefficient
        )
    joints = problem.interface
    if joints:
        motion.energies[STORED], motion.energies[LOST] = interface_energies(
            joints.points, motion.w, motion.t, motion.state
        )
    if contact.friction:
        rubbed = contact.rubbed(0.5 * (pushed + motion.contact), outcome.du)
        motion.energies[LOST] = lost - old_lost + _lost_in_joints(problem, motion) + rubbed
    return outcome


def _flies_off(problem: Problem, du: FloatArray, factors: FloatArray) -> bool:
    """Whether joints open as far as only rounding errors of their stiffness would hold them.

    `du` is the step less what supports impose.
    """
    joints = problem.interface
    points = problem.numbering.table.coordinates[problem.numbering.nodes]
    jumps = joints.J @ du
    if np.abs(jumps).max(initial=0.0) <= np.ptp(points, axis=0).max(initial=0.0):
        return False
    closed = joints.closed_stiffness() @ jumps
    loads = problem.loading.forces @ factors
    size = np.abs(loads).max(initial=0.0) + np.abs(problem.K @ du + loads).max(initial=0.0)
    return bool(np.abs(closed).max(initial=0.0) > FLOWN * size)


def _unheld(problem: Problem, motion: Motion, factors: FloatArray) -> bool:
    """Whether forces are out of balance: open joints, and a solution of rounding errors."""
    rest = _imbalance(problem, motion, factors)
    inner = np.abs(problem.constraints.V.T @ rest).max(initial=0.0)
    pulls = np.abs(problem.interface.J.T @ motion.f).max(initial=0.0)
    loads = np.abs(problem.loading.forces @ factors).max(initial=0.0)
    return bool(inner > UNHELD * (loads + pulls + np.abs(rest).max(initial=0.0)))


def _lost_in_joints(problem: Problem, motion: Motion) -> float:
    joints = problem.interface
    if not joints:
        return 0.0
    return float(interface_energies(joints.points, motion.w, motion.t, motion.state)[1])


def _check_balanced(
    problem: Problem, inverse: Inverse | None, motion: Motion, factors: FloatArray
) -> None:
    """Refuse loads that drive bodies which nothing holds; those without a load stay at rest."""
    if inverse is None or not inverse.singular or problem.contact:
        return
    work = inverse.work(-problem.constraints.V.T @ _imbalance(problem, motion, factors))
    driven = inverse.kernel[:, np.abs(work) > DRIVEN]
    if driven.shape[1]:
        motions = problem.constraints.T @ driven
        raise singular("kernel.statics.loads-drive-motions", problem.numbering, motions)


def _polish(problem: Problem, solver: StepSolver, motion: Motion, factors: FloatArray) -> None:
    """One more solution for what rounding left out of balance (stiff joints on soft bodies)."""
    if problem.contact:
        return
    T = problem.constraints.V
    rest = T.T @ _imbalance(problem, motion, factors)
    size = np.abs(T.T @ (problem.loading.forces @ factors)).max(initial=0.0)
    if np.abs(rest).max(initial=0.0) <= BALANCED * max(size, 1e-300):
        return
    dd = problem.loading.imposed @ factors - problem.constraints.C @ motion.u
    before = [x.copy() for x in motion]
    outcome = solver.solve(motion, -_imbalance(problem, motion, factors), dd, NOTHING)
    # beyond the step's own size it is no correction: nothing holds the body, but for rounding
    if outcome.turns > 0 and np.abs(outcome.du).max() <= np.abs(motion.u).max():
        motion.u[:] += outcome.du
        return
    _go_back(motion, before)


def _go_back(motion: Motion, before: list[FloatArray]) -> None:
    for array, old in zip(motion, before, strict=True):
        array[...] = old


def hand_over(observers: Sequence[Observer], step: int, made: Callable[[int], Snapshot]) -> None:
    """Give the instant to the observers that want it."""
    wanting = [o for o in observers if o.wanted[step]]
    if wanting:
        snapshot = made(step)
        for observer in wanting:
            observer.receive(snapshot)


def _ground_gives_way(
    problem: Problem, joints: Interface, motion: Motion, step: int
) -> ConvergenceError:
    """No equilibrium over ground that yields: too much weight, or too far out."""
    at: dict[str, Any] = {"step": step, "time": problem.times[step]}
    told = problem.numbering.table.told
    for found in overloads(problem, problem.loading.at(problem.times)[step]):
        at |= vars(found) | {"node": told(found.node)}
        return ConvergenceError("kernel.statics.footing-overloaded", **at)
    carried = joints.carried(motion.t)
    used = [-carried[bed.owner, -1] / bed.capacity for bed in joints.beds]
    bed = joints.beds[int(np.argmax(used))]
    j, cell = joints.cell_of(bed)
    return ConvergenceError(
        "kernel.statics.footing-gives-way",
        **at,
        node=told(int(j.zone.cells.nodes.resolve(j.upper[cell]).ravel()[0])),
        used=100.0 * max(used),
        share=100.0 * float(bed.in_contact(motion.w[bed.points], motion.t[bed.points])),
    )


def lost(problem: Problem, motion: Motion, step: int, outcome: StepOutcome) -> ConvergenceError:
    """What is said of a step without equilibrium: ground that yields, joints all open, or not."""
    joints, at = problem.interface, dict[str, Any](step=step, time=problem.times[step])
    if joints.beds:
        return _ground_gives_way(problem, joints, motion, step)
    if joints and (outcome.turns == 0 or not (motion.t[:, -1] < 0).any()):
        node = int(joints.joints[0].zone.cells.nodes.resolve(joints.joints[0].upper).ravel()[0])
        at |= {"n_points": joints.n_points, "node": problem.numbering.table.told(node)}
        return ConvergenceError("kernel.statics.no-equilibrium-full-uplift", **at)
    at |= {"residual": outcome.residual, "turns": -outcome.turns}
    return ConvergenceError("kernel.statics.no-equilibrium-found-residual", **at)
