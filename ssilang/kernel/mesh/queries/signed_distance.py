"""Signed distances of points to a line of segments (2D) or a surface of triangles (3D)."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.mesh import Mesh


def facets(mesh: Mesh, dimension: int) -> IntArray:
    """Segments (n, 2) of SEG2, SEG3 (two), or triangles (n, 3) of TRI3, QUA4 (two); no others."""
    parts: list[IntArray] = []
    for block in mesh.blocks:
        c = block.connectivity
        if (dimension, block.cell_type) in ((2, "SEG2"), (3, "TRI3")):
            parts.append(c)
        elif dimension == 2 and block.cell_type == "SEG3":
            parts.append(np.stack([c[:, :2], c[:, 1:]], axis=1).reshape(-1, 2))
        elif dimension == 3 and block.cell_type == "QUA4":
            parts.append(np.concatenate([c[:, [0, 1, 2]], c[:, [0, 2, 3]]]))
        else:
            raise MeshError(
                "kernel.mesh.distances-taken-not", plane=dimension == 2, cell_type=block.cell_type
            )
    if not parts:
        raise MeshError("kernel.mesh.mesh-distances-taken-empty")
    return np.concatenate(parts)


def nearest_on_segments(p: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """Nearest points (n, m, d) of m segments to n points."""
    along = b - a
    size = np.maximum((along**2).sum(axis=1), 1e-300)
    s = np.einsum("nmd,md->nm", p[:, None] - a[None], along) / size
    return np.asarray(a + np.clip(s, 0.0, 1.0)[..., None] * along)


def before_triangles(points: FloatArray, xyz: FloatArray, triangles: IntArray) -> FloatArray:
    """Distance (n,) of points (n, 3) to triangles (m, 3), positive on the side of the normals.

    At an edge or a corner the mean normal of the triangles there, by their angles, says the side.
    """
    from vtkmodules.util import numpy_support
    from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

    of: Any = numpy_support  # has no types
    used, places = np.unique(triangles, return_inverse=True)
    corners, table, surface = vtkPoints(), vtkCellArray(), vtkPolyData()
    corners.SetData(of.numpy_to_vtk(xyz[used]))
    table.SetData(3, of.numpy_to_vtkIdTypeArray(places.ravel()))
    surface.SetPoints(corners)
    surface.SetPolys(table)
    distance, found = vtkImplicitPolyDataDistance(), vtkDoubleArray()
    distance.SetInput(surface)
    distance.FunctionValue(of.numpy_to_vtk(np.ascontiguousarray(points)), found)
    return np.array(of.vtk_to_numpy(found))


def signed_distance(points: FloatArray, mesh: Mesh, dimension: int) -> FloatArray:
    """Distance (n,) of points (n, 2 or 3), positive on the side of the cells' normals.

    The normal of a segment is its direction turned by a right angle to the left; that of a
    triangle goes by its sense. Where two segments are equally near (at a corner), the one whose
    normal is most along the way to the point says the sign.
    """
    cells = facets(mesh, dimension)
    if dimension == 3:
        return before_triangles(points, mesh.nodes.coordinates, cells)
    corners, p = mesh.nodes.coordinates[cells][..., :2], points[:, :2]
    d = corners[:, 1] - corners[:, 0]
    normals = np.column_stack([-d[:, 1], d[:, 0]])
    normals = normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    way = p[:, None] - nearest_on_segments(p, corners[:, 0], corners[:, 1])
    gap = np.linalg.norm(way, axis=2)
    least = gap.min(axis=1)
    side = np.einsum("nmd,md->nm", way, normals)
    equal = gap <= least[:, None] * (1.0 + 1e-9) + 1e-300
    chosen = np.argmax(np.where(equal, np.abs(side), -1.0), axis=1)
    sign = np.where(side[np.arange(len(side)), chosen] < 0.0, -1.0, 1.0)
    return np.asarray(sign * least)


def beyond_tip(points: FloatArray, mesh: Mesh, tips: tuple[int, ...]) -> FloatArray:
    """Signed distance (n,) to the line across a 2D line of segments at its end, positive beyond it.

    Of two ends the one nearer to each point counts.

    Raises
    ------
    MeshError
        If a point given is no end of the line.
    """
    cells = facets(mesh, 2)
    xy = mesh.nodes.coordinates[:, :2]
    found, gaps = [], []
    for tip in tips:
        touching = cells[(cells == tip).any(axis=1)]
        if len(touching) != 1:
            raise MeshError("kernel.mesh.point-end-segments-line", n_touching=len(touching))
        other = int(touching[0][touching[0] != tip][0])
        out = xy[tip] - xy[other]
        found.append((points[:, :2] - xy[tip]) @ (out / np.linalg.norm(out)))
        gaps.append(np.linalg.norm(points[:, :2] - xy[tip], axis=1))
    nearer: NDArray[np.int64] = np.argmin(gaps, axis=0)
    return np.asarray(np.array(found)[nearer, np.arange(len(points))])


def beyond_front(points: FloatArray, mesh: Mesh, front: Mesh) -> tuple[FloatArray, FloatArray]:
    """Distances (n,) ahead of a surface's front and along it.

    Ahead: signed distance to the plane across the surface through the nearest segment of the
    front, positive beyond the front. Along: abscissa of the nearest point of the front.
    """
    cells = facets(mesh, 3)
    xyz = mesh.nodes.coordinates
    edges = facets(front, 2)
    a, b = xyz[edges[:, 0]], xyz[edges[:, 1]]
    out = np.array([_outward(xyz, cells, edge) for edge in edges])
    length = np.linalg.norm(b - a, axis=1)
    start = np.concatenate([[0.0], np.cumsum(length)[:-1]])
    nearest = nearest_on_segments(points, a, b)
    gap = np.linalg.norm(points[:, None] - nearest, axis=2)
    chosen = gap.argmin(axis=1)
    rows = np.arange(len(points))
    ahead = np.einsum("nd,nd->n", points - a[chosen], out[chosen])
    along = start[chosen] + np.linalg.norm(nearest[rows, chosen] - a[chosen], axis=1)
    return ahead, along


def _outward(xyz: FloatArray, cells: IntArray, edge: IntArray) -> FloatArray:
    """Unit vector in a surface, across one of its edges, away from it."""
    owner = cells[np.isin(cells, edge).sum(axis=1) == 2]
    if not len(owner):
        raise MeshError("kernel.mesh.front-not-made-sides")
    third = int(owner[0][~np.isin(owner[0], edge)][0])
    along = xyz[edge[1]] - xyz[edge[0]]
    inward = xyz[third] - xyz[edge[0]]
    inward = inward - along * (inward @ along) / (along @ along)
    return np.asarray(-inward / np.linalg.norm(inward))
