"""COQ4 and DST: flat shells with transverse shear.

COQ4 assumes shear strains (MITC4): Bathe and Dvorkin (1985). DST assumes discrete shears: Batoz and
Lardeur, "A discrete shear triangular nine d.o.f. element for the analysis of thick to very thin
plates" (1989). The normal's rotations are quadratic as those of DKT; the moments that they make are
linear and, by balance, say one shear strain for the cell, which each side's mean strain must meet:
the strains depend on the ratio of the moduli of bending and shear.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.family import per_cell
from ssilang.kernel.elements.shapes.reference import shape_functions, shape_gradients
from ssilang.kernel.elements.shells.flat_shell import FlatShell, flat_frames
from ssilang.kernel.elements.shells.plate import curvatures_of, kirchhoff_rotations
from ssilang.kernel.elements.shells.shell_section import section_moduli, transverse_moduli
from ssilang.kernel.elements.solids.solid_moduli import moduli_from_field
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.model import Zone


def _covariant_shear(local: FloatArray, place: tuple[float, float], axis: int) -> FloatArray:
    """Row (n, 12) of the shear strain along a reference axis at one point."""
    points = np.array([place])
    reference = shape_gradients("QUA4", points)
    J = np.einsum("ki,ckj->cij", reference[0], local)
    N, dN = shape_functions("QUA4", points)[0], reference[0, :, axis]
    row = np.zeros((len(local), 4, 3))
    row[:, :, 0] = dN
    row[:, :, 2] = N * J[:, axis, :1]
    row[:, :, 1] = -N * J[:, axis, 1:]
    return row.reshape(len(local), 12)


def _assumed_shear(local: FloatArray, points: FloatArray) -> FloatArray:
    """Bilinear bending, shear interpolated from the middles of the sides (n, 5, p, 12)."""
    reference = shape_gradients("QUA4", points)
    inverse = np.linalg.inv(np.einsum("pki,ckj->cpij", reference, local))
    slopes = np.einsum("cpji,pki->cpjk", inverse, reference)
    dx, dy = slopes[:, :, 0], slopes[:, :, 1]
    n, p = dx.shape[:2]
    by_node = np.zeros((n, 5, p, 4, 3))
    by_node[:, 0, ..., 2] = dx
    by_node[:, 2, ..., 2] = dy
    by_node[:, 1, ..., 1], by_node[:, 2, ..., 1] = -dy, -dx
    B = by_node.reshape(n, 5, p, 12)
    s, t = points.T
    low, high = (_covariant_shear(local, (0.0, e), 0)[:, None] for e in (-1.0, 1.0))
    left, right = (_covariant_shear(local, (e, 0.0), 1)[:, None] for e in (-1.0, 1.0))
    along = 0.5 * ((1 - t)[:, None] * low + (1 + t)[:, None] * high)
    across = 0.5 * ((1 - s)[:, None] * left + (1 + s)[:, None] * right)
    covariant = np.stack([along, across], axis=2)
    B[:, 3:] = np.einsum("cpji,cpim->cjpm", inverse, covariant)
    return B


def _discrete_shear(local: FloatArray, points: FloatArray, moduli: FloatArray) -> FloatArray:
    """Curvatures and shears (n, 5, p, 9) of a triangle with moduli (n or 1, 8, 8)."""
    rotations = kirchhoff_rotations(local)
    sides = np.roll(local, -1, axis=1) - local
    sides /= np.linalg.norm(sides, axis=2, keepdims=True)
    # second derivatives (n, side, 2, 2) of the shapes of the middles: 4 L_i L_j
    J = np.stack([local[:, 1] - local[:, 0], local[:, 2] - local[:, 0]], axis=1)
    slopes = np.einsum("cij,kj->cki", np.linalg.inv(J), shape_gradients("TRI3", points[:1])[0])
    pair = np.einsum("cka,ckb->ckab", slopes, np.roll(slopes, -1, axis=1))
    second = 4 * (pair + np.swapaxes(pair, -1, -2))
    # V = div M of a bulge of each side's rotation, and the shear strain that it makes
    bent = np.einsum("ckab,cks->ckasb", second, sides)  # cell, side, d(d beta_s / dx_b) / dx_a
    curved = np.stack([bent[..., 0, 0], bent[..., 1, 1], bent[..., 0, 1] + bent[..., 1, 0]], -1)
    moments = np.einsum("cij,ckaj->ckai", moduli[:, 3:6, 3:6], curved)
    forces = np.stack(
        [moments[:, :, 0, 0] + moments[:, :, 1, 2], moments[:, :, 0, 2] + moments[:, :, 1, 1]], 1
    )
    strain = np.linalg.solve(np.broadcast_to(moduli[:, 6:, 6:], (len(local), 2, 2)), forces)
    # bulges without shear, then with it: bulge = without + 3/2 side . strain bulge
    ends = 0.5 * (rotations[:, ::2] + np.roll(rotations[:, ::2], -1, axis=1))
    without = np.einsum("cks,cksm->ckm", sides, rotations[:, 1::2] - ends)
    bulge = np.linalg.solve(np.eye(3) - 1.5 * sides @ strain, without)
    rotations[:, 1::2] += np.einsum("cks,ckm->cksm", sides, bulge - without)
    curvatures = curvatures_of(rotations, local, points)
    shears = np.broadcast_to((strain @ bulge)[:, :, None], (len(local), 2, *curvatures.shape[2:]))
    return np.concatenate([curvatures, shears], axis=1)


class Mindlin(FlatShell):
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

    def bending(
        self, zone: Zone, parameters: ZoneField, cells: slice, points: FloatArray
    ) -> FloatArray:
        """Curvatures and shears; those of DST by its moduli, the mean of each cell."""
        local = flat_frames(zone, cells)[1]
        if zone.element == "COQ4":
            return _assumed_shear(local, points)
        given = moduli_from_field(zone, parameters, "RIGIDITE")
        moduli = self.moduli(zone, parameters, "RIGIDITE") if given is None else given
        return _discrete_shear(local, points, per_cell(moduli.mean(axis=1), cells))
