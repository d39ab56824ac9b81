"""Several problems integrated at once: those of one model advance side by side.

A step of one motion reads all of a large factor to do little with each number; steps of several
motions read it once for all. Each motion has its own loads, initial state and interface iteration,
and is what it is alone but for rounding. Small models run alone: side by side they took a seventh
less of a processor.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from operator import attrgetter
from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.stepping.choose import Case, method_of, rule_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.problem.sharing import grouped
from ssilang.kernel.stepping.rests.sparse.interleaved_batch import interleaved_batch
from ssilang.kernel.stepping.run import (
    CHUNK_SECONDS,
    CHUNK_VALUES,
    EVEN,
    GRID,
    History,
    Integration,
    Progress,
)
from ssilang.kernel.stepping.snapshot import Instants, Observer
from ssilang.kernel.stepping.state import N_ENERGIES, Outcome, Tap, rows_of
from ssilang.kernel.stepping.times import SAME, runs_of
from ssilang.kernel.stepping.track import View, rows_of_tap
from ssilang.messages.message import Sentence


class Engine(Protocol):
    """Steps of one dt of several problems."""

    name: str
    solver: str

    def run(
        self, factors: list[FloatArray], rows: list[IntArray], history: list[FloatArray],
        times: FloatArray, taps: list[Tap],
    ) -> tuple[list[Outcome], list[Instants]]:  # fmt: skip
        """Steps of each problem: load factors, rows of kept steps, energies; kept instants.

        The taps, of one length, take rows of their own.
        """
        ...

    def view(self, unknowns: IntArray) -> View:
        """How unknowns of the problems follow from what is tapped."""
        ...


@dataclass(eq=False)
class Lane:
    """One of the problems under way."""

    integration: Integration
    history: History
    problem_found: Exception | None = None

    @property
    def alive(self) -> bool:
        """Whether nothing went wrong so far."""
        return self.problem_found is None


@dataclass(eq=False)
class Group:
    """Problems of one model on their way."""

    lanes: list[Lane]
    engines: dict[float, Engine | None] = field(default_factory=dict)
    method: Sentence | None = None

    def engine(self, dt: float) -> Engine | None:
        """What steps all lanes together; None if nothing does."""
        known = next((k for k in self.engines if abs(k - dt) <= SAME * k), None)
        if known is None:
            self.engines[dt] = self._engine_of([lane.integration for lane in self.lanes], dt)
            known = dt
        return self.engines[known]

    def _engine_of(self, integrations: Sequence[Integration], dt: float) -> Engine | None:
        problems, motions = [i.problem for i in integrations], [i.motion for i in integrations]
        case = Case(problems[0], motions[0], dt)
        rule = rule_of(case)
        self.method = method_of(rule, problems[0])
        if rule.name != "dissection":
            return None
        return interleaved_batch(problems, motions, case.effective)


def integrate_together(
    problems: Sequence[Problem],
    observers: Sequence[Sequence[Observer]] = (),
    progress: Sequence[Progress | None] = (),
) -> list[History | Exception]:
    """Integrate several problems; those of one model advance together.

    Parameters
    ----------
    problems : sequence of Problem
        Of any kind. Problems with the same matrices, conditions, joints, scheme and times, and
        supports at rest, form a group, where their loop is that of large models; the others run
        one after another, as by `integrate`.
    observers, progress : sequences
        Of each problem; none if empty.

    Returns
    -------
    list of History or Exception
        In the order of the problems. What one problem or one of its observers raises is its
        result; the others go on. `History.together` says how many advanced side by side.
    """
    observers = observers or [()] * len(problems)
    progress = progress or [None] * len(problems)
    found: dict[int, History | Exception] = {}
    for group in grouped(problems):
        lanes: dict[int, Lane] = {}
        for i in group:
            try:
                lanes[i] = _lane(Integration(problems[i], observers[i], progress[i]))
            except Exception as problem:  # an observer may raise anything
                found[i] = problem
        _run(list(lanes.values()))
        for i, lane in lanes.items():
            found[i] = lane.history if lane.problem_found is None else lane.problem_found
    return [found[i] for i in range(len(problems))]


def _lane(integration: Integration) -> Lane:
    times = integration.problem.times
    history = History(times, np.zeros((len(times), N_ENERGIES)))
    history.kept[0] = integration.motion.energies
    return Lane(integration, history)


def _run(lanes: list[Lane]) -> None:
    """All steps of lanes of one model, side by side if there is an engine for it."""
    group, started = Group(lanes), time.perf_counter()
    if not _has_engines(group):
        for lane in lanes:
            _alone(lane)
        return
    for lane in lanes:
        lane.integration.prepare(inside=False)
        _guarded(lane, lane.integration.begin)
    _run_group(group)
    for lane in lanes:
        lane.history.seconds = (time.perf_counter() - started) / len(lanes)
        lane.history.together = len(lanes)
        _close(lane)


def _has_engines(group: Group) -> bool:
    if len(group.lanes) < 2:
        return False
    try:
        times = group.lanes[0].integration.problem.times
        return all(group.engine(dt) is not None for dt in {r.dt for r in runs_of(times, 1 << 16)})
    except Exception:  # alone, each says it for itself
        return False


def _alone(lane: Lane) -> None:
    try:
        lane.history = lane.integration.run()
    except Exception as problem:
        lane.problem_found = problem


def _run_group(group: Group) -> None:
    """All steps, in chunks that report progress."""
    first_problem = group.lanes[0].integration.problem
    times, done = first_problem.times, 0
    longest = GRID
    least = GRID if first_problem.numbering.size <= EVEN else 1  # as runs of their own
    while done < len(times) - 1 and any(lane.alive for lane in group.lanes):
        run = next(runs_of(times[done : done + longest + 1], longest))
        last = _within_memory(group, done, done + run.last)
        before = time.perf_counter()
        _steps(group, run.dt, done, last)
        spent = time.perf_counter() - before
        if spent < CHUNK_SECONDS / 2 and last - done == longest:
            longest = min(2 * longest, 1 << 16)
        elif spent > 2 * CHUNK_SECONDS:
            longest = max(longest // 2 // least, 1) * least
        done = last
        for lane in group.lanes:
            if lane.alive and lane.integration.progress is not None:
                lane.integration.progress(done, len(times) - 1)


def _within_memory(group: Group, first: int, last: int) -> int:
    one, count = group.lanes[0].integration, len(group.lanes)
    n, tapped = len(one.motion.u), len(_tapped(group))
    for wanted, values in (("wanted", 4 * n), ("taps.wanted", 3 * max(tapped, 1))):
        room = max(CHUNK_VALUES // max(values * count, 1), 1)
        asked = [attrgetter(wanted)(lane.integration) for lane in group.lanes]
        counts = np.cumsum(np.sum([x[first + 1 : last + 1] for x in asked], axis=0))
        over = np.flatnonzero(counts > room * count)
        last = last if len(over) == 0 else first + max(int(over[0]), 1)
    return last


def _tapped(group: Group) -> IntArray:
    """Unknowns that any lane's tracks ask for."""
    return np.unique(np.concatenate([lane.integration.taps.unknowns for lane in group.lanes]))


