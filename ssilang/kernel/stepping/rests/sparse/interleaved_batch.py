"""Large problems that share a model, set up for `run_interleaved_batch`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.copies import copy_state
from ssilang.kernel.interface.newton import Workspace, workspace_at
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.solvers.cholesky.multifrontal import Panels
from ssilang.kernel.solvers.cholesky.triangular_together import FOUR, backward_many, forward_many
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
from ssilang.kernel.stepping.rests.sparse.interleaved_loop import (
    Plan,
    Products,
    Sweep,
    account,
    add_work,
    advance_range,
    begin_step,
    predict,
    settle_interface,
)
from ssilang.kernel.stepping.snapshot import Instants, kept_instants
from ssilang.kernel.stepping.state import (
    Ends,
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
from ssilang.kernel.stepping.verbs import end_of_step, motion_at, recorder_at


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


# Several motions of one large model: the steps of `interleaved_loop`, side by side.
#
# Each branch of the factor is read once for all motions, which go through its triangular solves
# four at a time. What is a motion's own, its interface above all, is stepped as alone.


class Batch(NamedTuple):
    """m motions of one model, the first direction of each array, and where they end."""

    x: Motion
    products: Products
    newton: Workspace
    ends: Ends


@compiled
def _products_at(x: Products, j: int) -> Products:
    return Products(x.g[j], x.Mv[j], x.Ma[j], x.Cv[j], x.Ca[j], x.loads[j])


@compiled
def _sweep_at(x: Sweep, j: int) -> Sweep:
    return Sweep(
        x.b[j],
        x.du[j],
        x.above[j],
        x.change[j],
        x.room[j],
        x.load_change[j],
        x.next_load_change[j],
        x.sums[j],
        x.local[0],
    )


@compiled
def _add_above(L: Panels, s: int, sweep: Sweep) -> None:
    for j in range(len(sweep.b)):
        for i in range(L.first[s], L.first[s + 1]):
            sweep.b[j, i] += sweep.above[j, i]
            sweep.above[j, i] = 0.0


@compiled
def _solve_interfaces(
    plan: Plan, joints: Joints, batch: Batch, sweep: Sweep, k: int, steps: int
) -> None:
    """The interfaces of all motions at the end of step k; motions without an answer end."""
    L, s, ends = plan.L, plan.root, batch.ends
    _add_above(L, s, sweep)
    forward_many(L, s, s + 1, sweep.b, L.first[0], sweep.above, sweep.local)
    backward_many(L, s, s + 1, sweep.b, sweep.du, sweep.local)
    for j in range(len(sweep.b)):
        if ends.steps[j] == steps:
            turns, residual = settle_interface(
                plan, joints, motion_at(batch.x, j), workspace_at(batch.newton, j),
                _sweep_at(sweep, j),
            )  # fmt: skip
            if turns <= 0:
                ends.steps[j], ends.turns[j], ends.residual[j] = k, turns, residual
            else:
                ends.turns[j] = max(ends.turns[j], turns)


@compiled
def _advance_all(
    plan: Plan, batch: Batch, sweep: Sweep, to: Recorder, k: int, begin: int, end: int
) -> None:
    """Advance all motions on a range of unknowns, and predict their next step there."""
    for j in range(len(sweep.b)):
        own, products = _sweep_at(sweep, j), _products_at(batch.products, j)
        advance_range(plan, motion_at(batch.x, j), products, own, begin, end)
        add_work(plan.forces, own.du, begin, end, to.work[j, 0, k])
        predict(plan, products, own.next_load_change, own.b, begin, end)


@compiled
def _end_of_step(
    plan: Plan, joints: Joints, batch: Batch, sweep: Sweep, factors: FloatArray, to: Recorder,
    k: int, j: int,
) -> None:  # fmt: skip
    """Energies of motion j after step k, and its row if the step is kept."""
    x, own, ends = motion_at(batch.x, j), recorder_at(to, j), batch.ends
    products, mine = _products_at(batch.products, j), _sweep_at(sweep, j)
    account(plan, joints, x, products, mine, factors[j], own.work, k)
    if not np.isfinite(mine.sums[4]):
        ends.steps[j], ends.turns[j], ends.residual[j] = k, -1, np.inf
        return
    end_of_step(x, own, k)


@compiled
def run_interleaved_batch(
    plan: Plan, joints: Joints, batch: Batch, factors: FloatArray, to: Recorder
) -> None:
    """Step m motions as `run_interleaved` steps one; a motion that fails stops alone.

    All arrays of the batch, of `to` and the factors (m, n_steps + 1, k) have the motions first.
    """
    L, count, n, steps = plan.L, batch.x.u.shape[0], batch.x.u.shape[1], to.row.shape[1]
    loads, start, ends = factors.shape[2], L.first[0], batch.ends
    sweep = Sweep(
        np.empty((count, n)), np.zeros((count, n)), np.zeros((count, n)), np.zeros((count, n)),
        np.empty((count, n)), np.zeros((count, loads)), np.zeros((count, loads)),
        np.zeros((count, 5)), np.empty((FOUR, plan.room)),
    )  # fmt: skip
    b, du, above, local = sweep.b, sweep.du, sweep.above, sweep.local
    for j in range(count):
        ends.steps[j], ends.turns[j] = steps, 1
        for c in range(loads):
            sweep.load_change[j, c] = factors[j, 1, c] - factors[j, 0, c]
        predict(plan, _products_at(batch.products, j), sweep.load_change[j], b[j], start, n)
    for i in range(len(plan.branches)):
        s0, s1 = plan.branches[i]
        forward_many(L, s0, s1, b, L.first[s1], above, local)
    for k in range(steps):
        # solve: up the trunk, the interfaces at the root, down the trunk
        for s in plan.trunk:
            _add_above(L, s, sweep)
            forward_many(L, s, s + 1, b, L.first[0], above, local)
        if batch.x.f.shape[1]:
            _solve_interfaces(plan, joints, batch, sweep, k, steps)
        for i in range(len(plan.trunk) - 1, -1, -1):
            s = plan.trunk[i]
            backward_many(L, s, s + 1, b, du, local)
        for j in range(count):
            begin_step(_sweep_at(sweep, j), factors[j], k, to.work[j, 0, k])
        # each branch: down, advance and predict all motions, and up for the next step
        for i in range(len(plan.branches)):
            s0, s1 = plan.branches[i]
            begin, end = L.first[s0], L.first[s1]
            backward_many(L, s0, s1, b, du, local)
            _advance_all(plan, batch, sweep, to, k, begin, end)
            if k + 1 < steps:
                forward_many(L, s0, s1, b, end, above, local)
        # the trunk's and the root's own unknowns
        for i in range(len(plan.trunk) + 1):
            s = plan.trunk[i] if i < len(plan.trunk) else plan.root
            if s < len(L.first) - 1:
                _advance_all(plan, batch, sweep, to, k, L.first[s], L.first[s + 1])
        for j in range(count):
            if ends.steps[j] == steps:
                _end_of_step(plan, joints, batch, sweep, factors, to, k, j)
            copy_state(sweep.next_load_change[j], sweep.load_change[j])
