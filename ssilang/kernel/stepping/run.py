"""The time integration of a problem: chooses the loop, runs it, hands instants to observers."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray
from ssilang.kernel.base.errors import ConvergenceError, KernelError
from ssilang.kernel.stepping import keeping
from ssilang.kernel.stepping.choose import (
    Case,
    Choice,
    choose,
    method_of,
    only,
    refuse_combinations,
)
from ssilang.kernel.stepping.driven import Drive, Driver
from ssilang.kernel.stepping.extremes import Extremes
from ssilang.kernel.stepping.problem import initial
from ssilang.kernel.stepping.problem.bodies import full_uplift
from ssilang.kernel.stepping.problem.problem import Problem, react
from ssilang.kernel.stepping.rests.reduced.basis import Reduction
from ssilang.kernel.stepping.snapshot import Observer, Snapshot, kept_instant, snapshot_of
from ssilang.kernel.stepping.state import N_ENERGIES, Motion, recorder_of, rows_of
from ssilang.kernel.stepping.times import SAME, Run, runs_of
from ssilang.kernel.stepping.track import Taps, Track, rows_of_tap
from ssilang.messages.message import Sentence

CHUNK_VALUES = 4_000_000  # saved values held at once
LOOKED_AT = 400_000  # those that are looked at and let go: their memory is taken again
LEAST = 32  # steps at once all the same, where there is room
GRID = 64  # where memory cuts steps, it does so at multiples
LITTLE = 0.01  # of the largest energy: what is given may be this small beside it
FACTORS_KEPT = 4  # step sizes whose factors stay in memory

Progress = Callable[[int, int], None]
"""Called with steps done and steps in all."""


@dataclass(eq=False)
class History:
    """What a run leaves beside the instants that observers took.

    Attributes
    ----------
    times : array (n_times,)
    energies : array (n_times, N_ENERGIES)
        Kinetic, elastic, stored in joints, lost in joints, by friction and at impacts, damped,
        work of loads and supports.
    iterations : int
        Most interface iterations in one step.
    solver, loop : str
        Linear solver and loop used.
    method : Sentence or None
        What is said of the loop, where a rule chose it.
    reduction : Reduction or None
        Of runs on a reduced basis.
    beyond : dict of str to float
        Share of the points of a law that went beyond the last point of its curve, by law.
    """

    times: FloatArray
    energies: FloatArray
    iterations: int = 0
    solver: str = ""
    loop: str = ""
    seconds: float = 0.0
    reduction: Reduction | None = None
    method: Sentence | None = None
    beyond: dict[str, float] = field(default_factory=dict)

    @property
    def worst_imbalance(self) -> float:
        """The largest energy that came from nowhere, its absolute value."""
        return float(np.abs(self.imbalance).max(initial=0.0))

    @cached_property
    def largest_energy(self) -> float:
        """The largest energy of any kind, its absolute value."""
        kept = self.energies
        return float(max(kept.max(initial=0.0), -kept.min(initial=0.0)))

    @cached_property
    def imbalance(self) -> FloatArray:
        """Energy that came from nowhere since the start, shape (n_times,)."""
        kept = self.energies.T
        total = kept[0] + kept[1] + kept[2] + kept[3] + kept[4] - kept[5]
        return total - total[0]

    @property
    def given(self) -> FloatArray:
        """Energy that the structure has been given until each instant, shape (n_times,).

        That of the start, and the range of the work of loads and supports: what a body that falls
        later gets of its weight was not there when an impact changed its energy. No less than
        `LITTLE` of the largest energy: the first steps of a load have next to none.
        """
        kept = self.energies
        work = kept[:, 5]
        reach = np.maximum.accumulate(work) - np.minimum.accumulate(work)
        least = LITTLE * self.largest_energy
        return np.maximum(np.abs(kept[0, :3]).sum() + reach, least)


@dataclass(eq=False)
class Integration:
    """A problem under way."""

    problem: Problem
    observers: Sequence[Observer] = ()
    progress: Progress | None = None
    full_newton: bool = False
    driver: Driver | None = None
    keeper: keeping.Keeper = keeping.UNKEPT
    motion: Motion = field(init=False)
    taps: Taps = field(init=False)
    wanted: BoolArray = field(init=False)

    def __post_init__(self) -> None:
        p, self._drive = self.problem, None
        if p.constraints.T.shape[1] == 0 and not p.loading.imposed.any():
            size = p.numbering.size
            raise KernelError("kernel.stepping.conditions-hold-every-unknown", count=size)
        if self.driver is not None:
            self._drive = Drive(self.problem, self.driver, self.full_newton)
            p = self._drive.start()
        joints = initial.joint_state(p)
        v = initial.admissible_velocity(p)
        self._closed = initial.closed_at_start(p)
        a, pushing = initial.with_contact(
            p, v, initial.initial_acceleration(p, v, joints), self._closed
        )
        energies = initial.initial_energies(p, v, joints)
        self.motion = Motion(
            p.u.copy(), v, a, joints.delta, joints.f, joints.w, joints.t, joints.state,
            np.zeros_like(a), energies, pushing,
        )  # fmt: skip
        react(p, self.motion, p.loading.at(p.times[:1])[0])
        self._choices: dict[float, Choice] = {}
        self._begun: dict[float, list[Any]] = {}  # states in which choices were made, if kept
        self._done, self._rule = 0, ""
        refuse_combinations(p, self.full_newton)

    def run(self) -> History:
        """All steps.

        Raises
        ------
        ConvergenceError
            If a step's interface iteration does not converge; says which time.
        SingularMatrixError
            If bodies are held by nothing, not even by mass.
        """
        times, self._started = self.problem.times, time.perf_counter()
        history = History(times, np.zeros((len(times), N_ENERGIES)))
        history.energies[0] = self.motion.energies
        try:
            inside = False
            if self._drive is None:
                loop = self._choice(times[1] - times[0]).loop
                inside = loop.view(np.zeros(0, np.int64)).whole
            self.prepare(inside)
            if (kept := self.keeper.last()) is not None:
                with keeping.fitting():
                    self._go_on(kept, history)
            else:
                self.begin()
            self._run(history)
        finally:
            for observer in self.observers:
                observer.close()
        history.seconds += time.perf_counter() - self._started
        return history

    def prepare(self, inside: bool) -> None:
        """See what observers want; `inside`: the loop compares the largest values itself."""
        extremes = [o for o in self.observers if isinstance(o, Extremes)]
        for one in extremes:
            one.settle(inside)
        tracks = [o for o in self.observers if isinstance(o, Track)]
        whole = [o for o in self.observers if not isinstance(o, Track)]
        if self._drive is not None:  # what it adds differs from step to step
            tracks, whole = [], list(self.observers)
        times = self.problem.times
        self.taps, self._whole = Taps(tracks, len(times)), whole
        for one in extremes:
            self.taps.peaks = one.peaks if inside else self.taps.peaks
        self.wanted = np.zeros(len(times), bool)
        for observer in whole:
            self.wanted |= observer.wanted

    def begin(self) -> None:
        """Hand over the initial instant."""
        if self.wanted[0] or self.taps.wanted[0]:
            snapshot = snapshot_of(self.problem, self.motion, 0)
            for observer in self.observers:
                if observer.wanted[0]:
                    observer.receive(snapshot)

    @property
    def stepped(self) -> int:
        """Unknowns whose steps take as long as these."""
        return self.problem.numbering.size

    def _run(self, history: History) -> None:
        keeper, total, unknowns = self.keeper, len(self.problem.times) - 1, self.stepped
        state = partial(self._state, history)
        with keeping.told_to_leave(keeper, lambda: self._done, state):
            while self._done < total:
                self._chunk(self._done, keeper.stride(self._done, unknowns), history)
                if self._done < total:
                    keeper.reached(self._done, state)
        keeper.finished(self._done, state)

    def _chunk(self, done: int, longest: int, history: History) -> None:
        """Steps of one length, at most so many."""
        times = self.problem.times
        run = next(runs_of(times[done : done + longest + 1], longest))
        run = Run(done + run.first, done + run.last, run.dt)
        self._steps(run, history)
        if self.progress is not None:
            self.progress(run.last, len(times) - 1)

    def _steps(self, run: Run, history: History) -> None:
        first = run.first
        while first < run.last:
            last = self._within_memory(first, run.last)
            factors = self.problem.loading.at(history.times[first : last + 1])
            if self._drive is None:
                choice = self._choice(run.dt)
            else:
                at = float(history.times[last])
                choice, factors = self._drive.choice(self.motion, run.dt, at, factors, self._closed)
            history.solver, history.loop = choice.solver, choice.rule.loop
            history.method, self._rule = method_of(choice.rule, self.problem), choice.rule.name
            energies = history.energies[first + 1 : last + 1]
            row, tapped = (
                rows_of(x[first + 1 : last + 1]) for x in (self.wanted, self.taps.wanted)
            )
            view = choice.loop.view(self.taps.unknowns)
            tap = view.tap(tapped, self.taps.room)
            peaks = self.taps.peaks
            peaks.first[0] = first
            recorder = recorder_of(self.motion, row, energies, tap=tap, peaks=peaks)
            with self.keeper.steady(self._done, partial(self._state, history)):
                done, turns, residual = choice.loop.run(factors, recorder)
                if turns > 0:
                    history.iterations = max(history.iterations, turns)
                problem = self.problem if self._drive is None else self._drive.problem
                for k in np.flatnonzero(row[:done] >= 0).tolist():
                    self.hand_over(kept_instant(problem, recorder, int(row[k]), first + 1 + k))
                unknowns = self.taps.unknowns
                rows = rows_of_tap(problem, unknowns, view, tap, factors, first, done)
                if rows is not None:
                    self.taps.give(rows)
                if done < last - first:
                    raise self.diverged(first + done + 1, turns, residual)
                first = self._done = last

    # ---- going on later

    def _state(self, history: History) -> keeping.State:
        """All that the steps to come depend on, and what is told of those that were done."""
        known = [
            {"dt": dt, "begun": self._begun[dt], "remembers": keeping.memory(choice.loop)}
            for dt, choice in self._choices.items()
        ]
        return {
            "motion": keeping.leaves(self.motion),
            "closed": self._closed.copy(),
            "loops": known,
            "energies": history.energies[: self._done + 1],
            "told": {
                "iterations": history.iterations, "solver": history.solver,
                "seconds": history.seconds + time.perf_counter() - self._started,
                "rule": self._rule,
            },
        }  # fmt: skip

    def _go_on(self, kept: keeping.State, history: History) -> None:
        """Take over the state in which an earlier run left."""
        self._done = len(kept["energies"]) - 1
        made, self._choices = self._choices, {}
        for known in kept["loops"] if self._done < len(self.problem.times) - 1 else ():
            keeping.put_back((*self.motion, self._closed), known["begun"])
            if known["dt"] in made:
                self._choices[known["dt"]] = made[known["dt"]]
            keeping.recall(self._choice(known["dt"]).loop, known["remembers"])
        keeping.take_over(self.motion, kept["motion"])
        self._closed[:] = kept["closed"]
        history.energies[: self._done + 1] = kept["energies"]
        told = kept["told"]
        history.iterations, history.seconds = told["iterations"], told["seconds"]
        rule, self._rule = only(told["rule"])[0], told["rule"]
        history.solver, history.loop = told["solver"], rule.loop
        history.method = method_of(rule, self.problem)

    def _within_memory(self, first: int, last: int) -> int:
        if self._drive is not None:
            return first + 1
        n, tapped = len(self.motion.u), len(self.taps.unknowns)
        last = within(self.wanted, CHUNK_VALUES // max(4 * n, 1), first, last)
        most = max(n if self.problem.small else tapped, 1)  # loops on modes tap all of them
        room = CHUNK_VALUES // (3 * most)
        if self.taps.looked_at:
            room = min(room, max(LOOKED_AT // (3 * most), LEAST))
        end = within(self.taps.wanted, room, first, last)
        return end if end == last or end - first < GRID else end - (end - first) % GRID

    def _choice(self, dt: float) -> Choice:
        dt = next((known for known in self._choices if abs(known - dt) <= SAME * known), dt)
        found = self._choices.get(dt)
        if found is None:
            if len(self._choices) >= FACTORS_KEPT:
                oldest = next(iter(self._choices))
                del self._choices[oldest]
                self._begun.pop(oldest, None)
            if self.keeper is not keeping.UNKEPT:
                self._begun[dt] = keeping.leaves((*self.motion, self._closed))
            case = Case(self.problem, self.motion, dt, self.full_newton, self._closed)
            found = self._choices[dt] = choose(case)
        return found

    def hand_over(self, snapshot: Snapshot) -> None:
        """Hand an instant to those that want whole ones."""
        for observer in self._whole:
            if observer.wanted[snapshot.step]:
                observer.receive(snapshot)

    def diverged(self, step: int, turns: int, residual: float) -> ConvergenceError:
        time_ = self.problem.times[step]
        if turns == 0:
            body = full_uplift(self.problem, self.motion.t)
            if body is None:
                return ConvergenceError("kernel.stepping.full-uplift", step=step, time=time_)
            return ConvergenceError(
                "kernel.stepping.full-uplift-of-body",
                step=step,
                time=time_,
                node=self.problem.numbering.table.told(body.node),
                n_points=body.points,
            )
        if not np.isfinite(residual):
            return ConvergenceError("kernel.stepping.motion-grew", step=step, time=time_)
        return ConvergenceError(
            "kernel.stepping.interface-not-converged",
            step=step,
            time=time_,
            residual=residual,
            turns=-turns,
        )


def within(wanted: BoolArray, room: int, first: int, last: int) -> int:
    """The step up to which there is room for those that are wanted after `first`."""
    room = max(room, 1)
    if last - first <= room:
        return last
    saved = np.flatnonzero(wanted[first + 1 : last + 1])
    return last if len(saved) <= room else first + max(int(saved[room]), 1)


def integrate(
    problem: Problem,
    observers: Sequence[Observer] = (),
    progress: Progress | None = None,
    full_newton: bool = False,
    driver: Driver | None = None,
    keeper: keeping.Keeper | None = None,
) -> History:
    """Integrate a problem over its times.

    Parameters
    ----------
    observers : sequence of Observer
        Each receives the instants it wants; a `Track` takes rows.
    full_newton : bool
        Refactorise at each iteration instead of condensing the interface (comparison).
    driver : callable, optional
        What it adds to matrices and loads at each step; see `driven`.
    keeper : Keeper, optional
        Keeps the state on its way; see `keeping`. Not beside a driver.

    Raises
    ------
    ConvergenceError, SingularMatrixError
        See `Integration.run`.
    """
    kept = keeping.UNKEPT if keeper is None else keeper
    return Integration(problem, observers, progress, full_newton, driver, keeper=kept).run()
