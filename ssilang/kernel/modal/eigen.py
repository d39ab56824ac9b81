"""Eigenvalues of `K x = lambda M x` nearest a shift, on the motions that conditions allow.

The spectrum is turned over about the shift: with `A = K - s M`, `A^-1 M x = theta x` and
`lambda = s + 1/theta`, so that the nearest eigenvalues are the largest theta. A singular mass
(massless unknowns) only gives theta = 0. Small problems take all eigenvalues (LAPACK), large ones
the nearest (ARPACK).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.base.scientific import la, sp, spla
from ssilang.kernel.matrices.assembly import may_be_positive
from ssilang.kernel.modal.basis import ReducedProblem
from ssilang.kernel.solvers.backends import dissection_pays, factorise, goes_to_petsc
from ssilang.kernel.solvers.cholesky.inverse import accurate, invert
from ssilang.kernel.solvers.factor import Factor

DENSE = 400  # unknowns up to which all eigenvalues are computed
MASSLESS = 1e-13  # theta (relative to the largest) taken for zero
NUDGE = 1e-8  # shift off an eigenvalue, relative to the largest |lambda|, then to |s|
BESIDE = 1e-10  # of zero, relative to the largest |lambda|: where a free motion's eigenvalue lies
STRANGE = 1e-2  # share of its forces by which a shape may miss the equation of modes

Solve = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, eq=False)
class Pairs:
    """Eigenvalues lambda (k,) and shapes (r, k), mass-orthonormal, by distance from the shift."""

    values: FloatArray
    shapes: FloatArray


def nearest(problem: ReducedProblem, shift: float, count: int) -> Pairs:
    """The `count` eigenvalues nearest to `shift`, or all there are.

    Raises
    ------
    KernelError
        If no unknown has a mass, the matrices are not symmetric, or no modes are found.
    """
    check(problem)
    found = shifted_inverse(problem, shift)
    if found is None:
        return _without_idle(problem, shift, count)
    moved, solve = found
    whole = problem.size <= DENSE or count >= problem.size // 2
    if whole:
        theta, shapes = _all(problem, moved, solve)
    else:
        theta, shapes = _some(problem, moved, solve, count)
    real = np.abs(theta) > MASSLESS * np.abs(theta).max(initial=0.0)
    values, shapes = moved + 1.0 / theta[real], shapes[:, real]
    order = np.argsort(np.abs(values - shift), kind="stable")[:count]
    if not whole:
        _refuse_strangers(problem, values[order], shapes[:, order])
    return Pairs(values[order], shapes[:, order])


def check(problem: ReducedProblem) -> None:
    """Refuse unsymmetric matrices and systems without mass."""
    if not problem.symmetric:
        raise KernelError("kernel.modal.matrices-not-symmetric-modes")
    if problem.size == 0:
        raise KernelError("kernel.modal.conditions-hold-every-unknown")
    if problem.M.nnz == 0 or not np.any(problem.M.data):
        raise KernelError("kernel.modal.no-unknown-may-move")


def largest_value(problem: ReducedProblem) -> float:
    """Scale of the highest eigenvalue, from the diagonals."""
    mass = np.abs(problem.M.diagonal())
    stiffness = np.abs(problem.K.diagonal())
    heavy = mass > 1e-14 * mass.max(initial=0.0)
    ratio = stiffness[heavy] / mass[heavy]
    return float(ratio.max(initial=0.0)) or 1.0


def _without_idle(problem: ReducedProblem, shift: float, count: int) -> Pairs:
    """Eigenvalues of a system with motions that meet neither stiffness nor mass.

    Such motions (rotations of a flat shell about its normal) are held by as few unknowns.
    """
    size = abs(problem.K).max() / abs(problem.M).max()  # not zero: `check` saw to it
    inverse = invert(problem.bordered(sp.csr_array(problem.K + size * problem.M)), True)
    pinned = inverse.pinned[inverse.pinned < problem.size]
    if len(pinned) == 0:
        raise KernelError("kernel.modal.matrix-singular-whatever-frequency")
    kept = np.setdiff1d(np.arange(problem.size), pinned)
    part = nearest(problem.restricted(kept), shift, count)
    shapes = np.zeros((problem.size, len(part.values)))
    shapes[kept] = part.shapes
    return Pairs(part.values, shapes)


def shifted_inverse(problem: ReducedProblem, shift: float) -> tuple[float, Solve] | None:
    """A shift near the one wanted at which `K - s M` is regular, and its solver (r,) or (r, k).

    None if there is none: some motion meets neither stiffness nor mass.
    """
    step = NUDGE * largest_value(problem)
    for moved in (shift, shift - step, shift * (1.0 - 1e-6) - step, shift - 1e3 * step):
        A = problem.bordered(sp.csr_array(problem.K - moved * problem.M))
        solve = _regular(A, problem)
        if solve is not None:
            return moved, solve
    return None


def _regular(A: sp.csr_array, problem: ReducedProblem) -> Solve | None:
    """Solver of A by its scaled factor, for the problem's unknowns; None if A is singular."""
    top = np.asarray(abs(A).max(axis=1).toarray(), dtype=float).ravel()
    if (top == 0.0).any():
        return None
    scale, size = 1.0 / np.sqrt(top), problem.size
    S = sp.diags_array(scale)
    factor = _factor(sp.csr_array(S @ A @ S), problem, scale)
    if factor is None:
        return None
    x = np.random.default_rng(3).standard_normal(A.shape[0])
    for _ in range(3):
        x = factor.solve(x / np.linalg.norm(x))
        if not np.isfinite(x).all():
            return None
    if np.linalg.norm(x) > 1e14:
        return None

    def solve(b: FloatArray) -> FloatArray:
        full = np.zeros((A.shape[0], *b.shape[1:]))
        full[:size] = (b.T * scale[:size]).T
        return (factor.solve(full)[:size].T * scale[:size]).T

    return solve


