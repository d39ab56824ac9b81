"""What happens to velocities when unilateral relations close, and while they stay closed.

With C the rows that close in a step and v_L the velocity at its end, the corrections set
`C v_c = -C v_L` (a reflection): (1) with the smallest change in the norm of the mass, which keeps
the kinetic energy; (2) in that of the step's matrix, which spreads it over the neighbours. The
acceleration stays that of equilibrium. Rows that were closed already are, if wished, projected:
`C v = 0` with the smallest change in the norm of the mass. Velocities are relative to what the
relations impose. Where friction holds, slips have no velocity.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.rows import BoolArray, ContactRows
from ssilang.kernel.solvers.cholesky.inverse import invert
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
        own = contact.pushing[: len(contact)]
        self._by_mass: FloatArray | None = None
        if self.options.correction == "MASSE" or self.options.persistent:
            self._by_mass = _mass_motions(problem, effective, own)
        self._slips: FloatArray | None = None
        if contact.friction is not None:
            self._slips = _mass_motions(problem, effective, contact.friction.H)
        self._by_step: FloatArray | None = None
        if self.options.correction == "RIGIDITE":
            self._by_step = effective.solve(own.T.toarray())

    def correct(self, motion: Motion, rate: FloatArray) -> None:
        """Change `motion.v`; `rate` (m,) is the velocity of the imposed values."""
        now = self.contact.closed(motion.contact)
        closing, lasting = now & ~self.closed, now & self.closed
        self.closed[:] = now
        if self.options.correction != "FAUX" and closing.any():
            motions = self._by_mass if self.options.correction == "MASSE" else self._by_step
            assert motions is not None
            self._move(motion, motions, closing, -2.0, rate)
        if self.options.persistent and lasting.any():
            assert self._by_mass is not None
            self._move(motion, self._by_mass, lasting, -1.0, rate)
        self._hold(motion)

    def _hold(self, motion: Motion) -> None:
        """What sticks has no velocity and no acceleration along its friction.

        The average acceleration would turn a rest of velocity round at each step for ever.
        """
        friction = self.contact.friction
        if friction is None or self._slips is None:
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


def _mass_motions(problem: Problem, effective: Effective, rows: sp.csr_array) -> FloatArray:
    """`M^-1 rows^T` on the admissible motions (n, m)."""
    T, V = problem.constraints.T, problem.constraints.V
    mass = problem.M + (MASSLESS * 0.25 * effective.dt**2) * effective.A
    mass = sp.csr_array(V.T @ mass @ T)
    inverse = invert(mass, problem.constraints.associated, problem.solver)
    found: FloatArray = T @ inverse.solve(V.T @ rows.T.toarray())
    return found
