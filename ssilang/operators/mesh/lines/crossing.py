"""INTE: the line along which two simple surfaces cross."""

from ssilang.kernel.mesh.lines.crossing_curve import crossing_curve
from ssilang.kernel.mesh.surfaces import analytic
from ssilang.operators.dispatch import INTE
from ssilang.operators.mesh.lines.ends import *
from ssilang.operators.prelude import *

_CENTRE = arg("centre", "POINT", en="centre")
_AXIS = arg("axis", "POINT", en="point of the axis")
_SMALL_CIRCLE = arg("circle", "POINT", en="centre of a small circle")

# word -> surface through the start of the curve (a plane through both its ends)
_SURFACES: Mapping[
    str, Callable[[Sequence[FloatArray], FloatArray, FloatArray], analytic.Shape]
] = {
    "PLAN": lambda p, start, end: analytic.plane_shape(start, end, p[0]),
    "SPHE": lambda p, start, end: analytic.sphere_shape(p[0], start),
    "CYLI": lambda p, start, end: analytic.cylinder_shape(p[0], p[1], start),
    "CONI": lambda p, start, end: analytic.cone_shape(p[0], p[1], start),
    "TORI": lambda p, start, end: analytic.torus_shape(p[0], p[1], p[2], start),
}


@INTE.form()
def crossing(
    call: Call,
    surfaces: Sequence[Chosen] = Cases(
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
    ),
    start: Point | Mesh = Main("POINT", "MAILLAGE", en=START.en),
    count: int | None = COUNT,
    sizes: Sizes = SIZES,
    length: float | None = Key(
        "LONG",
        "FLOTTANT",
        unit="m",
        range=POSITIVE,
        en="length of the curve, then the end only shows the way",
    ),
    end: Point | Mesh | None = END,
) -> Mesh:
    """The line along which two surfaces cross, from a point or a line to another."""
    cuts = cuts_of(count, sizes)
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
        (end,) = ws.nodes.add(curve.points[-1:], cuts.last or 0.0)
        ends = Ends(ends.start, int(end), ends.before)
    return drawn(call, ends, curve, curve.length, cuts)
