"""Mohr-Coulomb joints (JOINT_DILATANT, COULOMB), for one point, compiled.

Elastic jump = jump less plastic jump; `|t_t| <= COHE - t_n tan(phi)`, slip with the dilatancy
`tan(psi)` (opening for each unit of slip), tension up to FTRC. With FTRC = 0 the point opens and
closes freely (shear is given up); with FTRC > 0 what it opens at FTRC stays. In compression the
stiffness may change to EF beyond the closing ECN, or a joint of two points may yield at FNE with
the tangent QT. Backward Euler, closed form.
"""

from __future__ import annotations

import math

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.copies import clear, copy_state
from ssilang.kernel.interface.laws.columns import (
    IN_CONTACT,
    IS_OPEN,
)
from ssilang.kernel.interface.laws.columns import Parameter as Par
from ssilang.kernel.interface.laws.columns import Variable as Var

ROUNDING = 1e-10
"""What of the cohesion a normal traction may pull beyond the strength: faces that slide at no
pressure at all stand exactly there."""


@compiled
def _elastic_normal(closing: float, p: FloatArray) -> tuple[float, float]:
    """Traction and stiffness of an elastic normal jump."""
    if p[Par.ECN] > 0.0 and closing < -p[Par.ECN]:
        return -p[Par.KN] * p[Par.ECN] + p[Par.EF] * (closing + p[Par.ECN]), p[Par.EF]
    return p[Par.KN] * closing, p[Par.KN]


@seldom
@compiled
def mohr_energy(w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray) -> float:
    """Stored energy of a point, per unit area."""
    n = w.shape[0] - 1
    stored: float = 0.0
    if t[n] != 0.0:
        e = w[n] - state[Var.XI]
        stored = 0.5 * t[n] * e
        if p[Par.ECN] > 0.0 and e < -p[Par.ECN]:
            first, beyond = p[Par.KN] * p[Par.ECN], -e - p[Par.ECN]
            stored = 0.5 * first * p[Par.ECN] - 0.5 * (t[n] - first) * beyond
    for i in range(n):
        if p[Par.KS1 + i] > 0.0:
            stored += 0.5 * t[i] * t[i] / p[Par.KS1 + i]
    return stored


@seldom
@compiled
def mohr_point(
    w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray, D: FloatArray
) -> None:
    """Traction, new state and tangent, written in place (arguments as `sdm_point`)."""
    n = w.shape[0] - 1
    clear(D)
    copy_state(state, new)
    new[Var.OPENING] = 0.0
    new[Var.STATUS] = IN_CONTACT
    strength = p[Par.FTRC]
    if p[Par.TPHI] > 0.0:
        strength = min(strength, p[Par.COHE] / p[Par.TPHI])
    tn, kn = _elastic_normal(w[n] - state[Var.XI], p)
    bound = strength + ROUNDING * p[Par.COHE]
    if tn > bound and p[Par.TPSI] > 0.0:
        # slip opens the joint: what pulls when tried may press once the faces have slid
        spent = _slide(w, p, t, new, D, tn, kn)
        if t[n] <= bound:
            new[Var.SHEAR_LOSS] = state[Var.SHEAR_LOSS] + spent
            _cumulate(state, new, n)
            return
        clear(D)
        copy_state(state, new)
        new[Var.OPENING] = 0.0
        new[Var.STATUS] = IN_CONTACT
    if tn > bound and strength == 0.0:
        _open(w, state, p, t, new)
        _cumulate(state, new, n)
        return
    loss = 0.0
    if tn > bound:
        new[Var.XI] += (tn - strength) / kn
        loss += strength * (tn - strength) / kn
        tn, kn = strength, 0.0
    elif p[Par.FNE] > 0.0 and tn < -(p[Par.FNE] + _hardening(p) * state[Var.DAMAGE]):
        yielded = (-tn - p[Par.FNE] - _hardening(p) * state[Var.DAMAGE]) / (kn + _hardening(p))
        new[Var.XI] -= yielded
        new[Var.DAMAGE] += yielded
        tn += kn * yielded
        loss -= tn * yielded
        kn = p[Par.QT]
    new[Var.SHEAR_LOSS] = state[Var.SHEAR_LOSS] + loss + _slide(w, p, t, new, D, tn, kn)
    _cumulate(state, new, n)


