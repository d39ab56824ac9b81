"""PILE: how far a strain may go."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.fields.cell_algebra import component_names
from ssilang.kernel.fields.cell_field import CellField
from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.vocabulary.terms import POSITIVE


@operator(
    "PILE",
    arg("first", "MCHAML", en="where one starts"),
    arg("second", "MCHAML", en="direction"),
    arg("limit", "FLOTTANT", en="limit, positive", range=POSITIVE),
    family="fields",
    full_name="PILEPS",
    help=Help(
        "The largest X with -CRIT < E1 + X E2 < CRIT on the side that E2 goes to, for every value "
        "of the fields in cells E1 and E2 (strains), component by component.",
        "X1 = PILE MCHAML1 MCHAML2 CRIT ;",
        (
            "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
            "E = CHAN 'CHAM' (COOR 1 S) S ; LIST (PILE (0. * E) E 0.5) ;",
        ),
    ),
)
def pile(call: Call, first: CellField, second: CellField, limit: float) -> float:
    """Largest factor before a component passes the limit."""
    if component_names(first) != component_names(second) or len(first.blocks) != len(second.blocks):
        raise call.error("operators.fields.fields-of-other-zones", second)
    best = np.inf
    for a, b in zip(first.blocks, second.blocks, strict=True):
        for name, values in b.components.items():
            start, step = np.broadcast_arrays(a.components[name], values)
            moving = step != 0.0
            room = (np.sign(step[moving]) * limit - start[moving]) / step[moving]
            best = min(best, float(room.min(initial=np.inf)))
    if not np.isfinite(best):
        raise call.error("operators.fields.second-field-is-zero", second)
    return best
