"""Integrals of fields, cell by cell; strains and stresses with terms of second order."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.beams.bar import bar_stretch
from ssilang.kernel.elements.beams.pipe import pipe_parameters
from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.catalog import BARS, BEAMS, THIN_SHELLS, family_name, support_rule
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.shapes.geometry import surface_geometry
from ssilang.kernel.elements.solids.gradients import second_order_strain
from ssilang.kernel.elements.zone_fields import carry, zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Zone

# what the line or middle surface of a family is multiplied by
_ACROSS = dict.fromkeys((*BEAMS, *BARS), "SECT") | dict.fromkeys(THIN_SHELLS, "EPAI")


def integrals(
    zone: Zone, field: CellField, name: str, material: CellField | None = None
) -> FloatArray | None:
    """Integral of a component over each cell (n_cells,), None where it is not defined.

    Parameters
    ----------
    material : CellField, optional
        With it beams, bars and shells are integrated over their volume (SECT, EPAI), plane stress
        over its thickness (DIM3); without it over their line or surface.
    """
    seen = zone_field(zone, field)
    if name not in seen:
        return None
    values, source = seen.raw(name)
    target: Support = source if source in ("RIGIDITE", "STRESSES", "MASSE") else "RIGIDITE"
    values = carry(values.astype(float), zone.element, source, target)
    parameters = zone_field(zone, material)
    if zone.formulation == "CHARGEMENT" and zone.mode is Mode.THREE_DIMENSIONAL:
        rule = support_rule(zone.element, target)
        weights = surface_geometry(zone.cells.cell_type, zone.cells.coordinates, rule).measures
    else:
        weights = family_of(zone).weights(zone, parameters, target)
    total: FloatArray = (np.broadcast_to(values, weights.shape) * weights).sum(axis=1)
    family = family_name(zone)
    across = _ACROSS.get(family)
    if material is not None and across is not None:
        if family == "pipe":
            parameters = pipe_parameters(zone, parameters)
        total = total * parameters.each(across)
    return total


def has_second_order(zone: Zone) -> bool:
    """Whether a zone's strains of second order are known."""
    return is_solid(zone) or family_name(zone) == "bar"


def green_strain(
    zone: Zone, displacement: NodeField, material: CellField | None = None
) -> CellFieldBlock:
    """Green-Lagrange strains of continuous elements and bars at the points of 'STRESSES'."""
    family = families.family_of(zone)
    values = family.strain_values(zone, displacement, zone_field(zone, material))
    if is_solid(zone):
        values = values + second_order_strain(zone, displacement)
    elif has_second_order(zone):
        values = values + 0.5 * bar_stretch(zone, displacement)[:, None] ** 2
    else:
        raise FieldError("kernel.elements.element-no-strains-second", element=zone.element)
    return cell_block(zone, family.strain_names(zone), values)


def green_stress(zone: Zone, material: CellField, displacement: NodeField) -> CellFieldBlock:
    """Elastic stresses of the Green-Lagrange strains."""
    strains = CellField((green_strain(zone, displacement, material),), "DEFORMATIONS")
    return families.elastic_stress(zone, material, strains)
