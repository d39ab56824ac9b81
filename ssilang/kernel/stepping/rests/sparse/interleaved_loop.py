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
read: the factor comes from memory once a step, not twice. Above the branches the tree is walked
alike, so that a supernode goes forward as soon as all below it did.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast, compiled_free
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import add_product, copy_state, dot
from ssilang.kernel.interface.newton import Workspace, solve_interface
from ssilang.kernel.interface.response import InterfaceState, Joints, accept, interface_energies
from ssilang.kernel.solvers.cholesky.multifrontal import Panels
from ssilang.kernel.solvers.cholesky.triangular import backward, forward
from ssilang.kernel.solvers.low_rank import LowRank, add_low_rank_product
from ssilang.kernel.stepping.newmark import Newmark
from ssilang.kernel.stepping.state import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
    Motion,
    Recorder,
)
from ssilang.kernel.stepping.verbs import advance, damped, end_of_step, from_past

BOTH, DOWN, UP = range(3)  # ways through a part: a branch goes down and up at once


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
    """What does not change during the steps of one dt."""

    L: Panels
    # (m, 3) first and last supernode of a part, and what is done with it (`BOTH`, `DOWN`, `UP`),
    # the interface's last
    visits: IntArray
    root: int  # the interface's supernode, or the number of supernodes without interface
    M: Sparse
    C: Damping
    damped: bool
    forces: FloatArray  # (k, n)
    first: IntArray  # (m + 1,)
    acting: IntArray  # (first[-1],) loads that act on the unknowns of each part
    lift: FloatArray  # (q, k) jumps under unit loads while all unknowns rest (no columns: none)
    Jr: Sparse  # (q, r) jumps of the root's unknowns
    JrT: Sparse  # its transpose
    Yr: FloatArray  # (r, q) motions of the root's unknowns under forces on the jumps
    blocks: LowRank  # (r, r) motions under their own forces, in place of panels and Yr (or none)
    condensed: Condensed
    newmark: Newmark
    room: int  # length of the longest supernode


class Products(NamedTuple):
    """What goes with the motion, changed in place; g to Ca are (n,), on the unknowns q.

    `g` are the out-of-balance forces, `Mv` to `Ca` products of mass and damping with the motion,
    `loads` (k,) the work `forces u` of each load.
    """

    g: FloatArray
    Mv: FloatArray
    Ma: FloatArray
    Cv: FloatArray
    Ca: FloatArray
    loads: FloatArray


class Sweep(NamedTuple):
    """Vectors that each step overwrites."""

    b: FloatArray  # (n,) right-hand side
    du: FloatArray  # (n,) increment
    above: FloatArray  # (n,) what branches add to the rows above them
    change: FloatArray  # (n,) `-J^T df` of the step's end
    room: FloatArray  # (n,)
    load_change: FloatArray  # (k,) increments of the load factors in this step
    next_load_change: FloatArray  # (k,) in the next one
    sums: FloatArray  # (5,) v.Mv, u.g, u.Cv, du.(Cv_0 + Cv_1), something finite if all is
    local: FloatArray  # (plan.room,) room of the solution


def sweep_of(plan: Plan, n: int, loads: int) -> Sweep:
    """Room for n unknowns."""
    b, du, above, change, room = (np.zeros(n) for _ in range(5))
    return Sweep(
        b, du, above, change, room, np.zeros(loads), np.zeros(loads), np.zeros(5),
        np.empty(plan.room),
    )  # fmt: skip


@compiled_fast
def _row(A: Sparse, i: int, x: FloatArray) -> float:
    total = 0.0
    for k in range(A.indptr[i], A.indptr[i + 1]):
        total += A.data[k] * x[A.indices[k]]
    return total


@apart
@compiled_fast
def predict(
    plan: Plan, products: Products, load_change: FloatArray, acting: IntArray, b: FloatArray,
    begin: int, end: int,
) -> None:  # fmt: skip
    """b of the next step on a range of unknowns; `load_change` (k,): increments of the factors."""
    n, g, Mv, Ma, Cv, Ca = (
        plan.newmark, products.g, products.Mv, products.Ma, products.Cv, products.Ca,
    )  # fmt: skip
    if plan.damped:
        for i in range(begin, end):
            b[i] = from_past(n, Mv[i], Ma[i], Cv[i], Ca[i]) + Cv[i] - g[i]
    else:
        for i in range(begin, end):
            b[i] = from_past(n, Mv[i], Ma[i], 0.0, 0.0) - g[i]
    for c in acting:
        if load_change[c] != 0.0:
            part, force, to = n.end * load_change[c], plan.forces[c, begin:end], b[begin:end]
            for i in range(end - begin):
                to[i] += part * force[i]


