"""Loads on a structure followed along the arc length; ZCON: both problems of CONTINU."""

import time

from ssilang.kernel.matrices.assembly import vector_to_field
from ssilang.kernel.plasticity.driven_load import ArcTrace, follow_arc, history_of
from ssilang.kernel.stepping.problem.problem import Problem, make_problem
from ssilang.operators.curves.instants import value_in_time
from ssilang.operators.dynamics.reports import report
from ssilang.operators.modal.continuation import continue_harmonics, lengths_of
from ssilang.operators.modal.hbm import asked_results, curve
from ssilang.operators.prelude import *
from ssilang.operators.statics.bodies import finite_bodies, finite_zones, plastic_bodies
from ssilang.operators.statics.pasapas import _inputs, _path_run, start_of
from ssilang.operators.statics.pasapas_results import ResultTables
from ssilang.operators.tables.entries import Entries

REFUSED = {
    "PROCEDURE_CHARMECA": "operators.statics.no-followers",
    "DYNAMIQUE": "operators.statics.static-path",
}


def continue_loads(entries: Entries) -> None:
    """Follow the path of loads and fill the tables."""
    entries.refuse(REFUSED)
    lengths, begun = lengths_of(entries), time.perf_counter()
    times = np.asarray(entries.needed("TEMPS_CALCULES").values, dtype=float)
    start = start_of(entries)
    if start.time is not None and start.time > times[0]:
        raise entries.error("operators.statics.path-begins-at-first-time")
    inputs, stresses = _inputs(entries, start, times, False)
    finite = finite_zones(entries)
    bodies = finite_bodies(entries, finite, start) if finite else plastic_bodies(entries, start)
    problem = make_problem(inputs)
    most = entries.get("MAXIPAS")
    every = entries.get("PAS_SAUVES")
    model: Model | None = entries.get("MODELE")
    zones = () if model is None else model.zones
    saved = np.ones(len(times), bool)
    results = ResultTables(
        entries.table, saved, stresses, False, start.index, zones, load=entries.get("CHARGEMENT")
    )
    rate = _rate(entries, problem, times)
    words = _stability(entries)
    path, trace = follow_arc(
        _path_run(problem, inputs, bodies, [results]), rate, lengths,
        lambda t: bool(t < times[-1]), most, every, "DIAG" in words,
    )  # fmt: skip
    history = history_of(path, trace, time.perf_counter() - begun)
    report(entries, problem, history, in_statics=True)
    _fill(entries, trace, problem)


def _rate(entries: Entries, problem: Problem, times: FloatArray) -> FloatArray:
    """Change of the load factors in a unit of time, the same all along."""
    factors = problem.loading.at(times)
    rate = (factors[-1] - factors[0]) / (times[-1] - times[0])
    straight = factors[0] + np.outer(times - times[0], rate)
    if np.abs(factors - straight).max(initial=0.0) > 1e-9 * np.abs(factors).max(initial=1e-300):
        raise entries.error("operators.statics.load-not-straight")
    if not rate.any():
        raise entries.error("operators.statics.load-does-not-change")
    return np.asarray(rate)


def _stability(entries: Entries) -> list[str]:
    given = entries.get("STABILITE")
    words = [w.strip() for w in given.values] if isinstance(given, ListMots) else []
    wrong = [w for w in words if w != "DIAG"]
    if wrong:
        raise entries.error("operators.statics.stability-for-harmonic-balance", wrong=wrong[0])
    return ["DIAG"] if given is True else words


def _fill(entries: Entries, trace: ArcTrace, problem: Problem) -> None:
    table = entries.table
    table.set(Mot("TEMPS_PROG"), ListReel(np.array(trace.times)))
    if trace.negative:
        inner = {"DIAG": ListReel(np.array(trace.negative))}
        table.set(Mot("RESULTATS_STABILITE"), Table.of(inner))
    x = np.array(trace.times)
    fields = [vector_to_field(u, problem.numbering) for u in trace.motions]
    for asked in asked_results(entries, "RESULTATS"):
        y = value_in_time(entries.call, fields, asked.component, asked.point.node)
        asked.table.set(Mot("RESULTATS"), ListReel(y))
        drawn = curve(x, y, ("t", asked.component), asked.title, asked.colour)
        asked.table.set(Mot("RESULTATS_EVOL"), drawn)


@operator("ZCON", family="modal")
def zcon(call: Call, table: Table = Arg("TABLE", en="table of CONTINU")) -> None:
    """Harmonic balance where 'HBM' says so, else loads on a structure."""

    entries = Entries(call, table, "CONTINU")
    (continue_harmonics if entries.flag("HBM") else continue_loads)(entries)
