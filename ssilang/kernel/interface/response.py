"""Forces and stiffness of an interface by its jumps, compiled; tractions that conserve energy."""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart, seldom
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.copies import clear, copy_rows, copy_state
from ssilang.kernel.interface.laws.columns import N_STATE, LawCode, Parameter, Variable
from ssilang.kernel.interface.laws.point_laws import point_energies, respond
from ssilang.kernel.interface.laws.sdm_law import normal_energy, opening_loss


class Joints(NamedTuple):
    """The points of an interface, as compiled code takes them."""

    pairs: IntArray  # (n_points, m) pairs of facing nodes that each point interpolates
    B: FloatArray  # (n_points, d, m d) local jump of a point from the jumps of its pairs
    weights: FloatArray  # (n_points,)
    codes: IntArray  # (n_points,) laws (`LawCode`)
    p: FloatArray  # (n_points, N_PARAMETERS) their parameters, C-contiguous


class InterfaceState(NamedTuple):
    """What an interface is at the end of the last converged step."""

    delta: FloatArray  # (q,) jumps of the pairs
    f: FloatArray  # (q,) forces on them
    w: FloatArray  # (n_points, d) local jumps, normal last
    t: FloatArray  # (n_points, d) tractions, normal last
    state: FloatArray  # (n_points, N_STATE) internal variables of the laws


class Trial(NamedTuple):
    """The end of a step while it is iterated on: jumps that are tried, and what the laws give."""

    y0: FloatArray  # (q,) increments of the jumps under the forces of the start
    y: FloatArray  # (q,) increments that are tried
    delta: FloatArray  # (q,) jumps tried
    f: FloatArray  # (q,) forces
    w: FloatArray  # (n_points, d)
    t: FloatArray  # (n_points, d)
    state: FloatArray  # (n_points, N_STATE)
    D: FloatArray  # (n_points, d, d) tangents dt/dw
    h: FloatArray  # (q,) load that corrects the linear solution
    r: FloatArray  # (q,) residual
    dy: FloatArray  # (q,) Newton's direction
    # (n_points, d) tractions that are means over the step; f and D are theirs (no rows: those of
    # the end)
    mean: FloatArray


def new_trial(shape: tuple[int, ...], q: int, mean: bool = False) -> Trial:
    """Zeros for (n_points, d) local jumps and q jumps of pairs."""
    n_points, d = shape
    w, t, state = np.zeros(shape), np.zeros(shape), np.zeros((n_points, N_STATE))
    y0, y, delta, f, h, r, dy = (np.zeros(q) for _ in range(7))
    D, means = np.zeros((n_points, d, d)), np.zeros((n_points if mean else 0, d))
    return Trial(y0, y, delta, f, w, t, state, D, h, r, dy, means)


@compiled
def _jumps_of_two(joints: Joints, delta: FloatArray, w: FloatArray) -> None:
    """`local_jumps` of two pairs in the plane: lengths that are known take a fifth of the time."""
    pairs, B = joints.pairs, joints.B
    for p in range(B.shape[0]):
        first, second = 2 * pairs[p, 0], 2 * pairs[p, 1]
        x0, x1, x2, x3 = delta[first], delta[first + 1], delta[second], delta[second + 1]
        for i in range(2):
            w[p, i] = B[p, i, 0] * x0 + B[p, i, 1] * x1 + B[p, i, 2] * x2 + B[p, i, 3] * x3


@compiled
def _forces_of_two(joints: Joints, t: FloatArray, f: FloatArray) -> None:
    """Adds what `interface_forces` gives of two pairs in the plane."""
    pairs, B, weights = joints.pairs, joints.B, joints.weights
    for p in range(B.shape[0]):
        first, second = 2 * pairs[p, 0], 2 * pairs[p, 1]
        for i in range(2):
            force = weights[p] * t[p, i]
            f[first] += force * B[p, i, 0]
            f[first + 1] += force * B[p, i, 1]
            f[second] += force * B[p, i, 2]
            f[second + 1] += force * B[p, i, 3]


@compiled
def local_jumps(joints: Joints, delta: FloatArray, w: FloatArray) -> None:
    """Local jumps w (n_points, d) from pair jumps delta (q,)."""
    pairs, B = joints.pairs, joints.B
    n, d, width = B.shape
    if d == 2 and width == 4:
        _jumps_of_two(joints, delta, w)
        return
    for p in range(n):
        for i in range(d):
            total = 0.0
            for a in range(pairs.shape[1]):
                for j in range(d):
                    total += B[p, i, a * d + j] * delta[pairs[p, a] * d + j]
            w[p, i] = total


@compiled
def interface_forces(joints: Joints, t: FloatArray, f: FloatArray) -> None:
    """Forces f (q,) on the pair jumps from local tractions t (n_points, d)."""
    pairs, B, weights = joints.pairs, joints.B, joints.weights
    n, d, width = B.shape
    for i in range(f.shape[0]):
        f[i] = 0.0
    if d == 2 and width == 4:
        _forces_of_two(joints, t, f)
        return
    for p in range(n):
        for i in range(d):
            force = weights[p] * t[p, i]
            if force != 0.0:
                for a in range(pairs.shape[1]):
                    for j in range(d):
                        f[pairs[p, a] * d + j] += force * B[p, i, a * d + j]


