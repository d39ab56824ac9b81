"""What DYNAMIC warns of how bodies stand: in balance or not, on what bears them, with which weight.

A body that no-tension joints bear is in balance where the resultant of what presses it lies within
them: the levers of all points about an axis have its own between them.
"""

from collections.abc import Iterable
from itertools import product
from typing import Any, cast

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.graph import chains, parts_of
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.interface import Interface, is_macro
from ssilang.kernel.interface.laws.columns import LawCode, Parameter
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.statics.doubled import bodies_of_nodes
from ssilang.kernel.statics.linear_motion import rigid_motions
from ssilang.kernel.stepping.problem.bodies import ROUNDING, bodies_of, held
from ssilang.kernel.stepping.problem.initial import joint_state
from ssilang.kernel.stepping.problem.plausibility import Body, Start, Told
from ssilang.kernel.stepping.problem.problem import Problem, closed_forces
from ssilang.kernel.waves.shaken import (
    AXES,
    GRAVITIES,
    LARGE,
    matter,
    shares,
)
from ssilang.language.vocabulary.unit_systems import MATTER, WAVES
from ssilang.operators.matrices.connections import rotary_without_mass

TURNS = ("RX", "RY", "RZ")
OTHER_SIDE = "operators.dynamics.held-from-the-other-side"
WEIGHT_TWICE = "operators.dynamics.weight-twice"
FAR_MASS = 20.0  # sizes of the model that a radius of gyration may be: a chimney has ten widths
LARGEST = 100.0  # m; a structure that is a point on a short joint may have less
OFF = 1e-3  # of a load's factor: less is no other one
REST_OFF = 0.02  # of the forces of joints: more are those of others
FEW_STOPS = 50
NEAR = 1.1  # times a load that stays as it is: what is held by more was pulled, to let it go
AWAY = 0.2  # of the largest push: a mean that drives a body from its support
AGAIN = 5e-3  # of the weight of a mass, that is rounding of g
SAME_MASS = 0.01  # of a beam
SAME_PULL = 1e-6  # of what a node weighs by its mass
TIMES = 10.0  # masses of a body over that of its weight
HEAVIER = 2.0, 30.0  # weights over that of its mass: ties, and a footing's own, press without one
IN_FEET = 32.174, 386.09  # ft/s2, in/s2
UNEQUAL = 300.0  # times the stiffness of other joints under a body
STIFF = 100.0  # times that of the ground's cells: a macro-element that only lifts and slides
BRAKED = 5.0  # of sqrt(g / size): damping that a fall from a block's own height hardly begins
OF_BEARINGS = 0.2  # of the critical damping, beside that of bearings
STOREYS = 3  # masses: two may be oscillators
PAIR = 2  # terms of a relation of two nodes
CORES = 2e-3  # of the weight: lead yields at some 0.03 to 0.1 of it
STRONG = 0.3  # of it: what no ground motion but the strongest makes yield
BESIDE, EDGE = 1e-6, 0.02  # of a footing's width; from its edge, where any push turns it over
WIDE = 20.0  # sizes of a model
TONNE, TONNES = 1000.0, 0.5  # kg; density of ground in t/m3 at least
LIGHTER = {False: 30.0, True: 10.0}
"""Times the density of other solids; below them, where buildings as one solid do not stand."""
MASSLESS, FOAM = 5000.0, 500.0  # times: beyond, no mass is meant; m/s, of waves of shear
ALIKE = 0.1  # of a density, that is the same ground's


