"""The whole time loop, compiled, for diagonal coordinates on springs that only push.

The springs are points of the Strong Discontinuity law without strength, closing traction and
shear: `f = k min(jump, 0)`. The steps are those of `reduced.loop`. The jumps that the end of a step
would have without its springs, and the springs' compliance `S = J P J^T`, give by
`contact.active_set` the springs that push: `Q = 1/k + c S` with c = 1 - alpha_f.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled_fast, compiled_inline
from ssilang.kernel.contact.active_set import (
    ActiveSet,
    active_set_of,
    anew,
    find_active,
    list_closed,
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
from ssilang.kernel.stepping.rests.reduced.loop import ReducedStep
from ssilang.kernel.stepping.state import STORED, Motion, Recorder
from ssilang.kernel.stepping.verbs import end_of_step

BLOCK = 64  # coordinates whose rows of J and Jt stay in the nearest cache
WRONG = 1e-14  # of the largest jump, or of its force: a sign that is not rounding


class OnSprings(NamedTuple):
    """The coordinates: what depends on dt, jumps of the springs, loads."""

    newmark: Newmark
    diagonal: Diagonal
    J: FloatArray  # (q, r)
    Jt: FloatArray  # (r, q)
    forces: FloatArray  # (n_loads, r)


@compiled_inline
def _push(
    model: OnSprings, springs: ActiveSet, f: FloatArray, sweep: Sweep, first: int,
    last: int,
) -> None:  # fmt: skip
    """The springs' new forces f into g and the increments of some coordinates."""
    g, order, n, J = sweep.g[first:last], springs.order, springs.tally[0], model.J
    for i in range(len(g)):
        g[i] = 0.0
    fours = n // 4 * 4
    for m in range(0, fours, 4):
        i0, i1, i2, i3 = order[m], order[m + 1], order[m + 2], order[m + 3]
        a, b, c, d = f[i0], f[i1], f[i2], f[i3]
        row0, row1 = J[i0, first:last], J[i1, first:last]
        row2, row3 = J[i2, first:last], J[i3, first:last]
        for j in range(len(g)):
            g[j] += (row0[j] * a + row1[j] * b) + (row2[j] * c + row3[j] * d)
    for m in range(fours, n):
        row, a = J[order[m], first:last], f[order[m]]
        for j in range(len(g)):
            g[j] += row[j] * a
    du, P, end = sweep.du[first:last], model.diagonal.P[first:last], model.newmark.end
    for i in range(len(g)):
        du[i] -= end * P[i] * g[i]


@compiled_inline
def _begin(
    model: OnSprings, springs: ActiveSet, x: Motion, sweep: Sweep, factors: FloatArray,
    first: int, last: int,
) -> None:  # fmt: skip
    """Loads and increments of the next step without its springs at the end; their jumps."""
    next_load(
        model.forces[:, first:last], factors, sweep.load0[first:last], sweep.load1[first:last]
    )
    predict(model.newmark, model.diagonal, x, sweep, model.newmark.start, first, last)
    u, du, end = x.u[first:last], sweep.du[first:last], sweep.end[first:last]
    for i in range(len(end)):
        end[i] = u[i] + du[i]
    add_jumps(model.Jt[first:last], end, springs.free)


@compiled_fast
def begin_springs(springs: ActiveSet, x: Motion) -> None:
    """The set of closed springs of the state, and E on it."""
    for i in range(len(springs.k)):
        springs.closed[i] = x.f[i] < 0.0
    anew(springs)
    list_closed(springs)


@compiled_inline
def end_springs(springs: ActiveSet, x: Motion) -> int:
    """Forces, jumps and largest openings of the springs at a step's end; see `find_active`."""
    turns, stored, found = find_active(springs), 0.0, springs.found
    for i in range(len(springs.k)):
        closed, stiffness = springs.closed[i], springs.k[i]
        force = min(found[i], 0.0) if closed else 0.0
        x.f[i], x.w[i, 0] = force, force / stiffness if closed else found[i]
        x.state[i, 0] = max(x.state[i, 0], x.w[i, 0])
        stored += force * force / stiffness
    x.energies[STORED] = 0.5 * stored
    return turns


@compiled_fast
def wrong_sign(springs: ActiveSet) -> float:
    """Largest wrong sign of what was found, over the largest jump."""
    wrong, most = 0.0, 0.0
    for i in range(len(springs.k)):
        part = springs.found[i]
        wrong = max(wrong, part / springs.k[i] if springs.closed[i] else -part)
        most = max(most, abs(springs.free[i]))
    return wrong / most


def springs_of(step: ReducedStep, k: FloatArray) -> ActiveSet:
    """Springs of stiffness k (q,), all open."""
    return active_set_of(step.newmark.end * step.condensed.S + np.diag(1.0 / k), k, WRONG)


@compiled_fast
def run_springs(
    model: OnSprings, springs: ActiveSet, x: Motion, sweep: Sweep,
    factors: FloatArray, to: Recorder,
) -> tuple[int, int, float]:  # fmt: skip
    """As `run_reduced`, J being the springs' jumps.

    `x` holds jumps w (q, 1), forces f (q,) and, as its state (q, 1), the largest openings.
    """
    n, steps, worst = len(x.u), len(to.row), 1
    begin_springs(springs, x)
    next_load(model.forces, factors[0], sweep.load0, sweep.load1)
    for s in range(-1, steps):  # -1: the forces at the start, for alpha_f, and the first prediction
        if s >= 0:
            turns = end_springs(springs, x)  # solve: the set of springs that push
            if turns < 0:
                return s, turns, wrong_sign(springs)
            worst = max(worst, turns)
        size = 0.0
        for i in range(len(springs.free)):
            springs.free[i] = 0.0
        for first in range(0, n, BLOCK):  # advance, and predict the next step
            last = min(first + BLOCK, n)
            _push(model, springs, x.f, sweep, first, last)
            if s >= 0:
                size += advance_range(model.newmark, model.diagonal, x, sweep, first, last)
            if s + 1 < steps:
                _begin(model, springs, x, sweep, factors[s + 2], first, last)
        if s < 0:
            continue
        if not np.isfinite(size):
            return s, -1, np.inf
        account(x, sweep)
        end_of_step(x, to, s)
    return steps, worst, 0.0
