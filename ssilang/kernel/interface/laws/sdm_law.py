"""The Strong Discontinuity law of a joint, for one point, compiled.

Traction t as a function of the jump w = u_U - u_L in the local frame (t1, [t2,] n), normal last;
t > 0 in tension, w_n > 0 open. `xi` is the largest irreversible opening. Normal law
(potential `eta k w`, softening `F_u exp(-F_u xi/G_f)`, closure `eta`)::

    open     w > xi            t = k (w - xi) while <= Y(xi) = FU exp(-FU xi/GF), else xi grows
                               such that k (w - xi) = Y(xi)
    closing  FC/k < w <= xi    t = k |FC|/(|FC| + k xi) (w - xi)
    closed   w <= FC/k         t = k w

With FU = FC = 0 this is `t = k min(w, 0)`. Shear: `k_t (w_t - s)` while t_n < 0, bounded by
`FROT |t_n|` if FROT >= 0, lost (s := w_t) while t_n >= 0 (no slip without k_t); in cohesive
tension k_t is scaled by Y(xi)/FU, and what closes again has its stiffness back from the traction
that is left, as if it had slipped by the rest: energy is lost there, not made. Source: Strong
Discontinuity Method, CLUB CAST3M 2014, and its closed form.
"""

import math

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.copies import clear, copy_state
from ssilang.kernel.interface.laws.columns import (
    CLOSED_SHEAR,
    OPEN_SHEAR,
    LawCode,
)
from ssilang.kernel.interface.laws.columns import Parameter as Par
from ssilang.kernel.interface.laws.columns import Variable as Var
from ssilang.kernel.interface.laws.law import Law, refuse


@compiled
def normal_law(
    w: float, xi_n: float, k: float, fu: float, gf: float, fc: float
) -> tuple[float, float, float]:
    """Traction, new xi and dt/dw of the normal law (parameters already checked)."""
    if w > xi_n:
        if fu == 0.0:
            return 0.0, w, 0.0
        a = fu / gf
        trial = k * (w - xi_n)
        if trial <= fu * math.exp(-a * xi_n):
            return trial, xi_n, k
        y, xi = _soften(w, xi_n, k, fu, a)
        return y, xi, -k * a * y / (k - a * y)
    if k * w <= fc:
        return k * w, xi_n, k
    closing = -k * fc / (-fc + k * xi_n) if fc < 0.0 else 0.0
    return closing * (w - xi_n), xi_n, closing


@seldom
@compiled
def _soften(w: float, xi: float, k: float, fu: float, a: float) -> tuple[float, float]:
    """Strength and opening that `k (w - xi) = FU exp(-a xi)` leads to from an opening xi."""
    for _ in range(100):  # monotone: the residual is convex and decreasing, 5-8 turns
        y = fu * math.exp(-a * xi)
        step = (k * (w - xi) - y) / (k - a * y)
        xi += step
        if abs(step) <= 1e-15 * abs(xi) + 1e-18:
            break
    return fu * math.exp(-a * xi), xi


@compiled
def normal_energy(w: float, t: float, xi: float, k: float, fc: float) -> float:
    """Stored energy of the normal law at (w, t, xi), per unit area."""
    if w > xi or k * w <= fc:
        closed = -0.5 * fc * xi if w <= xi else 0.0
        return 0.5 * t * t / k + closed
    return 0.5 * t * (w - xi)


@compiled
def opening_loss(xi: float, fu: float, gf: float) -> float:
    """Energy spent on opening up to xi, per unit area: GF (1 - exp(-FU xi/GF))."""
    return -gf * math.expm1(-fu * xi / gf) if fu > 0.0 else 0.0


@compiled
def sdm_energy(code: int, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray) -> float:
    """Stored energy of a point, per unit area, that of shear as its state has it."""
    n = w.shape[0] - 1
    shear: float = state[Var.SHEAR_ENERGY]
    return normal_energy(w[n], t[n], state[Var.XI], p[Par.KN], p[Par.FC]) + shear


