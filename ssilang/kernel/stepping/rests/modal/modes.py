"""Small problems in the coordinates that make their matrices diagonal, for the compiled loops.

The coordinates are all those of the problem: nothing is truncated. Supports that do not move and
motions that nothing excites take no part; displacements, and reactions from equilibrium, are put
back for the instants that are kept.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.scientific import la, sp
from ssilang.kernel.contact.active_set import ActiveSet
from ssilang.kernel.interface.laws.columns import N_STATE, LawCode, Parameter, Variable
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.interface.response import Joints, interface_forces
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.problem import Problem, keep_reactions, supports_are_still
from ssilang.kernel.stepping.rests.modal.diagonal import sweep_of
from ssilang.kernel.stepping.rests.modal.springs import OnSprings, run_springs, springs_of
from ssilang.kernel.stepping.rests.reduced.damping import split
from ssilang.kernel.stepping.rests.reduced.loop import (
    Reduced,
    dashpots_of,
    reduced_step,
    run_reduced,
)
from ssilang.kernel.stepping.state import Motion, Outcome, Recorder, Tap, recorder_of
from ssilang.kernel.stepping.track import JointRows, Matrix, View, expand

DIAGONAL = 1e-13  # of the step's matrix: damping off the diagonal that rounding leaves
NOTHING = 1e-14  # of the largest: a part of a mode that is rounding


@dataclass(frozen=True, eq=False)
class Modes:
    """Coordinates z, `u = X z` (n, r), in which mass, damping and stiffness are diagonal.

    `T` and `inner` give z from the motions that the supports leave. `J` (q, r) is the interface,
    `forces` (n_loads, r) the loads. What of the damping is not diagonal is `B^T sense B`, B (d, r).
    """

    X: FloatArray
    T: FloatArray
    inner: FloatArray
    m: FloatArray
    c: FloatArray
    k: FloatArray
    J: FloatArray
    forces: FloatArray
    B: FloatArray
    sense: FloatArray

    @property
    def size(self) -> int:
        """Number r of coordinates."""
        return len(self.m)

    def coordinates(self, fields: FloatArray) -> FloatArray:
        """z (r, k) of fields (n, k) that the supports allow."""
        return np.asarray(np.linalg.solve(self.inner, self.T.T @ fields), dtype=float)


def modes_of(problem: Problem, effective: Effective) -> Modes | None:
    """All modes of a step's problem; None if it has none, or a support moves.

    They are orthonormal in the step's matrix, which is regular also where the mass is not. Where
    the damping is not diagonal in them, they are those of the problem without the part of it that
    is no sum of mass and stiffness.
    """
    if effective.R.any() or not supports_are_still(problem):
        return None
    Y = problem.constraints.T
    M, C, K = (sp.csr_array(Y.T @ x @ Y) for x in (problem.M, problem.C, problem.K))
    A, n = (Y.T @ effective.A @ Y).toarray(), newmark_of(problem.scheme, effective.dt)
    T: FloatArray = Y.toarray()
    B, sense = np.zeros((0, len(A))), np.zeros(0)
    try:
        m, inner = la.eigh(M.toarray(), A)
        c = inner.T @ (C @ inner)
        if not _is_diagonal(c, effective.dt):
            damping = split(C, M, K, len(A))
            if damping is None:
                return None
            m, inner = la.eigh(M.toarray(), A - n.damping * damping.rest.toarray())
            c = inner.T @ ((C - damping.rest) @ inner)
            if not _is_diagonal(c, effective.dt):
                return None
            B, sense = damping.on(np.eye(len(A)))
    except la.LinAlgError:
        return None
    m[np.abs(m) <= NOTHING * np.abs(m).max(initial=0.0)] = 0.0
    X = T @ inner
    return Modes(
        X, T, inner, m, np.diag(c).copy(), np.einsum("ji,ji->i", inner, K @ inner),
        np.ascontiguousarray(problem.interface.J @ X),
        np.ascontiguousarray(problem.loading.forces.T @ X), B @ inner, sense,
    )  # fmt: skip


def _is_diagonal(c: FloatArray, dt: float) -> bool:
    rest = np.abs(c - np.diag(np.diag(c))).max(initial=0.0)
    return bool(rest <= DIAGONAL * max(dt, 1e-300))


Steps = Callable[[FloatArray, Recorder], tuple[Outcome, Recorder]]
Kept = Recorder | Tap
JointsOf = Callable[[Kept], JointRows]


class SmallLoop:
    """Steps of one dt on the modes, by the loop that fits: see `choose`.

    `springs` are springs that only push; None if it is not that.
    """

    remembered = ("_z", "_seen")

    def __init__(self, problem: Problem, motion: Motion, effective: Effective, modes: Modes):
        self.problem, self.motion, self.modes = problem, motion, modes
        self._newmark = newmark_of(problem.scheme, effective.dt)
        self._joints = problem.interface.points
        self._seen: FloatArray | None = None  # displacement up to which z is known
        self._z = np.zeros((3, modes.size))
        plain = not len(modes.sense)
        self.normal, J = shearless(self._joints, modes)
        joints = self._joints if self.normal is None else self.normal
        self._stepped = joints
        rows = np.ascontiguousarray(np.vstack([J, modes.B]).T)
        self._model = Reduced(
            modes.m, modes.c, modes.k, rows, modes.sense, modes.forces, np.zeros((len(J), 0))
        )
        self._step = reduced_step(self._model, self._newmark, len(J))
        self.springs: ActiveSet | None = None
        if plain and self.normal is not None and only_pushes(joints, motion.state):
            k = joints.weights * joints.p[:, Parameter.KN]
            n = self._newmark
            self._on_springs = OnSprings(n, self._step.diagonal, J, rows, modes.forces)
            self.springs = springs_of(self._step, k)
        self.using("modes")

    def using(self, way: str) -> "SmallLoop":
        """The loop with one of its ways to step: `modes`, `springs`."""
        ways: dict[str, tuple[Steps, JointsOf]] = {
            "modes": (self._by_modes, self._of_modes),
            "springs": (self._by_springs, self._of_springs),
        }
        self._way = way
        self._steps, self._joint_rows = ways[way]
        return self

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps on the whole problem's arrays; the recorder may have no room for energies."""
        m, X, r = self.motion, self.modes.X, recorder
        if self._seen is None or not np.array_equal(self._seen, m.u):
            self._z = self.modes.coordinates(np.stack([m.u, m.v, m.a], axis=1)).T.copy()
        outcome, kept = self._steps(factors, recorder)
        m.u[:], m.v[:], m.a[:] = self._z @ X.T
        self._seen = m.u.copy()
        if len(r.u):
            for part, z in zip((r.u, r.v, r.a), (kept.u, kept.v, kept.a), strict=True):
                part[:] = expand(X, z)
            r.w[:], r.t[:], r.state[:] = self._joint_rows(kept)
        keep_reactions(self.problem, factors, r)
        return outcome

    def view(self, unknowns: IntArray) -> View:
        """How unknowns and joints follow from the modes."""
        m, r = self.motion, self.modes.size
        shapes: dict[str, tuple[int, ...]] = {"u": (r,), "v": (r,), "a": (r,)}
        if self._way == "springs":
            shapes |= {"f": m.f[: len(m.w)].shape, "w": m.w[:, :1].shape, "state": m.w[:, :1].shape}
        else:
            w = m.w.shape if self.normal is None else m.w[:, :1].shape
            shapes |= {"w": w, "t": w, "state": m.state.shape}
        found = Matrix(self.modes.X[unknowns])
        return View(np.arange(r), shapes, found, self._joint_rows)

    def _by_modes(self, factors: FloatArray, recorder: Recorder) -> tuple[Outcome, Recorder]:
        """Steps by Newton's method on the interface; the kept coordinates."""
        m, r = self.motion, recorder
        u, v, a = self._z
        few = m._replace(u=u, v=v, a=a, reaction=np.zeros(0), contact=np.zeros(0))
        normal = self.normal
        if normal is not None:
            w, t = m.w[:, -1:].copy(), m.t[:, -1:].copy()
            few = few._replace(w=w, t=t, delta=w[:, 0].copy(), f=normal.weights * t[:, 0])
        kept = recorder_of(few, r.row, r.energies, ("u", "v", "a", "w", "t", "state"), tap=r.tap)
        work = workspace(few.w.shape, len(few.f))
        dashpots = dashpots_of(self.modes.B @ v, self.modes.B @ a, len(few.f), len(u))
        outcome = run_reduced(
            self._model, self._step, self._stepped, few, dashpots, work, factors, kept
        )
        if normal is not None:
            self._put_normal(few.w, few.t)
        return outcome, kept

    def _of_modes(self, kept: Kept) -> JointRows:
        """Joints of rows that `run_reduced` kept."""
        if self.normal is None:
            return JointRows(kept.w, kept.t, kept.state)
        return JointRows(
            *whole_joints(self._joints, self.modes, kept.u, kept.w, kept.t), kept.state
        )

    def _by_springs(self, factors: FloatArray, recorder: Recorder) -> tuple[Outcome, Recorder]:
        """Steps on springs that only push."""
        m, r = self.motion, recorder
        assert self.normal is not None
        assert self.springs is not None
        weights = self.normal.weights
        u, v, a = self._z
        few = m._replace(
            u=u, v=v, a=a, delta=np.zeros(0), f=weights * m.t[:, -1], w=m.w[:, -1:].copy(),
            t=np.zeros((0, 1)), state=m.state[:, [Variable.XI]], reaction=np.zeros(0),
            contact=np.zeros(0),
        )  # fmt: skip
        kept = recorder_of(few, r.row, r.energies, ("u", "v", "a", "f", "w", "state"), tap=r.tap)
        outcome = run_springs(self._on_springs, self.springs, few, sweep_of(len(u)), factors, kept)
        m.state[:, Variable.XI] = few.state[:, 0]
        self._put_normal(few.w, (few.f / weights)[:, None])
        return outcome, kept

    def _of_springs(self, kept: Kept) -> JointRows:
        """Joints of rows that `run_springs` kept: their states hold the largest opening alone."""
        state = np.zeros((*kept.f.shape, N_STATE))
        state[..., Variable.XI] = kept.state[..., 0]
        t = kept.f[..., None] / self._joints.weights[:, None]
        return JointRows(*whole_joints(self._joints, self.modes, kept.u, kept.w, t), state)

    def _put_normal(self, w: FloatArray, t: FloatArray) -> None:
        """Jumps and tractions of the motion from normal parts (n_points, 1)."""
        m, z = self.motion, self._z[0]
        whole_w, whole_t = whole_joints(self._joints, self.modes, self._z[:1], w[None], t[None])
        m.w[:], m.t[:] = whole_w[0], whole_t[0]
        m.delta[:] = self.modes.J @ z
        interface_forces(self._joints, m.t, m.f)


