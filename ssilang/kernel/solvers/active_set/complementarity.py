"""Small dense contact problems: which unilateral conditions are active, and their reactions."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray
from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.base.scientific import la, optimize

PENALTY = (100.0, 1e7)  # least and largest, of equilibrium against energy, in scaled unknowns
SMALL = 1e-10  # energy of its own of each row, relative to the mean
PASSES = 100  # of the augmented Lagrangian
ROUNDING = 1e-8  # how wrong, relative to the largest, rows may be that only rounding decides
HUGE = 1e7  # motions of the rows, relative to gaps and loads, that no equilibrium has
ALL_AT_ONCE = 20  # iterations that may change several rows; later ones change a single row


@dataclass(frozen=True, eq=False)
class ContactProblem:
    """Find p (m,) and a (k,) with `w = q + W p + B a`, `r + E^T p = 0`, and row by row
    `w >= 0, p >= 0, w p = 0`; on rows in `equality` just `w = 0`.

    W is the flexibility of the rows; the columns of B, E (m, k) are free motions of the body
    (k = 0 for a body that is held without contact) and r is the work of the loads on them.
    """

    W: FloatArray
    q: FloatArray
    B: FloatArray
    E: FloatArray
    r: FloatArray
    equality: BoolArray


@dataclass(frozen=True, eq=False)
class ContactSolution:
    """Reactions, amplitudes of the free motions, active rows, iterations taken."""

    p: FloatArray
    a: FloatArray
    active: BoolArray
    iterations: int


def solve_contact(problem: ContactProblem, start: BoolArray | None = None) -> ContactSolution:
    """Active-set iterations from `start` (default: rows that the loads close).

    All wrong rows change at once; when that has gone on for `ALL_AT_ONCE` iterations or comes
    back to a set it has seen, only the first wrong row changes (Murty's rule, which cannot cycle
    when W is a P-matrix). Bodies held by contact alone start with all rows active.

    Raises
    ------
    ConvergenceError
        If no set of active rows gives equilibrium, or the iterations do not end.
    """
    m, k = problem.B.shape
    held = k == 0
    active = problem.equality | (problem.q < 0.0 if held else np.ones(m, bool))
    if start is not None and held:
        active = problem.equality | start
    limit = 50 + 20 * m
    found = _iterate(problem, active, limit)
    if found is None and (np.diag(problem.W) < 0.0).any():
        raise ConvergenceError("kernel.solvers.no-set-active-unilateral")
    if found is None and _symmetric(problem):
        guess = _least_energy(problem)
        found = _iterate(problem, guess, limit, one_by_one=True) or _accepted(problem, guess)
    if found is None:
        raise ConvergenceError("kernel.solvers.no-set-of-conditions-holds-body")
    return found


def _iterate(
    problem: ContactProblem, active: BoolArray, limit: int, one_by_one: bool = False
) -> ContactSolution | None:
    """Active-set iterations; None if they end nowhere."""
    held = problem.B.shape[1] == 0
    seen: set[bytes] = set()
    for iteration in range(1, limit + 1):
        p, a, holds = _solve_active(problem, active)
        if not holds and not one_by_one:
            one_by_one, active = True, np.ones(len(active), bool)
            continue
        if not holds:
            return None
        wrong = _wrong_rows(problem, active, p, a)
        if not wrong.any():
            return ContactSolution(np.where(active, p, 0.0), a, active, iteration)
        if one_by_one and not held and active.tobytes() in seen:
            return None
        one_by_one = one_by_one or iteration > ALL_AT_ONCE or active.tobytes() in seen
        seen.add(active.tobytes())
        active = active ^ (_one_of(wrong, active, p, held) if one_by_one else wrong)
    return None


def _symmetric(problem: ContactProblem) -> bool:
    W, E = problem.W, problem.E
    near = 1e-9 * np.abs(W).max(initial=0.0)
    same = 1e-9 * np.abs(E).max(initial=0.0)
    return bool(np.abs(W - W.T).max(initial=0.0) <= near) and bool(
        np.abs(E - problem.B).max(initial=0.0) <= same
    )


def _least_energy(problem: ContactProblem) -> BoolArray:
    """Rows that push where `p W p / 2 + q p` is least over p >= 0 with `r + E^T p = 0`.

    Equilibrium is met by an augmented Lagrangian; each minimum is a non-negative least-squares
    problem (Lawson & Hanson), which ends whatever the rows.
    """
    scale = np.sqrt(np.diag(problem.W).clip(0.0))
    scale = 1.0 / np.where(scale > 1e-12 * scale.max(initial=0.0), scale, scale.max() or 1.0)
    E = scale[:, None] * problem.E
    norm = np.linalg.norm(E, axis=0)
    norm[norm == 0.0] = 1.0
    E, r = E / norm, problem.r / norm
    largest = np.abs(scale * problem.q).max(initial=0.0) / (np.abs(r).max(initial=0.0) or 1.0)
    penalty = float(np.clip(10.0 * largest, *PENALTY))
    H = scale[:, None] * problem.W * scale
    # opposite rows (MINI and MAXI of one unknown) have no energy together: a little of their own
    H[np.diag_indices_from(H)] += SMALL * (np.trace(H) / len(H) or 1.0)
    H += penalty * E @ E.T
    values, vectors = la.eigh(0.5 * (H + H.T))
    root = np.sqrt(values.clip(1e-3 * SMALL * values[-1]))
    R = root[:, None] * vectors.T
    both = np.hstack([R, -R[:, problem.equality]])
    p, shift = np.zeros(len(scale)), np.zeros(len(r))
    for _ in range(PASSES):
        g = scale * problem.q + penalty * E @ (r + shift)
        try:
            p = optimize.nnls(both, -(vectors.T @ g) / root, maxiter=30 * len(both.T))[0]
        except RuntimeError:  # too many iterations
            break
        p = p[: len(scale)]
        off = r + E.T @ p
        shift += off
        if np.abs(off).max(initial=0.0) <= 1e-12 * np.abs(r).max(initial=0.0):
            break
    active: BoolArray = problem.equality | (p > 1e-9 * p.max(initial=0.0))
    return active


def _accepted(problem: ContactProblem, active: BoolArray) -> ContactSolution | None:
    """The solution for a set of rows if it is wrong by rounding only, else None."""
    p, a, holds = _solve_active(problem, active)
    if not holds or _wrong_rows(problem, active, p, a, ROUNDING).any():
        return None
    return ContactSolution(np.where(active, p, 0.0), a, active, 1)


def _solve_active(
    problem: ContactProblem, active: BoolArray
) -> tuple[FloatArray, FloatArray, bool]:
    """Reactions of the active rows, motions, and whether equilibrium holds."""
    k = problem.B.shape[1]
    chosen = np.flatnonzero(active)
    n = len(chosen)
    system = np.zeros((n + k, n + k))
    system[:n, :n] = problem.W[np.ix_(chosen, chosen)]
    system[:n, n:] = problem.B[chosen]
    system[n:, :n] = problem.E[chosen].T
    right = -np.concatenate([problem.q[chosen], problem.r])
    scale = float(np.sqrt(np.abs(np.diag(problem.W)).max(initial=0.0))) or 1.0
    weights: FloatArray = np.concatenate([np.full(n, 1.0 / scale), np.full(k, scale)])
    solution = weights * least_squares(weights[:, None] * system * weights, weights * right)
    error = np.abs(system @ solution - right)
    size = np.abs(system) @ np.abs(solution) + np.abs(right)
    holds = bool((error[n:] <= 1e-7 * size[n:].max(initial=0.0) + 1e-300).all())
    p = np.zeros(len(active))
    p[chosen] = solution[:n]
    return p, solution[n:], holds and _of_natural_size(problem, p, solution[n:])


def natural_motion(W: FloatArray, q: FloatArray, E: FloatArray, r: FloatArray) -> float:
    """Size of the motions of rows that gaps q and loads r make, of flexibility W."""
    push = np.abs(r).max(initial=0.0) / (np.abs(E).max(initial=0.0) or 1.0)
    return float(np.abs(q).max(initial=0.0) + np.abs(W).max(initial=0.0) * push)


def _of_natural_size(problem: ContactProblem, p: FloatArray, a: FloatArray) -> bool:
    """False for the huge numbers that contradictory rows give (a stop on both sides at once)."""
    natural = natural_motion(problem.W, problem.q, problem.E, problem.r)
    moved = np.abs(problem.W @ p).max(initial=0.0) + np.abs(problem.B @ a).max(initial=0.0)
    return natural == 0.0 or bool(moved <= HUGE * natural)  # rigid and touching: only rounding


def least_squares(A: FloatArray, b: FloatArray) -> FloatArray:
    """Solution of A x = b, of least norm if A is singular (redundant rows)."""
    if len(b) == 0:
        return b
    try:
        x: FloatArray = np.asarray(np.linalg.solve(A, b), dtype=float)
        if np.abs(A @ x - b).max() <= 1e-9 * (np.abs(A) @ np.abs(x) + np.abs(b)).max():
            return x
    except np.linalg.LinAlgError:
        pass
    return la.lstsq(A, b, cond=1e-12)[0]


def _wrong_rows(
    problem: ContactProblem,
    active: BoolArray,
    p: FloatArray,
    a: FloatArray,
    tolerance: float = 1e-12,
) -> BoolArray:
    w = problem.q + problem.W @ p + problem.B @ a
    parts = (problem.q, problem.W @ p, problem.B @ a)
    size = sum(float(np.abs(part).max(initial=0.0)) for part in parts)
    tensile = active & ~problem.equality & (p < -tolerance * np.abs(p).max(initial=0.0))
    crossing = ~active & (w < -tolerance * size)
    return tensile | crossing


def _one_of(wrong: BoolArray, active: BoolArray, p: FloatArray, held: bool) -> BoolArray:
    """The first wrong row; the one with the largest tension for a body held by contact alone."""
    chosen = np.zeros_like(wrong)
    tensile = wrong & active
    if not held and tensile.any() and not (wrong & ~active).any():
        chosen[np.argmin(np.where(tensile, p, np.inf))] = True
    else:
        candidates = wrong & ~active if not held and (wrong & ~active).any() else wrong
        chosen[np.flatnonzero(candidates)[0]] = True
    return chosen
