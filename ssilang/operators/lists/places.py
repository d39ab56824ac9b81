"""Items of lists by their places: EXTR ENLE INSE REMP SOMM DIME INVE COPI, ET."""

from itertools import accumulate, chain

from ssilang.operators.curves.instants import refused_place, tell_zero
from ssilang.operators.dispatch import COPI, DIME, ENLE, EXTR, INVE, union
from ssilang.operators.lists.progressions import check_length
from ssilang.operators.prelude import *

AnyList = ListReel | ListEnti | ListMots | ListChpo | ListObje
LISTS = ("LISTREEL", "LISTENTI", "LISTMOTS", "LISTCHPO", "LISTOBJE")
_ITEM = {
    "LISTREEL": "FLOTTANT", "LISTENTI": "ENTIER", "LISTMOTS": "MOT", "LISTCHPO": "CHPOINT",
    "LISTOBJE": "*",
}  # fmt: skip
_PLACES = arg("places", "ENTIER", "LISTENTI", en="place, or list of places, from 1", range=POSITIVE)
_LIST = main("value", *LISTS, en="list")


def _list(kind: str) -> Any:
    return main("value", kind, en="list")


def _places(call: Call, size: int, places: Any) -> list[int]:
    """0-based places from an ENTIER or LISTENTI, checked."""
    wanted = places.values.tolist() if isinstance(places, ListEnti) else [int(places)]
    for i in wanted:
        if not 1 <= i <= size:
            raise call.error("operators.lists.no-such-place", places, size=size, place=i)
    return [i - 1 for i in wanted]


def taken(value: Any, places: list[int]) -> Any:
    """The list of the items at 0-based places."""
    if isinstance(value, ListReel | ListEnti):
        return type(value)(value.values[places])
    return type(value)([value.values[i] for i in places])


@EXTR.form()
def _values_at(
    call: Call,
    value: ListChpo = Main("LISTCHPO", en="list of fields"),
    taken: bool = Key("VALE", optional=False, en="values at a point"),
    names: ListMots | str | None = Opt(
        "LISTMOTS", "MOT", en="components, all by default", kind="component"
    ),
    point: Point | None = Opt("POINT", en="where"),
) -> ListReel:
    fields: list[Any] = value.values
    node = np.asarray([_only_node(call, value) if point is None else point.node])
    if names is not None:
        wanted = list(names.values) if isinstance(names, ListMots) else [names]
    else:
        wanted = list(dict.fromkeys(n for f in fields for n in f.components))
        if any(set(f.components) != set(wanted) for f in fields):
            raise call.error("operators.lists.components-differ")
    if fields and not any(f.nature == "DISCRET" or node[0] in f.node_ids for f in fields):
        tell_zero(call, refused_place(call, fields, str(wanted[0]).rstrip(), int(node[0])), point)
    return ListReel([float(f.values_at(str(n).rstrip(), node)[0]) for n in wanted for f in fields])


def _only_node(call: Call, value: ListChpo) -> int:
    """The one node that all fields of a list stand on."""
    nodes = {int(i) for field in value.values for i in cast(NodeField, field).node_ids}
    if len(nodes) != 1:
        raise call.error("operators.lists.no-single-point", value, count=len(nodes))
    return nodes.pop()


def _extract(call: Call, value: AnyList, places: int | ListEnti) -> Any:
    chosen = _places(call, len(value), places)
    if isinstance(places, ListEnti):
        return taken(value, chosen)
    item = value.values[chosen[0]]
    return item.item() if isinstance(item, np.generic) else item


for _kind in LISTS[:-1]:
    EXTR.form(_list(_kind), _PLACES, gives=by("places", {"LISTENTI": _kind}, default=_ITEM[_kind]))(
        _extract
    )


@EXTR.form(_list("LISTOBJE"), key("kind", "TYPE", optional=False, en="type of its objects"))
def _type_of_items(value: ListObje, kind: bool) -> Mot:
    first = type_of(value.values[0]) if value.values else ""  # all are of one type
    return Mot(f"{first:8s}")


EXTR.form(_list("LISTOBJE"), _PLACES, gives=ANY)(_extract)


@EXTR.form()
def _number_alone(
    call: Call,
    value: float = Arg("FLOTTANT", en="a number that stands for a list of one", range=ANY_NUMBER),
    place: int = Arg("ENTIER", en="its place, 1", range=POSITIVE),
) -> float:
    if place != 1:
        raise call.error("operators.lists.no-such-place", place, size=1, place=place)
    call.warn("operators.lists.item-of-a-number", value)
    return value


@ENLE.form(gives=Like("value"))
def _remove(call: Call, value: AnyList = _LIST, places: int | ListEnti = _PLACES) -> Any:
    gone = set(_places(call, len(value), places))
    return taken(value, [i for i in range(len(value)) if i not in gone])


_OTHER_LISTS = tuple(kind for kind in LISTS if kind != "LISTENTI")


@ENLE.form(gives=Like("value"))
def _remove_before(
    call: Call,
    places: ListEnti = Main("LISTENTI", en="places, before the list"),
    value: AnyList = Arg(*_OTHER_LISTS, en="list", range=CARRIED),
) -> Any:
    return _remove(call, value, places)


@DIME.form()
def _size(value: AnyList = _LIST) -> int:
    return len(value)


INSE = shared("INSE", "lists", full_name="INSERER")


def _insert(call: Call, value: AnyList, place: int, item: Any) -> Any:
    if not 1 <= place <= len(value) + 1:
        raise call.error(
            "operators.lists.no-place-to-insert", place, n_value=len(value), place=place
        )
    if isinstance(value, ListReel | ListEnti):
        return type(value)(np.insert(value.values, place - 1, item))
    items: list[Any] = list(value.values)
    items.insert(place - 1, item)
    return type(value)(items)


