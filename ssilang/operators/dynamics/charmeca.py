"""CHARMECA: what a procedure of the script adds to matrices and loads at each step of DYNAMIC."""

from typing import Any

from ssilang.kernel.matrices.assembly import vector_to_field
from ssilang.kernel.stepping.driven import Additions, State
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.language.values import Mot, Table
from ssilang.operators.session.user_procedures import call_user
from ssilang.operators.tables.entries import Entries

TERMS = {
    "ADDI_KNL": "stiffness",
    "ADDI_CNL": "damping",
    "ADDI_MATRICE": "operator",
    "ADDI_FNL": "force",
    "ADDI_SECOND": "imposed",
}


class AddedByProcedure:
    """Calls `TCHAR = CHARMECA TAB1 TIME` and reads its table.

    TAB1 . 'ETAT' holds TEMP DEPL VITE ACCE of the start of the step while the procedure runs.
    """

    def __init__(self, entries: Entries) -> None:
        self.entries = entries

    def __call__(self, time: float, state: State, problem: Problem) -> Additions:
        """Additions at `time`."""
        self.entries.table.set(Mot("ETAT"), _table_of(state, problem))
        results = call_user(self.entries.call, "CHARMECA", self.entries.table, time)
        if len(results) != 1 or not isinstance(results[0], Table):
            raise self.entries.error("operators.dynamics.charmeca-gives-a-table")
        found = Entries(self.entries.call, results[0], self.entries.procedure, "TCHAR")
        found.check()
        given: dict[str, Any] = {name: found.get(word) for word, name in TERMS.items()}
        return Additions(**given)


def _table_of(state: State, problem: Problem) -> Table:
    motion = {"DEPL": state.u, "VITE": state.v, "ACCE": state.a}
    fields = {word: vector_to_field(x, problem.numbering) for word, x in motion.items()}
    return Table.of({"TEMP": state.time, **fields})
