"""Mean traction of a step: what the energy-conserving scheme takes in place of the traction.

The normal traction is `t* = (W(w_1) - W(w_0))/(w_1 - w_0)`, W being the work of the law from the
state of the last converged step (stored energy plus what opening spends): the exact mean along a
monotone path, so that work and energy balance to rounding at any step. Shear takes the mean of
both ends; what that leaves over stored energy counts as lost in shear.
"""

from __future__ import annotations

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.laws.columns import FC, FU, GF, KN, SHEAR_ENERGY, SHEAR_LOSS, XI
from ssilang.kernel.interface.laws.point_laws import point_response
from ssilang.kernel.interface.laws.sdm_law import normal_energy, opening_loss
from ssilang.kernel.interface.response import interface_forces, local_jumps

TINY = 1e-6  # step (as a share of the tractions) below which the mean of both ends is as good


@compiled
def _branch(w: float, xi: float, new_xi: float, k: float, fc: float) -> int:
    """0 closed, 1 closing or open and free, 2 open elastic, 3 opening further."""
    if new_xi != xi:
        return 3
    if w > xi:
        return 2
    return 0 if k * w <= fc else 1


@compiled
def mean_point(
    code: int,
    w0: FloatArray,
    t0: FloatArray,
    state: FloatArray,
    w1: FloatArray,
    p: FloatArray,
    t1: FloatArray,
    new: FloatArray,
    tm: FloatArray,
    D: FloatArray,
) -> None:
    """End traction t1, new state, mean traction tm and its tangent D = dtm/dw1, in place."""
    n = w0.shape[0] - 1
    point_response(code, w1, state, p, t1, new, D)
    slope = D[n, n]
    work = 0.0
    for i in range(n + 1):
        tm[i] = 0.5 * (t0[i] + t1[i])
        for j in range(n + 1):
            D[i, j] *= 0.5
        if i < n:
            work += tm[i] * (w1[i] - w0[i])
    if code != 1:
        return
    new[SHEAR_LOSS] = state[SHEAR_LOSS] + work - (new[SHEAR_ENERGY] - state[SHEAR_ENERGY])
    k, fc = p[KN], p[FC]
    before = _branch(w0[n], state[XI], state[XI], k, fc)
    after = _branch(w1[n], state[XI], new[XI], k, fc)
    step = w1[n] - w0[n]
    if before == after and after != 3:
        return
    if abs(k * step) <= TINY * max(abs(t0[n]), abs(t1[n])) or step == 0.0:
        return
    start = normal_energy(w0[n], t0[n], state[XI], k, fc) + opening_loss(state[XI], p[FU], p[GF])
    end = normal_energy(w1[n], t1[n], new[XI], k, fc) + opening_loss(new[XI], p[FU], p[GF])
    tm[n] = (end - start) / step
    D[n, n] = (t1[n] - tm[n]) / step
    if D[n, n] > 0.5 * k and slope == 0.0:
        D[n, n] = 0.5 * k


@compiled
def mean_response(
    pairs: IntArray,
    B: FloatArray,
    weights: FloatArray,
    codes: IntArray,
    p: FloatArray,
    w0: FloatArray,
    t0: FloatArray,
    state: FloatArray,
    delta: FloatArray,
    w1: FloatArray,
    t1: FloatArray,
    new: FloatArray,
    tm: FloatArray,
    D: FloatArray,
    f: FloatArray,
) -> None:
    """Mean tractions, their tangents and forces f (size,) for end jumps delta, in place."""
    local_jumps(pairs, B, delta, w1)
    for i in range(w1.shape[0]):
        mean_point(codes[i], w0[i], t0[i], state[i], w1[i], p[i], t1[i], new[i], tm[i], D[i])
    interface_forces(pairs, B, weights, tm, f)
