"""The compiled loop on the motions that fixed supports leave, for small problems.

Supports that do not move take no part in the loop; displacements, and reactions from
equilibrium, are put back for the instants that are kept.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.equilibrium import reactions
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.arrays import joints_of, jumps_of
from ssilang.kernel.stepping.rests.dense.loop import StepOperators, System, run_dense, sweep_of
from ssilang.kernel.stepping.state import Motion, Outcome, Recorder
from ssilang.kernel.stepping.track import Matrix, View, expand, whole_view


def supports_are_still(problem: Problem) -> bool:
    """Whether no support moves, now or later, and the motions left are orthonormal."""
    C, T = problem.constraints.C, problem.constraints.T
    still = not problem.loading.imposed.any() and not np.any(C @ problem.u)
    return still and np.allclose((T.T @ T).toarray(), np.eye(T.shape[1]), atol=1e-13)


class ReducedLoop:
    """Steps of one dt on `u = T q`."""

    remembered = ("_work",)

    def __init__(self, problem: Problem, motion: Motion, effective: Effective) -> None:
        self.problem, self.motion = problem, motion
        self.T: FloatArray = problem.constraints.T.toarray()
        self.joints = joints_of(problem)
        self._work = workspace(motion.w.shape, len(motion.f))
        n = self.T.shape[1]
        self.system = System(
            self._reduced(problem.K.toarray()),
            self._reduced(problem.M.toarray()),
            self._reduced(problem.C.toarray()),
            np.ascontiguousarray(jumps_of(problem) @ self.T),
            problem.C.nnz > 0,
            np.ascontiguousarray(self.T.T @ problem.loading.forces),
            np.zeros((0, problem.loading.forces.shape[1])),
            np.zeros((0, n)),
            np.zeros((0, n)),
        )
        self.step = StepOperators(
            newmark_of(problem.scheme, effective.dt),
            np.ascontiguousarray(effective.inverse.solve(np.eye(n))),
            np.zeros((n, 0)),
            np.ascontiguousarray(self.T.T @ effective.Y),
            effective.S,
            effective.R if effective.R.any() else np.zeros((0, 0)),
        )

    def _reduced(self, A: FloatArray) -> FloatArray:
        return np.ascontiguousarray(self.T.T @ A @ self.T)

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps on the whole problem's arrays."""
        m, n, r, T = self.motion, self.T.shape[1], recorder, self.T
        few = m._replace(u=T.T @ m.u, v=T.T @ m.v, a=T.T @ m.a, reaction=np.zeros(n))
        u, v, a = (np.zeros((len(r.u), n)) for _ in range(3))
        to = r._replace(u=u, v=v, a=a, reaction=np.zeros((0, n)))
        outcome = run_dense(
            self.system, self.step, self.joints, few, sweep_of(self.system), self._work, factors, to
        )
        m.u[:], m.v[:], m.a[:] = T @ few.u, T @ few.v, T @ few.a
        for part, q in zip((r.u, r.v, r.a), (u, v, a), strict=True):
            part[:] = expand(T, q)
        keep_reactions(self.problem, factors, r)
        react(self.problem, m, factors[outcome[0]])
        return outcome

    def view(self, unknowns: IntArray) -> View:
        """How unknowns follow from all motions."""
        n = self.T.shape[1]
        shapes = whole_view(self.motion, np.arange(n), "reaction").shapes
        return View(np.arange(n), shapes, Matrix(self.T[unknowns]))


def keep_reactions(problem: Problem, factors: FloatArray, kept: Recorder) -> None:
    """Reactions of kept instants, from equilibrium."""
    if len(kept.u):
        loads = factors[1:][kept.row >= 0] @ problem.loading.forces.T
        kept.reaction[:] = reactions(problem, kept.u, kept.v, kept.a, kept.t, loads)


def react(problem: Problem, m: Motion, factors: FloatArray) -> None:
    """Reactions of the motion at load factors (k,), from equilibrium."""
    loads = problem.loading.forces @ factors
    now = (x[None] for x in (m.u, m.v, m.a, m.t, loads))
    m.reaction[:] = reactions(problem, *now)[0]
