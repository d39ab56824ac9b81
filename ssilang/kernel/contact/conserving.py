"""Unilateral relations in the energy-conserving step: mean reactions that give back all energy.

Multipliers (Lagrange, augmented, Uzawa): a relation that would be crossed in the step, or that
already is, keeps its gap or opens, `dg >= 0, p >= 0, p dg = 0`, so that the mean reaction does no
work (Laursen and Chawla's persistency, Moreau's impact of restitution 1, since `dg = 0` is
`C v_1 = -C v_0`). A relation turns back at most one step's way before its stop, and never crosses
it. Penalty: the mean reaction is that of the spring's energy, `p* = -(psi_1 - psi_0)/dg`.

On the unknowns of the interface, with h = f* - f_0 - R y,

    y  = y_0  - S_JJ h + S_JG p*
    dg = dg_0 - S_GJ h + S_GG p*
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.rows import BoolArray, ContactRows
from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.interface.condensed import condensed_of
from ssilang.kernel.interface.newton import evaluate
from ssilang.kernel.interface.response import accept, interface_stiffness, new_trial
from ssilang.kernel.solvers.active_set.contact_methods import METHODS
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import StepOutcome
from ssilang.kernel.stepping.state import Motion

TOLERANCE = 1e-14
ACCEPTED = 1e-11
PLAIN_TURNS = 15
MOST_TURNS = 80
CROSSED = 1e-13  # of the largest gap: rounding


class Joints(Protocol):
    """The joints' mean response in one step."""

    @property
    def size(self) -> int:
        """Unknowns of the joints."""

    def respond(self, y: FloatArray) -> FloatArray:
        """h (size,) at the increment y of the jumps."""

    def tangent(self) -> FloatArray:
        """dh/dy (size, size) at the last response."""


@dataclass(frozen=True)
class Found:
    """Joint loads h, mean reactions P, turns (<= 0: not converged), residual."""

    h: FloatArray
    P: FloatArray
    turns: int
    residual: float


class ConservingContact:
    """Steps of one dt with unilateral relations beside the joints."""

    def __init__(
        self, effective: Effective, contact: ContactRows, options: ContactOptions, J: sp.csr_array
    ) -> None:
        self.contact, self.options = contact, options
        self.YG = effective.solve(contact.G.T.toarray())
        self.SGG: FloatArray = contact.G @ self.YG
        self.SJJ = effective.S
        self.SJG: FloatArray = J @ self.YG
        self.SGJ: FloatArray = contact.G @ effective.Y

    def solve(self, joints: Joints, y0: FloatArray, gap: FloatArray, dg0: FloatArray) -> Found:
        """A step from gaps (m,) that would change by dg0 (m,) without joints and reactions."""
        if self.options.method == "PENALITE":
            return self._penalty(joints, y0, gap, dg0)
        stopped = np.zeros(len(gap), bool)
        worst = 0
        for _ in range(len(gap) + 1):
            found = self._stopped(joints, y0, dg0, stopped)
            if found.turns <= 0:
                return found
            worst = max(worst, found.turns)
            dg = dg0 - self.SGJ @ found.h + self.SGG @ found.P
            rounding = CROSSED * (np.abs(gap).max() + np.abs(dg).max())
            crossed = ~stopped & (gap + dg < -rounding) & (dg < 0.0)
            if not crossed.any():
                break
            stopped |= crossed
        return Found(found.h, found.P, worst, found.residual)

    def _stopped(
        self, joints: Joints, y0: FloatArray, dg0: FloatArray, stopped: BoolArray
    ) -> Found:
        """`dg >= 0, P >= 0, P dg = 0` on the stopped rows, no reaction on the others."""
        on = np.flatnonzero(stopped)
        P = np.zeros(len(dg0))
        if joints.size == 0:
            P[on] = self._complementarity(self.SGG[np.ix_(on, on)], dg0[on])
            return Found(np.zeros(0), P, 1, 0.0)
        y, one = y0.copy(), np.eye(joints.size)
        scale, before = max(float(np.abs(y0).max()), 1e-300), np.inf
        for turn in range(1, MOST_TURNS + 1):
            h = joints.respond(y)
            size = float(np.abs(y - y0 + self.SJJ @ h - self.SJG @ P).max())
            scale = max(scale, float(np.abs(y).max()))
            if turn > 1 and size <= TOLERANCE * scale:
                return Found(h, P, turn, size / scale)
            tangent = joints.tangent()
            inverse = np.linalg.inv(one + self.SJJ @ tangent)
            base = inverse @ (y0 - self.SJJ @ (h - tangent @ y))
            slope = inverse @ self.SJG[:, on]
            W = self.SGG[np.ix_(on, on)] - self.SGJ[on] @ (tangent @ slope)
            q = dg0[on] - self.SGJ[on] @ (h + tangent @ (base - y))
            P[on] = self._complementarity(W, q)
            step = base + slope @ P[on] - y
            if np.abs(step).max() <= 1e-15 * scale and size <= ACCEPTED * scale:
                return Found(h, P, turn, size / scale)
            y = y + (1.0 if turn <= PLAIN_TURNS or size < before else 0.5) * step
            before = size
        return Found(h, P, -MOST_TURNS, size / scale)

    def _complementarity(self, W: FloatArray, q: FloatArray) -> FloatArray:
        if len(q) == 0:
            return q
        return METHODS[self.options.method](W, q, self.options.coefficient, None).p

    def _penalty(self, joints: Joints, y0: FloatArray, gap: FloatArray, dg0: FloatArray) -> Found:
        """Newton's method on y and dg together."""
        n, m = joints.size, len(gap)
        S = np.block([[self.SJJ, -self.SJG], [self.SGJ, -self.SGG]])
        z0 = np.concatenate([y0, dg0])
        z, loads = z0.copy(), np.zeros(n + m)
        D = np.zeros((n + m, n + m))
        scale, before, step = float(np.abs(z0).max(initial=1e-300)), np.inf, np.zeros(n + m)
        for turn in range(1, MOST_TURNS + 1):
            loads[:n] = joints.respond(z[:n]) if n else 0.0
            loads[n:], slope = mean_penalty(gap, z[n:], self.options.coefficient or 0.0)
            rest = z - z0 + S @ loads
            size = float(np.abs(rest).max(initial=0.0))
            scale = max(scale, float(np.abs(z).max(initial=0.0)))
            small = np.abs(step).max(initial=0.0) <= 1e-15 * scale and size <= ACCEPTED * scale
            if size <= TOLERANCE * scale or (turn > 1 and small):
                return Found(loads[:n], loads[n:].copy(), turn, size / scale)
            if n:
                D[:n, :n] = joints.tangent()
            D[range(n, n + m), range(n, n + m)] = slope
            step = -np.linalg.solve(np.eye(n + m) + S @ D, rest)
            z = z + (1.0 if turn <= PLAIN_TURNS or size < before else 0.5) * step
            before = size
        return Found(loads[:n], loads[n:], -MOST_TURNS, size / scale)


