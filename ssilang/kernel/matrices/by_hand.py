"""Matrices written term by term: triangles of numbers, columns and rows given by fields."""

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.matrix import PRIMAL_OF, ElementMatrices, Matrix, dual_of
from ssilang.kernel.mesh.nodes import NodeTable


def square(rows: Sequence[FloatArray], size: int, sign: float | None) -> FloatArray:
    """A matrix (size, size) from its terms.

    Parameters
    ----------
    rows : sequence of arrays
        One array of all terms or of the lower triangle, row by row; or `size` arrays, each a
        row or the part of it up to the diagonal.
    sign : float or None
        1 symmetric, -1 antisymmetric, None any matrix (the triangle is then not enough).

    Raises
    ------
    FieldError
        If the number of terms fits neither.
    """
    terms = np.concatenate(rows)
    lengths = [len(r) for r in rows]
    whole = len(rows) == 1 or lengths == [size] * size
    if len(terms) == size * size and whole:
        return terms.reshape(size, size)
    triangle = len(rows) == 1 or lengths == list(range(1, size + 1))
    if sign is None or not triangle or len(terms) != size * (size + 1) // 2:
        wanted = [size * size] if sign is None else [size * size, size * (size + 1) // 2]
        raise FieldError(
            "kernel.matrices.matrix-rows-wants-terms", size=size, wanted=wanted, n_terms=len(terms)
        )
    made = np.zeros((size, size))
    made[np.tril_indices(size)] = terms
    return made + sign * np.tril(made, -1).T


def column(
    values: NodeField,
    node: int,
    unknown: str,
    dual: str,
    kind: str,
    sign: float | None = None,
    row: bool = False,
    names: dict[str, str] | None = None,
) -> Matrix:
    """The column of the unknown (node, unknown) with the terms of a field, or its row.

    Parameters
    ----------
    values : NodeField
        Terms, under the names of equations or of unknowns.
    dual : str
        Name of the equation of `unknown`.
    sign : float or None
        1 or -1 puts the terms into the row too, with this sign.
    row : bool
        True: the field is the row of (node, dual) instead.
    names : mapping, optional
        Unknown of each component of the field, where it is not the usual one.
    """
    blocks, names = [], names or {}
    for name, part in values.components.items():
        primal = names.get(name) or PRIMAL_OF.get(name, name)
        pairs = np.column_stack([np.full(len(part.nodes), node), part.nodes])
        terms = np.zeros((len(part.nodes), 2, 2))
        terms[(slice(None), 0, 1) if row else (slice(None), 1, 0)] = part.values[:, None].ravel()
        if sign is not None:
            same = (part.nodes == node) & (primal == unknown)
            mirrored = np.where(same, 0.0, sign * part.values)
            terms[(slice(None), 1, 0) if row else (slice(None), 0, 1)] = mirrored
        equation = name if name in PRIMAL_OF or name in names else dual_of(primal)
        blocks.append(
            ElementMatrices(
                values.table,
                pairs,
                np.arange(2),
                (unknown, primal),
                (dual, equation),
                terms,
                kind,
                None,
                sign == 1.0,
            )
        )
    return Matrix(values.table, tuple(blocks), (), kind)


def from_columns(
    table: NodeTable, nodes: IntArray, columns: Sequence[NodeField], kind: str
) -> Matrix:
    """One element matrix on the unknown ALFA at nodes (n,), from n fields, its columns.

    Raises
    ------
    FieldError
        If the number of fields is not that of the nodes.
    """
    if len(columns) != len(nodes):
        raise FieldError(
            "kernel.matrices.columns-points", n_columns=len(columns), n_nodes=len(nodes)
        )
    values = np.stack([c.values_at("ALFA", nodes) for c in columns], axis=1)
    symmetric, n = bool(np.array_equal(values, values.T)), len(nodes)
    block = ElementMatrices.of_one(
        table, nodes, n * ["ALFA"], n * ["FALF"], values, kind, symmetric
    )
    return Matrix(table, (block,), (), kind)
