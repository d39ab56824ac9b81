"""Matrices made from others or from fields: condensation on relations, filters, cables."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.errors import FieldError, MeshError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import (
    Numbering,
    assemble,
    constraint_matrix,
    field_to_vector,
    is_symmetric,
    numbering_of,
)
from ssilang.kernel.matrices.from_sparse import matrix_from_sparse
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.matrices.parts import together
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.sparse import sp


def condensed_on_multipliers(relations: Matrix, inverse_mass: NodeField) -> Matrix:
    """`C M^-1 C^T` on the multipliers (LX at their nodes) of relations C.

    Parameters
    ----------
    inverse_mass : NodeField
        Diagonal of M^-1, by the primal or the dual names of the unknowns.

    Raises
    ------
    FieldError
        Without relations, or if a term of a relation has no value.
    """
    numbering = numbering_of(relations)
    rows = constraint_matrix(relations, numbering)
    if not rows.C.shape[0]:
        raise FieldError("kernel.matrices.matrix-no-relation")
    given = [field_to_vector(inverse_mass, numbering, dual) for dual in (False, True)]
    weights = np.where(given[0] != 0.0, given[0], given[1])
    used = np.unique(rows.C.indices)
    if (weights[used] == 0.0).any():
        bad = int(used[weights[used] == 0.0][0])
        raise FieldError("kernel.matrices.diagonal-field-no-value", label=numbering.label(bad))
    S = sp.csr_array(rows.C @ sp.diags_array(weights) @ rows.D.T)
    order = np.argsort(rows.multipliers, kind="stable")
    S = sp.csr_array(S[order][:, order])
    marks = Numbering(
        numbering.table,
        ("LX",),
        ("FLX",),
        rows.multipliers[order],
        np.zeros(len(order), dtype=np.int64),
        numbering.version,
    )
    return matrix_from_sparse(S, marks, "RIGIDITE", rows.associated)


def condensed_by_relations(matrix: Matrix, relations: Matrix) -> Matrix:
    """`T^T K T`: the matrix without the unknowns that relations give by the others.

    Raises
    ------
    FieldError
        If the relations cannot be eliminated.
    """
    from ssilang.kernel.solvers.elimination import eliminate

    rows_only = Matrix(relations.table, (), relations.relations, relations.kind)
    whole = together(Matrix(matrix.table, matrix.blocks, (), matrix.kind), rows_only)
    numbering = numbering_of(whole)
    K = assemble(Matrix(matrix.table, matrix.blocks, (), matrix.kind), numbering)
    rows = constraint_matrix(rows_only, numbering)
    found = eliminate(rows.C)
    if not found.eliminated.all():
        raise FieldError("kernel.matrices.some-relations-cannot-eliminated")
    A = sp.csr_array(found.T.T @ K @ found.T)
    kept = found.masters
    masters = Numbering(
        numbering.table,
        numbering.unknowns,
        numbering.duals,
        numbering.nodes[kept],
        numbering.codes[kept],
        numbering.version,
    )
    return matrix_from_sparse(A, masters, matrix.kind, is_symmetric(matrix))


def filter_weights(
    weights: NodeField, radius: float, power: float, least: float, unknown: str, dual: str
) -> Matrix:
    """Matrix whose product with a field is its weighted mean over the neighbours of each node.

    Row i has `(1 - d_ij / radius)^power w_j` over their sum, for nodes nearer than the radius;
    terms not above `least` are dropped (after the division).
    """
    from scipy.spatial import cKDTree

    names = list(weights.components)
    if len(names) != 1:
        raise FieldError("kernel.matrices.component-weights-needed", names=names)
    part = weights.components[names[0]]
    n = len(part.nodes)
    if radius > 0.0:
        points = weights.table.coordinates[part.nodes]
        tree = cKDTree(points)
        near = tree.sparse_distance_matrix(tree, radius, output_type="coo_matrix")
        i = np.concatenate([near.row, np.arange(n)]).astype(np.int64)
        j = np.concatenate([near.col, np.arange(n)]).astype(np.int64)
        d = np.concatenate([near.data, np.zeros(n)])
        own = (near.row == near.col).nonzero()[0]
        kept = np.ones(len(i), bool)
        kept[own] = False
        i, j, d = i[kept], j[kept], d[kept]
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
