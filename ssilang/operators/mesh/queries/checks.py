"""VERM: what is wrong with a mesh is said and named."""

from __future__ import annotations

from ssilang.kernel.mesh.combine import without_duplicates
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.queries.soundness import repeated_cells, unfit_faces, unmatched_middles
from ssilang.language.registry import Help, arg, operator, said
from ssilang.language.run.session import Session

_CHECKS = (
    ("MESH", repeated_cells, "operators.mesh.repeated-cells"),
    ("NODE", unmatched_middles, "operators.mesh.unmatched-middles"),
    ("MESH", unfit_faces, "operators.mesh.unfit-faces"),
)


@operator(
    "VERM",
    arg("mesh", "MAILLAGE", en="mesh"),
    family="mesh",
    help=Help(
        en="Checks a mesh and says what is wrong: cells on the same nodes, linear cells next to "
        "quadratic ones, triangular faces on quadrangular ones. Cells and nodes found get the "
        "names MESH1 MESH2 ..., NODE1 ...",
        syntax="VERM GEO1 ;\nGEO2 = VERM GEO1 'CORR' ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0. 0.) (1. 0.) ; M = L ET (INVE L) ; VERM M ;",
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0. 0.) (1. 0.) ;\n"
            "M = VERM (L ET (INVE L)) 'CORR' ; LIST (NBEL M) ;",
        ),
    ),
)
def verm(session: Session, mesh: Mesh) -> None:
    """Check a mesh."""
    _tell(session, mesh)


@verm.form(
    said("CORR"),
    arg("mesh", "MAILLAGE", en="mesh"),
    en="'CORR' also gives the mesh with one cell left where several stand on the same nodes; "
    "what else is found is for the script to mend.",
)
def corrected(session: Session, mesh: Mesh) -> Mesh:
    """Check a mesh, and take doubled cells out of it."""
    _tell(session, mesh)
    return without_duplicates(mesh)


def _tell(session: Session, mesh: Mesh) -> None:
    count = {"MESH": 0, "NODE": 0}
    for kind, check, code in _CHECKS:
        found = check(mesh)
        if found.n_cells:
            count[kind] += 1
            name = f"{kind}{count[kind]}"
            session.frame.assign(name, found)
            session.print(" " + session.told(code, count=found.n_cells, name=name))
