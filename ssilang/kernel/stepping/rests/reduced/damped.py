"""A reduced model with dashpots or moving supports under way."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.newton import Workspace
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.stepping.problem.moving_supports import Course, Start
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.loop import Motion
from ssilang.kernel.stepping.rests.modal.loop import ModalRows
from ssilang.kernel.stepping.rests.reduced.basis import ReducedModel
from ssilang.kernel.stepping.rests.reduced.loop import (
    Pull,
    Reduced,
    ReducedStep,
    march_reduced,
    reduced_step,
)


class Given(NamedTuple):
    """What some steps of one dt start from."""

    dt: float
    joints: Joints
    motion: Motion
    newton: Workspace
    factors: FloatArray
    save: IntArray


class DampedTrace:
    """Steps of a reduced model by `march_reduced`, with the energies that supports bring."""

    def __init__(self, problem: Problem, model: ReducedModel, scheme: FloatArray) -> None:
        self.problem, self.model, self.supports = problem, model, model.supports
        self.steps: dict[float, ReducedStep] = {}
        q, own = len(model.J), problem.loading.forces.shape[1]
        lift = np.zeros((q, model.forces.shape[1]))
        lift[:, lift.shape[1] - self.supports.count :] = self.supports.columns.lift
        self.own = np.ascontiguousarray(model.forces[:, own:].T)
        self.reduced = Reduced(
            model.m, model.c, model.k, np.ascontiguousarray(np.vstack([model.J, model.B]).T),
            model.sense, np.ascontiguousarray(model.forces.T),
            lift if lift.any() else np.zeros((q, 0)), scheme,
        )  # fmt: skip
        self._rates = self.supports.start[1:]

    def advance(
        self, given: Given, rows: ModalRows, history: FloatArray
    ) -> tuple[int, int, Course | None]:
        """The steps of `given`: number done, most iterations of one, the course of the supports."""
        motion, factors, moves = given.motion, given.factors, self.supports.count > 0
        if given.dt not in self.steps:
            self.steps[given.dt] = reduced_step(self.reduced, given.dt, len(motion.delta))
        moving = self.supports.during(self.problem, given.dt)
        course = moving.course(factors[:, moving.chosen], *self._rates)
        scheme = self.problem.scheme
        whole = factors
        if moves:
            whole = np.hstack([factors, course.factors(scheme.alpha_m, scheme.alpha_f)])
        works = np.zeros((2, len(given.save), whole.shape[1] if moves else 0))
        work = np.array([self.own @ x for x in (motion.u, motion.v, motion.a)])
        start = Start(work, motion.f.copy())
        pull = Pull(self.model.B @ motion.v, self.model.B @ motion.a)
        done, turns, _ = march_reduced(
            self.reduced, self.steps[given.dt], given.joints, motion, pull, given.newton, whole,
            given.save, rows, history, works,
        )  # fmt: skip
        if not moves:
            return done, turns, None
        own = np.ascontiguousarray(works[:, :done, factors.shape[1] :])
        columns = self.supports.columns
        moving.complete(columns, course, start, own, factors, history[:done])
        if done:
            motion.energies[:] = history[done - 1]
        self._rates = np.array([course.v[-1], course.a[-1]])
        return done, turns, course
