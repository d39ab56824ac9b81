"""What a motion's start shows to be forgotten or mistaken: weight, supports, damping, steps.

Bodies are looked at as they stand: translations along the axes of those that something excites,
and one motion for each load, that of its forces on the structure at rest.

What presses on ground that yields, against what the ground bears.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import SingularFactorError
from ssilang.kernel.base.scientific import la, sp
from ssilang.kernel.interface.bed import Bed
from ssilang.kernel.interface.family import displacement_names
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.solvers.backends import SuperLUFactor
from ssilang.kernel.stepping.problem.bodies import ROUNDING, bodies_of, held, translation
from ssilang.kernel.stepping.problem.initial import admissible_velocity, joint_state
from ssilang.kernel.stepping.problem.loading import nodal_terms
from ssilang.kernel.stepping.problem.problem import Inputs, Problem, closed_forces, closed_stiffness
from ssilang.kernel.waves.shaken import accelerations, axes_of, shares, translations

MOST_BODIES = 20  # beyond, joints and relations are a material
MOST_MOTIONS, DENSE = 5000, 400  # free motions up to which a solve costs little beside the steps
SUNK = 0.1  # of a body's size, that its joints give way
STIRS = 1e-5  # of it, by which a load moves it on: a blow on a free bar sends waves
PRESSED = 0.02  # mean force of a weight beside the largest one
WEAK = 1e-13  # stiffness beside the largest one that holds nothing
LITTLE = 1e-6  # jump at which joints are tried (m), and share of a force that is none
NEARLY = 0.01  # of a load: what is left where supports take the rest
SUDDEN = 0.1  # part of a load's largest value that comes or goes within a step


@dataclass(frozen=True)
class Loose:
    """A body that a load moves off along an axis."""

    node: str  # one of its nodes, as messages name it
    axis: str
    pressed: bool  # whether joints or stops would hold it if something pressed it on them


@dataclass(frozen=True)
class Sunk:
    """A body that loads, standing still, would push further along an axis than it is large (m)."""

    node: str
    axis: str
    way: float
    size: float


@dataclass(frozen=True)
class Swing:
    """The motion that a load asks for: period (s), damping ratio, whether it comes at once.

    Without stiffness or dashpots against it the period is infinite. The motion (n,) is that of
    the forces at rest; `load` is the number of what asks for it, -1 a velocity.
    """

    period: float
    damping: float
    sudden: bool
    load: int
    motion: FloatArray


@dataclass(frozen=True)
class Body:
    """A body that supports let move.

    Attributes
    ----------
    own : array (n,)
        Its unknowns.
    node : str
        Its first one, as messages name it.
    ways : dict
        Its translations (n,) by the axes.
    up : array (n,)
        The last of them.
    mass, weight : float
        Along it; what loads that do not change press down with.
    size : float
        The largest of its nodes' box.
    """

    own: BoolArray
    node: str
    ways: dict[str, FloatArray]
    up: FloatArray
    mass: float
    weight: float
    size: float


Told = Iterator[tuple[str, dict[str, Any]]]
"""Codes of warnings with their data: what a look at a start gives."""


class Start:
    """The start of a calculation: what several looks at it need, and what holds its bodies."""

    def __init__(self, problem: Problem, inputs: Inputs) -> None:
        self.problem, self.inputs = problem, inputs
        self.axes = axes_of(problem)

    @cached_property
    def factors(self) -> FloatArray:
        """Of the loads, at all instants."""
        return self.problem.loading.at(self.problem.times)

    @cached_property
    def changing(self) -> BoolArray:
        """Which loads (k,) change."""
        return np.asarray(np.ptp(self.factors, axis=0) > 0.0)

    @cached_property
    def steady(self) -> FloatArray:
        """Factors (k,) of the loads that do not change, nought for others."""
        return np.asarray(self.factors[0] * ~self.changing)

    @cached_property
    def weight(self) -> FloatArray:
        """Forces (n,) of the loads that do not change."""
        return np.asarray(self.problem.loading.forces @ self.steady)

    @cached_property
    def accelerations(self) -> FloatArray:
        """Accelerations (d, k) of the whole that the loads are."""
        return accelerations(self.problem)

    @cached_property
    def shaking(self) -> FloatArray:
        """Those of the loads that change."""
        return self.accelerations * self.changing

    @cached_property
    def swings(self) -> list[Swing]:
        """The motions that loads and first velocities ask for."""
        return [*swings(self.problem, self.factors)]

    @cached_property
    def names(self) -> list[str]:
        """Names of the parts that the loads come from."""
        parts = () if self.inputs.load is None else self.inputs.load.parts
        return [part.name for part in parts for _ in nodal_terms(part)]

    @cached_property
    def size(self) -> float:
        """The largest of the model's."""
        table, nodes = self.problem.numbering.table, self.problem.numbering.nodes
        return float(np.ptp(table.coordinates[nodes], axis=0).max(initial=0.0))

    def bodies(self) -> Iterator[Body]:
        """Those that supports let move, where they are few."""
        problem, label, along = self.problem, bodies_of(self.problem), translations(self.problem).T
        points = problem.numbering.table.coordinates[problem.numbering.nodes]
        moving = np.unique(label[~held(problem)])
        for own in (label == k for k in moving if self.axes and len(moving) <= MOST_BODIES):
            ways = dict(zip(self.axes, own * along, strict=True))
            up = ways[self.axes[-1]]
            mass, weight = float(up @ (problem.M @ up)), -float(up @ self.weight)
            size = float(np.ptp(points[own], axis=0).max())
            yield Body(own, problem.numbering.told(own), ways, up, mass, weight, size)

    def loose(self) -> Iterator[Loose]:
        """Bodies without support along an axis, or without what presses them on theirs."""
        problem = self.problem
        begun = problem.u.any() or problem.v.any()  # an impact needs no weight
        if begun and not problem.loading.forces.any():
            return
        for body in self.bodies():
            ways = {a: self._way(motion, body.size) for a, motion in body.ways.items()}
            held = not {"held", "stands", "pressed"}.isdisjoint(ways.values())
            for axis, way in ways.items():
                if way == "pressed" or (way == "slides" and held):
                    yield Loose(body.node, axis, way == "pressed")

    def sunk(self) -> Iterator[Sunk]:
        """Bodies that closed joints alone hold, by less than what loads push them with."""
        for body in self.bodies() if self.problem.interface else ():
            for axis, motion in body.ways.items():
                held = self._closed(motion)
                if held > 0.0 and body.size > 0.0 and not self.holds(motion):
                    push = self.factors @ (self.problem.loading.forces.T @ motion)
                    way = float(np.abs(push).max(initial=0.0)) / held
                    if way > SUNK * body.size:
                        yield Sunk(body.node, axis, way, body.size)

    def _way(self, motion: FloatArray, size: float) -> str:
        """'held', 'slides', 'stands' on joints or stops, or 'pressed' that needs to be; or ''."""
        problem = self.problem
        if not motion.any() or not motion @ (problem.M @ motion):
            return ""
        if self.holds(motion, dashpots=True):
            return "held"
        pushed = self.factors @ (problem.loading.forces.T @ motion)
        forces = self.factors @ np.abs(problem.loading.forces[motion != 0.0]).sum(axis=0)
        largest = float(np.abs(pushed).max(initial=0.0))
        excited = largest > ROUNDING * float(np.abs(forces).max(initial=0.0))
        closed, *ways = self._closed(motion), *(self.touches(s * motion) for s in (1.0, -1.0))
        closed = closed or np.abs(problem.contact.friction.H @ motion).max(initial=0.0)
        if all(ways):
            return "held"
        if any(ways):
            load = problem.loading
            shaken = self.factors.any() and (load.forces.any() or load.imposed.any())
            weight = excited and abs(float(pushed.mean())) > PRESSED * largest
            return "pressed" if shaken and not weight else "stands"
        return "slides" if excited and not closed and self.stirs(motion, size) else ""

    def stirs(self, motion: FloatArray, size: float) -> bool:
        """Whether loads move a body of a size on, along a motion that nothing holds."""
        pushed = self.factors @ (self.problem.loading.forces.T @ motion)
        dt, mass = np.diff(self.problem.times), float(motion @ (self.problem.M @ motion))
        way = np.abs(np.cumsum(np.cumsum(pushed[1:] * dt) * dt)).max(initial=0.0) / (mass or 1.0)
        return bool(way * np.abs(motion).max() > STIRS * size or not pushed.any())

    def holds(self, motion: FloatArray, *, dashpots: bool = False) -> bool:
        """Whether stiffness or supports act against a motion, or the dashpots of several masses."""
        problem = self.problem
        if np.abs(problem.constraints.C @ motion).max(initial=0.0) > ROUNDING:
            return True
        natural = motion**2 @ abs(problem.K.diagonal())
        if abs(motion @ (problem.K @ motion)) > ROUNDING * natural:
            return True
        if not dashpots or motion @ (problem.C @ motion) == 0.0:
            return False
        return np.count_nonzero(motion) == 1 or is_dragged(problem, motion)

    def _closed(self, motion: FloatArray) -> float:
        """Stiffness against a motion of joints that are pressed."""
        joints = self.problem.interface
        if not (delta := joints.J @ motion).any():
            return 0.0
        return float(delta @ (joints.closed_stiffness() @ delta))

    def touches(self, motion: FloatArray) -> bool:
        """Whether stops or joints act against a small motion from the start."""
        if (self.problem.contact.G @ motion < -ROUNDING).any():
            return True
        joints = joint_state(self.problem, LITTLE * motion)
        return bool(joints.f @ joints.delta > LITTLE**3 * self._closed(motion))


