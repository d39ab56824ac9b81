"""What DYNAMIC warns of before it steps: inputs that are well typed and make no sense together."""

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.elements.families import unlike
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.interface import Interface, is_macro, joint_zones, replaced_blocks
from ssilang.kernel.interface.laws.columns import LawCode, Parameter
from ssilang.kernel.interface.laws.law_table import LAWS, law_of
from ssilang.kernel.materials.model import same_elements
from ssilang.kernel.matrices.assembly import imposed_outside, outside
from ssilang.kernel.plasticity.points import plastic_zones
from ssilang.kernel.statics.conditioning import joint_conditioning
from ssilang.kernel.statics.doubled import bodies_apart, idle_nodes, terms_of
from ssilang.kernel.statics.linear_motion import rigid_motions
from ssilang.kernel.stepping.extremes import Extremes
from ssilang.kernel.stepping.node_histories import NodeHistories
from ssilang.kernel.stepping.problem.bodies import ROUNDING, held, loose_bodies
from ssilang.kernel.stepping.problem.loading import nodal_terms
from ssilang.kernel.stepping.problem.plausibility import (
    STRANGE,
    Start,
    Told,
    against_supports,
    contact_resolution,
    masses_alone,
    on_supports,
    overloads,
    stiffness_contrast,
)
from ssilang.kernel.stepping.problem.problem import Inputs, Problem
from ssilang.kernel.waves.shaken import AXES, translations
from ssilang.operators.dynamics.damped import OVERDAMPED, damped_heavily
from ssilang.operators.dynamics.reports import conserved
from ssilang.operators.dynamics.shaking import (
    beside_free_field,
    bridged,
    sides_unlike,
    stops_on_held,
    warn_of_shaking,
)
from ssilang.operators.dynamics.standing import (
    bodies_stand,
    braked,
    footing_too_wide,
    ground_twice,
    hangs_on_springs,
    mass_of_beam,
    mass_of_both,
    masses_apart,
    matter_amiss,
    out_of_balance,
    rest_of_others,
    rotary_alone,
    stops_across,
    stops_turned,
    turns_heavily,
    unequal_joints,
    velocity_of_rest,
    weak_cores,
    weight_of_part,
)
from ssilang.operators.matrices.connections import warn_connections, warn_repeated
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

NAMED = 4  # values and bodies that a warning names
NOUGHT = 1e-3  # part of a curve's largest value that counts as nought at its ends
NEARLY = 0.02  # the same, where the curve goes on to the last step but one
MISSED = 0.2  # part of a curve's largest value by which steps may pass over its points
MOST_ALONE = 5000  # unknowns, without joints or stops, whose bodies are looked for
AHEAD = 10.0  # times what a calculation saw of a curve: what lies behind its end is the load
HALF = 2.0  # times what it saw of a load that grows to 1: a calculation in stages sees less
SWUNG = 2.0  # of a curve's largest value, up and down together: more is no load that was put on
FEWEST, WANTED = 3, 20  # steps of a period
BRIEF, TRIED = 0.1, 30  # of a period: what ends in it has not begun to move; steps of a trial
RESOLVED = 5e-3  # of the largest energy: with four steps a contact some 3 %, with 24 0.15 %
TURNED, TIPPED = 1.0, 0.2  # rad: of a node; of a body at the end, that joints or stops bear
STEEP = 1.0 / 3.0  # of a bowl's radius, where sine and tangent are 6 % apart
HELD = 0.99  # of all mass, on nodes that do not move
OF_MASS = ("operators.dynamics.mass-held", "operators.dynamics.ground-too-light")
SUPPORTS = {"DYNAMIC": "RIGI", "PASAPAS": "BLOCAGES_MECANIQUES"}
"""Entry of each procedure that conditions belong to."""
FAR = 100.0  # sizes of the model; what slides may go far
STAGED = 100.0  # times what was seen; a load that is put on in stages may grow by less


def warn_of_start(entries: Entries, start: Start, *, in_statics: bool = False) -> None:
    """Warn of all that the start of a calculation shows, by the tables below."""
    guards = IN_STATICS if in_statics else GUARDS
    if not in_statics and not plastic_zones(start.inputs.model):
        guards += OF_STIFFNESS
    for find in guards:
        for code, told in find(start):
            entries.warn(code, supports=SUPPORTS[entries.procedure], **told)
    if not in_statics:
        warn_of_shaking(entries, start)


