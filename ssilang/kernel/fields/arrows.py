"""Arrows made from fields: at nodes, in cells, principal values."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.deformed import ArrowPart, Arrows
from ssilang.kernel.fields.node_field import NodeField

Columns = tuple[str, str, str]
_PRINCIPAL = ("SI11", "SI22", "SI33")
_USUAL = (2, 4, 1)  # red, green, blue


def arrows_at_nodes(
    field: NodeField, columns: Columns, scale: float | None = None, colour: int = 0
) -> Arrows:
    """Arrows of the components `columns` along x, y, z ('' for none) at their nodes."""
    present = [field.components[c].nodes for c in columns if c in field.components]
    ids = np.unique(np.concatenate([np.empty(0, dtype=np.int64), *present]))
    vectors = np.column_stack([field.values_at(c, ids) for c in columns])
    name = " ".join(c for c in columns if c in field.components)
    where = field.table.coordinates[ids]
    return Arrows((ArrowPart(where, vectors, ids, scale, colour, name),))


def arrows_in_cells(
    field: CellField, columns: Columns, scale: float | None = None, colour: int = 0
) -> Arrows:
    """Arrows of the mean of `columns` along x, y, z in the middle of each cell.

    Raises
    ------
    FieldError
        If no block has one of the components.
    """
    parts = []
    for block in field.blocks:
        if not any(c in block.components for c in columns):
            continue
        vectors = np.column_stack([_mean(block, c) for c in columns])
        name = " ".join(c for c in columns if c)
        parts.append(ArrowPart(_centres(block), vectors, None, scale, colour, name))
    if not parts:
        raise FieldError("kernel.fields.field-none-components", columns=columns)
    return Arrows(tuple(parts))


def principal_strokes(
    field: CellField,
    scale: float | None = None,
    chosen: tuple[str, ...] = (),
    colours: tuple[int, ...] = (),
) -> Arrows:
    """Strokes along the principal directions in the middle of each cell.

    Parameters
    ----------
    field : CellField
        Principal stresses as PRIN gives them: values SI11 SI22 SI33, directions COX1 COY1 COZ1,
        COX2 ..., or stresses SMXX ... themselves.
    chosen : tuple of str
        Of SI11, SI22, SI33; all when empty. SI11 is the largest.
    colours : tuple of int
        Of the strokes of SI11, SI22, SI33; red, green and blue when empty.

    Raises
    ------
    FieldError
        If the field holds neither.
    """
    names = chosen or _PRINCIPAL
    shade = dict(zip(names, (*colours, *_USUAL[len(colours) :]), strict=False))
    parts = []
    for block in field.blocks:
        tensor = _tensor(block)
        if tensor is None:
            continue
        values, directions = np.linalg.eigh(tensor)
        for rank in range(3):
            name = _PRINCIPAL[rank]
            if name not in shade:
                continue
            column = 2 - rank  # eigh sorts upwards
            vectors = directions[:, :, column] * values[:, column, None]
            if np.any(vectors):
                parts.append(
                    ArrowPart(_centres(block), vectors, None, scale, shade[name], name, False)
                )
    if not parts:
        raise FieldError("kernel.fields.field-holds-no-principal")
    return Arrows(tuple(parts))


def _tensor(block: CellFieldBlock) -> FloatArray | None:
    """Mean stress tensor of each cell, shape (n, 3, 3); None if the block has none."""
    parts = block.components
    if "SI11" in parts:
        total: Any = 0.0
        for i in (1, 2, 3):
            value = _values(block, f"SI{i}{i}")
            d = np.stack([_values(block, f"CO{axis}{i}") for axis in "XYZ"], axis=-1)
            total = total + value[..., None, None] * d[..., :, None] * d[..., None, :]
        return np.asarray(total.mean(axis=1))
    for names in (
        ("SMXX", "SMYY", "SMZZ", "SMXY", "SMXZ", "SMYZ"),
        ("SMRR", "SMZZ", "SMTT", "SMRZ", "SMRT", "SMZT"),
    ):
        if names[0] in parts:
            a, b, c, ab, ac, bc = (_mean(block, n) for n in names)
            rows = [np.stack(r, axis=-1) for r in ((a, ab, ac), (ab, b, bc), (ac, bc, c))]
            return np.stack(rows, axis=-2)
    return None


def _values(block: CellFieldBlock, name: str) -> FloatArray:
    """Values of a component (n, p), zero if it is absent."""
    found = block.components.get(name)
    if found is None:
        return np.zeros((len(block.cells), 1))
    return np.asarray(found, dtype=float)


def _mean(block: CellFieldBlock, name: str) -> FloatArray:
    mean: FloatArray = _values(block, name).mean(axis=1)
    return np.broadcast_to(mean, (len(block.cells),))


def _centres(block: CellFieldBlock) -> FloatArray:
    middle: FloatArray = block.cells.coordinates.mean(axis=1)
    return middle
