"""XXT and ZXXT: sums of outer products, behind the procedures M_DAMPIN and M_DAMP_K."""

from __future__ import annotations

from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.outer import sum_of_outer_products
from ssilang.language.registry import Help, arg, operator, opt
from ssilang.language.values import ListChpo, ListReel
from ssilang.language.vocabulary.terms import ANY_NUMBER


@operator(
    "ZXXT",
    arg("fields", "LISTCHPO", en="fields v"),
    arg("factors", "LISTREEL", en="numbers a", range=ANY_NUMBER),
    family="matrix",
    help=Help(
        en="Full matrix of damping a1 v1 v1T + a2 v2 v2T + ... of fields v and numbers a, behind "
        "M_DAMPIN and M_DAMP_K.",
        syntax="RIG1 = ZXXT LCHP1 LREE1 ;",
        examples=(
            "OPTI DIME 2 ; V = MANU 'CHPO' (0. 0.) 2 'FX' 1. 'FY' 2. 'NATURE' 'DISCRET' ; "
            "LIST (EXTR (ZXXT (SUIT V) (PROG 3.)) 'DIAG') ;",
        ),
    ),
)
def zxxt(fields: ListChpo, factors: ListReel) -> Matrix:
    """Sum of the outer products."""
    vectors = [f for f in fields.values if isinstance(f, NodeField)]
    return sum_of_outer_products(vectors, [float(a) for a in factors.values], "AMORTISSEMENT")


@operator(
    "XXT",
    arg("field", "CHPOINT", en="v"),
    opt("factor", "FLOTTANT", default=1.0, en="a", range=ANY_NUMBER),
    family="matrix",
    help=Help(
        en="Stiffness a v v^T of a nodal field v (forces, or displacements): one full element on "
        "all its nodes.",
        syntax="RIG1 = XXT CHPO1 (X1) ;",
        examples=(
            "OPTI DIME 2 ; V = MANU 'CHPO' (0. 0.) 2 'FX' 1. 'FY' 2. 'NATURE' 'DISCRET' ; "
            "LIST (EXTR (XXT V 3.) 'DIAG') ;",
        ),
    ),
)
def xxt(field: NodeField, factor: float) -> Matrix:
    """Outer product."""
    return sum_of_outer_products([field], [factor], "RIGIDITE")
