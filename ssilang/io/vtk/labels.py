"""Names of cells as VTK files have them: a number in each cell, and the name of each number.

Readers other than VTK's know no texts in fields, so that the names stand in the field data, each
with its number: `group_SOIL` = 2 says what the 2 of the cells' array `group` is.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

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
    keys = [_Keys(block) for block in mesh.blocks]
    for what, sets in told.items():
        found = _numbers(keys, list(sets.values()))
        used = [(i, name) for i, name in enumerate(sets, start=1) if (found == i).any()]
        if used:
            numbers[what] = found
            names |= {f"{what}_{name}": float(i) for i, name in used}
    if part is not None:
        numbers["part"] = np.full(mesh.n_cells, part[0], dtype=np.int64)
        names[f"part_{part[1]}"] = float(part[0])
    return Labels(numbers, names)


def _numbers(keys: "Sequence[_Keys]", sets: Sequence[Sequence[CellBlock]]) -> IntArray:
    """Number from 1 of the smallest set that has a cell, 0 where none has (n_cells,)."""
    sizes = [sum(len(block) for block in blocks) for blocks in sets]
    found = [np.zeros(len(k.block), dtype=np.int64) for k in keys]
    # smaller ones overwrite, and earlier ones of the same size
    for i in sorted(range(len(sets)), key=lambda i: (-sizes[i], -i)):
        for key, numbers in zip(keys, found, strict=True):
            for block in sets[i]:
                numbers[key.rows(block)] = i + 1
    return np.concatenate([np.zeros(0, dtype=np.int64), *found])


class _Keys:
    """Finds cells of a block among others, by one number for a cell's nodes."""

    def __init__(self, block: CellBlock) -> None:
        self.block = block
        self._sorted: tuple[NDArray[np.uint64], IntArray, IntArray] | None = None

    def rows(self, other: CellBlock) -> IntArray | slice:
        """Rows of this block that `other` has too."""
        if other is self.block or other.raw is self.block.raw:
            return slice(None)
        if other.cell_type != self.block.cell_type or not len(other) or not len(self.block):
            return slice(0, 0)
        keys, order, nodes = self._index()
        wanted = np.sort(other.connectivity, axis=1)
        at = np.minimum(np.searchsorted(keys, _hashed(wanted)), len(keys) - 1)
        rows = order[at]
        return rows[(nodes[rows] == wanted).all(axis=1)]

    def _index(self) -> tuple[NDArray[np.uint64], IntArray, IntArray]:
        if self._sorted is None:
            nodes = np.sort(self.block.connectivity, axis=1)
            keys = _hashed(nodes)
            order = np.argsort(keys, kind="stable")
            self._sorted = keys[order], order, nodes
        return self._sorted


def _hashed(nodes: IntArray) -> NDArray[np.uint64]:
    """A number for each row of nodes (n,): equal rows have equal ones."""
    factors = np.random.default_rng(0).integers(1, 1 << 63, nodes.shape[1], dtype=np.uint64)
    return (nodes.astype(np.uint64) * (factors | np.uint64(1))).sum(axis=1)
