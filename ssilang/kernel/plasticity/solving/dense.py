"""Newton's method of small yielding models with dense matrices: what bounds it is calls.

The same iteration as `BulkSolver`, on the motions that the conditions leave. Where the terms of a
tangent go in their matrix is found once.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface import response
from ssilang.kernel.plasticity.bulk import Answer, Bulk, State
from ssilang.kernel.plasticity.newton import RIGID, BulkSolver, BulkTrial
from ssilang.kernel.plasticity.solving.positive import Pattern
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import Motion

FEW = 240
"""Unknowns up to which matrices are dense."""


class DenseSolver(BulkSolver):
    """The step of `BulkSolver` with dense matrices."""

    factor = "LAPACK"

    def __init__(
        self, problem: Problem, A: sp.csr_array, share: float, bulk: Bulk, state: State
    ) -> None:
        super().__init__(problem, A, share, bulk, state)
        T, V = self.constraints.T, self.constraints.V
        self._dense, self._T, self._Vt = A.toarray(), T.toarray(), V.T.toarray()
        self._reduced = self._Vt @ self._dense @ self._T
        self._placed = places_of(bulk.terms, V, T, share)
        self._stiff = float(np.abs(A.data).max(initial=0.0))
        J = problem.interface.J.toarray()
        self._nothing, self._none = response.new_trial((0, 0), 0), np.zeros((0, 0))
        self._at_play = np.zeros((5, A.shape[0]))
        self._J, self._JT, self._VJ = J, J @ self._T, self._Vt @ J.T

    def _trial(
        self, motion: Motion, r: FloatArray, du: FloatArray, pushed: FloatArray,
        answer: Answer | None = None,
    ) -> BulkTrial:  # fmt: skip
        answer = answer or self.bulk.respond(self.state, du, self.time, True)
        at_play = self._at_play
        at_play[0], at_play[2], at_play[3] = r, answer.force, self.force
        linear = np.dot(self._dense, du, out=at_play[1])
        free = r - linear - self.share * (answer.force - self.force)
        joints, K = self._nothing, self._none
        if self.interface:
            joints = response.new_trial(motion.w.shape, len(motion.f))
            K, at_play[4] = self._jumped(motion, du, joints)
            free -= at_play[4]
        rest = self._Vt @ free
        stiff = max(self._stiff, _largest(answer.terms))
        floor = RIGID * stiff * min(_largest(du), self.extent)
        scale = max(float(np.abs(at_play).max(axis=1).sum()), floor, 1e-300)
        return BulkTrial(du, answer, K, joints, rest, _largest(rest) / scale, free, pushed)

    def _jumped(
        self, motion: Motion, du: FloatArray, trial: response.Trial
    ) -> tuple[FloatArray, FloatArray]:
        """Stiffness (q, q) of the joints, forces (n,) by which they differ from the start."""
        joints = self.interface
        trial.y[:] = self._J @ du
        trial.delta[:] = motion.delta + trial.y
        response.interface_response(joints.points, motion.state, trial.delta, trial)
        force = self.share * (self._J.T @ (trial.f - motion.f))
        return self._joint_stiffness(joints, trial).toarray(), force

    def _corrected(
        self, motion: Motion, now: BulkTrial, gap: FloatArray, held: FloatArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """What the tangents of a trial ask for beyond it, beside a motion of the supports."""
        whole = self._reduced + (self._placed @ now.answer.terms).reshape(self._reduced.shape)
        if self.interface:
            whole += self._VJ @ (now.K @ self._JT)
        rest = now.rest
        if held is not None:
            moved = self._dense @ held + self.share * (now.answer.tangent @ held)
            if self.interface:
                moved += self._J.T @ (now.K @ (self._J @ held))
            rest = rest - self._Vt @ moved
        try:
            return self._T @ np.asarray(np.linalg.solve(whole, rest), float), now.pushed
        except np.linalg.LinAlgError as error:
            raise SingularFactorError(str(error)) from None


def _largest(x: FloatArray) -> float:
    return float(np.abs(x).max()) if len(x) else 0.0


def places_of(terms: Pattern, V: sp.csr_array, T: sp.csr_array, share: float) -> sp.csr_array:
    """What takes terms (nnz,) to the rows of `share V^T K T`, one behind the other: (r r, nnz)."""
    row = np.repeat(np.arange(len(terms.indptr) - 1), np.diff(terms.indptr))
    left, right = sp.csr_array(V), sp.csr_array(T)
    of_left, of_right = np.diff(left.indptr)[row], np.diff(right.indptr)[terms.indices]
    count = of_left * of_right
    term = np.repeat(np.arange(len(row)), count)
    inner = np.arange(len(term)) - np.repeat(np.cumsum(count) - count, count)
    i = left.indptr[row][term] + inner // of_right[term]
    j = right.indptr[terms.indices][term] + inner % of_right[term]
    size, values = T.shape[1], share * left.data[i] * right.data[j]
    places = left.indices[i].astype(np.int64) * size + right.indices[j]
    shape = (size * size, len(row))
    return sp.csr_array(sp.coo_array((values, (places, term)), shape=shape))


def is_small(problem: Problem, bulk: Bulk) -> bool:
    """Whether matrices may be dense: few unknowns, small strains, no contact, no solver asked."""
    plain = type(bulk) is Bulk and len(bulk.zones) > 0 and not problem.contact
    return plain and problem.numbering.size <= FEW and problem.solver.name is None
