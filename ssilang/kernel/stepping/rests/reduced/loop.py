"""The compiled loop on coordinates: all modes of a small problem, or a reduced basis.

On the coordinates mass and stiffness are diagonal; the damping is a diagonal and, if that is not
all, `B^T sense B`, B with one row for each direction in which dashpots pull. Their forces phi stand
in a step as those of the interface do, and are linear: with `S = R P R^T` for the rows R = (J; B),
w the dashpots' velocities that the state of before brings and g = (1 - alpha_f) gamma / (beta dt),

    phi = E (w + g (y_B - S_BJ h)) ,   E = sense (1 + g S_BB sense)^-1

they are eliminated from the interface's compliance once for a step length. Supports may move: their
loads stand among the others, `lift` holds the jumps that they make.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import apart, seldom
from ssilang.kernel.base.compiled.compiler import compiled_fast, compiled_inline
from ssilang.kernel.interface.condensed import Condensed, condensed_of
from ssilang.kernel.interface.copies import copy_rows, copy_state
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
    diagonal_of,
    next_load,
    predict,
    sweep_of,
)
from ssilang.kernel.stepping.state import DAMPED, LOST, STORED, Motion, Recorder
from ssilang.kernel.stepping.verbs import advance, end_of_step

BLOCK = 128  # coordinates whose rows of Rt stay in the nearest cache


class Reduced(NamedTuple):
    """Diagonal matrices (r,), rows of the interface and of the dashpots, loads."""

    m: FloatArray
    c: FloatArray
    k: FloatArray
    Rt: FloatArray  # (r, q + d), columns of J and of B
    sense: FloatArray  # (d,)
    forces: FloatArray  # (n_loads, r)
    lift: FloatArray  # (q, n_loads), or no columns


class ReducedStep(NamedTuple):
    """What depends on dt."""

    newmark: Newmark
    diagonal: Diagonal
    condensed: Condensed  # the interface with the dashpots
    E: FloatArray  # (d, d)
    SJB: FloatArray  # (q, d)
    SBB: FloatArray  # (d, d)


class Dashpots(NamedTuple):
    """Velocities and accelerations of the dashpots, and what each step overwrites."""

    v: FloatArray  # (d,)
    a: FloatArray
    w: FloatArray  # (d,) velocities that the past brings
    phi: FloatArray  # (d,)
    z: FloatArray  # (d,) motions in the step
    y: FloatArray  # (q + d,) jumps and dashpots' motions under the loads alone
    h: FloatArray  # (q,) change of the joints' forces
    sweep: Sweep  # of the coordinates


def dashpots_of(v: FloatArray, a: FloatArray, q: int, r: int) -> Dashpots:
    """Dashpots (d,) beside q jumps, on r coordinates."""
    w, phi, z = (np.zeros(len(v)) for _ in range(3))
    return Dashpots(v, a, w, phi, z, np.zeros(q + len(v)), np.zeros(q), sweep_of(r))


def reduced_step(model: Reduced, n: Newmark, q: int) -> ReducedStep:
    """What steps of a scheme need; q rows are the interface's."""
    diagonal, rate = diagonal_of(n, model.m, model.c, model.k), n.damping
    S = model.Rt.T @ (diagonal.P[:, None] * model.Rt)
    SJB, SBB = np.ascontiguousarray(S[:q, q:]), np.ascontiguousarray(S[q:, q:])
    d = len(model.sense)
    E = model.sense[:, None] * np.linalg.inv(np.eye(d) + rate * SBB * model.sense)
    E = np.ascontiguousarray(0.5 * (E + E.T))
    own = condensed_of(S[:q, :q] - rate * SJB @ E @ SJB.T, n.end)
    return ReducedStep(n, diagonal, own, E, SJB, SBB)


@seldom
@compiled_fast
def _hold_back(step: ReducedStep, dashpots: Dashpots, q: int) -> None:
    """phi without a change of the joints' forces; takes its jumps off y."""
    n = step.newmark
    for i in range(len(dashpots.phi)):
        dashpots.w[i] = n.c_v * dashpots.v[i] + n.c_a * dashpots.a[i]
        dashpots.z[i] = dashpots.w[i] + n.damping * dashpots.y[q + i]
    copy_state(np.dot(step.E, dashpots.z), dashpots.phi)
    if q:
        moved = np.dot(step.SJB, dashpots.phi)
        for i in range(q):
            dashpots.y[i] -= moved[i]


@seldom
@compiled_fast
def _advance_dashpots(
    model: Reduced, step: ReducedStep, dashpots: Dashpots, h: FloatArray
) -> float:
    """phi and the dashpots' motion for the change h of the joints' forces; twice the loss."""
    n, q, z = step.newmark, len(h), dashpots.z
    if q:
        moved = np.dot(h, step.SJB)
        back = np.dot(step.E, moved)
        for i in range(len(moved)):
            dashpots.phi[i] -= n.damping * back[i]
            z[i] = dashpots.y[q + i] - moved[i]
    else:
        copy_state(dashpots.y, z)
    held, lost = np.dot(step.SBB, dashpots.phi), 0.0
    for i in range(len(z)):
        z[i] -= held[i]
        v = dashpots.v[i]
        dashpots.v[i], dashpots.a[i] = advance(n, z[i], v, dashpots.a[i])
        lost += model.sense[i] * z[i] * (v + dashpots.v[i])
    return lost


