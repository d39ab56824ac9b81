"""Triangles refined to wanted sizes, their contour kept; triangulations of points."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import contour
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.surfaces.charts import plane_chart
from ssilang.kernel.mesh.surfaces.fill import SizeField, fill_contour
from ssilang.kernel.mesh.surfaces.surface import contour_cells, contour_chart_data


def refined_triangles(
    mesh: Mesh, ids: IntArray, sizes: FloatArray, colour: int = 0, limit: int | None = None
) -> Mesh:
    """A plane mesh of TRI3 with points added inside until its triangles have the wanted sizes.

    Parameters
    ----------
    ids, sizes : array (n,)
        Nodes of the mesh and the sizes wanted there; all nodes are kept.
    limit : int, optional
        Most nodes of the result: the sizes grow alike until it is kept.

    Raises
    ------
    MeshError
        If the mesh has more nodes than that already.
    """
    if limit is not None and limit < len(ids):
        raise MeshError("kernel.mesh.limit-below-nodes", limit=limit, n_nodes=len(ids))
    border = contour(mesh)
    chart = plane_chart(*contour_chart_data(border))
    nodes = mesh.nodes
    edge = contour_cells(border)
    first = np.unique(edge)
    every = np.concatenate([first, np.setdiff1d(ids, first)])
    number = np.zeros(int(every.max()) + 1, dtype=np.int64)
    number[every] = np.arange(len(every))
    flat = chart.flatten(nodes.coordinates[every].copy())
    at = chart.flatten(nodes.coordinates[ids].copy())
    field = SizeField(at, sizes)
    points, triangles = fill_contour(flat, number[edge], field, squares=False)
    while limit is not None and len(points) > limit:
        sizes = sizes * max(1.1, np.sqrt(len(points) / limit))
        field = SizeField(at, sizes)
        points, triangles = fill_contour(flat, number[edge], field, squares=False)
    fresh = points[len(every) :]
    made = nodes.add(chart.lift(fresh), field(fresh)) if len(fresh) else fresh[:, 0].astype(int)
    table = np.concatenate([every, made])
    return Mesh.of(nodes, "TRI3", table[triangles], colour)


def delaunay_mesh(mesh: Mesh, dimension: int, colour: int = 0) -> Mesh:
    """The Delaunay triangulation of a mesh's nodes: TRI3 in 2D, TET4 in 3D.

    Raises
    ------
    MeshError
        If the points are too few or lie in one line or plane.
    """
    from scipy.spatial import Delaunay, QhullError

    ids = mesh.node_ids
    if not len(ids):
        raise MeshError("kernel.mesh.mesh-empty-nothing-triangulate")
    at = mesh.nodes.coordinates[ids, :dimension]
    try:
        cells = Delaunay(at).simplices.astype(np.int64)
    except QhullError as error:
        raise MeshError("kernel.mesh.points-too-few-line") from error
    arms = at[cells[:, 1:]] - at[cells[:, :1]]
    negative = np.linalg.det(arms) < 0
    cells[negative, :2] = cells[negative, 1::-1]
    return Mesh.of(mesh.nodes, "TRI3" if dimension == 2 else "TET4", ids[cells], colour)
