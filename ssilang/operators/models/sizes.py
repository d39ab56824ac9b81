"""TAIL: sizes of the elements of a model."""

from __future__ import annotations

from ssilang.kernel.elements.catalog import ELEMENTS, SOLID_FAMILIES
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.mesh.heights import smallest_lengths
from ssilang.kernel.model import Model
from ssilang.language.call import Call
from ssilang.language.registry import Help, operator


@operator(
    "TAIL",
    family="models",
    full_name="TAILLE",
    help=Help(
        "'DIAMETRE_MIN': the smallest length of each solid element, at its middle, component L: "
        "between two nodes, or from a node to a side that does not hold it. It limits the time "
        "step "
        "of explicit schemes.",
        "'DIAMETRE_MIN' : la plus petite longueur de chaque élément massif, en son centre, "
        "composante L : entre deux noeuds, ou d'un noeud à un côté qui ne le contient pas. Elle "
        "borne le pas de temps des schémas explicites.",
        "MCHAML1 = TAIL 'DIAMETRE_MIN' MODL1 (MCHAML2) ;",
        (
            "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 0.3) ; "
            "LIST (MINI (TAIL 'DIAMETRE_MIN' (MODE S MECANIQUE ELASTIQUE))) ;",
        ),
    ),
    reads_itself=True,
)
def tail(call: Call) -> CellField:
    """Smallest lengths of solid elements."""
    word = call.keyword(("DIAM", "DIRE"))
    model: Model = call.required("MMODEL")
    call.optional("MCHAML")
    if word != "DIAM":
        raise call.bad("only 'DIAMETRE_MIN' is built", model)
    blocks = []
    for zone in model.zones:
        if ELEMENTS[zone.element].family not in SOLID_FAMILIES:
            raise call.bad(f"elements {zone.element} are not solid", model)
        values = smallest_lengths(zone.cells)[:, None]
        blocks.append(CellFieldBlock(zone.cells, {"L": values}, "GRAVITE", zone.element))
    return CellField(tuple(blocks), "CARACTERISTIQUES")
