"""Strains of expansion in time that plastic bodies take without stress."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.elements.loads.thermal import thermal_strain
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.plasticity.bulk import FreeStrain
from ssilang.kernel.stepping.problem.loading import TimeCurve, terms_of


def free_strains(
    load: Load | None, zones: tuple[Zone, ...], material: CellField
) -> dict[int, FreeStrain]:
    """ALPH (T - TALP) in time, by position of the zone; empty without a load T."""
    parts = [] if load is None else [p for p in load.parts if p.name.strip() == "T"]
    if not parts:
        return {}
    found = {
        i: _free_strain(zone, material, [t for p in parts for t in terms_of(p)])
        for i, zone in enumerate(zones)
    }
    # beams of fibres have none, or are refused above
    return {i: strain for i, strain in found.items() if "SECTION" not in zones[i].behaviour}


def _free_strain(
    zone: Zone, material: CellField, terms: Sequence[tuple[object, TimeCurve]]
) -> FreeStrain:
    nodes = np.unique(zone.cells.connectivity)
    cold = NodeField(zone.cells.nodes, {"T": NodeValues(nodes, np.zeros(len(nodes)))})
    reference = thermal_strain(zone, material, cold)
    changes: list[tuple[FloatArray, TimeCurve]] = []
    for field, curve in terms:
        if not isinstance(field, NodeField | CellField):
            raise FieldError("kernel.plasticity.load-needs-field-temperatures")
        changes.append((thermal_strain(zone, material, field) - reference, curve))

    def at(time: float) -> FloatArray:
        total = reference
        for change, curve in changes:
            total = total + float(np.interp(time, *curve)) * change
        return total

    return at
