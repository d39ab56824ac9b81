"""Lines: DROI LIGN QUEL."""

import math

from ssilang.kernel.mesh.lines.curves import Arc, arc_about_axis
from ssilang.kernel.mesh.lines.lines import CurveMap, chain_mesh
from ssilang.operators.mesh.lines.ends import *
from ssilang.operators.prelude import *


@operator("DROI", family="mesh", full_name="DROIT")
def droi(
    call: Call,
    count: int | None = COUNT,
    start: Point | Mesh = START,
    end: Point | Mesh | None = END,
    sizes: Sizes = SIZES,
) -> Mesh:
    """Draw a straight line."""
    cuts = cuts_of(count, sizes)
    ends = ends_of(call, start, end)
    a, b = positions(workspace(call.session), ends.start, ends.end)
    return drawn(call, ends, lambda s: a + s[:, None] * (b - a), float(np.linalg.norm(b - a)), cuts)


@operator("LIGN", said("ROTA"), family="mesh", full_name="LIGNE")
def lign(
    call: Call,
    count: int | None = COUNT,
    angle: float | None = ANGLE,
    centre: Point | Mesh = Arg("POINT", "MAILLAGE", en="centre, a point"),
    start: Point | Mesh = START,
    normal: Point | None = Opt("POINT", en="normal to the plane of the arc, in space"),
    sizes: Sizes = SIZES,
) -> Mesh:
    """Draw an arc from a point."""
    if isinstance(centre, Mesh):
        raise call.error("operators.mesh.mesh-as-centre", centre)
    count, degrees = count_and_angle(call, count, angle)
    cuts = cuts_of(count, sizes)
    axis = np.array([0.0, 0.0, 1.0])
    if workspace(call.session).dimension == 3:
        if normal is None:
            raise call.missing(("POINT",))
        axis = normal.coordinates.copy()
    origin = centre.coordinates.copy()

    def way(at: FloatArray) -> tuple[Arc, float]:
        arc = arc_about_axis(at, origin, axis, math.radians(degrees))
        return arc, arc.length

    return drawn_from(call, start, way, cuts)


@lign.form(said("TRAN"))
def segment(
    call: Call,
    count: int | None = COUNT,
    start: Point | Mesh = START,
    vector: Point = Arg("POINT", en="vector to the end", usual=NOT_ZERO),
    sizes: Sizes = SIZES,
    angle: float | None = Opt("FLOTTANT", en="of 'ROTA' alone, refused", range=ANY_NUMBER),
) -> Mesh:
    """Draw a segment from a point along a vector."""
    if angle is not None:
        raise call.error("operators.mesh.no-angle-of-segment", angle)
    step = vector.coordinates.copy()

    def way(at: FloatArray) -> tuple[CurveMap, float]:
        return lambda s: at + s[:, None] * step, float(np.linalg.norm(step))

    return drawn_from(call, start, way, cuts_of(count, sizes), vector.density)


@operator("QUEL", family="mesh", full_name="QUELCONQUE")
def quel(
    call: Call,
    cell_type: str | None = Choice(
        ("SEG2", "SEG3"), en="type of the cells, that of OPTI ELEM by default"
    ),
    lists: Sequence[ListReel] = Many(
        "LISTREEL", en="first coordinates, second ones ...", unit="m", range=ANY_NUMBER
    ),
    points: Sequence[Point | Mesh] = Many(
        "POINT", "MAILLAGE", en="points, or meshes whose points follow one another"
    ),
) -> Mesh:
    """Draw a broken line."""
    ws = workspace(call.session)
    quadratic = cell_type == "SEG3" if cell_type else chosen_family(ws).quadratic
    if not lists:
        return chain_mesh(ws.nodes, _given_nodes(call, points), quadratic, ws.colour)
    if points:
        raise call.error("operators.mesh.points-and-lists", points[0])
    if len({len(v) for v in lists}) > 1:
        raise call.error("operators.mesh.coordinate-lists-differ", lists[1])
    table = np.column_stack([v.values for v in lists[: max(ws.dimension, 1)]])
    return chain_mesh(ws.nodes, ws.nodes.add(table, ws.density), quadratic, ws.colour)


def _given_nodes(call: Call, points: Sequence[Point | Mesh]) -> IntArray:
    if not points:
        raise call.missing(("POINT", "MAILLAGE", "LISTREEL"))
    meshes = (item.mesh if isinstance(item, Point) else item for item in points)
    return np.concatenate([b.connectivity.ravel() for mesh in meshes for b in mesh.blocks])
