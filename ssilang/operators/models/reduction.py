"""Curves in MATE: TRAC in place of ECRO, cyclic soil by GGAM or by the strain GAMR."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.plastic.backbone import break_points, hyperbola
from ssilang.kernel.materials.plastic.tension_curve import hardening_of
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


def tension_to_hardening(values: dict[str, tuple[NDArray[Any], Support]]) -> None:
    """Replace TRAC by the ECRO that it means.

    Raises
    ------
    MaterialError
        If ECRO is given too, or if YOUN is missing or not one number.
    """
    if "TRAC" not in values:
        return
    table, support = values.pop("TRAC")
    if "ECRO" in values:
        raise MaterialError("operators.models.hardening-given-twice")
    given = values["YOUN"][0] if "YOUN" in values else np.empty((0, 0))
    if given.dtype == object or not given.size or (given != given.flat[0]).any():
        raise MaterialError("operators.models.trac-needs-one-youn")
    if not all(isinstance(v, Curve) for v in table.flat):
        raise MaterialError("operators.models.trac-is-a-curve")
    made = {id(v): hardening_of(v, float(given.flat[0])) for v in table.flat}
    curves = np.empty(table.shape, dtype=object)
    for place, curve in np.ndenumerate(table):
        curves[place] = made[id(curve)]
    values["ECRO"] = curves, support
