"""Mohr-Coulomb joints (JOINT_DILATANT, COULOMB), for one point, compiled.

Elastic jump = jump less plastic jump; `|t_t| <= COHE - t_n tan(phi)`, slip with the dilatancy
`tan(psi)` (opening for each unit of slip), tension up to FTRC. With FTRC = 0 the point opens and
closes freely (shear is given up); with FTRC > 0 what it opens at FTRC stays. In compression the
stiffness may change to EF beyond the closing ECN, or a joint of two points may yield at FNE with
the tangent QT. Backward Euler, closed form.
"""

import math

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.copies import clear, copy_state
from ssilang.kernel.interface.laws.columns import (
    IN_CONTACT,
    IS_OPEN,
    LawCode,
)
from ssilang.kernel.interface.laws.columns import Parameter as Par
from ssilang.kernel.interface.laws.columns import Variable as Var
from ssilang.kernel.interface.laws.law import Law, refuse

ROUNDING = 1e-10
"""What of the cohesion a normal traction may pull beyond the strength: faces that slide at no
pressure at all stand exactly there."""


@seldom
@compiled
def mohr_energy(code: int, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray) -> float:
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
    code: int, w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray,
    D: FloatArray,
) -> None:  # fmt: skip
    """Traction, new state and tangent, written in place (arguments as `sdm_point`)."""
    n = w.shape[0] - 1
    strength = p[Par.FTRC]
    if p[Par.TPHI] > 0.0:
        strength = min(strength, p[Par.COHE] / p[Par.TPHI])
    # slip opens the joint: what pulls when tried may press once the faces have slid, and more yet
    closing, kn, stays = w[n] - state[Var.XI], p[Par.KN], 1.0
    tn, yielded = kn * closing, 0.0
    loss = _slide(w, state, p, t, new, D, tn, kn, stays)
    if t[n] > strength + ROUNDING * p[Par.COHE]:
        opened = (tn - strength) / kn  # by tension and by slip together
        loss = _slide(w, state, p, t, new, D, strength, 0.0, 0.0)
        if strength == 0.0:
            loss = _open(w, state, p, t, new, D, loss)
        else:
            new[Var.XI] += opened
            loss += strength * opened
        new[Var.PULLED] += max(opened - state[Var.OPENING], 0.0)
    else:
        if p[Par.ECN] > 0.0 and t[n] < -kn * p[Par.ECN]:
            tn, kn = p[Par.EF] * (closing + p[Par.ECN]) - kn * p[Par.ECN], p[Par.EF]
            loss = _slide(w, state, p, t, new, D, tn, kn, stays)
        limit = p[Par.FNE] + _hardening(p) * state[Var.DAMAGE]
        if p[Par.FNE] > 0.0 and t[n] < -limit:
            yielded = (-tn - limit) / (kn + _hardening(p))
            stays = p[Par.QT] / p[Par.KN]
            loss = _slide(w, state, p, t, new, D, tn + kn * yielded, p[Par.QT], stays)
            loss -= t[n] * yielded
            new[Var.XI] -= yielded
            lift = p[Par.TPSI] * _length(state, new, n)
            new[Var.DAMAGE] += yielded + (1.0 - stays) * lift
    new[Var.SHEAR_LOSS] += loss
    _cumulate(state, new, n)


@compiled
def _length(state: FloatArray, new: FloatArray, n: int) -> float:
    """Slip of a step."""
    total: float = 0.0
    for i in range(n):
        total += (new[Var.SLIP1 + i] - state[Var.SLIP1 + i]) ** 2
    return math.sqrt(total)


@compiled
def _hardening(p: FloatArray) -> float:
    slope: float = p[Par.KN] * p[Par.QT] / (p[Par.KN] - p[Par.QT])
    return slope


@compiled
def _open(
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    spent: float,
) -> float:
    """An open point: no traction; what it spent sliding and its stored shear are lost, once."""
    n = w.shape[0] - 1
    clear(D)
    new[Var.STATUS] = IS_OPEN
    new[Var.OPENING] = w[n] - state[Var.XI]
    for i in range(n):
        if p[Par.KS1 + i] > 0.0:
            spent += 0.5 * t[i] * t[i] / p[Par.KS1 + i]
        t[i] = 0.0
        new[Var.SLIP1 + i] = w[i]
    t[n] = 0.0
    return 0.0 if state[Var.STATUS] == IS_OPEN else spent


@compiled
def _slide(
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    tn: float,
    kn: float,
    stays: float,
) -> float:
    """Shear returned to the cone, dilatancy; returns the energy spent on slip.

    From `state` anew; `stays` is the share of the dilatancy that is not made up for by an opening
    in tension or by crushing.
    """
    clear(D)
    copy_state(state, new)
    new[Var.OPENING] = 0.0
    new[Var.STATUS] = IN_CONTACT
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
    lift = stays * p[Par.TPSI] * slip
    spent: float = t[n] * lift
    new[Var.XI] += lift
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


def check_mohr_parameters(parameters: FloatArray) -> None:
    """Refuse parameters of a Mohr-Coulomb joint that have no meaning.

    Raises
    ------
    MaterialError
        If KN <= 0, or a shear stiffness, angle, cohesion or strength is negative, or the
        hardening in compression is not below the elastic stiffness.
    """
    columns = {p.name: parameters[:, p] for p in Par}
    if not np.isfinite(parameters).all():
        raise MaterialError("kernel.interface.joint-parameter-not-finite-or-steep")
    refuse(columns["KN"] <= 0, columns["KN"], "KN", "> 0")
    for name in ("KS1", "KS2", "TPHI", "TPSI", "COHE", "FTRC", "EF", "ECN", "FNE", "QT"):
        refuse(columns[name] < 0, columns[name], name, ">= 0")
    refuse((columns["FNE"] > 0) & (columns["QT"] >= columns["KN"]), columns["QT"], "QT", "< KN")


_PLASTIC: dict[str, tuple[Var, ...]] = {
    "EPSE": (Var.CUMULATED,), "STAT": (Var.STATUS,), "EPOU": (Var.OPENING,),
    "LAM1": (Var.PULLED,), "PLA1": (Var.SLIP1,), "PLA2": (Var.SLIP2,),
    "PLA3": (Var.XI, Var.OPENING), "LAM3": (Var.DAMAGE,),
}  # fmt: skip
_OPPOSITE = {"EPCO": "LAM3"}

LAWS = {
    "JOINT_DILATANT": Law(
        LawCode.MOHR,
        mohr_point,
        mohr_energy,
        ("KN", "KS", "PHI", "MU"),
        ("FTRC", "COHE"),
        check_mohr_parameters,
        angles={"PHI": ("TPHI",), "MU": ("TPSI",)},
        variables=_PLASTIC,
        opposite=_OPPOSITE,
    ),
    "COULOMB": Law(
        LawCode.MOHR,
        mohr_point,
        mohr_energy,
        ("KN", "KS", "FRIC", "COHE"),
        ("FTRC", "EF", "ECN", "FNE", "QT", "TYPE"),
        check_mohr_parameters,
        angles={"FRIC": ("TPHI", "TPSI")},
        variables=_PLASTIC,
        opposite=_OPPOSITE,
    ),
}
