"""The energy-conserving step: midpoint rule with the mean traction of the joints.

    M (v_1 - v_0)/dt + C du/dt + K (u_0 + du/2) + J^T f* = (F_0 + F_1)/2 ,  du = dt (v_0 + v_1)/2

For linear systems it is the average acceleration; with joints the balance of energy holds to
rounding whatever dt and the joints' stiffness. The matrix is that of the average acceleration.
Unilateral relations push by mean reactions that give back all energy (`contact.conserving`).
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.contact.conserving import ConservingContact
from ssilang.kernel.interface.interface import Interface
from ssilang.kernel.interface.response import (
    interface_energies,
    interface_forces,
    interface_stiffness,
    mean_response,
    new_trial,
)
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import end_of_step, products_of, support_work
from ssilang.kernel.stepping.state import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
    Motion,
    Outcome,
    Recorder,
)
from ssilang.kernel.stepping.track import View, whole_view

TOLERANCE = 1e-14
ACCEPTED = 1e-11
PLAIN_TURNS = 15
MOST_TURNS = 80


class ConservingLoop:
    """Steps of one dt. Accelerations and reactions are means over the step."""

    def __init__(self, problem: Problem, motion: Motion, effective: Effective) -> None:
        self.problem, self.motion, self.effective = problem, motion, effective
        self._by = products_of(problem)
        joints = problem.interface
        if joints is not None:
            self._end = new_trial(motion.w.shape, joints.size)
            self._mean = np.zeros_like(motion.t)
            self._now = motion.joints
            self._K = np.zeros((joints.size, joints.size))
        self._contact: ConservingContact | None = None
        if problem.contact is not None:
            self._contact = ConservingContact(
                effective,
                problem.contact,
                problem.contact_options,
                None if joints is None else joints.J,
            )

    @property
    def size(self) -> int:
        """Unknowns of the joints."""
        return 0 if self.problem.interface is None else self.problem.interface.size

    def respond(self, y: FloatArray) -> FloatArray:
        """h = 2 f* - R y at the increment y of the jumps."""
        joints = self.problem.interface
        assert joints is not None
        return self._residual(joints, y, y)[1]

    def tangent(self) -> FloatArray:
        """dh/dy at the last response."""
        joints = self.problem.interface
        assert joints is not None
        interface_stiffness(joints.points, self._end.D, self._K)
        found: FloatArray = 2 * self._K - self.effective.R
        return found

    def renew(self, problem: Problem) -> None:
        """Go on with other loads, all else being the same."""
        self.problem = problem

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps on the whole problem's arrays."""
        p, m, dt, worst = self.problem, self.motion, self.effective.dt, 0
        loads, imposed = factors @ p.loading.forces.T, factors @ p.loading.imposed.T
        for k in range(len(recorder.row)):
            mean_load = 0.5 * (loads[k] + loads[k + 1])
            r = 2 * mean_load - 2 * (self._by.K @ m.u) + (4 / dt) * (self._by.M @ m.v)
            dd = imposed[k + 1] - self._by.D @ m.u
            if self._contact is None:
                du, turns, residual = self._increment(r, dd)
            else:
                du, turns, residual = self._with_contact(self._contact, r, dd, factors[k : k + 2])
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            self._advance(du, dd, mean_load, factors[k : k + 2])
            if not np.isfinite(m.u).all():
                return k, -1, np.inf
            end_of_step(m, recorder, k)
        return len(recorder.row), worst, 0.0

    def view(self, unknowns: IntArray) -> View:
        """Unknowns as they are."""
        return whole_view(self.motion, unknowns)

    def _increment(self, r: FloatArray, dd: FloatArray) -> tuple[FloatArray, int, float]:
        e, joints = self.effective, self.problem.interface
        du = e.solve(r)
        if dd.any():
            du = du + e.imposed(dd)
        if joints is None:
            return du, 1, 0.0
        y0 = self._by.J @ du
        y = y0.copy()
        size, h = self._residual(joints, y, y0)
        scale = max(np.abs(y0).max(), np.abs(self.motion.delta).max(), 1e-300)
        for turn in range(1, MOST_TURNS + 1):
            scale = max(scale, float(np.abs(y).max()))
            if size <= TOLERANCE * scale:
                return du - e.Y @ h, turn, size / scale
            interface_stiffness(joints.points, self._end.D, self._K)
            tangent = 2 * self._K - e.R
            rest = y - y0 + e.S @ h
            dy = -np.linalg.solve(np.eye(len(y)) + e.S @ tangent, rest)
            size, h, length = self._search(joints, y, y0, dy, size, turn)
            if length * np.abs(dy).max() <= 1e-15 * scale and size <= ACCEPTED * scale:
                return du - e.Y @ h, turn, size / scale
        return du, -MOST_TURNS, size / scale

    def _with_contact(
        self, contact: ConservingContact, r: FloatArray, dd: FloatArray, factors: FloatArray
    ) -> tuple[FloatArray, int, float]:
        """The increment with unilateral relations; `motion.contact` becomes their mean reaction."""
        e, m, rows, joints = self.effective, self.motion, contact.contact, self.problem.interface
        du = e.solve(r)
        if dd.any():
            du = du + e.imposed(dd)
        y0 = self._by.J @ du if joints is not None else np.zeros(0)
        gap = rows.gaps(m.u, factors[0])
        change = rows.G @ du - rows.imposed @ (factors[1] - factors[0])
        found = contact.solve(self, y0, gap, change)
        m.contact[:] = 0.5 * found.P
        du = du + contact.YG @ found.P
        if joints is not None:
            du = du - e.Y @ found.h
        return du, found.turns, found.residual

    def _search(
        self, joints: Interface, y: FloatArray, y0: FloatArray, dy: FloatArray, before: float,
        turn: int,
    ) -> tuple[float, FloatArray, float]:  # fmt: skip
        """Move y along dy, halving the step after the first turns until the residual falls."""
        length = 1.0
        start = y.copy()
        for _ in range(12):
            y[:] = start + length * dy
            size, h = self._residual(joints, y, y0)
            if turn <= PLAIN_TURNS or size < before:
                break
            length *= 0.5
        return size, h, length

    def _residual(
        self, joints: Interface, y: FloatArray, y0: FloatArray
    ) -> tuple[float, FloatArray]:
        m, e = self.motion, self.effective
        mean_response(joints.points, self._now, m.delta + y, self._end, self._mean)
        h = 2 * self._end.f - e.R @ y
        return float(np.abs(y - y0 + e.S @ h).max()), h

    def _advance(
        self, du: FloatArray, dd: FloatArray, mean_load: FloatArray, factors: FloatArray
    ) -> None:
        p, m, dt, joints = self.problem, self.motion, self.effective.dt, self.problem.interface
        by = self._by
        v0, middle = m.v.copy(), m.u + 0.5 * du
        m.u[:] += du
        m.v[:] = 2 * du / dt - v0
        m.a[:] = (m.v - v0) / dt
        m.reaction[:] = by.M @ m.a + by.K @ middle - mean_load
        if p.C.nnz:
            damping = by.C @ du / dt
            m.reaction[:] += damping
            m.energies[DAMPED] += du @ damping
        if joints is not None:
            m.reaction[:] += by.Jt @ self._end.f
            m.delta[:] = by.J @ m.u
            end = self._end
            m.w[:, :], m.t[:, :], m.state[:, :] = end.w, end.t, end.state
            interface_forces(joints.points, m.t, m.f)
            m.energies[STORED], m.energies[LOST] = interface_energies(
                joints.points, m.w, m.t, m.state
            )
        m.energies[EXTERNAL] += du @ mean_load
        m.energies[EXTERNAL] += support_work(
            p, m.reaction, m.contact, du, dd, factors[1] - factors[0]
        )
        m.energies[KINETIC] = 0.5 * m.v @ (by.M @ m.v)
        m.energies[ELASTIC] = 0.5 * m.u @ (by.K @ m.u)
        if p.contact is not None and p.contact_options.method == "PENALITE":
            m.energies[ELASTIC] += p.contact.penalty_energy(
                p.contact.gaps(m.u, factors[1]), p.contact_options.coefficient
            )
