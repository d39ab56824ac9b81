"""Loads that depend on where the bodies are, given by a function, beside the bodies' own forces.

How they change with the displacement is found by small differences: unknowns whose forces do not
meet in one row are moved together.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields.cell_field import CellFieldBlock
from ssilang.kernel.plasticity.bulk import Answer, Bulk, State
from ssilang.kernel.plasticity.points import PlasticPoints, PointState

SHIFT = 1e-6
"""Small displacement over the size of the bodies, small turn, small time over that of the run."""
SINGLY = 30
"""Loaded unknowns up to which each is moved alone, whatever meets."""


@dataclass(frozen=True, eq=False)
class Added:
    """What acts at one instant: forces (n,), and a matrix for the iterations that is given."""

    force: FloatArray
    stiffness: sp.csr_array | None = None


LoadLaw = Callable[[float, FloatArray], Added]
"""What acts at a time where the displacements are u (n,)."""


@dataclass(frozen=True, eq=False)
class _Loaded:
    """State: that of the bodies, displacement (n,), load (n,)."""

    bodies: State
    u: FloatArray
    force: FloatArray


@dataclass(frozen=True, eq=False)
class LoadedBulk(Bulk):
    """Bodies under a load that follows them.

    Attributes
    ----------
    shifts : array (n,)
        Small difference of each unknown.
    instant : float
        Small difference of time.
    pattern : csr array (n, n)
        Where unknowns meet.
    said : str
        What is said of the load.
    seen : set of int
        Unknowns that have been loaded so far.
    """

    bodies: Bulk = field(default_factory=lambda: Bulk((), (), 0))
    law: LoadLaw = field(default=lambda time, u: Added(np.zeros_like(u)))
    shifts: FloatArray = field(default_factory=lambda: np.zeros(0))
    instant: float = SHIFT
    pattern: sp.csr_array | None = None
    said: str = ""
    seen: set[int] = field(default_factory=set)

    @property
    def words(self) -> str:
        """What is said of them."""
        return ", ".join(w for w in (self.bodies.words, self.said) if w)

    @property
    def searched(self) -> bool:
        """As without the load."""
        return self.bodies.searched

    def begin(self, bodies: State, u: FloatArray, time: float) -> State:
        """The state at the start."""
        return cast(State, _Loaded(bodies, u.copy(), self.law(time, u).force))

    def points_of(self, state: State) -> list[tuple[PlasticPoints, PointState]]:
        """Those of the bodies."""
        return self.bodies.points_of(_of(state).bodies)

    def respond(self, state: State, du: FloatArray, time: float, whole: bool = False) -> Answer:
        """Forces and tangent of bodies and load after a step."""
        old = _of(state)
        u = old.u + du
        inner = self.bodies.respond(old.bodies, du, time)
        added = self.law(time, u)
        tangent = inner.tangent
        follows = self._follows(time, u, added.force)
        if follows is not None:
            tangent = sp.csr_array(tangent - follows)
        elif added.stiffness is not None:
            tangent = sp.csr_array(tangent + added.stiffness)
        later = self.law(time + self.instant, u).force
        rate = (added.force - later) / self.instant
        after = cast(State, _Loaded(inner.state, u, added.force))
        return Answer(inner.force - added.force, lambda: tangent, after, inner.work, rate)

    def _follows(self, time: float, u: FloatArray, force: FloatArray) -> sp.csr_array | None:
        """Change of the load with the displacement; None where there is none."""
        self.seen.update(np.flatnonzero(force).tolist())
        near = self._near(np.array(sorted(self.seen), dtype=np.int64))
        if not len(near):
            return None
        sign = np.where(np.arange(len(near)) % 3 == 1, -1.0, 1.0)
        together = u.copy()
        together[near] += sign * self.shifts[near]
        if np.array_equal(self.law(time, together).force, force):
            return None
        rows: list[IntArray] = []
        columns: list[IntArray] = []
        values: list[FloatArray] = []
        for group, owner in self._groups(near):
            moved = u.copy()
            moved[group] += self.shifts[group]
            change = self.law(time, moved).force - force
            row = np.flatnonzero((change != 0.0) & (owner >= 0))
            place = owner[row]
            rows.append(row)
            columns.append(group[place])
            values.append(change[row] / self.shifts[group[place]])
        joined = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
        return sp.csr_array(sp.coo_array(joined, shape=(self.size, self.size)))

    def _near(self, loaded: IntArray) -> IntArray:
        """Unknowns that meet the loaded ones."""
        if self.pattern is None or not len(loaded):
            return loaded
        return np.union1d(loaded, np.unique(self.pattern[loaded].indices))

    def _groups(self, near: IntArray) -> list[tuple[IntArray, IntArray]]:
        """Unknowns moved together, and which of them a row (size,) belongs to, -1 for none."""
        if self.pattern is None or len(near) <= SINGLY:
            alone = np.zeros(self.size, dtype=np.int64)
            return [(near[i : i + 1], alone) for i in range(len(near))]
        meets = sp.csr_array(self.pattern[near])
        neighbours = sp.csr_array(meets @ meets.T)
        colour = np.full(len(near), -1)
        for i in range(len(near)):
            taken = set(colour[neighbours.indices[neighbours.indptr[i] : neighbours.indptr[i + 1]]])
            colour[i] = next(c for c in range(len(near)) if c not in taken)
        groups = []
        for c in range(int(colour.max()) + 1):
            chosen: NDArray[np.int64] = np.flatnonzero(colour == c)
            own = sp.coo_array(meets[chosen])
            owner = np.full(self.size, -1, dtype=np.int64)
            owner[own.col] = own.row
            groups.append((near[chosen], owner))
        return groups

    def force(self, state: State) -> FloatArray:
        """Internal forces less the load (n,)."""
        loaded = _of(state)
        return self.bodies.force(loaded.bodies) - loaded.force

    def pushed(self, state: State) -> FloatArray:
        """The load (n,)."""
        return _of(state).force

    def stored(self, state: State) -> float:
        """Elastic energy of the bodies."""
        return self.bodies.stored(_of(state).bodies)

    def stresses(self, state: State) -> list[CellFieldBlock]:
        """Stresses of the bodies."""
        return self.bodies.stresses(_of(state).bodies)


def _of(state: State) -> _Loaded:
    return cast(Any, state)  # type: ignore[no-any-return]


def loaded_bulk(
    bodies: Bulk,
    law: LoadLaw,
    shifts: FloatArray,
    instant: float,
    pattern: sp.csr_array,
    said: str,
) -> LoadedBulk:
    """Bodies and the load that a function gives them."""
    return LoadedBulk((), (), bodies.size, {}, bodies, law, shifts, instant, pattern, said)