for _kind, _item in _ITEM.items():
    INSE.form(
        _list(_kind),
        arg("place", "ENTIER", en="place, from 1", range=POSITIVE),
        arg("item", _item, en="item to put there", range=CARRIED),
        gives=_kind,
    )(_insert)


REMP = shared("REMP", "lists", full_name="REMPLACER")


def _replace(call: Call, value: AnyList, places: int | ListEnti, new: Any) -> None:
    chosen = _places(call, len(value), places)
    items = list(new.values) if type_of(new) == type_of(value) else [new] * len(chosen)
    if len(items) != len(chosen):
        raise call.error(
            "operators.lists.places-and-items", new, n_places=len(chosen), n_items=len(items)
        )
    for i, item in zip(chosen, items, strict=True):
        value.values[i] = item


def _replacing(kind: str) -> None:
    REMP.form(
        arg("value", kind, en="list", range=CARRIED),
        _PLACES,
        arg("new", _ITEM[kind], kind, en="item, or one for each place", range=CARRIED),
    )(_replace)


# a list of words could be what is replaced in a word: that is tried before
for _kind in ("LISTREEL", "LISTENTI"):
    _replacing(_kind)


@REMP.form(
    arg("word", "MOT", en="word"),
    arg("old", "MOT", "LISTMOTS", en="what is replaced"),
    arg("new", "MOT", "LISTMOTS", en="by what"),
)
def _replace_in_word(call: Call, word: str, old: str | ListMots, new: str | ListMots) -> Mot:
    olds = list(old.values) if isinstance(old, ListMots) else [old]
    news = list(new.values) if isinstance(new, ListMots) else [new]
    if len(olds) != len(news):
        raise call.error(
            "operators.lists.words-to-replace", new, n_olds=len(olds), n_news=len(news)
        )
    for a, b in zip(olds, news, strict=True):
        if not a:
            raise call.error("operators.lists.empty-word", old)
        word = word.replace(a, b)
    return Mot(word)


for _kind in ("LISTMOTS", "LISTCHPO", "LISTOBJE"):
    _replacing(_kind)


@operator("SOMM", gives="FLOTTANT|ENTIER|LISTREEL|LISTENTI", family="lists", full_name="SOMME")
def somm(
    running: bool = Flag("CUMU", en="partial sums"),
    value: ListReel | ListEnti = Arg("LISTREEL", "LISTENTI", en="values to sum", range=ANY_NUMBER),
) -> Any:
    """Sum a list."""
    if isinstance(value, ListReel):
        return ListReel(np.cumsum(value.values)) if running else value.values.sum()
    sums = list(accumulate(value.values.tolist()))  # exact: single integers may be longer
    if not running:
        return sums[-1] if sums else 0
    if max(map(abs, sums), default=0) >= 2**63:
        raise KernelError("operators.numbers.list-integer-too-large")
    return ListEnti(sums)


@INVE.form(gives=Like("value"))
def _reverse(value: AnyList = _LIST) -> Any:
    return taken(value, list(range(len(value) - 1, -1, -1)))


@COPI.form(gives=Like("value"))
def _copy(value: AnyList = _LIST) -> Any:
    return taken(value, list(range(len(value))))


# ---- ET ---------------------------------------------------------------------------------------


def _held(lists: Any, a: Any, b: Any) -> list[Any]:
    """What two lists hold, or a list and an item, or two.

    A loop of `L = L ET L` is stopped long before it fills the memory.
    """
    held = [v.values if isinstance(v, lists) else [v] for v in (a, b)]
    check_length(sum(map(len, held)))
    return held


@union(
    ("LISTREEL", "LISTREEL"), ("LISTREEL", "LISTENTI"), ("LISTENTI", "LISTREEL"),
    ("LISTREEL", "FLOTTANT"), ("LISTREEL", "ENTIER"), ("FLOTTANT", "LISTREEL"),
    ("ENTIER", "LISTREEL"), ("LISTENTI", "FLOTTANT"), ("FLOTTANT", "LISTENTI"),
    ("FLOTTANT", "FLOTTANT"), ("ENTIER", "FLOTTANT"), ("FLOTTANT", "ENTIER"),
)  # fmt: skip
def _join_reals(a: Any, b: Any) -> ListReel:
    return ListReel.of(np.concatenate(_held(ListReel | ListEnti, a, b)).astype(float, copy=False))


@union(("LISTENTI", "LISTENTI"), ("LISTENTI", "ENTIER"), ("ENTIER", "LISTENTI"), ("ENTIER",) * 2)
def _join_integers(a: Any, b: Any) -> ListEnti:
    return ListEnti(np.concatenate(_held(ListReel | ListEnti, a, b)))


@union(("LISTCHPO", "LISTCHPO"), ("LISTCHPO", "CHPOINT"), ("CHPOINT", "LISTCHPO"))
def _join_fields(a: Any, b: Any) -> ListChpo:
    return ListChpo(chain(*_held(ListChpo | ListObje, a, b)))


@union(("LISTOBJE", "*"), ("*", "LISTOBJE"))
def _join_objects(a: Any, b: Any) -> ListObje:
    """A LISTOBJE with a list or an object of the same type."""
    made = ListObje(chain(*_held(ListChpo | ListObje, a, b)))
    kinds = dict.fromkeys(type_of(v) for v in made.values)
    if len(kinds) > 1:
        raise KernelError("operators.lists.objects-of-one-type", kinds=kinds)
    return made
