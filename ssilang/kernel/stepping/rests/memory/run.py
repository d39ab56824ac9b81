"""Time integration of what stands on a ground whose memory is known.

The ground's part of a step is its compliance and the motion that past forces and loads bring: both
act on the jumps. All else is stepped as it is, by the loop of large problems, a step at a time.
"""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import SINGLE, BoolArray, FloatArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.threads import begun
from ssilang.kernel.solvers.low_rank import LowRank, low_rank
from ssilang.kernel.stepping.choose import Choice, only
from ssilang.kernel.stepping.effective import Effective, effective_matrix, effective_of
from ssilang.kernel.stepping.extremes import Extremes
from ssilang.kernel.stepping.newmark import Newmark, advanced
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.memory.ground import Ground, Parts, alike, parts_of
from ssilang.kernel.stepping.rests.memory.kernels import (
    Kernels,
    increments,
    kernels_of,
    with_loads,
)
from ssilang.kernel.stepping.rests.memory.past import Past
from ssilang.kernel.stepping.rests.reduced.basis import NoReduction, Reduction, refuse_reduction
from ssilang.kernel.stepping.rests.sparse.interleaved import (
    InterleavedLoop,
    PreparedBlock,
    Seen,
    fits,
)
from ssilang.kernel.stepping.rests.sparse.interleaved_loop import run_interleaved, sweep_of
from ssilang.kernel.stepping.run import History, Integration, Progress
from ssilang.kernel.stepping.snapshot import Observer
from ssilang.kernel.stepping.state import ELASTIC, EXTERNAL, Motion, Outcome, Recorder
from ssilang.kernel.stepping.times import SAME
from ssilang.kernel.stepping.track import Track

SHARE = 0.1  # of the tolerance: what stages of kernels leave out
TRIES = 3  # of smaller and smaller shares
KEPT = 0.97  # of an alternating velocity, in a step
NOW, BEFORE = 0.25 * (3.0 + KEPT), -0.25 * (1.0 - KEPT)  # so that slow motions have the scheme's
MANY = 1000  # jumps beyond which blocks of their compliance are read
SOFT = 10.0  # stiffness of their joints times compliance, up to which directions are iterated
FEW = 2e-3  # of the compliance: what few vectors of a block leave out
ALL, LEFT = 1e-2, 1e-3  # of the tolerance of kernels: the same of all vectors, residual of jumps
EXACT = 1e-9  # of the building's compliance: what is left out is forces that are not there
LOOKED_AT = 160  # steps over which kernels are compared with the ground itself


