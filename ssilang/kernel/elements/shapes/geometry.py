"""Geometry of cells at quadrature points: gradients of shape functions, volumes."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.shapes.polygons import SIDES, consistent
from ssilang.kernel.elements.shapes.quadrature import Rule
from ssilang.kernel.elements.shapes.reference import shape_functions, shape_gradients

CHUNK = 512
"""Cells treated at once: the working arrays of a chunk then stay in the cache."""


def chunks(n_cells: int) -> Iterator[slice]:
    """Slices that cover range(n_cells)."""
    for start in range(0, n_cells, CHUNK):
        yield slice(start, min(start + CHUNK, n_cells))


@dataclass(frozen=True, eq=False)
class CellGeometry:
    """Cells at quadrature points."""

    shapes: FloatArray  # (n_points, n_nodes)
    gradients: FloatArray  # (n_cells, n_points, dim, n_nodes) of the shape functions by x, y, z
    volumes: FloatArray  # (n_cells, n_points) quadrature weight times |Jacobian|


def _inverse(jacobians: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Determinants (...) and inverses (..., d, d) of small matrices, written out."""
    d = jacobians.shape[-1]
    J = np.moveaxis(jacobians, (-2, -1), (0, 1))
    if d == 1:
        det = J[0, 0]
        cofactors = np.ones_like(J)
    elif d == 2:
        det = J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
        cofactors = np.array([[J[1, 1], -J[0, 1]], [-J[1, 0], J[0, 0]]])
    else:
        c = [np.cross(J[:, 1], J[:, 2], axis=0)]
        c += [np.cross(J[:, 2], J[:, 0], axis=0), np.cross(J[:, 0], J[:, 1], axis=0)]
        cofactors = np.stack(c)
        det = (J[:, 0] * c[0]).sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return det, cofactors / det


def _jacobians(reference: FloatArray, coordinates: FloatArray) -> FloatArray:
    """Derivatives (n_cells, p, d, d) of the position, from those (p, k, d) of the shapes."""
    p, k, d = reference.shape
    flat = np.moveaxis(reference, 1, 2).reshape(p * d, k)
    return (flat @ coordinates).reshape(-1, p, d, d)


FLAT = 1e-12  # sine of an angle, or height of a cell beside its length: no digit is left


def _check_jacobians(det: FloatArray, jacobians: FloatArray) -> None:
    """Cells may be numbered either way round, but must be neither folded nor flat."""
    scale = np.abs(det).max(axis=1, keepdims=True)
    sides = np.sqrt((jacobians**2).sum(axis=3))
    flat = np.abs(det) <= np.maximum(1e-14 * scale, FLAT * sides.prod(axis=2))
    flat |= sides.min(axis=2) <= FLAT * sides.max(axis=2)
    folded = flat.any(axis=1) | (det.min(axis=1) < 0) & (det.max(axis=1) > 0)
    if folded.any():
        first = int(np.argmax(folded))
        told = {"n_folded": int(folded.sum()), "first": first + 1}
        raise MeshError("kernel.elements.jacobian-vanishes-changes-sign", **told)


def cell_geometry(cell_type: str, coordinates: FloatArray, rule: Rule) -> CellGeometry:
    """Geometry of cells that fill their space (dimension of the cell = of the coordinates).

    Parameters
    ----------
    coordinates : array (n_cells, n_nodes, dim)

    Raises
    ------
    MeshError
        If a Jacobian vanishes or changes sign in a cell.
    """
    reference = shape_gradients(cell_type, rule.points)
    p, k, d = reference.shape
    # jacobians[c, p, i, j] = dx_j / dxi_i, inverse[c, p, j, i] = dxi_i / dx_j
    jacobians = _jacobians(reference, coordinates)
    det, inverse = _inverse(jacobians)
    _check_jacobians(det, jacobians)
    gradients = np.zeros((len(coordinates), p, d, k))
    for j in range(d):
        for i in range(d):
            gradients[:, :, j] += inverse[j, i][:, :, None] * reference[:, :, i]
    shapes = shape_functions(cell_type, rule.points)
    volumes = rule.weights * np.abs(det)
    if cell_type in SIDES and p > 1:
        gradients, volumes = consistent(gradients, volumes, coordinates)
    return CellGeometry(shapes, gradients, volumes)


def cell_volumes(cell_type: str, coordinates: FloatArray, rule: Rule) -> FloatArray:
    """The volumes of `cell_geometry`, without its gradients where they are not needed."""
    if cell_type in SIDES:
        return cell_geometry(cell_type, coordinates, rule).volumes
    J = _jacobians(shape_gradients(cell_type, rule.points), coordinates)
    det = J[..., 0, 0] * J[..., 1, 1] - J[..., 0, 1] * J[..., 1, 0] if J.shape[-1] == 2 else None
    det = np.linalg.det(J) if det is None else det
    _check_jacobians(det, J)
    return rule.weights * np.abs(det)


@dataclass(frozen=True, eq=False)
class SurfaceGeometry:
    """Lines in the plane or surfaces in space at quadrature points.

    Attributes
    ----------
    shapes : array (n_points, n_nodes)
    normals : array (n_cells, n_points, dim)
        Vector area element times weight: for a line (t_y, -t_x), which points to the right of
        its direction; for a surface the cross product of its two tangents.
    measures : array (n_cells, n_points)
        Norm of `normals`.
    """

    shapes: FloatArray
    normals: FloatArray
    measures: FloatArray


def surface_geometry(cell_type: str, coordinates: FloatArray, rule: Rule) -> SurfaceGeometry:
    """Geometry of cells of one dimension less than their space.

    Parameters
    ----------
    coordinates : array (n_cells, n_nodes, dim)
        dim is 2 for lines, 3 for surfaces.
    """
    reference = shape_gradients(cell_type, rule.points)
    tangents = np.einsum("pkd,ckj->cpdj", reference, coordinates)
    if coordinates.shape[2] == 2:
        t = tangents[:, :, 0]
        area = np.stack([t[..., 1], -t[..., 0]], axis=-1)
    else:
        area = np.cross(tangents[:, :, 0], tangents[:, :, 1])
    normals = area * rule.weights[None, :, None]
    shapes = shape_functions(cell_type, rule.points)
    return SurfaceGeometry(shapes, normals, np.linalg.norm(normals, axis=-1))


def line_geometry(
    cell_type: str, coordinates: FloatArray, rule: Rule
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Lines in space.

    Returns
    -------
    shapes : array (n_points, n_nodes)
    gradients : array (n_cells, n_points, dim, n_nodes)
        Derivative by the arc length times the unit tangent: strain is `gradients . u`.
    lengths : array (n_cells, n_points)
        Quadrature weight times length.
    """
    reference = shape_gradients(cell_type, rule.points)[:, :, 0]
    tangents = np.einsum("pk,ckj->cpj", reference, coordinates)
    speed = np.linalg.norm(tangents, axis=-1)
    if (speed <= 0).any():
        raise MeshError("kernel.elements.line-cell-zero-length")
    directions = tangents / speed[..., None] ** 2
    gradients = directions[..., None] * reference[None, :, None, :]
    return shape_functions(cell_type, rule.points), gradients, rule.weights * speed
