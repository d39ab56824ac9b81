"""Stages of PASAPAS: models, characteristics and supports that the load gives in time.

A model that changes (CHAR 'MODE') builds and digs: cells that come are without stress where they
come, cells that go take their forces away.
"""

from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.zone_fields import cell_rows, n_points
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.kinematics import element_sides
from ssilang.kernel.matrices.submatrices import together
from ssilang.kernel.stepping.snapshot import Receiver, Snapshot
from ssilang.operators.matrices.element import joined
from ssilang.operators.prelude import *
from ssilang.operators.statics.loads_in_time import part_at
from ssilang.operators.statics.pasapas_materials import Varying, same_fields
from ssilang.operators.statics.pasapas_results import ResultTables
from ssilang.operators.statics.pasapas_steering import working_table
from ssilang.operators.tables.entries import Entries

STAGED = {
    "MODE": ("MODELE", "MMODEL"),
    "MATE": ("CARACTERISTIQUES", "MCHAML"),
    "BLOM": ("BLOCAGES_MECANIQUES", "RIGIDITE"),
}
"""Entry, and its type, that the parts of a load by these names stand for."""


@dataclass(frozen=True)
class Stage:
    """Steps over which nothing changes.

    Attributes
    ----------
    entries : Entries
        With the model, characteristics and supports of these steps.
    """

    entries: Entries
    steps: int


def loads_taken(entries: Entries) -> Entries:
    """The entries, those of STAGED that are loads being parts of CHARGEMENT; the table stays."""
    words = [word for word, _ in STAGED.values() if isinstance(entries.get(word), Load)]
    if not words:
        return entries
    table, loads = working_table(entries.table), [entries.get(w) for w in ("CHARGEMENT", *words)]
    for word in words:
        table.remove(word)
    parts = (part for load in loads if load is not None for part in load.parts)
    table.set(Mot("CHARGEMENT"), Load(tuple(parts)))
    return Entries(entries.call, table, entries.procedure)


def stage_of(work: Entries, times: FloatArray) -> Stage:
    """The first stage of times[1:], times[0] being where it starts."""
    load: Load | None = work.get("CHARGEMENT")
    every = () if load is None else load.parts
    parts = [p for p in every if p.name.strip() in STAGED]
    first = _at(work, parts, float(times[1]))
    steps = 1
    while steps < len(times) - 1 and _same(first, _at(work, parts, float(times[steps + 1]))):
        steps += 1
    table = working_table(work.table)
    staged = Entries(work.call, table, work.procedure)
    for word, values in first.items():
        table.set(Mot(STAGED[word][0]), _joined(work, word, values))
    rest = tuple(p for p in every if p not in parts)
    varying = Varying(staged.get("MODELE"), staged.get("CARACTERISTIQUES"), rest)
    fields, n = varying.fields(float(times[1])), 1
    while n < steps and same_fields(fields, varying.fields(float(times[n + 1]))):
        n += 1
    for told in varying.beyond(fields):
        if not work.call.session.warned("operators.fields.beyond-law", name=told["name"]):
            work.warn("operators.fields.beyond-law", **told)
    warm = any(p.name.strip() == "T" for p in rest)
    reference = varying.reference() if warm else ()
    if not (parts or fields or reference):
        return Stage(work, steps)
    table.set(Mot("CARACTERISTIQUES"), varying.at(fields))
    acting = [p for p in varying.acting if not parts or _acts(p, times[: n + 1])]
    table.set(Mot("CHARGEMENT"), Load((*acting, *reference)))
    return Stage(staged, n)


def _acts(part: LoadPart, times: FloatArray) -> bool:
    """Whether a load is ever other than zero: if not, the cells that it waits for may lack."""
    return part.time is None or any(part.time.at(float(t)) != 0.0 for t in times)


