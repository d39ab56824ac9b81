"""CHAR TIRE, and loadings in EXTR DIME ENLE ET CHAN."""

from ssilang.kernel.curves.algebra import check_increasing
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.operators.curves.words import one_part
from ssilang.operators.dispatch import CHAN, DIME, ENLE, EXTR, union
from ssilang.operators.prelude import *

_SPACE = ("CHPOINT", "MCHAML")
_HELD = ("CHPOINT", "MCHAML", "MMODEL", "MAILLAGE", "RIGIDITE", "POINT")


_NAME = opt("name", "MOT", en="name, of 4 characters")
_LINK = choice("link", ("LIE", "LIBR"), en="follows the matter or not: the same here")
_MOVES = choice("moves", ("TRAN", "ROTA"), en="moving: not available")
_PATH: Any = group(  # behind the name, which may be this word
    "path", choice("path", ("TRAJ",), en="moving: not available")
)


@operator("CHAR", family="loads", full_name="CHARGEMENT")
def char(
    call: Call,
    name: str | None = _NAME,
    held: Any = Arg(*_HELD, en="field, or what is loaded", range=ANY_NUMBER),
    curve: Curve | None = Opt("EVOLUTIO", en="factor in time, 1 without it"),
    link: str | None = _LINK,
    moves: str | None = _MOVES,
    path: str | None = _PATH,
) -> Load:
    """A field times a curve."""
    _refuse_moving(call, moves or ("TRAJ" if path else None))
    if curve is not None:
        part = one_part(call, curve)
        if not len(part.abscissas):
            raise call.error("operators.statics.empty-curve", curve)
        check_increasing(part.abscissas)
        _check_numbers(call, curve)
    return Load((LoadPart(_short(name), held, curve, free=link == "LIBR"),))


def _short(name: str | None) -> str:
    return (name or "").rstrip()[:4].rstrip()


def _refuse_moving(call: Call, word: str | None) -> None:
    if word is not None:
        raise call.error("operators.statics.moving-load", said=word)


def _check_numbers(call: Call, curve: Curve) -> None:
    part = curve.parts[0]
    values = np.asarray(part.ordinates, dtype=float)
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        told = {"value": values[wrong[0]], "abscissa": part.abscissas[wrong[0]]}
        more = len(wrong) - 1
        raise call.error("operators.statics.curve-holds-no-number", curve, more=more, **told)


@char.form()
def char_in_steps(
    call: Call,
    name: str | None = _NAME,
    times: Table = Arg("TABLE", en="times, from 0 on"),
    fields: Table = Arg("TABLE", en="a field for each"),
    link: str | None = _LINK,
    moves: str | None = _MOVES,
    path: str | None = _PATH,
) -> Load:
    """A field at each of listed times."""
    _refuse_moving(call, moves or ("TRAJ" if path else None))
    steps: list[tuple[float, Any]] = []
    for i in range(len(times)):
        if not times.has(i) or not fields.has(i):
            raise call.error("operators.statics.index-missing", times, i=i)
        time, held = times.get(i), fields.get(i)
        if not isinstance(time, int | float) or type_of(held) not in _HELD:
            raise call.error("operators.statics.time-and-field-wanted", times, i=i)
        if steps and time <= steps[-1][0]:
            raise call.error(
                "operators.statics.times-must-increase", times, time=time, steps=steps[-1][0]
            )
        steps.append((float(time), held))
    if not steps:
        raise call.error("operators.statics.tables-are-empty", times)
    return Load((LoadPart(_short(name), None, None, tuple(steps), free=link == "LIBR"),))


@char.form()
def char_in_lists(
    call: Call,
    name: str | None = _NAME,
    times: ListReel = Arg("LISTREEL", en="times", unit="s", range=IN_ORDER),
    objects: ListObje | ListChpo = Arg("LISTOBJE", "LISTCHPO", en="an object for each"),
    link: str | None = _LINK,
    moves: str | None = _MOVES,
    path: str | None = _PATH,
) -> Load:
    """A field at each of listed times."""
    _refuse_moving(call, moves or ("TRAJ" if path else None))
    if len(times) != len(objects) or not len(times):
        told = {"n_times": len(times), "n_objects": len(objects)}
        raise call.error("operators.statics.times-and-objects-differ", objects, **told)
    check_increasing(times.values)
    for held in objects.values:
        if type_of(held) not in _HELD:
            raise call.error("operators.statics.not-loaded", objects, found=type_of(held))
    fields = cast("tuple[NodeField | CellField, ...]", objects.values)  # by _HELD
    steps = tuple(zip(times.values.tolist(), fields, strict=True))
    return Load((LoadPart(_short(name), None, None, steps, free=link == "LIBR"),))