class MemoryLoop(InterleavedLoop):
    """Steps of a problem on a ground that is remembered."""

    def __init__(
        self, parts: Parts, motion: Motion, effective: Effective, kernels: Kernels
    ) -> None:
        p = parts.near
        self.S = kernels.compliance(parts.ground.newmark)
        """The ground's compliance."""
        past = begun(lambda: Past(kernels, parts.ground.loading[1], len(p.times) - 1))
        super().__init__(p, motion, replace(effective, S=effective.S + self.S))
        self.parts = parts
        if len(self.S) > MANY:
            self._use_blocks(effective, kernels.tolerance)
        self.start = motion.f.copy()
        self.past = past()
        self.at = motion.delta - self.J @ self._folded(motion.u)
        """The ground's part (q,) of the jumps: what the building's is not."""
        self.moved = np.zeros((3, len(self.at)))
        """How far that is from the start, its velocity and acceleration."""
        self.steps = np.zeros((2, len(self.at)))
        """Last increments of the first two."""
        self.largest = 0.0
        """Jump so far."""

    def _use_blocks(self, effective: Effective, tolerance: float) -> None:
        """In place of what is read in each step, where that is symmetric and large.

        Directions are rough ones then, and what is left of a step is taken to the next one.
        """
        plan, S, root = self.plan, self.plan.condensed.S, effective.root
        assert root is not None  # else nothing fits
        if self.parts.near.interface.is_soft(S, SOFT):
            blocks = self._blocks(S.astype(SINGLE), FEW, ALL * tolerance)
            condensed = plan.condensed._replace(blocks=blocks, tolerance=LEFT * tolerance)
            plan = plan._replace(condensed=condensed)
        at, data = root.J.indices, root.J.data
        one = (np.diff(root.J.indptr) == 1).all()  # unknown of each jump
        if one and np.array_equal(np.sort(at), np.arange(root.J.shape[1])):
            blocks = self._blocks(root.Y[at] / data, EXACT, EXACT)
            blocks = blocks._replace(order=at[blocks.order].astype(np.int64))
            plan = plan._replace(Yr=root.Y[:0], blocks=blocks)
        self.plan = plan

    def _blocks(self, A: FloatArray, few: float, least: float) -> LowRank:
        size = float(np.linalg.norm(A, np.inf))
        return low_rank(A, self.parts.ground.places, few * size, least * size)

    def stepped(self, block: PreparedBlock, kept: Recorder) -> Outcome:
        """Each step of a block: the ground's motion under old forces, then all together."""
        x, n, worst, loads = block.motion, block.plan.newmark, 0, block.factors.shape[1] + 1
        # one load more, which acts on nothing but the jumps: a step's own motion of the ground,
        # by an increment of one in each step
        lift = np.zeros((len(x.f), loads))
        forces = np.vstack([block.plan.forces, np.zeros(len(x.u))])
        plan = block.plan._replace(forces=forces, lift=lift)
        products = block.products._replace(loads=np.append(block.products.loads, 0.0))
        sweep, steps = sweep_of(plan, len(x.u), loads), np.arange(len(block.factors), dtype=float)
        factors = np.column_stack([block.factors, steps])
        to = kept._replace(work=np.zeros((2, len(kept.row), loads)))
        self._ground = np.zeros((len(kept.row), *self.moved.shape))
        for k in range(len(kept.row)):
            before = x.f.copy()
            brought = lift[:, -1] = self.past.next(before - self.start) - self.newton.trial.r
            _, turns, residual = run_interleaved(
                plan, self.joints, x, products, sweep, self.newton, factors, to, k - (k == 0), k + 1
            )
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            at = x.delta - self.J @ x.u
            step, self.at = at - self.at, at
            self._move(step, n)
            self._ground[k] = self.moved
            self.largest = max(self.largest, float(np.abs(x.delta).max()))
            x.energies[ELASTIC] += 0.5 * (self.at - (k + 1) * brought) @ x.f
            x.energies[EXTERNAL] += 0.5 * (before + x.f) @ step
            kept.energies[k] = x.energies
        return len(kept.row), worst, 0.0

    def _move(self, step: FloatArray, n: Newmark) -> None:
        """How far the ground has moved, with its velocity and acceleration.

        Those of schemes without numerical damping keep errors for ever, with alternating sign:
        here they are forgotten, with what alternates besides.
        """
        self.moved[0] += step
        if n.v_v != -1.0:
            self.moved[1:] = advanced(n, step, self.moved[1], self.moved[2])
            return
        for i in (1, 2):
            rate = 2.0 / n.dt * (NOW * step + BEFORE * self.steps[i - 1]) - KEPT * self.moved[i]
            self.steps[i - 1], step = step, rate - self.moved[i]
            self.moved[i] = rate

    def put(
        self, block: PreparedBlock, kept: Recorder, to: Recorder, first: int, done: int, seen: Seen
    ) -> None:
        """Kept instants, the ground's side of the joints with them."""
        super().put(block, kept, to, first, done, seen)
        rows, back = self.parts.rows, self.parts.back
        whole, tapped = (np.flatnonzero(x.row[:done] >= 0) for x in (kept, kept.tap))
        mine = np.flatnonzero(np.isin(seen.unknowns, rows))
        at = np.searchsorted(rows, seen.unknowns[mine])
        for i, name in enumerate(("u", "v", "a")):
            start = self.problem.u[rows] if name == "u" else np.zeros(len(rows))
            moved = start + (back @ self._ground[:, i].T).T
            getattr(to, name)[np.ix_(to.row[first + whole], rows)] = moved[whole]
            getattr(to.tap, name)[np.ix_(to.tap.row[first + tapped], mine)] = moved[tapped][:, at]


class Shelf(Protocol):
    """Where a memory stands."""

    @property
    def name(self) -> str:
        """As messages call it."""

    @property
    def there(self) -> bool:
        """Whether anything stands there."""

    def read(self) -> Kernels | None:
        """What stands there, None for nothing."""

    def held(self) -> AbstractContextManager[None]:
        """Nobody else writes meanwhile."""

    def answered(
        self, name: str, shape: tuple[int, int], rows: Iterator[FloatArray]
    ) -> Iterator[FloatArray]:
        """Rows of a name, or those that a making which was broken off left under it."""

    def write(self, kernels: Kernels) -> None:
        """Put it in the place of what stands there."""


RULE = replace(
    only("dissection")[0], name="memory", loop="memory", when="the ground is remembered",
    said="kernel.stepping.loop-memory",
)  # fmt: skip


@dataclass(eq=False)
class MemoryIntegration(Integration):
    """An integration whose loop is that of a ground's memory."""

    parts: Parts = field(kw_only=True)
    effective: Effective = field(kw_only=True)
    kernels: Kernels = field(kw_only=True)

    @property
    def stepped(self) -> int:
        """What stands on the ground."""
        return self.problem.constraints.T.shape[1]

    def prepare(self, inside: bool) -> None:
        """See what observers want; the loop compares no largest values."""
        super().prepare(inside=False)

    def _choice(self, dt: float) -> Choice:
        """One loop for all steps, that has the past."""
        if not self._choices:
            self.loop = MemoryLoop(self.parts, self.motion, self.effective, self.kernels)
            self._choices[dt] = Choice(RULE, self.loop, self.effective.inverse.factor.name)
        return next(iter(self._choices.values()))


_KEPT: list[Kernels] = []
"""The memory of the last ground: runs that are forks of this one have it."""


