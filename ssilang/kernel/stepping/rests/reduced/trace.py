"""Reduced models under way: their steps, and how far two nested ones are apart."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.initial import (
    admissible_velocity,
    initial_energies,
    joint_state,
)
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
from ssilang.kernel.stepping.state import N_ENERGIES, Motion, Recorder, recorder_of, rows_of
from ssilang.kernel.stepping.times import SAME, Run, runs_of

KEPT = ("u", "v", "a", "w", "t", "state")
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
    rows: Recorder
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
    strength: float = 1.0  # of the loads
    motion: Motion = field(init=False)
    energies: FloatArray = field(init=False)
    iterations: int = 0

    def __post_init__(self) -> None:
        p, start = self.problem, self.model.start
        joints = joint_state(p)
        energies = initial_energies(p, admissible_velocity(p), joints)
        u, v, a = (start[:, i].copy() for i in range(3))
        self.motion = Motion(
            u, v, a, joints.delta, joints.f, joints.w, joints.t, joints.state, np.zeros(0),
            energies, np.zeros(0),
        )  # fmt: skip
        self.energies = np.zeros((len(p.times), N_ENERGIES))
        self.energies[0] = energies
        self._joints, m = p.joints, self.model
        self._steps: dict[float, ReducedStep] = {}
        q, own = len(m.J), self.problem.loading.forces.shape[1]
        lift = np.zeros((q, m.forces.shape[1]))
        lift[:, lift.shape[1] - m.supports.count :] = m.supports.columns.lift
        self._own = np.ascontiguousarray(m.forces[:, own:].T)
        self._reduced = Reduced(
            m.m, m.c, m.k, np.ascontiguousarray(np.vstack([m.J, m.B]).T), m.sense,
            np.ascontiguousarray(m.forces.T), lift if lift.any() else lift[:, :0].copy(),
        )  # fmt: skip
        self._rates = m.supports.start[1:]

    def advance(self, run: Run) -> Chunk | None:
        """The steps of a run; None if one of them did not converge."""
        row = rows_of(self.kept[run.first + 1 : run.last + 1])
        steps = run.first + 1 + np.flatnonzero(row >= 0)
        times = self.problem.times[run.first : run.last + 1]
        factors = self.strength * self.problem.loading.at(times)
        to = recorder_of(
            self.motion, row, self.energies[run.first + 1 : run.last + 1], KEPT,
            jumps=np.zeros((len(row), *self.motion.w.shape)),
        )  # fmt: skip
        # steps as long as known ones but for rounding are these
        dt = next((t for t in self._steps if abs(t - run.dt) <= SAME * t), run.dt)
        if dt not in self._steps:
            n, q = newmark_of(self.problem.scheme, dt), len(self.motion.delta)
            self._steps[dt] = reduced_step(self._reduced, n, q)
        done, turns, course = self._advance(self._steps[dt], factors, to)
        if done < len(row):
            return None
        self.iterations = max(self.iterations, turns)
        return Chunk(run, to, steps, course)

    def _advance(
        self, step: ReducedStep, factors: FloatArray, to: Recorder
    ) -> tuple[int, int, Course | None]:
        """Steps of a motion: number done, most iterations of one, the course of the supports."""
        n, x, model, supports = step.newmark, self.motion, self.model, self.model.supports
        moving, whole = supports.during(self.problem, n.dt), factors
        course = moving.course(factors[:, moving.chosen], *self._rates)
        if supports.count:
            whole = np.hstack([factors, course.factors(n)])
        to = to._replace(work=np.zeros((2, len(to.row), whole.shape[1] if supports.count else 0)))
        start = Start(np.array([self._own @ z for z in (x.u, x.v, x.a)]), x.f.copy())
        dashpots = dashpots_of(model.B @ x.v, model.B @ x.a, len(x.delta), len(x.u))
        room = workspace(x.w.shape, len(x.f))
        done, turns, _ = run_reduced(
            self._reduced, step, self._joints, x, dashpots, room, whole, to
        )
        if not supports.count:
            return done, turns, None
        own = np.ascontiguousarray(to.work[:, :done, factors.shape[1] :])
        history = to.energies[:done]
        moving.complete(supports.columns, course, start, own, factors, history)
        if done:
            x.energies[:] = history[-1]
        self._rates = np.array([course.v[-1], course.a[-1]])
        return done, turns, course


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
        return self._gap / np.where(self._size > 0.0, self._size, 1.0)

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
