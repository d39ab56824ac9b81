"""Bearings of isolated structures at a joint of two points, compiled: lead and rubber, pendulum.

`LEAD` (APPUI_PLOMB): rubber and a lead core, of hysteresis by Bouc and Wen in both directions
(Park, Wen and Ang 1986). With z of length <= 1, uy = QD / (KS - KPOS):

    t = KPOS u + QD z ,   uy dz = du - |z|^(ETA - 2) (z . du) c z ,   c = 1 loading, 1 - 2 BETA not

(c = gamma + BETA sign(z . du), gamma = 1 - BETA: beta is that of |du|, as Wen has it.)
Backward Euler: z = zeta a / |a|, a = z0 + d, d = du / uy, is along a, with
`zeta + c (a . d) / |a| zeta^ETA = |a|`: one equation whose left side grows.
The vertical spring KN is elastic both ways.

`PENDULUM` (APPUI_PENDULE): a slider on a bowl of radius R = RAYO. The bowl lifts it by u^2 / 2 R:
with the gap g = w - u^2 / 2 R above the bowl, N = -KN g where g < 0 and nothing where it has
lifted off,

    t_n = -N ,   t = N u / R + f ,   f = KS (u - slip) ,  |f| <= FROT N

so that without friction all is the derivative of KN g^2 / 2, in which no energy is lost.
"""

import math

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.copies import clear, copy_state
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.interface.laws.columns import Parameter as Par
from ssilang.kernel.interface.laws.columns import Variable as Var
from ssilang.kernel.interface.laws.law import SLIPS, Law, columns_of, refuse

TURNS = 60
ENOUGH = 1e-15


@compiled
def _radius(kappa: float, eta: float, size: float) -> float:
    """The root zeta of zeta + kappa zeta^eta = size, kappa >= 0, eta >= 1: Newton from above."""
    if eta == 1.0:
        return size / (1.0 + kappa)
    zeta: float = size
    for _ in range(TURNS):
        power = kappa * zeta ** (eta - 1.0)
        step = (zeta * (1.0 + power) - size) / (1.0 + eta * power)
        zeta -= step
        if abs(step) <= ENOUGH * size:
            break
    return zeta


@compiled
def _lead_core(
    w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray, D: FloatArray
) -> float:
    """Shear of the core added to t and D, z and slip to new; returns the energy it takes."""
    n = w.shape[0] - 1
    uy = p[Par.QD] / (p[Par.KS1] - p[Par.KPOS])
    # a = z0 + d, d = du / uy; what slipped before is u - uy z
    size, along = 0.0, 0.0
    for i in range(n):
        z0 = state[Var.HYSTERETIC1 + i]
        a = (w[i] - state[Var.SLIP1 + i]) / uy
        size += a * a
        along += a * (a - z0)
    size = math.sqrt(size)
    if size == 0.0:
        for i in range(n):
            new[Var.HYSTERETIC1 + i] = 0.0
            new[Var.SLIP1 + i] = w[i]
            D[i, i] += p[Par.QD] / uy
        return 0.0
    along /= size
    c = 1.0 if along > 0.0 else 1.0 - 2.0 * p[Par.BETA]
    kappa, eta = c * along, p[Par.ETA]
    zeta = _radius(kappa, eta, size)
    down = 1.0 + kappa * eta * zeta ** (eta - 1.0)
    taken = 0.0
    for i in range(n):
        z0 = state[Var.HYSTERETIC1 + i]
        a_i = (w[i] - state[Var.SLIP1 + i]) / uy
        z = zeta * a_i / size
        new[Var.HYSTERETIC1 + i] = z
        new[Var.SLIP1 + i] = w[i] - uy * z
        t[i] += p[Par.QD] * z
        # what of the jump is not elastic, by the mean of both ends
        taken += 0.5 * p[Par.QD] * (z0 + z) * (new[Var.SLIP1 + i] - state[Var.SLIP1 + i])
    for j in range(n):
        e_j = (w[j] - state[Var.SLIP1 + j]) / uy / size
        d_j = (w[j] - state[Var.SLIP1 + j]) / uy - state[Var.HYSTERETIC1 + j]
        # derivatives by d_j: of |a| (e_j), of (a . d) / |a|, of zeta
        turn = e_j + (d_j - along * e_j) / size
        grow = (e_j - zeta**eta * c * turn) / down
        for i in range(n):
            e_i = (w[i] - state[Var.SLIP1 + i]) / uy / size
            unit = 1.0 if i == j else 0.0
            D[i, j] += p[Par.QD] / uy * (grow * e_i + zeta * (unit - e_i * e_j) / size)
    return taken


@seldom
@compiled
def lead_point(
    code: int, w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray,
    D: FloatArray,
) -> None:  # fmt: skip
    """Force, new state and tangent of a lead and rubber bearing, written in place."""
    n = w.shape[0] - 1
    clear(D)
    copy_state(state, new)
    for i in range(n):
        t[i] = p[Par.KPOS] * w[i]
        D[i, i] = p[Par.KPOS]
    t[n] = p[Par.KN] * w[n]
    D[n, n] = p[Par.KN]
    new[Var.SHEAR_LOSS] = state[Var.SHEAR_LOSS] + _lead_core(w, state, p, t, new, D)


@seldom
@compiled
def lead_energy(code: int, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray) -> float:
    """Stored in the rubber, in what of the core is elastic, and in the vertical spring."""
    n = w.shape[0] - 1
    core: float = p[Par.QD] ** 2 / (p[Par.KS1] - p[Par.KPOS])
    stored: float = 0.5 * p[Par.KN] * w[n] ** 2
    for i in range(n):
        z = state[Var.HYSTERETIC1 + i]
        stored += 0.5 * p[Par.KPOS] * w[i] ** 2 + 0.5 * core * z * z
    return stored


