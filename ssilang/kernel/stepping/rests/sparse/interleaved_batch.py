"""Large problems that share a model, set up for `march_many`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.newton import Workspace
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.problem.sharing import LoadBasis
from ssilang.kernel.stepping.rests.dense.loop import Motion, Saved
from ssilang.kernel.stepping.rests.modal.springs_batch import Ends
from ssilang.kernel.stepping.rests.sparse.interleaved import (
    BLOCK,
    InterleavedLoop,
    PreparedBlock,
    fits,
)
from ssilang.kernel.stepping.rests.sparse.interleaved_batch_loop import march_many
from ssilang.kernel.stepping.rests.sparse.interleaved_loop import Flow, Kept
from ssilang.kernel.stepping.snapshot import Instants

Outcome = tuple[int, int, float]
Rooms = Sequence[Callable[[int], tuple[Saved, Instants]]]


class InterleavedTogether:
    """Steps of one dt of large problems with one model; see `interleaved_together`."""

    name = "condensed"

    def __init__(
        self, problems: Sequence[Problem], motions: Sequence[Motion], effective: Effective,
        rooms: Rooms,
    ) -> None:  # fmt: skip
        self.solver, self._rooms = effective.inverse.factor.name, rooms
        first = InterleavedLoop(problems[0], motions[0], effective)
        others = zip(problems[1:], motions[1:], strict=True)
        self.loops = [first, *(first.alike(p, m) for p, m in others)]
        self._loads = LoadBasis([loop.forces for loop in self.loops])
        self._plan = first.plan._replace(forces=self._loads.forces)
        self._alive = list(range(len(self.loops)))
        self._newtons = Workspace(*_stacked([loop.newton for loop in self.loops]))

    def march(
        self, factors: list[FloatArray], save: list[IntArray], history: list[FloatArray],
        times: FloatArray,
    ) -> tuple[list[Outcome], list[Instants]]:  # fmt: skip
        """Steps of all problems; see `together.Engine`. One that fails takes no further part."""
        steps = len(save[0])
        rooms = [room(int((s >= 0).sum())) for room, s in zip(self._rooms, save, strict=True)]
        outcomes = [(0, -1, np.nan)] * len(self.loops)
        for j in self._alive:
            outcomes[j] = (steps, 1, 0.0)
        for first in range(0, steps, BLOCK):
            part = slice(first, min(first + BLOCK, steps))
            given = slice(first, part.stop + 1)
            tasks = [
                BlockTask(
                    j, self.loops[j], np.ascontiguousarray(factors[j][given]), save[j][part],
                    rooms[j][0], history[j][part],
                )
                for j in self._alive
            ]  # fmt: skip
            if not tasks:
                break
            for task, (done, turns, residual) in zip(tasks, self._block(tasks), strict=True):
                if turns <= 0:
                    outcomes[task.place] = (first + done, turns, residual)
                    self._leave_out(task.place)
                else:
                    outcomes[task.place] = (steps, max(outcomes[task.place][1], turns), 0.0)
        return outcomes, [room[1] for room in rooms]

    def _leave_out(self, place: int) -> None:
        at = self._alive.index(place)
        self._alive.remove(place)
        self._newtons = Workspace(*_without(self._newtons, at))

    def _block(self, tasks: Sequence[BlockTask]) -> list[Outcome]:
        blocks = [task.loop.block(task.factors) for task in tasks]
        if any(b.columns.X.shape[1] for b in blocks):  # a start that the supports do not allow
            return [t.loop.march(t.factors, t.save, t.saved, t.history) for t in tasks]
        count, steps = len(tasks), len(tasks[0].save)
        flows = Flow(*_stacked([b.flow for b in blocks]))
        flows = flows._replace(loads=flows.u @ self._loads.forces.T)
        save = [np.where(t.save >= 0, np.cumsum(t.save >= 0) - 1, -1) for t in tasks]
        rows = max(int((t.save >= 0).sum()) for t in tasks)
        kept = Kept(*_stacked([t.loop.room(rows) for t in tasks]))
        factors = self._loads.factors([t.factors for t in tasks], self._alive)
        works = np.zeros((count, 2, steps, len(self._loads.forces)))
        energies = np.stack([t.history for t in tasks])
        ends = Ends(np.zeros(count, np.int64), np.zeros(count, np.int64), np.zeros(count))
        march_many(
            self._plan, self.loops[0].joints, flows, self._newtons, factors, np.stack(save), kept,
            energies, works, ends,
        )  # fmt: skip
        outcomes = []
        for j, (task, block) in enumerate(zip(tasks, blocks, strict=True)):
            done = int(ends.steps[j])
            for name, part in block.flow._asdict().items():
                if name != "loads":
                    part[...] = getattr(flows, name)[j]
            task.history[:] = energies[j]
            _put(task, block, Kept(*(x[j] for x in kept)), done)
            outcomes.append((done, int(ends.turns[j]), float(ends.residual[j])))
        return outcomes


def _put(task: BlockTask, block: PreparedBlock, kept: Kept, done: int) -> None:
    """Motion, energies and saved steps of a block of which some steps were done."""
    task.loop.finish(block, task.factors, task.history[:done])
    for row, k in enumerate(np.flatnonzero(task.save[:done] >= 0)):
        to, at = int(task.save[k]), int(k) + 1
        task.loop.keep(kept, row, block, at, task.factors[at], task.saved, to)


@dataclass(frozen=True, eq=False)
class BlockTask:
    """Some steps of the motion at a place among all: as `compiled_loop.march` takes them."""

    place: int
    loop: InterleavedLoop
    factors: FloatArray
    save: IntArray
    saved: Saved
    history: FloatArray


def _without(arrays: tuple[Any, ...], at: int) -> list[Any]:
    return [_left(x, at) for x in arrays]


def _left(x: Any, at: int) -> Any:
    return type(x)(*_without(x, at)) if isinstance(x, tuple) else np.delete(x, at, axis=0)


def _stacked(parts: Sequence[tuple[Any, ...]]) -> list[Any]:
    """Arrays of several tuples, those of one place together."""
    return [
        type(first)(*_stacked((first, *others)))
        if isinstance(first, tuple)
        else np.stack((first, *others))
        for first, *others in zip(*parts, strict=True)
    ]


def interleaved_together(
    problems: Sequence[Problem], motions: Sequence[Motion], effective: Effective, rooms: Rooms
) -> InterleavedTogether | None:
    """Large problems of one model whose supports rest; None if their loop is another one."""
    if not fits(problems[0], effective) or any(p.loading.imposed.any() for p in problems):
        return None
    return InterleavedTogether(problems, motions, effective, rooms)
