"""What a calculation says when it is done, and the warnings before."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.language.values import LazyTable, promises
from ssilang.messages.message import sentence
from ssilang.operators.matrices.connections import warn_connections, warn_repeated
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    from ssilang.kernel.interface.interface import Interface
    from ssilang.kernel.stepping.problem.problem import Inputs, Problem
    from ssilang.kernel.stepping.run import History

ENERGY_LIMIT = 0.01
"""Imbalance of energy, as a part of the largest, above which it is told with what makes it."""
_LOAD_STEPS = "operators.dynamics.imbalance-load-steps"
LASTING = 8  # steps in a row: what an impact leaves for good
CHANGED = 0.05  # of the largest energy
ENERGIES = ("CINETIQUE", "ELASTIQUE", "JOINTS", "DISSIPEE", "AMORTIE", "EXTERIEURE")


def conserved(joints: Interface) -> bool:
    """Whether 'CONSERVATIF' keeps the energy of joints."""
    return bool((joints.codes == LawCode.SDM).all())


def _energy(history: History, word: str) -> ListReel:
    """Energies in time by their word."""
    if word == "TEMPS":
        return ListReel(history.times)
    if word == "ECART":
        return ListReel(history.imbalance)
    return ListReel(history.energies[:, ENERGIES.index(word)])


def report(
    entries: Entries,
    problem: Problem,
    history: History,
    *,
    in_statics: bool = False,
    added: bool = False,
) -> None:
    """Energies in time into the table, and a line of statistics for the summary.

    `added`: a procedure of the script added loads or matrices on the way (CHARMECA).
    """
    energies = LazyTable(partial(_energy, history), promises("TEMPS", *ENERGIES, "ECART"))
    entries.table.set(Mot("ENERGIES"), energies)
    steps, session = len(history.times) - 1, entries.call.session
    method = history.loop
    if history.method is not None:
        method = sentence(history.method.code, history.method.data, session.language)
    session.note(f"{entries.procedure}: {method} ({history.solver})")
    line: dict[str, Any] = {
        "procedure": entries.procedure,
        "unknowns": problem.numbering.size,
        "interface_unknowns": problem.interface.size if problem.interface else 0,
        "steps": steps,
        "loop": history.loop,
        "method": method,
        "solver": history.solver,
        "most_interface_iterations": history.iterations,
        "seconds": history.seconds,
        "steps_per_second": steps / history.seconds if history.seconds > 0 else None,
        "energy_imbalance": _relative(history.worst_imbalance, history.largest_energy),
        "energy_imbalance_joules": history.worst_imbalance * _joules(session),
        "static": in_statics,
    }
    if history.reduction is not None:
        line |= {
            "reduced": history.reduction.vectors > 0,
            "vectors": history.reduction.vectors,
            "estimated_error": none_if_nan(history.reduction.estimate),
            "estimated_error_of_velocities": none_if_nan(history.reduction.velocity),
            "estimated_error_of_accelerations": none_if_nan(history.reduction.acceleration),
            "not_reduced_because": str(history.reduction.refused or ""),
            "seconds_preparing_the_basis": history.reduction.prepared,
        }
    session.statistics.setdefault("calculations", []).append(line)
    for law, share in history.beyond.items():
        entries.warn("operators.dynamics.beyond-curve", law=law, share=100.0 * share)
    told = warn_impacts(entries, problem, history)
    # at an impact of relations alone it is off for a step: what lasts is told by itself
    impacts = problem.contact is not None and problem.interface is None and not in_statics
    if (line["energy_imbalance"] or 0.0) > ENERGY_LIMIT and (told or not impacts):
        causes = [_LOAD_STEPS] if in_statics else _causes(problem, added)
        line["energy_imbalance_from"] = [sentence(c, {}, session.language) for c in causes]
        line["energy_imbalance_told"] = bool(told)
        line["energy_imbalance"] = max(line["energy_imbalance"], told)


def warn_impacts(entries: Entries, problem: Problem, history: History) -> float:
    """Warn where impacts on relations alone have changed the energy for good; by what share.

    A share of what the structure had been given by then. At an impact it is off for a step, see
    `kernel.contact.impact`. Schemes that damp take energy on purpose, as impacts without correction
    do; the springs of a penalty hold some.
    """
    if problem.contact is None or problem.interface is not None or len(history.times) <= LASTING:
        return 0.0
    if not history.energies[:, 0].any():
        return 0.0
    damps = not (problem.scheme.average_acceleration or problem.scheme.conserving)
    options = problem.contact_options
    penalty = options.method == "PENALITE"
    takes = damps or penalty or options.correction == "FAUX"
    change = (history.imbalance if takes else np.abs(history.imbalance)) / history.given
    windows = np.lib.stride_tricks.sliding_window_view(change, LASTING)
    share = float(windows.min(axis=1).max())
    if share <= CHANGED:
        return 0.0
    if damps:
        entries.warn("operators.dynamics.impacts-uncorrected", share=100.0 * share)
    else:
        code = "operators.dynamics.impacts-change-energy"
        uncorrected = not penalty and options.correction == "FAUX"
        entries.warn(code, share=100.0 * share, uncorrected=uncorrected)
    return share


def _causes(problem: Problem, added: bool) -> list[str]:
    """What may put the energies of a motion out of balance, by what it has; likeliest first."""
    contact, options = problem.contact is not None, problem.contact_options
    joints, kept = problem.interface, problem.scheme.conserving
    found = {
        "operators.dynamics.imbalance-joint": joints is not None and conserved(joints) and not kept,
        "operators.dynamics.imbalance-law": joints is not None and not conserved(joints),
        "operators.dynamics.imbalance-stops": contact and not kept,
        "operators.dynamics.imbalance-velocities": contact
        and (options.correction != "FAUX" or options.persistent),
        "operators.dynamics.imbalance-scheme": not (kept or problem.scheme.average_acceleration),
        "operators.dynamics.imbalance-added": added,
    }
    return [cause for cause, holds in found.items() if holds] or [
        "operators.dynamics.imbalance-step"
    ]


def _joules(session: Session) -> float:
    """What the deck's unit of energy is in J; 1 where OPTI 'UNIT' names none."""
    units = workspace(session).units
    return 1.0 if units is None else units.factor("J")


