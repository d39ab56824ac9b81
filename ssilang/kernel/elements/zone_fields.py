"""What a field in cells says on the cells of one zone of a model."""

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError, MaterialError
from ssilang.kernel.curves.cloud import Cloud
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.elements.catalog import ELEMENTS, support_rule
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS, shape_functions
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.mesh.cells import LINEAR_CELLS
from ssilang.kernel.mesh.combine import row_keys
from ssilang.kernel.mesh.mesh import CellBlock


def cell_rows(inside: CellBlock, wanted: CellBlock) -> IntArray:
    """Row in `inside` of each cell of `wanted`, -1 where there is none, shape (n_wanted,)."""
    if inside.cell_type != wanted.cell_type:
        return np.full(len(wanted), -1)
    return rows_of(inside.connectivity, wanted.connectivity)


def rows_of(inside: IntArray, wanted: IntArray) -> IntArray:
    """Row (m,) of a table (n, k) with the nodes of each of other rows (m, k), -1 for none."""
    if not len(inside) or not len(wanted):
        return np.full(len(wanted), -1)
    meant = np.zeros(max(inside.max(), wanted.max()) + 1, bool)
    meant[wanted] = True
    near = np.flatnonzero(meant[inside].all(axis=1))  # as a rule few, and sorting takes long
    if not len(near):
        return np.full(len(wanted), -1)
    keys, probe = row_keys(inside[near]), row_keys(wanted)
    order = np.argsort(keys, kind="stable")
    rows = order[np.minimum(np.searchsorted(keys, probe, sorter=order), len(keys) - 1)]
    return np.where(keys[rows] == probe, near[rows], -1)


def _fitting_basis(cell_type: str, source: FloatArray, target: FloatArray) -> list[FloatArray]:
    """Richest basis that the source points determine, at source and target points."""
    for name in (cell_type, LINEAR_CELLS.get(cell_type, cell_type)):
        at_source = shape_functions(name, source)
        # points above one another, as those across thick shells, determine no more than one does
        if np.linalg.matrix_rank(at_source) == len(REFERENCE_CELLS[name].nodes):
            return [at_source, shape_functions(name, target)]
    if cell_type == "CUB8" and len(source) == 5:  # solid shells: the line between two faces
        return [np.column_stack([np.ones(len(x)), x[:, 2]]) for x in (source, target)]
    return [np.ones((len(points), 1)) for points in (source, target)]


@cache
def transfer_matrix(element: str, source: Support, target: Support) -> FloatArray:
    """Matrix (n_target, n_source) that carries values from one support to another.

    Least squares on the element's shape functions, over the reference cell where its points have
    weights; on those of the linear cell, or a constant, where the points are too few to determine
    them.
    """
    kind = ELEMENTS[element]
    cell_type = kind.reference or kind.cell_type
    rules = [support_rule(element, s) for s in (source, target)]
    if source == "NOEUD":
        return shape_functions(cell_type, rules[1].points)
    if np.array_equal(rules[0].points, rules[1].points):
        return np.eye(len(rules[0]))
    old, new = _fitting_basis(cell_type, rules[0].points, rules[1].points)
    weights = rules[0].weights if (rules[0].weights > 0).all() else np.ones(len(old))
    roots = np.sqrt(weights)
    matrix: FloatArray = new @ np.linalg.pinv(roots[:, None] * old) * roots
    return np.where(np.abs(matrix) < 1e-14, 0.0, matrix)


def carry(values: NDArray[Any], element: str, source: Support, target: Support) -> NDArray[Any]:
    """Values (n_cells, n_points) moved to another support; constants stay as they are.

    Of values at the nodes of joints the mean of both sides counts.
    """
    if values.shape[1] == 1 or source == target:
        return values
    if values.dtype == object:
        raise FieldError("kernel.elements.curves-points-vary-inside")
    matrix = transfer_matrix(element, source, target)
    half = matrix.shape[1]
    if source == "NOEUD" and values.shape[1] == 2 * half:
        values = (values[:, :half] + values[:, half:]) / 2
    if half != values.shape[1]:
        told = {"source": source, "n_values": values.shape[1], "element": element, "n_matrix": half}
        raise FieldError("kernel.elements.field-values-cell-element", **told)
    return values @ matrix.T


