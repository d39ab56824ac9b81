"""ZPAS: the load steps behind the procedure PASAPAS."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.curve import Load, LoadPart
from ssilang.kernel.dynamics.plan import nearest
from ssilang.kernel.elements.families import mass, stiffness
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.joints.elements import is_joint
from ssilang.kernel.joints.law_table import law_of
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.model import Model, Zone
from ssilang.kernel.plasticity.bulk import without_stiffness
from ssilang.kernel.plasticity.points import is_plastic, plastic_zones
from ssilang.kernel.statics.thermal_load import split_thermal
from ssilang.language.call import Call
from ssilang.language.registry import Help, operator
from ssilang.language.values import Mot, Table
from ssilang.operators.dynamics.reports import report, warn_contrast, warn_resolution
from ssilang.operators.dynamics.scheme_entries import contact_options, scheme_of
from ssilang.operators.models.contact import model_relations
from ssilang.operators.session.progress import ProgressLine
from ssilang.operators.session.user_procedures import AfterEachStep, StopCalculation
from ssilang.operators.statics.bodies import finite_bodies, finite_zones, plastic_bodies
from ssilang.operators.statics.initial_stress import offset_load, stress_offsets
from ssilang.operators.statics.pasapas_entries import KNOWN, REFUSED, RESULTS
from ssilang.operators.statics.pasapas_results import ResultTables, Stresses
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    from ssilang.kernel.dynamics.problem import Inputs
    from ssilang.kernel.dynamics.snapshot import Observer


@operator(
    "ZPAS",
    family="statics",
    help=Help(
        en="Load steps of the table of PASAPAS, which is the procedure to call.",
        fr="Pas de charge de la table de PASAPAS, procédure à appeler.",
        syntax="ZPAS TAB1 ;",
    ),
    reads_itself=True,
)
def zpas(call: Call) -> None:
    """Read the table, step through the times, fill the tables of results."""
    from ssilang.kernel.dynamics.integrate import integrate
    from ssilang.kernel.dynamics.problem import make_problem
    from ssilang.kernel.plasticity.run import run_bulk
    from ssilang.kernel.statics.stepping import step_statics

    entries = Entries(call, call.required("TABLE"), "PASAPAS")
    entries.refuse(REFUSED)
    entries.warn_unknown(KNOWN)
    start = start_of(entries)
    times, saved = _times(entries, start)
    dynamic = entries.flag("DYNAMIQUE")
    entries.table.set(Mot("CONV"), False)
    entries.table.set(Mot("ERREUR"), True)
    inputs, stresses = _inputs(entries, start, times, dynamic)
    finite = finite_zones(entries)
    bodies = finite_bodies(entries, finite, start) if finite else plastic_bodies(entries, start)
    problem = make_problem(inputs)
    results = ResultTables(entries.table, saved, stresses, dynamic, start.index)
    observers: list[Observer] = [results]
    if entries.flag("PROCEDURE_PERSO1"):
        observers.append(AfterEachStep(call, "PERSO1", entries.table, len(times)))
    line = ProgressLine("PASAPAS")
    try:
        (warn_resolution if dynamic else warn_contrast)(entries, problem)
        if bodies is not None:
            history = run_bulk(problem, *bodies(problem, inputs), observers, line, dynamic)
        elif dynamic:
            history = integrate(problem, observers, line, entries.flag("NEWTON_COMPLET"))
        else:
            history = step_statics(problem, observers, line)
        report(entries, problem, history)
    except StopCalculation:
        pass
    finally:
        line.close()
    _say_last(entries, results)
    entries.table.set(Mot("CONV"), True)
    entries.table.set(Mot("ERREUR"), False)


def _say_last(entries: Entries, results: ResultTables) -> None:
    """Table CONTINUATION: the last results, from which a further call goes on."""
    last = Table()
    for word in RESULTS:
        inner = entries.table.get(Mot(word))
        if isinstance(inner, Table) and inner.has(results.number - 1):
            last.set(Mot(word), inner.get(results.number - 1))
    entries.table.set(Mot("CONTINUATION"), last)


@dataclass(frozen=True)
class Start:
    """Where a calculation begins: number of the result it goes on from, time, initial state."""

    index: int
    time: float | None
    entries: Entries

    def of(self, word: str, *types: str) -> Any:
        """The result of this number, None if there is none."""
        return self.entries.at(word, self.index, *types)


def start_of(entries: Entries) -> Start:
    """The last result in the table, or that of time REPRISE: later ones are removed."""
    numbers = [
        i
        for word in ("TEMPS", "DEPLACEMENTS", "CONTRAINTES", "VITESSES")
        for i in entries.numbers(word)
    ]
    again = entries.get("REPRISE", "FLOTTANT")
    if again is None:
        index = max(entries.numbers("TEMPS") or numbers, default=0)
    else:
        times = {i: entries.at("TEMPS", i, "FLOTTANT", "ENTIER") for i in entries.numbers("TEMPS")}
        if not times:
            raise entries.bad("'REPRISE' needs the results of an earlier calculation")
        index = min(times, key=lambda i: abs(times[i] - again))
        if abs(times[index] - again) > 1e-9 * max(abs(again), 1e-9):
            raise entries.bad(
                f"no result stands at the time of 'REPRISE', {again:g}",
                f"the nearest is at {times[index]:g}",
            )
        entries.forget_after(index)
    return Start(index, entries.at("TEMPS", index, "FLOTTANT", "ENTIER"), entries)


def _times(entries: Entries, start: Start) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Times with the initial one first, and which are saved (the initial one always)."""
    given = entries.get("TEMPS_CALCULES", "LISTREEL")
    if given is None:
        given = entries.needed("TEMPS_SAUVES", "LISTREEL")
    wanted = np.asarray(given.values, dtype=float)
    first = start.time
    if first is None:
        first = min(0.0, float(wanted[0])) if len(wanted) else 0.0
    times = np.concatenate([[float(first)], wanted[wanted > first]])
    if len(times) < 2:
        raise entries.bad(f"no time of 'TEMPS_CALCULES' comes after the initial one, {first:g}")
    chosen = entries.get("TEMPS_SAUVES", "LISTREEL")
    if chosen is None:
        return times, np.ones(len(times), bool)
    later = chosen.values[(chosen.values > first) & (chosen.values <= times[-1])]
    saved = nearest(times, later)
    saved[0] = True
    return times, saved


