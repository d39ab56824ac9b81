"""Several motions of one large model: the steps of `interleaved_loop`, side by side.

Each branch of the factor is read once for all motions, which go through its triangular solves four
at a time. What is a motion's own, its interface above all, is stepped as alone.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.copies import copy_state
from ssilang.kernel.interface.newton import Workspace, workspace_at
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.solvers.cholesky.multifrontal import Panels
from ssilang.kernel.solvers.cholesky.triangular_together import FOUR, backward_many, forward_many
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
from ssilang.kernel.stepping.state import Ends, Motion, Recorder
from ssilang.kernel.stepping.verbs import end_of_step, motion_at, recorder_at


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
