"""INTE between points: the curve along which two simple surfaces cross."""

from __future__ import annotations

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.mesh.lines.crossing_curve import crossing_curve
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.surfaces.analytic import (
    Shape,
    cone_shape,
    cylinder_shape,
    plane_shape,
    sphere_shape,
    torus_shape,
)
from ssilang.language.run.call import Call
from ssilang.operators.mesh.ends import (
    Cuts,
    Ends,
    drawn,
    ends_of,
    positions,
    read_count,
    read_sizes,
)
from ssilang.operators.workspace import workspace

SURFACES = {"PLAN": 1, "SPHE": 1, "CYLI": 2, "CONI": 2, "TORI": 3}
"""Words of surfaces and the number of points that stand behind them."""


def draws_a_curve(call: Call) -> bool:
    """True if a word of a surface stands in the call."""
    words = (o.value for o in call.operands if isinstance(o.value, str))
    return any(w[:4].upper() in SURFACES for w in words)


def drawn_crossing(call: Call, first: Point | Mesh) -> Mesh:
    """The line along which two surfaces cross, from a point or a line to another."""
    cuts, length = Cuts(), None
    items: list[Point | Mesh] = [first]
    named: list[tuple[str, list[FloatArray]]] = []
    before = -1
    while before != len(call.operands):
        before = len(call.operands)
        read_sizes(call, cuts)
        if call.keyword(("LONG",)) is not None:
            length = float(call.required("FLOTTANT", after=call.keyword_end))
            if length <= 0.0:
                raise call.bad(f"the length of the curve is positive, not {length:g}", length)
        if not cuts.count:
            read_count(call, cuts)
        word = call.keyword(tuple(SURFACES))
        if word is not None:
            points = [call.required("POINT", after=call.keyword_end) for _ in range(SURFACES[word])]
            named.append((word, [p.coordinates.copy() for p in points]))
        elif len(named) >= 2 and len(items) == 1:
            last = call.read("POINT", "MAILLAGE")
            items += [last.value] if last is not None else []
    if len(named) != 2:
        raise call.bad(
            f"a curve is the crossing of two surfaces, {len(named)} stand here",
            hint="'PLAN' P1, 'SPHE' C1, 'CYLI' A1 A2, 'CONI' S1 A1 or 'TORI' C1 A1 C2, twice",
        )
    ends = ends_of(call, items)
    ws = workspace(call.session)
    start, end = positions(ws, ends.start, ends.end)
    gaps = [_surface(word, points, start, end).distance for word, points in named]
    curve = crossing_curve((gaps[0], gaps[1]), start, end, length)
    if length is not None:
        ends = Ends(ends.start, int(ws.nodes.add(curve.points[-1:], cuts.last)[0]), ends.before)
    return drawn(call, ends, curve, curve.length, cuts)


def _surface(word: str, points: list[FloatArray], start: FloatArray, end: FloatArray) -> Shape:
    """A surface through the start of the curve (a plane through both its ends)."""
    if word == "PLAN":
        return plane_shape(start, end, points[0])
    if word == "SPHE":
        return sphere_shape(points[0], start)
    if word == "CYLI":
        return cylinder_shape(points[0], points[1], start)
    if word == "CONI":
        return cone_shape(points[0], points[1], start)
    return torus_shape(points[0], points[1], points[2], start)
