"""The largest values of a motion over all its steps.

Loops on the problem's own unknowns, or on most of them, compare displacements and joints as they
step; what conditions hold, and push by, is found of the rows at their unknowns. Of other loops all
unknowns come as rows.
"""

from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.stepping.keeping import leaves, put_back
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.kernel.stepping.state import Peaks, peaks_of
from ssilang.kernel.stepping.track import Rows, Track, balance_of, rows_of_snapshot

JOINTS = ("OUVERTURE", "COMPRESSION", "CISAILLEMENT")


@dataclass(frozen=True)
class Peak:
    """The value that is largest without its sign, its step, and its unknown or joint point."""

    value: float
    step: int
    place: int


@dataclass(eq=False)
class Extremes(Track):
    """Largest displacements, reactions, openings and joint forces.

    Attributes
    ----------
    asked : bool
        Whether they are found whatever the loop; otherwise where that costs next to nothing.
    inside : bool
        Whether the loop itself compares what is not held.
    held : array (h,)
        Unknowns of the conditions.
    peaks : Peaks
        Of all displacements and joints.
    forces, forces_when : arrays (n,)
        Largest forces of the conditions, and their steps.
    """

    wanted: BoolArray = field(init=False)
    unknowns: IntArray = field(init=False)
    problem: Problem = field(kw_only=True)
    asked: bool = field(kw_only=True, default=True)
    inside: bool = field(init=False, default=False)
    keeps: ClassVar[bool] = False
    peaks: Peaks = field(init=False)

    def __post_init__(self) -> None:
        self.settle(False)

    @property
    def known(self) -> bool:
        """Whether the loop that was taken gives them."""
        return self.asked or self.inside

    def settle(self, inside: bool) -> None:
        """Prepare for a loop; `inside`: it compares what is not held itself."""
        p, self.inside = self.problem, inside
        self.wanted = np.full(len(p.times), self.known)
        self.peaks = peaks_of(0, 0)
        self.unknowns = np.zeros(0, np.int64)
        if not self.known:
            return
        rows = (p.constraints.C, p.constraints.D, p.contact.pushing)
        self.held = np.unique(np.concatenate([A.indices for A in rows])).astype(np.int64)
        self.balance = balance_of(p, self.held)
        self.unknowns = np.arange(p.numbering.size)
        if self.inside:
            self.unknowns = self.balance.near
        self.peaks = peaks_of(p.numbering.size, p.interface.n_points)
        self.forces, self.forces_when = np.zeros(p.numbering.size), np.zeros(p.numbering.size)

    def receive(self, snapshot: Snapshot) -> None:
        """Compare one whole instant."""
        n = self.problem.numbering.size
        self.take(rows_of_snapshot(snapshot, np.arange(n)))
        if snapshot.problem is not self.problem:  # it may have relations of its own
            step = np.array([snapshot.step])
            _compare(snapshot.support_forces[None], step, self.forces, self.forces_when)

    def take(self, rows: Rows) -> None:
        """Compare rows with what came before."""
        steps = rows.steps_taken
        if len(self.held):
            forces, when = self.forces[self.held], self.forces_when[self.held]
            _compare(rows.reactions(self.balance), steps, forces, when)
            self.forces[self.held], self.forces_when[self.held] = forces, when
        chosen = self.held if self.inside and steps[0] else rows.unknowns
        values, to = rows.values("u", np.searchsorted(rows.unknowns, chosen)), self.peaks
        u, when = to.u[chosen], to.when[chosen]
        _compare(values, steps, u, when)
        to.u[chosen], to.when[chosen] = u, when
        if not to.joints.shape[1] or (self.inside and steps[0]):
            return
        w, t = rows.joints.w, rows.joints.t
        shear = np.linalg.norm(t[..., :-1], axis=-1)
        for i, x in enumerate((w[..., -1], -t[..., -1], shear)):
            _compare(np.maximum(x, 0.0), steps, to.joints[i], to.joints_when[i])

    def content(self) -> list[Any]:
        """What a checkpoint keeps: the largest values so far."""
        return leaves((self.peaks, self.forces, self.forces_when)) if self.known else []

    def restore(self, kept: list[Any]) -> None:
        """Go on from a checkpoint; the loop shares the peaks."""
        if self.known:
            put_back((self.peaks, self.forces, self.forces_when), kept)

    def found(self) -> dict[tuple[str, str], Peak]:
        """Of each kind (DEPL, REACTIONS: and component) the largest of all."""
        numbering, to = self.problem.numbering, self.peaks
        made: dict[tuple[str, str], Peak] = {}
        for code, (name, dual) in enumerate(zip(numbering.unknowns, numbering.duals, strict=True)):
            mine = np.flatnonzero(numbering.codes == code)
            made["DEPL", name] = _largest(to.u, to.when, mine)
            made["REACTIONS", dual] = _largest(self.forces, self.forces_when, mine)
        joints = self.problem.interface
        for i, name in enumerate(JOINTS):
            if not to.joints.shape[1]:
                break
            points = np.arange(joints.n_shown) if name == "OUVERTURE" else joints.pressing
            if len(points):
                peak = _largest(to.joints[i], to.joints_when[i], points)
                sign = -1.0 if name == "COMPRESSION" else 1.0
                made[name, ""] = Peak(sign * peak.value, peak.step, peak.place)
        return made


def _largest(value: FloatArray, when: FloatArray, mine: IntArray) -> Peak:
    """The largest of some values."""
    at = int(mine[np.abs(value[mine]).argmax()])
    return Peak(float(value[at]), int(when[at]), at)


def _compare(values: FloatArray, steps: IntArray, best: FloatArray, when: FloatArray) -> None:
    """Values (k, m) of some steps with the largest (m,) before them, changed in place."""
    if not values.size:
        return
    rows = np.abs(values).argmax(axis=0)
    found = values[rows, np.arange(values.shape[1])]
    larger = np.abs(found) > np.abs(best)
    best[larger], when[larger] = found[larger], steps[rows[larger]]
