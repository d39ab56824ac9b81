"""DYNE: time stepping on modes, with shocks, friction, plastic links and couplings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices.assembly import Numbering, assemble, field_to_vector, numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.modal.explicit import (
    SCHEMES,
    VARIABLES,
    ModalProblem,
    ModalRun,
    ModalState,
    ModalSteps,
    integrate_modes,
)
from ssilang.kernel.modal.links import STATES, link_arrays
from ssilang.kernel.modal.modes import eigenvalue
from ssilang.kernel.stepping.problem.loading import loading_of
from ssilang.language.registry import Help, arg, choice, many, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel, Mot, Table
from ssilang.language.vocabulary.terms import POSITIVE
from ssilang.operators.modal.basis import shapes_in
from ssilang.operators.modal.dyne_links import Basis, ReadLink, link_results, links_of
from ssilang.operators.modal.modes import filled
from ssilang.operators.tables.entries import Entries
from ssilang.operators.workspace import workspace

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


def _dyne(
    call: Call,
    scheme: str,
    given: tuple[Table, ...],
    steps: int,
    h: float,
    every: int,
) -> Table:
    tables = tables_by_role(call, given, _ROLES)
    if "system" not in tables:
        raise call.error("operators.modal.dyne-wants-table-base")
    system = system_of(call, tables["system"])
    links = links_of(call, tables.get("links"), system.basis)
    start = _start(call, tables.get("start"), system, len(links))
    if tables.keys().isdisjoint(("start", "loads")):
        call.warn("operators.modal.nothing-moves")
    spaces, amplitudes = _forces(call, tables.get("loads"), system, start.time, h, steps)
    problem = ModalProblem(
        system.M, damping_of(call, tables.get("damping"), system), system.K, spaces, amplitudes,
        link_arrays([r.link for r in links], len(system.M)),
    )  # fmt: skip
    run = integrate_modes(problem, start, ModalSteps(h, steps, every, scheme))
    return _results(run, system, links, tables.get("output"))


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
            raise call.error(
                "operators.modal.unknown-table",
                table,
                name=call.name,
                subtype=table.subtype,
                known=list(by_subtype),
            )
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
    stiffness, mass = (_matrix(call, table, name) for name in ("RAIDEUR", "MASSE"))
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
    return System(basis, numbering, K, M)


def _matrix(call: Call, table: Table, name: str) -> Matrix:
    value = table.get(Mot(name))
    if not isinstance(value, Matrix):
        raise call.error("operators.modal.matrix-wanted", table, subtype=table.subtype, name=name)
    return value


def _full(table: Table, name: str) -> bool:
    return str(table.get(Mot(name), "DIAGONALE")).rstrip() == "PLEINE"


def _kept(matrix: FloatArray, full: bool) -> FloatArray:
    return matrix if full else np.diag(np.diag(matrix))


def damping_of(call: Call, table: Table | None, system: System) -> FloatArray:
    """Damping of the modes (n, n), zero without a table."""
    if table is None:
        return np.zeros_like(system.M)
    matrix = _matrix(call, table, "AMORTISSEMENT")
    return _kept(assemble(matrix, system.numbering).toarray(), _full(table, "NATURE"))


def _forces(
    call: Call, table: Table | None, system: System, t0: float, h: float, steps: int
) -> tuple[FloatArray, FloatArray]:
    """Forces on the modes (p, n) and their values at each half step (p, 2 steps + 1)."""
    load = None if table is None else table.get("BASE_A")
    if table is not None and not isinstance(load, Load):
        raise call.error("operators.modal.table-chargement-no-load", table)
    given = load if isinstance(load, Load) else None
    loading = loading_of(given, system.numbering, np.zeros(0, dtype=np.int64))
    times = t0 + 0.5 * h * np.arange(2 * max(steps, 0) + 1, dtype=np.float64)
    return loading.forces.T.copy(), loading.at(times).T.copy()


def _start(call: Call, table: Table | None, system: System, links: int) -> ModalState:
    n = len(system.M)
    rest = ModalState(0.0, np.zeros(n), np.zeros(n), None, None, None)
    if table is None:
        return rest
    again = table.get("REPRISE")
    source = again if isinstance(again, Table) else table
    q, v = (_values(call, source, name, system) for name in ("DEPLACEMENT", "VITESSE"))
    start = replace(rest, q=rest.q if q is None else q, v=rest.v if v is None else v)
    if not isinstance(again, Table):
        return start
    kept = again.get("LIAISONS")
    state = np.asarray(kept.values).reshape(-1, STATES) if isinstance(kept, ListReel) else None
    if state is None or len(state) != links:
        raise call.error("operators.modal.table-reprise-not-hold", again, links=links)
    return replace(
        start, time=_of_mode(call, again, "TEMPS"), links=state,
        before=_values(call, again, "ACCELERATION_1/2", system),
        q_before=_values(call, again, "DEPLACEMENT_1/2", system),
    )  # fmt: skip


def _values(call: Call, table: Table, name: str, system: System) -> FloatArray | None:
    field = table.get(Mot(name))
    if field is None:
        return None
    if not isinstance(field, NodeField):
        raise call.error(
            "operators.modal.entry-is-a-field", table, name=name, subtype=table.subtype
        )
    return field_to_vector(field, system.numbering, dual=False)


# --- what is given back ------------------------------------------------------------------------


def _results(run: ModalRun, system: System, links: list[ReadLink], output: Table | None) -> Table:
    table = Table("RESULTAT_DYNE")
    table.set(Mot("TEMPS_DE_SORTIE"), ListReel(run.times))
    variables = None if output is None else output.get("VARIABLE")
    wanted = {"DEPLACEMENT": True, "VITESSE": True}
    kind = "CHPOINT"
    if isinstance(variables, Table):
        wanted |= {str(i).rstrip(): v is True for i, v in variables.items() if type(v) is bool}
        kind = str(variables.get("TYPE_SORTIE", kind)).rstrip()
    chosen = [i for i, name in enumerate(VARIABLES) if wanted.get(name)]
    (_as_fields if kind == "CHPOINT" else _as_lists)(table, run, system, chosen)
    _add_links(table, run, links, output)
    table.set(Mot("REPRISE"), _restart(run, system))
    return table


def _as_fields(table: Table, run: ModalRun, system: System, chosen: list[int]) -> None:
    for step, values in enumerate(run.values):
        entry = Table()
        for i in chosen:
            entry.set(Mot(VARIABLES[i]), system.field(values[i]))
        table.set(step + 1, entry)


def _as_lists(table: Table, run: ModalRun, system: System, chosen: list[int]) -> None:
    """A list for a single mode, else a table of lists by the number of the mode."""
    for i in chosen:
        lists = [ListReel(run.values[:, i, j]) for j in range(len(system.M))]
        numbered = Table()
        for number, values in enumerate(lists, start=1):
            numbered.set(number, values)
        table.set(Mot(VARIABLES[i]), lists[0] if len(lists) == 1 else numbered)


def _add_links(table: Table, run: ModalRun, links: list[ReadLink], output: Table | None) -> None:
    for name in ("LIAISON_A", "LIAISON_B"):
        asked = None if output is None else output.get(Mot(name))
        if not isinstance(asked, Table):
            continue
        for place, read in enumerate(links):
            wanted = asked.get(read.table, False)
            if wanted is True or isinstance(wanted, Table):
                made = link_results(read, place, run.values[:, 0], run.links, wanted)
                table.set(read.table, made)


def _restart(run: ModalRun, system: System) -> Table:
    last = run.last
    assert last.before is not None
    assert last.q_before is not None
    assert last.links is not None
    entries: dict[str, Any] = {
        "TEMPS": float(last.time),
        "DEPLACEMENT": system.field(last.q),
        "VITESSE": system.field(last.v),
        "DEPLACEMENT_1/2": system.field(last.q_before),
        "ACCELERATION_1/2": system.field(last.before),
        "LIAISONS": ListReel(last.links.ravel()),
    }
    return filled("REPRISE", entries)


_EXAMPLE = (
    "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; K1 = APPU 'UX' 39.4784176 P1 ; "
    "B1 = VIBR 'SIMU' 1. 1 K1 (MASS 'UX' 1. P1) ; "
    "P2 = B1 . 'MODES' . 1 . 'POINT_REPERE' ; "
    "TI = TABL 'INITIAL' ; TI . 'DEPLACEMENT' = MANU 'CHPO' P2 1 'ALFA' 1. ; "
)
operator(
    "DYNE",
    choice("scheme", SCHEMES, optional=False, en="how time is stepped"),
    TABLES,
    arg("steps", "ENTIER", range=POSITIVE, en="number of steps"),
    arg("h", "FLOTTANT", range=POSITIVE, en="time step", unit="s"),
    opt(
        "every",
        "ENTIER",
        range=POSITIVE,
        default=1,
        en="one step of so many is kept, all without it",
    ),
    family="modal",
    help=Help(
        "Time stepping on modes: De Vogelaere (fourth order), central differences, average "
        "acceleration or Fox-Goodwin, from rest, from initial values or going on from a run "
        "(INITIAL); loads on the modes (CHARGEMENT, index 'BASE_A', made by PJBA or SEIS), "
        "damping, and links (LIAISON): POINT_PLAN, POINT_POINT, POINT_CERCLE with friction or "
        "without, POINT_CERCLE_MOBILE, CERCLE_PLAN_FROTTEMENT, plastic springs and hinges "
        "between points, COUPLAGE_DEPLACEMENT and COUPLAGE_VITESSE. Contacts push "
        "against the normal, which points "
        "into the obstacle, where the motion along it is beyond the gap. The table of results has "
        "one entry a saved step (DEPLACEMENT, VITESSE ... on ALFA), TEMPS_DE_SORTIE, lists of the "
        "links asked for, and REPRISE to go on. A step too long for the scheme is refused.",
        "TAB1 = DYNE 'DE_VOGELAERE' | 'DIFFERENCES_CENTREES' | 'ACCELERATION_MOYENNE' | "
        "'FOX_GOODWIN' TBASE | TRIGMASS (TAMOR) (TLIAI) (TCHAR) (TINIT) N1 FLOT1 (N2) (TSORT) ;",
        (
            _EXAMPLE + "R = DYNE 'DE_VOGELAERE' B1 TI 100 0.01 ; "
            "LIST (MAXI (R . 51 . 'DEPLACEMENT')) ;",
            _EXAMPLE + "L1 = TABL 'LIAISON_ELEMENTAIRE' ; L1 . 'TYPE_LIAISON' = MOT 'POINT_PLAN' ; "
            "L1 . 'SUPPORT' = P1 ; L1 . 'NORMALE' = -1. 0. ; L1 . 'RAIDEUR' = 4.E3 ; "
            "L1 . 'JEU' = 0. ; TL = TABL 'LIAISON' ; TL . 'LIAISON_B' = TABL 'LIAISON_B' ; "
            "TL . 'LIAISON_B' . 1 = L1 ; TS = TABL 'SORTIE' ; TS . 'LIAISON_B' = TABL 'LIAISON_B' ;"
            " TS . 'LIAISON_B' . L1 = VRAI ; R = DYNE 'DE_VOGELAERE' B1 TI TL TS 400 1.E-3 ; "
            "LIST (MAXI (R . L1 . 'FORCE_DE_CHOC') 'ABS') ;",
        ),
    ),
)(_dyne)
