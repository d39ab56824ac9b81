"""Steel and concrete of fibres at many points, compiled: `menegotto_pinto`, `hognestad` say what.

Parameters stand in rows (k, m), in the order of `STEEL` and `CONCRETE`; stress (m,) and variables
(m, ...) are brought up to date, `slope` (m,) is the derivative by the step of strain (m,).
"""

import math

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled

STEEL = (
    "YOUN", "STSY", "STSU", "EPSH", "EPSU", "ROFA", "BFAC", "A1FA", "A2FA", "FALD", "A6FA", "CFAC",
    "AFAC",
)  # fmt: skip
SLENDER, MOST_SLENDER = 5.0, 11.0
"""Values of FALD from which bars buckle, and up to which the law was written."""


@compiled
def first_loading(p: FloatArray, i: int, e: float) -> tuple[float, float]:
    """Stress and slope of the first loading of steel."""
    E, limit, top, start, end = p[0, i], p[1, i], p[2, i], p[3, i], p[4, i]
    size = abs(e)
    if size * E <= limit:
        return E * e, E
    stress, slope = limit, 0.0
    if size > start:
        left = min(max((end - size) / (end - start), 0.0), 1.0)
        stress = top - (top - limit) * left**4
        slope = 4.0 * (top - limit) * left**3 / (end - start)
    return math.copysign(stress, e), slope


@compiled
def on_branch(
    p: FloatArray,
    i: int,
    er: float,
    sr: float,
    before: float,
    way: float,
    buckled: bool,
    e: float,
) -> tuple[float, float]:
    """Stress and slope of steel on a branch from a reversal (er, sr) up or down."""
    E, limit, b, ratio = p[0, i], p[1, i], p[6, i], p[9, i]
    # the corner: the first line through the reversal meets the line of hardening
    e0 = (way * limit * (1.0 - b) + E * er - sr) / (E - b * E)
    share, moved = b, 0.0
    if ratio > SLENDER and way < 0.0:
        last = limit - 4.0 * limit / ratio
        power = min(b * E * (er - before) / last, 50.0)
        share = p[12, i] * (SLENDER - ratio) * math.exp(power)
        ease = (MOST_SLENDER - ratio) / (10.0 * (math.exp(p[11, i] * ratio) - 1.0))
        moved = ease * b * E * (b - share) / (1.0 - share)
    elif ratio > SLENDER and buckled:
        a5 = 1.0 + (SLENDER - ratio) / 7.5
        soft = E * (a5 + (1.0 - a5) * math.exp(-p[10, i] * (before - e0) ** 2))
        e0 = (way * limit * (1.0 - b) + soft * er - sr) / (soft - b * E)
        share = b * E / soft
    s0 = way * limit * (1.0 - b) + b * E * e0 - moved
    span = e0 - er
    if way * span <= 1e-12 * limit / E:  # a reversal beyond the line of hardening: its slope
        return sr + b * E * (e - er), b * E
    xi = max(way * (before - e0), 0.0) / abs(span)
    R = p[5, i] - p[7, i] * xi / (p[8, i] + xi)
    x = max((e - er) / span, 0.0)
    bend = 1.0 + x**R
    root = bend ** (-1.0 / R)
    stress = sr + (s0 - sr) * (share + (1.0 - share) * root) * x
    return stress, (s0 - sr) / span * (share + (1.0 - share) * root / bend)


@compiled
def steel_points(
    p: FloatArray, strain: FloatArray, stress: FloatArray, v: FloatArray, slope: FloatArray
) -> None:
    """A step of strain of steel; variables EPSE EPSO EPSR SIGR EPSP SENS FLAM."""
    for i in range(len(strain)):
        E, limit = p[0, i], p[1, i]
        last, at, sense = v[i, 1], v[i, 2], v[i, 5]
        e, was, way = last + strain[i], stress[i], math.copysign(1.0, sense)
        first, yielded = abs(sense) < 2.0, abs(sense) == 1.0
        if first and not (yielded and way * (e - at) < 0.0):
            # first loading, farther than ever or not yet yielded
            stress[i], slope[i] = first_loading(p, i, e)
            if yielded or abs(e) * E > limit:
                v[i, 2], v[i, 3], v[i, 5] = e, stress[i], math.copysign(1.0, e)
        else:
            er, sr, before = at, v[i, 3], v[i, 4]
            if first:  # unloads
                way, before = -way, -way * limit / E
            elif way * (e - last) < 0.0:  # turns round
                er, sr, before, way = last, was, at, -way
            stress[i], slope[i] = on_branch(p, i, er, sr, before, way, v[i, 6] > 0.0, e)
            if not first or way * (e - at) * E > limit / 3.0:
                v[i, 2], v[i, 3], v[i, 4], v[i, 5] = er, sr, before, 2.0 * way
                if way < 0.0 and p[9, i] > SLENDER:
                    v[i, 6] = 1.0
        v[i, 0] += abs(strain[i] - (stress[i] - was) / E)
        v[i, 1] = e


CONCRETE = ("STRENGTH", "PEAK", "FALL", "ST85", "STFT", "TRAF")
"""The first three with confinement: strength, its strain, relative slope behind it."""


@compiled
def concrete_points(
    p: FloatArray, strain: FloatArray, stress: FloatArray, v: FloatArray, slope: FloatArray
) -> None:
    """A step of strain of concrete; variables EPSE EPSO EPSM OUVE."""
    for i in range(len(strain)):
        top, peak, fall, rest = p[0, i], p[1, i], p[2, i], p[3, i]
        E = 2.0 * top / peak
        e = v[i, 1] + strain[i]
        least = min(v[i, 2], e)
        # the curve of the first compression at the least strain
        x = -least / peak
        bottom, rise = -top * x * (2.0 - x), E * (1.0 - x)
        if x > 1.0:
            line = top * (1.0 - fall * (-least - peak))
            bottom, rise = -max(line, rest), -top * fall if line > rest else 0.0
        back = E * (1.0 + x) / (1.0 + x + x * x)
        left = least - bottom / back
        opening = max(e - left, 0.0)
        if e <= least and e < 0.0:
            stress[i], slope[i] = bottom, rise
        elif e < left:
            stress[i], slope[i] = back * (e - left), back
        else:
            stress[i], slope[i] = _crack(E, p[4, i], p[5, i], opening, v[i, 3])
        v[i, 0], v[i, 1], v[i, 2], v[i, 3] = left, e, least, max(v[i, 3], opening)


@compiled
def _crack(
    E: float, strength: float, reach: float, opening: float, largest: float
) -> tuple[float, float]:
    """Stress and slope of an opening >= 0, the largest one before known."""
    crack, far = strength / E, max(opening, largest)
    if far <= crack:
        return E * opening, E
    length = (reach - 1.0) * crack
    soft = strength * (1.0 - (far - crack) / length) if length > 0.0 else 0.0
    if soft <= 0.0:
        return 0.0, 0.0
    if opening < largest:
        return soft / far * opening, soft / far
    return soft, -strength / length
