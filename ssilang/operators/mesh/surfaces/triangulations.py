"""Triangles inside lines and between points (TRIA RAFT COUT), Voronoi's partition (VORO)."""

from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.generators.sweep import cone, stitch
from ssilang.kernel.mesh.queries.measure import enclosed_area, enclosed_volume
from ssilang.kernel.mesh.surfaces import constrained
from ssilang.kernel.mesh.surfaces.charts import plane_chart
from ssilang.kernel.mesh.surfaces.surface import contour_cells, contour_chart_data, fill_surface
from ssilang.kernel.mesh.surfaces.triangulate import triangulate_inside
from ssilang.kernel.mesh.surfaces.voronoi import OUTSIDE, VoronoiPartition, voronoi_partition
from ssilang.kernel.mesh.volumes.volume import fill_volume
from ssilang.operators.mesh.changes.remeshed import INTERPOLATED, changed
from ssilang.operators.mesh.metrics import METRIC, REPORT, report_mesh
from ssilang.operators.prelude import *


@operator("TRIA", family="mesh", full_name="TRIANGULATION")
def tria(
    session: Session,
    mesh: Mesh = Arg("MAILLAGE", en="closed lines, or points"),
    convex: bool = Flag("CONV", en="of points: their convex hull, as always"),
    limit: int | None = Opt("ENTIER", en="accepted, without effect", range=ANY_NUMBER),
) -> Mesh:
    """Triangulate a contour or points."""
    ws = workspace(session)
    if mesh.dimension == 0:
        return constrained.delaunay_mesh(mesh, ws.dimension, ws.colour)
    return _of_given_points(mesh, ws)


def _of_given_points(mesh: Mesh, ws: Workspace) -> Mesh:
    """Triangles inside lines, whose points alone are their corners."""
    if not constrained.is_closed(mesh) or any(b.cell_type == "SEG3" for b in mesh.blocks):
        return constrained.triangulated_with_lines(mesh, ws.dimension, ws.colour)
    boundary, segments = contour_chart_data(mesh)
    flat = plane_chart(boundary, segments)
    cells = contour_cells(mesh)
    ids, local = np.unique(cells, return_inverse=True)
    points = flat.flatten(mesh.nodes.coordinates[ids].copy())
    table = triangulate_inside(points, local.reshape(cells.shape).astype(np.int64))
    return Mesh.of(mesh.nodes, "TRI3", ids[table], ws.colour)


@tria.form(said("TOPO"), METRIC, REPORT, INTERPOLATED)
def tria_topo(
    call: Call,
    session: Session,
    boundary: Mesh = Arg("MAILLAGE", en="closed plane lines of SEG2, or a closed surface of TRI3"),
    points: str = Choice(("AJNO", "NOAJ"), default="AJNO", en="with new points inside, or without"),
    **said: Any,
) -> Mesh | tuple[Mesh, NodeField]:
    """Fill a boundary with simplices."""
    ws = workspace(session)
    plane = boundary.dimension == 1
    if not plane and points == "NOAJ":
        raise call.error("operators.mesh.volume-needs-points", boundary)
    if not plane:
        made = fill_volume(boundary, ws.colour)
    elif points == "NOAJ":
        made = _of_given_points(boundary, ws)
    else:
        chart = plane_chart(*contour_chart_data(boundary))
        made = fill_surface(boundary, chart, "TRI3", ws.colour)
    if said["metric"] is not None:
        return changed(call, made, boundary, points == "AJNO", said)
    wanted = enclosed_area(boundary) if plane else enclosed_volume(boundary)
    report_mesh(said["report"], made, wanted)
    return made


