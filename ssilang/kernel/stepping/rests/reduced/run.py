"""Time integration of a reduced model whose error is estimated and held below a tolerance.

Two nested bases run the same motion. Their difference, largest over jumps of all steps and over
the whole field at instants spread over the motion, relative to the largest jump and displacement,
is the estimate; while it exceeds the tolerance the basis grows. The richer basis gives the
results. The estimate is that of the poorer basis and holds as long as the richer one is nearer to
the whole model (which is the assumption; it is no strict bound). Between the instants compared
the field's error may be somewhat larger (a factor of 2 has been seen).
"""

import math
import time
from collections import OrderedDict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.keeping import digest
from ssilang.kernel.stepping.problem.problem import Problem, reactions
from ssilang.kernel.stepping.rests.reduced.basis import (
    Basis,
    NoReduction,
    ReducedModel,
    Reduction,
    refuse_reduction,
)
from ssilang.kernel.stepping.rests.reduced.trace import Chunk, Difference, Trace, comparing
from ssilang.kernel.stepping.run import History, Integration, Progress, integrate
from ssilang.kernel.stepping.snapshot import Observer, Snapshot
from ssilang.kernel.stepping.state import closed_tap
from ssilang.kernel.stepping.track import Rows, View

if TYPE_CHECKING:
    from ssilang.kernel.stepping.rests.memory.run import Shelf

INSTANTS = 64  # at which whole fields are compared
GROWTH = 1.2  # a basis is compared with one that is this much smaller, or more
MOST_VECTORS = 0.5  # of the unknowns: more do not pay
MOST = 4000  # vectors, for memory
MOST_VALUES = 30_000_000  # reduced states kept until the estimate is known
LIFTED = 0.5  # share of the joints' points that opens at once: from there on motions may amplify
BATCH = 64  # instants expanded together
PAIRS_KEPT = 2  # models whose bases stay in memory


@dataclass(eq=False)
class Pair:
    """Two nested models on a basis that may grow."""

    basis: Basis
    poor: ReducedModel
    rich: ReducedModel

    def grow(self) -> None:
        """The richer model becomes the poorer of the next pair.

        The last pair is what room is left for, and the first vectors of it.

        Raises
        ------
        NoReduction
            If there is none; nothing changes.
        """
        basis = self.basis
        try:
            self.poor, self.rich = self.rich, _grown(basis, GROWTH * self.rich.size)
        except NoReduction:
            if basis.size == self.rich.size:
                raise
            self.poor, self.rich = basis.model(int(basis.size / GROWTH)), basis.model()


def _grown(basis: Basis, wanted: float) -> ReducedModel:
    while basis.size < wanted:
        before = basis.size
        basis.grow()
        if basis.size == before:
            raise NoReduction("kernel.stepping.krylov-exhausted")
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
    p, sparse = problem, list[sp.csr_array]()
    dense = [p.loading.forces, p.u, p.v, p.state, p.loading.at(p.times[:1]), p.times[:1]]
    if p.loading.imposed.any():
        sparse.append(p.constraints.C)
        dense += [p.loading.imposed, p.loading.at(p.times[:2])]
    sparse += [p.K, p.M, p.C, p.constraints.T]
    if p.interface is not None:
        sparse.append(p.interface.J)
        dense += [p.interface.parameters, p.interface.weights, p.interface.B]
    return f"{digest(sparse, dense)} {_step_of(p):.9g}"