@compiled
def sdm_point(
    code: int,
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
) -> None:
    """Traction `t`, new state `new` and tangent `D` of one point, written in place.

    Parameters
    ----------
    w : array (d,)
        Jump, shear first, normal last.
    state, new : array (N_STATE,)
        Last converged and new state, see `Variable`; lost in shear is what friction takes, and
        what an opening gives up.
    p : array (N_PARAMETERS,)
        See `Parameter`.
    """
    n = w.shape[0] - 1
    tn, xi, dtn = normal_law(w[n], state[Var.XI], p[Par.KN], p[Par.FU], p[Par.GF], p[Par.FC])
    clear(D)
    copy_state(state, new)
    new[Var.XI] = xi
    t[n] = tn
    D[n, n] = dtn
    if p[Par.SHEAR] == 1.0:  # elastic at any opening
        for i in range(n):
            t[i] = p[Par.KS1 + i] * w[i]
            D[i, i] = p[Par.KS1 + i]
    elif (tn < 0.0 and state[Var.HELD] != OPEN_SHEAR) or state[Var.HELD] == CLOSED_SHEAR:
        # in compression: elastic up to Coulomb's bound
        if state[Var.DAMAGE] > 0.0:
            for i in range(n):
                if p[Par.KS1 + i] > 0.0:
                    new[Var.SLIP1 + i] += state[Var.DAMAGE] * (w[i] - state[Var.SLIP1 + i])
            new[Var.DAMAGE] = 0.0
        _closed_shear(w, p, t, new, D, tn, dtn)
        for i in range(n):
            for j in range(n):
                D[i, j] *= 1.0 - state[Var.DAMAGE]  # the slip of closing follows the jump
    elif p[Par.FU] > 0.0:
        # in cohesive tension: stiffness and strength fade together
        left = math.exp(-p[Par.FU] / p[Par.GF] * xi)
        new[Var.DAMAGE] = 1.0 - left
        softening = dtn / p[Par.FU] if dtn < 0.0 else 0.0
        for i in range(n):
            elastic = p[Par.KS1 + i] * (w[i] - state[Var.SLIP1 + i])
            t[i] = left * elastic
            D[i, i] = left * p[Par.KS1 + i]
            D[i, n] = softening * elastic
    else:
        # open: shear is lost, the slip follows the jump
        for i in range(n):
            t[i] = 0.0
            if p[Par.KS1 + i] > 0.0:
                new[Var.SLIP1 + i] = w[i]
    _shear_energies(w, state, p, t, new, tn)


@compiled
def _shear_energies(
    w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray, tn: float
) -> None:
    """Stored energy of the shear and the energy that it has lost, into `new`."""
    stored, lost, trial, left = 0.0, 0.0, 0.0, 1.0 - state[Var.DAMAGE]
    for i in range(w.shape[0] - 1):
        elastic = w[i] - (0.0 if p[Par.SHEAR] == 1.0 else new[Var.SLIP1 + i])
        stored += 0.5 * t[i] * elastic
        before = w[i] - state[Var.SLIP1 + i]
        if new[Var.DAMAGE] == 0.0:  # closes
            lost += 0.5 * p[Par.KS1 + i] * before**2 * left * (1.0 - left)
            before *= left
        trial += 0.5 * p[Par.KS1 + i] * before**2
        lost += t[i] * (before - w[i] + new[Var.SLIP1 + i])
        lost += 0.5 * p[Par.KS1 + i] * elastic**2 * max(new[Var.DAMAGE] - 1.0 + left, 0.0)
    had = min(trial, left * state[Var.SHEAR_ENERGY])
    if new[Var.DAMAGE] == 0.0 and had > stored:  # slips at once where its bound is below that
        lost += (math.sqrt(had) - math.sqrt(stored)) ** 2
    opened = (tn >= 0.0 and state[Var.HELD] != CLOSED_SHEAR) or state[Var.HELD] == OPEN_SHEAR
    if opened and p[Par.FU] == 0.0 and p[Par.SHEAR] != 1.0:  # the stored shear is given up
        lost = state[Var.SHEAR_ENERGY]
    new[Var.SHEAR_ENERGY] = stored
    new[Var.SHEAR_LOSS] = state[Var.SHEAR_LOSS] + lost


