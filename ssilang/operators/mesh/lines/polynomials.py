"""Polynomial curves: PARA CUBP CUBT COUR."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.mesh.lines.curves import Polynomial, cubic_tangents, cubic_through, parabola
from ssilang.kernel.mesh.lines.lines import line_ends
from ssilang.operators.mesh.lines.ends import (
    COUNT,
    END,
    SIZES,
    START,
    Ends,
    Sizes,
    cuts_of,
    drawn,
    drawn_by_middle,
    ends_of,
    positions,
)
from ssilang.operators.prelude import *


@operator(
    "PARA",
    COUNT,
    START,
    arg("middle", "POINT", en="where the tangents of both ends meet"),
    END,
    SIZES,
    family="mesh",
    full_name="PARABOLE",
)
def para(
    call: Call,
    count: int | None,
    start: Point | Mesh,
    middle: Point,
    end: Point | Mesh | None,
    sizes: Sizes,
) -> Mesh:
    """Draw an arc of parabola."""
    cuts = cuts_of(call, count, sizes)
    return drawn_by_middle(call, parabola, (start, middle, end), cuts)


@operator(
    "CUBP",
    COUNT,
    START,
    arg("first", "POINT", en="first inner point"),
    arg("second", "POINT", en="second inner point"),
    END,
    flag("uniform", "UNIF", en="nodes even in length"),
    SIZES,
    family="mesh",
)
def cubp(
    call: Call,
    count: int | None,
    start: Point | Mesh,
    first: Point,
    second: Point,
    end: Point | Mesh | None,
    sizes: Sizes,
    uniform: bool,
) -> Mesh:
    """Draw the cubic through four points."""
    ends = ends_of(call, start, end)
    inner = first.coordinates.copy(), second.coordinates.copy()
    a, b = positions(workspace(call.session), ends.start, ends.end)
    shape = cubic_through(a, *inner, b, uniform)
    return drawn(call, ends, shape, shape.length, cuts_of(call, count, sizes))


@operator(
    "CUBT",
    COUNT,
    START,
    arg("first", "POINT", en="tangent at the start"),
    arg("second", "POINT", en="tangent at the end"),
    END,
    SIZES,
    family="mesh",
)
def cubt(
    call: Call,
    count: int | None,
    start: Point | Mesh,
    first: Point,
    second: Point,
    end: Point | Mesh | None,
    sizes: Sizes,
) -> Mesh:
    """Draw the cubic between two tangents."""
    ends = ends_of(call, start, end)
    tangents = first.coordinates.copy(), second.coordinates.copy()
    a, b = positions(workspace(call.session), ends.start, ends.end)
    shape = cubic_tangents(a, *tangents, b)
    return drawn(call, ends, shape, shape.length, cuts_of(call, count, sizes))


@operator(
    "COUR",
    COUNT,
    SIZES,
    key(
        "before",
        "PINI",
        arg("point", "POINT", "MAILLAGE"),
        en="existing point at the start, or a line to go on",
    ),
    key(
        "after",
        "PFIN",
        arg("point", "POINT", "MAILLAGE"),
        en="existing point at the end, or a line to reach",
    ),
    key(
        "limits",
        "PARAMETRE",
        arg("u1", "FLOTTANT", range=ANY_NUMBER),
        arg("u2", "FLOTTANT", range=ANY_NUMBER),
        default=(0.0, 1.0),
        en="U at the start and at the end",
    ),
    flag("regular", "REGULIER", en="nodes even in length"),
    many("points", "POINT", at_least=1, en="P0 P1 P2 ..."),
    family="mesh",
    full_name="COURBE",
)
def cour(
    call: Call,
    count: int | None,
    sizes: Sizes,
    before: Point | Mesh | None,
    after: Point | Mesh | None,
    limits: tuple[float, float],
    regular: bool,
    points: Sequence[Point],
) -> Mesh:
    """Draw a polynomial curve."""
    if len(points) < 2:
        raise call.missing(("POINT",))
    cuts = cuts_of(call, count, sizes)
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