def _relative(imbalance: float, largest: float) -> float | None:
    """The imbalance as a part of the largest energy, None where there was none."""
    return imbalance / largest if largest > 0.0 else None


def none_if_nan(value: float) -> float | None:
    """A number for JSON."""
    return None if np.isnan(value) else value


def warn_resolution(entries: Entries, problem: Problem) -> None:
    """Warn when the step does not resolve contact, saying the step to use."""
    from ssilang.kernel.stepping.problem.plausibility import contact_resolution

    warn_contrast(entries, problem)
    warn_massless(entries, problem)
    warn_overloaded(entries, problem)
    found = contact_resolution(problem)
    if found is None or found.resolved:
        return
    told = {n: getattr(found, n) for n in ("dt", "contact_time", "wanted_dt")}
    joints, code = problem.interface, "operators.dynamics.contact-not-resolved"
    keeps = joints is not None and conserved(joints)
    kept = keeps and problem.scheme.conserving
    entries.warn(code, **told, kept=kept, conserved=keeps)


def warn_overloaded(entries: Entries, problem: Problem) -> None:
    """Warn of footings that the loads of the start already press into ground that yields."""
    from ssilang.kernel.stepping.problem.plausibility import overloads

    for found in overloads(problem, problem.loading.at(problem.times[:1])[0]):
        told = {"node": problem.numbering.table.told(found.node), "pressing": found.pressing}
        entries.warn("operators.dynamics.footing-overloaded", **told, capacity=found.capacity)


def warn_massless(entries: Entries, problem: Problem) -> None:
    """Warn where a body that only joints hold, or all, has no mass: forgotten, most often."""
    from ssilang.kernel.stepping.problem.bodies import loose_bodies

    joints = problem.interface
    bodies = []
    if joints is not None:
        bodies = loose_bodies(problem, np.zeros((joints.n_points, joints.dimension)))
    massless = [body for body in bodies if body.mass == 0.0]
    if massless:
        node = problem.numbering.table.told(massless[0].node)
        others = len(massless) - 1
        entries.warn("operators.dynamics.body-without-mass", node=node, others=others)
    if not massless and not problem.M.count_nonzero() and not problem.C.count_nonzero():
        entries.warn("operators.dynamics.no-mass")


def warn_of_connections(entries: Entries, inputs: Inputs) -> None:
    """Warn of supports beside the body, joints the wrong way round, beams on single nodes."""
    place = entries.call.session, entries.place, entries.procedure
    laden = [] if inputs.mass is None else [b.nodes.ravel() for b in inputs.mass.blocks]
    warn_connections(*place, inputs.stiffness, inputs.model, inputs.characteristics, laden)
    for kind, matrix in (("MASS", inputs.mass), ("AMOR", inputs.damping)):
        if matrix is not None:
            warn_repeated(*place, matrix, kind, inputs.stiffness)
    for block in () if inputs.damping is None else inputs.damping.blocks:
        diagonal = np.diagonal(block.values, axis1=1, axis2=2)
        drives = diagonal.max(initial=0.0) <= 0.0 > diagonal.min(initial=0.0)
        if drives and block.kind != "AMORTISSEMENT":  # absorbing layers have parts of either sign
            node = block.table.told(int(block.nodes[0, 0]))
            entries.warn("operators.dynamics.damping-negative", node=node, kind=block.kind)
            break


def warn_at_rest(entries: Entries, problem: Problem) -> None:
    """Warn of a motion that nothing starts: no load, no first displacement or velocity."""
    loading = problem.loading
    acting = loading.at(problem.times).any(axis=0)
    moved = loading.forces[:, acting].any() or loading.imposed[:, acting].any()
    given = moved or problem.u.any() or problem.v.any() or entries.get("REPRISE") is not None
    if not given and problem.contact is None and not entries.flag("CHARMECA"):
        entries.warn("operators.dynamics.nothing-moves")


def warn_contrast(entries: Entries, problem: Problem) -> None:
    """Warn when joints are out of all proportion to the bodies: units, most often."""
    from ssilang.kernel.statics.conditioning import joint_conditioning
    from ssilang.kernel.stepping.problem.plausibility import STRANGE, stiffness_contrast

    found = joint_conditioning(problem)
    if found is not None and found.joints_are_to_blame:
        told = {n: getattr(found, n) for n in ("number", "digits", "balanced", "kn", "wanted_kn")}
        entries.warn("operators.dynamics.badly-conditioned", **told)
        return
    ratio = stiffness_contrast(problem)
    if ratio is None or 1 / STRANGE <= ratio <= STRANGE:
        return
    told = {"stiffer": ratio if ratio > 1 else 0.0, "softer": 1 / ratio}
    entries.warn("operators.dynamics.joints-out-of-proportion", **told)
