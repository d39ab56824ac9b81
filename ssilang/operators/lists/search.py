"""POSI ORDO UNIQ: places of items, sorting."""

from bisect import bisect_left, insort
from itertools import takewhile

from ssilang.kernel.base.scientific import optimize
from ssilang.kernel.mesh.combine import without_duplicates
from ssilang.operators.dispatch import ORDO, UNIQ
from ssilang.operators.lists.places import taken
from ssilang.operators.prelude import *

_PRECISION = 2.2e-16
Sortable = ListReel | ListEnti | ListMots
SORTABLE = ("LISTREEL", "LISTENTI", "LISTMOTS")


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


@operator("POSI", gives="ENTIER|LISTENTI", family="lists", full_name="POSITION")
def posi(
    call: Call,
    item: Any = Lead(en="what is looked for"),
    where: Any = Key(
        "DANS",
        "LISTREEL",
        "LISTENTI",
        "LISTMOTS",
        "MOT",
        "MAILLAGE",
        range=CARRIED,
        optional=False,
        en="where it is looked for",
    ),
    every: bool = Flag("TOUS", en="all places"),
    fold: bool = Flag("NOCA", en="whatever the case"),
    tolerance: float | None = Opt("FLOTTANT", range=NOT_NEGATIVE, en="absolute tolerance"),
) -> Any:
    """Look items up."""
    if isinstance(where, str):
        return _in_word(str(item), where, fold, every)
    items, wanted = _comparable(call, item, where)
    if isinstance(wanted, (list, np.ndarray)):
        return ListEnti([_first(equal_items(items, w, tolerance, fold)) for w in wanted])
    found = equal_items(items, wanted, tolerance, fold)
    if every:
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


def without_doubles(
    values: Any, order: list[int], tolerance: float, absolute: bool = False, fold: bool = False
) -> list[int]:
    """Drop from places, sorted that way, those whose value equals one kept before."""
    kept: list[int] = []
    keys, sizes = _keys(values, False, fold), _keys(values, absolute, fold)

    def near(a: Any, b: Any) -> bool:
        return bool(a == b if isinstance(a, str) else abs(a - b) <= tolerance)

    for i in order:
        # 1 -1 1 stand side by side where absolute values count
        beside = takewhile(lambda j: near(sizes[j], sizes[i]), reversed(kept))  # noqa: B023
        if not any(near(keys[j], keys[i]) for j in beside):
            kept.append(i)
    return kept


_ORDER = (
    choice("order", ("CROI", "DECR"), default="CROI", en="increasing or decreasing"),
    flag("absolute", "ABSO", en="by absolute values"),
    flag("fold", "NOCA", en="whatever the case"),
)
_DISTINCT_EN = "without doubles, within a tolerance"
_DISTINCT = key(
    "distinct",
    "UNIQ",
    opt("tolerance", "FLOTTANT", range=NOT_NEGATIVE, default=0.0, behind=True),
    en=_DISTINCT_EN,
)
_COST = (
    select(
        "cost",
        {"COUT": [arg("costs", "LISTREEL", "LISTENTI", range=ANY_NUMBER)]},
        optional=False,
        en="cost of each item at each place",
    ),
    choice("method", ("HONG", "COMP"), en="changes nothing: the best is found"),
)
_SORTED = main("value", *SORTABLE, en="list to sort by")
_OTHERS = many("others", *SORTABLE, en="lists that follow it", range=CARRIED)


@ORDO.form(*_COST, *_ORDER, gives=ANY)
def _sort_by_cost(
    call: Call,
    cost: Chosen,
    value: Sortable = _SORTED,
    others: tuple[Sortable, ...] = _OTHERS,
    **_: object,
) -> Any:
    lists = _together(call, value, others)
    total, order = _cheapest(call, cost["costs"], len(value))
    return (total, *(taken(v, order) for v in lists))


@ORDO.form(_SORTED, *_ORDER, gives=Like("value", ("others",)))
def _sort_lists(
    call: Call,
    value: Sortable,
    order: str,
    absolute: bool,
    fold: bool,
    distinct: float | None = _DISTINCT,
    others: tuple[Sortable, ...] = _OTHERS,
    table: Table | None = Opt("TABLE", en="refused: a table of lists stands before the list"),
) -> Any:
    if table is not None:
        raise call.error("operators.lists.table-before-list", table)
    lists = _together(call, value, others)
    places = sorting(value.values, order == "DECR", absolute, fold)
    if distinct is not None:
        if len(lists) > 1:
            raise call.error("operators.lists.one-list-without-doubles")
        places = without_doubles(value.values, places, distinct, absolute, fold)
    return tuple(taken(v, places) for v in lists)


def _together(call: Call, value: Sortable, others: tuple[Sortable, ...]) -> list[Sortable]:
    """Lists that are sorted alike, checked."""
    lists = [value, *others]
    if len({len(v) for v in lists}) > 1:
        sizes = " ".join(str(len(v)) for v in lists)
        raise call.error("operators.lists.sorted-lengths", sizes=sizes)
    return lists


