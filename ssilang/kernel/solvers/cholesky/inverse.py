"""Inverse of a sparse matrix that knows whether it is singular, and along which motions.

The matrix is scaled to a diagonal near one first, so that metres, radians and multipliers compare.
A small eigenvalue is suspected from a few inverse iterations on the factor; then the motions
without stiffness are found from a slightly shifted matrix and judged by their energy.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.base.scientific import la, sp
from ssilang.kernel.solvers.backends import MULTIGRID, factorise
from ssilang.kernel.solvers.cholesky.elimination import SmallGroupsFactor
from ssilang.kernel.solvers.factor import Factor, Ordering, Solver

if TYPE_CHECKING:
    from ssilang.kernel.solvers.multigrid.multigrid import MultigridFactor

SUSPECT = 1e-9  # smallest eigenvalue (unit diagonal) below which free motions are looked for
FREE = 1e-14  # energy below which a motion is free: some tens of rounding errors
SHIFT = 1e-12
MOST = 100_000_000  # numbers of which free motions may consist: 0.8 GB
ROWS = 100_000  # scaled together: a copy of a large matrix is gigabytes


@dataclass(frozen=True, eq=False)
class Inverse:
    """Factorised matrix, with its free motions if it is singular."""

    factor: Factor
    scale: FloatArray  # (n,) the factor is that of `scale A scale`
    # (n, p) free motions (null vectors), p = 0 for a regular matrix; orthonormal in scaled unknowns
    # `u / scale`
    kernel: FloatArray
    pinned: IntArray  # (p,) unknowns held at zero so that the rest can be solved
    kept: IntArray  # (n - p,) the other unknowns

    @property
    def singular(self) -> bool:
        """True if there are free motions."""
        return len(self.pinned) > 0

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b, b (n,) or (n, k); pinned unknowns are zero.

        With free motions b must do no work on them (see `work`).
        """
        if not self.singular:
            return (self.factor.solve((b.T * self.scale).T).T * self.scale).T
        x = np.zeros_like(b, dtype=float)
        s = self.scale[self.kept]
        x[self.kept] = (self.factor.solve((b[self.kept].T * s).T).T * s).T
        return x

    def work(self, b: FloatArray) -> FloatArray:
        """Work of b (n,) on each free motion over the product of the norms, shape (p,)."""
        scaled = b * self.scale
        norm = float(np.linalg.norm(scaled)) or 1.0
        return (self.kernel.T @ b) / norm

    def without_work(self, b: FloatArray) -> FloatArray:
        """The part of b (n,) that does no work on the free motions, nearest to b."""
        basis = np.linalg.qr(self.kernel)[0]
        return b - basis @ (basis.T @ b)


def invert(
    A: sp.csr_array,
    symmetric: bool,
    solver: Solver | str | None = None,
    ordering: Ordering | None = None,
) -> Inverse:
    """Factorise A (n, n); of a singular symmetric A find the free motions and pin them.

    Positive matrices are factorised without pivoting (by nested dissection if an ordering is
    given, see `factorise`); a symmetric matrix that turns out not to
    be positive (negative or zero pivots) is factorised again with pivoting.

    Raises
    ------
    KernelError
        If A holds values that are not finite, or many of its unknowns meet nothing.
    """
    if not np.isfinite(A.data).all():
        raise KernelError("kernel.solvers.matrix-holds-values-not")
    scaled, scale = unit_diagonal(A)
    if symmetric and not scaled.diagonal().all():
        used = np.flatnonzero(np.asarray(abs(scaled).max(axis=1).toarray()))
        if len(used) < A.shape[0]:
            return _without_idle(scaled, scale, used, solver, ordering)
    return _invert(scaled, scale, symmetric, solver, ordering)


def _without_idle(
    scaled: sp.csr_array,
    scale: FloatArray,
    used: IntArray,
    solver: Solver | str | None,
    ordering: Ordering | None,
) -> Inverse:
    """Inverse of a symmetric matrix, some of whose rows are zero: each is a free motion.

    Iterations would find these motions too, at the price of some dense matrices of their number.
    """
    n = scaled.shape[0]
    idle = np.setdiff1d(np.arange(n), used)
    if len(idle) * n > MOST:
        raise KernelError("kernel.solvers.unknowns-without-stiffness", idle=len(idle), count=n)
    part = None if ordering is None else ordering.of(used)
    held = _invert(sp.csr_array(scaled[used][:, used]), scale[used], True, solver, part)
    motions = np.zeros((n, held.kernel.shape[1] + len(idle)))
    motions[used, : held.kernel.shape[1]] = held.kernel
    motions[idle, held.kernel.shape[1] + np.arange(len(idle))] = 1.0
    pinned = np.sort(np.concatenate([used[held.pinned], idle]))
    return Inverse(held.factor, scale, motions, pinned, used[held.kept])


def _invert(
    scaled: sp.csr_array,
    scale: FloatArray,
    symmetric: bool,
    solver: Solver | str | None,
    ordering: Ordering | None,
) -> Inverse:
    """Inverse of a matrix that is scaled to a diagonal near one by `scale`."""
    n = scaled.shape[0]
    nothing = np.empty(0, dtype=np.int64)
    if n == 0:
        return Inverse(_Empty(), np.empty(0), np.empty((0, 0)), nothing, nothing)
    ordering = None if ordering is None else ordering.scaled(scale)
    factor = _try_factors(scaled, symmetric, solver, ordering)
    if factor is not None and factor.name == MULTIGRID:
        motions = cast("MultigridFactor", factor).free_motions()
    elif factor is not None and _smallest_eigenvalue(factor, n) > SUSPECT:
        motions = np.empty((n, 0))
    else:
        motions = free_motions(scaled, symmetric, solver)
    if motions.shape[1] == 0 and factor is not None:
        return Inverse(factor, scale, np.empty((n, 0)), nothing, np.arange(n))

    pinned = np.sort(la.qr(motions.T, mode="r", pivoting=True)[1][: motions.shape[1]])
    kept = np.setdiff1d(np.arange(n), pinned)
    part = None if ordering is None else ordering.of(kept.astype(np.int64))
    held = _try_factors(sp.csr_array(scaled[kept][:, kept]), symmetric, solver, part)
    if held is None:
        raise KernelError("kernel.solvers.matrix-stays-singular-free")
    motions = (motions.T * scale).T
    return Inverse(held, scale, motions, pinned.astype(np.int64), kept.astype(np.int64))


