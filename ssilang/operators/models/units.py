"""Numbers of materials that look like another unit than the deck's, where OPTI 'UNIT' says it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.language.vocabulary import Quantity
from ssilang.language.vocabulary.terms import Range
from ssilang.language.vocabulary.unit_systems import UnitSystem, likely_units
from ssilang.operators.prelude import *
from ssilang.operators.vocabulary import words

Given = tuple[NDArray[Any], Any]
_CODE = "operators.models.unusual-value"
_SIZES = Range(high=5000.0)  # m; what soil and structures measure across at most


def warn_of_units(call: Call, zone: Zone, given: Mapping[str, Given]) -> None:
    """Warn of parameters out of what is usual in the deck's units; nought is one in any unit.

    The library's own procedures give numbers that are no material's, and stay unheard.

    Parameters
    ----------
    given : mapping of str to (array, object)
        Parameters of the zone: their values, and what the script gave for them.
    """
    session, system = call.session, workspace(call.session).units
    _warn_of_sign(call, given)
    if system is None:
        _warn_of_friction(call, zone, given)
    if system is None or session.frame.procedure in session.library.standard_names:
        return
    _warn_of_size(call, zone, system)
    for name, (array, said) in given.items():
        meant = words.parameter(name, zone)
        if meant is None or meant.unit is None or array.dtype != float:
            continue
        numbers = array[np.isfinite(array) & (array != 0.0)]
        ends = (float(numbers.min()), float(numbers.max())) if numbers.size else ()
        here = system.factor(meant.unit)
        unusual = next((v for v in ends if v * here not in meant.usual), None)
        if unusual is not None:
            _warn(call, meant, unusual, said, system)


def _warn_of_size(call: Call, zone: Zone, system: UnitSystem) -> None:
    """Warn, once, of a body of some kilometres: millimetres of a drawing, most often."""
    here, code = system.factor("m"), "operators.models.unusual-size"
    corners = zone.cells.coordinates
    size = float(np.ptp(corners.reshape(-1, corners.shape[2]), axis=0).max())
    if size * here in _SIZES or any(w.code == code for w in call.session.warnings):
        return
    told = {"size": size, "unit": system.written("m"), "system": system.name}
    call.warn(code, likely=list(likely_units(size, "m", _SIZES, system)), **told)


def _warn_of_sign(call: Call, given: Mapping[str, Given]) -> None:
    """Warn of negative coefficients of friction but -1: the shear has no bound there."""
    array, said = given.get("FROT", (np.empty(0), None))
    wrong = array[(array < 0.0) & (array != -1.0)] if array.dtype == float else array[:0]
    if wrong.size:
        told = {"name": "FROT", "value": float(wrong[0])}
        call.warn("operators.models.friction-negative", said, **told)


def _warn_of_friction(call: Call, zone: Zone, given: Mapping[str, Given]) -> None:
    """Warn of coefficients of friction that are angles, which shows in any system of units."""
    for name in ("FROT", "MU"):
        meant = words.parameter(name, zone) if name in given else None
        if meant is None or meant.unit or not np.isfinite(meant.usual.high):
            continue
        array, said = given[name]
        value = float(array.max()) if array.dtype == float and array.size else 0.0
        if value > meant.usual.high:
            call.warn(
                "operators.models.friction-as-angle",
                said,
                name=name,
                value=value,
                tangent=float(np.tan(np.radians(min(value, 89.0)))),
                degrees=value < 90.0,
            )


def _warn(call: Call, meant: Quantity, value: float, said: Any, system: UnitSystem) -> None:
    """Say it where the value stands, once for each place and parameter."""
    unit, low, high = meant.unit or "", meant.usual.low, meant.usual.high
    here, likely = system.factor(unit), likely_units(value, unit, meant.usual, system)
    warning = call.error(
        _CODE,
        said,
        name=meant.name,
        value=value,
        unit=system.written(unit),
        small=abs(value) * here < min(abs(low), abs(high)),
        system=system.name,
        low=low / here,
        high=high / here,
        meaning=meant.meaning(call.session.language),
        likely=list(likely),
        written=[f"{v:g}" for v in likely.values()],
    )
    warning.warns = True
    before = [w for w in call.session.warnings if w.code == _CODE and w.span == warning.span]
    if not any(w.data["name"] == meant.name for w in before):
        call.session.report(warning)