def _cheapest(call: Call, cost: Any, n: int) -> tuple[float | int, list[int]]:
    """Least total cost, whole if the costs are, and the permutation that gives it."""
    if len(cost) != n * n:
        raise call.error("operators.lists.cost-count", cost, needed=n * n, n=n, found=len(cost))
    costs = cost.values.reshape(n, n)
    rows, order = optimize.linear_sum_assignment(costs.astype(float))
    return costs[rows, order].sum().item(), [int(i) for i in order]


_TABLE = main("table", "TABLE", en="table of lists")
_INDEX_EN = "index of the list to sort by, or a list beside the table"


@ORDO.form(*_COST, *_ORDER, _TABLE, opt("index", en="changes nothing: all lists follow"), gives=ANY)
def _sort_table_by_cost(
    call: Call, table: Table, cost: Chosen, **_: object
) -> tuple[float | int, Table]:
    lengths = {len(v) for _, v in table.items() if isinstance(v, Sortable)}
    if not lengths:
        raise call.error("operators.lists.no-list-in-table", table)
    if len(lengths) != 1:
        sizes = " ".join(map(str, sorted(lengths)))
        raise call.error("operators.lists.sorted-lengths", table, sizes=sizes)
    total, order = _cheapest(call, cost["costs"], lengths.pop())
    return total, _in_order(table, order, len(order))


# an index may be spelt like a keyword: it is one where no other index stands
@ORDO.form(_TABLE, lead("index", en=_INDEX_EN), *_ORDER, _DISTINCT)
@ORDO.form(_TABLE, *_ORDER, flag("distinct", "UNIQ", en=_DISTINCT_EN), arg("index", en=_INDEX_EN))
@ORDO.form(_TABLE, *_ORDER, _DISTINCT, arg("index", en=_INDEX_EN))
def _sort_table(
    call: Call,
    table: Table,
    index: Any,
    order: str,
    absolute: bool,
    fold: bool,
    distinct: float | bool | None,
) -> Table:
    beside = not table.has(index) and isinstance(index, Sortable)
    if not table.has(index) and not beside:
        raise call.error("operators.lists.no-list-to-sort-by", index)
    first: Any = index if beside else table.get(index)
    if not isinstance(first, Sortable):
        raise call.error("operators.lists.index-holds-no-list", index)
    places = sorting(first.values, order == "DECR", absolute, fold)
    if distinct is not None and distinct is not False:
        if beside or sum(isinstance(v, Sortable) for _, v in table.items()) > 1:
            raise call.error("operators.lists.one-list-without-doubles")
        tolerance = 0.0 if distinct is True else distinct
        places = without_doubles(first.values, places, tolerance, absolute, fold)
    return _in_order(table, places, len(first))


def _in_order(table: Table, places: list[int], length: int) -> Table:
    """The table with its lists of that length in another order."""
    made = Table()
    for name, value in table.items():
        same = isinstance(value, Sortable) and len(value) == length
        made.set(name, taken(value, places) if same else value)
    return made


@UNIQ.form(gives=Like("value", ("others",)))
def _unique(
    value: Sortable | Mesh = Main(*SORTABLE, "MAILLAGE", en="list, or mesh"),
    others: tuple[Sortable | Mesh, ...] = Many(
        *SORTABLE, "MAILLAGE", en="further ones", range=CARRIED
    ),
    tolerance: float | None = Opt("FLOTTANT", range=NOT_NEGATIVE, en="absolute tolerance of reals"),
    fold: bool = Flag("NOCA", en="whatever the case"),
    ordered: bool = Flag("ORDO", en="cells on the same nodes in another order stay"),
) -> Any:
    return tuple(_without_doubles_of(v, tolerance, fold, ordered) for v in (value, *others))


def _first_reals(numbers: list[float], tolerance: float | None) -> list[int]:
    """Places of the numbers that none before them equals."""
    kept: list[int] = []
    known: list[float] = []  # sorted
    for i, x in enumerate(numbers):
        slack = 10 * _PRECISION * abs(x) if tolerance is None else tolerance
        near = bisect_left(known, x - slack)
        if near == len(known) or known[near] > x + slack:
            kept.append(i)
            insort(known, x)
    return kept


def _without_doubles_of(
    value: Sortable | Mesh, tolerance: float | None, fold: bool, ordered: bool
) -> Any:
    if isinstance(value, Mesh):
        return without_duplicates(value, ordered)
    if isinstance(value, ListReel):
        return taken(value, _first_reals(value.values.tolist(), tolerance))
    seen: dict[Any, int] = {}
    for i, item in enumerate(_keys(value.values, False, fold)):
        seen.setdefault(item, i)
    return taken(value, sorted(seen.values()))
