"""Frames along lines: FREN."""

from __future__ import annotations

from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.lines.frenet import frenet_frames
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.session import Session
from ssilang.operators.workspace import workspace


@operator(
    "FREN",
    arg("line", "MAILLAGE", en="lines"),
    family="mesh",
    full_name="FRENET",
    help=Help(
        en="Frenet frame along lines, as a nodal field: tangent TX TY (TZ), normal NX NY (NZ) and, "
        "in 3D, binormal BX BY BZ. In 2D the normal is the tangent turned by a quarter turn.",
        syntax="CHPO1 = FREN LIG1 ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; F = FREN (DROI 4 (0. 0.) (1. 0.)) ; LIST (TYPE F) ;",),
    ),
)
def fren(session: Session, line: Mesh) -> NodeField:
    """Frenet frame."""
    ids, frames = frenet_frames(line)
    dimension = workspace(session).dimension
    if dimension < 3:
        t = frames[:, 0]
        values = {"TX": t[:, 0], "TY": t[:, 1], "NX": -t[:, 1], "NY": t[:, 0]}
    else:
        values = {
            f"{row}{axis}": frames[:, k, j]
            for k, row in enumerate("TNB")
            for j, axis in enumerate("XYZ")
        }
    return NodeField.of(line.nodes, ids, values, "DIFFUS")
