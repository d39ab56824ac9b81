"""Meshes and points: blocks of cells over the table of nodes."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.cells import CELL_TYPES, CellType
from ssilang.kernel.mesh.nodes import NodeTable


@dataclass(frozen=True, eq=False)
class Point:
    """One node, seen from a script (POINT).

    A point is its node: coordinates and density are read from the table at each access.
    """

    nodes: NodeTable
    number: int

    @property
    def identity(self) -> int:
        """What tells points apart where they serve as indices: two points of one node are one."""
        return self.node if self.nodes.version else self.number

    @property
    def former(self) -> IntArray:
        """Numbers of all nodes that became one with its own; none before any did."""
        numbers = np.arange(len(self.nodes) if self.nodes.version else 0)
        return np.flatnonzero(self.nodes.resolve(numbers) == self.node)

    @property
    def node(self) -> int:
        """Node number (0-based) after merges."""
        return int(self.node_ids[0])

    @property
    def node_ids(self) -> IntArray:
        """The same as an array (1,)."""
        return self.nodes.resolve(np.asarray([self.number]))

    sorted_node_ids = node_ids

    @property
    def mesh(self) -> "Mesh":
        """A mesh of one POI1."""
        return Mesh.of(self.nodes, "POI1", self.node_ids)

    @property
    def coordinates(self) -> FloatArray:
        """Coordinates, shape (3,)."""
        return self.nodes.coordinates[self.node]

    @property
    def density(self) -> float:
        """Wanted mesh size around the point, 0 if none was set."""
        return float(self.nodes.density[self.node])


@dataclass(frozen=True, eq=False)
class CellBlock:
    """Cells of one type.

    Parameters
    ----------
    cell_type : str
        A key of `CELL_TYPES`.
    raw : array (n_cells, n_nodes)
        Node numbers as they were when the block was made; read `connectivity` instead.
    colours : array (n_cells,) of int8
        Index into Cast3M's colour list, 0 = DEFA(UT).
    """

    nodes: NodeTable
    cell_type: str
    raw: IntArray
    colours: NDArray[np.int8]
    _resolved: list[tuple[int, IntArray]] = field(default_factory=list, repr=False)

    @classmethod
    def make(
        cls,
        nodes: NodeTable,
        cell_type: str,
        connectivity: IntArray,
        colours: NDArray[np.int8] | int = 0,
    ) -> "CellBlock":
        """A block from connectivity (n, k) and one colour for all or one a cell."""
        kind = CELL_TYPES[cell_type]
        table = np.ascontiguousarray(connectivity, dtype=np.int64).reshape(-1, kind.n_nodes)
        shades = np.broadcast_to(np.asarray(colours, dtype=np.int8), (len(table),)).copy()
        return cls(nodes, cell_type, table, shades)

    def some(self, which: IntArray | BoolArray | slice) -> "CellBlock":
        """Some of the cells, in the order given."""
        table, colours = self.connectivity[which], self.colours[which]
        return CellBlock.make(self.nodes, self.cell_type, table, colours)

    @property
    def kind(self) -> CellType:
        """The cell type's data."""
        return CELL_TYPES[self.cell_type]

    @property
    def connectivity(self) -> IntArray:
        """Node numbers (n_cells, n_nodes) after merges."""
        version = self.nodes.version
        if not self._resolved or self._resolved[0][0] != version:
            self._resolved[:] = [(version, self.nodes.resolve(self.raw))]
        return self._resolved[0][1]

    def __len__(self) -> int:
        return len(self.raw)

    @property
    def coordinates(self) -> FloatArray:
        """Coordinates of the cells' nodes, shape (n_cells, n_nodes, 3)."""
        return self.nodes.coordinates[self.connectivity]

    def shown_middle(self, cell: int) -> FloatArray:
        """Middle of a cell as scripts see it."""
        return self.nodes.shown(self.coordinates[cell].mean(axis=0))


def same_cells(a: CellBlock, b: CellBlock) -> bool:
    """Whether two blocks hold the same cells in the same order."""
    return a is b or (
        a.cell_type == b.cell_type
        and a.raw.shape == b.raw.shape
        and np.array_equal(a.connectivity, b.connectivity)
    )


@dataclass(frozen=True, eq=False)
class Mesh:
    """Blocks of cells (MAILLAGE).

    Parameters
    ----------
    blocks : tuple of CellBlock
        An elementary mesh has one block; ET concatenates blocks of the same type.
    sides : tuple of Mesh
        References kept by generators, read with COTE: the lines that bound a surface, in the
        order in which they were given; the faces 1 (start), 2 (end), 3 (around) of a volume.
    """

    nodes: NodeTable
    blocks: tuple[CellBlock, ...]
    sides: "tuple[Mesh, ...]" = ()
    _order: list[tuple[int, IntArray]] = field(default_factory=list, init=False, repr=False)

    @classmethod
    def of(
        cls,
        nodes: NodeTable,
        cell_type: str,
        connectivity: IntArray,
        colours: NDArray[np.int8] | int = 0,
        sides: "tuple[Mesh, ...]" = (),
    ) -> "Mesh":
        """A mesh of one block."""
        return cls(nodes, (CellBlock.make(nodes, cell_type, connectivity, colours),), sides)

    @property
    def n_cells(self) -> int:
        """Number of cells of all blocks."""
        return sum(len(b) for b in self.blocks)

    @property
    def node_ids(self) -> IntArray:
        """Node numbers in order of first appearance, each once, shape (n,)."""
        version = self.nodes.version
        if self.blocks and (not self._order or self._order[0][0] != version):
            flat = np.concatenate([b.connectivity.ravel() for b in self.blocks])
            _, first = np.unique(flat, return_index=True)
            self._order[:] = [(version, flat[np.sort(first)])]
        return self._order[0][1] if self.blocks else np.empty(0, dtype=np.int64)

    @property
    def sorted_node_ids(self) -> IntArray:
        """Node numbers in increasing order, each once, shape (n,)."""
        if not self.blocks:
            return np.empty(0, dtype=np.int64)
        return np.unique(np.concatenate([b.connectivity.ravel() for b in self.blocks]))

    @property
    def dimension(self) -> int:
        """Largest dimension of the cells, 0 for points."""
        return max((b.kind.dimension for b in self.blocks), default=0)

    def blocks_of(self, dimension: int) -> tuple[CellBlock, ...]:
        """The blocks of cells of a dimension, joints left out."""
        return tuple(b for b in self.blocks if b.kind.dimension == dimension and not b.kind.joint)

    def single_block(self) -> CellBlock:
        """The one block of an elementary mesh.

        Raises
        ------
        MeshError
            If the mesh has none or several.
        """
        if len(self.blocks) != 1:
            kinds = [b.cell_type for b in self.blocks]
            raise MeshError("kernel.mesh.mesh-cell-type-needed", kinds=kinds)
        return self.blocks[0]