@compiled_fast
def _correct(
    model: Reduced, step: ReducedStep, f: FloatArray, phi: FloatArray, sweep: Sweep, first: int,
    last: int,
) -> None:  # fmt: skip
    """Increments of some coordinates under the joints' new forces f and the dashpots'."""
    end, q, Rt = step.newmark.end, len(f), model.Rt[first:last]
    du, old, P = sweep.du[first:last], sweep.g[first:last], step.diagonal.P[first:last]
    fours = len(du) // 4 * 4
    for i in range(0, fours, 4):  # four sums at a time: f is read less often
        a, b, c, d = 0.0, 0.0, 0.0, 0.0
        row0, row1, row2, row3 = Rt[i], Rt[i + 1], Rt[i + 2], Rt[i + 3]
        for j in range(q):
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
        for j in range(q):
            g += Rt[i, j] * f[j]
        _change_force(du, old, P, end, i, g)
    if len(phi):
        for i in range(len(du)):
            back = 0.0
            for j in range(len(phi)):
                back += Rt[i, q + j] * phi[j]
            du[i] -= P[i] * back


@compiled_fast
def _change_force(
    du: FloatArray, old: FloatArray, P: FloatArray, end: float, i: int, g: float
) -> None:
    """The increment of a coordinate whose joints' force becomes g."""
    du[i] -= P[i] * end * (g - old[i])
    old[i] = g


@compiled_inline
def _begin(
    model: Reduced, step: ReducedStep, x: Motion, sweep: Sweep, y: FloatArray, factors: FloatArray,
    first: int, last: int,
) -> None:  # fmt: skip
    """Loads and prediction of the next step on some coordinates; `y` gathers R du."""
    next_load(
        model.forces[:, first:last], factors, sweep.load0[first:last], sweep.load1[first:last]
    )
    predict(step.newmark, step.diagonal, x, sweep, 1.0, first, last)
    add_jumps(model.Rt[first:last], sweep.du[first:last], y)


@apart
@compiled_fast
def _end_and_begin(
    model: Reduced, step: ReducedStep, x: Motion, dashpots: Dashpots, work: FloatArray,
    factors: FloatArray, ends: bool,
) -> float:  # fmt: skip
    """End of a step under the joints' forces and prediction of the next, in one pass over Rt.

    `factors` are those of the loads at the end of the next step; none: there is none. Nothing
    `ends` before the first. `work` gathers that of each load on the increment.
    """
    n, size, coming, y, sweep = len(x.u), 0.0, len(factors) > 0, dashpots.y, dashpots.sweep
    for j in range(len(y)):
        y[j] = 0.0
    for first in range(0, n, BLOCK):
        last = min(first + BLOCK, n)
        _correct(model, step, x.f, dashpots.phi, sweep, first, last)
        if ends:
            size += advance_range(step.newmark, step.diagonal, x, sweep, first, last)
            for c in range(len(work)):
                for i in range(first, last):
                    work[c] += model.forces[c, i] * sweep.du[i]
        if coming:
            _begin(model, step, x, sweep, y, factors[0], first, last)
    if ends:
        account(x, sweep)
    return size


@compiled_fast
def run_reduced(
    model: Reduced, step: ReducedStep, joints: Joints, x: Motion, dashpots: Dashpots,
    room: Workspace, factors: FloatArray, to: Recorder,
) -> tuple[int, int, float]:  # fmt: skip
    """Steps between the rows of `factors`; see `state.Outcome` for the results.

    `x` and the rows hold coordinates; work of loads as in `run_interleaved`.
    """
    q, steps, worst = len(x.delta), len(to.row), 0
    d, trial, end, condensed = len(model.sense), room.trial, step.newmark.end, step.condensed
    sweep, h = dashpots.sweep, dashpots.h
    now = InterfaceState(x.delta, x.f, x.w, x.t, x.state)
    next_load(model.forces, factors[0], sweep.load0, sweep.load1)
    _end_and_begin(model, step, x, dashpots, h[:0], factors[1:2], False)
    for k in range(steps):
        # predict: jumps that supports make, forces of the dashpots
        for c in range(model.lift.shape[1]):
            for i in range(q):
                dashpots.y[i] += model.lift[i, c] * (factors[k + 1, c] - factors[k, c])
        if d:
            _hold_back(step, dashpots, q)
        if q:  # solve: Newton's method on the interface
            copy_state(dashpots.y[:q], trial.y0)
            copy_state(trial.y0, trial.y)
            turns, residual = solve_interface(joints, condensed, now, room)
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
            for i in range(q):
                h[i] = end * (trial.f[i] - x.f[i])
            accept(trial, now)
            if len(to.jumps):
                copy_rows(x.w, to.jumps[k])
        # advance and account: dashpots, then all coordinates, the next step's prediction with them
        if d:
            x.energies[DAMPED] += 0.5 * _advance_dashpots(model, step, dashpots, h)
        size = _end_and_begin(model, step, x, dashpots, to.work[0, k], factors[k + 2 : k + 3], True)
        for c in range(min(model.lift.shape[1], to.work.shape[2])):
            for i in range(q):
                to.work[1, k, c] += model.lift[i, c] * x.f[i]
        if not np.isfinite(size):
            return k, -1, np.inf
        if q:
            stored, lost = interface_energies(joints, x.w, x.t, x.state)
            x.energies[STORED], x.energies[LOST] = stored, lost
        end_of_step(x, to, k)
    return steps, worst, 0.0