def _at(work: Entries, parts: list[LoadPart], time: float) -> dict[str, list[Any]]:
    """What the parts give at a time, by their name."""
    found: dict[str, list[Any]] = {}
    for part in parts:
        word = part.name.strip()
        kind = {"MODE": Model, "MATE": CellField, "BLOM": Matrix}[word]
        value = part.space if part.time is None and not part.steps else None
        if value is None and (part.steps or word == "MATE"):
            value = part_at(part, time)
        if not isinstance(value, kind):
            raise work.error(
                "operators.statics.no-load-at-time", word=word, staged=STAGED[word][1], time=time
            )
        found.setdefault(word, []).append(value)
    return found


def _same(first: dict[str, list[Any]], second: dict[str, list[Any]]) -> bool:
    return all(a is b for word in first for a, b in zip(first[word], second[word], strict=True))


def _joined(work: Entries, word: str, values: list[Any]) -> Any:
    """The parts together; supports join those that always hold."""
    if word == "MODE":
        return values[0] if len(values) == 1 else Model(tuple(z for m in values for z in m.zones))
    if word == "MATE":
        return joined(tuple(values))
    always = work.get("BLOCAGES_MECANIQUES")
    return together(*(values if always is None else [always, *values]))


@dataclass
class Reached(Receiver):
    """Keeps the state at the end of a stage."""

    results: ResultTables
    n_times: int
    values: dict[str, Any] = field(default_factory=dict)

    @property
    def wanted(self) -> NDArray[np.bool_]:
        """The last time alone."""
        return np.arange(self.n_times) == self.n_times - 1

    def receive(self, snapshot: Snapshot) -> None:
        """The last time."""
        self.values = self.results.values(snapshot)


def entering(state: Table, model: Model | None) -> Table:
    """A state for a stage's model: cells that come have no stress, no history, no jump."""
    made = Table()
    for index, value in state.items():
        if isinstance(value, CellField) and model is not None:
            value = completed(value, model, str(index) == "CONTRAINTES")
        if isinstance(value, NodeField) and model is not None and index == "DEPLACEMENTS":
            value = laid_on(value, model)
        made.set(index, value)
    return made


def laid_on(displacement: NodeField, model: Model) -> NodeField:
    """A displacement in which new faces of joints lie where the faces before them have gone."""
    components = dict(displacement.components)
    for zone in (z for z in model.zones if is_joint(z)):
        upper, lower = (displacement.table.resolve(side).ravel() for side in element_sides(zone))
        for name, part in components.items():
            for new, old in ((upper, lower), (lower, upper)):
                comes = ~np.isin(new, part.nodes) & np.isin(old, part.nodes)
                nodes, first = np.unique(new[comes], return_index=True)
                values = part.at(old[comes][first])
                every = np.concatenate([part.nodes, nodes])
                order = np.argsort(every, kind="stable")
                part = NodeValues(every[order], np.concatenate([part.values, values])[order])
            components[name] = part
    return NodeField(displacement.table, components, displacement.nature)


def completed(given: CellField, model: Model, whole: bool) -> CellField:
    """A field with zeros on the cells of a model that it lacks.

    Parameters
    ----------
    whole : bool
        True fills zones of which no cell has a value too (stresses).
    """
    more: list[CellFieldBlock] = []
    for zone in model.zones:
        if zone.formulation == "MECANIQUE":
            more += _missing(given, zone, whole)
    return CellField((*given.blocks, *more), given.title) if more else given


def _missing(given: CellField, zone: Zone, whole: bool) -> list[CellFieldBlock]:
    lacking = np.ones(len(zone.cells), bool)
    names: tuple[str, ...] = ()
    for block in given.blocks:
        if block.cells is zone.cells:
            return []
        if block.cells.cell_type == zone.cells.cell_type:
            there = cell_rows(block.cells, zone.cells) >= 0
            lacking &= ~there
            names = tuple(block.components) if there.any() else names
    if not lacking.any() or not (names or whole):
        return []
    names = names or family_of(zone).stress_names(zone)
    cells = CellBlock.make(zone.cells.nodes, zone.cells.cell_type, zone.cells.connectivity[lacking])
    zero = partial(np.zeros, (len(cells), n_points(zone.element, "STRESSES")))
    components = {name: zero() for name in names}
    return [CellFieldBlock(cells, components, "STRESSES", zone.element, zone.constituent)]