def out_of_balance(start: Start) -> Told:
    """Displacements of the start that are held by a load that is not yet there, or not so large."""
    problem = start.problem
    loading, T = problem.loading, problem.constraints.T
    if not problem.u.any() or not 0 < loading.forces.size < LARGE:
        return
    held, forces = T.T @ _held_at_start(problem), T.T @ loading.forces
    if 0 < len(problem.contact) <= FEW_STOPS:
        stops = (T.T @ problem.contact.G.T).toarray()  # whatever they bear
        held, forces = (f - stops @ np.linalg.lstsq(stops, f)[0] for f in (held, forces))
    share = shares(forces, held[:, None])[:, 0]
    begins, ends = start.factors[[0, -1]]
    off = np.abs(forces @ begins - held).max(initial=0.0) > OFF * np.abs(held).max(initial=0.0)
    for k in np.flatnonzero(off & (np.abs(begins - share) > OFF * share)).tolist():
        still = start.changing[k] or share[k] > NEAR * begins[k]
        if share[k] > OFF and (abs(ends[k] - share[k]) <= OFF * share[k] or not still):
            yield "operators.dynamics.out-of-balance", {"begins": begins[k], "held": share[k]}


def rest_of_others(start: Start) -> Told:
    """Displacements at which bodies are in balance with the loads of the start, joints are not.

    Neither closed nor as they are: those that open or slip at rest are closed in RESO.
    """
    problem, joints = start.problem, start.problem.interface
    loading, T = problem.loading, problem.constraints.T
    if not joints or problem.contact or not problem.u.any():
        return
    acting, of_joints = T.T @ (loading.forces @ start.factors[0]), abs(joints.J @ T).sum(axis=0) > 0
    held = _held_at_start(problem), closed_forces(problem, problem.u)
    off = np.abs(T.T @ np.stack(held, axis=1) - acting[:, None])
    balanced = off[~of_joints, 0].max(initial=0.0) < OFF * np.abs(acting).max(initial=0.0)
    size = np.abs(T.T @ (held[0] - problem.K @ problem.u)).max(initial=0.0) or np.inf
    part = off[of_joints].max(axis=0, initial=0.0).min() / size
    if balanced and acting[~of_joints].any() and part > REST_OFF:
        yield "operators.dynamics.rest-of-others", {"part": 100.0 * part}


def weight_of_part(start: Start) -> Told:
    """Bodies that weigh at some nodes what their mass does, less at others: by loads, by 'DEPL'.

    Nothing at all is less, too, but on bodies that something holds: ground with its structure.
    """
    problem = start.problem
    nodes, table = problem.numbering.nodes, problem.numbering.table
    forces = [start.weight, *([_held_at_start(problem)] if problem.u.any() else [])]
    for body, (rest, force) in product(start.bodies(), enumerate(forces)):
        mass, weight = body.up * (problem.M @ body.up), -body.up * force
        heavy = np.flatnonzero(mass > 0.0)
        pull = weight[heavy] / mass[heavy]
        usual = float(pull.max(initial=0.0))
        known = usual * (OFF if rest else SAME_PULL)  # what is held was solved for
        same, least = np.abs(pull - usual) < known, known if start.holds(body.up) else -known
        less = (pull > least) & (pull < (1.0 - AGAIN) * usual)
        if not ((same | less).all() and any(abs(usual / g - 1.0) < 0.01 for g in GRAVITIES)):
            continue
        heights = table.coordinates[nodes[heavy], len(start.axes) - 1]
        less &= heights > heights.min() + BESIDE * body.size  # ground moves with a footing
        if less.any():
            worst = int(heavy[less][np.argmin(pull[less])])
            told = {"mass": mass[worst], "weighs": weight[worst] / usual + 0.0, "rest": bool(rest)}
            told |= {"count": int(less.sum()), "share": 100.0 * weight.sum() / (usual * body.mass)}
            yield "operators.dynamics.weight-of-part", told | {"node": table.told(nodes[worst])}
            return


def _held_at_start(problem: Problem) -> FloatArray:
    """Forces (n,) of stiffness and joints for the displacements of the start."""
    return np.asarray(problem.K @ problem.u + problem.interface.J.T @ joint_state(problem).f)


