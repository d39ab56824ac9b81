"""TIMO with a section made of fibres (ELASTIQUE SECTION): forces and moments go together."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.beams.beam import Timoshenko, keep, to_global
from ssilang.kernel.elements.beams.beam_frame import Section, beam_frame, kept_rows
from ssilang.kernel.elements.beams.fibre_section import section_of_beam
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Zone


class FibreBeam(Timoshenko):
    """Timoshenko beam whose rigidities are those of its fibres, about its line."""

    def section(self, zone: Zone, parameters: ZoneField) -> Section:
        """Rigidities of the section without what couples forces and moments."""
        return Section(np.diag(section_of_beam(parameters).rigidity)[None])

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Full matrix (1, 1, s, s)."""
        rows = np.array(kept_rows(zone))
        found: FloatArray = section_of_beam(parameters).rigidity[rows[:, None], rows][None, None]
        return found

    def linear_mass(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, FloatArray]:
        """Mass per length (n_cells,) and mass moments per length (n_cells, 3) about the line."""
        mass, n = section_of_beam(parameters).mass, len(zone.cells)
        return np.full(n, mass[0, 0]), np.tile(np.diag(mass)[3:], (n, 1))

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """Linear interpolation; fibres off the line tie translations to rotations."""
        frame = beam_frame(zone, parameters)
        pair = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6
        local = np.kron(pair, section_of_beam(parameters).mass) * frame.lengths[:, None, None]
        return to_global(keep(local, zone), frame.rotation(zone)), self.layout(zone)

    def _squared_radii(self, zone: Zone, parameters: ZoneField) -> FloatArray:
        if "MODS" not in parameters:
            return np.zeros((len(zone.cells), 2))
        return np.tile(section_of_beam(parameters).squared_radii, (len(zone.cells), 1))
