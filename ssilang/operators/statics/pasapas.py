"""ZPAS: the load steps behind the procedure PASAPAS."""

from ssilang.kernel.elements.families import mass, stiffness, viscosity
from ssilang.kernel.elements.loads.thermal import refuse_expanding
from ssilang.kernel.elements.springs import is_impedance, law_of_impedance
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.interface import joint_zones
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.plasticity.bulk import stiffness_beside, without_stiffness
from ssilang.kernel.plasticity.points import is_plastic, plastic_zones
from ssilang.kernel.statics.stepping import step_statics
from ssilang.kernel.statics.thermal_load import (
    check_strains,
    loaded_sides,
    pressures,
    split_strains,
    with_pressures,
)
from ssilang.kernel.stepping.problem.problem import Inputs, Problem, make_problem
from ssilang.kernel.stepping.run import integrate
from ssilang.kernel.stepping.snapshot import Observer
from ssilang.operators.dynamics import plausibility
from ssilang.operators.dynamics.checkpoints import kept_calculation
from ssilang.operators.dynamics.recording import calculation_record, recorded
from ssilang.operators.dynamics.reports import report
from ssilang.operators.dynamics.scheme_entries import contact_options, scheme_of
from ssilang.operators.modal.stepped_links import stepped_links
from ssilang.operators.prelude import *
from ssilang.operators.session.progress import ProgressLine
from ssilang.operators.session.user_procedures import StopCalculation
from ssilang.operators.statics.bodies import (
    Bodies,
    finite_bodies,
    finite_zones,
    plastic_bodies,
    warn_of_confinement,
    warn_of_strains,
)
from ssilang.operators.statics.pasapas_charmeca import loaded_bodies, pressure_law, procedure_law
from ssilang.operators.statics.pasapas_contact import (
    joined_matrix,
    linear_blocks,
    offset_load,
    sides_of,
)
from ssilang.operators.statics.pasapas_materials import offsets_of
from ssilang.operators.statics.pasapas_results import RESULTS, ResultTables, Stresses
from ssilang.operators.statics.pasapas_stages import Reached, Stage, entering, loads_taken, stage_of
from ssilang.operators.statics.pasapas_steering import (
    ASKED,
    ChangedCalculation,
    SavedTable,
    Steering,
    tell_parts,
    working_table,
)
from ssilang.operators.statics.path_following import control_asked, driven_parts, follow
from ssilang.operators.statics.solve import NOT_SMALL, far, is_anywhere, warn_of_weight
from ssilang.operators.statics.temperatures import warn_of_temperatures
from ssilang.operators.tables.entries import Entries
from ssilang.operators.workspace import solver_of

if TYPE_CHECKING:
    from ssilang.kernel.plasticity.run import BulkRun


@operator("ZPAS", family="statics")
def zpas(call: Call, table: Table = Arg("TABLE", en="table of PASAPAS")) -> None:
    """Read the table, step through the times, fill the tables of results."""
    entries = Entries(call, table, "PASAPAS")
    start = start_of(entries)
    times, saved = _times(entries, start)
    work = loads_taken(entries)
    plausibility.warn_of_loads(entries, work.get("CHARGEMENT"), times)
    if not start.index:
        warn_of_temperatures(work, times)
    entries.table.set(Mot("CONV"), False)
    entries.table.set(Mot("ERREUR"), True)
    if work.has("MODELE") and stepped_links(entries, times, saved, start.index):
        entries.table.set(Mot("CONV"), True)
        entries.table.set(Mot("ERREUR"), False)
        return
    inner = working_table(work.table)
    tell_parts(inner)
    entries.table.set(Mot("WTABLE"), inner)
    if any(entries.flag(word) for word in (*ASKED, "PROCEDURE_CHARMECA")):
        work = Entries(call, inner, "PASAPAS")
    start = replace(start, before=stage_of(work, times[[0, 0]]).entries)
    try:
        while len(times) > 1:
            stage = stage_of(work, times)
            before = Entries(call, working_table(stage.entries.table), "PASAPAS")
            part = slice(0, stage.steps + 1)
            number = start.index if start.reached is None else _last_number(entries)
            try:
                ends = len(times) - 1 == stage.steps
                state = _stretch(
                    entries, work, _entering(start, stage), stage, times[part], saved[part], number
                )
                _say_model(entries, work, stage, number)
                if ends:
                    break
                step, changed = stage.steps, False
            except ChangedCalculation as change:
                state, step, changed = entries.get("ESTIMATION"), change.step, True
            start, times, saved = _onward(entries, work, times, saved, step, state, before)
            if changed:
                times, saved = _other_times(entries, times, saved)
    except StopCalculation:
        pass
    _say_last(entries, _last_number(entries))
    entries.table.set(Mot("CONV"), True)
    entries.table.set(Mot("ERREUR"), False)


