"""PERSO1: what the user's procedure sees of a calculation of PASAPAS, and what it changes of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.materials.model import Model
from ssilang.kernel.stepping.times import nearest
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel, Mot, Table
from ssilang.operators.files.saving import save
from ssilang.operators.session.user_procedures import StopCalculation, call_user
from ssilang.operators.statics.pasapas_results import ResultTables

if TYPE_CHECKING:
    from ssilang.kernel.stepping.snapshot import Snapshot

CHANGEABLE = (
    "MODELE", "CARACTERISTIQUES", "BLOCAGES_MECANIQUES", "CHARGEMENT", "RIGIDITE_CONSTANTE",
    "MASSE_CONSTANTE", "AMORTISSEMENT",
)  # fmt: skip
"""Entries of WTABLE that the procedure may replace."""
TIMES = "A_CALCULER"


class ChangedCalculation(Exception):
    """The user's procedure changed what is calculated; `step` is the last one done."""

    def __init__(self, step: int) -> None:
        super().__init__(step)
        self.step = step


def working_table(table: Table) -> Table:
    """WTABLE: the entries in use, which start as those of the table."""
    work = Table()
    for index, value in table.items():
        if index not in ("WTABLE", "ESTIMATION"):
            work.set(index, value)
    return work


class Steering:
    """Calls PERSO1 after each computed time, with the state in ESTIMATION.

    Attributes
    ----------
    wanted : array of bool (n_times,)
        All but the initial time.
    """

    def __init__(
        self, call: Call, table: Table, work: Table, results: ResultTables, n_times: int
    ) -> None:
        self.call, self.table, self.work, self.results = call, table, work, results
        self.wanted = np.ones(n_times, bool)
        self.wanted[0] = False

    def receive(self, snapshot: Snapshot) -> None:
        """One computed time.

        Raises
        ------
        StopCalculation
            When the table's entry ARRET is VRAI.
        ChangedCalculation
            When an entry of WTABLE, or the list of times, is another one after the call.
        """
        self.table.set(Mot("ESTIMATION"), state_table(self.results.values(snapshot)))
        before = [self.work.get(word) for word in CHANGEABLE]
        call_user(self.call, "PERSO1", self.table)
        if self.table.get("ARRET") is True:
            raise StopCalculation
        after = [self.work.get(word) for word in CHANGEABLE]
        same = all(_is_same(a, b) for a, b in zip(before, after, strict=True))
        if not same or isinstance(self.table.get(TIMES), ListReel):
            raise ChangedCalculation(snapshot.step)

    def close(self) -> None:
        """Nothing to do."""


class SavedTable:
    """Writes the table by SAUV after the times of TEMPS_SAUVEGARDES."""

    def __init__(self, call: Call, table: Table, times: FloatArray, wanted: FloatArray) -> None:
        self.call, self.table = call, table
        inside = wanted[(wanted > times[0]) & (wanted <= times[-1])]
        self.wanted = nearest(times, inside)

    def receive(self, snapshot: Snapshot) -> None:
        """One time: its results stand in the table already."""
        root = self.call.session.root
        name = next((n for n in root.names() if root.find(n) is self.table), "TAB1")
        save(self.call, [(name, self.table)])

    def close(self) -> None:
        """Nothing to do."""


def state_table(values: dict[str, Any]) -> Table:
    """Table of a state by the words of the results."""
    state = Table()
    for word, value in values.items():
        state.set(Mot(word), value)
    return state


def _is_same(first: Any, second: Any) -> bool:
    """Whether two entries say the same; models made anew on the same cells do."""
    if first is second:
        return True
    if not (isinstance(first, Model) and isinstance(second, Model)):
        return False
    if len(first.zones) != len(second.zones):
        return False
    return all(
        (a.element, a.behaviour, a.mode, a.formulation)
        == (b.element, b.behaviour, b.mode, b.formulation)
        and np.array_equal(a.cells.connectivity, b.cells.connectivity)
        for a, b in zip(first.zones, second.zones, strict=True)
    )