class ConservingSolver:
    """Steps with unilateral relations; `motion.contact` becomes their mean reaction."""

    def __init__(self, problem: Problem, effective: Effective, rows: ContactRows) -> None:
        joints, share = problem.interface, 1 - problem.scheme.alpha_f
        self.effective, self.rows, self.interface = effective, rows, joints
        self.contact = ConservingContact(effective, rows, problem.contact_options, joints.J)
        self._condensed = condensed_of(effective.S, share, effective.R)
        self._trial = new_trial((joints.n_points, joints.dimension), joints.size, mean=True)
        self._K = np.zeros((joints.size, joints.size))

    def solve(self, motion: Motion, r: FloatArray, dd: FloatArray, gap: FloatArray) -> StepOutcome:
        """The step's increment; `gap` (2, m) are those of both ends for du = 0."""
        e, joints, self._now = self.effective, self.interface, motion.joints
        du = e.solve(r)
        if dd.any():
            du = du + e.imposed(dd)
        found = self.contact.solve(self, joints.J @ du, gap[0], self.rows.G @ du + gap[1] - gap[0])
        motion.contact[:] = found.P
        du = du + self.contact.YG @ found.P
        if joints and found.turns > 0:
            du = du - e.Y @ found.h
            accept(self._trial, self._now)
        return StepOutcome(du, found.turns, found.residual)

    @property
    def size(self) -> int:
        """Unknowns of the joints."""
        return len(self.effective.S)

    def respond(self, y: FloatArray) -> FloatArray:
        """h at the increment y of the jumps."""
        self._trial.y[:] = y
        evaluate(self.interface.points, self._condensed, self._now, self._trial)
        return self._trial.h.copy()

    def tangent(self) -> FloatArray:
        """dh/dy at the last response."""
        interface_stiffness(self.interface.points, self._trial.D, self._K)
        return self._condensed.c * self._K - self.effective.R


def mean_penalty(
    gap: FloatArray, dg: FloatArray, coefficient: float
) -> tuple[FloatArray, FloatArray]:
    """Mean reactions (m,) of springs that push at negative gaps, and their slopes.

    `p* = -(psi(g + dg) - psi(g))/dg` with `psi = c min(g, 0)^2 / 2`.
    """
    end = gap + dg
    below, above = np.minimum(gap, 0.0), np.minimum(end, 0.0)
    crossing = (gap < 0.0) != (end < 0.0)
    step = np.where(crossing & (dg != 0.0), dg, 1.0)
    secant = -0.5 * (above**2 - below**2) / step
    mean = np.where(crossing, secant, -0.5 * (below + above))
    slope = np.where(crossing, (-above - secant) / step, np.where(end < 0.0, -0.5, 0.0))
    return coefficient * mean, coefficient * slope