def _stretch(
    entries: Entries,
    work: Entries,
    start: "Start",
    stage: Stage,
    times: FloatArray,
    saved: NDArray[np.bool_],
    number: int,
) -> Table:
    """Steps of one stage; the state at their end."""
    from ssilang.kernel.plasticity.run import run_bulk

    given, dynamic = stage.entries, work.flag("DYNAMIQUE")
    inputs, stresses = _inputs(given, start, times, dynamic)
    finite = finite_zones(given)
    bodies = finite_bodies(given, finite, start) if finite else plastic_bodies(given, start)
    load: Load | None = given.get("CHARGEMENT")
    follows = load if finite and pressures(load) else None
    if follows is not None:
        law = pressure_law(follows, loaded_sides(given.get("MODELE")))
        bodies = loaded_bodies(law, "pressures that follow", bodies)
    if work.flag("PROCEDURE_CHARMECA"):
        bodies = loaded_bodies(procedure_law(entries), "loads by a procedure", bodies)
    problem = make_problem(inputs)
    if bodies is None and not control_asked(work) and stage.entries is work:
        plausibility.warn_of_connections(work, inputs)
        plausibility.warn_of_start(
            work, plausibility.Start(problem, inputs), in_statics=not dynamic
        )
    elif start.reached is None:
        plausibility.warn_of_bodies(work, inputs)
    if start.reached is None:
        plausibility.warn_of_parts(work, problem, inputs)
    model: Model | None = given.get("MODELE")
    zones = () if model is None else model.zones
    axis = "UZ" if "UZ" in problem.numbering.unknowns else "UY"
    if not dynamic and axis in problem.numbering.unknowns:
        rows = problem.numbering.where(axis)
        pressing = -problem.loading.forces[rows] @ problem.loading.at(times[-1:])[0]
        nodes = problem.numbering.nodes[rows]
        warn_of_weight(entries.call, inputs.stiffness, zones, nodes, pressing)
    asked = given.inside("MES_SAUVEGARDES")
    kept = finite or (asked is not None and asked.flag("DEFTO"))
    strained = given.needed("CARACTERISTIQUES") if kept else None
    results = ResultTables(
        entries.table, saved, stresses, dynamic, number, zones, strained, given.get("CHARGEMENT"),
        bool(finite),
    )  # fmt: skip
    reached = Reached(results, len(times))
    observers: list[Observer] = [results, reached]
    if (saves := work.get("TEMPS_SAUVEGARDES")) is not None:
        observers.append(SavedTable(entries.call, entries.table, times, saves.values))
    steered = any(work.flag(word) for word in ASKED)
    if steered:
        begins = start.reached is None
        observers.append(Steering(entries, work, results, len(times), begins))
    record = calculation_record(entries, problem, inputs)
    observers += [] if record is None else record.observers
    path = control_asked(work)
    made = None if bodies is None or path else bodies(problem, inputs)
    keeper = kept_calculation(entries, problem, observers, _not_kept(work), made)
    if keeper is not None:
        observers.append(keeper)
    line = ProgressLine("PASAPAS", entries.call.session.told)
    try:
        (plausibility.warn_of_strength if dynamic else plausibility.warn_contrast)(work, problem)
        if dynamic:
            plausibility.warn_of_contact(work, problem)
        with recorded(record):
            if path:
                history = follow(entries, _path_run(problem, inputs, bodies, observers))
            elif made is not None:
                if not dynamic:
                    warn_of_confinement(work, problem, *made)
                full = work.flag("NEWTON_COMPLET")
                history = run_bulk(problem, *made, observers, line, dynamic, keeper, full)
            elif dynamic:
                full = work.flag("NEWTON_COMPLET")
                history = integrate(problem, observers, line, full, keeper=keeper)
            else:
                history = step_statics(problem, observers, line, keeper)
    finally:
        line.close()
    if record is not None:
        record.save(history)
    if not dynamic or finite:
        warn_of_strains(given, reached.values.get("DEPLACEMENTS"))
    moved = reached.values.get("DEPLACEMENTS")
    told = dynamic or entries.call.session.warned("operators.dynamics.load-on-supports")
    stays = moved is not None and not problem.contact and not (told or is_anywhere(moved))
    if stays and _pushes(load, float(times[-1])):
        entries.warn("operators.statics.nothing-moves")
    judged = not finite and not dynamic and not all(map(is_joint, zones))  # whose size is none
    for told in far(moved, NOT_SMALL) if moved is not None and judged else ():
        entries.warn("operators.statics.moves-far", operator="PASAPAS", **told)
    added = follows is not None or work.flag("PROCEDURE_CHARMECA")
    report(entries, problem, history, in_statics=not dynamic, added=added)
    return Table.of(reached.values)


