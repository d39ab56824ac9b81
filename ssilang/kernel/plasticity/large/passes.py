"""The compiled passes of a zone, by its law."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.materials.plastic.cone_rows import cone_rows
from ssilang.kernel.plasticity.large.blocks import ZonePass, cells_of
from ssilang.kernel.plasticity.large.cones import ConePass
from ssilang.kernel.plasticity.large.nested import NestedPass, nested_of
from ssilang.kernel.plasticity.points import PlasticPoints


def zone_pass(points: PlasticPoints, places: NDArray[np.int32]) -> ZonePass | None:
    """The compiled passes of a zone, None where its law or stresses have none."""
    if points.held:
        return None
    if points.law.parts is not None:
        nested = nested_of(points.law.parts, points.parameters)
        return NestedPass(cells_of(points, places), nested)
    cone = cone_rows(points.law, points.parameters)
    return None if cone is None else ConePass(cells_of(points, places), cone)
