"""VIDE: empty objects, and whether an object is empty."""

from ssilang.io.plots.labels import Annotation
from ssilang.kernel.curves.cloud import Cloud
from ssilang.kernel.fields.deformed import Arrows, Deformed
from ssilang.language.values import is_empty
from ssilang.operators.prelude import *

_MAKERS: dict[str, Callable[[Workspace, str], Any]] = {
    "MAILLAGE": lambda ws, sub: Mesh(ws.nodes, ()),
    "CHPOINT": lambda ws, sub: NodeField(
        ws.nodes,
        {},
        {"DISC": "DISCRET", "DIFF": "DIFFUS"}.get(sub[:4], ""),  # type: ignore[arg-type]
    ),
    "MCHAML": lambda ws, sub: CellField(()),
    "MMODEL": lambda ws, sub: Model(()),
    "RIGIDITE": lambda ws, sub: Matrix(ws.nodes, (), (), sub),
    "EVOLUTIO": lambda ws, sub: Curve((), "", sub or "REEL"),
    "LISTENTI": lambda ws, sub: ListEnti(),
    "LISTREEL": lambda ws, sub: ListReel(),
    "LISTMOTS": lambda ws, sub: ListMots(),
    "LISTCHPO": lambda ws, sub: ListChpo(),
    "LISTOBJE": lambda ws, sub: ListObje(),
    "TABLE": lambda ws, sub: Table(sub),
    "CHARGEME": lambda ws, sub: Load(()),
    "DEFORME": lambda ws, sub: Deformed(()),
    "VECTEUR": lambda ws, sub: Arrows(()),
    "NUAGE": lambda ws, sub: Cloud({}),
    "ANNOTATI": lambda ws, sub: Annotation(),
}


_COUNT = arg("count", "ENTIER", en="number of objects", range=between(1, 1e6))
_PLACES = opt(
    "places", "LISTENTI", "LISTREEL", "LISTMOTS", en="indices of the table, else 1, 2 ...",
    range=ANY_NUMBER,
)  # fmt: skip


def _group(call: Call) -> list[Any] | None:
    """One `TYPE/SUBTYPE*N` group, None at the end."""
    said = call.read("MOT")
    if said is None:
        return None
    kind = str(said.value).strip().upper()[:8]
    if kind not in _MAKERS:
        raise call.error(
            "operators.session.nothing-empty-of-type", said.value, kind=kind, makers=_MAKERS
        )
    sub, count = "", 1
    while call.operands and call.operands[0].span.text in ("/", "*"):
        mark = call.operands.pop(0).span.text
        if mark == "*":
            count = call.given(_COUNT)
        else:
            sub = str(call.required("MOT")).strip()
    if kind == "MAILLAGE" and sub and sub.upper() not in CELL_TYPES:
        raise call.error("operators.session.no-such-cell", sub=sub, cell_types=CELL_TYPES)
    ws = workspace(call.session)
    return [_MAKERS[kind](ws, sub) for _ in range(count)]


@operator(
    "VIDE",
    flag("tabulated", "TABU", en="in a table"),
    _PLACES,
    many("types", en="types with sub-type and number, or an object to test"),
    gives=ANY,
    family="objects",
    reads_itself="types, sub-types and numbers are joined by / and *",
)
def vide(call: Call) -> Any:
    """Make empty objects, or test one."""
    if call.operands and not isinstance(call.operands[0].value, Mot):
        tested = call.read("*")
        assert tested is not None
        if type_of(tested.value) not in _MAKERS:
            raise call.error(
                "operators.session.never-empty", tested.value, found=type_of(tested.value)
            )
        return is_empty(tested.value)
    tabulated = call.keyword(("TABU",)) is not None
    places = call.given(_PLACES) if tabulated else None
    made: list[Any] = []
    while (group := _group(call)) is not None:
        made += group
    if not made:
        raise call.missing(("MOT",))
    if not tabulated:
        return tuple(made)
    indices = [] if places is None else list(places.values)
    if isinstance(places, ListReel | ListEnti):
        indices = places.values.tolist()
    return Table.of(
        (indices[i] if i < len(indices) else i + 1, value) for i, value in enumerate(made)
    )
