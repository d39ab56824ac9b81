"""LIST: what objects hold, in readable lines."""

from ssilang.io.plots.palette import COLOURS
from ssilang.language.text.tree import print_items
from ssilang.language.values import Objet, Texte
from ssilang.operators.dispatch import LISTINGS, listing
from ssilang.operators.fields.signs import nature_word
from ssilang.operators.prelude import *
from ssilang.operators.texts.fortran_format import formatted
from ssilang.operators.texts.words import type_word

_ROWS = 200  # rows printed of a field or curve before the middle is left out


def real(x: float) -> str:
    """A real in 12 columns."""
    if x == 0.0 or 1e-98 < abs(x) < 1e98:  # two digits of exponent: Python writes them the same
        return f"{x:12.5E}"
    return formatted("(1PE12.5)", x)


def _headed(head: str, short: bool, cells: list[str], per_line: int) -> str:
    rows = ["".join(cells[i : i + per_line]) for i in range(0, len(cells), per_line)]
    return head if short else "\n".join([head, *rows])


@listing("ENTIER")
def _integer(value: int, short: bool, say: Teller) -> str:
    return say("operators.texts.integer", value=value)


@listing("FLOTTANT")
def _real(value: float, short: bool, say: Teller) -> str:
    return say("operators.texts.real", value=formatted("(1PE22.14)", value))


@listing("LOGIQUE")
def _logical(value: bool, short: bool, say: Teller) -> str:
    return say("operators.texts.logical", value="VRAI" if value else "FAUX")


@listing("MOT")
def _word(value: str, short: bool, say: Teller) -> str:
    return say("operators.texts.word", length=len(value), text=value)


@listing("TEXTE")
def _text(value: Texte, short: bool, say: Teller) -> str:
    return say("operators.texts.text", text=print_items(value.items))


def _reals(value: ListReel, short: bool, say: Teller, per_line: int = 10) -> str:
    head = say("operators.texts.reals", count=len(value), full=not short)
    return _headed(head, short, [f" {real(v)}" for v in value.values.tolist()], per_line)


listing("LISTREEL")(_reals)


def _integers(value: ListEnti, short: bool, say: Teller, per_line: int = 20) -> str:
    head = say("operators.texts.integers", count=len(value), full=not short)
    return _headed(head, short, [f" {v:7d}" for v in value.values.tolist()], per_line)


listing("LISTENTI")(_integers)


@listing("LISTMOTS")
def _words(value: ListMots, short: bool, say: Teller) -> str:
    head = say("operators.texts.words", count=len(value), full=not short)
    return _headed(head, short, [f" {v.rstrip():<8s}" for v in value.values], 10)


@listing("LISTCHPO", "LISTOBJE")
def _objects(value: ListChpo | ListObje, short: bool, say: Teller) -> str:
    kind = type_of(value.values[0]) if value.values else ""
    return say("operators.texts.objects", count=len(value), kind=kind)


def brief(value: Any, say: Teller) -> str:
    """A value in a few characters, for tables."""
    if isinstance(value, bool):
        return "VRAI" if value else "FAUX"
    if isinstance(value, float):
        return real(value).strip()
    if isinstance(value, str):
        return value if len(value) <= 40 else value[:37] + "..."
    if isinstance(value, int):
        return str(value)
    if isinstance(value, Table):
        return value.subtype
    if isinstance(value, Procedure):
        return value.name
    return say("operators.texts.items", count=len(value)) if hasattr(value, "__len__") else ""


@listing("TABLE")
def _table(value: Table, short: bool, say: Teller) -> str:
    lines = [say("operators.texts.table", count=len(value))]
    if short:
        return lines[0]
    left, right = say("operators.texts.table-index"), say("operators.texts.table-object")
    lines.append(f"  {left:<30s} {right}")
    for index, held in value.items():
        left = f"{type_of(index):<8s} {brief(index, say)}"
        lines.append(f"  {left:<30s} {type_of(held):<8s} {brief(held, say)}".rstrip())
    return "\n".join(lines)