def _pushes(load: Load | None, time: float) -> bool:
    """Whether forces or pressures act at a time."""
    parts = () if load is None else load.parts
    curves = (p.time for p in parts if p.name.strip() in ("MECA", "PRES"))
    return any(c is not None and c.at(time) != 0.0 for c in curves)


def _not_kept(work: Entries) -> list[str]:
    """Entries in force whose calculation REPRISE cannot keep."""
    words = (*ASKED, "PROCEDURE_CHARMECA", "AUTOMATIQUE", "PILOTAGE_INDIRECT")
    return [word for word in words if work.flag(word)]


def _entering(start: "Start", stage: Stage) -> "Start":
    """The start of a stage, with what the cells that come bring."""
    if start.reached is None:
        return start
    model: Model | None = stage.entries.get("MODELE")
    state = entering(start.reached.table, model)
    return replace(start, reached=Entries(stage.entries.call, state, "PASAPAS", "TAB1.ESTIMATION"))


def _onward(
    entries: Entries,
    work: Entries,
    times: FloatArray,
    saved: NDArray[np.bool_],
    step: int,
    state: Table,
    before: Entries,
) -> "tuple[Start, FloatArray, NDArray[np.bool_]]":
    """Where it goes on from a state reached at a step: start, times, which are saved."""
    rest, kept = times[step:], saved[step:].copy()
    kept[0] = False  # it stands in the tables already if it was to be kept
    reached = Entries(entries.call, state, "PASAPAS", "TAB1.ESTIMATION")
    return Start(_last_number(entries), float(rest[0]), work, reached, before), rest, kept


