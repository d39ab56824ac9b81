"""Matrices condensed on relations, by their multipliers or by the unknowns left free."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.sparse import sp
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
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.submatrices import together


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
    from ssilang.kernel.solvers.cholesky.elimination import eliminate

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
