"""What a calculation says when it is done, and the warnings before."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.language.values import LazyTable, ListReel, Mot, promises
from ssilang.operators.matrices.doubled import warn_doubled_supports
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    from ssilang.kernel.stepping.problem.problem import Inputs, Problem
    from ssilang.kernel.stepping.run import History

ENERGIES = ("CINETIQUE", "ELASTIQUE", "JOINTS", "DISSIPEE", "AMORTIE", "EXTERIEURE")


def _energy(history: History, word: str) -> ListReel:
    """Energies in time by their word."""
    if word == "TEMPS":
        return ListReel(history.times)
    if word == "ECART":
        return ListReel(history.imbalance)
    return ListReel(history.energies[:, ENERGIES.index(word)])


def report(entries: Entries, problem: Problem, history: History) -> None:
    """Energies in time into the table, and a line of statistics for the summary."""
    energies = LazyTable(partial(_energy, history), promises("TEMPS", *ENERGIES, "ECART"))
    entries.table.set(Mot("ENERGIES"), energies)
    steps, session = len(history.times) - 1, entries.call.session
    method = history.words.get(session.language, history.loop)
    session.note(f"{entries.procedure}: {method} ({history.solver})")
    line: dict[str, Any] = {
        "procedure": entries.procedure,
        "unknowns": problem.numbering.size,
        "interface_unknowns": problem.interface.size if problem.interface else 0,
        "steps": steps,
        "together": history.together,
        "loop": history.loop,
        "method": method,
        "solver": history.solver,
        "most_interface_iterations": history.iterations,
        "seconds": history.seconds,
        "steps_per_second": steps / history.seconds if history.seconds > 0 else None,
        "energy_imbalance": history.worst_imbalance,
    }
    if history.reduction is not None:
        line |= {
            "reduced": history.reduction.vectors > 0,
            "vectors": history.reduction.vectors,
            "estimated_error": none_if_nan(history.reduction.estimate),
            "estimated_error_of_velocities": none_if_nan(history.reduction.velocity),
            "estimated_error_of_accelerations": none_if_nan(history.reduction.acceleration),
            "not_reduced_because": history.reduction.refused,
            "seconds_preparing_the_basis": history.reduction.prepared,
        }
    session.statistics.setdefault("calculations", []).append(line)


def none_if_nan(value: float) -> float | None:
    """A number for JSON."""
    return None if np.isnan(value) else value


def warn_resolution(entries: Entries, problem: Problem) -> None:
    """Warn when the step does not resolve contact, saying the step to use."""
    from ssilang.kernel.stepping.problem.resolution import contact_resolution

    warn_contrast(entries, problem)
    warn_massless(entries, problem)
    found = contact_resolution(problem)
    if found is None or found.resolved:
        return
    advice = f"dt <= T_c/30 = {found.wanted_dt:.3g} s keeps energy; or CONSERVATIF, a softer joint"
    if problem.scheme.conserving:
        advice = f"energy is kept; dt <= T_c/30 = {found.wanted_dt:.3g} s follows the contact too"
    entries.warn(
        f"the step {found.dt:.3g} s does not resolve contact, whose half period is "
        f"{found.contact_time:.3g} s with the mass attached to the joints",
        advice,
    )


def warn_massless(entries: Entries, problem: Problem) -> None:
    """Warn of bodies without mass that only joints hold: MASS was forgotten, most often."""
    from ssilang.kernel.stepping.problem.bodies import loose_bodies

    joints = problem.interface
    if joints is None:
        return
    for body in loose_bodies(problem, np.zeros((joints.n_points, joints.dimension))):
        if body.mass == 0.0:
            entries.warn(
                f"the body at node {body.node} has no mass and only joints hold it: it follows "
                "its loads at once, and is lost where all its joints open",
                "give its MASS",
            )


def warn_supports(entries: Entries, inputs: Inputs) -> None:
    """Warn of supports beside the body (lines made twice) and of joints the wrong way round."""
    from ssilang.kernel.statics.sides import swapped_joints

    warn_doubled_supports(
        entries.call.session, entries.place, entries.procedure, inputs.stiffness, inputs.model
    )
    for x, y, z in swapped_joints(inputs.stiffness, inputs.model, inputs.characteristics):
        entries.warn(
            f"the joint around {x:.4g} {y:.4g} {z:.4g} opens where its bodies come together: its "
            "sides are swapped",
            "RACC and LIAI take the structure's side first",
        )


def warn_motion_elsewhere(entries: Entries, problem: Problem, inputs: Inputs) -> None:
    """Warn of initial displacements and velocities of nodes that no matrix has."""
    for index, field in (("DEPL", inputs.displacement), ("VITE", inputs.velocity)):
        parts = field.components.items() if field is not None else ()
        moved = [part.nodes[part.values != 0.0] for name, part in parts if name != "LX"]
        nodes = np.unique(np.concatenate(moved)) if moved else np.empty(0, dtype=np.int64)
        lost = int(np.isin(nodes, problem.numbering.nodes, invert=True).sum())
        if lost:
            entries.warn(
                f"{lost} nodes of '{index}' belong to no matrix: what moves there is not seen",
                "a point written again is a new node: use the names of the mesh",
            )


def warn_contrast(entries: Entries, problem: Problem) -> None:
    """Warn when joints are out of all proportion to the bodies: units, most often."""
    from ssilang.kernel.statics.conditioning import joint_conditioning
    from ssilang.kernel.stepping.problem.contrast import STRANGE, stiffness_contrast

    found = joint_conditioning(problem)
    if found is not None and found.joints_are_to_blame:
        entries.warn(
            f"the condition number of the stiffness with closed joints is {found.number:.0e}: "
            f"{found.digits} of 16 digits are left; with joints as stiff as the bodies at their "
            f"nodes it is {found.balanced:.0e}",
            f"KN and KS are in Pa/m (N/m for JOI1), here KN = {found.kn:.3g}: check their units; "
            f"{found.wanted_kn:.1e} is as stiff as the bodies",
        )
        return
    ratio = stiffness_contrast(problem)
    if ratio is None or 1 / STRANGE <= ratio <= STRANGE:
        return
    more = f"{ratio:.1e} times as stiff as" if ratio > 1 else f"{1 / ratio:.1e} times softer than"
    entries.warn(
        f"the joints are {more} the bodies at the same nodes: digits are lost",
        "KN and KS are in Pa/m (N/m for JOI1); check their units",
    )
