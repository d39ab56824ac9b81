"""SHB8: a shell on bricks, integrated along one line through the thickness.

Abed-Meraim and Combescure (2002, 2007). Nodes 1-4 are one face of the shell, 5-8 the other; five
Gauss points stand on the line between the faces' centres. Across the thickness a stress E times
the strain acts, uncoupled from plane stress in the surface. Transverse shear is taken at the
middles of the sides (Dvorkin and Bathe 1984), where bending leaves none, so that distorted thin
bricks do not lock.

The line of points does not feel seven motions of the brick; further strains hold them, constant in
the cell, each with the energy that its part of an assumed strain field has:

- xi eta and xi eta zeta of the displacements in the surface: only the direct strains that they
  make (which keeps the membrane from locking);
- xi eta zeta of the deflection: only the transverse shear;
- the two transverse shears that vary along the surface.

They see nothing of linear displacements, and are components of their own in strains and stresses
(GH.. and SH..): forces in balance with the stresses of a displacement are exactly its stiffness'.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements import family
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.shapes.geometry import CellGeometry, cell_geometry, chunks
from ssilang.kernel.elements.shapes.quadrature import Rule, quadrature
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS, shape_gradients
from ssilang.kernel.elements.shells.shell_section import isotropic
from ssilang.kernel.elements.solids.kinematics import SOLID_KINEMATICS
from ssilang.kernel.elements.solids.solid import Solid, geometric_scalar, strain_matrix
from ssilang.kernel.elements.solids.solid_moduli import symmetry_of
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.elasticity import PAIRS, rotated_moduli
from ssilang.kernel.materials.model import Mode, Zone

_KINEMATICS = SOLID_KINEMATICS[Mode.THREE_DIMENSIONAL]
_HELD = 7
_XI, _ETA, _ZETA = REFERENCE_CELLS["CUB8"].nodes.T
_PATTERNS = np.stack([_XI * _ETA, _XI * _ETA * _ZETA])


@dataclass(frozen=True, eq=False)
class _Brick:
    """Some bricks seen from their centres."""

    axes: FloatArray  # (n, 3, 3) unit rows: along the first direction, in the surface, normal
    steps: FloatArray  # (n, 3, 3) rows: derivative of the place by each coordinate, at the centre
    slopes: FloatArray  # (n, 3, 8) mean gradients of the shape functions over the line of points
    share: FloatArray  # (n, p) part of the volume that each point has
    line: CellGeometry  # gradients and volumes at the points
    nodes: FloatArray  # (n, 8, 3)


def _bricks(zone: Zone, cells: slice = slice(None), support: Support = "STRESSES") -> _Brick:
    x = zone.cells.nodes.coordinates[zone.cells.connectivity[cells]]
    line = cell_geometry("CUB8", x, support_rule(zone.element, support))
    share = line.volumes / line.volumes.sum(axis=1, keepdims=True)
    slopes = np.einsum("cp,cpik->cik", share, line.gradients)
    reference = shape_gradients("CUB8", np.zeros((1, 3)))[0]
    steps = np.einsum("ki,ckj->cij", reference, x)
    e1 = steps[:, 0] / np.linalg.norm(steps[:, 0], axis=1, keepdims=True)
    normal = np.cross(steps[:, 0], steps[:, 1])
    e3 = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    return _Brick(np.stack([e1, np.cross(e3, e1), e3], axis=1), steps, slopes, share, line, x)


def _without_linear(rows: FloatArray, brick: _Brick) -> FloatArray:
    """Rows (n, r, 8, 3) on the displacements less their linear part."""
    moments = np.einsum("crkj,cki->crij", rows, brick.nodes)
    linear: FloatArray = np.einsum("crij,cik->crkj", moments, brick.slopes)
    return rows - linear


def _held_rows(brick: _Brick, mean: FloatArray) -> FloatArray:
    """Operator (n, 7, 24) of the strains that hold what the line of points does not feel.

    Their squares, times the modulus of the direct strain (first four) or of shear (others), are
    the mean energies of the fields they stand for. `mean` (n, 6, 24) gives the mean strains.
    """
    n = len(brick.nodes)
    rows = np.zeros((n, _HELD, 8, 3))
    flat, twisted = _PATTERNS / 8
    inverse = np.linalg.inv(brick.steps)  # inverse[c, j, i] = d xi_i / d x_j
    rate = np.einsum("cai,cik->cak", brick.axes[:, :2], inverse)[..., :2]
    size = np.linalg.norm(rate, axis=2) / np.sqrt(3.0)  # root mean square of d (xi eta) / d x_a
    # less what a displacement zeta (k . x) of constant curvature k has of xi eta zeta
    slopes = np.stack([_ZETA * _XI, _ZETA * _ETA]) / 8
    place = np.einsum("k,ckj,caj->ca", flat, brick.nodes, brick.axes[:, :2])
    bent = twisted - np.einsum("ca,cai,ik->ck", place, rate, slopes)
    for a in (0, 1):
        along = brick.axes[:, a][:, None]
        rows[:, a] = flat[None, :, None] * along * size[:, a, None, None]
        rows[:, 2 + a] = bent[..., None] * along * size[:, a, None, None] / np.sqrt(3.0)
    whole = np.linalg.norm(size, axis=1)[:, None, None] / np.sqrt(3.0)
    rows[:, 4] = twisted[None, :, None] * brick.axes[:, 2][:, None] * whole
    held: FloatArray = _without_linear(rows, brick).reshape(n, _HELD, 24)
    metric = np.einsum("cji,cjk->cik", inverse, inverse)
    for a in (0, 1):
        scale = np.sqrt(metric[:, a, a] * metric[:, 2, 2] / 3.0)[:, None]
        # half the change from side to side, less that of the mean strain
        across, on_strain = _covariant_shear(brick, a, _ends(a))
        own = (across[:, 1] - across[:, 0]).reshape(-1, 24)
        usual = np.einsum("cs,csm->cm", on_strain[:, 1] - on_strain[:, 0], mean)
        held[:, 5 + a] = (own - usual) / 2 * scale
    return held


def _covariant_shear(brick: _Brick, axis: int, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Shear between a direction of the surface and that across, at reference points.

    Returns
    -------
    operator (n, p, 8, 3) on displacements, and (n, p, 6) on strains EPXX .. GAYZ
    """
    reference = shape_gradients("CUB8", points)
    steps = np.einsum("pki,ckj->cpij", reference, brick.nodes)
    along, across = steps[:, :, axis], steps[:, :, 2]
    rows = np.einsum("pk,cpj->cpkj", reference[:, :, axis], across)
    rows += np.einsum("pk,cpj->cpkj", reference[:, :, 2], along)
    on_strain = [along[..., i] * across[..., j] + along[..., j] * across[..., i] for i, j in PAIRS]
    return rows, np.stack(on_strain, axis=-1)


