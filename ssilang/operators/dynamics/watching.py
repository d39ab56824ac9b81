"""What is watched during a motion beside what is kept: largest values, bodies that leave."""

from typing import ClassVar

from ssilang.kernel.interface.interface import Interface, is_macro
from ssilang.kernel.stepping.extremes import Extremes
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.kernel.stepping.track import Rows, Track
from ssilang.language.values import promises
from ssilang.operators.prelude import *

SAMPLES = 24
"""Instants looked at to see whether all joints have opened for good."""

FOR_GOOD = 4
"""Samples in a row, at the end, in which all joints are open and open further."""

FASTER = 0.1
"""Part of the way since they opened that their acceleration makes, 1 from rest."""


KINDS = ("DEPL", "REACTIONS", "OUVERTURE", "COMPRESSION", "CISAILLEMENT")


def even(count: int, most: int) -> BoolArray:
    """Which of so many instants are taken: the first, the last, and evenly between."""
    wanted = np.zeros(count, bool)
    wanted[np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))] = True
    return wanted


def extremes_table(extremes: Extremes) -> Table:
    """VALEUR, TEMPS and where, by quantity and, at nodes, by component."""
    problem, made = extremes.problem, Table()
    for (kind, name), peak in extremes.found().items():
        entry = Table.of({"VALEUR": peak.value, "TEMPS": float(problem.times[peak.step])})
        if not name:
            x = problem.numbering.table.shown(joint_places(problem.interface)[peak.place])
            entry.set(Mot("COORDONNEES"), ListReel(x))
            made.set(Mot(kind), entry)
            continue
        node = problem.numbering.nodes[peak.place]
        entry.set(Mot("POINT"), Point(problem.numbering.table, int(node)))
        made.inner(kind).set(Mot(name), entry)
    return made


def extremes_later(problem: Problem, again: Callable[[Extremes], object]) -> LazyTable:
    """The same, found by stepping again when someone asks."""
    found: list[Table] = []

    def find(kind: str) -> object:
        if not found:
            extremes = Extremes(problem=problem)
            again(extremes)
            found.append(extremes_table(extremes))
        return found[0].get(kind)

    joints = problem.interface
    known = 2 if not joints else None if len(joints.pressing) else 3
    return LazyTable(find, promises(*KINDS[:known]))


def joint_places(joints: Interface) -> FloatArray:
    """Where the joints' points are, half-way between the sides, (n_points, 3)."""
    found = []
    for zone in joints.joints:
        nodes = zone.zone.cells.nodes
        x = nodes.coordinates
        middle = (x[nodes.resolve(zone.upper)] + x[nodes.resolve(zone.lower)]) / 2.0
        found.append(np.einsum("gm,nmx->ngx", zone.shape, middle).reshape(-1, 3))
    return np.concatenate(found)


@dataclass(eq=False)
class UpliftWatch(Track):
    """Sees whether all joints have opened for good: weights with the wrong sign, most often.

    Attributes
    ----------
    seen : list of (float, float)
        Times and least openings since all joints were seen open.
    """

    seen: list[tuple[float, float]] = field(default_factory=list, init=False)
    keeps: ClassVar[bool] = False

    @classmethod
    def of(cls, problem: Problem) -> "UpliftWatch | None":
        """The watch of a problem with joints that can open; None without."""
        joints = problem.interface
        if not joints or any(is_macro(j.zone) for j in joints.joints):
            return None
        return cls(even(len(problem.times), SAMPLES), np.zeros(0, np.int64))

    def receive(self, snapshot: Snapshot) -> None:
        """Look at one whole instant."""
        self._look(snapshot.time, snapshot.w, snapshot.t)

    def take(self, rows: Rows) -> None:
        """Look at instants."""
        for time, w, t in zip(rows.times.tolist(), rows.joints.w, rows.joints.t, strict=True):
            self._look(time, w, t)

    def _look(self, time: float, w: FloatArray, t: FloatArray) -> None:
        least = float(w[:, -1].min())
        if least <= 0.0 or t.any() or (self.seen and least < self.seen[-1][1]):
            self.seen.clear()
            return
        self.seen.append((time, least))

    def content(self) -> list[Any]:
        """What a checkpoint keeps."""
        return [list(pair) for pair in self.seen]

    def restore(self, kept: list[Any]) -> None:
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
