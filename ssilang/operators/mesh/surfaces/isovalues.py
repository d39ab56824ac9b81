"""ISOV: where a field in cells takes a value."""

from __future__ import annotations

from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.isovalue import isovalue
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.registry import Help, arg, choice, operator
from ssilang.language.vocabulary.terms import ANY_NUMBER

_SIDES = {"EGAL": 0, "EGINFE": -1, "EGSUPE": 1}


@operator(
    "ISOV",
    arg("field", "MCHAML", en="field at nodes, one component"),
    choice(
        "side",
        tuple(_SIDES),
        default="EGAL",
        en="places of the value, the default, or of smaller or larger ones",
    ),
    arg("value", "FLOTTANT", en="value", range=ANY_NUMBER),
    family="mesh",
    full_name="ISOVALEUR",
    help=Help(
        en="Mesh of the places where a field in cells, given at nodes and of one component, takes "
        "a value: points in lines, lines in surfaces, triangles in volumes. With 'EGINFE', "
        "'EGSUPE' the part where it is smaller or equal, larger or equal, cells being cut along "
        "the value. The cells are POI1 SEG2 TRI3 TET4; QUA4 and linear volumes are first cut into "
        "triangles and tetrahedra.",
        syntax="MAIL1 = ISOV CHAM1 ('EGAL'|'EGINFE'|'EGSUPE') FLOT1 ;",
        examples=(
            "OPTI DIME 2 ELEM TRI3 ; S = (DROI 3 (0. 0.) (1. 0.)) TRAN 3 (0. 1.) ; "
            "C = CHAN 'CHAM' (COOR 1 S) S ; MESS (MESU (ISOV C 0.4)) ; "
            "MESS (MESU (ISOV C 'EGINFE' 0.4)) ;",
        ),
    ),
)
def isov(field: CellField, side: str, value: float) -> Mesh:
    """Isovalue, or part on one side of it."""
    return isovalue(field, value, _SIDES[side])
