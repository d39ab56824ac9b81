"""The plastic points of a zone by its kind, and the compiled passes over them by its law."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.elements.zone_fields import (
    zone_field,
)
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.behaviours import SECTION_FAMILIES
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.materials.plastic.cone_rows import cone_rows
from ssilang.kernel.materials.plastic.laws import law_at, plastic_law
from ssilang.kernel.plasticity.fibre_points import fibre_points
from ssilang.kernel.plasticity.layered_points import is_layered, layered_points
from ssilang.kernel.plasticity.points import COMPONENTS, PlasticPoints, law_parameters
from ssilang.kernel.plasticity.section_points import section_points
from ssilang.kernel.plasticity.solving.blocks import ZonePass, cells_of
from ssilang.kernel.plasticity.solving.cones import ConePass
from ssilang.kernel.plasticity.solving.nested import NestedPass, nested_of


def plastic_points(zone: Zone, characteristics: CellField) -> PlasticPoints:
    """Everything that does not change during a calculation.

    Raises
    ------
    KernelError
        In hypotheses without plastic laws.
    MaterialError
        For missing or inadmissible parameters.
    """
    if "SECTION" in zone.behaviour:
        return fibre_points(zone, characteristics)
    if is_layered(zone):
        return layered_points(zone, characteristics)
    if ELEMENTS[zone.element].family in SECTION_FAMILIES:
        return section_points(zone, characteristics)
    law, family = plastic_law(zone.behaviour), family_of(zone)
    assert law is not None
    given = zone_field(zone, characteristics)
    bar = ELEMENTS[zone.element].family in ("bar", "hoop")
    if not bar and zone.mode not in COMPONENTS:
        raise KernelError("kernel.plasticity.plastic-laws-not-exist", value=zone.mode.value)
    parts = [
        family.strain_operator(zone, given, "STRESSES", cells) for cells in chunks(len(zone.cells))
    ]
    B = np.concatenate([part.matrix for part in parts])
    weights = np.concatenate([np.broadcast_to(p.weights, (len(p.matrix), p.matrix.shape[2]))
                              for p in parts])  # fmt: skip
    section: FloatArray | None = None
    if bar:
        section = np.broadcast_to(given.at("SECT", "STRESSES"), weights.shape)
        weights = weights * section
    parameters = law_parameters(zone, law, given)
    held: tuple[int, ...] = (1, 2, 3, 4, 5) if bar and not law.uniaxial else ()
    if zone.mode is Mode.PLANE_STRESS and not bar:
        held = (2,)
    components = (0,) if bar else COMPONENTS[zone.mode]
    return PlasticPoints(
        zone, law_at(law, parameters), family.layout(zone), B, weights, section, components, held,
        parameters,
    )  # fmt: skip


def zone_pass(points: PlasticPoints, places: NDArray[np.int32]) -> ZonePass | None:
    """The compiled passes of a zone, None where its law or stresses have none."""
    if points.held:
        return None
    if points.law.parts is not None:
        nested = nested_of(points.law.parts, points.parameters)
        return NestedPass(cells_of(points, places), nested)
    cone = cone_rows(points.law, points.parameters)
    return None if cone is None else ConePass(cells_of(points, places), cone)
