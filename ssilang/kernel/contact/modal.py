"""Small problems with unilateral relations, set up for `run_contact`."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.contact.active_set import ActiveSet, active_set_of
from ssilang.kernel.contact.impact import MASSLESS, solves_bodies
from ssilang.kernel.contact.modal_loop import (
    ROUNDING,
    Stops,
    VelocityChange,
    factorise,
    room_of,
    run_contact,
)
from ssilang.kernel.contact.rows import BoolArray, ContactRows
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.problem import (
    Problem,
    keep_reactions,
    react,
    supports_are_still,
)
from ssilang.kernel.stepping.rests.modal.diagonal import Diagonal
from ssilang.kernel.stepping.rests.modal.modes import Modes, modes_of
from ssilang.kernel.stepping.state import Motion, Outcome, Recorder, Tap, recorder_of
from ssilang.kernel.stepping.track import JointRows, Matrix, View, expand

MOST = 400
"""Motions that supports leave, up to which all modes are made and steps are compiled."""
MOST_UNKNOWNS = 2000
EXACT = ("LAGRANGE", "AUGMENTE")
"""Methods whose reactions are the exact ones, whatever their coefficient."""


def takes(problem: Problem) -> bool:
    """Whether `ContactLoop` may run a problem: few unknowns, relations alone, supports at rest."""
    contact, options = problem.contact, problem.contact_options
    if problem.interface or len(contact) == 0:
        return False
    if contact.friction or not contact.associated:
        return False
    exact = options.method in EXACT and options.coefficient is None
    soft = options.method == "PENALITE" and (options.coefficient or 0.0) > 0.0
    few = problem.constraints.T.shape[1] <= MOST and problem.numbering.size <= MOST_UNKNOWNS
    return (
        (exact or soft) and few and problem.constraints.associated and supports_are_still(problem)
    )


def contact_loop(
    problem: Problem, motion: Motion, effective: Effective, closed: BoolArray
) -> "ContactLoop | None":
    """The compiled loop; None where the damping is not diagonal or rows depend on one another."""
    if effective.inverse.singular:
        return None
    modes = modes_of(problem, effective)
    if modes is None or len(modes.sense):
        return None
    stops = _stops(problem, problem.contact, modes, closed, effective.dt)
    rows, m = _rows(stops), len(problem.contact)
    for A in (rows.Q, stops.closing.on, stops.lasting.on):
        if len(A) and not factorise(A, np.arange(m), m, np.zeros((m, m))):
            return None
    return ContactLoop(problem, motion, modes, stops, rows)


def _rows(stops: Stops) -> ActiveSet:
    """The relations by their flexibility, with the springs of a penalty."""
    m = len(stops.G)
    W = stops.G @ stops.G.T
    if stops.stiffness:
        W += np.eye(m) / stops.stiffness
    return active_set_of(W, 1.0 / np.diag(W), ROUNDING)


def _stops(
    problem: Problem, contact: ContactRows, modes: Modes, closed: BoolArray, dt: float
) -> Stops:
    options, n = problem.contact_options, newmark_of(problem.scheme, dt)
    G = np.ascontiguousarray(contact.G @ modes.X)
    stiffness = float(options.coefficient or 0.0) if options.method == "PENALITE" else 0.0
    none = np.zeros((modes.size, 0))
    mass = modes.m + MASSLESS * 0.25 * dt**2
    by_mass = np.ascontiguousarray(G.T / mass[:, None])
    by_step = np.ascontiguousarray(G.T)
    closing = {"MASSE": by_mass, "RIGIDITE": by_step}.get(options.correction, none)
    lasting = by_mass if options.persistent else none
    struck = by_mass if solves_bodies(problem) else none
    nothing = np.zeros((0, 0))
    return Stops(
        n, Diagonal(modes.m, modes.c, modes.k, np.ones(modes.size)), G, modes.forces,
        np.ascontiguousarray(contact.imposed),
        VelocityChange(closing, G @ closing if closing.size else nothing, -2.0),
        VelocityChange(lasting, G @ lasting if lasting.size else nothing, -1.0),
        VelocityChange(struck, G @ struck if struck.size else nothing, -1.0), modes.c / mass,
        stiffness, closed,
    )  # fmt: skip


class ContactLoop:
    """Steps of one dt."""

    remembered = ("_z", "_seen", "_rows")

    def __init__(
        self, problem: Problem, motion: Motion, modes: Modes, stops: Stops, rows: ActiveSet
    ) -> None:
        self.problem, self.motion, self.modes, self.stops = problem, motion, modes, stops
        self._rows = rows
        self._seen: FloatArray | None = None  # displacement up to which z is known
        self._z = np.zeros((3, modes.size))

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps on the whole problem's arrays."""
        m, X, r = self.motion, self.modes.X, recorder
        if self._seen is None or not np.array_equal(self._seen, m.u):
            self._z = self.modes.coordinates(np.stack([m.u, m.v, m.a], axis=1)).T.copy()
        u, v, a = self._z
        few = m._replace(u=u, v=v, a=a, reaction=np.zeros(0))
        kept = recorder_of(few, r.row, r.energies, ("u", "v", "a", "contact"), tap=r.tap)
        outcome = run_contact(
            self.stops, self._rows, few, room_of(*self.stops.G.shape), factors, kept
        )
        m.u[:], m.v[:], m.a[:] = self._z @ X.T
        self._seen = m.u.copy()
        for part, z in zip((r.u, r.v, r.a), (kept.u, kept.v, kept.a), strict=True):
            part[:] = expand(X, z)
        r.contact[:] = kept.contact
        keep_reactions(self.problem, factors, r)
        react(self.problem, m, factors[outcome[0]])
        return outcome

    def view(self, unknowns: IntArray) -> View:
        """How unknowns follow from all modes."""
        n, m = self.modes.size, self.motion
        shapes: dict[str, tuple[int, ...]] = {"u": (n,), "v": (n,), "a": (n,)}
        shapes["contact"] = m.contact.shape
        return View(np.arange(n), shapes, Matrix(self.modes.X[unknowns]), self._no_joints)

    def _no_joints(self, tap: Tap) -> JointRows:
        m, rows = self.motion, len(tap.u)
        return JointRows(*(np.zeros((rows, *x.shape)) for x in (m.w, m.t, m.state)))