# ---- values at a time ---------------------------------------------------------------------------


def _scaled(field: Any, factor: float) -> Any:
    if factor == 1.0:
        return field
    if isinstance(field, NodeField):
        return node_algebra.applied(field, lambda v: v * factor)
    return cell_algebra.applied(field, lambda v: v * factor)


def _sum(a: Any, b: Any, factor: float = 1.0) -> Any:
    algebra: Any = node_algebra if isinstance(a, NodeField) else cell_algebra
    return algebra.added(a, b, factor)


def part_at(part: LoadPart, time: float) -> Any:
    """What one loading is at a time: its field, scaled, or interpolated between its steps.

    Of a trajectory (TRAJ) it is a point.
    """
    if part.name == "TRAJ" and part.time is not None and isinstance(part.space, NodeField):
        return _on_path(part.space, part.time.at(time))
    if not part.steps:
        factor = 1.0 if part.time is None else part.time.at(time)
        return part.space if part.time is None else _scaled(part.space, factor)
    times = [t for t, _ in part.steps]
    k = int(np.searchsorted(times, time, side="right"))
    if k == 0:
        return part.steps[0][1]
    before = part.steps[k - 1][1]
    if k == len(times) or not isinstance(before, NodeField | CellField):
        return before
    share = (time - times[k - 1]) / (times[k] - times[k - 1])
    return _sum(_scaled(before, 1.0 - share), part.steps[k][1], share)


def named_at(load: Load | None, name: str, time: float) -> Any:
    """The sum of all parts of a name at a time; None without any, or of several types."""
    parts = () if load is None else load.parts
    values = [part_at(p, time) for p in parts if p.name.strip() == name]
    return reduce(_sum, values) if len({type(v) for v in values}) == 1 else None


def _on_path(abscissas: NodeField, at: float) -> Point:
    """The point of a meshed line where its curvilinear abscissa is `at`, or the nearest end."""
    along = next(iter(abscissas.components.values()))
    order = np.argsort(along.values)
    nodes = abscissas.table.coordinates[along.nodes[order]]
    found = np.array([[np.interp(at, along.values[order], x) for x in nodes.T]])
    return Point(abscissas.table, int(abscissas.table.add(found)[0]))


_LOAD = arg("load", "CHARGEME", en="loading")
_TIME = arg("time", "FLOTTANT", en="time", unit="s", range=ANY_NUMBER)


@operator("TIRE", family="loads", full_name="TIRER", gives="|".join(_HELD))
def tire(
    call: Call,
    load: Load = _LOAD,
    time: float = _TIME,
    name: str | None = Opt("MOT", en="name of the parts, all without it"),
) -> Any:
    """Evaluate a loading."""
    parts = load.parts if name is None else _named(call, load, [name])
    values = [part_at(p, time) for p in parts]
    kinds = {type_of(v) for v in values}
    if len(kinds) > 1 or (len(values) > 1 and not kinds <= set(_SPACE)):
        raise call.error("operators.statics.parts-do-not-add-up", load, kinds=sorted(kinds))
    if not values:
        raise call.error("operators.statics.loading-empty", load)
    return reduce(_sum, values)


@tire.form(said("TABL"))
def tire_by_names(load: Load = _LOAD, time: float = _TIME) -> Table:
    """A table of the parts by their names."""
    made = Table()
    for part in load.parts:
        value, before = part_at(part, time), made.get(part.name)
        made.set(Mot(part.name), value if before is None else _sum(before, value))
    return made


def _named(call: Call, load: Load, names: list[str]) -> tuple[LoadPart, ...]:
    wanted = {n.rstrip()[:4].rstrip() for n in names}
    parts = tuple(p for p in load.parts if p.name in wanted)
    if not parts:
        known = " ".join(dict.fromkeys(p.name or "''" for p in load.parts))
        raise call.error("operators.statics.no-part-of-name", load, names=names, known=known)
    return parts


# ---- parts --------------------------------------------------------------------------------------


_MAIN = main("load", "CHARGEME", en="loading")
_NUMBER = opt("place", "ENTIER", default=1, en="number of the part", range=POSITIVE)
_PART = arg("name", "MOT", en="name of parts")


