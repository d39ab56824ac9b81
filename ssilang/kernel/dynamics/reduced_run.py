"""Time integration of a reduced model whose error is estimated and held below a tolerance.

Two nested bases run the same motion. Their difference, largest over jumps of all steps and over
the whole field at instants spread over the motion, relative to the largest jump and displacement,
is the estimate; while it exceeds the tolerance the basis grows. The richer basis gives the
results. The estimate is that of the poorer basis and holds as long as the richer one is nearer to
the whole model (which is the assumption; it is no strict bound). Between the instants compared
the field's error may be somewhat larger (a factor of 2 has been seen).
"""

from __future__ import annotations

import hashlib
import math
import time
from collections import OrderedDict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ssilang.kernel.dynamics.compiled_loop import N_ENERGIES, Joints, Motion
from ssilang.kernel.dynamics.initial import (
    admissible_velocity,
    initial_energies,
    joint_state,
)
from ssilang.kernel.dynamics.integrate import History, Integration, Progress, integrate
from ssilang.kernel.dynamics.modal_loop import Modal, ModalRows, ModalStep, march_modal
from ssilang.kernel.dynamics.motion import snapshot_of
from ssilang.kernel.dynamics.plan import SAME, Run, runs_of
from ssilang.kernel.dynamics.problem import Problem
from ssilang.kernel.dynamics.reduction import (
    Basis,
    NoReduction,
    ReducedModel,
    Reduction,
    refuse_reduction,
)
from ssilang.kernel.dynamics.snapshot import Observer, Snapshot
from ssilang.kernel.errors import KernelError
from ssilang.kernel.joints.response import interface_forces
from ssilang.kernel.mesh.nodes import FloatArray, IntArray

INSTANTS = 64  # at which whole fields are compared
SPARSER = 8  # velocities and accelerations at one of so many of them
CHUNK, LONGEST = 256, 4096  # steps to the first comparison, between the last ones
GROWTH = 1.2  # a basis is compared with one that is this much smaller, or more
MOST_VECTORS = 0.5  # of the unknowns: more do not pay
MOST = 4000  # vectors, for memory
MOST_VALUES = 30_000_000  # reduced states kept until the estimate is known
BATCH = 64  # instants expanded together
PAIRS_KEPT = 2  # models whose bases stay in memory


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
        self._modal = Modal(m.m, m.c, m.k, m.J, Jt, np.ascontiguousarray(m.forces), scheme)
        self._joints = _joints(p)
        self._steps: dict[float, ModalStep] = {}

    def advance(self, run: Run) -> Chunk | None:
        """The steps of a run; None if one of them did not converge."""
        chosen = self.kept[run.first + 1 : run.last + 1]
        save = np.where(chosen, np.cumsum(chosen) - 1, -1).astype(np.int64)
        rows = self._room(run.last - run.first, int(chosen.sum()))
        factors = self.problem.loading.at(self.problem.times[run.first : run.last + 1])
        history = self.energies[run.first + 1 : run.last + 1]
        done, turns, _ = march_modal(
            self._modal, self._step(run.dt), self._joints, self.motion, factors, save, rows, history
        )
        if done < run.last - run.first:
            return None
        self.iterations = max(self.iterations, turns)
        return Chunk(run, rows, run.first + 1 + np.flatnonzero(chosen))

    def _room(self, steps: int, rows: int) -> ModalRows:
        m, r = self.motion, self.model.size
        u, v, a = (np.zeros((rows, r)) for _ in range(3))
        w, t = np.zeros((rows, *m.w.shape)), np.zeros((rows, *m.t.shape))
        return ModalRows(
            np.zeros((steps, *m.w.shape)), u, v, a, w, t, np.zeros((rows, *m.state.shape))
        )

    def _step(self, dt: float) -> ModalStep:
        dt = next((known for known in self._steps if abs(known - dt) <= SAME * dt), dt)
        if dt not in self._steps:
            s, m = self.problem.scheme, self.model
            A = (1 - s.alpha_m) / (s.beta * dt**2) * m.m + (1 - s.alpha_f) * m.k
            A += (1 - s.alpha_f) * s.gamma / (s.beta * dt) * m.c
            self._steps[dt] = ModalStep(dt, 1.0 / A, np.ascontiguousarray((m.J / A) @ m.J.T))
        return self._steps[dt]


