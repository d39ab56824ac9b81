"""What a calculation says when it is done, and the warnings before."""

from ssilang.kernel.interface.interface import Interface
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.run import History
from ssilang.kernel.waves.shaken import largest_motions
from ssilang.language.values import promises
from ssilang.messages.message import sentence
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

ENERGY_LIMIT = 0.01
"""Imbalance of energy, as a part of the largest, above which it is told with what makes it."""
_SHORTER_STEPS = "operators.dynamics.imbalance-step"
_LOAD_STEPS = "operators.dynamics.imbalance-load-steps"
ESTIMATES = {
    "estimated_error": "estimate",
    "estimated_error_of_velocities": "velocity",
    "estimated_error_of_accelerations": "acceleration",
}
"""Keys of the summary, and what of a reduction they are."""
PARTS, EXPLODES = 8, 1e5  # of a motion; times its energy that no load brings in five of them
LASTING = 8  # steps in a row: what an impact leaves for good
CHANGED = 0.05  # of the largest energy
ENERGIES = ("CINETIQUE", "ELASTIQUE", "JOINTS", "DISSIPEE", "AMORTIE", "EXTERIEURE")


def conserved(joints: Interface) -> bool:
    """Whether 'CONSERVATIF' keeps the energy of joints."""
    return bool(joints) and bool((joints.codes == LawCode.SDM).all())


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
        "interface_unknowns": problem.interface.size,
        "steps": steps,
        "loop": history.loop,
        "method": method,
        "solver": history.solver,
        "most_interface_iterations": history.iterations,
        "seconds": history.seconds,
        "steps_per_second": steps / history.seconds if history.seconds > 0 else None,
        "energy_imbalance": relative(history.worst_imbalance, history.largest_energy),
        "energy_imbalance_joules": history.worst_imbalance * _joules(session),
        "static": in_statics,
        "motions": [] if in_statics else largest_motions(problem).tolist(),
    }
    if history.reduction is not None:
        line |= {
            "reduced": history.reduction.vectors > 0,
            "vectors": history.reduction.vectors,
            **{k: none_if_nan(getattr(history.reduction, n)) for k, n in ESTIMATES.items()},
            "not_reduced_because": str(history.reduction.refused or ""),
            "seconds_preparing_the_basis": history.reduction.prepared,
        }
    session.statistics.setdefault("calculations", []).append(line)
    for law, share in history.beyond.items():
        entries.warn("operators.dynamics.beyond-curve", law=law, share=100.0 * share)
    if (times := growth(history)) > EXPLODES:
        entries.warn("operators.dynamics.grows-without-end", times=times, added=added)
    lasting = warn_impacts(entries, problem, history)
    told = lasting is not None and lasting > CHANGED
    # at an impact of relations alone it is off for a step: what lasts is told by itself
    impacts = problem.contact and not problem.interface and not in_statics
    if impacts and not told and lasting is not None and line["energy_imbalance"]:
        line["energy_imbalance_joules"] *= lasting / line["energy_imbalance"]
        line["energy_imbalance"] = lasting
    if (line["energy_imbalance"] or 0.0) > ENERGY_LIMIT and (told or not impacts):
        causes = [_LOAD_STEPS] if in_statics else _causes(problem, added)
        line["energy_imbalance_from"] = [sentence(c, {}, session.language) for c in causes]
        line["energy_imbalance_told"] = told
        line["energy_imbalance"] = max(line["energy_imbalance"], lasting or 0.0)


def growth(history: History) -> float:
    """By what energy grows in the last five eighths of a motion, tenfold in each; nought if not."""
    if len(history.energies) < 3 * PARTS:
        return 0.0
    energies = np.abs(history.energies[:, :3]).sum(axis=1)
    most = np.array([part.max() for part in np.array_split(energies, PARTS)])[2:]
    return float(most[-1] / most[0]) if (most[:-1] * 10.0 < most[1:]).all() and most[0] else 0.0


def warn_impacts(entries: Entries, problem: Problem, history: History) -> float | None:
    """Warn where impacts on relations alone have changed the energy for good; by what share.

    A share of what the structure had been given by then. At an impact it is off for a step, see
    `kernel.contact.impact`. Schemes that damp take energy on purpose, as impacts of multipliers
    without correction do.
    """
    if not problem.contact or problem.interface or len(history.times) <= LASTING:
        return None
    if not history.energies[:, 0].any():
        return None
    damps = not (problem.scheme.average_acceleration or problem.scheme.conserving)
    options = problem.contact_options
    penalty = options.method == "PENALITE"
    uncorrected = not penalty and options.correction == "FAUX"
    takes = damps or uncorrected
    change = (history.imbalance if takes else np.abs(history.imbalance)) / history.given
    windows = np.lib.stride_tricks.sliding_window_view(change, LASTING)
    share = max(0.0, float(windows.min(axis=1).max()))
    if share <= CHANGED:
        return share
    if damps:
        entries.warn("operators.dynamics.impacts-uncorrected", share=100.0 * share)
    else:
        code = "operators.dynamics.impacts-change-energy"
        entries.warn(code, share=100.0 * share, uncorrected=uncorrected)
    return share


def _causes(problem: Problem, added: bool) -> list[str]:
    """What may put the energies of a motion out of balance, by what it has; likeliest first."""
    contact, options = bool(problem.contact), problem.contact_options
    joints, kept = problem.interface, problem.scheme.conserving
    found = {
        "operators.dynamics.imbalance-joint": conserved(joints) and not kept,
        "operators.dynamics.imbalance-law": bool(joints) and not conserved(joints),
        "operators.dynamics.imbalance-stops": contact and not kept,
        "operators.dynamics.imbalance-velocities": contact
        and (options.correction != "FAUX" or options.persistent),
        "operators.dynamics.imbalance-scheme": not (kept or problem.scheme.average_acceleration),
        "operators.dynamics.imbalance-added": added,
    }
    return [cause for cause, holds in found.items() if holds] or [_SHORTER_STEPS]


def _joules(session: Session) -> float:
    """What the deck's unit of energy is in J; 1 where OPTI 'UNIT' names none."""
    units = workspace(session).units
    return 1.0 if units is None else units.factor("J")


def relative(imbalance: float, largest: float) -> float | None:
    """The imbalance as a part of the largest energy, None where there was none."""
    return imbalance / largest if largest > 0.0 else None


def none_if_nan(value: float) -> float | None:
    """A number for JSON."""
    return None if np.isnan(value) else value
