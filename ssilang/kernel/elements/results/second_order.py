"""Strains and stresses with the terms of second order in the displacements."""

from __future__ import annotations

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.beams.bar import bar_stretch
from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.solids.gradients import second_order_strain
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Zone


def green_strain(
    zone: Zone, displacement: NodeField, material: CellField | None = None
) -> CellFieldBlock:
    """Green-Lagrange strains of continuous elements and bars at the points of 'STRESSES'."""
    family = families.family_of(zone)
    values = family.strain_values(zone, displacement, zone_field(zone, material))
    if is_solid(zone):
        values = values + second_order_strain(zone, displacement)
    elif ELEMENTS[zone.element].family == "bar":
        values = values + 0.5 * bar_stretch(zone, displacement)[:, None] ** 2
    else:
        raise FieldError("kernel.elements.element-no-strains-second", element=zone.element)
    return cell_block(zone, family.strain_names(zone), values)


def green_stress(zone: Zone, material: CellField, displacement: NodeField) -> CellFieldBlock:
    """Elastic stresses of the Green-Lagrange strains."""
    strains = CellField((green_strain(zone, displacement, material),), "DEFORMATIONS")
    return families.elastic_stress(zone, material, strains)
