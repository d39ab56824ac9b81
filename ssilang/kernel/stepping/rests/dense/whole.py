"""The dense loop on all unknowns, where supports move."""

from __future__ import annotations

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.arrays import joints_of, operators_of, system_of
from ssilang.kernel.stepping.rests.dense.loop import run_dense, sweep_of
from ssilang.kernel.stepping.state import Motion, Outcome, Recorder
from ssilang.kernel.stepping.track import View, whole_view


class DenseLoop:
    """Steps of one dt."""

    remembered = ("_work",)

    def __init__(self, problem: Problem, motion: Motion, effective: Effective) -> None:
        self._system = system_of(problem)
        self._operators = operators_of(problem, effective)
        self._joints = joints_of(problem)
        self._motion = motion
        self._work = workspace(motion.w.shape, len(motion.f))

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps on the whole problem's arrays."""
        return run_dense(
            self._system,
            self._operators,
            self._joints,
            self._motion,
            sweep_of(self._system),
            self._work,
            factors,
            recorder,
        )

    def view(self, unknowns: IntArray) -> View:
        """Unknowns as they are."""
        return whole_view(self._motion, unknowns)
