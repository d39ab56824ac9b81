"""Fields for a matrix: CHPO on its unknowns, ORTH makes some orthogonal for it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.fields import node_algebra
from ssilang.kernel.matrices.assembly import numbering_of
from ssilang.kernel.modal.basis import work
from ssilang.kernel.statics.linear import product
from ssilang.operators.numbers.noise import session_generator
from ssilang.operators.prelude import *


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


@operator(
    "ORTH",
    flag("alike", "SEMBLABLE", en="the fields have the same nodes and components"),
    arg("field", "CHPOINT", en="field X"),
    arg("shapes", "LISTCHPO", en="fields U"),
    arg("norms", "LISTREEL", en="products U K U", range=ANY_NUMBER),
    opt("loaded", "LISTCHPO", en="fields K U"),
    arg("matrix", "RIGIDITE", en="matrix K"),
    opt("precision", "FLOTTANT", range=POSITIVE, en="precision"),
    opt("passes", "ENTIER", range=POSITIVE, default=2, en="passes at most"),
    family="matrix",
    full_name="ORTHOGONALISER",
)
def orth(
    call: Call,
    alike: bool,
    field: NodeField,
    shapes: ListChpo,
    norms: ListReel,
    loaded: ListChpo | None,
    matrix: Matrix,
    precision: float | None,
    passes: int,
) -> NodeField:
    """Gram and Schmidt's step."""
    fields: list[Any] = list(shapes.values)
    forces: list[Any] = (
        [product(matrix, u) for u in fields] if loaded is None else list(loaded.values)
    )
    if not len(fields) == len(norms) == len(forces):
        raise call.error(
            "operators.matrices.products-do-not-match",
            n_shapes=len(fields),
            n_norms=len(norms),
            n_forces=len(forces),
        )
    if (norms.values == 0.0).any():
        raise call.error("operators.matrices.product-is-zero")
    for turn in range(max(passes, 1)):
        worst = 0.0
        for u, k, f in zip(fields, norms.values, forces, strict=True):
            share = work(f, field) / k
            worst = max(worst, abs(share))
            field = node_algebra.added(field, u, -share)
        if precision is None or (turn and worst <= precision):
            break
    return field
