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

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.materials.plastic.conditions import require
from ssilang.kernel.materials.plastic.response import PointParameters, Response
from ssilang.kernel.materials.plastic.uniaxial import elastic_shear, fibre_tangent

REQUIRED = ("STSY", "STSU", "EPSH", "EPSU", "ROFA", "BFAC", "A1FA", "A2FA")
BUCKLING = ("FALD", "A6FA", "CFAC", "AFAC")
"""Parameters of buckling: 0, without it, where they are not given."""
VARIABLES = ("EPSE", "EPSO", "EPSR", "SIGR", "EPSP", "SENS", "FLAM")
"""Cumulated plastic strain, strain, strain and stress of the last reversal (of the farthest point
in the first loading), strain of the reversal before; SENS 0 before yielding, +-1 in the first
loading, +-2 on the branches of cycles that go up and down; FLAM 1 after a branch that buckled."""
SLENDER, MOST_SLENDER = 5.0, 11.0
"""Values of FALD from which bars buckle, and up to which the law was written."""


@dataclass(frozen=True, eq=False)
class Branch:
    """Where branches of cycles start: arrays (m,).

    `strain` and `stress` of the reversal, `before` the strain of the reversal before, `way` +1 up
    or -1 down, `buckled` whether an earlier branch down did.
    """

    strain: FloatArray
    stress: FloatArray
    before: FloatArray
    way: FloatArray
    buckled: NDArray[np.bool_]


