"""The door to meshio: meshes in the formats of other programs, with their named parts.

meshio numbers the nodes of a cell as VTK does, corners first. Of its readers those are let in
whose files come back whole in the tests; what they print is kept as remarks, what they raise
becomes a refusal.
"""

import io
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.errors import InputError, readable
from ssilang.io.mesh_files.bounds import Text, check_hdf5, nodes_held, opened, unpacked
from ssilang.io.mesh_files.file_mesh import NONE, FileMesh, Part, names_in, padded, refuse_doubles
from ssilang.io.vtk.grid import ORDERS
from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.mesh.cells import POLYGON_SIDES

NAMES: dict[str, str] = names_in("meshio")
"""meshio's names of the cell types here."""
_TYPES = {name: cell_type for cell_type, name in NAMES.items()}

# middles of a brick's faces as VTK has them: x-, x+, y-, y+, bottom, top; then its own
_FACES_OF_27 = (25, 23, 22, 24, 20, 21, 26)
_POLYGONS = {3: "TRI3", 4: "QUA4"} | {n: name for name, n in POLYGON_SIDES.items()}
_MOST_TAGS = 200  # different numbers in an array of integers that tells parts


@dataclass(frozen=True)
class Foreign:
    """A format that meshio reads."""

    reader: str  # what meshio calls it
    endings: tuple[str, ...]
    library: str = ""  # what meshio needs for it beside itself, '' if nothing


FOREIGN = {
    "GMSH": Foreign("gmsh", (".msh",)),
    "MED": Foreign("med", (".med", ".rmed"), "h5py"),
    "VTU": Foreign("vtu", (".vtu",)),
    "VTK": Foreign("vtk", (".vtk",)),
    "NASTRAN": Foreign("nastran", (".bdf", ".nas", ".fem")),
    "MEDIT": Foreign("medit", (".mesh", ".meshb")),
}
"""Formats read through meshio, by their names in scripts."""


def library() -> Any:
    """meshio, with the two cells that its table of dimensions has forgotten (5.3)."""
    import meshio
    from meshio import _mesh

    for name in ("wedge15", "pyramid13"):
        _mesh.topological_dimension.setdefault(name, 3)
    return meshio


def read_foreign(path: Path, kind: str) -> FileMesh:
    """Read a file of one of the formats.

    Parameters
    ----------
    kind : str
        A key of `FOREIGN`.

    Raises
    ------
    InputError
        If it cannot be read, or a library for it is missing.
    """
    with _guarded(path, kind) as said:
        read = _read(path, kind)
        remarks = re.split(r"(?:Warning|Info|Error):", " ".join(said.getvalue().split()))
        told = tuple(t.strip() for t in remarks if t.strip())
        return _gathered(read, kind, told).sound(path.name, kind)


def foreign_mesh(path: Path, kind: str) -> Any:
    """The same as meshio has it, with its fields."""
    with _guarded(path, kind):
        return _read(path, kind)


@contextmanager
def _guarded(path: Path, kind: str) -> Iterator[io.StringIO]:
    """Keeps what a library prints meanwhile, and makes refusals of what it raises."""
    said = io.StringIO()
    with readable(path):
        path.open("rb").close()
    try:
        with redirect_stderr(said), redirect_stdout(said):
            yield said
    except InputError:
        raise
    except ImportError as error:
        raise InputError("io.mesh-library-missing", kind=kind, library=error.name) from error
    except Exception as error:  # a damaged file: the readers check little and raise anything
        raise InputError(
            "io.no-readable-mesh-file", name=path.name, kind=kind, error=_first_line(error)
        ) from error


def _first_line(error: Exception) -> str:
    """What an error says, with its kind where that is little; '' if meshio just gives up."""
    text = str(error).strip().splitlines()
    shown = text[0][:120] if text else ""
    kind = type(error).__name__
    return shown if len(shown) >= 12 or (not shown and kind == "ReadError") else f"{kind} {shown}"


_MSH2 = re.compile(rb"\$MeshFormat\s+2\S*\s+0\s")
_GRID = re.compile(r"^GRID\*?[ ,]+(\d+)(.*)$", re.MULTILINE)


def _gmsh(path: Path, kind: str) -> Any:
    from meshio.gmsh.main import read_buffer

    content = path.read_bytes()
    if _MSH2.search(content):  # the nodes of a text: meshio counts them, whatever their numbers
        nodes = content.partition(b"$Nodes")[2].partition(b"$EndNodes")[0]
        lines = nodes.decode("latin-1").strip().split("\n")[1:]
        refuse_doubles(path.name, ((int(t.split()[0]), t) for t in lines))
    with opened(path, binary=True) as stream, nodes_held(path):
        return read_buffer(stream)


