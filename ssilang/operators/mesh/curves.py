"""Polynomial curves: CUBP, CUBT, COUR."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.mesh.lines.curves import Polynomial, cubic_tangents, cubic_through
from ssilang.kernel.mesh.lines.lines import line_ends
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.mesh.ends import (
    SIZES_EN,
    SIZES_FR,
    Cuts,
    Ends,
    cuts_and_items,
    drawn,
    ends_of,
    positions,
    read_count,
    read_sizes,
)
from ssilang.operators.workspace import workspace


@operator(
    "CUBP",
    family="mesh",
    help=Help(
        en="Cubic through four points; 'UNIF' spaces nodes by length, else by the parameter that "
        "is 1/3 and 2/3 at the inner points. " + SIZES_EN,
        fr="Cubique passant par quatre points ; 'UNIF' répartit les noeuds selon l'abscisse "
        "curviligne, sinon selon le paramètre valant 1/3 et 2/3 aux points internes. " + SIZES_FR,
        syntax="LIG1 = CUBP (N1) POIN1 POIN2 POIN3 POIN4 ('UNIF') ('DINI' D1) ('DFIN' D2) ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = CUBP 9 (0. 0.) (1. 1.) (2. -1.) (3. 0.) ;",),
    ),
    reads_itself=True,
)
def cubp(call: Call) -> Mesh:
    """Draw the cubic through four points."""
    cuts, items = cuts_and_items(call)
    uniform = call.keyword(("UNIF",)) is not None
    read_sizes(call, cuts)
    return _four(call, cuts, items, lambda a, p, q, b: cubic_through(a, p, q, b, uniform))


@operator(
    "CUBT",
    family="mesh",
    help=Help(
        en="Cubic between two points, tangent to a vector at each. " + SIZES_EN,
        fr="Cubique entre deux points, tangente à un vecteur en chacun. " + SIZES_FR,
        syntax="LIG1 = CUBT (N1) POIN1 VECT1 VECT2 POIN2 ('DINI' DENS1) ('DFIN' DENS2) ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = CUBT 9 (0. 0.) (1. 1.) (1. -1.) (3. 0.) ;",),
    ),
    reads_itself=True,
)
def cubt(call: Call) -> Mesh:
    """Draw the cubic between two tangents."""
    cuts, items = cuts_and_items(call)
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
