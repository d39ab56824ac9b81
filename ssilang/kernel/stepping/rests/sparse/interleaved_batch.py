"""Large problems that share a model, set up for `run_interleaved_batch`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.interface.newton import Workspace
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.problem.sharing import LoadBasis
from ssilang.kernel.stepping.rests.sparse.interleaved import (
    BLOCK,
    InterleavedLoop,
    PreparedBlock,
    Seen,
    fits,
)
from ssilang.kernel.stepping.rests.sparse.interleaved_batch_loop import Batch, run_interleaved_batch
from ssilang.kernel.stepping.rests.sparse.interleaved_loop import Products
from ssilang.kernel.stepping.snapshot import Instants, kept_instants
from ssilang.kernel.stepping.state import (
    Motion,
    Outcome,
    Recorder,
    Tap,
    ends_of,
    part_of,
    recorder_of,
    stacked,
)
from ssilang.kernel.stepping.track import View


class InterleavedBatch:
    """Steps of one dt of large problems with one model; see `interleaved_batch`."""

    name = "condensed"

    def __init__(
        self, problems: Sequence[Problem], motions: Sequence[Motion], effective: Effective
    ) -> None:
        self.solver = effective.inverse.factor.name
        first = InterleavedLoop(problems[0], motions[0], effective)
        others = zip(problems[1:], motions[1:], strict=True)
        self.loops = [first, *(first.alike(p, m) for p, m in others)]
        self._loads = LoadBasis([loop.forces for loop in self.loops])
        self._plan = first.plan._replace(forces=self._loads.forces)
        self._alive = list(range(len(self.loops)))
        self._newtons: Workspace = stacked([loop.newton for loop in self.loops])

    def run(
        self, factors: list[FloatArray], rows: list[IntArray], history: list[FloatArray],
        times: FloatArray, taps: list[Tap],
    ) -> tuple[list[Outcome], list[Instants]]:  # fmt: skip
        """Steps of all problems; see `run_many.Engine`. One that fails takes no further part."""
        steps = len(rows[0])
        recorders = [
            recorder_of(loop.motion, row, energies, tap=tap)
            for loop, row, energies, tap in zip(self.loops, rows, history, taps, strict=True)
        ]
        seen = self.loops[0].seen(taps[0].at)
        outcomes: list[Outcome] = [(0, -1, np.nan)] * len(self.loops)
        for j in self._alive:
            outcomes[j] = (steps, 1, 0.0)
        for first in range(0, steps, BLOCK):
            part = slice(first, min(first + BLOCK, steps))
            tasks = [
                BlockTask(
                    j, self.loops[j],
                    np.ascontiguousarray(factors[j][first : part.stop + 1]), recorders[j], part,
                    seen,
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
        instants = [kept_instants(x.problem, r) for x, r in zip(self.loops, recorders, strict=True)]
        return outcomes, instants

    def view(self, unknowns: IntArray) -> View:
        """Unknowns as they are."""
        return self.loops[0].view(unknowns)

    def _leave_out(self, place: int) -> None:
        at = self._alive.index(place)
        self._alive.remove(place)
        self._newtons = _left(self._newtons, at)

    def _block(self, tasks: Sequence[BlockTask]) -> list[Outcome]:
        blocks = [task.loop.block(task.factors) for task in tasks]
        if any(b.columns.X.shape[1] for b in blocks):  # a start that the supports do not allow
            return [task.alone() for task in tasks]
        x: Motion = stacked([b.motion for b in blocks])
        products: Products = stacked([b.products for b in blocks])
        products = products._replace(loads=x.u @ self._loads.forces.T)
        own = [t.room(b) for t, b in zip(tasks, blocks, strict=True)]
        kept = self._room(blocks[0], own)
        factors = self._loads.factors([t.factors for t in tasks], self._alive)
        ends = ends_of(len(tasks))
        batch = Batch(x, products, self._newtons, ends)
        run_interleaved_batch(self._plan, self.loops[0].joints, batch, factors, kept)
        outcomes: list[Outcome] = []
        for j, (task, block) in enumerate(zip(tasks, blocks, strict=True)):
            for array, found in zip(block.motion, part_of(x, j), strict=True):
                array[...] = found
            found_rows = part_of(kept, j)
            task.recorder.energies[task.part] = found_rows.energies
            done = int(ends.steps[j])
            history = task.recorder.energies[task.part]
            # the work is of the loads of all, and of no support that moves
            task.put(block, found_rows._replace(energies=history, work=own[j].work), done)
            outcomes.append((done, int(ends.turns[j]), float(ends.residual[j])))
        return outcomes

    def _room(self, block: PreparedBlock, own: Sequence[Recorder]) -> Recorder:
        """One recorder for all, with as many rows as the fullest and the work of all loads."""
        fullest = max(own, key=lambda r: len(r.u))
        work = np.zeros((2, len(fullest.row), len(self._loads.forces)))
        tapped = max((r.tap for r in own), key=lambda t: len(t.u))
        found: Recorder = stacked([fullest._replace(work=work, tap=tapped)] * len(own))
        return found._replace(
            row=np.stack([r.row for r in own]), energies=np.stack([r.energies for r in own]),
            tap=found.tap._replace(row=np.stack([r.tap.row for r in own])),
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class BlockTask:
    """Some steps of the motion at a place among all."""

    place: int
    loop: InterleavedLoop
    factors: FloatArray
    recorder: Recorder
    part: slice
    seen: Seen

    def room(self, block: PreparedBlock) -> Recorder:
        """Room for its kept steps."""
        return self.loop.room(block, self.recorder, self.part, self.seen)

    def put(self, block: PreparedBlock, kept: Recorder, done: int) -> None:
        """Motion, energies and kept instants of a block of which some steps were done."""
        self.loop.finish(block, self.factors, kept, done)
        self.loop.react(self.factors[done])
        self.loop.put(block, self.factors, kept, self.recorder, self.part.start, done, self.seen)

    def alone(self) -> Outcome:
        """Its steps by its own loop."""
        r, part = self.recorder, self.part
        tap = r.tap._replace(row=r.tap.row[part])
        return self.loop.run(
            self.factors, r._replace(row=r.row[part], energies=r.energies[part], tap=tap)
        )


def _left(record: Any, at: int) -> Any:
    """Stacked records without one of them."""
    if isinstance(record, tuple):
        return type(record)(*(_left(x, at) for x in record))
    return np.delete(record, at, axis=0)


def interleaved_batch(
    problems: Sequence[Problem], motions: Sequence[Motion], effective: Effective
) -> InterleavedBatch | None:
    """Large problems of one model whose supports rest; None if their loop is another one."""
    if not fits(problems[0], effective) or any(p.loading.imposed.any() for p in problems):
        return None
    return InterleavedBatch(problems, motions, effective)
