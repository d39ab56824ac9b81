"""Meshes with their named parts as files of other programs: Gmsh, MED, Abaqus."""

import io
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.atomic import replacing
from ssilang.io.errors import OutputError
from ssilang.io.mesh_files.decks import abaqus_lines_of
from ssilang.io.mesh_files.file_mesh import FileMesh
from ssilang.io.mesh_files.foreign import NAMES, library, vtk_order
from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.orientation import flipped_order

WRITTEN = {".msh": "GMSH", ".med": "MED", ".inp": "ABAQUS"}
"""Formats that are written with named parts, by the ending."""


def write_mesh_file(path: Path, mesh: FileMesh, dimension: int, plane: str = "") -> None:
    """Write a mesh, whole or not at all, in the format of the file's ending.

    Parameters
    ----------
    dimension : int
        Of space: MED says it.
    plane : 'CPE', 'CPS' or 'CAX', optional
        What surfaces are in an Abaqus deck in two dimensions.

    Raises
    ------
    OutputError
        For cells or names that the format has not, or without a library for it.
    """
    writer = _WRITERS[WRITTEN[path.suffix.lower()]]
    with tempfile.TemporaryDirectory() as folder:
        aside = Path(folder) / f"mesh{path.suffix.lower()}"
        said = io.StringIO()
        try:
            with redirect_stderr(said), redirect_stdout(said):
                writer(aside, mesh, dimension, plane)
        except ImportError as error:
            raise OutputError(
                "io.mesh-library-missing", kind=WRITTEN[path.suffix.lower()], library=error.name
            ) from error
        with replacing(path) as stream, open(aside, "rb") as made:
            shutil.copyfileobj(made, stream)


def _known(mesh: FileMesh, kind: str) -> None:
    others = sorted(set(mesh.cells) - set(NAMES))
    if others:
        raise OutputError("io.mesh-cells-not-written", kind=kind, others=others, known=list(NAMES))


# ---- Gmsh: an element again for each further group that has it, as Gmsh itself writes 2.2 --------


def _gmsh(path: Path, mesh: FileMesh, dimension: int, plane: str) -> None:
    _known(mesh, "GMSH")
    cells, tags, names = [], [], {}
    for tag, name, cell_type, rows in _tagged(mesh):
        if name:
            names[name] = np.array([tag, CELL_TYPES[cell_type].dimension])
        cells.append((NAMES[cell_type], rows))
        tags.append(np.full(len(rows), tag, dtype=np.int32))
    data = {"gmsh:physical": tags, "gmsh:geometrical": [np.maximum(t, 1) for t in tags]}
    made = library().Mesh(mesh.points, cells, cell_data=data, field_data=names)
    made.write(path, file_format="gmsh22", binary=False)


def _tagged(mesh: FileMesh) -> Iterator[tuple[int, str, str, IntArray]]:
    """Number and name of a group, type and rows of its cells; number 0 for those of none."""
    left = {k: np.ones(len(t), dtype=bool) for k, t in mesh.cells.items()}
    found = []
    for tag, (name, part) in enumerate(mesh.parts.items(), start=1):
        if '"' in name:
            raise OutputError("io.mesh-part-name", name=name, kind="GMSH")
        dimensions = {CELL_TYPES[k].dimension for k in part.cells} | {0}
        for cell_type, rows in part.cells.items():
            d = CELL_TYPES[cell_type].dimension
            shown = name if d == max(dimensions) else f"{name}_{d}D"
            table = mesh.cells[cell_type][rows]
            found.append((tag, shown, cell_type, table[:, vtk_order(cell_type)]))
            left[cell_type][rows] = False
        if len(part.nodes):
            shown = name if max(dimensions) == 0 else f"{name}_0D"
            found.append((tag, shown, "POI1", part.nodes[:, None]))
    for cell_type, table in mesh.cells.items():
        if left[cell_type].any():
            found.append((0, "", cell_type, table[left[cell_type]][:, vtk_order(cell_type)]))
    # points first, as Gmsh has them; readers take a type's cells together
    yield from sorted(found, key=lambda f: (CELL_TYPES[f[2]].dimension, f[2]))


# ---- MED: a family for each set of groups that cells have in common ------------------------------


def _med(path: Path, mesh: FileMesh, dimension: int, plane: str) -> None:
    _known(mesh, "MED")
    for name in mesh.parts:
        if not name.isascii() or len(name) > 80:
            raise OutputError("io.mesh-part-name", name=name, kind="MED")
    cell_tags: dict[int, list[str]] = {}
    cells, tags = [], []
    for cell_type, table in mesh.cells.items():
        groups = [(n, p.cells[cell_type]) for n, p in mesh.parts.items() if cell_type in p.cells]
        tags.append(_families(len(table), groups, cell_tags, -1))
        cells.append((NAMES[cell_type], _turned(cell_type, table)[:, vtk_order(cell_type)]))
    point_tags: dict[int, list[str]] = {}
    groups = [(n, p.nodes) for n, p in mesh.parts.items() if len(p.nodes)]
    nodes = _families(len(mesh.points), groups, point_tags, 1)
    made = library().Mesh(
        mesh.points[:, :dimension],
        cells,
        point_data={"point_tags": nodes},
        cell_data={"cell_tags": tags},
    )
    made.point_tags, made.cell_tags = point_tags, cell_tags
    made.write(path, file_format="med")
    _number_types(path)


def _families(
    count: int, groups: list[tuple[str, IntArray]], known: dict[int, list[str]], sign: int
) -> IntArray:
    """Family of each of `count` things; the families' groups are put into `known`."""
    marks = np.zeros((count, len(groups)), dtype=bool)
    for i, (_, rows) in enumerate(groups):
        marks[rows, i] = True
    families = np.zeros(count, dtype=np.int64)
    if not groups or not count:
        return families
    kinds, of = np.unique(marks, axis=0, return_inverse=True)
    for i, kind in enumerate(kinds):
        names = [groups[k][0] for k in np.flatnonzero(kind)]
        if names:
            number = next((n for n, held in known.items() if held == names), 0)
            number = number or sign * (len(known) + 1)
            known[number] = names
            families[of.ravel() == i] = number
    return families


def _turned(cell_type: str, table: IntArray) -> IntArray:
    """Cells as MED describes them: solids the other way round."""
    if CELL_TYPES[cell_type].dimension < 3:
        return table
    return table[:, list(flipped_order(cell_type))]


def _number_types(path: Path) -> None:
    """The number of each cell's shape, which Code_Aster asks for and meshio leaves out."""
    import h5py

    shapes = {"PO": 0, "SE": 1, "TR": 2, "QU": 2, "TE": 3, "HE": 3, "PY": 3, "PE": 3}
    quadratic = {"T10": 310, "H20": 320, "P13": 313, "P15": 315}
    with h5py.File(path, "r+") as file:
        for step in file["ENS_MAA/mesh"].values():
            for name, group in step["MAI"].items():
                shape = quadratic.get(name) or 100 * shapes[name[:2]] + int(name[2:])
                group.attrs.create("GEO", 1 if name == "PO1" else shape)


# ---- Abaqus --------------------------------------------------------------------------------------


def _abaqus(path: Path, mesh: FileMesh, dimension: int, plane: str) -> None:
    path.write_text("".join(t + "\n" for t in abaqus_lines_of(mesh, plane)), encoding="utf-8")


_Writer = Callable[[Path, FileMesh, int, str], Any]
_WRITERS: dict[str, _Writer] = {"GMSH": _gmsh, "MED": _med, "ABAQUS": _abaqus}
