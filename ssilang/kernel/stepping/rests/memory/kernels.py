"""What the motion of a ground's side of the joints remembers of forces and loads.

Discrete kernels of the scheme's own steps: `G_k` (q, q) are the increments of the jumps in the kth
step under unit forces at the end of the first one. They are seen through answers `G_k W` to probes
W, orthonormal forces: waves leave, and what is left of them is smooth, so that fewer and fewer
probes tell all of a kernel (Halko, Martinsson and Tropp 2011, 10.1137/090771806: the mixed cosines
of section 4.6, symmetric kernels from one pass of section 5.5). The first one is kept whole, all
others as sums `G_1 + .. + G_k`, how far an impulse has moved the jumps: what is left out of a sum
is there for a step, what is left out of an increment stays. The next sums are kept in blocks, later
ones in the span of their answers, both but for singular vectors below the tolerance. Of loads there
are the patterns that a motion has, as edges of a soil follow what comes from below: so few that
other motions have the same.
"""

import hashlib
from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from threading import Lock

import numpy as np

from ssilang.kernel.base.arrays import SINGLE, FloatArray
from ssilang.kernel.base.compiled.compiler import compiled_threaded
from ssilang.kernel.base.scientific import fft, la, spla
from ssilang.kernel.base.threads import side_by_side
from ssilang.kernel.solvers.cholesky.triangular import solve_together
from ssilang.kernel.solvers.low_rank import LowRank, low_rank
from ssilang.kernel.stepping.newmark import Newmark
from ssilang.kernel.stepping.rests.memory.ground import Ground, GroundSteps, alike
from ssilang.kernel.stepping.run import Progress
from ssilang.kernel.stepping.verbs import advance, damped, from_past

COLUMNS = 192  # stepped together
PROBES = 64  # at first; half as many more while they do not suffice
OVER = 2  # probes of one singular vector
MOST = 0.75  # singular vectors of one probe
NEAR = 9  # first kernels, of any number of vectors
GUESSED = 20  # steps of most probes, until it is known
FEW = 0.6  # of the jumps: kernels with more singular vectors are kept in blocks
CLOSER = 0.25  # of the tolerance: the same of one step, as many add up
LONGER = 1.25  # where steps end that share their vectors, over where they begin
QUIET = 16  # steps without an answer, after which none comes
QUIETER = 5e-3  # of the tolerance: what no answer to a probe is
STILL = 0.05  # of the tolerance: what none to a load is
SPANNED = 0.1  # of the tolerance, of the norm of factors of loads: what is beside all patterns
FINER = 0.1  # of that: beside the first ones
FOLLOWED = 2  # times as long as the first ones at most: short motions leave a memory as long


Kept = Callable[[str, tuple[int, int], Iterator[FloatArray]], Iterator[FloatArray]]
"""The rows of a name and a shape, or those that a making which was broken off left under it."""


@dataclass(eq=False)
class Making:
    """Hands on rows as they were kept, and says how far they are: columns times steps."""

    kept: Kept
    progress: Progress | None
    left: int
    done: int = 0
    _counting: Lock = field(default_factory=Lock)

    def answered(
        self, name: str, shape: tuple[int, int], rows: Iterator[FloatArray]
    ) -> Iterator[FloatArray]:
        """Rows of a name; see `Kept`."""
        for row in self.kept(name, shape, rows):
            with self._counting:  # pieces are stepped by several threads
                self.done, self.left = self.done + shape[1], max(self.left - shape[1], 0)
                if self.progress is not None:
                    self.progress(self.done, self.done + self.left)
            yield row


@dataclass(frozen=True, eq=False)
class Stage:
    """Kernels after `first`, summed from the first one on, on a few vectors: `P core P^T`."""

    first: int
    P: FloatArray  # (q, r) orthonormal
    sums: FloatArray  # (m, r, r)


