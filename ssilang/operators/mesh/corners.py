"""Rounded corners (CONG), triangulations (TRIA, RAFT), points inside (DEDA)."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.boundary import contour
from ssilang.kernel.mesh.lines.fillet import fillet
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.queries.select import inside_contour
from ssilang.kernel.mesh.surfaces.charts import plane_chart
from ssilang.kernel.mesh.surfaces.constrained import is_closed, triangulated_with_lines
from ssilang.kernel.mesh.surfaces.refine import delaunay_mesh, refined_triangles
from ssilang.kernel.mesh.surfaces.surface import contour_cells, contour_chart_data
from ssilang.kernel.mesh.surfaces.triangulate import triangulate_inside
from ssilang.kernel.mesh.volumes.tetrahedralize import ray_inside
from ssilang.language.registry import Help, arg, flag, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.run.session import Session
from ssilang.operators.workspace import workspace


@operator(
    "CONG",
    family="mesh",
    full_name="CONGE",
    help=Help(
        en="Rounds the corner between two lines, the second following the first, by an arc of a "
        "given radius. Gives the first line cut short, the arc and the second line cut short.",
        fr="Arrondit le coin entre deux lignes qui se suivent par un arc de rayon donné. Rend la "
        "première ligne raccourcie, le congé et la seconde raccourcie.",
        syntax="GEO1 GEO3 GEO2 = LIG1 CONG (N1) FLOT1 LIG2 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; P = 1. 0. ; L = DROI 5 (0. 0.) P ; M = DROI 5 P (1. 1.) ;"
            " A B C0 = L CONG 4 0.3 M ; LIST (MESU B) ;",
        ),
    ),
    reads_itself=True,
)
def cong(call: Call) -> tuple[Mesh, Mesh, Mesh]:
    """Round a corner."""
    first = call.required("MAILLAGE")
    count = call.optional("ENTIER", default=0)
    radius = call.read("FLOTTANT")
    if radius is None:
        radius_value, count = float(count), 0
    else:
        radius_value = float(radius.value)
    second = call.required("MAILLAGE")
    if radius_value <= 0.0:
        raise call.bad(f"the radius is positive, this one is {radius_value:g}")
    if call.keyword(("DOUBLE",)) is not None:
        raise call.bad("CONG 'DOUBLE' is not available", hint="draw the two arcs with CERC")
    return fillet(first, second, radius_value, abs(count), workspace(call.session).colour)


@operator(
    "TRIA",
    arg("mesh", "MAILLAGE"),
    flag("convex", "CONV"),
    opt("limit", "ENTIER"),
    family="mesh",
    full_name="TRIANGULATION",
    help=Help(
        en="Triangles inside closed plane lines of SEG2, in any sense, without new points (RAFT "
        "refines them); lines that end inside, lie free there or cut the domain in parts are "
        "kept as sides of triangles. Or the Delaunay triangulation of a mesh of "
        "points: TRI3 in 2D, TET4 in 3D.",
        fr="Triangles intérieurs à des lignes planes fermées de SEG2, de sens quelconque, sans "
        "nouveau point (RAFT les raffine) ; les lignes qui finissent à l'intérieur, y sont libres "
        "ou coupent le domaine restent des côtés de triangles. Ou triangulation de "
        "Delaunay d'un maillage de points : TRI3 en 2D, TET4 en 3D.",
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
    arg("mesh", "MAILLAGE"),
    opt("sizes", "CHPOINT"),
    opt("limit", "ENTIER"),
    family="mesh",
    help=Help(
        en="Refines a plane mesh of TRI3 to the sizes of a nodal field (or the densities of its "
        "nodes) by new points inside; the contour is kept.",
        fr="Raffine un maillage plan de TRI3 selon les tailles d'un champ par points (ou les "
        "densités de ses noeuds) par de nouveaux points intérieurs ; le contour est gardé.",
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
        raise MeshError(
            "a size is missing or not positive at some nodes",
            "give a field of sizes on all nodes of the mesh",
        )
    return refined_triangles(mesh, ids, wanted, workspace(session).colour)


@operator(
    "DEDA",
    arg("point", "POINT"),
    arg("mesh", "MAILLAGE"),
    opt("tolerance", "FLOTTANT"),
    family="mesh",
    help=Help(
        en="Whether a point lies inside a closed line of SEG2 (2D) or a closed surface of TRI3 "
        "(3D); of a surface in 2D the contour is taken.",
        fr="Dit si un point est à l'intérieur d'une ligne fermée de SEG2 (2D) ou d'une surface "
        "fermée de TRI3 (3D) ; d'une surface en 2D on prend le contour.",
        syntax="LOG1 = DEDA P1 MAIL1 (FLOT1) ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (1. 0.)) TRAN 2 (0. 1.) ;"
            " SI (DEDA (2. 0.5) (CONT S)) ; ERRE 5 ; FINSI ;",
        ),
    ),
)
def deda(session: Session, point: Point, mesh: Mesh, tolerance: float | None) -> bool:
    """Whether a point is inside."""
    at = point.coordinates[None].copy()
    if workspace(session).dimension < 3:
        border = contour(mesh) if mesh.dimension == 2 else mesh
        return bool(inside_contour(at, border, strict=False)[0])
    corners = [b.connectivity[:, list(b.kind.corners)] for b in mesh.blocks]
    if not corners or any(t.shape[1] != 3 for t in corners):
        raise MeshError("a closed surface of triangles is needed", "change it: CHAN 'TRI3'")
    return bool(ray_inside(at, mesh.nodes.coordinates, np.concatenate(corners))[0])
