"""CHPO: fields on the unknowns of a matrix."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices.assembly import numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.language.registry import Chosen, Help, arg, operator, select
from ssilang.language.run.call import Call
from ssilang.language.vocabulary.terms import ANY_NUMBER
from ssilang.operators.numbers.noise import session_generator

_TWO = "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; K = (APPU 'UX' 4. P) ET (APPU 'UX' 5. Q) ; "


@operator(
    "CHPO",
    select(
        "values",
        {
            "ALEATOIRE": [],
            "UNIFORME": [arg("value", "FLOTTANT", en="value", range=ANY_NUMBER)],
        },
        en="random, or the same everywhere",
    ),
    arg("matrix", "RIGIDITE", en="matrix"),
    family="fields",
    full_name="CHPOINT",
    help=Help(
        en="Nodal field on the unknowns of a matrix: the same value everywhere ('UNIFORME'), or "
        "random values between 0 and 1 ('ALEATOIRE').",
        syntax="CHPO1 = CHPO 'ALEATOIRE' | 'UNIFORME' X1 RIG1 ;",
        examples=(
            _TWO + "LIST (CHPO 'UNIFORME' 2. K) ;",
            (
                "OPTI DIME 2 ; P = 0. 0. ;\n"
                "C = CHPO 'ALEA' (APPU 'UX' 1. P) ; LIST (EXTR C 'COMP') ;"
            ),
        ),
    ),
)
def chpo(call: Call, values: Chosen | None, matrix: Matrix) -> NodeField:
    """Field on the unknowns of a matrix."""
    if values is None:
        raise call.error("operators.matrices.which-values")
    value = values["value"] if values.word == "UNIFORME" else None
    numbering = numbering_of(matrix)
    if not numbering.size:
        call.warn("operators.matrices.at-no-node")
    generator = session_generator(call, None)
    made = {}
    for name in numbering.unknowns:
        nodes = numbering.nodes[numbering.where(name)]
        n = len(nodes)
        made[name] = NodeValues(nodes, generator.random(n) if value is None else np.full(n, value))
    return NodeField(numbering.table, made, "DIFFUS")
