"""Lines: DROI, CERC, CER3, PARA, CUBP, CUBT, COUR, QUEL."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.lines.curves import (
    Arc,
    Polynomial,
    arc_about_axis,
    arc_about_centre,
    arc_through,
    parabola,
)
from ssilang.kernel.mesh.lines.lines import chain_mesh, end_sizes, line_ends, mesh_curve, polyline
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.mesh.ends import (
    SIZES_EN,
    SIZES_FR,
    Cuts,
    Ends,
    chosen_family,
    count_and_number,
    cuts_and_items,
    drawn,
    ends_of,
    positions,
    read_count,
    read_sizes,
)
from ssilang.operators.workspace import workspace


@operator(
    "DROI",
    family="mesh",
    full_name="DROIT",
    aliases=("D",),
    help=Help(
        en="Straight line between two points. " + SIZES_EN,
        fr="Segment de droite entre deux points. " + SIZES_FR,
        syntax="LIG1 = DROI (N1) POIN1 POIN2 ('DINI' DENS1) ('DFIN' DENS2) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; LIST (NBEL L) ;",
            "OPTI DIME 2 ELEM SEG3 DENS 0.25 ; P = 0. 0. ; L = P DROI (1. 0.) 'DFIN' 0.1 ;",
        ),
    ),
    reads_itself=True,
)
def droi(call: Call) -> Mesh:
    """Draw a straight line."""
    cuts, items = cuts_and_items(call)
    ends = ends_of(call, items[:2])
    a, b = positions(workspace(call.session), ends.start, ends.end)
    return drawn(call, ends, lambda s: a + s[:, None] * (b - a), float(np.linalg.norm(b - a)), cuts)


def _three(call: Call, items: list[Any]) -> tuple[Ends, FloatArray]:
    """Ends, and the position of the point that stands between them."""
    if len(items) < 2 or not isinstance(items[1], Point):
        raise call.missing(("POINT",))
    ends = ends_of(call, [items[0], *items[2:3]])
    return ends, items[1].coordinates.copy()


def _by_middle(
    call: Call, curve: Callable[[FloatArray, FloatArray, FloatArray], Arc | Polynomial]
) -> Mesh:
    cuts, items = cuts_and_items(call)
    ends, middle = _three(call, items)
    a, b = positions(workspace(call.session), ends.start, ends.end)
    shape = curve(a, middle, b)
    return drawn(call, ends, shape, shape.length, cuts)


@operator(
    "CERC",
    family="mesh",
    full_name="CERCLE",
    aliases=("C",),
    help=Help(
        en="Circular arc: around a centre (the shorter arc, the default), through three points "
        "('PASS'), or by turning a point by an angle in degrees about a point (2D) or an axis (3D) "
        "('ROTA'; 'ELIM' closes a turn of 360 degrees on its first point). " + SIZES_EN,
        fr="Arc de cercle : de centre donné (l'arc le plus court, par défaut), par trois points "
        "('PASS'), ou par rotation d'un point d'un angle en degrés autour d'un point (2D) ou d'un "
        "axe (3D) ('ROTA' ; 'ELIM' ferme un tour complet sur son premier point). " + SIZES_FR,
        syntax="LIG1 = CERC (N1) ('CENTR') POIN1 CENTR2 POIN3 ('DINI' DENS1) ('DFIN' DENS2) ;\n"
        "LIG1 = CERC (N1) 'PASS' POIN1 POIN2 POIN3 ('DINI' DENS1) ('DFIN' DENS2) ;\n"
        "LIG1 = CERC (N1) 'ROTA' FLOT1 POIN1 POIN2 (POIN3) ('ELIM') ('DINI' D1) ('DFIN' D2) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = CERC 8 (1. 0.) (0. 0.) (0. 1.) ;",
            "OPTI DIME 2 ELEM SEG2 ; L = CERC 8 'ROTA' 180. (1. 0.) (0. 0.) ;",
            "OPTI DIME 2 ELEM SEG3 ; L = CERC 8 'PASS' (1. 0.) (0. 1.) (-1. 0.) ;",
        ),
    ),
    reads_itself=True,
)
def cerc(call: Call) -> Mesh:
    """Draw a circular arc."""
    cuts = Cuts()
    read_sizes(call, cuts)
    word = call.keyword(("CENTR", "PASS", "ROTA"))
    if word is None:
        read_count(call, cuts)
        read_sizes(call, cuts)
        word = call.keyword(("CENTR", "PASS", "ROTA"))
    if word == "ROTA":
        return _turned(call, cuts)
    more, items = cuts_and_items(call)
    ends, middle = _three(call, items)
    cuts = Cuts(cuts.count or more.count, cuts.first or more.first, cuts.last or more.last)
    a, b = positions(workspace(call.session), ends.start, ends.end)
    shape = (arc_through if word == "PASS" else arc_about_centre)(a, middle, b)
    return drawn(call, ends, shape, shape.length, cuts)


def _turned(call: Call, cuts: Cuts) -> Mesh:
    """The arc that a point describes in a rotation."""
    ws = workspace(call.session)
    read_sizes(call, cuts)
    count, angle = (0, None) if cuts.count else count_and_number(call)
    if cuts.count:
        angle = call.required("FLOTTANT")
    if angle is None:
        raise call.missing(("FLOTTANT",))
    cuts.count = cuts.count or count
    items = call.all("POINT", "MAILLAGE")
    closing = call.keyword(("ELIM",)) is not None
    read_sizes(call, cuts)
    closing = closing or call.keyword(("ELIM",)) is not None
    need = 2 if ws.dimension < 3 else 3
    if len(items) < need or not all(isinstance(p, Point) for p in items[1:need]):
        raise call.missing(("POINT",))
    origin = items[1].coordinates.copy()
    axis = items[2].coordinates - origin if need == 3 else np.array([0.0, 0.0, 1.0])
    before = items[0] if isinstance(items[0], Mesh) else None
    start = line_ends(before)[1] if before is not None else items[0].node
    arc = arc_about_axis(positions(ws, start)[0], origin, axis, math.radians(angle))
    sizes = cuts.sizes(end_sizes(ws.nodes, start, start))
    parts = subdivide(arc.length, *sizes, cuts.count)
    if closing and abs(abs(angle) - 360.0) > 1e-6:
        raise call.bad(f"ELIM closes a turn of 360 degrees, the angle is {angle:g}")
    quadratic = chosen_family(ws).quadratic
    end = start if closing else None
    line = mesh_curve(ws.nodes, arc, start, end, parts, quadratic, ws.colour)
    return line if before is None else union(before, line, as_given=True)


@operator(
    "CER3",
    family="mesh",
    help=Help(
        en="Circular arc through three points. " + SIZES_EN,
        fr="Arc de cercle passant par trois points. " + SIZES_FR,
        syntax="LIG1 = CER3 (N1) POIN1 POIN2 POIN3 ('DINI' DENS1) ('DFIN' DENS2) ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = CER3 8 (1. 0.) (0. 1.) (-1. 0.) ;",),
    ),
    reads_itself=True,
)
def cer3(call: Call) -> Mesh:
    """Draw the arc through three points."""
    return _by_middle(call, arc_through)


@operator(
    "PARA",
    family="mesh",
    full_name="PARABOLE",
    help=Help(
        en="Arc of parabola between two points, the middle point being where the end tangents "
        "meet. " + SIZES_EN,
        fr="Arc de parabole entre deux points, le point du milieu étant l'intersection des "
        "tangentes aux extrémités. " + SIZES_FR,
        syntax="LIG1 = PARA (N1) POIN1 POIN3 POIN2 ('DINI' DENS1) ('DFIN' DENS2) ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = PARA 8 (0. 0.) (1. 2.) (2. 0.) ;",),
    ),
    reads_itself=True,
)
def para(call: Call) -> Mesh:
    """Draw an arc of parabola."""
    return _by_middle(call, parabola)


@operator(
    "LIGN",
    family="mesh",
    full_name="LIGNE",
    help=Help(
        en="Arc ('ROTA') from a point (or the end of a line) about a centre, with the normal of "
        "its plane in 3D, by an angle in degrees; or segment ('TRAN') from a point along a vector. "
        + SIZES_EN,
        fr="Arc ('ROTA') d'un point (ou de la fin d'une ligne) autour d'un centre, avec la normale "
        "à son plan en 3D, d'un angle en degrés ; ou segment ('TRAN') d'un point selon un vecteur. "
        + SIZES_FR,
        syntax="LIG1 = LIGN 'ROTA' (N1) CENTRE POIN1 (NORMAL) ANGLE ('DINI' D1) ('DFIN' D2) ;\n"
        "LIG1 = LIGN 'TRAN' (N1) POIN1 VEC1 ('DINI' D1) ('DFIN' D2) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = LIGN 'ROTA' 8 (0. 0.) (1. 0.) 90. ;"
            " M = LIGN 'TRAN' 4 (0. 0.) (1. 1.) ;",
        ),
    ),
    reads_itself=True,
)
def lign(call: Call) -> Mesh:
    """Draw an arc or a segment from a point."""
    ws = workspace(call.session)
    word = call.keyword(("ROTA", "TRAN"))
    cuts = Cuts()
    read_sizes(call, cuts)
    angle = None
    if any(isinstance(o.value, float) for o in call.operands):
        cuts.count, angle = count_and_number(call)
    else:
        read_count(call, cuts)
    items = call.all("POINT", "MAILLAGE")
    read_sizes(call, cuts)
    word = word or call.keyword(("ROTA", "TRAN"))
    if word is None:
        raise call.bad("what the line is is not said", hint="'ROTA' or 'TRAN'")
    if word == "ROTA" and angle is None:
        angle = call.required("FLOTTANT")
    if word == "TRAN" and angle is not None:
        raise call.bad("a straight line has no angle", angle, hint="'ROTA' draws arcs")
    base = 1 if word == "ROTA" else 0
    others = [items[i] for i in range(len(items)) if i != base]
    if any(isinstance(other, Mesh) for other in others):
        raise call.bad("only the beginning of the line may be a mesh", hint="give points")
    if len(items) < 2 or (word == "ROTA" and ws.dimension == 3 and len(items) < 3):
        raise call.missing(("POINT",))
    before = items[base] if isinstance(items[base], Mesh) else None
    start = items[base].node if before is None else line_ends(before)[1]
    at = positions(ws, start)[0]
    curve: Callable[[FloatArray], FloatArray]
    if angle is not None:
        normal = items[2].coordinates.copy() if ws.dimension == 3 else np.array([0.0, 0.0, 1.0])
        arc = arc_about_axis(at, items[0].coordinates.copy(), normal, math.radians(angle))
        curve, length, size = arc, arc.length, float(ws.nodes.density[start])
    else:
        step, size = items[1].coordinates.copy(), items[1].density
        curve, length = (lambda s: at + s[:, None] * step), float(np.linalg.norm(step))
    sizes = cuts.sizes((float(ws.nodes.density[start]), size))
    parts = subdivide(length, *sizes, cuts.count)
    line = mesh_curve(ws.nodes, curve, start, None, parts, chosen_family(ws).quadratic, ws.colour)
    return line if before is None else union(before, line, as_given=True)


@operator(
    "QUEL",
    family="mesh",
    full_name="QUELCONQUE",
    help=Help(
        en="Broken line through points, in order: given one by one, as a mesh of points, or by "
        "lists of coordinates. With SEG3 every other point is the middle of an element.",
        fr="Ligne brisée passant par des points dans l'ordre : donnés un à un, par un maillage de "
        "points ou par des listes de coordonnées. Avec SEG3 un point sur deux est un milieu.",
        syntax="LIG1 = QUEL ('SEG2'|'SEG3') POIN1 POIN2 ... | MAIL1 | LISTX (LISTY (LISTZ)) ;",
        examples=(
            "OPTI DIME 2 ; L = QUEL 'SEG2' (0. 0.) (1. 1.) (2. 0.) ;",
            "OPTI DIME 2 ; L = QUEL 'SEG2' (PROG 0. 1. 2.) (PROG 0. 1. 0.) ;",
        ),
    ),
    reads_itself=True,
)
def quel(call: Call) -> Mesh:
    """Draw a broken line."""
    ws = workspace(call.session)
    word = call.keyword(("SEG2", "SEG3"))
    lists = call.all("LISTREEL")
    if lists:
        if len({len(v) for v in lists}) > 1:
            raise call.bad("the lists of coordinates have different lengths", lists[1])
        table = np.column_stack([v.values for v in lists[: max(ws.dimension, 1)]])
        chain = ws.nodes.add(table, ws.density)
    else:
        chain = _given_nodes(call)
    word = word or call.keyword(("SEG2", "SEG3"))
    quadratic = word == "SEG3" if word else chosen_family(ws).quadratic
    if lists:
        return chain_mesh(ws.nodes, chain, quadratic, ws.colour)
    return polyline(ws.nodes, chain, quadratic, ws.colour)


def _given_nodes(call: Call) -> Any:
    parts: list[Any] = []
    for item in call.all("POINT", "MAILLAGE"):
        if isinstance(item, Point):
            parts.append([item.node])
        else:
            parts += [b.connectivity.ravel() for b in item.blocks]
    if not parts:
        raise call.missing(("POINT", "MAILLAGE", "LISTREEL"))
    return np.concatenate(parts).astype(np.int64)
