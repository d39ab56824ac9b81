"""Numbers of materials that are unusual: by themselves, beside others, in the deck's units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.elements.catalog import LOCKING
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.language.run.call import Call
from ssilang.language.vocabulary import Quantity
from ssilang.language.vocabulary.terms import Range
from ssilang.language.vocabulary.unit_systems import UnitSystem, likely_units
from ssilang.operators.vocabulary import words
from ssilang.operators.workspace import workspace

Given = tuple[NDArray[Any], Any]
_CODE = "operators.models.unusual-value"
COMPRESSIBLE = 0.49
"""Poisson's ratio beyond which linear cells are told: a punch on QUA4 is 4 % too stiff there, by 27 %
at 0.499; on CUB8 by 43 % and three times."""
_SIZES = Range(high=5000.0)  # m; what soil and structures measure across at most


def warn_of_units(call: Call, zone: Zone, given: Mapping[str, Given]) -> None:
    """Warn of parameters out of what is usual, by their unit in the deck's; nought is one in any.

    The library's own procedures give numbers that are no material's, and stay unheard.

    Parameters
    ----------
    given : mapping of str to (array, object)
        Parameters of the zone: their values, and what the script gave for them.
    """
    session, system = call.session, workspace(call.session).units
    _warn_of_sign(call, given)
    if session.frame.procedure in session.library.standard_names:
        return
    _warn_of_numbers(call, zone, given)
    _warn_of_ratios(call, zone, given)
    _warn_of_locking(call, zone, given)
    if system is None:
        return
    _warn_of_size(call, zone, system)
    for name, (array, said) in given.items():
        meant = words.parameter(name, zone)
        if meant is None or not meant.unit or array.dtype != float:
            continue
        here = system.factor(meant.unit)
        unusual = next((v for v in _ends(array) if v * here not in meant.usual), None)
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


def _warn_of_numbers(call: Call, zone: Zone, given: Mapping[str, Given]) -> None:
    """Warn of numbers without unit out of what is usual, which shows in any system of units."""
    for name, (array, said) in given.items():
        meant = words.parameter(name, zone)
        if meant is None or meant.unit != "" or array.dtype != float:
            continue
        value = next((v for v in _ends(array) if v not in meant.usual), None)
        if value is None or (value < 0.0 and name == "FROT"):  # told by its sign
            continue
        if name in ("FROT", "MU"):
            tangent = float(np.tan(np.radians(min(value, 89.0))))
            told: dict[str, Any] = {"tangent": tangent, "degrees": value < 90.0}
            call.warn("operators.models.friction-as-angle", said, name=name, value=value, **told)
            continue
        told = {"range": meant.usual.text(name), "meaning": meant.meaning(call.session.language)}
        call.warn("operators.models.unusual-number", said, name=name, value=value, **told)


def _warn_of_ratios(call: Call, zone: Zone, given: Mapping[str, Given]) -> None:
    """Warn of parameters out of proportion to another one of the same unit."""
    for name, (array, said) in given.items():
        meant = words.parameter(name, zone)
        for other, usual in () if meant is None else meant.beside.items():
            base = given[other][0] if other in given else np.empty(0)
            if not (array.dtype == base.dtype == float and array.size and base.size and base.all()):
                continue
            ratio = float((array / base.mean(axis=1, keepdims=True)).max())
            if ratio not in usual:
                told = {"ratio": ratio, "other": other, "range": usual.text(f"{name}/{other}")}
                code, value = "operators.models.unusual-ratio", float(array.max())
                call.warn(code, said, name=name, value=value, **told)


def _warn_of_locking(call: Call, zone: Zone, given: Mapping[str, Given]) -> None:
    """Warn of nearly incompressible matter in elements that are too stiff for it."""
    array, said = given.get("NU", (np.empty(0), None))
    value = max(_ends(array), default=0.0) if array.dtype == float else 0.0
    if value > COMPRESSIBLE and zone.element in LOCKING and zone.mode is not Mode.PLANE_STRESS:
        told = {"mean": LOCKING[zone.element], "element": zone.element}
        call.warn("operators.models.locks", said, value=value, **told)


def _ends(array: NDArray[Any]) -> tuple[float, ...]:
    """The least and the largest finite number, none where all are nought."""
    numbers = array[np.isfinite(array) & (array != 0.0)]
    return (float(numbers.min()), float(numbers.max())) if numbers.size else ()


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
