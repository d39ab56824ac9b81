"""Problems on springs that only push, set up for `run_springs_batch`; instants made if asked."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.laws.columns import Parameter, Variable
from ssilang.kernel.interface.response import Joints, interface_forces
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.problem.sharing import LoadBasis
from ssilang.kernel.stepping.rests.dense.arrays import joints_of
from ssilang.kernel.stepping.rests.modal.modes import (
    Modes,
    local_jumps,
    modal_of,
    modes_of,
    only_pushes,
    shearless,
    spring_rows,
)
from ssilang.kernel.stepping.rests.modal.springs import springs_of
from ssilang.kernel.stepping.rests.modal.springs_batch import batch_of, run_springs_batch
from ssilang.kernel.stepping.snapshot import Instants, Snapshot
from ssilang.kernel.stepping.state import (
    N_ENERGIES,
    Motion,
    Outcome,
    Recorder,
    Tap,
    ends_of,
    part_of,
    recorder_of,
    stacked,
)
from ssilang.kernel.stepping.track import JointRows, Matrix, Rows, View

KEPT = ("u", "v", "a", "f", "w", "state")


class SpringsBatch:
    """Steps of one dt of problems that share a model; see `springs_batch`."""

    name = "compiled"

    def __init__(
        self, problems: Sequence[Problem], motions: Sequence[Motion], effective: Effective,
        modes: Modes, normal: Joints, J: FloatArray,
    ) -> None:  # fmt: skip
        self.problems, self.motions, self.modes, self.normal = problems, motions, modes, normal
        self.solver = effective.inverse.factor.name
        self.joints = joints_of(problems[0])
        self._loads = LoadBasis([p.loading.forces.T @ modes.X for p in problems])
        n = newmark_of(problems[0].scheme, effective.dt)
        self._modal, self._step = modal_of(modes, J, self._loads.forces, n)
        k = normal.weights * normal.p[:, Parameter.KN]
        self._batch = batch_of(springs_of(self._step, k), len(problems), modes.size)
        self._z: FloatArray | None = None  # (3, m, r)

    def run(
        self, factors: list[FloatArray], rows: list[IntArray], history: list[FloatArray],
        times: FloatArray, taps: list[Tap],
    ) -> tuple[list[Outcome], list[Instants]]:  # fmt: skip
        """Steps of all problems; see `run_many.Engine`."""
        x, count, steps = self._state(), len(self.problems), len(rows[0])
        fullest = max(rows, key=lambda row: int((row >= 0).sum()))
        room = recorder_of(part_of(x, 0), fullest, np.zeros((steps, N_ENERGIES)), KEPT)
        kept = stacked([room] * count)._replace(row=np.stack(rows), tap=stacked(taps))
        whole = self._loads.factors(factors)
        ends = ends_of(count)
        run_springs_batch(self._modal, self._step, self._batch, x, whole, kept, ends)
        outcomes: list[Outcome] = []
        instants: list[Instants] = []
        for j, motion in enumerate(self.motions):
            history[j][:] = kept.energies[j]
            for own, array in zip(taps[j], kept.tap, strict=True):
                own[...] = array[j]
            self._put_back(j, motion, x)
            instants.append(partial(self._instant, j, part_of(kept, j), factors[j]))
            outcomes.append((int(ends.steps[j]), int(ends.turns[j]), float(ends.residual[j])))
        return outcomes, instants

    def view(self, unknowns: IntArray) -> View:
        """How unknowns and joints follow from the modes."""
        r, q = self.modes.size, len(self.normal.weights)
        shapes: dict[str, tuple[int, ...]] = dict.fromkeys("uva", (r,))
        shapes |= {"f": (q,), "w": (q, 1), "state": (q, 1)}
        return View(np.arange(r), shapes, Matrix(self.modes.X[unknowns]), self._joint_rows)

    def _joint_rows(self, tap: Tap) -> JointRows:
        return spring_rows(self.joints, self.modes, tap)

    def _instant(
        self, j: int, kept: Recorder, factors: FloatArray, row: int, step: int
    ) -> Snapshot:
        """A kept instant of problem j; the batch has room for the fullest of its motions."""
        p = self.problems[j]
        every = np.arange(p.numbering.size)
        view, at = self.view(every), np.array([row])
        tap = view.tap(np.zeros(1, np.int64))
        for name in view.shapes:
            getattr(tap, name)[:] = getattr(kept, name)[at]
        load = factors[1:][np.flatnonzero(kept.row == row)]
        return Rows(p, np.array([step]), every, view, tap, load).snapshot(0)

    def _state(self) -> Motion:
        if self._z is None:
            z = [self.modes.coordinates(np.stack([m.u, m.v, m.a], axis=1)).T for m in self.motions]
            self._z = np.ascontiguousarray(np.stack(z, axis=1))
        weights, none = self.normal.weights, np.zeros((len(self.motions), 0))
        w, f, xi, energies = (
            np.stack(parts)
            for parts in zip(
                *(
                    (
                        m.w[:, -1:],
                        weights * m.t[:, -1],
                        m.state[:, [Variable.XI]],
                        m.energies,
                    )
                    for m in self.motions
                ),
                strict=True,
            )
        )
        u, v, a = self._z
        t = np.zeros((len(self.motions), 0, 1))
        return Motion(u, v, a, none, f, w, t, xi, none, energies, none)

    def _put_back(self, j: int, motion: Motion, x: Motion) -> None:
        """The motion's own arrays after the steps."""
        X, joints = self.modes.X, self.joints
        motion.u[:], motion.v[:], motion.a[:] = X @ x.u[j], X @ x.v[j], X @ x.a[j]
        motion.delta[:] = self.modes.J @ x.u[j]
        motion.w[:] = local_jumps(joints, motion.delta[None])[0]
        motion.w[:, -1], motion.t[:, :-1] = x.w[j, :, 0], 0.0
        motion.t[:, -1] = x.f[j] / joints.weights
        motion.state[:, Variable.XI], motion.energies[:] = x.state[j, :, 0], x.energies[j]
        interface_forces(joints, motion.t, motion.f)


def springs_batch(
    problems: Sequence[Problem], motions: Sequence[Motion], effective: Effective
) -> SpringsBatch | None:
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
    return SpringsBatch(problems, motions, effective, modes, normal, J)


def _still(problem: Problem) -> bool:
    """Whether no support moves (the rest is shared)."""
    still = not problem.loading.imposed.any()
    return still and not np.any(problem.constraints.C @ problem.u)
