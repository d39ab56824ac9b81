"""What happens to velocities when unilateral relations close, and while they stay closed.

With C the rows that close in a step and v_L the velocity at its end, the corrections set
`C v_c = -C v_L` (a reflection): (1) with the smallest change in the norm of the mass, which keeps
the kinetic energy; (2) in that of the step's matrix, which spreads it over the neighbours. The
acceleration stays that of equilibrium. Rows that were closed already are, if wished, projected:
`C v = 0` with the smallest change in the norm of the mass. Velocities are relative to what the
relations impose. Where friction holds, slips have no velocity. A body that other rows hold when a
row strikes it does not rebound, see `struck`.
"""

from functools import cached_property

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.rows import BoolArray, ContactRows
from ssilang.kernel.contact.struck import STILL, press, slow_down, strike
from ssilang.kernel.solvers.cholesky.inverse import Inverse, invert
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import Motion

MASSLESS = 1e-10
"""Share of the step's matrix added to the mass, so that massless nodes move freely."""


class ImpactRule:
    """Velocity corrections of one problem and step size.

    Parameters
    ----------
    closed : array (m,) of bool
        Rows closed at the start of the run; kept up to date by `correct`.
    """

    def __init__(
        self, problem: Problem, effective: Effective, contact: ContactRows, closed: BoolArray
    ) -> None:
        self.contact, self.closed = contact, closed
        self.options = problem.contact_options
        self._problem, self._effective = problem, effective
        own = contact.pushing[: len(contact)]
        self._by_mass: FloatArray | None = None
        if self.options.correction == "MASSE" or self.options.persistent:
            self._by_mass = _mass_motions(problem, effective, own)[1]
        self._slips: FloatArray | None = None
        if contact.friction:
            self._slips = _mass_motions(problem, effective, contact.friction.H)[1]
        self._by_step: FloatArray | None = None
        if self.options.correction == "RIGIDITE":
            self._by_step = effective.solve(own.T.toarray())

    def correct(self, motion: Motion, rate: FloatArray) -> float | None:
        """Change `motion.v`; `rate` (m,) is the velocity of the imposed values.

        Where a body was struck while it was held, `motion.a` and `motion.contact` change too, and
        the result is the work of moving stops on it.
        """
        now = self.contact.closed(motion.contact)
        closing, lasting, work = now & ~self.closed, now & self.closed, None
        if now.any() and solves_bodies(self._problem):
            work = self._strike(motion, closing, rate)
        self.closed[:] = self.contact.closed(motion.contact)
        lasting &= self.closed
        if self.options.correction != "FAUX" and closing.any():
            motions = self._by_mass if self.options.correction == "MASSE" else self._by_step
            assert motions is not None
            self._move(motion, motions, closing, -2.0, rate)
        if self.options.persistent and lasting.any():
            assert self._by_mass is not None
            self._move(motion, self._by_mass, lasting, -1.0, rate)
        self._hold(motion)
        return work

    def _strike(self, motion: Motion, closing: BoolArray, rate: FloatArray) -> float | None:
        """Bodies that are struck while they are held; their rows no longer count as `closing`."""
        m, G, (X, W, _, flexibility) = len(rate), self.contact.G, self._bodies
        p, dt = motion.contact[:m], self._effective.dt
        v, step = G @ motion.v - rate, np.array([0.5 * dt, 2.0 / dt])
        c = v - step[1] * (flexibility @ p)
        held = self.closed & ~closing & (c <= 0.0)
        stays = held & (p > 0.0) & (rate == 0.0) & (np.abs(v) > STILL * np.abs(c))
        body, struck = np.zeros(m, bool), np.zeros(m, bool)
        impulse, change = np.zeros(m), np.zeros(m)
        if not (closing | stays).any():
            return None
        a = G @ motion.a
        if strike(W, flexibility, c, v, a, step, closing | stays, held, body, struck, impulse) == 0:
            return None
        self._push(motion, impulse)
        press(W, G @ motion.a, struck, p, change)
        motion.a[:] += X @ change
        p += change
        closing &= ~body
        work = rate @ (impulse - 0.5 * dt * change)
        slow_down(W, G @ motion.v - rate, G @ motion.a, v * step[0], body, struck, impulse)
        self._push(motion, impulse)
        return float(work + rate @ impulse)

    def _push(self, motion: Motion, impulse: FloatArray) -> None:
        """Velocities and accelerations after impulses (m,) on the rows."""
        X, _, mass, _ = self._bodies
        move, T, V = X @ impulse, self._problem.constraints.T, self._problem.constraints.V
        motion.v[:] += move
        if self._problem.C.nnz:
            motion.a[:] -= T @ mass.solve(V.T @ (self._problem.C @ move))

    @cached_property
    def _bodies(self) -> tuple[FloatArray, FloatArray, Inverse, FloatArray]:
        """Motions and flexibilities by the mass, its inverse, flexibilities of the step."""
        G, effective = self.contact.G, self._effective
        inverse, X = _mass_motions(self._problem, effective, G)
        flexibility = np.asarray(G @ effective.solve(G.T.toarray()))
        return X, np.ascontiguousarray(G @ X), inverse, flexibility

    def _hold(self, motion: Motion) -> None:
        """What sticks has no velocity and no acceleration along its friction.

        The average acceleration would turn a rest of velocity round at each step for ever.
        """
        friction = self.contact.friction
        if self._slips is None:
            return
        held = np.repeat(self.contact.sticking(motion.contact, motion.u), friction.width)
        if not held.any():
            return
        H, X = friction.H[np.flatnonzero(held)], self._slips[:, held]
        for rate in (motion.v, motion.a):
            rate[:] -= X @ np.linalg.lstsq(H @ X, H @ rate, rcond=1e-12)[0]

    def _move(
        self,
        motion: Motion,
        motions: FloatArray,
        rows: BoolArray,
        factor: float,
        rate: FloatArray,
    ) -> None:
        """Add to v the motion that changes the rows' velocities by `factor` times themselves."""
        G, X = self.contact.G[np.flatnonzero(rows)], motions[:, rows]
        wanted = factor * (G @ motion.v - rate[rows])
        motion.v[:] += X @ np.linalg.lstsq(G @ X, wanted, rcond=1e-12)[0]


def solves_bodies(problem: Problem) -> bool:
    """Whether impacts on bodies that are held are solved: multipliers, corrected, of two rows.

    Not where rows rub: sticking places would take part in the impact.
    """
    contact, options = problem.contact, problem.contact_options
    if len(contact) < 2 or options.correction == "FAUX":
        return False
    if contact.friction:
        return False
    return options.method != "PENALITE" and contact.associated and problem.constraints.associated


def _mass_motions(
    problem: Problem, effective: Effective, rows: sp.csr_array
) -> tuple[Inverse, FloatArray]:
    """Inverse of the mass on the admissible motions, `M^-1 rows^T` (n, m)."""
    T, V = problem.constraints.T, problem.constraints.V
    mass = problem.M + (MASSLESS * 0.25 * effective.dt**2) * effective.A
    mass = sp.csr_array(V.T @ mass @ T)
    inverse = invert(mass, problem.constraints.associated, problem.solver)
    return inverse, T @ inverse.solve(V.T @ rows.T.toarray())
