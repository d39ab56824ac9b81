"""Small problems in the coordinates that make their matrices diagonal, for the compiled loops.

The coordinates are all those of the problem: nothing is truncated. Supports that do not move and
motions that nothing excites take no part; displacements, and reactions from equilibrium, are put
back for the instants that are kept.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.laws.columns import LawCode, Parameter, Variable
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.interface.response import Joints, interface_forces
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.arrays import joints_of
from ssilang.kernel.stepping.rests.dense.loop import Motion, Saved
from ssilang.kernel.stepping.rests.dense.still_supports import reactions, supports_are_still
from ssilang.kernel.stepping.rests.modal.loop import Modal, ModalRows, ModalStep, march_modal
from ssilang.kernel.stepping.rests.modal.one_mode import carry, march_mode
from ssilang.kernel.stepping.rests.modal.one_spring import (
    Line,
    LineRows,
    LineState,
    Spring,
    march_line,
)
from ssilang.kernel.stepping.rests.modal.springs import march_normal

DIAGONAL = 1e-13  # of the step's matrix: damping off the diagonal that rounding leaves
NOTHING = 1e-14  # of the largest: a part of a mode that is rounding
LINE_MODES = 8  # most modes of the loop of one spring


@dataclass(frozen=True, eq=False)
class Modes:
    """Coordinates z, `u = X z` (n, r), in which mass, damping and stiffness are diagonal.

    `start` gives z from the motions that the supports leave; `P` is the inverse of the step's
    matrix, `J` (q, r) the interface, `forces` (n_loads, r) the loads.
    """

    X: FloatArray
    T: FloatArray
    inner: FloatArray
    m: FloatArray
    c: FloatArray
    k: FloatArray
    J: FloatArray
    forces: FloatArray

    @property
    def size(self) -> int:
        """Number r of coordinates."""
        return len(self.m)

    def coordinates(self, fields: FloatArray) -> FloatArray:
        """z (r, k) of fields (n, k) that the supports allow."""
        return np.asarray(np.linalg.solve(self.inner, self.T.T @ fields), dtype=float)


def modes_of(problem: Problem, effective: Effective) -> Modes | None:
    """All modes of a step's problem; None if its damping has no common modes, or a support moves.

    They are orthonormal in the step's matrix, which is regular also where the mass is not.
    """
    import scipy.linalg as la

    if effective.R.any() or not supports_are_still(problem):
        return None
    T = problem.constraints.T.toarray()
    A, M, C, K = (T.T @ (x @ T) for x in (effective.A, problem.M, problem.C, problem.K))
    try:
        m, inner = la.eigh(M, A)
    except la.LinAlgError:
        return None
    c = inner.T @ C @ inner
    if np.abs(c - np.diag(np.diag(c))).max(initial=0.0) > DIAGONAL * max(effective.dt, 1e-300):
        return None
    m[np.abs(m) <= NOTHING * np.abs(m).max(initial=0.0)] = 0.0
    X = T @ inner
    J = np.zeros((0, len(m))) if problem.interface is None else problem.interface.J @ X
    return Modes(
        X, T, inner, m, np.diag(c).copy(), np.einsum("ji,jk,ki->i", inner, K, inner, optimize=True),
        np.ascontiguousarray(J), np.ascontiguousarray(problem.loading.forces.T @ X),
    )  # fmt: skip


class SmallLoop:
    """Steps of one dt; `light` says that a run without its energies costs much less."""

    def __init__(self, problem: Problem, motion: Motion, effective: Effective, modes: Modes):
        self.problem, self.motion, self.modes = problem, motion, modes
        s = problem.scheme
        self._scheme = np.array([s.alpha_m, s.alpha_f, s.beta, s.gamma])
        self._joints = joints_of(problem)
        self._dt = effective.dt
        self._seen: FloatArray | None = None  # displacement up to which z is known
        self._z = np.zeros((3, modes.size))
        self._line = line_of(problem, motion, modes, self._joints, self._scheme)
        self.balance = np.zeros(2)  # see `LineState`
        self._normal, J = shearless(self._joints, modes)
        joints = self._joints if self._normal is None else self._normal
        Jt = np.ascontiguousarray(J.T)
        self._stepped = joints
        self._modal = Modal(modes.m, modes.c, modes.k, J, Jt, modes.forces, self._scheme)
        self._step = ModalStep(effective.dt, np.ones(modes.size), np.ascontiguousarray(J @ Jt))
        self._pushes = self._normal is not None and only_pushes(joints, motion.state)

    @property
    def light(self) -> bool:
        """Whether energies are kept only if asked for."""
        return self._line is not None

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        """As `compiled_loop.march`, on the whole problem's arrays; a history may be empty."""
        m, X = self.motion, self.modes.X
        if self._seen is None or not np.array_equal(self._seen, m.u):
            self._z = self.modes.coordinates(np.stack([m.u, m.v, m.a], axis=1)).T.copy()
        chosen = save >= 0
        run = self._march_line if self._line is not None else self._march_modal
        outcome, kept = run(factors, save, saved, history)
        m.u[:], m.v[:], m.a[:] = self._z @ X.T
        self._seen = m.u.copy()
        forces = self.problem.loading.forces.T
        if len(saved.u):
            for part, z in zip((saved.u, saved.v, saved.a), kept, strict=True):
                np.matmul(z, X.T, out=part)
            loads = factors[1:][chosen] @ forces
            saved.reaction[:] = reactions(
                self.problem, self._joints, saved.u, saved.v, saved.a, saved.t, loads
            )
        return outcome

    def _march_modal(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[tuple[int, int, float], list[FloatArray]]:
        m, rows = self.motion, len(saved.u)
        u, v, a = self._z
        kept = [np.zeros((rows, self.modes.size)) for _ in range(3)]
        w, t, delta, f, to_w, to_t = m.w, m.t, m.delta, m.f, saved.w, saved.t
        if self._normal is not None:
            w, t, to_w, to_t = (x[..., -1:].copy() for x in (w, t, to_w, to_t))
            delta, f = w[:, 0].copy(), self._normal.weights * t[:, 0]
        few = Motion(u, v, a, delta, f, w, t, m.state, np.zeros(0), m.energies, m.contact)
        none = np.zeros((0, *w.shape))
        to = ModalRows(none, kept[0], kept[1], kept[2], to_w, to_t, saved.state)
        if self._pushes:
            weights = self._stepped.weights
            k = weights * self._stepped.p[:, Parameter.KN]
            outcome = march_normal(
                self._modal, self._step, weights, k, few, factors, save, to, history
            )
        else:
            newton = workspace(w.shape, len(f))
            outcome = march_modal(
                self._modal, self._step, self._stepped, few, newton, factors, save, to, history
            )
        if self._normal is not None:
            self._put_normal(self._z[:1], w[None], t[None], m.w[None], m.t[None])
            self._put_normal(kept[0], to_w, to_t, saved.w, saved.t)
            m.delta[:] = self.modes.J @ self._z[0]
            interface_forces(self._joints, m.t, m.f)
        return outcome, kept

    def _put_normal(
        self, z: FloatArray, w: FloatArray, t: FloatArray, to_w: FloatArray, to_t: FloatArray
    ) -> None:
        """Whole jumps and tractions of instants from their coordinates and normal parts."""
        j = self._joints
        d = j.B.shape[1]
        jumps = (z @ self.modes.J.T).reshape(len(z), len(self.modes.J) // d, d)[:, j.pairs[:, 0]]
        to_w[:] = np.einsum("pij,kpj->kpi", j.B, jumps)
        to_w[..., -1], to_t[..., -1] = w[..., 0], t[..., 0]
        to_t[..., :-1] = 0.0

    def _march_line(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[tuple[int, int, float], list[FloatArray]]:
        assert self._line is not None
        line, spring, active, idle = self._line
        m, rows = self.motion, len(saved.u)
        joint = np.zeros(3)
        if spring.weight > 0.0:
            joint[:] = m.w[0, -1], m.t[0, -1], m.state[0, Variable.XI]
        u, v, a = self._z[:, active].copy()
        x = LineState(u, v, a, joint, m.energies, self.balance)
        few = [np.zeros((rows, len(active))) for _ in range(3)]
        to = LineRows(few[0], few[1], few[2], np.zeros((rows, 3)))
        if not line.forces.shape[0]:
            factors = factors[:, :0]
        factors = np.ascontiguousarray(factors)
        if len(active) == 1:
            outcome = march_mode(line, self._dt, spring, x, factors, save, to, history)
        else:
            one = np.ones(len(active))
            outcome = march_line(line, self._dt, one, spring, x, factors, save, to, history)
        self._z[:, active] = x.u, x.v, x.a
        if spring.weight > 0.0:
            self._put_joint(joint[None], m.w[None], m.t[None], m.state[None])
            self._put_joint(to.joint, saved.w, saved.t, saved.state)
            B = self._joints.B[0]
            m.delta[:], m.f[:] = B.T @ m.w[0], spring.weight * (B.T @ m.t[0])
        kept = [np.zeros((rows, self.modes.size)) for _ in range(3)]
        for whole, part in zip(kept, few, strict=True):
            whole[:, active] = part
        if len(idle):
            still, led = self._z[1:, idle].copy(), np.zeros((2, rows, len(idle)))
            carry(self._unmoved(), save, still, led)
            self._z[1:, idle] = still
            kept[1][:, idle], kept[2][:, idle] = led
        return outcome, kept

    def _unmoved(self) -> FloatArray:
        """What a step makes of velocity and acceleration of a motion that does not move."""
        beta, gamma, dt = self._scheme[2], self._scheme[3], self._dt
        return np.array(
            [
                [1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)],
                [-1 / (beta * dt), 1 - 0.5 / beta],
            ]
        )

    def _put_joint(self, rows: FloatArray, w: FloatArray, t: FloatArray, state: FloatArray) -> None:
        """Jumps, tractions and states of instants from rows of (w, t, xi)."""
        p = self._joints.p[0]
        w[:, 0, -1], t[:, 0, -1], state[:, 0, Variable.XI] = rows.T
        if p[Parameter.FU] > 0.0:
            lost = -np.expm1(-p[Parameter.FU] / p[Parameter.GF] * rows[:, 2])
            state[:, 0, Variable.DAMAGE] = np.where(rows[:, 1] < 0.0, 0.0, lost)


def shearless(joints: Joints, modes: Modes) -> tuple[Joints | None, FloatArray]:
    """Joints that push along their normals alone (None if some resist shear), J on the modes."""
    n, width = joints.pairs.shape
    shear = joints.p[:, Parameter.KS1 : Parameter.KS2 + 1]
    if n == 0 or width != 1 or (joints.codes != LawCode.SDM).any() or shear.any():
        return None, modes.J
    d = joints.B.shape[1]
    rows = modes.J.reshape(-1, d, modes.size)[joints.pairs[:, 0]]
    J = np.ascontiguousarray(np.einsum("pj,pjr->pr", joints.B[:, -1], rows))
    places = np.arange(n, dtype=np.int64)[:, None]
    return Joints(places, np.ones((n, 1, 1)), joints.weights, joints.codes, joints.p), J


def only_pushes(joints: Joints, state: FloatArray) -> bool:
    """Whether joints without shear have no strength, no closing traction and no past but xi."""
    past = state.copy()
    past[:, Variable.XI] = 0.0
    return not (joints.p[:, [Parameter.FU, Parameter.FC]].any() or past.any())


def line_of(
    problem: Problem, motion: Motion, modes: Modes, joints: Joints, scheme: FloatArray
) -> tuple[Line, Spring, IntArray, IntArray] | None:
    """The problem as a few modes and one spring; None if it is not.

    The modes that move, and those that only have a velocity and an acceleration: without mass,
    damping and load, they stay where they are.
    """
    spring, b = Spring(0.0, 0.0, 0.0, 0.0, 0.0), np.zeros(modes.size)
    if problem.interface is not None:
        found = _spring_of(motion, modes, joints, 1 - scheme[1])
        if found is None:
            return None
        spring, b = found
    z = np.abs(modes.coordinates(np.stack([motion.u, motion.v, motion.a], axis=1)))
    moves = (z > NOTHING * z.max(axis=0)).any(axis=1)
    pulls = np.abs(b) > NOTHING * np.abs(b).max(initial=0.0)
    loaded = np.abs(modes.forces) > NOTHING * np.abs(modes.forces).max(axis=1, initial=0.0)[:, None]
    away = z[:, 0] > NOTHING * z[:, 0].max(initial=0.0)
    driven = pulls | loaded.any(axis=0) | (modes.m != 0.0) | (modes.c != 0.0) | away
    active = np.flatnonzero(driven & (moves | pulls | loaded.any(axis=0)))
    idle = np.flatnonzero(moves & ~driven)
    if not 0 < len(active) <= LINE_MODES:
        return None
    forces = modes.forces[:, active] if loaded.any() else np.zeros((0, len(active)))
    m, c, k, b = (np.ascontiguousarray(x[active]) for x in (modes.m, modes.c, modes.k, b))
    return Line(m, c, k, b, np.ascontiguousarray(forces), scheme), spring, active, idle


def _spring_of(
    motion: Motion, modes: Modes, joints: Joints, share: float
) -> tuple[Spring, FloatArray] | None:
    """The only point of the interface and its jump (r,), if shear cannot move there."""
    if len(joints.weights) != 1 or joints.codes[0] != LawCode.SDM or joints.pairs.shape[1] != 1:
        return None
    jumps = joints.B[0] @ modes.J
    still = np.abs(jumps[:-1]).max(initial=0.0) <= NOTHING * np.abs(jumps[-1]).max(initial=0.0)
    state = motion.state[0].copy()
    state[[Variable.XI, Variable.DAMAGE]] = 0.0
    if not still or state.any() or motion.w[0, :-1].any():
        return None
    p, weight, b = joints.p[0], float(joints.weights[0]), jumps[-1]
    k, fu, gf = (float(p[i]) for i in (Parameter.KN, Parameter.FU, Parameter.GF))
    if fu > 0.0:  # the closed form is the only answer if the rest is stiffer than the softening
        a = fu / gf
        if 1.0 - share * weight * float(b @ b) * k * a * fu / (k - a * fu) <= 0.0:
            return None
    return Spring(weight, k, fu, gf, float(p[Parameter.FC])), b
