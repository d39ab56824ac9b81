"""The time loop on sparse matrices: one solve a step, the rest on the interface.

Same steps as the compiled loops, which tests hold against this one.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import for_products
from ssilang.kernel.contact.impact import ImpactRule
from ssilang.kernel.interface.condensed import condensed_of
from ssilang.kernel.interface.newton import solve_interface, workspace
from ssilang.kernel.interface.response import accept, interface_energies
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.newmark import Newmark, advanced, from_past
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
    WHOLE,
    Motion,
    Outcome,
    Peaks,
    Recorder,
)
from ssilang.kernel.stepping.track import View, whole_view

NOTHING = np.zeros(0)


@dataclass
class StepOutcome:
    """Increment of a step, iterations it took (<= 0: none converged), last residual."""

    du: FloatArray
    turns: int
    residual: float


class StepSolver(Protocol):
    """Solves `A du + c J^T (f_1 - f_0) = r`, `C du = dd`; updates the joints of the motion."""

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """The step's increment; `motion.delta, f, w, t, state` become those of its end.

        `gap` (m,) are the gaps of relations for du = 0 and the imposed values at the end of the
        step; (2, m) with those of both ends where steps conserve energy.
        """


class CondensedSolver:
    """The interface condensed exactly on its own unknowns (one factorisation a dt)."""

    remembered = ("_newton",)

    def __init__(self, problem: Problem, effective: Effective) -> None:
        self.effective = effective
        self.interface = problem.interface
        share = 1.0 - problem.scheme.alpha_f
        self._condensed = condensed_of(effective.S, share, effective.R)
        joints, mean = problem.interface, problem.scheme.conserving
        shape = (joints.n_points, joints.dimension)
        self._newton = workspace(shape, joints.size, mean) if joints else None
        self._J = for_products(joints.J)

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """One solve, Newton on the interface, one product."""
        du = self.effective.solve(r)
        if dd.any():
            du = du + self.effective.imposed(dd)
        if self._newton is None:
            return StepOutcome(du, 1, 0.0)
        trial = self._newton.trial
        trial.y0[:] = self._J @ du
        trial.y[:] = trial.y0
        now = motion.joints
        turns, residual = solve_interface(self.interface.points, self._condensed, now, self._newton)
        if turns > 0:
            du = du - self.effective.Y @ trial.h
            accept(trial, now)
        return StepOutcome(du, turns, residual)


def support_work(
    problem: Problem,
    reaction: FloatArray,
    pushed: FloatArray,
    du: FloatArray,
    dd: FloatArray,
    dc: FloatArray,
) -> float:
    """Work of moving supports and stops in a step, and of non-associated relations.

    Parameters
    ----------
    reaction : array (n,)
        Mean force of all conditions on the body.
    pushed : array (size,)
        Mean reactions and frictions of the unilateral relations.
    du, dd, dc : increments of displacement, imposed values and load factors.
    """
    contact, rest, work = problem.contact, reaction, 0.0
    if contact:
        rest = reaction - contact.pushing.T @ pushed
        work = contact.work(pushed, du, dc)
    if not problem.constraints.associated:
        return work + float(rest @ du)
    return work + float(dd @ problem.constraints.multipliers(rest)) if dd.any() else work


class Products(NamedTuple):
    """A problem's matrices by `for_products`; D are its conditions, Jt is J transposed."""

    K: Any
    M: Any
    C: Any
    D: Any
    J: Any
    Jt: Any


@dataclass(eq=False)
class SparseLoop:
    """What steps are made of, beside a solver for each."""

    problem: Problem
    motion: Motion

    def __post_init__(self) -> None:
        p, J = self.problem, self.problem.interface.J
        self._damped = p.C.nnz > 0
        self._by = Products(*map(for_products, (p.K, p.M, p.C, p.constraints.C, J, J.T)))

    def _gap(self, factors: FloatArray) -> FloatArray:
        contact = self.problem.contact
        return contact.gaps(self.motion.u, factors) if contact else NOTHING

    def _begin(self) -> None:
        """Products of the current state, that each step hands to the next."""
        p, m = self.problem, self.motion
        by = self._by
        self._Ku, self._Mv, self._Ma = by.K @ m.u, by.M @ m.v, by.M @ m.a
        self._Cv = by.C @ m.v if self._damped else NOTHING
        self._joints_lost = self._of_joints()[1] if p.contact else 0.0

    def _of_joints(self) -> tuple[float, float]:
        joints, m = self.problem.interface, self.motion
        if not joints:
            return 0.0, 0.0
        stored, lost = interface_energies(joints.points, m.w, m.t, m.state)
        return float(stored), float(lost)

    def _predict(self, n: Newmark, load0: FloatArray, load1: FloatArray) -> FloatArray:
        """Right-hand side of the step, the joints' forces as they are."""
        zero = np.zeros_like(load0)
        Cv, Ca = (self._Cv, zero) if self._damped else (zero, zero)
        if self._damped and n.c_a != 0.0:
            Ca = self._by.C @ self.motion.a
        r: FloatArray = from_past(n, self._Mv, self._Ma, Cv, Ca) - self._Ku
        r += n.end * load1 + n.start * load0
        if self.problem.interface:
            r -= self._by.Jt @ self.motion.f
        return r

    def _advance(self, n: Newmark, du: FloatArray) -> None:
        m = self.motion
        m.u[:] += du
        m.v[:], m.a[:] = advanced(n, du, m.v, m.a)

    def _account(
        self, n: Newmark, du: FloatArray, dd: FloatArray, loads: FloatArray, pushed: FloatArray,
        factors: FloatArray,
    ) -> None:  # fmt: skip
        """Reactions and energies; `pushed` are the contact reactions at the step's start.

        `loads` (2, n) and `factors` (2, k) are those of both ends.
        """
        p, m = self.problem, self.motion
        old, before = m.reaction.copy(), m.energies[LOST] - self._joints_lost
        Ku, Cv, b = self._Ku, self._Cv, n.before
        self._begin()
        m.reaction[:] = self._Ma + (1 - b) * (self._Ku - loads[1]) + b * (Ku - loads[0])
        if self._damped:
            m.reaction[:] += (1 - b) * self._Cv + b * Cv
            m.energies[DAMPED] += 0.5 * du @ (Cv + self._Cv)
        if p.interface:
            m.reaction[:] += self._by.Jt @ m.f
        if b:  # forces of the step, and those of joints and relations, are means by themselves
            old, pushed = m.reaction, m.contact
        m.energies[EXTERNAL] += 0.5 * du @ (loads[0] + loads[1])
        m.energies[EXTERNAL] += support_work(
            p, 0.5 * (old + m.reaction), 0.5 * (pushed + m.contact), du, dd, factors[1] - factors[0]
        )
        m.energies[KINETIC], m.energies[ELASTIC] = 0.5 * m.v @ self._Mv, 0.5 * m.u @ self._Ku
        if p.contact and p.contact_options.method == "PENALITE":
            m.energies[ELASTIC] += p.contact.penalty_energy(
                self._gap(factors[1]), p.contact_options.coefficient
            )
        if p.interface:
            m.energies[STORED], m.energies[LOST] = self._of_joints()
        if p.contact:
            rubbed = p.contact.rubbed(0.5 * (pushed + m.contact), du)
            m.energies[LOST] = self._joints_lost + before + rubbed


