"""What DYNAMIC warns of where a motion enters: how strong it is, in which frame, what it meets.

A load shakes where it is the mass times an acceleration of the whole; supports move as one where
their imposed values are those of a translation.
"""

from itertools import chain

from ssilang.io.ground_motions.record import G
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.family import displacement_names
from ssilang.kernel.interface.interface import Interface, is_macro, joint_zones, without_zones
from ssilang.kernel.interface.kinematics import JointCells
from ssilang.kernel.interface.laws.columns import LawCode, Parameter
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.matrices.assembly import Numbering, field_to_vector
from ssilang.kernel.statics.cells_amiss import bordered_solids, layers
from ssilang.kernel.stepping.problem.bodies import ROUNDING, bodies_of, held, loose_bodies
from ssilang.kernel.stepping.problem.loading import nodal_terms
from ssilang.kernel.stepping.problem.plausibility import Start, Told
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.waves.shaken import (
    AXES,
    FEWER,
    GRAVITIES,
    LARGE,
    SAME,
    absorbing_ends,
    is_record,
    longest_cell,
    shares,
    strong_frequency,
    translations,
    unlike_sides,
)
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

STRONG = 3.0  # g; more than the ground of any earthquake but one
WEIGHT = (0.05, 3.0)  # g; what pulls down
MANY = 3  # nodes, or instants: fewer say nothing of a rule
PART, WHOLE = 0.2, 0.8  # of what moves along another axis, at a node and in all: less is forgotten
IN_PART = 0.3  # of a body's mass: ground that moves with a footing may have some, and no load
ITS_OWN = 0.4  # of a node's mass by its cells: what a field on this node alone takes of it
LEVELS = 3  # heights of a side; a base has one
GROUND, HIGH = 360.0, 5.0  # m/s, of waves of shear in soil; height over width of a column of it
PAIR = 2  # nodes of a spring, at most
STUCK = {True: "operators.dynamics.joints-closed", False: "operators.dynamics.joints-held"}
"""Joints that cannot open, by whether they can slip."""
BEARINGS = LawCode.LEAD, LawCode.PENDULUM
SHEARED = "operators.dynamics.weight-in-shear"
SOFT = 1e-3  # of the stiffness of a joint's point: springs that stand there for numbers' sake
PRESENT = 0.1  # of a mass or damper on the diagonal: lumped or not, it is there
FEW = 2  # nodes of a side with springs of their own; one is an oscillator's
NAMES = {"ACCE": "ACCE", "VITE": "VITE", "VELO": "VITE", "DEPL": "DEPL", "DISP": "DEPL"}
"""What a curve is of, by the first letters of the name of its ordinates."""


def warn_of_shaking(entries: Entries, start: Start) -> None:
    """Warn of motions that are no earthquake's, of what damps or holds what they should move."""
    found = [*_Entering(start).told(entries)] if start.axes else []
    if joints := start.problem.interface:
        found += [*_held_footings(start, joints), *_sheared(start, joints)]
    for code, told in found:
        entries.warn(code, **told)


