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

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.materials.plastic.conditions import require
from ssilang.kernel.materials.plastic.response import PointParameters
from ssilang.kernel.materials.plastic.uniaxial import Along

REQUIRED = ("STSY", "STSU", "EPSH", "EPSU", "ROFA", "BFAC", "A1FA", "A2FA")
BUCKLING = ("FALD", "A6FA", "CFAC", "AFAC")
"""Parameters of buckling: 0, without it, where they are not given."""
VARIABLES = ("EPSE", "EPSO", "EPSR", "SIGR", "EPSP", "SENS", "FLAM")
"""Cumulated plastic strain, strain, strain and stress of the last reversal (of the farthest point
in the first loading), strain of the reversal before; SENS 0 before yielding, +-1 in the first
loading, +-2 on the branches of cycles that go up and down; FLAM 1 after a branch that buckled."""


def respond(
    p: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Along:
    """Steel in cycles (see the head of this module)."""
    from ssilang.kernel.materials.plastic.fibre_cycles import steel_points

    along = Along(stress.copy(), variables.copy(), np.empty(len(stress)))
    steel_points(p.once(_table), strain, *along)
    return along


def _table(p: PointParameters) -> FloatArray:
    from ssilang.kernel.materials.plastic.fibre_cycles import STEEL

    return np.stack([p[n] for n in STEEL])


def check(p: PointParameters) -> None:
    """Refuse steel whose curves do not exist.

    Raises
    ------
    MaterialError
        Naming what must hold.
    """
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
