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

from dataclasses import dataclass
from typing import cast

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.condensed import condensed_of
from ssilang.kernel.interface.newton import solve_interface, workspace
from ssilang.kernel.interface.response import accept
from ssilang.kernel.plasticity.bulk import Answer, Bulk, State
from ssilang.kernel.plasticity.newton import RIGID, TOLERANCE, BulkSolver
from ssilang.kernel.plasticity.solving.part import (
    NEAR,
    Part,
    by_zone,
    cells_for_the_next,
    cells_nearer,
    part_of,
    whole_part,
)
from ssilang.kernel.solvers.backends import DISSECTION, factor_pays
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.triangular import (
    backward,
    backward_runs,
    forward,
    forward_runs,
)
from ssilang.kernel.stepping.effective import Effective, effective_of, ordering_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import StepOutcome
from ssilang.kernel.stepping.state import Motion

DEPTH = 16  # turns that the acceleration looks back on
PATIENCE = 20  # turns after which the tangent of what has been reached is factorised
EARLY = 3.0  # times the tolerance from which on the next turn may well be the last
TIGHTER = 0.1  # of the tolerance, where the forces at play were thought too large
RENEWALS = 3  # in a step, before Newton's method on all unknowns
MANY_SOLVES = 1_000  # a factor is compared with iterations as if it served so often
DEPENDENT = 1e-14  # smallest eigenvalue of the turns' products that counts, of the largest


class Acceleration:
    """Anderson's acceleration of `p = g(p)`: the combination of turns with the least residual."""

    def __init__(self, size: int) -> None:
        self._residuals, self._images = np.empty((DEPTH, size)), np.empty((DEPTH, size))
        self._products = np.zeros((DEPTH, DEPTH))
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
        return image - share @ self._images[:m]


@dataclass(frozen=True, eq=False)
class Reference:
    """A factorised step.

    Attributes
    ----------
    K : csr array (n, n)
        The bodies' stiffness in it, c times a tangent.
    T : csr array (n, r)
        Motions by the factor's unknowns: scaled, in the order of elimination.
    order : array (r,)
        The independent unknown at each place of that order.
    elastic : bool
        Whether K is the elastic stiffness, so that p is what flow makes alone.
    stiff : float
        Largest term of K.
    """

    K: sp.csr_array
    effective: Effective
    T: sp.csr_array
    order: IntArray
    elastic: bool
    stiff: float

    @property
    def dissected(self) -> DissectedFactor | None:
        """The factor with the interface at its root, None for others."""
        return _dissected(self.effective)

    @property
    def scale(self) -> FloatArray:
        """Of the independent unknowns, in the order of elimination."""
        return self.effective.inverse.scale[self.order]


def _dissected(e: Effective) -> DissectedFactor | None:
    if e.inverse.factor.name != DISSECTION or (e.root is None and e.right.shape[1]):
        return None
    return cast(DissectedFactor, e.inverse.factor)


@dataclass(eq=False)
class Step:
    """A step under way.

    Attributes
    ----------
    r, held : array (n,), array (n,) or None
        Right-hand side, motion of the supports.
    forwarded : array (r,)
        Right-hand side of the independent unknowns after the forward solve.
    known, part : Reference, Part
    p : array (m,)
        The load that is looked for, of the part's unknowns.
    du, answer : array (n,), Answer or None
        The last motion of the part's unknowns, and what the bodies answer if they all did.
    """

    motion: Motion
    r: FloatArray
    held: FloatArray | None
    forwarded: FloatArray
    known: Reference
    part: Part
    p: FloatArray
    du: FloatArray
    answer: Answer | None = None


