"""One door to meshes of other programs, by what tells their format: scripts and pictures use it."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.mesh_files import foreign
from ssilang.io.mesh_files.abaqus import read_abaqus
from ssilang.io.mesh_files.file_mesh import FileMesh
from ssilang.io.mesh_files.geo import read_geo
from ssilang.io.mesh_files.unv_stl import read_stl, read_unv


@dataclass(frozen=True)
class Asked:
    """What a reader may need to know.

    Attributes
    ----------
    dimension : int
        Of the space that a geometry is meshed for.
    allowed : function
        The path of a file that another one includes, by its path there, where it may be read.
    """

    dimension: int = 3
    allowed: Callable[[str], Path] = Path


def _stl(path: Path, asked: Asked) -> FileMesh:
    corners = read_stl(path)
    count = len(corners)
    return FileMesh(corners.reshape(-1, 3), {"TRI3": np.arange(3 * count).reshape(-1, 3)})


_OWN: dict[str, tuple[tuple[str, ...], Callable[[Path, Asked], FileMesh]]] = {
    "ABAQUS": (
        (".inp",),
        lambda path, asked: read_abaqus(path, lambda name: asked.allowed(str(path.parent / name))),
    ),
    "UNV": ((".unv",), lambda path, asked: read_unv(path)),
    "STL": ((".stl",), _stl),
    "GEO": ((".geo",), lambda path, asked: read_geo(path, asked.dimension)),
}
ENDINGS = {e: kind for kind, f in foreign.FOREIGN.items() for e in f.endings} | {
    e: kind for kind, (endings, _) in _OWN.items() for e in endings
}
"""Formats by the ending of the file."""


def read_mesh_file(path: Path, kind: str, asked: Asked) -> FileMesh:
    """The mesh of a file.

    Parameters
    ----------
    kind : str
        A value of `ENDINGS`.

    Raises
    ------
    InputError
        If it cannot be read, or a library for it is missing.
    """
    return _OWN[kind][1](path, asked) if kind in _OWN else foreign.read_foreign(path, kind)


def mesh_with_fields(path: Path, kind: str) -> Any:
    """The same as meshio's mesh, with the fields that the file has where meshio reads it.

    Of other formats the cells have `part`, the last named part that has them, from 1.
    """
    if kind in foreign.FOREIGN:
        return foreign.foreign_mesh(path, kind)
    read = read_mesh_file(path, kind, Asked())
    cells = [(foreign.NAMES[k], rows[:, foreign.vtk_order(k)]) for k, rows in read.cells.items()]
    numbers = {k: np.zeros(len(rows)) for k, rows in read.cells.items()}
    for number, part in enumerate(read.parts.values(), 1):
        for k, rows in part.cells.items():
            numbers[k][rows] = number
    data = {"part": list(numbers.values())} if read.parts else None
    return foreign.library().Mesh(read.points, cells, cell_data=data)