@seldom
@compiled
def pendulum_point(
    code: int, w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray,
    D: FloatArray,
) -> None:  # fmt: skip
    """Force, new state and tangent of a friction pendulum, written in place."""
    n, radius = w.shape[0] - 1, p[Par.RAYO]
    clear(D)
    copy_state(state, new)
    gap = w[n]
    for i in range(n):
        gap -= 0.5 * w[i] * w[i] / radius
    if gap >= 0.0:  # lifted off: the slider follows
        for i in range(n):
            t[i] = 0.0
            new[Var.SLIP1 + i] = w[i]
        t[n] = 0.0
        return
    # the bowl: all derivatives of KN gap^2 / 2
    t[n] = p[Par.KN] * gap
    D[n, n] = p[Par.KN]
    size = 0.0
    for i in range(n):
        t[i] = -t[n] * w[i] / radius
        D[i, n] = D[n, i] = -p[Par.KN] * w[i] / radius
        for j in range(n):
            D[i, j] = p[Par.KN] * w[i] * w[j] / radius**2
        D[i, i] -= t[n] / radius
        size += (p[Par.KS1] * (w[i] - state[Var.SLIP1 + i])) ** 2
    new[Var.SHEAR_LOSS] = state[Var.SHEAR_LOSS] + _rub(w, state, p, t, new, D, math.sqrt(size))


@compiled
def _rub(
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    size: float,
) -> float:
    """Friction added to t and D, `size` that of its trial; returns what slip takes."""
    n, stiff = w.shape[0] - 1, p[Par.KS1]
    bound = -p[Par.FROT] * t[n]
    share = 1.0 if size <= bound else bound / size
    taken = 0.0
    for i in range(n):
        tried = stiff * (w[i] - state[Var.SLIP1 + i])
        t[i] += share * tried
        D[i, i] += share * stiff
        if share < 1.0:
            moved = (1.0 - share) * (w[i] - state[Var.SLIP1 + i])
            new[Var.SLIP1 + i] = state[Var.SLIP1 + i] + moved
            taken += share * tried * moved
    if share < 1.0:
        for i in range(n):
            e_i = stiff * (w[i] - state[Var.SLIP1 + i]) / size
            D[i, n] -= p[Par.FROT] * p[Par.KN] * e_i
            for j in range(n):
                e_j = stiff * (w[j] - state[Var.SLIP1 + j]) / size
                D[i, j] -= share * stiff * e_i * e_j
                D[i, j] += p[Par.FROT] * p[Par.KN] * w[j] / p[Par.RAYO] * e_i
    return taken


@seldom
@compiled
def pendulum_energy(
    code: int, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray
) -> float:
    """Stored in the vertical spring and in the friction's spring."""
    n = w.shape[0] - 1
    gap, stored = w[n], 0.0
    for i in range(n):
        gap -= 0.5 * w[i] * w[i] / p[Par.RAYO]
        stored += 0.5 * p[Par.KS1] * (w[i] - state[Var.SLIP1 + i]) ** 2
    return stored + 0.5 * p[Par.KN] * gap * gap if gap < 0.0 else 0.0


def check_lead_parameters(parameters: FloatArray) -> None:
    """Refuse a lead and rubber bearing without stiffness, strength or hysteresis.

    Raises
    ------
    MaterialError
        Naming the parameter.
    """
    columns = _bearing_columns(parameters)
    refuse(columns["QD"] <= 0, columns["QD"], "QD", "> 0")
    refuse(columns["KPOS"] < 0, columns["KPOS"], "KPOS", ">= 0")
    refuse(columns["KPOS"] >= columns["KS1"], columns["KPOS"], "KPOS", "< KS")
    refuse(columns["ETA"] < 1, columns["ETA"], "ETA", ">= 1")
    refuse((columns["BETA"] < 0.5) | (columns["BETA"] > 1), columns["BETA"], "BETA", "0.5 ... 1")


def check_pendulum_parameters(parameters: FloatArray) -> None:
    """Refuse a friction pendulum without bowl or friction.

    Raises
    ------
    MaterialError
        Naming the parameter.
    """
    columns = _bearing_columns(parameters)
    refuse(columns["RAYO"] <= 0, columns["RAYO"], "RAYO", "> 0")
    refuse(columns["FROT"] < 0, columns["FROT"], "FROT", ">= 0")


def _bearing_columns(parameters: FloatArray) -> dict[str, FloatArray]:
    columns = columns_of(parameters)
    for name in ("KN", "KS1"):
        refuse(columns[name] <= 0, columns[name], name, "> 0")
    # KS2 is 0 in the plane, where there is no second direction
    other = (columns["KS2"] != columns["KS1"]) & (columns["KS2"] != 0)
    refuse(other, columns["KS2"], "KS2", "= KS1")
    return columns


LAWS = {
    "APPUI_PLOMB": Law(
        LawCode.LEAD,
        lead_point,
        lead_energy,
        ("KN", "KS", "QD", "KPOS"),
        ("ETA", "BETA"),
        check_lead_parameters,
        variables={**SLIPS, "HYS1": (Var.HYSTERETIC1,), "HYS2": (Var.HYSTERETIC2,)},
        two_points=True,
        opens=False,
    ),
    "APPUI_PENDULE": Law(
        LawCode.PENDULUM,
        pendulum_point,
        pendulum_energy,
        ("KN", "KS", "RAYO", "FROT"),
        (),
        check_pendulum_parameters,
        variables=SLIPS,
        two_points=True,
    ),
}
