"""POSI ORDO UNIQ: places of items, sorting."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListEnti, ListMots, ListReel, Table
from ssilang.operators.dispatch import ORDO, UNIQ
from ssilang.operators.lists.items import taken

_PRECISION = 2.2e-16
Sortable = ListReel | ListEnti | ListMots


def equal_items(items: Any, wanted: Any, tolerance: float | None, fold: bool) -> Any:
    """Logical array: which items equal `wanted`."""
    if isinstance(items, list):
        said = str(wanted).rstrip()
        if fold:
            return np.asarray([str(i).rstrip().upper() == said.upper() for i in items], dtype=bool)
        return np.asarray([str(i).rstrip() == said for i in items], dtype=bool)
    if items.dtype == np.int64:
        return items == wanted
    if tolerance is None:
        return np.abs(items - wanted) <= 10 * _PRECISION * np.maximum(np.abs(items), abs(wanted))
    return np.abs(items - wanted) <= tolerance


@operator(
    "POSI",
    family="lists",
    full_name="POSITION",
    help=Help(
        en="Place of an item in a list (of a word in a word, of a point in a mesh of points), 0 "
        "if it is not there. 'TOUS' gives all places; a list of items gives the first place of "
        "each. 'NOCA' forgets the case; a real at the end is the absolute tolerance.",
        fr="Rang d'un élément dans une liste (d'un mot dans un mot, d'un point dans un maillage de "
        "points), 0 s'il n'y est pas. 'TOUS' donne tous les rangs ; une liste d'éléments donne le "
        "premier rang de chacun. 'NOCA' ignore la casse ; un réel final est la tolérance absolue.",
        syntax="N1 | LENT1 = POSI OBJ1 'DANS' LIS1 (FLOT1) ('NOCA') ('TOUS') ;",
        examples=(
            "LIST (POSI 'B' 'DANS' (MOTS 'A' 'B')) ;",
            "LIST (POSI 'a' 'DANS' 'banana' 'TOUS') ;",
        ),
    ),
    reads_itself=True,
)
def posi(call: Call) -> Any:
    """Look items up."""
    item = call.read("*")
    if item is None:
        raise call.missing(("*",))
    if call.keyword(("DANS",)) is None:
        raise call.error("operators.lists.list-not-named")
    place = call.keyword_end
    kinds = ("LISTREEL", "LISTENTI", "LISTMOTS", "MOT", "MAILLAGE")
    operand = call.read(*kinds, after=place)
    if operand is None:
        raise call.missing(kinds)
    words: set[str] = set()
    while (said := call.keyword(("TOUS", "NOCA"))) is not None:
        words.add(said)
    tolerance = call.optional("FLOTTANT")
    while (said := call.keyword(("TOUS", "NOCA"))) is not None:
        words.add(said)
    where, fold = operand.value, "NOCA" in words
    if isinstance(where, str):
        return _in_word(str(item.value), where, fold, "TOUS" in words)
    items, wanted = _comparable(call, item.value, where)
    if isinstance(wanted, list | np.ndarray):
        return ListEnti([_first(equal_items(items, w, tolerance, fold)) for w in wanted])
    found = equal_items(items, wanted, tolerance, fold)
    if "TOUS" in words:
        places = np.flatnonzero(found) + 1
        return ListEnti(places if len(places) else [0])
    return _first(found)


def _comparable(call: Call, item: Any, where: Any) -> tuple[Any, Any]:
    if isinstance(where, ListReel | ListEnti | ListMots):
        if isinstance(item, ListReel | ListEnti | ListMots):
            return where.values, item.values
        fits = isinstance(item, str) if isinstance(where, ListMots) else type(item) in (int, float)
        if not fits:
            raise call.error("operators.lists.item-of-other-type", item)
        return where.values, item
    nodes = where.single_block().connectivity[:, 0]
    if hasattr(item, "node"):
        return nodes, item.node
    if not hasattr(item, "single_block"):
        raise call.error("operators.lists.point-or-mesh", item)
    return nodes, item.single_block().connectivity[:, 0]


def _first(found: Any) -> int:
    places = np.flatnonzero(found)
    return int(places[0]) + 1 if len(places) else 0


def _in_word(part: str, word: str, fold: bool, every: bool) -> Any:
    if fold:
        part, word = part.upper(), word.upper()
    places, at = [], word.find(part)
    while at >= 0:
        places.append(at + 1)
        at = word.find(part, at + 1)
    if every:
        return ListEnti(places or [0])
    return places[0] if places else 0


# ---- ORDO -------------------------------------------------------------------------------------


def _keys(values: Any, absolute: bool, fold: bool) -> Any:
    if isinstance(values, list):
        return [v.rstrip().upper() if fold else v.rstrip() for v in values]
    return np.abs(values) if absolute else values


def sorting(values: Any, down: bool, absolute: bool = False, fold: bool = False) -> list[int]:
    """Places (0-based) of the values in increasing or decreasing order; equal ones keep theirs."""
    keys = _keys(values, absolute, fold)
    if isinstance(keys, list):
        return sorted(range(len(keys)), key=keys.__getitem__, reverse=down)
    order = np.argsort(-keys if down else keys, kind="stable")
    return [int(i) for i in order]


def distinct(values: Any, order: list[int], tolerance: float, fold: bool) -> list[int]:
    """Drop from sorted places those whose value equals the one kept before."""
    kept: list[int] = []
    keys = _keys(values, False, fold)
    for i in order:
        if kept:
            last = keys[kept[-1]]
            same = keys[i] == last if isinstance(keys, list) else abs(keys[i] - last) <= tolerance
            if same:
                continue
        kept.append(i)
    return kept


@ORDO.on(
    "LISTREEL",
    "LISTENTI",
    "LISTMOTS",
    syntax="LIS2 = ORDO LIS1 ('CROI' | 'DECR') ('ABSO') ('NOCA') ('UNIQ' (FLOT1)) ;\n"
    "LIS3 LIS4 ... = ORDO LIS1 LIS2 ... ('CROI' | 'DECR') ('ABSO') ('NOCA') ;\n"
    "X1 LIS2 ... = ORDO LIS1 ... 'COUT' LIS3 ('HONG' | 'COMP') ;",
    en="Of lists: increasing order ('DECR': decreasing), 'ABSO' by absolute values, 'NOCA' "
    "whatever the case, 'UNIQ' without doubles; further lists follow the first one's order. "
    "'COUT' gives the least total cost, then the lists in the permutation that has it.",
    fr="De listes : ordre croissant ('DECR' : décroissant), 'ABSO' selon les valeurs absolues, "
    "'NOCA' sans égard à la casse, 'UNIQ' sans doublons ; les autres listes suivent l'ordre de la "
    "première. 'COUT' donne le moindre coût total, puis les listes dans la permutation qui l'a.",
    examples=(
        "LIST (ORDO (PROG 3. 1. 2.) 'DECR') ;",
        "A B = ORDO (LECT 2 1) (MOTS 'X' 'Y') ; LIST B ;",
    ),
)
def _sort_lists(call: Call, first: Sortable) -> Any:
    words, tolerance, cost = _sort_words(call)
    lists: list[Any] = [first]
    while (operand := call.read("LISTREEL", "LISTENTI", "LISTMOTS")) is not None:
        lists.append(operand.value)
    more, tolerance_more, cost_more = _sort_words(call)
    words |= more
    tolerance, cost = tolerance or tolerance_more, cost if cost is not None else cost_more
    if len({len(v) for v in lists}) > 1:
        sizes = " ".join(str(len(v)) for v in lists)
        raise call.error("operators.lists.sorted-lengths", sizes=sizes)
    if cost is not None:
        total, order = _cheapest(call, cost, len(first))
        return (total, *(taken(v, order) for v in lists))
    fold = "NOCA" in words
    order = sorting(first.values, "DECR" in words, "ABSO" in words, fold)
    if "UNIQ" in words:
        if len(lists) > 1:
            raise call.error("operators.lists.one-list-without-doubles")
        order = distinct(first.values, order, tolerance, fold)
    return tuple(taken(v, order) for v in lists)


def _sort_words(call: Call) -> tuple[set[str], float, Any]:
    words: set[str] = set()
    tolerance, cost = 0.0, None
    known = ("CROI", "DECR", "ABSO", "NOCA", "UNIQ", "COUT", "HONG", "COMP")
    while (said := call.keyword(known)) is not None:
        words.add(said)
        if said == "UNIQ":
            tolerance = call.optional("FLOTTANT", default=0.0)
        elif said == "COUT":
            cost = call.required("LISTREEL", "LISTENTI", after=call.keyword_end)
    return words, tolerance, cost


def _cheapest(call: Call, cost: Any, n: int) -> tuple[float | int, list[int]]:
    """Least total cost, whole if the costs are, and the permutation that gives it."""
    from scipy.optimize import linear_sum_assignment

    if len(cost) != n * n:
        raise call.error("operators.lists.cost-count", cost, needed=n * n, n=n, found=len(cost))
    costs = cost.values.reshape(n, n)
    rows, order = linear_sum_assignment(costs.astype(float))
    return costs[rows, order].sum().item(), [int(i) for i in order]


@ORDO.on(
    "TABLE",
    syntax="TAB2 = ORDO TAB1 OBJ1 ('CROI' | 'DECR') ('ABSO') ('NOCA') ;",
    en="Of a table of lists: all sorted as the list at index OBJ1.",
    fr="D'une table de listes : toutes triées comme la liste d'indice OBJ1.",
)
def _sort_table(call: Call, table: Table) -> Table:
    index = call.read("*")
    if index is None or not table.has(index.value):
        raise call.error("operators.lists.no-list-to-sort-by", index.value if index else None)
    words, _, _ = _sort_words(call)
    lead: Any = table.get(index.value)
    if not isinstance(lead, ListReel | ListEnti | ListMots):
        raise call.error("operators.lists.index-holds-no-list", index.value)
    order = sorting(lead.values, "DECR" in words, "ABSO" in words, "NOCA" in words)
    made = Table()
    for key, value in table.items():
        same = isinstance(value, ListReel | ListEnti | ListMots) and len(value) == len(lead)
        made.set(key, taken(value, order) if same else value)
    return made


@UNIQ.on(
    "LISTREEL",
    "LISTENTI",
    "LISTMOTS",
    syntax="LIS2 = UNIQ LIS1 (FLOT1) ('NOCA') ;",
    en="Of a list: without doubles, in order of first appearance.",
    fr="D'une liste : sans doublons, dans l'ordre de première apparition.",
    examples=("LIST (UNIQ (LECT 3 1 3 2 1)) ;",),
)
def _unique(call: Call, value: Sortable) -> Any:
    tolerance = call.optional("FLOTTANT", default=0.0)
    fold = call.keyword(("NOCA",)) is not None
    values: Any = value.values
    if tolerance and not isinstance(value, ListMots):
        kept: list[int] = []
        for i in range(len(values)):
            if not any(abs(values[i] - values[j]) <= tolerance for j in kept):
                kept.append(i)
        return taken(value, kept)
    seen: dict[Any, int] = {}
    for i, key in enumerate(_keys(values, False, fold)):
        seen.setdefault(key, i)
    return taken(value, sorted(seen.values()))
