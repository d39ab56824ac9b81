"""Small dense problems of contact with Coulomb's friction.

Unknowns are the reactions p (m,) of unilateral rows, the frictions tau (k, d) of k places (d = 1
in the plane, 2 in space) and amplitudes a (f,) of free motions. With lam = (p, tau),

    (w, s, b) = q + W lam + B a        r + E^T lam = 0
    w >= 0, p >= 0, w p = 0
    |tau_i| <= limit_i,   s_i = -gamma_i tau_i, gamma_i >= 0 and zero where |tau_i| < limit_i

limit_i is `coefficient p + constant` of its closed row (0 where that is open), or, for places
without a row, max(b_i, 0). s are slips of a step. Newton's method on the projections of Alart and
Curnier (1991); block Gauss-Seidel sweeps (Jean and Moreau 1992) where it does not end.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.base.scientific import la
from ssilang.kernel.solvers.active_set.complementarity import (
    HUGE,
    ROUNDING,
    natural_motion,
)

TURNS = 60
"""Newton's turns before the sweeps, and after them."""
SWEEPS = 3000
TOLERANCE = 1e-11
"""What is wrong with an accepted solution, relative to its own size."""
RANK = 1e-12
"""Reciprocal condition below which rows are redundant, and their share of it rounding."""


@dataclass(frozen=True, eq=False)
class CoulombProblem:
    """See the module; `normal` (k,) is the row of each place, -1 for places without one.

    W (m + k d + k, m + k d) and q hold the rows w, then s place by place, then b.
    """

    W: FloatArray
    q: FloatArray
    B: FloatArray
    E: FloatArray
    r: FloatArray
    n_normal: int
    width: int
    normal: IntArray
    coefficient: FloatArray
    constant: FloatArray

    @property
    def n_places(self) -> int:
        """Number of places that rub."""
        return len(self.normal)

    @property
    def n_forces(self) -> int:
        """Number of reactions and frictions."""
        return self.n_normal + self.n_places * self.width


@dataclass(frozen=True, eq=False)
class CoulombSolution:
    """Reactions and frictions lam, amplitudes of free motions, places that stick, turns taken."""

    forces: FloatArray
    a: FloatArray
    sticking: BoolArray
    turns: int


@dataclass(eq=False)
class _Trial:
    """A trial: unknowns x = (lam, a) and what they say."""

    x: FloatArray
    closed: BoolArray
    sticking: BoolArray
    sliding: BoolArray
    y: FloatArray
    limit: FloatArray

    @property
    def key(self) -> bytes:
        return self.closed.tobytes() + self.sticking.tobytes() + self.sliding.tobytes()


def solve_coulomb(problem: CoulombProblem, start: FloatArray | None = None) -> CoulombSolution:
    """Reactions and frictions in equilibrium; `start` (m + k d,) is a guess of them.

    Raises
    ------
    ConvergenceError
        If no equilibrium is found: a body held by friction alone that the loads drive away, or
        rows that contradict each other.
    """
    solver = _Solver(problem)
    known = start is not None and bool(start.any())
    first = np.zeros(solver.size)
    if start is not None and known:
        first[: problem.n_forces] = start
    found = solver.newton(first) if known else None
    found = found or solver.newton(np.zeros(solver.size), fresh=True)
    if found is None and not known:
        found = solver.newton(first)
    if found is None:
        found = solver.newton(solver.sweep(first))
    if found is None:
        raise ConvergenceError("kernel.solvers.no-state-contact-friction")
    return found


