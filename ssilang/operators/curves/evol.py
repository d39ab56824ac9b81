"""EVOL: curves from lists, along lines of nodes, in time."""

from weakref import WeakKeyDictionary

from ssilang.kernel.fields.node_algebra import component
from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.waves.shaken import axes_of, ground_along
from ssilang.language.vocabulary.unit_systems import result_unit
from ssilang.operators.curves import instants
from ssilang.operators.curves.words import COLOUR, axis_name, read_colours
from ssilang.operators.prelude import *

_SAME_STEP, _TIMES = 1e-3, 9.0  # of a record's step; times it, beyond which it is no time in s
_LISTS = ("LISTREEL", "LISTENTI", "LISTMOTS")


_ABSCISSA = opt("x_name", "MOT", en="name of the abscissas")
_ORDINATE = opt("y_name", "MOT", en="name of the ordinates")
_COMPONENT = opt("name", "MOT", en="component", kind="component")

_BASIS = arg("basis", "TABLE", "MMODEL", en="basis of shapes")
_X = arg("x", *_LISTS, en="abscissas", range=CARRIED)
_Y = arg("y", *_LISTS, en="ordinates", range=CARRIED)
_REALS = arg("x", "LISTREEL", en="abscissas", range=CARRIED)
_PARTS = (
    arg("first", "LISTREEL", en="first parts", range=CARRIED),
    arg("second", "LISTREEL", en="second parts", range=CARRIED),
)
TIMES = opt("times", "LISTREEL", en="their times", unit="s", range=ANY_NUMBER, usual=IN_ORDER)
_ITS_TIMES = arg(
    "times", "LISTREEL", en="times of the fields", unit="s", range=ANY_NUMBER, usual=IN_ORDER
)
STEPS = opt("steps", "LISTENTI", en="steps, all without it", range=NOT_NEGATIVE)
COUNT = opt("count", "ENTIER", range=POSITIVE, en="number of shapes, all without it")
SHAPES = opt("shapes", "ENTIER", "LISTENTI", en="shapes, all without it", range=POSITIVE)
_CELL = arg("cell", "ENTIER", en="zone, cell, point", range=POSITIVE)

# what EVOL reads, for its help
_ENTRIES: dict[str, list[Entry]] = {
    "MANU": [
        key("type", "TYPE", "MOT", en="type of the ordinates"),
        key("legend", "LEGE", "MOT", en="legend"),
        _ABSCISSA,
        _X,
        _ORDINATE,
        _Y,
    ],
    "COMP": [
        choice(
            "form", ("REIM", "MOPH"), en="real and imaginary parts (default), or modulus and phase"
        ),
        key(
            "legends",
            "LEGE",
            arg("first", "MOT", en="of the first"),
            arg("second", "MOT", en="of the second"),
            en="legends",
        ),
        _ABSCISSA,
        _REALS,
        _ORDINATE,
        _PARTS[0],
        opt("second_name", "MOT", en="name of the second"),
        _PARTS[1],
    ],
    "CHPO": [
        arg("field", "CHPOINT", en="field"),
        _COMPONENT,
        arg("line", "MAILLAGE", en="line"),
    ],
    "TEMP": [
        arg("history", "LISTCHPO", "TABLE", en="fields, or results"),
        TIMES,
        opt("index", "MOT", en="what of the results"),
        STEPS,
        opt(
            "names",
            "MOT",
            "LISTMOTS",
            en="component, or several",
            kind="component",
        ),
        opt("support", "POINT", "MAILLAGE", en="points"),
        many("cell", "ENTIER", en="zone, cell, point", range=POSITIVE),
    ],
    "RECO": [
        arg("history", "LISTCHPO", "TABLE", en="contributions in time"),
        TIMES,
        _BASIS,
        COUNT,
        opt("load", "CHARGEME", en="load of pseudo-modes"),
        choice(
            "quantity",
            ("DEPL", "VITE", "ACCE"),
            en="displacement (default), velocity or acceleration",
        ),
        _COMPONENT,
        opt("support", "POINT", "MAILLAGE", "CHPOINT", en="points"),
    ],
    "SOLU": [
        arg("results", "TABLE", en="results of DYNE"),
        choice(
            "quantity",
            ("DEPL", "VITE", "ACCE", "TRAVAIL_INTERIEUR", "TRAVAIL_EXTERIEUR"),
            en="what of them",
            length=9,
        ),
        opt("basis", "TABLE", en="basis"),
        flag("modes", "ALFA", en="of its modes"),
        opt("support", "POINT", "MAILLAGE", "CHPOINT", en="marks"),
        _COMPONENT,
        TIMES,
    ],
    "PJBA": [
        arg("history", "LISTCHPO", "TABLE", en="fields in time"),
        TIMES,
        STEPS,
        _BASIS,
        SHAPES,
        opt("metric", "RIGIDITE", en="matrix of the product"),
    ],
}


