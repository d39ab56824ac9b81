"""The compiled laws of joints behind one interface: by code, on one point or on many.

Numba has no table of functions whose calls cost nothing: a chain of comparisons is made of
`law_table.LAWS` instead, a function a law, each written into the one before.
"""

from collections.abc import Callable
from typing import Any

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled, compiled_inline
from ssilang.kernel.interface.laws.bed_law import PLACE, bed_points
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.interface.laws.columns import Parameter as Par
from ssilang.kernel.interface.laws.columns import Variable as Var
from ssilang.kernel.interface.laws.law_table import LAWS
from ssilang.kernel.interface.laws.sdm_law import opening_loss

Answer = Callable[..., float | None]


def _or_others(own: int, law: Answer, others: Answer) -> Any:
    """The law's answer where the code is its own, else that of the others."""

    @compiled_inline
    def answer(code: int, *rest: Any) -> float | None:
        if code == own:
            return law(code, *rest)
        return others(code, *rest)

    return answer


point_response, _stored = PLACE.point, PLACE.energy
for _law in {law.code: law for law in reversed(LAWS.values())}.values():
    point_response = _or_others(int(_law.code), _law.point, point_response)
    _stored = _or_others(int(_law.code), _law.energy, _stored)


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
    spent = opening_loss(state[Var.XI], p[Par.FU], p[Par.GF])
    return _stored(code, w, t, state, p), spent + state[Var.SHEAR_LOSS]
