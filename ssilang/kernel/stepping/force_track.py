"""Forces in time: sums of named supports and relations, found while a loop steps; of footings.

What footings carry is made of each instant that an observer is given.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.interface.footing import Footing, Loads, footings_of
from ssilang.kernel.stepping.node_track import Forces, resultants_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.kernel.stepping.track import Rows, Track, balance_of, rows_of_snapshot

MOST = 8
"""Footings that are followed."""


@dataclass(eq=False)
class FootingTrack(Track):
    """Loads of footings at the times it wants; rows are let go at once.

    Attributes
    ----------
    footings : sequence of Footing
    kept : list of lists of Loads
        Of each footing, in order of time.
    left_out : int
        Smaller footings, which nobody follows.
    """

    footings: Sequence[Footing] = field(kw_only=True)
    left_out: int = field(default=0, kw_only=True)
    kept: list[list[Loads]] = field(init=False)
    instants: list[FloatArray] = field(default_factory=list, init=False)
    keeps: ClassVar[bool] = False

    def __post_init__(self) -> None:
        self.kept = [[] for _ in self.footings]

    def receive(self, snapshot: Snapshot) -> None:
        """Take one whole instant, of a problem that may have unknowns of its own."""
        self.instants.append(np.array([snapshot.time]))
        for footing, kept in zip(self.footings, self.kept, strict=True):
            u = snapshot.u[footing.unknowns]
            kept.append(footing.loads(snapshot.w[None], snapshot.t[None], u[None]))

    def take(self, rows: Rows) -> None:
        """Take instants."""
        self.instants.append(rows.times)
        joints = rows.joints
        for footing, kept in zip(self.footings, self.kept, strict=True):
            places = np.searchsorted(rows.unknowns, footing.unknowns)
            kept.append(footing.loads(joints.w, joints.t, rows.values("u", places)))

    @property
    def times(self) -> FloatArray:
        """Of all instants."""
        return np.concatenate([np.zeros(0), *self.instants])

    def found(self, number: int) -> Loads:
        """The loads of a footing in time."""
        return Loads(*(np.concatenate(x) for x in zip(*self.kept[number], strict=True)))

    def content(self) -> list[Any]:
        """What a checkpoint keeps: the loads so far."""
        return [self.times, *(x for i in range(len(self.kept)) for x in self._so_far(i))]

    def restore(self, kept: list[Any]) -> None:
        """Go on from a checkpoint."""
        times, *loads = kept
        self.instants = [np.asarray(times)] if len(times) else []
        size = len(Loads._fields)
        self.kept = [
            [Loads(*map(np.asarray, loads[i * size : (i + 1) * size]))] if len(times) else []
            for i in range(len(self.footings))
        ]

    def _so_far(self, number: int) -> Sequence[FloatArray]:
        return self.found(number) if self.kept[number] else [np.zeros(0)] * len(Loads._fields)


def footing_track(problem: Problem, wanted: BoolArray) -> FootingTrack | None:
    """The observer of a problem's largest footings; None where it has no joints."""
    if problem.interface is None:
        return None
    every = footings_of(problem.interface, problem.numbering)
    footings, left = every[:MOST], len(every[MOST:])
    held = [np.zeros(0, np.int64), *(f.unknowns for f in footings)]
    return FootingTrack(wanted, np.unique(np.concatenate(held)), footings=footings, left_out=left)


@dataclass(eq=False)
class ForceTrack(Track):
    """Sums of the forces of named relations on the body.

    Only the sums are kept: rows of all that acts on what they hold would be many numbers.

    Attributes
    ----------
    problem : Problem
    named : dict
        Multiplier nodes of the relations of each name.
    """

    unknowns: IntArray = field(init=False)
    problem: Problem = field(kw_only=True)
    named: dict[str, IntArray] = field(kw_only=True)
    keeps: ClassVar[bool] = False
    _steps: list[IntArray] = field(init=False, default_factory=list)
    _sums: list[FloatArray] = field(init=False, default_factory=list)

    def __post_init__(self) -> None:
        self._maps = self._of(self.problem)
        at = [np.zeros(0, np.int64), *(forces.at for forces in self._maps.values())]
        held = np.unique(np.concatenate(at))
        near = balance_of(self.problem, held).near if len(held) else held
        self.unknowns = near.astype(np.int64)

    def _of(self, problem: Problem) -> dict[tuple[str, str], Forces]:
        """Sums by name and component."""
        return {
            (name, dual): forces
            for name, nodes in self.named.items()
            for dual, forces in resultants_of(problem, nodes).items()
        }

    def receive(self, snapshot: Snapshot) -> None:
        """Take one whole instant; where the problem changes, of its own relations."""
        if snapshot.problem is self.problem:
            super().receive(snapshot)
            return
        maps, every = self._of(snapshot.problem), np.arange(len(snapshot.u))
        rows = rows_of_snapshot(snapshot, every)
        self._add(rows, {key: maps[key] for key in self._maps if key in maps})

    def take(self, rows: Rows) -> None:
        """Sum the forces of some instants."""
        self._add(rows, self._maps)

    def _add(self, rows: Rows, maps: dict[tuple[str, str], Forces]) -> None:
        none = np.zeros((len(rows), 1))
        found = [maps[key].values(rows) if key in maps else none for key in self._maps]
        self._steps.append(rows.steps_taken)
        self._sums.append(np.hstack([none[:, :0], *found]))

    @property
    def times(self) -> FloatArray:
        """Of the instants kept."""
        return self.problem.times[self._whole()[0]]

    @property
    def histories(self) -> dict[tuple[str, str], FloatArray]:
        """Sum (n_rows,) by name and component."""
        sums = self._whole()[1]
        return {key: sums[:, i].copy() for i, key in enumerate(self._maps)}

    def _whole(self) -> tuple[IntArray, FloatArray]:
        steps = np.concatenate([np.zeros(0, np.int64), *self._steps])
        return steps, np.concatenate([np.zeros((0, len(self._maps))), *self._sums])

    def content(self) -> list[Any]:
        """What a checkpoint keeps: the sums so far."""
        return list(self._whole())

    def restore(self, kept: list[Any]) -> None:
        """Go on from a checkpoint."""
        steps, sums = kept
        self._steps, self._sums = [np.asarray(steps)], [np.asarray(sums)]
