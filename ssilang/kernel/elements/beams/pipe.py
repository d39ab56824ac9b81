"""TUYA: straight pipes and elbows as beams whose section is a ring.

An elbow bends more easily than its ring because it turns oval: its inertia is divided by von
Karman's factor 1.65 / lambda, lambda = thickness x bend radius / (mean radius)^2, when above 1.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.beams.beam import Beam
from ssilang.kernel.elements.beams.beam_frame import Section, beam_frame
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import CellFieldBlock
from ssilang.kernel.materials.model import Zone


def pipe_parameters(zone: Zone, parameters: ZoneField, bends: bool = True) -> ZoneField:
    """The parameters with the ring's SECT INRY INRZ TORS, the flexibility of elbows included.

    Without `bends` the inertia is that of the ring: the intensity factors of stresses
    and the mass hold for it.
    """
    if "EPAI" not in parameters or "SECT" in parameters:
        return parameters
    h, outer = parameters.each("EPAI"), parameters.each("RAYO")
    inner, mean = outer - h, outer - h / 2
    area = np.pi * (outer**2 - inner**2)
    inertia = np.pi / 4 * (outer**4 - inner**4)
    bend = parameters.each("RACO", 0.0)
    ratio = h * bend / mean**2
    curved = bends & (bend > 0)
    flexible = np.where(curved, np.maximum(1.65 / np.where(bend > 0, ratio, 1.0), 1.0), 1.0)
    made = {"SECT": area, "INRY": inertia / flexible, "INRZ": inertia / flexible}
    made["TORS"] = 2 * inertia
    columns = {k: v[:, None] for k, v in made.items()}
    block = CellFieldBlock(zone.cells, columns, "GRAVITE", zone.element)
    return ZoneField(zone, (*parameters.parts, (block, None)))


def pressure_forces(zone: Zone, parameters: ZoneField) -> FloatArray:
    """Element vectors (n_cells, 12) of the inner pressure PRES on closed ends: p pi r^2."""
    h, outer, pressure = (parameters.each(name) for name in ("EPAI", "RAYO", "PRES"))
    push = pressure * np.pi * (outer - h) ** 2
    axis = beam_frame(zone, parameters).axes[:, 0]
    vectors = np.zeros((len(h), 12))
    vectors[:, :3], vectors[:, 6:9] = -push[:, None] * axis, push[:, None] * axis
    return vectors


class Pipe(Beam):
    """Beam with the section of a pipe."""

    def section(self, zone: Zone, parameters: ZoneField) -> Section:
        """Rigidities of the ring."""
        return super().section(zone, pipe_parameters(zone, parameters))

    def linear_mass(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, FloatArray]:
        """Mass per length of the ring, which no bend makes lighter to turn."""
        return super().linear_mass(zone, pipe_parameters(zone, parameters, bends=False))
