"""Polygons of five to twelve sides on regular reference polygons: Wachspress' functions.

Shape function i is `w_i / sum w`, `w_i` the product of the areas of the triangles that the point
makes with all sides but the two at corner i: positive inside, linear along the sides, exact for
linear fields (Wachspress 1975; on regular polygons Sukumar and Tabarraei 2004). Triangles and
quadrangles in a mesh of polygons are TRI3 and QUA4, whose functions are the same.
"""

from functools import cache

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.mesh.cells import POLYGON_SIDES

SIDES = POLYGON_SIDES


def regular_polygon(n: int) -> FloatArray:
    """Corners (n, 2) on the unit circle, anticlockwise."""
    angle = 2.0 * np.pi * np.arange(n) / n
    return np.column_stack([np.cos(angle), np.sin(angle)])


@cache
def _sides(n: int) -> tuple[FloatArray, FloatArray]:
    """Distance of a point p to side i is `offset[i] - normal[i] . p`; side i leaves corner i."""
    angle = 2.0 * np.pi * (np.arange(n) + 0.5) / n
    return np.column_stack([np.cos(angle), np.sin(angle)]), np.full(n, np.cos(np.pi / n))


@cache
def _others(n: int) -> np.ndarray:
    """Sides (n, n - 2) that do not touch each corner."""
    return np.array([[(i + k) % n for k in range(1, n - 1)] for i in range(n)])


def polygon_functions(n: int, points: FloatArray) -> FloatArray:
    """Shape functions (n_points, n) at points (n_points, 2)."""
    normals, offsets = _sides(n)
    distance = offsets - points @ normals.T
    weight: FloatArray = distance[:, _others(n)].prod(axis=2)
    return weight / weight.sum(axis=1, keepdims=True)


def polygon_gradients(n: int, points: FloatArray) -> FloatArray:
    """Their derivatives (n_points, n, 2)."""
    normals, offsets = _sides(n)
    distance, others = offsets - points @ normals.T, _others(n)
    factors = distance[:, others]
    weight = factors.prod(axis=2)
    slope = np.zeros((len(points), n, 2))
    for k in range(n - 2):
        rest = np.delete(factors, k, axis=2).prod(axis=2)
        slope -= rest[..., None] * normals[others[:, k]]
    total = weight.sum(axis=1)[:, None, None]
    return slope / total - weight[..., None] * slope.sum(axis=1)[:, None] / total**2


def polygon_excess(n: int, points: FloatArray) -> FloatArray:
    """How far points (m, 2) lie beyond each side, negative inside, shape (m, n)."""
    normals, offsets = _sides(n)
    return points @ normals.T - offsets


def consistent(
    gradients: FloatArray, volumes: FloatArray, coordinates: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Gradients and volumes corrected so that Gauss' theorem holds exactly in each polygon.

    Quadrature of rational functions is not exact. The volumes are scaled to the polygon's area
    and the gradients get one constant a node, so that their integral is that of the shape
    function times the normal along the sides: constant strains are then exact (Talischi, Pereira,
    Menezes and Paulino 2015).

    Parameters
    ----------
    gradients : array (n_cells, n_points, 2, n)
    volumes : array (n_cells, n_points)
    coordinates : array (n_cells, n, 2)
    """
    after = np.roll(coordinates, -1, axis=1)
    cross = coordinates[..., 0] * after[..., 1] - coordinates[..., 1] * after[..., 0]
    signed = 0.5 * cross.sum(axis=1)
    area, sense = np.abs(signed), np.sign(signed)
    scaled = volumes * (area / volumes.sum(axis=1))[:, None]
    way = after - coordinates
    outward = np.stack([way[..., 1], -way[..., 0]], axis=-1) * sense[:, None, None]
    half = 0.5 * (outward + np.roll(outward, 1, axis=1))
    found = np.einsum("cp,cpdk->ckd", scaled, gradients)
    lack = np.moveaxis((half - found) / area[:, None, None], 1, 2)
    return gradients + lack[:, None], scaled