def _motion_elsewhere(start: Start) -> Told:
    problem, inputs = start.problem, start.inputs
    for index, field in (("DEPL", inputs.displacement), ("VITE", inputs.velocity)):
        lost = [] if field is None else outside(field, problem.numbering, dual=False)
        if lost:
            more, names = len(lost[NAMED:]), problem.numbering.unknowns
            told = {"index": index, "lost": lost[:NAMED], "more": more, "known": names}
            yield "operators.dynamics.motion-elsewhere", told


def _motion_against_supports(start: Start) -> Told:
    for index, rows in against_supports(start.problem).items():
        if len(rows):
            told = {"index": index, "count": len(rows), "moved": index == "DEPL"}
            yield "operators.dynamics.motion-against-supports", told


def _imposed_elsewhere(start: Start) -> Told:
    problem, inputs = start.problem, start.inputs
    known = problem.multipliers, problem.contact.multipliers
    for part in () if inputs.load is None else inputs.load.parts:
        count = max(imposed_outside(f, np.concatenate(known)) for f, _ in nodal_terms(part))
        if count:
            yield "operators.dynamics.imposed-elsewhere", {"name": part.name, "count": count}


def _not_conserved(start: Start) -> Told:
    problem, inputs = start.problem, start.inputs
    joints, zones = problem.interface, () if inputs.model is None else inputs.model.zones
    if joints and problem.scheme.conserving and not conserved(joints):
        laws = [law_of(z.behaviour) for z in zones if is_joint(z)]
        names = [n for n, law in LAWS.items() if law in laws and law.code is not LawCode.SDM]
        yield "operators.dynamics.conserving-other-laws", {"laws": names}


def _joints_of_others(start: Start) -> Told:
    """What the laws of MODELE replace in RIGI: joints of other laws or of other parameters."""
    inputs = start.inputs
    if inputs.model is None or inputs.characteristics is None:
        return
    zones = joint_zones(inputs.model)
    gone = replaced_blocks(inputs.stiffness, zones)
    for block in gone:
        of = [z.behaviour for z in zones if same_elements(block.zone, z)]
        if block.zone and block.zone.behaviour not in of:
            told = {"node": block.table.told(int(block.nodes[0, 0])), "count": len(block.nodes)}
            yield "operators.dynamics.springs-replaced", told
    for zone in zones:
        if off := unlike(gone, zone, inputs.characteristics):
            yield "operators.dynamics.joints-of-others", {"off": off}


def _mass_held(start: Start) -> Told:
    """A mass that supports hold, all but a hundredth of it."""
    problem = start.problem
    mass, along = problem.M, translations(problem)
    moved = np.asarray((along * (mass @ along)).sum(axis=1), float)
    still = held(problem)
    if moved[still].sum() > HELD * moved.sum() > 0.0 and not problem.loading.imposed.any():
        told = {"held": moved[still].sum() / along.shape[1], "whole": moved.sum() / along.shape[1]}
        node = problem.numbering.told(moved * still)
        yield "operators.dynamics.mass-held", {**told, "node": node}


def _mass_missing(start: Start) -> Told:
    """Cells with a density of which no node has a mass, but for those that other cells have."""
    numbering, blocks = start.problem.numbering, start.inputs.stiffness.blocks
    heavy = numbering.nodes[start.problem.M.diagonal() != 0.0]
    moved = numbering.nodes[~held(start.problem)]
    for block in (b for b in blocks if b.dense and len(heavy)):
        others = (b.nodes.ravel() for b in blocks if b.zone and b is not block)
        own = np.setdiff1d(block.nodes, np.concatenate([heavy[:0], *others]))
        if np.isin(own, moved).any() and not np.isin(own, heavy).any():
            told = {"node": numbering.table.told(int(own[0])), "count": len(block.nodes)}
            yield "operators.dynamics.mass-missing", told


def _viscosity_unread(start: Start) -> Told:
    if start.inputs.damping is None and any(b.viscous for b in start.inputs.stiffness.blocks):
        yield "operators.dynamics.viscosity-unread", {}


def _masses_alone(start: Start) -> Told:
    if len(nodes := masses_alone(start.problem)):
        told = {"count": len(nodes), "node": start.problem.numbering.table.told(nodes[0])}
        yield "operators.dynamics.masses-alone", told