def whole_joints(
    joints: Joints, modes: Modes, z: FloatArray, w: FloatArray, t: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Jumps and tractions (k, n_points, d) from coordinates and normal parts (k, n_points, 1)."""
    whole_w = local_jumps(joints, expand(modes.J, z))
    whole_t = np.zeros_like(whole_w)
    whole_w[..., -1], whole_t[..., -1] = w[..., 0], t[..., 0]
    return whole_w, whole_t


def local_jumps(joints: Joints, delta: FloatArray) -> FloatArray:
    """Jumps (k, n_points, d) at the joints' points from those (k, q) at their nodes."""
    d = joints.B.shape[1]
    jumps = delta.reshape(len(delta), delta.shape[1] // d, d)[:, joints.pairs[:, 0]]
    return np.einsum("pij,kpj->kpi", joints.B, jumps)


def has_no_shear(joints: Joints) -> bool:
    """Whether joints act along their normals alone."""
    shear = joints.p[:, Parameter.KS1 : Parameter.KS2 + 1]
    sdm = (joints.codes == LawCode.SDM).all()
    return bool(joints.pairs.shape[1] == 1 and sdm and not shear.any())


def shearless(joints: Joints, modes: Modes) -> tuple[Joints | None, FloatArray]:
    """Joints that push along their normals alone (None if some resist shear), J on the modes."""
    n = len(joints.pairs)
    if n == 0 or not has_no_shear(joints):
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
