"""Cells whose forces no stiffness gives: those of a plastic law, or of a joint that opens.

And those of a free field that have yielded: no linear ground moves as they did.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.plasticity.points import is_plastic

PLASTIC = "EPSE"
"""Cumulated plastic strain among internal variables."""
NOTHING = 1e-9
"""Plastic strain that changes no motion."""


@dataclass(frozen=True)
class Yielding:
    """Law, middle of the first cell, number of cells."""

    behaviour: tuple[str, ...]
    place: FloatArray
    count: int

    def told(self) -> dict[str, Any]:
        """What messages say of them."""
        return {"law": " ".join(self.behaviour), "place": self.place, "count": self.count}


def yielding_outside(model: Model, inside: Mesh) -> Yielding | None:
    """Cells of laws that are not linear among those that are not cells of a mesh."""
    kept = {key for block in inside.blocks for key in _keys(block.connectivity)}
    return _yielding(model, lambda nodes: np.array([k not in kept for k in _keys(nodes)], bool))


def yielding_at(model: Model, edge: Mesh) -> Yielding | None:
    """Cells of laws that are not linear among those that touch a mesh."""
    nodes = edge.sorted_node_ids
    return _yielding(model, lambda of: np.asarray(np.isin(of, nodes).any(axis=1), bool))


def _yielding(model: Model, wanted: Callable[[IntArray], BoolArray]) -> Yielding | None:
    count, first = 0, None
    for zone in model.zones:
        if law_of(zone.behaviour).linear if is_joint(zone) else not is_plastic(zone):
            continue
        found = np.flatnonzero(wanted(zone.cells.connectivity))
        if len(found) and first is None:
            first = (zone.behaviour, zone.cells.shown_middle(int(found[0])))
        count += len(found)
    return None if first is None else Yielding(*first, count)


def _keys(nodes: IntArray) -> list[bytes]:
    return [row.tobytes() for row in np.sort(nodes.astype(np.int64), axis=1)]


@dataclass(frozen=True)
class Yielded:
    """Largest cumulated plastic strain, middle of its cell, number of cells that have yielded."""

    strain: float
    place: FloatArray
    count: int


def yielded(variables: CellField, nodes: IntArray, axis: int | None = None) -> Yielded | None:
    """Cells of a free field that have yielded, of those whose motion some nodes take.

    Parameters
    ----------
    variables : CellField
        Internal variables at the end of the free field.
    nodes : array (n,)
        Nodes that take the motion.
    axis : int or None
        Upward axis, if they take that of a column at their height; None for that of their own.
    """
    count, worst, place = 0, 0.0, np.zeros(0)
    for block in variables.blocks:
        if PLASTIC not in block.components or not len(block.cells):
            continue
        strain = np.asarray(block.components[PLASTIC], dtype=float).max(axis=1)
        strain = np.broadcast_to(strain, (len(block.cells),))
        found = np.flatnonzero((strain > NOTHING) & _concerned(block.cells, nodes, axis))
        count += len(found)
        if len(found) and strain[found].max() > worst:
            cell = int(found[np.argmax(strain[found])])
            worst = float(strain[cell])
            place = block.cells.shown_middle(cell)
    return Yielded(worst, place, count) if count else None


def _concerned(cells: CellBlock, nodes: IntArray, axis: int | None) -> BoolArray:
    """Which cells have these nodes alone, or reach in between their heights."""
    if axis is None:
        return np.asarray(np.isin(cells.connectivity, nodes).all(axis=1), bool)
    heights = cells.nodes.coordinates[nodes, axis]
    own = cells.coordinates[..., axis]
    low, high = own.min(axis=1), own.max(axis=1)
    slack = 1e-6 * (high - low)
    return np.asarray((high > heights.min() + slack) & (low < heights.max() - slack), bool)
