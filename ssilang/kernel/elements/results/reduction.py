"""Models and fields in cells restricted to a mesh or a model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.zone_fields import cell_rows, zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.mesh.mesh import CellBlock, Mesh


def model_on_mesh(model: Model, mesh: Mesh) -> Model:
    """Zones restricted to the cells of a mesh.

    Raises
    ------
    FieldError
        If none of the mesh's cells belongs to the model.
    """
    zones: list[Zone] = []
    for zone in model.zones:
        for block in mesh.blocks:
            rows = cell_rows(zone.cells, block)
            kept = rows[rows >= 0]
            if not len(kept):
                continue
            same = len(kept) == len(zone.cells) and np.array_equal(kept, np.arange(len(kept)))
            cells = zone.cells if same else _picked(zone.cells, kept)
            zones.append(replace(zone, cells=cells))
    if not zones:
        raise FieldError("kernel.elements.no-cell-mesh-belongs")
    return Model(tuple(zones))


def _picked(cells: CellBlock, rows: np.ndarray) -> CellBlock:
    return CellBlock(cells.nodes, cells.cell_type, cells.raw[rows], cells.colours[rows])


def field_on_mesh(field: CellField, mesh: Mesh) -> CellField:
    """Blocks of a field in cells restricted to the cells of a mesh."""
    blocks = []
    for block in field.blocks:
        for wanted in mesh.blocks:
            rows = cell_rows(block.cells, wanted)
            kept = rows[rows >= 0]
            if not len(kept):
                continue
            full = {
                n: np.broadcast_to(v, (len(block.cells), v.shape[1]))[kept]
                for n, v in block.components.items()
            }
            cells = _picked(block.cells, kept)
            blocks.append(
                CellFieldBlock(cells, full, block.support, block.element, block.constituent)
            )
    if not blocks:
        raise FieldError("kernel.elements.no-cell-mesh-belongs-to-support")
    return CellField(tuple(blocks), field.title)


def field_on_model(field: CellField, model: Model) -> CellField:
    """The field on the very cells of a model's zones."""
    blocks = []
    for zone in model.zones:
        seen = zone_field(zone, field)
        by_support: dict[Support, dict[str, np.ndarray]] = {}
        for name in seen.names:
            values, support = seen.raw(name)
            by_support.setdefault(support, {})[name] = values
        element = next((b.element for b, _ in seen.parts if b.element), zone.element)
        blocks += [
            CellFieldBlock(zone.cells, components, support, element, zone.constituent)
            for support, components in by_support.items()
        ]
    if not blocks:
        raise FieldError("kernel.elements.field-no-value-cells")
    return CellField(tuple(blocks), field.title)