@operator(
    "EVOL",
    COLOUR,
    select("kind", _ENTRIES, en="where it comes from"),
    family="curves",
    full_name="EVOLUTION",
    reads_itself="names of axes are words of any kind, spelt as keywords or colours too",
)
def evol(call: Call) -> Curve:
    """Choose the kind of curve."""
    colours = read_colours(call)
    word = call.keyword(tuple(_ENTRIES))
    if word is None:
        raise call.error("operators.curves.which-curve", kinds=[f"'{w}'" for w in _ENTRIES])
    colours = colours or read_colours(call) or [workspace(call.session).colour]
    return KINDS[word](call, colours)


def _manual(call: Call, colours: list[int]) -> Curve:
    kind, legend = "", ""
    while (said := call.keyword(("TYPE", "LEGE"))) is not None:
        value = str(call.required("MOT", after=call.keyword_end))
        kind, legend = (value.strip().upper()[:4], legend) if said == "TYPE" else (kind, value)
    x_name = axis_name(call)
    x = call.given(_X)
    y_name = axis_name(call)
    y = call.given(_Y)
    if len(x) != len(y):
        raise call.error(
            "operators.curves.abscissas-and-ordinates-differ", y, n_x=len(x), n_y=len(y)
        )
    marks = tuple(x.values) if isinstance(x, ListMots) else ()
    abscissas = np.arange(1.0, len(x) + 1) if marks else x.values.astype(float)
    words: tuple[str, ...] = ()
    if isinstance(y, ListMots):
        words, ordinates = tuple(y.values), np.arange(1.0, len(y) + 1)
    else:
        ordinates = y.values.astype(float)
    file, step = workspace(call.session).record_of(ordinates)
    given = float(np.median(np.diff(abscissas))) if file else 0.0
    if file and abs(given - step) > _SAME_STEP * step and step / _TIMES < given < _TIMES * step:
        told = {"file": file, "step": step, "given": given, "slower": given > step}
        call.warn("operators.curves.record-at-other-step", x, **told)
    made = {ListMots: "MOTS", ListEnti: "ENTI", ListReel: ""}[type(y)]
    part = CurvePart(
        abscissas, ordinates, x_name[:12], y_name[:12], legend.strip(), colours[0],
        words, kind if kind not in ("", "REEL") else made, marks,
    )  # fmt: skip
    return Curve((part,), workspace(call.session).title)


def _complex(call: Call, colours: list[int]) -> Curve:
    form, legends = "REIM", ["", ""]
    while (said := call.keyword(("REIM", "MOPH", "LEGE"))) is not None:
        if said == "LEGE":
            legends = [str(call.required("MOT")), str(call.required("MOT"))]
        else:
            form = said
    x_name = axis_name(call)
    x = call.given(_REALS)
    names, values = [], []
    for part in _PARTS:
        names.append(axis_name(call))
        values.append(call.given(part).values)
    if len({len(x), len(values[0]), len(values[1])}) > 1:
        raise call.error(
            "operators.curves.lists-differ", x, n_x=len(x), n_values=len(values[0]),
            n_values_2=len(values[1]),
        )  # fmt: skip
    kinds = ("PREE", "PIMA") if form == "REIM" else ("MODU", "PHAS")
    default = ("Re", "Im") if form == "REIM" else ("Amp", "Phi")
    parts = []
    for i, (name, y) in enumerate(zip(names, values, strict=True)):
        legend, colour = legends[i] or default[i], colours[min(i, len(colours) - 1)]
        part = CurvePart(x.values, y, x_name[:12], name[:12], legend, colour, (), kinds[i])
        parts.append(part)
    return Curve(tuple(parts), workspace(call.session).title, "COMPLEXE")


# ---- along lines --------------------------------------------------------------------------------


