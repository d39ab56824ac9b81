"""Histories that DYNAMIC keeps: the table of results, lists and files of values in time.

The kernel's tracks hold them.
"""

from functools import cached_property
from pathlib import Path

from ssilang.io.atomic import write_text
from ssilang.io.tables import write_parquet
from ssilang.kernel.fields.node_algebra import restricted
from ssilang.kernel.stepping.node_histories import ForceHistories, NodeHistories
from ssilang.kernel.stepping.snapshot import Observer, Receiver, Snapshot
from ssilang.language.values import promises
from ssilang.language.vocabulary.unit_systems import result_unit
from ssilang.operators.curves.instants import InstantField, RecordedFields, RecordedPoints
from ssilang.operators.prelude import *

PARQUET = ".parquet"
NODAL = {"DEPL": "displacement", "VITE": "velocity", "ACCE": "acceleration"}
JOINTS = {"CONTRAINTES": "traction", "SAUTS": "jump", "VARIABLES_INTERNES": "variables"}
OF_INSTANTS = {"traction": "tractions", "jump": "jumps", "variables": "variables"}
"""Words of the table of results, with what they are of an instant."""
NODAL_WORDS, ALL_WORDS = promises("TEMP", *NODAL), promises("TEMP", *NODAL, *JOINTS)
BODY_WORDS = promises("TEMP", *NODAL, "CONTRAINTES", "VARIABLES_INTERNES")
"""Of plastic bodies without joints."""


def _found(snapshot: Snapshot, nodes: IntArray | None, word: str) -> object:
    if word in JOINTS:
        return getattr(snapshot, OF_INSTANTS[JOINTS[word]])
    given: NodeField = getattr(snapshot, NODAL[word])
    return given if nodes is None else restricted(given, nodes)


VECTORS = {"DEPL": "u", "VITE": "v", "ACCE": "a"}


def _stand_in(
    snapshot: Snapshot, nodes: IntArray | None, word: str, make: Callable[[], Any]
) -> InstantField | None:
    """A field of the whole body that stays unmade while single values are asked for."""
    if nodes is not None or word not in VECTORS:
        return None
    return InstantField(snapshot.problem.numbering, getattr(snapshot, VECTORS[word]), make)


def _asked(table: LazyRows, place: int, index: str) -> NodeField:
    """The field of an instant after all."""
    entry = table.get(place)
    assert isinstance(entry, Table)
    made = entry.get(index)
    assert isinstance(made, NodeField)
    return made


@dataclass(eq=False)
class TableObserver(Receiver):
    """The table of results: 1, 2 ... with TEMP, DEPL, VITE, ACCE and what joints give.

    What loops record stays as rows; fields are made of them when a script first asks. `whole`: of
    problems that change, or with plastic bodies, instants are kept instead.
    """

    track: NodeHistories
    whole: bool = False
    origins: Any = None  # of fields, and of these
    table: LazyRows = field(init=False)

    def __post_init__(self) -> None:
        self.nodes = self.track.nodes
        words = ALL_WORDS if self.track.problem.interface else NODAL_WORDS
        self.table = LazyRows(self._entry, words, self._stand_ins, self.track)

    @property
    def observer(self) -> Observer:
        """What the run hands instants to."""
        return self if self.whole else self.track

    @property
    def wanted(self) -> BoolArray:
        """Which times."""
        return self.track.wanted

    def receive(self, snapshot: Snapshot) -> None:
        """Add one whole instant."""
        if self.nodes is not None and not snapshot.problem.small:
            entry = self._entry(snapshot)
            entry.items()  # lets go of the rest of a large model
            self.table.set(len(self.table) + 1, entry)
            return
        self.table.append(snapshot)

    def _stand_ins(self, index: str) -> tuple[Sequence[Any], FloatArray] | None:
        """What serves instead of all fields at an index, and their times."""
        track = self.track
        if not self.whole:
            if index in VECTORS:
                make = partial(track.node_field, name=VECTORS[index])
                return RecordedFields(len(track), make, track, VECTORS[index]), track.times
            if index in JOINTS and track.problem.interface:
                name = JOINTS[index]
                made = partial(track.cell_field, name=name)
                return RecordedPoints(len(track), made, track, name), track.times
            return None
        if index not in VECTORS or self.nodes is not None:
            return None
        fields, rows = [], self.table.rows
        for place, snapshot in rows.items():
            make = partial(_asked, self.table, place, index)
            values = getattr(snapshot, VECTORS[index])
            fields.append(InstantField(snapshot.problem.numbering, values, make))
        return fields, np.array([snapshot.time for snapshot in rows.values()])

    def _entry(self, row: Snapshot | int) -> LazyTable:
        """The table of an instant: a snapshot, or a place among the rows."""
        if isinstance(row, int):
            words = ALL_WORDS if self.track.problem.interface else NODAL_WORDS
            entry = LazyTable(partial(self._recorded, row), words, partial(self._instant, row))
            entry.set(Mot("TEMP"), float(self.track.instant(row).times[0]))
            return entry
        words = ALL_WORDS
        if not row.problem.interface:
            words = BODY_WORDS if hasattr(row, "body_stresses") else NODAL_WORDS
        entry = LazyTable(
            partial(_found, row, self.nodes), words, partial(_stand_in, row, self.nodes)
        )
        entry.set(Mot("TEMP"), row.time)
        return entry

    def _recorded(self, row: int, word: str) -> object:
        if word in JOINTS:
            return self.track.cell_field(row, JOINTS[word])
        made = self.track.node_field(row, VECTORS[word])
        if self.origins is not None:
            known, origin = self.origins
            known[made] = origin
        return made

    def _instant(self, row: int, word: str, make: Callable[[], Any]) -> InstantField | None:
        """As `_stand_in`, of recorded rows."""
        if self.nodes is not None or word not in VECTORS:
            return None
        values = self.track.instant(row).values(VECTORS[word])[0]
        return InstantField(self.track.problem.numbering, values, make)


