"""Fields for a matrix: CHPO on its unknowns, ORTH makes some orthogonal for it."""

from ssilang.kernel.fields import node_algebra
from ssilang.kernel.matrices.assembly import numbering_of
from ssilang.kernel.modal.basis import work
from ssilang.kernel.statics.linear import product
from ssilang.operators.numbers.noise import session_generator
from ssilang.operators.prelude import *


@operator("CHPO", family="fields", full_name="CHPOINT")
def chpo(
    call: Call,
    values: Chosen | None = Cases(
        {
            "ALEATOIRE": [],
            "UNIFORME": [arg("value", "FLOTTANT", en="value", range=ANY_NUMBER)],
        },
        en="random, or the same everywhere",
    ),
    matrix: Matrix = Arg("RIGIDITE", en="matrix"),
) -> NodeField:
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


@operator("ORTH", family="matrix", full_name="ORTHOGONALISER")
def orth(
    call: Call,
    alike: bool = Flag("SEMBLABLE", en="the fields have the same nodes and components"),
    field: NodeField = Arg("CHPOINT", en="field X"),
    shapes: ListChpo = Arg("LISTCHPO", en="fields U"),
    norms: ListReel = Arg("LISTREEL", en="products U K U", range=ANY_NUMBER),
    loaded: ListChpo | None = Opt("LISTCHPO", en="fields K U"),
    matrix: Matrix = Arg("RIGIDITE", en="matrix K"),
    precision: float | None = Opt("FLOTTANT", range=POSITIVE, en="precision"),
    passes: int = Opt("ENTIER", range=POSITIVE, default=2, en="passes at most"),
) -> NodeField:
    """Gram and Schmidt's step."""
    fields: list[Any] = list(shapes.values)
    forces: list[Any] = (
        [product(matrix, u) for u in fields] if loaded is None else list(loaded.values)
    )
    if not len(fields) == len(norms) == len(forces):
        told = {"n_shapes": len(fields), "n_norms": len(norms), "n_forces": len(forces)}
        raise call.error("operators.matrices.products-do-not-match", **told)
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
