"""DEG3: roots of a polynomial of the third degree."""

from __future__ import annotations

import numpy as np

from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.vocabulary.terms import ANY_NUMBER


@operator(
    "DEG3",
    arg("a0", "FLOTTANT", en="constant term", range=ANY_NUMBER),
    arg("a1", "FLOTTANT", en="factor of X", range=ANY_NUMBER),
    arg("a2", "FLOTTANT", en="factor of X**2", range=ANY_NUMBER),
    arg("a3", "FLOTTANT", en="factor of X**3", range=ANY_NUMBER),
    family="numbers",
    help=Help(
        en="The three roots of A0 + A1 X + A2 X**2 + A3 X**3, each as real and imaginary part; "
        "real roots first, in growing order.",
        syntax="XR1 XI1 XR2 XI2 XR3 XI3 = DEG3 A0 A1 A2 A3 ;",
        examples=("R1 I1 R2 I2 R3 I3 = DEG3 -6. 11. -6. 1. ; LIST R1 ; LIST R2 ; LIST R3 ;",),
    ),
)
def deg3(
    call: Call, a0: float, a1: float, a2: float, a3: float
) -> tuple[float, float, float, float, float, float]:
    """Roots as eigenvalues of the companion matrix."""
    if a3 == 0.0 or not np.isfinite([a0, a1, a2, a3]).all():
        raise call.error("operators.numbers.not-third-degree")
    roots = np.roots([a3, a2, a1, a0])
    small = 1e-12 * np.abs(roots).max(initial=0.0)
    pairs = [(float(r.real), float(r.imag) if abs(r.imag) > small else 0.0) for r in roots]
    pairs.sort(key=lambda p: (p[1] != 0.0, p[0], p[1]))
    first, second, third = pairs
    return (*first, *second, *third)
