"""Temperatures in a load, as mechanical loads and as stresses to take off."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements.families import elastic_stress, family_of
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.loads.thermal import thermal_strain
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.stepping.problem.loading import TimeCurve, terms_of


@dataclass(frozen=True, eq=False)
class ThermalStress:
    """Stress of fully restrained expansion of one zone, times a curve in time."""

    zone: Zone
    block: CellFieldBlock
    curve: TimeCurve

    def taken_off(self, given: CellFieldBlock, time: float) -> CellFieldBlock:
        """`given` less this stress at a time."""
        factor = float(np.interp(time, *self.curve))
        components = {k: v - factor * self.block.components[k] for k, v in given.components.items()}
        return CellFieldBlock(
            given.cells, components, given.support, given.element, given.constituent
        )


def split_thermal(
    load: Load | None, zones: list[tuple[Zone, CellField]]
) -> tuple[Load | None, list[ThermalStress]]:
    """The load with its temperatures (T) turned into forces, and their stresses.

    Strains are ALPH (T - TALP); `zones` are those that expand, with their characteristics.
    """
    if load is None or not any(p.name.strip() == "T" for p in load.parts):
        return load, []
    kept = [p for p in load.parts if p.name.strip() != "T"]
    stresses: list[ThermalStress] = []
    always: TimeCurve = (np.zeros(1), np.ones(1))
    for zone, material in zones:
        reference = _restrained(zone, material, None)
        stresses.append(ThermalStress(zone, reference, always))
        for part in (p for p in load.parts if p.name.strip() == "T"):
            for field, curve in terms_of(part):
                if not isinstance(field, NodeField | CellField):
                    raise FieldError("kernel.statics.load-needs-field-temperatures")
                whole = _restrained(zone, material, field)
                change = {k: v - reference.components[k] for k, v in whole.components.items()}
                block = CellFieldBlock(
                    whole.cells, change, whole.support, whole.element, whole.constituent
                )
                stresses.append(ThermalStress(zone, block, curve))
    parts = [_force(s, _of(zones, s.zone)) for s in stresses]
    return Load((*kept, *parts)), stresses


def _of(zones: list[tuple[Zone, CellField]], zone: Zone) -> CellField:
    return next(material for z, material in zones if z is zone)


def _restrained(
    zone: Zone, material: CellField, field: NodeField | CellField | None
) -> CellFieldBlock:
    """Stress D ALPH (T - TALP); of T = 0 without a field."""
    if field is None:
        nodes = np.unique(zone.cells.connectivity)
        zero = {"T": NodeValues(nodes, np.zeros(len(nodes)))}
        field = NodeField(zone.cells.nodes, zero)
    names = family_of(zone).strain_names(zone)
    strain = cell_block(zone, names, thermal_strain(zone, material, field))
    return elastic_stress(zone, material, CellField((strain,), "DEFORMATIONS"))


def _force(stress: ThermalStress, material: CellField) -> LoadPart:
    zone = stress.zone
    family = family_of(zone)
    names = family.stress_names(zone)
    values = np.stack([stress.block.components[n] for n in names], axis=1)
    vectors = family.force_vectors(zone, values, zone_field(zone, material))
    curve = Curve((CurvePart(*stress.curve),))
    return LoadPart("MECA", family.layout(zone).scatter(vectors), curve)