def _joints(problem: Problem) -> Joints:
    """Interface arrays without the rows of J, which reduced vectors replace."""
    joints = problem.interface
    nothing = np.zeros((0, 0))
    if joints is None:
        pairs, none = np.zeros((0, 1), dtype=np.int64), np.zeros(0, dtype=np.int64)
        return Joints(nothing, pairs, np.zeros((0, 1, 1)), np.zeros(0), none, nothing)
    return Joints(
        nothing, joints.pairs, joints.B, joints.weights, joints.codes,
        np.ascontiguousarray(joints.parameters),
    )  # fmt: skip


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


@dataclass(eq=False)
class Pair:
    """Two nested models on a basis that may grow."""

    basis: Basis
    poor: ReducedModel
    rich: ReducedModel

    def grow(self) -> None:
        """The richer model becomes the poorer of the next pair."""
        self.poor = self.rich
        self.rich = _grown(self.basis, GROWTH * self.poor.size)


def _grown(basis: Basis, wanted: float) -> ReducedModel:
    while basis.size < wanted:
        before = basis.size
        basis.grow()
        if basis.size == before:
            raise NoReduction("the Krylov space is exhausted")
    return basis.model()


_PAIRS: OrderedDict[str, Pair] = OrderedDict()


def _pair_of(problem: Problem, tolerance: float) -> Pair:
    """The pair of a problem, kept for the next motion on the same model."""
    key = f"{_name_of(problem)} {tolerance:g}"
    if key in _PAIRS:
        _PAIRS.move_to_end(key)
        return _PAIRS[key]
    largest = min(int(MOST_VECTORS * problem.constraints.T.shape[1]), MOST)
    basis = Basis(problem, _step_of(problem), largest)
    poor = _grown(basis, basis.size)
    pair = Pair(basis, poor, _grown(basis, GROWTH * poor.size))
    _PAIRS[key] = pair
    while len(_PAIRS) > PAIRS_KEPT:
        _PAIRS.popitem(last=False)
    return pair


def _step_of(problem: Problem) -> float:
    return float(np.median(np.diff(problem.times)))


def _name_of(problem: Problem) -> str:
    """A digest of all that the basis is made of."""
    p, digest = problem, hashlib.sha256()
    sparse = [p.K, p.M, p.C, p.constraints.T]
    dense = [p.loading.forces, p.u, p.v, p.state, p.loading.at(p.times[:1]), p.times[:1]]
    if p.interface is not None:
        sparse.append(p.interface.J)
        dense += [p.interface.parameters, p.interface.weights, p.interface.B]
    for A in sparse:
        for part in (A.indptr, A.indices, A.data):
            digest.update(np.ascontiguousarray(part).tobytes())
    for x in dense:
        digest.update(np.ascontiguousarray(x).tobytes())
    return f"{digest.hexdigest()} {_step_of(p):.9g}"


