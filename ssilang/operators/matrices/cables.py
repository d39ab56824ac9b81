"""CABL: stiffness of cables under tension."""

from __future__ import annotations

from ssilang.kernel.matrices.cables import cable_stiffness
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.vocabulary.terms import NOT_ZERO, POSITIVE
from ssilang.operators.workspace import workspace


@operator(
    "CABL",
    arg("mesh", "MAILLAGE", en="cables"),
    arg("force", "FLOTTANT", en="force", unit="N", usual=POSITIVE),
    arg("percent", "FLOTTANT", en="lengthening under it", unit="%", range=NOT_ZERO, usual=POSITIVE),
    family="matrix",
    full_name="CABLE",
    help=Help(
        en="Stiffness of cables (SEG2) whose force is X1 at a lengthening of X2 percent.",
        syntax="RIG1 = CABL GEO1 X1 X2 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (2. 0.) ; "
            "LIST (EXTR (CABL L 10. 1.) 'DIAG') ;",
        ),
    ),
)
def cabl(call: Call, mesh: Mesh, force: float, percent: float) -> Matrix:
    """Cables."""
    return cable_stiffness(mesh, workspace(call.session).dimension, force, percent)
