"""RECO: fields on the body from the contributions of modes and static shapes."""

from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.matrices.matrix import imaginary
from ssilang.kernel.modal.basis import combined
from ssilang.kernel.stepping.problem.loading import terms_of
from ssilang.operators.curves.evol import results_in_time
from ssilang.operators.curves.instants import MadeFields
from ssilang.operators.modal.basis import BASIS, Shape, basis_shapes, shapes_in
from ssilang.operators.prelude import *

QUANTITIES = ("DEPL", "VITE", "ACCE", "CONT", "REAC")
_INDEX = {
    "DEPL": "DEPLACEMENT", "VITE": "VITESSE", "ACCE": "ACCELERATION", "CONT": "DEPLACEMENT",
    "REAC": "DEPLACEMENT",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class PseudoShape:
    """A pseudo-mode and its amplitude in time: what neglected modes answer to a load at once."""

    entry: Table
    curves: tuple[tuple[float, FloatArray, FloatArray], ...]
    """Factors of curves (abscissas, ordinates), linear between points."""

    @property
    def field(self) -> NodeField:
        """Its displacement."""
        value = self.entry.get(Mot("DEPLACEMENT"))
        assert isinstance(value, NodeField)
        return value

    def at(self, times: FloatArray) -> FloatArray:
        """Amplitudes (m,) at times."""
        total = np.zeros(len(times))
        for factor, x, y in self.curves:
            total += factor * np.interp(times, x, y)
        return total


def pseudo_shapes(call: Call, basis: Table, load: Load) -> list[PseudoShape]:
    """Pseudo-modes of a basis ('PSEUDO_MODES') that parts of a load drive.

    A part drives the pseudo-mode whose force (or projected force) is proportional to it.
    """
    table = basis.get(Mot("PSEUDO_MODES"))
    if not isinstance(table, Table):
        raise call.error("operators.modal.load-counts-pseudo-modes", basis)
    found = []
    for index, entry in table.items():
        if type(index) is not int or not isinstance(entry, Table):
            continue
        references = _references(entry, shapes_in(basis))
        curves = []
        for part in load.parts:
            for field, (x, y) in terms_of(part):
                factor = next((f for r in references if (f := ratio(field, r)) is not None), None)
                if factor is not None:
                    curves.append((factor, x, y))
        if curves:
            found.append(PseudoShape(entry, tuple(curves)))
    return found


def _references(entry: Table, shapes: list[Shape]) -> list[NodeField]:
    """Loads of one unit of a pseudo-mode: forces on the body, forces on the modes."""
    given = [entry.get(Mot(name)) for name in ("CHAMP_BASE_B", "CHAMP_BASE_A")]
    found = [f for f in given if isinstance(f, NodeField)]
    direction = entry.get(Mot("DIRECTION"))
    if isinstance(direction, int):
        values = {}
        for s in shapes:
            along = s.entry.get(Mot("DEPLACEMENTS_GENERALISES"))
            number = along.get(direction) if isinstance(along, Table) else None
            if isinstance(number, int | float):
                values[s.mark.node] = -float(number)
        nodes = np.array(sorted(values), dtype=np.int64)
        part = NodeValues(nodes, np.array([values[int(n)] for n in nodes]))
        if values:
            found.append(NodeField(shapes[0].mark.nodes, {"FALF": part}, "DISCRET"))
    return found


def ratio(field: object, reference: NodeField) -> float | None:
    """Factor f with field = f x reference, None if they are not proportional."""
    if not isinstance(field, NodeField):
        return None
    names = set(field.components) | set(reference.components)
    pairs = []
    for name in sorted(names):
        nodes = [f.components[name].nodes for f in (field, reference) if name in f.components]
        all_nodes = np.unique(np.concatenate(nodes))
        pairs.append([f.values_at(name, all_nodes) for f in (field, reference)])
    a, b = (np.concatenate([p[i] for p in pairs]) for i in (0, 1)) if pairs else (np.zeros(0),) * 2
    size = float(b @ b)
    if size == 0.0:
        return None
    factor = float(a @ b) / size
    return factor if np.abs(a - factor * b).max() <= 1e-8 * np.abs(a).max() else None


def recombined(weights: Any, shapes: list[Shape]) -> NodeField:
    """Sum of shapes times the values ALFA and BETA of a field at their marks.

    Imaginary parts (IALF, IBET: harmonic responses) give components IUX ... besides.
    """
    fields = [s.field for s in shapes]
    real = combined(contribution(weights, shapes), fields)
    if not any(imaginary(s.unknown) in weights.components for s in shapes):
        return real
    other = combined(contribution(weights, shapes, imaginary), fields)
    parts = {imaginary(name): part for name, part in other.components.items()}
    return NodeField(real.table, {**real.components, **parts}, real.nature)


def contribution(
    weights: Any, shapes: list[Shape], name: Callable[[str], str] = str
) -> list[float]:
    """Values ALFA or BETA of a field (or what `name` makes of these) at the marks of the shapes."""
    return [float(weights.values_at(name(s.unknown), np.array([s.mark.node]))[0]) for s in shapes]


def modal_history(call: Call, table: Table, quantity: str) -> tuple[Sequence[Any], FloatArray]:
    """Contributions in time of the results of DYNE or of PASAPAS, and the times."""
    name = _INDEX.get(quantity, quantity)
    if table.subtype != "RESULTAT_DYNE":
        plural = {"ACCELERATION": "ACCELERATIONS"}.get(name, name + "S")
        return results_in_time(table, plural)
    times = table.get(Mot("TEMPS_DE_SORTIE"))
    assert isinstance(times, ListReel)
    lists = table.get(Mot(name))
    kept = lists.items() if isinstance(lists, Table) else ()  # TYPE_SORTIE: LISTREEL
    marks = [(k, v.values) for k, v in kept if isinstance(k, Point) and isinstance(v, ListReel)]

    def saved(place: int) -> Any:
        """The contributions of one instant."""
        if marks:
            values = np.array([v[place] for _, v in marks])
            at = np.array([k.node for k, _ in marks])
            return NodeField.of(marks[0][0].nodes, at, {"ALFA": values, "BETA": values})
        entry = table.get(int(place) + 1)
        field = entry.get(Mot(name)) if isinstance(entry, Table) else None
        if field is None:
            raise call.error("operators.modal.results-hold-no-steps", table, name=name)
        return field

    return MadeFields(len(times), saved), times.values


def at_time(call: Call, fields: Sequence[Any], times: FloatArray, time: float) -> NodeField:
    """A field in time at one instant, linear between the saved ones."""
    span = 1e-9 * max(float(times[-1] - times[0]), 1e-300)
    if not times[0] - span <= time <= times[-1] + span:
        raise call.error("operators.modal.no-such-time", time, times=times[0], times_2=times[-1])
    i = int(np.clip(np.searchsorted(times, time) - 1, 0, max(len(times) - 2, 0)))
    if len(times) == 1:
        return fields[0]  # type: ignore[no-any-return]
    part = float(np.clip((time - times[i]) / (times[i + 1] - times[i]), 0.0, 1.0))
    return combined([1.0 - part, part], [fields[i], fields[i + 1]])


_QUANTITY = choice(
    "quantity",
    QUANTITIES,
    default="DEPL",
    en="displacement (default), velocity, acceleration, stresses, reactions",
)
_LOAD = opt("load", "CHARGEME", en="load of pseudo-modes")


@operator("RECO", main("weights", "CHPOINT", en="contributions"), BASIS, family="modal")
def _reco(
    call: Call,
    weights: NodeField,
    basis: Chosen,
    quantity: str = _QUANTITY,
    load: Load | None = _LOAD,
    time: float | None = Opt(
        "FLOTTANT", en="number of shapes to take; instant of the load", range=ANY_NUMBER
    ),
) -> NodeField | CellField:
    shapes = basis_shapes(call, basis)
    if time is not None and load is None:  # a number of shapes to take
        shapes = shapes[: _count(call, time)]
    return _combined(call, weights, shapes, basis, quantity, load, time)


def _pseudo(
    call: Call, basis: Chosen, quantity: str, load: Load | None, time: float | None
) -> list[PseudoShape]:
    """Pseudo-modes that a load drives."""
    if load is None or quantity not in ("DEPL", "CONT", "REAC"):
        return []
    if time is None or basis.word != "tables":
        raise call.error("operators.modal.pseudo-modes-want-basis-and-time", load)
    return pseudo_shapes(call, basis["tables"][0], load)


def _combined(
    call: Call,
    weights: NodeField,
    shapes: list[Shape],
    basis: Chosen,
    quantity: str,
    load: Load | None,
    time: float | None,
) -> NodeField | CellField:
    """What contributions at an instant combine to."""
    pseudo = _pseudo(call, basis, quantity, load, time)
    if quantity == "CONT":
        # Sum of the stresses of shapes (CONTRAINTE_MODALE, CONTRAINTE), as SIGS gives them.
        total: CellField | None = None
        for factor, entry in _weighted(weights, shapes, pseudo, time):
            stress = entry.get("CONTRAINTE_MODALE", entry.get("CONTRAINTE"))
            if not isinstance(stress, CellField):
                raise call.error("operators.modal.shape-no-stresses", entry)
            first = total is None
            total = cell_algebra.added(stress if total is None else total, stress, factor - first)
        assert total is not None
        return total
    if quantity == "REAC":
        return _reactions(call, weights, shapes, pseudo, time)
    field = recombined(weights, shapes)
    if pseudo:
        amplitudes = [float(p.at(np.array([time]))[0]) for p in pseudo]
        field = node_algebra.added(field, combined(amplitudes, [p.field for p in pseudo]))
    return field


def _count(call: Call, number: float) -> int:
    if number != int(number) or number < 1:
        raise call.error("operators.modal.least-mode-recombined-not", number, number=number)
    return int(number)


def _weighted(
    weights: Any, shapes: list[Shape], pseudo: list[PseudoShape], time: float | None
) -> list[tuple[float, Table]]:
    """Tables of shapes and pseudo-modes, and how much of each there is."""
    factors = contribution(weights, shapes)
    entries = [(f, s.entry) for f, s in zip(factors, shapes, strict=True)]
    return entries + [(float(p.at(np.array([time]))[0]), p.entry) for p in pseudo]


def _reactions(
    call: Call, weights: Any, shapes: list[Shape], pseudo: list[PseudoShape], time: float | None
) -> NodeField:
    """Sum of the reactions of shapes (REACTION_MODALE, REACTION), as REAC gives them."""
    entries = _weighted(weights, shapes, pseudo, time)
    fields = []
    for _, entry in entries:
        field = entry.get("REACTION_MODALE", entry.get("REACTION"))
        if not isinstance(field, NodeField):
            raise call.error("operators.modal.shape-no-reactions", entry)
        fields.append(field)
    return combined([f for f, _ in entries], fields)


@_reco.form()
def reco_of_results(
    call: Call,
    results: Table = Main("TABLE", en="results of DYNE or PASAPAS"),
    basis: Chosen = BASIS,
    quantity: str = _QUANTITY,
    load: Load | None = _LOAD,
    time: float = Arg("FLOTTANT", en="instant", unit="s", range=ANY_NUMBER),
) -> NodeField | CellField:
    """What results in time combine to at an instant."""
    shapes = basis_shapes(call, basis)
    weights = at_time(call, *modal_history(call, results, quantity), time)
    return _combined(call, weights, shapes, basis, quantity, load, time)


@_reco.form(
    main("fields", "LISTCHPO", en="contributions"),
    BASIS,
    opt("count", "ENTIER", range=POSITIVE, en="number of shapes, all without it"),
)
def reco_of_list(call: Call, fields: ListChpo, basis: Chosen, count: int | None) -> ListChpo:
    """What each field of a list combines to."""
    shapes = basis_shapes(call, basis)
    if count is not None:
        shapes = shapes[: _count(call, count)]
    return ListChpo([recombined(f, shapes) for f in fields.values])
