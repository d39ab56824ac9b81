"""PASAPAS on modes with links: models MODAL and LIAISON, which DYNE steps."""

from ssilang.kernel.modal.explicit import ModalSteps
from ssilang.kernel.modal.shape_models import is_shape
from ssilang.operators.modal.dyne import results_of_models
from ssilang.operators.modal.dyne_models import is_link
from ssilang.operators.prelude import *
from ssilang.operators.statics.pasapas_results import put_results
from ssilang.operators.tables.entries import Entries


def stepped_links(
    entries: Entries, times: FloatArray, saved: NDArray[np.bool_], first: int
) -> bool:
    """Step and fill the tables of results where MODELE has links; else nothing, and False.

    `first` is the number of the result that it goes on from, which stays. The results of a link
    asked for (SORT) stand in VARIABLES_INTERNES, a table at SLIA: their value at the instant, in
    that of the first step also that of the start, which fields of an initial state have not.
    """
    model: Model | None = entries.get("MODELE")
    if model is None or not any(is_link(z) for z in model.zones):
        return False
    if any(z.formulation == "MECANIQUE" and not is_shape(z) for z in model.zones):
        raise entries.error("operators.statics.links-are-of-modes")
    if not entries.flag("DYNAMIQUE"):
        raise entries.error("operators.statics.links-want-dynamics")
    gaps = np.diff(times)
    if np.ptp(gaps) > 1e-6 * gaps[0]:
        raise entries.error("operators.statics.links-want-equal-steps")
    plan = ModalSteps(float(gaps[0]), len(gaps), begin=float(times[0]))
    reached = entries.get("REPRISE_DYNE") if first else None
    if first and not _stands_at(reached, times[0]):
        raise entries.error("operators.statics.links-go-on-from-the-last", time=times[0])
    results, named = results_of_models(entries.call, entries, plan, reached)
    for number, step in enumerate(np.flatnonzero(saved), start=first):
        entry = results.get(int(step) + 1)
        assert isinstance(entry, Table)
        of_links = {
            id(z): _at_step(results.get(k), int(step), begun=number == step == 1)
            for z, _, k in named
        }
        blocks = tuple(_block(z, of_links.get(id(z))) for z in model.zones)
        values = {
            "TEMPS": float(times[step]),
            "DEPLACEMENTS": entry.get(Mot("DEPLACEMENT")),
            "VITESSES": entry.get(Mot("VITESSE")),
            "VARIABLES_INTERNES": CellField(blocks, "VARIABLES INTERNES"),
        }
        put_results(entries.table, number, values, keep=step == 0)
    entries.table.set(Mot("REPRISE_DYNE"), results.get(Mot("REPRISE")))
    return True


def _stands_at(reached: Table | None, time: float) -> bool:
    """Whether a state to go on from is that of an instant."""
    kept = None if reached is None else reached.get(Mot("TEMPS"))
    return isinstance(kept, float) and abs(kept - time) <= 1e-9 * max(abs(time), 1e-9)


def _at_step(lists: object, step: int, begun: bool) -> Table | None:
    """Results of a link at one step, and at the start where it has begun: lists, tables."""
    if not isinstance(lists, Table):
        return None
    made, rows = Table(), [0, step] if begun else [step]
    for index, values in lists.items():
        if isinstance(values, ListReel):
            made.set(index, ListReel(values.values[rows]))
        elif isinstance(values, Table):
            made.set(index, Table.numbered(values.get(row + 1) for row in rows))
    return made


def _block(zone: Zone, results: Table | None) -> CellFieldBlock:
    """The cells of a zone with the results of its link."""
    values = {}
    if results is not None:
        column = np.empty((len(zone.cells), 1), dtype=object)
        column[:] = results
        values["SLIA"] = column
    return zone.block(values, "GRAVITE")