def velocity_of_rest(start: Start) -> Told:
    """A velocity of the start that is the displacement which its loads hold at rest."""
    problem = start.problem
    loading, T = problem.loading, problem.constraints.T
    if problem.v.any() and loading.forces.size < LARGE:
        forces = T.T @ (loading.forces @ start.factors[0])
        off = np.abs(T.T @ closed_forces(problem, problem.v) - forces).max(initial=0.0)
        if off < OFF * np.abs(forces).max(initial=0.0):
            yield "operators.dynamics.velocity-of-rest", {}


def turns_heavily(start: Start) -> Told:
    """Bodies whose rotary inertia is that of a mass many sizes of the model away."""
    problem, numbering = start.problem, start.problem.numbering
    label, size = bodies_of(problem), max(start.size, _width(problem))
    if not start.axes or not size:
        return
    lifts = (numbering.codes == numbering.code(start.axes[-1])).astype(float)
    mass = np.bincount(label, lifts * (problem.M @ lifts))
    for axis in [a for a in TURNS if a in numbering.unknowns]:
        turn = (numbering.codes == numbering.code(axis)).astype(float)
        inertia = np.bincount(label, turn * (problem.M @ turn))
        body = int((inertia - (FAR_MASS * size) ** 2 * mass).argmax())
        way = float(np.sqrt(inertia[body] / (mass[body] or np.inf)))
        if way > max(FAR_MASS * size, LARGEST):
            node = numbering.told(label == body)
            told = {"node": node, "inertia": inertia[body], "mass": mass[body], "size": size}
            yield "operators.dynamics.turns-heavily", {**told, "way": way}
            return


def rotary_alone(start: Start) -> Told:
    """Rotary inertia where masses are meant, but for that of masses far away, told already."""
    found = None if start.inputs.mass is None else rotary_without_mass(start.inputs.mass)
    if found is not None and not any(True for _ in turns_heavily(start)):
        yield "operators.matrices.rotary-alone", found


def stops_turned(start: Start) -> Told:
    """Stops that keep two nodes from parting, at the very distance at which these lie."""
    contact, numbering = start.problem.contact, start.problem.numbering
    if not len(contact) or not {*numbering.unknowns} & {*AXES}:
        return
    along = np.array([AXES.index(u) if u in AXES else 0 for u in numbering.unknowns])
    G, points = contact.G, numbering.table.coordinates
    apart, pair = G @ points[numbering.nodes, along[numbering.codes]], np.diff(G.indptr) == PAIR
    off = np.abs(contact.imposed @ start.factors[0] - apart)
    for k in np.flatnonzero(pair & (apart < 0.0) & (off < BESIDE * np.abs(apart))).tolist():
        row = G[[k]]
        if (G @ row.T).min() >= 0.0:  # else one of them is a stop, the other one a hook
            nodes = [numbering.table.told(n) for n in numbering.nodes[row.indices]]
            told = {"node": nodes[0], "other": nodes[1], "gap": -apart[k]}
            yield "operators.dynamics.stop-turned", told
            return


def stops_across(start: Start) -> Told:
    """Stops of which none acts: no load, no motion of the start moves anything along one."""
    problem, factors = start.problem, start.factors
    contact, C = problem.contact, problem.constraints.C
    if not len(contact) or (contact.imposed @ factors.T).max() > 0.0:
        return
    rows = C, contact.G, problem.interface.J
    linked = sp.coo_array(abs(problem.K) + abs(problem.M) + abs(problem.C))
    strong = linked.data > ROUNDING * linked.diagonal()[linked.row]
    pairs = cast(IntArray, linked.row[strong]), cast(IntArray, linked.col[strong])
    label = parts_of(problem.numbering.size, pairs, *map(chains, map(sp.csr_array, rows)))
    moved = problem.loading.forces.any(axis=1) | (problem.u != 0.0) | (problem.v != 0.0)
    moved |= abs(C.T) @ np.abs(problem.loading.imposed).sum(axis=1) > 0.0
    if not np.isin(label[contact.G.indices], label[moved]).any() and moved.any():
        node = problem.numbering.told(abs(contact.G[[0]]).toarray()[0])
        yield "operators.dynamics.stops-across", {"node": node, "count": len(contact)}


