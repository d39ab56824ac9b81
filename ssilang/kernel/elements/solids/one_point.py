"""Q4RI: the quadrangle with one integration point, held against hourglass motions.

Flanagan and Belytschko (1981): a small stiffness acts on what is left of the nodes' pattern
(1, -1, 1, -1) once its linear part is taken off, so that linear fields feel nothing of it.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.family import per_cell
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.elements.solids.solid import Solid, coordinates, kinematics, zone_geometry
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.materials.model import Zone

HOURGLASS = 0.05
"""Share of the usual stiffness that hourglass motions keep."""
_PATTERN = np.array([1.0, -1.0, 1.0, -1.0])


class OnePoint(Solid):
    """Quadrangle with one integration point."""

    def stiffness_values(self, zone: Zone, moduli: FloatArray, parameters: ZoneField) -> FloatArray:
        """The usual stiffness and a small one against hourglass motions."""
        values = super().stiffness_values(zone, moduli, parameters)
        nu = len(kinematics(zone).unknowns)
        for cells in chunks(len(zone.cells)):
            gradients = zone_geometry(zone, "RIGIDITE", cells).gradients[:, 0]
            weights = self.strain_operator(zone, parameters, "RIGIDITE", cells).weights[:, 0]
            linear = np.einsum("b,cbi->ci", _PATTERN, coordinates(zone, cells))
            left = _PATTERN - np.einsum("ci,cia->ca", linear, gradients)
            modulus = per_cell(moduli, cells)[:, 0, 0, 0]
            size = np.einsum("cia,cia->c", gradients, gradients)
            held = (HOURGLASS * modulus * weights * size)[:, None, None]
            stiffness = held * left[:, :, None] * left[:, None, :] / 4
            for i in range(nu):
                values[cells, i : 4 * nu : nu, i : 4 * nu : nu] += stiffness
        return values