def _inputs(
    entries: Entries, start: Start, times: FloatArray, dynamic: bool
) -> tuple[Inputs, Stresses]:
    from ssilang.kernel.dynamics.problem import Inputs

    material: CellField | None = entries.get("CARACTERISTIQUES", "MCHAML")
    model: Model | None = entries.get("MODELE", "MMODEL")
    linear = _linear_zones(entries)
    solids = [(z, m) for z, m in linear if not is_joint(z)]
    load, thermal = split_thermal(entries.get("CHARGEMENT", "CHARGEME"), solids)
    displacement = start.of("DEPLACEMENTS", "CHPOINT")
    stresses = Stresses(linear, thermal)
    given = start.of("CONTRAINTES", "MCHAML")
    if isinstance(given, CellField) and solids:
        stresses.offsets = stress_offsets(solids, stresses, given, displacement, float(times[0]))
        parts = offset_load(stresses.offsets, solids)
        load = Load((*(load.parts if load else ()), *(LoadPart("MECA", f) for f in parts)))
    blocks = [stiffness(z, m) for z, m in solids]
    plastic = (*plastic_zones(model), *finite_zones(entries))
    blocks += [without_stiffness(z) for z in plastic]
    heavy = [mass(z, m) for z, m in solids] if dynamic else []
    if dynamic and material is not None:
        heavy += [mass(z, material) for z in plastic]
    contact, gaps = _contact(model, material)
    if gaps is not None:
        load = Load((*(load.parts if load else ()), LoadPart("MECA", gaps)))
    constant = entries.get("RIGIDITE_CONSTANTE", "RIGIDITE")
    supports = entries.get("BLOCAGES_MECANIQUES", "RIGIDITE")
    masses: Matrix | None = None
    if dynamic:
        masses = _joined(entries, heavy, (entries.get("MASSE_CONSTANTE", "RIGIDITE"),), "MASSE")
    inputs = Inputs(
        _joined(entries, blocks, (constant, supports, contact), "RIGIDITE"),
        times,
        masses,
        entries.get("AMORTISSEMENT", "RIGIDITE") if dynamic else None,
        load,
        displacement,
        start.of("VITESSES", "CHPOINT") if dynamic else None,
        model,
        material,
        scheme_of(entries),
        contact_options(entries, dynamic),
        start.of("VARIABLES_INTERNES", "MCHAML"),
    )
    return inputs, stresses


def _contact(
    model: Model | None, material: CellField | None
) -> tuple[Matrix | None, NodeField | None]:
    """Unilateral relations of the sides in contact, and the values that they stay above."""
    found = [] if model is None else model_relations(model, material)
    if not found or model is None:
        return None, None
    table = model.mesh.nodes
    nodes = np.concatenate([c.relations.multipliers for c in found])
    values = np.concatenate([c.distances for c in found])
    order = np.argsort(nodes, kind="stable")
    gaps = NodeField(table, {"FLX": NodeValues(nodes[order], values[order])}, "DISCRET")
    return Matrix(table, (), tuple(c.relations for c in found)), gaps


def _joined(
    entries: Entries, blocks: list[ElementMatrices], parts: tuple[Matrix | None, ...], kind: str
) -> Matrix:
    given = [m for m in parts if m is not None]
    all_blocks = (*blocks, *(b for m in given for b in m.blocks))
    relations = tuple(r for m in given for r in m.relations)
    if blocks:
        table = blocks[0].table
    elif given:
        table = given[0].table
    else:
        model = entries.needed("MODELE", "MMODEL")
        table = model.mesh.nodes
    return Matrix(table, all_blocks, relations, kind)


def _linear_zones(entries: Entries) -> list[tuple[Zone, CellField]]:
    """Zones of MODELE whose stiffness says all, with the characteristics."""
    model: Model | None = entries.get("MODELE", "MMODEL")
    if model is None:
        return []
    material = entries.needed("CARACTERISTIQUES", "MCHAML")
    finite = finite_zones(entries)
    mechanical = (z for z in model.zones if z.formulation == "MECANIQUE" and z not in finite)
    return [(z, material) for z in mechanical if _is_linear(z)]


def _is_linear(zone: Zone) -> bool:
    return law_of(zone.behaviour).linear if is_joint(zone) else not is_plastic(zone)
