"""MANU 'CHPO' and 'CHML', RESU, XTY, XTX, COMB: fields from values, sums over fields."""

from __future__ import annotations

from typing import Any, cast

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.elements.zone_fields import n_points
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.fields.node_field import Nature, NodeField, NodeValues
from ssilang.kernel.materials.model import Model
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.language.registry import (
    Help,
    arg,
    choice,
    each,
    flag,
    key,
    main,
    many,
    operator,
    opt,
    said,
)
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListEnti, ListMots, ListReel, Table
from ssilang.operators.dispatch import MANU
from ssilang.operators.fields.components import NATURE, support_nodes
from ssilang.operators.fields.signs import names_of, nature_of, paired_names

_SUPPORTS = ("NOEUD", "GRAVITE", "RIGIDITE", "MASSE", "STRESSES")


_TITLE = key("title", "TITRE", arg("text", "MOT"), en="title of the field", fr="titre du champ")
_ON_NODES = arg(
    "support",
    "MAILLAGE",
    "POINT",
    en="mesh or point that carries the field",
    fr="maillage ou point qui porte le champ",
)


@MANU.form(
    said("CHPO"),
    _TITLE,
    NATURE,
    opt("count", "ENTIER", en="number of pairs", fr="nombre de couples"),
    _ON_NODES,
    each(
        "pairs",
        arg("component", "MOT", en="name of a component", fr="nom d'une composante"),
        arg(
            "value",
            "FLOTTANT",
            "LISTREEL",
            en="its value, or one value a point",
            fr="sa valeur, ou une valeur par point",
        ),
        at_least=1,
        times="count",
    ),
    syntax="CHPO1 = MANU 'CHPO' GEO1 (N1) MOT1 VAL1 MOT2 VAL2 ... ('TITRE' MOT3) ('NATURE' MOT4) ;",
    en="CHPO: field at the nodes of a mesh or at a point; a value is a number or, on a mesh of "
    "points, a list with one value a point. Words after the last pair need N1, the number of "
    "pairs.",
    fr="CHPO : champ par points aux noeuds d'un maillage ou en un point ; une valeur est un nombre "
    "ou, sur un maillage de points, une liste d'une valeur par point. Des mots après le dernier "
    "couple demandent N1, le nombre de couples.",
    examples=("OPTI DIME 2 ; P = 0. 0. ; LIST (MANU 'CHPO' P 'UX' 3. 'UY' 4.) ;",),
)
def node_field(
    call: Call,
    title: str | None,
    nature: str | None,
    count: int | None,
    support: Point | Mesh,
    pairs: list[tuple[str, Any]],
) -> NodeField:
    """Field at nodes from pairs of a component and its value."""
    named = [(name.rstrip()[:8], value) for name, value in pairs]
    return _on_nodes(call, support, named, nature_of(call, nature) or "", title or "")


@MANU.form(
    said("CHPO"),
    _TITLE,
    NATURE,
    _ON_NODES,
    arg("names", "LISTMOTS", en="names of the components", fr="noms des composantes"),
    arg(
        "values",
        "LISTREEL",
        en="their values, 0 for those behind the last",
        fr="leurs valeurs, 0 pour celles qui manquent",
    ),
    syntax="CHPO1 = MANU 'CHPO' GEO1 LMOT1 LREE1 ('TITRE' MOT3) ('NATURE' MOT4) ;",
)
def node_field_of_lists(
    call: Call,
    title: str | None,
    nature: str | None,
    support: Point | Mesh,
    names: ListMots,
    values: ListReel,
) -> NodeField:
    """Field at nodes, the same value everywhere, from lists of components and values."""
    given = values.values.tolist()
    pairs = [(n, given[i] if i < len(given) else 0.0) for i, n in enumerate(names_of(names))]
    return _on_nodes(call, support, pairs, nature_of(call, nature) or "", title or "")


