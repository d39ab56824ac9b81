"""PARC: an arc of circle as a chain of parabolas."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.lines.curves import ParabolicArc, arc_about_centre
from ssilang.kernel.mesh.lines.lines import chain_mesh, different_nodes, end_sizes
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.mesh.ends import SIZES_EN, SIZES_FR, cuts_and_items, ends_of, positions
from ssilang.operators.workspace import workspace


@operator(
    "PARC",
    family="mesh",
    help=Help(
        en="The shorter arc of circle around a centre as arcs of parabola, SEG3 whose ends lie on "
        "the circle and are tangent to it. " + SIZES_EN,
        fr="L'arc de cercle le plus court autour d'un centre en arcs de parabole, SEG3 dont les "
        "extrémités sont sur le cercle et lui sont tangentes. " + SIZES_FR,
        syntax="LIG1 = PARC (N1) POIN1 CENTR1 POIN2 ('DINI' DENS1) ('DFIN' DENS2) ;",
        examples=("OPTI DIME 2 ; L = PARC 2 (1. 0.) (0. 0.) (0. 1.) ; LIST (COOR 1 L) ;",),
    ),
    reads_itself=True,
)
def parc(call: Call) -> Mesh:
    """Draw parabolas along an arc."""
    ws = workspace(call.session)
    cuts, items = cuts_and_items(call)
    if len(items) < 2 or not isinstance(items[1], Point):
        raise call.missing(("POINT",))
    ends = ends_of(call, [items[0], *items[2:3]])
    different_nodes(ws.nodes, ends.start, ends.end)
    a, b = positions(ws, ends.start, ends.end)
    arc = arc_about_centre(a, items[1].coordinates.copy(), b)
    sizes = cuts.sizes(end_sizes(ws.nodes, ends.start, ends.end))
    pieces = subdivide(arc.length, *sizes, cuts.count)
    middles = ParabolicArc(arc, pieces.fractions).middles()
    inner = pieces.fractions[1:-1]
    corners = ws.nodes.add(arc(inner), pieces.density(inner)) if len(inner) else inner.astype(int)
    chain = np.empty(2 * pieces.count + 1, dtype=np.int64)
    chain[0], chain[-1] = ends.start, ends.end
    chain[2:-1:2] = corners
    chain[1::2] = ws.nodes.add(middles, pieces.density(pieces.middles))
    line = chain_mesh(ws.nodes, chain, True, ws.colour)
    parts = [m for m in (ends.before, line, ends.after) if m is not None]
    return union(*parts, as_given=True)
