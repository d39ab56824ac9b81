"""Several motions on the same springs that only push: the steps of `springs`, side by side.

Each motion has its own set of closed springs and its own loads. The products with the springs'
rows J are those of two matrices, one row a motion, so that J is read once for all of them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.contact.active_set import ActiveSet
from ssilang.kernel.interface.copies import copy_state
from ssilang.kernel.stepping.rests.modal.diagonal import (
    Sweep,
    account,
    advance_range,
    next_load,
    predict,
)
from ssilang.kernel.stepping.rests.modal.loop import Modal, ModalStep
from ssilang.kernel.stepping.rests.modal.springs import (
    begin_springs,
    end_springs,
    wrong_sign,
)
from ssilang.kernel.stepping.state import Ends, Motion, Recorder
from ssilang.kernel.stepping.verbs import keep, motion_at, recorder_at, tap


class Batch(NamedTuple):
    """Springs and sweeps of m motions, the first direction of each array."""

    springs: ActiveSet
    sweep: Sweep


def batch_of(springs: ActiveSet, count: int, size: int) -> Batch:
    """Room for m motions on r coordinates and the same springs."""
    q = len(springs.k)
    own = springs._replace(
        E=np.zeros((count, q, q)), closed=np.zeros((count, q), bool),
        order=np.zeros((count, q), np.int64), tally=np.zeros((count, 2), np.int64),
        free=np.zeros((count, q)), found=np.zeros((count, q)),
    )  # fmt: skip
    du, g, load0, load1, end = (np.zeros((count, size)) for _ in range(5))
    return Batch(own, Sweep(du, g, load0, load1, np.zeros((count, 4)), end))


@compiled_fast
def _springs_at(x: ActiveSet, j: int) -> ActiveSet:
    return ActiveSet(
        x.Q, x.k, x.E[j], x.closed[j], x.order[j], x.tally[j], x.free[j], x.found[j], x.rounding
    )


@compiled_fast
def _sweep_at(x: Sweep, j: int) -> Sweep:
    return Sweep(x.du[j], x.g[j], x.load0[j], x.load1[j], x.sums[j], x.end[j])


@compiled_fast
def _begin(
    modal: Modal, step: ModalStep, batch: Batch, x: Motion, factors: FloatArray, j: int
) -> None:
    """Loads and increments of the next step of motion j, and the coordinates that they lead to."""
    sweep, end, n = _sweep_at(batch.sweep, j), batch.sweep.end[j], len(x.u)
    next_load(modal.forces, factors, sweep.load0, sweep.load1)
    first = n - n  # not a literal: that is a type, and code, of its own
    predict(step.newmark, step.diagonal, x, sweep, step.newmark.start, first, n)
    for i in range(len(end)):
        end[i] = x.u[i] + sweep.du[i]


@compiled_fast
def _end(step: ModalStep, batch: Batch, x: Motion, j: int) -> float:
    """The state of motion j after a step that its springs end with their forces g."""
    sweep = _sweep_at(batch.sweep, j)
    P, end, n = step.diagonal.P, step.newmark.end, len(x.u)
    for i in range(n):
        sweep.du[i] -= end * P[i] * sweep.g[i]
    size = advance_range(step.newmark, step.diagonal, x, sweep, n - n, n)
    account(x, sweep)
    return size


@compiled_fast
def run_springs_batch(
    modal: Modal, step: ModalStep, batch: Batch, x: Motion, factors: FloatArray, to: Recorder,
    ends: Ends,
) -> None:  # fmt: skip
    """Step m motions as `run_springs` steps one; a motion that fails stops alone.

    All arrays of `x`, of `to` and the factors (m, n_steps + 1, n_loads) have the motions first.
    """
    count, steps, sweep = x.u.shape[0], to.row.shape[1], batch.sweep
    np.dot(x.f, modal.J, sweep.g)
    for j in range(count):
        begin_springs(_springs_at(batch.springs, j), motion_at(x, j))
        next_load(modal.forces, factors[j, 0], sweep.load0[j], sweep.load1[j])
        _begin(modal, step, batch, motion_at(x, j), factors[j, min(1, steps)], j)
        ends.steps[j], ends.turns[j] = steps, 1
    for s in range(steps):
        # solve: the springs of each motion, after one product for all
        np.dot(sweep.end, modal.Jt, batch.springs.free)
        for j in range(count):
            if ends.steps[j] == steps:
                springs = _springs_at(batch.springs, j)
                turns = end_springs(springs, motion_at(x, j))
                if turns < 0:
                    ends.steps[j], ends.turns[j] = s, turns
                    ends.residual[j] = wrong_sign(springs)
                else:
                    ends.turns[j] = max(ends.turns[j], turns)
        np.dot(x.f, modal.J, sweep.g)
        # advance, account, keep and predict, each motion by itself
        for j in range(count):
            if ends.steps[j] == steps:
                motion, own = motion_at(x, j), recorder_at(to, j)
                if not np.isfinite(_end(step, batch, motion, j)):
                    ends.steps[j], ends.turns[j], ends.residual[j] = s, -1, np.inf
                    continue
                copy_state(motion.energies, own.energies[s])
                if own.row[s] >= 0:
                    keep(motion, own, own.row[s])
                if own.tap.row[s] >= 0:
                    tap(motion, own.tap, own.tap.row[s])
                _begin(modal, step, batch, motion, factors[j, min(s + 2, steps)], j)
