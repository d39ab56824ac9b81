"""AVS "unstructured cell data" text files: several structures may follow one another.

Source: AVS Developer's Guide, UCD ASCII format. A structure is: counts (nodes, cells, values a
node, values a cell, values of the model), node lines, cell lines (number, material, kind, nodes),
then for each set of values the sizes of its components, a line `label, unit` each, and the values.
Comment lines (#) may stand before the counts.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError, OutputError, text_of
from ssilang.io.mesh_files.file_mesh import names_in, refuse_doubles
from ssilang.io.vtk.grid import ORDERS, cell_means
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh

_KINDS: dict[str, str] = names_in("avs")
_TYPES = {(kind, len(ORDERS[name][1])): name for name, kind in _KINDS.items()}


@dataclass(frozen=True, eq=False)
class Structure:
    """What one structure holds.

    Attributes
    ----------
    points : array (n, 3)
    cells : list of (type, material, array (m, k) of rows of `points`)
        Nodes in Cast3M's order.
    node_values : dict of str to array (n,)
    cell_values : dict of str to array (n_cells,)
        In the order of `cells`.
    model_values : dict of str to float
    """

    points: FloatArray
    cells: list[tuple[str, int, IntArray]]
    node_values: dict[str, FloatArray] = field(default_factory=dict)
    cell_values: dict[str, FloatArray] = field(default_factory=dict)
    model_values: dict[str, float] = field(default_factory=dict)


def structure_of(
    mesh: Mesh,
    node_field: NodeField | None = None,
    cell_field: CellField | None = None,
    time: float | None = None,
) -> Structure:
    """The structure that holds a mesh, its fields (0 where a node has no value) and a time.

    Raises
    ------
    OutputError
        For cells that the format has not, or without a value in a field in cells.
    """
    ids = mesh.sorted_node_ids
    cells = []
    for number, block in enumerate(mesh.blocks, start=1):
        if block.cell_type not in _KINDS:
            raise OutputError("io.cells-no-avs-counterpart", cell_type=block.cell_type)
        cells.append((block.cell_type, number, np.searchsorted(ids, block.connectivity)))
    nodal = {}
    if node_field is not None:
        nodal = {c: node_field.values_at(c, ids) for c in node_field.components}
    means = cell_means(cell_field, mesh) if cell_field is not None else {}
    if any(np.isnan(v).any() for v in means.values()):
        raise OutputError("io.field-cells-not-cover")
    values = {} if time is None else {"time": time}
    return Structure(mesh.nodes.coordinates[ids], cells, nodal, means, values)


def avs_lines(structure: Structure) -> list[str]:
    """The lines of a structure."""
    s = structure
    count = sum(len(table) for _, _, table in s.cells)
    sizes = (len(s.node_values), len(s.cell_values), len(s.model_values))
    lines = [f"{len(s.points)} {count} {sizes[0]} {sizes[1]} {sizes[2]}"]
    lines += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(s.points.tolist(), start=1)]
    number = 0
    for kind, material, table in s.cells:
        rows = (table[:, list(ORDERS[kind][1])] + 1).tolist()
        for row in rows:
            number += 1
            lines.append(f"{number} {material} {_KINDS[kind]} " + " ".join(map(str, row)))
    for values in (s.node_values, s.cell_values):
        if values:
            lines += _labels(list(values))
            table = np.column_stack(list(values.values())).tolist()
            lines += [f"{i} " + " ".join(map(repr, row)) for i, row in enumerate(table, start=1)]
    if s.model_values:
        lines += _labels(list(s.model_values))
        lines.append("1 " + " ".join(repr(float(v)) for v in s.model_values.values()))
    return lines


def _labels(names: Sequence[str]) -> list[str]:
    return [f"{len(names)}" + " 1" * len(names), *(f"{name}, " for name in names)]


def read_avs(path: Path, skip: int = 0) -> Structure | None:
    """The structure number `skip` (from 0) of a file, None if the file has fewer.

    Raises
    ------
    InputError
        If the file cannot be read or is no AVS file.
    """
    text = text_of(path, "latin-1")
    lines = iter([t for t in text.splitlines() if t.strip() and not t.startswith("#")])
    try:
        for _ in range(skip):
            if _structure(lines, path.name) is None:
                return None
        return _structure(lines, path.name)
    except (StopIteration, RuntimeError) as error:
        raise InputError("io.avs-file-cut", name=path.name) from error
    except (ValueError, LookupError, OverflowError) as error:
        raise InputError("io.no-readable-avs-file", name=path.name, error=error) from error


def _structure(lines: Iterator[str], name: str) -> Structure | None:
    head = next(lines, None)
    if head is None:
        return None
    n_nodes, n_cells, per_node, per_cell, per_model = (int(t) for t in head.split()[:5])
    nodes = [next(lines).split() for _ in range(n_nodes)]
    refuse_doubles(name, ((int(t[0]), t) for t in nodes))
    row_of = {int(t[0]): i for i, t in enumerate(nodes)}
    points = np.array([[float(x) for x in t[1:4]] for t in nodes]).reshape(n_nodes, 3)
    cells, order = _cells([next(lines).split() for _ in range(n_cells)], row_of)
    nodal = _values(lines, n_nodes) if per_node else {}
    in_cells = _values(lines, n_cells) if per_cell else {}
    of_model = _values(lines, 1) if per_model else {}
    return Structure(
        points,
        cells,
        nodal,
        {name: v[order] for name, v in in_cells.items()},
        {name: float(v[0]) for name, v in of_model.items()},
    )


def _cells(
    rows: list[list[str]], row_of: dict[int, int]
) -> tuple[list[tuple[str, int, IntArray]], IntArray]:
    """Cells grouped by kind and material, and the order of the rows in the groups."""
    groups: dict[tuple[str, int], list[int]] = {}
    tables: dict[tuple[str, int], list[list[int]]] = {}
    for i, row in enumerate(rows):
        key = _TYPES[row[2].lower(), len(row) - 3], int(row[1])
        groups.setdefault(key, []).append(i)
        tables.setdefault(key, []).append([row_of[int(t)] for t in row[3:]])
    made = []
    for (kind, material), table in tables.items():
        place = np.argsort(ORDERS[kind][1])
        made.append((kind, material, np.array(table, dtype=np.int64)[:, place]))
    order = [i for group in groups.values() for i in group]
    return made, np.array(order, dtype=np.int64)


def _values(lines: Iterator[str], count: int) -> dict[str, FloatArray]:
    sizes = [int(t) for t in next(lines).split()[1:]]
    names = [next(lines).split(",")[0].strip() for _ in sizes]
    if not count:  # no row says whether there are as many components
        return {}
    rows = [next(lines).split() for _ in range(count)]
    table = np.array([[float(t) for t in row[-sum(sizes) :]] for row in rows])
    table = table.reshape(count, sum(sizes))
    if not np.isfinite(table).all():
        raise ValueError("NaN")
    values: dict[str, FloatArray] = {}
    column = 0
    for name, size in zip(names, sizes, strict=True):
        for k in range(size):
            values[name if size == 1 else f"{name}{k + 1}"] = table[:, column]
            column += 1
    return values
