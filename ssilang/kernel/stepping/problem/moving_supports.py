"""Moving supports as loads on the motions that they leave.

With `u = T q + X c(t)` and `C X` the imposed values of each curve, the unknowns q obey

    T^T (M T q'' + C T q' + K T q + J^T f) = T^T (F - M X c'' - C X c' - K X c)

c' and c'' being what the scheme makes of c, as it makes velocity and acceleration of all unknowns.
An initial motion that the supports do not allow is a further column, whose c ends with the first
step. Energies of q alone are completed by products of the columns with the motion, that follow
from the work of these loads.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.newmark import Newmark, newmark_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import DAMPED, ELASTIC, EXTERNAL, KINETIC, Motion
from ssilang.kernel.stepping.verbs import advance

MOST = 24  # curves of imposed values: each is three loads more
ALLOWED = 1e-12  # rounding errors of a motion that the supports allow


@dataclass(frozen=True, eq=False)
class Columns:
    """Motions X (n, m) of the supports with their products, on all unknowns and on q."""

    X: FloatArray
    MX: FloatArray  # (n, m)
    CX: FloatArray  # (n, m)
    KX: FloatArray  # (n, m)
    forces: FloatArray  # (3 m, r) `-T^T` times these
    lift: FloatArray  # (q, m) jumps


@dataclass(frozen=True, eq=False)
class Course:
    """c, c', c'' at the times of some steps, each (n_steps + 1, m)."""

    c: FloatArray
    v: FloatArray
    a: FloatArray

    def factors(self, n: Newmark) -> FloatArray:
        """Factors (n_steps + 1, 3 m) of the loads on q.

        Those of the inertia are such that a mean by alpha_f is that of c'' by alpha_m.
        """
        inertia = self.a.copy()
        inertia[1:] = (n.inertia_end * self.a[1:] + n.inertia_start * self.a[:-1]) / n.end
        for k in range(len(inertia) - 1 if n.start and inertia.shape[1] else 0):
            inertia[k + 1] -= n.start / n.end * inertia[k]
        return np.hstack([inertia, self.v, self.c])


@dataclass(frozen=True, eq=False)
class Start:
    """The motion at the start of some steps as the columns see it."""

    work: FloatArray  # (3, 3 m) of the columns' loads on q, q' and q''
    joints: FloatArray  # (q,) forces on the jumps


@compiled
def _follow(n: Newmark, c: FloatArray, v: FloatArray, a: FloatArray) -> None:
    """Velocities and accelerations of c, each (n_steps + 1, m), from the first ones on."""
    for k in range(len(c) - 1):
        for j in range(c.shape[1]):
            v[k + 1, j], a[k + 1, j] = advance(n, c[k + 1, j] - c[k, j], v[k, j], a[k, j])


