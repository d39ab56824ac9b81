"""ZDYN: the time integration behind the procedure DYNAMIC."""

from ssilang.kernel.base.compiled.cache import is_compiled
from ssilang.kernel.interface.interface import without_zones
from ssilang.kernel.plasticity.points import plastic_zones
from ssilang.kernel.stepping.extremes import Extremes
from ssilang.kernel.stepping.keeping import Cut
from ssilang.kernel.stepping.node_histories import NodeHistories
from ssilang.kernel.stepping.problem.problem import Inputs, Problem, make_problem
from ssilang.kernel.stepping.run import History, integrate
from ssilang.kernel.stepping.snapshot import Observer
from ssilang.operators.dynamics import plausibility
from ssilang.operators.dynamics.charmeca import AddedByProcedure
from ssilang.operators.dynamics.checkpoints import (
    kept_calculation,
    steps_of_reprise,
)
from ssilang.operators.dynamics.histories import TableObserver, forces_table
from ssilang.operators.dynamics.motion_files import (
    csv_observer,
    force_track,
    nodes_asked,
    vtk_observer,
)
from ssilang.operators.dynamics.recording import calculation_record, recorded
from ssilang.operators.dynamics.reports import relative, report
from ssilang.operators.dynamics.scheme_entries import contact_options, scheme_of
from ssilang.operators.dynamics.watching import UpliftWatch, extremes_later, extremes_table
from ssilang.operators.files.outputs import output_path, run_output
from ssilang.operators.prelude import *
from ssilang.operators.session.progress import ProgressLine
from ssilang.operators.statics.bodies import plastic_bodies
from ssilang.operators.statics.solve import first_cells
from ssilang.operators.tables.entries import Entries
from ssilang.operators.workspace import solver_of

if TYPE_CHECKING:
    from ssilang.io.memory_file import MemoryFile
    from ssilang.kernel.plasticity.bulk import Bulk, State

MOST_STEPS = 1e9
"""Steps beyond which a list of times is a slip of the pen."""


@operator("ZDYN", family="dynamics")
def zdyn(call: Call, table: Table = Arg("TABLE", en="table of DYNAMIC")) -> Table:
    """Read the table, integrate, hand back the saved instants."""
    entries = Entries(call, table, "DYNAMIC")
    times, saved = _times(entries)
    inputs = _with_bodies(entries, _inputs(entries, times))
    problem = make_problem(inputs)
    plausibility.warn_of_connections(entries, inputs)
    plausibility.warn_of_loads(entries, inputs.load, times, at_rest=inputs.velocity is None)
    plausibility.warn_at_rest(entries, problem)
    start = plausibility.Start(problem, inputs)
    plausibility.warn_of_start(entries, start)
    make_bodies = plastic_bodies(entries)
    bodies = None if make_bodies is None else make_bodies(problem, inputs)
    plausibility.warn_of_strength(entries, problem)
    asked = nodes_asked(entries, "MAILLAGE_SAUVE", problem)
    whole = bodies is not None or entries.flag("CHARMECA")
    origin = workspace(call.session).origins, (first_cells(inputs.stiffness), None)
    results = TableObserver(NodeHistories(saved, problem=problem, nodes=asked), whole, origin)
    vtk, csv = vtk_observer(entries, problem), csv_observer(entries, problem)
    forces = force_track(entries, problem, saved)
    line = ProgressLine("DYNAMIC", entries.call.session.told)
    record = calculation_record(entries, problem, inputs)
    asked_for = entries.flag("EXTREMES") or record is not None
    extremes = Extremes(problem=problem, asked=asked_for)
    uplift = UpliftWatch.of(problem)
    lists = None if csv is None else csv.track
    given = (results.observer, vtk, lists, forces, extremes, uplift)
    observers = [o for o in given if o is not None]
    observers += [] if record is None else record.observers
    if not is_compiled("stepping"):
        line.note("operators.dynamics.compiling")
    try:
        with recorded(record):
            history = _integrated(entries, problem, observers, line, bodies)
    except BaseException:
        plausibility.warn_of_contact(entries, problem)
        raise
    finally:
        line.close()
    shown = extremes.known and uplift is not None  # macro-elements rock unseen
    off = relative(history.worst_imbalance, history.largest_energy)
    plausibility.warn_of_contact(entries, problem, extremes if shown else None, off)
    if record is not None:
        record.save(history, extremes)
    _say_reduction(entries, history)
    if csv is not None:
        entries.table.set(Mot("RESULTATS_CSV"), csv.table)
    if forces is not None:
        entries.table.set(Mot("RESULTATS_RELATIONS"), forces_table(forces))
    if extremes.known:
        entries.table.set(Mot("RESULTATS_EXTREMES"), extremes_table(extremes))
    elif not whole:
        reduced = history.reduction is not None and history.reduction.vectors
        tolerance, shelf = entries.get("REDUCTION") if reduced else None, memory_file(entries)
        again = partial(_step_again, tolerance, shelf, problem, steps_of_reprise(entries))
        entries.table.set(Mot("RESULTATS_EXTREMES"), extremes_later(problem, again))
    plausibility.warn_of_motion(entries, start, results.track)
    plausibility.warn_of_bowls(entries, problem.interface, results.track)
    if uplift is not None and uplift.left and problem.loading.forces.any():  # else thrown
        entries.warn("operators.dynamics.left-for-good", time=uplift.since, least=uplift.opening)
    report(entries, problem, history, added=entries.flag("CHARMECA"))
    return results.table