def _factor(A: sp.csr_array, problem: ReducedProblem, scale: FloatArray) -> Factor | None:
    """A factor of `K - s M` (scaled); None if it is exactly singular.

    With the shift below all eigenvalues the matrix is positive; above some, a factor without row
    exchanges mostly serves, and keeps the symmetric ordering: that of a thin tube of 24 000
    unknowns has a fifth of the entries of a factor with exchanges.
    """
    n = A.shape[0]
    if goes_to_petsc(problem.solver, n):
        return _by_petsc(A, problem, scale)
    if n > DENSE and n == problem.size:
        orderings = [None] if not dissection_pays(n) else [problem.ordering.scaled(scale), None]
        for ordering in orderings:
            try:
                factor = factorise(A, True, problem.solver if ordering else "SuperLU", ordering)
            except SingularFactorError:
                continue
            if accurate(A, factor):
                return factor
    try:
        return factorise(A, False)
    except SingularFactorError:
        return None


def _by_petsc(A: sp.csr_array, problem: ReducedProblem, scale: FloatArray) -> Factor | None:
    """A factor of PETSc's: positive, else any; None if it is singular."""
    for positive in (True, False) if (A.diagonal() > 0.0).all() else (False,):
        ordering = None
        if positive and A.shape[0] == problem.size:
            ordering = problem.ordering.scaled(scale)
        try:
            return factorise(A, positive, problem.solver, ordering)
        except SingularFactorError:
            continue
    return None


def _all(problem: ReducedProblem, moved: float, solve: Solve) -> tuple[FloatArray, FloatArray]:
    """All theta and shapes: `R^T A^-1 R y = theta y` with `M = R R^T`, `x = A^-1 R y`."""
    weights, vectors = la.eigh(problem.M.toarray())
    if weights[0] < -1e-10 * abs(weights[-1]):
        return _indefinite(problem, moved, solve)
    heavy = weights > 1e-14 * weights[-1]
    root = vectors[:, heavy] * np.sqrt(weights[heavy])
    image = solve(root)
    flexible = root.T @ image
    theta, y = la.eigh(0.5 * (flexible + flexible.T))
    return theta, _normal(problem, image @ y)