@compiled_fast
def _strain_forces(
    forces: FloatArray, acting: IntArray, sweep: Sweep, begin: int, end: int
) -> None:
    """`dF - J^T df` into the sweep's room; `change` is the last term."""
    out, change = sweep.room, sweep.change
    for i in range(begin, end):
        out[i] = change[i]
    for c in acting:
        part, force, to = sweep.load_change[c], forces[c, begin:end], out[begin:end]
        if part != 0.0:
            for i in range(end - begin):
                to[i] += part * force[i]


@apart
@compiled_fast
def advance_range(
    plan: Plan, x: Motion, products: Products, sweep: Sweep, acting: IntArray, begin: int, end: int
) -> None:
    """Motion, products and out-of-balance forces after the increment, on a range of unknowns."""
    n, du, g, Mv, Ma = plan.newmark, sweep.du, products.g, products.Mv, products.Ma
    g_g, g_1, g_0 = -n.start / n.end, -n.inertia_end / n.end, -n.inertia_start / n.end
    kinetic, static, size = 0.0, 0.0, 0.0
    if plan.damped:
        _strain_forces(plan.forces, acting, sweep, begin, end)
    for i in range(begin, end):
        # the motion, and products with the mass
        move, Ma0, g0 = du[i], Ma[i], g[i]
        x.u[i] += move
        x.v[i], x.a[i] = advance(n, move, x.v[i], x.a[i])
        if plan.M.diagonal:
            Mx = plan.M.data[i] * move
            Mv[i], Ma[i] = plan.M.data[i] * x.v[i], plan.M.data[i] * x.a[i]
        else:
            Mx = _row(plan.M, i, du)
            Mv[i], Ma[i] = advance(n, Mx, Mv[i], Ma0)
        g[i] = g_g * g0 + g_1 * Ma[i] + g_0 * Ma0
        if plan.damped:
            Cv0, Ca0, C = products.Cv[i], products.Ca[i], plan.C
            rest, force = _row(C.rest, i, du), sweep.room[i] + g[i] - g0
            products.Cv[i], products.Ca[i] = damped(n, C.alpha, C.beta, Mx, rest, force, Cv0, Ca0)
            sweep.sums[2] += x.u[i] * products.Cv[i]
            sweep.sums[3] += move * (Cv0 + products.Cv[i])
        kinetic += x.v[i] * Mv[i]
        static += x.u[i] * g[i]
        size += abs(x.u[i])
    sweep.sums[0] += kinetic
    sweep.sums[1] += static
    sweep.sums[4] += size


@compiled_fast
def add_work(
    forces: FloatArray, acting: IntArray, du: FloatArray, begin: int, end: int, work: FloatArray
) -> None:
    """work += forces du on a range of unknowns."""
    for c in acting:
        work[c] += dot(forces[c, begin:end], du[begin:end])


@compiled
def begin_step(sweep: Sweep, factors: FloatArray, k: int, work: FloatArray) -> None:
    """Increments of the load factors of step k and of the next; sums and work become zero."""
    last = len(factors) - 1
    for i in range(len(sweep.sums)):
        sweep.sums[i] = 0.0
    for c in range(len(work)):
        work[c] = 0.0
        sweep.load_change[c] = factors[k + 1, c] - factors[k, c]
        sweep.next_load_change[c] = factors[min(k + 2, last), c] - factors[k + 1, c]


@compiled
def _rise(L: Panels, s0: int, s1: int, kind: int, sweep: Sweep) -> None:
    """Forward solve of a part, with what those below added to its rows."""
    b, above, beyond = sweep.b, sweep.above, L.first[s1]
    if kind == UP:
        for i in range(L.first[s0], L.first[s1]):
            b[i] += above[i]
            above[i] = 0.0
        beyond = L.first[0]
    forward(L, s0, s1, b, beyond, above, sweep.local)


@apart
@compiled
def settle_interface(
    plan: Plan, joints: Joints, flow: Motion, newton: Workspace, sweep: Sweep
) -> tuple[int, float]:
    """The joints' state at the end of the step, the root's unknowns in `du` with it.

    They are those under the joints' old forces before.
    """
    begin, end = plan.L.first[plan.root], plan.L.first[plan.root + 1]
    du, q, trial = sweep.du, len(flow.f), newton.trial
    own = du[begin:end]
    for i in range(q):
        y = _row(plan.Jr, i, own)
        for c in range(plan.lift.shape[1]):
            y += plan.lift[i, c] * sweep.load_change[c]
        trial.y0[i] = trial.y[i] = y
    now = InterfaceState(flow.delta, flow.f, flow.w, flow.t, flow.state)
    turns, residual = solve_interface(joints, plan.condensed, now, newton)
    if turns > 0:
        released = trial.dy
        for i in range(q):
            released[i] = flow.f[i] - trial.f[i]
        if len(plan.blocks.values):
            for i in range(end - begin):
                sweep.room[begin + i] = -_row(plan.JrT, i, trial.h)
            add_low_rank_product(plan.blocks, False, sweep.room[begin:end], own)
        else:
            add_product(-1.0, plan.Yr, trial.h, own)
        for i in range(end - begin):
            sweep.change[begin + i] = _row(plan.JrT, i, released)
        accept(trial, now)
    return turns, residual


