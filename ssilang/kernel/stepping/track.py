"""Histories: what loops keep of a few unknowns at many steps, as rows that nobody copies.

A loop keeps entries of its own coordinates (`Tap`); a `View` gives the problem's unknowns of them,
when someone asks. Whole fields are never made on the way.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, reduce
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.problem.problem import Problem, joint_forces
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.kernel.stepping.state import Motion, Peaks, Room, Tap, peaks_of, tap_of

FIELDS = ("u", "v", "a")
MOST_COORDINATES = 50_000_000
"""Numbers in a loop's coordinates that a track holds; beyond, it holds its unknowns if these are
fewer."""


def expand(X: FloatArray, z: FloatArray) -> FloatArray:
    """`z X^T` (k, p) of rows z (k, r) and X (p, r), each number by itself.

    A product of matrices sums in an order that depends on how many rows there are; here a few rows
    of X give to the last bit what all of them give.
    """
    return np.vecdot(np.ascontiguousarray(z)[:, None], np.ascontiguousarray(X)[None])


class Map(Protocol):
    """Unknowns (k, p) from rows (k, c) of what was kept."""

    @property
    def shape(self) -> tuple[int, int]:
        """p and c."""

    def __getitem__(self, places: IntArray | slice) -> Map:
        """That of some of the unknowns."""

    def __call__(self, z: FloatArray) -> FloatArray:
        """The unknowns."""


@dataclass(frozen=True, eq=False)
class Matrix:
    """A map by a matrix (p, c)."""

    X: FloatArray

    @property
    def shape(self) -> tuple[int, int]:
        """p and c."""
        return self.X.shape[0], self.X.shape[1]

    def __getitem__(self, places: IntArray | slice) -> Matrix:
        return Matrix(self.X[places])

    def __call__(self, z: FloatArray) -> FloatArray:
        return expand(self.X, z)


class JointRows(NamedTuple):
    """Jumps and tractions (k, n_points, d) and states (k, n_points, N_STATE) of joints."""

    w: FloatArray
    t: FloatArray
    state: FloatArray


@dataclass(frozen=True, eq=False)
class View:
    """How some unknowns of a problem, and its joints, follow from what a loop keeps."""

    at: IntArray  # (c,) entries of the loop's fields that it keeps
    shapes: dict[str, tuple[int, ...]]  # of the parts of the state that it keeps, by name
    map: Map | None = None  # unknowns from these entries; None: they are the unknowns
    # makes the joints' rows; None: they are kept as they are
    joints: Callable[[Tap], JointRows] | None = None

    @property
    def whole(self) -> bool:
        """Whether the loop steps the unknowns themselves: it compares their largest values too."""
        return self.map is None

    def tap(self, row: IntArray, room: Room | None = None) -> Tap:
        """Room for what is kept, not set."""
        return (room or Room(0)).tap(row, self.at, self.shapes)


def whole_view(motion: Motion | Snapshot, unknowns: IntArray, *without: str) -> View:
    """The view of arrays on the problem's own unknowns; `without`: parts that are not there."""
    shapes = dict.fromkeys((*FIELDS, "reaction"), unknowns.shape)
    shapes |= {name: getattr(motion, name).shape for name in ("w", "t", "state", "contact")}
    return View(unknowns, {k: v for k, v in shapes.items() if k not in without})