def _on_nodes(
    call: Call, support: Point | Mesh, pairs: list[tuple[str, Any]], nature: Nature, title: str
) -> NodeField:
    nodes = support_nodes(support)
    made: dict[str, NodeValues] = {}
    for name, value in pairs:
        listed = isinstance(value, ListReel)
        if listed and len(value) != len(nodes):
            raise call.error(
                "operators.fields.values-per-point", value, n_values=len(value), n_nodes=len(nodes)
            )
        values = value.values if listed else np.full(len(nodes), float(value))
        part = _merged(call, name, nodes, values, nature)
        made[name] = part
    return NodeField(support.nodes, made, nature, title)


def _merged(
    call: Call, name: str, nodes: IntArray, values: FloatArray, nature: Nature
) -> NodeValues:
    """Values of repeated nodes: summed when DISCRET, else they must be equal."""
    ids, first, place = np.unique(nodes, return_index=True, return_inverse=True)
    if len(ids) == len(nodes):
        return NodeValues(ids, values[first])
    if nature == "DISCRET":
        return NodeValues(ids, np.bincount(place, weights=values).astype(float))
    if nature == "DIFFUS" and np.any(values != values[first][place]):
        raise call.error("operators.fields.node-twice-with-other-values", name=name)
    return NodeValues(ids, values[first])


# ---- in cells -----------------------------------------------------------------------------------


@MANU.form(
    said("CHML", "CHAM"),
    arg(
        "support",
        "MAILLAGE",
        "MMODEL",
        en="mesh or model that carries the field",
        fr="maillage ou modèle qui porte le champ",
    ),
    key("title", "TYPE", arg("word", "MOT"), en="sub-type of the field", fr="sous-type du champ"),
    key("constituent", "CONS", arg("word", "MOT"), en="constituent", fr="constituant"),
    key("position", "POSI", arg("word", "MOT"), en="points: NOEUD ...", fr="points : NOEUD ..."),
    flag(
        "deal",
        "REPA",
        en="the values of a list are dealt out, one a cell",
        fr="les valeurs d'une liste sont distribuées, une par élément",
    ),
    choice(
        "points",
        ("NOEUD", "GRAVITE", "STRESSES"),
        en="points that carry the values",
        fr="points qui portent les valeurs",
    ),
    choice(
        "integration",
        ("RIGIDITE", "MASSE"),
        length=8,
        en="points that carry the values",
        fr="points qui portent les valeurs",
    ),
    each(
        "pairs",
        arg("component", "MOT", en="name of a component", fr="nom d'une composante"),
        arg("value", en="its value or object", fr="sa valeur ou son objet"),
        at_least=1,
    ),
    many(
        "place",
        "FLOTTANT",
        en="of a field that is zero but at one point, whose cell was the value: number of the "
        "point, of the zone if not 1, then the value",
        fr="d'un champ nul sauf en un point, dont l'élément était la valeur : numéro du point, de "
        "la zone si ce n'est 1, puis la valeur",
    ),
    syntax="CHAM1 = MANU 'CHML' GEO1 | MODL1 ('REPA') MOT1 VAL1 MOT2 VAL2 ... ('TYPE' MOT3) "
    "('CONS' MOT4) ('NOEUD' | 'GRAVITE' | 'RIGIDITE' | 'MASSE' | 'STRESSES') ;\n"
    "CHAM1 = MANU 'CHAM' MODL1 ('TYPE' MOT1) ('POSI' MOT2) MOT3 CELL1 POINT1 (ZONE1) VAL1 ;",
    en="CHML: field in the cells of a mesh or model; values are numbers or objects, constant in "
    "the cells; 'REPA' deals the values of a list out, one a cell. On a model also: zero "
    "everywhere but at one point of one cell.",
    fr="CHML : champ par éléments sur un maillage ou un modèle ; les valeurs sont des nombres ou "
    "des objets, constants par élément ; 'REPA' distribue les valeurs d'une liste, une par "
    "élément. Sur un modèle aussi : nul partout sauf en un point d'un élément.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; "
        "LIST (MAXI (MANU 'CHML' L 'SCAL' 3.)) ;",
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; "
        "MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
        "LIST (MAXI (MANU 'CHAM' MO 'POSI' 'GRAVITE' 'V' 2 1 7.)) ;",
    ),
)
def cell_field(
    call: Call,
    support: Mesh | Model,
    title: str | None,
    constituent: str | None,
    position: str | None,
    deal: bool,
    points: str | None,
    integration: str | None,
    pairs: list[tuple[str, Any]],
    place: tuple[float, ...],
) -> CellField:
    """Field in cells from pairs of a component and its value, or zero but at one point."""
    at = points or integration or (position or "NOEUD").rstrip()
    if at not in _SUPPORTS:
        raise call.error("operators.fields.no-support", support=at, supports=_SUPPORTS)
    points_at, kind = cast(Support, at), (title or "").rstrip()
    named = [(name.rstrip(), value) for name, value in pairs]
    if place:
        name, cell = named[-1]
        return _at_one_point(call, support, name, (cell, *place), points_at, kind)
    said = None if constituent is None else constituent.rstrip()
    return _in_cells(support, named, points_at, kind, said, deal)


