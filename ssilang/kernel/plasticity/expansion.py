"""Strains of expansion in time that plastic bodies take without stress."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.elements.loads.thermal import given_strain, thermal_strain
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.plasticity.bulk import FreeStrain
from ssilang.kernel.stepping.problem.loading import TimeCurve, terms_of


def free_strains(
    load: Load | None, zones: tuple[Zone, ...], material: CellField
) -> dict[int, FreeStrain]:
    """ALPH (T - TALP) and given strains in time, by position of the zone; empty without either."""
    if not _terms(load, "T") and not _terms(load, "DEFI"):
        return {}
    found = {i: _free_strain(load, zone, material) for i, zone in enumerate(zones)}
    # beams of fibres have none, or are refused above
    return {i: strain for i, strain in found.items() if "SECTION" not in zones[i].behaviour}


def _terms(load: Load | None, name: str) -> list[tuple[object, TimeCurve]]:
    parts = () if load is None else load.parts
    return [t for p in parts if p.name.strip() == name for t in terms_of(p)]


def _free_strain(load: Load | None, zone: Zone, material: CellField) -> FreeStrain:
    reference, changes = _expansion(load, zone, material)
    for field, curve in _terms(load, "DEFI"):
        if isinstance(field, CellField):
            changes.append((given_strain(zone, field), curve))

    def at(time: float) -> FloatArray:
        total = reference
        for change, curve in changes:
            total = total + float(np.interp(time, *curve)) * change
        return total

    return at


def _expansion(
    load: Load | None, zone: Zone, material: CellField
) -> tuple[FloatArray, list[tuple[FloatArray, TimeCurve]]]:
    """Strains of T = 0, and how each field of temperatures changes them."""
    nodes = np.unique(zone.cells.connectivity)
    cold = NodeField(zone.cells.nodes, {"T": NodeValues(nodes, np.zeros(len(nodes)))})
    reference = thermal_strain(zone, material, cold)
    terms = _terms(load, "T")
    if not terms:
        return np.zeros_like(reference), []
    changes: list[tuple[FloatArray, TimeCurve]] = []
    for field, curve in terms:
        if not isinstance(field, NodeField | CellField):
            raise FieldError("kernel.plasticity.load-needs-field-temperatures")
        changes.append((thermal_strain(zone, material, field) - reference, curve))
    return reference, changes