@compiled
def _hardening(p: FloatArray) -> float:
    slope: float = p[Par.KN] * p[Par.QT] / (p[Par.KN] - p[Par.QT])
    return slope


@compiled
def _open(w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray) -> None:
    """An open point: no traction, the shear's stored energy is lost."""
    n = w.shape[0] - 1
    new[Var.STATUS] = IS_OPEN
    new[Var.OPENING] = w[n] - state[Var.XI]
    for i in range(n):
        t[i] = 0.0
        new[Var.SLIP1 + i] = w[i]
    t[n] = 0.0


@compiled
def _slide(
    w: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    tn: float,
    kn: float,
) -> float:
    """Shear returned to the cone, dilatancy; returns the energy spent on slip."""
    n = w.shape[0] - 1
    # elastic trial: size of the traction, length of the elastic jump
    size, length = 0.0, 0.0
    for i in range(n):
        t[i] = p[Par.KS1 + i] * (w[i] - new[Var.SLIP1 + i])
        D[i, i] = p[Par.KS1 + i]
        size += t[i] * t[i]
        length += (w[i] - new[Var.SLIP1 + i]) ** 2
    size, length = math.sqrt(size), math.sqrt(length)
    t[n], D[n, n] = tn, kn
    if size <= p[Par.COHE] - tn * p[Par.TPHI] or size == 0.0:
        return 0.0
    # back on the cone: dilatancy presses the faces together, which raises the bound
    a = kn * p[Par.TPSI] * p[Par.TPHI]
    ratio = (p[Par.COHE] - tn * p[Par.TPHI] + a * length) / (size + a * length)
    down = size + a * length
    slip = (1.0 - ratio) * length
    # consistent tangent
    for i in range(n):
        e_i = w[i] - new[Var.SLIP1 + i]
        for j in range(n):
            e_j = (w[j] - new[Var.SLIP1 + j]) / length
            g_j = p[Par.KS1 + j] * t[j] / size
            D[i, j] = t[i] * (a * e_j - ratio * (g_j + a * e_j)) / down
        D[i, i] += ratio * p[Par.KS1 + i]
        D[i, n] = -t[i] * kn * p[Par.TPHI] / down
        g_i = p[Par.KS1 + i] * t[i] / size
        dr = (a * e_i / length - ratio * (g_i + a * e_i / length)) / down
        D[n, i] = -kn * p[Par.TPSI] * ((1.0 - ratio) * e_i / length - length * dr)
    D[n, n] = kn - kn * p[Par.TPSI] * length * kn * p[Par.TPHI] / down
    # tractions, slip and what it spends
    t[n] = tn - kn * p[Par.TPSI] * slip
    spent: float = t[n] * p[Par.TPSI] * slip
    new[Var.XI] += p[Par.TPSI] * slip
    for i in range(n):
        moved = (1.0 - ratio) * (w[i] - new[Var.SLIP1 + i])
        new[Var.SLIP1 + i] += moved
        t[i] *= ratio
        spent += t[i] * moved
    return spent


@compiled
def _cumulate(state: FloatArray, new: FloatArray, n: int) -> None:
    """Cumulated plastic jump, sqrt(2/3) of its length."""
    total = (new[Var.XI] + new[Var.OPENING] - state[Var.XI] - state[Var.OPENING]) ** 2
    for i in range(n):
        total += (new[Var.SLIP1 + i] - state[Var.SLIP1 + i]) ** 2
    new[Var.CUMULATED] = state[Var.CUMULATED] + math.sqrt(2.0 / 3.0 * total)
