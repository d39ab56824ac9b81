"""Largest shear strain of solid cells over a motion (equivalent-linear soil)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellFieldBlock
from ssilang.kernel.materials.model import Zone


def largest_shear_strain(zone: Zone, motion: Iterable[FloatArray]) -> CellFieldBlock:
    """Largest over a motion of sqrt(2 e:e) at the centres of cells, e being the strain deviator.

    In simple shear this is the shear strain (gamma) itself.

    Parameters
    ----------
    motion : iterable of arrays (n_instants, n_cells, n_rows)
        Element vectors of displacements, in the layout of the zone.

    Returns
    -------
    CellFieldBlock
        SCAL at 'GRAVITE', no unit.

    Raises
    ------
    MeshError
        If the zone is not of continuous elements.
    """
    family = families.family_of(zone)
    names = family.strain_names(zone)
    if names[:3] not in (("EPXX", "EPYY", "EPZZ"), ("EPRR", "EPZZ", "EPTT")):
        raise MeshError("kernel.elements.elements-no-shear-strain", element=zone.element)
    everything = slice(0, len(zone.cells))
    operator = family.strain_operator(zone, zone_field(zone, None), "GRAVITE", everything)
    matrix = operator.matrix[:, :, 0, :]
    largest = np.zeros(len(zone.cells))
    for vectors in motion:
        strain = np.matmul(matrix, vectors.transpose(1, 2, 0))
        normal, shear = strain[:, :3], strain[:, 3:]
        deviator = normal - normal.mean(axis=1, keepdims=True)
        square = 2 * (deviator**2).sum(axis=1) + (shear**2).sum(axis=1)
        np.maximum(largest, square.max(axis=1, initial=0.0), out=largest)
    return cell_block(zone, ("SCAL",), np.sqrt(largest)[:, None, None], "GRAVITE")
