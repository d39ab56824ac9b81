"""Matrices condensed on relations, by their multipliers or by the unknowns left free."""

from dataclasses import replace

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.build import matrix_from_sparse
from ssilang.kernel.matrices.matrix import Matrix, Relations
from ssilang.kernel.matrices.submatrices import together

DEPENDENCE = "DEPENDAN"
"""Kind of the matrices that give all unknowns by those that relations leave free."""


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
    numbering = assembly.numbering_of(relations)
    rows = assembly.constraint_matrix(relations, numbering)
    if not rows.C.shape[0]:
        raise FieldError("kernel.matrices.matrix-no-relation")
    given = [assembly.field_to_vector(inverse_mass, numbering, dual) for dual in (False, True)]
    weights = np.where(given[0] != 0.0, given[0], given[1])
    used = np.unique(rows.C.indices)
    if (weights[used] == 0.0).any():
        bad = int(used[weights[used] == 0.0][0])
        raise FieldError("kernel.matrices.diagonal-field-no-value", label=numbering.label(bad))
    S = sp.csr_array(rows.C @ sp.diags_array(weights) @ rows.D.T)
    order = np.argsort(rows.multipliers, kind="stable")
    S = sp.csr_array(S[order][:, order])
    codes = np.zeros(len(order), dtype=np.int64)
    marks = replace(
        numbering, unknowns=("LX",), duals=("FLX",), nodes=rows.multipliers[order], codes=codes
    )
    return matrix_from_sparse(S, marks, "RIGIDITE", rows.associated)


def condensed_by_relations(matrix: Matrix, relations: Matrix) -> Matrix:
    """`T^T K T`: the matrix without the unknowns that relations give by the others.

    Its own conditions C stay, as C T, with their multipliers.

    Parameters
    ----------
    relations : Matrix
        Relations, or the first matrix of `dependence`.

    Raises
    ------
    FieldError
        Without relations, or if they cannot be eliminated.
    """
    if not relations.relations and relations.kind != DEPENDENCE:
        swapped = bool(matrix.relations) and not matrix.blocks
        raise FieldError("kernel.matrices.condensed-without-relations", swapped=swapped)
    body = Matrix(matrix.table, matrix.blocks, matrix.relations, matrix.kind)
    rows_only = Matrix(relations.table, (), relations.relations, relations.kind)
    given = relations.kind == DEPENDENCE
    numbering = assembly.numbering_of(body if given else together(body, rows_only))
    K = assembly.assemble(body, numbering)
    T, kept = _given(relations, numbering) if given else _eliminated(rows_only, numbering)
    A = sp.csr_array(T.T @ K @ T)
    masters = numbering.some(kept)
    made = matrix_from_sparse(A, masters, matrix.kind, assembly.is_symmetric(matrix))
    return replace(made, relations=_carried(body, numbering, T, masters), cache={})


def _carried(
    matrix: Matrix, numbering: assembly.Numbering, T: sp.csr_array, masters: assembly.Numbering
) -> tuple[Relations, ...]:
    """The conditions of a matrix on the unknowns that stay."""
    rows = assembly.constraint_matrix(matrix, numbering)
    C, D = (sp.csr_array(part @ T) for part in (rows.C, rows.D))

    def relations(part: sp.csr_array, dual: Relations | None) -> Relations:
        names = tuple(masters.unknowns[k] for k in masters.codes[part.indices])
        return Relations(
            matrix.table, part.indptr.astype(np.int64), masters.nodes[part.indices], names,
            part.data, rows.multipliers, rows.sense, dual,
        )  # fmt: skip

    if not len(rows.multipliers):
        return ()
    return (relations(C, None if rows.associated else relations(D, None)),)


def _eliminated(relations: Matrix, numbering: assembly.Numbering) -> tuple[sp.csr_array, IntArray]:
    """T (n, r) and the r unknowns that stay."""
    from ssilang.kernel.solvers.cholesky.elimination import eliminate

    rows = assembly.constraint_matrix(relations, numbering)
    if not rows.C.shape[0]:
        raise FieldError("kernel.matrices.matrix-no-relation")
    found = eliminate(rows.C)
    if not found.eliminated.all():
        raise FieldError("kernel.matrices.some-relations-cannot-eliminated")
    return found.T, found.masters


def _given(matrix: Matrix, numbering: assembly.Numbering) -> tuple[sp.csr_array, IntArray]:
    """The same from the matrix of `dependence`; unknowns that it does not know stay."""
    parts = []
    known = np.zeros(numbering.size, dtype=bool)
    for block in matrix.blocks:
        nodes = block.nodes
        place = [
            numbering.index(nodes[:, k], numbering.code(name))
            for k, name in zip(block.local, block.unknowns, strict=True)
        ]
        for i, j in np.ndindex(len(place), len(place)):
            values, there = block.values[:, i, j], (place[i] >= 0) & (place[j] >= 0)
            known[place[i][there]] = known[place[j][there]] = True
            kept = there & (values != 0.0)
            parts.append((values[kept], place[i][kept], place[j][kept]))
    free = np.flatnonzero(~known)
    parts.append((np.ones(len(free)), free, free))
    v, i, j = (np.concatenate(p) for p in zip(*parts, strict=True))
    T = sp.csr_array((v, (i, j)), shape=(numbering.size, numbering.size))
    masters = np.flatnonzero(np.diff(T.tocsc().indptr))
    return sp.csr_array(T[:, masters]), masters


def dependence(matrix: Matrix) -> tuple[Matrix, Matrix]:
    """Matrices of `u = T v` and of `g = T^T f`, on all unknowns of a matrix with relations.

    The first takes and gives unknowns (UX to UX), the second forces (FX to FX). Rows and columns
    of the unknowns that stay are those of the identity.

    Raises
    ------
    FieldError
        Without relations, or if they cannot be eliminated.
    """
    numbering = assembly.numbering_of(matrix)
    found, masters = _eliminated(matrix, numbering)
    m = len(masters)
    ones = sp.csr_array((np.ones(m), (np.arange(m), masters)), shape=(m, numbering.size))
    T = sp.csr_array(found @ ones)
    made = []
    for A, names in ((T, numbering.unknowns), (sp.csr_array(T.T), numbering.duals)):
        marks = replace(numbering, unknowns=names, duals=names)
        made.append(matrix_from_sparse(A, marks, DEPENDENCE, False))
    return made[0], made[1]
