"""COQ6 and COQ8: curved shells with transverse shear, degenerated from solids.

Ahmad, Irons, Zienkiewicz (1970), with reduced integration: fibres along the normals of the middle
surface turn with the nodes; no stress acts across the thickness. Two points across. Clamped COQ8
become too stiff when the thickness falls below some hundredth of the cells' size.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements import family
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.elements.shapes.quadrature import Rule
from ssilang.kernel.elements.shapes.reference import (
    REFERENCE_CELLS,
    shape_functions,
    shape_gradients,
)
from ssilang.kernel.elements.shells import shell_section
from ssilang.kernel.elements.solids.kinematics import cross_matrix
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Zone

ACROSS = 1 / np.sqrt(3.0)
"""Where the points stand across, in half thicknesses from the middle: first half below."""


def fibres(zone: Zone, cells: slice = slice(None)) -> FloatArray:
    """Unit normals (n, k, 3) of the middle surface at the nodes.

    Raises
    ------
    MeshError
        If the surface folds at a node.
    """
    x = zone.cells.nodes.coordinates[zone.cells.connectivity[cells]]
    reference = shape_gradients(zone.cells.cell_type, REFERENCE_CELLS[zone.cells.cell_type].nodes)
    tangents = np.einsum("aki,ckj->caij", reference, x)
    normal = np.cross(tangents[:, :, 0], tangents[:, :, 1])
    size = np.linalg.norm(normal, axis=2, keepdims=True)
    if (size <= 0).any():
        raise MeshError("kernel.elements.middle-surface-shell-folds")
    return normal / size


def _areas(zone: Zone, rule: Rule) -> FloatArray:
    """Shares (n, p) of the middle surface."""
    reference = shape_gradients(zone.cells.cell_type, rule.points)
    t = np.einsum("pki,ckj->cpij", reference, zone.cells.coordinates)
    return np.linalg.norm(np.cross(t[:, :, 0], t[:, :, 1]), axis=2) * rule.weights


class ThickShell(family.TurningFamily):
    """Curved shell with transverse shear."""

    strains = ("EPSS", "EPTT", "GAST", "GASN", "GATN")
    stresses = ("SMSS", "SMTT", "SMST", "SMSN", "SMTN")

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Plane stress with transverse shear."""
        return shell_section.material_moduli(zone, parameters, support)

    def _placed(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Height (n or 1, p), arms (n, k, 3), Jacobian and own axes (n, p, 3, 3) at the points.

        The own axes are rows: along the first reference axis, in the surface, normal.
        """
        rule, kind = support_rule(zone.element, support), zone.cells.cell_type
        N, dN = shape_functions(kind, rule.points), shape_gradients(kind, rule.points)
        half = len(rule) // 2
        zeta = np.where(np.arange(len(rule)) < half, -ACROSS, ACROSS)
        x = zone.cells.nodes.coordinates[zone.cells.connectivity[cells]]
        h = parameters.each("EPAI")[cells]
        arm = fibres(zone, cells) * (h / 2)[:, None, None]
        e = shell_section.offset(zone, parameters)
        height = zeta + (np.zeros((len(x), 1)) if e is None else (2 * e[cells] / h)[:, None])
        place = x[:, None] + height[:, :, None, None] * arm[:, None]
        J = np.empty((len(x), len(rule), 3, 3))
        J[:, :, :2] = np.einsum("pki,cpkj->cpij", dN, place)
        J[:, :, 2] = np.einsum("pk,ckj->cpj", N, arm)
        e1 = J[:, :, 0] / np.linalg.norm(J[:, :, 0], axis=-1, keepdims=True)
        normal = np.cross(J[:, :, 0], J[:, :, 1])
        e3 = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
        return height, arm, J, np.stack([e1, np.cross(e3, e1), e3], axis=2)

    def frames(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Own axes (n, p, 3, 3) of strains and stresses, rows."""
        return self._placed(zone, parameters, support, slice(None))[3]

    def weights(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Volumes (n, p) of the points; without EPAI their shares of the middle surface."""
        if "EPAI" in parameters:
            return super().weights(zone, parameters, support)
        return _areas(zone, support_rule(zone.element, support))

    def _gradients(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> tuple[FloatArray, FloatArray]:
        """Gradients (n, p, 3, 3, k, 6) of the displacements in local frames, and weights (n, p).

        The first two axes after the points: component, direction of the derivative.
        """
        rule, kind = support_rule(zone.element, support), zone.cells.cell_type
        N, dN = shape_functions(kind, rule.points), shape_gradients(kind, rule.points)
        height, arm, J, frames = self._placed(zone, parameters, support, cells)
        inverse = np.linalg.inv(J)
        # d u_a / d x_j as an operator on (node, translation or rotation)
        G = np.zeros((len(arm), len(rule), 3, 3, arm.shape[1], 6))
        flat = np.einsum("cpji,pki->cpjk", inverse[..., :2], dN)
        turned = flat * height[:, :, None, None] + inverse[..., 2][..., None] * N[:, None, :]
        for a in range(3):
            G[:, :, a, :, :, a] = flat
        G[..., 3:] = np.einsum("cpjk,ckab->cpajkb", turned, cross_matrix(-arm))
        grad = np.einsum("cpia,cpjb,cpabkm->cpijkm", frames, frames, G, optimize=True)
        weights = np.abs(np.linalg.det(J)) * rule.weights * 2
        return grad, weights

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> family.StrainOperator:
        """Local strains at points on both sides of the middle surface."""
        grad, weights = self._gradients(zone, parameters, support, cells)
        n, p, k = grad.shape[0], grad.shape[1], grad.shape[4]
        B = np.stack(
            [
                grad[:, :, 0, 0],
                grad[:, :, 1, 1],
                grad[:, :, 0, 1] + grad[:, :, 1, 0],
                grad[:, :, 0, 2] + grad[:, :, 2, 0],
                grad[:, :, 1, 2] + grad[:, :, 2, 1],
            ],
            axis=1,
        )
        return family.StrainOperator(B.reshape(n, 5, p, 6 * k), weights)

    def held_about_normals(
        self, zone: Zone, values: FloatArray, moduli: FloatArray, parameters: ZoneField
    ) -> FloatArray:
        """By the stiffness in bending."""
        bending = moduli[:, :, 0, 0].mean(axis=1) * parameters.each("EPAI") ** 3 / 12
        return shell_section.drilled(zone, values, bending, fibres(zone))

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Effect of the stresses in the surface on the displacements' gradients along it."""
        n, m = len(zone.cells), 6 * zone.cells.kind.n_nodes
        values = np.empty((n, m, m))
        for cells in chunks(n):
            grad, weights = self._gradients(zone, parameters, "STRESSES", cells)
            along = grad[:, :, :, :2].reshape(*grad.shape[:3], 2, m)
            flux = np.einsum(
                "cijp,cpajm,cp->cpaim", stress[cells][:, [[0, 2], [2, 1]]], along, weights
            )
            rows = -1, 6 * weights.shape[1], m
            values[cells] = np.matmul(along.reshape(rows).transpose(0, 2, 1), flux.reshape(rows))
        return values

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, family.Layout]:
        """RHO EPAI of the translations, RHO EPAI^3 / 12 of the fibres' rotations."""
        rule = support_rule(zone.element, "MASSE")
        N, area = shape_functions(zone.cells.cell_type, rule.points), _areas(zone, rule)
        rho, h = parameters.each("RHO"), parameters.each("EPAI")
        scalar = np.einsum("cp,pa,pb->cab", area * (rho * h)[:, None], N, N)
        v = fibres(zone)
        # fibres move by sum N_a theta_a x v_a: on curved cells those of two nodes are not parallel
        tangent = np.einsum("cab,cak,cbk,ij->caibj", scalar, v, v, np.eye(3), optimize=True)
        tangent -= np.einsum("cab,cbi,caj->caibj", scalar, v, v)
        turning = tangent * (h**2 / 12)[:, None, None, None, None]
        return shell_section.by_node(zone, parameters, v, scalar, turning), self.layout(zone)