def _on_supports(start: Start) -> Told:
    names = dict.fromkeys(start.names[k] for k in on_supports(start))
    other_side = bool(names) and len(_held_on_the_other_side(start.problem, start.inputs)) > 0
    for name in names:
        told = {"name": name, "other_side": other_side}
        yield "operators.dynamics.load-on-supports", told
    problem, forces = start.problem, start.problem.loading.forces
    if not problem.interface:
        return
    bare = held(problem) & (problem.K.diagonal() == 0.0) & (problem.M.diagonal() == 0.0)
    for k in np.flatnonzero(forces[bare].any(axis=0)).tolist():
        if start.names[k] not in names:
            force = np.abs(forces[:, k])
            told = {"name": start.names[k], "node": problem.numbering.told(force * bare)}
            told["part"] = 100.0 * force[bare].sum() / force.sum()
            yield "operators.dynamics.force-on-ground", told


def _held_on_the_other_side(problem: Problem, inputs: Inputs) -> IntArray:
    """Unknowns (n,) held on one side of joints whose other side stands on nothing."""
    nodes, still = problem.numbering.nodes, held(problem)
    if not problem.interface:
        return np.zeros(0, np.int64)
    resolve, zones = problem.numbering.table.resolve, inputs.model.zones if inputs.model else ()
    bodies = [resolve(z.cells.raw).ravel() for z in zones if not is_joint(z)]
    borne = abs(problem.constraints.C).sum(axis=0) + problem.K.diagonal() != 0.0
    laden = (problem.M.diagonal() != 0.0) | problem.loading.forces.any(axis=1)
    lying = np.concatenate([nodes[laden], *bodies])
    bare = ~still & ~borne & ~np.isin(nodes, lying)
    sides = [[resolve(s).ravel() for s in (j.lower, j.upper)] for j in problem.interface.joints]
    for a, b in (way for pair in sides for way in (pair, pair[::-1])):
        if np.isin(a, nodes[still]).all() and np.isin(b, nodes[bare]).all():
            return np.flatnonzero(still & np.isin(nodes, a))
    return np.zeros(0, np.int64)


def _sinks(start: Start) -> Told:
    for sunk in start.sunk():
        yield "operators.dynamics.sinks-in", vars(sunk)


def _loose(start: Start) -> Told:
    problem = start.problem
    alone = not (problem.interface or problem.contact)
    if alone and problem.numbering.size > MOST_ALONE:
        return
    joints, loose = problem.interface, [*start.loose()]
    slides = bool((joints.parameters[:, Parameter.KS1] == 0.0).any())
    away = (s for s in start.swings if np.isinf(s.period) and start.stirs(s.motion, start.size))
    if not loose and problem.constraints.C.nnz and any(True for _ in away):
        macro = any(is_macro(j.zone) for j in joints.joints)
        yield "operators.dynamics.turns-away", {"macro": macro, "slides": slides}
    for found in loose:
        told = {"node": found.node, "axis": found.axis}
        if found.pressed:
            yield "operators.dynamics.nothing-presses", told
        else:
            told |= {"joints": bool(joints), "slides": slides}
            yield "operators.dynamics.slides-away", told


def _swings(start: Start) -> Told:
    problem, found = start.problem, start.swings
    dt = float(np.diff(problem.times).max())
    period = min((s.period for s in found if s.sudden), default=dt)
    ratio = max((s.damping for s in found), default=0.0)
    if FEWEST * dt > period > 0.0 and any(s.sudden for s in found):
        told = {"dt": dt, "period": period, "wanted": period / WANTED, "steps": WANTED}
        told["dt_over"] = dt / period
        yield "operators.dynamics.step-over-period", told
    longest = max((s.period for s in found), default=np.inf)
    least, lasts = min((s.period for s in found), default=0.0), float(np.ptp(problem.times))
    if lasts < BRIEF * least < np.inf and len(problem.times) > TRIED:
        yield "operators.dynamics.ends-early", {"lasts": lasts, "period": least}
    strikes = problem.interface or len(problem.contact) or any(s.sudden for s in found)
    if longest < FEWEST * dt and not strikes and start.shaking.any():
        told = {"period": longest, "steps": longest / dt}
        yield "operators.dynamics.shaken-as-rigid", told
    if any(s.damping < 0.0 for s in found):
        yield "operators.dynamics.driven-by-dashpots", {"ratio": min(s.damping for s in found)}
    if ratio > OVERDAMPED:
        yield "operators.dynamics.overdamped", {"ratio": ratio}