def balance(energies: FloatArray) -> float:
    """What a motion keeps."""
    return float(energies[:EXTERNAL].sum() - energies[EXTERNAL])


def lose(m: Motion, work: float, before: float) -> float:
    """What the balance of a step with an impact lacks of that `before` it, as lost; how much.

    `work` is that of moving stops on what was struck.
    """
    m.energies[EXTERNAL] += work
    lost = max(before - balance(m.energies), 0.0)
    m.energies[LOST] += lost
    return lost


def end_of_step(m: Motion, to: Recorder, k: int) -> None:
    """As the verb of that name, of arrays at once."""
    to.energies[k] = m.energies
    row, tapped = to.row[k], to.tap.row[k]
    if row >= 0:
        for name in WHOLE:
            getattr(to, name)[row] = getattr(m, name)
    if tapped >= 0:
        for name in ("u", "v", "a", "reaction"):
            getattr(to.tap, name)[tapped] = getattr(m, name)[to.tap.at]
        for name in ("w", "t", "state", "contact"):
            getattr(to.tap, name)[tapped] = getattr(m, name)
    if len(to.peaks.u):
        watch_whole(m, to.peaks, k)


def watch_whole(m: Motion, to: Peaks, k: int) -> None:
    """As the verb `watch`, of arrays at once."""
    step = to.first[0] + k + 1.0
    larger = np.flatnonzero(np.abs(m.u) > np.abs(to.u))
    if len(larger):
        to.u[larger], to.when[larger] = m.u[larger], step
    if to.joints.shape[1]:
        shear = np.sqrt(np.vecdot(m.t[:, :-1], m.t[:, :-1]))
        found = np.array([m.w[:, -1], -m.t[:, -1], shear])
        larger_joints = found > to.joints
        if larger_joints.any():
            np.copyto(to.joints, found, where=larger_joints)
            to.joints_when[larger_joints] = step


@dataclass(eq=False)
class SparseSteps(SparseLoop):
    """Steps of one dt with one solver; `impact` corrects velocities of unilateral relations."""

    remembered = ("solver",)

    solver: StepSolver
    newmark: Newmark
    impact: ImpactRule | None = None

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps on the whole problem's arrays."""
        p, m, n, worst = self.problem, self.motion, self.newmark, 0
        self._begin()
        loads = factors @ p.loading.forces.T
        imposed = factors @ p.loading.imposed.T
        for k in range(len(recorder.row)):
            rest = self._predict(n, loads[k], loads[k + 1])
            dd = imposed[k + 1] - self._by.D @ m.u
            pushed = m.contact.copy()
            ends = factors[k : k + 2] if n.before else factors[k + 1]
            outcome = self.solver.solve(m, rest, dd, self._gap(ends))
            if outcome.turns <= 0:
                return k, outcome.turns, outcome.residual
            worst, work = max(worst, outcome.turns), None
            self._advance(n, outcome.du)
            if self.impact is not None:
                rate = p.contact.imposed @ (factors[k + 1] - factors[k]) / n.dt
                work = self.impact.correct(m, rate)
            before = balance(m.energies)
            if not np.isfinite(m.u).all():
                return k, -1, np.inf
            self._account(n, outcome.du, dd, loads[k : k + 2], pushed, factors[k : k + 2])
            if work is not None:
                lose(m, work, before)
            end_of_step(m, recorder, k)
        return len(recorder.row), worst, 0.0

    def renew(self, problem: Problem) -> None:
        """Go on with other loads, all else being the same."""
        self.problem = problem

    def view(self, unknowns: IntArray) -> View:
        """Unknowns as they are."""
        return whole_view(self.motion, unknowns)