def _along_line(call: Call, colours: list[int]) -> Curve:
    field: NodeField = call.required("CHPOINT")
    said = call.read("MOT")
    line: Mesh = call.required("MAILLAGE")
    if said is None:
        said = call.read("MOT")
    name = str(said.value).rstrip() if said is not None else _only(call, field)
    part = component(field, name)
    kinds = {b.cell_type for b in line.blocks}
    nodes = line.node_ids if kinds == {"POI1"} else line_chain(line)
    x = line.nodes.coordinates[nodes]
    steps = np.linalg.norm(np.diff(x, axis=0), axis=1)
    s = np.concatenate(([0.0], np.cumsum(steps)))
    missing = ~np.isin(nodes, part.nodes)
    if np.all(missing):
        raise instants.refused_place(call, [field], name, int(nodes[0]))
    if np.any(missing):
        call.session.warn(
            "operators.curves.no-value-on-line", call.span, operator="EVOL", name=name,
            n_missing=missing.sum(), n_nodes=len(nodes),
        )  # fmt: skip
    made = CurvePart(s, part.at(nodes), "ABS", name, "", colours[0])
    return Curve((made.measured("m"),), workspace(call.session).title)


def _only(call: Call, field: NodeField) -> str:
    names = list(field.components)
    if len(names) != 1:
        raise call.error("operators.curves.which-component", field, names=names)
    return names[0]


# ---- in time ------------------------------------------------------------------------------------

MISSING = object()
_NONE = 1e-12  # of the model's size: what a body at rest moves by rounding
_LOOKED_AT: WeakKeyDictionary[Any, set[int]] = WeakKeyDictionary()
"""Nodes whose motion was read of what a calculation has recorded."""
_ROUNDING = 1e-9  # of another translation of the same point
_LOST = 5.0  # % of a largest value that may stand between two instants


def _unit_in_time(results: Table | None, index: str, name: str) -> str:
    """SI unit of a component of what a calculation has left, '' where that is not certain."""
    if isinstance(results, LazyRows) or (results and results.subtype in ("DYNAMIC", "PASAPAS")):
        return result_unit(name, index)
    return ""


def _in_time(call: Call, colours: list[int]) -> Curve:
    results = next((o.value for o in call.operands if isinstance(o.value, Table)), None)
    fields, times, title = history(call, unmade=True)
    results = results if title else None
    chosen = call.given(STEPS)
    if chosen is not None:
        places = chosen.values - 1 if not title else chosen.values
        if np.any(places < 0) or np.any(places >= len(fields)):
            raise call.error("operators.curves.no-such-step", chosen, n_fields=len(fields))
        fields, times = [fields[int(i)] for i in places], times[places]
    if isinstance(fields, instants.RecordedPoints) or (fields and isinstance(fields[0], CellField)):
        return _in_a_cell(call, fields, times, colours[0], partial(_unit_in_time, results, title))
    names = names_in_time(call, fields)
    support = call.needed("POINT", "MAILLAGE")
    names = names or names_in_time(call, fields)
    if not names:
        names = [_only(call, _made(fields[0]))] if fields else []
    nodes = support.value.node_ids.tolist()
    called = _point_names(call, support)
    parts: list[CurvePart] = []
    for name in names:
        relative = _are_relative(fields, title, name)
        for node in nodes:
            values = instants.value_in_time(call, fields, name, node)
            _tell_peak(call, fields, values, name)
            _tell_rounding(call, fields, values, name, node)
            legend = f"{name} {called[node]}"
            colour = colours[len(parts) % len(colours)]
            made = CurvePart(times, values, "TEMP", name, legend, colour)
            parts.append(made.measured("s", _unit_in_time(results, title, name), relative))
    return Curve(tuple(parts), workspace(call.session).title)


def _are_relative(fields: Sequence[Any], index: str, name: str) -> bool:
    """Whether results are accelerations relative to a ground that shakes along their axis."""
    if index != "ACCE" or not isinstance(fields, instants.RecordedFields):
        return False

    return bool(ground_along(fields.track.problem, name).any())


