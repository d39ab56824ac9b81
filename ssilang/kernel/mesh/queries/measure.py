"""Lengths, areas, volumes and mesh sizes."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.shapes.quadrature import quadrature
from ssilang.kernel.elements.shapes.reference import (
    reference_cell,
    shape_functions,
    shape_gradients,
)
from ssilang.kernel.mesh.boundary import edges
from ssilang.kernel.mesh.cells import POLYGON_SIDES
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.surfaces.fill import mean_sizes


def cell_measures(block: CellBlock) -> FloatArray:
    """Length, area or volume of each cell (n,), curved quadratic cells included; 0 for points.

    Volumes and plane areas of straight cells are exact; lengths and areas of curved cells in
    space are those of the quadrature rule.
    """
    if block.kind.joint or block.kind.dimension == 0:
        return np.zeros(len(block))
    x = block.coordinates
    rule = quadrature(reference_cell(block.cell_type).shape, _POINTS[block.cell_type])
    frames = np.einsum("gkd,nkj->ngdj", shape_gradients(block.cell_type, rule.points), x)
    dimension = frames.shape[2]
    if dimension == 3:
        return np.abs(np.linalg.det(frames) @ rule.weights)
    if dimension == 2:
        size = np.linalg.norm(np.cross(frames[:, :, 0], frames[:, :, 1]), axis=-1)
    else:
        size = np.linalg.norm(frames[:, :, 0], axis=-1)
    return size @ rule.weights


def total_measure(mesh: Mesh) -> float:
    """Measure of the cells of the highest dimension in the mesh."""
    top = mesh.dimension
    return float(sum(cell_measures(b).sum() for b in mesh.blocks if b.kind.dimension == top))


def enclosed_area(line: Mesh) -> float:
    """Area inside closed lines: the modulus of the area vector (projection on the mean plane).

    Quadratic cells are counted with their curvature.
    """
    return float(np.linalg.norm(_area_vector(line)))


def signed_area(contour: Mesh) -> float:
    """Area inside a contour in the plane, positive if it runs anticlockwise.

    A contour that is open is closed by a straight segment from its last node to its first.

    Raises
    ------
    MeshError
        If the mesh is not a line.
    """
    total = _area_vector(contour)[2]
    table = np.concatenate([b.connectivity[:, [0, -1]] for b in contour.blocks])
    first, last = np.setdiff1d(table[:, 0], table[:, 1]), np.setdiff1d(table[:, 1], table[:, 0])
    xyz = contour.nodes.coordinates
    if len(first) == len(last) == 1:
        total += 0.5 * np.cross(xyz[last[0]], xyz[first[0]])[2]
    return float(total)


def _area_vector(line: Mesh) -> FloatArray:
    total = np.zeros(3)
    for block in line.blocks:
        if block.kind.dimension != 1 or block.kind.joint:
            raise MeshError("kernel.mesh.area-inside-line-asked")
        x = block.coordinates
        rule = quadrature("line", 3)
        at = np.einsum("gk,nkj->gnj", shape_functions(block.cell_type, rule.points), x)
        slope = np.einsum("gkd,nkj->gnj", shape_gradients(block.cell_type, rule.points), x)
        total += 0.5 * rule.weights @ np.cross(at, slope).sum(axis=1)
    return total


def enclosed_volume(surface: Mesh) -> float:
    """Volume inside a closed surface, by the divergence theorem on its triangulated cells."""
    total = 0.0
    for block in surface.blocks:
        if block.kind.dimension != 2 or block.kind.joint:
            raise MeshError("kernel.mesh.volume-inside-surface-asked")
        corners = list(block.kind.corners)
        x = block.coordinates[:, : block.kind.degree * len(corners)]  # no middle of the cell
        centre = x[:, corners].mean(axis=1)
        following = np.roll(x, -1, axis=1)
        total += np.einsum("ni,nki->", centre, np.cross(x, following)) / 6.0
    return abs(float(total))


def node_sizes(mesh: Mesh) -> tuple[IntArray, FloatArray]:
    """Mean length of the edges at each node: node numbers (n,) and sizes (n,).

    The middle of a quadratic edge gets the mean over its own two halves.
    """
    lines = [b.connectivity for b in edges(mesh).blocks]
    if not lines:
        raise MeshError("kernel.mesh.mesh-sizes-measured-edges")
    halves = np.concatenate([t[:, k : k + 2] for t in lines for k in range(t.shape[1] - 1)])
    ids, where = np.unique(halves, return_inverse=True)
    return ids, mean_sizes(mesh.nodes.coordinates[ids], where.reshape(-1, 2))


# points of the rule that integrates each type's Jacobian
_POINTS = {
    "SEG2": 1, "SEG3": 5, "TRI3": 1, "TRI6": 7, "QUA4": 9, "QUA8": 25,
    "TET4": 1, "TE10": 27, "PRI6": 6, "PR15": 21, "PYR5": 27, "CUB8": 8, "CU20": 27,
    "TRI7": 7, "QUA9": 25, "PY13": 27, "TE15": 27, "PR21": 21, "CU27": 27,
    **{name: 7 * n for name, n in POLYGON_SIDES.items()},
}  # fmt: skip
