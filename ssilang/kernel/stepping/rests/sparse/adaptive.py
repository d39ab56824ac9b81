"""Steps halved, again and again, where a joint or relation opens or closes within them.

The event is located to dt/2^DEEPEST; elsewhere the step asked for is kept. Loads are linear
within a step.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.contact.impact import ImpactRule
from ssilang.kernel.contact.rows import BoolArray
from ssilang.kernel.contact.solver import step_solver
from ssilang.kernel.stepping.effective import effective_matrix, effective_of
from ssilang.kernel.stepping.keeping import memory, recall
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import SparseLoop, StepSolver, end_of_step
from ssilang.kernel.stepping.state import N_ENERGIES, Motion, Outcome, Recorder, recorder_of
from ssilang.kernel.stepping.track import View, whole_view

DEEPEST = 5

Memory = list[dict[str, Any]]


class AdaptiveLoop:
    """Steps of one dt, split at contact events.

    `closed` (m,) are the unilateral relations that are closed at the start; kept up to date.
    """

    def __init__(self, problem: Problem, motion: Motion, dt: float, closed: BoolArray) -> None:
        self.problem, self.motion, self.dt, self.closed = problem, motion, dt, closed
        self._impacts: dict[int, ImpactRule] = {}
        self.loop = SparseLoop(problem, motion)
        self._solvers: dict[int, StepSolver] = {}
        self.solver = ""
        self._solver(0)

    def memory(self) -> Memory:
        """What the solvers of the levels remember, in the order in which they were made."""
        return [{"level": level, "kept": memory(s)} for level, s in self._solvers.items()]

    def recall(self, kept: Memory) -> None:
        """Give it back to them."""
        for part in kept:
            recall(self._solver(part["level"]), part["kept"])

    def renew(self, problem: Problem) -> None:
        """Go on with other loads, all else being the same."""
        self.problem = self.loop.problem = problem

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps of dt, each in as many parts as it takes."""
        worst, r = 0, recorder
        for k in range(len(r.row)):
            turns, residual = self._step(0, factors[k], factors[k + 1])
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            end_of_step(self.motion, r, k)
        return len(r.row), worst, 0.0

    def view(self, unknowns: IntArray) -> View:
        """Unknowns as they are."""
        return whole_view(self.motion, unknowns)

    def _solver(self, level: int) -> StepSolver:
        if level not in self._solvers:
            dt = self.dt / 2**level
            share = 1 - self.problem.scheme.alpha_f
            effective = effective_of(self.problem, effective_matrix(self.problem, dt), dt, share)
            self.solver = effective.inverse.factor.name
            self._solvers[level] = step_solver(self.problem, effective)
            if self.problem.contact is not None:
                rule = ImpactRule(self.problem, effective, self.problem.contact, self.closed)
                self._impacts[level] = rule
        return self._solvers[level]

    def _step(self, level: int, start: FloatArray, end: FloatArray) -> tuple[int, float]:
        """One step between two rows of load factors, split if contact changes in it."""
        before, touching = [x.copy() for x in self.motion], self.closed.copy()
        closed = self._closed()
        solver = self._solver(level)
        nowhere = recorder_of(self.motion, np.full(1, -1), np.zeros((1, N_ENERGIES)))
        n = newmark_of(self.problem.scheme, self.dt / 2**level)
        done, turns, residual = self.loop.run(
            solver, n, np.stack([start, end]), nowhere, self._impacts.get(level)
        )
        fine = done == 1 and np.array_equal(closed, self._closed())
        if fine or (level == DEEPEST and done == 1):
            return turns, residual
        if level == DEEPEST:
            return min(turns, 0), residual
        for array, old in zip(self.motion, before, strict=True):
            array[...] = old
        self.closed[:] = touching
        middle = 0.5 * (start + end)
        first, residual = self._step(level + 1, start, middle)
        if first <= 0:
            return first, residual
        second, residual = self._step(level + 1, middle, end)
        return (second if second <= 0 else max(first, second)), residual

    def _closed(self) -> BoolArray:
        """Joints, then relations, that push."""
        joints = self.motion.t[:, -1] < 0.0
        contact = self.problem.contact
        if contact is None:
            return joints
        return np.concatenate([joints, contact.closed(self.motion.contact)])
