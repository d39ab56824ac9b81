"""DKT and COQ3: flat triangular thin shells with constant membrane strains.

DKT bends by the discrete Kirchhoff condition: Batoz, Bathe, Ho, "A study of three-node triangular
plate bending elements" (1980). Rotations of the normal are quadratic; along each side the
deflection is cubic and Kirchhoff's condition holds at its ends and middle. COQ3 bends by an
incomplete cubic deflection (see `cubic_curvatures`).

COQ4 and DST: flat shells with transverse shear.

COQ4 assumes shear strains (MITC4): Bathe and Dvorkin (1985). DST extends DKT by discrete shears:
Katili, "A new discrete Kirchhoff-Mindlin element based on Mindlin-Reissner plate theory and assumed
shear strain fields, part I" (1993). Along each side the normal's rotation is quadratic, the moment
that it makes linear and, by balance, the shear strain constant: what the side bends and shears is
told by the ratio of its moduli. Batoz and Lardeur (1989) take one shear strain for the cell: beside
each other such cells turn unlike, and thick irregular meshes miss a constant moment.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.family import per_cell
from ssilang.kernel.elements.shapes.reference import shape_functions, shape_gradients
from ssilang.kernel.elements.shells.flat_shell import FlatShell
from ssilang.kernel.elements.shells.shell_section import section_moduli, transverse_moduli
from ssilang.kernel.elements.solids.solid_moduli import moduli_from_field
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
    length = np.linalg.norm(sides, axis=2)
    sides /= length[..., None]
    c, s = np.moveaxis(sides, 2, 0)
    bent = np.stack([c * c, s * s, 2 * c * s], axis=2)
    stiff = np.einsum("cki,cij,ckj->ck", bent, moduli[:, 3:6, 3:6], bent)
    soft = np.einsum("cki,cij,ckj->ck", sides, np.linalg.inv(moduli[:, 6:, 6:]), sides)
    ratio = (12 * stiff * soft / length**2)[..., None]
    # bulge of the rotation in the middle of each side: without shear strain, then with it
    ends = 0.5 * (rotations[:, ::2] + np.roll(rotations[:, ::2], -1, axis=1))
    without = np.einsum("cks,cksm->ckm", sides, rotations[:, 1::2] - ends)
    bulge = without / (1 + ratio)
    rotations[:, 1::2] -= np.einsum("cks,ckm->cksm", sides, ratio * bulge)
    along = -2 / 3 * ratio * bulge
    # linear shears that are constant along each side: at a corner those of both sides hold
    meeting, strains = (np.stack([v, np.roll(v, 1, axis=1)], axis=2) for v in (sides, along))
    corners = np.linalg.solve(meeting, strains)
    shapes = np.column_stack([1 - points.sum(axis=1), points])
    shears = np.einsum("pk,cksm->cspm", shapes, corners)
    return np.concatenate([curvatures_of(rotations, local, points), shears], axis=1)


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
        self, zone: Zone, parameters: ZoneField, cells: slice, local: FloatArray, points: FloatArray
    ) -> FloatArray:
        """Curvatures and shears; those of DST by its moduli, the mean of each cell."""
        if zone.element == "COQ4":
            return _assumed_shear(local, points)
        given = moduli_from_field(parameters, "RIGIDITE")
        moduli = self.moduli(zone, parameters, "RIGIDITE") if given is None else given
        return _discrete_shear(local, points, per_cell(moduli.mean(axis=1), cells))
