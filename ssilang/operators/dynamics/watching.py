"""What is watched during a motion beside what is kept: largest values, bodies that leave."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import BoolArray, FloatArray
from ssilang.kernel.mesh.mesh import Point
from ssilang.language.values import ListReel, Mot, Table

if TYPE_CHECKING:
    from ssilang.kernel.interface.interface import Interface
    from ssilang.kernel.stepping.problem.problem import Problem
    from ssilang.kernel.stepping.snapshot import Snapshot

SAMPLES = 64
"""Instants looked at to see whether all joints have opened for good."""

FOR_GOOD = 5
"""Samples in a row, at the end, in which all joints are open and open further."""

FASTER = 0.1
"""Part of the way since they opened that their acceleration makes, 1 from rest."""


@dataclass(frozen=True)
class Peak:
    """The value that is largest without its sign, when, and at which unknown or joint point."""

    value: float
    time: float
    place: int


@dataclass
class ExtremesObserver:
    """Looks at every step for the largest displacement, reaction, opening and joint forces."""

    problem: Problem
    peaks: dict[tuple[str, str], Peak] = field(default_factory=dict)

    @property
    def wanted(self) -> NDArray[np.bool_]:
        """All times."""
        return np.ones(len(self.problem.times), bool)

    def receive(self, snapshot: Snapshot) -> None:
        """Compare one instant."""
        numbering = snapshot.problem.numbering
        forces = snapshot.support_forces
        for name, dual in zip(numbering.unknowns, numbering.duals, strict=True):
            mine = numbering.where(name)
            self._take("DEPL", name, snapshot.time, snapshot.u, mine)
            self._take("REACTIONS", dual, snapshot.time, forces, mine)
        if snapshot.problem.interface is not None:
            points = np.arange(len(snapshot.w))
            t = snapshot.t
            shear = np.linalg.norm(t[:, :-1], axis=1)
            self._take("OUVERTURE", "", snapshot.time, np.maximum(snapshot.w[:, -1], 0.0), points)
            self._take("COMPRESSION", "", snapshot.time, np.minimum(t[:, -1], 0.0), points)
            self._take("CISAILLEMENT", "", snapshot.time, shear, points)

    def close(self) -> None:
        """Nothing is open."""

    def _take(self, kind: str, name: str, time: float, values: FloatArray, mine: Any) -> None:
        if not len(mine):
            return
        place = int(mine[np.argmax(np.abs(values[mine]))])
        before = self.peaks.get((kind, name))
        if before is None or abs(values[place]) > abs(before.value):
            self.peaks[kind, name] = Peak(float(values[place]), time, place)

    def table(self) -> Table:
        """VALEUR, TEMPS and where, by quantity and, at nodes, by component."""
        made = Table()
        for (kind, name), peak in self.peaks.items():
            entry = Table()
            entry.set(Mot("VALEUR"), peak.value)
            entry.set(Mot("TEMPS"), peak.time)
            if not name:
                entry.set(Mot("COORDONNEES"), ListReel(self._at_joint(peak.place)))
                made.set(Mot(kind), entry)
                continue
            table, node = self.problem.numbering.table, self.problem.numbering.nodes[peak.place]
            entry.set(Mot("POINT"), Point(table, int(node)))
            if not made.has(kind):
                made.set(Mot(kind), Table())
            made.get(kind).set(Mot(name), entry)
        return made

    def _at_joint(self, point: int) -> FloatArray:
        joints = self.problem.interface
        assert joints is not None
        places = joint_places(joints)
        return self.problem.numbering.table.shown(places[point])


def joint_places(joints: Interface) -> FloatArray:
    """Where the joints' points are, half-way between the sides, (n_points, 3)."""
    found = []
    for zone in joints.joints:
        nodes = zone.zone.cells.nodes
        x = nodes.coordinates
        middle = (x[nodes.resolve(zone.upper)] + x[nodes.resolve(zone.lower)]) / 2.0
        found.append(np.einsum("gm,nmx->ngx", zone.shape, middle).reshape(-1, 3))
    return np.concatenate(found)


@dataclass
class UpliftWatch:
    """Sees whether all joints have opened for good: weights with the wrong sign, most often.

    Attributes
    ----------
    wanted : array (n_times,)
    """

    wanted: BoolArray
    seen: list[tuple[float, float]] = field(default_factory=list)

    @classmethod
    def of(cls, problem: Problem) -> UpliftWatch | None:
        """The watch of a problem with joints that can open; None without."""
        from ssilang.kernel.interface.interface import is_macro

        joints, n = problem.interface, len(problem.times)
        if joints is None or any(is_macro(j) for j in joints.joints):
            return None
        wanted = np.zeros(n, bool)
        wanted[np.unique(np.linspace(0, n - 1, SAMPLES).round().astype(int))] = True
        return cls(wanted)

    def receive(self, snapshot: Snapshot) -> None:
        """Look at one instant."""
        least = float(snapshot.w[:, -1].min())
        if least <= 0.0 or snapshot.t.any() or (self.seen and least < self.seen[-1][1]):
            self.seen.clear()
            return
        self.seen.append((snapshot.time, least))

    def close(self) -> None:
        """Nothing is open."""

    @property
    def since(self) -> float:
        """The first time at which all joints were seen open."""
        return self.seen[0][0]

    @property
    def opening(self) -> float:
        """The smallest opening at the end (m)."""
        return self.seen[-1][1]

    @property
    def left(self) -> bool:
        """Whether the body is driven off the ground: all joints open, and ever faster.

        A body in flight falls back, or flies on at its speed; neither is told.
        """
        if len(self.seen) < FOR_GOOD:
            return False
        t, w = np.array(self.seen).T
        bend = np.polyfit((t - t[0]) / (t[-1] - t[0]), w - w[0], 2)[0]
        return bool(bend > FASTER * (w[-1] - w[0]))