def _tell_peak(call: Call, fields: Sequence[Any], values: FloatArray, name: str) -> None:
    """Warn where a largest value may stand between instants that are kept, of more that were not.

    The parabola through it and its neighbours bends by an eighth of the second difference.
    """
    if not isinstance(fields, instants.RecordedFields) or len(fields) != len(values):
        return
    steps, top = len(fields.track.wanted), int(np.abs(values).argmax())
    code = "operators.curves.peak-between"
    size = float(np.ptp(fields.track.problem.numbering.table.coordinates, axis=0).max())
    rounding = abs(values[top]) <= _NONE * size
    if len(values) == steps or rounding or not 0 < top < len(values) - 1:
        return
    bend = abs(values[top - 1] - 2.0 * values[top] + values[top + 1]) / 8.0
    told = {"share": 100.0 * bend / (abs(values[top]) or 1.0), "kept": len(values), "steps": steps}
    if told["share"] > _LOST and not call.session.warned(code):
        call.warn(code, name=name, **told)


def _tell_rounding(
    call: Call, fields: Sequence[Any], values: FloatArray, name: str, node: int
) -> None:
    """Warn of a translation that is free and stays at nought where the point moves along others.

    A script that has looked at these first knows, and asks what is left.
    """
    if not isinstance(fields, instants.RecordedFields):
        return
    from ssilang.kernel.stepping.problem.bodies import held

    problem, code = fields.track.problem, "operators.curves.only-rounding"
    found = {n: fields.track.history(fields.name, n, node) for n in axes_of(problem)}
    ways = {n: float(np.abs(v).max(initial=0.0)) for n, v in found.items() if v is not None}
    other = max(ways, key=lambda n: ways[n], default="")
    if name not in ways or ways[name] > _ROUNDING * ways[other] or not ways[other]:
        if values.any():
            _LOOKED_AT.setdefault(fields.track, set()).add(node)
        else:
            _tell_held_side(call, fields, name, node)
            if name in ways and held(problem)[problem.numbering.index_of(node, name)]:
                _tell_held_top(call, fields, name, node)
        return
    free = not held(problem)[problem.numbering.index_of(node, name)]
    known = node in _LOOKED_AT.get(fields.track, ())
    if free and not known and not call.session.warned(code):
        told = {"most": float(np.abs(values).max(initial=0.0)), "other": other}
        node_told = problem.numbering.table.told(node)
        call.warn(code, name=name, node=node_told, **told, moved=ways[other])


def _tell_held_side(call: Call, fields: instants.RecordedFields, name: str, node: int) -> None:
    """Warn of a fixed side of a joint that is read, and its other side moves and was not."""
    problem, code = fields.track.problem, "operators.curves.held-side"
    table = problem.numbering.table
    for joint in problem.interface.joints:
        ends = np.stack([table.resolve(s).ravel() for s in (joint.lower, joint.upper)])
        for other in ends[::-1][ends == node][:1].tolist():
            found = fields.track.history(fields.name, name, other)
            moved = 0.0 if found is None else float(np.abs(found).max(initial=0.0))
            known = other in _LOOKED_AT.get(fields.track, ())
            if moved and not known and not call.session.warned(code):
                told = {"node": table.told(node), "other": table.told(other), "moved": moved}
                call.warn(code, name=name, **told)


def _tell_held_top(call: Call, fields: instants.RecordedFields, name: str, node: int) -> None:
    """Warn of a held node that is the highest: a base may be looked at, a top is meant to move."""
    problem = fields.track.problem
    table, up = problem.numbering.table, len(axes_of(problem)) - 1
    top = float(table.coordinates[problem.numbering.nodes, up].max())
    if table.coordinates[node, up] == top and problem.loading.forces.any():
        call.warn("operators.curves.held-there", name=name, node=table.told(node))


def _point_names(call: Call, support: Operand) -> dict[int, str]:
    """What a legend calls nodes: the script's names of the points, else their numbers."""
    named = reversed(call.session.frame.named().items())
    points = {p.node: name for name, p in named if isinstance(p, Point)}
    found = {node: points.get(node, str(node + 1)) for node in support.value.node_ids.tolist()}
    if isinstance(support.value, Point) and support.name:
        found[support.value.node] = support.name
    return found


def _made(field: NodeField | instants.InstantField) -> NodeField:
    return field.make() if isinstance(field, instants.InstantField) else field