@dataclass(eq=False)
class Rows:
    """Some instants of a motion, at some unknowns."""

    problem: Problem
    steps: IntArray | slice  # (k,) or slice: places of their times, 0 for the initial state
    unknowns: IntArray  # (p,) increasing
    view: View
    tap: Tap  # what was kept of these instants, one a row
    factors: FloatArray  # (k, n_loads) of the problem's loads

    def __len__(self) -> int:
        return len(self.tap.u)

    @property
    def steps_taken(self) -> IntArray:
        """The steps (k,) themselves."""
        return np.arange(len(self.problem.times))[self.steps]

    @property
    def times(self) -> FloatArray:
        """Of the instants (k,)."""
        return self.problem.times[self.steps]

    def values(self, name: str, places: IntArray | slice = slice(None)) -> FloatArray:
        """`u`, `v`, `a` or `reaction` (k, len(places)) at places among the unknowns."""
        kept: FloatArray = getattr(self.tap, name)
        if name == "reaction" and not kept.shape[1]:
            return balance_of(self.problem, self.unknowns[places]).of(self)
        if self.view.map is None:
            return kept[:, places]
        return self.view.map[places](kept)

    @cached_property
    def joints(self) -> JointRows:
        """Of all joints."""
        if self.view.joints is not None:
            return self.view.joints(self.tap)
        return JointRows(self.tap.w, self.tap.t, self.tap.state)

    def reactions(self, balance: Balance) -> FloatArray:
        """Reactions (k, p) of some unknowns whose neighbours were kept too."""
        if self.tap.reaction.shape[1]:
            return self.values("reaction", np.searchsorted(self.unknowns, balance.at))
        return balance.of(self)

    def chosen(self, which: BoolArray, unknowns: IntArray) -> Rows:
        """Some of the instants (k,) at some of the unknowns."""
        few = self
        if not which.all():
            parts = {
                name: getattr(self.tap, name)[which]
                for name in self.view.shapes
            }  # fmt: skip
            few = replace(
                few, steps=self.steps_taken[which], factors=self.factors[which],
                tap=self.tap._replace(**parts),
            )  # fmt: skip
        if len(unknowns) == len(self.unknowns):
            return few
        places = np.searchsorted(self.unknowns, unknowns)
        if self.view.map is not None:
            view = replace(self.view, map=self.view.map[places])
            return replace(few, unknowns=unknowns, view=view)
        held: dict[str, Any] = {
            name: getattr(few.tap, name)[:, places]
            for name in (*FIELDS, "reaction") if name in self.view.shapes
        }  # fmt: skip
        return replace(few, unknowns=unknowns, tap=few.tap._replace(**held))

    def settled(self) -> Rows:
        """The same with its unknowns made, if these are fewer than what was kept for them."""
        mapped = self.view.map
        if mapped is None or mapped.shape[0] >= mapped.shape[1]:
            return self
        made: dict[str, Any] = {name: self.values(name) for name in FIELDS}
        made |= self.joints._asdict()
        shapes = {name: shape for name, shape in self.view.shapes.items() if name != "f"}
        for name in shapes:  # what was kept as it is lies in a piece of memory with all the rest
            kept = getattr(self.tap, name)
            made[name] = kept.copy() if made.get(name, kept) is kept else made[name]
        tap = tap_of(self.tap.row, self.tap.at, {})._replace(**made)
        return replace(self, tap=tap, view=View(self.view.at, shapes))

    def snapshot(self, row: int) -> Snapshot:
        """One of the instants, where all unknowns were kept."""
        one = self.chosen(np.arange(len(self)) == row, self.unknowns)
        u, v, a, reaction = (one.values(name)[0] for name in (*FIELDS, "reaction"))
        w, t, state = (x[0] for x in one.joints)
        contact = one.tap.contact[0] if len(one.tap.contact) else np.zeros(0)
        step = int(one.steps_taken[0])
        return Snapshot(
            self.problem, step, float(one.times[0]), u, v, a, reaction, w, t, state, contact
        )


@dataclass(frozen=True, eq=False)
class Balance:
    """What reactions of a few unknowns follow from: `M a + C v + K u + J^T f - F`."""

    at: IntArray  # (p,) the unknowns
    near: IntArray  # (c,) all that act on them
    M: sp.csr_array  # (p, c)
    C: sp.csr_array  # (p, c)
    K: sp.csr_array  # (p, c)

    def of(self, rows: Rows) -> FloatArray:
        """Reactions (k, p) of rows that hold what is near."""
        p = rows.problem
        columns: IntArray | slice = slice(None)
        if len(self.near) < len(rows.unknowns):
            columns = np.searchsorted(rows.unknowns, self.near)
        parts = ((self.M, "a"), (self.C, "v"), (self.K, "u"))
        forces = [A @ rows.values(name, columns).T for A, name in parts if A.nnz]
        found = -expand(p.loading.forces[self.at], rows.factors)
        for part in forces:
            found += part.T
        J = p.interface.J[:, self.at]
        return found + joint_forces(p.interface, rows.joints.t) @ J if J.nnz else found


def balance_of(problem: Problem, at: IntArray) -> Balance:
    """The balance of some unknowns."""
    rows = [A[at] for A in (problem.M, problem.C, problem.K)]
    near = np.unique(np.concatenate([at, *(A.indices for A in rows)])).astype(np.int64)
    return Balance(at, near, *(A[:, near] for A in rows))


def rows_of_snapshot(snapshot: Snapshot, unknowns: IntArray) -> Rows:
    """One instant as rows."""
    s, view = snapshot, whole_view(snapshot, unknowns)
    tap = view.tap(np.zeros(1, np.int64))
    for name in (*FIELDS, "reaction"):
        getattr(tap, name)[0] = getattr(s, name)[unknowns]
    for name in ("w", "t", "state", "contact"):
        getattr(tap, name)[0] = getattr(s, name)
    factors = s.problem.loading.at(np.array([s.time]))
    return Rows(s.problem, np.array([s.step]), unknowns, view, tap, factors)


