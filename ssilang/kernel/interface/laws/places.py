"""Places under a footing, and the elastic bed that presses at them alone, compiled."""

import math

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.interface.laws.columns import Parameter as Par

STRIPES = 64
"""Places across a footing in the plane: stripes of equal width, each at its centre of area."""

ACROSS = 16
"""Places along each side of a rectangle in space, and twice the rings of a disc."""


@compiled
def n_places(dimension: int) -> int:
    """Number of places under a footing."""
    return STRIPES if dimension == 2 else ACROSS * ACROSS


@compiled
def _segment_of_disc(x: float) -> tuple[float, float]:
    """Area and first moment of a unit disc on one side of x, but for constants."""
    rest = math.sqrt(max(1.0 - x * x, 0.0))
    return math.asin(x) + x * rest, -2.0 / 3.0 * rest**3


@compiled
def place(code: int, dimension: int, i: int, p: FloatArray) -> tuple[float, float, float]:
    """Where a place is, along t1 and t2 from the centre (along the base in 2D), and its area.

    The parts of a disc in space are sectors of rings of equal width, all of one area.
    """
    if dimension == 2 and code == LawCode.DISC:
        r = p[Par.RAYO]
        a0, m0 = _segment_of_disc(2.0 * i / STRIPES - 1.0)
        a1, m1 = _segment_of_disc(2.0 * (i + 1) / STRIPES - 1.0)
        return r * (m1 - m0) / (a1 - a0), 0.0, r * r * (a1 - a0)
    if dimension == 2:
        depth = p[Par.LONG] if p[Par.LONG] > 0.0 else 1.0
        return p[Par.LARG] * ((i + 0.5) / STRIPES - 0.5), 0.0, p[Par.LARG] * depth / STRIPES
    if code == LawCode.DISC:
        rings, r = ACROSS // 2, p[Par.RAYO]
        ring = int(math.sqrt(0.25 * i + 1e-9))
        count = 4 * (2 * ring + 1)
        half, inner, outer = math.pi / count, r * ring / rings, r * (ring + 1) / rings
        middle = 2.0 / 3.0 * (outer**3 - inner**3) / (outer**2 - inner**2) * math.sin(half) / half
        angle = (2.0 * (i - 4 * ring * ring) + 1.0) * half
        area = math.pi * r * r / (ACROSS * ACROSS)
        return middle * math.cos(angle), middle * math.sin(angle), area
    s1 = p[Par.LARG] * ((i // ACROSS + 0.5) / ACROSS - 0.5)
    s2 = p[Par.LONG] * ((i % ACROSS + 0.5) / ACROSS - 0.5)
    return s1, s2, p[Par.LARG] * p[Par.LONG] / (ACROSS * ACROSS)


@compiled
def _pressed_stripes(w: FloatArray, p: FloatArray, t: FloatArray, D: FloatArray) -> None:
    """`pressed_at_places` of a strip, whose m stripes that press stand at one of its edges."""
    theta, v, width = w[0], w[1], p[Par.LARG]
    m = STRIPES if v < 0.0 else 0
    if theta != 0.0:
        edge = STRIPES * (0.5 - v / (abs(theta) * width)) - 0.5
        m = math.ceil(min(max(edge, 0.0), float(STRIPES)))
    k, step = p[Par.KN] / STRIPES, width / STRIPES
    # of s = step (i + 1/2) - width/2, i < m
    far = 0.5 * step * m * m
    first = far - 0.5 * width * m
    second = step * step * m * (4.0 * m * m - 1.0) / 12.0 - width * (far - 0.25 * width * m)
    D[0, 0], D[1, 1] = k * second, k * m
    D[0, 1] = D[1, 0] = k * first if theta >= 0.0 else -k * first
    t[0], t[1] = D[0, 0] * theta + D[0, 1] * v, D[1, 0] * theta + D[1, 1] * v


@compiled
def pressed_at_places(
    code: int, w: FloatArray, p: FloatArray, t: FloatArray, D: FloatArray
) -> None:
    """Moments and force t and tangent D of the elastic bed that presses at the places alone.

    Both follow from area, first and second moments of the places that press.
    """
    d = w.shape[0]
    if d == 2 and code == LawCode.STRIP:
        _pressed_stripes(w, p, t, D)
        return
    whole, area, m1, m2, m11, m12, m22 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    v, by_1, by_2 = (w[1], w[0], 0.0) if d == 2 else (w[2], -w[1], w[0])
    for i in range(n_places(d)):
        s1, s2, a = place(code, d, i, p)
        whole += a
        if v + by_1 * s1 + by_2 * s2 < 0.0:
            area += a
            m1 += a * s1
            m2 += a * s2
            m11 += a * s1 * s1
            m12 += a * s1 * s2
            m22 += a * s2 * s2
    k = p[Par.KN] / whole
    if d == 2:
        D[0, 0], D[0, 1], D[1, 0], D[1, 1] = k * m11, k * m1, k * m1, k * area
    else:
        D[0, 0], D[1, 1], D[2, 2] = k * m22, k * m11, k * area
        D[0, 1] = D[1, 0] = -k * m12
        D[0, 2] = D[2, 0] = k * m2
        D[1, 2] = D[2, 1] = -k * m1
    for i in range(d):
        t[i] = 0.0
        for j in range(d):
            t[i] += D[i, j] * w[j]