def _in_a_cell(
    call: Call,
    fields: Sequence[Any],
    times: FloatArray,
    colour: int,
    unit_of: Callable[[str], str],
) -> Curve:
    """Component of fields in cells at point N3 of cell N2 of zone N1."""
    name = str(call.required("MOT")).rstrip()
    zone, cell, point = (call.given(_CELL) for _ in range(3))
    legend = f"{name} {zone} {cell} {point}"
    recorded, values = None, list[float]()
    if isinstance(fields, instants.RecordedPoints):
        recorded = fields.history(name, zone, cell, point)
        fields = fields[:1] if recorded is None else ()  # the others lack it too
    for field in fields:
        held = field.blocks[zone - 1].components.get(name) if zone <= len(field.blocks) else None
        if held is None or cell > len(held):
            raise call.error(
                "operators.curves.no-value-at-point", name=name, zone=zone, cell=cell, point=point
            )
        row = held[cell - 1]
        values.append(float(row[min(point, len(row)) - 1]))
    ordinates = np.asarray(values) if recorded is None else recorded
    part = CurvePart(times, ordinates, "TEMP", name[:12], legend, colour)
    return Curve((part.measured("s", unit_of(name)),), workspace(call.session).title)


def names_in_time(call: Call, fields: Sequence[Any]) -> list[str]:
    operand = call.read("LISTMOTS")
    if operand is not None:
        return [str(w).rstrip() for w in operand.value.values]
    word = call.peek_word()
    if word is not None and (
        call.at_word() or word.rstrip() in instants.components_in_time(fields)
    ):
        return [str(call.word()).rstrip()]
    return []


def history(call: Call, unmade: bool = False) -> tuple[Sequence[Any], FloatArray, str]:
    """Fields, their times, and the index of the table they came from ('' for a list).

    With `unmade`, an `InstantField` may stand for a field that nobody asked for yet.
    """
    operand = call.needed("LISTCHPO", "TABLE")
    if isinstance(operand.value, ListChpo):
        times = call.given(_ITS_TIMES).values
        fields = list(operand.value.values)
        if len(times) != len(fields):
            told = {"n_fields": len(fields), "n_times": len(times)}
            raise call.error("operators.curves.fields-and-times-differ", operand.value, **told)
        return fields, times, ""
    table: Table = operand.value
    index = "DEPLACEMENTS" if table.has("DEPLACEMENTS") else "DEPL"
    said = call.peek_word()
    if said is not None and _holds(table, said.rstrip()):
        index = str(call.word()).rstrip()
    found, times = results_in_time(table, index, unmade)
    call.tell_odd(_ITS_TIMES, Operand(ListReel.of(times), operand.span))
    return found, times, index


def _holds(table: Table, index: str) -> bool:
    """Whether a table of results has the index, itself (PASAPAS) or in its steps (DYNAMIC)."""
    if isinstance(table, LazyRows) and table.promises(index):
        return True
    steps = (value for place, value in table.items() if type(place) is int)
    return table.has(index) or any(isinstance(s, Table) and s.has(index) for s in steps)


def results_in_time(
    table: Table, index: str, unmade: bool = False
) -> tuple[Sequence[Any], FloatArray]:
    """Fields and times of a table of results: of PASAPAS by index, of DYNAMIC by step.

    Parameters
    ----------
    unmade : bool
        Whether an `InstantField` may stand for a field that is not made yet, and what was recorded
        for all of them.

    Raises
    ------
    KernelError
        If the table holds no such results.
    """
    held, times = table.get(index), table.get("TEMPS")
    if isinstance(held, Table) and isinstance(times, Table):
        steps = sorted(i for i, _ in held.items() if type(i) is int)
        return [held.get(i) for i in steps], np.array([times.get(i) for i in steps], dtype=float)
    found = []
    if unmade and isinstance(table, LazyRows) and table.untouched:
        ready = table.stand_ins(index)
        if ready is not None:  # in order of time as they came
            return ready
    for place, value in table.items():
        if type(place) is int and isinstance(value, Table):
            look = value.glance if unmade and isinstance(value, LazyTable) else value.get
            field = look(index, MISSING)
            if field is not MISSING:
                found.append((value.get("TEMP", place), field))
    if not found:
        raise KernelError("operators.curves.no-results-in-time", index=index)
    found.sort(key=lambda pair: float(str(pair[0])))
    return [f for _, f in found], np.array([t for t, _ in found], dtype=float)


KINDS: Filled[str, Callable[[Call, list[int]], Curve]] = Filled("kinds of curves")
"""What makes the curve, by the word of EVOL; those of modal bases are added by their module."""
KINDS["MANU"] = _manual
KINDS["COMP"] = _complex
KINDS["CHPO"] = _along_line
KINDS["TEMP"] = _in_time
