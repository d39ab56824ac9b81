"""One saved instant of a motion, and who receives it."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface.interface import interface_field, plastic_jumps, state_field
from ssilang.kernel.matrices.assembly import vector_to_field
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import WHOLE, Motion, Recorder


@dataclass(frozen=True, eq=False)
class Snapshot:
    """State at one instant."""

    problem: Problem
    step: int  # 0 for the initial state
    time: float
    u: FloatArray  # (n,) displacement
    v: FloatArray  # (n,) velocity
    a: FloatArray  # (n,) acceleration
    reaction: FloatArray  # (n,) force that the conditions apply on the body
    w: FloatArray  # (n_points, d) jumps of the joints
    t: FloatArray  # (n_points, d) tractions
    state: FloatArray  # (n_points, N_STATE)
    contact: FloatArray  # (size,) reactions of the unilateral relations, and frictions

    @property
    def _multipliers(self) -> FloatArray:
        """Reactions of the equalities, D^T of which is what they push by."""
        rest = self.reaction - self.problem.contact.pushing.T @ self.contact
        return self.problem.constraints.multipliers(rest)

    @property
    def displacement(self) -> NodeField:
        """Displacement, with the multipliers LX of the conditions."""
        contact = self.problem.contact
        nodes = np.concatenate([self.problem.multipliers, contact.multipliers])
        pair = nodes, np.concatenate([-self._multipliers, contact.lagrange(self.contact)])
        return vector_to_field(self.u, self.problem.numbering, multipliers=pair)

    @property
    def velocity(self) -> NodeField:
        """Velocity, by the displacements' names."""
        return vector_to_field(self.v, self.problem.numbering)

    @property
    def acceleration(self) -> NodeField:
        """Acceleration, by the displacements' names."""
        return vector_to_field(self.a, self.problem.numbering)

    @property
    def support_forces(self) -> FloatArray:
        """Forces (n,) of the conditions on the body."""
        pushed = self.problem.contact.pushing.T @ self.contact
        return np.asarray(self.problem.constraints.D.T @ self._multipliers + pushed)

    @property
    def reactions(self) -> NodeField:
        """Forces of the conditions on the body, by dual names."""
        return vector_to_field(self.support_forces, self.problem.numbering, dual=True)

    @property
    def jumps(self) -> CellField:
        """Jumps at the joints' points."""
        return interface_field(self.problem.interface, self.w, "jump")

    @property
    def tractions(self) -> CellField:
        """Tractions at the joints' points."""
        return interface_field(self.problem.interface, self.t, "traction")

    @property
    def plastic_strains(self) -> CellField:
        """Plastic jumps of the joints."""
        joints = self.problem.interface
        return interface_field(joints, plastic_jumps(joints, self.w, self.t), "plastic jump")

    @property
    def variables(self) -> CellField:
        """Internal variables of the joints."""
        return state_field(self.problem.interface, self.state, self.w, self.t)


def snapshot_of(problem: Problem, motion: Motion, step: int) -> Snapshot:
    """A copy of the state at a step."""
    parts = (getattr(motion, name).copy() for name in WHOLE)
    return Snapshot(problem, step, float(problem.times[step]), *parts)


def kept_instant(problem: Problem, recorder: Recorder, row: int, step: int) -> Snapshot:
    """The instant in a row of what was kept."""
    parts = (getattr(recorder, name)[row] for name in WHOLE)
    return Snapshot(problem, step, float(problem.times[step]), *parts)


class Observer(Protocol):
    """Receives the instants it wants, in order."""

    @property
    def wanted(self) -> NDArray[np.bool_]:
        """Which times, shape (n_times,)."""

    def receive(self, snapshot: Snapshot) -> None:
        """Take an instant."""

    def close(self) -> None:
        """End of the calculation, also when it failed."""


class Receiver:
    """An observer that does nothing at the end: what it fills is whole after each instant."""

    def close(self) -> None:
        """Nothing."""