GUARDS: tuple[Callable[[Start], Told], ...] = (
    _motion_elsewhere, _motion_against_supports, _imposed_elsewhere, _not_conserved,
    _joints_of_others, _on_supports, _mass_held, _viscosity_unread, bridged, unequal_joints,
    ground_twice, footing_too_wide, sides_unlike, beside_free_field, matter_amiss,
    rotary_alone, weak_cores, mass_of_both, damped_heavily, stops_turned, stops_across,
    weight_of_part, mass_of_beam, masses_apart, _mass_missing, hangs_on_springs, stops_on_held,
)  # fmt: skip
"""Each gives the codes of warnings with their data."""
IN_STATICS = (
    _imposed_elsewhere, _on_supports, bridged, unequal_joints, ground_twice, footing_too_wide,
    stops_on_held, _sinks,
)  # fmt: skip
OF_STIFFNESS = (
    _masses_alone, _sinks, _loose, _swings, out_of_balance, velocity_of_rest, turns_heavily,
    bodies_stand, braked, rest_of_others,
)  # fmt: skip
"""Those that need the stiffness of all bodies: that of plastic ones stands in their law."""


def warn_of_motion(entries: Entries, start: Start, track: NodeHistories) -> None:
    """Warn where the last instant kept has moved by many times the model's size, or far round."""
    problem, numbering = start.problem, start.problem.numbering
    along, round_about = (
        np.isin(numbering.codes, [numbering.code(a) for a in names if a in numbering.unknowns])
        for names in (AXES, ("RX", "RY", "RZ"))
    )
    if not len(track) or not along[track.unknowns].any():
        return
    last = track.instant(len(track) - 1)
    u, moved = last.values("u")[0], bool(last.values("v")[0].any())
    ended = track.unknowns, u, moved, bool(problem.C.count_nonzero())
    workspace(entries.call.session).ended = ended
    loose = start.bodies() if problem.interface or len(problem.contact) else ()
    turn = float(np.abs(u[round_about[track.unknowns]]).max(initial=0.0))
    tips = max((_turn(problem, body.own, track.unknowns, u) for body in loose), default=0.0)
    if turn > TURNED or tips > TIPPED:
        entries.warn("operators.dynamics.turns-far", turn=max(turn, tips), tips=tips > TIPPED)
    way = float(np.abs(u[along[track.unknowns]]).max())
    size = float(np.ptp(numbering.table.coordinates[numbering.nodes[along]], axis=0).max())
    if way > FAR * size > 0.0:
        entries.warn("operators.dynamics.moves-far", way=way, size=size, times=way / size)


def _turn(problem: Problem, own: BoolArray, kept: IntArray, u: FloatArray) -> float:
    """Rotation (rad) of a body, by the displacements u (n,) of those of its unknowns kept."""
    motions, mine = rigid_motions(problem.numbering, np.zeros(3))[kept], own[kept]
    return float(np.linalg.norm(np.linalg.lstsq(motions[mine], u[mine])[0][3:]))


def warn_of_bowls(entries: Entries, joints: Interface, track: NodeHistories) -> None:
    """Warn of pendulums that travel so far that their bowl is steeper than their law has it."""
    if not len(track) or not (joints.codes == LawCode.PENDULUM).any():
        return
    ways = np.linalg.norm(track.joints("w")[..., :-1], axis=-1).max(axis=0)
    radii = joints.parameters[:, Parameter.RAYO]
    far = (joints.codes == LawCode.PENDULUM) & (ways > STEEP * radii)
    if far.any():
        told = {"way": ways[far].max(), "radius": radii[far][ways[far].argmax()]}
        entries.warn("operators.dynamics.travels-far", **told, share=told["way"] / told["radius"])


def warn_of_loads(
    entries: Entries | Call, load: Load | None, times: FloatArray, *, at_rest: bool = False
) -> None:
    """Warn of curves of loads that begin late, end early, or change between the instants.

    A calculation that starts `at_rest` is asked what of them lies before it.
    """
    parts = () if load is None or len(times) < 2 else load.parts
    known: set[tuple[int, bytes]] = set()
    for part in parts:
        curves = () if part.time is None else part.time.parts
        values = (v.tobytes() for c in curves for v in (c.abscissas, c.ordinates))
        key = id(part.space), b"".join(values)
        if key in known and part.time is not None:
            entries.warn("operators.dynamics.load-twice", name=part.name)
        known.add(key)
        for curve in curves:
            for code, told in _flaws(curve.abscissas, curve.ordinates, times, at_rest):
                entries.warn(code, name=part.name, **told)