def swings(problem: Problem, factors: FloatArray) -> Iterator[Swing]:
    """The motions that loads of these factors and first velocities ask for; small problems alone.

    Of a force f the static displacement x has the period `2 pi sqrt(x M x / x f)`, an upper
    estimate of those of the modes that it excites, weighed by their compliance (Rayleigh).
    Supports that move ask for what the inertia of the displacement that follows them does.
    """
    T, given = problem.constraints.T, _loads(problem, factors)
    if T.shape[1] > MOST_MOTIONS or len(problem.contact) or not given:
        return
    K = closed_stiffness(problem)
    largest = float(abs(K).max()) if K.nnz else 0.0
    if not largest or (K.diagonal() < 0.0).any():  # stresses of a matched layer are unknowns
        return
    # held by next to nothing: a load that moves a part of what is free is seen, too
    solved = solver_of(K + sp.eye_array(K.shape[0]) * (0.01 * WEAK * largest))
    if pulled := [(k, way, held) for k, (way, held, *_) in enumerate(given) if held is not None]:
        moved, ways, pulls = zip(*pulled, strict=True)
        follows = T @ solved(T.T @ np.column_stack(pulls))
        for k, force in zip(moved, (problem.M @ (np.column_stack(ways) - follows)).T, strict=True):
            given[k] = (force, *given[k][1:])
    forces = np.column_stack([T.T @ f for f, *_ in given])
    motions = solved(forces)
    free = np.abs(motions).max(axis=0) * largest * WEAK > np.abs(forces).max(axis=0)
    free |= (motions * (K @ motions)).sum(axis=0) < WEAK * (K.diagonal() @ motions**2)
    for x, (force, pull, sudden, k), unheld in zip((T @ motions).T, given, free, strict=True):
        if unheld:
            if pull is None and not is_dragged(problem, x):
                yield Swing(np.inf, 0.0, sudden, k, x)
            continue
        moved, work = float(x @ (problem.M @ x)), float(x @ force)
        if moved > 0.0 and 0.0 < work < np.inf:
            period, damped = 2.0 * np.pi * np.sqrt(moved / work), float(x @ (problem.C @ x))
            damped *= abs(damped) > ROUNDING * (x**2 @ abs(problem.C.diagonal()))
            yield Swing(float(period), damped / (2.0 * np.sqrt(work * moved)), sudden, k, x)