@apart
@compiled
def account(
    plan: Plan, joints: Joints, x: Motion, products: Products, sweep: Sweep, factors: FloatArray,
    work: FloatArray, k: int,
) -> None:  # fmt: skip
    """Energies at the end of step k, from equilibrium: K u = g - C v - J^T f + F.

    `work` (2, n_steps, k): of each load on the increment, and that of the joints' forces on unit
    jumps of each load, which is made here.
    """
    sums, pulls = sweep.sums, work[1, k]
    elastic = sums[1] - sums[2]
    for c in range(len(pulls)):
        products.loads[c] += work[0, k, c]
        elastic += factors[k + 1, c] * products.loads[c]
        x.energies[EXTERNAL] += 0.5 * (factors[k, c] + factors[k + 1, c]) * work[0, k, c]
    for i in range(len(x.f)):
        elastic -= x.delta[i] * x.f[i]
    for c in range(plan.lift.shape[1]):
        pulls[c] = 0.0
        for i in range(len(x.f)):
            pulls[c] += plan.lift[i, c] * x.f[i]
        elastic += factors[k + 1, c] * pulls[c]
    x.energies[KINETIC], x.energies[ELASTIC] = 0.5 * sums[0], 0.5 * elastic
    x.energies[DAMPED] += 0.5 * sums[3]
    if len(x.f):
        stored, lost = interface_energies(joints, x.w, x.t, x.state)
        x.energies[STORED], x.energies[LOST] = stored, lost


@compiled
def _root(plan: Plan, sweep: Sweep) -> None:
    """Forward and backward solves of the root, under the joints' old forces."""
    L, s = plan.L, plan.root
    if len(plan.blocks.values):
        begin, end = L.first[s], L.first[s + 1]
        for i in range(begin, end):
            sweep.b[i] += sweep.above[i]
            sweep.above[i] = sweep.du[i] = 0.0
        add_low_rank_product(plan.blocks, False, sweep.b[begin:end], sweep.du[begin:end])
        return
    _rise(L, s, s + 1, UP, sweep)
    backward(L, s, s + 1, sweep.b, sweep.du, sweep.local)


@compiled_free
def run_interleaved(
    plan: Plan, joints: Joints, x: Motion, products: Products, sweep: Sweep, newton: Workspace,
    factors: FloatArray, to: Recorder, first: int, last: int,
) -> tuple[int, int, float]:  # fmt: skip
    """Steps between the rows of `factors`, of which `last - first` now; see `state.Outcome`.

    Those from `first` on, which the sweep has begun, or from 0 on if that is -1.

    The recorder's work (2, n_steps, k) is that of each load on the step's increment, and of the
    joints' forces on the jumps of `lift` at its end.
    """
    L, worst, visits = plan.L, 1, plan.visits
    b, du, local = sweep.b, sweep.du, sweep.local
    for k in range(first, last):  # -1: what leads to the first step
        # solve: Newton's method on the interface, which is the root
        if k >= 0 and len(x.f):
            _root(plan, sweep)
            turns, residual = settle_interface(plan, joints, x, newton, sweep)
            if turns <= 0:
                return k, turns, residual
            worst = max(worst, turns)
        work = to.work[0, k]
        begin_step(sweep, factors, k, work)
        # each part: down, and once all below it are there: advance, predict, up for the next step
        for j in range(len(visits)):
            s0, s1, kind = visits[j]
            begin, end = L.first[s0], L.first[s1]
            acting = plan.acting[plan.first[j] : plan.first[j + 1]]
            if k >= 0 and kind != UP:
                backward(L, s0, s1, b, du, local)
            if kind != DOWN:
                if k >= 0:
                    advance_range(plan, x, products, sweep, acting, begin, end)
                    add_work(plan.forces, acting, du, begin, end, work)
                predict(plan, products, sweep.next_load_change, acting, b, begin, end)
                if s0 < plan.root and k + 1 < len(to.row):
                    _rise(L, s0, s1, kind, sweep)
        copy_state(sweep.next_load_change, sweep.load_change)
        if k >= 0:
            account(plan, joints, x, products, sweep, factors, to.work, k)
            if not np.isfinite(sweep.sums[4]):
                return k, -1, np.inf
            end_of_step(x, to, k)
    return last, worst, 0.0
