"""Strains of expansion in time that plastic bodies take without stress."""

from functools import partial

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.plasticity.bulk import FreeStrain
from ssilang.kernel.statics.thermal_load import free_terms
from ssilang.kernel.stepping.problem.loading import TimeCurve


def free_strains(
    load: Load | None, zones: tuple[Zone, ...], material: CellField
) -> dict[int, FreeStrain]:
    """ALPH (T - TALP) and given strains in time, by position of the zone; empty without either."""
    found = {i: free_terms(load, zone, material) for i, zone in enumerate(zones)}
    # beams of fibres have none, or are refused above
    strained = (i for i in found if found[i] and "SECTION" not in zones[i].behaviour)
    return {i: partial(_at, found[i]) for i in strained}


def _at(terms: list[tuple[FloatArray, TimeCurve]], time: float) -> FloatArray:
    return sum((float(np.interp(time, *c)) * s for s, c in terms), np.zeros_like(terms[0][0]))
