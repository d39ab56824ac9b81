"""DKT and COQ3: flat triangular thin shells with constant membrane strains.

DKT bends by the discrete Kirchhoff condition: Batoz, Bathe, Ho, "A study of three-node triangular
plate bending elements" (1980). Rotations of the normal are quadratic; along each side the
deflection is cubic and Kirchhoff's condition holds at its ends and middle. COQ3 bends by an
incomplete cubic deflection (see `cubic_curvatures`).
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.shapes.reference import shape_gradients
from ssilang.kernel.elements.shells.flat_shell import FlatShell
from ssilang.kernel.elements.shells.shell_section import section_moduli
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Zone


def _second(L: FloatArray, powers: tuple[int, int, int]) -> FloatArray:
    """Second derivatives (p, 3, 3) of a monomial of the area coordinates L (p, 3)."""
    out = np.empty((len(L), 3, 3))
    for a in range(3):
        for b in range(3):
            left, factor = list(powers), 1
            for axis in (a, b):
                factor *= left[axis]
                left[axis] -= 1
            out[:, a, b] = factor * np.prod(L ** np.maximum(left, 0), axis=1) if factor else 0.0
    return out


def _of(i: int, twice: int, j: int, once: int) -> tuple[int, int, int]:
    """Powers of the monomial L_i^twice L_j^once."""
    powers = [0, 0, 0]
    powers[i] += twice
    powers[j] += once
    return powers[0], powers[1], powers[2]


def cubic_curvatures(local: FloatArray, points: FloatArray) -> FloatArray:
    """Curvatures (n, 3, p, 9) from w, RX, RY at the corners (own frame).

    Parameters
    ----------
    local : array (n, 3, 2)
        Corners in the own frame.
    points : array (p, 2)
        Places in the reference triangle.
    """
    L = np.column_stack([1 - points.sum(axis=1), points])
    J = np.stack([local[:, 1] - local[:, 0], local[:, 2] - local[:, 0]], axis=1)
    slopes = np.einsum("cij,kj->cik", np.linalg.inv(J), shape_gradients("TRI3", points)[0])
    bubble = _second(L, (1, 1, 1)) / 2
    found = np.zeros((len(local), len(points), 3, 3, 3, 3))  # cell, point, Hessian, node, unknown
    hessians = found.transpose(0, 1, 4, 5, 2, 3)
    for i in range(3):
        for j in ((i + 1) % 3, (i + 2) % 3):
            forth, back = _second(L, _of(i, 2, j, 1)), _second(L, _of(i, 1, j, 2))
            hessians[:, :, i, 0] += (forth - back)[None]
            side = (local[:, j] - local[:, i])[:, None, None, None]
            hessians[:, :, i, 1] += side[..., 1] * (forth + bubble)  # RX = dw/dy
            hessians[:, :, i, 2] -= side[..., 0] * (forth + bubble)  # RY = - dw/dx
    bent = -np.einsum("cia,cpabnu,cjb->cijpnu", slopes, found, slopes, optimize=True)
    rows = np.stack([bent[:, 0, 0], bent[:, 1, 1], 2 * bent[:, 0, 1]], axis=1)
    return rows.reshape(len(local), 3, len(points), 9)


def kirchhoff_rotations(local: FloatArray) -> FloatArray:
    """Normal's rotations (n, 6 nodes, 2, 9) from w, RX, RY at the corners (own frame)."""
    n = len(local)
    T = np.zeros((n, 6, 2, 9))
    for i in range(3):
        j = (i + 1) % 3
        T[:, 2 * i, 0, 3 * i + 2] = 1.0
        T[:, 2 * i, 1, 3 * i + 1] = -1.0
        side = local[:, j] - local[:, i]
        length = np.linalg.norm(side, axis=1)
        s = side / length[:, None]
        t = np.stack([-s[:, 1], s[:, 0]], axis=1)
        middle = T[:, 2 * i + 1]
        middle[:, :, 3 * i] += 1.5 / length[:, None] * s
        middle[:, :, 3 * j] -= 1.5 / length[:, None] * s
        mixed = 0.5 * np.einsum("ca,cb->cab", t, t) - 0.25 * np.einsum("ca,cb->cab", s, s)
        for node in (i, j):
            middle[:, :, 3 * node + 2] += mixed[:, :, 0]
            middle[:, :, 3 * node + 1] -= mixed[:, :, 1]
    return T


def curvatures_of(rotations: FloatArray, local: FloatArray, points: FloatArray) -> FloatArray:
    """Curvatures (n, 3, p, 9) of quadratic rotations (n, 6 nodes, 2, 9) of the normal."""
    J = np.stack([local[:, 1] - local[:, 0], local[:, 2] - local[:, 0]], axis=1)
    reference = shape_gradients("TRI6", points)
    found: FloatArray = np.einsum("cij,pkj->cpik", np.linalg.inv(J), reference)
    slopes = np.einsum("cpik,ckjm->cpijm", found, rotations)
    mixed = slopes[:, :, 1, 0] + slopes[:, :, 0, 1]
    return np.stack([slopes[:, :, 0, 0], slopes[:, :, 1, 1], mixed], axis=1)


class Plate(FlatShell):
    """Thin shell made of flat triangles."""

    strains = ("EPSS", "EPTT", "GAST", "RTSS", "RTTT", "RTST")
    stresses = ("N11", "N22", "N12", "M11", "M22", "M12")

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Membrane and bending moduli."""
        return section_moduli(zone, parameters, support)

    def bending(
        self, zone: Zone, parameters: ZoneField, cells: slice, local: FloatArray, points: FloatArray
    ) -> FloatArray:
        """Curvatures, linear in the cell."""
        if zone.element == "DKT":
            return curvatures_of(kirchhoff_rotations(local), local, points)
        return cubic_curvatures(local, points)