class MovingSupports:
    """The imposed values of a problem, for steps of one length."""

    def __init__(self, problem: Problem, dt: float, T: sp.csr_array) -> None:
        self.problem, self.dt, self._T = problem, dt, T
        imposed = problem.loading.imposed
        self.chosen = np.flatnonzero(np.abs(imposed).max(axis=0, initial=0.0))
        X = [problem.constraints.particular(imposed[:, j]) for j in self.chosen]
        n = problem.numbering.size
        self._own = self._columns(np.array(X).reshape(-1, n).T)

    @property
    def newmark(self) -> Newmark:
        """Coefficients of the steps."""
        return newmark_of(self.problem.scheme, self.dt)

    def _columns(self, X: FloatArray) -> Columns:
        p = self.problem
        MX, CX, KX = p.M @ X, p.C @ X, p.K @ X
        forces = np.ascontiguousarray(-(self._T.T @ np.hstack([MX, CX, KX])).T)
        return Columns(X, MX, CX, KX, forces, p.interface.J @ X)

    def begin(self, motion: Motion, factors: FloatArray) -> tuple[Columns, Course]:
        """Columns, and their course over the times of `factors` (n_steps + 1, k)."""
        p, m = self.problem, len(self.chosen)
        rows, imposed = p.constraints.C, p.loading.imposed[:, self.chosen]
        start, extra = [factors[0, self.chosen]], []
        for x in (motion.v, motion.a):
            start.append(np.linalg.lstsq(imposed, rows @ x, rcond=None)[0])
        for i, x in enumerate((motion.u, motion.v, motion.a)):
            left = rows @ x - imposed @ start[i]
            if np.abs(left).max(initial=0.0) > ALLOWED * np.abs(x).max(initial=0.0):
                extra.append((i, p.constraints.particular(left)))
        if not extra:
            return self._own, self.course(factors[:, self.chosen], start[1], start[2])
        columns = self._columns(np.column_stack([self._own.X, *(x for _, x in extra)]))
        first = np.zeros((3, m + len(extra)))
        first[:, :m] = start
        for j, (i, _) in enumerate(extra):
            first[i, m + j] = 1.0
        c = np.zeros((len(factors), m + len(extra)))
        c[:, :m], c[0] = factors[:, self.chosen], first[0]
        return columns, self.course(c, first[1], first[2])

    def course(self, c: FloatArray, v0: FloatArray, a0: FloatArray) -> Course:
        """The scheme's velocities and accelerations of c, from those at the start."""
        v, a, n = np.zeros(c.shape), np.zeros(c.shape), self.newmark
        if not c.shape[1]:
            return Course(c, v, a)
        v[0], a[0] = v0, a0
        _follow(n, np.ascontiguousarray(c), v, a)
        return Course(c, v, a)

    def complete(
        self, columns: Columns, course: Course, start: Start, works: FloatArray,
        factors: FloatArray, history: FloatArray,
    ) -> None:  # fmt: skip
        """Add to the energies (n_steps, N_ENERGIES) of q what the columns bring.

        Parameters
        ----------
        works : array (2, n_steps, 3 m)
            See `run_interleaved`.
        factors : array (n_steps + 1, k)
            Of the loads of the problem.
        """
        steps, m = len(history), columns.X.shape[1]
        if steps == 0 or m == 0:
            return
        c, v, a = course.c[: steps + 1], course.v[: steps + 1], course.a[: steps + 1]
        rises = works[0, :steps]
        u = start.work[0] + np.vstack([np.zeros(3 * m), np.cumsum(rises, axis=0)])
        motion = self.course(u, start.work[1], start.work[2])
        inertia, damping, strain = (slice(i * m, (i + 1) * m) for i in range(3))
        pulls = np.vstack([columns.lift.T @ start.joints, works[1, :steps, strain]])
        loads = factors[: steps + 1] @ self.problem.loading.forces.T @ columns.X
        X = columns.X
        MXX, CXX, KXX = X.T @ columns.MX, X.T @ columns.CX, X.T @ columns.KX
        reaction = (
            a @ MXX + v @ CXX + c @ KXX + pulls - loads
            - motion.a[:, inertia] - motion.v[:, damping] - u[:, strain]
        )  # fmt: skip
        whole = course.factors(self.newmark)
        dc, before = np.diff(c, axis=0), slice(0, steps)
        external = -0.5 * np.sum((whole[:steps] + whole[1 : steps + 1]) * rises, axis=1)
        external += 0.5 * np.sum(
            (loads[1:] + loads[before] + reaction[1:] + reaction[before]) * dc, axis=1
        )
        lost = -np.sum((v[1:] + v[before]) * rises[:, damping], axis=1)
        lost -= np.sum((motion.v[1:, damping] + motion.v[before, damping]) * dc, axis=1)
        lost += np.sum(((v[1:] + v[before]) @ CXX) * dc, axis=1)
        history[:, EXTERNAL] += np.cumsum(external)
        history[:, DAMPED] += 0.5 * np.cumsum(lost)
        kinetic = -motion.v[1:, inertia] + 0.5 * v[1:] @ MXX
        elastic = -u[1:, strain] + 0.5 * c[1:] @ KXX
        history[:, KINETIC] += np.sum(kinetic * v[1:], axis=1)
        history[:, ELASTIC] += np.sum(elastic * c[1:], axis=1)
