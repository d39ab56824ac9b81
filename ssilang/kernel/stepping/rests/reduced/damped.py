"""A reduced model with dashpots or moving supports under way."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.interface.newton import Workspace
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.stepping.newmark import Newmark
from ssilang.kernel.stepping.problem.moving_supports import Course, Start
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.reduced.basis import ReducedModel
from ssilang.kernel.stepping.rests.reduced.loop import (
    Reduced,
    ReducedStep,
    dashpots_of,
    reduced_step,
    run_reduced,
)
from ssilang.kernel.stepping.state import Motion, Recorder


class DampedTrace:
    """Steps of a reduced model by `run_reduced`, with the energies that supports bring."""

    def __init__(self, problem: Problem, model: ReducedModel, joints: Joints) -> None:
        self.problem, self.model, self.supports = problem, model, model.supports
        self.joints = joints
        self.steps: dict[float, ReducedStep] = {}
        q, own = len(model.J), problem.loading.forces.shape[1]
        lift = np.zeros((q, model.forces.shape[1]))
        lift[:, lift.shape[1] - self.supports.count :] = self.supports.columns.lift
        self.own = np.ascontiguousarray(model.forces[:, own:].T)
        self.reduced = Reduced(
            model.m, model.c, model.k, np.ascontiguousarray(np.vstack([model.J, model.B]).T),
            model.sense, np.ascontiguousarray(model.forces.T),
            lift if lift.any() else np.zeros((q, 0)),
        )  # fmt: skip
        self._rates = self.supports.start[1:]

    def advance(
        self, n: Newmark, motion: Motion, room: Workspace, factors: FloatArray, to: Recorder
    ) -> tuple[int, int, Course | None]:
        """Steps of a motion: number done, most iterations of one, the course of the supports."""
        moves, q = self.supports.count > 0, len(motion.delta)
        if n.dt not in self.steps:
            self.steps[n.dt] = reduced_step(self.reduced, n, q)
        moving = self.supports.during(self.problem, n.dt)
        course = moving.course(factors[:, moving.chosen], *self._rates)
        whole = factors
        if moves:
            whole = np.hstack([factors, course.factors(n)])
        to = to._replace(work=np.zeros((2, len(to.row), whole.shape[1] if moves else 0)))
        work = np.array([self.own @ x for x in (motion.u, motion.v, motion.a)])
        start = Start(work, motion.f.copy())
        dashpots = dashpots_of(self.model.B @ motion.v, self.model.B @ motion.a, q, len(motion.u))
        done, turns, _ = run_reduced(
            self.reduced, self.steps[n.dt], self.joints, motion, dashpots, room, whole, to
        )
        if not moves:
            return done, turns, None
        own = np.ascontiguousarray(to.work[:, :done, factors.shape[1] :])
        history = to.energies[:done]
        moving.complete(self.supports.columns, course, start, own, factors, history)
        if done:
            motion.energies[:] = history[-1]
        self._rates = np.array([course.v[-1], course.a[-1]])
        return done, turns, course
