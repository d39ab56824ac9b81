"""Steps of yielding bodies that keep their factor: what bodies do beyond it is a load, iterated.

The step `A du + c (F_1 - F_0) + c J^T (f_1 - f_0) = r` is written with a tangent K of the bodies
that was factorised some time before,

    (A + K) du + c J^T (f_1 - f_0) = r - p ,     p = g(du) = c (F_1 - F_0) - K du

For a given p all but the joints is linear: one solve, and Newton's method on the jumps alone
(`interface.condensed`), whatever opens. That makes p the only unknown, `p = g(du(p))`, found by
Anderson's acceleration of the fixed point (Anderson 1965; Walker and Ni 2011, for a linear problem
the same as GMRES). Where it takes many turns the tangent of the state that it has come to is
factorised; where that does not help, Newton's method on all unknowns goes on.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.newton import Workspace, solve_interface, workspace
from ssilang.kernel.interface.response import InterfaceState, accept
from ssilang.kernel.plasticity.bulk import Answer, Bulk, State
from ssilang.kernel.plasticity.newton import RIGID, TOLERANCE, BulkSolver
from ssilang.kernel.solvers.backends import DISSECTION, factor_pays
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.triangular import backward, forward
from ssilang.kernel.stepping.effective import Effective, effective_of, ordering_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import StepOutcome
from ssilang.kernel.stepping.state import Motion

DEPTH = 10  # turns that the acceleration looks back on
PATIENCE = 12  # turns after which the tangent of what has been reached is factorised
RENEWALS = 3  # in a step, before Newton's method on all unknowns
MANY_SOLVES = 1_000  # a factor is compared with iterations as if it served so often
DEPENDENT = 1e-14  # smallest eigenvalue of the turns' products that counts, of the largest


class Acceleration:
    """Anderson's acceleration of `p = g(p)`: the combination of turns with the least residual."""

    def __init__(self, size: int) -> None:
        self._residuals, self._images = np.empty((DEPTH, size)), np.empty((DEPTH, size))
        self._products = np.zeros((DEPTH, DEPTH))
        self._count, self._last = 0, (np.zeros(0), np.zeros(0))

    def forget(self) -> None:
        """Begin anew."""
        self._count, self._last = 0, (np.zeros(0), np.zeros(0))

    def next(self, p: FloatArray, image: FloatArray) -> FloatArray:
        """The next p from the last one and its image g(p)."""
        residual = image - p
        last_residual, last_image = self._last
        self._last = residual, image
        if not len(last_residual):
            return image
        k, m = self._count % DEPTH, min(self._count + 1, DEPTH)
        self._count += 1
        np.subtract(residual, last_residual, out=self._residuals[k])
        np.subtract(image, last_image, out=self._images[k])
        rows = self._residuals[:m]
        products = rows @ self._residuals[k]
        self._products[k, :m] = self._products[:m, k] = products
        size = np.sqrt(np.maximum(np.diagonal(self._products)[:m], 1e-300))
        scaled = self._products[:m, :m] / np.outer(size, size)
        share = np.linalg.lstsq(scaled, (rows @ residual) / size, rcond=DEPENDENT)[0] / size
        found: FloatArray = image - share @ self._images[:m]
        return found


@dataclass(frozen=True, eq=False)
class Reference:
    """A factorised step: the bodies' stiffness K in it (c times a tangent), csr (n, n)."""

    K: sp.csr_array
    effective: Effective

    @property
    def dissected(self) -> DissectedFactor | None:
        """The factor with the interface at its root, None for others."""
        e = self.effective
        if e.inverse.factor.name != DISSECTION or (e.root is None and e.right.shape[1]):
            return None
        return cast(DissectedFactor, e.inverse.factor)


