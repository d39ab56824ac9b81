"""Models as sets of zones: DIFF and INTE."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.mesh.combine import cell_keys
from ssilang.language.registry import arg, main
from ssilang.operators.dispatch import DIFF, INTE


def same_zone(one: Zone, other: Zone) -> bool:
    """Whether two zones put the same element and law on the same cells."""
    laws = [(z.formulation, z.behaviour, z.element, z.mode, z.constituent) for z in (one, other)]
    if laws[0] != laws[1] or one.cells.cell_type != other.cells.cell_type:
        return False
    if one.cells is other.cells:
        return True
    if len(one.cells) != len(other.cells):
        return False
    keys = [np.sort(cell_keys(z.cells)) for z in (one, other)]
    return bool((keys[0] == keys[1]).all())


def _found_in(zone: Zone, model: Model) -> bool:
    return any(same_zone(zone, other) for other in model.zones)


_FIRST = main("first", "MMODEL", en="model")
_SECOND = arg("second", "MMODEL", en="other model")


@DIFF.form(
    _FIRST,
    _SECOND,
    syntax="MOD3 = MOD1 DIFF MOD2 ;",
    en="Of models: zones of one only.",
    examples=(
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ; T = S PLUS (2. 0.) ;"
        " A = MODE S MECANIQUE ELASTIQUE ; B = MODE T MECANIQUE ELASTIQUE ;"
        " C = (A ET B) DIFF A ; LIST (NBEL (EXTR C 'MAIL')) ;",
    ),
)
def difference_of_models(first: Model, second: Model) -> Model:
    """Zones of one of two models only."""
    left = [z for z in first.zones if not _found_in(z, second)]
    return Model((*left, *(z for z in second.zones if not _found_in(z, first))))


@INTE.form(_FIRST, _SECOND, syntax="MOD3 = MOD1 INTE MOD2 ;", en="Of models: zones that both hold.")
def intersection_of_models(first: Model, second: Model) -> Model:
    """Common zones of two models."""
    common = tuple(z for z in first.zones if _found_in(z, second))
    if not common:
        raise MeshError("operators.models.no-common-zone")
    return Model(common)