def hangs_on_springs(start: Start) -> Told:
    """Bodies that turning springs at their highest node alone hold: a footing's, at the top."""
    problem, numbering = start.problem, start.problem.numbering
    if problem.interface or problem.contact:
        return
    springs = [b for b in start.inputs.stiffness.blocks if b.raw_nodes.shape[1] == 1]
    turning = [b for b in springs if not {*TURNS}.isdisjoint(b.unknowns)]
    at, turn = ([n for b in bs for n in b.nodes[:, 0]] for bs in (springs, turning))
    still, table = held(problem), numbering.table
    for body in start.bodies() if turning else ():
        nodes = np.unique(numbering.nodes[body.own])
        heights = table.coordinates[nodes, len(start.axes) - 1] * (1.0 - 2.0 * (body.weight < 0.0))
        borne, below = np.isin(nodes, at), heights < heights.max() - BESIDE * body.size
        stands = still[body.own].any() or (below & borne).any() or not below.any()
        if not stands and np.isin(nodes[borne], turn).any():
            yield "operators.dynamics.hangs-on-springs", {"node": table.told(nodes[borne][0])}


def mass_of_both(start: Start) -> Told:
    """Two nodes of one place that move together, each with the mass of a line of nodes."""
    given = [] if start.inputs.mass is None else start.inputs.mass.blocks
    lumps = [b for b in given if b.zone is None and b.raw_nodes.shape == (len(b.nodes), 1)]
    table = start.problem.numbering.table
    for r in start.inputs.stiffness.relations if lumps else ():
        first = r.row_start[:-1][(np.diff(r.row_start) == PAIR) & (r.sense == 0)]
        a, b = r.nodes[first], r.nodes[np.minimum(first + 1, len(r.nodes) - 1)]
        one = np.abs(table.coordinates[a] - table.coordinates[b]).max(axis=1, initial=0.0) < BESIDE
        for k, lump in product(np.flatnonzero(one & (a != b)).tolist(), lumps):
            name, other = r.unknowns[first[k] :][:PAIR]
            opposed = not r.coefficients[first[k] :][:PAIR].sum()
            several = name == other and opposed and name in lump.unknowns
            if several and len(lump.nodes) > PAIR and np.isin([a[k], b[k]], lump.nodes).all():
                told = {"node": table.told(a[k]), "unknown": name}
                yield "operators.dynamics.mass-of-both", told
                return


def mass_of_beam(start: Start) -> Told:
    """Masses of one statement on the nodes of a beam that are its own mass once more."""
    given = [] if start.inputs.mass is None else start.inputs.mass.blocks
    beams = [b for b in given if b.raw_nodes.shape[1] == PAIR]
    for lump in (b for b in given if b.zone is None and b.raw_nodes.shape == (len(b.nodes), 1)):
        axis = lump.unknowns[0]
        mass = float(lump.values[:, 0, 0].sum())
        of = [(b, np.isin(b.nodes, lump.nodes).all(axis=1)) for b in beams if axis in b.unknowns]
        nodes, own, cells = [lump.nodes[:0]], 0.0, 0
        for beam, on in of if axis in AXES else ():
            at = [i for i, name in enumerate(beam.unknowns) if name == axis]
            own += float(beam.values[on][:, at][:, :, at].sum())
            nodes.append(beam.nodes[on].reshape(-1, 1))
            cells += int(on.sum())
        count, spread = len(np.unique(np.concatenate(nodes))), mass / len(lump.nodes)
        twice = min(abs(mass - own), abs(spread * cells - own)) < SAME_MASS * own
        if cells >= PAIR and count == len(np.unique(lump.nodes)) and twice:
            told = {"count": count, "mass": mass, "own": own}
            yield "operators.dynamics.mass-of-beam", told
            return


