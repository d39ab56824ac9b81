"""Matrices made by hand: values at nodes, diagonals, the same small matrix on every cell."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, dual_of
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

PRIMAL_OF = {
    "FX": "UX", "FY": "UY", "FZ": "UZ", "MX": "RX", "MY": "RY", "MZ": "RZ", "FR": "UR",
    "FT": "UT", "MT": "RT", "FLX": "LX", "Q": "T", "FP": "P", "FALF": "ALFA", "FBET": "BETA",
}  # fmt: skip
"""Unknown of each usual dual."""


def nodal_diagonal(
    table: NodeTable, nodes: IntArray, values: dict[str, FloatArray], kind: str
) -> Matrix:
    """Values on the diagonal at nodes.

    Parameters
    ----------
    nodes : array (n,)
    values : mapping of unknown to array (n,)
    kind : str
        'RIGIDITE', 'MASSE' or 'AMORTISSEMENT'.
    """
    names = tuple(values)
    diagonal = np.stack(list(values.values()), axis=1)
    matrices = diagonal[:, :, None] * np.eye(len(names))
    local = np.zeros(len(names), dtype=np.int64)
    duals = tuple(dual_of(n) for n in names)
    block = ElementMatrices(table, nodes[:, None], local, names, duals, matrices, kind)
    return Matrix(table, (block,), (), kind)


def field_diagonal(field: NodeField, kind: str) -> Matrix:
    """Matrix whose diagonal is a nodal field; components named as duals stand for their unknown."""
    blocks: list[ElementMatrices] = []
    for name, part in field.components.items():
        unknown = PRIMAL_OF.get(name, name)
        made = nodal_diagonal(field.table, part.nodes, {unknown: part.values}, kind)
        blocks += made.blocks
    return Matrix(field.table, tuple(blocks), (), kind)


def repeated_matrix(
    mesh: Mesh,
    unknowns: list[tuple[str, ...]],
    duals: list[tuple[str, ...]] | None,
    matrix: FloatArray,
    kind: str,
    symmetric: bool,
) -> Matrix:
    """The same matrix on every cell of a mesh.

    Parameters
    ----------
    unknowns : list of tuples
        Names at each node of a cell (one tuple serves all nodes).
    matrix : array (m, m)
        Rows node by node.

    Raises
    ------
    FieldError
        If the size does not fit the names.
    """
    blocks = []
    for block in mesh.blocks:
        k = CELL_TYPES[block.cell_type].n_nodes
        at_nodes = unknowns * k if len(unknowns) == 1 else unknowns
        if len(at_nodes) != k:
            raise FieldError(
                "kernel.matrices.lists-names-cells-nodes", n_at_nodes=len(at_nodes), k=k
            )
        names = tuple(n for node in at_nodes for n in node)
        forces = tuple(dual_of(n) for n in names)
        if duals is not None:
            of_nodes = duals * k if len(duals) == 1 else duals
            forces = tuple(n for node in of_nodes for n in node)
        m = len(names)
        if matrix.shape != (m, m) or len(forces) != m:
            raise FieldError(
                "kernel.matrices.cell-names-rows-matrix",
                cell_type=block.cell_type,
                m=m,
                n_matrix=matrix.shape[0],
                n_matrix_2=matrix.shape[1],
                n_forces=len(forces),
            )
        local = np.repeat(np.arange(k), [len(node) for node in at_nodes])
        values = np.broadcast_to(matrix, (len(block), m, m)).copy()
        blocks.append(
            ElementMatrices(
                mesh.nodes, block.raw, local, names, forces, values, kind, None, symmetric
            )
        )
    return Matrix(mesh.nodes, tuple(blocks), (), kind)
