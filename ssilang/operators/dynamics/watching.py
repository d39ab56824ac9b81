"""What is watched during a motion beside what is kept: largest values, bodies that leave."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.mesh.mesh import Point
from ssilang.language.values import ListReel, Mot, Table

if TYPE_CHECKING:
    from ssilang.kernel.interface.interface import Interface
    from ssilang.kernel.stepping.problem.problem import Problem
    from ssilang.kernel.stepping.snapshot import Snapshot

SAMPLES = 24
"""Instants looked at to see whether all joints have opened for good."""

FOR_GOOD = 4
"""Samples in a row, at the end, in which all joints are open and open further."""

FASTER = 0.1
"""Part of the way since they opened that their acceleration makes, 1 from rest."""


TOGETHER = 100_000
"""Values of displacements that are compared at a time."""


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
    waiting: list[Snapshot] = field(default_factory=list)

    @property
    def wanted(self) -> NDArray[np.bool_]:
        """All times."""
        return np.ones(len(self.problem.times), bool)

    def receive(self, snapshot: Snapshot) -> None:
        """Compare one instant, with those that came before it."""
        self.waiting.append(snapshot)
        if len(self.waiting) * max(len(snapshot.u), 1) >= TOGETHER:
            self.close()

    def close(self) -> None:
        """Compare the instants that wait."""
        rows, self.waiting = self.waiting, []
        if not rows:
            return
        numbering, times = rows[0].problem.numbering, [s.time for s in rows]
        u = np.stack([s.u for s in rows])
        forces = np.stack([s.support_forces for s in rows])
        for name, dual in zip(numbering.unknowns, numbering.duals, strict=True):
            mine = numbering.where(name)
            self._take("DEPL", name, times, u[:, mine], mine)
            self._take("REACTIONS", dual, times, forces[:, mine], mine)
        if rows[0].problem.interface is not None:
            w, t = np.stack([s.w for s in rows]), np.stack([s.t for s in rows])
            points = np.arange(w.shape[1])
            shear = np.linalg.norm(t[..., :-1], axis=-1)
            self._take("OUVERTURE", "", times, np.maximum(w[..., -1], 0.0), points)
            self._take("COMPRESSION", "", times, np.minimum(t[..., -1], 0.0), points)
            self._take("CISAILLEMENT", "", times, shear, points)

    def _take(
        self, kind: str, name: str, times: list[float], values: FloatArray, places: IntArray
    ) -> None:
        """Compare values (n_rows, n) at some unknowns or joint points."""
        if not values.size:
            return
        row, column = np.unravel_index(int(np.abs(values).argmax()), values.shape)
        found, before = float(values[row, column]), self.peaks.get((kind, name))
        if before is None or abs(found) > abs(before.value):
            self.peaks[kind, name] = Peak(found, times[int(row)], int(places[column]))

    def held(self) -> list[Any]:
        """What a checkpoint keeps."""
        self.close()
        return [[*key, p.value, p.time, p.place] for key, p in self.peaks.items()]

    def hold(self, kept: list[Any]) -> None:
        """Go on from a checkpoint."""
        self.peaks = {(kind, name): Peak(*peak) for kind, name, *peak in kept}

    def table(self) -> Table:
        """VALEUR, TEMPS and where, by quantity and, at nodes, by component."""
        made, inner = Table(), dict[str, Table]()
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
            if kind not in inner:
                inner[kind] = Table()
                made.set(Mot(kind), inner[kind])
            inner[kind].set(Mot(name), entry)
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

    def held(self) -> list[Any]:
        """What a checkpoint keeps."""
        return [list(pair) for pair in self.seen]

    def hold(self, kept: list[Any]) -> None:
        """Go on from a checkpoint."""
        self.seen = [(time, least) for time, least in kept]

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