def rows_of_tap(
    problem: Problem, unknowns: IntArray, view: View, tap: Tap, factors: FloatArray, first: int,
    done: int,
) -> Rows | None:  # fmt: skip
    """What was kept of the steps after `first`, of which some were done; None for nothing.

    `factors` (n_steps + 1, n_loads) are those from `first` on.
    """
    if not len(tap.u) or not done:
        return None
    if len(tap.u) == done and tap.row[done - 1] == done - 1:  # all of them
        every = slice(first + 1, first + 1 + done)
        return Rows(problem, every, unknowns, view, tap, factors[1:])
    kept = np.flatnonzero(tap.row[:done] >= 0)
    if not len(kept):
        return None
    if len(kept) < len(tap.u):
        parts = {name: getattr(tap, name)[: len(kept)] for name in view.shapes}
        tap = tap._replace(**parts)
    return Rows(problem, first + 1 + kept, unknowns, view, tap, factors[kept + 1])


@dataclass(eq=False)
class Track:
    """An observer that takes rows: some unknowns, and the joints, at the times it wants."""

    wanted: BoolArray  # (n_times,)
    unknowns: IntArray  # (p,) increasing
    pieces: list[Rows] = field(default_factory=list)  # what came, in order of time
    at_end: Callable[[], None] | None = None  # called when the run has ended
    keeps: ClassVar[bool] = True

    @cached_property
    def _count(self) -> int:
        """How many instants are wanted."""
        return int(np.count_nonzero(self.wanted))

    def receive(self, snapshot: Snapshot) -> None:
        """Take one whole instant."""
        self.take(rows_of_snapshot(snapshot, self.unknowns))

    def take(self, rows: Rows) -> None:
        """Take instants at the unknowns."""
        mapped = rows.view.map
        if mapped is not None and 3 * mapped.shape[1] * self._count > MOST_COORDINATES:
            rows = rows.settled()
        self.pieces.append(rows)

    def close(self) -> None:
        """The run has ended, or failed."""
        if self.at_end is not None:
            self.at_end()

    def __len__(self) -> int:
        return sum(len(rows) for rows in self.pieces)

    @property
    def times(self) -> FloatArray:
        """Of all instants."""
        return np.concatenate([rows.times for rows in self.pieces] or [np.zeros(0)])

    def values(self, name: str, unknowns: IntArray) -> FloatArray:
        """History (n_rows, len(unknowns)) of `u`, `v` or `a` at some of the unknowns."""
        places = np.searchsorted(self.unknowns, unknowns)
        found = [rows.values(name, places) for rows in self.pieces]
        return np.concatenate(found or [np.zeros((0, len(unknowns)))])

    def joints(self, name: str) -> FloatArray:
        """History (n_rows, n_points, ...) of `w`, `t` or `state` of the joints."""
        return np.concatenate([getattr(rows.joints, name) for rows in self.pieces])


@dataclass(eq=False)
class Taps:
    """All tracks of a run, taken together: what a loop has to keep, and who gets what.

    Attributes
    ----------
    wanted : array (n_times,)
    unknowns : array (p,)
        Increasing.
    peaks : Peaks
        The largest values, for loops that compare them.
    room : Room or None
        For rows that some track keeps as they are; others look at rows, or take what they want of
        them, so that their memory is soon free for the next.
    looked_at : bool
        Whether rows are looked at while the run goes on, and nobody keeps them.
    """

    tracks: Sequence[Track]
    n_times: int
    peaks: Peaks = field(default_factory=lambda: peaks_of(0, 0))
    wanted: BoolArray = field(init=False)
    unknowns: IntArray = field(init=False)
    room: Room | None = field(init=False, default=None)
    looked_at: bool = field(init=False)

    def __post_init__(self) -> None:
        times = [track.wanted for track in self.tracks] or [np.zeros(self.n_times, bool)]
        self.wanted = reduce(np.logical_or, times)
        asked = [track.unknowns for track in self.tracks]
        self.unknowns = np.unique(np.concatenate([np.zeros(0, np.int64), *asked]))
        rows, width = int(np.count_nonzero(self.wanted)), len(self.unknowns)
        kept = [
            track
            for track in self.tracks
            if track.keeps
            and np.count_nonzero(track.wanted) == rows
            and len(track.unknowns) == width
        ]  # they get the rows that the loop fills, and no copies
        self.looked_at = not kept and any(track.wanted.any() for track in self.tracks)
        if kept:
            self.room = Room(rows)

    def give(self, rows: Rows) -> None:
        """Hand rows at all the unknowns, or more, to the tracks that want them."""
        for track in self.tracks:
            which = track.wanted[rows.steps]
            if which.any():
                track.take(rows.chosen(which, track.unknowns))