def _indefinite(
    problem: ReducedProblem, moved: float, solve: Solve
) -> tuple[FloatArray, FloatArray]:
    """The same where the "mass" has both signs (buckling) and A, or else K, is positive.

    With `A^-1 = L L^T` and `x = L y`: `L^T M L y = theta y`. A shift above the first load that
    buckles leaves A without such an L; K has one.
    """
    lower, base = _root(problem, solve), moved
    if lower is None:
        elastic = shifted_inverse(problem, 0.0)
        if elastic is not None:
            base, lower = elastic[0], _root(problem, elastic[1])
    if lower is None:
        raise KernelError("kernel.modal.mass-matrix-negative-eigenvalues")
    theta, y = la.eigh(lower.T @ problem.M.toarray() @ lower)
    if base != moved:
        real = np.abs(theta) > MASSLESS * np.abs(theta).max(initial=0.0)
        theta, y = 1.0 / (base + 1.0 / theta[real] - moved), y[:, real]
    return theta, _normal(problem, lower @ y)


def _root(problem: ReducedProblem, solve: Solve) -> FloatArray | None:
    """L (r, r) of the inverse `L L^T` that `solve` applies; None if that is not positive."""
    inverse = solve(np.eye(problem.size))
    try:
        lower: FloatArray = la.cholesky(0.5 * (inverse + inverse.T), lower=True)
    except la.LinAlgError:
        return None
    return lower


def _some(
    problem: ReducedProblem, moved: float, solve: Solve, count: int
) -> tuple[FloatArray, FloatArray]:
    """The largest |theta| by ARPACK, a few more than wanted so that none is missed.

    Vectors are measured by the mass, or by K where the "mass" is a load (buckling).
    """
    n = problem.size
    wanted = min(count + 4, n - 1)
    inverse = spla.LinearOperator((n, n), matvec=solve, dtype=float)
    start = solve(problem.M @ np.random.default_rng(4).standard_normal(n))
    asked: dict[str, Any] = {
        "v0": start,
        "which": "LM",
        "ncv": min(n, max(2 * wanted + 10, 30)),
        "maxiter": 1000,
    }
    K, M = problem.K, problem.M
    try:
        if not may_be_positive(M) and moved == 0.0:
            theta, shapes = spla.eigsh(M, wanted, M=K, Minv=inverse, **asked)
        elif not may_be_positive(M):
            values, shapes = spla.eigsh(
                K, wanted, M=M, sigma=moved, mode="buckling", OPinv=inverse, **asked
            )
            theta = 1.0 / (values - moved)
        else:
            values, shapes = spla.eigsh(K, wanted, M=M, sigma=0.0, OPinv=inverse, **asked)
            theta = 1.0 / values
    except spla.ArpackError as problem_found:
        raise KernelError(
            "kernel.modal.search-modes-not-converge", problem_found=problem_found
        ) from None
    return theta, _normal(problem, shapes)


def _refuse_strangers(problem: ReducedProblem, values: FloatArray, shapes: FloatArray) -> None:
    """Refuse shapes (r, k) that are no modes at all: they miss `K x = lambda M x` altogether.

    A mass that is not positive makes ARPACK find such without a word.
    """
    elastic, inertia = problem.K @ shapes, (problem.M @ shapes) * values
    missed = np.linalg.norm(elastic - inertia, axis=0)
    size = np.maximum(np.linalg.norm(elastic, axis=0), np.linalg.norm(inertia, axis=0))
    rounding = 1e-9 * np.linalg.norm(abs(problem.K) @ np.abs(shapes), axis=0)
    if (missed > STRANGE * size + rounding).any():
        raise KernelError("kernel.modal.modes-miss-equation")


def _normal(problem: ReducedProblem, shapes: FloatArray) -> FloatArray:
    """Shapes of generalised mass one."""
    mass = np.einsum("ij,ij->j", shapes, problem.M @ shapes)
    return shapes / np.sqrt(np.where(mass > 0.0, mass, 1.0))


def between(problem: ReducedProblem, low: float, high: float) -> Pairs:
    """All eigenvalues in [low, high], increasing; about zero those that rounding may have moved."""
    check(problem)
    middle, count = 0.5 * (low + high), 12
    if low <= 0.0 <= high:
        beside = BESIDE * largest_value(problem)
        low, high = min(low, -beside), max(high, beside)
    while True:
        found = nearest(problem, middle, count)
        inside = (found.values >= low) & (found.values <= high)
        if not inside.all() or len(found.values) < count or count >= problem.size:
            order = np.argsort(found.values[inside], kind="stable")
            return Pairs(found.values[inside][order], found.shapes[:, inside][:, order])
        count *= 2
