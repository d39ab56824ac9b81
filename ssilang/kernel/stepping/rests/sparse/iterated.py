"""The step of a model whose factor takes too much memory or time: Newton's method, by multigrid.

Nothing is condensed: a thousand points are three thousand solves. The joints' tangents stand in
the matrix of each turn, and conjugate gradients solve it with levels that hold all joints closed,
made once. With the inertia of a step next to the stiffness that takes few turns, fewer still from
where the last steps lead.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.interface import joint_stiffness
from ssilang.kernel.interface.laws.law_table import elastic_tangent
from ssilang.kernel.interface.newton import hold_shear, release_shear
from ssilang.kernel.interface.response import (
    InterfaceState,
    Trial,
    accept,
    interface_forces,
    interface_response,
    local_jumps,
    new_trial,
)
from ssilang.kernel.solvers.backends import MULTIGRID, factor_pays
from ssilang.kernel.solvers.cholesky.inverse import unit_diagonal
from ssilang.kernel.statics.linear_motion import singular
from ssilang.kernel.stepping.effective import ordering_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import StepOutcome
from ssilang.kernel.stepping.state import Motion

if TYPE_CHECKING:
    from ssilang.kernel.solvers.multigrid.multigrid import MultigridFactor

TURNS = 60  # of Newton's method
PLAIN_TURNS = 12  # turns without line search
HOLDING_TURN = 16  # turn from which shear that jumps with the opening is held
HALVINGS = 10  # of a step in the line search
FORCING = 1e-3  # residual of a turn's solve, of what is out of balance: contact changes cost little
COURSE = np.array([3.0, -3.0, 1.0])  # a parabola through three increments, where it leads
MANY = 150_000  # unknowns from which the size of a factor is looked at
SYMMETRIC = 1e-12  # of the largest tangent


@dataclass(frozen=True, eq=False)
class IteratedSystem:
    """The matrix of a step with all joints closed, and its levels."""

    factor: MultigridFactor  # of `scale T^T (A + c J^T K_0 J) T scale`, K_0 of the closed joints
    scale: FloatArray  # (r,)
    T: sp.csr_array  # (n, r) motions of the scaled unknowns
    J: sp.csr_array  # (q, r) their jumps
    A: sp.csr_array  # (n, n) the matrix without joints
    closed: FloatArray  # (n_points, d, d) tangents of the closed joints


def iterated_system(problem: Problem, A: sp.csr_array, share: float) -> IteratedSystem:
    """The system of a step, `share` being c in `c J^T f`.

    Raises
    ------
    SingularMatrixError
        If all bodies together are free with all joints closed; it names the motions.
    """
    from ssilang.kernel.solvers.multigrid.multigrid import MultigridFactor

    T, joints = problem.constraints.T, problem.interface
    whole, closed = A, elastic_tangent(joints.parameters, joints.dimension)
    if joints:
        K = joint_stiffness(joints.points, share * closed, joints.size)
        whole = sp.csr_array(A + joints.J.T @ K @ joints.J)
    scaled, scale = unit_diagonal(sp.csr_array(T.T @ whole @ T))
    del whole
    order = ordering_of(problem, sp.csc_array((T.shape[1], 0)))
    rigid, nodes = None, None
    if order is not None:
        order = order.scaled(scale)
        rigid, nodes = order.rigid, order.nodes
    factor = MultigridFactor(scaled, True, rigid, nodes, problem.solver.tolerance)
    if not factor.converges():  # found out here: what is gone on with starts alike
        factor.in_double()
    motions = sp.csr_array(T @ sp.diags_array(scale))
    free = factor.free_motions()
    if free.shape[1]:
        code = "kernel.stepping.motions-without-mass"
        raise singular(code, problem.numbering, motions @ free)
    return IteratedSystem(factor, scale, motions, sp.csr_array(joints.J @ motions), A, closed)


class IteratedSolver:
    """`A du + c J^T (f(delta_0 + J du) - f_0) = r`, solved to the tolerance of the problem."""

    remembered: tuple[str, ...] = ("past",)

    def __init__(self, problem: Problem, system: IteratedSystem, share: float) -> None:
        self.system, self.share = system, share
        self.constraints, self.interface = problem.constraints, problem.interface
        self.tolerance = problem.solver.tolerance
        self.turns = 0
        """Turns of the linear iterations so far."""
        self.past = np.zeros((0, problem.numbering.size))
        """Increments (k, n) of the last steps, the last one first, without what supports impose."""

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """Newton from where the last steps lead, else all but what supports impose at rest."""
        start = self.constraints.particular(dd) if dd.any() else np.zeros_like(r)
        trial = new_trial(motion.w.shape, len(motion.f))
        now = motion.joints
        du, outcome = self._newton(now, trial, r, start)
        release_shear(motion.state, trial.state)
        if outcome.turns > 0:
            self.past = np.vstack([du - start, self.past[: len(COURSE) - 1]])
            if self.interface:
                accept(trial, now)
        return StepOutcome(du, outcome.turns, outcome.residual)

    def _newton(
        self, now: InterfaceState, trial: Trial, r: FloatArray, start: FloatArray
    ) -> tuple[FloatArray, StepOutcome]:
        s, forces = self.system, [r]  # the joints' among them: the body may be one at rest
        if start.any():
            forces.append(s.A @ start)
        forces.append(self.interface.J.T @ now.f)
        reference = sum(float(np.linalg.norm(s.T.T @ f)) for f in forces) or 1.0
        du, rest = self._begin(now, trial, r, start)
        size, enough = float(np.linalg.norm(rest)), self.tolerance * reference
        for turn in range(1, TURNS + 1):
            if size <= enough:
                return du, StepOutcome(du, turn, size / reference)
            if turn == HOLDING_TURN and self._hold(now, trial):
                du = start.copy()
                rest = self._rest(now, trial, r, du)
                size = float(np.linalg.norm(rest))
            step, led = self._step(trial, rest, max(0.3 * enough, FORCING * size))
            if not led:
                return du, StepOutcome(du, -turn, size / reference)
            length, before = 1.0, size
            for halving in range(HALVINGS):
                tried = du + length * step
                rest = self._rest(now, trial, r, tried)
                size = float(np.linalg.norm(rest))
                if turn <= PLAIN_TURNS or size < before or halving == HALVINGS - 1:
                    break
                length *= 0.5
            du = tried
        return du, StepOutcome(du, -TURNS, size / reference)

    def _begin(
        self, now: InterfaceState, trial: Trial, r: FloatArray, start: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Where the last steps lead if less is out of balance there, and what is."""
        rest = self._rest(now, trial, r, start)
        if len(self.past) == len(COURSE):
            led = start + COURSE @ self.past
            left = self._rest(now, trial, r, led)
            if np.linalg.norm(left) < np.linalg.norm(rest):
                return led, left
            rest = self._rest(now, trial, r, start)
        return start.copy(), rest

    def _rest(self, now: InterfaceState, trial: Trial, r: FloatArray, du: FloatArray) -> FloatArray:
        """What is out of balance at du, on the scaled unknowns; the joints' answer into `trial`."""
        rest = r - self.system.A @ du if du.any() else r.copy()
        if self.interface:
            trial.y[:] = self.interface.J @ du
            trial.delta[:] = now.delta + trial.y
            interface_response(self.interface.points, now.state, trial.delta, trial)
            rest -= self.interface.J.T @ (self.share * (trial.f - now.f))
        return self.system.T.T @ rest

    def _step(self, trial: Trial, rest: FloatArray, enough: float) -> tuple[FloatArray, bool]:
        """Newton's increment (n,), and whether the linear iteration led anywhere."""
        from ssilang.kernel.solvers.multigrid import multigrid as krylov

        s, joints = self.system, self.interface
        change = self.share * (trial.D - s.closed)
        if not change.any():
            multiply, symmetric = s.factor.multiply, True
        else:
            flipped = np.swapaxes(trial.D, 1, 2)
            symmetric = bool(np.abs(trial.D - flipped).max() <= SYMMETRIC * np.abs(trial.D).max())
            w, f = np.empty(trial.w.shape), np.empty(len(trial.f))

            def multiply(x: FloatArray) -> FloatArray:
                local_jumps(joints.points, s.J @ x, w)
                interface_forces(joints.points, np.einsum("pij,pj->pi", change, w), f)
                return np.asarray(s.factor.multiply(x) + s.J.T @ f)

        cycle = s.factor.hierarchy.cycle
        if symmetric:
            found = krylov.conjugate_gradients(multiply, cycle, rest, enough, krylov.MOST_TURNS)
            self.turns += found.turns
        if not symmetric or not found.converged:
            found = krylov.minimal_residuals(multiply, cycle, rest, enough, krylov.MOST_TURNS)
            self.turns += found.turns
        increment: FloatArray = s.T @ found.x
        return increment, found.residual < 0.5 * float(np.linalg.norm(rest))

    def _hold(self, now: InterfaceState, trial: Trial) -> bool:
        """Hold the shear that a step's start has, where no other shear is possible."""
        if not self.interface:
            return False
        interface_response(self.interface.points, now.state, now.delta, trial)
        return bool(hold_shear(self.interface.points, trial.t, now.state))


def pays(problem: Problem, A: sp.csr_array) -> bool:
    """Whether steps go by multigrid: asked for, or their factor would take too much."""
    T, solver = problem.constraints.T, problem.solver
    if problem.contact or not problem.constraints.associated:
        return False
    if solver.name is not None or T.shape[1] < MANY or solver.petsc is not None:
        return solver.name == MULTIGRID  # PETSc takes what memory does not hold
    order = ordering_of(problem, sp.csc_array((T.shape[1], 0)))
    steps = len(problem.times) - 1
    return order is not None and not factor_pays(sp.csr_array(T.T @ A @ T), order, steps)