class _Entering:
    """Motions that enter: accelerations (d, k) of the loads and of the base, nought for others."""

    def __init__(self, start: Start) -> None:
        self.start, self.problem, self.inputs = start, start.problem, start.inputs
        self.axes, self.changing, self.loads = start.axes, start.changing, start.accelerations
        self.along, imposed = translations(self.problem), self.problem.loading.imposed
        self.factors = np.abs(start.factors).max(axis=0)
        self.base = shares(self.problem.constraints.C @ self.along, imposed * self.changing)
        self.shaken = np.abs(start.shaking).sum(axis=1)

    def told(self, entries: Entries) -> Told:
        """Codes of warnings with their data."""
        yield from self._strange_loads(workspace(entries.call.session).units)
        if (np.abs(self.base).sum(axis=1) * self.shaken).any():
            yield "operators.dynamics.shaken-twice", {}
        T, moved = self.problem.constraints.T, self.along @ self.base[:, self.base.any(axis=0)]
        braked, pulled = T.T @ (self.problem.C @ moved), T.T @ (self.problem.M @ moved)
        if any(
            shares(p[:, None], b[:, None]).any() for p, b in zip(pulled.T, braked.T, strict=True)
        ):
            yield "operators.dynamics.damped-against-ground", {}
        yield from self._twice_along()
        finds = self._sides(), self._masses_one_way(), self._long_cells(), self._columns()
        yield from chain(*finds, self._driven_in_part(), self._driven_beyond())

    def _twice_along(self) -> Told:
        """Records along one axis, each by its load, while nothing shakes along another."""
        curves, shaken = self.problem.loading.curves, self.start.shaking
        alone = np.count_nonzero(shaken, axis=0) == 1
        records = [k for k in np.flatnonzero(alone) if is_record(curves[k][1])]
        axes = [int(np.abs(shaken[:, k]).argmax()) for k in records]
        spans = [curves[k][0][curves[k][1] != 0.0] for k in records]
        apart = max((t[0] for t in spans), default=0) >= min((t[-1] for t in spans), default=0)
        if len(self.axes) > 1 and len(axes) > 1 == len({*axes}) and not apart:
            name = self.start.names[records[1]]
            told = {"name": name, "axis": self.axes[axes[0]], "others": self.axes}
            yield "operators.dynamics.shaken-twice-along", told

    def _strange_loads(self, system: Any) -> Told:
        loading, load = self.problem.loading, self.inputs.load
        terms = [(p, t) for p in load.parts for t in nodal_terms(p)] if load else []
        sizes = np.linalg.norm(self.loads, axis=0) * self.factors
        units = [s for s in sizes[~self.changing] if min(abs(s / g - 1) for g in GRAVITIES) < 0.01]
        g = G / system.length if system else units[0] if units else np.inf
        for k, (part, _) in enumerate(terms):
            curve = part.time.parts[0] if part.time is not None else None
            kind = "" if curve is None else NAMES.get(curve.ordinate_name.strip().upper()[:4], "")
            down = abs(self.loads[-1, k]) * self.factors[k]
            shakes = self.changing[k] and sizes[k] > 0.0
            odd = system and not WEIGHT[0] < down / g < WEIGHT[1]
            imposes = loading.imposed[:, k].any()
            pulls = not self.changing[k] and down > 0.0 and len(self.axes) > 1
            told = {"name": part.name, "value": sizes[k], "times": sizes[k] / g, "wanted": g}
            told |= {"velocities": kind == "VITE", "most": STRONG}
            for code, holds in {
                "operators.dynamics.shaken-strongly": shakes and sizes[k] > STRONG * g,
                "operators.dynamics.shaken-in-g": shakes and curve and curve.units[1] == "g",
                "operators.dynamics.shaken-by-others": shakes and kind in ("VITE", "DEPL"),
                "operators.dynamics.imposed-by-others": kind in ("VITE", "ACCE") and imposes,
                "operators.dynamics.weight-unusual": pulls and odd,
                "operators.dynamics.weight-upward": pulls and self._upward(k),
            }.items():
                if holds:
                    yield code, told

    def _upward(self, load: int) -> bool:
        """Whether a load lifts all by its own weight, and all that is held is below."""
        lift = self.loads[-1, load] * self.start.factors[0, load]
        numbering, still = self.problem.numbering, held(self.problem)
        heights = numbering.table.coordinates[numbering.nodes, len(self.axes) - 1]
        stands = still.any() and heights[still].max() < heights[~still].mean()
        return bool(stands and any(abs(lift / g - 1.0) < 0.01 for g in GRAVITIES))

    def _masses_one_way(self) -> Told:
        """Masses that move along some axes, and do not weigh, or shake, along others."""
        problem, free = self.problem, ~held(self.problem)
        nodes, at = np.unique(problem.numbering.nodes, return_inverse=True)
        by_node = sp.csr_array((np.ones(len(at)), (at, np.arange(len(at)))))
        mass = np.asarray(by_node @ (self.along * (problem.M @ self.along)))
        moves = np.asarray(by_node @ (self.along * free[:, None])) > 0.0
        total = mass.sum(axis=0)
        for axis, name in enumerate(self.axes):
            less = moves[:, axis] & (mass[:, axis] < PART * mass.max(axis=1))
            if total[axis] >= WHOLE * total.max() or not less.any():
                continue
            along = sp.csr_array(by_node * self.along[:, axis])
            forces = (along @ f for f in problem.loading.forces.T)  # one by one: they may be many
            laden = ((f[f != 0.0], mass[f != 0.0, axis]) for f in forces)
            if any(len(f) >= MANY and shares(m[:, None], f[:, None]).any() for f, m in laden):
                node = problem.numbering.table.told(nodes[less.argmax()])
                told = {"count": int(less.sum()), "node": node, "axis": name}
                told["other"] = self.axes[int(mass[less.argmax()].argmax())]
                yield "operators.dynamics.masses-one-way", told

    def _driven_in_part(self) -> Told:
        """Bodies of which a record drives by their mass a small part, and nothing the rest."""
        problem, curves = self.problem, self.problem.loading.curves
        records = [k for k in np.flatnonzero(self.changing) if is_record(curves[k][1])]
        solids = [b for b, *_ in bordered_solids(self.inputs.stiffness)]
        if not records or any(len({*b.unknowns}) == len(self.axes) for b in solids):
            return  # of ground that is meshed a part may be meant
        label, free, forces = bodies_of(problem), ~held(problem), problem.loading.forces[:, records]
        for axis, e in zip(self.axes, self.along.T, strict=True):
            pushed, mass = np.abs(forces) * e[:, None], (problem.M @ e) * e
            some = pushed > 0.0
            meant = np.zeros(len(records), bool)
            for value in (1.0, *GRAVITIES):
                chosen = pushed > ITS_OWN * value * mass[:, None]
                off = np.abs(value * (problem.M @ (chosen * e[:, None])) * e[:, None] - pushed)
                same = chosen.any(axis=0) & (off.max(axis=0) < SAME * pushed.max(axis=0))
                some[:, same], meant = chosen[:, same], meant | same
            moved = (problem.M @ (some.any(axis=1) * e)) * e
            whole, own = (np.bincount(label, m * free) for m in (mass, moved))
            for body in np.flatnonzero((own > 0.0) & (own < IN_PART * whole)):
                within = label == body
                if (some[within].any(axis=0) & meant).any():
                    k = records[int((some[within].any(axis=0) & meant).argmax())]
                    unmoved = mass * within * free * ~some.any(axis=1)
                    told = {"name": self.start.names[k], "axis": axis, "driven": own[body]}
                    told["node"] = problem.numbering.told(unmoved)
                    yield "operators.dynamics.driven-in-part", {**told, "whole": whole[body]}
                    return

    def _driven_beyond(self) -> Told:
        """Records that drive nodes by a mass that these have not, and all others by their own."""
        problem, curves = self.problem, self.problem.loading.curves
        damping = () if self.inputs.damping is None else self.inputs.damping.blocks
        sides = [b.nodes.ravel() for b in damping if b.zone is None and b.raw_nodes.shape[1] > 1]
        beside = ~np.isin(problem.numbering.nodes, np.concatenate([[], *sides]))  # dashpots let in
        records = [k for k in np.flatnonzero(self.changing) if is_record(curves[k][1])]
        for k in (k for k in records if problem.loading.forces[beside, k].any()):
            for axis, e in zip(self.axes, self.along.T, strict=True):
                force, mass = np.abs(problem.loading.forces[:, k]) * e, (problem.M @ e) * e
                driven = np.flatnonzero(force * (mass >= 0.0))
                pull = force[driven] / np.maximum(mass[driven], 1e-300)
                usual = float(np.median(pull)) if len(pull) else 0.0
                same = np.abs(pull - usual) < SAME * usual
                if same.sum() < MANY or not (same | (pull > usual)).all() or same.all():
                    continue
                worst = driven[pull.argmax()]
                told = {"driven": force[worst] / usual, "mass": mass[worst], "axis": axis}
                told["node"] = problem.numbering.table.told(problem.numbering.nodes[worst])
                yield "operators.dynamics.driven-beyond", told | {"name": self.start.names[k]}
                return

    def _long_cells(self) -> Told:
        """Cells with too few of them in a wavelength of what shakes, the worst of each load."""
        load, mass = self.inputs.load, self.inputs.mass
        terms = [p for p in load.parts for _ in nodal_terms(p)] if load and mass else []
        shakes = self.start.shaking
        waves, few = np.zeros_like(shakes), self.problem.loading.forces.size < LARGE
        if terms and few and not shakes.any():  # that dashpots let in, at their velocities
            braked = self.problem.C @ self.along
            waves = shares(braked, self.problem.loading.forces) * self.changing
        for part, pushed, moved, let in zip(terms, shakes.T, self.base.T, waves.T, strict=False):
            along, power = (pushed, -1) if pushed.any() else (moved, 1) if moved.any() else (let, 0)
            if not part.time or not along.any() or len(part.time.parts[0].abscissas) < MANY:
                continue
            curve = part.time.parts[0]
            frequency = strong_frequency(curve.abscissas, curve.ordinates, power)
            axis, stiffness = self.axes[int(np.abs(along).argmax())], self.inputs.stiffness
            assert mass is not None
            found = longest_cell(stiffness, mass, axis, frequency) if frequency else None
            if found is not None and found.cells < FEWER * found.usual:
                told = vars(found) | {"node": mass.table.told(found.node), "frequency": frequency}
                yield "operators.dynamics.cells-too-long", {"name": part.name, **told}

    def _columns(self) -> Told:
        """Columns one cell wide that bend as they are shaken: ground does not, it shears."""
        stiffness, moved = self.inputs.stiffness, self.shaken + np.abs(self.base).sum(axis=1)
        up = len(self.axes) - 1
        for layer in layers(stiffness, bordered_solids(stiffness)) if moved.any() else ():
            if layer.across < up == layer.along and moved[layer.across] > SAME * moved.max():
                told = {"node": stiffness.table.told(layer.node), "count": layer.count}
                told |= {"slender": 0.0, "axis": self.axes[up]}
                yield "operators.dynamics.column-bends", told
                return
        if up > 0 and self.inputs.mass is not None and moved.any():
            axis = int(moved[:-1].argmax())
            if not moved[axis] or (slender := self._slender(axis)) <= HIGH:
                return
            found = longest_cell(stiffness, self.inputs.mass, self.axes[axis], 1.0)
            if found and found.speed < GROUND:
                told = {"node": "", "count": 0, "slender": slender, "axis": self.axes[up]}
                yield "operators.dynamics.column-bends", told

    def _slender(self, axis: int) -> float:
        """Height over width of cells of which nothing above their base keeps a side from rising."""
        numbering, damping = self.problem.numbering, self.inputs.damping
        rows, up = abs(self.problem.constraints.C).sum(axis=0) > 0.0, len(self.axes) - 1
        rows &= numbering.codes == numbering.code(self.axes[up])
        dashpots = [b for b in damping.blocks if b.kind == "AMORTISSEMENT"] if damping else []
        tied = np.concatenate([numbering.nodes[rows], *(b.nodes.ravel() for b in dashpots)])
        blocks = [b.nodes.ravel() for b, _, _ in bordered_solids(self.inputs.stiffness)]
        if not blocks or not len(tied):
            return 0.0
        nodes = np.concatenate(blocks)
        points = numbering.table.coordinates[nodes]
        size = np.ptp(points, axis=0)
        above = points[:, up] > points[:, up].min() + ROUNDING * size[up]
        ends = (np.isclose(points[:, axis], f(points[:, axis])) & above for f in (np.min, np.max))
        free = any(not np.isin(nodes[end], tied).any() for end in ends)
        return float(size[up] / size[axis]) if free and size[axis] else 0.0

    def _sides(self) -> Told:
        """Rollers along the shaking: held that way and free to move up, at several heights."""
        numbering, free = self.problem.numbering, ~held(self.problem)
        rising = numbering.nodes[(self.along[:, -1] > 0.0) & free]
        moved = self.shaken + np.abs(self.base).sum(axis=1)
        for axis in np.flatnonzero(moved[:-1] > SAME * moved.max()):
            still = numbering.nodes[(self.along[:, axis] > 0.0) & ~free]
            still = still[np.isin(still, rising)]
            points = numbering.table.coordinates[still]
            heights, across = points[:, len(self.axes) - 1], points[:, axis]
            if len(np.unique(heights.round(9))) >= LEVELS:
                told = {"count": len(still), "node": numbering.table.told(still[0])}
                told |= {"axis": self.axes[axis], "plane": not np.ptp(across).round(9)}
                yield "operators.dynamics.sides-held", told


