"""Several motions of one large model: the steps of `interleaved_march`, side by side.

Each branch of the factor is read once for all motions, which go through its triangular solves four
at a time. What is a motion's own, its interface above all, is stepped as alone.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.copies import copy_state
from ssilang.kernel.interface.newton import Workspace, workspace_at
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.solvers.cholesky.multifrontal import Panels
from ssilang.kernel.solvers.cholesky.triangular_together import FOUR, backward_many, forward_many
from ssilang.kernel.stepping.rests.modal.springs_batch import Ends
from ssilang.kernel.stepping.rests.sparse.interleaved_loop import (
    Flow,
    Kept,
    Plan,
    account,
    add_work,
    advance,
    keep,
    right_side,
    settle_interface,
)


@compiled
def _flow(x: Flow, j: int) -> Flow:
    """One of the motions, that lie in the first direction of each array."""
    return Flow(
        x.u[j], x.v[j], x.a[j], x.g[j], x.Mv[j], x.Ma[j], x.Cv[j], x.Ca[j], x.loads[j],
        x.delta[j], x.f[j], x.w[j], x.t[j], x.state[j], x.energies[j],
    )  # fmt: skip


@compiled
def _rows(x: Kept, j: int) -> Kept:
    return Kept(x.u[j], x.v[j], x.a[j], x.f[j], x.w[j], x.t[j], x.state[j])


@compiled
def _add_above(L: Panels, s: int, b: FloatArray, above: FloatArray) -> None:
    for j in range(len(b)):
        for i in range(L.first[s], L.first[s + 1]):
            b[j, i] += above[j, i]
            above[j, i] = 0.0


@compiled
def _root(
    plan: Plan, joints: Joints, flows: Flow, newtons: Workspace, b: FloatArray, above: FloatArray,
    du: FloatArray, local: FloatArray, rise: FloatArray, pull: FloatArray, k: int, steps: int,
    ends: Ends,
) -> None:  # fmt: skip
    """The interfaces of all motions at the end of step k; motions without an answer end."""
    L, s = plan.L, plan.root
    _add_above(L, s, b, above)
    forward_many(L, s, s + 1, b, L.first[0], above, local)
    backward_many(L, s, s + 1, b, du, local)
    for j in range(len(b)):
        if ends.steps[j] == steps:
            turns, residual = settle_interface(
                plan, joints, _flow(flows, j), workspace_at(newtons, j), du[j], rise[j], pull[j]
            )
            if turns <= 0:
                ends.steps[j], ends.turns[j], ends.residual[j] = k, turns, residual
            else:
                ends.turns[j] = max(ends.turns[j], turns)


@compiled
def march_many(
    plan: Plan,
    joints: Joints,
    flows: Flow,
    newtons: Workspace,
    factors: FloatArray,
    save: IntArray,
    kept: Kept,
    history: FloatArray,
    works: FloatArray,
    ends: Ends,
) -> None:
    """Step m motions as `march_interleaved` steps one; a motion that fails stops alone.

    Parameters
    ----------
    flows, newtons, kept
        As there, with a first direction (m,) in each array.
    factors : array (m, n_steps + 1, k)
    save : array (m, n_steps)
    history : array (m, n_steps, N_ENERGIES)
    works : array (m, 2, n_steps, k)
    """
    L, count, n, steps = plan.L, flows.u.shape[0], flows.u.shape[1], save.shape[1]
    b, du, above = np.empty((count, n)), np.zeros((count, n)), np.zeros((count, n))
    pull, room, local = np.zeros((count, n)), np.empty(n), np.empty((FOUR, plan.room))
    loads, start = factors.shape[2], L.first[0]
    rise, coming, sums = (
        np.zeros((count, loads)), np.zeros((count, loads)), np.zeros((count, 5)),
    )  # fmt: skip
    for j in range(count):
        ends.steps[j], ends.turns[j] = steps, 1
        for c in range(loads):
            rise[j, c] = factors[j, 1, c] - factors[j, 0, c]
        right_side(plan, _flow(flows, j), rise[j], start, n, b[j])
    for i in range(len(plan.branches)):
        s0, s1 = plan.branches[i]
        forward_many(L, s0, s1, b, L.first[s1], above, local)
    for k in range(steps):
        for s in plan.trunk:
            _add_above(L, s, b, above)
            forward_many(L, s, s + 1, b, L.first[0], above, local)
        if flows.f.shape[1]:
            _root(
                plan, joints, flows, newtons, b, above, du, local, rise, pull, k, steps, ends
            )  # fmt: skip
        for i in range(len(plan.trunk) - 1, -1, -1):
            s = plan.trunk[i]
            backward_many(L, s, s + 1, b, du, local)
        for j in range(count):
            for c in range(loads):
                works[j, 0, k, c] = 0.0
                rise[j, c] = factors[j, k + 1, c] - factors[j, k, c]
                coming[j, c] = factors[j, min(k + 2, steps), c] - factors[j, k + 1, c]
            for c in range(5):
                sums[j, c] = 0.0
        for i in range(len(plan.branches)):
            s0, s1 = plan.branches[i]
            begin, end = L.first[s0], L.first[s1]
            backward_many(L, s0, s1, b, du, local)
            for j in range(count):
                flow, work = _flow(flows, j), works[j, 0, k]
                advance(plan, flow, du[j], begin, end, sums[j], rise[j], pull[j], room)
                add_work(plan.forces, du[j], begin, end, work)
                right_side(plan, flow, coming[j], begin, end, b[j])
            if k + 1 < steps:
                forward_many(L, s0, s1, b, end, above, local)
        for i in range(len(plan.trunk) + 1):
            s = plan.trunk[i] if i < len(plan.trunk) else plan.root
            if s < len(L.first) - 1:
                begin, end = L.first[s], L.first[s + 1]
                for j in range(count):
                    flow, work = _flow(flows, j), works[j, 0, k]
                    advance(plan, flow, du[j], begin, end, sums[j], rise[j], pull[j], room)
                    add_work(plan.forces, du[j], begin, end, work)
                    right_side(plan, flow, coming[j], begin, end, b[j])
        for j in range(count):
            if ends.steps[j] == steps:
                _end_of_step(
                    plan, joints, _flow(flows, j), sums[j], works[j], factors[j], k, history[j],
                    ends, j,
                )  # fmt: skip
                if ends.steps[j] == steps and save[j, k] >= 0:
                    keep(_flow(flows, j), _rows(kept, j), save[j, k])
            for c in range(loads):
                rise[j, c] = coming[j, c]


@compiled
def _end_of_step(
    plan: Plan, joints: Joints, flow: Flow, sums: FloatArray, works: FloatArray,
    factors: FloatArray, k: int, history: FloatArray, ends: Ends, j: int,
) -> None:  # fmt: skip
    account(plan, joints, flow, sums, works[0, k], factors, k, works[1, k])
    if not np.isfinite(sums[4]):
        ends.steps[j], ends.turns[j], ends.residual[j] = k, -1, np.inf
        return
    copy_state(flow.energies, history[k])
