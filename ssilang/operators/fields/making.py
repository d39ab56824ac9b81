"""MANU 'CHPO' and 'CHML', RESU, XTY, XTX, COMB: fields from values, sums over fields."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.elements.zone_fields import n_points
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import Nature, NodeField, NodeValues
from ssilang.kernel.materials.model import Model
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListReel, Table, type_of
from ssilang.operators.dispatch import MANU
from ssilang.operators.fields.parts import support_nodes
from ssilang.operators.fields.signs import names_of, read_nature

_SUPPORTS = ("NOEUD", "GRAVITE", "RIGIDITE", "MASSE", "STRESSES")


@MANU.on(
    "CHPO",
    syntax="CHPO1 = MANU 'CHPO' GEO1 (N1) MOT1 VAL1 MOT2 VAL2 ... ('TITRE' MOT3) "
    "('NATURE' MOT4) ;\n"
    "CHPO1 = MANU 'CHPO' GEO1 LMOT1 LREE1 ('TITRE' MOT3) ('NATURE' MOT4) ;",
    en="CHPO: field at the nodes of a mesh or at a point; a value is a number or, on a mesh of "
    "points, a list with one value a point. Words after the last pair need N1, the number of "
    "pairs.",
    fr="CHPO : champ par points aux noeuds d'un maillage ou en un point ; une valeur est un nombre "
    "ou, sur un maillage de points, une liste d'une valeur par point. Des mots après le dernier "
    "couple demandent N1, le nombre de couples.",
    examples=("OPTI DIME 2 ; P = 0. 0. ; LIST (MANU 'CHPO' P 'UX' 3. 'UY' 4.) ;",),
)
def _node_field(call: Call, word: str) -> NodeField:
    title, nature = _title_and_nature(call, "", None)
    support: Any = None
    count = call.read("ENTIER")
    operand = call.read("MAILLAGE", "POINT")
    if operand is None:
        raise call.missing(("MAILLAGE", "POINT"))
    support = operand.value
    if count is None and call.operands and type(call.operands[0].value) is int:
        count = call.read("ENTIER")
    lists = call.read("LISTMOTS")
    if lists is not None:
        values = call.required("LISTREEL").values.tolist()
        names = names_of(lists.value)
        pairs: list[tuple[str, Any]] = [
            (n, values[i] if i < len(values) else 0.0) for i, n in enumerate(names)
        ]
    else:
        pairs = _pairs(call, None if count is None else count.value)
    title, nature = _title_and_nature(call, title, nature)
    return _on_nodes(call, support, pairs, nature or "", title)


def _title_and_nature(call: Call, title: str, nature: Nature | None) -> tuple[str, Nature | None]:
    while True:
        said = call.peek_word()
        if said is not None and said[:4] == "TITR":
            call.word()
            title = str(call.required("MOT"))
        elif said is not None and said[:4] == "NATU":
            nature = read_nature(call)
        else:
            return title, nature


def _pairs(call: Call, count: int | None) -> list[tuple[str, Any]]:
    pairs: list[tuple[str, Any]] = []
    while count is None or len(pairs) < count:
        if count is None and pairs and (call.peek_word() or "")[:4] in ("TITR", "NATU"):
            break
        name = call.read("MOT")
        if name is None:
            break
        value = call.read("FLOTTANT", "LISTREEL", after=name.span.end)
        if value is None:
            raise call.missing(("FLOTTANT", "LISTREEL"))
        pairs.append((str(name.value).rstrip()[:8], value.value))
    if not pairs:
        raise call.missing(("MOT",))
    return pairs


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


@MANU.on(
    "CHML",
    "CHAM",
    syntax="CHAM1 = MANU 'CHML' GEO1 | MODL1 ('REPA') MOT1 VAL1 MOT2 VAL2 ... ('TYPE' MOT3) "
    "('CONS' MOT4) ('NOEUD' | 'GRAVITE' | 'RIGIDITE' | 'MASSE' | 'STRESSES') ;\n"
    "CHAM1 = MANU 'CHAM' MODL1 ('POSI' MOT2) MOT3 CELL1 POINT1 (ZONE1) VAL1 ;",
    en="CHML: field in the cells of a mesh or model; values are numbers or objects, constant in "
    "the cells; 'REPA' deals the values of a list out, one a cell.",
    fr="CHML : champ par éléments sur un maillage ou un modèle ; les valeurs sont des nombres ou "
    "des objets, constants par élément ; 'REPA' distribue les valeurs d'une liste, une par "
    "élément.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; "
        "LIST (MAXI (MANU 'CHML' L 'SCAL' 3.)) ;",
    ),
)
def _cell_field(call: Call, word: str) -> CellField:
    operand = call.read("MAILLAGE", "MMODEL")
    if operand is None:
        raise call.missing(("MAILLAGE", "MMODEL"))
    settings: dict[str, str] = {}
    deal = False
    pairs: list[tuple[str, Any]] = []
    while (said := call.peek_word()) is not None:
        key = said.rstrip()
        if key[:4] in ("TYPE", "CONS", "POSI"):
            call.word()
            settings[key[:4]] = str(call.required("MOT")).rstrip()
        elif key[:4] == "REPA":
            call.word()
            deal = True
        elif key[:8] in _SUPPORTS or key[:4] in ("NOEU", "GRAV", "STRE"):
            call.word()
            settings["POSI"] = next(s for s in _SUPPORTS if s[:4] == key[:4])
        else:
            name = str(call.required("MOT")).rstrip()
            value = call.read("*")
            if value is None:
                raise call.missing(("*",))
            rest = call.all("FLOTTANT") if type(value.value) is int else []
            if rest:
                return _at_one_point(call, operand.value, name, [value.value, *rest], settings)
            pairs.append((name, value.value))
    if not pairs:
        raise call.missing(("MOT",))
    return _in_cells(operand.value, pairs, settings, deal)


def _at_one_point(
    call: Call, model: Mesh | Model, name: str, numbers: list[float], settings: dict[str, str]
) -> CellField:
    """Zero but at one point: numbers of cell, point (and zone), then the value."""
    if not isinstance(model, Model) or len(numbers) not in (3, 4):
        raise call.error("operators.fields.one-point-field-needs")
    cell, point = int(numbers[0]), int(numbers[1])
    zone_number = int(numbers[2]) if len(numbers) == 4 else 1
    if not 1 <= zone_number <= len(model.zones):
        raise call.error(
            "operators.fields.model-has-no-such-zone", n_zones=len(model.zones), zone=zone_number
        )
    zone = model.zones[zone_number - 1]
    place: Any = settings.get("POSI", "NOEUD")
    shape = (len(zone.cells), n_points(zone.element, place))
    if not (1 <= cell <= shape[0] and 1 <= point <= shape[1]):
        raise call.error(
            "operators.fields.zone-has-no-such-point", n_cells=shape[0], n_points=shape[1]
        )
    values = np.zeros(shape)
    values[cell - 1, point - 1] = float(numbers[-1])
    block = CellFieldBlock(zone.cells, {name: values}, place, zone.element, zone.constituent)
    return CellField((block,), settings.get("TYPE", ""))


def _in_cells(
    support: Mesh | Model, pairs: list[tuple[str, Any]], settings: dict[str, str], deal: bool
) -> CellField:
    place: Any = settings.get("POSI", "NOEUD")
    blocks = []
    zones: list[tuple[CellBlock, str, str]]
    if isinstance(support, Model):
        zones = [(z.cells, z.element, z.constituent) for z in support.zones]
    else:
        zones = [(cells, "", "") for cells in support.blocks]
        place = "NOEUD"
    taken = 0
    for cells, element, constituent in zones:
        made = {n: _cell_values(v, len(cells), deal, taken) for n, v in pairs}
        taken += len(cells)
        said = settings.get("CONS", constituent)
        blocks.append(CellFieldBlock(cells, made, place, element if place != "NOEUD" else "", said))
    return CellField(tuple(blocks), settings.get("TYPE", ""))


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
        ),
    ),
    reads_itself=True,
)
def resu(call: Call) -> Any:
    """Sum components over nodes."""
    value = call.required("CHPOINT", "LISTREEL", "LISTENTI")
    if not isinstance(value, NodeField):
        return value.values.sum()
    nodes = value.node_ids
    if not len(nodes):
        raise call.error("operators.fields.field-empty", value)
    here = nodes[:1]
    made = {k: NodeValues(here, np.asarray([v.values.sum()])) for k, v in value.components.items()}
    return NodeField(value.table, made, "DISCRET")


@operator(
    "XTY",
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
        ),
    ),
    reads_itself=True,
)
def xty(call: Call) -> Any:
    """Scalar product of fields."""
    first = call.required("CHPOINT", "LISTCHPO")
    second = call.required("LISTCHPO" if isinstance(first, ListChpo) else "CHPOINT")
    left, right = (names_of(call.required("LISTMOTS")) for _ in range(2))
    if len(left) != len(right):
        raise call.error(
            "operators.fields.word-counts-differ", n_left=len(left), n_right=len(right)
        )
    if isinstance(first, NodeField):
        return float(node_algebra.scalar_product(first, second, left, right).values.sum())
    if len(first) != len(second):
        raise call.error(
            "operators.fields.field-counts-differ", second, n_first=len(first), n_second=len(second)
        )
    pairs: Any = zip(first.values, second.values, strict=True)
    return ListReel(
        [float(node_algebra.scalar_product(a, b, left, right).values.sum()) for a, b in pairs]
    )


@operator(
    "XTX",
    family="fields",
    help=Help(
        en="Sum of the squares of all values of a field, or of X1 CHP1 + X2 CHP2.",
        fr="Somme des carrés de toutes les valeurs d'un champ, ou de X1 CHP1 + X2 CHP2.",
        syntax="X3 = XTX CHP1 ; X3 = XTX X1 CHP1 X2 CHP2 ;",
        examples=("OPTI DIME 2 ; P = 0. 0. ; LIST (XTX (MANU 'CHPO' P 'UX' 3. 'UY' 4.)) ;",),
    ),
    reads_itself=True,
)
def xtx(call: Call) -> float:
    """Square norm."""
    first = call.required("CHPOINT", "MCHAML")
    second = call.optional(type_of(first))
    if second is not None:
        a, b = call.required("FLOTTANT"), call.required("FLOTTANT")
        algebra: Any = node_algebra if isinstance(first, NodeField) else cell_algebra
        first = algebra.added(algebra.applied(first, lambda v: v * a), second, b)
    if isinstance(first, NodeField):
        return float(sum(v.values @ v.values for v in first.components.values()))
    return float(sum((v * v).sum() for v in cell_algebra.values_of(first)))


@operator(
    "COMB",
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
    reads_itself=True,
)
def comb(call: Call) -> NodeField:
    """Combine fields."""
    call.keyword(("SEMB",))
    weights: NodeField = call.required("CHPOINT")
    table: Table = call.required("TABLE")
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