def sides_unlike(start: Start) -> Told:
    """Sides that absorb waves of another ground than that beside them, a base of a softer one."""
    inputs = start.inputs
    if inputs.mass is not None and inputs.damping is not None:
        found = unlike_sides(inputs.stiffness, inputs.mass, inputs.damping)
        if found is not None:
            told = {"node": inputs.mass.table.told(found[0]), "times": found[1], "base": found[2]}
            yield "operators.dynamics.sides-unlike", told
        top, bottom = absorbing_ends(inputs.stiffness, inputs.damping)
        known = start.problem.numbering.nodes
        if len(top) and len(bottom) and not held(start.problem)[np.isin(known, bottom)].any():
            yield "operators.dynamics.surface-absorbs", {"node": inputs.mass.table.told(top[0])}


def beside_free_field(start: Start) -> Told:
    """Masses and dampers that a free field's forces were found with, and the matrices lack."""
    problem, numbering, load = start.problem, start.problem.numbering, start.inputs.load
    parts = () if load is None else load.parts
    for mass, dampers in dict.fromkeys(part.beside for part in parts if part.beside):
        m, c = (field_to_vector(of, numbering, dual=False) for of in (mass, dampers))
        for code, lost in {
            "operators.dynamics.dampers-left-out": (c > 0.0) & (problem.C.diagonal() < PRESENT * c),
            "operators.dynamics.masses-left-out": (m > 0.0) & (problem.M.diagonal() < PRESENT * m),
            "operators.dynamics.dampers-held": (c > 0.0) & held(problem),
        }.items():
            if lost.any():
                nodes = np.unique(numbering.nodes[lost])
                yield code, {"count": len(nodes), "node": numbering.table.told(nodes[0])}


