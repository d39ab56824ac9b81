"""ZCON: the two problems of the procedure CONTINU."""

from __future__ import annotations

from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Table
from ssilang.operators.modal.continuation import continue_harmonics
from ssilang.operators.tables.entries import Entries


@operator(
    "ZCON",
    arg("table", "TABLE", en="table of CONTINU"),
    family="modal",
    help=Help(
        en="Continuation of the table of CONTINU, which is the procedure to call.",
        syntax="ZCON TAB1 ;",
    ),
)
def zcon(call: Call, table: Table) -> None:
    """Harmonic balance where 'HBM' says so, else loads on a structure."""
    from ssilang.operators.statics.continuation import continue_loads

    entries = Entries(call, table, "CONTINU")
    (continue_harmonics if entries.flag("HBM") else continue_loads)(entries)
