"""Finding the cell of a mesh in which points lie, and the shape functions there."""

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.elements.shapes.polygons import SIDES, polygon_excess
from ssilang.kernel.elements.shapes.reference import (
    reference_cell,
    shape_functions,
    shape_gradients,
)
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

Found = tuple[IntArray, FloatArray]


def locate(mesh: Mesh, points: FloatArray, tolerance: float = 1e-5) -> list[Found]:
    """For each block of the mesh: cell of each point (n,), -1 for none, shapes (n, n_nodes).

    A point goes to the first block and cell that hold it within `tolerance` (reference
    coordinates, and distance over cell size for lines and surfaces in space).
    """
    out: list[Found] = []
    free = np.ones(len(points), bool)
    for block in mesh.blocks:
        cells = np.full(len(points), -1, dtype=np.int64)
        shapes = np.zeros((len(points), block.kind.n_nodes))
        for place, cell, values in _in_block(block, points, np.flatnonzero(free), tolerance):
            new = cells[place] < 0
            cells[place[new]], shapes[place[new]] = cell[new], values[new]
        free &= cells < 0
        out.append((cells, shapes))
    return out


def _in_block(
    block: CellBlock, points: FloatArray, wanted: IntArray, tolerance: float
) -> list[tuple[IntArray, IntArray, FloatArray]]:
    if len(wanted) == 0 or len(block) == 0:
        return []
    corners = block.coordinates
    centres = corners.mean(axis=1)
    radius = np.linalg.norm(corners - centres[:, None], axis=2).max(axis=1) * (1.01 + tolerance)
    near = spatial.cKDTree(points[wanted]).query_ball_point(centres, radius)
    counts = np.array([len(n) for n in near])
    cell = np.repeat(np.arange(len(block)), counts)
    place = wanted[np.concatenate([np.asarray(n, dtype=np.int64) for n in near])]
    if len(cell) == 0:
        return []
    reference, miss = _inverse_map(block.cell_type, corners[cell], points[place])
    shapes = shape_functions(block.cell_type, reference)
    off = np.maximum(_outside(block.cell_type, reference), miss / radius[cell])
    good = off <= tolerance
    order = np.lexsort((off[good], place[good]))
    place, cell, shapes = place[good][order], cell[good][order], shapes[good][order]
    _, first = np.unique(place, return_index=True)
    return [(place[first], cell[first], shapes[first])]


def _inverse_map(
    cell_type: str, corners: FloatArray, points: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Reference coordinates (n, dim) by Gauss-Newton, and the distance left over (n,)."""
    reference = reference_cell(cell_type)
    dim = reference.nodes.shape[1]
    xi = np.tile(reference.nodes.mean(axis=0), (len(points), 1))
    for _ in range(15):
        shapes = shape_functions(cell_type, xi)
        gap = points - np.einsum("nk,nkd->nd", shapes, corners)
        gradients = shape_gradients(cell_type, xi)
        jacobian = np.einsum("nki,nkd->ndi", gradients, corners)
        normal = np.einsum("ndi,ndj->nij", jacobian, jacobian)
        normal += 1e-14 * np.trace(normal, axis1=1, axis2=2)[:, None, None] * np.eye(dim)
        right = np.einsum("ndi,nd->ni", jacobian, gap)
        step = np.linalg.solve(normal, right[..., None])[..., 0]
        xi = xi + np.clip(step, -2.0, 2.0)
        if np.abs(step).max() < 1e-13:
            break
    shapes = shape_functions(cell_type, xi)
    gap = points - np.einsum("nk,nkd->nd", shapes, corners)
    return xi, np.linalg.norm(gap, axis=1)


def _outside(cell_type: str, xi: FloatArray) -> FloatArray:
    """How far reference coordinates lie outside the cell, zero inside, shape (n,)."""
    shape = reference_cell(cell_type).shape
    if cell_type in SIDES:
        excess = polygon_excess(SIDES[cell_type], xi)
    else:
        excess = _EXCESS[shape](xi) if shape in _EXCESS else np.abs(xi) - 1.0
    return np.clip(excess, 0.0, None).max(axis=1, initial=0.0)


def _simplex(xi: FloatArray) -> FloatArray:
    return np.column_stack([-xi, xi.sum(axis=1) - 1.0])


_EXCESS: dict[str, Callable[[FloatArray], FloatArray]] = {
    "triangle": _simplex,
    "tetrahedron": _simplex,
    "prism": lambda xi: np.column_stack([_simplex(xi[:, :2]), np.abs(xi[:, 2]) - 1.0]),
    "pyramid": lambda xi: np.column_stack(
        [np.abs(xi[:, :2]).max(axis=1) + xi[:, 2] - 1.0, -xi[:, 2]]
    ),
    "point": np.abs,
}