def bridged(start: Start) -> Told:
    """Springs and dashpots that act where joints open; ground held where these stand on it."""
    problem, inputs = start.problem, start.inputs
    if not (joints := problem.interface):
        return
    own = without_zones(inputs.stiffness, joint_zones(inputs.model or Model(())))
    springs = [b for b in own.blocks if b.raw_nodes.shape[1] <= PAIR]
    given, none = inputs.damping, np.zeros((joints.n_points, joints.dimension))
    damping = given and without_zones(given, tuple(j.zone for j in joints.joints))
    if damping is not given:
        yield "operators.dynamics.joints-undamped", {}
    dashpots = damping.blocks if damping and loose_bodies(problem, none) else ()
    for joint in joints.joints:
        resolve = joint.zone.cells.nodes.resolve
        lower, upper = resolve(joint.lower).ravel(), resolve(joint.upper).ravel()
        axis = _normal(joint)
        soft = SOFT * float((joints.parameters[:, Parameter.KN] * joints.weights).max(initial=0.0))
        for code, blocks, few, least in (
            ("operators.dynamics.joints-bridged", dashpots, 1, 0.0),
            ("operators.dynamics.joints-sprung", springs, FEW, soft),
        ):
            acting = [_across(b, lower, upper, axis, least) for b in blocks if b.kind != "MASSE"]
            nodes = np.unique(np.concatenate([lower[:0], *acting]))
            if len(nodes) >= few:
                yield code, {"axis": axis, "node": problem.numbering.table.told(nodes[0])}
        yield from _ground_held(problem, own, lower, axis)