def _ends(axis: int, across: float = 0.0) -> FloatArray:
    """Middles (2, 3) of the sides on which the shear along `axis` is sampled."""
    points = np.full((2, 3), across)
    points[:, axis], points[:, 1 - axis] = 0.0, (-1.0, 1.0)
    return points


def _sampled_shear(brick: _Brick, points: FloatArray) -> FloatArray:
    """What takes the strains (n, 6, p, 24) of the line of points to shears sampled on the sides."""
    n, p = len(brick.nodes), len(points)
    steps = np.einsum("pki,ckj->cpij", shape_gradients("CUB8", points), brick.nodes)
    inverse = np.linalg.inv(steps)
    added = np.zeros((n, 6, p, 24))
    for axis in (0, 1):
        here = _covariant_shear(brick, axis, points)[0]
        places = np.concatenate([_ends(axis, z) for z in points[:, 2]])
        sides = _covariant_shear(brick, axis, places)[0].reshape(n, p, 2, 8, 3).mean(axis=2)
        change = _without_linear(sides - here, brick).reshape(n, p, 24)
        a, b = inverse[..., axis], inverse[..., 2]
        for row, (i, j) in enumerate(PAIRS):
            share = a[..., i] * b[..., j] + (i != j) * a[..., j] * b[..., i]
            added[:, row] += share[..., None] * change
    return added


class SolidShell(family.ElementFamily):
    """Shell on bricks, with translations only."""

    # in global axes, then those that hold the brick
    strains = (*_KINEMATICS.strains, *(f"GH0{i + 1}" for i in range(_HELD)))
    stresses = (*_KINEMATICS.stresses, *(f"SH0{i + 1}" for i in range(_HELD)))

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Plane stress in the surface, E across it, shear; turned to global axes.

        Raises
        ------
        MaterialError
            If the material is not isotropic.
        """
        if symmetry_of(zone) != "ISOTROPE":
            raise MaterialError(
                "kernel.elements.elasticity-not-available-shb8", symmetry_of=symmetry_of(zone)
            )
        plane = isotropic(parameters, support)
        own = np.zeros((*plane.shape[:2], 6, 6))
        own[..., :2, :2] = plane[..., :2, :2]
        own[..., 2, 2] = parameters.at("YOUN", support)
        for i in (3, 4, 5):
            own[..., i, i] = plane[..., 2, 2]
        n, p = len(zone.cells), plane.shape[1]
        D = np.zeros((n, p, 6 + _HELD, 6 + _HELD))
        D[..., :6, :6] = rotated_moduli(own, _bricks(zone).axes[:, None])
        for i in range(_HELD):
            D[..., 6 + i, 6 + i] = plane[..., 0, 0] if i < 4 else plane[..., 2, 2]
        return D

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> family.StrainOperator:
        """Symmetric gradient at the points, and the holding strains, the same at all."""
        brick = _bricks(zone, cells, support)
        n, p = brick.share.shape
        matrix = np.empty((n, 6 + _HELD, p, 24))
        matrix[:, :6] = strain_matrix(zone, brick.line, cells)
        matrix[:, :6] += _sampled_shear(brick, support_rule(zone.element, support).points)
        mean = np.einsum("cp,cspm->csm", brick.share, matrix[:, :6])
        matrix[:, 6:] = _held_rows(brick, mean)[:, :, None]
        return family.StrainOperator(matrix, brick.line.volumes)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, family.Layout]:
        """That of the brick, 2 x 2 x 2 points."""
        return Solid().mass_values(zone, parameters)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Integral of grad(N)^T sigma grad(N), the stress of the points in all their layer."""
        n = len(zone.cells)
        values = np.zeros((n, 24, 24))
        for cells in chunks(n):
            brick = _bricks(zone, cells)
            # geometric stiffness (n, 8, 8) of one unknown, 2 x 2 points in each layer
            square, line = quadrature("quadrangle", 4), quadrature("line", 5)
            points = np.column_stack([np.tile(square.points, (5, 1)), np.repeat(line.points, 4)])
            rule = Rule(points, np.repeat(line.weights, 4) * np.tile(square.weights, 5))
            geometry = cell_geometry("CUB8", brick.nodes, rule)
            spread = np.repeat(stress[cells][:, :6], 4, axis=2)
            scalar = geometric_scalar(zone, geometry, spread, geometry.volumes, cells)[0]
            values[cells] = family.spread(scalar, 3)
        return values
