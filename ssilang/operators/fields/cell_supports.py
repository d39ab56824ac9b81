"""CHAN between supports of fields in cells, REDU and EXTR of models and fields in cells."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

from ssilang.kernel.elements.results.reduction import field_on_mesh, field_on_model, model_on_mesh
from ssilang.kernel.elements.results.supports import (
    cells_of_mesh,
    cells_of_nodal,
    moved,
    nodal_of_cells,
    point_coordinates,
    values_at_points,
)
from ssilang.kernel.fields.cell_field import CellField, Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.run.call import Call
from ssilang.operators.dispatch import CHAN, COOR, REDU
from ssilang.operators.workspace import workspace

SUPPORTS = ("NOEUD", "GRAVITE", "RIGIDITE", "MASSE", "STRESSES")
_EXAMPLE = (
    "OPTI DIME 2 ELEM QUA4 ; L = DROI 2 (0 0) (2 0) ; S = TRAN 1 L (0. 1.) ; "
    "M = MODE S MECANIQUE ELASTIQUE ; A = MATE M 'YOUN' 2.E11 'NU' 0.3 ; "
)


@CHAN.on(
    *SUPPORTS,
    syntax="CHAM2 = CHAN 'NOEUD' | 'GRAVITE' | 'RIGIDITE' | 'MASSE' | 'STRESSES' MODL1 CHAM1 ;",
    en="With a support's name: the field in cells at the nodes, centres or integration points of "
    "the elements, by least squares on their shape functions.",
    fr="Avec un nom de support : le champ par éléments aux noeuds, aux centres ou aux points "
    "d'intégration des éléments, par moindres carrés sur leurs fonctions de forme.",
    examples=(_EXAMPLE + "B = CHAN 'STRESSES' M A ; LIST (TYPE B) ;",),
)
def chan_support(call: Call, word: str) -> CellField:
    """Another support."""
    model, field = _model_and_field(call)
    if not isinstance(field, CellField):
        return cells_of_nodal(model, field, cast(Support, word))
    title = call.word() if call.peek_word() in _TITLES else None
    return moved(model, field, cast(Support, word), title)


def _model_and_field(call: Call) -> tuple[Model, CellField | NodeField]:
    model: Model = call.required("MMODEL")
    operand = call.read("MCHAML", "CHPOINT")
    if operand is None:
        raise call.missing(("MCHAML", "CHPOINT"))
    return model, operand.value


@CHAN.on(
    "CHAM",
    syntax="CHAM1 = CHAN 'CHAM' CHPO1 | GEO1 | MODL1 ('NOEUD' | 'GRAVITE' | ...) (TYP1) ;",
    en="CHAM: the field in cells that a nodal field gives by interpolation, at the nodes (default) "
    "or at the points of a support.",
    fr="CHAM : le champ par éléments qu'un champ par points donne par interpolation, aux noeuds "
    "(par défaut) ou aux points d'un support.",
    examples=(_EXAMPLE + "T = MANU 'CHPO' S 1 'T' 3. ; C = CHAN 'CHAM' T S ; LIST (TYPE C) ;",),
)
def chan_cells(call: Call, word: str) -> CellField:
    """Nodal field to field in cells."""
    operand = call.read("CHPOINT", "MCHAML")
    if operand is None:
        raise call.missing(("CHPOINT", "MCHAML"))
    place = call.read("MMODEL", "MAILLAGE")
    if place is None:
        raise call.missing(("MMODEL", "MAILLAGE"))
    support = cast(Support, call.keyword(SUPPORTS) or "NOEUD")
    title = call.word() if call.peek_word() in _TITLES else None
    if isinstance(place.value, Mesh):
        return cells_of_mesh(place.value, operand.value)
    if isinstance(operand.value, CellField):
        return moved(place.value, operand.value, support, title)
    return cells_of_nodal(place.value, operand.value, support, title or "")


_TITLES = (
    "SCALAIRE", "CONTRAINTES", "DEFORMATIONS", "CARACTERISTIQUES", "TEMPERATURES", "DEPLACEMENTS",
    "FORCES", "GRADIENT", "VARIABLES INTERNES",
)  # fmt: skip


@CHAN.on(
    "CHPO",
    syntax="CHPO1 = CHAN 'CHPO' MODL1 CHAM1 ('MOYE' | 'SOMM' | 'SUPP') ;",
    en="CHPO: the nodal field with, at each node, the mean (or sum) of the values that the cells "
    "around it have there; 'SUPP' makes a new node at each point that carries the field.",
    fr="CHPO : le champ par points ayant, en chaque noeud, la moyenne (ou la somme) des valeurs "
    "qu'y ont les éléments voisins ; 'SUPP' crée un noeud à chaque point support du champ.",
    examples=(_EXAMPLE + "C = CHAN 'CHPO' M A ; LIST (MAXI (EXCO 'NU' C)) ;",),
)
def chan_nodal(call: Call, word: str) -> NodeField:
    """Field in cells to nodal field."""
    model: Any = call.optional("MMODEL")
    operand = call.read("CHPOINT", "MCHAML")
    if operand is None:
        raise call.missing(("MCHAML",))
    model = call.optional("MMODEL") if model is None else model
    rule = call.keyword(["MOYE", "SOMM", "SUPP"]) or "MOYE"
    if isinstance(operand.value, NodeField):
        return operand.value
    if rule == "SUPP":
        return values_at_points(operand.value)
    if model is None:
        raise call.missing(("MMODEL",))
    return nodal_of_cells(model, operand.value, "SOMM" if rule == "SOMM" else "MOYE")


@REDU.on(
    "MMODEL",
    syntax="MODL2 = REDU MODL1 GEO1 ;",
    en="A model restricted to the cells of a mesh.",
    fr="Un modèle réduit aux éléments d'un maillage.",
)
def redu_model(call: Call, model: Model) -> Model | CellField:
    """Model on a mesh; also a field given behind the model."""
    operand = call.read("MAILLAGE", "MCHAML")
    if operand is None:
        raise call.missing(("MAILLAGE",))
    if isinstance(operand.value, CellField):
        return field_on_model(operand.value, model)
    return model_on_mesh(model, operand.value)


@REDU.on(
    "MCHAML",
    syntax="CHAM2 = REDU CHAM1 | GEO1 | MODL1 ;",
    en="A field in cells restricted to the cells of a mesh or model.",
    fr="Un champ par éléments réduit aux éléments d'un maillage ou d'un modèle.",
)
def redu_cells(call: Call, field: CellField) -> CellField:
    """Field in cells on a mesh or model."""
    operand = call.read("MAILLAGE", "MMODEL")
    if operand is None:
        raise call.missing(("MAILLAGE", "MMODEL"))
    if isinstance(operand.value, Mesh):
        return field_on_mesh(field, operand.value)
    return field_on_model(field, operand.value)


@COOR.on(
    "MCHAML",
    syntax="CHAM2 = COOR N1 CHAM1 ; CHAM2 CHAM3 (CHAM4) = COOR CHAM1 ;",
    en="Of a field in cells: the coordinates of the points that it stands on, as fields in cells.",
    fr="D'un champ par éléments : les coordonnées de ses points, en champs par éléments.",
    examples=(_EXAMPLE + "X = COOR 1 (MANU 'CHML' M 'SCAL' 1.) ; LIST (MAXI X) ;",),
)
def coor_cells(call: Call, field: CellField) -> Any:
    """Coordinates as fields in cells."""
    wanted = call.optional("ENTIER")
    dimension = workspace(call.session).dimension
    if wanted is not None and not 1 <= wanted <= dimension:
        raise call.error("operators.fields.no-coordinate", wanted, wanted=wanted)
    where = point_coordinates(field)
    axes = range(dimension) if wanted is None else (wanted - 1,)
    made = tuple(
        CellField(
            tuple(replace(b, components={"SCAL": x[..., axis]}) for b, x in where), "SCALAIRE"
        )
        for axis in axes
    )
    return made[0] if len(made) == 1 else made