def stops_on_held(start: Start) -> Told:
    """Sides in contact that are held whole, on cells that go on below them."""
    contact, numbering = start.problem.contact, start.problem.numbering
    for sign in (1.0, -1.0):
        own = sign * contact.G.data > 0.0
        if not own.any():
            continue
        side = contact.G.indices[own]
        push = np.bincount(numbering.codes[side], np.abs(contact.G.data[own]))
        axis = numbering.unknowns[int(push.argmax())]
        if axis in AXES:
            lower = np.unique(numbering.nodes[side])
            yield from _ground_held(start.problem, start.inputs.stiffness, lower, axis)


def _across(
    block: ElementMatrices, lower: IntArray, upper: IntArray, axis: str, least: float
) -> IntArray:
    """Nodes (n,) of `upper` that matrices hold along an axis, to the ground or to `lower`."""
    ours = np.isin(block.nodes, upper)
    cells = (ours | np.isin(block.nodes, lower)).all(axis=1) & ours.any(axis=1)
    cells &= (~ours).any(axis=1) | (block.nodes.shape[1] == 1)
    along = np.array(block.unknowns) == axis
    acts = along & (np.abs(np.diagonal(block.values, axis1=1, axis2=2)) > least)
    return np.asarray(block.nodes[:, block.local][acts & ours[:, block.local] & cells[:, None]])


def _ground_held(problem: Problem, stiffness: Matrix, lower: IntArray, axis: str) -> Told:
    """A joint's lower side held whole, on cells that go on below it."""
    numbering, free = problem.numbering, ~held(problem)
    along = numbering.nodes[(numbering.codes == numbering.code(axis)) & free]
    moved = abs(problem.constraints.C.T) @ np.abs(problem.loading.imposed).sum(axis=1) > 0.0
    if np.isin(lower, along).any() or np.isin(lower, numbering.nodes[moved]).any():
        return
    zoned = [b for b in stiffness.blocks if b.zone is not None and not is_joint(b.zone)]
    solid = [b.nodes for b in zoned if b.zone and b.zone.cells.kind.dimension > 1]
    if any(np.isin(n[np.isin(n, lower).any(axis=1)], along).any() for n in solid):
        node = numbering.table.told(lower[0])
        yield "operators.dynamics.ground-held", {"axis": axis, "node": node}


