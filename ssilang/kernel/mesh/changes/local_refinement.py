"""Cells divided where wanted; nodes left hanging on coarser neighbours are tied by SURE cells.

Each division halves the edges of a cell (two, four or eight cells of the same kind). Neighbours
differ by one division at most, so that a node hangs in the middle of an edge or of a face.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.cells import CELL_TYPES, many_noded
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable

TIE = "SURE"
"""Cells of this family hold a hanging node, then the nodes that it follows."""

_MOST_CELLS = 2_000_000
_EDGE_BITS = 31


@dataclass(frozen=True)
class _Division:
    """How a cell is divided; local numbers: corners, middles of edges, of faces, of the cell.

    Attributes
    ----------
    edges : array (n_edges, 2)
    faces : array (n_faces, 4)
        Faces of four sides, which get a node.
    inner : array (n, 2)
        Pairs of edges whose middles a division of a triangular face joins.
    centre : bool
        True if the cell itself gets a node.
    children : array (n_children, n_corners)
    """

    edges: IntArray
    faces: IntArray
    inner: IntArray
    centre: bool
    children: IntArray


# --- how each kind of cell is divided --------------------------------------------------------

_TRIANGLE = [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)]
# corners, then the inner octahedron cut along 02-13 (Bey 1995), oriented as the cell
_TETRAHEDRON = [
    (0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3),
    (4, 6, 7, 8), (4, 5, 6, 8), (6, 8, 9, 7), (6, 5, 9, 8),
]  # fmt: skip
_PLANE = {
    "SEG2": ([(0, 1)], [(0, 2), (2, 1)]),
    "TRI3": ([(0, 1), (1, 2), (2, 0)], _TRIANGLE),
    "TET4": ([(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)], _TETRAHEDRON),
}
_REFERENCE = {
    "QUA4": [(0, 0), (2, 0), (2, 2), (0, 2)],
    "CUB8": [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0),
             (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)],
}  # fmt: skip


@cache
def _division(cell_type: str) -> _Division:
    if cell_type in _PLANE:
        edges, children = _PLANE[cell_type]
        inner = _triangle_pairs(cell_type, np.array(edges))
        return _Division(np.array(edges), np.empty((0, 4), int), inner, False, np.array(children))
    if cell_type == "PRI6":
        return _prism()
    if cell_type in _REFERENCE:
        return _brick(cell_type)
    raise MeshError(
        "kernel.mesh.cells-not-divided", cell_type=cell_type, value=(*_PLANE, *_REFERENCE, "PRI6")
    )


def _faces(cell_type: str, sides: int) -> list[tuple[int, ...]]:
    kind = CELL_TYPES[cell_type]
    if kind.dimension == 2:
        return [kind.corners] if len(kind.corners) == sides else []
    return [corners for _, corners in kind.faces if len(corners) == sides]


def _triangle_pairs(cell_type: str, edges: IntArray) -> IntArray:
    """Pairs of edges that follow each other on the triangular faces of a volume."""
    if CELL_TYPES[cell_type].dimension < 3:
        return np.empty((0, 2), int)
    number = {frozenset(e): i for i, e in enumerate(edges.tolist())}
    pairs = []
    for a, b, c in _faces(cell_type, 3):
        k = [number[frozenset(e)] for e in ((a, b), (b, c), (c, a))]
        pairs += [(k[0], k[1]), (k[1], k[2]), (k[2], k[0])]
    return np.array(pairs)


def _edge_table(cell_type: str) -> IntArray:
    faces = _faces(cell_type, 3) + _faces(cell_type, 4)
    pairs = [(f[i], f[(i + 1) % len(f)]) for f in faces for i in range(len(f))]
    return np.array(list(dict.fromkeys(tuple(sorted(p)) for p in pairs)))


def _brick(cell_type: str) -> _Division:
    corners = np.array(_REFERENCE[cell_type])
    dim = corners.shape[1]
    edges, faces = _edge_table(cell_type), np.array(_faces(cell_type, 4))
    places = [*corners, *corners[edges].mean(axis=1), *corners[faces].mean(axis=1)]
    if dim == 3:
        places.append(np.ones(3))
    number = {tuple(int(v) for v in p): i for i, p in enumerate(places)}
    children = [
        [number[tuple(int(v) for v in corner // 2 + np.array(shift))] for corner in corners]
        for shift in product((0, 1), repeat=dim)
    ]
    return _Division(edges, faces, np.empty((0, 2), int), dim == 3, np.array(children))


def _prism() -> _Division:
    edges = np.array([(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)])
    faces = np.array([(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)])
    layers = [(0, 1, 2, 6, 7, 8), (12, 13, 14, 15, 16, 17), (3, 4, 5, 9, 10, 11)]
    children = [
        [low[i] for i in corners] + [high[i] for i in corners]
        for low, high in pairwise(layers)
        for corners in _TRIANGLE
    ]
    return _Division(edges, faces, _triangle_pairs("PRI6", edges), False, np.array(children))


# --- nodes in the middle of edges and faces --------------------------------------------------


@dataclass
class _Middles:
    """Nodes made in the middle of edges, or of faces known by a diagonal: sorted keys, nodes."""

    keys: IntArray = field(default_factory=lambda: np.empty(0, np.int64))
    nodes: IntArray = field(default_factory=lambda: np.empty(0, np.int64))

    def at(self, keys: IntArray) -> IntArray:
        """Nodes of keys, -1 where there is none."""
        if not len(self.keys):
            return np.full(keys.shape, -1)
        place = np.minimum(np.searchsorted(self.keys, keys), len(self.keys) - 1)
        return np.where(self.keys[place] == keys, self.nodes[place], -1)

    def put(self, keys: IntArray, nodes: IntArray) -> None:
        """Add keys that are not there yet."""
        every, numbers = np.append(self.keys, keys), np.append(self.nodes, nodes)
        order = np.argsort(every)
        self.keys, self.nodes = every[order], numbers[order]


def _edge_keys(pairs: IntArray) -> IntArray:
    return (pairs.min(axis=-1) << _EDGE_BITS) | pairs.max(axis=-1)


def _face_keys(faces: IntArray) -> IntArray:
    """The diagonal through the smallest node."""
    first = faces.argmin(axis=-1)[..., None]
    ends = [np.take_along_axis(faces, (first + k) % 4, axis=-1) for k in (0, 2)]
    return _edge_keys(np.concatenate(ends, axis=-1))


_TIED = {3: ("edges", _edge_keys), 5: ("faces", _face_keys)}


@dataclass
class _State:
    """The mesh while it is divided: places and wanted sizes grow with the nodes."""

    nodes: NodeTable
    sizes: FloatArray
    edges: _Middles = field(default_factory=_Middles)
    faces: _Middles = field(default_factory=_Middles)

    def middles(self, known: _Middles, keys: IntArray, groups: IntArray) -> IntArray:
        """Nodes in the middle of groups (..., k) of nodes; those that lack are made."""
        found = known.at(keys)
        missing = found < 0
        if missing.any():
            new, first = np.unique(keys[missing], return_index=True)
            known.put(new, self.add(groups[missing][first]))
            found = known.at(keys)
        return found

    def add(self, groups: IntArray) -> IntArray:
        """New nodes in the middle of groups (n, k)."""
        made = self.nodes.add(self.nodes.coordinates[groups].mean(axis=1))
        self.sizes = np.append(self.sizes, self.sizes[groups].mean(axis=1))
        return made


# --- the division ----------------------------------------------------------------------------


def divided_to_sizes(mesh: Mesh, sizes: FloatArray, ties: Iterable[CellBlock] = ()) -> Mesh:
    """Divide cells until no edge is longer than the size wanted in its cell.

    Parameters
    ----------
    mesh : Mesh
        Of SEG2, TRI3, QUA4, TET4, CUB8, PRI6 and POI1.
    ties : CellBlocks
        Of an earlier division: nodes that stand in the middle of edges and faces.
    sizes : array (n,)
        Size wanted at each node of `mesh.node_ids`, positive. New nodes take the mean of those
        between which they lie; a cell wants the mean of its corners.

    Returns
    -------
    Mesh
        The cells, then ties: SURE3 (hanging node, ends of the edge) and SURE5 (hanging node,
        corners of the face).

    Raises
    ------
    MeshError
        For cells of other kinds, sizes that are not positive or too many cells.
    """
    if not (sizes > 0.0).all():
        raise MeshError("kernel.mesh.sizes-wanted-positive", sizes_min=sizes.min())
    wanted = np.full(len(mesh.nodes), np.inf)
    wanted[mesh.node_ids] = sizes
    state = _State(mesh.nodes, wanted)
    for nodes in (block.connectivity for block in ties):
        known, key = _TIED[nodes.shape[1]]
        getattr(state, known).put(key(nodes[:, 1:]), nodes[:, 0])
    still = [c for c in mesh.blocks if c.cell_type == "POI1"]
    active = [c for c in mesh.blocks if c.cell_type != "POI1"]
    top = max((c.kind.dimension for c in active), default=0)
    while True:
        _check_number(state, active)  # again and again: smaller sizes may come in between
        marks = [(_excess(state, c) > 1.0) | _torn(state, c, top) for c in active]
        if not any(m.any() for m in marks):
            break
        active = [_divided(state, c, m) for c, m in zip(active, marks, strict=True)]
    return Mesh(mesh.nodes, (*active, *still, *_ties(state, active)))


def _excess(state: _State, cells: CellBlock) -> FloatArray:
    """Longest edge of each cell over the size wanted there."""
    edges = cells.connectivity[:, _division(cells.cell_type).edges]
    ends = state.nodes.coordinates[edges]
    longest = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2).max(axis=1, initial=0.0)
    wanted = state.sizes[cells.connectivity].mean(axis=1) * (1.0 + 1e-9)
    return longest / wanted


def _check_number(state: _State, active: list[CellBlock]) -> None:
    total = 0.0
    for cells in active:
        growth = len(_division(cells.cell_type).children)
        times = np.ceil(np.log2(np.maximum(_excess(state, cells), 1.0)))
        total += float((growth**times).sum())
    if total > _MOST_CELLS:
        raise MeshError("kernel.mesh.about-cells-needed", total=total)


def _torn(state: _State, cells: CellBlock, top: int) -> NDArray[np.bool_]:
    """Cells with a neighbour two divisions finer, and sides of volumes that are divided."""
    plan = _division(cells.cell_type)
    edges = cells.connectivity[:, plan.edges]
    middles = state.edges.at(_edge_keys(edges))
    marks = np.zeros(len(cells), dtype=bool)
    for end in (0, 1):
        half = np.stack([edges[..., end], middles], axis=-1)
        marks |= _halved(state, half)
    if len(plan.inner):
        marks |= _halved(state, middles[:, plan.inner])
    if cells.kind.dimension < top:
        if len(plan.faces):
            middles = state.faces.at(_face_keys(cells.connectivity[:, plan.faces]))
        marks |= middles.min(axis=1) >= 0
    return marks


def _halved(state: _State, pairs: IntArray) -> NDArray[np.bool_]:
    """Cells of which one of the pairs (n, m, 2) of existing nodes has a node between them."""
    there = np.asarray(pairs.min(axis=-1) >= 0)
    keys = np.where(there, _edge_keys(np.maximum(pairs, 0)), -1)
    return np.asarray(((state.edges.at(keys) >= 0) & there).any(axis=1))


def _divided(state: _State, cells: CellBlock, marks: NDArray[np.bool_]) -> CellBlock:
    parents = cells.connectivity[marks]
    if not len(parents):
        return cells
    plan = _division(cells.cell_type)
    edges, faces = parents[:, plan.edges], parents[:, plan.faces]
    columns = [parents, state.middles(state.edges, _edge_keys(edges), edges)]
    if len(plan.faces):
        columns.append(state.middles(state.faces, _face_keys(faces), faces))
    if plan.centre:
        columns.append(state.add(parents)[:, None])
    children = np.concatenate(columns, axis=1)[:, plan.children]
    table = np.concatenate([cells.connectivity[~marks], children.reshape(-1, parents.shape[1])])
    divided = np.repeat(cells.colours[marks], len(plan.children))
    colours = np.concatenate([cells.colours[~marks], divided])
    return CellBlock.make(state.nodes, cells.cell_type, table, colours)


# --- ties ------------------------------------------------------------------------------------


def _ties(state: _State, active: list[CellBlock]) -> Iterator[CellBlock]:
    """Nodes in the middle of an edge or a face of a cell that is not divided."""
    for size, (place, keys_of) in _TIED.items():
        known = getattr(state, place)
        rows = [np.empty((0, size), dtype=np.int64)]
        for cells in active:
            groups = cells.connectivity[:, getattr(_division(cells.cell_type), place)]
            if not groups.shape[1]:
                continue
            middles = known.at(keys_of(groups))
            hanging = middles >= 0
            rows.append(np.column_stack([middles[hanging], groups[hanging]]))
        every = np.concatenate(rows)
        _, first = np.unique(every[:, 0], return_index=True)
        if len(first):
            yield CellBlock.make(state.nodes, many_noded(TIE, size), every[first])


def is_tie(cell_type: str) -> bool:
    """True for the cells that tie hanging nodes."""
    return cell_type.startswith(TIE)


def parted(mesh: Mesh) -> tuple[Mesh, tuple[CellBlock, ...]]:
    """The mesh without its ties, and the ties."""
    ties = tuple(b for b in mesh.blocks if is_tie(b.cell_type))
    if not ties:
        return mesh, ()
    kept = tuple(b for b in mesh.blocks if not is_tie(b.cell_type))
    return Mesh(mesh.nodes, kept, mesh.sides), ties
