"""Fibres of concrete: Hognestad's parabola with softening, confinement, and cracks.

Hognestad (1951); confinement of Model Code 1990 and Eurocode 8 as fibres of CASTEM 2000 have it
(Guedes, Pegon and Pinto 1994, JRC I.94.31), with the parameters of Cast3M's BETON_UNI. Compression
counts positive here:

- confinement by a = ALF1 and w = OME1: the strength is `f = beta STFC` at the strain
  `c = beta^2 EZER`, beta = min(1 + 2.5 a w, 1.125 + 1.25 a w);
- first compression: `f x (2 - x)`, x = e / c, then `f (1 - Z (e - c))`, at least ST85. Z is ZETA;
  where ZETA = 0, the line meets 0.85 STFC at 0.0035 + 0.1 a w.

Notice and codes leave open, and it is so here:

- unloading from the largest compression (e, s) along the slope `E0 (1 + x) / (1 + x + x^2)`,
  E0 = 2 f / c being the first slope of the parabola, until no stress is left, and back the same;
- tension from there: slope E0 up to STFT, then down to nothing at TRAF times the strain of STFT;
  a crack that is not full closes along the line to where it began, and all of the compression
  comes back there: the stiff closing, FAMX < 0. The gradual one is not built.

YOUN makes the elastic stiffness only (RIGI, shear): the curves have slopes of their own.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.conditions import require
from ssilang.kernel.materials.plastic.response import PointParameters
from ssilang.kernel.materials.plastic.uniaxial import Points

REQUIRED = ("STFC", "EZER", "STFT", "ZETA", "ST85", "TRAF")
DEFAULTS = {"ALF1": 0.0, "OME1": 0.0, "FAMX": -1.0}
UNUSED = ("STPT", "FACL", "FAM1", "FAM2")
"""Parameters of the other closing of cracks."""
VARIABLES = ("EPSE", "EPSO", "EPSM", "OUVE")
"""Strain that is left without stress, strain, least strain so far, largest opening so far."""
LIMIT, SPREAD, REST = 0.0035, 0.1, 0.85
"""Strain of concrete whose strength has fallen to REST of what it is without confinement, and what
confinement a w adds to it."""


def confined(p: PointParameters) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Strength, its strain, and the relative slope of the softening: (m,) each."""
    hoops = p["ALF1"] * p["OME1"]
    beta = np.minimum(1 + 2.5 * hoops, 1.125 + 1.25 * hoops)
    strength, peak = beta * p["STFC"], beta**2 * p["EZER"]
    reach = LIMIT + SPREAD * hoops - peak
    slope = (1 - REST / beta) / np.where(reach > 0, reach, 1.0)
    return strength, peak, np.where(p["ZETA"] > 0, p["ZETA"], slope)


def _table(p: PointParameters) -> FloatArray:
    return np.stack([*confined(p), *(p[n] for n in ("ST85", "STFT", "TRAF"))])


@compiled
def _points(
    p: FloatArray, strain: FloatArray, stress: FloatArray, v: FloatArray, slope: FloatArray
) -> None:
    """A step of strain of concrete (see the head of this module).

    Rows of p: strength, its strain, relative slope behind it, ST85, STFT, TRAF.
    """
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


CONCRETE = Points(_points, _table)


def check(p: PointParameters) -> None:
    """Refuse concrete whose curves do not exist, or whose cracks close gradually."""
    if (p["FAMX"] >= 0).any():
        soft = MaterialError("kernel.materials.soft-crack-closing", value=p["FAMX"].max())
        raise soft.about("FAMX")
    if ((p["ZETA"] > 0) & (p["ALF1"] * p["OME1"] > 0)).any():
        raise MaterialError("kernel.materials.slope-and-confinement").about("ZETA")
    hoops = p["ALF1"] * p["OME1"]
    _, peak, _ = confined(p)
    free = (p["ZETA"] > 0) | (peak < LIMIT + SPREAD * hoops)
    rules = {
        "STFT >= 0": p["STFT"] >= 0,
        "ALF1 >= 0": p["ALF1"] >= 0,
        "OME1 >= 0": p["OME1"] >= 0,
        "ZETA >= 0": p["ZETA"] >= 0,
        "0 <= ST85 <= STFC": (p["ST85"] >= 0) & (p["ST85"] <= p["STFC"]),
        "TRAF > 1": p["TRAF"] > 1,
        "beta^2 EZER < 0.0035 + 0.1 ALF1 OME1 (ZETA = 0)": free,
    }
    require("BETON_UNI", p, rules)
