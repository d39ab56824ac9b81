"""Steps halved, again and again, where a joint or relation opens or closes within them.

The event is located to dt/2^DEEPEST; elsewhere the step asked for is kept. Loads are linear
within a step.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.contact.rows import BoolArray
from ssilang.kernel.stepping.keeping import leaves, memory, put_back, recall
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import SparseSteps, end_of_step
from ssilang.kernel.stepping.state import (
    N_ENERGIES,
    Motion,
    Outcome,
    Recorder,
    none_kept,
    recorder_of,
)
from ssilang.kernel.stepping.track import View, whole_view

DEEPEST = 5

Memory = list[dict[str, Any]]


class AdaptiveLoop:
    """Steps of one dt, split at contact events.

    `closed` (m,) are the unilateral relations that are closed at the start; kept up to date. `part`
    makes the loop of steps of a length.
    """

    def __init__(
        self, problem: Problem, motion: Motion, dt: float, closed: BoolArray,
        part: Callable[[float], SparseSteps],
    ) -> None:  # fmt: skip
        self.problem, self.motion, self.dt, self.closed = problem, motion, dt, closed
        self._make, self._parts = part, dict[int, SparseSteps]()
        self._part(0)

    def memory(self) -> Memory:
        """What the loops of the levels remember, in the order in which they were made."""
        return [{"level": level, "kept": memory(p)} for level, p in self._parts.items()]

    def recall(self, kept: Memory) -> None:
        """Give it back to them."""
        for part in kept:
            recall(self._part(part["level"]), part["kept"])

    def renew(self, problem: Problem) -> None:
        """Go on with other loads, all else being the same."""
        self.problem = problem
        for part in self._parts.values():
            part.renew(problem)

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps of dt, each in as many parts as it takes."""
        worst, steps = 0, len(recorder.row)
        for k in range(steps):
            turns, residual = self._step(0, factors[k], factors[k + 1])
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            end_of_step(self.motion, recorder, k)
        return steps, worst, 0.0

    def view(self, unknowns: IntArray) -> View:
        """Unknowns as they are."""
        return whole_view(self.motion, unknowns)

    def _part(self, level: int) -> SparseSteps:
        if level not in self._parts:
            self._parts[level] = self._make(self.dt / 2**level)
            self._parts[level].renew(self.problem)
        return self._parts[level]

    def _step(self, level: int, start: FloatArray, end: FloatArray) -> tuple[int, float]:
        """One step between two rows of load factors, split if contact changes in it."""
        state = (*self.motion, self.closed)
        before, closed = leaves(state), self._closed()
        nowhere = recorder_of(self.motion, none_kept(1), np.zeros((1, N_ENERGIES)), ())
        done, turns, residual = self._part(level).run(np.stack([start, end]), nowhere)
        fine = done == 1 and np.array_equal(closed, self._closed())
        if fine or (level == DEEPEST and done == 1):
            return turns, residual
        if level == DEEPEST:
            return min(turns, 0), residual
        put_back(state, before)
        middle = 0.5 * (start + end)
        first, residual = self._step(level + 1, start, middle)
        if first <= 0:
            return first, residual
        second, residual = self._step(level + 1, middle, end)
        return (second if second <= 0 else max(first, second)), residual

    def _closed(self) -> BoolArray:
        """Joints, then relations, that push."""
        joints = self.motion.t[:, -1] < 0.0
        return np.concatenate([joints, self.problem.contact.closed(self.motion.contact)])
