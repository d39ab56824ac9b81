"""DKT and COQ3: flat triangular thin shells with constant membrane strains.

DKT bends by the discrete Kirchhoff condition: Batoz, Bathe, Ho, "A study of three-node triangular
plate bending elements" (1980). Rotations of the normal are quadratic; along each side the
deflection is cubic and Kirchhoff's condition holds at its ends and middle. COQ3 bends by an
incomplete cubic deflection (see `cubic_plate`). The element's own frame has x along the side from
node 1 to node 2 and z along the normal.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.family import (
    Layout,
    ShellFamily,
    StrainOperator,
)
from ssilang.kernel.elements.shapes.reference import shape_gradients
from ssilang.kernel.elements.shells.shell_section import (
    drilled,
    inertia_off_mesh,
    own_to_global,
    section_moduli,
    strains_off_mesh,
)
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


def plate_frames(zone: Zone, cells: slice = slice(None)) -> tuple[FloatArray, FloatArray]:
    """Frames (n, 3, 3), rows being the axes, and coordinates (n, 3, 2) in them.

    Raises
    ------
    MeshError
        If a triangle has no area.
    """
    x = zone.cells.nodes.coordinates[zone.cells.connectivity[cells]]
    first, second = x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]
    normal = np.cross(first, second)
    sizes = [np.linalg.norm(v, axis=1, keepdims=True) for v in (first, normal)]
    if (sizes[1] <= 1e-14 * sizes[0] ** 2).any():
        raise MeshError("kernel.elements.triangle-shell-no-area")
    e1, e3 = first / sizes[0], normal / sizes[1]
    frames = np.stack([e1, np.cross(e3, e1), e3], axis=1)
    local = np.einsum("cij,ckj->cki", frames[:, :2], x - x[:, :1])
    return frames, local


def _gradients(local: FloatArray, cell_type: str, points: FloatArray) -> FloatArray:
    """Derivatives (n, p, 2, k) of shape functions on straight triangles."""
    J = np.stack([local[:, 1] - local[:, 0], local[:, 2] - local[:, 0]], axis=1)
    reference = shape_gradients(cell_type, points)
    found: FloatArray = np.einsum("cij,pkj->cpik", np.linalg.inv(J), reference)
    return found


def _rotations(local: FloatArray) -> FloatArray:
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


def _discrete_kirchhoff(local: FloatArray, points: FloatArray) -> FloatArray:
    """Curvatures (n, 3, p, 9) from w, RX, RY at the corners (own frame)."""
    slopes = np.einsum("cpik,ckjm->cpijm", _gradients(local, "TRI6", points), _rotations(local))
    mixed = slopes[:, :, 1, 0] + slopes[:, :, 0, 1]
    return np.stack([slopes[:, :, 0, 0], slopes[:, :, 1, 1], mixed], axis=1)


_CURVATURES = {"DKT": _discrete_kirchhoff, "COQ3": cubic_curvatures}


class Plate(ShellFamily):
    """Thin shell made of flat triangles."""

    strains = ("EPSS", "EPTT", "GAST", "RTSS", "RTTT", "RTST")
    stresses = ("N11", "N22", "N12", "M11", "M22", "M12")

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Membrane and bending moduli."""
        return section_moduli(zone, parameters, support)

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """Membrane strains (constant) and curvatures (linear)."""
        rule = support_rule(zone.element, support)
        frames, local = plate_frames(zone, cells)
        n, p = len(local), len(rule)
        B = np.zeros((n, 6, p, 18))
        linear = _gradients(local, "TRI3", rule.points)
        for node in range(3):
            B[:, 0, :, 6 * node] = B[:, 2, :, 6 * node + 1] = linear[:, :, 0, node]
            B[:, 1, :, 6 * node + 1] = B[:, 2, :, 6 * node] = linear[:, :, 1, node]
        columns = [6 * node + k for node in range(3) for k in (2, 3, 4)]
        B[:, 3:, :, columns] = _CURVATURES[zone.element](local, rule.points)
        double_area = local[:, 1, 0] * local[:, 2, 1]
        operator = strains_off_mesh(own_to_global(B, frames), zone, parameters, cells)
        return StrainOperator(operator, double_area[:, None] * rule.weights)

    def stiffness_values(self, zone: Zone, moduli: FloatArray, parameters: ZoneField) -> FloatArray:
        """The usual stiffness and a small one about the normal, which the element lacks."""
        values = super().stiffness_values(zone, moduli, parameters)
        normals = np.repeat(plate_frames(zone)[0][:, None, 2], 3, axis=1)
        return drilled(zone, values, moduli[:, :, 3, 3].mean(axis=1), normals)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """Linear interpolation: RHO EPAI of the translations, RHO EPAI^3 / 12 of the rotations."""
        frames, local = plate_frames(zone)
        n = len(frames)
        rho = np.broadcast_to(parameters.at("RHO", "GRAVITE")[:, 0], (n,))
        h = np.broadcast_to(parameters.at("EPAI", "GRAVITE")[:, 0], (n,))
        area = 0.5 * local[:, 1, 0] * local[:, 2, 1]
        pair = (np.ones((3, 3)) + np.eye(3)) / 12
        tangent = np.einsum("cai,caj->cij", frames[:, :2], frames[:, :2])
        values = np.zeros((n, 3, 6, 3, 6))
        scalar = (rho * h * area)[:, None, None] * pair
        inertia = np.einsum("cab,cij->caibj", scalar * (h**2 / 12)[:, None, None], tangent)
        for k in range(3):
            values[:, :, k, :, k] = scalar
        values[:, :, 3:, :, 3:] = inertia
        normals = np.repeat(frames[:, None, 2], 3, axis=1)
        whole = inertia_off_mesh(values.reshape(n, 18, 18), zone, parameters, normals)
        return whole, self.layout(zone)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Effect of the membrane forces on linear translations."""
        rule = support_rule(zone.element, "STRESSES")
        frames, local = plate_frames(zone)
        n = len(frames)
        G = _gradients(local, "TRI3", rule.points)
        w = (local[:, 1, 0] * local[:, 2, 1])[:, None] * rule.weights
        N = np.empty((n, len(rule), 2, 2))
        N[..., 0, 0], N[..., 1, 1] = stress[:, 0], stress[:, 1]
        N[..., 0, 1] = N[..., 1, 0] = stress[:, 2]
        scalar = np.einsum("cp,cpia,cpij,cpjb->cab", w, G, N, G, optimize=True)
        values = np.zeros((n, 3, 6, 3, 6))
        for k in range(3):
            values[:, :, k, :, k] = scalar
        normals = np.repeat(frames[:, None, 2], 3, axis=1)
        return inertia_off_mesh(values.reshape(n, 18, 18), zone, parameters, normals)
