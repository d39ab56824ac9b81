"""Fields in cells whose values are curves, from fields at several abscissas."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.fields.cell_algebra import component_names, numeric, rebuilt, same_cells
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock


def through(name: str, abscissas: Sequence[float], fields: Sequence[CellField]) -> CellField:
    """In each cell the curve of the values of fields of one component against abscissas.

    Parameters
    ----------
    name : str
        Of the abscissas; the ordinates bear the name of the component.

    Raises
    ------
    FieldError
        If the abscissas do not increase, or the fields differ in cells or component.
    """
    x = np.asarray(abscissas, dtype=float)
    if (np.diff(x) <= 0).any():
        i = int(np.argmax(np.diff(x) <= 0))
        raise FieldError("kernel.curves.abscissas-must-increase-follows", x=x[i + 1], x_2=x[i])
    names = {n for f in fields for n in component_names(f)}
    if len(names) != 1:
        raise FieldError("kernel.fields.curves-of-one-component", names=sorted(names))
    (component,) = names
    blocks = [_block(b, component, name, x, fields) for b in fields[0].blocks]
    return CellField(tuple(blocks), fields[0].title)


def _block(
    block: CellFieldBlock, component: str, name: str, x: FloatArray, fields: Sequence[CellField]
) -> CellFieldBlock:
    rows = []
    for field in fields:
        mine = next((b for b in field.blocks if same_cells(b.cells, block.cells)), None)
        if mine is None or mine.support != block.support:
            raise FieldError("kernel.fields.curves-of-other-cells", n_cells=len(block.cells))
        rows.append(numeric(component, mine.components[component]))
    values = np.stack(np.broadcast_arrays(*rows), axis=-1).astype(float)
    made = np.empty(values.shape[:2], dtype=object)
    known: dict[bytes, Curve] = {}
    for place in np.ndindex(*made.shape):
        key = values[place].tobytes()
        if key not in known:
            part = CurvePart(x, values[place].copy(), name, component)
            known[key] = Curve((part,))
        made[place] = known[key]
    return rebuilt(block, {component: made})
