"""Tables of HBM, CONTINU and HBM_POST: results asked for, curves, entries by number."""

from ssilang.io.plots.palette import NAMES, index_of
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries


@dataclass(frozen=True, eq=False)
class Asked:
    """A result asked for: its table, the point, the component, title and colour."""

    table: Table
    point: Point
    component: str
    title: str
    colour: int


def asked_results(entries: Entries, index: str) -> list[Asked]:
    """Results 1, 2 ... of the table at an index; none without it."""
    inner = entries.get(index)
    if inner is None:
        return []
    return [
        _asked(entries, inner.get(i), index, i)
        for i, _ in sorted((i, v) for i, v in inner.items() if type(i) is int)
    ]


def _asked(entries: Entries, table: object, index: str, number: int) -> Asked:
    place = f"{index} . {number}"
    if not isinstance(table, Table):
        raise entries.error("operators.modal.entry-is-a-table", place=place)
    own = Entries(entries.call, table, entries.procedure, f"TAB1.{index}.I")
    point: Point = own.needed("POINT_MESURE")
    word = "COMPOSANTE" if own.has("COMPOSANTE") else "COMPOSANTES"
    given = own.needed(word)
    words = given.values if isinstance(given, ListMots) else [str(given)]
    if not words or not words[0].strip():
        raise entries.error("operators.modal.component-wanted", place=place, word=word)
    component = words[0]
    title = own.get("TITRE")
    name = str(table.get("COULEUR") or "").strip().upper()[:4]
    return Asked(
        table, point, component.rstrip(), str(title or component).rstrip(),
        (index_of(name) if name in NAMES else 0),
    )  # fmt: skip


def curve(x: FloatArray, y: FloatArray, names: tuple[str, str], title: str, colour: int) -> Curve:
    """One curve."""
    return Curve((CurvePart(x.copy(), y.copy(), names[0], names[1], title, colour),), title)


def joined(curves: Sequence[Curve]) -> Curve:
    """All curves as one object."""
    return Curve(tuple(p for c in curves for p in c.parts))


def longer(table: Table, index: str, values: FloatArray) -> FloatArray:
    """The list at an index with more values behind, also set there."""
    known = table.get(index)
    whole = np.concatenate([known.values, values]) if isinstance(known, ListReel) else values
    table.set(Mot(index), ListReel(np.array(whole, dtype=float)))
    return np.asarray(whole)