@dataclass(frozen=True, eq=False)
class ZoneField:
    """A field seen from the cells of one zone.

    `parts` are the field's blocks that cover the zone: block and, for each cell of the zone, its
    row there (None: the same cells in the same order).
    """

    zone: Zone
    parts: tuple[tuple[CellFieldBlock, IntArray | None], ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Components that are defined on the zone, each once, in order."""
        return tuple(dict.fromkeys(n for b, _ in self.parts for n in b.components))

    def __contains__(self, name: str) -> bool:
        return any(name in block.components for block, _ in self.parts)

    def own(self) -> "ZoneField":
        """Without what models of other elements on the same cells were given."""
        parts = tuple(p for p in self.parts if p[0].element in ("", self.zone.element))
        return ZoneField(self.zone, parts)

    def raw(self, name: str) -> tuple[NDArray[Any], Support]:
        """Values (n_cells or 1, n_points) as stored, and their support.

        Raises
        ------
        FieldError
            If the component is missing, or missing on some cells of the zone.
        """
        result: NDArray[Any] | None = None
        support: Support = "NOEUD"
        known = np.zeros(len(self.zone.cells), dtype=bool)
        for block, rows in self.parts:
            if name not in block.components:
                continue
            values = np.asarray(block.components[name])
            if rows is None:
                return values, block.support
            found = rows >= 0
            picked = values[np.maximum(rows, 0)] if len(values) > 1 else values[[0] * len(rows)]
            if result is None:
                result, support = picked.copy(), block.support
            else:
                picked = carry(picked, self.zone.element, block.support, support)
                width = max(result.shape[1], picked.shape[1])
                result = np.broadcast_to(result, (len(rows), width)).copy()
                result[found] = np.broadcast_to(picked, result.shape)[found]
            known |= found
        if result is None or not known.all():
            raise FieldError("kernel.elements.component-not-defined-cells", name=name)
        return result, support

    def numbers(self, name: str) -> tuple[FloatArray, Support]:
        """As `raw`, of a parameter that is no curve and no other object."""
        values, support = self.raw(name)
        if values.dtype == object:
            first = values.flat[0]
            told = {"name": name, "found": first, "curve": isinstance(first, Curve | Cloud)}
            told["word"] = first if isinstance(first, str) else ""
            raise MaterialError("kernel.elements.parameter-not-a-number", **told)
        return values.astype(float, copy=False), support

    def at(self, name: str, support: Support, default: float | None = None) -> FloatArray:
        """Values at the points of a support, shape (n_cells or 1, n_points or 1).

        Raises
        ------
        MaterialError
            If the component is missing and has no default, or depends on another field.
        """
        if name not in self:
            if default is None:
                raise missing_parameter(self.zone, name, self.names)
            return np.full((1, 1), float(default))
        values, source = self.numbers(name)
        found = carry(values, self.zone.element, source, support)
        uniform = len(found) > 1 and found.shape[1] == 1 and (found == found[0, 0]).all()
        return found[:1] if uniform else found

    def each(self, name: str, default: float | None = None) -> FloatArray:
        """Values (n_cells,), one a cell: at its first point where they vary."""
        return np.broadcast_to(self.at(name, "GRAVITE", default)[:, 0], (len(self.zone.cells),))

    def matrix(self, names: tuple[str, ...], support: Support) -> FloatArray:
        """Several components side by side, zero where absent, (n_cells, len(names), n_points)."""
        n = len(self.zone.cells)
        p = len(support_rule(self.zone.element, support))
        columns = [np.broadcast_to(self.at(name, support, 0.0), (n, p)) for name in names]
        return np.stack(columns, axis=1)


INSTEAD = {"ECRO": "TRAC", "GGAM": "GAMR"}
"""Parameters that may be made from another one, and that one."""


def missing_parameter(zone: Zone, name: str, given: tuple[str, ...]) -> MaterialError:
    """The error for a parameter that a zone needs and does not have."""
    law = " ".join(zone.behaviour)
    return MaterialError(
        "kernel.elements.parameter-missing-element",
        name=name,
        instead=INSTEAD.get(name, ""),
        element=zone.element,
        law=law,
        given=given,
    )


def none_of(names: tuple[str, ...], zone: Zone, seen: ZoneField) -> FieldError:
    """The refusal of a field that has none of some components in the cells of a zone."""
    code = "kernel.elements.field-none-cells-element"
    return FieldError(code, names=names, element=zone.element, present=seen.names)


def zone_field(zone: Zone, field: CellField | None) -> ZoneField:
    """The part of a field that stands on a zone's cells.

    Blocks made over the very same cells count first; others are compared cell by cell, so that a
    field made for a larger model serves a part of it.
    """
    if field is None:
        return ZoneField(zone, ())
    fitting = [b for b in field.blocks if len({zone.constituent, b.constituent} - {""}) < 2]
    parts: list[tuple[CellFieldBlock, IntArray | None]] = [
        (b, None) for b in fitting if b.cells is zone.cells
    ]
    known = {name for block, _ in parts for name in block.components}
    for block in fitting:
        if block.cells is zone.cells or known.issuperset(block.components):
            continue
        if block.cells.cell_type != zone.cells.cell_type:
            continue
        rows = cell_rows(block.cells, zone.cells)
        if (rows >= 0).any():
            parts.append((block, rows))
    return ZoneField(zone, tuple(parts))


def n_points(element: str, support: Support) -> int:
    """Number of points of a support of an element."""
    return len(support_rule(element, support))
