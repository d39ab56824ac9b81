"""Equivalent stresses of the section forces of beams and bars."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.beams.pipe import pipe_parameters
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.tensors import components_at_home
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, Support
from ssilang.kernel.materials.model import Zone

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
    if ELEMENTS[zone.element].family == "pipe":
        return _of_pipes(zone, field, material)
    if ELEMENTS[zone.element].family not in ("bar", "beam", "timoshenko"):
        raise FieldError("kernel.elements.element-no-equivalent-stress", element=zone.element)
    names = family_of(zone).stress_names(zone)
    forces, support = components_at_home(zone, field, names)
    parameters = zone_field(zone, material)
    squares = (forces[:, 0] / parameters.at("SECT", "GRAVITE")) ** 2
    for name, distance, constant in _TERMS:
        if name in names and distance in parameters:
            lever = parameters.at(distance, "GRAVITE") / parameters.at(constant, "GRAVITE")
            squares = squares + (forces[:, names.index(name)] * lever) ** 2
    return np.sqrt(squares), support


def _of_pipes(
    zone: Zone, field: CellField, material: CellField | None
) -> tuple[FloatArray, Support]:
    """Membrane, torsion and bending stresses of a pipe with their intensity factors."""
    names = family_of(zone).stress_names(zone)
    forces, support = components_at_home(zone, field, names)
    ring = pipe_parameters(zone, zone_field(zone, material), bends=False)
    h, outer = ring.at("EPAI", "GRAVITE"), ring.at("RAYO", "GRAVITE")
    mean, bend = outer - h / 2, ring.at("RACO", "GRAVITE", 0.0)
    ratio = np.where(bend > 0, h * bend / mean**2, 1.0)
    bending = np.pi / 4 * np.where(bend > 0, np.maximum(1.0, 8 / 9 / ratio ** (2 / 3)), 1.0)

    def term(force: str, factor: str, default: FloatArray | float, lever: FloatArray) -> FloatArray:
        given = ring.at(factor, "GRAVITE") if factor in ring else default
        squared: FloatArray = (forces[:, names.index(force)] * given * lever) ** 2
        return squared

    squares = term("EFFX", "CFFX", 1.0, 1 / ring.at("SECT", "GRAVITE"))
    squares = squares + term("MOMX", "CFMX", np.sqrt(3.0), mean / ring.at("TORS", "GRAVITE"))
    squares = squares + term("MOMY", "CFMY", bending, mean / ring.at("INRY", "GRAVITE"))
    squares = squares + term("MOMZ", "CFMZ", bending, mean / ring.at("INRZ", "GRAVITE"))
    if "CFPR" in ring and "PRES" in ring:
        hoop = ring.at("PRES", "GRAVITE") * ring.at("CFPR", "GRAVITE") * mean / h
        squares = squares + hoop**2
    return np.sqrt(squares), support
