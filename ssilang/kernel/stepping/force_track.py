"""Forces of named supports and relations in time: their sums, found while a loop steps."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.stepping.node_track import Forces, resultants_of
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.kernel.stepping.track import Rows, Track, balance_of, rows_of_snapshot


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
