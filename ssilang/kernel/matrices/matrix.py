"""Matrices by element blocks, with constraints kept apart (RIGIDITE)."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.mesh.nodes import NodeTable


@dataclass(frozen=True, eq=False)
class ElementMatrices:
    """Matrices of the elements of one block.

    Row i of an element matrix is the unknown `unknowns[i]` at the element's node `local[i]`.

    Parameters
    ----------
    raw_nodes : array (n, k)
        Node numbers of the elements (as made; resolved when assembled).
    local : array (m,) of int
        Local node of each row.
    unknowns, duals : tuple of str, length m
        Primal names ('UX', 'RZ') and dual names ('FX', 'MZ') of the rows.
    values : array (n, m, m)
    kind : str
        'RIGIDITE', 'MASSE', 'AMORTISSEMENT' ...
    zone : Zone or None
        Model zone it was made from (None: made by hand); lets a law that replaces the linear
        stiffness of its zone take these blocks out.
    viscous : bool
        Whether its material has a viscosity, which a matrix of damping is made of.
    dense : bool
        Whether its material has a density, which a mass is made of.
    part : tuple of two tuples of str, or None
        Of a part of a matrix: the unknowns and equations that it has, its other columns and rows
        being zero.
    """

    table: NodeTable
    raw_nodes: IntArray
    local: NDArray[np.int64]
    unknowns: tuple[str, ...]
    duals: tuple[str, ...]
    values: FloatArray
    kind: str = "RIGIDITE"
    zone: Zone | None = None
    symmetric: bool = True
    viscous: bool = False
    dense: bool = False
    part: tuple[tuple[str, ...], tuple[str, ...]] | None = None

    @classmethod
    def of_one(
        cls, table: NodeTable, nodes: IntArray, unknowns: Sequence[str], duals: Sequence[str],
        values: FloatArray, kind: str, symmetric: bool = True,
    ) -> "ElementMatrices":  # fmt: skip
        """One element: values (m, m) of the unknowns (m,) at nodes (m,).

        Nodes that differ stay in their order, which is that of the shapes that they mark.
        """
        ids, local = np.unique(nodes, return_inverse=True)
        if len(ids) == len(nodes):
            ids, local = nodes, np.arange(len(nodes))
        rows = (local.astype(np.int64), tuple(unknowns), tuple(duals))
        return cls(table, ids[None, :], *rows, values[None], kind, None, symmetric)

    def some(self, which: BoolArray) -> "ElementMatrices":
        """Of some of the elements (n,) alone."""
        return replace(self, raw_nodes=self.raw_nodes[which], values=self.values[which])

    @property
    def nodes(self) -> IntArray:
        """Node numbers (n, k) after merges."""
        return self.table.resolve(self.raw_nodes)


@dataclass(frozen=True, eq=False)
class Relations:
    """Linear conditions `sum_j coefficient_j u_j = d` (or >= d, <= d), one a row (BLOQ, RELA).

    Each row owns a node of its own, its multiplier: the imposed value d is given there as the
    component FLX of a nodal field (DEPI) and the multiplier is found there as LX in a solution.
    Sign: K u + C^T LX = F, so -C^T LX is the force that the support applies (REAC).

    Parameters
    ----------
    row_start : array (n_rows + 1,)
        Terms of row i are row_start[i]:row_start[i + 1].
    raw_nodes : array (n_terms,); unknowns : tuple of str, length n_terms
    coefficients : array (n_terms,)
    raw_multipliers : array (n_rows,)
        Multiplier nodes.
    sense : array (n_rows,) of int8
        0 equality; +1 the left side stays >= d (MINI); -1 it stays <= d (MAXI).
    dual : Relations or None
        Non-associated relations (RELA ... 'DUAL'): K u + D^T LX = F with these rows D instead
        of C; same number of rows, same multipliers.
    """

    table: NodeTable
    row_start: IntArray
    raw_nodes: IntArray
    unknowns: tuple[str, ...]
    coefficients: FloatArray
    raw_multipliers: IntArray
    sense: NDArray[np.int8]
    dual: "Relations | None" = None

    @property
    def nodes(self) -> IntArray:
        """Nodes of the terms, after merges."""
        return self.table.resolve(self.raw_nodes)

    @property
    def multipliers(self) -> IntArray:
        """Multiplier nodes, after merges."""
        return self.table.resolve(self.raw_multipliers)

    def __len__(self) -> int:
        return len(self.raw_multipliers)


@dataclass(frozen=True, eq=False)
class Matrix:
    """A sum of element blocks and a set of relations (RIGIDITE).

    Immutable; `cache` keeps what solvers derive from it (unknown numbering, assembled CSR,
    factors), keyed by their own names.
    """

    table: NodeTable
    blocks: tuple[ElementMatrices, ...] = ()
    relations: tuple[Relations, ...] = ()
    kind: str = "RIGIDITE"

    cache: dict[str, object] = field(default_factory=dict, repr=False)

    @property
    def inertial(self) -> bool:
        """Whether its terms are masses.

        A geometric stiffness made for VIBR is of the kind 'MASSE' too, its blocks are not.
        """
        blocks = any(b.kind.startswith("MASS") for b in self.blocks)
        return blocks and self.kind.startswith("MASS")

    def scaled(self, factor: float) -> "Matrix":
        """The matrix times a number; relations are not scaled (they are conditions)."""
        blocks = tuple(replace(b, values=factor * b.values) for b in self.blocks)
        return Matrix(self.table, blocks, self.relations, self.kind)


def imaginary(name: str) -> str:
    """Name of the imaginary part of an unknown or force: 'IUX', 'IFX', 'IFAL'."""
    return ("I" + name)[:4]


PRIMAL_TO_DUAL: dict[str, str] = {
    "UX": "FX", "UY": "FY", "UZ": "FZ", "RX": "MX", "RY": "MY", "RZ": "MZ",
    "UR": "FR", "UT": "FT", "RT": "MT", "LX": "FLX", "T": "Q", "P": "FP", "ALFA": "FALF",
    "BETA": "FBET",
}  # fmt: skip
"""Dual of each unknown, as Cast3M names them; others: 'F' + name cut at 4 characters."""

PRIMAL_OF = {dual: unknown for unknown, dual in PRIMAL_TO_DUAL.items()}
"""Unknown of each usual dual."""

PRIMAL_TO_DUAL |= {imaginary(u): imaginary(d) for u, d in PRIMAL_TO_DUAL.items()}


def dual_of(unknown: str) -> str:
    """Name of the dual (force) of an unknown."""
    return PRIMAL_TO_DUAL.get(unknown, ("F" + unknown)[:4])


def diagonal_matrices(rows: FloatArray) -> FloatArray:
    """Matrices (n, m, m) that have those rows (n, m) on their diagonals."""
    n, m = rows.shape
    values = np.zeros((n, m, m))
    values[:, np.arange(m), np.arange(m)] = rows
    return values