@dataclass(frozen=True, eq=False)
class Kernels:
    """The memory of a ground, of single precision."""

    mark: FloatArray  # of the ground
    dt: float
    tolerance: float
    first: FloatArray  # (q, q) G_1
    sums: tuple[LowRank, ...]  # (q, q) each: of the first 2 to m kernels
    stages: tuple[Stage, ...]  # none: the last sum lasts
    loads: FloatArray  # (l, q, r) the same of loads, in patterns
    patterns: FloatArray  # (k, r) orthonormal, of the k loads
    loads_mark: FloatArray  # of their forces
    reach: int  # steps that all this describes, 0: any number
    estimate: float = np.nan  # error of the jumps of a motion, of the largest

    @property
    def size(self) -> int:
        """Number q of jumps."""
        return len(self.first)

    @property
    def vectors(self) -> int:
        """Rows of the largest kernel, and vectors of all stages."""
        return self.size + sum(s.P.shape[1] for s in self.stages)

    def compliance(self, n: Newmark) -> FloatArray:
        """That of a step (q, q): what forces at its end answer in it."""
        return self.first.astype(float) / n.end


def increments(ground: GroundSteps, changes: Iterable[FloatArray]) -> Iterator[FloatArray]:
    """Increments (q, k) of the jumps in steps whose loads (r, k) change by `changes`.

    Changes without columns are none.
    """
    n, end = ground.newmark, SINGLE(ground.newmark.end)
    b = none = np.zeros((0, 0), SINGLE)
    for change in changes:
        if not len(b):
            b = np.zeros(change.shape, SINGLE)
            g, Mv, Ma, Cv, Ca = (np.zeros(change.shape, SINGLE) for _ in range(5))
        if len(change):
            b += end * change
        solve_together(ground.factor, b)
        yield ground.J @ b
        rest = ground.rest @ b if ground.rest.nnz else none
        given = ground.M @ b, rest, change
        _advance(n, ground.alpha, ground.beta, given, (g, Mv, Ma, Cv, Ca), b)


def impulse(forces: FloatArray, steps: int) -> Iterator[FloatArray]:
    """Changes of forces that are there at the end of the first step alone."""
    yield forces
    yield -forces
    for _ in range(steps - 2):
        yield forces[:0]


@compiled_threaded
def _advance(
    n: Newmark, alpha: float, beta: float,
    given: tuple[FloatArray, FloatArray, FloatArray],
    state: tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray], b: FloatArray,
) -> None:  # fmt: skip
    """Products after an increment, and the right side of the next step into b; see `interleaved`.

    `given`: mass and dashpots times the increment, change of the loads in the step.
    """
    Mx, rest, change = given
    g, Mv, Ma, Cv, Ca = state
    g_g, g_1, g_0 = -n.start / n.end, -n.inertia_end / n.end, -n.inertia_start / n.end
    for i in range(b.shape[0]):
        for j in range(b.shape[1]):
            Ma0, g0, own = Ma[i, j], g[i, j], rest[i, j] if len(rest) else 0.0
            Mv[i, j], Ma[i, j] = advance(n, Mx[i, j], Mv[i, j], Ma0)
            g[i, j] = g_g * g0 + g_1 * Ma[i, j] + g_0 * Ma0
            force = (change[i, j] if len(change) else 0.0) + g[i, j] - g0
            Cv[i, j], Ca[i, j] = damped(n, alpha, beta, Mx[i, j], own, force, Cv[i, j], Ca[i, j])
            b[i, j] = from_past(n, Mv[i, j], Ma[i, j], Cv[i, j], Ca[i, j]) + Cv[i, j] - g[i, j]


