"""COUT: triangles between lines, cells joined to a point."""

from __future__ import annotations

from ssilang.kernel.mesh.generators.stitch import cone, stitch
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.session import Session
from ssilang.operators.workspace import workspace


@operator(
    "COUT",
    arg("first", "MAILLAGE", en="line, or cells"),
    arg("second", "MAILLAGE", "POINT", en="line in the same sense, or point"),
    family="mesh",
    full_name="COUTURE",
    help=Help(
        en="Triangles between two lines described in the same sense, whatever their numbers of "
        "cells; or the cells of a mesh joined to a point (POI1 give SEG2, SEG2 TRI3, SEG3 TRI6, "
        "TRI3 TET4, QUA4 PYR5), those that hold the point being left out.",
        syntax="SURF1 = COUT LIG1 LIG2 ;\nMAIL2 = COUT MAIL1 POIN1 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; M = DROI 2 (0. 1.) (1. 1.) ;"
            " LIST (NBEL (COUT L M)) ;",
            "OPTI DIME 2 ELEM QUA8 ; O = 0. 0. ; A = CERC 6 (1. 0.) O (0. 1.) ;"
            " LIST (MESU (COUT O A)) ;",
        ),
    ),
)
def cout(session: Session, first: Mesh, second: Mesh | Point) -> Mesh:
    """Stitch lines together, or join cells to a point."""
    if isinstance(second, Point):
        return cone(first, second.node)
    return stitch(first, second, workspace(session).colour)
