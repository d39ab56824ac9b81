"""The compiled laws of joints behind one interface: by code, on one point or on many.

Numba has no table of functions whose calls cost nothing: a chain of comparisons is made of
`law_table.LAWS` instead, a function a law, each written into the one before.
"""

from collections.abc import Callable
from typing import Any

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled, compiled_inline
from ssilang.kernel.interface.laws.bed_law import bed_energies, bed_points
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


_last, *_others = {law.code: law for law in reversed(LAWS.values())}.values()
point_response, _stored = _last.point, _last.energy
for _law in _others:
    point_response = _or_others(int(_law.code), _law.point, point_response)
    _stored = _or_others(int(_law.code), _law.energy, _stored)


@compiled
def first_place(codes: IntArray) -> int:
    """The first of the places under footings, which stand behind all other points."""
    i = len(codes)
    while i > 0 and codes[i - 1] == LawCode.BED:
        i -= 1
    return i


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
    first = first_place(codes)
    for i in range(first):
        point_response(codes[i], w[i], state[i], p[i], t[i], new[i], D[i])
    if first < len(codes):
        bed_points(first, w, state, p, t, new, D)


@compiled
def point_energies(
    codes: IntArray, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray,
    found: FloatArray,
) -> None:  # fmt: skip
    """Energy stored and energy lost so far of n points at their own state, into `found` (2, n).

    Per unit area.
    """
    first = first_place(codes)
    for i in range(first):
        found[0, i] = _stored(codes[i], w[i], t[i], state[i], p[i])
        spent = opening_loss(state[i, Var.XI], p[i, Par.FU], p[i, Par.GF])
        found[1, i] = spent + state[i, Var.SHEAR_LOSS]
    if first < len(codes):
        bed_energies(first, w, t, state, p, found)