def _at_one_point(
    call: Call,
    model: Mesh | Model,
    name: str,
    numbers: tuple[Any, ...],
    at: Support,
    title: str,
) -> CellField:
    """Zero but at one point: numbers of cell, point (and zone), then the value."""
    whole = all(float(n).is_integer() for n in numbers[:-1] if isinstance(n, int | float))
    if not isinstance(model, Model) or len(numbers) not in (3, 4) or not whole:
        raise call.error("operators.fields.one-point-field-needs")
    cell, point = int(numbers[0]), int(numbers[1])
    number = int(numbers[2]) if len(numbers) == 4 else 1
    if not 1 <= number <= len(model.zones):
        raise call.error(
            "operators.fields.model-has-no-such-zone", n_zones=len(model.zones), zone=number
        )
    zone = model.zones[number - 1]
    shape = (len(zone.cells), n_points(zone.element, at))
    if not (1 <= cell <= shape[0] and 1 <= point <= shape[1]):
        raise call.error(
            "operators.fields.zone-has-no-such-point", n_cells=shape[0], n_points=shape[1]
        )
    values = np.zeros(shape)
    values[cell - 1, point - 1] = float(numbers[-1])
    element = "" if at == "NOEUD" else zone.element
    block = CellFieldBlock(zone.cells, {name: values}, at, element, zone.constituent)
    return CellField((block,), title)


def _in_cells(
    support: Mesh | Model,
    pairs: list[tuple[str, Any]],
    at: Support,
    title: str,
    named: str | None,
    deal: bool,
) -> CellField:
    blocks = []
    zones: list[tuple[CellBlock, str, str]]
    if isinstance(support, Model):
        zones = [(z.cells, z.element, z.constituent) for z in support.zones]
    else:
        zones = [(cells, "", "") for cells in support.blocks]
        at = "NOEUD"
    taken = 0
    for cells, element, constituent in zones:
        made = {n: _cell_values(v, len(cells), deal, taken) for n, v in pairs}
        taken += len(cells)
        said = constituent if named is None else named
        blocks.append(CellFieldBlock(cells, made, at, element if at != "NOEUD" else "", said))
    return CellField(tuple(blocks), title)


def _cell_values(value: Any, n: int, deal: bool, taken: int) -> Any:
    if isinstance(value, bool):
        value = 1.0 if value else 2.0
    if isinstance(value, int | float):
        return np.full((n, 1), float(value))
    if deal and isinstance(value, ListReel) and len(value):
        return value.values[(taken + np.arange(n)) % len(value)][:, None]
    made = np.empty((n, 1), dtype=object)
    made[:, 0] = [value] * n
    return made


# ---- measures -----------------------------------------------------------------------------------


