"""EVOL 'RECO' and 'PJBA': curves in time of modal contributions, and of what they recombine to."""

from ssilang.kernel.modal.basis import work
from ssilang.kernel.statics.linear import product
from ssilang.operators.curves import evol
from ssilang.operators.curves.instants import tell_zero, value_in_time
from ssilang.operators.modal.basis import Shape, read_basis, shapes_of
from ssilang.operators.modal.recombination import contribution, modal_history, pseudo_shapes
from ssilang.operators.prelude import *


def _basis(call: Call, shapes_wanted: int | None = None) -> list[Shape]:
    operand = next((o for o in call.operands if isinstance(o.value, Table)), None)
    if operand is None:
        raise call.missing(("TABLE",))
    call.operands.remove(operand)
    return shapes_of(call, operand.value)[:shapes_wanted]


def contributions(fields: Sequence[Any], shapes: list[Shape]) -> FloatArray:
    """Values ALFA or BETA at the marks of the shapes, shape (n_fields, n_shapes)."""
    return np.array([contribution(f, shapes) for f in fields])


def _recombined(call: Call, colours: list[int]) -> Curve:
    first = next((o.value for o in call.operands if isinstance(o.value, ListChpo | Table)), None)
    if isinstance(first, Table):
        return _recombined_results(call, colours)
    fields, times, _ = evol.history(call)
    steps = call.given(evol.STEPS)
    shapes = _basis(call)
    shapes = shapes[: call.given(evol.COUNT)]
    fields, times = _at_steps(call, steps, fields, times)
    known = [s.field for s in shapes]
    names = evol.names_in_time(call, known)
    support = call.needed("POINT", "MAILLAGE")
    names = names or evol.names_in_time(call, known)
    if not names:
        raise call.missing(("MOT",))
    places_of = [(name, node) for name in names for node in support.value.node_ids.tolist()]
    return _curves(call, times, contributions(list(fields), shapes), known, places_of, colours)


def _curves(
    call: Call,
    times: FloatArray,
    weights: FloatArray,
    shapes: list[NodeField],
    places: list[tuple[str, int]],
    colours: list[int],
) -> Curve:
    """Curves of components at nodes: weights (m, n) times the n shapes there."""
    parts: list[CurvePart] = []
    for name, node in places:
        try:
            shape = value_in_time(call, list(shapes), name, node)
        except SsiError as refused:
            tell_zero(call, refused)
            shape = np.zeros(len(shapes))
        colour = colours[len(parts) % len(colours)]
        parts.append(CurvePart(times, weights @ shape, "TEMP", name, name, colour))
    return Curve(tuple(parts), workspace(call.session).title)


def _recombined_results(call: Call, colours: list[int]) -> Curve:
    """Of results of DYNE or PASAPAS, pseudo-modes that a load drives included."""
    results: Table = call.required("TABLE")
    basis = next((o.value for o in call.operands if isinstance(o.value, Table)), None)
    shapes = read_basis(call)
    load = call.optional("CHARGEME")
    quantity = call.keyword(("DEPL", "VITE", "ACCE")) or "DEPL"
    fields, times = modal_history(call, results, quantity)
    known = [s.field for s in shapes]
    pseudo = []
    if load is not None and quantity == "DEPL":
        if basis is None:
            raise call.error("operators.modal.pseudo-modes-want-basis", load)
        pseudo = pseudo_shapes(call, basis, load)
        known += [p.field for p in pseudo]
    places = _places_asked(call, known)
    at = call.given(evol.TIMES)
    fields, times = _about(call, at, fields, times)
    weights = np.column_stack([contributions(fields, shapes), *(p.at(times) for p in pseudo)])
    if at is not None:
        weights, times = _at(at, times, weights), np.asarray(at.values)
    return _curves(call, times, weights, known, places, colours)


def _places_asked(call: Call, fields: list[NodeField]) -> list[tuple[str, int]]:
    """Components and nodes: of a field CHPO1, or components of points."""
    chosen = call.read("CHPOINT")
    if chosen is not None:
        parts = chosen.value.components.items()
        return [(name, int(n)) for name, part in parts for n in part.nodes]
    support = call.read("POINT", "MAILLAGE")
    if support is None:
        raise call.missing(("POINT", "MAILLAGE", "CHPOINT"))
    names = evol.names_in_time(call, fields)
    if not names:
        raise call.missing(("MOT",))
    return [(name, node) for name in names for node in support.value.node_ids.tolist()]