@dataclass(eq=False)
class ReducedIntegration:
    """A reduced run under way: the pair grows until the estimate is below the tolerance."""

    problem: Problem
    observers: Sequence[Observer]
    progress: Progress | None
    tolerance: float
    lifted: float = 0.0

    def run(self) -> History:
        """All steps.

        Raises
        ------
        NoReduction
            If the tolerance is out of reach.
        """
        started = time.perf_counter()
        p = self.problem
        given = Integration(p, self.observers)
        given.prepare(inside=False)
        wanted = given.wanted | given.taps.wanted
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
                raise NoReduction(
                    "kernel.stepping.reduction-inexact", reason=reason, estimate=estimate
                ) from None
        given.begin()
        swing = self._swing(pair.poor) if self.lifted > LIFTED else 0.0
        self._hand_over(pair.rich, given, wanted, chunks)
        return History(
            p.times, rich.energies, rich.iterations, "none", "reduced",
            time.perf_counter() - built,
            Reduction(
                pair.rich.size, estimate, None, built - started,
                *[*difference.relative[3:].tolist(), swing],
            ),
        )  # fmt: skip

    @property
    def _sampled(self) -> np.ndarray:
        """Instants (n_times,) at which whole fields are compared."""
        n = len(self.problem.times)
        return np.isin(np.arange(n), np.linspace(1, n - 1, INSTANTS).round())

    def _both(
        self, pair: Pair, wanted: np.ndarray
    ) -> tuple[Trace, Difference | None, list[Chunk] | None]:
        """Both models over the motion, as long as they agree: the rich one, difference, chunks.

        The difference is None if one of them did not converge, the chunks if they do not fit.
        """
        p, n, sampled = self.problem, len(self.problem.times), self._sampled
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
            opened = np.mean(b.rows.jumps[:, :, -1] > 0.0, axis=1) if p.interface else np.zeros(1)
            self.lifted = max(self.lifted, float(opened.max()))
            if not difference.estimate <= self.tolerance:
                return rich, difference, None
            chunks.append(replace(b, rows=b.rows._replace(jumps=b.rows.jumps[:0])))
            if self.progress is not None:
                self.progress(run.last, n - 1)
        return rich, difference, chunks if fits else None

    def _swing(self, model: ReducedModel) -> float:
        """How far loads that are stronger by the tolerance move the motion, as `Difference`."""
        p, difference = self.problem, Difference(self.problem)
        last = np.arange(len(p.times)) == len(p.times) - 1
        stronger, plain = (Trace(p, model, last, s) for s in (1.0 + self.tolerance, 1.0))
        for run in comparing(p.times):
            a, b = stronger.advance(run), plain.advance(run)
            if a is None or b is None:
                return math.inf
            difference.take(stronger, plain, a, b)
        return difference.estimate

    def _hand_over(
        self, model: ReducedModel, given: Integration, wanted: np.ndarray,
        chunks: list[Chunk] | None,
    ) -> None:  # fmt: skip
        """Saved instants, as whole fields or rows; steps run again if their states did not fit."""
        p, unknowns = self.problem, given.taps.unknowns
        moved = sp.csr_array(model.supports.columns.X)
        expansion = Expansion(model.T, model.basis, model.X, moved)[unknowns]
        source: Iterable[Chunk] = chunks if chunks is not None else self._again(model, wanted)
        for chunk in source:
            taken = np.flatnonzero(given.taps.wanted[chunk.steps])
            if len(taken):
                given.taps.give(rows_of_chunk(p, expansion, unknowns, chunk, taken))
            rows = np.flatnonzero(given.wanted[chunk.steps])
            for start in range(0, len(rows), BATCH):
                for snapshot in expanded(p, model, chunk, rows[start : start + BATCH]):
                    given.hand_over(snapshot)

    def _again(self, model: ReducedModel, wanted: np.ndarray) -> Iterator[Chunk]:
        trace = Trace(self.problem, model, wanted)
        for run in comparing(self.problem.times):
            chunk = trace.advance(run)
            assert chunk is not None
            yield chunk


@dataclass(frozen=True, eq=False)
class Expansion:
    """Unknowns from coordinates of a model, and the motions of its supports."""

    T: sp.csr_array  # (p, c) of the motions y that these unknowns need
    basis: FloatArray  # (r, c)
    X: FloatArray  # (r, r)
    moved: sp.csr_array  # (p, m) motions of the supports

    @property
    def shape(self) -> tuple[int, int]:
        """p, and coordinates and supports together."""
        return self.T.shape[0], len(self.X) + self.moved.shape[1]

    def __getitem__(self, places: IntArray | slice) -> "Expansion":
        T = self.T[places]
        at = np.unique(T.indices)
        return Expansion(sp.csr_array(T[:, at]), self.basis[:, at], self.X, self.moved[places])

    def __call__(self, z: FloatArray) -> FloatArray:
        """Rows (k, p) of rows (k, r + m)."""
        r = len(self.X)
        found: FloatArray = (self.T @ (self.basis.T @ (self.X @ z[:, :r].T))).T
        if self.moved.shape[1]:
            found = found + (self.moved @ z[:, r:].T).T
        return found