def first_loading(p: PointParameters, strain: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Stress and slope (m,) of the first loading."""
    E, limit, top, start, end = (p[n] for n in ("YOUN", "STSY", "STSU", "EPSH", "EPSU"))
    size = np.abs(strain)
    left = np.clip((end - size) / (end - start), 0.0, 1.0)
    hard = np.where(size > start, top - (top - limit) * left**4, limit)
    rise = np.where(size > start, 4 * (top - limit) * left**3 / (end - start), 0.0)
    still = size * E <= limit
    return np.where(still, E * strain, np.sign(strain) * hard), np.where(still, E, rise)


def on_branch(p: PointParameters, start: Branch, e: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Stress and slope (m,) on branches of cycles at strains beyond their reversals."""
    E, limit, b = p["YOUN"], p["STSY"], p["BFAC"]
    way, slender = start.way, p["FALD"] > SLENDER
    down, up = slender & (way < 0), slender & (way > 0) & start.buckled

    def corner(slope: FloatArray) -> FloatArray:
        push = way * limit * (1 - b) + slope * start.strain - start.stress
        return push / (slope - b * E)

    e0 = corner(E)
    a5 = 1 + (SLENDER - p["FALD"]) / 7.5
    soft = E * (a5 + (1 - a5) * np.exp(-p["A6FA"] * (start.before - e0) ** 2))
    e0 = np.where(up, corner(np.where(up, soft, E)), e0)
    s0 = way * limit * (1 - b) + b * E * e0
    fall, moved = _buckling(p, start)
    share = np.where(down, fall, np.where(up, b * E / soft, b))
    s0 = s0 - np.where(down, moved, 0.0)
    span = e0 - start.strain
    # a reversal that lies beyond the line of hardening follows that line's slope
    inside = way * span > 1e-12 * limit / E
    span, height = np.where(inside, span, 1.0), s0 - start.stress
    xi = np.maximum(way * (start.before - e0), 0.0) / np.abs(span)
    R = p["ROFA"] - p["A1FA"] * xi / (p["A2FA"] + xi)
    x = np.where(inside, np.maximum((e - start.strain) / span, 0.0), 0.0)
    bend = 1 + x**R
    curve = share * x + (1 - share) * x / bend ** (1 / R)
    slope = height / span * (share + (1 - share) / bend ** (1 + 1 / R))
    line = start.stress + b * E * (e - start.strain)
    return np.where(inside, start.stress + height * curve, line), np.where(inside, slope, b * E)


def _buckling(p: PointParameters, start: Branch) -> tuple[FloatArray, FloatArray]:
    """Slope share of a branch that buckles, and what its corner's stress falls by: (m,) each."""
    E, limit, b = p["YOUN"], p["STSY"], p["BFAC"]
    ratio = np.where(p["FALD"] > SLENDER, p["FALD"], 2 * SLENDER)
    ease = np.where(p["CFAC"] > 0, p["CFAC"], 1.0)
    last = limit - 4 * limit / ratio
    power = b * E * (start.strain - start.before) / last
    fall = p["AFAC"] * (SLENDER - ratio) * np.exp(np.minimum(power, 50.0))
    share = (MOST_SLENDER - ratio) / (10 * (np.exp(ease * ratio) - 1))
    return fall, share * b * E * (b - fall) / (1 - fall)


def respond(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Steel in cycles (see the head of this module)."""
    p, E = parameters, parameters["YOUN"]
    yielding = p["STSY"] / E
    _, last, at, held, before, sense, buckled = variables.T
    e, sign = last + strain[:, 0], np.sign(sense)
    first, yielded = np.abs(sense) < 2, np.abs(sense) == 1
    farther = np.where(yielded, sign * (e - at) >= 0, np.abs(e) > yielding)
    back = yielded & ~farther  # unloads from the first loading
    starts = back & (sign * (at - e) > yielding / 3)
    turns = ~first & (sign * (e - last) < 0)
    leaves = back | turns
    start = Branch(
        np.where(turns, last, at),
        np.where(turns, stress[:, 0], held),
        np.where(turns, at, np.where(back, -sign * yielding, before)),
        np.where(leaves, -sign, np.where(sign == 0, 1.0, sign)),
        buckled > 0,
    )
    curve, rise = first_loading(p, e)
    cycle, slope = on_branch(p, start, e)
    outer = first & ~back
    after = np.where(outer, curve, cycle)
    tangent = np.where(outer, rise, slope)
    cyclic = ~first | starts
    on_curve = first & farther
    moved = strain[:, 0] - (after - stress[:, 0]) / E
    kept = np.column_stack([
        variables[:, 0] + np.abs(moved),
        e,
        np.where(cyclic, start.strain, np.where(on_curve, e, at)),
        np.where(cyclic, start.stress, np.where(on_curve, after, held)),
        np.where(cyclic, start.before, before),
        np.where(cyclic, 2 * start.way, np.where(on_curve, np.sign(e), sense)),
        start.buckled | (cyclic & (start.way < 0) & (p["FALD"] > SLENDER)),
    ])  # fmt: skip
    found = elastic_shear(p, stress, strain)
    found[:, 0] = after
    return Response(found, kept, fibre_tangent(p, tangent))


def check(p: PointParameters) -> None:
    """Refuse steel whose curves do not exist.

    Raises
    ------
    MaterialError
        Naming what must hold.
    """
    slender = p["FALD"] > SLENDER
    rules = {
        "STSY <= STSU": p["STSY"] <= p["STSU"],
        "STSY / YOUN <= EPSH": p["STSY"] <= p["EPSH"] * p["YOUN"] * (1 + 1e-12),
        "EPSH < EPSU": p["EPSH"] < p["EPSU"],
        "0 <= BFAC < 1": (p["BFAC"] >= 0) & (p["BFAC"] < 1),
        "0 <= A1FA < ROFA": (p["A1FA"] >= 0) & (p["A1FA"] < p["ROFA"]),
        "A2FA > 0": p["A2FA"] > 0,
        "0 <= FALD < 11": (p["FALD"] >= 0) & (p["FALD"] < MOST_SLENDER),
        "CFAC > 0, FALD > 5": ~slender | (p["CFAC"] > 0),
        "AFAC >= 0, FALD > 5": ~slender | (p["AFAC"] >= 0),
        "A6FA >= 0, FALD > 5": ~slender | (p["A6FA"] >= 0),
    }
    require("ACIER_UNI", p, rules)
