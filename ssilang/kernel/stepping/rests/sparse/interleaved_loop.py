"""The time loop of large problems, compiled: one passage over the factor a step.

Unknowns are q with `u = T q`, in the order of the factor of `A = T^T A T`, the interface's last.
Equilibrium at the start of a step replaces the product with the stiffness. With the out-of-balance
forces `g = K q + C q' + J^T f - F`, one of whose parts the scheme makes vanish,

    (1 - alpha_f) g_1 + alpha_f g_0 + (1 - alpha_m) M a_1 + alpha_m M a_0 = 0

    A dq + (1 - alpha_f) J^T df = b = - g_0 + (1 - alpha_f) dF
        + (1 - alpha_m) M (v_0/(beta dt) + (1/(2 beta) - 1) a_0) - alpha_m M a_0
        + (1 - alpha_f) C (gamma/beta v_0 - dt (1 - gamma/(2 beta)) a_0)

so that a step needs `M dq` alone; with `C = alpha M + beta K + C'`, where C' are discrete dashpots,

    K dq + dC q' = g_1 - g_0 - J^T df + dF ,   C dq = alpha M dq + beta K dq + C' dq

give `C dq` without a product with C. Moving supports and their velocities and accelerations are
among the loads F, and `lift` are the jumps that they make. The forward solve ends at the
interface, where its unknowns alone are iterated on; the backward solve starts from what they
became. A branch of the elimination tree that fits in the processor's cache goes backward, takes
its new velocities and right side, and goes forward for the next step before the next branch is
read: the factor comes from memory once a step, not twice.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_rows, copy_state
from ssilang.kernel.interface.newton import Workspace, solve_interface
from ssilang.kernel.interface.response import InterfaceState, Joints, accept, interface_energies
from ssilang.kernel.solvers.cholesky.multifrontal import Panels
from ssilang.kernel.solvers.cholesky.triangular import backward, forward
from ssilang.kernel.stepping.rests.dense.loop import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
)


class Sparse(NamedTuple):
    """Rows of a sparse matrix; `diagonal` says that `data` is its diagonal alone."""

    indptr: IntArray
    indices: IntArray
    data: FloatArray
    diagonal: bool


class Damping(NamedTuple):
    """C = alpha M + beta K + rest."""

    alpha: float
    beta: float
    rest: Sparse


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
    M : Sparse
    C : Damping
    damped : bool
    forces : array (k, n)
    lift : array (q, k)
        Jumps under unit loads while all unknowns rest (no columns: none).
    Jr, JrT : Sparse (q, r), (r, q)
        Jumps of the root's unknowns, and the transpose.
    Yr : array (r, q)
        Motions of the root's unknowns under forces on the jumps.
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
    C: Damping
    damped: bool
    forces: FloatArray
    lift: FloatArray
    Jr: Sparse
    JrT: Sparse
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


@apart
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
def _strain_forces(
    forces: FloatArray, rise: FloatArray, begin: int, end: int, pull: FloatArray, out: FloatArray
) -> None:
    """out = dF - J^T df on a range of unknowns; `pull` holds the last term and becomes zero."""
    for i in range(begin, end):
        out[i] = pull[i]
        pull[i] = 0.0
    for c in range(len(rise)):
        if rise[c] != 0.0:
            for i in range(begin, end):
                out[i] += rise[c] * forces[c, i]


@apart
@compiled_fast
def advance(
    plan: Plan, flow: Flow, du: FloatArray, begin: int, end: int, sums: FloatArray,
    rise: FloatArray, pull: FloatArray, Cx: FloatArray,
) -> None:  # fmt: skip
    """Motion, products and out-of-balance forces after the increment, on a range of unknowns.

    `sums` gather v.Mv, u.g, u.Cv, du.(Cv_0 + Cv_1), and something finite if all is. `rise` (k,)
    are the increments of the load factors in this step, `pull` (n,) becomes zero and was
    `-J^T df`, `Cx` (n,) is room.
    """
    am, af, beta, gamma, dt = plan.scheme
    v_u, v_v, v_a = gamma / (beta * dt), 1 - gamma / beta, dt * (1 - 0.5 * gamma / beta)
    a_u, a_v, a_a = 1 / (beta * dt * dt), -1 / (beta * dt), 1 - 0.5 / beta
    g_g, g_1, g_0 = -af / (1 - af), -(1 - am) / (1 - af), -am / (1 - af)
    kinetic, static, size = 0.0, 0.0, 0.0
    if plan.damped:
        _strain_forces(plan.forces, rise, begin, end, pull, Cx)
    for i in range(begin, end):
        x, v0, a0, Ma0 = du[i], flow.v[i], flow.a[i], flow.Ma[i]
        flow.u[i] += x
        flow.v[i] = v_u * x + v_v * v0 + v_a * a0
        flow.a[i] = (x / dt - v0) / (beta * dt) + a_a * a0
        Mv0 = flow.Mv[i]
        if plan.M.diagonal:
            Mx = plan.M.data[i] * x
            flow.Mv[i], flow.Ma[i] = plan.M.data[i] * flow.v[i], plan.M.data[i] * flow.a[i]
        else:
            Mx = _row(plan.M, i, du)
            flow.Mv[i] = v_u * Mx + v_v * Mv0 + v_a * Ma0
            flow.Ma[i] = (Mx / dt - Mv0) / (beta * dt) + a_a * Ma0
        g0 = flow.g[i]
        flow.g[i] = g_g * g0 + g_1 * flow.Ma[i] + g_0 * Ma0
        if plan.damped:
            Cv0, Ca0 = flow.Cv[i], flow.Ca[i]
            part = plan.C.alpha * Mx + _row(plan.C.rest, i, du)
            Kx = Cx[i] + flow.g[i] - g0 + (1 - v_v) * Cv0 - v_a * Ca0 - v_u * part
            part += plan.C.beta * Kx / (1 + plan.C.beta * v_u)
            flow.Cv[i] = v_u * part + v_v * Cv0 + v_a * Ca0
            flow.Ca[i] = a_u * part + a_v * Cv0 + a_a * Ca0
            sums[2] += flow.u[i] * flow.Cv[i]
            sums[3] += x * (Cv0 + flow.Cv[i])
        kinetic += flow.v[i] * flow.Mv[i]
        static += flow.u[i] * flow.g[i]
        size += abs(flow.u[i])
    sums[0] += kinetic
    sums[1] += static
    sums[4] += size


@compiled_fast
def add_work(forces: FloatArray, du: FloatArray, begin: int, end: int, work: FloatArray) -> None:
    """work += forces du on a range of unknowns."""
    for c in range(forces.shape[0]):
        total = 0.0
        for i in range(begin, end):
            total += forces[c, i] * du[i]
        work[c] += total


@compiled
def _trunk_forward(
    L: Panels, trunk: IntArray, b: FloatArray, above: FloatArray, local: FloatArray
) -> None:
    """Forward solve of the trunk, with what the branches added to its rows."""
    for s in trunk:
        for i in range(L.first[s], L.first[s + 1]):
            b[i] += above[i]
            above[i] = 0.0
        forward(L, s, s + 1, b, L.first[0], above, local)


@apart
@compiled
def _interface(
    plan: Plan, joints: Joints, flow: Flow, newton: Workspace, b: FloatArray, above: FloatArray,
    du: FloatArray, local: FloatArray, rise: FloatArray, pull: FloatArray,
) -> tuple[int, float]:  # fmt: skip
    """Increment of the root's unknowns; the joints' state becomes that of the step's end.

    `rise` (k,) are the increments of the load factors; `pull` (n,) becomes `-J^T df`.
    """
    L, s = plan.L, plan.root
    for i in range(L.first[s], L.first[s + 1]):
        b[i] += above[i]
        above[i] = 0.0
    forward(L, s, s + 1, b, L.first[0], above, local)
    backward(L, s, s + 1, b, du, local)
    return settle_interface(plan, joints, flow, newton, du, rise, pull)


@apart
@compiled
def settle_interface(
    plan: Plan, joints: Joints, flow: Flow, newton: Workspace, du: FloatArray, rise: FloatArray,
    pull: FloatArray,
) -> tuple[int, float]:  # fmt: skip
    """As `_interface`, the root's unknowns in `du` being those under the joints' old forces."""
    begin, end = plan.L.first[plan.root], plan.L.first[plan.root + 1]
    q = len(flow.f)
    trial, own = newton.trial, du[begin:end]
    for i in range(q):
        y = _row(plan.Jr, i, own)
        for c in range(plan.lift.shape[1]):
            y += plan.lift[i, c] * rise[c]
        trial.y0[i] = trial.y[i] = y
    now = InterfaceState(flow.delta, flow.f, flow.w, flow.t, flow.state)
    condensed = Condensed(plan.S, plan.R, 1 - plan.scheme[1])
    turns, residual = solve_interface(joints, condensed, now, newton)
    if turns > 0:
        back, released = np.dot(plan.Yr, trial.h), flow.f - trial.f
        for i in range(end - begin):
            du[begin + i] -= back[i]
            pull[begin + i] = _row(plan.JrT, i, released)
        accept(trial, now)
    return turns, residual


@apart
@compiled
def keep(flow: Flow, kept: Kept, row: int) -> None:
    copy_state(flow.u, kept.u[row])
    copy_state(flow.v, kept.v[row])
    copy_state(flow.a, kept.a[row])
    copy_state(flow.f, kept.f[row])
    copy_rows(flow.w, kept.w[row])
    copy_rows(flow.t, kept.t[row])
    copy_rows(flow.state, kept.state[row])


@apart
@compiled
def account(
    plan: Plan, joints: Joints, flow: Flow, sums: FloatArray, work: FloatArray,
    factors: FloatArray, k: int, pulls: FloatArray,
) -> None:  # fmt: skip
    """Energies at the end of step k, from equilibrium: K u = g - C v - J^T f + F.

    `pulls` (k,) become the work of the joints' forces on unit jumps of each load.
    """
    elastic = sums[1] - sums[2]
    for c in range(len(work)):
        flow.loads[c] += work[c]
        elastic += factors[k + 1, c] * flow.loads[c]
        flow.energies[EXTERNAL] += 0.5 * (factors[k, c] + factors[k + 1, c]) * work[c]
    for i in range(len(flow.f)):
        elastic -= flow.delta[i] * flow.f[i]
    for c in range(plan.lift.shape[1]):
        pulls[c] = 0.0
        for i in range(len(flow.f)):
            pulls[c] += plan.lift[i, c] * flow.f[i]
        elastic += factors[k + 1, c] * pulls[c]
    flow.energies[KINETIC], flow.energies[ELASTIC] = 0.5 * sums[0], 0.5 * elastic
    flow.energies[DAMPED] += 0.5 * sums[3]
    if len(flow.f):
        stored, lost = interface_energies(joints, flow.w, flow.t, flow.state)
        flow.energies[STORED], flow.energies[LOST] = stored, lost


@compiled
def march_interleaved(
    plan: Plan, joints: Joints, flow: Flow, newton: Workspace, factors: FloatArray, save: IntArray,
    kept: Kept, history: FloatArray, works: FloatArray,
) -> tuple[int, int, float]:  # fmt: skip
    """Steps between the rows of `factors`; see `compiled_loop.march` for the results.

    `works` (2, n_steps, k): work of each load on the step's increment, and of the joints' forces
    on the jumps of `lift` at its end.
    """
    L, n, steps, worst = plan.L, len(flow.u), len(save), 1
    b, du, above, local = np.empty(n), np.zeros(n), np.zeros(n), np.empty(plan.room)
    pull, room = np.zeros(n), np.empty(n)
    sums, start = np.zeros(5), L.first[0]  # 0, but not as a literal: that is a type of its own
    rise, coming = factors[1] - factors[0], np.zeros(factors.shape[1])
    right_side(plan, flow, rise, start, n, b)
    for j in range(len(plan.branches)):
        s0, s1 = plan.branches[j]
        forward(L, s0, s1, b, L.first[s1], above, local)
    for k in range(steps):
        _trunk_forward(L, plan.trunk, b, above, local)
        if len(flow.f):
            turns, residual = _interface(
                plan, joints, flow, newton, b, above, du, local, rise, pull
            )
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
        for j in range(len(plan.trunk) - 1, -1, -1):
            s = plan.trunk[j]
            backward(L, s, s + 1, b, du, local)
        work = works[0, k]
        for i in range(5):
            sums[i] = 0.0
        for c in range(len(coming)):
            work[c] = 0.0
            rise[c] = factors[k + 1, c] - factors[k, c]
            coming[c] = factors[min(k + 2, steps), c] - factors[k + 1, c]
        for j in range(len(plan.branches)):
            s0, s1 = plan.branches[j]
            begin, end = L.first[s0], L.first[s1]
            backward(L, s0, s1, b, du, local)
            advance(plan, flow, du, begin, end, sums, rise, pull, room)
            add_work(plan.forces, du, begin, end, work)
            if k + 1 < steps:
                right_side(plan, flow, coming, begin, end, b)
                forward(L, s0, s1, b, end, above, local)
        for j in range(len(plan.trunk) + 1):
            s = plan.trunk[j] if j < len(plan.trunk) else plan.root
            if s < len(L.first) - 1:
                begin, end = L.first[s], L.first[s + 1]
                advance(plan, flow, du, begin, end, sums, rise, pull, room)
                add_work(plan.forces, du, begin, end, work)
                right_side(plan, flow, coming, begin, end, b)
        account(plan, joints, flow, sums, work, factors, k, works[1, k])
        if not np.isfinite(sums[4]):
            return k, -1, np.inf
        copy_state(flow.energies, history[k])
        for c in range(len(rise)):
            rise[c] = coming[c]
        if save[k] >= 0:
            keep(flow, kept, save[k])
    return steps, worst, 0.0
