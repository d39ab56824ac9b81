"""Values of conditions: second members FLX at their multipliers (DEPI, JEU)."""

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.matrix import Matrix, Relations


def imposed_uniform(relations: Sequence[Relations], value: float) -> NodeField:
    """The same value for all rows: a field FLX at the multipliers (DEPI)."""
    nodes = np.unique(np.concatenate([r.multipliers for r in relations]))
    return NodeField.of(relations[0].table, nodes, {"FLX": np.full(len(nodes), value)}, "DISCRET")


def imposed_from_field(relations: Sequence[Relations], values: NodeField) -> NodeField:
    """Values for rows of one unknown, read in the field at that unknown's name and node.

    Rows are `c u = d`: d is the coefficient times the field's value.

    Raises
    ------
    FieldError
        If a row has several unknowns, or the field has none of the values wanted.
    """
    nodes, imposed = [], []
    for part in relations:
        if (np.diff(part.row_start) != 1).any():
            raise FieldError("kernel.matrices.field-values-fits-conditions")
        names = np.array(part.unknowns)
        for name in dict.fromkeys(part.unknowns):
            own = names == name
            component = values.components.get(name)
            there = np.zeros(own.sum(), bool)
            if component is not None:
                there = np.isin(part.nodes[own], component.nodes)
            found = part.coefficients[own] * values.values_at(name, part.nodes[own])
            nodes.append(part.multipliers[own][there])
            imposed.append(found[there])
    where = np.concatenate(nodes)
    if len(where) == 0:
        held = tuple(dict.fromkeys(u for r in relations for u in r.unknowns))
        raise FieldError(
            "kernel.matrices.field-no-value-something", held=held, components=values.components
        )
    return NodeField.of(values.table, where, {"FLX": np.concatenate(imposed)}, "DISCRET")


def geometric_gaps(matrix: Matrix) -> NodeField:
    """Values that make relations on displacements speak of positions: `-C x` at the multipliers.

    Unknowns that move along no axis (rotations) count with a coordinate of zero.
    """
    axes = {"UX": 0, "UR": 0, "UY": 1, "UZ": 2}
    nodes, values = [np.empty(0, np.int64)], [np.empty(0)]
    for part in matrix.relations:
        points = part.table.coordinates[part.nodes]
        radial = "UR" in part.unknowns  # axisymmetric: UZ is along the second coordinate
        axis = np.array([1 if radial and u == "UZ" else axes.get(u, -1) for u in part.unknowns])
        x = np.where(axis >= 0, points[np.arange(len(axis)), axis], 0.0)
        nodes.append(part.multipliers)
        values.append(-np.add.reduceat(part.coefficients * x, part.row_start[:-1]))
    where = np.concatenate(nodes)
    return NodeField.of(matrix.table, where, {"FLX": np.concatenate(values)}, "DISCRET")


def imposed_by_node(relations: Sequence[Relations], values: NodeField) -> NodeField:
    """Values for relations between unknowns of a single node, from the component SCAL there.

    Raises
    ------
    FieldError
        If a row has terms on several nodes or the field has another component than SCAL.
    """
    if list(values.components) != ["SCAL"]:
        raise FieldError("kernel.matrices.rela-wants-field-component")
    nodes, imposed = [], []
    for part in relations:
        first = part.nodes[part.row_start[:-1]]
        if (part.nodes != np.repeat(first, np.diff(part.row_start))).any():
            raise FieldError("kernel.matrices.rela-fits-relations-between")
        nodes.append(part.multipliers)
        imposed.append(values.values_at("SCAL", first))
    return NodeField.of(
        values.table, np.concatenate(nodes), {"FLX": np.concatenate(imposed)}, "DISCRET"
    )
