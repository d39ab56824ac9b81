"""Small problems with unilateral relations, set up for `march_contact`."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.contact.impact import MASSLESS
from ssilang.kernel.contact.modal_loop import (
    ContactRowsKept,
    Held,
    Moving,
    Stops,
    factorise,
    march_contact,
)
from ssilang.kernel.contact.rows import BoolArray, ContactRows
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.arrays import joints_of
from ssilang.kernel.stepping.rests.dense.loop import Motion, Saved
from ssilang.kernel.stepping.rests.dense.still_supports import reactions, supports_are_still
from ssilang.kernel.stepping.rests.modal.modes import Modes, modes_of

MOST = 400
"""Motions that supports leave, up to which all modes are made and steps are compiled."""
MOST_UNKNOWNS = 2000
EXACT = ("LAGRANGE", "AUGMENTE")
"""Methods whose reactions are the exact ones, whatever their coefficient."""


def takes(problem: Problem) -> bool:
    """Whether `ContactLoop` may run a problem: few unknowns, relations alone, supports at rest."""
    contact, options = problem.contact, problem.contact_options
    if contact is None or problem.interface is not None or len(contact) == 0:
        return False
    if contact.friction is not None or not contact.associated:
        return False
    exact = options.method in EXACT and options.coefficient is None
    soft = options.method == "PENALITE" and (options.coefficient or 0.0) > 0.0
    few = problem.constraints.T.shape[1] <= MOST and problem.numbering.size <= MOST_UNKNOWNS
    return (
        (exact or soft) and few and problem.constraints.associated and supports_are_still(problem)
    )


def contact_loop(
    problem: Problem, motion: Motion, effective: Effective, closed: BoolArray
) -> ContactLoop | None:
    """The compiled loop; None where the damping is not diagonal or rows depend on one another."""
    if effective.inverse.singular:
        return None
    modes = modes_of(problem, effective)
    if modes is None or problem.contact is None:
        return None
    stops = _stops(problem, problem.contact, modes, effective.dt)
    m = len(problem.contact)
    for A in (stops.W, stops.closing, stops.lasting):
        if len(A) and not factorise(A, np.arange(m), m, np.zeros((m, m))):
            return None
    return ContactLoop(problem, motion, modes, stops, closed)


def _stops(problem: Problem, contact: ContactRows, modes: Modes, dt: float) -> Stops:
    options, s = problem.contact_options, problem.scheme
    G = np.ascontiguousarray(contact.G @ modes.X)
    stiffness = float(options.coefficient or 0.0) if options.method == "PENALITE" else 0.0
    own = G @ G.T
    W = own + np.eye(len(G)) / stiffness if stiffness else own
    none, nothing = np.zeros((modes.size, 0)), np.zeros((0, 0))
    by_mass = np.ascontiguousarray(G.T / (modes.m + MASSLESS * 0.25 * dt**2)[:, None])
    by_step = np.ascontiguousarray(G.T)
    closing = {"MASSE": by_mass, "RIGIDITE": by_step}.get(options.correction, none)
    lasting = by_mass if options.persistent else none
    return Stops(
        modes.m, modes.c, modes.k, G, W, modes.forces, np.ascontiguousarray(contact.imposed),
        closing, G @ closing if closing.size else nothing,
        lasting, G @ lasting if lasting.size else nothing,
        np.array([s.alpha_m, s.alpha_f, s.beta, s.gamma]), dt, stiffness,
    )  # fmt: skip


class ContactLoop:
    """Steps of one dt."""

    def __init__(
        self, problem: Problem, motion: Motion, modes: Modes, stops: Stops, closed: BoolArray
    ) -> None:
        self.problem, self.motion, self.modes = problem, motion, modes
        self.stops, self._closed = stops, closed
        m = len(closed)
        self._held = Held(
            np.zeros(m, bool), np.zeros(m, bool), np.zeros((m, m)), np.zeros(m, np.int64),
            np.zeros(m), np.zeros(m),
        )  # fmt: skip
        self._seen: FloatArray | None = None  # displacement up to which z is known
        self._z = np.zeros((3, modes.size))
        self._joints = joints_of(problem)

    def march(
        self, factors: FloatArray, save: IntArray, saved: Saved, history: FloatArray
    ) -> tuple[int, int, float]:
        """As `compiled_loop.march`, on the whole problem's arrays."""
        m, X, rows = self.motion, self.modes.X, len(saved.u)
        if self._seen is None or not np.array_equal(self._seen, m.u):
            self._z = self.modes.coordinates(np.stack([m.u, m.v, m.a], axis=1)).T.copy()
        moving = Moving(self._z, m.contact, self._closed, m.energies)
        kept = ContactRowsKept(np.zeros((rows, 3, self.modes.size)), saved.contact)
        outcome = march_contact(self.stops, moving, self._held, factors, save, kept, history)
        m.u[:], m.v[:], m.a[:] = self._z @ X.T
        self._seen = m.u.copy()
        for part, i in ((saved.u, 0), (saved.v, 1), (saved.a, 2)):
            np.matmul(kept.z[:, i], X.T, out=part)
        forces = self.problem.loading.forces.T
        loads = factors[1:][save >= 0] @ forces
        saved.reaction[:] = self._reactions(saved.u, saved.v, saved.a, loads)
        last = factors[outcome[0]] @ forces
        m.reaction[:] = self._reactions(m.u[None], m.v[None], m.a[None], last[None])[0]
        return outcome

    def _reactions(
        self, u: FloatArray, v: FloatArray, a: FloatArray, loads: FloatArray
    ) -> FloatArray:
        nothing = np.zeros((len(u), 0, 1))
        return reactions(self.problem, self._joints, u, v, a, nothing, loads)