@listing("OBJET")
def _object(value: Objet, short: bool, say: Teller) -> str:
    lines = [say("operators.texts.object", name=value.class_name)]
    for name, held in value.attributes.items():
        head = say("operators.texts.attribute", name=name)
        lines.append(f"{head} {type_of(held):<8s} {brief(held, say)}".rstrip())
    lines += [say("operators.texts.method", name=name) for name in value.methods]
    return "\n".join(lines)


@listing("PROCEDUR")
def _procedure(value: Procedure, short: bool, say: Teller) -> str:
    lines = value.definition.span.text.split("\n")
    head = say("operators.texts.procedure", name=value.name, origin=value.origin, count=len(lines))
    if short:
        return head
    return "\n".join([head, *(f"{i:5d}  {line}" for i, line in enumerate(lines, start=1))])


@listing("EVOLUTIO")
def _curves(value: Curve, short: bool, say: Teller) -> str:
    lines = [say("operators.texts.curves", count=len(value.parts), title=value.title)]
    for i, part in enumerate(value.parts, start=1):
        lines.append(
            say(
                "operators.texts.curve",
                number=i,
                kind=part.kind or "REEL",
                colour=COLOURS[part.colour],
                count=len(part.abscissas),
                legend=part.legend,
            )
        )
        if short:
            continue
        x = part.abscissa_name or say("operators.texts.abscissa")
        y = part.ordinate_name or say("operators.texts.ordinate")
        lines.append(f"  {x:>13s} {y:>13s}")
        ordinates = part.words or [f" {real(y)}" for y in part.ordinates.tolist()]
        abscissas = part.abscissa_words or [real(x) for x in part.abscissas.tolist()]
        pairs = zip(abscissas, ordinates, strict=True)
        lines += _shortened([f"   {x} {y}" for x, y in pairs], say)
    return "\n".join(lines)


def _shortened(rows: list[str], say: Teller) -> list[str]:
    if len(rows) <= _ROWS:
        return rows
    half = _ROWS // 2
    left_out = say("operators.texts.lines-left-out", count=len(rows) - _ROWS)
    return [*rows[:half], left_out, *rows[-half:]]


@listing("CHPOINT")
def _node_field(value: NodeField, short: bool, say: Teller) -> str:
    nodes = value.node_ids
    names = list(value.components)
    lines = [
        say(
            "operators.texts.node-field",
            n_nodes=len(nodes),
            n_names=len(names),
            nature=nature_word(value.nature),
        )
    ]
    if value.title:
        lines.append(say("operators.texts.title-line", title=value.title))
    for name in names:
        v = value.components[name].values
        if len(v):
            low, high = real(v.min()), real(v.max())
            lines.append(say("operators.texts.extremes", name=name, low=low, high=high))
    if short or not len(nodes):
        return "\n".join(lines)
    lines.append(f"  {say('operators.texts.node'):<5s}  " + "".join(f"{n:>14s}" for n in names))
    columns = np.array([value.components[n].at(nodes, np.nan) for n in names])
    rows = []
    for k, node in enumerate(nodes.tolist()):
        cells = ["            ." if np.isnan(x) else f" {real(x)}" for x in columns[:, k]]
        rows.append(f"{node + 1:7d}  " + "".join(f"{c:>14s}" for c in cells))
    return "\n".join([*lines, *_shortened(rows, say)])


@listing("CHARGEME")
def _load(value: Load, short: bool, say: Teller) -> str:
    lines = [say("operators.texts.load", count=len(value.parts))]
    for part in value.parts:
        if part.steps:
            first, last = part.steps[0][0], part.steps[-1][0]
            what = say(
                "operators.texts.load-of-steps", count=len(part.steps), first=first, last=last
            )
        elif part.time is None:
            what = say("operators.texts.constant-load", kind=type_of(part.space))
        else:
            x = part.time.parts[0].abscissas
            kind = type_of(part.space)
            what = say("operators.texts.load-in-time", kind=kind, first=x[0], last=x[-1])
        lines.append(f"  '{part.name:<4s}' {what}")
    return "\n".join(lines)