def rows_of_chunk(
    problem: Problem, expansion: Expansion, unknowns: IntArray, chunk: Chunk, rows: IntArray
) -> Rows:
    """Some rows of a chunk at some unknowns, that are made when someone asks."""
    x, c, steps = chunk.rows, chunk.course, chunk.steps[rows]
    now = steps - chunk.run.first
    parts = {name: getattr(x, name)[rows] for name in ("u", "v", "a", "w", "t", "state")}
    if c is not None:
        for name, moved in (("u", c.c), ("v", c.v), ("a", c.a)):
            parts[name] = np.hstack([parts[name], moved[now]])
    at = np.arange(expansion.shape[1])
    view = View(at, {name: part.shape[1:] for name, part in parts.items()}, expansion)
    tap = closed_tap(0)._replace(at=at, **parts)
    factors = problem.loading.at(problem.times[steps])
    return Rows(problem, steps, unknowns, view, tap, factors)


def expanded(
    problem: Problem, model: ReducedModel, chunk: Chunk, rows: IntArray
) -> Iterator[Snapshot]:
    """Whole fields of some rows of a chunk, with the reactions that their balance asks for."""
    p, x = problem, chunk.rows
    parts = np.concatenate([x.u[rows], x.v[rows], x.a[rows]])
    u, v, a = np.split(model.expand(parts.T), 3, axis=1)
    steps = chunk.steps[rows]
    if chunk.course is not None:
        X, c, now = model.supports.columns.X, chunk.course, steps - chunk.run.first
        u, v, a = u + X @ c.c[now].T, v + X @ c.v[now].T, a + X @ c.a[now].T
    loads = p.loading.at(p.times[steps]) @ p.loading.forces.T
    rest = reactions(p, u.T, v.T, a.T, x.t[rows], loads)
    for i, (row, step) in enumerate(zip(rows, steps.tolist(), strict=True)):
        yield Snapshot(
            p, step, float(p.times[step]), u[:, i].copy(), v[:, i].copy(), a[:, i].copy(),
            rest[i], x.w[row], x.t[row], x.state[row], np.zeros(0),
        )  # fmt: skip


def integrate_reduced(
    problem: Problem,
    tolerance: float,
    observers: Sequence[Observer] = (),
    progress: Progress | None = None,
    shelf: "Shelf | None" = None,
) -> History:
    """Integrate a problem on a reduced basis, or as it is where that does not serve.

    Parameters
    ----------
    tolerance : float
        Largest estimated error of displacements and jumps, relative to the largest of the
        motion, between 0 and 1.
    shelf : Shelf, optional
        Where the memory of the ground stands: the largest body is stepped by that, nothing else
        is reduced.

    Returns
    -------
    History
        `reduction` says the number of vectors and the estimated error, or why the whole model
        was run: the damping is not symmetric, the motion starts off its supports, or more than half
        the unknowns would be needed.

    Raises
    ------
    KernelError
        For a tolerance out of range, unilateral relations, adaptive or conserving steps.
    ConvergenceError, SingularMatrixError
        See `integrate`.
    """
    if not 0.0 < tolerance < 1.0:
        raise KernelError("kernel.stepping.tolerance-reduction", tolerance=tolerance)
    refuse_reduction(problem)
    started = time.perf_counter()
    try:
        if shelf is None:
            history = ReducedIntegration(problem, observers, progress, tolerance).run()
        else:
            from ssilang.kernel.stepping.rests.memory.run import integrate_with_memory

            return integrate_with_memory(problem, tolerance, shelf, observers, progress)
    except NoReduction as reason:
        spent = time.perf_counter() - started
        history = integrate(problem, observers, progress)
        history.reduction = Reduction(refused=reason, prepared=spent)
        return history
    except BaseException:
        _close(observers)
        raise
    _close(observers)
    return history


def _close(observers: Sequence[Observer]) -> None:
    for observer in observers:
        observer.close()
