"""What `--report` takes down of a calculation: footings, energies, some instants of what moves."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.io.recording import Recording
from ssilang.io.vtk.grid import ORDERS
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.interface.footing import Footing, Loads
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.stepping.extremes import Extremes
from ssilang.kernel.stepping.node_histories import FootingHistories, footing_histories
from ssilang.kernel.stepping.problem.problem import Inputs, Problem
from ssilang.kernel.stepping.run import History
from ssilang.kernel.stepping.snapshot import Observer
from ssilang.operators.dynamics.motion_files import VtkObserver, stress_of
from ssilang.operators.dynamics.reports import ENERGIES
from ssilang.operators.dynamics.watching import even, joint_places
from ssilang.operators.files.outputs import run_output
from ssilang.operators.tables.entries import Entries
from ssilang.operators.workspace import units_in_si

INSTANTS = 2000
"""Instants at most of the histories."""
FRAMES = 60
"""Instants at most of the scene."""
NUMBERS = 6_000_000
"""Displacements at most that the scene has, all instants together."""

COLUMNS = ("share", "force", "pressure", "opening")
"""Histories of a footing, beside its moments and rotations."""


@dataclass(eq=False)
class CalculationRecord:
    """One calculation on its way into the report."""

    recording: Recording
    entries: Entries
    problem: Problem
    footings: FootingHistories | None
    scene: VtkObserver | None

    @property
    def observers(self) -> list[Observer]:
        """Who gets instants."""
        given: tuple[Observer | None, ...] = (self.footings, self.scene)
        return [o for o in given if o is not None]

    def save(self, history: History | None, extremes: Extremes | None = None) -> None:
        """Add it to the recording; `history`: None for a calculation that failed."""
        recording, session = self.recording, self.entries.call.session
        columns = {} if history is None else self._energies(history)
        footings = []
        track = self.footings
        if track is not None and len(track.times):
            if len(columns.get("time", ())) != len(track.times):
                columns = {"time": track.times}  # it failed, or chose its own instants
            for i, footing in enumerate(track.footings):
                columns |= _columns(footing, track.found(i), f"_{i + 1}")
                footings.append(_told(footing, self.problem))
        if not columns:
            columns = {"time": np.zeros(0)}
        path = recording.table(columns)
        run_output(session).wrote(path)
        recording.calculations.append(
            {
                "procedure": self.entries.procedure,
                "table": path.name,
                "scene": None if self.scene is None else self.scene.writer.base.name + ".vtkhdf",
                "whole": history is not None,
                "footings": footings,
                "footings_left": 0 if track is None else track.left_out,
                "largest": [] if extremes is None else _largest(extremes),
            }
        )

    def _energies(self, history: History) -> dict[str, FloatArray]:
        taken = even(len(history.times), INSTANTS)
        found = {"time": history.times[taken]}
        found |= {w: history.energies[taken, i] for i, w in enumerate(ENERGIES)}
        return {**found, "ECART": np.broadcast_to(history.imbalance, history.times.shape)[taken]}


def calculation_record(
    entries: Entries, problem: Problem, inputs: Inputs
) -> CalculationRecord | None:
    """What takes the calculation down; None if nobody asked, or enough have been."""
    output = run_output(entries.call.session)
    recording = output.recording
    if recording is None or not recording.takes_more:
        return None
    footings = footing_histories(problem, even(len(problem.times), INSTANTS))
    return CalculationRecord(recording, entries, problem, footings, _scene(entries, inputs))


@contextmanager
def recorded(record: CalculationRecord | None) -> Iterator[None]:
    """Around a calculation: one that fails leaves what there is of it."""
    try:
        yield
    except BaseException:
        if record is not None:
            record.save(None)
        raise


def _scene(entries: Entries, inputs: Inputs) -> VtkObserver | None:
    session = entries.call.session
    output = run_output(session)
    recording = output.recording
    mesh = moving_mesh(inputs)
    if recording is None or mesh is None:
        return None
    size = max(3 * len(mesh.sorted_node_ids), 1)
    wanted = even(len(inputs.times), int(np.clip(NUMBERS // size, 2, FRAMES)))
    path = recording.folder / f"scene_{len(recording.calculations) + 1}"
    writer = output.begin_series(path, units_in_si(session), one_file=True)
    return VtkObserver(wanted, {"": mesh}, writer, stress_of(entries))


def moving_mesh(inputs: Inputs) -> Mesh | None:
    """All cells of a problem that a picture can show, those of its matrices and of its model."""
    given = [m for m in (inputs.stiffness, inputs.mass) if m is not None]
    zones = [b.zone for m in given for b in m.blocks if b.zone is not None]
    zones += [] if inputs.model is None else list(inputs.model.zones)
    shown = [z.cells for z in zones if z.cells.cell_type in ORDERS and len(z.cells)]
    found = tuple({(c.cell_type, c.raw.tobytes()): c for c in shown}.values())
    return Mesh(found[0].nodes, found) if found else None


def _columns(footing: Footing, loads: Loads, tail: str) -> dict[str, FloatArray]:
    """Histories of a footing by the titles of their columns."""
    found = {name + tail: getattr(loads, name) for name in COLUMNS}
    for k, axis in enumerate(axis_names(footing.axes)):
        found[f"moment_{axis}{tail}"] = loads.moment[:, k]
        found[f"rotation_{axis}{tail}"] = loads.rotation[:, k]
    return {name: values for name, values in found.items() if not np.isnan(values).all()}


def axis_names(axes: FloatArray) -> list[str]:
    """x, y, z for rotation axes along these, 1 and 2 for others."""
    names = []
    for k, axis in enumerate(axes):
        along = int(np.abs(axis).argmax())
        names.append("xyz"[along] if abs(axis[along]) > 1.0 - 1e-9 else str(k + 1))
    return names


def _told(footing: Footing, problem: Problem) -> dict[str, Any]:
    """A footing for `contents.json`."""
    table = problem.numbering.table
    return {
        "area": footing.area,
        "centre": table.shown(footing.centre).tolist(),
        "normal": footing.normal.tolist(),
        "axes": axis_names(footing.axes),
        "points": len(footing.points),
        "kind": "pairs" if footing.pairs else "macro" if footing.outline else "faces",
    }


def _largest(extremes: Extremes) -> list[dict[str, Any]]:
    """Largest values over all steps, for `contents.json`."""
    problem, found = extremes.problem, []
    table = problem.numbering.table
    for (kind, name), peak in extremes.found().items():
        if name:
            place: Sequence[float] = table.coordinates[problem.numbering.nodes[peak.place]]
        else:
            place = joint_places(problem.interface)[peak.place]
        told = {"kind": kind, "component": name, "value": peak.value}
        told |= {"time": float(problem.times[peak.step])}
        found.append(told | {"place": table.shown(np.asarray(place)).tolist()})
    return found
