"""Arcs of circle: CERC CER3 PARC, and CONG for rounded corners."""

import math

from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.lines import curves
from ssilang.kernel.mesh.lines.lines import chain_mesh, different_nodes, end_sizes
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.operators.mesh.lines.ends import *
from ssilang.operators.prelude import *


@operator("CERC", family="mesh", full_name="CERCLE")
def cerc(
    call: Call,
    through: str = Choice(
        ("CENTR", "PASS"),
        default="CENTR",
        en="the second point is the centre, the default, or lies on the arc",
    ),
    count: int | None = COUNT,
    start: Point | Mesh = START,
    middle: Point = Arg("POINT", en="centre, or point of the arc"),
    end: Point | Mesh | None = END,
    sizes: Sizes = SIZES,
) -> Mesh:
    """Draw a circular arc about a centre or through three points."""
    curve = curves.arc_through if through == "PASS" else partial(_about_centre, call)
    at, cuts = middle.coordinates.copy(), cuts_of(count, sizes)
    return drawn_between(call, start, end, lambda a, b: curve(a, at, b), cuts)


def _about_centre(
    call: Call, first: FloatArray, centre: FloatArray, last: FloatArray
) -> curves.Arc:
    """The arc between two points, about the mediator's nearest point to a centre that is off."""
    r1, r2 = (float(np.linalg.norm(p - centre)) for p in (first, last))
    arc = curves.arc_about_centre(first, centre, last)
    if not 0.99 < r1 / r2 < 1.01:
        call.warn("operators.mesh.arc-about-moved-centre", r1=r1, r2=r2, r=arc.length / arc.angle)
    return arc


@cerc.form(said("ROTA"))
def turned_point(
    call: Call,
    count: int | None = COUNT,
    angle: float | None = ANGLE,
    start: Point | Mesh = START,
    axis: Sequence[Point] = AXIS,
    closed: bool = Flag("ELIM", en="a whole turn ends on its first point"),
    sizes: Sizes = SIZES,
) -> Mesh:
    """The arc that a point describes in a rotation."""
    count, degrees = count_and_angle(call, count, angle)
    cuts = cuts_of(count, sizes)
    if closed and abs(abs(degrees) - 360.0) > 1e-6:
        raise call.error("operators.mesh.turn-not-whole", degrees=degrees)
    origin, direction = axis_of(call, axis)

    def way(at: FloatArray) -> tuple[curves.Arc, float]:
        arc = curves.arc_about_axis(at, origin, direction, math.radians(degrees))
        return arc, arc.length

    return drawn_from(call, start, way, cuts, closed=closed)


@operator("CER3", family="mesh")
def cer3(
    call: Call,
    count: int | None = COUNT,
    start: Point | Mesh = START,
    middle: Point = Arg("POINT", en="point of the arc"),
    end: Point | Mesh | None = END,
    sizes: Sizes = SIZES,
) -> Mesh:
    """Draw the arc through three points."""
    at, cuts = middle.coordinates.copy(), cuts_of(count, sizes)
    return drawn_between(call, start, end, lambda a, b: curves.arc_through(a, at, b), cuts)


@operator("PARC", family="mesh")
def parc(
    call: Call,
    count: int | None = COUNT,
    start: Point | Mesh = START,
    centre: Point = Arg("POINT", en="centre"),
    end: Point | Mesh | None = END,
    sizes: Sizes = SIZES,
) -> Mesh:
    """Draw parabolas along an arc."""
    ws = workspace(call.session)
    cuts = cuts_of(count, sizes)
    ends = ends_of(call, start, end)
    different_nodes(ws.nodes, ends.start, ends.end)
    a, b = positions(ws, ends.start, ends.end)
    arc = _about_centre(call, a, centre.coordinates.copy(), b)
    tips = cuts.sizes(end_sizes(ws.nodes, ends.start, ends.end))
    pieces = subdivide(arc.length, *tips, cuts.count)
    middles = curves.parabolic_middles(arc, pieces.fractions)
    inner = pieces.fractions[1:-1]
    corners = ws.nodes.add(arc(inner), pieces.density(inner)) if len(inner) else inner.astype(int)
    chain = np.empty(2 * pieces.count + 1, dtype=np.int64)
    chain[0], chain[-1] = ends.start, ends.end
    chain[2:-1:2] = corners
    chain[1::2] = ws.nodes.add(middles, pieces.density(pieces.middles))
    line = chain_mesh(ws.nodes, chain, True, ws.colour)
    parts = [m for m in (ends.before, line, ends.after) if m is not None]
    return union(*parts, as_given=True)


_CELLS = between(1, 1e7)


@operator("CONG", family="mesh", full_name="CONGE")
def cong(
    call: Call,
    first: Mesh = Arg("MAILLAGE", en="first line"),
    count: int | None = Opt(
        "ENTIER", en="number of elements; by the mesh sizes without it", range=_CELLS
    ),
    radius: float | None = Opt("FLOTTANT", range=POSITIVE, en="radius", unit="m"),
    second: Mesh = Arg("MAILLAGE", en="line that follows"),
    double: bool = Flag("DOUBLE", en="two arcs: not available"),
) -> tuple[Mesh, Mesh, Mesh]:
    """Round a corner; an integer alone is the radius."""
    if double:
        raise call.error("operators.mesh.no-double-fillet")
    if radius is None:
        radius, count = float(count or 0), 0
    if radius <= 0.0:
        raise call.error("operators.mesh.radius-not-positive", radius=radius)
    return curves.fillet(first, second, radius, abs(count or 0), workspace(call.session).colour)
