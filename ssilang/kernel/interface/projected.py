"""A start for Newton's method where joints are stiff and rub: forces that are projected.

Newton's method on jumps w takes tractions from them, `t = law(w)`, so stiff joints overshoot and
points go on changing sides. Coulomb's law without tension is a projection, whose solution is the
same for any r > 0 (Alart and Curnier 1991): with k the joint's stiffness and s its slip,

    t = law(w') ,   w' = w - (1 - rho) (w - s - t/k) ,   rho = r/k

With r the stiffness of all else as a point feels it, the points that are open or slide are found
in two to four turns. Jumps and tractions are both unknown; with D = dt/dw' and F = t - law(w'),

    dt = D' B dy - G^-1 F ,   G = 1 - D (1 - rho)/k ,   D' = G^-1 D rho

and what is solved for dy is Newton's matrix of the tangents D'.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.condensed import Condensed, residual
from ssilang.kernel.interface.copies import copy_rows, copy_state
from ssilang.kernel.interface.factors.inverse import VANISHING, solve_small
from ssilang.kernel.interface.factors.kept import FORCING, Factors, solve_tangent
from ssilang.kernel.interface.laws.columns import LawCode, Parameter, Variable
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    Trial,
    interface_forces,
    local_jumps,
)

MOST_TURNS = 12
TOLERANCE = 1e-8  # of the largest traction: Newton's method goes on from there
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
        if size <= TOLERANCE * top:
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
        if not solve_tangent(joints, condensed, factors, trial.D, trial.dy, FORCING):
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
