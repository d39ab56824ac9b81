"""Equivalent stresses of the section forces of beams and bars."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.tensors import components_at_home
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.errors import FieldError
from ssilang.kernel.fields.cell_field import CellField, Support
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.model import Zone

# force, distance that makes a stress of it, section constant
_TERMS = (("MOMX", "DX", "TORS"), ("MOMY", "DZ", "INRY"), ("MOMZ", "DY", "INRZ"))


def equivalent_of_lines(
    zone: Zone, field: CellField, material: CellField | None
) -> tuple[FloatArray, Support]:
    """Root of the sum of squares of the stresses of each section force, and its support.

    Moments count where their distance DX, DY, DZ is given.

    Raises
    ------
    FieldError
        For elements that are not beams or bars.
    """
    if ELEMENTS[zone.element].family not in ("bar", "beam", "timoshenko"):
        raise FieldError(f"element {zone.element} has no equivalent stress")
    names = family_of(zone).stress_names(zone)
    forces, support = components_at_home(zone, field, names)
    parameters = zone_field(zone, material)
    squares = (forces[:, 0] / parameters.at("SECT", "GRAVITE")) ** 2
    for name, distance, constant in _TERMS:
        if name in names and distance in parameters:
            lever = parameters.at(distance, "GRAVITE") / parameters.at(constant, "GRAVITE")
            squares = squares + (forces[:, names.index(name)] * lever) ** 2
    return np.sqrt(squares), support
