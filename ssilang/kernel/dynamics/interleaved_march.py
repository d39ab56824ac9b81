"""The time loop of large problems, compiled: one passage over the factor a step.

Unknowns are q with `u = T q`, in the order of the factor of `A = T^T A T`, the interface's last.
Equilibrium at the start of a step replaces the product with the stiffness. With the out-of-balance
forces `g = K q + C q' + J^T f - F`, one of whose parts the scheme makes vanish,

    (1 - alpha_f) g_1 + alpha_f g_0 + (1 - alpha_m) M a_1 + alpha_m M a_0 = 0

    A dq + (1 - alpha_f) J^T df = b = - g_0 + (1 - alpha_f) dF
        + (1 - alpha_m) M (v_0/(beta dt) + (1/(2 beta) - 1) a_0) - alpha_m M a_0
        + (1 - alpha_f) C (gamma/beta v_0 - dt (1 - gamma/(2 beta)) a_0)

so that a step needs `M dq` and, with damping, `C dq` alone. The forward solve ends at the
interface, where its unknowns alone are iterated on; the backward solve starts from what they
became. A branch of the elimination tree that fits in the processor's cache goes backward, takes
its new velocities and right side, and goes forward for the next step before the next branch is
read: the factor comes from memory once a step, not twice.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.compiled import compiled, compiled_fast
from ssilang.kernel.dynamics.compiled_loop import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
    Joints,
)
from ssilang.kernel.joints.condensed_cached import Workspace, iterate_cached
from ssilang.kernel.joints.response import interface_energies
from ssilang.kernel.mesh.nodes import FloatArray, IntArray
from ssilang.kernel.solvers.multifrontal import Panels
from ssilang.kernel.solvers.triangular import backward, forward


class Sparse(NamedTuple):
    """Rows of a sparse matrix; `diagonal` says that `data` is its diagonal alone."""

    indptr: IntArray
    indices: IntArray
    data: FloatArray
    diagonal: bool


class Plan(NamedTuple):
    """What does not change during the steps of one dt.

    Attributes
    ----------
    L : Panels
    branches : array (m, 2)
        First and last supernode of branches that fit in the cache.
    trunk : array (p,)
        The other supernodes but the interface's, increasing.
    root : int
        The interface's supernode, or the number of supernodes without interface.
    M, C : Sparse
    damped : bool
    forces : array (k, n)
    Jr, Yr : arrays (q, r), (r, q)
        Jumps of the root's unknowns, and their motions under forces on the jumps.
    S, R : arrays (q, q)
        Compliance of the interface, stiffness of it that A holds (no rows: none).
    scheme : tuple
        alpha_m, alpha_f, beta, gamma, dt.
    room : int
        Length of the longest supernode.
    """

    L: Panels
    branches: IntArray
    trunk: IntArray
    root: int
    M: Sparse
    C: Sparse
    damped: bool
    forces: FloatArray
    Jr: FloatArray
    Yr: FloatArray
    S: FloatArray
    R: FloatArray
    scheme: tuple[float, float, float, float, float]
    room: int


class Flow(NamedTuple):
    """State that the steps change in place; u to Ca are (n,), all on the unknowns q.

    `g` are the out-of-balance forces, `Mv` to `Ca` products of mass and damping with the motion,
    `loads` (k,) the work `forces u` of each load.
    """

    u: FloatArray
    v: FloatArray
    a: FloatArray
    g: FloatArray
    Mv: FloatArray
    Ma: FloatArray
    Cv: FloatArray
    Ca: FloatArray
    loads: FloatArray
    delta: FloatArray
    f: FloatArray
    w: FloatArray
    t: FloatArray
    state: FloatArray
    energies: FloatArray


class Kept(NamedTuple):
    """Rows for saved steps."""

    u: FloatArray
    v: FloatArray
    a: FloatArray
    f: FloatArray
    w: FloatArray
    t: FloatArray
    state: FloatArray


@compiled_fast
def _row(A: Sparse, i: int, x: FloatArray) -> float:
    total = 0.0
    for k in range(A.indptr[i], A.indptr[i + 1]):
        total += A.data[k] * x[A.indices[k]]
    return total


@compiled_fast
def right_side(
    plan: Plan, flow: Flow, rise: FloatArray, begin: int, end: int, b: FloatArray
) -> None:
    """b of the next step; `rise` (k,) are the increments of the load factors."""
    am, af, beta, gamma, dt = plan.scheme
    by_v, by_a = (1 - am) / (beta * dt), (1 - am) * (0.5 / beta - 1) - am
    by_cv, by_ca = (1 - af) * gamma / beta, -(1 - af) * dt * (1 - 0.5 * gamma / beta)
    for i in range(begin, end):
        b[i] = by_v * flow.Mv[i] + by_a * flow.Ma[i] - flow.g[i]
    if plan.damped:
        for i in range(begin, end):
            b[i] += by_cv * flow.Cv[i] + by_ca * flow.Ca[i]
    for c in range(len(rise)):
        if rise[c] != 0.0:
            part = (1 - af) * rise[c]
            for i in range(begin, end):
                b[i] += part * plan.forces[c, i]


@compiled_fast
def _advance(
    plan: Plan, flow: Flow, du: FloatArray, begin: int, end: int, sums: FloatArray
) -> None:
    """Motion, products and out-of-balance forces after the increment, on a range of unknowns.

    `sums` gather v.Mv, u.g, u.Cv, du.(Cv_0 + Cv_1), and something finite if all is.
    """
    am, af, beta, gamma, dt = plan.scheme
    v_u, v_v, v_a = gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    a_u, a_v, a_a = 1 / (beta * dt * dt), -1 / (beta * dt), 1 - 0.5 / beta
    g_g, g_1, g_0 = -af / (1 - af), -(1 - am) / (1 - af), -am / (1 - af)
    kinetic, static, size = 0.0, 0.0, 0.0
    for i in range(begin, end):
        x, v0, a0, Ma0 = du[i], flow.v[i], flow.a[i], flow.Ma[i]
        flow.u[i] += x
        flow.v[i] = v_u * x + v_v * v0 + v_a * a0
        flow.a[i] = (x / dt - v0) / (beta * dt) + a_a * a0
        if plan.M.diagonal:
            flow.Mv[i], flow.Ma[i] = plan.M.data[i] * flow.v[i], plan.M.data[i] * flow.a[i]
        else:
            Mx, Mv0 = _row(plan.M, i, du), flow.Mv[i]
            flow.Mv[i] = v_u * Mx + v_v * Mv0 + v_a * Ma0
            flow.Ma[i] = (Mx / dt - Mv0) / (beta * dt) + a_a * Ma0
        flow.g[i] = g_g * flow.g[i] + g_1 * flow.Ma[i] + g_0 * Ma0
        kinetic += flow.v[i] * flow.Mv[i]
        static += flow.u[i] * flow.g[i]
        size += abs(flow.u[i])
    sums[0] += kinetic
    sums[1] += static
    sums[4] += size
    if plan.damped:
        for i in range(begin, end):
            Cx, Cv0, Ca0 = _row(plan.C, i, du), flow.Cv[i], flow.Ca[i]
            flow.Cv[i] = v_u * Cx + v_v * Cv0 + v_a * Ca0
            flow.Ca[i] = a_u * Cx + a_v * Cv0 + a_a * Ca0
            sums[2] += flow.u[i] * flow.Cv[i]
            sums[3] += du[i] * (Cv0 + flow.Cv[i])


@compiled_fast
def _work(plan: Plan, du: FloatArray, begin: int, end: int, work: FloatArray) -> None:
    """work += forces du on a range of unknowns."""
    for c in range(plan.forces.shape[0]):
        total = 0.0
        for i in range(begin, end):
            total += plan.forces[c, i] * du[i]
        work[c] += total


@compiled
def _trunk_forward(plan: Plan, b: FloatArray, above: FloatArray, local: FloatArray) -> None:
    """Forward solve of the trunk, with what the branches added to its rows."""
    for s in plan.trunk:
        for i in range(plan.L.first[s], plan.L.first[s + 1]):
            b[i] += above[i]
            above[i] = 0.0
        forward(plan.L, s, s + 1, b, 0, above, local)


@compiled
def _interface(
    plan: Plan, joints: Joints, flow: Flow, newton: Workspace, b: FloatArray, above: FloatArray,
    du: FloatArray, local: FloatArray,
) -> tuple[int, float]:  # fmt: skip
    """Increment of the root's unknowns; the joints' state becomes that of the step's end."""
    L, s = plan.L, plan.root
    begin, end = L.first[s], L.first[s + 1]
    for i in range(begin, end):
        b[i] += above[i]
        above[i] = 0.0
    forward(L, s, s + 1, b, 0, above, local)
    backward(L, s, s + 1, b, du, local)
    y0 = np.dot(plan.Jr, du[begin:end])
    y = y0.copy()
    turns, residual = iterate_cached(
        joints.pairs, joints.B, joints.weights, joints.codes, joints.p, plan.S, plan.R,
        1 - plan.scheme[1], flow.delta, flow.f, flow.state, y0, y, flow.w, flow.t, newton.new,
        newton.D, newton.f, newton.h, newton.r, newton.dy, newton.delta, newton.K, newton.A,
        newton.known, newton.pivots,
    )  # fmt: skip
    if turns > 0:
        du[begin:end] -= np.dot(plan.Yr, newton.h)
        flow.delta[:] += y
        flow.f[:] = newton.f
        flow.state[:, :] = newton.new
    return turns, residual


