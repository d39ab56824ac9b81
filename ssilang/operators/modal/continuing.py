"""ZCON: the two problems of the procedure CONTINU."""

from __future__ import annotations

from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.modal.continuation import continue_harmonics
from ssilang.operators.tables.entries import Entries


@operator(
    "ZCON",
    family="modal",
    help=Help(
        en="Continuation of the table of CONTINU, which is the procedure to call.",
        fr="Continuation de la table de CONTINU, procédure à appeler.",
        syntax="ZCON TAB1 ;",
    ),
    reads_itself=True,
)
def zcon(call: Call) -> None:
    """Harmonic balance where 'HBM' says so, else loads on a structure."""
    from ssilang.operators.statics.continuation import continue_loads

    entries = Entries(call, call.required("TABLE"), "CONTINU")
    (continue_harmonics if entries.flag("HBM") else continue_loads)(entries)
