"""What DYNAMIC and PASAPAS keep of a motion: tables of results, VTK series, CSV files."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.atomic import write_text
from ssilang.io.vtk.series import Part, SeriesWriter
from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.values import LazyRows, LazyTable, ListReel, Mot, Table, promises
from ssilang.language.vocabulary.unit_systems import UnitSystem, result_unit
from ssilang.operators.curves.instants import InstantField

if TYPE_CHECKING:
    from ssilang.kernel.stepping.snapshot import Snapshot

Steps = NDArray[np.bool_]


def restricted(given: NodeField, nodes: IntArray | None) -> NodeField:
    """A nodal field on these increasing nodes only (None: everywhere)."""
    if nodes is None:
        return given
    parts: dict[str, NodeValues] = {}
    for name, part in given.components.items():
        kept = np.isin(part.nodes, nodes)
        if kept.any():
            parts[name] = NodeValues(part.nodes[kept], part.values[kept])
    return NodeField(given.table, parts, given.nature)


NODAL = {"DEPL": "displacement", "VITE": "velocity", "ACCE": "acceleration"}
JOINTS = {"CONTRAINTES": "tractions", "SAUTS": "jumps", "VARIABLES_INTERNES": "variables"}
"""Words of the table of results, with what they are of an instant."""
NODAL_WORDS, ALL_WORDS = promises("TEMP", *NODAL), promises("TEMP", *NODAL, *JOINTS)
BODY_WORDS = promises("TEMP", *NODAL, "CONTRAINTES", "VARIABLES_INTERNES")
"""Of plastic bodies without joints."""


def _found(snapshot: Snapshot, nodes: IntArray | None, word: str) -> object:
    if word in JOINTS:
        return getattr(snapshot, JOINTS[word])
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


@dataclass
class TableObserver:
    """Fills the table of results: 1, 2 ... with TEMP, DEPL, VITE and what joints give.

    Fields are made of an instant's vectors when a script first asks for them.
    """

    wanted: Steps
    nodes: IntArray | None = None
    table: LazyRows = field(init=False)

    def __post_init__(self) -> None:
        self.table = LazyRows(self._entry, NODAL_WORDS, self._unmade)

    def receive(self, snapshot: Snapshot) -> None:
        """Add one instant."""
        if self.nodes is not None and not snapshot.problem.small:
            entry = self._entry(snapshot)
            entry.items()  # lets go of the rest of a large model
            self.table.set(len(self.table) + 1, entry)
            return
        self.table.append(snapshot)

    def _unmade(self, index: str) -> list[tuple[float, InstantField]]:
        """Times and stand-ins of the instants that nobody asked for yet, if all have them."""
        if index not in VECTORS or self.nodes is not None:
            return []
        name, table = VECTORS[index], self.table
        return [
            (
                snapshot.time,
                InstantField(
                    snapshot.problem.numbering,
                    getattr(snapshot, name),
                    partial(_asked, table, place, index),
                ),
            )
            for place, snapshot in table.rows.items()
        ]

    def _entry(self, snapshot: Snapshot) -> LazyTable:
        words = ALL_WORDS
        if snapshot.problem.interface is None:
            words = BODY_WORDS if hasattr(snapshot, "body_stresses") else NODAL_WORDS
        entry = LazyTable(
            partial(_found, snapshot, self.nodes), words, partial(_stand_in, snapshot, self.nodes)
        )
        entry.set(Mot("TEMP"), snapshot.time)
        return entry

    def close(self) -> None:
        """Nothing to do: the table is whole after each step."""


@dataclass
class VtkObserver:
    """Writes a VTK series of meshes with displacement, velocity, reactions, joints, stresses.

    Attributes
    ----------
    meshes : dict
        Name of the part ('' for a single one) to mesh.
    stress : function or None
        Stress of the solids for a displacement.
    """

    wanted: Steps
    meshes: dict[str, Mesh]
    writer: SeriesWriter
    stress: Callable[[NodeField], CellField | None] | None = None

    def receive(self, snapshot: Snapshot) -> None:
        """Write one instant."""
        u = snapshot.displacement
        moved = NodeField(u.table, {k: v for k, v in u.components.items() if k != "LX"}, u.nature)
        points = {
            "displacement": moved,
            "velocity": snapshot.velocity,
            "acceleration": snapshot.acceleration,
            "reaction": snapshot.reactions,
        }
        cells: dict[str, CellField] = {}
        bodies: CellField | None = getattr(snapshot, "body_stresses", None)
        jumps = snapshot.jumps
        tractions = snapshot.tractions
        if bodies is not None:
            tractions = getattr(snapshot, "joint_tractions", None)
        if jumps is not None and tractions is not None:
            cells |= {"opening": jumps, "traction": tractions}
        if snapshot.variables is not None:
            cells |= joint_points(snapshot.variables)
        stress = self.stress(u) if self.stress is not None else None
        found = [f for f in (stress, bodies) if f is not None]
        if found:
            cells["stress"] = CellField(tuple(b for f in found for b in f.blocks), "CONTRAINTES")
        parts = {name: Part(mesh, points, cells) for name, mesh in self.meshes.items()}
        self.writer.write_parts(snapshot.time, parts)

    def held(self) -> Any:
        """What a checkpoint keeps: how far the series is."""
        return self.writer.position()

    def hold(self, kept: Any) -> None:
        """Go on from a checkpoint."""
        self.writer.go_back(kept)

    def close(self) -> None:
        """Write the list of the steps."""
        self.writer.close()


SHOWN = {"joint_state": "ETAT", "stored_energy": "ESTO", "lost_energy": "EPER"}
"""Names in VTK files of what the points of joints have."""


def joint_points(variables: CellField) -> dict[str, CellField]:
    """State and energies of joints, for cells: the most open point, and means of energies."""
    found = {}
    for name, component in SHOWN.items():
        blocks = []
        for block in variables.blocks:
            values = block.components[component]
            if component == "ETAT":
                values = values.max(axis=1, keepdims=True)
            support = "GRAVITE" if component == "ETAT" else block.support
            blocks.append(replace(block, components={component: values}, support=support))
        found[name] = CellField(tuple(blocks), "VARIABLES INTERNES")
    return found


@dataclass
class CsvObserver:
    """Lists of values in time at the nodes of a mesh, and a file of them."""

    wanted: Steps
    nodes: IntArray
    components: list[str] | None = None
    path: Path | None = None
    units: UnitSystem | None = None
    columns: dict[str, list[float]] = field(default_factory=lambda: {"TEMP": []})

    def receive(self, snapshot: Snapshot) -> None:
        """Add one row."""
        self.columns["TEMP"].append(snapshot.time)
        for word, given in (
            ("DEPL", snapshot.displacement),
            ("VITE", snapshot.velocity),
            ("ACCE", snapshot.acceleration),
        ):
            for name, part in given.components.items():
                if name == "LX" or (self.components is not None and name not in self.components):
                    continue
                here = np.intersect1d(self.nodes, part.nodes)
                for node, value in zip(here, part.at(here), strict=True):
                    self.columns.setdefault(f"{word}_{name}_{node + 1}", []).append(float(value))

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