def _integrated(
    entries: Entries,
    problem: Problem,
    observers: Sequence[Observer],
    line: ProgressLine,
    bodies: "tuple[Bulk, State] | None" = None,
) -> History:
    """The history, on a reduced basis if REDUCTION gives a tolerance."""
    tolerance, shelf = entries.get("REDUCTION"), memory_file(entries)
    full = entries.flag("NEWTON_COMPLET")
    driver = AddedByProcedure(entries) if entries.flag("CHARMECA") else None
    in_force = {"REDUCTION": tolerance is not None, "CHARMECA": driver is not None}
    refused = [word for word, is_so in in_force.items() if is_so]
    keeper = kept_calculation(entries, problem, observers, refused, bodies)
    if keeper is not None:
        observers = [*observers, keeper]
    if bodies is not None:
        if tolerance is not None:
            raise entries.error("operators.dynamics.reduction-of-plastic-bodies")
        from ssilang.kernel.plasticity.run import run_bulk

        return run_bulk(problem, *bodies, observers, line, dynamic=True, keeper=keeper, full=full)
    if tolerance is None:
        return integrate(problem, observers, line, full, driver, keeper)
    if driver is not None:
        raise entries.error("operators.dynamics.reduction-or-charmeca")
    if full:
        raise entries.error("operators.dynamics.reduction-or-newton")
    from ssilang.kernel.stepping.rests.reduced.run import integrate_reduced

    return integrate_reduced(problem, float(tolerance), observers, line, shelf)


def memory_file(entries: Entries) -> "MemoryFile | None":
    """The ground's memory that MEMOIRE names: all runs of a sweep share it."""
    name, session = entries.get("MEMOIRE"), entries.call.session
    if name is None:
        return None
    if entries.get("REDUCTION") is None:
        raise entries.error("operators.dynamics.memory-without-tolerance")
    path, own = output_path(entries.call, f"{name}.npz"), run_output(session).directory
    if session.shared is not None and path.is_relative_to(own):
        path = session.shared / path.relative_to(own)
    from ssilang.io.memory_file import MemoryFile

    return MemoryFile(path)