def is_dragged(problem: Problem, motion: FloatArray) -> bool:
    """Whether dashpots act against a motion; damping by the mass holds nothing."""
    drag, pull = problem.C @ motion, problem.M @ motion
    drag = drag - pull * (motion @ drag) / ((motion @ pull) or 1.0)
    natural = motion**2 @ abs(problem.C.diagonal())
    return bool(np.abs(motion * drag).max() > LITTLE * natural)


def solver_of(K: sp.csr_array) -> Callable[[FloatArray], FloatArray]:
    """What gives motions (n, k) under forces (n, k), K factorised once.

    Raises
    ------
    SingularFactorError
        If nothing holds what moves.
    """
    if K.shape[0] > DENSE:
        return SuperLUFactor(sp.csr_array(K), positive=True).solve
    factors, order, singular = la.lapack.dgetrf(K.toarray())
    if singular:
        raise SingularFactorError(f"pivot {singular}")
    return lambda forces: np.asarray(la.lapack.dgetrs(factors, order, forces)[0], float)


def _loads(
    problem: Problem, factors: FloatArray
) -> list[tuple[FloatArray, FloatArray | None, bool, int]]:
    """Forces (n,) of loads that change and of velocities, or ways of supports; if sudden; number.

    Of ways: what stiffness and closed joints hold them with (n,).
    """
    loading = problem.loading
    found: list[tuple[FloatArray, FloatArray | None, bool, int]] = []
    sizes = np.abs(factors).max(axis=0, initial=0.0)
    bends = np.abs(np.diff(factors, 2, axis=0)).max(axis=0, initial=0.0)
    for k in np.flatnonzero(np.ptp(factors, axis=0) > 0.0):
        sudden = bool(bends[k] > SUDDEN * sizes[k])
        found.append((loading.forces[:, k], None, sudden, int(k)))
        if loading.imposed[:, k].any():
            way = problem.constraints.particular(loading.imposed[:, k])
            found.append((way, closed_forces(problem, way), sudden, int(k)))
    found.append((problem.M @ problem.v, None, True, -1))
    return [g for g in found if (g[0] if g[1] is None else g[1]).any()]


