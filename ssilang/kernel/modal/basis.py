"""Projection on shapes and recombination: `F* = X^T F`, `K* = X^T K X`, `u = X q`."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices.assembly import (
    assemble,
    constraint_matrix,
    field_to_vector,
    numbering_of,
)
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations, dual_of
from ssilang.kernel.mesh.nodes import NodeTable

MULTIPLIERS = ("LX", "FLX")


def work(force: NodeField, shape: NodeField, same_names: bool = False) -> float:
    """Sum of the products of forces (FX ...) and displacements (UX ...) at the nodes of both.

    `same_names` multiplies components of equal names instead.
    """
    total = 0.0
    for name, part in shape.components.items():
        other = force.components.get(name if same_names else dual_of(name))
        if other is not None and name not in MULTIPLIERS:
            total += float(part.values @ other.at(part.nodes))
    return total


def combined(factors: Sequence[float], fields: Sequence[NodeField]) -> NodeField:
    """Linear combination of fields; a component absent at a node counts as zero."""
    parts: dict[str, NodeValues] = {}
    for name in dict.fromkeys(n for f in fields for n in f.components):
        nodes = np.unique(
            np.concatenate([f.components[name].nodes for f in fields if name in f.components])
        )
        total = np.zeros(len(nodes))
        for factor, field in zip(factors, fields, strict=True):
            total += factor * field.values_at(name, nodes)
        parts[name] = NodeValues(nodes, total)
    return NodeField(fields[0].table, parts, fields[0].nature)


def projected_matrix(
    matrix: Matrix,
    shapes: Sequence[NodeField],
    marks: IntArray,
    unknowns: Sequence[str],
    duals: Sequence[str],
) -> Matrix:
    """`X^T K X` as one element matrix on the points that mark the shapes (n,)."""
    numbering = numbering_of(matrix)
    X = np.stack([field_to_vector(s, numbering, dual=False) for s in shapes], axis=1)
    values: FloatArray = X.T @ (assemble(matrix, numbering) @ X)
    symmetric = all(b.symmetric for b in matrix.blocks)
    return on_marks(matrix.table, values, marks, unknowns, duals, matrix.kind, symmetric)


def on_marks(
    table: NodeTable,
    values: FloatArray,
    marks: IntArray,
    unknowns: Sequence[str],
    duals: Sequence[str],
    kind: str,
    symmetric: bool = True,
) -> Matrix:
    """Values (n, n) as one element matrix on the points that mark n shapes; symmetrised if so."""
    if symmetric:
        values = 0.5 * (values + values.T)
    block = ElementMatrices(
        table,
        marks[None, :],
        np.arange(len(marks)),
        tuple(unknowns),
        tuple(duals),
        values[None],
        kind,
        symmetric=symmetric,
    )
    return Matrix(table, (block,), (), kind)


def projected_relations(
    matrix: Matrix, shapes: Sequence[NodeField], marks: IntArray, unknowns: Sequence[str]
) -> Matrix:
    """Conditions on the body as conditions `C X q = d` on the participations q.

    Rows that no shape touches are left out; multipliers stay those of the body's conditions.
    """
    rows = constraint_matrix(matrix)
    numbering = numbering_of(matrix)
    X = np.stack([field_to_vector(s, numbering, dual=False) for s in shapes], axis=1)
    values = rows.C @ X
    small = 1e-12 * np.abs(values).max(initial=0.0)
    kept = np.flatnonzero((np.abs(values) > small).any(axis=1))
    terms = [np.flatnonzero(np.abs(values[i]) > small) for i in kept]
    counts = np.array([len(t) for t in terms], dtype=np.int64)
    flat = np.concatenate(terms) if terms else np.zeros(0, dtype=np.int64)
    found = Relations(
        matrix.table,
        np.concatenate([[0], np.cumsum(counts)]),
        marks[flat],
        tuple(unknowns[i] for i in flat),
        values[np.repeat(kept, counts), flat],
        rows.multipliers[kept],
        rows.sense[kept],
    )
    return Matrix(matrix.table, (), (found,), matrix.kind)


def static_complement(
    static: NodeField,
    shapes: Sequence[NodeField],
    works: Sequence[float],
    stiffnesses: Sequence[float],
) -> NodeField:
    """What modes leave out of a static response: `u - sum (work_i / k_i) shape_i`."""
    factors = [1.0, *(-w / k for w, k in zip(works, stiffnesses, strict=True))]
    return combined(factors, [static, *shapes])
