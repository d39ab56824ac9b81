"""Names of cells as VTK files have them: a number in each cell, and the name of each number.

Readers other than VTK's know no texts in fields, so that the names stand in the field data, each
with its number: `group_SOIL` = 2 says what the 2 of the cells' array `group` is.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ssilang.io.vtk.grid import matching_rows
from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

Named = Mapping[str, Sequence[CellBlock]]
"""Sets of cells by their names."""


@dataclass(frozen=True)
class Labels:
    """What the cells of a mesh are called.

    Attributes
    ----------
    numbers : mapping of str to array (n_cells,)
        By what is told ('group', 'material', 'part'): number of the name, 0 without one.
    names : mapping of str to float
        Number by what is told and the name: 'group_SOIL'.
    """

    numbers: Mapping[str, IntArray] = field(default_factory=dict)
    names: Mapping[str, float] = field(default_factory=dict)


def labels_of(mesh: Mesh, told: Mapping[str, Named], part: tuple[int, str] | None = None) -> Labels:
    """The labels of a mesh's cells.

    Parameters
    ----------
    told : mapping of str to sets
        What is told of the cells, from named sets: the smallest set that has a cell names it.
    part : (int, str), optional
        Number and name of the part that the whole mesh is.
    """
    numbers: dict[str, IntArray] = {}
    names: dict[str, float] = {}
    for what, sets in told.items():
        by_block = [_numbers(block, list(sets.values())) for block in mesh.blocks]
        found = np.concatenate([np.zeros(0, dtype=np.int64), *by_block])
        used = [(i, name) for i, name in enumerate(sets, start=1) if (found == i).any()]
        if used:
            numbers[what] = found
            names |= {f"{what}_{name}": float(i) for i, name in used}
    if part is not None:
        numbers["part"] = np.full(mesh.n_cells, part[0], dtype=np.int64)
        names[f"part_{part[1]}"] = float(part[0])
    return Labels(numbers, names)


def _numbers(block: CellBlock, sets: Sequence[Sequence[CellBlock]]) -> IntArray:
    """Number from 1 of the smallest set that has a cell, 0 where none has (n,)."""
    sizes = [sum(len(part) for part in parts) for parts in sets]
    # smaller ones are found first, and earlier ones of the same size
    order = sorted(range(len(sets)), key=lambda i: (sizes[i], i))
    named = [(part, i + 1) for i in order for part in sets[i] if part.cell_type == block.cell_type]
    values = np.repeat([i for _, i in named], [len(p) for p, _ in named])
    if not len(values):
        return np.zeros(len(block), dtype=np.int64)
    rows = matching_rows(block.connectivity, np.concatenate([p.connectivity for p, _ in named]))
    return np.where(rows < 0, 0, values[rows])
