"""Runs of a sweep that go side by side in one process and meet at their time integrations.

Each run has a thread, of which one alone is awake at any time: what a run does is what it does
alone. A run that reaches a time integration waits there until all others wait too or are done;
the problems that came together are then integrated at once, those of one model side by side.
"""

from __future__ import annotations

import itertools
import threading
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import TYPE_CHECKING

from ssilang.cli.sweeping.worker import Row, Task, Work, lost_row, run_task

if TYPE_CHECKING:
    from ssilang.kernel.stepping.problem.problem import Problem
    from ssilang.kernel.stepping.run import History, Progress
    from ssilang.kernel.stepping.snapshot import Observer

STACK = 64 << 20  # bytes of a thread's stack: scripts may nest procedures as deep as in a process


@dataclass(eq=False)
class Request:
    """A time integration that a run waits for."""

    problem: Problem
    observers: Sequence[Observer]
    progress: Progress | None
    found: History | Exception | None = None
    seconds: float = 0.0
    """Its share of the time that the integration took."""


class Gathering:
    """Where the runs of a process meet.

    Parameters
    ----------
    runs : int
        How many there are.
    """

    def __init__(self, runs: int) -> None:
        self._awake, self._waiting = runs, list[Request]()
        self._turn = threading.Condition()
        self._own = threading.local()

    def run(self, work: Callable[[], Row]) -> Row:
        """Do a run's work, in a thread of its own, when it is its turn."""
        with self._turn:
            try:
                return work()
            finally:
                self._awake -= 1
                self._settle()

    def integrate(
        self, problem: Problem, observers: Sequence[Observer], progress: Progress | None
    ) -> History:
        """As the kernel's `integrate`, with what the other runs integrate."""
        request, began = Request(problem, observers, progress), perf_counter()
        self._waiting.append(request)
        self._awake -= 1
        self._settle()
        self._turn.wait_for(lambda: request.found is not None)
        self._own.away = self.away() + perf_counter() - began - request.seconds
        if isinstance(request.found, Exception):
            raise request.found
        assert request.found is not None
        return request.found

    def away(self) -> float:
        """Seconds that the run of this thread left to others so far."""
        return float(getattr(self._own, "away", 0.0))

    def _settle(self) -> None:
        """Integrate what waits if no run is awake that could add to it."""
        if self._awake or not self._waiting:
            return
        from ssilang.kernel.stepping.run_many import integrate_together

        requests, self._waiting = self._waiting, []
        began = perf_counter()
        parts = [(r.problem, r.observers, r.progress) for r in requests]
        found: Sequence[History | Exception]
        try:
            found = integrate_together(*(list(p) for p in zip(*parts, strict=True)))
        except Exception as problem:
            found = [problem] * len(requests)
        share = (perf_counter() - began) / len(requests)
        for request, result in zip(requests, found, strict=True):
            request.found, request.seconds = result, share
        self._awake += len(requests)
        self._turn.notify_all()


def run_together(tasks: Sequence[Task], work: Work = run_task) -> list[Row]:
    """Rows of tasks that go side by side; what one of them raises is its own row's error."""
    if len(tasks) == 1:
        return [_row(work, tasks[0])]
    meeting = Gathering(len(tasks))
    rows: list[Row | None] = [None] * len(tasks)

    def run(place: int) -> None:
        task = replace(tasks[place], meeting=meeting)
        rows[place] = meeting.run(lambda: _row(work, task))

    before = threading.stack_size(STACK)
    with warnings.catch_warnings():  # runs set filters and put them back in any order
        threads = [threading.Thread(target=run, args=(i,)) for i in range(len(tasks))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    threading.stack_size(before)
    return [row or lost_row(task, "no end") for row, task in zip(rows, tasks, strict=True)]


def _row(work: Work, task: Task) -> Row:
    try:
        return work(task)
    except Exception as problem:
        return lost_row(task, str(problem))


def gathered(tasks: Sequence[Task], jobs: int, most: int) -> list[tuple[Task, ...]]:
    """Neighbours in batches of at most `most`: as many for each job, of the same size but for one.

    All jobs end at about the same time.
    """
    rounds = -(-len(tasks) // (max(most, 1) * max(jobs, 1)))
    count = min(rounds * max(jobs, 1), len(tasks))
    places = [len(tasks) * i // max(count, 1) for i in range(count + 1)]
    return [tuple(tasks[a:b]) for a, b in itertools.pairwise(places)]