def masses_apart(start: Start) -> Told:
    """Masses one above another, each on a spring of its own to the ground, two of them alike."""
    problem, numbering, up = start.problem, start.problem.numbering, len(start.axes) - 1
    k, m, points = problem.K.diagonal(), problem.M.diagonal(), numbering.table.coordinates
    alone = np.flatnonzero((m > 0.0) & (k > 0.0) & (np.diff(problem.K.indptr) <= 2 * up + 2))
    alone = alone[abs(problem.K[alone]).sum(axis=1) == k[alone]]  # of points: never all of it
    for tie in (problem.constraints.C, problem.interface.J, problem.contact.G):
        alone = alone[abs(tie[:, alone]).sum(axis=0) == 0.0]
    for axis in np.flatnonzero(np.abs(start.shaking[:up]).sum(axis=1)):
        rows = alone[numbering.codes[alone] == numbering.code(start.axes[axis])]
        places = points[numbering.nodes[rows]].round(6)
        for plan in np.unique(places[:, :up], axis=0):
            own = rows[(places[:, :up] == plan).all(axis=1)]
            heights, swings = points[numbering.nodes[own], up], np.sort(k[own] / m[own])
            alike = (np.diff(swings) < BESIDE * swings[1:]).any() if len(own) else False
            if len(np.unique(heights)) >= STOREYS and alike:
                told = {"count": len(own), "axis": start.axes[axis]}
                node = numbering.table.told(numbering.nodes[own[heights.argmin()]])
                yield "operators.dynamics.masses-apart", {**told, "node": node}


def bodies_stand(start: Start) -> Told:
    """Bodies that joints or stops alone bear: from which side, where; with what weight, all."""
    problem, loading, force = start.problem, start.problem.loading, start.weight
    drops = bool(loading.forces[:, start.changing].any())
    drops = drops and not (len(problem.contact) or problem.u.any() or problem.v.any())
    left = np.abs(problem.constraints.T.T @ force)  # by supports
    drops = drops and bool(left.max(initial=0.0) > OFF * np.abs(force).max(initial=0.0))
    for body in start.bodies():
        node, up, mass, weight = body.node, body.up, body.mass, body.weight
        # joints that open for good are told behind the motion
        for axis, way in body.ways.items() if problem.contact else ():
            borne = [start.touches(s * way) for s in (1.0, -1.0)]
            push = start.factors @ (loading.forces.T @ way)
            out = float(push.mean()) * (1.0 if borne[1] else -1.0)
            most = float(np.abs(push).max(initial=0.0))
            if borne[0] != borne[1] and out > AWAY * most and not start.holds(way, dashpots=True):
                yield OTHER_SIDE, {"node": node, "axis": axis, "below": borne[1]}
        if drops and _are_weights(1.0, weight, mass):
            most, drops = int((-(up @ loading.forces) * start.steady).argmax()), False
            yield "operators.dynamics.weight-dropped", {"name": start.names[most]}
        stands = weight > 0.0 and start.touches(-up) and not start.holds(up)
        pull = weight / mass if stands and mass > 0.0 and start.shaking.any() else 0.0
        heavier = [pull / g for g in GRAVITIES if HEAVIER[0] < pull / g < HEAVIER[1]]
        heavier *= all(abs(pull / g - 1.0) > 0.01 for g in IN_FEET)
        for times in [2.0] if _are_weights(2.0, weight, mass) else heavier:
            yield WEIGHT_TWICE, {"mass": mass, "weight": weight, "times": times, "node": node}
        if stands:
            times = mass * GRAVITIES[0] / weight
            same = abs(mass - weight) < SAME_PULL * weight and mass != 1.0  # g left out; no unit
            if same or (times > TIMES and start.shaking.any()):
                told = {"mass": mass, "weight": weight, "times": times}
                yield "operators.dynamics.mass-over-weight", {**told, "node": node}
            if not (problem.interface and problem.contact) and not start.touches(up):
                yield from _beside_its_base(start, body)


