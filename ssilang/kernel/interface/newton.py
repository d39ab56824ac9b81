"""Semi-smooth Newton on the jumps of an interface, all else being linear (see `condensed`).

The laws are piecewise smooth, so two or three turns reach rounding errors.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart, seldom
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.condensed import LAST_DIGITS, Condensed, residual
from ssilang.kernel.interface.copies import copy_rows, copy_state, largest
from ssilang.kernel.interface.factors.inverse import VANISHING, solve_small
from ssilang.kernel.interface.factors.kept import (
    FORCING,
    Factors,
    has_tangents,
    new_factors,
    solve_tangent,
)
from ssilang.kernel.interface.laws.columns import (
    CLOSED_SHEAR,
    OPEN_SHEAR,
    LawCode,
    Parameter,
    Variable,
)
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    Trial,
    interface_forces,
    interface_response,
    local_jumps,
    mean_response,
    new_trial,
)

# A start for Newton's method where joints are stiff and rub: forces that are projected.
#
# Newton's method on jumps w takes tractions from them, `t = law(w)`, so stiff joints overshoot
# and points go on changing sides. Coulomb's law without tension is a projection, whose solution
# is the same for any r > 0 (Alart and Curnier 1991): with k the joint's stiffness and s its slip,
#
# t = law(w') , w' = w - (1 - rho) (w - s - t/k) , rho = r/k
#
# With r the stiffness of all else as a point feels it, the points that are open or slide are
# found in two to four turns. Jumps and tractions are both unknown; with D = dt/dw' and F = t -
# law(w'),
#
# dt = D' B dy - G^-1 F , G = 1 - D (1 - rho)/k , D' = G^-1 D rho
#
# and what is solved for dy is Newton's matrix of the tangents D'.

DIRECTED = 1e-8  # residual of an iterated direction: forces of stiff points need digits
STIFF = 0.5  # rho under which points are stiff


@compiled_fast
def _compliance(S: FloatArray, pairs: IntArray, b: FloatArray, d: int) -> float:
    """b S b^T of one row (m d,) of a point's local jumps."""
    total = 0.0
    for a in range(len(b)):
        if b[a] != 0.0:
            row = S[pairs[a // d] * d + a % d]
            for e in range(len(b)):
                total += b[a] * row[pairs[e // d] * d + e % d] * b[e]
    return total


@compiled
def rubs(joints: Joints) -> bool:
    """Whether any point has a bound by friction."""
    for i in range(len(joints.p)):  # noqa: SIM110
        if joints.p[i, Parameter.FROT] >= 0.0:
            return True
    return False


@seldom
@compiled
def set_shares(joints: Joints, condensed: Condensed, rho: FloatArray) -> None:
    """Shares rho (n_points, d) of the joints' own stiffness: 1 of points that are no projections.

    Directions of shear have one, or slip and shear would not stay along each other.
    """
    p, c = joints.p, condensed.c
    n, d, _ = joints.B.shape
    for i in range(n):
        plain = joints.codes[i] == LawCode.SDM and p[i, Parameter.SHEAR] != 1.0
        plain = plain and p[i, Parameter.FU] == 0.0 and p[i, Parameter.FC] == 0.0
        plain = plain and p[i, Parameter.FROT] >= 0.0
        shear = 1.0
        for j in range(d):
            rho[i, j] = 1.0
            k = p[i, Parameter.KN] if j == d - 1 else p[i, Parameter.KS1 + j]
            if plain and k > 0.0:
                felt = c * joints.weights[i] * k
                felt *= _compliance(condensed.S, joints.pairs[i], joints.B[i, j], d)
                rho[i, j] = 1.0 / max(1.0, felt)
                if j < d - 1:
                    shear = min(shear, rho[i, j])
        for j in range(d - 1):
            rho[i, j] = shear if p[i, Parameter.KS1 + j] > 0.0 else 1.0


@compiled
def is_stiff(rho: FloatArray) -> bool:
    """Whether there are stiff points among those that rub."""
    for i in range(len(rho)):
        for j in range(rho.shape[1]):
            if rho[i, j] < STIFF:
                return True
    return False


@compiled_fast
def _shift(
    joints: Joints, now: InterfaceState, rho: FloatArray, t: FloatArray, w: FloatArray
) -> None:
    """w becomes w', in place."""
    p, d = joints.p, w.shape[1]
    for i in range(len(w)):
        for j in range(d):
            if rho[i, j] < 1.0:
                k, slip = p[i, Parameter.KN], 0.0
                if j < d - 1:
                    k, slip = p[i, Parameter.KS1 + j], now.state[i, Variable.SLIP1 + j]
                w[i, j] -= (1.0 - rho[i, j]) * (w[i, j] - slip - t[i, j] / k)


@compiled
def _tangents(joints: Joints, rho: FloatArray, D: FloatArray, F: FloatArray) -> bool:
    """D becomes D', F becomes G^-1 F; False if one is singular."""
    p, d = joints.p, D.shape[1]
    G, X = np.zeros((d, d)), np.zeros((d, d + 1))
    for i in range(len(D)):
        own = True
        for j in range(d):
            own = own and rho[i, j] == 1.0
        if own:
            continue
        for a in range(d):
            X[a, d] = F[i, a]
            for j in range(d):
                k = p[i, Parameter.KN] if j == d - 1 else p[i, Parameter.KS1 + j]
                G[a, j] = 1.0 if a == j else 0.0
                if rho[i, j] < 1.0:
                    G[a, j] -= D[i, a, j] * (1.0 - rho[i, j]) / k
                X[a, j] = D[i, a, j] * rho[i, j]
        if not solve_small(G, X, VANISHING):
            return False
        for a in range(d):
            F[i, a] = X[a, d]
            for j in range(d):
                D[i, a, j] = X[a, j]
    return True


@seldom
@compiled
def find_start(
    joints: Joints, condensed: Condensed, now: InterfaceState, trial: Trial, factors: Factors,
    rho: FloatArray,
) -> int:  # fmt: skip
    """The start value `trial.y`: turns it took; 0, and `trial.y` as it was, if none was found."""
    n, d = trial.w.shape
    t, F, w = np.empty((n, d)), np.empty((n, d)), np.empty((n, d))
    begin = np.empty(len(trial.y))
    copy_rows(now.t, t)
    copy_state(trial.y, begin)
    for turn in range(1, MOST_TURNS + 1):
        for i in range(len(trial.y)):
            trial.delta[i] = now.delta[i] + trial.y[i]
        local_jumps(joints, trial.delta, w)
        _shift(joints, now, rho, t, w)
        respond(joints.codes, w, now.state, joints.p, trial.t, trial.state, trial.D)
        size, top = 0.0, 0.0
        for i in range(n):
            for j in range(d):
                F[i, j] = t[i, j] - trial.t[i, j]
                size, top = max(size, abs(F[i, j])), max(top, abs(t[i, j]))
        if size <= LAST_DIGITS * top:
            return turn
        if not _tangents(joints, rho, trial.D, F):
            break
        for i in range(n):
            for j in range(d):
                t[i, j] -= F[i, j]
        interface_forces(joints, t, trial.f)
        residual(condensed, now, trial)
        for i in range(len(trial.y)):
            trial.dy[i] = -trial.r[i]
        if not solve_tangent(joints, condensed, factors, trial.D, trial.dy, DIRECTED):
            break
        for i in range(len(trial.y)):
            trial.y[i] += trial.dy[i]
        local_jumps(joints, trial.dy, w)
        for i in range(n):
            for j in range(d):
                for a in range(d):
                    t[i, j] += trial.D[i, j, a] * w[i, a]
    copy_state(begin, trial.y)
    return 0


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


def workspace(
    shape: tuple[int, ...], q: int, mean: bool = False, single: bool = False
) -> Workspace:
    """Room for (n_points, d) local jumps and q jumps of pairs; nothing is factorised yet.

    Steps of `mean` tractions have no start by projected ones; `single` is the precision of factors.
    """
    shares = np.full(shape, 1.0 if mean else np.nan)
    return Workspace(new_trial(shape, q, mean), new_factors(shape, q, single=single), shares)


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
def evaluate(joints: Joints, condensed: Condensed, now: InterfaceState, trial: Trial) -> float:
    """Tractions and forces at the increment y of the trial; the largest residual."""
    for i in range(len(trial.y)):
        trial.delta[i] = now.delta[i] + trial.y[i]
    interface_response(joints, now.state, trial.delta, trial)
    if len(trial.mean):
        mean_response(joints, now, trial)
    return residual(condensed, now, trial)


@seldom
@compiled
def _restart_held(joints: Joints, condensed: Condensed, now: InterfaceState, trial: Trial) -> float:
    """Start again with the shear held that a step's start has, where no other shear is possible."""
    interface_response(joints, now.state, now.delta, trial)
    if hold_shear(joints, trial.t, now.state):
        copy_state(trial.y0, trial.y)
    return evaluate(joints, condensed, now, trial)


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
    elif has_tangents(condensed, work.factors) and len(trial.mean) == 0:
        # starts where the last tangents lead, which is the end if no point changes
        solve_tangent(joints, condensed, work.factors, trial.D, y, FORCING)
    size = evaluate(joints, condensed, now, trial)
    scale = max(largest(trial.y0), largest(now.delta), 1e-300)
    turns = -MOST_TURNS
    for turn in range(1, MOST_TURNS + 1):
        scale = max(scale, largest(y))
        if turn == HOLDING_TURN:
            size = _restart_held(joints, condensed, now, trial)
        if size <= condensed.tolerance * scale:
            turns = turn
            break
        # Newton's direction
        for i in range(len(y)):
            dy[i] = -trial.r[i]
        enough = max(FORCING, 0.1 * condensed.tolerance * scale / size)
        if not solve_tangent(joints, condensed, work.factors, trial.D, dy, enough):
            turns = 0
            break
        # step along it, halved after the first turns until the residual falls
        before, length = size, 1.0
        for halving in range(HALVINGS):
            for i in range(len(y)):
                y[i] += length * dy[i]
            size = evaluate(joints, condensed, now, trial)
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