class _Empty:
    """Factor of a matrix without rows."""

    name = "none"

    def solve(self, b: FloatArray) -> FloatArray:
        return b


def unit_diagonal(A: sp.csr_array) -> tuple[sp.csr_array, FloatArray]:
    """`S A S` with a diagonal near one, and the diagonal of S."""
    size, rows = np.abs(A.diagonal()), A.shape[0]
    data = np.empty_like(A.data)
    largest = np.zeros(rows)
    parts = [(i, min(i + ROWS, rows)) for i in range(0, rows, ROWS)]
    for low, high in parts:
        begin, end = A.indptr[low], A.indptr[high]
        counts = np.diff(A.indptr[low : high + 1])
        filled = np.flatnonzero(counts)
        if end > begin:
            starts = A.indptr[low:high][filled] - begin
            largest[low + filled] = np.maximum.reduceat(np.abs(A.data[begin:end]), starts)
    size = np.where(size > 1e-14 * largest, size, largest)
    # powers of two: scaling rounds nothing
    scale = np.exp2(np.round(-0.5 * np.log2(np.where(size > 0.0, size, 1.0))))
    for low, high in parts:
        part = slice(A.indptr[low], A.indptr[high])
        data[part] = A.data[part] * scale[A.indices[part]]
        data[part] *= np.repeat(scale[low:high], np.diff(A.indptr[low : high + 1]))
    return sp.csr_array((data, A.indices.copy(), A.indptr.copy()), shape=A.shape), scale


def _try_factors(
    A: sp.csr_array, symmetric: bool, solver: Solver | str | None, ordering: Ordering | None
) -> Factor | None:
    """Factor without pivoting if A seems positive, else with; None if exactly singular."""
    if A.shape[0] == 0:  # everything was pinned
        return _Empty()
    diagonal = A.diagonal()
    if symmetric and (diagonal < 0.0).any():
        negative = _beside_groups(A, np.flatnonzero(diagonal < 0.0), solver, ordering)
        if negative is not None:
            return negative
    for positive in (True, False) if symmetric and (diagonal > 0.0).all() else (False,):
        try:
            factor = factorise(A, positive, solver, ordering)
        except SingularFactorError:
            continue
        # an iteration looks at its residuals by itself
        if not positive or factor.name == MULTIGRID or accurate(A, factor):
            return factor
    return None


def _beside_groups(
    A: sp.csr_array, groups: IntArray, solver: Solver | str | None, ordering: Ordering | None
) -> Factor | None:
    """Factor of a matrix that is positive but for small negative groups, None if it is not that."""
    try:
        factor = SmallGroupsFactor(A, groups, solver, ordering)
    except SingularFactorError:
        return None
    return factor if accurate(A, factor) else None


def accurate(A: sp.csr_array, factor: Factor) -> bool:
    """True if a solution's residual is small: without pivoting it may not be (A not positive)."""
    x = np.random.default_rng(0).standard_normal(A.shape[0])
    b = A @ x
    y = factor.solve(b)
    if not np.isfinite(y).all():
        return False
    return bool(np.linalg.norm(A @ y - b) <= 1e-10 * np.linalg.norm(y))


def _smallest_eigenvalue(factor: Factor, n: int) -> float:
    """Rough smallest |eigenvalue| of the factorised matrix, zero if it overflows."""
    x = np.random.default_rng(1).standard_normal(n)
    size = 0.0
    for _ in range(3):
        x /= np.linalg.norm(x) or 1.0
        x = factor.solve(x)
        size = float(np.linalg.norm(x))
        if not np.isfinite(size):
            return 0.0
    return 1.0 / size if size > 0.0 else np.inf


def free_motions(
    scaled: sp.csr_array, symmetric: bool, solver: Solver | str | None = None
) -> FloatArray:
    """Orthonormal null vectors (n, p) of a matrix with unit diagonal.

    Subspace iterations on the shifted matrix; a vector is null if its energy (symmetric) or the
    norm of its image (else) is below `FREE` times some tens.
    """
    n = scaled.shape[0]
    shifted = factorise(sp.csr_array(scaled + SHIFT * sp.eye_array(n)), False, solver)
    width = 8
    while True:
        width = min(width, n)
        X = np.linalg.qr(np.random.default_rng(2).standard_normal((n, width)))[0]
        for _ in range(8):
            X = np.linalg.qr(shifted.solve(X))[0]
        energy, vectors = _ritz(scaled, X, symmetric)
        null = energy < FREE
        if not null.all() or width == n or width > 512:
            return X @ vectors[:, null]
        width *= 4


def _ritz(A: sp.csr_array, X: FloatArray, symmetric: bool) -> tuple[FloatArray, FloatArray]:
    image = A @ X
    if symmetric:
        values, vectors = np.linalg.eigh(X.T @ image)
        return np.abs(values), vectors
    _, singular, right = np.linalg.svd(image, full_matrices=False)
    return 0.1 * singular, right.T