@dataclass(eq=False)
class CsvObserver:
    """Lists of values in time at the nodes of a mesh, and a file of them, CSV or Parquet."""

    track: NodeHistories
    components: list[str] | None = None
    path: Path | None = None
    units: UnitSystem | None = None

    def __post_init__(self) -> None:
        self.track.at_end = self.close

    @cached_property
    def columns(self) -> dict[str, FloatArray]:
        """Values in time by title: TEMP, DEPL_UX_12 ..."""
        track, numbering = self.track, self.track.problem.numbering
        found = {"TEMP": track.times}
        for word, field_ in VECTORS.items():
            values = track.values(field_, track.shown)
            for name in numbering.unknowns:
                if self.components is not None and name not in self.components:
                    continue
                places = np.flatnonzero(numbering.codes[track.shown] == numbering.code(name))
                for place in places.tolist():
                    node = numbering.nodes[track.shown[place]]
                    found[f"{word}_{name}_{node + 1}"] = values[:, place]
        return found

    def close(self) -> None:
        """Write the file, whole."""
        if self.path is None:
            return
        if self.path.suffix.lower() == PARQUET:
            write_parquet(
                self.path, self.columns, {name: self._unit(name) for name in self.columns}
            )
            return
        lines = [";".join(map(self._head, self.columns))]
        row = ";".join(["%.12g"] * len(self.columns))
        columns = [values.tolist() for values in self.columns.values()]
        lines += [row % values for values in zip(*columns, strict=True)]
        write_text(self.path, "\n".join(lines) + "\n")

    def _head(self, name: str) -> str:
        """Title of a column of the file, with its unit where it is known."""
        unit = self._unit(name)
        return f"{name} ({unit})" if unit else name

    def _unit(self, name: str) -> str:
        """Unit of a column where the deck's are known."""
        if self.units is None:
            return ""
        index, component = (*name.split("_"), "")[:2]
        return self.units.written("s" if name == "TEMP" else result_unit(component, index))

    @property
    def table(self) -> Table:
        """RESULTATS_CSV: one LISTREEL a quantity."""
        return Table.of({name: ListReel(values) for name, values in self.columns.items()})


def forces_table(track: ForceHistories) -> Table:
    """RESULTATS_RELATIONS: for each name TEMP and a LISTREEL of each component."""
    made = Table.of({name: Table.of({"TEMP": ListReel(track.times)}) for name in track.named})
    for (name, dual), values in track.histories.items():
        made.inner(name).set(Mot(dual), ListReel(values))
    return made