@operator("RAFT", family="mesh")
def raft(
    session: Session,
    mesh: Mesh = Arg("MAILLAGE", en="plane triangles"),
    sizes: NodeField | None = Opt(
        "CHPOINT", en="mesh sizes wanted; without it the densities of the nodes", unit="m"
    ),
    limit: int | None = Opt("ENTIER", en="most nodes of the result", range=POSITIVE),
) -> Mesh:
    """Refine triangles."""
    ids = mesh.node_ids
    if sizes is None:
        wanted = mesh.nodes.density[ids].copy()
    else:
        wanted = sizes.values_at(next(iter(sizes.components)), ids, np.nan)
        if not (wanted > 0).all():
            raise MeshError("operators.mesh.sizes-not-positive")
    return constrained.refined_triangles(mesh, ids, wanted, workspace(session).colour, limit)


@operator("COUT", family="mesh", full_name="COUTURE")
def cout(
    session: Session,
    first: Mesh = Arg("MAILLAGE", en="line, or cells"),
    second: Mesh | Point = Arg("MAILLAGE", "POINT", en="line in the same sense, or point"),
) -> Mesh:
    """Stitch lines together, or join cells to a point."""
    if isinstance(second, Point):
        return cone(first, second.node)
    return stitch(first, second, workspace(session).colour)


@operator("VORO", family="mesh", full_name="VORONOI")
def voro(
    call: Call,
    germs: Mesh = Arg("MAILLAGE", en="points of the cells"),
    contour: Mesh = Arg("MAILLAGE", en="closed line of SEG2"),
    weights: NodeField | None = Opt("CHPOINT", en="weights of the points", unit="m"),
) -> Table:
    """Cells, edges and neighbours."""
    ws = workspace(call.session)
    if ws.dimension != 2:
        raise call.error("operators.mesh.plane-only")
    if any(b.cell_type != "POI1" for b in germs.blocks) or not germs.n_cells:
        raise call.error("operators.mesh.germs-are-points", germs)
    if any(b.cell_type != "SEG2" for b in contour.blocks):
        raise call.error("operators.mesh.contour-of-segments", contour)
    nodes = germs.nodes
    places = np.concatenate([b.connectivity[:, 0] for b in germs.blocks])
    sides = contour_cells(contour)
    corners, local = np.unique(sides, return_inverse=True)
    sizes = np.zeros(len(places))
    if weights is not None:
        sizes = weights.values_at(next(iter(weights.components)), places, 0.0)
    x = nodes.coordinates
    found = voronoi_partition(
        x[places, :2].copy(), sizes, x[corners, :2].copy(), local.reshape(sides.shape)
    )
    fresh = nodes.add(found.points[len(corners) :], ws.density)
    edges = np.concatenate([corners, fresh])[found.edges]
    return _told(germs, places, sizes, found, edges, ws.colour)


def _told(
    germs: Mesh, places: IntArray, weights: FloatArray, found: VoronoiPartition, edges: IntArray,
    colour: int,
) -> Table:  # fmt: skip
    """The partition in the language's objects."""
    nodes, owners = germs.nodes, found.owners

    def lines(table: IntArray) -> Mesh:
        return Mesh.of(nodes, "SEG2", table, colour)

    arcs, cells = Table.numbered(lines(edge[None]) for edge in edges), Table()
    for germ, place in enumerate(places):
        # Edges with the germ's cell on their left, their numbers, and the cells beside it.
        left, right = owners[:, 0] == germ, owners[:, 1] == germ
        rows = np.flatnonzero(left | right)
        around = np.where(left[rows, None], edges[rows], edges[rows][:, ::-1])
        beside = np.where(left[rows], owners[rows, 1], owners[rows, 0])
        near = poi1(nodes, places[np.unique(beside[beside != OUTSIDE])], colour)
        cell = {"VISU": lines(around), "ARTS": ListEnti(rows + 1), "VOIS": near}
        cells.set(Point(nodes, int(place)), Table.of(cell))
    order = np.argsort(places)
    values = NodeValues(places[order], weights[order])
    field = NodeField(nodes, {"SCAL": values}, "DIFFUS")
    return Table.of({"VISU": lines(edges), "POND": field, "CELL": cells, "ARTS": arcs})