def braked(start: Start) -> Told:
    """Damping by the mass of bodies that lift, which it brakes as they fall, or swing on bearings.

    What is proportional to a stiffness does not act on a body that moves as a whole.
    """
    problem = start.problem
    steps, times = start.factors[:, start.changing], problem.times
    most = np.abs(steps).max(axis=0, initial=0.0)
    rate = np.abs(np.diff(steps, axis=0) / np.diff(times)[:, None]).max(axis=0, initial=0.0)
    rate = np.inf if problem.v.any() else float((rate / most).max(initial=0.0))
    for body in start.bodies() if problem.C.nnz else ():
        weight, size = body.weight, body.size
        told: dict[str, Any] = {"node": body.node}
        for axis, way in body.ways.items():
            drag, pull = problem.C @ way, problem.M @ way
            mass = float(way @ pull)
            alpha = float(way @ drag) / (mass or np.inf)
            off = np.abs(drag - alpha * pull).max() > OFF * np.abs(drag).max()
            if alpha <= 0.0 or off or start.holds(way):
                continue
            lifts = way is body.up and start.touches(-way) and not start.touches(way)
            rocks = np.sqrt(max(weight, 0.0) / mass / size) if size else 0.0
            if lifts and alpha > BRAKED * rocks > 0.0 and rate > rocks:  # else slow, to equilibrium
                fall = weight / mass / alpha
                yield "operators.dynamics.falls-braked", {**told, "alpha": alpha, "fall": fall}
            swings = _bearing_stiffness(problem.interface, way, weight)
            pulsation = np.sqrt(swings / mass)
            if alpha > 2.0 * OF_BEARINGS * pulsation > 0.0:
                told |= {"alpha": alpha, "frequency": pulsation / (2.0 * np.pi), "axis": axis}
                ratio = alpha / 2.0 / pulsation
                yield "operators.dynamics.bearings-braked", {**told, "ratio": ratio}
                return


def weak_cores(start: Start) -> Told:
    """Lead cores that yield under next to nothing of the weight above, or never."""
    joints = start.problem.interface
    lead = joints.codes == LawCode.LEAD
    for body in start.bodies() if np.any(lead) else ():
        own = lead & (joints.jumps(body.up)[:, -1] > 0.0)
        cores = joints.parameters[:, Parameter.QD]
        bearing = [(float(cores[own].sum()), body.weight)]
        if body.weight > 0.0 and start.problem.u.any():  # what each bears at rest
            pressed = -joints.parameters[:, Parameter.KN] * joints.jumps(start.problem.u)[:, -1]
            bearing += zip(cores[own].tolist(), pressed[own].tolist(), strict=True)
        for core, weight in bearing:
            if weight > 0.0 and core > 0.0 and not CORES <= core / weight <= STRONG:
                told = {"node": body.node, "cores": core, "weight": weight, "share": core / weight}
                codes = "operators.dynamics.cores-strong", "operators.dynamics.cores-weak"
                yield codes[core < CORES * weight], told
                break


def _bearing_stiffness(joints: Interface, way: FloatArray, weight: float) -> float:
    """Stiffness against a motion of bearings that have yielded, none beside other joints."""
    moved = (joints.jumps(way)[:, :-1] ** 2).sum(axis=1)
    p = joints.parameters[:, [Parameter.KPOS, Parameter.RAYO]]
    lead, pendulum = (joints.codes[moved > 0.0] == c for c in (LawCode.LEAD, LawCode.PENDULUM))
    if lead.size and lead.all():
        return float(p[:, 0] @ moved)
    radius = p[moved > 0.0, 1]
    return max(weight, 0.0) / float(radius.max()) if pendulum.size and pendulum.all() else 0.0


def _are_weights(count: float, force: float, mass: float) -> bool:
    """Whether a force is so many times the weight of a mass."""
    return mass > 0.0 and any(abs(force / mass / g - count) < AGAIN for g in GRAVITIES)


