"""Semi-smooth Newton on the jumps of an interface, all else being linear (see `condensed`).

The laws are piecewise smooth, so two or three turns reach rounding errors.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import apart, seldom
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.condensed import Condensed, residual
from ssilang.kernel.interface.copies import largest
from ssilang.kernel.interface.factors.changed import Changes
from ssilang.kernel.interface.factors.inverse import Inverse
from ssilang.kernel.interface.factors.kept import FORCING, Factors, new_factors, solve_tangent
from ssilang.kernel.interface.factors.krylov import Krylov
from ssilang.kernel.interface.factors.lu import LU
from ssilang.kernel.interface.laws.columns import (
    CLOSED_SHEAR,
    OPEN_SHEAR,
    LawCode,
    Parameter,
    Variable,
)
from ssilang.kernel.interface.projected import find_start, is_stiff, rubs, set_shares
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    Trial,
    interface_response,
    new_trial,
)

TOLERANCE = 1e-12  # of the largest jump or increment: what double precision leaves
PLAIN_TURNS = 12  # turns without line search
HOLDING_TURN = 16  # turn from which shear that jumps with the opening is held
MOST_TURNS = 60
HALVINGS = 12  # of a step in the line search
ACCEPTED = 1e-9  # residual at which an iteration that only rounding errors move is accepted
MOVED = 1e-14  # least step of Newton, relative to the jumps


class Workspace(NamedTuple):
    """Arrays of the iteration, that go on from step to step."""

    trial: Trial
    factors: Factors
    shares: FloatArray  # (n_points, d), see `projected`; NaN: not looked at yet


def workspace(shape: tuple[int, ...], q: int) -> Workspace:
    """Room for (n_points, d) local jumps and q jumps of pairs; nothing is factorised yet."""
    return Workspace(new_trial(shape, q), new_factors(shape, q), np.full(shape, np.nan))


@compiled
def workspace_at(works: Workspace, j: int) -> Workspace:
    """One of several workspaces that are stacked array by array."""
    t, x = works.trial, works.factors
    return Workspace(
        Trial(
            t.y0[j], t.y[j], t.delta[j], t.f[j], t.w[j], t.t[j], t.state[j], t.D[j], t.h[j],
            t.r[j], t.dy[j],
        ),
        Factors(
            x.tangents[j],
            LU(x.lu.A[j], x.lu.exchanges[j]),
            Inverse(
                x.inverse.Y[j], x.inverse.room[j], x.inverse.updates[j], x.inverse.matrix[j],
                x.inverse.rows[j], x.inverse.changes[j],
            ),
            Changes(x.changes.Z[j], x.changes.row[j], x.changes.held[j]),
            Krylov(x.krylov.V[j], x.krylov.asked[j], x.krylov.spent[j]),
        ),
        works.shares[j],
    )  # fmt: skip


@compiled
def release_shear(state: FloatArray, new: FloatArray) -> None:
    """End of an iteration: no shear is held any more."""
    for i in range(state.shape[0]):
        state[i, Variable.HELD] = 0.0
        new[i, Variable.HELD] = 0.0


@compiled
def hold_shear(joints: Joints, t: FloatArray, state: FloatArray) -> bool:
    """Hold the shear of points that lose it at once on opening; True if there are any.

    `t` are the tractions at the start of the step.
    """
    found, normal, p = False, t.shape[1] - 1, joints.p
    for i in range(state.shape[0]):
        bounded = p[i, Parameter.FROT] >= 0.0 or p[i, Parameter.SHEAR] == 1.0
        if joints.codes[i] == LawCode.SDM and not bounded and p[i, Parameter.FU] == 0.0:
            state[i, Variable.HELD] = CLOSED_SHEAR if t[i, normal] < 0.0 else OPEN_SHEAR
            found = True
    return found


@apart
@compiled
def _evaluate(joints: Joints, condensed: Condensed, now: InterfaceState, trial: Trial) -> float:
    """Tractions and forces at the increment y of the trial; the largest residual."""
    for i in range(len(trial.y)):
        trial.delta[i] = now.delta[i] + trial.y[i]
    interface_response(joints, now.state, trial.delta, trial)
    return residual(condensed, now, trial)


@seldom
@compiled
def _restart_held(joints: Joints, condensed: Condensed, now: InterfaceState, trial: Trial) -> float:
    """Start again with the shear held that a step's start has, where no other shear is possible."""
    interface_response(joints, now.state, now.delta, trial)
    if hold_shear(joints, trial.t, now.state):
        for i in range(len(trial.y)):
            trial.y[i] = trial.y0[i]
    return _evaluate(joints, condensed, now, trial)


@apart
@compiled
def solve_interface(
    joints: Joints, condensed: Condensed, now: InterfaceState, work: Workspace
) -> tuple[int, float]:
    """The increment `y` of the jumps, from a start value, with all that belongs to it, in `work`.

    Parameters
    ----------
    now : InterfaceState
        Start of the step; left as it is (`accept` makes the end the state).
    work : Workspace
        `trial.y0` and the start value of `trial.y` are read.

    Returns
    -------
    turns : int
        Newton turns, negative if it did not converge, 0 if the interface lost its stiffness.
    residual : float
        Of the last turn, relative to the jumps.
    """
    trial, y, dy, shares = work.trial, work.trial.y, work.trial.dy, work.shares
    if len(shares) and np.isnan(shares[0, 0]):
        if rubs(joints):
            set_shares(joints, condensed, shares)
        else:
            shares[0, 0] = 1.0  # looked at; the others stay no number, which is not stiff
    if is_stiff(shares):
        find_start(joints, condensed, now, trial, work.factors, shares)
    size = _evaluate(joints, condensed, now, trial)
    scale = max(largest(trial.y0), largest(now.delta), 1e-300)
    turns = -MOST_TURNS
    for turn in range(1, MOST_TURNS + 1):
        scale = max(scale, largest(y))
        if turn == HOLDING_TURN:
            size = _restart_held(joints, condensed, now, trial)
        if size <= TOLERANCE * scale:
            turns = turn
            break
        # Newton's direction
        for i in range(len(y)):
            dy[i] = -trial.r[i]
        enough = max(FORCING, 0.1 * TOLERANCE * scale / size)
        if not solve_tangent(joints, condensed, work.factors, trial.D, dy, enough):
            turns = 0
            break
        # step along it, halved after the first turns until the residual falls
        before, length = size, 1.0
        for halving in range(HALVINGS):
            for i in range(len(y)):
                y[i] += length * dy[i]
            size = _evaluate(joints, condensed, now, trial)
            if turn <= PLAIN_TURNS or size < before or halving == HALVINGS - 1:
                break
            for i in range(len(y)):
                y[i] -= length * dy[i]
            length *= 0.5
        if length * largest(dy) <= MOVED * scale and size <= ACCEPTED * scale:
            turns = turn
            break
    release_shear(now.state, trial.state)
    return turns, size / scale
