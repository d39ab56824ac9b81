"""I-DEAS universal files (.unv): nodes (2411), cells (2412), groups (2467 2470 2477).

Source: SDRC universal file datasets. A dataset stands between two lines that hold -1 alone.

Surfaces of triangles in STL files, text and binary.
"""

import struct
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError, OutputError, readable, text_of
from ssilang.io.mesh_files.file_mesh import FileMesh, Part, names_in
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import Mesh

# I-DEAS element number -> cell type; orders along the contour, as Cast3M's
_CELLS = {n: cell_type for cell_type, numbers in names_in("unv").items() for n in numbers}
_BEAMS = frozenset({11, 21, 22, 24})  # these have a line of orientation before their nodes


def read_unv(path: Path) -> FileMesh:
    """Read a file.

    Raises
    ------
    InputError
        If it cannot be read or holds no nodes.
    """
    lines = text_of(path, "latin-1").splitlines()
    labels: list[int] = []
    points: list[list[float]] = []
    rows: list[tuple[int, str, list[int]]] = []
    groups: list[tuple[str, list[tuple[int, int]]]] = []
    left_out: dict[str, int] = {}
    try:
        for number, body in _datasets(lines):
            if number in (2411, 781):
                for head, line in zip(body[::2], body[1::2], strict=False):
                    labels.append(int(head.split()[0]))
                    x, y, z = (
                        float(t.replace("D", "E").replace("d", "e")) for t in line.split()[:3]
                    )
                    points.append([x, y, z])
            elif number in (2412, 780):
                rows += _read_cells(body, left_out)
            elif number in (2467, 2470, 2477, 2435, 2452):
                groups += _read_groups(body)
        if not points:
            raise InputError("io.holds-no-nodes-dataset", name=path.name)
        return _gathered(labels, points, rows, groups, left_out)
    except (ValueError, LookupError, OverflowError) as error:
        raise InputError("io.no-readable-unv-file", name=path.name, error=error) from error


def _datasets(lines: list[str]) -> Iterator[tuple[int, list[str]]]:
    marks = [i for i, line in enumerate(lines) if line.strip() == "-1"]
    for start, end in zip(marks[::2], marks[1::2], strict=False):
        if end > start + 1:
            yield int(lines[start + 1].split()[0]), lines[start + 2 : end]


def _read_cells(body: list[str], left_out: dict[str, int]) -> list[tuple[int, str, list[int]]]:
    found = []
    i = 0
    while i < len(body):
        head = [int(t) for t in body[i].split()]
        label, kind, count = head[0], head[1], head[5]
        i += 2 if kind in _BEAMS else 1
        nodes: list[int] = []
        while len(nodes) < count:
            nodes += [int(t) for t in body[i].split()]
            i += 1
        if kind not in _CELLS:
            left_out[str(kind)] = left_out.get(str(kind), 0) + 1
        else:
            if len(nodes) != CELL_TYPES[_CELLS[kind]].n_nodes:
                raise ValueError(f"{label}: {_CELLS[kind]}, {len(nodes)}")
            found.append((label, _CELLS[kind], nodes))
    return found


def _read_groups(body: list[str]) -> list[tuple[str, list[tuple[int, int]]]]:
    found = []
    i = 0
    while i < len(body):
        count = int(body[i].split()[7])
        name = body[i + 1].strip()
        numbers: list[int] = []
        i += 2
        while len(numbers) < 4 * count:
            numbers += [int(t) for t in body[i].split()]
            i += 1
        found.append((name, list(zip(numbers[0::4], numbers[1::4], strict=True))))
    return found


def _gathered(
    labels: list[int],
    points: list[list[float]],
    rows: list[tuple[int, str, list[int]]],
    groups: list[tuple[str, list[tuple[int, int]]]],
    left_out: dict[str, int],
) -> FileMesh:
    row_of = {label: i for i, label in enumerate(labels)}
    tables: dict[str, list[list[int]]] = {}
    place: dict[int, tuple[str, int]] = {}
    for label, kind, nodes in rows:
        table = tables.setdefault(kind, [])
        place[label] = kind, len(table)
        table.append([row_of[n] for n in nodes])
    parts = {}
    for name, entities in groups:
        cells: dict[str, list[int]] = {}
        for what, tag in entities:
            if what == 8 and tag in place:
                cell_type, row = place[tag]
                cells.setdefault(cell_type, []).append(row)
        nodes = [row_of[tag] for what, tag in entities if what == 7 and tag in row_of]
        chosen = {cell_type: np.array(r, dtype=np.int64) for cell_type, r in cells.items()}
        parts[name] = Part(chosen, np.array(nodes, dtype=np.int64))
    made = {kind: np.array(t, dtype=np.int64) for kind, t in tables.items()}
    return FileMesh(np.array(points), made, parts, left_out)


def stl_lines(mesh: Mesh) -> list[str]:
    """The lines of a text file of the triangles of a mesh.

    Raises
    ------
    OutputError
        If the mesh holds other cells than TRI3.
    """
    others = {b.cell_type for b in mesh.blocks} - {"TRI3"}
    if others or not mesh.blocks:
        raise OutputError("io.stl-holds-tri3-only", others=others)
    lines = ["solid surface"]
    for block in mesh.blocks:
        corners = block.coordinates
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        normal = normal / np.where(length > 0, length, 1.0)
        for n, triangle in zip(normal.tolist(), corners.tolist(), strict=True):
            lines.append(f"facet normal {n[0]!r} {n[1]!r} {n[2]!r}")
            lines.append("outer loop")
            lines += [f"vertex {x!r} {y!r} {z!r}" for x, y, z in triangle]
            lines += ["endloop", "endfacet"]
    lines.append("endsolid surface")
    return lines


def read_stl(path: Path) -> FloatArray:
    """Corners of the triangles, shape (n, 3, 3).

    Raises
    ------
    InputError
        If the file cannot be read.
    """
    with readable(path):
        raw = path.read_bytes()
    (count,) = struct.unpack_from("<I", raw, 80) if len(raw) >= 84 else (-1,)
    try:
        if len(raw) == 84 + 50 * count:
            kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
            corners = np.frombuffer(raw, kind, count, 84)["corners"].astype(float)
        else:
            words = [t.split() for t in raw.decode("latin-1").splitlines()]
            rows = [w[1:4] for w in words if w[:1] == ["vertex"]]
            corners = np.array(rows, dtype=float).reshape(-1, 3, 3)
        if not np.isfinite(corners).all():
            raise ValueError("nan, inf")
    except ValueError as error:
        raise InputError("io.no-readable-stl-file", name=path.name, error=error) from error
    if len(corners) == 0:
        raise InputError("io.holds-no-triangles", name=path.name)
    return corners
