"""What flat shells of triangles and quadrangles share: own frames, membrane, masses, KSIG.

The own frame has z along the (mean) normal and x along the side from node 1 to node 2. Four nodes
may be warped: the membrane is then a shallow shell over the mean plane (Marguerre 1938), which no
rigid motion strains; curvatures and shears are those of the plane. Translations follow the shapes
of the cell.
"""

from abc import abstractmethod

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.family import Layout, StrainOperator, TurningFamily
from ssilang.kernel.elements.shapes.quadrature import Rule
from ssilang.kernel.elements.shapes.reference import shape_functions, shape_gradients
from ssilang.kernel.elements.shells.shell_section import (
    DRILLING,
    by_node,
    drilled,
    own_to_global,
    strains_off_mesh,
)
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Zone

WARPED = 100.0
"""Stiffness about the normal over that in bending, per square of the warp: nothing else takes
moments that kinks between twisted cells turn about it."""


def flat_frames(zone: Zone, cells: slice = slice(None)) -> tuple[FloatArray, FloatArray]:
    """Frames (n, 3, 3), rows being the axes, and coordinates (n, k, 2) in them from node 1.

    Raises
    ------
    MeshError
        If a cell has no area.
    """
    x = zone.cells.nodes.coordinates[zone.cells.connectivity[cells]]
    normal = np.cross(x[:, 2] - x[:, 0], x[:, -1] - x[:, 1])
    side = x[:, 1] - x[:, 0]
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    if (size[:, 0] <= 1e-14 * np.vecdot(side, side)).any():
        raise MeshError("kernel.elements.flat-shell-no-area")
    e3 = normal / size
    e1 = side - np.vecdot(side, e3)[:, None] * e3
    e1 /= np.linalg.norm(e1, axis=1, keepdims=True)
    frames = np.stack([e1, np.cross(e3, e1), e3], axis=1)
    return frames, np.einsum("cij,ckj->cki", frames[:, :2], x - x[:, :1])


def rises(zone: Zone, cells: slice, frames: FloatArray, slopes: FloatArray) -> FloatArray:
    """Slopes (n, p, 2) of warped cells against their mean plane."""
    x = zone.cells.nodes.coordinates[zone.cells.connectivity[cells]]
    return np.einsum("cpik,ckj,cj->cpi", slopes, x, frames[:, 2], optimize=True)


def surface_slopes(zone: Zone, local: FloatArray, rule: Rule) -> tuple[FloatArray, FloatArray]:
    """Derivatives (n, p, 2, k) of the cell's shapes in the own frame, and weights (n, p)."""
    reference = shape_gradients(zone.cells.cell_type, rule.points)
    J = np.einsum("pki,ckj->cpij", reference, local)
    slopes = np.einsum("cpji,pki->cpjk", np.linalg.inv(J), reference)
    return slopes, np.abs(np.linalg.det(J)) * rule.weights


def _normals(frames: FloatArray, count: int) -> FloatArray:
    """Normals (n, count, 3) at the nodes of flat cells."""
    return np.repeat(frames[:, None, 2], count, axis=1)


class FlatShell(TurningFamily):
    """Shell of flat cells: a family adds its moduli, and what bends it."""

    @abstractmethod
    def bending(
        self, zone: Zone, parameters: ZoneField, cells: slice, local: FloatArray, points: FloatArray
    ) -> FloatArray:
        """Curvatures, then shears (n, 3 or 5, p, 3 k) from w, RX, RY at the nodes.

        `local` (n, k, 2) are the nodes of these cells in their own frames.
        """

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """Membrane strains of the shapes of the cell, then what bending adds."""
        rule = support_rule(zone.element, support)
        frames, local = flat_frames(zone, cells)
        slopes, weights = surface_slopes(zone, local, rule)
        n, p, _, k = slopes.shape
        bent = self.bending(zone, parameters, cells, local, rule.points)
        B = np.zeros((n, 3 + bent.shape[1], p, k, 6))
        B[:, 0, ..., 0] = B[:, 2, ..., 1] = slopes[:, :, 0]
        B[:, 1, ..., 1] = B[:, 2, ..., 0] = slopes[:, :, 1]
        B[:, 3:, ..., 2:5] = bent.reshape(*bent.shape[:3], k, 3)
        rise = np.moveaxis(rises(zone, cells, frames, slopes), 2, 0)[..., None]
        B[:, 0, ..., 2], B[:, 1, ..., 2] = rise[0] * slopes[:, :, 0], rise[1] * slopes[:, :, 1]
        B[:, 2, ..., 2] = rise[0] * slopes[:, :, 1] + rise[1] * slopes[:, :, 0]
        own = own_to_global(B.reshape(*B.shape[:3], 6 * k), frames)
        return StrainOperator(strains_off_mesh(own, zone, parameters, cells), weights)

    def weights(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Areas (n_cells, n_points) of the points of a support, which no parameter changes."""
        rule = support_rule(zone.element, support)
        return surface_slopes(zone, flat_frames(zone)[1], rule)[1]

    def held_about_normals(
        self, zone: Zone, values: FloatArray, moduli: FloatArray, parameters: ZoneField
    ) -> FloatArray:
        """By the stiffness in bending, and the warp of cells."""
        frames, local = flat_frames(zone)
        slopes, _ = surface_slopes(zone, local, support_rule(zone.element, "RIGIDITE"))
        steep = (rises(zone, slice(None), frames, slopes) ** 2).sum(axis=2).mean(axis=1)
        turned = np.clip(WARPED * steep / DRILLING, 1.0, 0.1 / DRILLING)
        normals = _normals(frames, zone.cells.kind.n_nodes)
        return drilled(zone, values, moduli[:, :, 3, 3].mean(axis=1) * turned, normals)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """By the shapes of the cell: RHO EPAI of translations, RHO EPAI^3 / 12 of rotations."""
        frames, local = flat_frames(zone)
        rule = support_rule(zone.element, "MASSE")
        rho, h = parameters.each("RHO"), parameters.each("EPAI")
        N = shape_functions(zone.cells.cell_type, rule.points)
        w = surface_slopes(zone, local, rule)[1] * (rho * h)[:, None]
        scalar = np.einsum("cp,pa,pb->cab", w, N, N)
        tangent = np.einsum("cai,caj->cij", frames[:, :2], frames[:, :2])
        turning = np.einsum("cab,cij->caibj", scalar * (h**2 / 12)[:, None, None], tangent)
        normals = _normals(frames, N.shape[1])
        return by_node(zone, parameters, normals, scalar, turning), self.layout(zone)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Effect of the membrane forces on the translations."""
        frames, local = flat_frames(zone)
        slopes, w = surface_slopes(zone, local, support_rule(zone.element, "STRESSES"))
        N = stress[:, [[0, 2], [2, 1]]]
        scalar = np.einsum("cp,cpia,cijp,cpjb->cab", w, slopes, N, slopes, optimize=True)
        return by_node(zone, parameters, _normals(frames, scalar.shape[1]), scalar, 0.0)