@compiled
def _save(flow: Flow, kept: Kept, row: int) -> None:
    kept.u[row], kept.v[row], kept.a[row], kept.f[row] = flow.u, flow.v, flow.a, flow.f
    kept.w[row], kept.t[row], kept.state[row] = flow.w, flow.t, flow.state


@compiled
def _account(
    plan: Plan, joints: Joints, flow: Flow, sums: FloatArray, work: FloatArray,
    factors: FloatArray, k: int,
) -> None:  # fmt: skip
    """Energies at the end of step k, from equilibrium: K u = g - C v - J^T f + F."""
    elastic = sums[1] - sums[2]
    for c in range(len(work)):
        flow.loads[c] += work[c]
        elastic += factors[k + 1, c] * flow.loads[c]
        flow.energies[EXTERNAL] += 0.5 * (factors[k, c] + factors[k + 1, c]) * work[c]
    for i in range(len(flow.f)):
        elastic -= flow.delta[i] * flow.f[i]
    flow.energies[KINETIC], flow.energies[ELASTIC] = 0.5 * sums[0], 0.5 * elastic
    flow.energies[DAMPED] += 0.5 * sums[3]
    if len(flow.f):
        stored, lost = interface_energies(
            joints.codes, joints.p, joints.weights, flow.w, flow.t, flow.state
        )
        flow.energies[STORED], flow.energies[LOST] = stored, lost


