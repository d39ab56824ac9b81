"""EXCO NOMC MANU CHAN EXTR REDU ENLE COPI on fields: components, supports, natures."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListMots, ListReel, Mot
from ssilang.operators.dispatch import CHAN, COPI, ENLE, EXTR, REDU
from ssilang.operators.fields.signs import names_of, nature_word, read_nature

_FIELDS = ("CHPOINT", "MCHAML")
_LAGRANGE = frozenset({"LX", "FLX"})
_POINT_FIELD = "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'UX' 3. 'UY' 4. ; "


def with_nature(call: Call, field: NodeField) -> NodeField:
    """The field with the nature that 'NATURE' says, if it stands there."""
    nature = read_nature(call)
    return field if nature is None else node_algebra.rebuilt(field, field.components, nature)


@operator(
    "EXCO",
    family="fields",
    full_name="EXCO",
    help=Help(
        en="Field of some components, under new names if they are given (one component of a field "
        "at nodes is called SCAL without). 'NOID': a missing component is no error.",
        fr="Champ de certaines composantes, sous de nouveaux noms s'ils sont donnés (sinon, "
        "l'unique composante d'un champ par points s'appelle SCAL). 'NOID' : une composante "
        "absente n'est pas une erreur.",
        syntax="CHP2 = EXCO MOT1 | LMOT1 ('NOID') CHP1 (MOT2 | LMOT2) ('NATURE' MOT3) ;",
        examples=(_POINT_FIELD + "LIST (EXCO 'UX' C) ;",),
    ),
    reads_itself=True,
)
def exco(call: Call) -> Any:
    """Extract components."""
    wanted = call.read("MOT", "LISTMOTS")
    if wanted is None:
        raise call.missing(("MOT", "LISTMOTS"))
    lenient = call.keyword(("NOID",)) is not None
    field = call.required(*_FIELDS)
    lenient = lenient or call.keyword(("NOID",)) is not None
    nature = read_nature(call) if isinstance(field, NodeField) else None
    new = call.read("LISTMOTS") if isinstance(wanted.value, ListMots) else call.read("MOT")
    old = names_of(wanted.value)
    if new is not None:
        names = names_of(new.value)
    else:
        single = isinstance(wanted.value, str) and isinstance(field, NodeField)
        names = ["SCAL"] if single else old
    if len(names) != len(old):
        raise call.error(
            "operators.fields.new-name-count",
            new.value if new else None,
            n_old=len(old),
            n_new=len(names),
        )
    if isinstance(field, CellField):
        return cell_algebra.extracted(field, old, names, not lenient)
    nature = read_nature(call) if nature is None else nature
    made: dict[str, NodeValues] = {}
    for name, target in zip(old, names, strict=True):
        if name in field.components or not lenient:
            made[target] = node_algebra.component(field, name)
    return node_algebra.rebuilt(field, made, nature)


def _rename(call: Call) -> Any:
    first = call.read("MOT", "LISTMOTS")
    field = call.required(*_FIELDS)
    if first is None:
        first = call.read("MOT", "LISTMOTS")
    if first is None:
        raise call.missing(("MOT", "LISTMOTS"))
    node = isinstance(field, NodeField)
    known = list(field.components) if node else cell_algebra.component_names(field)
    if isinstance(first.value, ListMots):
        old, new = names_of(first.value), names_of(call.required("LISTMOTS"))
        if len(old) != len(new):
            raise call.error(
                "operators.fields.renamed-name-count", first.value, n_old=len(old), n_new=len(new)
            )
    else:
        if len(known) > 1:
            raise call.error(
                "operators.fields.one-name-not-enough", first.value, n_known=len(known)
            )
        old, new = known, [str(first.value).rstrip()] * len(known)
    if node:
        return with_nature(call, node_algebra.renamed(field, old, new))
    return cell_algebra.renamed(field, old, new)


@operator(
    "NOMC",
    family="fields",
    help=Help(
        en="Field with other names of components: one name for a single component, or a list of "
        "old names and a list of new ones.",
        fr="Champ aux composantes renommées : un nom pour une composante unique, ou une liste "
        "d'anciens noms et une liste de nouveaux.",
        syntax="CHP2 = NOMC MOT1 | (LMOT1 LMOT2) CHP1 ('NATURE' MOT3) ;",
        examples=(_POINT_FIELD + "LIST (NOMC (MOTS 'UX') (MOTS 'FX') C) ;",),
    ),
    reads_itself=True,
)
def nomc(call: Call) -> Any:
    """Rename components."""
    return _rename(call)


@CHAN.on(
    "COMP",
    of=_FIELDS,
    syntax="CHP2 = CHAN 'COMP' MOT1 | (LMOT1 LMOT2) CHP1 ('NATU' MOT3) ;",
    en="COMP changes names of components, as NOMC does.",
    fr="COMP change des noms de composantes, comme NOMC.",
)
def _change_names(call: Call, word: str) -> Any:
    return _rename(call)


@CHAN.on(
    "ATTR",
    syntax="CHPO2 = CHAN 'ATTRIBUT' CHPO1 'NATURE' 'INDETER' | 'DIFFUS' | 'DISCRET' ;",
    en="ATTRIBUT changes the nature of a field at nodes.",
    fr="ATTRIBUT change la nature d'un champ par points.",
    examples=(_POINT_FIELD + "D = CHAN 'ATTRIBUT' C 'NATURE' 'DISCRET' ; MESS (EXTR D 'NATU') ;",),
)
def _change_nature(call: Call, word: str) -> NodeField:
    return with_nature(call, call.required("CHPOINT"))


@CHAN.on(
    "TITR",
    of=("CHPOINT",),
    syntax="CHPO2 = CHAN 'TITRE' CHPO1 MOT1 ;",
    en="TITRE changes the title of a field at nodes.",
    fr="TITRE change le titre d'un champ par points.",
)
def _change_title(call: Call, word: str) -> NodeField:
    field: NodeField = call.required("CHPOINT")
    return NodeField(field.table, field.components, field.nature, str(call.required("MOT")))


@CHAN.on(
    "TYPE",
    of=("MCHAML",),
    syntax="CHAM2 = CHAN 'TYPE' CHAM1 MOT1 ;",
    en="TYPE changes the sub-type of a field in cells.",
    fr="TYPE change le sous-type d'un champ par éléments.",
)
def _change_type(call: Call, word: str) -> CellField:
    field: CellField = call.required("MCHAML")
    return CellField(field.blocks, str(call.required("MOT")).rstrip())


@CHAN.on(
    "CONS",
    of=("MCHAML",),
    syntax="CHAM2 = CHAN 'CONS' CHAM1 MOT1 ;",
    en="CONS changes the constituent of a field in cells.",
    fr="CONS change le constituant d'un champ par éléments.",
)
def _change_constituent(call: Call, word: str) -> CellField:
    field: CellField = call.required("MCHAML")
    name = str(call.required("MOT")).rstrip()
    blocks = tuple(
        CellFieldBlock(b.cells, b.components, b.support, b.element, name) for b in field.blocks
    )
    return CellField(blocks, field.title)


# ---- EXTR ---------------------------------------------------------------------------------------


def support_nodes(support: Point | Mesh) -> IntArray:
    """Nodes of a point or a mesh, in order; those of a mesh of points as they stand."""
    if isinstance(support, Point):
        return np.asarray([support.node])
    if all(b.cell_type == "POI1" for b in support.blocks) and support.blocks:
        return np.concatenate([b.connectivity[:, 0] for b in support.blocks])
    return support.node_ids


@EXTR.on(
    "CHPOINT",
    syntax="X1 = EXTR CHPO1 MOT1 POIN1 ; LREE1 = EXTR CHPO1 'VALE' (MOT1 | LMOT1) (POIN1 | GEO1) "
    "('NOID') ;\nMAIL1 = EXTR CHPO1 'MAIL' ('NOMU') ; LMOT1 = EXTR CHPO1 'COMP' ; "
    "MOT1 = EXTR CHPO1 'TITR' | 'TYPE' | 'NATU' ;",
    en="Of a field at nodes: a value at a point (0. outside of its support), values as a list (in "
    "the order of the points of a mesh), its mesh of points, names of components, title, type, "
    "nature.",
    fr="D'un champ par points : une valeur en un point (0. hors de son support), des valeurs en "
    "liste (dans l'ordre des points d'un maillage), son maillage de points, noms des composantes, "
    "titre, type, nature.",
    examples=(_POINT_FIELD + "LIST (EXTR C 'UY' P) ; LIST (EXTR C 'VALE' 'UX') ;",),
)
def _extract(call: Call, field: NodeField) -> Any:
    point = call.read("POINT")
    said = call.peek_word()
    key = "" if said is None else said.rstrip()
    word = None
    if key not in field.components:
        word = call.keyword(("VALE", "MAIL", "COMP", "TITR", "TYPE", "NATU"))
    if word is None:
        name = str(call.required("MOT")).rstrip()
        place = point or call.read("POINT")
        if place is None:
            raise call.missing(("POINT",))
        return _value_at(field, name, place.value)
    if word == "VALE":
        return _values(call, field, None if point is None else point.value)
    if word == "MAIL":
        return _points_of(field, call.keyword(("NOMU",)) is not None)
    if word == "COMP":
        return ListMots(list(field.components))
    return Mot({"TITR": field.title, "TYPE": " " * 8, "NATU": nature_word(field.nature)}[word])


def _value_at(field: NodeField, name: str, point: Point) -> float:
    """The value at a point, 0. outside of the field's support, as for a list of values."""
    part = node_algebra.component(field, name)
    if point.node not in part.nodes:
        return 0.0
    return float(part.at(np.asarray([point.node]))[0])