class _Solver:
    """The problem with its scales: forces that make one unit of motion of each row."""

    def __init__(self, problem: CoulombProblem) -> None:
        self.p = problem
        p, m = problem, problem.n_normal
        self.size = p.n_forces + p.B.shape[1]
        whole = np.abs(np.diag(p.W[: p.n_forces]))
        largest = float(whole.max(initial=0.0)) or 1.0
        flexible = np.maximum(whole, 1e-8 * largest)
        self.rn = 1.0 / flexible[:m]
        self.rt = 1.0 / flexible[m:].reshape(-1, p.width).max(axis=1, initial=0.0)
        self.unit = 1.0 / largest
        self.natural = natural_motion(p.W, p.q, p.E, p.r)

    # --- what a trial says

    def observed(self, x: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Gaps (m,), slips (k, d), limits of places without a row (k,)."""
        p, n = self.p, self.p.n_forces
        seen = p.q + p.W @ x[:n] + p.B @ x[n:]
        return seen[: p.n_normal], seen[p.n_normal : n].reshape(-1, p.width), seen[n:]

    def trial(self, x: FloatArray) -> _Trial:
        p, m = self.p, self.p.n_normal
        w, s, b = self.observed(x)
        push = x[:m] - self.rn * w
        closed = push > 0.0
        limit = self.limits(x[:m], closed, b)
        tau = x[m : p.n_forces].reshape(-1, p.width)
        y = tau - self.rt[:, None] * s
        size = np.linalg.norm(y, axis=1)
        rubbing = limit > 0.0
        sticking = rubbing & (size <= limit)
        return _Trial(x, closed, sticking, rubbing & ~sticking, y, limit)

    def limits(self, pushes: FloatArray, closed: BoolArray, b: FloatArray) -> FloatArray:
        p = self.p
        own = p.normal >= 0
        found = np.where(own, 0.0, np.maximum(b, 0.0))
        rows = p.normal[own]
        bound = p.coefficient[own] * np.maximum(pushes[rows], 0.0) + p.constant[own]
        found[own] = np.where(closed[rows], bound, 0.0)
        return found

    # --- Newton

    def newton(self, x: FloatArray, fresh: bool = False) -> CoulombSolution | None:
        """Newton from x (or from rows that the loads close and places that stick)."""
        now = self.first() if fresh else self.trial(x)
        seen: set[bytes] = set()
        last = np.inf
        for turn in range(1, TURNS + 1):
            x = self.solved(now)
            if not np.isfinite(x).all():
                return None
            after = self.trial(x)
            same, error = after.key == now.key, self.violation(after)
            if error <= TOLERANCE or (same and 0.5 * last < error <= ROUNDING):
                return self.solution(after, turn)
            if self.p.width == 1 and not same and after.key in seen:
                return None
            seen.add(after.key)
            now, last = after, error
        return self.solution(now, TURNS) if self.violation(now) <= ROUNDING else None

    def first(self) -> _Trial:
        p = self.p
        m, free = p.n_normal, p.B.shape[1] > 0
        closed = np.ones(m, bool) if free else p.q[:m] < 0.0
        touching = np.where(p.normal >= 0, closed[p.normal] if m else False, True)
        none = np.zeros(p.n_places, bool)
        y = np.zeros((p.n_places, p.width))
        return _Trial(np.zeros(self.size), closed, touching, none, y, none.astype(float))

    def solved(self, g: _Trial) -> FloatArray:
        """The unknowns that meet the equations of a state, linearised about the trial."""
        p, m, n = self.p, self.p.n_normal, self.p.n_forces
        A = np.zeros((self.size, self.size))
        right = np.zeros(self.size)
        on, off = np.flatnonzero(g.closed), np.flatnonzero(~g.closed)
        self._rows_seen(A, right, on, on)
        A[off, off] = self.unit
        places = np.arange(p.n_places)
        for j in range(p.width):
            rows = m + places * p.width + j
            held = rows[g.sticking]
            self._rows_seen(A, right, held, held)
            idle = rows[~g.sticking & ~g.sliding]
            A[idle, idle] = self.unit
        self._sliding_rows(A, right, g)
        A[n:, :n] = p.E.T
        right[n:] = -p.r
        return self._balanced(A, right)

    def _rows_seen(self, A: FloatArray, right: FloatArray, to: IntArray, rows: IntArray) -> None:
        n = self.p.n_forces
        A[to, :n], A[to, n:], right[to] = self.p.W[rows], self.p.B[rows], -self.p.q[rows]

    def _sliding_rows(self, A: FloatArray, right: FloatArray, g: _Trial) -> None:
        """`tau = limit n`, n the direction of y; in space n turns with y."""
        p, m, n = self.p, self.p.n_normal, self.p.n_forces
        for i in np.flatnonzero(g.sliding):
            size = float(np.linalg.norm(g.y[i]))
            way = g.y[i] / size
            rows = m + i * p.width + np.arange(p.width)
            A[rows, rows] += self.unit
            bent = (g.limit[i] / size) * (np.eye(p.width) - np.outer(way, way))
            if p.width > 1:  # d n (dtau - rt ds) / |y|; n itself does not change along y
                A[np.ix_(rows, rows)] -= self.unit * bent
                A[rows, :n] += self.unit * self.rt[i] * bent @ p.W[rows]
                A[rows, n:] += self.unit * self.rt[i] * bent @ p.B[rows]
                right[rows] -= self.unit * self.rt[i] * bent @ p.q[rows]
            row = int(p.normal[i])
            if row >= 0:
                A[rows, row] -= self.unit * p.coefficient[i] * way
                right[rows] += self.unit * p.constant[i] * way
            else:
                A[rows, :n] -= self.unit * np.outer(way, p.W[n + i])
                A[rows, n:] -= self.unit * np.outer(way, p.B[n + i])
                right[rows] += self.unit * p.q[n + i] * way

    def _balanced(self, A: FloatArray, right: FloatArray) -> FloatArray:
        """Solution with rows of one size; forces and free motions have their own units.

        Redundant rows share their force in the measure of their stiffness: the forces are
        counted by the root of it, and the solution is the least.
        """
        n, m, width = self.p.n_forces, self.p.n_normal, self.p.width
        columns = np.ones(self.size)
        columns[:m], columns[m:n] = np.sqrt(self.rn), np.repeat(np.sqrt(self.rt), width)
        columns[:n] *= np.sqrt(self.unit)
        scaled = A * columns
        sizes = np.abs(scaled).max(axis=1)
        sizes[sizes == 0.0] = 1.0
        return columns * _least(scaled / sizes[:, None], right / sizes)

    # --- what is wrong with a trial

    def violation(self, g: _Trial) -> float:
        """The largest violation of any condition, relative to forces and motions at play."""
        p, m, n = self.p, self.p.n_normal, self.p.n_forces
        lam = g.x[:n]
        w, s, _ = self.observed(g.x)
        force = float(np.abs(lam).max(initial=0.0))
        parts = (p.q[:n], (p.W @ lam)[:n], (p.B @ g.x[n:])[:n])
        motion = max((float(np.abs(part).max(initial=0.0)) for part in parts), default=0.0)
        if motion > HUGE * self.natural:
            return np.inf
        motion = motion or 1e-300
        force = max(force, motion * self.unit, 1e-300)
        reach = np.maximum(lam[:m] - self.rn * w, 0.0)
        found = [_size(lam[:m] - reach, force), _size(np.minimum(w, 0.0), motion)]
        length = np.linalg.norm(g.y, axis=1)
        drawn = np.minimum(1.0, g.limit / np.where(length > 0.0, length, 1.0))
        tau = lam[m:].reshape(-1, p.width)
        found.append(_size(tau - drawn[:, None] * g.y, force))
        found.append(_size(s[g.sticking], motion))
        if len(p.r):
            scale = np.abs(p.r).max() + np.abs(p.E).max() * force
            found.append(_size(p.r + p.E.T @ lam, float(scale)))
        return max(found)

    def solution(self, g: _Trial, turns: int) -> CoulombSolution:
        n, m = self.p.n_forces, self.p.n_normal
        forces = g.x[:n].copy()
        forces[:m] = np.where(g.closed, np.maximum(forces[:m], 0.0), 0.0)
        return CoulombSolution(forces, g.x[n:], g.sticking, turns)

    # --- sweeps

    def sweep(self, x: FloatArray) -> FloatArray:
        """Rows and places one after the other, many times; free motions follow by springs."""
        p, n = self.p, self.p.n_forces
        W, q, x = p.W.copy(), p.q.copy(), x.copy()
        weak = np.zeros((0, n))
        if p.B.shape[1]:  # a = (r + E^T lam)/eps, eps small against the rows' own stiffness
            size = float(np.abs(p.B[:n] @ p.E.T).max(initial=0.0)) or 1.0
            soft = 100.0 / self.unit / size
            weak = soft * p.E.T
            W, q = W + p.B @ weak, q + p.B @ (soft * p.r)
        lam = x[:n]
        for _ in range(SWEEPS):
            before = lam.copy()
            self._one_sweep(W, q, lam)
            if np.abs(lam - before).max(initial=0.0) <= 1e-12 * np.abs(lam).max(initial=0.0):
                break
        if p.B.shape[1]:
            x[n:] = weak @ lam + 100.0 / self.unit / size * p.r
        return x

    def _one_sweep(self, W: FloatArray, q: FloatArray, lam: FloatArray) -> None:
        p, m, n, d = self.p, self.p.n_normal, self.p.n_forces, self.p.width
        for i in range(m):
            flexible = max(W[i, i], 1e-300)
            lam[i] = max(0.0, lam[i] - (q[i] + W[i] @ lam) / flexible)
        for i in range(p.n_places):
            rows = slice(m + i * d, m + (i + 1) * d)
            row = int(p.normal[i])
            limit = q[n + i] + W[n + i] @ lam
            if row >= 0:
                limit = p.coefficient[i] * lam[row] + p.constant[i] if lam[row] > 0.0 else 0.0
            trial = lam[rows] - (q[rows] + W[rows] @ lam) / max(W[rows, rows].trace(), 1e-300) * d
            size = float(np.linalg.norm(trial))
            lam[rows] = trial * min(1.0, max(limit, 0.0) / size) if size > 0.0 else 0.0


def _least(A: FloatArray, b: FloatArray) -> FloatArray:
    """Solution of A x = b; of rank below its size, the least x with the least left over.

    A small residual does not tell that the rank is full, and a little added to the diagonal
    (1e-12 of it) would multiply the rounding of b (1e-16) by its inverse in what is shared.
    """
    if len(b) == 0:
        return b
    factors, pivots, info = la.lapack.dgetrf(A)
    if info == 0 and la.lapack.dgecon(factors, np.abs(A).sum(axis=0).max())[0] > RANK:
        return np.asarray(la.lapack.dgetrs(factors, pivots, b)[0], dtype=np.float64)
    return la.lstsq(A, b, cond=RANK)[0]


def _size(values: FloatArray, scale: float) -> float:
    return float(np.abs(values).max(initial=0.0)) / scale
