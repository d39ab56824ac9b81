"""Mean traction of a step: what the energy-conserving scheme takes in place of the traction.

The normal traction is `t* = (W(w_1) - W(w_0))/(w_1 - w_0)`, W being the work of the law from the
state of the last converged step (stored energy plus what opening spends): the exact mean along a
monotone path, so that work and energy balance to rounding at any step. Shear takes the mean of
both ends; what that leaves over stored energy counts as lost in shear.
"""

from __future__ import annotations

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.laws.columns import LawCode, Parameter, Variable
from ssilang.kernel.interface.laws.point_laws import point_response
from ssilang.kernel.interface.laws.sdm_law import normal_energy, opening_loss
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    Trial,
    interface_forces,
    local_jumps,
)

TINY = 1e-6  # step (as a share of the tractions) below which the mean of both ends is as good
CLOSED, CLOSING, OPEN, OPENING = range(4)  # CLOSING: also free, OPEN: elastic in tension


@compiled
def _branch(w: float, xi: float, new_xi: float, k: float, fc: float) -> int:
    """The straight line on which a point is, or that it opens further."""
    if new_xi != xi:
        return OPENING
    if w > xi:
        return OPEN
    return CLOSED if k * w <= fc else CLOSING


@compiled
def _mean_point(
    joints: Joints, now: InterfaceState, end: Trial, tm: FloatArray, point: int
) -> None:
    """A point's end traction and state, mean traction tm and its tangent dtm/dw, in place."""
    p, state, new, D = joints.p[point], now.state[point], end.state[point], end.D[point]
    w0, t0, w1, t1 = now.w[point], now.t[point], end.w[point], end.t[point]
    n = w0.shape[0] - 1
    point_response(joints.codes[point], w1, state, p, t1, new, D)
    slope = D[n, n]
    # shear, and whatever has no energy of its own: the mean of both ends
    work = 0.0
    for i in range(n + 1):
        tm[i] = 0.5 * (t0[i] + t1[i])
        for j in range(n + 1):
            D[i, j] *= 0.5
        if i < n:
            work += tm[i] * (w1[i] - w0[i])
    if joints.codes[point] != LawCode.SDM:
        return
    stored = new[Variable.SHEAR_ENERGY] - state[Variable.SHEAR_ENERGY]
    new[Variable.SHEAR_LOSS] = state[Variable.SHEAR_LOSS] + work - stored
    # the mean of both ends is exact too where the law is a straight line between them
    k, fc, xi0, xi1 = p[Parameter.KN], p[Parameter.FC], state[Variable.XI], new[Variable.XI]
    before, after = _branch(w0[n], xi0, xi0, k, fc), _branch(w1[n], xi0, xi1, k, fc)
    step = w1[n] - w0[n]
    if before == after and after != OPENING:
        return
    if abs(k * step) <= TINY * max(abs(t0[n]), abs(t1[n])) or step == 0.0:
        return
    # elsewhere work over path; its tangent is kept below that which Newton could not leave
    fu, gf = p[Parameter.FU], p[Parameter.GF]
    work = normal_energy(w1[n], t1[n], xi1, k, fc) + opening_loss(xi1, fu, gf)
    work -= normal_energy(w0[n], t0[n], xi0, k, fc) + opening_loss(xi0, fu, gf)
    tm[n] = work / step
    D[n, n] = (t1[n] - tm[n]) / step
    if D[n, n] > 0.5 * k and slope == 0.0:
        D[n, n] = 0.5 * k


@compiled
def mean_response(
    joints: Joints, now: InterfaceState, delta: FloatArray, end: Trial, tm: FloatArray
) -> None:
    """Mean tractions tm (n_points, d) of a step that ends at the pair jumps delta, into `end`.

    There w, t and state are those of the end; D are tangents of the mean tractions, f (q,) their
    forces.
    """
    local_jumps(joints, delta, end.w)
    for i in range(end.w.shape[0]):
        _mean_point(joints, now, end, tm[i], i)
    interface_forces(joints, tm, end.f)
