"""Matrices of no element: values at nodes, diagonals, outer products, cables, filters."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError, MeshError
from ssilang.kernel.base.scientific import sp, spatial
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import Numbering
from ssilang.kernel.matrices.matrix import (
    PRIMAL_OF,
    ElementMatrices,
    Matrix,
    diagonal_matrices,
    dual_of,
)
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable


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
                "kernel.matrices.cell-names-rows-matrix", cell_type=block.cell_type, m=m,
                n_matrix=matrix.shape[0], n_matrix_2=matrix.shape[1], n_forces=len(forces),
            )  # fmt: skip
        local = np.repeat(np.arange(k), [len(node) for node in at_nodes])
        values = np.broadcast_to(matrix, (len(block), m, m)).copy()
        blocks.append(
            ElementMatrices(
                mesh.nodes, block.raw, local, names, forces, values, kind, None, symmetric
            )
        )
    return Matrix(mesh.nodes, tuple(blocks), (), kind)


_LARGEST = 20_000
"""Rows of a dense matrix that still fits a usual memory (3.2 GB)."""


def sum_of_outer_products(
    fields: Sequence[NodeField], factors: Sequence[float], kind: str
) -> Matrix:
    """The matrix `sum_i a_i v_i v_i^T`.

    Parameters
    ----------
    fields : sequence of n NodeField
        The vectors v_i; components named as duals (FX ...) stand for their unknowns.
    factors : sequence of n float
        The numbers a_i.
    kind : str
        'RIGIDITE', 'MASSE' or 'AMORTISSEMENT'.

    Raises
    ------
    FieldError
        If there are no vectors, not as many factors, or too many unknowns for a dense matrix.
    """
    if not fields or len(fields) != len(factors):
        raise FieldError(
            "kernel.matrices.vectors-factors", n_fields=len(fields), n_factors=len(factors)
        )
    table = fields[0].table
    parts = [
        (i, PRIMAL_OF.get(name, name), part)
        for i, field in enumerate(fields)
        for name, part in field.components.items()
    ]
    places = sorted({(name, int(node)) for _, name, part in parts for node in part.nodes})
    if len(places) > _LARGEST:
        raise FieldError("kernel.matrices.full-matrix-rows-too", n_places=len(places))
    rows = {place: i for i, place in enumerate(places)}
    vectors = np.zeros((len(fields), len(places)))
    for i, name, part in parts:
        vectors[i, [rows[name, int(node)] for node in part.nodes]] += part.values
    values = (vectors.T * np.asarray(factors, dtype=float)) @ vectors
    names, nodes = [n for n, _ in places], np.array([n for _, n in places], dtype=np.int64)
    duals = [dual_of(name) for name in names]
    block = ElementMatrices.of_one(table, nodes, names, duals, values, kind)
    return Matrix(table, (block,), (), kind)


def cable_stiffness(mesh: Mesh, dimension: int, force: float, percent: float) -> Matrix:
    """Stiffness of straight cables whose force is `force` at a lengthening of `percent`.

    Raises
    ------
    MeshError
        If a cell is not a segment of two nodes, or has no length.
    """
    if {b.cell_type for b in mesh.blocks} != {"SEG2"}:
        raise MeshError("kernel.matrices.cable-made-segments-two")
    rigidity = 100.0 * force / percent
    blocks = []
    for b in mesh.blocks:
        d = dimension
        along = (b.coordinates[:, 1] - b.coordinates[:, 0])[:, :d]
        length = np.linalg.norm(along, axis=1)
        if (length == 0.0).any():
            raise MeshError("kernel.matrices.segment-cable-no-length")
        row = np.concatenate([-along, along], axis=1) / length[:, None]
        values = (rigidity / length)[:, None, None] * row[:, :, None] * row[:, None, :]
        names = ("UX", "UY", "UZ")[:d] * 2
        duals = ("FX", "FY", "FZ")[:d] * 2
        local = np.repeat([0, 1], d)
        blocks.append(ElementMatrices(b.nodes, b.raw, local, names, duals, values, "RIGIDITE"))
    return Matrix(mesh.nodes, tuple(blocks), (), "RIGIDITE")


def lumped_matrix(matrix: Matrix, kept: tuple[str, ...] = ()) -> Matrix:
    """Sum of each row on the diagonal; unknowns in `kept` keep their diagonal term instead."""
    return replace(matrix, blocks=tuple(_lumped(b, kept) for b in matrix.blocks), cache={})


def _lumped(block: ElementMatrices, kept: tuple[str, ...]) -> ElementMatrices:
    rows = block.values.sum(axis=2)
    own = np.einsum("cii->ci", block.values)
    diagonal = np.where([u in kept for u in block.unknowns], own, rows)
    return replace(block, values=diagonal_matrices(diagonal))


def filter_weights(
    weights: NodeField, radius: float, power: float, least: float, unknown: str, dual: str
) -> Matrix:
    """Matrix whose product with a field is its weighted mean over the neighbours of each node.

    Row i has `(1 - d_ij / radius)^power w_j` over their sum, for nodes nearer than the radius;
    terms not above `least` are dropped (after the division).
    """
    names = list(weights.components)
    if len(names) != 1:
        raise FieldError("kernel.matrices.component-weights-needed", names=names)
    part = weights.components[names[0]]
    n = len(part.nodes)
    if radius > 0.0:
        points = weights.table.coordinates[part.nodes]
        tree = spatial.cKDTree(points)
        near = tree.sparse_distance_matrix(tree, radius, output_type="coo_matrix")
        other = near.row != near.col
        i = np.concatenate([near.row[other], np.arange(n)]).astype(np.int64)
        j = np.concatenate([near.col[other], np.arange(n)]).astype(np.int64)
        d = np.concatenate([near.data[other], np.zeros(n)])
        values = np.maximum(1.0 - d / radius, 0.0) ** power * part.values[j]
        shares = sp.coo_array((values, (i, j)), shape=(n, n)).tocsr()
    else:
        shares = sp.csr_array(sp.diags_array(part.values.copy()))
    total: FloatArray = np.asarray(shares.sum(axis=1)).ravel()
    if (total == 0.0).any():
        raise FieldError("kernel.matrices.weights-around-node-zero")
    W = sp.csr_array(sp.diags_array(1.0 / total) @ shares)
    W.data[W.data <= least] = 0.0
    codes = np.zeros(n, dtype=np.int64)
    numbering = Numbering(weights.table, (unknown,), (dual,), part.nodes, codes, 0)
    return matrix_from_sparse(W, numbering, "RIGIDITE", False)


# A sparse matrix over a numbering of unknowns as a sum of small element matrices.


def matrix_from_sparse(
    A: sp.csr_array, numbering: Numbering, kind: str = "RIGIDITE", symmetric: bool = True
) -> Matrix:
    """The matrix with these terms: one element of two nodes a term, of one on the diagonal.

    Parameters
    ----------
    A : csr array (n, n)
    symmetric : bool
        True: only the lower triangle is read.
    """
    terms = A.tocoo()
    i, j, v = terms.row.astype(np.int64), terms.col.astype(np.int64), terms.data
    kept = (v != 0.0) & ((i >= j) | (not symmetric))
    i, j, v = i[kept], j[kept], v[kept]
    blocks = []
    pairs = numbering.codes[i] * len(numbering.unknowns) + numbering.codes[j]
    for pair in np.unique(pairs):
        mine = pairs == pair
        names = divmod(int(pair), len(numbering.unknowns))
        for same in (True, False):
            chosen = mine & ((i == j) == same)
            if chosen.any():
                place = (i[chosen], j[chosen])
                blocks.append(_block(numbering, names, place, v[chosen], kind, symmetric))
    return Matrix(numbering.table, tuple(blocks), (), kind)


def _block(
    numbering: Numbering,
    names: tuple[int, int],
    place: tuple[IntArray, IntArray],
    values: FloatArray,
    kind: str,
    symmetric: bool,
) -> ElementMatrices:
    i, j = (numbering.nodes[p] for p in place)
    codes: tuple[int, ...] = names
    if np.array_equal(place[0], place[1]):
        codes = names[:1]
        nodes, matrices = i[:, None], values[:, None, None]
    else:
        nodes = np.column_stack([i, j])
        matrices = np.zeros((len(values), 2, 2))
        matrices[:, 0, 1] = values
        if symmetric:
            matrices[:, 1, 0] = values
    return ElementMatrices(
        numbering.table, nodes, np.arange(len(codes)), tuple(numbering.unknowns[c] for c in codes),
        tuple(numbering.duals[c] for c in codes), matrices, kind, None, symmetric,
    )  # fmt: skip
