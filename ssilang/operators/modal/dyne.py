"""DYNE: time stepping on modes, with shocks, friction, plastic links and couplings."""

from ssilang.kernel.matrices.assembly import Numbering, assemble, field_to_vector, numbering_of
from ssilang.kernel.modal import explicit
from ssilang.kernel.modal.link_laws import STATES
from ssilang.kernel.modal.modes import eigenvalue
from ssilang.kernel.stepping.problem.loading import loading_of
from ssilang.operators.modal.basis import shapes_in
from ssilang.operators.modal.dyne_links import Basis, ReadLink, link_results, links_of
from ssilang.operators.modal.dyne_models import links_table, modal_table, wanted_of
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

BASES = ("BASE_MODALE", "BASE_DE_MODES", "ENSEMBLE_DE_BASES")
_ROLES = {
    "TBAS1": "system", "TRIGMASS": "system", "TAMOR": "damping", "TLIAI": "links",
    "TCHAR": "loads", "TINIT": "start", "TSORT": "output",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class System:
    """Stiffness and mass (n, n) on the unknowns of the modes, and their numbering."""

    basis: Basis
    numbering: Numbering
    K: FloatArray
    M: FloatArray

    def field(self, values: FloatArray, dual: bool = False) -> NodeField:
        """A field ALFA and BETA (or FALF, FBET) of values (n,)."""
        names = self.numbering.duals if dual else self.numbering.unknowns
        parts = {}
        for code, name in enumerate(names):
            own = self.numbering.codes == code
            if own.any():
                parts[name] = NodeValues(self.numbering.nodes[own], values[own])
        return NodeField(self.numbering.table, parts, "DIFFUS")


TABLES = many("given", "TABLE", en="basis, links, damping, loads ...")


@operator("DYNE", family="modal")
def _dyne(
    call: Call,
    scheme: str = Choice(explicit.SCHEMES, optional=False, en="how time is stepped"),
    given: tuple[Table, ...] = TABLES,
    steps: int = Arg("ENTIER", range=POSITIVE, en="number of steps"),
    h: float = Arg("FLOTTANT", range=POSITIVE, en="time step", unit="s"),
    every: int = Opt(
        "ENTIER", range=POSITIVE, default=1, en="one step of so many is kept, all without it"
    ),
) -> Table:
    tables = tables_by_role(call, given, _ROLES)
    if "system" not in tables:
        raise call.error("operators.modal.dyne-wants-table-base")
    system = system_of(call, tables["system"])
    if tables.keys().isdisjoint(("start", "loads", "links")):
        call.warn("operators.modal.nothing-moves")
    damping = damping_of(call, tables.get("damping"), system)
    return _integrated(call, tables, system, damping, explicit.ModalSteps(h, steps, every, scheme))


def _integrated(
    call: Call,
    tables: dict[str, Table],
    system: System,
    damping: FloatArray,
    steps: explicit.ModalSteps,
) -> Table:
    """The table of results of a run."""
    links, arrays = links_of(call, tables.get("links"), system.basis)
    start = _start(call, tables.get("start"), system, len(arrays.kinds), steps)
    # Forces on the modes (p, n) and their values at each half step (p, 2 steps + 1).
    given = _held(tables["loads"], "BASE_A") if "loads" in tables else None
    loading = loading_of(given, system.numbering, np.zeros(0, dtype=np.int64))
    times = start.time + 0.5 * steps.h * np.arange(2 * max(steps.count, 0) + 1, dtype=np.float64)
    from ssilang.operators.dynamics.plausibility import warn_of_loads

    warn_of_loads(call, given, times)
    spaces, amplitudes = loading.forces.T.copy(), loading.at(times).T.copy()
    problem = explicit.ModalProblem(system.M, damping, system.K, spaces, amplitudes, arrays)
    run = explicit.integrate_modes(problem, start, steps)
    closed = system.K + explicit.stiffness_of_links(arrays)
    limit = explicit.largest_step(system.M, closed, steps.scheme) if len(arrays.kinds) else np.inf
    if steps.h > limit:
        call.warn("operators.modal.step-of-links", h=steps.h, limit=limit, scheme=steps.scheme)
    return _results(call, run, system, links, tables.get("output"))


def results_of_models(
    call: Call, entries: Entries, steps: explicit.ModalSteps, reached: Table | None
) -> tuple[Table, list[tuple[Zone, Model | None, Table]]]:
    """Step models MODAL and LIAISON of a table PASAPAS.

    It goes on from the state `reached` (REPRISE), where given. Gives the table of results and for
    each link its zone, the model that asks for its results and its table.
    """
    model, material = entries.needed("MODELE"), entries.needed("CARACTERISTIQUES")
    base, dampings = modal_table(model, material)
    system = system_of(call, base)
    links, zones = links_table(model, material)
    asked, kept, named = Table("LIAISON_B"), entries.get("SORTIE"), []
    for zone, link in zones:
        index, wanted = wanted_of(zone, entries, material)
        asked.set(link, wanted)
        named.append((zone, index, link))
    output = Table.of({"LIAISON_B": asked}, "SORTIE")
    if kept is not None and kept.has(Mot("VARIABLE")):
        output.set(Mot("VARIABLE"), kept.get(Mot("VARIABLE")))
    start = {n: entries.at(f"{n}S", 0) for n in ("DEPLACEMENT", "VITESSE")}
    start = {n: f for n, f in (start | {"REPRISE": reached}).items() if f is not None}
    tables = {"links": links, "start": Table.of(start, "INITIAL"), "output": output}
    if entries.has("CHARGEMENT"):
        tables["loads"] = Table.of({"BASE_A": entries.get("CHARGEMENT")}, "CHARGEMENT")
    damping = np.diag([dampings[mark] for mark in system.basis.marks])
    return _integrated(call, tables, system, damping, steps), named


def tables_by_role(
    call: Call, tables: Iterable[Table], roles: Mapping[str, str]
) -> dict[str, Table]:
    """Tables, checked, by the role of the argument that they are."""
    declared = call.session.library.declared(call.name)
    assert declared is not None
    by_subtype = {a.subtype: a.name for a in declared.arguments if a.subtype}
    by_subtype |= dict.fromkeys(BASES, declared.arguments[0].name)
    found: dict[str, Table] = {}
    for table in tables:
        argument = by_subtype.get(table.subtype)
        if argument is None:
            told = {"name": call.name, "subtype": table.subtype, "known": list(by_subtype)}
            raise call.error("operators.modal.unknown-table", table, **told)
        if roles[argument] in found:
            raise call.error("operators.modal.two-tables-of-kind", table, subtype=table.subtype)
        Entries(call, table, call.name, argument).check()
        found[roles[argument]] = table
    return found


# --- what is given -----------------------------------------------------------------------------


def system_of(call: Call, table: Table) -> System:
    """Matrices of a basis or of a table RAIDEUR_ET_MASSE."""
    if table.subtype == "RAIDEUR_ET_MASSE":
        return _of_matrices(call, table)
    shapes = sorted(shapes_in(table), key=lambda s: s.mark.node)
    if not shapes or any(s.unknown != "ALFA" for s in shapes):
        raise call.error("operators.modal.basis-without-modes", table)
    nodes = workspace(call.session).nodes
    marks = np.array([s.mark.node for s in shapes])
    codes = np.zeros(len(marks), dtype=np.int64)
    numbering = Numbering(nodes, ("ALFA",), ("FALF",), marks, codes, nodes.version)
    masses = np.array([_of_mode(call, s.entry, "MASSE_GENERALISEE") for s in shapes])
    if (masses <= 0.0).any():
        raise call.error("operators.modal.mass-not-positive", table, masses_min=masses.min())
    squares = np.array([eigenvalue(_of_mode(call, s.entry, "FREQUENCE")) for s in shapes])
    basis = Basis(tuple(int(m) for m in marks), ("ALFA",) * len(marks), tuple(shapes))
    return System(basis, numbering, np.diag(masses * squares), np.diag(masses))


def _of_mode(call: Call, entry: Table, name: str) -> float:
    """A number of the table of a mode."""
    value = entry.get(Mot(name))
    if isinstance(value, bool) or not isinstance(value, int | float) or not np.isfinite(value):
        raise call.error("operators.modal.mode-number-wanted", entry, name=name)
    return float(value)


def _of_matrices(call: Call, table: Table) -> System:
    stiffness, mass = (_held(table, name) for name in ("RAIDEUR", "MASSE"))
    numbering = numbering_of(stiffness, mass)
    named = [numbering.unknowns[c] for c in numbering.codes]
    if any(u not in ("ALFA", "BETA") for u in named):
        raise call.error("operators.modal.matrices-dyne-alfa-beta", table)
    shapes = None
    known = table.get("BASE_MODALE")
    if isinstance(known, Table):
        by_mark = {s.mark.node: s for s in shapes_in(known)}
        if any(int(n) not in by_mark for n in numbering.nodes):
            raise call.error("operators.modal.matrices-modes-base-modale", table)
        shapes = tuple(by_mark[int(n)] for n in numbering.nodes)
    basis = Basis(tuple(int(n) for n in numbering.nodes), tuple(named), shapes)
    K, M = (
        _kept(assemble(m, numbering).toarray(), _full(table, nature))
        for m, nature in ((stiffness, "NATURE_RAIDEUR"), (mass, "NATURE_MASSE"))
    )
    if (masses := np.diag(M)).min(initial=0.0) < 0.0:
        raise call.error("operators.modal.mass-not-positive", table, masses_min=masses.min())
    return System(basis, numbering, K, M)


def _held(table: Table, name: str) -> Any:
    return table.get(Mot(name))  # of its type: the table is checked


def _full(table: Table, name: str) -> bool:
    return str(table.get(Mot(name), "DIAGONALE")).rstrip() == "PLEINE"


def _kept(matrix: FloatArray, full: bool) -> FloatArray:
    return matrix if full else np.diag(np.diag(matrix))


def damping_of(call: Call, table: Table | None, system: System) -> FloatArray:
    """Damping of the modes (n, n), zero without a table."""
    if table is None:
        return np.zeros_like(system.M)
    matrix = _held(table, "AMORTISSEMENT")
    damping = _kept(assemble(matrix, system.numbering).toarray(), _full(table, "NATURE"))
    if (driven := np.diag(damping) < 0.0).any():
        call.warn("operators.modal.damping-negative", table, mode=int(np.argmax(driven)) + 1)
    return damping


def _start(
    call: Call, table: Table | None, system: System, links: int, steps: explicit.ModalSteps
) -> explicit.ModalState:
    n = len(system.M)
    rest = explicit.ModalState(steps.begin, np.zeros(n), np.zeros(n), None, None, None)
    if table is None:
        return rest
    again = table.get("REPRISE")
    source = again if isinstance(again, Table) else table
    q, v = (_values(call, source, name, system) for name in ("DEPLACEMENT", "VITESSE"))
    start = replace(rest, q=rest.q if q is None else q, v=rest.v if v is None else v)
    if not isinstance(again, Table):
        return start
    kept = again.get("LIAISONS")
    state = np.asarray(kept.values) if isinstance(kept, ListReel) else None
    if state is None or state.size != links * STATES:
        raise call.error("operators.modal.table-reprise-not-hold", again, links=links)
    start = replace(start, time=_of_mode(call, again, "TEMPS"), links=state.reshape(-1, STATES))
    if again.has("PAS_DE_TEMPS") and not np.isclose(_of_mode(call, again, "PAS_DE_TEMPS"), steps.h):
        return start  # half a step before is another instant then
    before, q_before = (
        _values(call, again, f"{name}_1/2", system) for name in ("ACCELERATION", "DEPLACEMENT")
    )
    return replace(start, before=before, q_before=q_before)


def _values(call: Call, table: Table, name: str, system: System) -> FloatArray | None:
    field = table.get(Mot(name))
    if field is None:
        return None
    if not isinstance(field, NodeField):
        raise call.error(
            "operators.modal.entry-is-a-field", table, name=name, subtype=table.subtype
        )
    known, names = system.numbering.unknowns, list(field.components)
    if set(known).isdisjoint(names):
        call.warn("operators.modal.start-of-other-names", table, names=names, known=known)
    return field_to_vector(field, system.numbering, dual=False)


# --- what is given back ------------------------------------------------------------------------


def _results(
    call: Call, run: explicit.ModalRun, system: System, links: list[ReadLink], output: Table | None
) -> Table:
    table = Table("RESULTAT_DYNE")
    table.set(Mot("TEMPS_DE_SORTIE"), ListReel(run.times))
    variables = None if output is None else output.get("VARIABLE")
    wanted = {"DEPLACEMENT": True, "VITESSE": True}
    kind = "CHPOINT"
    if isinstance(variables, Table):
        wanted |= {str(i).rstrip(): v is True for i, v in variables.items() if type(v) is bool}
        kind = str(variables.get("TYPE_SORTIE", kind)).rstrip()
    chosen = [i for i, name in enumerate(explicit.VARIABLES) if wanted.get(name)]
    (_as_fields if kind == "CHPOINT" else _as_lists)(table, run, system, chosen)
    _add_links(call, table, run, system, links, output)
    table.set(Mot("REPRISE"), _restart(run, system))
    return table


def _as_fields(table: Table, run: explicit.ModalRun, system: System, chosen: list[int]) -> None:
    for step, values in enumerate(run.values):
        entry = {explicit.VARIABLES[i]: system.field(values[i]) for i in chosen}
        table.set(step + 1, Table.of(entry))


def _as_lists(table: Table, run: explicit.ModalRun, system: System, chosen: list[int]) -> None:
    """A table of lists by the point that marks the unknown."""
    for i in chosen:
        lists = table.inner(explicit.VARIABLES[i])
        for j, node in enumerate(system.numbering.nodes):
            lists.set(Point(system.numbering.table, int(node)), ListReel(run.values[:, i, j]))


def _add_links(
    call: Call,
    table: Table,
    run: explicit.ModalRun,
    system: System,
    links: list[ReadLink],
    output: Table | None,
) -> None:
    first, nodes = 0, system.numbering.table
    for read in links:
        own = run.links[:, first : first + len(read.links)]
        first += len(read.links)
        for name in ("LIAISON_A", "LIAISON_B"):
            asked = None if output is None else output.get(Mot(name))
            wanted = asked.get(read.table, False) if isinstance(asked, Table) else False
            if wanted is True or isinstance(wanted, Table) or wanted == "VRAI":
                made = link_results(call, read, nodes, run.values[:, 0], own, wanted)
                table.set(read.table, made)


_MOTION = {
    "DEPLACEMENT": "q",
    "VITESSE": "v",
    "DEPLACEMENT_1/2": "q_before",
    "ACCELERATION_1/2": "before",
}
"""Fields from which DYNE goes on, and where the last step has them."""


def _restart(run: explicit.ModalRun, system: System) -> Table:
    last = run.last
    assert last.before is not None
    assert last.q_before is not None
    assert last.links is not None
    entries = {word: system.field(getattr(last, name)) for word, name in _MOTION.items()}
    times, links = {"TEMPS": float(last.time), "PAS_DE_TEMPS": last.h}, last.links.ravel()
    return Table.of(entries | times | {"LIAISONS": ListReel(links)}, "REPRISE")


@_dyne.form()
def _of_models(
    call: Call,
    scheme: str = Choice(explicit.SCHEMES, optional=False, en="how time is stepped"),
    table: Table = Arg("TABLE", en="table PASAPAS"),
) -> None:
    """Step what a table PASAPAS describes; results go into it, by number of the saved step."""
    entries = Entries(call, table, "DYNE", "TAB11")
    entries.check()
    steps, h = entries.needed("NOMBRE_PAS"), entries.needed("PAS_DE_TEMPS")
    plan = explicit.ModalSteps(h, steps, entries.get("PAS_DE_SORTIE"), scheme)
    results, named = results_of_models(call, entries, plan, entries.get("INIT_DYNE"))
    made = {name: Table() for name in ("TEMPS", "DEPLACEMENTS", "VITESSES", "LIAISONS")}
    times = results.get(Mot("TEMPS_DE_SORTIE"))
    assert isinstance(times, ListReel)
    for step, time in enumerate(times.values):
        made["TEMPS"].set(step, float(time))
        entry = results.get(step + 1)
        for name in ("DEPLACEMENT", "VITESSE"):
            if isinstance(entry, Table) and entry.has(Mot(name)):
                made[f"{name}S"].set(step, entry.get(Mot(name)))
    for _, index, link in named:
        if index is not None and results.has(link):
            made["LIAISONS"].set(index, results.get(link))
    for name, inner in made.items():
        table.set(Mot(name), inner)
    table.set(Mot("REPRISE_DYNE"), results.get(Mot("REPRISE")))