def _sheared(start: Start, joints: Interface) -> Told:
    """Weights that joints carry by their shear alone: none of them is pressed."""
    for body in start.bodies():
        pulls = {a: abs(float(way @ start.weight)) for a, way in body.ways.items()}
        axis = max(pulls, key=pulls.__getitem__)
        w = joints.jumps(body.ways[axis])
        slips = np.abs(w).max(initial=0.0) > 0.0 == np.abs(w[:, -1]).round(9).max(initial=0.0)
        if slips and pulls[axis] > 0.0 and not start.holds(body.ways[axis]):
            yield SHEARED, {"axis": axis, "node": body.node}


def _held_footings(start: Start, joints: Interface) -> Told:
    """Joints that supports keep from opening, sides of joints that they hold like a structure."""
    problem = start.problem
    rows, numbering = problem.constraints.C, problem.numbering
    if problem.loading.imposed.any() or not joints.n_points:
        return
    left = abs(joints.J @ problem.constraints.T).sum(axis=1).reshape(-1, joints.dimension)
    moving = (left > ROUNDING)[joints.pairs].reshape(joints.n_points, 1, -1)
    moves: BoolArray = np.asarray(((np.abs(joints.B) > ROUNDING) & moving).any(axis=2))
    if not moves[:, -1].any():
        yield STUCK[bool(moves.any())], {}
        return
    alone = np.diff(rows.indptr) == 1
    fixed, ties, stiff = rows[alone].indices, abs(rows[~alone]), problem.K.diagonal()
    for p in np.flatnonzero(np.isin(joints.codes, BEARINGS) & ~moves[:, :-1].any(axis=1))[:1]:
        row = joints.pairs[p, 0] * joints.dimension + np.abs(joints.B[p, 0]).argmax()
        sides = joints.J[[int(row)]].indices
        held_side = int(sides[stiff[sides].argmax()])
        yield "operators.dynamics.bearing-held", {"unknown": numbering.label(held_side)}
    for joint in (j for j in joints.joints if law_of(j.zone.behaviour).opens):
        if is_macro(joint.zone) and joint.frames[0, 0, -1, -1] < 0.0:  # told: the wrong way round
            continue
        sides = [joint.zone.cells.nodes.resolve(side) for side in (joint.upper, joint.lower)]
        bare = np.isin(numbering.nodes, sides[0])  # the ground, named first and turned round
        ground = not (stiff[bare].any() or abs(problem.constraints.T[bare]).max() > ROUNDING)
        upper = np.isin(numbering.nodes, sides[ground])
        tied = numbering.nodes[upper | (ties[ties @ upper > 0.0].sum(axis=0) > 0.0)]
        along = _normal(joint)
        names = {along, *(f"R{a[1]}" for a in AXES)} - {f"R{along[1]}"}
        if joints.n_points == 1 and not is_macro(joint.zone):  # a point cannot rock
            names = {along}
        codes = [numbering.code(n) for n in names & {*numbering.unknowns}]
        kept = fixed[np.isin(numbering.nodes[fixed], tied) & np.isin(numbering.codes[fixed], codes)]
        if len(kept):
            yield "operators.dynamics.footing-held", {"unknown": numbering.label(int(kept[0]))}
            return
        mine = upper & (numbering.codes == numbering.code(along))
        if start.shaking.any() and mine.sum() >= MANY and _level(rows[~alone], mine, numbering):
            told = {"unknown": numbering.label(int(mine.argmax()))}
            yield "operators.dynamics.footing-level", told
            return


def _level(ties: sp.csr_array, mine: BoolArray, numbering: Numbering) -> bool:
    """Whether conditions among all of some unknowns let them move as one, and not turn."""
    points = numbering.table.coordinates[numbering.nodes] * mine[:, None]
    size = np.ptp(points[mine], axis=0).max()
    broken = np.abs(ties @ points).max(axis=1) > ROUNDING * size
    broken &= (np.diff(ties.indptr) == abs(ties).sign() @ mine) & (abs(ties @ mine) < ROUNDING)
    return bool(len(np.unique(ties[broken].indices)) == mine.sum())


def _normal(joint: JointCells) -> str:
    """The displacement along which a joint opens, most."""
    normal = np.abs(joint.frames[..., -1, :]).reshape(-1, joint.frames.shape[-1]).mean(axis=0)
    return displacement_names(joint.zone)[int(normal.argmax())]