@dataclass(eq=False)
class ReducedIntegration:
    """A reduced run under way: the pair grows until the estimate is below the tolerance."""

    problem: Problem
    observers: Sequence[Observer]
    progress: Progress | None
    tolerance: float

    def run(self) -> History:
        """All steps.

        Raises
        ------
        NoReduction
            If the tolerance is out of reach.
        """
        started = time.perf_counter()
        p = self.problem
        wanted = np.zeros(len(p.times), bool)
        for observer in self.observers:
            wanted |= observer.wanted
        pair = _pair_of(p, self.tolerance)
        while True:
            built = time.perf_counter()
            rich, difference, chunks = self._both(pair, wanted)
            estimate = difference.estimate if difference else math.inf
            if difference is not None and estimate <= self.tolerance:
                break
            try:
                pair.grow()
            except NoReduction as reason:
                raise NoReduction(f"{reason} (estimated error {estimate:.1e})") from None
        self._hand_over(pair.rich, wanted, chunks)
        return History(
            p.times, rich.energies, rich.iterations, "none", "reduced",
            time.perf_counter() - built,
            Reduction(
                pair.rich.size, estimate, "", built - started, *difference.relative[3:].tolist()
            ),
        )  # fmt: skip

    def _both(
        self, pair: Pair, wanted: np.ndarray
    ) -> tuple[Trace, Difference | None, list[Chunk] | None]:
        """Both models over the motion, as long as they agree: the rich one, difference, chunks.

        The difference is None if one of them did not converge, the chunks if they do not fit.
        """
        p, n = self.problem, len(self.problem.times)
        sampled = np.zeros(n, bool)
        sampled[np.unique(np.linspace(1, n - 1, INSTANTS).round().astype(int))] = True
        fits = 3 * pair.rich.size * int(wanted.sum()) <= MOST_VALUES
        poor = Trace(p, pair.poor, sampled)
        rich = Trace(p, pair.rich, sampled | wanted if fits else sampled)
        difference, chunks = Difference(p), []
        for run in comparing(p.times):
            a = poor.advance(run)
            b = rich.advance(run) if a is not None else None
            if a is None or b is None:
                return rich, None, None
            difference.take(poor, rich, a, b)
            if not difference.estimate <= self.tolerance:
                return rich, difference, None
            chunks.append(replace(b, rows=b.rows._replace(jumps=b.rows.jumps[:0])))
            if self.progress is not None:
                self.progress(run.last, n - 1)
        return rich, difference, chunks if fits else None

    def _hand_over(
        self, model: ReducedModel, wanted: np.ndarray, chunks: list[Chunk] | None
    ) -> None:
        """Saved instants, as whole fields; steps run again if their states did not fit memory."""
        p = self.problem
        if wanted[0]:
            self._receive(snapshot_of(p, Integration(p).motion, 0))
        source: Iterable[Chunk] = chunks if chunks is not None else self._again(model, wanted)
        for chunk in source:
            rows = np.flatnonzero(wanted[chunk.steps])
            for start in range(0, len(rows), BATCH):
                for snapshot in expanded(p, model, chunk, rows[start : start + BATCH]):
                    self._receive(snapshot)

    def _again(self, model: ReducedModel, wanted: np.ndarray) -> Iterator[Chunk]:
        trace = Trace(self.problem, model, wanted)
        for run in comparing(self.problem.times):
            chunk = trace.advance(run)
            assert chunk is not None
            yield chunk

    def _receive(self, snapshot: Snapshot) -> None:
        for observer in self.observers:
            if observer.wanted[snapshot.step]:
                observer.receive(snapshot)


def expanded(
    problem: Problem, model: ReducedModel, chunk: Chunk, rows: IntArray
) -> Iterator[Snapshot]:
    """Whole fields of some rows of a chunk, with the reactions that their balance asks for."""
    p, x = problem, chunk.rows
    u, v, a = (model.expand(part[rows].T) for part in (x.u, x.v, x.a))
    steps = chunk.steps[rows]
    rest = p.M @ a + p.C @ v + p.K @ u - p.loading.forces @ p.loading.at(p.times[steps]).T
    joints = p.interface
    if joints is not None:
        f = np.zeros((len(rows), joints.size))
        for i, row in enumerate(rows):
            interface_forces(joints.pairs, joints.B, joints.weights, x.t[row], f[i])
        rest = rest + joints.J.T @ f.T
    for i, (row, step) in enumerate(zip(rows, steps.tolist(), strict=True)):
        yield Snapshot(
            p, step, float(p.times[step]), u[:, i].copy(), v[:, i].copy(), a[:, i].copy(),
            rest[:, i].copy(), x.w[row], x.t[row], x.state[row], np.zeros(0),
        )  # fmt: skip


def integrate_reduced(
    problem: Problem,
    tolerance: float,
    observers: Sequence[Observer] = (),
    progress: Progress | None = None,
) -> History:
    """Integrate a problem on a reduced basis, or as it is where that does not serve.

    Parameters
    ----------
    tolerance : float
        Largest estimated error of displacements and jumps, relative to the largest of the
        motion, between 0 and 1.

    Returns
    -------
    History
        `reduction` says the number of vectors and the estimated error, or why the whole model
        was run: the damping is not proportional, or more than half the unknowns would be needed.

    Raises
    ------
    KernelError
        For a tolerance out of range, unilateral relations, moving supports, adaptive or
        conserving steps.
    ConvergenceError, SingularMatrixError
        See `integrate`.
    """
    if not 0.0 < tolerance < 1.0:
        raise KernelError(f"the tolerance of the reduction is {tolerance:g}", "between 0 and 1")
    refuse_reduction(problem)
    started = time.perf_counter()
    try:
        history = ReducedIntegration(problem, observers, progress, tolerance).run()
    except NoReduction as reason:
        spent = time.perf_counter() - started
        history = integrate(problem, observers, progress)
        history.reduction = Reduction(refused=str(reason), prepared=spent)
        return history
    for observer in observers:
        observer.close()
    return history
