"""The time loop, compiled, on coordinates in which mass, damping and stiffness are diagonal.

The interface is that of the whole model, seen through the coordinates: jumps `J q`, compliance
`J P J^T`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled_fast, compiled_inline
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_rows, copy_state
from ssilang.kernel.interface.factors.kept import is_factorised, solve_known
from ssilang.kernel.interface.newton import Workspace, solve_interface
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    accept,
    interface_energies,
)
from ssilang.kernel.stepping.newmark import Newmark
from ssilang.kernel.stepping.rests.modal.diagonal import (
    Diagonal,
    Sweep,
    account,
    add_jumps,
    advance_range,
    next_load,
    predict,
)
from ssilang.kernel.stepping.state import LOST, STORED, Motion, Recorder
from ssilang.kernel.stepping.verbs import end_of_step

BLOCK = 128  # coordinates whose rows of Jt stay in the nearest cache


class Modal(NamedTuple):
    """Interface and loads on r coordinates."""

    J: FloatArray  # (q, r)
    Jt: FloatArray  # (r, q)
    forces: FloatArray  # (n_loads, r)


class ModalStep(NamedTuple):
    """What depends on dt: diagonals, the condensed interface."""

    newmark: Newmark
    diagonal: Diagonal
    condensed: Condensed


@compiled_fast
def correct(
    modal: Modal, step: ModalStep, f: FloatArray, sweep: Sweep, first: int, last: int
) -> None:
    """The joints' new forces f into g and the increments of some coordinates."""
    end, Jt = step.newmark.end, modal.Jt[first:last]
    du, old, P = sweep.du[first:last], sweep.g[first:last], step.diagonal.P[first:last]
    fours = len(du) // 4 * 4
    for i in range(0, fours, 4):  # four sums at a time: f is read less often
        a, b, c, d = 0.0, 0.0, 0.0, 0.0
        row0, row1, row2, row3 = Jt[i], Jt[i + 1], Jt[i + 2], Jt[i + 3]
        for j in range(len(f)):
            a += row0[j] * f[j]
            b += row1[j] * f[j]
            c += row2[j] * f[j]
            d += row3[j] * f[j]
        _change_force(du, old, P, end, i, a)
        _change_force(du, old, P, end, i + 1, b)
        _change_force(du, old, P, end, i + 2, c)
        _change_force(du, old, P, end, i + 3, d)
    for i in range(fours, len(du)):
        g = 0.0
        for j in range(len(f)):
            g += Jt[i, j] * f[j]
        _change_force(du, old, P, end, i, g)


@compiled_fast
def _change_force(
    du: FloatArray, old: FloatArray, P: FloatArray, end: float, i: int, g: float
) -> None:
    """The increment of a coordinate whose joints' force becomes g."""
    du[i] -= P[i] * end * (g - old[i])
    old[i] = g


@apart
@compiled_fast
def _end_and_begin(
    modal: Modal, step: ModalStep, x: Motion, sweep: Sweep, y0: FloatArray, factors: FloatArray,
    ends: bool,
) -> float:  # fmt: skip
    """End of a step under the joints' forces and prediction of the next, in one pass over Jt.

    `factors` are those of the loads at the end of the next step; none: there is none. Nothing
    `ends` before the first.
    """
    n, size, coming = len(x.u), 0.0, len(factors) > 0
    for j in range(len(y0)):
        y0[j] = 0.0
    for first in range(0, n, BLOCK):
        last = min(first + BLOCK, n)
        correct(modal, step, x.f, sweep, first, last)
        if ends:
            size += advance_range(step.newmark, step.diagonal, x, sweep, first, last)
        if coming:
            _begin(modal, step, x, sweep, y0, factors[0], first, last)
    if ends:
        account(x, sweep)
    return size


@compiled_inline
def _begin(
    modal: Modal, step: ModalStep, x: Motion, sweep: Sweep, y0: FloatArray, factors: FloatArray,
    first: int, last: int,
) -> None:  # fmt: skip
    """Loads and prediction of the next step on some coordinates; `y0` gathers its jumps."""
    next_load(
        modal.forces[:, first:last], factors, sweep.load0[first:last], sweep.load1[first:last]
    )
    predict(step.newmark, step.diagonal, x, sweep, 1.0, first, last)
    add_jumps(modal.Jt[first:last], sweep.du[first:last], y0)


@compiled_fast
def run_modal(
    modal: Modal, step: ModalStep, joints: Joints, x: Motion, sweep: Sweep, work: Workspace,
    factors: FloatArray, to: Recorder,
) -> tuple[int, int, float]:  # fmt: skip
    """As `run_dense`; `x` and the rows hold coordinates."""
    steps, worst, trial, condensed = len(to.row), 0, work.trial, step.condensed
    now = InterfaceState(x.delta, x.f, x.w, x.t, x.state)
    next_load(modal.forces, factors[0], sweep.load0, sweep.load1)
    _end_and_begin(modal, step, x, sweep, trial.y0, factors[1:2], False)
    for k in range(steps):
        if len(x.f):  # solve: Newton's method on the interface
            copy_state(trial.y0, trial.y)
            if is_factorised(work.factors):  # starts where the last tangents lead
                solve_known(joints, condensed, work.factors, trial.y)
            turns, residual = solve_interface(joints, condensed, now, work)
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            accept(trial, now)
            if len(to.jumps):
                copy_rows(x.w, to.jumps[k])
        # advance and account, and predict the next step while its coordinates are near
        size = _end_and_begin(modal, step, x, sweep, trial.y0, factors[k + 2 : k + 3], True)
        if not np.isfinite(size):
            return k, -1, np.inf
        if len(x.f):
            stored, lost = interface_energies(joints, x.w, x.t, x.state)
            x.energies[STORED], x.energies[LOST] = stored, lost
        end_of_step(x, to, k)
    return steps, worst, 0.0
