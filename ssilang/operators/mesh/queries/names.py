"""REFE: named meshes within another one."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.session import Session
from ssilang.language.values import ListMots


@operator(
    "REFE",
    arg("small", "MAILLAGE", en="mesh"),
    arg("large", "MAILLAGE", en="mesh that may hold it"),
    family="mesh",
    help=Help(
        en="Names of the meshes whose nodes all belong to a mesh; or, with two meshes, whether all "
        "nodes of the first belong to the second.",
        syntax="LMOT1 = REFE MAIL2 ; LOG1 = MAIL1 REFE MAIL2 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; L1 = DROI 2 A (1. 0.) ; L2 = DROI 2 A (0. 1.) ; "
            "L3 = L1 ET L2 ; LIST (REFE L3) ; LIST (L1 REFE L2) ;",
        ),
    ),
)
def refe(small: Mesh, large: Mesh) -> bool:
    """Whether a mesh is within another one."""
    return _inside(small, large)


@refe.form(arg("mesh", "MAILLAGE", en="mesh"))
def names_within(session: Session, mesh: Mesh) -> ListMots:
    """Names of the meshes within a mesh."""
    frame = session.frame
    values = ((name, frame.find(name)) for name in sorted(frame.names()))
    return ListMots(
        [n for n, v in values if isinstance(v, Mesh) and v is not mesh and _inside(v, mesh)]
    )


def _inside(small: Mesh, large: Mesh) -> bool:
    return bool(np.isin(small.sorted_node_ids, large.sorted_node_ids).all())
