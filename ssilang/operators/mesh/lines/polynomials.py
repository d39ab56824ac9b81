"""Polynomial curves: PARA CUBP CUBT COUR."""

from ssilang.kernel.mesh.lines.curves import Polynomial, cubic_tangents, cubic_through, parabola
from ssilang.kernel.mesh.lines.lines import line_ends
from ssilang.operators.mesh.lines.ends import *
from ssilang.operators.prelude import *


@operator("PARA", family="mesh", full_name="PARABOLE")
def para(
    call: Call,
    count: int | None = COUNT,
    start: Point | Mesh = START,
    middle: Point = Arg("POINT", en="where the tangents of both ends meet"),
    end: Point | Mesh | None = END,
    sizes: Sizes = SIZES,
) -> Mesh:
    """Draw an arc of parabola."""
    at, cuts = middle.coordinates.copy(), cuts_of(count, sizes)
    return drawn_between(call, start, end, lambda a, b: parabola(a, at, b), cuts)


@operator("CUBP", family="mesh")
def cubp(
    call: Call,
    count: int | None = COUNT,
    start: Point | Mesh = START,
    first: Point = Arg("POINT", en="first inner point"),
    second: Point = Arg("POINT", en="second inner point"),
    end: Point | Mesh | None = END,
    uniform: bool = Flag("UNIF", en="nodes even in length"),
    sizes: Sizes = SIZES,
) -> Mesh:
    """Draw the cubic through four points."""
    inner, cuts = (first.coordinates.copy(), second.coordinates.copy()), cuts_of(count, sizes)
    return drawn_between(call, start, end, lambda a, b: cubic_through(a, *inner, b, uniform), cuts)


@operator("CUBT", family="mesh")
def cubt(
    call: Call,
    count: int | None = COUNT,
    start: Point | Mesh = START,
    first: Point = Arg("POINT", en="tangent at the start"),
    second: Point = Arg("POINT", en="tangent at the end"),
    end: Point | Mesh | None = END,
    sizes: Sizes = SIZES,
) -> Mesh:
    """Draw the cubic between two tangents."""
    tangents, cuts = (first.coordinates.copy(), second.coordinates.copy()), cuts_of(count, sizes)
    return drawn_between(call, start, end, lambda a, b: cubic_tangents(a, *tangents, b), cuts)


@operator("COUR", family="mesh", full_name="COURBE")
def cour(
    call: Call,
    count: int | None = COUNT,
    sizes: Sizes = SIZES,
    before: Point | Mesh | None = Key(
        "PINI", "POINT", "MAILLAGE", en="existing point at the start, or a line to go on"
    ),
    after: Point | Mesh | None = Key(
        "PFIN", "POINT", "MAILLAGE", en="existing point at the end, or a line to reach"
    ),
    limits: tuple[float, float] = Key(
        "PARAMETRE",
        arg("u1", "FLOTTANT", range=ANY_NUMBER),
        arg("u2", "FLOTTANT", range=ANY_NUMBER),
        default=(0.0, 1.0),
        en="U at the start and at the end",
    ),
    regular: bool = Flag("REGULIER", en="nodes even in length"),
    points: Sequence[Point] = Many("POINT", at_least=1, en="P0 P1 P2 ..."),
) -> Mesh:
    """Draw a polynomial curve."""
    if len(points) < 2:
        raise call.missing(("POINT",))
    cuts = cuts_of(count, sizes)
    table = np.array([p.coordinates for p in points])
    shape = Polynomial(table, *limits, regular=regular)
    ends = _curve_ends(call, shape, before, after)
    return drawn(call, ends, shape, shape.length, cuts)


def _curve_ends(
    call: Call, shape: Polynomial, before: Point | Mesh | None, after: Point | Mesh | None
) -> Ends:
    """Existing or new end nodes of a curve."""
    ws = workspace(call.session)
    tips = shape(np.array([0.0, 1.0]))
    scale = max(shape.length, 1e-300)
    nodes = []
    for word, there, side, tip in (("PINI", before, 1, tips[0]), ("PFIN", after, 0, tips[1])):
        if there is None:
            nodes.append(int(ws.nodes.add(tip[None], ws.density)[0]))
            continue
        node = there.node if isinstance(there, Point) else line_ends(there)[side]
        if float(np.linalg.norm(ws.nodes.coordinates[node] - tip)) > 1e-4 * scale:
            raise call.error("operators.mesh.point-off-curve", there, word=word)
        nodes.append(node)
    lines = (m if isinstance(m, Mesh) else None for m in (before, after))
    return Ends(nodes[0], nodes[1], *lines)
