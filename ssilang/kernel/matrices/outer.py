"""Matrices made of outer products of nodal fields: one dense block on all their nodes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.build import PRIMAL_OF
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, dual_of

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
    places = sorted(
        {
            (PRIMAL_OF.get(name, name), int(node))
            for field in fields
            for name, part in field.components.items()
            for node in part.nodes
        }
    )
    if len(places) > _LARGEST:
        raise FieldError("kernel.matrices.full-matrix-rows-too", n_places=len(places))
    rows = {place: i for i, place in enumerate(places)}
    vectors = np.zeros((len(fields), len(places)))
    for vector, field in zip(vectors, fields, strict=True):
        _fill(vector, field, rows)
    values = (vectors.T * np.asarray(factors, dtype=float)) @ vectors
    nodes, local = np.unique([node for _, node in places], return_inverse=True)
    names = tuple(name for name, _ in places)
    duals = tuple(dual_of(name) for name in names)
    block = ElementMatrices(
        table, nodes[None, :], local.astype(np.int64), names, duals, values[None], kind
    )
    return Matrix(table, (block,), (), kind)


def _fill(vector: FloatArray, field: NodeField, rows: dict[tuple[str, int], int]) -> None:
    """Add the values of a field to its rows."""
    for name, part in field.components.items():
        unknown = PRIMAL_OF.get(name, name)
        where = [rows[unknown, int(node)] for node in part.nodes]
        vector[where] += part.values
