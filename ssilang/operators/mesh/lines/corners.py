"""CONG: rounded corners."""

from __future__ import annotations

from ssilang.kernel.mesh.lines.fillet import fillet
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.registry import Help, arg, flag, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.vocabulary.terms import POSITIVE
from ssilang.operators.workspace import workspace


@operator(
    "CONG",
    arg("first", "MAILLAGE", en="first line"),
    opt("count", "ENTIER", en="number of elements; by the mesh sizes without it", range=POSITIVE),
    opt("radius", "FLOTTANT", range=POSITIVE, en="radius", unit="m"),
    arg("second", "MAILLAGE", en="line that follows"),
    flag("double", "DOUBLE", en="two arcs: not available"),
    family="mesh",
    full_name="CONGE",
    help=Help(
        en="Rounds the corner between two lines, the second following the first, by an arc of a "
        "given radius. Gives the first line cut short, the arc and the second line cut short.",
        syntax="GEO1 GEO3 GEO2 = LIG1 CONG (N1) FLOT1 LIG2 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; P = 1. 0. ; L = DROI 5 (0. 0.) P ; M = DROI 5 P (1. 1.) ;"
            " A B C0 = L CONG 4 0.3 M ; LIST (MESU B) ;",
        ),
    ),
)
def cong(
    call: Call,
    first: Mesh,
    count: int | None,
    radius: float | None,
    second: Mesh,
    double: bool,
) -> tuple[Mesh, Mesh, Mesh]:
    """Round a corner; an integer alone is the radius."""
    if double:
        raise call.error("operators.mesh.no-double-fillet")
    if radius is None:
        radius, count = float(count or 0), 0
    if radius <= 0.0:
        raise call.error("operators.mesh.radius-not-positive", radius=radius)
    return fillet(first, second, radius, abs(count or 0), workspace(call.session).colour)
