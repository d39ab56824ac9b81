"""What the motion of a ground's side of the joints remembers of forces and loads.

Discrete kernels of the scheme's own steps: `G_k` (q, q) are the increments of the jumps in the kth
step under unit forces at the end of the first one. The first kernels are kept whole. Waves leave,
and what is left of them is smooth: from step a to 2a forces count by their part in the span of
what the kernels from a/2 to a answered, whose singular vectors below the tolerance are left out
(the next kernels shrink them further). Dyadic steps as in fast convolution (Hairer, Lubich and
Schlichte 1985).
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.base.scientific import la
from ssilang.kernel.stepping.newmark import Newmark
from ssilang.kernel.stepping.rests.memory.ground import SINGLE, Ground, GroundSteps
from ssilang.kernel.stepping.verbs import advance, damped, from_past

COLUMNS = 128  # stepped together
WHOLE = 16  # first kernels, kept as they are
FEW = 0.6  # of the jumps: more singular vectors than that are kept as whole kernels
QUIET = 16  # steps without an answer, after which none comes


@dataclass(frozen=True, eq=False)
class Stage:
    """Kernels from `first` on, on a few vectors: `G_k = P core P^T`."""

    first: int
    P: FloatArray  # (q, r) orthonormal
    cores: FloatArray  # (m, r, r)


@dataclass(frozen=True, eq=False)
class Kernels:
    """The memory of a ground, of single precision."""

    mark: FloatArray  # of the ground
    dt: float
    tolerance: float
    whole: FloatArray  # (m, q, q) G_1 to G_m
    stages: tuple[Stage, ...]
    reach: int  # steps that the memory describes, 0: all
    loads: FloatArray  # (l, q, k) the same of loads
    loads_mark: FloatArray  # of their forces
    loads_reach: int  # steps that these describe, 0: all
    estimate: float = np.nan  # error of the jumps of a motion, of the largest

    @property
    def size(self) -> int:
        """Number q of jumps."""
        return int(self.whole.shape[1])

    @property
    def vectors(self) -> int:
        """Rows of the largest kernel, and vectors of all stages."""
        return self.size + sum(s.P.shape[1] for s in self.stages)

    def compliance(self, n: Newmark) -> FloatArray:
        """That of a step (q, q): what forces at its end answer in it."""
        return self.whole[0].astype(float) / n.end


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
        for part in ground.factor:
            part.forward(b)
        for part in reversed(ground.factor):
            part.backward(b)
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


@compiled_fast
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


def kernels_of(ground: Ground, tolerance: float, steps: int) -> Kernels:
    """The memory of a ground for motions of so many steps.

    Parameters
    ----------
    tolerance : float
        Norm of what is left out of a stage, of that of the first kernel.

    Raises
    ------
    NoReduction
        If the ground has no factor.
    """
    own, q = ground.steps, ground.J.shape[0]
    whole = _kernels(own, np.eye(q), 0, WHOLE)
    least = tolerance * float(np.linalg.norm(whole[0], 2))
    first, stages = WHOLE, list[Stage]()
    P = _span(whole[WHOLE // 2 :], least)
    while P.shape[1] and first < steps:
        if P.shape[1] > FEW * q:
            P = np.eye(q)
        cores = _kernels(own, P, first, 2 * first, 0.1 * least)
        if len(P) == P.shape[1]:
            whole = np.concatenate([whole, cores])
        else:
            stages.append(Stage(first, P.astype(SINGLE), cores))
        P, first = P @ _span(cores, least), 2 * first
    return Kernels(
        ground.mark, ground.dt, tolerance, whole, tuple(stages), first if P.shape[1] else 0,
        *loads_of(ground, tolerance, steps),
    )  # fmt: skip


def _kernels(
    ground: GroundSteps, P: FloatArray, begin: int, end: int, little: float = 0.0
) -> FloatArray:
    """`P^T G_k P` (end - begin, r, r) for the kernels after `begin`, symmetric.

    Zero behind `QUIET` steps with no more than `little`.
    """
    P = P.astype(SINGLE)
    r = P.shape[1]
    found = np.zeros((end - begin, r, r), SINGLE)
    for first in range(0, r, COLUMNS):
        part = slice(first, first + COLUMNS)
        forces, quiet = ground.J.T @ P[:, part], 0
        for k, rows in enumerate(increments(ground, impulse(forces, end))):
            if k >= begin:
                found[k - begin, :, part] = answer = P.T @ rows
                quiet = quiet + 1 if np.linalg.norm(answer) <= little else 0
                if quiet == QUIET:
                    break
    for G in found:
        G += G.T.copy()
    found *= SINGLE(0.5)
    return found


def _span(kernels: FloatArray, least: float) -> FloatArray:
    """Orthonormal columns of the directions that some kernels answer by more than `least`."""
    W = np.zeros(kernels.shape[1:])
    for G in kernels:
        exact = G.astype(float)
        W += exact @ exact
    values, vectors = la.eigh(W)
    return np.asarray(vectors[:, values > least**2])


def loads_of(ground: Ground, tolerance: float, steps: int) -> tuple[FloatArray, FloatArray, int]:
    """Answers (l, q, k) to the loads until they are quiet, the loads' mark, steps described."""
    own, found, reach = ground.steps, list[FloatArray](), 0
    for first in range(0, own.forces.shape[1], COLUMNS):
        rows, largest, quiet = list[FloatArray](), 0.0, 0
        forces = np.ascontiguousarray(own.forces[:, first : first + COLUMNS])
        for row in increments(own, impulse(forces, steps)):
            rows.append(row)
            size = np.abs(row).max(axis=0)
            largest = np.maximum(largest, size)
            quiet = quiet + 1 if (size <= tolerance * largest).all() else 0
            if quiet == QUIET and np.all(largest > 0.0):
                break
        else:
            reach = steps
        found.append(np.array(rows))
    longest = max(map(len, found), default=0)
    padded = [np.pad(x, ((0, longest - len(x)), (0, 0), (0, 0))) for x in found]
    none = np.zeros((0, own.J.shape[0], 0), SINGLE)
    return np.concatenate(padded or [none], axis=2), ground.loads_mark, reach