def _flaws(x: FloatArray, y: FloatArray, times: FloatArray, at_rest: bool) -> Told:
    """What a curve (x, y) and the instants of a calculation have not in common."""
    size, slack = float(np.abs(y).max(initial=0.0)), 1e-6 * float(times[-1] - times[0])
    if len(x) < 2 or not size:
        return
    first, last = float(times[0]), float(times[-1])
    told = {"first": first, "last": last, "begin": float(x[0]), "end": float(x[-1])}
    if x[0] >= last or x[-1] <= first:
        yield "operators.dynamics.load-outside", told
        return
    if x[0] > first + slack and abs(y[0]) > NOUGHT * size and abs(y[1] - y[0]) > NOUGHT * size:
        yield "operators.dynamics.load-begins", told | {"value": float(y[0])}
    short = NEARLY if last - x[-1] <= 1.01 * (x[-1] - x[-2]) else NOUGHT
    if x[-1] < last - slack and min(abs(y[-1]), abs(y[-1] - y[-2])) > short * size:
        yield "operators.dynamics.load-ends", told | {"value": float(y[-1])}
    saw = float(np.abs(np.append(y[x <= last], np.interp(last, x, y))).max())
    ends = [0, int(np.abs(y).argmax())]
    ahead = AHEAD
    if np.abs(y - np.interp(x, x[ends], y[ends]))[: ends[1] + 1].max() < NOUGHT * size:
        # the time itself may be the factor of the load; what reaches 1 later is the whole load
        ahead = HALF if size == 1.0 != x[ends[1]] - x[0] else STAGED
    if np.abs(y[x > last]).max(initial=0.0) > ahead * saw > 0.0:
        yield "operators.dynamics.load-ahead", told | {"value": saw, "most": size}
    before = np.append(y[x < first], np.interp(first, x, y))
    if at_rest and np.abs(np.diff(before)).sum() > SWUNG * size:
        yield "operators.dynamics.load-before", told
    inside = (x > first) & (x < last)
    seen = np.interp(x[inside], times, np.interp(times, x, y))
    off = np.abs(seen - y[inside])
    if off.max(initial=0.0) > MISSED * size:
        at = int(off.argmax())
        told |= {"time": float(x[inside][at]), "value": float(y[inside][at])}
        yield "operators.dynamics.load-missed", told | {"seen": float(seen[at])}


def warn_of_strength(entries: Entries, problem: Problem) -> None:
    """Warn of joints out of proportion, of what has no mass, of ground that yields."""
    warn_contrast(entries, problem)
    warn_massless(entries, problem)
    warn_overloaded(entries, problem)


def warn_of_contact(
    entries: Entries, problem: Problem, extremes: Extremes | None = None, off: float | None = None
) -> None:
    """Warn when the step does not resolve contact that was lost, as far as is known.

    Energies `off` by next to nothing, of the largest, show that it does, but where they are kept
    (None: not known).
    """
    found, known = contact_resolution(problem), {} if extremes is None else extremes.found()
    lost = known.get(("OUVERTURE", ""))
    if found is None or found.resolved or (lost is not None and not lost.value):
        return
    if any(map(entries.call.session.warned, OF_MASS)):
        return  # of the mass that is left
    code = "operators.dynamics.contact-not-resolved"
    keeps = conserved(problem.interface)
    told = {n: getattr(found, n) for n in ("dt", "contact_time", "wanted_dt")}
    if (kept := keeps and problem.scheme.conserving) or off is None or off > RESOLVED:
        entries.warn(code, **told, conserved=keeps, kept=kept)


def warn_overloaded(entries: Entries, problem: Problem) -> None:
    """Warn of footings that the loads of the start already press into ground that yields."""
    for found in overloads(problem, problem.loading.at(problem.times[:1])[0]):
        told = {"node": problem.numbering.table.told(found.node), "pressing": found.pressing}
        entries.warn("operators.dynamics.footing-overloaded", **told, capacity=found.capacity)


