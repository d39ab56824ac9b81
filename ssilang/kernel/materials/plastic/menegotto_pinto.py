"""Steel bars in cycles: the curves of Giuffre, Menegotto and Pinto, with buckling.

The law of fibres of Guedes, Pegon and Pinto (1994, "A fibre/Timoshenko beam element in CASTEM
2000", JRC I.94.31), written out also for PINTO_MENEGOTTO in Code_Aster's R5.03.09:

- first loading: elastic to STSY, a plateau to EPSH, then
  `STSU - (STSU - STSY) ((EPSU - |e|) / (EPSU - EPSH))^4` up to EPSU, and STSU beyond;
- unloading by less than a third of the yield strain comes back to that curve; by more, it starts
  the cycles;
- in a cycle, from the last reversal (er, sr) to (e0, s0), where the elastic line through the
  reversal meets the line of hardening, of slope BFAC YOUN through (+-STSY/YOUN, +-STSY):
  `s* = b x + (1 - b) x / (1 + x^R)^(1/R)`, s* and x being 0 at the reversal and 1 at (e0, s0);
- `R = ROFA - A1FA xi / (A2FA + xi)`, xi = (e before - e0) / (e0 - er), e before being the reversal
  before the last one (0 where that one lies inside e0);
- FALD = L / D > 5 is buckling (Monti and Nuti 1992): going down, b = AFAC (5 - FALD)
  exp(BFAC YOUN (er - e before) / (STSY - s8)), s8 = 4 STSY / FALD, and s0 is moved; going up
  after that, the first slope falls to YOUN (a5 + (1 - a5) exp(-A6FA (e before - e0)^2)),
  a5 = 1 + (5 - FALD) / 7.5.

R5.03.09 takes (STSU - STSY) / (EPSU - STSY / YOUN) for the slope of the line of hardening and
BFAC for the curve alone; here both are BFAC YOUN, so that the line is the curve's asymptote.
"""

import math

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.materials.plastic.conditions import require
from ssilang.kernel.materials.plastic.response import PointParameters
from ssilang.kernel.materials.plastic.uniaxial import Points

REQUIRED = ("STSY", "STSU", "EPSH", "EPSU", "ROFA", "BFAC", "A1FA", "A2FA")
BUCKLING = ("FALD", "A6FA", "CFAC", "AFAC")
"""Parameters of buckling: 0, without it, where they are not given."""
VARIABLES = ("EPSE", "EPSO", "EPSR", "SIGR", "EPSP", "SENS", "FLAM")
"""Cumulated plastic strain, strain, strain and stress of the last reversal (of the farthest point
in the first loading), strain of the reversal before; SENS 0 before yielding, +-1 in the first
loading, +-2 on the branches of cycles that go up and down; FLAM 1 after a branch that buckled."""
_STEEL = (
    "YOUN", "STSY", "STSU", "EPSH", "EPSU", "ROFA", "BFAC", "A1FA", "A2FA", "FALD", "A6FA", "CFAC",
    "AFAC",
)  # fmt: skip
"""Rows of the parameters that the compiled functions get."""
SLENDER, MOST_SLENDER = 5.0, 11.0
"""Values of FALD from which bars buckle, and up to which the law was written."""


@compiled
def _first_loading(p: FloatArray, i: int, e: float) -> tuple[float, float]:
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
def _on_branch(
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
def _points(
    p: FloatArray, strain: FloatArray, stress: FloatArray, v: FloatArray, slope: FloatArray
) -> None:
    """A step of strain of steel (see the head of this module)."""
    for i in range(len(strain)):
        E, limit = p[0, i], p[1, i]
        last, at, sense = v[i, 1], v[i, 2], v[i, 5]
        e, was, way = last + strain[i], stress[i], math.copysign(1.0, sense)
        first, yielded = abs(sense) < 2.0, abs(sense) == 1.0
        if first and not (yielded and way * (e - at) < 0.0):
            # first loading, farther than ever or not yet yielded
            stress[i], slope[i] = _first_loading(p, i, e)
            if yielded or abs(e) * E > limit:
                v[i, 2], v[i, 3], v[i, 5] = e, stress[i], math.copysign(1.0, e)
        else:
            er, sr, before = at, v[i, 3], v[i, 4]
            if first:  # unloads
                way, before = -way, -way * limit / E
            elif way * (e - last) < 0.0:  # turns round
                er, sr, before, way = last, was, at, -way
            stress[i], slope[i] = _on_branch(p, i, er, sr, before, way, v[i, 6] > 0.0, e)
            if not first or way * (e - at) * E > limit / 3.0:
                v[i, 2], v[i, 3], v[i, 4], v[i, 5] = er, sr, before, 2.0 * way
                if way < 0.0 and p[9, i] > SLENDER:
                    v[i, 6] = 1.0
        v[i, 0] += abs(strain[i] - (stress[i] - was) / E)
        v[i, 1] = e


STEEL = Points(_points, lambda p: np.stack([p[n] for n in _STEEL]))


def check(p: PointParameters) -> None:
    """Refuse steel whose curves do not exist."""
    slender = p["FALD"] > 5
    rules = {
        "STSY <= STSU": p["STSY"] <= p["STSU"],
        "STSY / YOUN <= EPSH": p["STSY"] <= p["EPSH"] * p["YOUN"] * (1 + 1e-12),
        "EPSH < EPSU": p["EPSH"] < p["EPSU"],
        "0 <= BFAC < 1": (p["BFAC"] >= 0) & (p["BFAC"] < 1),
        "0 <= A1FA < ROFA": (p["A1FA"] >= 0) & (p["A1FA"] < p["ROFA"]),
        "A2FA > 0": p["A2FA"] > 0,
        "0 <= FALD < 11": (p["FALD"] >= 0) & (p["FALD"] < 11),
        "CFAC > 0 (FALD > 5)": ~slender | (p["CFAC"] > 0),
        "AFAC >= 0 (FALD > 5)": ~slender | (p["AFAC"] >= 0),
        "A6FA >= 0 (FALD > 5)": ~slender | (p["A6FA"] >= 0),
    }
    require("ACIER_UNI", p, rules)