@compiled
def march_interleaved(
    plan: Plan, joints: Joints, flow: Flow, newton: Workspace, factors: FloatArray, save: IntArray,
    kept: Kept, history: FloatArray,
) -> tuple[int, int, float]:  # fmt: skip
    """Steps between the rows of `factors`; see `compiled_loop.march` for the results."""
    L, n, steps, worst = plan.L, len(flow.u), len(save), 1
    b, du, above, local = np.empty(n), np.zeros(n), np.zeros(n), np.empty(plan.room)
    sums, work = np.zeros(5), np.zeros(plan.forces.shape[0])
    right_side(plan, flow, factors[1] - factors[0], 0, n, b)
    for j in range(len(plan.branches)):
        s0, s1 = plan.branches[j]
        forward(L, s0, s1, b, L.first[s1], above, local)
    for k in range(steps):
        _trunk_forward(plan, b, above, local)
        if len(flow.f):
            turns, residual = _interface(plan, joints, flow, newton, b, above, du, local)
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
        for j in range(len(plan.trunk) - 1, -1, -1):
            s = plan.trunk[j]
            backward(L, s, s + 1, b, du, local)
        sums[:], work[:] = 0.0, 0.0
        rise = factors[k + 2] - factors[k + 1] if k + 1 < steps else np.zeros(len(work))
        for j in range(len(plan.branches)):
            s0, s1 = plan.branches[j]
            begin, end = L.first[s0], L.first[s1]
            backward(L, s0, s1, b, du, local)
            _advance(plan, flow, du, begin, end, sums)
            _work(plan, du, begin, end, work)
            if k + 1 < steps:
                right_side(plan, flow, rise, begin, end, b)
                forward(L, s0, s1, b, end, above, local)
        for j in range(len(plan.trunk) + 1):
            s = plan.trunk[j] if j < len(plan.trunk) else plan.root
            if s < len(L.first) - 1:
                begin, end = L.first[s], L.first[s + 1]
                _advance(plan, flow, du, begin, end, sums)
                _work(plan, du, begin, end, work)
                right_side(plan, flow, rise, begin, end, b)
        _account(plan, joints, flow, sums, work, factors, k)
        if not np.isfinite(sums[4]):
            return k, -1, np.inf
        history[k] = flow.energies
        if save[k] >= 0:
            _save(flow, kept, save[k])
    return steps, worst, 0.0
