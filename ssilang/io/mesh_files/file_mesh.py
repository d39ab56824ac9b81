"""What a file of another program's mesh holds: points, cells by type, named parts."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.errors import InputError
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.remembered import tables_of

NONE = np.empty(0, dtype=np.int64)


def names_in(form: str) -> dict[str, Any]:
    """What a format calls the cells that it has, by type."""
    tables = tables_of(Path(__file__).with_name("cells.toml"))
    return {cell_type: names[form] for cell_type, names in tables.items() if form in names}


def refuse_doubles(name: str, numbered: Iterable[tuple[int, object]]) -> None:
    """Refuse a number that two nodes or two cells of a file bear: which one is meant is not said.

    Parameters
    ----------
    numbered : pairs of a number and what bears it; the same twice is once

    Raises
    ------
    InputError
    """
    known: dict[int, object] = {}
    for number, held in numbered:
        if known.setdefault(number, held) != held:
            raise InputError("io.mesh-number-twice", name=name, number=number)


@dataclass(frozen=True, eq=False)
class Part:
    """A named part.

    Attributes
    ----------
    cells : mapping of str to array (m,)
        Type to rows of the file's cells of that type.
    nodes : array (n,)
        Rows of the points.
    """

    cells: Mapping[str, IntArray] = field(default_factory=dict)
    nodes: IntArray = field(default_factory=NONE.copy)


@dataclass(frozen=True, eq=False)
class FileMesh:
    """What a file holds.

    Attributes
    ----------
    points : array (n, 3)
    cells : dict of str to array (m, k)
        Type to rows of `points`, nodes in Cast3M's order.
    parts : dict of str to Part
    left_out : dict of str to int
        Cells without a counterpart here: how many by the file's name of their type.
    remarks : tuple of str
        What the library that read the file said meanwhile.
    """

    points: FloatArray
    cells: dict[str, IntArray]
    parts: dict[str, Part] = field(default_factory=dict)
    left_out: dict[str, int] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()

    def sound(self, name: str, kind: str) -> "FileMesh":
        """The mesh itself, if its cells and parts name points and cells that are there.

        Raises
        ------
        InputError
            If they do not.
        """
        n = len(self.points)
        tables = [*self.cells.values(), *(p.nodes for p in self.parts.values())]
        wrong = next((t for t in tables if t.size and not (t.min() >= 0 and t.max() < n)), None)
        if wrong is not None:
            raise InputError("io.mesh-file-names-no-node", name=name, kind=kind)
        for part in self.parts.values():
            for cell_type, rows in part.cells.items():
                count = len(self.cells[cell_type])
                if rows.size and not (rows.min() >= 0 and rows.max() < count):
                    raise InputError("io.mesh-file-names-no-cell", name=name, kind=kind)
        return self


def padded(points: FloatArray) -> FloatArray:
    """Points (n, 1..3) with three columns, missing ones zero."""
    made = np.zeros((len(points), 3))
    made[:, : points.shape[1]] = points
    return made