def warn_massless(entries: Entries, problem: Problem) -> None:
    """Warn where a body that only joints hold, or all, has no mass: forgotten, most often."""
    joints = problem.interface
    bodies = loose_bodies(problem, np.zeros((joints.n_points, joints.dimension)))
    massless = [body for body in bodies if body.mass == 0.0]
    if massless:
        node = problem.numbering.table.told(massless[0].node)
        others = len(massless) - 1
        if taken := _taken_for(problem, massless[0].node):
            entries.warn("operators.dynamics.joint-side-alone", node=node, other=taken)
        else:
            entries.warn("operators.dynamics.body-without-mass", node=node, others=others)
    if not massless and not problem.M.count_nonzero() and not problem.C.count_nonzero():
        entries.warn("operators.dynamics.no-mass")


def _taken_for(problem: Problem, node: int) -> str:
    """Where joints alone have a node, the one at its place with bodies on both sides of them."""
    numbering, joints, K = problem.numbering, problem.interface, sp.csr_array(problem.K)
    nodes, points = numbering.nodes, numbering.table.coordinates
    stiff, here = abs(K).sum(axis=1) > 0.0, nodes == node
    if not joints or stiff[here].any() or problem.constraints.C[:, here].nnz:
        return ""
    normal = joints.B[:, -1].reshape(-1, joints.dimension).sum(axis=0)
    near = ROUNDING * np.ptp(points[nodes], axis=0).max()
    for other in np.unique(nodes[stiff & (np.abs(points[nodes] - points[node]).max(1) <= near)]):
        beside = points[nodes[K[nodes == other].indices], : len(normal)]
        heights = (beside - points[node, : len(normal)]) @ normal
        if heights.min() < -near < near < heights.max():
            return numbering.table.told(int(other))
    return ""


def warn_of_bodies(entries: Entries, inputs: Inputs) -> None:
    """Warn of bodies, those that yield among them, that touch and are not joined."""
    zones = () if inputs.model is None else inputs.model.zones
    nodes = bodies_apart(inputs.stiffness, zones)
    if len(nodes) and not any(z.formulation == "CONTACT" for z in zones):
        told = {"count": len(nodes), "node": inputs.stiffness.table.told(int(nodes[0]))}
        entries.warn("operators.matrices.bodies-apart", **told)


def warn_of_parts(entries: Entries, problem: Problem, inputs: Inputs) -> None:
    """Warn of conditions on the wrong side of joints, and on cells that stand in no model."""
    for row in _held_on_the_other_side(problem, inputs)[:1].tolist():
        told = {"unknown": problem.numbering.label(row), "supports": SUPPORTS[entries.procedure]}
        entries.warn("operators.dynamics.footing-held", **told)
    model, given = entries.get("MODELE"), entries.get("CARACTERISTIQUES")
    stiff, zones = inputs.stiffness, () if model is None else model.zones
    resolve, none = stiff.table.resolve, np.zeros(0, np.int64)
    known = [b.nodes.ravel() for b in stiff.blocks]
    known += [resolve(z.cells.raw).ravel() for z in zones]
    lost = np.setdiff1d(resolve(terms_of(stiff).nodes), np.concatenate([none, *known]))
    for block in given.blocks if isinstance(given, CellField) and len(lost) else ():
        if len(own := np.intersect1d(resolve(block.cells.raw), lost)):
            told = {"count": len(block.cells), "node": stiff.table.told(int(own[0]))}
            entries.warn("operators.statics.material-without-model", **told)
            return


