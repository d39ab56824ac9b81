"""ZGAM: the largest shear strains behind the procedure ISSLEQ."""

from __future__ import annotations

from typing import cast

from ssilang.kernel.elements.results.shear_history import largest_shear_strain
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model
from ssilang.language.registry import Help, arg, operator
from ssilang.language.values import ListChpo


@operator(
    "ZGAM",
    arg("model", "MMODEL", en="model", fr="modèle"),
    arg("motion", "LISTCHPO", en="displacements", fr="déplacements"),
    family="dynamics",
    help=Help(
        en="Largest shear strain over a list of displacements, at the centres of solid cells, for "
        "ISSLEQ: square root of twice e:e, e being the deviator of the strain.",
        fr="Plus grande distorsion sur une liste de déplacements, aux centres d'éléments massifs, "
        "pour ISSLEQ : racine de deux fois e:e, e étant le déviateur de la déformation.",
        syntax="CHAM1 = ZGAM MODL1 LCHP1 ;",
        examples=(
            "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; S = TRAN 1 (DROI 1 (0. 0.) (1. 0.)) (0. 1.) ; "
            "M = MODE S MECANIQUE ELASTIQUE ; U = NOMC 'UX' ((COOR 2 S) * 3.E-3) ; "
            "LIST (MAXI (ZGAM M (SUIT (U * -2.) U))) ;",
        ),
    ),
)
def zgam(model: Model, motion: ListChpo) -> CellField:
    """Largest strain zone by zone."""
    fields = cast("list[NodeField]", motion.values)
    return CellField(tuple(largest_shear_strain(z, fields) for z in model.zones), "SCALAIRE")
