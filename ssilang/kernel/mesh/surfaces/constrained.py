"""Triangles refined, or inside plane lines of which some end inside or cut the domain in parts."""

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.base.scientific import csgraph, spatial
from ssilang.kernel.mesh.boundary import contour
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.surfaces.charts import plane_chart
from ssilang.kernel.mesh.surfaces.fill import SizeField, fill_contour, mean_sizes
from ssilang.kernel.mesh.surfaces.surface import contour_cells, contour_chart_data
from ssilang.kernel.mesh.surfaces.triangulate import delaunay_triangles, recover_segments


def is_closed(lines: Mesh) -> bool:
    """True if as many lines end at each node as a set of closed contours has: two."""
    cells = np.concatenate([b.connectivity[:, [0, -1]] for b in lines.blocks])
    _, times = np.unique(cells, return_counts=True)
    return bool((times == 2).all())


def triangulated_with_lines(lines: Mesh, dimension: int, colour: int = 0) -> Mesh:
    """TRI3 inside lines of SEG2, each of which is a side of triangles.

    Parameters
    ----------
    lines : Mesh
        Closed contours, with lines that hang from them, lie free inside or join two of their
        nodes. A contour inside another bounds a hole.
    dimension : int
        2: in the plane of the first two coordinates; 3: in the plane of the nodes.

    Raises
    ------
    MeshError
        If nothing is enclosed, the nodes are not in one plane or lines cross.
    """
    if any(b.cell_type != "SEG2" for b in lines.blocks):
        raise MeshError("kernel.mesh.lines-seg2-needed-triangulate")
    cells = np.concatenate([b.connectivity for b in lines.blocks])
    ids, local = np.unique(cells, return_inverse=True)
    segments = local.reshape(cells.shape).astype(np.int64)
    points = _flat(lines.nodes.coordinates[ids], dimension)
    triangles = recover_segments(points, delaunay_triangles(points), segments)
    inside = _enclosed(triangles, segments, len(ids))
    if not inside.any():
        raise MeshError("kernel.mesh.lines-enclose-nothing")
    return Mesh.of(lines.nodes, "TRI3", ids[triangles[inside]], colour)


def _flat(at: FloatArray, dimension: int) -> FloatArray:
    if dimension == 2:
        return at[:, :2].copy()
    centred = at - at.mean(axis=0)
    _, _, axes = np.linalg.svd(centred, full_matrices=False)
    extent = float(np.ptp(at, axis=0).max())
    off = float(np.abs(centred @ axes[2]).max())
    if off > 1e-3 * extent:
        raise MeshError("kernel.mesh.lines-not-plane-point", off=off)
    return np.asarray(centred @ axes[:2].T)


def _enclosed(triangles: IntArray, segments: IntArray, n: int) -> NDArray[np.bool_]:
    """Triangles in parts that an odd number of lines, the fewest, divides from the outside."""
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2) @ [n, 1]
    walls = np.sort(segments, axis=1) @ [n, 1]
    owner = np.repeat(np.arange(len(triangles)), 3)
    order = np.argsort(sides.ravel(), kind="stable")
    keys, owner = sides.ravel()[order], owner[order]
    pair = np.flatnonzero(keys[:-1] == keys[1:])
    first, second, key = owner[pair], owner[pair + 1], keys[pair]
    open_side = ~np.isin(key, walls)
    part = parts_of(len(triangles), (first[open_side], second[open_side]))
    n_parts = int(part.max()) + 1
    alone = np.ones(len(keys), dtype=bool)
    alone[pair] = alone[pair + 1] = False
    rim = part[owner[alone]]
    walled = np.isin(keys[alone], walls)
    # graph of parts across walls; number n_parts is the outside
    a = np.concatenate([part[first[~open_side]], rim])
    b = np.concatenate([part[second[~open_side]], np.full(len(rim), n_parts)])
    cost = np.concatenate([np.ones((~open_side).sum()), np.where(walled, 1.0, 1e-6)])
    kept = a != b
    graph = np.full((n_parts + 1, n_parts + 1), np.inf)
    np.minimum.at(graph, (a[kept], b[kept]), cost[kept])
    steps = csgraph.shortest_path(graph, directed=False, indices=n_parts)
    return np.asarray(np.round(steps[part]) % 2 == 1)


def refined_triangles(
    mesh: Mesh, ids: IntArray, sizes: FloatArray, colour: int = 0, limit: int | None = None
) -> Mesh:
    """A plane mesh of TRI3 with points added inside until its triangles have the wanted sizes.

    Parameters
    ----------
    ids, sizes : array (n,)
        Nodes of the mesh, which are all kept, and the sizes wanted there; where none is (0),
        the border's sides say it.
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
    own = mean_sizes(flat, number[edge])[number[ids]]
    sizes = np.where(sizes > 0.0, sizes, own)
    known = sizes > 0.0  # within the border those without a size follow the others
    at, sizes = at[known], sizes[known]
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
    ids = mesh.node_ids
    if not len(ids):
        raise MeshError("kernel.mesh.mesh-empty-nothing-triangulate")
    at = mesh.nodes.coordinates[ids, :dimension]
    try:
        cells = spatial.Delaunay(at).simplices.astype(np.int64)
    except spatial.QhullError as error:
        raise MeshError("kernel.mesh.points-too-few-line") from error
    arms = at[cells[:, 1:]] - at[cells[:, :1]]
    negative = np.linalg.det(arms) < 0
    cells[negative, :2] = cells[negative, 1::-1]
    return Mesh.of(mesh.nodes, "TRI3" if dimension == 2 else "TET4", ids[cells], colour)