def on_memory(
    problem: Problem, tolerance: float, shelf: Shelf, observers: Sequence[Observer] = (),
    progress: Progress | None = None,
) -> Callable[[], History]:  # fmt: skip
    """The integration of a problem on a ground whose memory stands on a shelf, ready to run.

    The memory is made where it is not there; the first motion on it runs twice, for its error.

    Raises
    ------
    NoReduction
        If there is no such ground, or the tolerance is not reached.
    KernelError
        If what stands on the shelf is the memory of another ground, or of another step.
    ConvergenceError, SingularMatrixError
        See `integrate`.
    """
    refuse_reduction(problem)
    started, share = time.perf_counter(), SHARE
    parts = parts_of(problem, _asked(problem, observers))
    near, dt = parts.near, parts.ground.dt
    A, end = effective_matrix(near, dt), 1.0 - near.scheme.alpha_f
    effective = effective_of(near, A, dt, end, least=0)
    if not fits(near, effective) or effective.R.any():
        raise NoReduction("kernel.stepping.memory-without-mass")
    motion = partial(MemoryIntegration, near, parts=parts, effective=effective)
    for _ in range(TRIES):
        kernels = _memory(parts.ground, share * tolerance, shelf, progress)
        if np.isnan(kernels.estimate):
            first = motion((), progress, kernels=kernels)
            first.run()
            kernels = replace(kernels, estimate=_looked_at(parts.ground, first.loop))
            with shelf.held():
                shelf.write(kernels)
            _KEPT[:] = [kernels]
        if kernels.estimate <= tolerance:
            break
        share *= 0.5 * tolerance / kernels.estimate
    else:
        raise NoReduction("kernel.stepping.memory-inexact", estimate=kernels.estimate)
    run = motion(observers, progress, kernels=kernels)
    prepared = time.perf_counter() - started

    def integrated() -> History:
        history = run.run()
        history.reduction = Reduction(kernels.vectors, kernels.estimate, None, prepared)
        return history

    return integrated


def _asked(problem: Problem, observers: Sequence[Observer]) -> BoolArray:
    """Unknowns (n,) of which some observer wants results."""
    asked = np.zeros(problem.numbering.size, bool)
    for observer in observers:
        if isinstance(observer, Extremes):
            asked |= observer.asked
        elif isinstance(observer, Track):
            asked[observer.unknowns] = True
        else:
            asked |= bool(observer.wanted.any())
    return asked


def _memory(ground: Ground, tolerance: float, shelf: Shelf, progress: Progress | None) -> Kernels:
    """The memory of a ground for its motion, as it is known or made."""
    dt, steps = ground.dt, len(ground.problem.times) - 1
    if np.abs(np.diff(ground.problem.times) - dt).max() > SAME * dt * steps:
        raise NoReduction("kernel.stepping.memory-steps-differ")
    with shelf.held():
        known = [k for k in _KEPT if alike(k.mark, ground.mark)] if shelf.there else []
        found = known[0] if known else shelf.read()
        if found is not None and abs(found.dt - dt) > SAME * dt * steps:
            code = "kernel.stepping.memory-of-another-step"
            raise KernelError(code, name=shelf.name, dt=found.dt, step=dt)
        if found is not None and not alike(found.mark, ground.mark):
            raise KernelError("kernel.stepping.memory-of-another-ground", name=shelf.name)
        if found is None or found.tolerance > tolerance or 0 < found.reach < steps:
            found = kernels_of(ground, tolerance, steps, shelf.answered, progress)
            shelf.write(found)
        elif (more := with_loads(found, ground, steps, shelf.answered, progress)) is not found:
            found = more
            shelf.write(found)
    _KEPT[:] = [found]
    return found


def _looked_at(ground: Ground, loop: MemoryLoop) -> float:
    """What kernels miss of the ground's motion, of the largest jump of a run.

    The ground itself is stepped under the forces of the run, over the steps in which these changed
    most, from rest.
    """
    past, own = loop.past, ground.steps
    forces = past.forces[past.pad : past.pad + past.done]
    changes = np.abs(np.diff(forces, axis=0)).sum(axis=1)
    length = min(LOOKED_AT, len(changes))
    if not length:
        return 0.0  # one step, before which no force has changed
    first = int(np.argmax(np.convolve(changes, np.ones(length), "valid")))
    part = slice(first, first + length + 1)
    f, c = forces[part] - forces[first], past.loads[part] - past.loads[first]
    pushed = own.forces @ np.diff(c, axis=0).T - own.J.T @ np.diff(f, axis=0).T
    exact = increments(own, (np.ascontiguousarray(x[:, None]) for x in pushed.T))
    known, away, largest = Past(past.kernels, c, length), np.zeros(f.shape[1]), 0.0
    for k, moved in enumerate(exact):
        step = known.next(f[k]) - loop.S @ (own.newmark.end * (f[k + 1] - f[k]))
        away += step - moved[:, 0]
        largest = max(largest, float(np.abs(away).max()))
    return largest / max(loop.largest, 1e-300)
