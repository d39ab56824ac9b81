"""COQ4: quadrangular shell with transverse shear, flat, with assumed shear strains (MITC4).

Bathe and Dvorkin (1985). The element's own frame has z along the mean normal and x along the side
from node 1 to node 2; a small warp of the four nodes is neglected.
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
from ssilang.kernel.elements.shapes.quadrature import quadrature
from ssilang.kernel.elements.shapes.reference import shape_functions, shape_gradients
from ssilang.kernel.elements.shells.shell_section import (
    drilled,
    inertia_off_mesh,
    own_to_global,
    section_moduli,
    strains_off_mesh,
    transverse_moduli,
)
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Zone


def quadrangle_frames(zone: Zone, cells: slice = slice(None)) -> tuple[FloatArray, FloatArray]:
    """Frames (n, 3, 3), rows being the axes, and coordinates (n, 4, 2) in them.

    Raises
    ------
    MeshError
        If a quadrangle has no area.
    """
    x = zone.cells.nodes.coordinates[zone.cells.connectivity[cells]]
    normal = np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    if (size <= 0).any():
        raise MeshError("kernel.elements.quadrangle-shell-no-area")
    e3 = normal / size
    side = x[:, 1] - x[:, 0]
    e1 = side - np.einsum("ci,ci->c", side, e3)[:, None] * e3
    e1 /= np.linalg.norm(e1, axis=1, keepdims=True)
    frames = np.stack([e1, np.cross(e3, e1), e3], axis=1)
    local = np.einsum("cij,ckj->cki", frames[:, :2], x - x.mean(axis=1, keepdims=True))
    return frames, local


def _jacobians(local: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Derivatives of shapes (p, 4, 2) and J[c, p, i, j] = dx_j / dxi_i."""
    reference = shape_gradients("QUA4", points)
    return reference, np.einsum("pki,ckj->cpij", reference, local)


def _covariant_shear(local: FloatArray, place: tuple[float, float], axis: int) -> FloatArray:
    """Row (n, 24) of the shear strain along a reference axis at one point."""
    points = np.array([place])
    reference, J = _jacobians(local, points)
    N, dN = shape_functions("QUA4", points)[0], reference[0, :, axis]
    row = np.zeros((len(local), 4, 6))
    row[:, :, 2] = dN
    row[:, :, 4] = N * J[:, 0, axis, :1]
    row[:, :, 3] = -N * J[:, 0, axis, 1:]
    return row.reshape(len(local), 24)


class Mindlin(ShellFamily):
    """Flat shell with transverse shear."""

    strains = ("EPSS", "EPTT", "GAST", "RTSS", "RTTT", "RTST", "GASN", "GATN")
    stresses = ("N11", "N22", "N12", "M11", "M22", "M12", "V1", "V2")

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Membrane, bending and shear moduli."""
        section = section_moduli(zone, parameters, support)
        shear = transverse_moduli(zone, parameters, support)
        shape = np.broadcast_shapes(section.shape[:2], shear.shape[:2])
        D = np.zeros((*shape, 8, 8))
        D[..., :6, :6], D[..., 6:, 6:] = section, shear
        return D

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """Bilinear membrane and bending, shear interpolated from the middles of the sides."""
        rule = support_rule(zone.element, support)
        frames, local = quadrangle_frames(zone, cells)
        reference, J = _jacobians(local, rule.points)
        inverse = np.linalg.inv(J)
        G = np.einsum("cpji,pki->cpjk", inverse, reference)
        n, p = len(local), len(rule)
        by_node = np.zeros((n, 8, p, 4, 6))
        dx, dy = G[:, :, 0], G[:, :, 1]
        by_node[:, 0, ..., 0] = by_node[:, 2, ..., 1] = by_node[:, 3, ..., 4] = dx
        by_node[:, 1, ..., 1] = by_node[:, 2, ..., 0] = by_node[:, 5, ..., 4] = dy
        by_node[:, 4, ..., 3], by_node[:, 5, ..., 3] = -dy, -dx
        B = by_node.reshape(n, 8, p, 24)
        s, t = rule.points.T
        low, high = (_covariant_shear(local, (0.0, e), 0)[:, None] for e in (-1.0, 1.0))
        left, right = (_covariant_shear(local, (e, 0.0), 1)[:, None] for e in (-1.0, 1.0))
        along = 0.5 * ((1 - t)[:, None] * low + (1 + t)[:, None] * high)
        across = 0.5 * ((1 - s)[:, None] * left + (1 + s)[:, None] * right)
        covariant = np.stack([along, across], axis=2)
        B[:, 6:] = np.einsum("cpji,cpim->cjpm", inverse, covariant)
        weights = np.abs(np.linalg.det(J)) * rule.weights
        operator = strains_off_mesh(own_to_global(B, frames), zone, parameters, cells)
        return StrainOperator(operator, weights)

    def stiffness_values(self, zone: Zone, moduli: FloatArray, parameters: ZoneField) -> FloatArray:
        """The usual stiffness and a small one about the normal, which the element lacks."""
        values = super().stiffness_values(zone, moduli, parameters)
        normals = np.repeat(quadrangle_frames(zone)[0][:, None, 2], 4, axis=1)
        return drilled(zone, values, moduli[:, :, 3, 3].mean(axis=1), normals)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """Bilinear: RHO EPAI of the translations, RHO EPAI^3 / 12 of the rotations."""
        rule = quadrature("quadrangle", 4)
        frames, local = quadrangle_frames(zone)
        _, J = _jacobians(local, rule.points)
        n = len(frames)
        rho = np.broadcast_to(parameters.at("RHO", "GRAVITE")[:, 0], (n,))
        h = np.broadcast_to(parameters.at("EPAI", "GRAVITE")[:, 0], (n,))
        N = shape_functions("QUA4", rule.points)
        w = np.abs(np.linalg.det(J)) * rule.weights * (rho * h)[:, None]
        scalar = np.einsum("cp,pa,pb->cab", w, N, N)
        tangent = np.einsum("cai,caj->cij", frames[:, :2], frames[:, :2])
        values = np.zeros((n, 4, 6, 4, 6))
        for k in range(3):
            values[:, :, k, :, k] = scalar
        values[:, :, 3:, :, 3:] = np.einsum(
            "cab,cij->caibj", scalar * (h**2 / 12)[:, None, None], tangent
        )
        normals = np.repeat(frames[:, None, 2], 4, axis=1)
        whole = inertia_off_mesh(values.reshape(n, 24, 24), zone, parameters, normals)
        return whole, self.layout(zone)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Effect of the membrane forces on bilinear translations."""
        rule = support_rule(zone.element, "STRESSES")
        frames, local = quadrangle_frames(zone)
        reference, J = _jacobians(local, rule.points)
        G = np.einsum("cpji,pki->cpjk", np.linalg.inv(J), reference)
        w = np.abs(np.linalg.det(J)) * rule.weights
        N = stress[:, [[0, 2], [2, 1]]]
        scalar = np.einsum("cp,cpia,cijp,cpjb->cab", w, G, N, G, optimize=True)
        values = np.zeros((len(frames), 4, 6, 4, 6))
        for k in range(3):
            values[:, :, k, :, k] = scalar
        normals = np.repeat(frames[:, None, 2], 4, axis=1)
        return inertia_off_mesh(values.reshape(-1, 24, 24), zone, parameters, normals)