def against_supports(problem: Problem) -> dict[str, IntArray]:
    """Conditions that the initial displacements ('DEPL') and velocities ('VITE') do not obey."""
    rows = problem.constraints.C
    imposed = problem.loading.imposed @ problem.loading.at(problem.times[:1])[0]
    taken = problem.v - admissible_velocity(problem)
    found = {}
    for index, value, off in (
        ("DEPL", np.append(problem.u, imposed), rows @ problem.u - imposed),
        ("VITE", problem.v, rows @ taken),
    ):
        size = np.abs(value).max(initial=0.0)
        found[index] = np.flatnonzero(np.abs(off) > LITTLE * size) if size else np.zeros(0, int)
    return found


def masses_alone(problem: Problem) -> IntArray:
    """Nodes (n,) with mass or dashpots that nothing holds, joins, pushes or moves."""
    joints, contact, loading = problem.interface, problem.contact, problem.loading
    used = np.zeros(problem.numbering.size, bool)
    for matrix in (problem.K, problem.constraints.C, joints.J, contact.G):
        used[matrix.indices[matrix.data != 0.0]] = True
    used |= loading.forces.any(axis=1) | (problem.u != 0.0) | (problem.v != 0.0)
    nodes = problem.numbering.nodes
    heavy, damped = (nodes[matrix.diagonal() != 0.0] for matrix in (problem.M, problem.C))
    found = np.setdiff1d(np.union1d(heavy, damped), nodes[used])
    rows = np.flatnonzero(np.isin(nodes, found))
    dashpots = sp.coo_array(problem.C[rows])
    joined = (dashpots.data != 0.0) & (rows[dashpots.row] != dashpots.col)
    return np.setdiff1d(found, nodes[rows[dashpots.row[joined]]])


def on_supports(start: Start) -> IntArray:
    """Loads that supports take, all but a hundredth of them; weights where they change, too."""
    problem = start.problem
    T, forces, along = problem.constraints.T, problem.loading.forces, translations(problem)
    sizes, left = (np.abs(f).sum(axis=0) for f in (forces, T.T @ forces))
    weighs = shares(problem.M @ along, forces).any(axis=0) if along.size else sizes < 0.0
    few = left <= np.where(weighs, ROUNDING, NEARLY) * sizes
    return np.flatnonzero((sizes > 0.0) & few & (start.changing | ~weighs))


# Whether a step resolves contact: the half period of the mass that a joint carries.

STEPS_WANTED = 30
"""Steps per contact: at 32 the energy error of an impact is 0.05 %, at 10 some 7 %."""

SAME_DIGITS = 5e-3  # half of the last of three digits


@dataclass(frozen=True)
class Resolution:
    """Contact time `T_c = pi sqrt(m/k)` and largest step of a problem."""

    contact_time: float
    dt: float

    @property
    def wanted_dt(self) -> float:
        """Largest step that resolves contact."""
        return self.contact_time / STEPS_WANTED

    @property
    def resolved(self) -> bool:
        """Whether the step is short enough, in the three digits in which both are told."""
        return self.dt <= self.wanted_dt * (1 + SAME_DIGITS)


