"""Meshes as input decks of other codes: Abaqus (.inp) and Nastran bulk data (.bdf).

Sources: the keyword *ELEMENT and the element library of Abaqus' manuals; the entries GRID, CROD,
CTRIA3 ... CHEXA of the Nastran Quick Reference Guide. Nodes are numbered from 1 in the order of
the mesh's nodes, cells from 1 block by block; a block is an ELSET, or has a property number.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ssilang.io.errors import OutputError
from ssilang.io.vtk.cells import ORDERS
from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.mesh.mesh import Mesh

_SOLIDS = {
    "TET4": "C3D4", "TE10": "C3D10", "PYR5": "C3D5", "PRI6": "C3D6", "PR15": "C3D15",
    "CUB8": "C3D8", "CU20": "C3D20",
}  # fmt: skip
_PLANE = {"TRI3": "3", "TRI6": "6", "QUA4": "4", "QUA8": "8"}
_CARDS = {
    "SEG2": "CROD", "TRI3": "CTRIA3", "TRI6": "CTRIA6", "QUA4": "CQUAD4", "QUA8": "CQUAD8",
    "TET4": "CTETRA", "TE10": "CTETRA", "PYR5": "CPYRAM", "PRI6": "CPENTA", "PR15": "CPENTA",
    "CUB8": "CHEXA", "CU20": "CHEXA",
}  # fmt: skip
_NASTRAN_ORDERS = {
    # VTK's order, but the middles between bottom and top stand before those of the top
    "PR15": (*range(9), 12, 13, 14, 9, 10, 11),
    "CU20": (*range(12), 16, 17, 18, 19, 12, 13, 14, 15),
}


def abaqus_lines(mesh: Mesh, plane: str = "") -> list[str]:
    """Lines of an Abaqus deck of a mesh of solids.

    Parameters
    ----------
    mesh : Mesh
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
            fields = [str(n) for n in (number, *row)]
            lines += [", ".join(fields[i : i + 15]) + ", " for i in range(0, len(fields) - 15, 15)]
            lines.append(", ".join(fields[(len(fields) - 1) // 15 * 15 :]))
    return lines


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
    for name, block, first, rows in _blocks(mesh, _CARDS, "NAS", _NASTRAN_ORDERS):
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
