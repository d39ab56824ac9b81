"""Modes and displacements by name that a script leaves: scenes of a report beside calculations."""

import math

from ssilang.io.recording import Recording
from ssilang.io.vtk.grid import ORDERS
from ssilang.operators.files.outputs import run_output
from ssilang.operators.prelude import *
from ssilang.operators.workspace import units_in_si

MOST_FIELDS, MOST_MODES = 6, 12
_MOVES = {"UX", "UY", "UZ", "UR"}


def record_shapes(session: Session, recording: Recording) -> None:
    """Write the modes that names hold; where nothing was calculated in time, displacements too."""
    named = {n: session.root.find(n) for n in sorted(session.root.variables)}
    blocks = _cells(named)
    if not blocks:
        return
    for name, value in named.items():
        modes = list(_modes(value))
        if modes and len(recording.shapes) < MOST_FIELDS:
            _write(session, recording, blocks, name, "modes", modes)
    fields = [(n, v) for n, v in named.items() if _is_displacement(v)]
    for name, field in () if recording.calculations else fields:
        if len(recording.shapes) < MOST_FIELDS:
            _write(session, recording, blocks, name, "field", [(0.0, field)])
    if not recording.calculations and not recording.shapes:
        _write(session, recording, blocks, "", "mesh", [])


def _cells(named: dict[str, object]) -> list[CellBlock]:
    """Cells of the models, or of the largest mesh where there are none, each once."""
    models = [v for v in named.values() if isinstance(v, Model) and v.zones]
    meshes = [v for v in named.values() if isinstance(v, Mesh)]
    found = [b for m in models for b in m.mesh.blocks]
    found = found or list(max(meshes, key=lambda m: m.n_cells).blocks if meshes else ())
    shown = [b for b in found if b.cell_type in ORDERS and len(b)]
    return list({(b.cell_type, b.raw.tobytes()): b for b in shown}.values())


def _is_displacement(value: object) -> bool:
    return isinstance(value, NodeField) and bool(_MOVES & value.components.keys())


def _modes(value: object) -> Iterator[tuple[float, NodeField]]:
    """Frequency and shape of the modes of a table BASE_MODALE or BASE_DE_MODES."""
    if not isinstance(value, Table) or value.subtype not in ("BASE_MODALE", "BASE_DE_MODES"):
        return
    inner = value.get("MODES") if value.has("MODES") else value
    for index, entry in inner.items() if isinstance(inner, Table) else ():
        if not isinstance(index, int) or not isinstance(entry, Table):
            continue
        shape = entry.get("DEFORMEE_MODALE") if entry.has("DEFORMEE_MODALE") else None
        frequency = entry.get("FREQUENCE") if entry.has("FREQUENCE") else None
        if not isinstance(shape, NodeField) or not isinstance(frequency, int | float):
            continue
        if math.isfinite(frequency):
            yield float(frequency), shape


def _write(
    session: Session, recording: Recording, blocks: list[CellBlock], name: str, kind: str,
    steps: list[tuple[float, NodeField]],
) -> None:  # fmt: skip
    """A series whose times number the shapes."""
    steps = steps[:MOST_MODES]
    held = {int(n) for _, f in steps for part in f.components.values() for n in part.nodes}
    if held:
        nodes = np.array(sorted(held))
        blocks = [b for b in blocks if np.isin(b.connectivity, nodes).all()]
    if not blocks:
        return
    path = recording.folder / f"shapes_{len(recording.shapes) + 1}"
    writer = run_output(session).begin_series(path, units_in_si(session), one_file=True)
    mesh = Mesh(blocks[0].nodes, tuple(blocks))
    for i, (_, field) in enumerate(steps):
        parts = {k: v for k, v in field.components.items() if k != "LX"}
        moved = NodeField(field.table, parts, field.nature)
        writer.write(float(i), mesh, {"displacement": moved})
    if not steps:
        writer.write(0.0, mesh)
    recording.shapes.append(
        {
            "name": name,
            "kind": kind,
            "scene": path.name + ".vtkhdf",
            "frequencies": [frequency for frequency, _ in steps] if kind == "modes" else [],
        }
    )