def kernels_of(
    ground: Ground, tolerance: float, steps: int, kept: Kept,
    progress: Progress | None = None,
) -> Kernels:  # fmt: skip
    """The memory of a ground for motions of so many steps.

    Parameters
    ----------
    tolerance : float
        Norm of what is left out of kernels, of that of the first one.
    kept : callable
        Hands on the rows of each piece of the ground's answers, or those that were left.
    progress : callable, optional
        Called with the columns stepped so far, and how many it takes as far as that is known.

    Raises
    ------
    NoReduction
        If the ground has no factor.
    """
    own, q = ground.steps, ground.J.shape[0]
    probes, steps = _probes(q), max(steps, NEAR)
    patterns = _patterns(ground, np.zeros((len(ground.loads), 0)), tolerance)
    making = Making(kept, progress, steps * (PROBES + patterns.shape[1]) + q * GUESSED)
    first_answers, loads, reach = _first_answers(
        own, probes[:, :PROBES], patterns, tolerance, steps, making.answered
    )  # fmt: skip
    answers = _answers_to_probes(own, probes, first_answers, CLOSER * tolerance, making)
    sums, stages = list[LowRank](), list[Stage]()
    first, least = 0, CLOSER * tolerance * _norm(answers[0])
    while first < len(answers):
        count = answers[first].shape[1]
        longest = answers[first : max(NEAR, int(LONGER * first))]
        part = [Y for Y in longest if Y.shape[1] == count]
        as_it_is = first < NEAR or (count == q and _rank(part[-1], least) > FEW * q)
        P = probes if as_it_is else _span(part, least * np.sqrt(count / q), MOST * count)
        if count == q and first <= len(sums) + 1 and P.shape[1] > FEW * q:
            near = (_symmetric(Y @ probes.T) for Y in part[0 if first else 1 :])
            sums += [low_rank(A, ground.places, least, least) for A in near]
        elif P.shape[1]:
            seen = P.T @ probes[:, :count]
            back = la.solve(seen @ seen.T, seen, assume_a="pos").T
            cores = np.array([_symmetric(P.T @ Y @ back) for Y in part], SINGLE)
            stages.append(Stage(first, P.astype(SINGLE), cores))
        first += len(part)
    return Kernels(
        ground.mark, ground.dt, tolerance, _symmetric(answers[0] @ probes.T), tuple(sums),
        tuple(stages), loads, patterns, ground.loads_mark, reach,
    )  # fmt: skip


def _probes(q: int) -> FloatArray:
    """Orthonormal columns (q, q) of which any few are as good as others: cosines in disorder."""
    random = np.random.default_rng(0)
    cosines = fft.dct(np.diag(random.choice([-1.0, 1.0], q)), axis=0, norm="ortho")
    return np.asarray(cosines.T[:, random.permutation(q)], SINGLE)


def _patterns(ground: Ground, known: FloatArray, tolerance: float) -> FloatArray:
    """Orthonormal columns (k, r) which, with the known ones, span the factors of the loads."""
    factors, beside = ground.loading[1], SPANNED if known.size else FINER * SPANNED
    _, values, rows = la.svd(factors - factors @ known @ known.T, full_matrices=False)
    return rows[values > beside * tolerance * la.norm(factors)].T


def _first_answers(
    ground: GroundSteps, probes: FloatArray, patterns: FloatArray, tolerance: float, steps: int,
    kept: Kept,
) -> tuple[FloatArray, FloatArray, int]:  # fmt: skip
    """Answers to probes (q, c) and to patterns of loads, with the steps described."""
    given = la.block_diag(probes, patterns.astype(SINGLE))
    little = tolerance * np.repeat([QUIETER, STILL], [probes.shape[1], patterns.shape[1]])
    rows, reach = _answers(ground, given, steps, little, kept)
    return rows[:, :, : probes.shape[1]], rows[:, :, probes.shape[1] :], reach