@EXTR.form(
    _MAIN,
    select(
        "what",
        {
            "CHAR": [_NUMBER],
            "CHAM": [_NUMBER],
            "EVOL": [_NUMBER],
            "LREE": [_NUMBER],
            "LOBJ": [_NUMBER],
            "COMP": [],
            "LIE": [],
            "LIBR": [],
        },
        optional=False,
        unless=lambda load: {p.name for p in getattr(load, "parts", ())},
        en="a part, its field, its curve, its times or objects, all names, the parts that follow "
        "the matter or not",
    ),
    gives=by(
        "what",
        {
            "CHAM": "|".join(_HELD),
            "EVOL": "EVOLUTIO",
            "LREE": "LISTREEL",
            "LOBJ": "LISTOBJE",
            "COMP": "LISTMOTS",
        },
        "CHARGEME",
    ),
)
def extr_load(call: Call, load: Load, what: Chosen) -> Any:
    """A part of a loading, by a word."""
    if what.word == "COMP":
        return ListMots([p.name for p in load.parts])
    if what.word in ("LIE", "LIBR"):
        return Load(tuple(p for p in load.parts if p.free == (what.word == "LIBR")))
    place = what["place"]
    if not 1 <= place <= len(load.parts):
        raise call.error(
            "operators.statics.no-part-of-number", place, n_parts=len(load.parts), place=place
        )
    part = load.parts[place - 1]
    if what.word == "CHAR":
        return Load((part,))
    if what.word == "CHAM":
        return part.space if part.space is not None else part.steps[0][1]
    if what.word in ("LREE", "LOBJ"):
        steps = _steps_of(part)
        if not steps:
            raise call.error("operators.statics.part-has-no-curve", load)
        times, objects = zip(*steps, strict=True)
        return ListReel.of(np.array(times)) if what.word == "LREE" else ListObje(objects)
    if part.time is None:
        raise call.error("operators.statics.part-has-no-curve", load)
    return part.time


@EXTR.form(gives=by("tables", {True: ("TABLE", "TABLE")}, "CHARGEME"))
def extr_named(
    call: Call,
    load: Load = _MAIN,
    name: str = _PART,
    tables: bool = Flag("TABL", en="as times and fields"),
) -> Load | tuple[Table, Table]:
    """The parts of a name, or the first of them as two tables."""
    parts = _named(call, load, [name])
    return _tables(parts[0]) if tables else Load(parts)


@EXTR.form()
def extr_names(
    call: Call, load: Load = _MAIN, names: ListMots = Arg("LISTMOTS", en="names of parts")
) -> Load:
    """The parts of some names."""
    return Load(_named(call, load, [str(w) for w in names.values]))


def _steps_of(part: LoadPart) -> list[tuple[float, Any]]:
    """Times and what is loaded at each, those of its curve where it has one."""
    if part.steps or part.time is None:
        return list(part.steps)
    times = part.time.parts[0].abscissas.tolist()
    return [(float(t), part_at(part, float(t))) for t in times]


def _tables(part: LoadPart) -> tuple[Table, Table]:
    steps = list(enumerate(_steps_of(part)))
    return Table.of({i: time for i, (time, _) in steps}), Table.of({i: f for i, (_, f) in steps})


@CHAN.form(said("TABL"), of=("CHARGEME",))
def in_steps(call: Call, load: Load = _LOAD, name: str = _PART) -> Load:
    """Parts of a name as fields at listed times."""
    chosen = _named(call, load, [name])
    times = sorted({t for p in chosen for t in _times(p)})
    steps = tuple((t, reduce(_sum, [part_at(p, t) for p in chosen])) for t in times)
    others = tuple(p for p in load.parts if p not in chosen)
    return Load((LoadPart(chosen[0].name, None, None, steps, free=chosen[0].free), *others))


def _times(part: LoadPart) -> list[float]:
    if part.steps:
        return [t for t, _ in part.steps]
    curve: Curve | None = part.time
    return [] if curve is None else [float(t) for t in curve.parts[0].abscissas]


@DIME.form()
def count_parts(load: Load = _MAIN) -> int:
    """Number of parts."""
    return len(load.parts)


@ENLE.form()
def without_parts(call: Call, load: Load = _MAIN, name: str = _PART) -> Load:
    """A loading without the parts of a name."""
    gone = _named(call, load, [name])
    return Load(tuple(p for p in load.parts if p not in gone))


@union(("CHARGEME", "CHARGEME"))
def _join(a: Load, b: Load) -> Load:
    return Load((*a.parts, *b.parts))