def _vtk(path: Path, kind: str) -> Any:
    from meshio.vtk._main import read_buffer

    with opened(path, binary=True) as stream:
        return read_buffer(stream)


def _vtu(path: Path, kind: str) -> Any:
    from meshio.vtu import read

    with unpacked(path):
        return read(str(path))


def _med(path: Path, kind: str) -> Any:
    from meshio.med import read

    check_hdf5(path)
    return read(str(path))


def _medit(path: Path, kind: str) -> Any:
    from meshio.medit import _medit

    binary = path.name.endswith("b")
    with opened(path, binary) as stream:
        return (_medit.read_binary_buffer if binary else _medit.read_ascii_buffer)(stream)


# element cards of Nastran that meshio passes over without a word
_CARDS = re.compile(
    r"^(CELAS[2-4]|CDAMP[1-5]|CMASS[1-4]|CONM[12]|CVISC|CTUBE|CONROD|CWELD|CFAST|CBEND|CSEAM|"
    r"CRAC2D|CRAC3D|CTRIAX|CQUADX|CQUADX[48]|CTRIAX3|RBE[123]|RBAR|RROD|RTRPLT)\b",
    re.MULTILINE,
)


def _nastran(path: Path, kind: str) -> Any:
    """Bulk data; a file without its end would make meshio's reader turn for ever."""
    from meshio.nastran import _nastran

    text = path.read_text(encoding="latin-1").replace("\r\n", "\n")
    if "BEGIN BULK" not in text:
        text = "BEGIN BULK\n" + text
    if not re.search(r"^ENDDATA", text, re.MULTILINE):
        raise InputError("io.mesh-file-cut", name=path.name, kind=kind, end="ENDDATA")
    refuse_doubles(path.name, ((int(n), rest) for n, rest in _GRID.findall(text)))
    read = _nastran.read_buffer(Text(text.rstrip() + "\n"))
    if np.any(read.point_data.get("nastran:ref", 0)):
        raise InputError("io.nastran-coordinate-system", name=path.name)
    for card in _CARDS.findall(text):
        read.info = (read.info or {}) | {card: (read.info or {}).get(card, 0) + 1}
    return read


_READERS: Mapping[str, Callable[[Path, str], Any]] = {
    "GMSH": _gmsh, "MED": _med, "VTU": _vtu, "VTK": _vtk, "NASTRAN": _nastran, "MEDIT": _medit
}  # fmt: skip


def _read(path: Path, kind: str) -> Any:
    library()
    return _READERS[kind](path, kind)


# ---- cells and parts -----------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Block:
    """Where a block of meshio's went: type ('' if left out) and row of each of its cells."""

    cell_type: str
    rows: IntArray


def _gathered(read: Any, kind: str, remarks: tuple[str, ...]) -> FileMesh:
    points = np.asarray(read.points, dtype=float)
    if points.ndim != 2 or not len(points):
        raise ValueError("points")
    tables: dict[str, list[IntArray]] = {}
    left_out: dict[str, int] = dict(read.info) if isinstance(read.info, dict) else {}
    blocks = [_taken(block, tables, left_out) for block in read.cells]
    cells = {cell_type: np.concatenate(parts) for cell_type, parts in tables.items()}
    if kind == "GMSH":
        cells, blocks = _once(cells, blocks)
    parts: dict[str, Part] = {}
    for name, chosen in _named(read, kind):
        _add(parts, name, _part(blocks, chosen))
    for name, nodes in _named_nodes(read):
        _add(parts, name, Part({}, np.unique(np.asarray(nodes, dtype=np.int64))))
    return FileMesh(padded(points), cells, parts, left_out, remarks)


def _taken(block: Any, tables: dict[str, list[IntArray]], left_out: dict[str, int]) -> _Block:
    data = block.data
    count = len(data)
    polygon = block.type == "polygon" and count
    cell_type = _POLYGONS.get(np.shape(data)[1], "") if polygon else _TYPES.get(block.type, "")
    if not cell_type:
        left_out[block.type] = left_out.get(block.type, 0) + count
        return _Block("", np.full(count, -1))
    table = np.asarray(data).astype(np.int64).reshape(count, -1)
    before = sum(len(t) for t in tables.get(cell_type, ()))
    tables.setdefault(cell_type, []).append(table[:, np.argsort(vtk_order(cell_type))])
    return _Block(cell_type, np.arange(before, before + count))


