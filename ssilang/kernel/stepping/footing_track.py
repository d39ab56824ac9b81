"""What footings carry in time: an observer that makes a few numbers of each instant it is given."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray
from ssilang.kernel.interface.footing import Footing, Loads, footings_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.kernel.stepping.track import Rows, Track

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