def _points_of(field: NodeField, without_multipliers: bool) -> Mesh:
    parts = [
        p.nodes for k, p in field.components.items() if not (without_multipliers and k in _LAGRANGE)
    ]
    nodes = np.unique(np.concatenate(parts)) if parts else np.empty(0, dtype=np.int64)
    return Mesh.of(field.table, "POI1", nodes[:, None])


def _values(call: Call, field: NodeField, support: Any) -> ListReel:
    lenient = call.keyword(("NOID",)) is not None
    operand = call.read("LISTMOTS", "MOT")
    if support is None:
        support = call.optional("POINT", "MAILLAGE")
    if operand is None:
        operand = call.read("LISTMOTS", "MOT")
    lenient = lenient or call.keyword(("NOID",)) is not None
    names = list(field.components) if operand is None else names_of(operand.value)
    if not lenient:
        for name in names:
            node_algebra.component(field, name)
    nodes = None if support is None else support_nodes(support)
    return ListReel(node_algebra.values_in_order(field, names, nodes))


# ---- REDU, ENLE, COPI ---------------------------------------------------------------------------


@REDU.on(
    "CHPOINT",
    syntax="CHPO2 = REDU CHPO1 MAIL1 | POIN1 | CHPO3 ;",
    en="Of a field at nodes: the part on the points of a mesh, on a point, or where another field "
    "has a value other than zero.",
    fr="D'un champ par points : la partie portée par les points d'un maillage, par un point, ou "
    "là où un autre champ n'est pas nul.",
    examples=(_POINT_FIELD + "LIST (REDU C P) ;",),
)
def _reduce(call: Call, field: NodeField) -> NodeField:
    operand = call.read("MAILLAGE", "POINT", "CHPOINT")
    if operand is None:
        raise call.missing(("MAILLAGE", "POINT", "CHPOINT"))
    support = operand.value
    if not isinstance(support, NodeField):
        return node_algebra.restricted(field, support_nodes(support))
    kept = [v.nodes[v.values != 0] for v in support.components.values()]
    nodes = np.concatenate(kept) if kept else np.empty(0, dtype=np.int64)
    return node_algebra.restricted(field, nodes)


@ENLE.on(
    "CHPOINT",
    syntax="CHPO2 = ENLE CHPO1 MOT1 | LMOT1 ;",
    en="Of a field at nodes: without some components.",
    fr="D'un champ par points : sans certaines composantes.",
    examples=(_POINT_FIELD + "LIST (ENLE C 'UX') ;",),
)
def _without(call: Call, field: NodeField) -> NodeField:
    operand = call.read("MOT", "LISTMOTS")
    if operand is None:
        raise call.missing(("MOT", "LISTMOTS"))
    gone = set(names_of(operand.value))
    return node_algebra.rebuilt(field, {k: v for k, v in field.components.items() if k not in gone})


@COPI.on("CHPOINT", "MCHAML", en="Of a field: a field with the same values.")
def _copy(call: Call, field: Any) -> Any:
    call.keyword(("GEOM",))
    if isinstance(field, NodeField):
        return node_algebra.rebuilt(field, dict(field.components))
    return CellField(field.blocks, field.title)
