"""Moving supports of a reduced problem: their loads, and the motion that they add."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.problem.moving_supports import MOST, Columns, MovingSupports
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import Motion
from ssilang.messages.message import Sentence


@dataclass(frozen=True, eq=False)
class ReducedSupports:
    """Supports whose motions `X c(t)` come on top of what the vectors describe.

    Attributes
    ----------
    columns : Columns
        On the motions y that the supports leave.
    start : array (3, m)
        c, c', c'' at the start.
    """

    moving: MovingSupports
    columns: Columns
    start: FloatArray

    @property
    def count(self) -> int:
        """Number m of motions."""
        return int(self.columns.X.shape[1])

    def during(self, problem: Problem, dt: float) -> MovingSupports:
        """The same supports in another motion (its scheme, its loads), for steps dt."""
        moving = copy(self.moving)
        moving.problem, moving.dt = problem, dt
        return moving


def reduced_supports(
    problem: Problem, T: sp.csr_array, u: FloatArray, v: FloatArray, a: FloatArray
) -> ReducedSupports | Sentence:
    """The supports of a problem whose motion starts with u, v, a (n,); or why they are too much."""
    dt = float(problem.times[1] - problem.times[0])
    moving = MovingSupports(problem, dt, T)
    if len(moving.chosen) > MOST:
        return Sentence("kernel.stepping.supports-move-by-too-many", most=MOST)
    none, table = np.zeros(0), np.zeros((0, 1))
    motion = Motion(u, v, a, none, none, table, table, table, none, none, none)
    columns, course = moving.begin(motion, problem.loading.at(problem.times[:2]))
    if columns.X.shape[1] > len(moving.chosen):
        return Sentence("kernel.stepping.initial-motion-of-supports")
    start = np.array([course.c[0], course.v[0], course.a[0]])
    return ReducedSupports(moving, columns, start)
