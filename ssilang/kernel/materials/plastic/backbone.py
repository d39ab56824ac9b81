"""Curves of a first loading: G/Gmax and the hyperbola in shear, hardening from a tension test."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.curve import Curve, CurvePart

SURFACES = 20
"""Break points of the hyperbola."""
_SAME = 1e-9
"""Relative difference of two slopes, or of G/Gmax and 1, that is rounding."""


def hyperbola(reference: float, surfaces: int = SURFACES) -> Curve:
    """G/Gmax = 1 / (1 + x), x = shear strain over its reference value, at few points.

    A chord of the stress x / (1 + x) over a length h is at most h^2 / (4 x (1 + x)^2) of it too
    low. Points x = tan^2(i pi / (2 n + 2)) make that the same everywhere: (pi / (2 n + 2))^2,
    0.56 % for 20 points. The first point is the end of elasticity, G/Gmax = 1: as much too high.

    Parameters
    ----------
    reference : float
        Shear strain at which the modulus is half of the first one; > 0.
    surfaces : int
        How many points, at least 2.

    Returns
    -------
    Curve
        G/Gmax over the shear strain.
    """
    x = np.tan(np.arange(1, surfaces + 1) * np.pi / (2 * surfaces + 2)) ** 2
    ratios = 1.0 / (1.0 + x)
    ratios[0] = 1.0
    return Curve((CurvePart(reference * x, ratios, "GAMM", "GGAM"),))


@dataclass(frozen=True, eq=False)
class Backbones:
    """Polygons of shear stress over shear strain, as elastic, perfectly plastic parts side by side.

    Part i has the share of the modulus by which the polygon's slope falls at its break point, and
    yields there (Iwan 1967); behind the last point the stress stays.

    Attributes
    ----------
    strains, shares : array (n_curves, n)
        Shear strain at which each part yields, and its share of the modulus (0: no such part);
        the shares of a curve add up to 1.
    which : array (m,)
        The curve of each point.
    """

    strains: FloatArray
    shares: FloatArray
    which: IntArray


def backbones(curves: list[Curve], which: IntArray) -> Backbones:
    """The parts of curves of G/Gmax.

    Raises
    ------
    MaterialError
        For a curve that is none of a soil: see `break_points`.
    """
    found = [_parts(*break_points(curve)) for curve in curves]
    n = max(len(strains) for strains, _ in found)
    strains, shares = np.ones((len(found), n)), np.zeros((len(found), n))
    for i, (strain, share) in enumerate(found):
        strains[i, : len(strain)], shares[i, : len(share)] = strain, share
    return Backbones(strains, shares, which)


def _parts(strains: FloatArray, ratios: FloatArray) -> tuple[FloatArray, FloatArray]:
    slopes = np.append(_slopes(strains, ratios), 0.0)
    shares = np.maximum(slopes[:-1] - slopes[1:], 0.0)
    kept = shares > _SAME
    return strains[kept], shares[kept]


def _slopes(strains: FloatArray, ratios: FloatArray) -> FloatArray:
    """Slopes (n,) of stress over modulus: from the origin to the first point, to the next ..."""
    return np.diff(strains * ratios, prepend=0.0) / np.diff(strains, prepend=0.0)


def break_points(curve: Curve) -> tuple[FloatArray, FloatArray]:
    """Shear strains and G/Gmax (n,) of a curve, less a point at no strain.

    Raises
    ------
    MaterialError
        Unless strains grow from 0 on, G/Gmax begins at 1 and falls without reaching 0, and the
        stress G gamma rises ever more slowly.
    """
    part = curve.parts[0]
    strains, ratios = np.asarray(part.abscissas, float), np.asarray(part.ordinates, float)
    if len(strains) and strains[0] == 0.0:
        strains, ratios = strains[1:], ratios[1:]
    _check_values(strains, ratios)
    _check_slopes(strains, ratios)
    return strains, ratios


def _check_values(strains: FloatArray, ratios: FloatArray) -> None:
    if not len(strains) or not np.isfinite([strains, ratios]).all():
        raise MaterialError("kernel.materials.reduction-no-points")
    if strains[0] < 0:
        raise MaterialError("kernel.materials.reduction-strain-negative", strain=strains[0])
    steps = np.diff(strains)
    if (steps <= 0).any():
        i = int(np.argmax(steps <= 0))
        raise MaterialError(
            "kernel.materials.reduction-strains-fall", first=strains[i], second=strains[i + 1]
        )
    if (ratios <= 0).any():
        i = int(np.argmax(ratios <= 0))
        raise MaterialError(
            "kernel.materials.reduction-negative", strain=strains[i], ratio=ratios[i]
        )
    if abs(ratios[0] - 1.0) > _SAME:
        raise MaterialError("kernel.materials.reduction-begins", strain=strains[0], ratio=ratios[0])
    rises = np.diff(ratios) > _SAME
    if rises.any():
        i = int(np.argmax(rises))
        told = {"first": strains[i], "before": ratios[i], "second": strains[i + 1]}
        told |= {"after": ratios[i + 1]}
        raise MaterialError("kernel.materials.reduction-rises", **told)


def _check_slopes(strains: FloatArray, ratios: FloatArray) -> None:
    slopes = _slopes(strains, ratios)
    if (slopes < -_SAME).any():
        i = int(np.argmax(slopes < -_SAME))
        told = {"first": strains[i - 1], "second": strains[i], "ratio": ratios[i]}
        told |= {"least": ratios[i - 1] * strains[i - 1] / strains[i]}
        raise MaterialError("kernel.materials.reduction-softens", **told)
    stiffer = np.diff(slopes) > _SAME
    if stiffer.any():
        i = int(np.argmax(stiffer))  # the slope behind point i is steeper than before it
        before = 0.0 if i == 0 else strains[i - 1]
        start = 0.0 if i == 0 else strains[i - 1] * ratios[i - 1]
        chord = (strains[i + 1] * ratios[i + 1] - start) / (strains[i + 1] - before)
        told = {"strain": strains[i], "ratio": ratios[i]}
        told |= {"least": (start + chord * (strains[i] - before)) / strains[i]}
        raise MaterialError("kernel.materials.reduction-stiffens", **told)


_LIKE = 0.01
"""By how much the slope of the first stretch may differ from YOUN, rounded figures of a test."""


def hardening_of(tension: Curve, young: float) -> Curve:
    """Stress over plastic strain (ECRO) from stress over total strain (TRAC).

    Parameters
    ----------
    tension : Curve
        From (0, 0) through the elastic limit.

    Raises
    ------
    MaterialError
        If the curve does not begin so, if its first slope is not `young`, or if it rises by more
        than the elastic slope further on.
    """
    part = tension.parts[0]
    strain, stress = np.asarray(part.abscissas, float), np.asarray(part.ordinates, float)
    if len(strain) < 2 or strain[0] != 0.0 or stress[0] != 0.0 or strain[1] <= 0.0:
        raise MaterialError("kernel.materials.trac-begins-zero-stress")
    slope = stress[1] / strain[1]
    if abs(slope - young) > _LIKE * young:
        raise MaterialError("kernel.materials.first-slope-trac-youn", slope=slope, young=young)
    plastic = (strain[1:] - strain[1]) - (stress[1:] - stress[1]) / young
    if (np.diff(plastic) < -1e-9 * strain[1]).any():
        raise MaterialError("kernel.materials.trac-rises-more-youn")
    plastic = np.maximum.accumulate(plastic)
    return Curve((CurvePart(plastic, stress[1:], "EPSE", "SIGM"),), tension.title)
