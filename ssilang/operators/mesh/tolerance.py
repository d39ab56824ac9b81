"""How near points count as being at one place."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.language.registry import opt
from ssilang.language.vocabulary.terms import NOT_NEGATIVE
from ssilang.operators.workspace import Workspace

DISTANCE = opt(
    "distance",
    "FLOTTANT",
    en="how far off still counts, a tenth of the density by default",
    unit="m",
    range=NOT_NEGATIVE,
)


def tolerance_of(ws: Workspace, given: float | None, positions: FloatArray) -> float:
    """The given distance, else a tenth of the density, else a hair of the extent."""
    if given is not None:
        return given
    if ws.density > 0.0:
        return 0.1 * ws.density
    return 1e-9 * float(np.ptp(positions, axis=0).max(initial=0.0))
