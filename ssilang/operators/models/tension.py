"""TRAC in MATE: a tension curve in the place of the hardening curve ECRO."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.plastic.tension_curve import hardening_of


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
