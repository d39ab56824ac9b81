"""Large problems with supports at rest, set up for `march_interleaved`."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.dynamics.compiled_loop import Joints, Motion, Saved
from ssilang.kernel.dynamics.dense_loop import joints_of
from ssilang.kernel.dynamics.effective import Effective, RootResponse, root_response
from ssilang.kernel.dynamics.interleaved_march import (
    Flow,
    Kept,
    Plan,
    Sparse,
    march_interleaved,
)
from ssilang.kernel.dynamics.problem import Problem
from ssilang.kernel.joints.condensed_cached import workspace
from ssilang.kernel.mesh.nodes import FloatArray, IntArray
from ssilang.kernel.solvers.dissected import DissectedFactor
from ssilang.kernel.solvers.triangular import longest
from ssilang.kernel.sparse import sp

BRANCH = 64_000  # numbers of a branch of the factor: half of a megabyte, the cache of a core
BLOCK = 64  # steps between two evaluations of the equilibrium from the displacements


def fits(problem: Problem, effective: Effective) -> bool:
    """Whether `InterleavedLoop` can run a problem.

    Supports at rest, associated relations, no unilateral ones, and a factor by dissection.
    """
    C, c = problem.constraints.C, problem.constraints
    if problem.contact is not None or not c.associated or effective.inverse.singular:
        return False
    if problem.loading.imposed.any() or np.any(C @ problem.u) or np.any(C @ problem.v):
        return False
    if problem.interface is not None and root_response(effective.inverse, effective.right) is None:
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
        root = root_response(inverse, effective.right)
        if root is None:
            root = RootResponse(np.zeros((q, 0)), np.zeros((0, q)))
        branches, trunk = _cut(factor, root.J.shape[1] > 0)
        self.plan = Plan(
            factor.panels, branches, trunk, len(factor.panels.first) - 2 + (root.J.shape[1] == 0),
            _rows(self.M), _all_rows(self.C), self.C.nnz > 0, self.forces, root.J, root.Y,
            effective.S, effective.R if effective.R.any() else np.zeros((0, 0)),
            (s.alpha_m, s.alpha_f, s.beta, s.gamma, effective.dt), longest(factor.panels),
        )  # fmt: skip
        joints = joints_of(problem) if problem.interface is None else None
        self.joints = joints or _joints_without_rows(problem)
        self.J = sp.csr_array((0, n)) if problem.interface is None else problem.interface.J @ self.T
        self.newton = workspace(q, motion.w, motion.state)
        gram = sp.csr_array(self.T.T @ self.T)
        self._gram_diagonal = gram.diagonal()
        self._gram = None if gram.nnz == n else sp.csc_array(gram)

    def _reduced(self, A: sp.csr_array) -> sp.csr_array:
        return sp.csr_array(self.T.T @ A @ self.T)

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        """As `compiled_loop.march`."""
        worst, steps = 0, len(save)
        for first in range(0, steps, BLOCK):
            last = min(first + BLOCK, steps)
            flow, rows = self._flow(factors[first]), save[first:last]
            chosen = np.flatnonzero(rows >= 0)
            places = np.where(rows >= 0, np.cumsum(rows >= 0) - 1, -1)
            kept = self._room(len(chosen))
            done, turns, residual = march_interleaved(
                self.plan, self.joints, flow, self.newton,
                np.ascontiguousarray(factors[first : last + 1]), places, kept,
                history[first:last],
            )  # fmt: skip
            self._unfold(flow, factors[first + done])
            for row, k in enumerate(chosen[chosen < done]):
                self._keep(kept, row, factors[first + k + 1], saved, int(rows[k]))
            if turns <= 0:
                return first + done, turns, residual
            worst = max(worst, turns)
        return steps, worst, 0.0

    def _flow(self, factors: FloatArray) -> Flow:
        """The motion on the loop's unknowns, with the forces of equilibrium from scratch."""
        m = self.motion
        u, v, a = (self._folded(x) for x in (m.u, m.v, m.a))
        Cv, Ca = self.C @ v, self.C @ a
        g = self.K @ u + Cv + self.J.T @ m.f - self.forces.T @ factors
        return Flow(
            u, v, a, g, self.M @ v, self.M @ a, Cv, Ca, self.forces @ u, m.delta, m.f, m.w, m.t,
            m.state, m.energies,
        )  # fmt: skip

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

    def _unfold(self, flow: Flow, factors: FloatArray) -> None:
        m = self.motion
        m.u[:], m.v[:], m.a[:] = self.T @ flow.u, self.T @ flow.v, self.T @ flow.a
        m.reaction[:] = self._reaction(m.u, m.v, m.a, m.f, factors)

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

    def _room(self, rows: int) -> Kept:
        m, n = self.motion, self.T.shape[1]
        return Kept(
            np.zeros((rows, n)), np.zeros((rows, n)), np.zeros((rows, n)),
            np.zeros((rows, len(m.f))), np.zeros((rows, *m.w.shape)),
            np.zeros((rows, *m.t.shape)), np.zeros((rows, *m.state.shape)),
        )  # fmt: skip

    def _keep(self, kept: Kept, row: int, factors: FloatArray, saved: Saved, to: int) -> None:
        u, v, a = self.T @ kept.u[row], self.T @ kept.v[row], self.T @ kept.a[row]
        saved.u[to], saved.v[to], saved.a[to] = u, v, a
        saved.reaction[to] = self._reaction(u, v, a, kept.f[row], factors)
        saved.w[to], saved.t[to], saved.state[to] = kept.w[row], kept.t[row], kept.state[row]


def _joints_without_rows(problem: Problem) -> Joints:
    """Interface arrays without the dense J, that large problems never need."""
    joints = problem.interface
    assert joints is not None
    return Joints(
        np.zeros((0, 0)), joints.pairs, joints.B, joints.weights, joints.codes,
        np.ascontiguousarray(joints.parameters),
    )  # fmt: skip


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
