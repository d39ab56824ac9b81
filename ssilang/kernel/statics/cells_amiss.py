"""Cells that do not fit: nodes that hang in the edge of another cell, single layers that bend.

A node in the middle of an edge that does not know it moves by itself: the two sides part or
overlap there. A cell with linear sides cannot bend: where one layer of them is all that there is
across a plate, shear takes what bending should (R. D. Cook, Concepts and Applications of Finite
Element Analysis, the four-node element in pure bending).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, IntArray
from ssilang.kernel.elements.catalog import LOCKING
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.boundary import sharing
from ssilang.kernel.mesh.cells import CellType

_SAME = 1e-9  # of directions that are one
_LONG = 2.0  # length over thickness of a cell beyond which a single layer is told
_PLATE = 10.0  # thicknesses across which a single layer is a plate


def _solids(matrix: Matrix) -> Iterator[tuple[ElementMatrices, CellType, str]]:
    for block in matrix.blocks:
        zone = block.zone
        if zone is not None and not is_joint(zone) and zone.cells.kind.dimension >= 2:
            yield block, zone.cells.kind, zone.element


def hanging_nodes(matrix: Matrix) -> IntArray:
    """Nodes (n,), in no condition, inside an edge of a cell that shares an end with their own."""
    links = [np.zeros((0, 2), np.int64)]
    for block, kind, _ in _solids(matrix):
        for name, local in kind.faces:
            ring = np.array(local[: len(local) - (name in ("TRI7", "QUA9"))])
            ends = ring if kind.dimension == 3 else ring[:-1]
            pairs = block.nodes[:, np.stack([ends, np.resize(np.roll(ring, -1), len(ends))], 1)]
            links += [pairs.reshape(-1, 2), pairs[..., ::-1].reshape(-1, 2)]
    a, b = np.unique(np.concatenate(links), axis=0).T
    way = matrix.table.coordinates[b] - matrix.table.coordinates[a]
    length = np.linalg.norm(way, axis=1)
    unit = way / length[:, None]
    order = np.lexsort((unit @ (0.5413, 0.6967, 0.4711), a))
    a, b, unit, length = a[order], b[order], unit[order], length[order]
    alike = np.abs(np.diff(unit, axis=0)).max(axis=1, initial=0.0) < _SAME
    together = np.flatnonzero((np.diff(a) == 0) & alike)
    inner = b[together + (length[together] > length[together + 1])]
    tied = [r.nodes for r in matrix.relations]
    return np.setdiff1d(inner, np.concatenate([inner[:0], *tied]))


@dataclass(frozen=True)
class Layer:
    """A single layer of linear cells: a node, their number, their length over their thickness."""

    node: int
    count: int
    slender: float

    @property
    def stiffer(self) -> float:
        """How many times too stiff it bends, for Poisson's ratio 0: `1 + (l / t)^2 / 2`."""
        return 1.0 + 0.5 * self.slender**2


def bent_layer(matrix: Matrix) -> Layer | None:
    """The most slender of single layers of linear cells, some thicknesses large; None without."""
    solids = [found for found in _solids(matrix) if found[2] in LOCKING]
    tied = np.unique(np.concatenate([np.zeros(0, np.int64), *(r.nodes for r in matrix.relations)]))
    whole: dict[int, list[IntArray]] = {}
    for block, kind, _ in solids:
        for _, local in kind.faces:
            whole.setdefault(len(local), []).append(block.nodes[:, list(local)])
    free = {n: iter(_split(sharing(np.concatenate(t))[0] == 1, t)) for n, t in whole.items()}
    found = []
    for block, kind, _ in solids:
        points = matrix.table.coordinates[block.nodes]
        border = [next(free[len(local)]) for _, local in kind.faces]
        middles = [points[:, list(local)].mean(axis=1) for _, local in kind.faces]
        sides = [{*local} for _, local in kind.faces]
        across = [(i, j) for i in range(len(sides)) for j in range(i) if not sides[i] & sides[j]]
        loose = ~np.isin(block.nodes, tied).all(axis=1)
        for i, j in across:
            thick = np.linalg.norm(middles[i] - middles[j], axis=1)
            side = points[:, list(kind.faces[i][1])]
            slender = np.linalg.norm(side - np.roll(side, 1, 1), axis=2).max(axis=1) / thick
            alone = border[i] & border[j] & loose & (slender > _LONG)
            size = np.ptp(points[alone].reshape(-1, 3), axis=0).max() if alone.any() else 0.0
            if size > _PLATE * thick[alone].max(initial=0.0):
                node, mean = int(block.nodes[alone][0, 0]), float(np.median(slender[alone]))
                found.append(Layer(node, int(alone.sum()), mean))
    return max(found, key=lambda layer: layer.slender, default=None)


def _split(values: BoolArray, tables: list[IntArray]) -> list[BoolArray]:
    """Values of tables set one behind the other, table by table."""
    return np.split(values, np.cumsum([len(t) for t in tables])[:-1])