def _steps(group: Group, dt: float, first: int, last: int) -> None:
    engine = group.engine(dt)
    assert engine is not None
    factors, rows, history = [], [], []
    times = group.lanes[0].integration.problem.times
    unknowns = _tapped(group)
    view = engine.view(unknowns)
    asked = [lane.integration.taps.wanted[first + 1 : last + 1] for lane in group.lanes]
    taps = _taps(view, asked)
    for lane in group.lanes:
        lane.history.solver, lane.history.loop = engine.solver, engine.name
        lane.history.method = group.method
        factors.append(lane.integration.problem.loading.at(times[first : last + 1]))
        rows.append(rows_of(lane.integration.wanted[first + 1 : last + 1]))
        history.append(lane.history.kept[first + 1 : last + 1])
    outcomes, instants = engine.run(factors, rows, history, times, taps)
    for lane, (done, turns, residual), instant, tap, given in zip(
        group.lanes, outcomes, instants, taps, factors, strict=True
    ):
        if not lane.alive:
            continue
        i = lane.integration
        lane.history.iterations = max(lane.history.iterations, turns)
        steps = first + 1 + np.flatnonzero(i.wanted[first + 1 : first + 1 + done])
        for row, step in enumerate(steps):
            _guarded(lane, partial(i.hand_over, instant(row, int(step))))
        rows_seen = rows_of_tap(i.problem, unknowns, view, tap, given, first, done)
        if rows_seen is not None:
            _guarded(lane, partial(i.taps.give, rows_seen))
        if lane.alive and done < last - first:
            lane.problem_found = i.diverged(first + done + 1, turns, residual)


def _taps(view: View, asked: Sequence[BoolArray]) -> list[Tap]:
    """Taps of all lanes, with as many rows as the fullest."""
    found = [view.tap(rows_of(x)) for x in asked]
    fullest = max(found, key=lambda tap: len(tap.u))
    parts = {name: getattr(fullest, name) for name in view.shapes}
    return [
        tap._replace(**{name: np.zeros_like(part) for name, part in parts.items()}) for tap in found
    ]


def _guarded(lane: Lane, action: Callable[[], None]) -> None:
    """What hands something to the lane's observers, if they took all before."""
    if lane.problem_found is not None:
        return
    try:
        action()
    except Exception as problem:
        lane.problem_found = problem


def _close(lane: Lane) -> None:
    for observer in lane.integration.observers:
        try:
            observer.close()
        except Exception as problem:
            lane.problem_found = lane.problem_found or problem
