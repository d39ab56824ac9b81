"""Hardening curve of a plastic law from a tension test."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.curve import Curve, CurvePart

_LIKE = 0.01
"""By how much the slope of the first stretch may differ from YOUN, rounded figures of a test."""


def hardening_of(tension: Curve, young: float) -> Curve:
    """Stress over plastic strain (ECRO) from stress over total strain (TRAC).

    Parameters
    ----------
    tension : Curve
        From (0, 0) through the elastic limit.
    young : float

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
