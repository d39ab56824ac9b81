"""PERSO1, REEV_MEC: what procedures of the user see of PASAPAS, and what they change of it."""

from ssilang.kernel.elements.results.supports import field_on_model
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.mesh.mesh import same_cells
from ssilang.kernel.stepping.snapshot import Receiver, Snapshot
from ssilang.kernel.stepping.times import nearest
from ssilang.operators.files.saving import save
from ssilang.operators.prelude import *
from ssilang.operators.session.configurations import Configuration
from ssilang.operators.session.user_procedures import StopCalculation, call_user
from ssilang.operators.statics.pasapas_results import ResultTables
from ssilang.operators.tables.entries import Entries

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


PARTS = {
    "MECANIQUE": ("MOD_MEC", "MAT_MEC"),
    "CONTACT": ("MODCONTA", "MATCONTA"),
}
"""Of a formulation: its zones, their characteristics."""
ASKED = ("PROCEDURE_PERSO1", "PROCEDURE_REEV_MEC")
"""Entries that call a procedure after each time."""


def working_table(table: Table) -> Table:
    """WTABLE: the entries in use, which start as those of the table.

    What a script has put there itself, for its own procedures, stays.
    """
    given = table.get("WTABLE")
    kept = given.items() if isinstance(given, Table) and not given.has("FOR0") else []
    pairs = [*kept, *table.items()]
    return Table.of((i, value) for i, value in pairs if i not in ("WTABLE", "ESTIMATION"))


def tell_parts(inner: Table) -> None:
    """What WTABLE holds beside the entries: the model by formulations, the nodes' places."""
    model, material = inner.get("MODELE"), inner.get("CARACTERISTIQUES")
    if not isinstance(model, Model) or not model.zones:
        return
    for formulation, (part, values) in PARTS.items():
        zones = tuple(z for z in model.zones if z.formulation == formulation)
        if zones:
            inner.set(Mot(part), Model(zones))
        # contact without friction has no characteristics
        if isinstance(material, CellField) and any(zone_field(z, material).names for z in zones):
            inner.set(Mot(values), field_on_model(material, Model(zones)))
    inner.set(Mot("MEC1"), inner.has("MOD_MEC"))
    inner.set(Mot("MO_TOT"), model)
    inner.set(Mot("MA_TOT"), material)
    if not inner.has("FOR0"):
        inner.set(Mot("FOR0"), Configuration(model.mesh.nodes.coordinates.copy()))
    if not inner.has("FOR"):
        inner.set(Mot("FOR"), inner.get("FOR0"))


def tell_step(table: Table, time: float) -> None:
    """What WTABLE holds of the step that ends at a time: its number, that time."""
    inner = table.inner("WTABLE")
    asked = inner.get("TEMPS_CALCULES")
    calculated = asked.values[asked.values > 0.0] if isinstance(asked, ListReel) else np.empty(0)
    step = int((calculated <= time + 1e-9 * abs(time)).sum())
    for word, value in (("PAS", step), ("T_FINAL", time), ("CONV", True)):
        inner.set(Mot(word), value)


class Steering(Receiver):
    """Calls REEV_MEC and PERSO1 after each computed time, with the state in ESTIMATION.

    Attributes
    ----------
    wanted : array of bool (n_times,)
        All but the initial time, and that too where REEV_MEC is to prepare the calculation.
    """

    def __init__(
        self, entries: Entries, work: Entries, results: ResultTables, n_times: int, begins: bool
    ) -> None:
        self.call, self.table = entries.call, entries.table
        self.inner, self.results = work.table, results
        self.prepared = work.flag("PROCEDURE_REEV_MEC")
        self.steered = work.flag("PROCEDURE_PERSO1")
        self.moves = work.flag("GRANDS_DEPLACEMENTS")
        self.wanted = np.ones(n_times, bool)
        self.wanted[0] = begins and self.prepared

    def receive(self, snapshot: Snapshot) -> None:
        """One computed time.

        Raises
        ------
        StopCalculation
            When the table's entry ARRET is VRAI.
        ChangedCalculation
            When an entry of WTABLE, or the list of times, is another one after the calls.
        """
        state = Table.of(self.results.values(snapshot))
        self.table.set(Mot("ESTIMATION"), state)
        tell_step(self.table, snapshot.time)
        before = [self.inner.get(word) for word in CHANGEABLE]
        if self.prepared:
            self.table.set(Mot("TT"), state)
            call_user(self.call, "REEV_MEC", self.table, int(snapshot.step > 0))
        moved, at_start = state.get("DEPLACEMENTS"), self.inner.get("FOR0")
        if self.moves and isinstance(moved, NodeField) and isinstance(at_start, Configuration):
            self.inner.set(Mot("FOR"), at_start.moved(moved))
        if self.steered and snapshot.step > 0:
            call_user(self.call, "PERSO1", self.table)
        if self.table.get("ARRET") is True:
            raise StopCalculation
        after = [self.inner.get(word) for word in CHANGEABLE]
        same = all(_is_same(a, b) for a, b in zip(before, after, strict=True))
        if not same or isinstance(self.table.get(TIMES), ListReel):
            tell_parts(self.inner)
            raise ChangedCalculation(snapshot.step)


class SavedTable(Receiver):
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
        and same_cells(a.cells, b.cells)
        for a, b in zip(first.zones, second.zones, strict=True)
    )