@compiled_fast
def add_stiffness_forces(
    joints: Joints, c: float, D: FloatArray, x: FloatArray, f: FloatArray
) -> None:
    """`f += c K x` on pair jumps x (q,), K of the local tangents D (n_points, d, d)."""
    pairs, B = joints.pairs, joints.B
    n, d, _ = B.shape
    for p in range(n):
        for i in range(d):
            force = 0.0
            for k in range(d):
                if D[p, i, k] != 0.0:
                    jump = 0.0
                    for pair in range(pairs.shape[1]):
                        for j in range(d):
                            jump += B[p, k, pair * d + j] * x[pairs[p, pair] * d + j]
                    force += D[p, i, k] * jump
            if force != 0.0:
                force *= c * joints.weights[p]
                for pair in range(pairs.shape[1]):
                    for j in range(d):
                        f[pairs[p, pair] * d + j] += force * B[p, i, pair * d + j]


@compiled
def interface_stiffness(joints: Joints, D: FloatArray, K: FloatArray) -> None:
    """Dense stiffness K (q, q) from local tangents D (n_points, d, d)."""
    pairs, B, weights = joints.pairs, joints.B, joints.weights
    clear(K)
    for p in range(len(B)):
        add_point_stiffness(pairs[p], B[p], weights[p], D[p], K)


@compiled
def add_point_stiffness(
    pairs: IntArray, B: FloatArray, weight: float, D: FloatArray, K: FloatArray
) -> None:
    """`K += weight B^T D B` of one point."""
    d = len(B)
    for i in range(d):
        for j in range(d):
            value = weight * D[i, j]
            if value != 0.0:
                _add_product(pairs, B[i], B[j], value, d, K)


@compiled
def _add_product(
    pairs: IntArray, left: FloatArray, right: FloatArray, value: float, d: int, K: FloatArray
) -> None:
    for a in range(pairs.shape[0]):
        for i in range(d):
            row = pairs[a] * d + i
            part = value * left[a * d + i]
            if part != 0.0:
                for b in range(pairs.shape[0]):
                    for j in range(d):
                        K[row, pairs[b] * d + j] += part * right[b * d + j]


@compiled
def interface_response(joints: Joints, start: FloatArray, delta: FloatArray, end: Trial) -> None:
    """Jumps, tractions, new states, tangents and forces at the pair jumps delta, into `end`.

    `start` (n_points, N_STATE) are the states of the last converged step.
    """
    local_jumps(joints, delta, end.w)
    respond(joints.codes, end.w, start, joints.p, end.t, end.state, end.D)
    interface_forces(joints, end.t, end.f)


@compiled
def accept(trial: Trial, now: InterfaceState) -> None:
    """The end of a converged step becomes the state."""
    for i in range(len(trial.y)):
        now.delta[i] += trial.y[i]
    copy_state(trial.f, now.f)
    copy_rows(trial.w, now.w)
    copy_rows(trial.t, now.t)
    copy_rows(trial.state, now.state)


@apart
@compiled
def interface_energies(
    joints: Joints, w: FloatArray, t: FloatArray, state: FloatArray
) -> tuple[float, float]:
    """Stored energy and energy lost so far of the whole interface (joules)."""
    found, stored, lost = np.empty((2, w.shape[0])), 0.0, 0.0
    point_energies(joints.codes, w, t, state, joints.p, found)
    for i in range(w.shape[0]):
        stored += joints.weights[i] * found[0, i]
        lost += joints.weights[i] * found[1, i]
    return stored, lost


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
def _mean_point(joints: Joints, now: InterfaceState, end: Trial, point: int) -> None:
    """A point's mean traction tm, its tangent dtm/dw, the loss by its work, in place."""
    p, state, new, D = joints.p[point], now.state[point], end.state[point], end.D[point]
    w0, t0, w1, t1, tm = now.w[point], now.t[point], end.w[point], end.t[point], end.mean[point]
    n = w0.shape[0] - 1
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
    straight = before == after and after != OPENING
    if straight or abs(k * step) <= TINY * max(abs(t0[n]), abs(t1[n])):
        return
    # elsewhere work over path; its tangent is kept below that which Newton could not leave
    fu, gf = p[Parameter.FU], p[Parameter.GF]
    work = normal_energy(w1[n], t1[n], xi1, k, fc) + opening_loss(xi1, fu, gf)
    work -= normal_energy(w0[n], t0[n], xi0, k, fc) + opening_loss(xi0, fu, gf)
    tm[n] = work / step
    D[n, n] = (t1[n] - tm[n]) / step
    if D[n, n] > 0.5 * k and slope == 0.0:
        D[n, n] = 0.5 * k


@seldom
@compiled
def mean_response(joints: Joints, now: InterfaceState, end: Trial) -> None:
    """Mean tractions of a step, from its end as `interface_response` leaves it, with D and f."""
    for i in range(end.w.shape[0]):
        _mean_point(joints, now, end, i)
    interface_forces(joints, end.mean, end.f)
