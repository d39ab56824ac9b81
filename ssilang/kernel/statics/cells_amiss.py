"""Cells that do not fit: nodes that hang in the edge of another cell, single layers that bend.

A node in the middle of an edge that does not know it moves by itself: the two sides part or
overlap there. A cell with linear sides cannot bend: where one layer of them is all that there is
across a plate, shear takes what bending should (R. D. Cook, Concepts and Applications of Finite
Element Analysis, the four-node element in pure bending).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain, combinations, permutations
from typing import cast

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, IntArray
from ssilang.kernel.elements.catalog import LOCKING
from ssilang.kernel.interface.elements import is_joint, joint_element
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.queries.select import cells_containing
from ssilang.kernel.statics.doubled import face_keys

_SAME = 1e-9  # of directions that are one
_LONG = 2.0  # length over thickness of a cell beyond which a single layer is told
_LOOKED_AT = 64  # cells of a part where others may be
_PLATE = 10.0  # thicknesses across which a single layer is a plate

Solids = list[tuple[ElementMatrices, Zone, list[BoolArray]]]


def bordered_solids(matrix: Matrix) -> Solids:
    """Blocks of cells of two or three dimensions; by face, which cells have it for themselves."""
    if "solids" in matrix.cache:
        return cast(Solids, matrix.cache["solids"])
    blocks = {id(b.raw_nodes): b for b in matrix.blocks if b.zone and not is_joint(b.zone)}.values()
    solids = [(b, b.zone) for b in blocks if b.zone and b.zone.cells.kind.dimension >= 2]
    keys = [[face_keys(b.nodes[:, list(x)]) for _, x in z.cells.kind.faces] for b, z in solids]
    every = np.concatenate([np.zeros(0, np.int64), *chain.from_iterable(keys)])
    known, times = np.unique(every, return_counts=True)
    alone = known[times == 1]
    borders = [[np.isin(k, alone) for k in own] for own in keys]
    made = [(b, zone, border) for (b, zone), border in zip(solids, borders, strict=True)]
    matrix.cache["solids"] = made
    return made


def hanging_nodes(matrix: Matrix, solids: Solids) -> IntArray:
    """Nodes (n,), in no condition, inside an edge of a cell that shares an end with their own."""
    links = [np.zeros((0, 2), np.int64)]
    for block, zone, border in solids:
        kind = zone.cells.kind
        for (name, local), alone in zip(kind.faces, border, strict=True):
            links.append(_sides(block.nodes[alone][:, list(local)], name, kind.dimension == 3))
    return _inner(matrix, np.concatenate(links))


def passed_by_joints(matrix: Matrix, joints: Iterable[Zone]) -> IntArray:
    """Nodes (n,) of bodies, in no condition, inside an edge of a joint that begins on their own."""
    links = [np.zeros((0, 2), np.int64)]
    for zone in (z for z in joints if z.element != "JOI1"):
        name, nodes = joint_element(zone).face, zone.cells.connectivity
        links += [_sides(half, name, name[:3] != "SEG") for half in np.split(nodes, 2, axis=1)]
    sides = np.concatenate(links)
    for block in matrix.blocks if len(sides) else ():
        if block.zone is not None and not is_joint(block.zone):
            near = block.nodes[np.isin(block.nodes, sides).any(axis=1)]
            kind = block.zone.cells.kind
            whole = ((kind.name, tuple(range(kind.n_nodes))),)
            for name, local in kind.faces if kind.dimension == 3 else whole:
                links.append(_sides(near[:, list(local)], name, kind.dimension > 1))
    return np.setdiff1d(_inner(matrix, np.concatenate(links)), sides)


def _sides(nodes: IntArray, name: str, closed: bool) -> IntArray:
    """Pairs (n, 2) of neighbours along lines (m, k) of nodes, of faces round about them."""
    ring = np.arange(nodes.shape[1] - (name in ("TRI7", "QUA9")))
    ends = ring if closed else ring[:-1]
    pairs = np.stack([ends, np.resize(np.roll(ring, -1), len(ends))], axis=1)
    return np.asarray(nodes[:, pairs].reshape(-1, 2))


def _inner(matrix: Matrix, edges: IntArray) -> IntArray:
    """The nearer ends (n,), in no condition, of edges (m, 2) that go one way from one node."""
    a, b = np.unique(np.concatenate([edges, edges[:, ::-1]]), axis=0).T
    way = matrix.table.coordinates[b] - matrix.table.coordinates[a]
    length = np.linalg.norm(way, axis=1)
    unit = way / np.maximum(length, np.finfo(float).tiny)[:, None]
    order = np.lexsort((unit @ (0.5413, 0.6967, 0.4711), a))
    a, b, unit, length = a[order], b[order], unit[order], length[order]
    alike = np.abs(np.diff(unit, axis=0)).max(axis=1, initial=0.0) < _SAME
    together = np.flatnonzero((np.diff(a) == 0) & alike)
    inner = b[together + (length[together] > length[together + 1])]
    tied = [r.nodes for r in matrix.relations]
    return np.setdiff1d(inner, np.concatenate([inner[:0], *tied]))


def overlapping_cells(matrix: Matrix, solids: Solids) -> IntArray:
    """First node (n,) of cells whose middle lies inside a cell of another part; some of them."""
    bodies = []
    for block, zone, _ in solids:
        if zone.cells.kind.dimension == zone.mode.dimension:
            x = matrix.table.coordinates[block.nodes]
            bodies.append((block, zone.cells, x.mean(axis=1), x.min(axis=1), x.max(axis=1)))
    found = list[int]()
    for (block, _, middles, *_), (_, cells, _, low, high) in permutations(bodies, 2):
        there = ((middles >= low.min(axis=0)) & (middles <= high.max(axis=0))).all(axis=1)
        inner = np.flatnonzero(there)
        for i in inner[:: 1 + len(inner) // _LOOKED_AT].tolist():
            near = ((low <= middles[i]) & (high >= middles[i])).all(axis=1)
            if near.any() and cells_containing(cells.some(near), middles[i]).any():
                found.append(int(block.nodes[i, 0]))
    return np.array(found, np.int64)


@dataclass(frozen=True)
class Layer:
    """A single layer of linear cells: a node, their number, their length over their thickness.

    `across` and `along` are the axes of its thickness and of its largest extent.
    """

    node: int
    count: int
    slender: float
    across: int
    along: int

    @property
    def stiffer(self) -> float:
        """How many times too stiff it bends, for Poisson's ratio 0: `1 + (l / t)^2 / 2`."""
        return 1.0 + 0.5 * self.slender**2