def weights_twice(
    masses: Iterable[tuple[IntArray, FloatArray]],
    matrix: Matrix,
    zones: Iterable[Zone],
    nodes: IntArray,
    pressing: FloatArray,
) -> Told:
    """Bodies of statics that forces (m,) press down at nodes (m,) by twice the weight of masses.

    Cells of the matrix and of zones beside it make bodies, joints do not.
    """
    if "bodies" not in matrix.cache:
        held = [b.nodes for b in matrix.blocks if b.zone is None or not is_joint(b.zone)]
        held += [matrix.table.resolve(z.cells.raw) for z in zones if not is_joint(z)]
        matrix.cache["bodies"] = bodies_of_nodes(matrix, held)
    label = cast(IntArray, matrix.cache["bodies"])
    mass = np.zeros(len(matrix.table))
    for at, values in masses:
        np.add.at(mass, matrix.table.resolve(at), values)
    own, weights = np.bincount(label, mass[: len(label)]), np.bincount(label[nodes], pressing)
    for body in np.flatnonzero(own[: len(weights)] > 0.0):
        if _are_weights(2.0, weights[body], own[body]):
            told = {"mass": own[body], "weight": weights[body], "times": 2.0}
            yield WEIGHT_TWICE, told | {"node": matrix.table.told((label == body).argmax())}


def _beside_its_base(start: Start, body: Body) -> Told:
    """A resultant of what presses a body that lies beside all that bears it."""
    problem, joints = start.problem, start.problem.interface
    numbering, rows = problem.numbering, joints.J if joints else problem.contact.G
    rows = rows * (-1.0 if (rows @ body.up).sum() < 0.0 else 1.0)  # named from above
    lifts = (rows @ body.up).reshape(-1, joints.dimension)
    under = lifts[:, -1] > 1.0 - BESIDE
    if lifts[~under].any() or lifts[:, :-1].any() or not under.any():
        return
    borne = numbering.nodes[np.unique(rows.indices)]
    borne = borne[np.isin(borne, numbering.nodes[body.own])]
    centre = numbering.table.coordinates[borne].mean(axis=0)
    motions, C = rigid_motions(numbering, centre) * body.own[:, None], problem.constraints.C
    aside = motions[:, : len(start.axes) - 1]
    for turn in motions[:, 3:].T:
        turn -= aside @ np.linalg.lstsq(C @ aside, C @ turn)[0]  # about what is held aside
        if start.holds(turn):
            continue
        levers, ends = (rows @ turn).reshape(lifts.shape)[under, -1], np.zeros(int(under.sum()))
        if joints:
            middle, half = _normal_jumps(joints, turn)
            levers, ends = np.append(levers, middle), np.append(ends, half)
        elif (rows @ turn)[~under].any():  # stops that act along other axes
            continue
        low, high = float((levers - ends).min()), float((levers + ends).max())
        at, width = -float(turn @ start.weight) / body.weight, high - low
        off = max(low - at, at - high)
        if width > 0.0 and off > -EDGE * width:
            told = {"node": body.node, "width": width, "off": max(off, 0.0)}
            yield "operators.dynamics.weight-beside", told