def contact_resolution(problem: Problem) -> Resolution | None:
    """Contact time of the joints all together, None without mass or joints that open.

    k is the stiffness of all joints closed under a uniform normal jump, m the mass of the bodies
    on their two sides, `1/m = 1/m_1 + 1/m_2`, moving as a whole along the mean normal (fixed
    nodes count for nothing). Bodies without mass do not count: they ring whatever the step.
    """
    joints = problem.interface
    if not joints or problem.M.nnz == 0:
        return None
    if not any(law_of(j.zone.behaviour).opens for j in joints.joints):
        return None
    opening = _uniform_opening(joints.pairs, joints.B, joints.size)
    force = joints.closed_stiffness() @ opening
    k = float(opening @ force)
    if k <= 0.0:
        return None
    label, motion = bodies_of(problem), translation(problem, opening.reshape(-1, joints.dimension))
    push = (joints.J.T @ (force / k)) * motion
    mass = motion * (problem.M @ motion)
    count = int(label.max()) + 1
    pushes = np.bincount(label, push, count)
    masses = np.bincount(label, mass, count)
    moving = (masses > 0.0) & (np.abs(pushes) > 1e-9)
    mobility = float(np.sum(pushes[moving] ** 2 / masses[moving]))
    if mobility <= 0.0:
        return None
    return Resolution(float(np.pi / np.sqrt(k * mobility)), float(np.diff(problem.times).max()))


def _uniform_opening(pairs: IntArray, B: FloatArray, size: int) -> FloatArray:
    """Pair jumps (size,) of a unit opening along the mean normals at the pairs."""
    d = B.shape[1]
    total = np.zeros((size // d, d))
    normals = B[:, -1].reshape(len(B), -1, d)
    np.add.at(total, pairs, normals)
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return (total / np.where(length > 0, length, 1.0)).ravel()


@dataclass(frozen=True)
class Overload:
    """A footing whose loads press more than its ground bears."""

    node: int
    pressing: float  # force (N)
    capacity: float  # force (N)


def overloads(problem: Problem, factors: FloatArray) -> list[Overload]:
    """Macro-elements whose ground bears less than the loads on the body above press.

    Bodies that something else holds, or several macro-elements, are left out: how they share the
    loads is not known beforehand.

    Parameters
    ----------
    factors : array (n_loads,)
        Of the loads at an instant.
    """
    joints = problem.interface
    if not joints.beds:
        return []
    label = bodies_of(problem)
    force = problem.loading.forces @ factors
    borne = [label[_above(problem, bed)[0]] for bed in joints.beds]
    found = []
    for bed, body in zip(joints.beds, borne, strict=True):
        cells, cell = joints.cell_of(bed)
        along = translation(problem, cells.frames[cell, :1, -1])
        motion = np.where(label == body, along, 0.0)
        resisting = motion @ (problem.K @ motion)
        natural = motion**2 @ abs(problem.K.diagonal())
        if borne.count(body) > 1 or abs(resisting) > ROUNDING * natural:
            continue
        pressing = -float(motion @ force)
        if pressing > bed.capacity:
            node = int(problem.numbering.nodes[_above(problem, bed)[0]])
            found.append(Overload(node, pressing, bed.capacity))
    return found


def _above(problem: Problem, bed: Bed) -> list[int]:
    """Displacements of a macro-element's upper node."""
    joints, cell = problem.interface.cell_of(bed)
    node = int(joints.zone.cells.nodes.resolve(joints.upper[cell]).ravel()[0])
    return [problem.numbering.index_of(node, name) for name in displacement_names(joints.zone)]


# How stiff joints are against the bodies that they join: a slip of units shows here.

STRANGE = 1e8
"""Ratio that no joint needs: half of the digits are lost in the sum of both stiffnesses."""


def stiffness_contrast(problem: Problem) -> float | None:
    """Stiffness of the closed joints over that of the bodies at the same unknowns.

    Median over the unknowns that both have; None where there are none (bodies held by joints
    alone).
    """
    joints = problem.interface
    closed = joints.closed_stiffness().diagonal()
    of_joints = abs(joints.J).T @ closed
    of_bodies = problem.K.diagonal()
    both = (of_joints > 0.0) & (of_bodies > 0.0)
    if not both.any():
        return None
    return float(np.median(of_joints[both] / of_bodies[both]))
