"""Reduced models under way: their steps, and how far two nested ones are apart.

Steps of a reduced model by Newton's method on its coordinates, for interfaces of more unknowns.

    A dz + c J^T (f(delta_0 + J dz) - f_0) = r ,   A = mass M + damping C + c K

The law acts at every point of the joints. The LU factor of `A + c J^T K_j J`, K_j the joints'
tangent, is kept from turn to turn and step to step, and made again where a turn gains less than
`GAIN`. It is of single precision, and takes points anew whose tangents changed by `CHANGED`: it
leads to the solution, and what is out of balance, in double precision, says where that is.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.scientific import la
from ssilang.kernel.interface.interface import joint_stiffness
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    accept,
    interface_energies,
    interface_response,
    new_trial,
)
from ssilang.kernel.stepping.newmark import Newmark, advanced, from_past, newmark_of
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
from ssilang.kernel.stepping.state import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    N_ENERGIES,
    STORED,
    Motion,
    Outcome,
    Recorder,
    recorder_of,
    rows_of,
)
from ssilang.kernel.stepping.times import SAME, Run, runs_of

MOST_TURNS = 60
TOLERANCE = 1e-10  # of the forces of a step
GAIN = 5.0  # of a turn with a kept factor, below which it is made again
CHANGED = 0.02  # of a point's tangent, from which on the factor takes it


@dataclass(eq=False)
class Coordinates:
    """Steps of one dt on r coordinates.

    Attributes
    ----------
    J : array (q, r)
    A, C : arrays (r, r)
        The step's matrix without joints, damping.
    """

    model: Reduced
    newmark: Newmark
    joints: Joints
    J: FloatArray = field(init=False)
    _factor: Any = None

    def __post_init__(self) -> None:
        m, n, p = self.model, self.newmark, self.joints
        q, d = m.Rt.shape[1] - len(m.sense), p.B.shape[1]
        self.J, B = np.ascontiguousarray(m.Rt[:, :q].T), m.Rt[:, q:]
        self.C = np.diag(m.c) + (B * m.sense) @ B.T
        self.A = np.diag(n.mass * m.m + n.end * m.k) + n.damping * self.C
        self._trial = new_trial((len(p.weights), d), q)
        self._D = np.zeros((len(p.weights), d, d))
        self._J, self._matrix = (x.astype(np.float32) for x in (self.J, self.A))

    def run(self, x: Motion, factors: FloatArray, to: Recorder) -> Outcome:
        """Steps between the rows of `factors`; `x` and the rows hold coordinates."""
        m, n, e, worst = self.model, self.newmark, x.energies, 0
        loads, Cv, Ca = factors @ m.forces, self.C @ x.v, self.C @ x.a
        for k in range(len(to.row)):
            r = from_past(n, m.m * x.v, m.m * x.a, Cv, Ca) - m.k * x.u
            r += n.end * loads[k + 1] + n.start * loads[k] - x.f @ self.J
            dz, turns, residual = self._solve(x.joints, r)
            if turns <= 0:
                return k, turns, residual
            worst, before = max(worst, turns), Cv
            x.u[:] += dz
            x.v[:], x.a[:] = advanced(n, dz, x.v, x.a)
            Cv, Ca = advanced(n, self.C @ dz, Cv, Ca)
            e[KINETIC], e[ELASTIC] = 0.5 * m.m @ x.v**2, 0.5 * m.k @ x.u**2
            e[DAMPED] += 0.5 * dz @ (before + Cv)
            e[EXTERNAL] += 0.5 * dz @ (loads[k] + loads[k + 1])
            e[STORED], e[LOST] = interface_energies(self.joints, x.w, x.t, x.state)
            to.energies[k], to.jumps[k] = e, x.w
            if to.row[k] >= 0:
                for name in ("u", "v", "a", "w", "t", "state"):
                    getattr(to, name)[to.row[k]] = getattr(x, name)
        return len(to.row), worst, 0.0

    def _solve(self, now: InterfaceState, r: FloatArray) -> tuple[FloatArray, int, float]:
        """The increment (r,), turns (<= 0: none converged), what is out of balance."""
        trial, end, old = self._trial, self.newmark.end, np.inf
        dz, scale = np.zeros(len(r)), np.abs(r).max(initial=0.0)
        if self._factor is not None:  # the first turn would find what is known
            dz, old = dz + la.lu_solve(self._factor, r.astype(np.float32)), 1.0
        for turn in range(1, MOST_TURNS + 1):
            trial.y[:] = self.J @ dz
            trial.delta[:] = now.delta + trial.y
            interface_response(self.joints, now.state, trial.delta, trial)
            held = self.A @ dz
            left = r - held - end * ((trial.f - now.f) @ self.J)
            size = np.abs(left).max() / max(scale + np.abs(held).max(), 1e-300)
            if size <= TOLERANCE:
                accept(trial, now)
                return dz, turn, size
            if not np.isfinite(size):
                break
            if self._factor is None or size * GAIN > old:
                self._tangent(trial.D)
                self._factor = la.lu_factor(self._matrix)
            # pyrefly: ignore [no-matching-overload]
            old, dz = size, dz + la.lu_solve(self._factor, left.astype(np.float32))
        return dz, -MOST_TURNS, float(size)

    def _tangent(self, D: FloatArray) -> None:
        """The matrix with the joints' tangents D, which change at some points, for the factor."""
        p, end = self.joints, self.newmark.end
        gap = np.abs(D - self._D).max(axis=(1, 2))
        at = np.flatnonzero(gap > CHANGED * np.abs(D).max(axis=(1, 2)))
        some = Joints(p.pairs[at], p.B[at], p.weights[at], p.codes[at], p.p[at])
        K = joint_stiffness(some, end * (D - self._D)[at], len(self.J)).astype(np.float32)
        felt = np.flatnonzero(np.diff(K.indptr))
        self._matrix += self._J[felt].T @ (K[felt] @ self._J)
        self._D[at] = D[at]


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
        self._joints = p.interface.points
        self._take(self.model)

    def _take(self, m: ReducedModel) -> None:
        self.model = m
        self._steps: dict[float, ReducedStep | Coordinates] = {}
        q, own = len(m.J), self.problem.loading.forces.shape[1]
        lift = np.zeros((q, m.forces.shape[1]))
        lift[:, lift.shape[1] - m.supports.count :] = m.supports.columns.lift
        self._own = np.ascontiguousarray(m.forces[:, own:].T)
        self._reduced = Reduced(
            m.m, m.c, m.k, np.ascontiguousarray(np.vstack([m.J, m.B]).T), m.sense,
            np.ascontiguousarray(m.forces.T), lift if lift.any() else lift[:, :0].copy(),
        )  # fmt: skip
        self._rates = m.supports.start[1:]

    def again(self, motion: Motion, richer: ReducedModel) -> None:
        """Go on from a motion of before, on more vectors."""
        u, v, a = (richer.taken(self.model, x) for x in motion[:3])
        self.motion = motion._replace(u=u, v=v, a=a)
        self._take(richer)

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
            many, m = self.model.trained and q > self.model.size, self._reduced
            self._steps[dt] = Coordinates(m, n, self._joints) if many else reduced_step(m, n, q)
        done, turns, course = self._advance(self._steps[dt], factors, to)
        if done < len(row):
            return None
        self.iterations = max(self.iterations, turns)
        return Chunk(run, to, steps, course)

    def _advance(
        self, step: ReducedStep | Coordinates, factors: FloatArray, to: Recorder
    ) -> tuple[int, int, Course | None]:
        """Steps of a motion: number done, most iterations of one, the course of the supports."""
        if isinstance(step, Coordinates):
            done, turns, _ = step.run(self.motion, factors, to)
            return done, turns, None
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
