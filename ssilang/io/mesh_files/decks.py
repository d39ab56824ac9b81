"""Meshes as input decks of other codes: Abaqus (.inp) and Nastran bulk data (.bdf).

Sources: the keyword *ELEMENT and the element library of Abaqus' manuals; the entries GRID, CROD,
CTRIA3 ... CHEXA of the Nastran Quick Reference Guide. Nodes are numbered from 1 in the order of
the mesh's nodes, cells from 1 block by block; a block is an ELSET, or has a property number.
"""

from collections.abc import Iterator

import numpy as np

from ssilang.io.errors import OutputError
from ssilang.io.mesh_files.file_mesh import FileMesh, names_in
from ssilang.io.vtk.grid import ORDERS
from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.mesh.mesh import Mesh

_SOLIDS, _PLANE = names_in("solid"), names_in("plane")
_NASTRAN_ORDERS: dict[str, tuple[int, ...]] = {
    # VTK's order, but the middles between bottom and top stand before those of the top
    "PR15": (*range(9), 12, 13, 14, 9, 10, 11),
    "CU20": (*range(12), 16, 17, 18, 19, 12, 13, 14, 15),
}


def abaqus_lines(mesh: Mesh, plane: str = "") -> list[str]:
    """Lines of an Abaqus deck of a mesh of solids.

    Parameters
    ----------
    plane : 'CPE', 'CPS' or 'CAX', optional
        What surfaces are in two dimensions: plane strain or stress, or of revolution.

    Raises
    ------
    OutputError
        If the mesh holds no solids, or something else too.
    """
    names = _SOLIDS | ({kind: plane + n for kind, n in _PLANE.items()} if plane else {})
    lines = ["*HEADING", "*NODE"]
    for number, (x, y, z) in enumerate(_points(mesh), start=1):
        lines.append(f"{number}, {x!r}, {y!r}, {z!r}")
    for name, block, first, rows in _blocks(mesh, names, "ABAQ"):
        lines.append(f"*ELEMENT, TYPE={name}, ELSET=E{block}")
        for number, row in enumerate(rows.tolist(), start=first):
            lines += _over_lines([number, *row], 15)
    return lines


def abaqus_lines_of(mesh: FileMesh, plane: str = "") -> list[str]:
    """Lines of an Abaqus deck of a mesh with its named parts as sets.

    Parameters
    ----------
    plane : 'CPE', 'CPS' or 'CAX', optional
        What surfaces are in two dimensions; in space they are shells, and lines are beams.

    Raises
    ------
    OutputError
        For cells that have no element, or names that a set cannot have.
    """
    flat = {kind: plane + n for kind, n in _PLANE.items()} | names_in("beam")
    names = _SOLIDS | (flat if plane else names_in("structure"))
    others = sorted(set(mesh.cells) - set(names) - {"POI1"})
    if others:
        raise OutputError("io.mesh-cells-not-written", kind="ABAQUS", others=others, known=names)
    lines = ["*HEADING", "*NODE"]
    lines += [f"{i}, {x!r}, {y!r}, {z!r}" for i, (x, y, z) in enumerate(mesh.points.tolist(), 1)]
    firsts = {}
    first = 1
    for cell_type, table in mesh.cells.items():
        if cell_type != "POI1":
            firsts[cell_type] = first
            # the middle node of a beam is its second
            order = (0, 1, 2) if cell_type == "SEG3" else ORDERS[cell_type][1]
            lines.append(f"*ELEMENT, TYPE={names[cell_type]}")
            for number, row in enumerate((table[:, list(order)] + 1).tolist(), start=first):
                lines += _over_lines([number, *row], 15)
            first += len(table)
    for name, part in mesh.parts.items():
        if not name.isascii() or any(c in name for c in ',=*"') or len(name) > 80:
            raise OutputError("io.mesh-part-name", name=name, kind="ABAQUS")
        nodes = [part.nodes]
        if "POI1" in part.cells:
            nodes.append(mesh.cells["POI1"][part.cells["POI1"], 0])
        cells = [firsts[kind] + rows for kind, rows in part.cells.items() if kind != "POI1"]
        for word, members in (("NSET", [n + 1 for n in nodes]), ("ELSET", cells)):
            numbers = np.unique(np.concatenate([np.empty(0, dtype=np.int64), *members])).tolist()
            if numbers:
                lines.append(f'*{word}, {word}="{name}"')
                lines += [
                    ", ".join(map(str, numbers[i : i + 16])) for i in range(0, len(numbers), 16)
                ]
    return lines


def _over_lines(numbers: list[int], width: int) -> list[str]:
    """Numbers on as many lines as they need, a comma at the end of each that goes on."""
    cut = [numbers[i : i + width] for i in range(0, len(numbers), width)]
    return [", ".join(map(str, c)) + ("," if c is not cut[-1] else "") for c in cut]


def nastran_lines(mesh: Mesh) -> list[str]:
    """Lines of Nastran bulk data of a mesh: nodes in large fields, cells in small ones.

    Raises
    ------
    OutputError
        If the mesh holds no cells, or kinds that have no entry.
    """
    lines = ["BEGIN BULK"]
    for number, point in enumerate(_points(mesh), start=1):
        x, y, z = (f"{v:16.9E}" for v in point)
        lines += [f"GRID*   {number:16d}{0:16d}{x}{y}", f"*       {z}"]
    for name, block, first, rows in _blocks(mesh, names_in("nastran"), "NAS", _NASTRAN_ORDERS):
        for number, row in enumerate(rows.tolist(), start=first):
            fields = [f"{n:8d}" for n in (number, block, *row)]
            lines.append(f"{name:8s}" + "".join(fields[:8]))
            lines += ["+       " + "".join(fields[i : i + 8]) for i in range(8, len(fields), 8)]
    return [*lines, "ENDDATA"]


def _points(mesh: Mesh) -> list[tuple[float, float, float]]:
    return [tuple(p) for p in mesh.nodes.coordinates[mesh.node_ids].tolist()]


def _blocks(
    mesh: Mesh, names: dict[str, str], word: str, orders: dict[str, tuple[int, ...]] | None = None
) -> Iterator[tuple[str, int, int, IntArray]]:
    """Name, number of the block, number of its first cell and rows of nodes, from 1."""
    others = {b.cell_type for b in mesh.blocks} - set(names)
    if others or not mesh.blocks:
        raise OutputError("io.deck-holds-no-such-cells", word=word, others=others, known=names)
    local = np.zeros(int(mesh.node_ids.max()) + 1, dtype=np.int64)
    local[mesh.node_ids] = np.arange(1, len(mesh.node_ids) + 1)
    first = 1
    for number, block in enumerate(mesh.blocks, start=1):
        kind = block.cell_type
        rows = local[block.connectivity][:, ORDERS[kind][1]]
        order = (orders or {}).get(kind)
        yield names[kind], number, first, rows if order is None else rows[:, order]
        first += len(block)
