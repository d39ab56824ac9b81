"""Hoops: rings about the axis that one node of the section stands for (CERC)."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.beams.bar import Bar, spread
from ssilang.kernel.elements.family import Layout, StrainOperator
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Zone


def _radii(zone: Zone, cells: slice = slice(None)) -> FloatArray:
    """Radii (n, 1) of the rings.

    Raises
    ------
    MeshError
        For a point on the axis.
    """
    nodes = zone.cells.connectivity[cells]
    radii: FloatArray = zone.cells.nodes.coordinates[nodes][..., 0]
    if (radii <= 0.0).any():
        here = int(zone.cells.nodes.resolve(nodes)[radii <= 0.0][0])
        raise MeshError("kernel.elements.hoop-on-axis", node=zone.cells.nodes.told(here))
    return radii


class Hoop(Bar):
    """Normal force EFFX = YOUN SECT EPSS along the ring, EPSS = UR / r; whole turns are summed."""

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """Radial displacement over the radius."""
        radii = _radii(zone, cells)
        matrix = np.zeros((len(radii), 1, 1, 2))
        matrix[:, 0, 0, 0] = 1.0 / radii[:, 0]
        return StrainOperator(matrix, 2.0 * np.pi * radii)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """RHO SECT times the ring's length, in every direction."""
        density = parameters.at("RHO", "MASSE") * parameters.at("SECT", "MASSE")
        scalar = (2.0 * np.pi * _radii(zone) * density)[..., None]
        return spread(scalar, 2), self.layout(zone)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """EFFX / r^2 on the radial displacement: the second-order part of the ring's strain."""
        radii = _radii(zone)
        values = np.zeros((len(radii), 2, 2))
        values[:, 0, 0] = 2.0 * np.pi * stress[:, 0, 0] / radii[:, 0]
        return values
