"""Lines: DROI, CERC, CER3, PARA, CUBP, CUBT, COUR, QUEL."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.curves import (
    Arc,
    Polynomial,
    arc_about_axis,
    arc_about_centre,
    arc_through,
    cubic_tangents,
    cubic_through,
    parabola,
)
from ssilang.kernel.mesh.lines import chain_mesh, end_sizes, line_ends, mesh_curve, polyline
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.mesh.subdivision import subdivide
from ssilang.language.call import Call
from ssilang.language.registry import Help, operator
from ssilang.operators.meshing_ends import (
    Cuts,
    Ends,
    chosen_family,
    count_and_number,
    drawn,
    ends_of,
    positions,
    read_count,
    read_sizes,
)
from ssilang.operators.workspace import workspace

_SIZES_EN = (
    "N1 > 0: that many equal elements; N1 < 0: that many, graded by the mesh sizes of the ends; "
    "without N1 the sizes decide. DINI and DFIN replace the sizes that the ends carry. A line in "
    "place of an end point is continued; a line alone is closed."
)
_SIZES_FR = (
    "N1 > 0 : N1 éléments égaux ; N1 < 0 : N1 éléments gradués selon les densités ; sans N1 les "
    "densités décident. DINI et DFIN remplacent les densités des extrémités. Une ligne à la place "
    "d'une extrémité est prolongée ; une ligne seule est fermée."
)


def _cuts_and_items(call: Call) -> tuple[Cuts, list[Any]]:
    """Number of elements, sizes and points or lines, in whatever order they stand."""
    cuts = Cuts()
    items: list[Any] = []
    before = -1
    while before != len(call.operands):
        before = len(call.operands)
        read_sizes(call, cuts)
        if not cuts.count:
            read_count(call, cuts)
        items += call.all("POINT", "MAILLAGE")
    return cuts, items


@operator(
    "DROI",
    family="mesh",
    full_name="DROIT",
    aliases=("D",),
    help=Help(
        en="Straight line between two points. " + _SIZES_EN,
        fr="Segment de droite entre deux points. " + _SIZES_FR,
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
    cuts, items = _cuts_and_items(call)
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
    cuts, items = _cuts_and_items(call)
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
        "('ROTA'; 'ELIM' closes a turn of 360 degrees on its first point). " + _SIZES_EN,
        fr="Arc de cercle : de centre donné (l'arc le plus court, par défaut), par trois points "
        "('PASS'), ou par rotation d'un point d'un angle en degrés autour d'un point (2D) ou d'un "
        "axe (3D) ('ROTA' ; 'ELIM' ferme un tour complet sur son premier point). " + _SIZES_FR,
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
    more, items = _cuts_and_items(call)
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
        en="Circular arc through three points. " + _SIZES_EN,
        fr="Arc de cercle passant par trois points. " + _SIZES_FR,
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
        "meet. " + _SIZES_EN,
        fr="Arc de parabole entre deux points, le point du milieu étant l'intersection des "
        "tangentes aux extrémités. " + _SIZES_FR,
        syntax="LIG1 = PARA (N1) POIN1 POIN3 POIN2 ('DINI' DENS1) ('DFIN' DENS2) ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = PARA 8 (0. 0.) (1. 2.) (2. 0.) ;",),
    ),
    reads_itself=True,
)
def para(call: Call) -> Mesh:
    """Draw an arc of parabola."""
    return _by_middle(call, parabola)


@operator(
    "CUBP",
    family="mesh",
    help=Help(
        en="Cubic through four points; 'UNIF' spaces nodes by length, else by the parameter that "
        "is 1/3 and 2/3 at the inner points. " + _SIZES_EN,
        fr="Cubique passant par quatre points ; 'UNIF' répartit les noeuds selon l'abscisse "
        "curviligne, sinon selon le paramètre valant 1/3 et 2/3 aux points internes. " + _SIZES_FR,
        syntax="LIG1 = CUBP (N1) POIN1 POIN2 POIN3 POIN4 ('UNIF') ('DINI' D1) ('DFIN' D2) ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = CUBP 9 (0. 0.) (1. 1.) (2. -1.) (3. 0.) ;",),
    ),
    reads_itself=True,
)
def cubp(call: Call) -> Mesh:
    """Draw the cubic through four points."""
    cuts, items = _cuts_and_items(call)
    uniform = call.keyword(("UNIF",)) is not None
    read_sizes(call, cuts)
    return _four(call, cuts, items, lambda a, p, q, b: cubic_through(a, p, q, b, uniform))


@operator(
    "CUBT",
    family="mesh",
    help=Help(
        en="Cubic between two points, tangent to a vector at each. " + _SIZES_EN,
        fr="Cubique entre deux points, tangente à un vecteur en chacun. " + _SIZES_FR,
        syntax="LIG1 = CUBT (N1) POIN1 VECT1 VECT2 POIN2 ('DINI' DENS1) ('DFIN' DENS2) ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = CUBT 9 (0. 0.) (1. 1.) (1. -1.) (3. 0.) ;",),
    ),
    reads_itself=True,
)
def cubt(call: Call) -> Mesh:
    """Draw the cubic between two tangents."""
    cuts, items = _cuts_and_items(call)
    return _four(call, cuts, items, cubic_tangents)


def _four(
    call: Call,
    cuts: Cuts,
    items: list[Any],
    curve: Callable[[FloatArray, FloatArray, FloatArray, FloatArray], Polynomial],
) -> Mesh:
    if len(items) < 3 or not all(isinstance(p, Point) for p in items[1:3]):
        raise call.missing(("POINT",))
    ends = ends_of(call, [items[0], *items[3:4]])
    a, b = positions(workspace(call.session), ends.start, ends.end)
    shape = curve(a, items[1].coordinates.copy(), items[2].coordinates.copy(), b)
    return drawn(call, ends, shape, shape.length, cuts)


@operator(
    "COUR",
    family="mesh",
    full_name="COURBE",
    help=Help(
        en="Polynomial curve P(U) = P0 + U P1 + U**2 P2 + ..., U from 0 to 1 or between the values "
        "behind 'PARA'. 'REGU' spaces nodes by length. 'PINI' and 'PFIN' give an existing point "
        "(or a line to continue) where the curve starts or ends.",
        fr="Courbe polynomiale P(U) = P0 + U P1 + U**2 P2 + ..., U de 0 à 1 ou entre les bornes "
        "données derrière 'PARA'. 'REGU' répartit les noeuds selon l'abscisse curviligne. 'PINI' "
        "et 'PFIN' donnent un point existant (ou une ligne à prolonger) aux extrémités.",
        syntax="LIG1 = COUR (N1) ('DINI' D1) ('DFIN' D2) ('PINI' OBJ1) ('PFIN' OBJ2) POIN0 POIN1 "
        "(POIN2 ...) ('PARA' U1 U2) ('REGU') ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = COUR 8 (0. 0.) (1. 0.) (0. 1.) ;",),
    ),
    reads_itself=True,
)
def cour(call: Call) -> Mesh:
    """Draw a polynomial curve."""
    cuts = Cuts()
    points: list[Point] = []
    limits, regular = (0.0, 1.0), False
    given: dict[str, Point | Mesh] = {}
    before = -1
    while before != len(call.operands):
        before = len(call.operands)
        read_sizes(call, cuts)
        if not cuts.count:
            read_count(call, cuts)
        word = call.keyword(("PINI", "PFIN", "PARAMETRE", "REGULIER"))
        place = call.keyword_end
        if word in ("PINI", "PFIN"):
            given[word] = call.required("POINT", "MAILLAGE", after=place)
        elif word == "PARAMETRE":
            first = call.required("FLOTTANT", after=place)
            limits = first, call.required("FLOTTANT", after=place)
        elif word == "REGULIER":
            regular = True
        elif word is None:
            points += call.all("POINT")
    if len(points) < 2:
        raise call.missing(("POINT",))
    table = np.array([p.coordinates for p in points])
    shape = Polynomial(table, *limits, regular=regular)
    ends = _curve_ends(call, shape, given)
    return drawn(call, ends, shape, shape.length, cuts)


def _curve_ends(call: Call, shape: Polynomial, given: dict[str, Point | Mesh]) -> Ends:
    """Existing or new end nodes of a curve."""
    ws = workspace(call.session)
    tips = shape(np.array([0.0, 1.0]))
    scale = max(shape.length, 1e-300)
    nodes = []
    for word, side, tip in (("PINI", 1, tips[0]), ("PFIN", 0, tips[1])):
        there = given.get(word)
        if there is None:
            nodes.append(int(ws.nodes.add(tip[None], ws.density)[0]))
            continue
        node = there.node if isinstance(there, Point) else line_ends(there)[side]
        if float(np.linalg.norm(ws.nodes.coordinates[node] - tip)) > 1e-4 * scale:
            raise call.bad(f"the point behind {word} is not where the curve ends", there)
        nodes.append(node)
    lines = [given.get(w) for w in ("PINI", "PFIN")]
    before, after = (m if isinstance(m, Mesh) else None for m in lines)
    return Ends(nodes[0], nodes[1], before, after)


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