# --- with numbers behind the object ----------------------------------------------------------


def _procedure_lines(value: Procedure, first: int, last: int, say: Teller) -> str:
    lines = value.definition.span.text.split("\n")
    chosen = list(enumerate(lines, start=1))[max(first - 1, 0) : max(last, 0)]
    return "\n".join([_procedure(value, True, say), *(f"{i:5d}  {line}" for i, line in chosen)])


def _table_within(value: Table, depth: int, _: int, say: Teller) -> str:
    return "\n".join(_nested(value, min(depth, _DEEPEST), (id(value),), say))


def _nested(value: Table, depth: int, above: tuple[int, ...], say: Teller) -> list[str]:
    """The table, and below each table that it holds that table's lines, moved in."""
    head, *rows = _table(value, False, say).split("\n")
    lines = [head, *rows[:1]]
    for row, (_, held) in zip(rows[1:], value.items(), strict=True):
        lines.append(row)
        if depth > 0 and isinstance(held, Table) and id(held) not in above:
            inner = _nested(held, depth - 1, (*above, id(held)), say)
            lines += ["    " + r for r in inner]
    return lines


_DEEPEST = 10
_NUMBERED: dict[str, Callable[[Any, int, int, Teller], str]] = {
    "PROCEDUR": _procedure_lines,
    "LISTREEL": lambda value, per_line, _, say: _reals(value, False, say, per_line),
    "LISTENTI": lambda value, per_line, _, say: _integers(value, False, say, per_line),
    "TABLE": _table_within,
}


def described(value: Any, say: Teller, short: bool = False, numbers: Sequence[int] = ()) -> str:
    """The lines that LIST prints of an object, `numbers` being those that stand behind it."""
    numbered = _NUMBERED.get(type_of(value))
    if numbers and numbered is not None and min(numbers) > 0:
        return numbered(value, numbers[0], numbers[-1], say)
    entry = LISTINGS.get(type_of(value))
    if entry is not None:
        return entry(value, short, say)
    if value is ANNULE:
        return say("operators.texts.undefined")
    return say("operators.texts.of-type", kind=type_of(value))


def _all_names(session: Session, kind: str) -> str:
    rows = []
    for name, value in session.frame.named().items():
        if not kind or type_of(value) == kind:
            rows.append(f"  {name:<24s} {type_of(value):<8s} {brief(value, session.told)}".rstrip())
    return "\n".join([session.told("operators.texts.named", count=len(rows), kind=kind), *rows])


LIST = shared("LIST", "output", full_name="LISTE", terminal=True)


@LIST.form()
def _list_text(session: Session, value: Texte = Lead("TEXTE", en="a text, as it stands")) -> None:
    """A text is shown, not put in its place."""
    session.print(described(value, session.told))


@LIST.form()
def _list_names(
    call: Call,
    star: bool = Key("*", optional=False, en="all objects of a type"),
    kind: str = Name(en="type word"),
) -> None:
    call.session.print(_all_names(call.session, type_word(call, kind)))


@LIST.form()
def _list_object(
    session: Session,
    brief: bool = Flag("RESU", en="less of it"),
    value: Any = Arg("*", "TEXTE", en="what is printed"),
    numbers: tuple[int, ...] = Many(
        "ENTIER", en="values in a line, depth of tables, or first and last line", range=CARRIED
    ),
) -> None:
    session.print(described(value, session.told, brief, numbers))


@LIST.form()
def _list_word(session: Session, value: Any = Lead("*", "TEXTE", en="what is printed")) -> None:
    """A word that is spelt like the keyword, alone."""
    session.print(described(value, session.told))


@LIST.form()
def _list_all(session: Session) -> None:
    session.print(_all_names(session, ""))