@compiled
def _closed_shear(
    w: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    tn: float,
    dtn: float,
) -> None:
    """Shear of a point in compression: elastic, returned to Coulomb's cone if FROT >= 0.

    The tangent is the consistent one, which is not symmetric (the bound depends on the normal
    traction); with SYMMETRIC the bound counts as constant in it and the rest is made symmetric.
    """
    n = w.shape[0] - 1
    size = 0.0
    for i in range(n):
        t[i] = p[Par.KS1 + i] * (w[i] - new[Var.SLIP1 + i])
        D[i, i] = p[Par.KS1 + i]
        size += t[i] * t[i]
    size = math.sqrt(size)
    if p[Par.FROT] < 0.0 or size <= -p[Par.FROT] * tn:
        return
    _slide(w, p, t, new, D, dtn, size)


@seldom
@compiled
def _slide(
    w: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray, D: FloatArray, dtn: float,
    size: float,
) -> None:  # fmt: skip
    """Shear of `_closed_shear`, of this size, back on the cone."""
    n = w.shape[0] - 1
    ratio = -p[Par.FROT] * t[n] / size
    for i in range(n):
        direction = t[i] / size
        for j in range(n):
            cross = direction * t[j] / size
            stiffness = p[Par.KS1 + j]
            if p[Par.SYMMETRIC] == 1.0:
                stiffness = 0.5 * (p[Par.KS1 + i] + p[Par.KS1 + j])
            D[i, j] = ratio * stiffness * ((1.0 if i == j else 0.0) - cross)
        if p[Par.SYMMETRIC] != 1.0:
            D[i, n] = -p[Par.FROT] * dtn * direction
    for i in range(n):
        if p[Par.KS1 + i] > 0.0:
            new[Var.SLIP1 + i] += (1.0 - ratio) * (w[i] - new[Var.SLIP1 + i])
        t[i] *= ratio


def check_sdm_parameters(parameters: FloatArray) -> None:
    """Refuse parameters for which the SDM law has no traction or several.

    Parameters
    ----------
    parameters : array (n, N_PARAMETERS)

    Raises
    ------
    MaterialError
        If KN <= 0, KS < 0, FU < 0, GF < 0, FC > 0, a perfectly brittle point (FU > 0 with
        GF = 0), or KN <= FU^2 / GF: softening would be steeper than the elastic unloading, so
        that one opening would have several tractions. The message names the least admissible KN
        and the largest admissible FU.
    """
    columns = {p.name: parameters[:, p] for p in Par}
    refuse(columns["KN"] <= 0, columns["KN"], "KN", "> 0")
    for name in ("KS1", "KS2", "FU", "GF"):
        refuse(columns[name] < 0, columns[name], name, ">= 0")
    refuse(columns["FC"] > 0, columns["FC"], "FC", "<= 0 (it is a compression)")
    if not np.isfinite(parameters).all():
        raise MaterialError("kernel.interface.joint-parameter-not-finite")
    brittle = (columns["FU"] > 0) & (columns["GF"] == 0)
    if brittle.any():
        fu, kn = columns["FU"][brittle].max(), columns["KN"][brittle].min()
        raise MaterialError("kernel.interface.joint-fu-gf-perfectly", fu=fu, fu_2=fu * fu / kn)
    _check_snap_back(columns["KN"], columns["FU"], columns["GF"])


def _check_snap_back(kn: FloatArray, fu: FloatArray, gf: FloatArray) -> None:
    steep = (fu > 0) & (kn * gf <= fu * fu)
    if steep.any():
        at = int(np.flatnonzero(steep)[0])
        least, largest = fu[at] ** 2 / gf[at], np.sqrt(kn[at] * gf[at])
        raise MaterialError(
            "kernel.interface.kn-must-exceed-fu", kn=kn[at], least=least, largest=largest
        )


LAWS = {
    "JOINT_SDM": Law(
        LawCode.SDM,
        sdm_point,
        sdm_energy,
        ("KN", "KS"),
        ("FU", "GF", "FC", "FROT"),
        check_sdm_parameters,
        variables={
            "SAUT": (Var.XI,),
            "GLI1": (Var.SLIP1,),
            "GLI2": (Var.SLIP2,),
        },
    ),
}
