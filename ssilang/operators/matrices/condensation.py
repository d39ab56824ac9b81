"""CMCT: matrices without some unknowns."""

from __future__ import annotations

from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.condensation import condensed_by_relations, condensed_on_multipliers
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.language.registry import Help, arg, operator

_TWO = "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; K = (APPU 'UX' 4. P) ET (APPU 'UX' 5. Q) ; "


@operator(
    "CMCT",
    arg("matrix", "RIGIDITE", en="relations C"),
    arg("diagonal", "CHPOINT", en="M^-1"),
    family="matrix",
    help=Help(
        en="Condensation. With relations C and a field holding the inverse of a diagonal M: the "
        "matrix C M^-1 C^T on the multipliers LX. With a matrix K and relations: the matrix "
        "without the unknowns that the relations give by the others.",
        syntax="RIG3 = CMCT RIG1 CHPO1 ; RIG3 = CMCT RIG1 RIG2 ;",
        examples=(
            _TWO + "C = RELA 2. 'UX' P '+' 3. 'UX' Q ; "
            "D = MANU 'CHPO' (P ET Q) 1 'UX' 0.5 ; LIST (EXTR (CMCT C D) 'DIAG') ;",
            (
                "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ;\n"
                "K = (APPU 'UX' 4. P) ET (APPU 'UX' 5. Q) ;\n"
                "C = RELA 2. 'UX' P '+' 3. 'UX' Q ;\n"
                "LIST (EXTR (CMCT K C) 'DIAG') ;"
            ),
        ),
    ),
)
def cmct(matrix: Matrix, diagonal: NodeField) -> Matrix:
    """On the multipliers."""
    return condensed_on_multipliers(matrix, diagonal)


@cmct.form(
    arg("matrix", "RIGIDITE", en="matrix"),
    arg(
        "relations", "RIGIDITE", en="relations, or the first matrix that CHAN 'COND' makes of them"
    ),
)
def cmct_of_matrix(matrix: Matrix, relations: Matrix) -> Matrix:
    """On the unknowns that stay."""
    return condensed_by_relations(matrix, relations)