@operator(
    "RESU",
    arg("field", "CHPOINT", en="forces, say", fr="des forces, par exemple"),
    family="fields",
    full_name="RESULT",
    help=Help(
        en="Resultant of a field at nodes: its first point with the sum of each component. "
        "The sum of a list is SOMM's.",
        fr="Résultante d'un champ par points : son premier point avec les sommes des "
        "composantes. La somme d'une liste est l'affaire de SOMM.",
        syntax="CHPO2 = RESU CHPO1 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; LIST (MAXI (RESU (COOR 1 L))) ;",
            "LIST (RESU (PROG 1. 2. 4.)) ;",
        ),
    ),
)
def resu(call: Call, field: NodeField) -> NodeField:
    """Sum components over nodes."""
    nodes = field.node_ids
    if not len(nodes):
        raise call.error("operators.fields.field-empty", field)
    here = nodes[:1]
    made = {k: NodeValues(here, np.asarray([v.values.sum()])) for k, v in field.components.items()}
    return NodeField(field.table, made, "DISCRET")


@resu.form(
    arg("values", "LISTREEL", "LISTENTI", en="numbers to sum", fr="nombres à sommer"),
    gives="FLOTTANT|ENTIER",
)
def resu_of_list(values: ListReel | ListEnti) -> float | int:
    """Sum of a list."""
    total: float | int = values.values.sum()
    return total


_PAIRED = (
    arg("left", "LISTMOTS", en="components of the first", fr="composantes du premier"),
    arg(
        "right",
        "LISTMOTS",
        en="components of the second, paired with them",
        fr="composantes du second, appariées",
    ),
)


@operator(
    "XTY",
    arg("first", "CHPOINT", en="first field", fr="premier champ"),
    arg("second", "CHPOINT", en="second field", fr="second champ"),
    *_PAIRED,
    family="fields",
    help=Help(
        en="Sum over all nodes of the products of paired components of two fields; of two lists "
        "of fields, a list.",
        fr="Somme sur tous les noeuds des produits de composantes appariées de deux champs ; de "
        "deux listes de champs, une liste.",
        syntax="X1 = XTY CHPO1 CHPO2 LMOT1 LMOT2 ; LREE1 = XTY LCHP1 LCHP2 LMOT1 LMOT2 ;",
        examples=(
            "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'UX' 3. 'UY' 4. ; "
            "LIST (XTY C C (MOTS 'UX' 'UY') (MOTS 'UX' 'UY')) ;",
            (
                "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'T' 5. ;\n"
                "D = MANU 'CHPO' P 'T' 2. ; L = MOTS 'T' ;\n"
                "LIST (XTY (SUIT C D) (SUIT D D) L L) ;"
            ),
        ),
    ),
)
def xty(call: Call, first: NodeField, second: NodeField, left: ListMots, right: ListMots) -> float:
    """Scalar product of fields."""
    return _product(first, second, *paired_names(call, left, right))


@xty.form(
    arg("first", "LISTCHPO", en="first fields", fr="premiers champs"),
    arg("second", "LISTCHPO", en="as many second fields", fr="autant de seconds champs"),
    *_PAIRED,
)
def xty_of_lists(
    call: Call, first: ListChpo, second: ListChpo, left: ListMots, right: ListMots
) -> ListReel:
    """Scalar products of the fields of two lists."""
    names = paired_names(call, left, right)
    if len(first) != len(second):
        raise call.error(
            "operators.fields.field-counts-differ", second, n_first=len(first), n_second=len(second)
        )
    pairs: Any = zip(first.values, second.values, strict=True)
    return ListReel([_product(a, b, *names) for a, b in pairs])


def _product(a: NodeField, b: NodeField, left: list[str], right: list[str]) -> float:
    return float(node_algebra.scalar_product(a, b, left, right).values.sum())


_FACTORS = (
    opt("a", "FLOTTANT", en="factor of the first field", fr="facteur du premier champ"),
    opt("b", "FLOTTANT", en="factor of the second field", fr="facteur du second champ"),
)


