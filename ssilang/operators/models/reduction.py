"""Cyclic soil in MATE: curves of G/Gmax (GGAM), or the reference strain of a hyperbola (GAMR)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.plastic.backbone import break_points, hyperbola
from ssilang.language.run.call import Call

_PERCENT = 1e-2
"""Shear strain at half of Gmax beyond which no soil is known: plastic clay has 5e-3."""


def reference_to_curve(
    call: Call, values: dict[str, tuple[NDArray[Any], Support]], said: dict[str, Any]
) -> None:
    """Replace GAMR by the curve GGAM that it means; look at curves that are given.

    A field of GAMR counts by its mean in each cell.

    Raises
    ------
    MaterialError
        If both are given, or for curves that no soil has.
    """
    if "GAMR" in values:
        table, _ = values.pop("GAMR")
        if "GGAM" in values:
            raise call.error("operators.models.reduction-given-twice", said["GAMR"])
        if table.dtype == object:
            raise call.error("operators.models.gamr-is-a-number", said["GAMR"])
        references = table.mean(axis=1)
        different, place = np.unique(references, return_inverse=True)
        curves = np.array([hyperbola(float(g)) for g in different], dtype=object)
        values["GGAM"] = curves[place][:, None], "GRAVITE"
        _warn_of_percent(call, said["GAMR"], float(different[-1]))
    elif "GGAM" in values:
        for curve in {id(v): v for v in values["GGAM"][0].flat}.values():
            if not isinstance(curve, Curve):
                raise MaterialError("kernel.plasticity.parameter-curve", name="GGAM")
            strains, ratios = break_points(curve)
            half = float(np.interp(-0.5, -ratios, strains))
            _warn_of_percent(call, said["GGAM"], half if ratios[-1] <= 0.5 else 0.0)


def _warn_of_percent(call: Call, value: Any, half: float) -> None:
    """Warn of strains that are percentages."""
    if half > _PERCENT:
        warning = call.error("operators.models.strains-in-percent", value, half=half)
        warning.warns = True
        call.session.report(warning)
