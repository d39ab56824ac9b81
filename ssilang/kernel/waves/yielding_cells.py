"""Cells whose forces no stiffness gives: those of a plastic law, or of a joint that opens."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.plasticity.points import is_plastic


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
        if _is_linear(zone):
            continue
        found = np.flatnonzero(wanted(zone.cells.connectivity))
        if len(found) and first is None:
            middle = zone.cells.coordinates[found[0]].mean(axis=0)
            first = (zone.behaviour, zone.cells.nodes.shown(middle))
        count += len(found)
    return None if first is None else Yielding(*first, count)


def _is_linear(zone: Zone) -> bool:
    return law_of(zone.behaviour).linear if is_joint(zone) else not is_plastic(zone)


def _keys(nodes: IntArray) -> list[bytes]:
    return [row.tobytes() for row in np.sort(nodes.astype(np.int64), axis=1)]
