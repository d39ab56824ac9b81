"""ETG: the union of all that a table of parts holds."""

from __future__ import annotations

from typing import Any

from ssilang.kernel.mesh.combine import gathered
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.registry import ANY, Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Table
from ssilang.operators.dispatch import united


@operator(
    "ETG",
    arg("table", "TABLE", en="objects at 1, 2 ..."),
    gives=ANY,
    family="objects",
    help=Help(
        en="Union (ET) of the objects that a table of sub-type 'ESCLAVE' holds at the indices 1, 2 "
        "...: PART makes such tables. A mesh gets the cells in the order of the table.",
        syntax="OBJ2 = ETG TAB1 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 9 (0. 0.) (1. 0.) ; T = PART 'ARLE' L 3 ; "
            "MESS (NBEL (T . 1)) (NBEL (ETG T)) ;",
        ),
    ),
)
def etg(call: Call, table: Table) -> Any:
    """Union of a table's objects."""
    if table.subtype != "ESCLAVE":
        raise call.error("operators.tables.wrong-subtype", table, subtype=table.subtype)
    values = [v for index, v in table.items() if type(index) is int]
    if not values:
        raise call.error("operators.tables.empty-table", table)
    if all(isinstance(v, Mesh) for v in values):
        return gathered([v for v in values if isinstance(v, Mesh)])
    total = values[0]
    for value in values[1:]:
        total = united(call, total, value, call.span)
    return total