def _normal_jumps(joints: Interface, motion: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Openings (n_points,) by a motion at the middle of each point, and what its ends add."""
    w, p = joints.jumps(motion), joints.parameters
    sides = np.maximum(p[:, [Parameter.LONG, Parameter.LARG]], 2.0 * p[:, [Parameter.RAYO]]) / 2.0
    return w[:, -1], (np.abs(w[:, :-1]) * sides[:, 3 - joints.dimension :]).sum(axis=1)


def unequal_joints(start: Start) -> Told:
    """Joints of one law and kind under one body, one part of them far stiffer than another."""
    if not (joints := start.problem.interface):
        return
    label, numbering = bodies_of(start.problem), start.problem.numbering
    known: dict[object, tuple[float, int]] = {}
    for joint, rows in joints.placed:
        node = int(joint.zone.cells.nodes.resolve(joint.upper).ravel()[0])
        body = int(label[(numbering.nodes == node).argmax()])
        normal = tuple(joint.frames[0, 0, -1].round(3).tolist())
        key = body, joint.zone.element, joint.zone.behaviour, normal
        kn = float(np.median(joints.parameters[rows, Parameter.KN]))
        other, there = known.setdefault(key, (kn, node))
        if max(kn, other) > UNEQUAL * min(kn, other):
            told = {"node": numbering.table.told(node), "there": numbering.table.told(there)}
            yield "operators.dynamics.joints-unequal", {**told, "kn": kn, "other": other}


def ground_twice(start: Start) -> Told:
    """Macro-elements on ground that is meshed: the cells give way, and the element again."""
    problem, numbering = start.problem, start.problem.numbering
    if not (joints := problem.interface):
        return
    label = bodies_of(problem)
    zoned = [(b.nodes.ravel(), b.zone) for b in start.inputs.stiffness.blocks if b.zone is not None]
    solid = [n for n, z in zoned if z.cells.kind.dimension > 1 and not is_joint(z)]
    for zone, lower in ((j.zone, j.lower) for j in joints.joints if is_macro(j.zone)):
        node = int(zone.cells.nodes.resolve(lower).ravel()[0])
        below = label == label[(numbering.nodes == node).argmax()]
        cells = below & np.isin(numbering.nodes, np.concatenate([label[:0], *solid]))
        stiff = float(np.median(problem.K.diagonal()[cells])) if cells.any() else 0.0
        if float(joints.parameters[:, Parameter.KN].max()) < STIFF * stiff:
            yield "operators.dynamics.ground-twice", {"node": numbering.table.told(node)}


def matter_amiss(start: Start) -> Told:
    """Ground whose waves no ground has, by its density; solids of densities far apart."""
    problem, inputs = start.problem, start.inputs
    if inputs.mass is None or not len(cells := matter(inputs.stiffness, inputs.mass)):
        return
    numbering, joints = problem.numbering, problem.interface
    label, below = bodies_of(problem), held(problem)
    for joint in joints.joints:
        below |= np.isin(numbering.nodes, joint.zone.cells.nodes.resolve(joint.lower))
    ground = np.isin(cells[:, 0], numbering.nodes[np.isin(label, label[below])])
    height, density, speed = cells[:, 1:].T
    usual = MATTER[1]["RHO"]
    for i in np.flatnonzero(ground & (speed > WAVES.high) & (speed < WAVES.high * TONNE**0.5)):
        if TONNES <= density[i] in usual:
            told = {"density": density[i], "speed": speed[i], "wanted": density[i] * TONNE}
            told["low"], told["high"] = WAVES.low, WAVES.high
            node = numbering.table.told(cells[i, 0])
            yield "operators.dynamics.ground-too-light", {"node": node, **told}
            return
    i, j = int(density.argmin()), int(density.argmax())
    low, high = (abs(density - density[k]) < ALIKE * density[k] for k in (i, j))
    beneath = height[low].mean() < height[high].mean() and speed[i] > speed[j]
    times = density[j] / density[i]
    if LIGHTER[beneath] <= times < MASSLESS and speed[i] > FOAM:
        told = {"node": numbering.table.told(cells[i, 0]), "density": density[i]}
        told |= {"there": numbering.table.told(cells[j, 0]), "other": density[j]}
        yield "operators.dynamics.densities-apart", {**told, "times": times}


def footing_too_wide(start: Start) -> Told:
    """Macro-elements wider than the model is large, many times: millimetres among metres."""
    joints = start.problem.interface
    macro = any(is_macro(j.zone) for j in joints.joints)
    if macro and (wide := _width(start.problem)) > WIDE * start.size > 0.0:
        yield "operators.dynamics.footing-too-wide", {"width": wide, "size": start.size}


def _width(problem: Problem) -> float:
    """The largest width of macro-elements."""
    widths = [Parameter.LARG, Parameter.LONG, Parameter.RAYO]
    return float(problem.interface.parameters[:, widths].max(initial=0.0))