def _step_again(
    tolerance: float | None, shelf: "MemoryFile | None", problem: Problem, every: int | None,
    extremes: Extremes,
) -> None:  # fmt: skip
    """The same motion for its largest values, which its loop does not give without cost.

    `every` is that of a kept calculation, whose steps are cut there (None: it was not kept).
    """
    from ssilang.kernel.stepping.rests.reduced.run import integrate_reduced

    if tolerance is None:
        integrate(problem, [extremes], keeper=None if every is None else Cut(every))
    else:
        integrate_reduced(problem, float(tolerance), [extremes], None, shelf)


AMPLIFIED = 10.0
"""How much more than the tolerance a motion may move under loads that are stronger by it."""


def _say_reduction(entries: Entries, history: History) -> None:
    """Warn when a reduction that was asked for was not made, or its estimate is no guide."""
    found = history.reduction
    if found is not None and found.vectors == 0:
        entries.warn("operators.dynamics.reduction-not-used", refused=found.refused)
    elif found is not None and found.swing > AMPLIFIED * (share := entries.get("REDUCTION")):
        told = {"estimate": found.estimate, "swing": found.swing, "share": share}
        entries.warn("operators.dynamics.reduction-amplified", **told)


# ---- what is read ----------------------------------------------------------------------------


def _times(entries: Entries) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Times of the calculation and which of them the table keeps."""
    times = entries.times("TEMPS_CALCULES")
    if times is None:
        return _older_times(entries)
    return times, entries.saved_steps("", times)


def _older_times(entries: Entries) -> tuple[FloatArray, NDArray[np.bool_]]:
    """INST (instants kept), DEBU (start, 0), FREQ (cut-off frequency, dt = 1/(4 FREQ))."""
    instants = entries.get("INST")
    if instants is None:
        entries.needed("TEMPS_CALCULES")
    frequency = entries.get("FREQ")
    wanted = np.asarray(instants.values, dtype=float)
    begin = entries.get("DEBU")
    if begin is None:
        begin = min(0.0, float(wanted[0])) if len(wanted) else 0.0
    stops = wanted if len(wanted) and wanted[0] <= begin else np.concatenate([[begin], wanted])
    if len(stops) < 2 or not (np.diff(stops) > 0.0).all():
        raise entries.error("operators.dynamics.instants-must-increase")
    if frequency is None:
        return stops, np.isin(stops, wanted)
    if float(stops[-1] - stops[0]) * 4 * frequency > MOST_STEPS:
        raise entries.error(
            "operators.dynamics.too-many-steps", frequency=frequency, most_steps=MOST_STEPS
        )
    counts = np.maximum(np.ceil(np.diff(stops) * 4 * frequency * (1 - 1e-9)), 1).astype(int)
    pieces = [
        np.linspace(a, b, n, endpoint=False)
        for a, b, n in zip(stops[:-1], stops[1:], counts, strict=True)
    ]
    times = np.concatenate([*pieces, stops[-1:]])
    return times, np.isin(times, wanted)


def _inputs(entries: Entries, times: FloatArray) -> Inputs:
    get = entries.get
    return Inputs(
        entries.needed("RIGI"), times, get("MASS"), get("AMOR"), get("CHAR"), get("DEPL"),
        get("VITE"), get("MODELE"), get("CARACTERISTIQUES"), scheme_of(entries),
        contact_options(entries), solver=solver_of(entries.call.session),
    )  # fmt: skip


def _with_bodies(entries: Entries, inputs: Inputs) -> Inputs:
    """The stiffness without that of plastic bodies: their law replaces it."""
    zones = plastic_zones(inputs.model)
    if not zones:
        return inputs
    from ssilang.kernel.plasticity.bulk import stiffness_beside

    material = entries.needed("CARACTERISTIQUES")
    stiffness = without_zones(inputs.stiffness, zones)
    blocks = (*stiffness.blocks, *(stiffness_beside(z, material) for z in zones))
    return replace(inputs, stiffness=replace(stiffness, blocks=blocks, cache={}))
