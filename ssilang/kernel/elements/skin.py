"""Stresses at a point of the section of a beam, from its section forces."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.elements.beam_frame import kept_rows
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.tensors import components_at_home
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.errors import FieldError
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.model import Zone


def skin_stress(zone: Zone, field: CellField, material: CellField) -> CellFieldBlock:
    """Normal stress SMXX at the point (DY, DZ) of the section, local axes.

    EFFX / SECT + MOMY DZ / INRY - MOMZ DY / INRZ.

    Raises
    ------
    FieldError
        For elements that are not beams.
    """
    if ELEMENTS[zone.element].family not in ("beam", "timoshenko"):
        raise FieldError(f"element {zone.element} has no skin")
    names = family_of(zone).stress_names(zone)
    forces, support = components_at_home(zone, field, names)
    parameters = zone_field(zone, material)

    def term(force: str, lever: str, constant: str) -> np.ndarray | float:
        if force not in names:
            return 0.0
        ratio = parameters.at(lever, support, 0.0) / parameters.at(constant, support)
        found: np.ndarray = forces[:, names.index(force)] * ratio
        return found

    stress = forces[:, 0] / parameters.at("SECT", support)
    stress = stress - term("MOMZ", "DY", "INRZ")
    if len(kept_rows(zone)) == 6:
        stress = stress + term("MOMY", "DZ", "INRY")
    return CellFieldBlock(zone.cells, {"SMXX": stress}, support, zone.element, zone.constituent)
