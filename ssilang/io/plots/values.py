"""Values that colour the faces of a picture: from nodal fields and fields in cells."""

from functools import lru_cache

import numpy as np

from ssilang.io.plots.patches import Faces
from ssilang.io.vtk.grid import matching_cells
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.catalog import ELEMENTS, support_rule
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.cells import CELL_TYPES

VON_MISES = "von Mises"


def component_names(field: NodeField | CellField) -> tuple[str, ...]:
    """Components that can be drawn, in order; stresses begin with the von Mises stress."""
    if isinstance(field, NodeField):
        return tuple(field.components)
    names: dict[str, None] = {}
    for block in field.blocks:
        names |= {c: None for c, v in block.components.items() if v.dtype != object}
    stresses = any(_stress_names(tuple(names)))
    return (VON_MISES, *names) if stresses else tuple(names)


def values_on(faces: Faces, field: NodeField | CellField, component: str) -> FloatArray:
    """Values at the nodes of faces, shape (n, k); NaN where the field has none."""
    if isinstance(field, NodeField):
        return field.values_at(component, faces.nodes.ravel(), np.nan).reshape(faces.nodes.shape)
    values = np.full(faces.nodes.shape, np.nan)
    for part in field.blocks:
        place = matching_cells(faces.block, part.cells)[faces.cells]
        found = place >= 0
        if found.any():
            at_nodes = _nodal(part, component)
            if at_nodes is not None:
                values[found] = at_nodes[place[found]][:, faces.local]
    return values


def _nodal(part: CellFieldBlock, component: str) -> FloatArray | None:
    """Values at the nodes of the cells of a block, shape (n_cells, n_nodes)."""
    if component == VON_MISES:
        # from the stresses at the nodes: extrapolated itself it could become negative
        return _von_mises(part)
    found = part.components.get(component)
    return None if found is None else _spread(part, np.asarray(found, dtype=float))


def _spread(part: CellFieldBlock, given: FloatArray) -> FloatArray:
    """Values (n_cells, n_points or 1) brought to the nodes."""
    shape = len(part.cells), part.cells.kind.n_nodes
    if given.shape[1] == 1:
        return np.broadcast_to(given, shape)
    if part.support == "NOEUD":
        return given
    spread = to_nodes(part.element, part.support, part.cells.cell_type)
    if spread is None or spread.shape[1] != given.shape[1]:
        return np.broadcast_to(given.mean(axis=1, keepdims=True), shape)
    return given @ spread.T


@lru_cache(maxsize=64)
def to_nodes(element: str, support: Support, cell_type: str) -> FloatArray | None:
    """Matrix (n_nodes, n_points) that extrapolates from integration points to nodes.

    Least squares with the linear functions of the reference coordinates (and their products on
    quadrangles and hexahedra), so that a linear field is kept exactly. None for an element that
    has no reference cell of its own.
    """
    if element not in ELEMENTS:
        return None
    kind = CELL_TYPES[cell_type]
    cell = ELEMENTS[element].reference_cell
    points = support_rule(element, support).points
    nodes = cell.nodes
    rich = cell.shape in ("quadrangle", "hexahedron") and len(points) >= 2 ** points.shape[1]
    spread: FloatArray = _basis(nodes, rich) @ np.linalg.pinv(_basis(points, rich))
    if kind.joint:
        spread = np.concatenate([spread, spread])
    return spread if len(spread) == kind.n_nodes else None


def _basis(points: FloatArray, products: bool) -> FloatArray:
    columns = [np.ones(len(points)), *points.T]
    dim = points.shape[1]
    if products:
        columns += [points[:, i] * points[:, j] for i in range(dim) for j in range(i)]
        if dim == 3:
            columns.append(points.prod(axis=1))
    return np.column_stack(columns)


_NORMAL = (("SMXX", "SMYY", "SMZZ"), ("SMRR", "SMZZ", "SMTT"))
_SHEAR = (("SMXY", "SMXZ", "SMYZ"), ("SMRZ", "SMRT", "SMZT"))


def _stress_names(names: tuple[str, ...]) -> tuple[tuple[str, ...], tuple[str, ...]] | tuple[()]:
    for normal, shear in zip(_NORMAL, _SHEAR, strict=True):
        if normal[0] in names and normal[1] in names:
            return normal, shear
    return ()


def _von_mises(part: CellFieldBlock) -> FloatArray | None:
    found = _stress_names(tuple(part.components))
    if not found:
        return None
    normal, shear = found
    absent = np.zeros((len(part.cells), 1))

    def value(name: str) -> FloatArray:
        return _spread(part, np.asarray(part.components.get(name, absent), dtype=float))

    a, b, c = (value(n) for n in normal)
    shears = sum(value(n) ** 2 for n in shear)
    return np.asarray(np.sqrt(((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2) / 2 + 3 * shears))
