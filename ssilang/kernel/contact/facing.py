"""Points of one side seen from the cells of the other: where they project, how far they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.mesh import Mesh

OUTSIDE = 1e-6
"""How far out of a cell, in its own coordinates, a point still projects onto it."""
FACING = -0.1
"""Cosine of normals above which two sides do not face each other."""
BEHIND = 0.5
"""Depth under a cell, in its size, beyond which a point is on the other side of the body."""


@dataclass(frozen=True, eq=False)
class Side:
    """Straight cells of a side: segments in the plane, triangles in space.

    Attributes
    ----------
    cells : array (n_cells, k)
        Nodes; the outer normal is to the right of a segment's travel, and by the right hand
        about a triangle.
    corners : array (n_cells, k, dim)
    normals : array (n_cells, dim)
    sizes : array (n_cells,)
        Length, or area.
    """

    cells: IntArray
    corners: FloatArray
    normals: FloatArray
    sizes: FloatArray


def side_of(mesh: Mesh, dimension: int) -> Side:
    """The cells of a mesh of lines (plane) or triangles (space; quadrangles are cut in two).

    Raises
    ------
    MeshError
        For other cells.
    """
    wanted = {2: ("SEG2",), 3: ("TRI3", "QUA4")}[dimension]
    parts: list[IntArray] = []
    for block in mesh.blocks:
        if block.cell_type not in wanted:
            raise MeshError(
                "kernel.contact.side-contact-made-not", wanted=wanted, cell_type=block.cell_type
            )
        c = block.connectivity
        parts += [c] if block.cell_type != "QUA4" else [c[:, [0, 1, 2]], c[:, [0, 2, 3]]]
    cells = np.concatenate(parts)
    corners = mesh.nodes.coordinates[cells][..., :dimension]
    along = np.diff(corners, axis=1)
    if dimension == 2:
        normals = np.stack([along[:, 0, 1], -along[:, 0, 0]], axis=1)
        sizes = np.linalg.norm(normals, axis=1)
    else:
        normals = np.cross(along[:, 0], along[:, 1])
        sizes = 0.5 * np.linalg.norm(normals, axis=1)
    if (sizes <= 0).any():
        raise MeshError("kernel.contact.side-contact-cell-without")
    return Side(cells, corners, normals / np.linalg.norm(normals, axis=1, keepdims=True), sizes)


@dataclass(frozen=True, eq=False)
class Projection:
    """Where points fall on a side.

    Attributes
    ----------
    cell : array (n,)
        Cell, -1 for none.
    shapes : array (n, k)
        Shape functions there.
    gap : array (n,)
        Distance along the cell's normal, negative inside the body.
    """

    cell: IntArray
    shapes: FloatArray
    gap: FloatArray


def project(side: Side, points: FloatArray, normals: FloatArray) -> Projection:
    """The nearest facing cell for each point.

    Parameters
    ----------
    points : array (n, dim)
    normals : array (n, dim)
        Outer normals of the side that the points belong to.
    """
    shapes = _coordinates(side, points)
    offset = points[:, None] - side.corners[None, :, 0]
    gap = np.einsum("ncd,cd->nc", offset, side.normals)
    inside = (shapes >= -OUTSIDE).all(axis=2)
    against = normals @ side.normals.T <= FACING
    scale = side.sizes ** (1 / (points.shape[1] - 1))
    good = inside & against & (gap >= -BEHIND * scale)
    cost = np.where(good, np.abs(gap), np.inf)
    best = cost.argmin(axis=1)
    rows = np.arange(len(points))
    found = np.isfinite(cost[rows, best])
    return Projection(np.where(found, best, -1), shapes[rows, best], gap[rows, best])


def _coordinates(side: Side, points: FloatArray) -> FloatArray:
    """Shape functions (n, n_cells, k) of the feet of points on the cells' planes."""
    first = side.corners[:, 0]
    edges = side.corners[:, 1:] - first[:, None]
    metric = np.einsum("cid,cjd->cij", edges, edges)
    right = np.einsum("ncd,cid->nci", points[:, None] - first[None], edges)
    local = np.einsum("cij,ncj->nci", np.linalg.inv(metric), right)
    return np.concatenate([1 - local.sum(axis=2, keepdims=True), local], axis=2)
