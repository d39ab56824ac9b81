"""FORM: the coordinates of all nodes, moved by a field and brought back."""

from __future__ import annotations

from dataclasses import dataclass

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.deformed import displacements
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model
from ssilang.language.registry import Help, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.values import register_type
from ssilang.operators.workspace import workspace


@dataclass(frozen=True, eq=False)
class Configuration:
    """Coordinates of all nodes at one time (CONFIGURATION), shape (n, 3)."""

    coordinates: FloatArray


register_type(Configuration, "CONFIGUR")


@operator(
    "FORM",
    opt("start", "CONFIGUR", en="coordinates to begin with", fr="coordonnées de départ"),
    opt("field", "CHPOINT", en="displacements", fr="déplacements", unit="m"),
    opt(
        "axes",
        "MMODEL",
        "MCHAML",
        en="characteristics, refused: their local axes do not follow",
        fr="caractéristiques, refusées : leurs axes locaux ne suivent pas",
    ),
    family="mesh",
    full_name="FORME",
    help=Help(
        en="Moves all nodes: to the coordinates of a configuration if one is given, then by a "
        "field of displacements if one is given. Gives the configuration that is then in force; "
        "alone it only gives the present one.",
        fr="Déplace tous les noeuds : aux coordonnées d'une configuration si elle est donnée, "
        "puis d'un champ de déplacements s'il est donné. Rend la configuration alors en "
        "vigueur ; seul, il rend la configuration présente.",
        syntax="(CONF2 =) FORM (CONF1) (CHPO1) ;",
        examples=(
            "OPTI DIME 2 ; P = 1. 0. ; C = FORM ; FORM (MANU 'CHPO' P 'UX' 2.) ; "
            "LIST (COOR 1 P) ; FORM C ; LIST (COOR 1 P) ;",
        ),
    ),
)
def form(
    call: Call,
    start: Configuration | None,
    field: NodeField | None,
    axes: Model | CellField | None,
) -> Configuration:
    """Move the nodes."""
    nodes = workspace(call.session).nodes
    if axes is not None:
        raise call.error("operators.session.local-axes-kept")
    if start is not None:
        nodes.coordinates[: len(start.coordinates)] = start.coordinates
    if field is not None:
        ids = field.node_ids
        nodes.coordinates[ids] += displacements(nodes, field)[ids]
    return Configuration(nodes.coordinates.copy())
