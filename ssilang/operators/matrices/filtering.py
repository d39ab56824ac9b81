"""MFIL: matrices that smooth fields."""

from __future__ import annotations

from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.filtering import filter_weights
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.language.registry import Help, arg, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.vocabulary.terms import NOT_NEGATIVE, POSITIVE


@operator(
    "MFIL",
    arg("weights", "CHPOINT", en="weight of each node"),
    opt("radius", "FLOTTANT", range=POSITIVE, default=0.0, en="radius", unit="m"),
    opt("power", "FLOTTANT", default=1.0, en="power", range=NOT_NEGATIVE),
    opt("least", "FLOTTANT", range=NOT_NEGATIVE, default=0.0, en="least weight kept"),
    opt("unknown", "MOT", kind="component", en="unknown, else SCAL"),
    opt("dual", "MOT", kind="component", en="dual, else the same"),
    family="matrix",
    help=Help(
        en="Matrix whose product with a nodal field smooths it: each node takes the mean of its "
        "neighbours nearer than X1, weighed by (1 - d / X1) ** X2 and by the field CHPO1 (the "
        "nodes' volumes, say); weights not above X3 are dropped. The words name the unknown "
        "(SCAL) and the dual (the same).",
        syntax="RIG1 = MFIL CHPO1 (X1 (X2 (X3))) (MOT1 (MOT2)) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (4. 0.) ; X = COOR 1 L ; "
            "W = MANU 'CHPO' L 1 'SCAL' 1. ; LIST ((MFIL W 1.5) * (X * X)) ;",
        ),
    ),
)
def mfil(
    call: Call,
    weights: NodeField,
    radius: float,
    power: float,
    least: float,
    unknown: str | None,
    dual: str | None,
) -> Matrix:
    """Weights of a filter."""
    if radius < 0.0:
        raise call.error("operators.matrices.filter-radius-negative", radius, radius=radius)
    name = "SCAL" if unknown is None else unknown.rstrip()
    return filter_weights(
        weights, radius, power, least, name, name if dual is None else dual.rstrip()
    )