def _answers_to_probes(
    ground: GroundSteps, probes: FloatArray, first: FloatArray, tolerance: float, making: Making
) -> list[FloatArray]:
    """Answers (q, r_k) to as many probes as tell all until the kth step, from the `first` ones.

    Summed: how far the probes' impulses have moved the jumps.
    """
    found, end = list(np.cumsum(first, axis=0)), len(first)
    while (count := found[0].shape[1]) < len(probes):
        least = tolerance * _norm(found[0])
        end = bisect_left(
            range(end), True, NEAR, key=lambda k: _rank(found[k], least) <= count / OVER
        )  # fmt: skip
        more = probes[:, count : count + max(count // 2, PROBES)]
        making.left = end * (len(probes) - count)
        given = np.pad(more, ((0, ground.forces.shape[1]), (0, 0)))
        rows, _ = _answers(ground, given, end, np.zeros(more.shape[1]), making.answered)
        for k, row in enumerate(np.cumsum(rows, axis=0, out=rows)):
            found[k] = np.hstack([found[k], row])
    return found


def _norm(A: FloatArray) -> float:
    """The largest singular value."""
    if min(A.shape) <= PROBES:
        return float(la.norm(A, 2))
    start = np.ones(min(A.shape), A.dtype)
    return float(spla.svds(A, 1, v0=start, return_singular_vectors=False)[0])


def _rank(A: FloatArray, least: float) -> int:
    """Singular values above `least`."""
    exact = A.astype(float)
    return int((la.eigvalsh(exact.T @ exact) > least**2).sum())


def _symmetric(A: FloatArray) -> FloatArray:
    return 0.5 * (A + A.T)


def _span(parts: Sequence[FloatArray], least: float, most: float) -> FloatArray:
    """Orthonormal columns of the directions that some answers have by more than `least`."""
    Z = np.hstack(parts).astype(float)
    wide = Z.shape[1] > len(Z)
    gram = Z @ Z.T if wide else Z.T @ Z
    values, vectors = la.eigh(gram, driver="evd")
    few = slice(max(np.searchsorted(values, least**2), len(values) - int(most)), None)
    return vectors[:, few] if wide else Z @ (vectors[:, few] / np.sqrt(values[few]))


def _answers(
    ground: GroundSteps, given: FloatArray, steps: int, tolerance: FloatArray, kept: Kept
) -> tuple[FloatArray, int]:
    """Increments (k, q, c) of the jumps after forces in the first step, until quiet.

    Given (q + k, c): those on the joints, and factors of the loads. Quiet: for `QUIET` steps no
    more than `tolerance` (c,) of what was largest. With the steps that these describe, 0: all.
    """
    c = given.shape[1]
    count = max(1, min(c, 2 * -(-c // (2 * COLUMNS))))  # an even number keeps two busy
    pieces = zip(*(np.array_split(x, count, axis=-1) for x in (given, tolerance)), strict=True)
    found = side_by_side(
        [kept(*_until_quiet(ground, np.ascontiguousarray(x), steps, few)) for x, few in pieces]
    )
    rows = _beside(found)
    return rows, 0 if len(rows) < steps else steps


def _beside(pieces: Sequence[Sequence[FloatArray] | FloatArray]) -> FloatArray:
    """Columns of pieces (k, q, c), the longest one's steps of all."""
    longest = max(map(len, pieces))
    return np.concatenate(
        [np.pad(rows, ((0, longest - len(rows)), (0, 0), (0, 0))) for rows in pieces], axis=2
    )


def _until_quiet(
    ground: GroundSteps, given: FloatArray, steps: int, tolerance: FloatArray
) -> tuple[str, tuple[int, int], Iterator[FloatArray]]:
    """A name that says of what the increments of a piece are, their shape, and these."""
    said = hashlib.blake2b(str(steps).encode(), digest_size=8)
    for part in (ground.mark, np.array(ground.newmark), given, tolerance):
        said.update(part.data)
    q, c = ground.J.shape[0], given.shape[1]

    def rows() -> Iterator[FloatArray]:
        largest, quiet = np.zeros(c), 0
        forces = ground.J.T @ given[:q] + ground.forces @ given[q:]
        for row in increments(ground, impulse(forces, steps)):
            yield row
            size = np.abs(row).max(axis=0)
            largest = np.maximum(largest, size)
            quiet = quiet + 1 if (size <= tolerance * largest).all() else 0
            if quiet == QUIET and np.all(largest > 0.0):
                return

    return said.hexdigest(), (q, c), rows()


def with_loads(
    kernels: Kernels, ground: Ground, steps: int, kept: Kept, progress: Progress | None = None
) -> Kernels:
    """A memory that knows the loads of a motion, the same one if it does already."""
    k, none = kernels, np.zeros((kernels.size, 0), SINGLE)
    if not alike(k.loads_mark, ground.loads_mark):
        patterns = np.zeros((len(ground.loads), 0))
        k = replace(k, loads=none[None], patterns=patterns, loads_mark=ground.loads_mark)
    new = _patterns(ground, k.patterns, k.tolerance)
    if not new.size:
        return k
    steps = max(steps, k.reach or FOLLOWED * len(kernels.loads))
    making = Making(kept, progress, steps * new.shape[1])
    _, loads, reach = _first_answers(ground.steps, none, new, k.tolerance, steps, making.answered)
    return replace(
        k, loads=_beside([k.loads, loads]), patterns=np.hstack([k.patterns, new]),
        reach=min(filter(None, (k.reach, reach)), default=0),
    )  # fmt: skip