def _about(
    call: Call, asked: ListReel | None, fields: Sequence[Any], times: FloatArray
) -> tuple[Sequence[Any], FloatArray]:
    """Fields and times on both sides of asked instants; all where none is asked for."""
    if asked is None or not len(asked):
        return fields, times
    wanted = asked.values
    span = 1e-9 * max(float(times[-1] - times[0]), 1e-300)
    if not (times[0] - span <= wanted.min() and wanted.max() <= times[-1] + span):
        raise call.error("operators.modal.no-such-time", asked, times=times[0], times_2=times[-1])
    after = np.searchsorted(times, wanted)
    kept = np.unique(np.clip([after - 1, after], 0, len(times) - 1))
    return [fields[i] for i in kept], times[kept]


def _at(asked: ListReel, times: FloatArray, weights: FloatArray) -> FloatArray:
    """Weights at asked instants, linear between the saved ones."""
    return np.stack([np.interp(asked.values, times, w) for w in weights.T], axis=1)


_SOLU = {"DEPL": "DEPLACEMENT", "VITE": "VITESSE", "ACCE": "ACCELERATION"}


def _of_contributions(call: Call, colours: list[int]) -> Curve:
    """EVOL 'SOLU': contributions in time of results of DYNE."""
    results: Table = call.required("TABLE")
    words = (*_SOLU, "TRAVAIL_INTERIEUR", "TRAVAIL_EXTERIEUR")
    word = call.keyword(words, length=9)
    if word is None:
        raise call.error("operators.modal.which-contributions", words=[f"'{w}'" for w in words])
    fields, times = modal_history(call, results, _SOLU.get(word, word))
    other = call.read("TABLE")
    if other is not None:
        shapes = shapes_of(call, other.value)
        call.keyword(("ALFA",))
        places = [(s.unknown, s.mark.node) for s in shapes if s.unknown == "ALFA"]
    else:
        places = _places_asked(call, list(fields[:1]))
    at = call.given(evol.TIMES)
    fields, times = _about(call, at, fields, times)
    weights = np.stack([value_in_time(call, list(fields), c, n) for c, n in places], axis=1)
    if at is not None:
        weights, times = _at(at, times, weights), np.asarray(at.values)
    parts = [
        CurvePart(times, weights[:, i], "TEMP", c, c, colours[i % len(colours)])
        for i, (c, _) in enumerate(places)
    ]
    return Curve(tuple(parts), workspace(call.session).title)


def _at_steps(
    call: Call, steps: ListEnti | None, fields: Sequence[Any], times: FloatArray
) -> tuple[Sequence[Any], FloatArray]:
    """Fields and times of some steps, by number; all where none is asked for."""
    if steps is None:
        return fields, times
    places = [int(i) - 1 for i in steps.values]
    if any(not 0 <= i < len(fields) for i in places):
        raise call.error("operators.modal.no-such-step", steps, count=len(fields))
    return [fields[i] for i in places], times[places]


def _projected(call: Call, colours: list[int]) -> Curve:
    fields, times, _ = evol.history(call)
    steps = call.given(evol.STEPS) if _lists_before_table(call) else None
    shapes = _basis(call)
    chosen = call.given(evol.SHAPES)
    matrix = call.optional("RIGIDITE")
    fields, times = _at_steps(call, steps, fields, times)
    numbers = list(range(1, len(shapes) + 1))
    if chosen is not None:
        numbers = [int(i) for i in chosen.values] if isinstance(chosen, ListEnti) else [chosen]
        if any(i > len(shapes) for i in numbers):
            raise call.error("operators.modal.no-such-shape", chosen, n_shapes=len(shapes))
    parts = []
    for k, number in enumerate(numbers):
        shape = shapes[number - 1].field
        dual = shape if matrix is None else product(matrix, shape)
        values = np.asarray([float(work(dual, f, same_names=matrix is None)) for f in fields])
        legend = f"{shapes[number - 1].unknown} {number}"
        colour = colours[k % len(colours)]
        parts.append(CurvePart(times, values, "TEMP", shapes[number - 1].unknown, legend, colour))
    return Curve(tuple(parts), workspace(call.session).title)


def _lists_before_table(call: Call) -> bool:
    """Whether a list of integers stands before the table of the basis."""
    found = (o.value for o in call.operands if isinstance(o.value, Table | ListEnti))
    return isinstance(next(found, None), ListEnti)


evol.KINDS["RECO"] = _recombined
evol.KINDS["PJBA"] = _projected
evol.KINDS["SOLU"] = _of_contributions
