"""Triangles inside lines and between points: TRIA RAFT."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.surfaces.charts import plane_chart
from ssilang.kernel.mesh.surfaces.constrained import is_closed, triangulated_with_lines
from ssilang.kernel.mesh.surfaces.refine import delaunay_mesh, refined_triangles
from ssilang.kernel.mesh.surfaces.surface import contour_cells, contour_chart_data
from ssilang.kernel.mesh.surfaces.triangulate import triangulate_inside
from ssilang.language.registry import Help, arg, flag, operator, opt
from ssilang.language.run.session import Session
from ssilang.language.vocabulary.terms import ANY_NUMBER
from ssilang.operators.workspace import workspace


@operator(
    "TRIA",
    arg("mesh", "MAILLAGE", en="closed lines, or points"),
    flag("convex", "CONV", en="of points: their convex hull, as always"),
    opt("limit", "ENTIER", en="accepted, without effect", range=ANY_NUMBER),
    family="mesh",
    full_name="TRIANGULATION",
    help=Help(
        en="Triangles inside closed plane lines of SEG2, in any sense, without new points (RAFT "
        "refines them); lines that end inside, lie free there or cut the domain in parts are "
        "kept as sides of triangles. Or the Delaunay triangulation of a mesh of "
        "points: TRI3 in 2D, TET4 in 3D.",
        syntax="SURF1 = TRIA LIG1 (N1) ; MAIL2 = TRIA MAIL1 ('CONV') ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; L = P D 3 (1. 0.) D 3 (0. 1.) D 3 P ;"
            " LIST (MESU (TRIA L)) ;",
        ),
    ),
)
def tria(session: Session, mesh: Mesh, convex: bool, limit: int | None) -> Mesh:
    """Triangulate a contour or points."""
    ws = workspace(session)
    if mesh.dimension == 0:
        return delaunay_mesh(mesh, ws.dimension, ws.colour)
    if not is_closed(mesh):
        return triangulated_with_lines(mesh, ws.dimension, ws.colour)
    boundary, segments = contour_chart_data(mesh)
    flat = plane_chart(boundary, segments)
    cells = contour_cells(mesh)
    ids, local = np.unique(cells, return_inverse=True)
    points = flat.flatten(mesh.nodes.coordinates[ids].copy())
    table = triangulate_inside(points, local.reshape(cells.shape).astype(np.int64))
    return Mesh.of(mesh.nodes, "TRI3", ids[table], ws.colour)


@operator(
    "RAFT",
    arg("mesh", "MAILLAGE", en="plane triangles"),
    opt(
        "sizes",
        "CHPOINT",
        en="mesh sizes wanted; without it the densities of the nodes",
        unit="m",
    ),
    opt("limit", "ENTIER", en="accepted, without effect", range=ANY_NUMBER),
    family="mesh",
    help=Help(
        en="Refines a plane mesh of TRI3 to the sizes of a nodal field (or the densities of its "
        "nodes) by new points inside; the contour is kept.",
        syntax="SURF2 = RAFT (CHPO1) SURF1 (N1) ;",
        examples=(
            "OPTI DIME 2 ELEM TRI3 ; P = 0. 0. ; L = P D 8 (1. 0.) D 8 (0. 1.) D 8 P ;"
            " S = TRIA L ; T = RAFT S (MANU 'CHPO' S 1 'SCAL' 0.15) ; LIST (MESU T) ;",
        ),
    ),
)
def raft(session: Session, mesh: Mesh, sizes: NodeField | None, limit: int | None) -> Mesh:
    """Refine triangles."""
    ids = mesh.node_ids
    if sizes is None:
        wanted = mesh.nodes.density[ids].copy()
    else:
        wanted = sizes.values_at(next(iter(sizes.components)), ids, np.nan)
    if not (wanted > 0).all():
        raise MeshError("operators.mesh.sizes-not-positive")
    return refined_triangles(mesh, ids, wanted, workspace(session).colour)