class AcceleratedSolver(BulkSolver):
    """The step of `BulkSolver` with one factor for many turns and steps.

    Attributes
    ----------
    tangent : array (nnz,) or None
        Terms of the tangent that is factorised, None for that of the first step's start.
    load : array (r,)
        p at the end of the last step, of scaled unknowns.
    """

    remembered = (*BulkSolver.remembered, "tangent", "load", "_jumps")
    loop, factor, said = "kept factor", DISSECTION, "kernel.plasticity.loop-kept-factor"

    def __init__(
        self, problem: Problem, A: sp.csr_array, dt: float, share: float, bulk: Bulk, state: State
    ) -> None:
        super().__init__(problem, A, share, bulk, state)
        self.problem, self.dt = problem, dt
        self.tangent: FloatArray | None = None
        self.load = np.zeros(problem.constraints.T.shape[1])
        self._acceleration = Acceleration(len(self.load))
        self._reference: tuple[FloatArray | None, Reference] | None = None
        self._jumps: Workspace | None = None
        if (joints := problem.interface) is not None:
            self._jumps = workspace((joints.n_points, joints.dimension), joints.size)

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """The accelerated iteration, and Newton's method where it leads nowhere."""
        try:
            outcome = self._accelerated(motion, r, dd)
        except KernelError:  # a tangent without factor: Newton's method sees what is wrong
            outcome = StepOutcome(np.zeros_like(r), 0, np.inf)
        if outcome.turns > 0:
            return outcome
        self.load[:] = 0.0
        return super().solve(motion, r, dd, gap)

    # ---- the factorised step

    def _referred(self) -> Reference:
        """The factor of the tangent that is remembered."""
        if self._reference is None or self._reference[0] is not self.tangent:
            if self.tangent is None:
                nothing = np.zeros(len(self.force))
                self.tangent = self.bulk.respond(self.state, nothing, self.time).tangent.data
            self._reference = (self.tangent, self._factorised(self.tangent))
        return self._reference[1]

    def _factorised(self, tangent: FloatArray) -> Reference:
        K = self.bulk.terms.matrix(self.share * tangent)
        whole = sp.csr_array(self.A + K)
        return Reference(K, effective_of(self.problem, whole, self.dt, self.share))

    def _renewed(self, answer: Answer) -> Reference:
        self.tangent = answer.tangent.data
        return self._referred()

    # ---- the iteration

    def _accelerated(self, motion: Motion, r: FloatArray, dd: FloatArray) -> StepOutcome:
        known, V = self._referred(), self.constraints.V
        held = self.constraints.particular(dd) if dd.any() else None
        scale = known.effective.inverse.scale
        p, size, self.residuals = self.load.copy(), 0.0, []
        self._acceleration.forget()
        for turn in range(1, RENEWALS * PATIENCE + 1):
            moved = self._moved(known, motion, r, p, held)
            if moved is None:
                return StepOutcome(p, -turn, np.inf)
            du = moved
            answer = self.bulk.respond(self.state, du, self.time)
            change = self.share * (answer.force - self.force)
            image = scale * (V.T @ (change - known.K @ du))
            rest = float(np.abs((image - p) / scale).max(initial=0.0))
            size = size or self._size(motion, r, du, answer, known)
            self.residuals.append(rest / size)
            if not np.isfinite(rest):
                return StepOutcome(du, -turn, rest)
            if rest <= TOLERANCE * size:
                residual = self._residual(motion, r, du, answer, known)
                if residual <= TOLERANCE:
                    return self._accepted(motion, du, answer, image, turn, residual)
            if turn % PATIENCE == 0:
                known = self._renewed(answer)
                scale = known.effective.inverse.scale
                p = scale * (V.T @ (change - known.K @ du))
                self._acceleration.forget()
            else:
                p = self._acceleration.next(p, image)
        return StepOutcome(du, -len(self.residuals), self.residuals[-1])

    def _moved(
        self, known: Reference, motion: Motion, r: FloatArray, p: FloatArray,
        held: FloatArray | None,
    ) -> FloatArray | None:  # fmt: skip
        """Increment (n,) for a load p, the joints in equilibrium with it; None without one."""
        e, c = known.effective, self.constraints
        right = r if held is None else r - e.A @ held
        b = e.inverse.scale * (c.V.T @ right) - p
        factor = known.dissected
        if factor is None:
            return self._moved_by_columns(e, motion, b, held)
        x = b[factor.tree.order]
        panels, local = factor.panels, factor.room
        count, n = len(panels.first) - 1, len(x)
        forward(panels, panels.first[0], count, x, n, x, local)
        if e.root is not None:
            last, begin = count - 1, int(panels.first[-2])
            backward(panels, last, count, x, x, local)
            h = self._jumped(e, motion, e.root.J @ x[begin:], held)
            if h is None:
                return None
            x[begin:] -= e.root.Y @ h
            backward(panels, panels.first[0], last, x, x, local)
        else:
            backward(panels, panels.first[0], count, x, x, local)
        b[factor.tree.order] = x
        du: FloatArray = c.T @ (e.inverse.scale * b)
        return du if held is None else np.asarray(du + held)

    def _moved_by_columns(
        self, e: Effective, motion: Motion, b: FloatArray, held: FloatArray | None
    ) -> FloatArray | None:
        """The same with other factors: the interface's response is kept."""
        du = self.constraints.T @ (e.inverse.scale * e.inverse.factor.solve(b))
        if self.interface is not None:
            h = self._jumped(e, motion, self.interface.J @ du, held)
            if h is None:
                return None
            du = du - e.Y @ h
        return du if held is None else du + held

    def _jumped(
        self, e: Effective, motion: Motion, y0: FloatArray, held: FloatArray | None
    ) -> FloatArray | None:
        """Forces (q,) on the jumps by which the joints differ from the linear step."""
        joints, work = self.interface, self._jumps
        assert joints is not None
        assert work is not None
        work.trial.y0[:] = y0 if held is None else y0 + joints.J @ held
        work.trial.y[:] = work.trial.y0
        R = e.R if e.R.any() else np.zeros((0, 0))
        condensed = Condensed(e.S, R, self.share)
        turns, _ = solve_interface(joints.points, condensed, _joints_of(motion), work)
        return work.trial.h if turns > 0 else None

    # ---- what is out of balance

    def _size(
        self, motion: Motion, r: FloatArray, du: FloatArray, answer: Answer, known: Reference
    ) -> float:
        """Forces at play, as Newton's method on all unknowns reckons them."""
        parts = (r, self.A @ du, answer.force, self.force, self._pushed(motion))
        stiff = max(float(np.abs(M.data).max(initial=0.0)) for M in (self.A, known.K))
        moved = min(float(np.abs(du).max(initial=0.0)), self.extent)
        return max(
            sum(float(np.abs(x).max(initial=0.0)) for x in parts), RIGID * stiff * moved, 1e-300
        )

    def _pushed(self, motion: Motion) -> FloatArray:
        """Change (n,) of the joints' forces."""
        if self.interface is None or self._jumps is None:
            return np.zeros(0)
        found: FloatArray = self.interface.J.T @ (self.share * (self._jumps.trial.f - motion.f))
        return found

    def _residual(
        self, motion: Motion, r: FloatArray, du: FloatArray, answer: Answer, known: Reference
    ) -> float:
        """What is out of balance at du, without the factor's rounding, of the forces at play."""
        rest = r - self.A @ du - self.share * (answer.force - self.force)
        if self.interface is not None:
            rest = rest - self._pushed(motion)
        rest = self.constraints.V.T @ rest
        return float(np.abs(rest).max(initial=0.0)) / self._size(motion, r, du, answer, known)

    def _accepted(
        self, motion: Motion, du: FloatArray, answer: Answer, load: FloatArray, turn: int,
        residual: float,
    ) -> StepOutcome:  # fmt: skip
        if self._jumps is not None:
            accept(self._jumps.trial, _joints_of(motion))
        self.load[:] = load
        self.state, self.force, self.work = answer.state, answer.force, answer.work
        return StepOutcome(du, turn, residual)


def _joints_of(motion: Motion) -> InterfaceState:
    return InterfaceState(motion.delta, motion.f, motion.w, motion.t, motion.state)


def is_accelerated(problem: Problem, bulk: Bulk, A: sp.csr_array) -> bool:
    """Whether steps may keep a factor: symmetric, no contact, small strains, a factor that pays."""
    plain = type(bulk) is Bulk and bulk.symmetric and len(bulk.zones) > 0
    if not plain or problem.contact is not None or not problem.constraints.associated:
        return False
    if problem.solver.name not in (None, DISSECTION):
        return False
    joints, T = problem.interface, problem.constraints.T
    right = sp.csc_array((T.shape[1], 0)) if joints is None else sp.csc_array(T.T @ joints.J.T)
    order = ordering_of(problem, right)
    whole = sp.csr_array(A + bulk.terms.matrix(np.ones(len(bulk.terms.indices))))
    return order is not None and factor_pays(sp.csr_array(T.T @ whole @ T), order, MANY_SOLVES)
