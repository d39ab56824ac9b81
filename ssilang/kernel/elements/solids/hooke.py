"""Hooke matrices as fields in cells (sub-type MATRICE DE HOOKE, component MAHO)."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError, MaterialError
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import CellFieldBlock, Support
from ssilang.kernel.materials.model import Zone

HOOKE_COMPONENT = "MAHO"


def hooke_block(zone: Zone, moduli: FloatArray, support: Support) -> CellFieldBlock:
    """Block with one matrix (as an array object) a cell and point.

    Parameters
    ----------
    moduli : array (n_cells or 1, n_points or 1, s, s)
    """
    n, p = len(zone.cells), moduli.shape[1]
    objects = np.empty(moduli.shape[:2], dtype=object)
    for i in range(moduli.shape[0]):
        for j in range(p):
            objects[i, j] = moduli[i, j]
    values = np.broadcast_to(objects, (n, p))
    return CellFieldBlock(
        zone.cells, {HOOKE_COMPONENT: values}, support, zone.element, zone.constituent
    )


def moduli_from_field(zone: Zone, material: ZoneField, support: Support) -> FloatArray | None:
    """Moduli (n_cells or 1, n_points or 1, s, s) of a field of Hooke matrices, None without one.

    Raises
    ------
    FieldError
        If the matrices were computed at other points.
    """
    if HOOKE_COMPONENT not in material:
        return None
    values, found = material.raw(HOOKE_COMPONENT)
    if values.shape[1] > 1 and found != support and {found, support} != {"RIGIDITE", "STRESSES"}:
        raise FieldError(
            "kernel.elements.hooke-matrices-stand-needed", found=found, support=support
        )
    first = values[0, 0]
    if all(v is first for v in values.ravel()):
        return np.asarray(first, dtype=float)[None, None]
    rows = [np.asarray(v, dtype=float) for v in values.ravel()]
    return np.array(rows).reshape(*values.shape, *rows[0].shape)


def inverted(zone: Zone, moduli: FloatArray) -> FloatArray:
    """Inverse of moduli.

    Raises
    ------
    MaterialError
        If they are singular.
    """
    try:
        return np.linalg.inv(moduli).astype(np.float64)
    except np.linalg.LinAlgError:
        raise MaterialError(
            "kernel.elements.elastic-matrix-element-cannot", element=zone.element
        ) from None
