"""The compiled laws of joints behind one interface: by code, on one point or on many.

A law is one file with a compiled function of one point::

    law(w, state, p, t, new, D)      # traction t, new state and tangent D, written in place

To add a law: write it, give it a code (`columns.LawCode`), a row in `law_table.LAWS` and a line in
`point_response`.
"""

from __future__ import annotations

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.copies import clear, copy_state
from ssilang.kernel.interface.laws.bearing_law import (
    lead_energy,
    lead_point,
    pendulum_energy,
    pendulum_point,
)
from ssilang.kernel.interface.laws.bed_law import bed_energy, bed_point, bed_points
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.interface.laws.columns import Parameter as Par
from ssilang.kernel.interface.laws.columns import Variable as Var
from ssilang.kernel.interface.laws.macro_law import macro_energy, macro_point
from ssilang.kernel.interface.laws.mohr_law import mohr_energy, mohr_point
from ssilang.kernel.interface.laws.sdm_law import normal_energy, opening_loss, sdm_point


@compiled
def elastic_point(
    w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray, D: FloatArray
) -> None:
    """Bonded joint: t = diag(KS1, KS2, KN) w, no state."""
    n = w.shape[0] - 1
    clear(D)
    copy_state(state, new)
    for i in range(n):
        D[i, i] = p[Par.KS1 + i]
        t[i] = p[Par.KS1 + i] * w[i]
    D[n, n] = p[Par.KN]
    t[n] = p[Par.KN] * w[n]


@compiled
def point_response(
    code: int,
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
) -> None:
    """Traction, new state and tangent of one point by the law of this code."""
    if code == LawCode.SDM:
        sdm_point(w, state, p, t, new, D)
    elif code == LawCode.MOHR:
        mohr_point(w, state, p, t, new, D)
    elif code == LawCode.ELASTIC:
        elastic_point(w, state, p, t, new, D)
    elif code == LawCode.LEAD:
        lead_point(w, state, p, t, new, D)
    elif code == LawCode.PENDULUM:
        pendulum_point(w, state, p, t, new, D)
    elif code == LawCode.BED:
        bed_point(w, state, p, t, new, D)
    else:
        macro_point(code, w, state, p, t, new, D)


@apart
@compiled
def respond(
    codes: IntArray,
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
) -> None:
    """`point_response` on n points: w, t (n, d), state, new (n, N_STATE), D (n, d, d)."""
    i, n = 0, w.shape[0]
    while i < n:
        if codes[i] == LawCode.BED:
            first = i
            while i < n and codes[i] == LawCode.BED:
                i += 1
            bed_points(first, i, w, state, p, t, new, D)
        else:
            point_response(codes[i], w[i], state[i], p[i], t[i], new[i], D[i])
            i += 1


@compiled
def point_energies(
    code: int, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray
) -> tuple[float, float]:
    """Stored energy and energy lost so far of one point, per unit area, at its own state."""
    n = w.shape[0] - 1
    if code == LawCode.SDM:
        xi, spent = state[Var.XI], state[Var.SHEAR_LOSS]
        stored = normal_energy(w[n], t[n], xi, p[Par.KN], p[Par.FC]) + state[Var.SHEAR_ENERGY]
        return stored, opening_loss(xi, p[Par.FU], p[Par.GF]) + spent
    stored = 0.0
    if code == LawCode.MOHR:
        return mohr_energy(w, t, state, p), state[Var.SHEAR_LOSS]
    if code == LawCode.LEAD:
        return lead_energy(w, state, p), state[Var.SHEAR_LOSS]
    if code == LawCode.PENDULUM:
        return pendulum_energy(w, state, p), state[Var.SHEAR_LOSS]
    if code == LawCode.BED:
        return bed_energy(w, t, p), state[Var.SHEAR_LOSS]
    if code == LawCode.ELASTIC:
        for i in range(n + 1):
            stored += 0.5 * w[i] * t[i]
        return stored, 0.0
    return macro_energy(code, w, t, p), 0.0
