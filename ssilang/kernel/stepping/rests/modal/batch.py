"""Small problems on springs that only push, set up for `march_springs`; instants made if asked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.laws.columns import Parameter, Variable
from ssilang.kernel.interface.response import Joints, interface_forces
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.problem.sharing import LoadBasis
from ssilang.kernel.stepping.rests.dense.arrays import joints_of
from ssilang.kernel.stepping.rests.dense.loop import N_ENERGIES, Motion
from ssilang.kernel.stepping.rests.dense.still_supports import reactions
from ssilang.kernel.stepping.rests.modal.loop import Modal, ModalStep
from ssilang.kernel.stepping.rests.modal.modes import Modes, modes_of, only_pushes, shearless
from ssilang.kernel.stepping.rests.modal.springs_batch import (
    Ends,
    SpringMotions,
    SpringRows,
    march_springs,
)
from ssilang.kernel.stepping.snapshot import Instants, Snapshot

Outcome = tuple[int, int, float]


@dataclass(frozen=True, eq=False)
class KeptInstants:
    """The kept steps of one motion in coordinates; whole arrays are made when one is asked for."""

    problem: Problem
    modes: Modes
    joints: Joints
    z: tuple[FloatArray, FloatArray, FloatArray]  # (n_rows, r) each
    delta: FloatArray  # (n_rows, n_points)
    f: FloatArray
    xi: FloatArray
    factors: FloatArray  # (n_rows, k)
    past: FloatArray  # (n_points, N_STATE)

    @cached_property
    def u(self) -> FloatArray:
        """Displacements (n_rows, n)."""
        return self.z[0] @ self.modes.X.T

    @cached_property
    def v(self) -> FloatArray:
        """Velocities."""
        return self.z[1] @ self.modes.X.T

    @cached_property
    def a(self) -> FloatArray:
        """Accelerations."""
        return self.z[2] @ self.modes.X.T

    @cached_property
    def w(self) -> FloatArray:
        """Jumps (n_rows, n_points, d)."""
        j = self.joints
        d = j.B.shape[1]
        jumps = (self.z[0] @ self.modes.J.T).reshape(len(self.delta), -1, d)[:, j.pairs[:, 0]]
        found: FloatArray = np.einsum("pij,kpj->kpi", j.B, jumps)
        found[..., -1] = self.delta
        return found

    @cached_property
    def t(self) -> FloatArray:
        """Tractions (n_rows, n_points, d)."""
        found = np.zeros((*self.f.shape, self.joints.B.shape[1]))
        found[..., -1] = self.f / self.joints.weights
        return found

    @cached_property
    def state(self) -> FloatArray:
        """States (n_rows, n_points, N_STATE)."""
        found = np.repeat(self.past[None], len(self.xi), axis=0)
        found[..., Variable.XI] = self.xi
        return found

    @cached_property
    def reaction(self) -> FloatArray:
        """What the conditions push by (n_rows, n)."""
        loads = self.factors @ self.problem.loading.forces.T
        return reactions(self.problem, self.joints, self.u, self.v, self.a, self.t, loads)


class SpringInstant(Snapshot):
    """One of the kept instants."""

    def __init__(self, kept: KeptInstants, row: int, step: int, time: float) -> None:
        self.__dict__.update(
            problem=kept.problem, step=step, time=time, contact=NOTHING, kept=kept, row=row
        )

    def __getattr__(self, name: str) -> FloatArray:
        if name not in LATER:
            raise AttributeError(name)
        kept: KeptInstants = self.__dict__["kept"]
        found: FloatArray = getattr(kept, name)[self.__dict__["row"]]
        return found


LATER = ("u", "v", "a", "reaction", "w", "t", "state")
NOTHING = np.zeros(0)


class SpringsTogether:
    """Steps of one dt of problems that share a model; see `springs_together`."""

    name = "compiled"

    def __init__(
        self, problems: Sequence[Problem], motions: Sequence[Motion], effective: Effective,
        modes: Modes, normal: Joints, J: FloatArray,
    ) -> None:  # fmt: skip
        self.problems, self.motions, self.modes, self.normal = problems, motions, modes, normal
        self.solver = effective.inverse.factor.name
        self.joints = joints_of(problems[0])
        s = problems[0].scheme
        Jt = np.ascontiguousarray(J.T)
        self._loads = LoadBasis([p.loading.forces.T @ modes.X for p in problems])
        scheme = np.array([s.alpha_m, s.alpha_f, s.beta, s.gamma])
        self._modal = Modal(modes.m, modes.c, modes.k, J, Jt, self._loads.forces, scheme)
        self._step = ModalStep(effective.dt, np.ones(modes.size), np.ascontiguousarray(J @ Jt))
        self._z: FloatArray | None = None  # (3, m, r)

    def march(
        self, factors: list[FloatArray], save: list[IntArray], history: list[FloatArray],
        times: FloatArray,
    ) -> tuple[list[Outcome], list[Instants]]:  # fmt: skip
        """Steps of all problems; see `together.Engine`."""
        x, k = self._state(), self.normal.weights * self.normal.p[:, Parameter.KN]
        count, rows = len(self.problems), max(int((s >= 0).sum()) for s in save)
        kept = SpringRows(
            *(np.zeros((count, rows, self.modes.size)) for _ in range(3)),
            *(np.zeros((count, rows, len(k))) for _ in range(3)),
        )
        energies = np.zeros((count, len(save[0]), N_ENERGIES))
        ends = Ends(np.zeros(count, np.int64), np.zeros(count, np.int64), np.zeros(count))
        whole = self._loads.factors(factors)
        march_springs(
            self._modal, self._step, k, x, whole, np.stack(save), kept, energies, ends
        )  # fmt: skip
        outcomes: list[Outcome] = []
        instants: list[Instants] = []
        for j, motion in enumerate(self.motions):
            history[j][:] = energies[j]
            past = motion.state.copy()
            self._put_back(j, motion, x)
            chosen = save[j] >= 0
            z = (kept.u[j], kept.v[j], kept.a[j])
            found = KeptInstants(
                self.problems[j], self.modes, self.joints, z, kept.delta[j], kept.f[j],
                kept.xi[j], factors[j][1:][chosen], past,
            )  # fmt: skip
            instants.append(partial(_instant, found, times))
            outcomes.append((int(ends.steps[j]), int(ends.turns[j]), float(ends.residual[j])))
        return outcomes, instants

    def _state(self) -> SpringMotions:
        if self._z is None:
            z = [self.modes.coordinates(np.stack([m.u, m.v, m.a], axis=1)).T for m in self.motions]
            self._z = np.ascontiguousarray(np.stack(z, axis=1))
        w, t, xi, energies = (
            np.stack(parts)
            for parts in zip(
                *(
                    (m.w[:, -1], m.t[:, -1], m.state[:, Variable.XI], m.energies)
                    for m in self.motions
                ),
                strict=True,
            )
        )
        u, v, a = self._z
        return SpringMotions(u, v, a, w, t * self.normal.weights, xi, energies)

    def _put_back(self, j: int, motion: Motion, x: SpringMotions) -> None:
        """The motion's own arrays after the steps."""
        X, joints = self.modes.X, self.joints
        motion.u[:], motion.v[:], motion.a[:] = X @ x.u[j], X @ x.v[j], X @ x.a[j]
        motion.delta[:] = self.modes.J @ x.u[j]
        d = joints.B.shape[1]
        jumps = motion.delta.reshape(-1, d)[joints.pairs[:, 0]]
        motion.w[:] = np.einsum("pij,pj->pi", joints.B, jumps)
        motion.w[:, -1], motion.t[:, :-1] = x.delta[j], 0.0
        motion.t[:, -1] = x.f[j] / joints.weights
        motion.state[:, Variable.XI], motion.energies[:] = x.xi[j], x.energies[j]
        interface_forces(joints, motion.t, motion.f)


def _instant(kept: KeptInstants, times: FloatArray, row: int, step: int) -> Snapshot:
    return SpringInstant(kept, row, step, float(times[step]))


def springs_together(
    problems: Sequence[Problem], motions: Sequence[Motion], effective: Effective
) -> SpringsTogether | None:
    """Problems of one model on springs that only push, at least two; None if they are not that."""
    modes = modes_of(problems[0], effective)
    if modes is None or any(not _still(p) for p in problems):
        return None
    joints = joints_of(problems[0])
    normal, J = shearless(joints, modes)
    if normal is None or len(joints.weights) < 2:
        return None  # a single spring has a loop of its own, that no other can be faster than
    if not all(only_pushes(normal, m.state) for m in motions):
        return None
    return SpringsTogether(problems, motions, effective, modes, normal, J)


def _still(problem: Problem) -> bool:
    """Whether no support moves (the rest is shared)."""
    still = not problem.loading.imposed.any()
    return still and not np.any(problem.constraints.C @ problem.u)
