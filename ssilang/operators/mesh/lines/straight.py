"""Lines: DROI LIGN QUEL, and INTE where two simple surfaces cross."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ssilang.kernel.mesh.lines.crossing_curve import crossing_curve
from ssilang.kernel.mesh.lines.curves import Arc, arc_about_axis
from ssilang.kernel.mesh.lines.lines import CurveMap, chain_mesh, polyline
from ssilang.kernel.mesh.surfaces.analytic import (
    Shape,
    cone_shape,
    cylinder_shape,
    plane_shape,
    sphere_shape,
    torus_shape,
)
from ssilang.operators.dispatch import INTE
from ssilang.operators.mesh.lines.ends import (
    ANGLE,
    COUNT,
    END,
    SIZES,
    START,
    Ends,
    Sizes,
    chosen_family,
    count_and_angle,
    cuts_of,
    drawn,
    drawn_from,
    ends_of,
    positions,
)
from ssilang.operators.prelude import *


@operator("DROI", family="mesh", full_name="DROIT", aliases=("D",))
def droi(
    call: Call,
    count: int | None = COUNT,
    start: Point | Mesh = START,
    end: Point | Mesh | None = END,
    sizes: Sizes = SIZES,
) -> Mesh:
    """Draw a straight line."""
    cuts = cuts_of(call, count, sizes)
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
    cuts = cuts_of(call, count, sizes)
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

    return drawn_from(call, start, way, cuts_of(call, count, sizes), vector.density)


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
        return polyline(ws.nodes, _given_nodes(call, points), quadratic, ws.colour)
    if points:
        raise call.error("operators.mesh.points-and-lists", points[0])
    if len({len(v) for v in lists}) > 1:
        raise call.error("operators.mesh.coordinate-lists-differ", lists[1])
    table = np.column_stack([v.values for v in lists[: max(ws.dimension, 1)]])
    return chain_mesh(ws.nodes, ws.nodes.add(table, ws.density), quadratic, ws.colour)


def _given_nodes(call: Call, points: Sequence[Point | Mesh]) -> IntArray:
    if not points:
        raise call.missing(("POINT", "MAILLAGE", "LISTREEL"))
    parts = [
        p
        for item in points
        for p in (
            [np.array([item.node])]
            if isinstance(item, Point)
            else [b.connectivity.ravel() for b in item.blocks]
        )
    ]
    return np.concatenate(parts).astype(np.int64)


_CENTRE = arg("centre", "POINT", en="centre")
_AXIS = arg("axis", "POINT", en="point of the axis")
_SMALL_CIRCLE = arg("circle", "POINT", en="centre of a small circle")

# word -> surface through the start of the curve (a plane through both its ends)
_SURFACES: Mapping[str, Callable[[Sequence[FloatArray], FloatArray, FloatArray], Shape]] = {
    "PLAN": lambda p, start, end: plane_shape(start, end, p[0]),
    "SPHE": lambda p, start, end: sphere_shape(p[0], start),
    "CYLI": lambda p, start, end: cylinder_shape(p[0], p[1], start),
    "CONI": lambda p, start, end: cone_shape(p[0], p[1], start),
    "TORI": lambda p, start, end: torus_shape(p[0], p[1], p[2], start),
}


@INTE.form(
    select(
        "surfaces",
        {
            "PLAN": [arg("point", "POINT", en="point of the plane")],
            "SPHE": [_CENTRE],
            "CYLI": [arg("first", "POINT", en=_AXIS.en), _AXIS],
            "CONI": [arg("apex", "POINT", en="apex"), _AXIS],
            "TORI": [
                _CENTRE,
                _AXIS,
                _SMALL_CIRCLE,
            ],
        },
        optional=False,
        repeated=True,
        en="the two surfaces that cross, both through the start",
    )
)
def crossing(
    call: Call,
    surfaces: Sequence[Chosen],
    start: Point | Mesh = Main("POINT", "MAILLAGE", en=START.en),
    count: int | None = COUNT,
    sizes: Sizes = SIZES,
    length: float | None = Key(
        "LONG",
        arg("length", "FLOTTANT", unit="m", range=POSITIVE),
        en="length of the curve, then the end only shows the way",
    ),
    end: Point | Mesh | None = END,
) -> Mesh:
    """The line along which two surfaces cross, from a point or a line to another."""
    cuts = cuts_of(call, count, sizes)
    if len(surfaces) != 2:
        raise call.error("operators.mesh.two-surfaces-wanted", n_surfaces=len(surfaces))
    ends = ends_of(call, start, end)
    ws = workspace(call.session)
    first, last = positions(ws, ends.start, ends.end)
    gaps = [
        _SURFACES[s.word]([p.coordinates.copy() for p in s.values.values()], first, last).distance
        for s in surfaces
    ]
    curve = crossing_curve((gaps[0], gaps[1]), first, last, length)
    if length is not None:
        ends = Ends(ends.start, int(ws.nodes.add(curve.points[-1:], cuts.last)[0]), ends.before)
    return drawn(call, ends, curve, curve.length, cuts)