@operator(
    "XTX",
    main("first", "CHPOINT", en="field", fr="champ"),
    opt("second", "CHPOINT", en="field to add", fr="champ à ajouter"),
    *_FACTORS,
    family="fields",
    help=Help(
        en="Sum of the squares of all values of a field, or of X1 CHP1 + X2 CHP2.",
        fr="Somme des carrés de toutes les valeurs d'un champ, ou de X1 CHP1 + X2 CHP2.",
        syntax="X3 = XTX CHP1 ; X3 = XTX X1 CHP1 X2 CHP2 ;",
        examples=(
            "OPTI DIME 2 ; P = 0. 0. ; LIST (XTX (MANU 'CHPO' P 'UX' 3. 'UY' 4.)) ;",
            (
                "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
                "M = MODE ((DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.)) 'MECANIQUE' 'ELASTIQUE' ;\n"
                "LIST (XTX (MANU 'CHML' M 'SCAL' 3.)) ;"
            ),
        ),
    ),
)
def xtx(
    call: Call, first: NodeField, second: NodeField | None, a: float | None, b: float | None
) -> float:
    """Square norm of fields at nodes."""
    if second is not None:
        first = _weighted_sum(call, node_algebra, first, second, a, b)
    return float(sum(v.values @ v.values for v in first.components.values()))


@xtx.form(
    main("first", "MCHAML", en="field", fr="champ"),
    opt("second", "MCHAML", en="field to add", fr="champ à ajouter"),
    *_FACTORS,
)
def xtx_in_cells(
    call: Call, first: CellField, second: CellField | None, a: float | None, b: float | None
) -> float:
    """Square norm of fields in cells."""
    if second is not None:
        first = _weighted_sum(call, cell_algebra, first, second, a, b)
    return float(sum((v * v).sum() for v in cell_algebra.values_of(first)))


def _weighted_sum(
    call: Call, algebra: Any, first: Any, second: Any, a: float | None, b: float | None
) -> Any:
    if a is None or b is None:
        raise call.missing(("FLOTTANT",))
    return algebra.added(algebra.applied(first, lambda v: v * a), second, b)


@operator(
    "COMB",
    flag(
        "alike",
        "SEMBLABLE",
        en="the fields have the same nodes and components",
        fr="les champs ont les mêmes noeuds et composantes",
    ),
    arg("weights", "CHPOINT", en="coefficients, one component", fr="coefficients, une composante"),
    arg("table", "TABLE", en="fields by point", fr="champs par point"),
    family="fields",
    full_name="COMBTABLE",
    help=Help(
        en="Linear combination of the fields of a table indexed by points, with the values of a "
        "field with one component as coefficients.",
        fr="Combinaison linéaire des champs d'une table indicée par des points, les coefficients "
        "étant les valeurs d'un champ à une composante.",
        syntax="CHPO1 = COMB ('SEMBLABLE') CHPO2 TAB1 ;",
        examples=(
            "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; T = TABL ; T . P = MANU 'CHPO' P 'UX' 3. ; "
            "T . Q = MANU 'CHPO' P 'UX' 5. ; A = MANU 'CHPO' (P ET Q) 'ALFA' 2. ; "
            "LIST (MAXI (COMB A T)) ;",
        ),
    ),
)
def comb(call: Call, alike: bool, weights: NodeField, table: Table) -> NodeField:
    """Combine fields."""
    if len(weights.components) != 1:
        raise call.error("operators.fields.coefficients-have-one-component", weights)
    (part,) = weights.components.values()
    total: NodeField | None = None
    for index, field in table.items():
        if isinstance(index, Point) and isinstance(field, NodeField):
            factor = float(part.at(np.asarray([index.node]))[0])
            empty = node_algebra.rebuilt(field, {})
            total = node_algebra.added(empty if total is None else total, field, factor)
    if total is None:
        raise call.error("operators.fields.table-without-point-fields", table)
    return total
