"""Load steps whose load is sought with the displacements: a control says how long a step is.

`R(du) = r + x push` and `C du = d + x drag` with the load parameter x unknown; each iteration
splits the correction in two, `dI` (what is out of balance) and `dII` (one unit of x), and the
control finds the x that makes `du + dI + x dII` as long as it asks (Batoz and Dhatt 1979).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.plasticity.bulk import Bulk
from ssilang.kernel.plasticity.newton import TOLERANCE, TURNS, BulkSolver, BulkTrial
from ssilang.kernel.plasticity.run import BulkRun
from ssilang.kernel.solvers.backends import factorise
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import Motion

SOFT = 1e7
"""Displacement under a unit of load over that of the first state, beyond which it is a collapse."""
SHIFT = 1e-9
"""Share of the greatest diagonal term that a matrix of collapse is held by; iterations undo it."""

BLURRED = 1e3
"""Correction of what is out of balance over the step, beyond which one more iteration is made."""


@dataclass(frozen=True, eq=False)
class Split:
    """A correction in its two parts.

    Attributes
    ----------
    start : array (n,)
        Displacement at the start of the step.
    du : array (n,)
        Increment so far.
    rest, unit : array (n,)
        Correction of what is out of balance, and for one unit of the load parameter.
    x : float
        Load parameter so far.
    """

    start: FloatArray
    du: FloatArray
    rest: FloatArray
    unit: FloatArray
    x: float = 0.0


Control = Callable[[Split, float], list[float]]
"""Load parameters x for which `du + rest + x unit` is as long as asked (a share of the step)."""


@dataclass(frozen=True, eq=False)
class Way:
    """What one unit of the load parameter adds: forces (n,), imposed values (n_rows,)."""

    push: FloatArray
    drag: FloatArray


@dataclass(frozen=True, eq=False)
class Found:
    """A step: increment, load parameter, iterations (0 or less: none found), residual."""

    du: FloatArray
    x: float
    turns: int
    residual: float
    trial: BulkTrial | None = None


class FollowingSolver(BulkSolver):
    """Newton's method on displacements and load parameter.

    Attributes
    ----------
    last : array (n,) or None
        Increment of the step before, which says what going on means.
    """

    last: FloatArray | None = None
    pace: float = 0.0
    """Change of the time for one unit of the load parameter, from `since` on."""
    since: float = 0.0
    softest: float = 0.0
    """Size of the first displacement under one unit of the load; far beyond it is a collapse."""

    def follow(
        self, motion: Motion, r: FloatArray, dd: FloatArray, way: Way, control: Control,
        share: float = 1.0, most: float = np.inf,
    ) -> Found:  # fmt: skip
        """A step as long as the control asks; commits joints and bodies if it converges.

        Started from the last increment, and from nothing where that leads nowhere. A step that
        goes beyond the load parameter `most` ends there.
        """
        lost = Found(np.zeros(len(r)), 0.0, 0, np.inf)
        starts = [np.zeros(len(r))] if self.last is None else [share * self.last, np.zeros(len(r))]
        for start in starts:
            lost = self._followed(motion, r, dd, way, control, share, start)
            if lost.turns > 0:
                break
        if lost.turns <= 0 and np.isfinite(most):
            # far beyond the end there may be nothing where the first iteration looks
            lost = self._followed(motion, r, dd, way, _within(control, most), share, starts[-1])
        if lost.turns > 0 and lost.x > most:
            start = lost.du * (most / lost.x)
            lost = self._followed(motion, r, dd, way, lambda s, _: [most - s.x], share, start)
        if lost.turns > 0:
            assert lost.trial is not None
            self._commit(motion, lost.trial.joints)
            answer = lost.trial.answer
            self.state, self.force, self.work = answer.state, answer.force, answer.work
        return lost

    def _followed(
        self, motion: Motion, r: FloatArray, dd: FloatArray, way: Way, control: Control,
        share: float, start: FloatArray,
    ) -> Found:  # fmt: skip
        x, du = 0.0, start
        self.time = self.since
        now = self._trial(motion, r, du, motion.contact)
        self.residuals = []
        for turn in range(1, TURNS + 1):
            missing = dd + x * way.drag - self.constraints.C @ du
            split = self._split(motion, now, x, missing, way)
            if split is None:
                return Found(du, x, 0, now.residual)
            found = self._chosen(motion, r, way, x, split, control(split, share))
            if found is None:
                return Found(du, x, -turn, now.residual)
            step, now = found
            x, du = x + step, now.du
            self.residuals.append(now.residual)
            if not np.isfinite(now.residual):
                break
            # a great part of the correction that the other one takes back leaves its rounding
            blurred = np.linalg.norm(split.rest) > BLURRED * np.linalg.norm(du)
            if (now.residual <= TOLERANCE and not blurred) or self._stalled():
                return Found(du, x, turn, now.residual, now)
        return Found(du, x, -len(self.residuals), now.residual)

    def standing(self, motion: Motion) -> BulkTrial:
        """The state as it is."""
        nothing = np.zeros(len(motion.u))
        return self._trial(motion, nothing, nothing, motion.contact)

    def _at(
        self, motion: Motion, r: FloatArray, way: Way, x: float, s: float, split: Split
    ) -> BulkTrial:
        du = split.du + split.rest + s * split.unit
        self.time = self.since + self.pace * (x + s)
        return self._trial(motion, r + (x + s) * way.push, du, motion.contact)

    def _split(
        self, motion: Motion, now: BulkTrial, x: float, missing: FloatArray, way: Way
    ) -> Split | None:
        T, V = self.constraints.T, self.constraints.V
        whole = self.A + now.K + self.share * now.answer.tangent
        reduced = sp.csr_array(V.T @ whole @ T)
        if now.answer.rate is not None and self.pace:
            way = Way(way.push - self.pace * now.answer.rate, way.drag)
        for shift in (0.0, SHIFT):
            parts = self._parts(reduced, whole, shift, now.rest, missing, way)
            if parts is None:
                continue
            size = float(np.linalg.norm(parts[1]))
            self.softest = self.softest or size
            if np.isfinite(size) and (shift or size <= SOFT * self.softest):
                return Split(motion.u, now.du, parts[0], parts[1], x)
        return None

    def _parts(
        self, reduced: sp.csr_array, whole: sp.csr_array, shift: float, rest: FloatArray,
        missing: FloatArray, way: Way,
    ) -> list[FloatArray] | None:  # fmt: skip
        """Both parts of the correction; None where the matrix, so shifted, has no factor."""
        T, V = self.constraints.T, self.constraints.V
        if shift:
            size = float(np.abs(reduced.diagonal()).max(initial=0.0))
            reduced = sp.csr_array(reduced + shift * size * sp.eye_array(reduced.shape[0]))
        try:
            factor = factorise(reduced, False, self.solver)
        except SingularFactorError:
            return None
        parts = []
        for force, imposed in ((rest, missing), (V.T @ way.push, way.drag)):
            known = self.constraints.particular(imposed)
            parts.append(known + T @ factor.solve(force - V.T @ (whole @ known)))
        return parts

    def _chosen(
        self, motion: Motion, r: FloatArray, way: Way, x: float, split: Split, found: list[float]
    ) -> tuple[float, BulkTrial] | None:
        """The parameter that leaves the least out of balance; at first, the one that goes on."""
        if len(found) > 1 and not split.du.any():
            before = split.unit if self.last is None else self.last
            along = [float(before @ (split.rest + s * split.unit)) for s in found]
            found = [found[int(np.argmax(along))]]
        trials = [(s, self._at(motion, r, way, x, s, split)) for s in found if np.isfinite(s)]
        return min(trials, key=lambda t: t[1].residual) if trials else None


def _within(control: Control, most: float) -> Control:
    """The control that does not go beyond a load parameter."""
    return lambda split, share: [min(x, most - split.x) for x in control(split, share)]


class PathRun:
    """A calculation along its path: what stands at the end of the last accepted step."""

    def __init__(self, run: BulkRun) -> None:
        if run.problem.contact:
            raise KernelError("kernel.plasticity.unilateral-relations-mini-maxi")
        self.run = run
        self.solver = FollowingSolver(run.problem, run.problem.K, 1.0, run.bulk, run.state)
        self.count, self.iterations, self.turns = 0, 0, 0
        self.energies = [run.motion.energies.copy()]
        size = run.problem.numbering.size
        self._first = self.solver.standing(run.motion)
        self._elastic = np.zeros(size)

    def head_for(self, change: FloatArray, pace: float = 0.0) -> None:
        """Load parameters count this change of load factors (k,) and of time from now on."""
        self.solver.pace = pace
        way, constraints = self.way(change), self.run.problem.constraints
        split = self.solver._split(
            self.run.motion, self._first, 0.0, np.zeros(len(constraints.C @ self._elastic)), way
        )
        self._elastic = np.zeros_like(self._elastic) if split is None else split.unit

    def elastic(self) -> FloatArray:
        """Displacement (n,) of the structure as it was at the start for one unit of the load."""
        return self._elastic

    def way(self, factors: FloatArray) -> Way:
        """What a change of the load factors (k,) adds."""
        loading = self.run.problem.loading
        return Way(loading.forces @ factors, loading.imposed @ factors)

    def settle(self, factors: FloatArray) -> None:
        """Reactions of the state as it is."""
        run = self.run
        run.motion.reaction[:] = run.imbalance(self.solver.force, factors)

    def step(
        self, factors: FloatArray, change: FloatArray, control: Control, share: float, time: float,
        most: float = np.inf,
    ) -> float | None:  # fmt: skip
        """One step: load parameter x of `factors + x change`; None if none is found."""
        run, p, m = self.run, self.run.problem, self.run.motion
        self.solver.since = time
        r = -run.imbalance(self.solver.force, factors)
        dd = p.loading.imposed @ factors - p.constraints.C @ m.u
        found = self.solver.follow(m, r, dd, self.way(change), control, share, most)
        if found.turns <= 0 or not np.isfinite(found.du).all():
            return None
        self.solver.last = found.du / share
        run.accept(self.solver, found.du, factors, factors + found.x * change, m.contact)
        self.energies.append(m.energies.copy())
        self.turns = found.turns
        self.iterations = max(self.iterations, found.turns)
        return found.x

    def save(self, time: float) -> None:
        """Hand the state to all observers."""
        run = self.run
        snapshot = replace(run.snapshot(0), step=self.count, time=time)
        for observer in run.observers:
            if self.count > 0 or observer.wanted[0]:
                observer.receive(snapshot)
        self.count += 1


def no_bodies(problem: Problem) -> Bulk:
    """Bodies of a problem that has none beyond its matrices."""
    return Bulk((), (), problem.numbering.size)