def _other_times(
    entries: Entries, times: FloatArray, saved: NDArray[np.bool_]
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """The times that the user's procedure asks for, if it does."""
    listed = entries.get("A_CALCULER")
    if listed is None:
        return times, saved
    times = np.concatenate([times[:1], listed.values[listed.values > times[0]]])
    entries.table.remove("A_CALCULER")
    chosen = entries.get("TEMPS_SAUVES")
    saved = np.ones(len(times), bool)
    if chosen is not None and len(times) > 1:
        later = (chosen.values > times[0]) & (chosen.values <= times[-1])
        saved = entries.nearest("TEMPS_SAUVES", times, chosen.values[later])
    saved[0] = False
    return times, saved


def _path_run(
    problem: Problem, inputs: Inputs, bodies: Bodies | None, observers: list[Observer]
) -> "BulkRun":
    """A calculation along a path, at its start."""
    from ssilang.kernel.plasticity.following import no_bodies
    from ssilang.kernel.plasticity.run import BulkRun

    bulk, state = (no_bodies(problem), ()) if bodies is None else bodies(problem, inputs)
    return BulkRun(problem, bulk, state, tuple(observers))


def _last_number(entries: Entries) -> int:
    """The number after the last result."""
    return max(entries.numbers("TEMPS"), default=-1) + 1


def _say_model(entries: Entries, work: Entries, stage: Stage, first: int) -> None:
    """Table MODELES: the model of each result from number `first` on, where it changes."""
    if stage.entries.get("MODELE") is work.get("MODELE"):
        return
    models = entries.table.inner("MODELES")
    for number in range(first, _last_number(entries)):
        models.set(number, stage.entries.get("MODELE"))


def _say_last(entries: Entries, number: int) -> None:
    """Table CONTINUATION: the last results, from which a further call goes on."""
    last = Table()
    for word in RESULTS:
        inner = entries.table.get(Mot(word))
        if isinstance(inner, Table) and inner.has(number - 1):
            last.set(Mot(word), inner.get(number - 1))
    entries.table.set(Mot("CONTINUATION"), last)


@dataclass(frozen=True)
class Start:
    """Where a calculation begins: number of the result it goes on from, time, initial state.

    `reached`, where given, holds that state itself, by the words of the results, and `before` what
    led to it.
    """

    index: int
    time: float | None
    entries: Entries
    reached: Entries | None = None
    before: Entries | None = None

    def of(self, word: str) -> Any:
        """The result of this number, None if there is none."""
        if self.reached is not None:
            return self.reached.get(word)
        return self.entries.at(word, self.index)


def start_of(entries: Entries) -> Start:
    """The last result in the table, or that of time REPRISE: later ones are removed."""
    numbers = [
        i
        for word in ("TEMPS", "DEPLACEMENTS", "CONTRAINTES", "VARIABLES_INTERNES", "VITESSES")
        for i in entries.numbers(word)
    ]
    again = entries.get("REPRISE")
    if again is None or isinstance(again, Table):  # a table: how the calculation is kept
        index = max(entries.numbers("TEMPS") or numbers, default=0)
    else:
        times = {i: entries.at("TEMPS", i) for i in entries.numbers("TEMPS")}
        if not times:
            raise entries.error("operators.statics.no-results-to-go-on-from")
        index = min(times, key=lambda i: abs(times[i] - again))
        if abs(times[index] - again) > 1e-9 * max(abs(again), 1e-9):
            raise entries.error(
                "operators.statics.no-result-at-time", again=again, times=times[index]
            )
        entries.forget_after(index)
    return Start(index, entries.at("TEMPS", index), entries)


def _times(entries: Entries, start: Start) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Times with the initial one first, and which are saved (the initial one always)."""
    if not entries.has("TEMPS_SAUVES"):
        entries.needed("TEMPS_CALCULES")
    index = "TEMPS_CALCULES" if entries.has("TEMPS_CALCULES") else "TEMPS_SAUVES"
    given = entries.needed(index)
    wanted = np.asarray(given.values, dtype=float)
    first = start.time
    if first is None:
        first = min(0.0, float(wanted[0])) if len(wanted) else 0.0
    times = np.concatenate([[float(first)], wanted[wanted > first]])
    if len(times) < 2:
        raise entries.error("operators.statics.no-time-after-start", index=index, first=first)
    entries.increasing(index, times)
    chosen = entries.get("TEMPS_SAUVES")
    if chosen is None:
        return times, np.ones(len(times), bool)
    later = chosen.values[(chosen.values > first) & (chosen.values <= times[-1])]
    saved = entries.nearest("TEMPS_SAUVES", times, later)
    saved[0] = True
    return times, saved


def _inputs(
    entries: Entries, start: Start, times: FloatArray, dynamic: bool
) -> tuple[Inputs, Stresses]:
    material: CellField | None = entries.get("CARACTERISTIQUES")
    model: Model | None = entries.get("MODELE")
    linear = _linear_zones(entries)
    solids = [(z, m) for z, m in linear if not is_joint(z)]
    pressed = () if model is None else loaded_sides(model)
    forces = with_pressures(entries.get("CHARGEMENT"), pressed, bool(finite_zones(entries)))
    bodies = [z for z in model.zones if z.formulation == "MECANIQUE"] if model is not None else []
    check_strains(forces, tuple(bodies), bool(finite_zones(entries)))
    load, thermal = split_strains(forces, linear)
    if forces and any(p.name.strip() == "T" for p in forces.parts):
        refuse_expanding([z for z in bodies if is_joint(z) and not _is_linear(z)], material)
    displacement = start.of("DEPLACEMENTS")
    stresses = Stresses(linear, thermal)
    given = start.of("CONTRAINTES")
    if isinstance(given, CellField):
        old = entries if start.before is None else start.before
        before = [(z, old.get("CARACTERISTIQUES")) for z, _ in linear]
        loads = (forces, old.get("CHARGEMENT"))
        now = float(times[0])
        stresses.offsets = offsets_of(linear, before, loads, given, displacement, now)
        parts = offset_load(stresses.offsets, linear)
        load = Load((*(load.parts if load else ()), *(LoadPart("MECA", f) for f in parts)))
    blocks = linear_blocks(solids, "RIGIDITE", stiffness)
    finite = finite_zones(entries)
    yielding = tuple(z for z in plastic_zones(model) if z not in finite)
    blocks += [without_stiffness(z) for z in finite]
    if material is not None:
        blocks += [stiffness_beside(z, material) for z in yielding]
    heavy = linear_blocks(solids, "MASSE", mass) if dynamic else []
    if dynamic and material is not None:
        heavy += [mass(z, material) for z in (*yielding, *finite)]
    sides = sides_of(model, material, stresses.offsets)
    zones = () if model is None else model.zones
    if sides.matrix is None and any(z.formulation == "CONTACT" for z in zones):
        entries.warn("operators.statics.sides-apart")
    more = [] if sides.gaps is None else [LoadPart("MECA", sides.gaps)]
    more += driven_parts(entries)
    if more:
        load = Load((*(load.parts if load else ()), *more))
    constant = entries.get("RIGIDITE_CONSTANTE")
    supports = entries.get("BLOCAGES_MECANIQUES")
    masses: Matrix | None = None
    if dynamic:
        masses = joined_matrix(entries, heavy, (entries.get("MASSE_CONSTANTE"),), "MASSE")
    stiffnesses = joined_matrix(entries, blocks, (constant, supports, sides.matrix), "RIGIDITE")
    damping, velocity = entries.get("AMORTISSEMENT"), start.of("VITESSES")
    if dashpots := _dashpots_of_laws(solids, damping):
        damping = joined_matrix(entries, dashpots, (damping,), "AMORTISSEMENT")
        if not dynamic:
            entries.warn("operators.statics.dashpots-at-rest")
    inputs = Inputs(
        stiffnesses, times, masses, damping if dynamic else None, load, displacement,
        velocity if dynamic else None, model, material, scheme_of(entries),
        contact_options(entries, dynamic), start.of("VARIABLES_INTERNES"), sides.friction,
        solver_of(entries.call.session), _inside(entries, start),
    )  # fmt: skip
    return inputs, stresses


def _inside(entries: Entries, start: Start) -> tuple[CellField | None, CellField | None] | None:
    """Inelastic strains and stresses at the start, where displacements do not say all."""
    strains, stresses = start.of("DEFORMATIONS_INELASTIQUES"), start.of("CONTRAINTES")
    if strains is None and (stresses is None or start.of("DEPLACEMENTS") is not None):
        return None
    model: Model | None = entries.get("MODELE")
    for zone in joint_zones(model) if model is not None else ():
        held = zone_field(zone, stresses)
        unread = not _is_linear(zone) and law_of(zone.behaviour).code != LawCode.MOHR
        if unread and any(held.at(name, "STRESSES").any() for name in held.names):
            entries.warn("operators.statics.joint-stress-unread", law=zone.behaviour[-1])
    return strains, stresses


def _dashpots_of_laws(
    zones: list[tuple[Zone, CellField]], damping: Matrix | None
) -> list[ElementMatrices]:
    """Dashpots of impedances VOIGT and REUSS, but those that the damping already holds."""
    held = [(b.raw_nodes, b.unknowns) for b in damping.blocks] if damping is not None else []
    made = [
        viscosity(z, m)
        for z, m in zones
        if is_impedance(z) and law_of_impedance(z) in ("VOIGT", "REUSS")
    ]
    return [
        block
        for block in made
        if not any(block.unknowns == u and np.array_equal(block.raw_nodes, n) for n, u in held)
    ]


def _linear_zones(entries: Entries) -> list[tuple[Zone, CellField]]:
    """Zones of MODELE whose stiffness says all, with the characteristics."""
    model: Model | None = entries.get("MODELE")
    if model is None:
        return []
    material = entries.needed("CARACTERISTIQUES")
    finite = finite_zones(entries)
    mechanical = (z for z in model.zones if z.formulation == "MECANIQUE" and z not in finite)
    return [(z, material) for z in mechanical if _is_linear(z)]


def _is_linear(zone: Zone) -> bool:
    return law_of(zone.behaviour).linear if is_joint(zone) else not is_plastic(zone)