class AcceleratedSolver(BulkSolver):
    """The step of `BulkSolver` with one factor for many turns and steps.

    While the factor is elastic, and all zones have compiled passes, turns go over the part of the
    bodies that yields or is near to it; a step ends with a pass over all cells, and goes on with
    more of them if others yield too.

    Attributes
    ----------
    tangent : array (nnz,) or None
        Terms of the tangent that is factorised, None for that of the first step's start.
    load : array (r,)
        p at the end of the last step, not scaled.
    cells : array
        Those of the part, numbered through all zones.
    """

    remembered = (*BulkSolver.remembered, "tangent", "load", "cells", "_jumps")
    loop, factor, said = "kept factor", DISSECTION, "kernel.plasticity.loop-kept-factor"

    def __init__(
        self, problem: Problem, A: sp.csr_array, dt: float, share: float, bulk: Bulk, state: State
    ) -> None:
        super().__init__(problem, A, share, bulk, state)
        self.problem, self.dt = problem, dt
        self.tangent: FloatArray | None = None
        self.load = np.zeros(problem.constraints.T.shape[1])
        self.cells = np.zeros(0, np.int64)
        self._passed = all(bulk.passes) and not bulk.free
        self._reference: tuple[FloatArray | None, Reference] | None = None
        self._part: tuple[IntArray, Reference, Part] | None = None
        self._stiff = float(np.abs(A.data).max(initial=0.0))
        joints = problem.interface
        shape = (joints.n_points, joints.dimension)
        self._jumps = workspace(shape, joints.size) if joints else None

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

    def _factorised(self, tangent: FloatArray) -> Reference:
        K = self.bulk.terms.matrix(self.share * tangent)
        e = effective_of(self.problem, sp.csr_array(self.A + K), self.dt, self.share)
        factor, scale = _dissected(e), e.inverse.scale
        order = np.arange(len(scale)) if factor is None else factor.tree.order
        T = sp.csr_array((self.constraints.T @ sp.diags_array(scale))[:, order])
        elastic = self.tangent is None and factor is not None
        return Reference(K, e, T, order, elastic, float(np.abs(K.data).max(initial=0.0)))

    def _part_of(self, known: Reference) -> Part:
        """The part that the solver's cells make; all if the factor is not elastic."""
        if self._part is None or self._part[0] is not self.cells or self._part[1] is not known:
            factor = known.dissected
            if known.elastic and factor is not None:
                part = part_of(self.bulk, by_zone(self.bulk, self.cells), known.T, factor.panels)
            else:
                part = whole_part(known.T, factor)
            self._part = (self.cells, known, part)
        return self._part[2]

    # ---- the iteration

    def _accelerated(self, motion: Motion, r: FloatArray, dd: FloatArray) -> StepOutcome:
        step = self._begun(motion, r, self.constraints.particular(dd) if dd.any() else None)
        # what the forces at play are at least, as far as it is known before the step
        size = float(np.abs(r).max(initial=0.0)) + 2 * float(np.abs(self.force).max(initial=0.0))
        self.residuals, tolerance = [], TOLERANCE * max(size, 1e-300)
        acceleration = Acceleration(len(step.p))
        for turn in range(1, RENEWALS * PATIENCE + 1):
            image = self._image(step)
            if image is None:
                return StepOutcome(step.du, -turn, np.inf)
            rest = np.abs((image - step.p) / step.known.scale[step.part.places])
            self.residuals.append(float(rest.max(initial=0.0)) * TOLERANCE / tolerance)
            if not np.isfinite(self.residuals[-1]):
                return StepOutcome(step.du, -turn, self.residuals[-1])
            step.p = acceleration.next(step.p, image)
            late = turn % PATIENCE == 0
            if self.residuals[-1] > EARLY * TOLERANCE and not late:
                continue
            residual = self._whole(step)
            if residual <= TOLERANCE:
                return self._accepted(step, turn, residual)
            tolerance *= TIGHTER
            if self._widened(step) or late:
                # Go on from what has been reached with a wider part, or with another factor.
                if late:
                    assert step.answer is not None
                    self.tangent = step.answer.tangent.data
                    again = self._begun(step.motion, step.r, step.held)
                    step.known, step.forwarded = again.known, again.forwarded
                step.part = self._part_of(step.known)
                step.p = self._load(step)
                acceleration = Acceleration(len(step.p))
        return StepOutcome(step.du, -len(self.residuals), self.residuals[-1])

    def _begun(self, motion: Motion, r: FloatArray, held: FloatArray | None) -> Step:
        """A step with the load of the last one."""
        # The factor of the tangent that is remembered.
        if self._reference is None or self._reference[0] is not self.tangent:
            tangent = self.tangent
            if tangent is None:
                start = self.bulk.unloaded() if self._passed else self.state
                nothing = np.zeros(len(self.force))
                tangent = self.bulk.respond(start, nothing, self.time).tangent.data
                self.tangent = None if self._passed else tangent
            self._reference = (self.tangent, self._factorised(tangent))
        known = self._reference[1]
        part, e, factor = self._part_of(known), known.effective, known.dissected
        b = known.T.T @ (r if held is None else r - e.A @ held)
        if factor is not None:
            panels, n = factor.panels, len(b)
            forward(panels, panels.first[0], len(panels.first) - 1, b, n, b, factor.room)
        p = (self.load[known.order] * known.scale)[part.places]
        return Step(motion, r, held, b, known, part, p, np.zeros(len(r)))

    def _image(self, step: Step) -> FloatArray | None:
        """g(p) of the part's unknowns; None without equilibrium of the joints."""
        if not self._moved(step, step.part):
            return None
        if not step.known.elastic:
            step.answer = self.bulk.respond(self.state, step.du, self.time)
        return self._load(step)

    def _load(self, step: Step) -> FloatArray:
        """What the bodies' forces beyond the factor load the part's unknowns with."""
        part, known = step.part, step.known
        if not known.elastic:
            assert step.answer is not None
            change = self.share * (step.answer.force - self.force) - known.K @ step.du
            return np.asarray(part.T.T @ change)
        flow = np.zeros(len(step.du))
        for over, old in zip(part.passes, self.state, strict=True):
            over.flow(old, step.du, flow)
        return np.asarray(part.T.T @ (self.share * flow[part.unknowns]))

    def _whole(self, step: Step) -> float:
        """Move all, and have all bodies answer: what is out of balance, of the forces at play."""
        known, du = step.known, step.du
        if not self._moved(step, whole_part(known.T, known.dissected)):
            return np.inf
        answer = step.answer = self.bulk.respond(self.state, du, self.time)
        # What is out of balance at du, of the forces at play as Newton's method reckons them.
        linear = self.A @ du
        rest, parts = step.r - linear, [step.r, linear, answer.force, self.force]
        rest -= self.share * (answer.force - self.force)
        if self._jumps is not None:
            pushed = self.interface.J.T @ (self.share * (self._jumps.trial.f - step.motion.f))
            rest -= pushed
            parts.append(pushed)
        size = sum(float(np.abs(x).max(initial=0.0)) for x in parts)
        moved = min(float(np.abs(du).max(initial=0.0)), self.extent)
        size = max(size, RIGID * max(self._stiff, known.stiff) * moved, 1e-300)
        return float(np.abs(self.constraints.V.T @ rest).max(initial=0.0)) / size

    def _widened(self, step: Step) -> bool:
        """Whether cells beyond the part yield: it has them, too, then."""
        if not step.known.elastic or step.answer is None:
            return False
        yields = cells_nearer(self.bulk, step.answer.beyond, 0.0)
        if np.isin(yields, self.cells, assume_unique=True).all():
            return False
        self.cells = np.union1d(self.cells, cells_nearer(self.bulk, step.answer.beyond, NEAR))
        return True

    def _moved(self, step: Step, part: Part) -> bool:
        """Move a part's unknowns under its load; False without equilibrium of the joints."""
        known, factor = step.known, step.known.dissected
        if factor is None:
            return self._moved_by_columns(step)
        e, panels, local = known.effective, factor.panels, factor.room
        x = np.zeros(len(step.forwarded))
        x[step.part.places] = -step.p
        forward_runs(panels, step.part.runs, x, local)
        x += step.forwarded
        runs = part.runs
        if e.root is not None:
            last, begin = len(panels.first) - 2, int(panels.first[-2])
            backward(panels, last, last + 1, x, x, local)
            h = self._jumped(e, step.motion, e.root.J @ x[begin:], step.held)
            if h is None:
                return False
            x[begin:] -= e.root.Y @ h
            runs = np.minimum(runs, last)
        backward_runs(panels, runs, x, local)
        step.du[part.unknowns] = part.T @ x[part.places]
        if step.held is not None:
            step.du[part.unknowns] += step.held[part.unknowns]
        return True

    def _moved_by_columns(self, step: Step) -> bool:
        """The same with other factors: the interface's response is kept."""
        known = step.known
        e, b = known.effective, step.forwarded.copy()
        b[step.part.places] -= step.p
        du = known.T @ e.inverse.factor.solve(b)
        if self.interface:
            h = self._jumped(e, step.motion, self.interface.J @ du, step.held)
            if h is None:
                return False
            du = du - e.Y @ h
        step.du[:] = du if step.held is None else du + step.held
        return True

    def _jumped(
        self, e: Effective, motion: Motion, y0: FloatArray, held: FloatArray | None
    ) -> FloatArray | None:
        """Forces (q,) on the jumps by which the joints differ from the linear step."""
        joints, work = self.interface, self._jumps
        assert work is not None
        work.trial.y0[:] = y0 if held is None else y0 + joints.J @ held
        work.trial.y[:] = work.trial.y0
        condensed = condensed_of(e.S, self.share, e.R)
        turns, _ = solve_interface(joints.points, condensed, motion.joints, work)
        return work.trial.h if turns > 0 else None

    # ---- what is out of balance

    def _accepted(self, step: Step, turn: int, residual: float) -> StepOutcome:
        known, answer = step.known, step.answer
        assert answer is not None
        if self._jumps is not None:
            accept(self._jumps.trial, step.motion.joints)
        self.load[:] = 0.0
        self.load[known.order[step.part.places]] = step.p / known.scale[step.part.places]
        self.state, self.force, self.work = answer.state, answer.force, answer.work
        if known.elastic:
            self.cells = cells_for_the_next(self.bulk, self.cells, answer)
        return StepOutcome(step.du, turn, residual)


def is_accelerated(problem: Problem, bulk: Bulk, A: sp.csr_array) -> bool:
    """Whether steps may keep a factor: symmetric, no contact, small strains, a factor that pays."""
    plain = type(bulk) is Bulk and bulk.symmetric and len(bulk.zones) > 0
    if not plain or problem.contact or not problem.constraints.associated:
        return False
    if problem.solver.name not in (None, DISSECTION):
        return False
    joints, T = problem.interface, problem.constraints.T
    order = ordering_of(problem, sp.csc_array(T.T @ joints.J.T))
    whole = sp.csr_array(A + bulk.terms.matrix(np.ones(len(bulk.terms.indices))))
    return order is not None and factor_pays(sp.csr_array(T.T @ whole @ T), order, MANY_SOLVES)
