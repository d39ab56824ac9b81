"""Histories that DYNAMIC keeps: the table of results, lists and files of values in time.

The kernel's tracks hold them, which bring compiled code along: DYNAMIC imports this when it runs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.atomic import write_text
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.stepping.node_track import NodeTrack
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.language.values import LazyRows, LazyTable, ListReel, Mot, Table, promises
from ssilang.language.vocabulary.unit_systems import UnitSystem, result_unit
from ssilang.operators.curves.instants import InstantField, RecordedFields, RecordedPoints
from ssilang.operators.dynamics.motion_observers import restricted

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
    return restricted(getattr(snapshot, NODAL[word]), nodes)


VECTORS = {"DEPL": "u", "VITE": "v", "ACCE": "a"}


def _stand_in(
    snapshot: Snapshot, nodes: IntArray | None, word: str, make: Callable[[], NodeField]
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
class TableObserver(NodeTrack):
    """The table of results: 1, 2 ... with TEMP, DEPL, VITE, ACCE and what joints give.

    What loops record stays as rows; fields are made of them when a script first asks. `whole`: of
    problems that change, or with plastic bodies, instants are kept instead.
    """

    whole: bool = False
    table: LazyRows = field(init=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        words = NODAL_WORDS if self.problem.interface is None else ALL_WORDS
        self.table = LazyRows(self._entry, words, self._stand_ins, self)

    def receive(self, snapshot: Snapshot) -> None:
        """Add one instant."""
        if not self.whole:
            super().receive(snapshot)
            return
        if self.nodes is not None and not snapshot.problem.small:
            entry = self._entry(snapshot)
            entry.items()  # lets go of the rest of a large model
            self.table.set(len(self.table) + 1, entry)
            return
        self.table.append(snapshot)

    def _stand_ins(self, index: str) -> tuple[Sequence[Any], FloatArray] | None:
        """What serves instead of all fields at an index, and their times."""
        if not self.whole:
            if index in VECTORS:
                make = partial(self.node_field, name=VECTORS[index])
                return RecordedFields(self, VECTORS[index], make), self.times
            if index in JOINTS and self.problem.interface is not None:
                name = JOINTS[index]
                return RecordedPoints(self, name, partial(self._points, name=name)), self.times
            return None
        if index not in VECTORS or self.nodes is not None:
            return None
        rows = self.table.rows.items()
        fields = [
            InstantField(
                snapshot.problem.numbering,
                getattr(snapshot, VECTORS[index]),
                partial(_asked, self.table, place, index),
            )
            for place, snapshot in rows
        ]
        return fields, np.array([snapshot.time for _, snapshot in rows])

    def _points(self, row: int, name: str) -> CellField:
        found = self.cell_field(row, name)
        assert found is not None
        return found

    def _entry(self, row: Snapshot | int) -> LazyTable:
        """The table of an instant: a snapshot, or a place among the rows."""
        if isinstance(row, int):
            words = NODAL_WORDS if self.problem.interface is None else ALL_WORDS
            entry = LazyTable(partial(self._recorded, row), words, partial(self._instant, row))
            entry.set(Mot("TEMP"), float(self.instant(row).times[0]))
            return entry
        words = ALL_WORDS
        if row.problem.interface is None:
            words = BODY_WORDS if hasattr(row, "body_stresses") else NODAL_WORDS
        entry = LazyTable(
            partial(_found, row, self.nodes), words, partial(_stand_in, row, self.nodes)
        )
        entry.set(Mot("TEMP"), row.time)
        return entry

    def _recorded(self, row: int, word: str) -> object:
        if word in JOINTS:
            return self.cell_field(row, JOINTS[word])
        return self.node_field(row, VECTORS[word])

    def _instant(self, row: int, word: str, make: Callable[[], NodeField]) -> InstantField | None:
        """As `_stand_in`, of recorded rows."""
        if self.nodes is not None or word not in VECTORS:
            return None
        values = self.instant(row).values(VECTORS[word])[0]
        return InstantField(self.problem.numbering, values, make)


@dataclass(eq=False)
class CsvObserver(NodeTrack):
    """Lists of values in time at the nodes of a mesh, and a file of them."""

    components: list[str] | None = None
    path: Path | None = None
    units: UnitSystem | None = None

    @cached_property
    def columns(self) -> dict[str, FloatArray]:
        """Values in time by title: TEMP, DEPL_UX_12 ..."""
        found, numbering = {"TEMP": self.times}, self.problem.numbering
        for word, field_ in VECTORS.items():
            values = self.values(field_, self.shown)
            for name in numbering.unknowns:
                if self.components is not None and name not in self.components:
                    continue
                places = np.flatnonzero(numbering.codes[self.shown] == numbering.code(name))
                for place in places.tolist():
                    node = numbering.nodes[self.shown[place]]
                    found[f"{word}_{name}_{node + 1}"] = values[:, place]
        return found

    def close(self) -> None:
        """Write the file, whole."""
        if self.path is None:
            return
        lines = [";".join(map(self._head, self.columns))]
        lines += [
            ";".join(f"{x:.12g}" for x in row) for row in zip(*self.columns.values(), strict=True)
        ]
        write_text(self.path, "\n".join(lines) + "\n")

    def _head(self, name: str) -> str:
        """Title of a column of the file, with the deck's units where they are known."""
        if self.units is None:
            return name
        index, component = (*name.split("_"), "")[:2]
        unit = self.units.written("s" if name == "TEMP" else result_unit(component, index))
        return f"{name} ({unit})" if unit else name

    @property
    def table(self) -> Table:
        """RESULTATS_CSV: one LISTREEL a quantity."""
        made = Table()
        for name, values in self.columns.items():
            made.set(Mot(name), ListReel(values))
        return made
