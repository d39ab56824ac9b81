"""Large problems with supports at rest or in motion, set up for `march_interleaved`."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.triangular import longest
from ssilang.kernel.stepping.effective import Effective, RootResponse
from ssilang.kernel.stepping.problem.moving_supports import (
    MOST,
    Columns,
    Course,
    MovingSupports,
    Start,
)
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.problem.rayleigh import split_damping
from ssilang.kernel.stepping.rests.dense.arrays import joints_of
from ssilang.kernel.stepping.rests.dense.loop import Motion, Saved
from ssilang.kernel.stepping.rests.sparse.interleaved_loop import (
    Damping,
    Flow,
    Kept,
    Plan,
    Sparse,
    march_interleaved,
)

BRANCH = 64_000  # numbers of a branch of the factor: half of a megabyte, the cache of a core
BLOCK = 64  # steps between two evaluations of the equilibrium from the displacements


def fits(problem: Problem, effective: Effective) -> bool:
    """Whether `InterleavedLoop` can run a problem.

    Associated relations, no unilateral ones, few curves of imposed values, and a factor by
    dissection.
    """
    if problem.contact is not None or not problem.constraints.associated:
        return False
    if effective.inverse.singular or problem.loading.imposed.any(axis=0).sum() > MOST:
        return False
    if problem.interface is not None and effective.root is None:
        return False
    return isinstance(effective.inverse.factor, DissectedFactor)


class InterleavedLoop:
    """Steps of one dt of a problem that fits."""

    def __init__(self, problem: Problem, motion: Motion, effective: Effective) -> None:
        self.problem, self.motion = problem, motion
        inverse = effective.inverse
        factor = inverse.factor
        assert isinstance(factor, DissectedFactor)
        order = factor.tree.order
        scaled = sp.csr_array(problem.constraints.T @ sp.diags_array(inverse.scale))
        self.T = sp.csr_array(sp.csc_array(scaled)[:, order])
        self.M, self.C, self.K = (self._reduced(A) for A in (problem.M, problem.C, problem.K))
        self.forces = np.ascontiguousarray((self.T.T @ problem.loading.forces).T)
        n, q, s = len(order), effective.S.shape[0], problem.scheme
        root = effective.root
        if root is None:
            root = RootResponse(sp.csr_array((q, 0)), np.zeros((0, q)))
        branches, trunk = _cut(factor, root.J.shape[1] > 0)
        alpha, beta, rest = split_damping(self.C, self.M, self.K)
        self.plan = Plan(
            factor.panels, branches, trunk, len(factor.panels.first) - 2 + (root.J.shape[1] == 0),
            _rows(self.M), Damping(alpha, beta, _all_rows(rest)), self.C.nnz > 0, self.forces,
            np.zeros((q, 0)), _all_rows(root.J), _all_rows(sp.csr_array(root.J.T)), root.Y,
            effective.S, effective.R if effective.R.any() else np.zeros((0, 0)),
            (s.alpha_m, s.alpha_f, s.beta, s.gamma, effective.dt), longest(factor.panels),
        )  # fmt: skip
        self.supports = MovingSupports(problem, effective.dt, self.T)
        self.joints = joints_of(problem)
        self.J = sp.csr_array((0, n)) if problem.interface is None else problem.interface.J @ self.T
        self.newton = workspace(motion.w.shape, q)
        gram = sp.csr_array(self.T.T @ self.T)
        self._gram_diagonal = gram.diagonal()
        self._gram = None if gram.nnz == n else sp.csc_array(gram)

    def alike(self, problem: Problem, motion: Motion) -> InterleavedLoop:
        """The loop of another problem with the same model."""
        other = copy(self)
        other.problem, other.motion = problem, motion
        other.forces = np.ascontiguousarray((self.T.T @ problem.loading.forces).T)
        other.plan = self.plan._replace(forces=other.forces)
        other.supports = MovingSupports(problem, self.plan.scheme[-1], self.T)
        other.newton = workspace(motion.w.shape, len(motion.f))
        return other

    def _reduced(self, A: sp.csr_array) -> sp.csr_array:
        return sp.csr_array(self.T.T @ A @ self.T)

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        """As `compiled_loop.march`."""
        worst, steps = 0, len(save)
        for first in range(0, steps, BLOCK):
            last = min(first + BLOCK, steps)
            rows, given = save[first:last], np.ascontiguousarray(factors[first : last + 1])
            chosen = np.flatnonzero(rows >= 0)
            places = np.where(rows >= 0, np.cumsum(rows >= 0) - 1, -1)
            kept = self.room(len(chosen))
            block = self.block(given)
            done, turns, residual = march_interleaved(
                block.plan, self.joints, block.flow, self.newton, block.factors, places, kept,
                history[first:last], block.works,
            )  # fmt: skip
            self.finish(block, given, history[first : first + done])
            for row, k in enumerate(chosen[chosen < done]):
                self.keep(kept, row, block, int(k) + 1, given[k + 1], saved, int(rows[k]))
            if turns <= 0:
                return first + done, turns, residual
            worst = max(worst, turns)
        return steps, worst, 0.0

    def block(self, factors: FloatArray) -> PreparedBlock:
        """The motion on the loop's unknowns, with the forces of equilibrium from scratch."""
        m, s = self.motion, self.problem.scheme
        columns, course = self.supports.begin(m, factors)
        moved = columns.X.shape[1] > 0
        parts = (course.c[0], course.v[0], course.a[0])
        u, v, a = (
            self._folded(x - columns.X @ p if moved else x)
            for x, p in zip((m.u, m.v, m.a), parts, strict=True)
        )
        plan, whole, extra = self.plan, factors, self.forces.shape[0]
        if moved:
            whole = np.hstack([factors, course.factors(s.alpha_m, s.alpha_f)])
            forces = np.vstack([self.forces, columns.forces])
            lift = np.zeros((len(m.f), whole.shape[1]))
            lift[:, whole.shape[1] - columns.X.shape[1] :] = columns.lift
            plan = plan._replace(forces=forces, lift=lift if lift.any() else lift[:, :0].copy())
        Cv, Ca = self.C @ v, self.C @ a
        g = self.K @ u + Cv + self.J.T @ m.f - plan.forces.T @ whole[0]
        flow = Flow(
            u, v, a, g, self.M @ v, self.M @ a, Cv, Ca, plan.forces @ u, m.delta, m.f, m.w, m.t,
            m.state, m.energies,
        )  # fmt: skip
        own = plan.forces[extra:]
        start = Start(np.array([own @ u, own @ v, own @ a]), m.f.copy())
        works = np.zeros((2, len(factors) - 1, whole.shape[1]))
        return PreparedBlock(plan, flow, columns, course, whole, works, start)

    def finish(self, block: PreparedBlock, factors: FloatArray, history: FloatArray) -> None:
        """The motion and its energies after the steps that were done."""
        m, flow, done = self.motion, block.flow, len(history)
        extra = self.forces.shape[0]
        works = block.works[:, :done, extra:]
        self.supports.complete(block.columns, block.course, block.start, works, factors, history)
        if done:
            m.energies[:] = history[-1]
        m.u[:], m.v[:], m.a[:] = self._unfolded(block, flow.u, flow.v, flow.a, done)
        m.reaction[:] = self._reaction(m.u, m.v, m.a, m.f, factors[done])

    def _unfolded(
        self, block: PreparedBlock, u: FloatArray, v: FloatArray, a: FloatArray, k: int
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Displacement, velocity and acceleration (n,) after k steps."""
        X, c = block.columns.X, block.course
        u, v, a = self.T @ u, self.T @ v, self.T @ a
        if X.shape[1]:
            u, v, a = u + X @ c.c[k], v + X @ c.v[k], a + X @ c.a[k]
        return u, v, a

    def _folded(self, x: FloatArray) -> FloatArray:
        """q of an admissible x = T q."""
        b: FloatArray = self.T.T @ x
        if self._gram is None:
            return b / self._gram_diagonal
        import scipy.sparse.linalg as spla

        if not hasattr(self, "_gram_factor"):
            self._gram_factor = spla.splu(self._gram)
        found: FloatArray = self._gram_factor.solve(b)
        return found

    def _reaction(
        self, u: FloatArray, v: FloatArray, a: FloatArray, f: FloatArray, factors: FloatArray
    ) -> FloatArray:
        p = self.problem
        r: FloatArray = p.M @ a + p.K @ u - p.loading.forces @ factors
        if p.C.nnz:
            r += p.C @ v
        if p.interface is not None:
            r += p.interface.J.T @ f
        return r

    def room(self, rows: int) -> Kept:
        m, n = self.motion, self.T.shape[1]
        return Kept(
            np.zeros((rows, n)), np.zeros((rows, n)), np.zeros((rows, n)),
            np.zeros((rows, len(m.f))), np.zeros((rows, *m.w.shape)),
            np.zeros((rows, *m.t.shape)), np.zeros((rows, *m.state.shape)),
        )  # fmt: skip

    def keep(
        self,
        kept: Kept,
        row: int,
        block: PreparedBlock,
        k: int,
        factors: FloatArray,
        saved: Saved,
        to: int,
    ) -> None:
        u, v, a = self._unfolded(block, kept.u[row], kept.v[row], kept.a[row], k)
        saved.u[to], saved.v[to], saved.a[to] = u, v, a
        saved.reaction[to] = self._reaction(u, v, a, kept.f[row], factors)
        saved.w[to], saved.t[to], saved.state[to] = kept.w[row], kept.t[row], kept.state[row]


@dataclass(frozen=True, eq=False)
class PreparedBlock:
    """Some steps: what `march_interleaved` takes, and the supports' part of the motion."""

    plan: Plan
    flow: Flow
    columns: Columns
    course: Course
    factors: FloatArray
    works: FloatArray
    start: Start


def _rows(A: sp.csr_array) -> Sparse:
    diagonal = A.diagonal()
    if A.nnz == np.count_nonzero(diagonal):
        return Sparse(np.zeros(0, np.int64), np.zeros(0, np.int64), diagonal, True)
    return _all_rows(A)


def _all_rows(A: sp.csr_array) -> Sparse:
    return Sparse(A.indptr.astype(np.int64), A.indices.astype(np.int64), A.data, False)


def _cut(factor: DissectedFactor, has_root: bool) -> tuple[IntArray, IntArray]:
    """Branches of at most BRANCH numbers (first and last supernode), and the trunk."""
    at, parent = factor.panels.at, factor.tree.parent
    count = len(parent)
    lowest = np.arange(count)
    for s in range(count):
        if parent[s] >= 0:
            lowest[parent[s]] = min(lowest[parent[s]], lowest[s])
    whole = count - 1 if has_root else count
    size = at[1:] - at[lowest]
    light = size <= BRANCH
    heads = [
        s for s in range(whole)
        if light[s] and (parent[s] < 0 or parent[s] >= whole or not light[parent[s]])
    ]  # fmt: skip
    covered = np.zeros(count, bool)
    for s in heads:
        covered[lowest[s] : s + 1] = True
    branches = np.array([(lowest[s], s + 1) for s in heads], np.int64).reshape(-1, 2)
    return branches, np.flatnonzero(~covered[:whole]).astype(np.int64)
