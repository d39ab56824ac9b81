"""What a user wants to know of each point of a joint: open or closed, energies stored and lost."""

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.laws.columns import IS_OPEN, LawCode, Parameter, Variable
from ssilang.kernel.interface.laws.law_table import elastic_tangent
from ssilang.kernel.interface.laws.point_laws import point_energies

CLOSED, CLOSING, OPEN, OPENING = 1.0, 2.0, 3.0, 4.0
"""Codes of the state of a point."""

SAME = 1e-12  # of the strength: rounding between compiled and array exponentials
WHOLE = 1e-9  # of a moment: a macro-element in contact over its whole area


def point_states(
    codes: IntArray, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray
) -> FloatArray:
    """State of points, shape (n,).

    JOINT_SDM: CLOSED, `w_n <= FC/KN`, on the virgin line; CLOSING, between there and the largest
    opening, on the line that transmits at most |FC| (with FC < 0); OPENING, at the largest opening
    so far, without traction or on the softening curve; OPEN, everything else: a gap below the
    largest one, or tension below the strength. Mohr-Coulomb joints: CLOSED, OPEN, or OPENING at
    the tensile strength. Macro-elements: CLOSED over the whole area, else OPEN. Elastic joints
    and bearings of lead and rubber are CLOSED: they are bonded. Pendulums: CLOSED where they press.

    Parameters
    ----------
    codes : array (n,)
        Law of each point.
    w, t : arrays (n, d)
        Jumps and tractions, normal last.
    state : array (n, N_STATE)
    p : array (n, N_PARAMETERS)
    """
    found = np.full(len(codes), CLOSED)
    for code in np.unique(codes[codes != LawCode.ELASTIC]):
        chosen, of = codes == code, _STATES.get(code, _macro)
        found[chosen] = of(w[chosen], t[chosen], state[chosen], p[chosen])
    return found


def _sdm(w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray) -> FloatArray:
    wn, tn, xi = w[:, -1], t[:, -1], state[:, Variable.XI]
    k, fu, gf, fc = p[:, Parameter.KN], p[:, Parameter.FU], p[:, Parameter.GF], p[:, Parameter.FC]
    rate = np.divide(fu, gf, out=np.zeros(len(fu)), where=fu > 0)
    largest = (xi > 0) & (wn >= xi) & (tn >= fu * np.exp(-rate * xi) * (1 - SAME))
    conditions = [k * wn <= fc, largest, (wn < xi) & (fc < 0)]
    return np.select(conditions, [CLOSED, OPENING, CLOSING], OPEN)


def _mohr(w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray) -> FloatArray:
    conditions = [state[:, Variable.STATUS] == IS_OPEN, t[:, -1] > 0]
    return np.select(conditions, [OPEN, OPENING], CLOSED)


def _macro(w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray) -> FloatArray:
    d = w.shape[1]
    whole = np.einsum("nij,nj->ni", elastic_tangent(p, d), w)
    size = np.abs(np.diagonal(elastic_tangent(p, d), axis1=1, axis2=2) * w).max(axis=1)
    return np.where((np.abs(t - whole).max(axis=1) <= WHOLE * size), CLOSED, OPEN)


_STATES: dict[int, Callable[[FloatArray, FloatArray, FloatArray, FloatArray], FloatArray]] = {
    LawCode.SDM: _sdm,
    LawCode.MOHR: _mohr,
    LawCode.LEAD: lambda w, t, state, p: np.full(len(w), CLOSED),
    LawCode.PENDULUM: lambda w, t, state, p: np.where(t[:, -1] < 0, CLOSED, OPEN),
}
"""By law; all others are macro-elements."""


@compiled
def energies_of_points(
    codes: IntArray, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray
) -> FloatArray:
    """Energy stored and energy lost so far at each point, per unit area, shape (2, n)."""
    found = np.empty((2, w.shape[0]))
    point_energies(codes, w, t, state, p, found)
    return found