def vtk_order(cell_type: str) -> list[int]:
    """Places of VTK's nodes of a cell among those here."""
    order = list(ORDERS[cell_type][1])
    return [*order, *_FACES_OF_27] if cell_type == "CU27" else order


def _once(
    cells: dict[str, IntArray], blocks: Sequence[_Block]
) -> tuple[dict[str, IntArray], list[_Block]]:
    """Each cell once: Gmsh writes it again for each further physical group that has it."""
    made, places = {}, {}
    for cell_type, table in cells.items():
        _, first, back = np.unique(table, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(first)
        made[cell_type] = table[first[order]]
        places[cell_type] = np.argsort(order)[back.ravel()]
    return made, [_Block(b.cell_type, places[b.cell_type][b.rows]) if b.cell_type else b
                  for b in blocks]  # fmt: skip


def _part(blocks: Sequence[_Block], chosen: Sequence[IntArray]) -> Part:
    """The part of these cells of each block."""
    found: dict[str, list[IntArray]] = {}
    for block, cells in zip(blocks, chosen, strict=True):
        if block.cell_type and len(cells):
            found.setdefault(block.cell_type, []).append(block.rows[cells])
    return Part({cell_type: np.unique(np.concatenate(r)) for cell_type, r in found.items()})


def _add(parts: dict[str, Part], name: str, part: Part) -> None:
    """Put a part into the parts, joined with what bears its name."""
    if not part.cells and not len(part.nodes):
        return
    known = parts.get(name, Part())
    cells = dict(known.cells)
    for cell_type, rows in part.cells.items():
        cells[cell_type] = np.union1d(cells.get(cell_type, NONE), rows)
    parts[name] = Part(cells, np.union1d(known.nodes, part.nodes))


_Chosen = tuple[str, list[IntArray]]


def _named(read: Any, kind: str) -> Iterator[_Chosen]:
    """Names of parts with their cells in each block."""
    for name, sets in read.cell_sets.items():
        if not name.startswith("gmsh:"):
            yield name, [np.asarray(NONE if s is None else s, dtype=np.int64) for s in sets]
    for key, arrays in read.cell_data.items():
        whole = all(a is not None and a.dtype.kind in "iu" and a.ndim == 1 for a in arrays)
        geometrical = key == "gmsh:geometrical" and "gmsh:physical" in read.cell_data
        if not whole or geometrical or not arrays:
            continue
        tags = np.unique(np.concatenate(arrays))
        if len(tags) <= _MOST_TAGS:
            for dimension, tag in _tags(tags, key, kind):
                names = _names_of(read, key, int(tag), dimension)
                for name in names:
                    yield (
                        name,
                        [
                            np.flatnonzero(a == tag) if dimension in (-1, b.dim) else NONE
                            for a, b in zip(arrays, read.cells, strict=True)
                        ],
                    )


def _tags(tags: IntArray, key: str, kind: str) -> Iterator[tuple[int, int]]:
    """Dimension and tag; -1 where tags count for all dimensions. But for VTK's, 0 is no tag."""
    by_dimension = key.startswith("gmsh:")
    for tag in tags.tolist():
        if tag == 0 and kind not in ("VTU", "VTK"):
            continue
        for dimension in (0, 1, 2, 3) if by_dimension else (-1,):
            yield dimension, tag


def _names_of(read: Any, key: str, tag: int, dimension: int) -> list[str]:
    """Names of the part whose cells have a tag in an array."""
    if key == "cell_tags":
        return list(read.cell_tags.get(tag, ()))
    found, begun = [], f"{key}_"
    for name, value in read.field_data.items():
        told = np.ravel(value).tolist() if np.asarray(value).dtype.kind in "iuf" else []
        if key == "gmsh:physical" and told == [tag, dimension]:
            return [] if name in read.cell_sets else [name]
        if told == [tag] and name.startswith(begun):
            found.append(name.removeprefix(begun))
    if found or any(name.startswith(begun) for name in read.field_data):
        return found
    dimensional = f"{dimension}D_" if dimension >= 0 else ""
    return [f"{key.partition(':')[2] or key}_{dimensional}{tag}"]


def _named_nodes(read: Any) -> Iterator[tuple[str, IntArray]]:
    yield from read.point_sets.items()
    tags = read.point_data.get("point_tags")
    for tag, names in getattr(read, "point_tags", {}).items():
        for name in names:
            yield name, np.flatnonzero(tags == tag)