def bent_layer(matrix: Matrix, solids: Solids) -> Layer | None:
    """The most slender of single layers of linear cells, of cells that are long; None without."""
    return max(layers(matrix, solids, _LONG), key=lambda layer: layer.slender, default=None)


def layers(matrix: Matrix, solids: Solids, least: float = 0.0) -> list[Layer]:
    """Single layers of linear cells more slender than the least, some thicknesses large."""
    tied = np.concatenate([np.zeros(0, np.int64), *(r.nodes for r in matrix.relations)])
    found = []
    for block, zone, border in solids:
        points = matrix.table.coordinates[block.nodes]
        sides = [list(local) for _, local in zone.cells.kind.faces]
        loose = ~np.isin(block.nodes, tied).all(axis=1)
        for i, j in combinations(range(len(sides)), 2):
            if {*sides[i]} & {*sides[j]} or zone.element not in LOCKING:
                continue
            across = points[:, sides[i]].mean(axis=1) - points[:, sides[j]].mean(axis=1)
            thick = np.linalg.norm(across, axis=1)
            along = points[:, sides[i]] - np.roll(points[:, sides[i]], 1, axis=1)
            slender = np.linalg.norm(along, axis=2).max(axis=1) / thick
            alone = border[i] & border[j] & loose & (slender > least)
            extent = np.ptp(points[alone].reshape(-1, 3), axis=0) if alone.any() else np.zeros(3)
            if extent.max() > _PLATE * thick[alone].max(initial=0.0):
                node, mean = int(block.nodes[alone][0, 0]), float(np.median(slender[alone]))
                way = int(np.abs(across[alone]).sum(axis=0).argmax()), int(extent.argmax())
                found.append(Layer(node, int(alone.sum()), mean, *way))
    return found
