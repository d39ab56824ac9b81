"""Where a field of cells takes a value, or lies on one side of it."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.mesh.changes.split import split_quadrangles, tetrahedra
from ssilang.kernel.mesh.combine import cell_keys, union, without_duplicates
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable

_SIMPLICES = ("POI1", "SEG2", "TRI3", "TET4")  # by number of nodes - 1
_TO_TETRAHEDRA = ("CUB8", "PRI6", "PYR5")
_SAME = 1e-14  # a node lies on the value when it differs by a few roundings only


@dataclass(frozen=True)
class _Pieces:
    """Simplices (n, k) with the value less the one sought at their nodes, and their colours."""

    cells: IntArray
    values: FloatArray
    colours: NDArray[np.int8]


def isovalue(field: CellField, value: float, side: int = 0) -> Mesh:
    """Points, lines, surfaces where a field at nodes equals a value; or the part on one side.

    A simplex is cut in two at an edge on which the value is crossed, edges in the order of their
    node numbers, until no piece is crossed: neighbours then agree on the faces that they share.
    What touches the value by a face, an edge or a node only gives that face, edge or node, unless
    a larger cell of the result holds it.

    Parameters
    ----------
    field : CellField
        One component, at nodes, linear in POI1, SEG2, TRI3, TET4; QUA4 and volumes are first
        cut into simplices (the field is then taken as continuous).
    side : int
        0: where the field equals the value; 1: where it is larger or equal; -1: smaller or equal.

    Raises
    ------
    MeshError
        If the field has several components, does not stand at nodes, or has quadratic cells.
    """
    if not field.blocks:
        raise MeshError("kernel.fields.field-empty")
    nodes = field.blocks[0].cells.nodes
    meshes: list[Mesh] = []
    whole = [_simplices(block, value) for block in field.blocks]
    cuts = _cuts(whole, nodes)
    for each in whole:
        pieces = _cut(each, cuts, len(nodes))
        for corners in range(pieces.cells.shape[1], 0, -1):
            meshes.append(_kept(pieces, corners, side, nodes))
    return _without_parts(meshes, nodes)


def _simplices(block: CellFieldBlock, value: float) -> _Pieces:
    if len(block.components) != 1:
        raise MeshError("kernel.fields.field-components", components=block.components)
    if block.support != "NOEUD":
        raise MeshError("kernel.fields.field-not-stand-nodes")
    (data,) = block.components.values()
    cells = block.cells
    values = np.broadcast_to(np.asarray(data, dtype=float), cells.connectivity.shape)
    pieces = _of_simplices(cells, values)
    scale = max(abs(value), float(np.abs(pieces.values).max(initial=0.0)))
    excess = pieces.values - value
    excess[np.abs(excess) <= _SAME * scale] = 0.0
    return _Pieces(pieces.cells, excess, pieces.colours)


def _of_simplices(cells: CellBlock, values: FloatArray) -> _Pieces:
    if cells.cell_type in _SIMPLICES:
        return _Pieces(cells.connectivity, values, cells.colours)
    if cells.cell_type == "QUA4":
        parts = split_quadrangles(Mesh(cells.nodes, (cells,))).single_block()
    elif cells.cell_type in _TO_TETRAHEDRA:
        parts = tetrahedra(cells)
    else:
        told = {"cell_type": cells.cell_type, "value": (*_SIMPLICES, "QUA4", *_TO_TETRAHEDRA)}
        raise MeshError("kernel.fields.no-value-looked-cells", **told)
    at_node = np.zeros(len(cells.nodes))
    at_node[cells.connectivity] = values
    return _Pieces(parts.connectivity, at_node[parts.connectivity], parts.colours)


@dataclass(frozen=True)
class _Cuts:
    """Nodes made on the crossed edges: rows (k, 4) of two nodes and the excess at them."""

    places: FloatArray
    made: IntArray

    def find(self, places: FloatArray) -> IntArray:
        """The nodes made at places (m, 4) that are among those known."""
        _, which = np.unique(np.concatenate([self.places, places]), axis=0, return_inverse=True)
        number = np.empty(len(which), dtype=np.int64)
        number[which.ravel()[: len(self.made)]] = self.made
        return number[which.ravel()[len(self.made) :]]


def _places(pieces: _Pieces, rows: IntArray, first: IntArray, second: IntArray) -> FloatArray:
    """Nodes in increasing order and the excess at them, (m, 4), for two local nodes of each row."""
    ends = np.stack([pieces.cells[rows, first], pieces.cells[rows, second]], axis=-1)
    excess = np.stack([pieces.values[rows, first], pieces.values[rows, second]], axis=-1)
    order = np.argsort(ends, axis=-1)
    pair = (np.take_along_axis(x, order, axis=-1) for x in (ends.astype(float), excess))
    return np.concatenate(list(pair), axis=-1)


def _cuts(meshes: list[_Pieces], nodes: NodeTable) -> _Cuts:
    """New nodes where the excess vanishes within an edge, one an edge."""
    found = [np.empty((0, 4))]
    for pieces in meshes:
        for first, second in combinations(range(pieces.cells.shape[1]), 2):
            rows = np.flatnonzero(pieces.values[:, first] * pieces.values[:, second] < 0)
            at = np.full(len(rows), first), np.full(len(rows), second)
            found.append(_places(pieces, rows, *at))
    places = np.unique(np.concatenate(found), axis=0)
    if not len(places):
        return _Cuts(places, np.empty(0, dtype=np.int64))
    ends = places[:, :2].astype(np.int64)
    share = (places[:, 2] / (places[:, 2] - places[:, 3]))[:, None]
    xyz, size = nodes.coordinates[ends], nodes.density[ends]
    return _Cuts(
        places,
        nodes.add(
            xyz[:, 0] + share * (xyz[:, 1] - xyz[:, 0]),
            size[:, 0] + share[:, 0] * (size[:, 1] - size[:, 0]),
        ),
    )


def _cut(pieces: _Pieces, cuts: _Cuts, n_nodes: int) -> _Pieces:
    """Pieces on none of which the excess changes sign."""
    first, second = np.triu_indices(pieces.cells.shape[1], 1)
    while len(first):
        crossed = pieces.values[:, first] * pieces.values[:, second] < 0
        rows = np.flatnonzero(crossed.any(axis=1))
        if not len(rows):
            break
        ends = np.sort(np.stack([pieces.cells[:, first], pieces.cells[:, second]], -1)[rows], -1)
        key = np.where(crossed[rows], ends[..., 0] * n_nodes + ends[..., 1], np.iinfo(int).max)
        edge = key.argmin(axis=1)
        pieces = _bisected(pieces, rows, first[edge], second[edge], cuts)
    return pieces


def _bisected(
    pieces: _Pieces, rows: IntArray, first: IntArray, second: IntArray, cuts: _Cuts
) -> _Pieces:
    """Pieces `rows` cut in two where the excess vanishes between local nodes (one pair a row)."""
    made = cuts.find(_places(pieces, rows, first, second))
    halves = []
    for end in (first, second):
        cells, values = pieces.cells[rows].copy(), pieces.values[rows].copy()
        cells[np.arange(len(rows)), end] = made
        values[np.arange(len(rows)), end] = 0.0
        halves.append((cells, values, pieces.colours[rows]))
    rest = np.ones(len(pieces.cells), dtype=bool)
    rest[rows] = False
    whole = (pieces.cells[rest], pieces.values[rest], pieces.colours[rest])
    return _Pieces(*(np.concatenate(parts) for parts in zip(whole, *halves, strict=True)))


def _kept(pieces: _Pieces, corners: int, side: int, nodes: NodeTable) -> Mesh:
    """Whole pieces on the wanted side, and faces of `corners` nodes on which the excess is 0."""
    zero = pieces.values == 0
    size = pieces.cells.shape[1]
    rows = zero.sum(axis=1) == corners
    table = pieces.cells[rows][zero[rows]].reshape(-1, corners)
    colours = pieces.colours[rows]
    if corners == size and side:
        inside = (pieces.values * side >= 0).all(axis=1)
        table, colours = pieces.cells[inside], pieces.colours[inside]
    if not len(table):
        return Mesh(nodes, ())
    return Mesh.of(nodes, _SIMPLICES[corners - 1], table, colours)


def _without_parts(meshes: list[Mesh], nodes: NodeTable) -> Mesh:
    """Union of the meshes, each cell once, without those that are faces of larger ones."""
    filled = [m for m in meshes if m.blocks]
    if not filled:
        return Mesh(nodes, ())
    whole = without_duplicates(union(*filled, as_given=True))
    by_size = {b.kind.n_nodes: b for b in whole.blocks}
    kept = []
    for size in sorted(by_size, reverse=True):
        block = by_size[size]
        alone = np.ones(len(block), dtype=bool)
        for larger, other in by_size.items():
            if larger > size:
                places = list(combinations(range(other.kind.n_nodes), size))
                table = other.connectivity[:, places].reshape(-1, size)
                faces = CellBlock.make(other.nodes, _SIMPLICES[size - 1], table)
                alone &= ~np.isin(cell_keys(block), cell_keys(faces))
        if alone.any():
            kept.append(block.some(alone))
    return Mesh(nodes, tuple(kept))