def warn_of_connections(entries: Entries, inputs: Inputs) -> None:
    """Warn of supports beside the body, joints the wrong way round, beams on single nodes."""
    place = entries.call.session, entries.place, entries.procedure
    laden = [] if inputs.mass is None else [b.nodes.ravel() for b in inputs.mass.blocks]
    warn_connections(*place, inputs.stiffness, inputs.model, inputs.characteristics, laden)
    for kind, matrix in (("MASS", inputs.mass), ("AMOR", inputs.damping)):
        if matrix is not None:
            warn_repeated(*place, matrix, kind, inputs.stiffness)
    others = {b.kind for b in inputs.stiffness.blocks} & {"MASSE", "AMORTISSEMENT"}
    if others and not all(b.kind == "MASSE" for b in inputs.stiffness.blocks):
        entries.warn("operators.matrices.kind-in-stiffness", kind="AMORTISSEMENT" in others)
    damping = () if inputs.damping is None else inputs.damping.blocks
    dashpots = [b for b in damping if b.kind == "AMORTISSEMENT"]
    for node in idle_nodes(dashpots, inputs.stiffness)[:1].tolist():
        told = {"node": inputs.stiffness.table.told(node)}
        entries.warn("operators.dynamics.dashpots-on-supports", **told)
    springs, braking = _nodal(inputs.stiffness.blocks), _nodal(dashpots)
    for (node, unknown), value in sorted(braking.items() & springs.items())[:1]:
        told = {"node": inputs.stiffness.table.told(node), "unknown": unknown, "value": value}
        entries.warn("operators.dynamics.dashpot-of-spring", **told)
    for found in (springs, braking):
        ways = [(n, u, v, a) for (n, u), v in found.items() for a in AXES if u[0] == "R"]
        for node, unknown, value, other in [w for w in ways if found.get((w[0], w[3])) == w[2]][:1]:
            told = {"node": inputs.stiffness.table.told(node), "value": value, "other": other}
            entries.warn("operators.dynamics.turns-as-moves", unknown=unknown, **told)
    for block in damping:
        diagonal = np.diagonal(block.values, axis1=1, axis2=2)
        drives = diagonal.max(initial=0.0) <= 0.0 > diagonal.min(initial=0.0)
        if drives and block.kind != "AMORTISSEMENT":  # absorbing layers have parts of either sign
            node = block.table.told(int(block.nodes[0, 0]))
            entries.warn("operators.dynamics.damping-negative", node=node, kind=block.kind)
            break


def _nodal(blocks: Iterable[Any]) -> dict[tuple[int, str], float]:
    """Springs or dashpots by node and unknown, but those of round numbers."""
    return {
        (node, unknown): value
        for b in blocks
        if b.raw_nodes.shape == (1, 1)
        for node in b.nodes[:, 0].tolist()
        for unknown, value in zip(b.unknowns, np.diagonal(b.values[0]).tolist(), strict=True)
        if float(f"{value:.3g}") != value
    }


def warn_at_rest(entries: Entries, problem: Problem) -> None:
    """Warn of a motion that nothing starts, and of one that starts again where another ended."""
    loading = problem.loading
    acting = loading.at(problem.times).any(axis=0)
    moved = loading.forces[:, acting].any() or loading.imposed[:, acting].any()
    given = moved or problem.u.any() or problem.v.any() or entries.get("REPRISE") is not None
    unseen = entries.call.session.warned("operators.dynamics.load-missed")
    if not (given or unseen or problem.contact or entries.flag("CHARMECA")):
        entries.warn("operators.dynamics.nothing-moves")
    energies, first = entries.table.get(Mot("ENERGIES")), float(problem.times[0])
    before = energies.get(Mot("TEMPS")) if isinstance(energies, Table) else None
    again = isinstance(before, ListReel) and np.isclose(first, before.values[-1])
    at, u, moved, damped = workspace(entries.call.session).ended
    on = problem.u[at] if at.max(initial=0) < len(problem.u) else u[:0]
    goes_on = on.any() and len(on) == len(u) and np.abs(on - u).max() < ROUNDING * np.abs(u).max()
    if not problem.v.any() and (again or (goes_on and moved)):
        entries.warn("operators.dynamics.begins-again", first=first)
    if goes_on and damped and not problem.C.count_nonzero():
        entries.warn("operators.dynamics.goes-on-undamped")


def warn_contrast(entries: Entries, problem: Problem) -> None:
    """Warn when joints are out of all proportion to the bodies: units, most often."""
    found = joint_conditioning(problem)
    if found is not None and found.joints_are_to_blame:
        if entries.call.session.warned("operators.models.thicker-than-large"):
            return  # it is the shell's stiffness that is out of proportion
        told = {n: getattr(found, n) for n in ("number", "digits", "balanced", "kn", "wanted_kn")}
        entries.warn("operators.dynamics.badly-conditioned", **told)
        return
    ratio = stiffness_contrast(problem)
    if ratio is None or 1 / STRANGE <= ratio <= STRANGE:
        return
    told = {"stiffer": ratio if ratio > 1 else 0.0, "softer": 1 / ratio}
    entries.warn("operators.dynamics.joints-out-of-proportion", **told)
