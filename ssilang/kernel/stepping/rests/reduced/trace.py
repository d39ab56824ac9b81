"""Reduced models under way: their steps, and how far two nested ones are apart."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.newton import Workspace, workspace
from ssilang.kernel.stepping.problem.initial import (
    admissible_velocity,
    initial_energies,
    joint_state,
)
from ssilang.kernel.stepping.problem.moving_supports import Course
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.arrays import joints_of
from ssilang.kernel.stepping.rests.dense.loop import N_ENERGIES, Motion
from ssilang.kernel.stepping.rests.modal.loop import Modal, ModalRows, ModalStep, march_modal
from ssilang.kernel.stepping.rests.reduced.basis import ReducedModel
from ssilang.kernel.stepping.rests.reduced.damped import DampedTrace, Given
from ssilang.kernel.stepping.times import SAME, Run, runs_of

SPARSER = 8  # velocities and accelerations at one of so many of them
CHUNK, LONGEST = 256, 4096  # steps to the first comparison, between the last ones


def comparing(times: FloatArray) -> Iterator[Run]:
    """Runs of equal steps, each up to twice as long as the one before."""
    done, longest = 0, CHUNK
    while done < len(times) - 1:
        run = next(runs_of(times[done : done + longest + 1], longest))
        yield Run(done + run.first, done + run.last, run.dt)
        done, longest = done + run.last, min(2 * longest, LONGEST)


@dataclass(eq=False)
class Chunk:
    """Steps of one dt: jumps of all, rows of those kept."""

    run: Run
    rows: ModalRows
    steps: IntArray
    """Steps of the rows."""
    course: Course | None = None
    """Of the supports, at all times of the run."""


@dataclass(eq=False)
class Trace:
    """A reduced model under way."""

    problem: Problem
    model: ReducedModel
    kept: np.ndarray
    motion: Motion = field(init=False)
    energies: FloatArray = field(init=False)
    iterations: int = 0

    def __post_init__(self) -> None:
        p, start = self.problem, self.model.start
        joints = joint_state(p)
        energies = initial_energies(p, admissible_velocity(p), joints)
        u, v, a = (np.ascontiguousarray(start[:, i]) for i in range(3))
        self.motion = Motion(
            u.copy(), v.copy(), a.copy(), joints.delta, joints.f, joints.w, joints.t, joints.state,
            np.zeros(0), energies, np.zeros(0),
        )  # fmt: skip
        self.energies = np.zeros((len(p.times), N_ENERGIES))
        self.energies[0] = energies
        s = p.scheme
        scheme = np.array([s.alpha_m, s.alpha_f, s.beta, s.gamma])
        m = self.model
        Jt = np.ascontiguousarray(m.J.T)
        self._joints = joints_of(p)
        self._steps: dict[float, ModalStep] = {}
        self._damped: DampedTrace | None = None
        if not m.diagonal:
            self._damped = DampedTrace(p, m, scheme)
            return
        self._modal = Modal(m.m, m.c, m.k, m.J, Jt, np.ascontiguousarray(m.forces.T), scheme)

    def advance(self, run: Run) -> Chunk | None:
        """The steps of a run; None if one of them did not converge."""
        chosen = self.kept[run.first + 1 : run.last + 1]
        save = np.where(chosen, np.cumsum(chosen) - 1, -1).astype(np.int64)
        rows = self._room(run.last - run.first, int(chosen.sum()))
        factors = self.problem.loading.at(self.problem.times[run.first : run.last + 1])
        history = self.energies[run.first + 1 : run.last + 1]
        course = None
        if self._damped is not None:
            dt = self._like(run.dt, self._damped.steps)
            given = Given(dt, self._joints, self.motion, self._newton(), factors, save)
            done, turns, course = self._damped.advance(given, rows, history)
        else:
            done, turns, _ = march_modal(
                self._modal, self._step(run.dt), self._joints, self.motion, self._newton(), factors,
                save, rows, history,
            )  # fmt: skip
        if done < run.last - run.first:
            return None
        self.iterations = max(self.iterations, turns)
        return Chunk(run, rows, run.first + 1 + np.flatnonzero(chosen), course)

    def _newton(self) -> Workspace:
        return workspace(self.motion.w.shape, len(self.motion.f))

    def _room(self, steps: int, rows: int) -> ModalRows:
        m, r = self.motion, self.model.size
        u, v, a = (np.zeros((rows, r)) for _ in range(3))
        w, t = np.zeros((rows, *m.w.shape)), np.zeros((rows, *m.t.shape))
        return ModalRows(
            np.zeros((steps, *m.w.shape)), u, v, a, w, t, np.zeros((rows, *m.state.shape))
        )

    @staticmethod
    def _like(dt: float, steps: Iterable[float]) -> float:
        """dt, or the length of a step known that is the same but for rounding."""
        return next((known for known in steps if abs(known - dt) <= SAME * dt), dt)

    def _step(self, dt: float) -> ModalStep:
        dt = self._like(dt, self._steps)
        if dt not in self._steps:
            s, m = self.problem.scheme, self.model
            A = (1 - s.alpha_m) / (s.beta * dt**2) * m.m + (1 - s.alpha_f) * m.k
            A += (1 - s.alpha_f) * s.gamma / (s.beta * dt) * m.c
            self._steps[dt] = ModalStep(dt, 1.0 / A, np.ascontiguousarray((m.J / A) @ m.J.T))
        return self._steps[dt]


class Difference:
    """The largest difference of two traces so far, relative to the largest values."""

    def __init__(self, problem: Problem) -> None:
        numbering = problem.numbering
        names = np.array([name.startswith("R") for name in numbering.unknowns])
        turning = names[numbering.codes]
        self._groups = [np.flatnonzero(~turning), np.flatnonzero(turning)]
        self._gap, self._size = np.zeros(5), np.zeros(5)

    def take(self, poor: Trace, rich: Trace, a: Chunk, b: Chunk) -> None:
        """Compare a chunk: all jumps, and whole fields at the instants that both kept."""
        where = np.flatnonzero(np.isin(b.steps, a.steps))
        few = slice(None, None, SPARSER)
        x, y = a.rows, b.rows
        both = [(x.u, y.u[where]), (x.v[few], y.v[where[few]]), (x.a[few], y.a[where[few]])]
        (gap, u), *others = _fields(poor.model, rich.model, both)
        pairs = [(x.jumps - y.jumps, y.jumps), *((gap[g], u[g]) for g in self._groups), *others]
        for i, (change, value) in enumerate(pairs):
            self._gap[i] = max(self._gap[i], np.abs(change).max(initial=0.0))
            self._size[i] = max(self._size[i], np.abs(value).max(initial=0.0))

    @property
    def relative(self) -> FloatArray:
        """Relative differences of jumps, displacements, rotations, velocities, accelerations."""
        found: FloatArray = self._gap / np.where(self._size > 0.0, self._size, 1.0)
        return found

    @property
    def estimate(self) -> float:
        """The largest of jumps, displacements and rotations: what the tolerance holds."""
        return float(self.relative[:3].max())


def _fields(
    poor: ReducedModel, rich: ReducedModel, pairs: list[tuple[FloatArray, FloatArray]]
) -> list[tuple[FloatArray, FloatArray]]:
    """Difference and values of whole fields (n, k) for pairs of rows of coordinates."""
    columns = []
    for p, q in pairs:
        z = rich.X @ q.T
        gap = z.copy()
        gap[: poor.size] -= poor.X @ p.T
        columns += [gap, z]
    ends = np.cumsum([z.shape[1] for z in columns])[:-1]
    parts = np.split(rich.whole(np.concatenate(columns, axis=1)), ends, axis=1)  # one product
    return list(zip(parts[::2], parts[1::2], strict=True))
