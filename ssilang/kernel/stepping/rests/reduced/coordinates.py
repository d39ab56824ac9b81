"""Steps of a reduced model by Newton's method on its coordinates, for interfaces of more unknowns.

    A dz + c J^T (f(delta_0 + J dz) - f_0) = r ,   A = mass M + damping C + c K

The law acts at every point of the joints. The LU factor of `A + c J^T K_j J`, K_j the joints'
tangent, is kept from turn to turn and step to step, and made again where a turn gains less than
`GAIN`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    Trial,
    accept,
    interface_energies,
    interface_response,
    new_trial,
)
from ssilang.kernel.stepping.newmark import Newmark, advanced, from_past
from ssilang.kernel.stepping.state import (
    DAMPED,
    ELASTIC,
    EXTERNAL,
    KINETIC,
    LOST,
    STORED,
    Motion,
    Outcome,
    Recorder,
)

if TYPE_CHECKING:
    from ssilang.kernel.stepping.rests.reduced.loop import Reduced

MOST_TURNS = 60
TOLERANCE = 1e-10  # of the forces of a step
GAIN = 5.0  # of a turn with a kept factor, below which it is made again


@dataclass(eq=False)
class Coordinates:
    """Steps of one dt on r coordinates.

    Attributes
    ----------
    J : array (q, r)
    A, C : arrays (r, r)
        The step's matrix without joints, damping.
    """

    model: Reduced
    newmark: Newmark
    joints: Joints
    J: FloatArray = field(init=False)
    _factor: Any = None

    def __post_init__(self) -> None:
        m, n, p = self.model, self.newmark, self.joints
        q, d = m.Rt.shape[1] - len(m.sense), p.B.shape[1]
        self.J, B = np.ascontiguousarray(m.Rt[:, :q].T), m.Rt[:, q:]
        self.C = np.diag(m.c) + (B * m.sense) @ B.T
        self.A = np.diag(n.mass * m.m + n.end * m.k) + n.damping * self.C
        self._trial = new_trial((len(p.weights), d), q)
        places = (p.pairs[:, :, None] * d + np.arange(d)).reshape(len(p.pairs), -1)
        k = places.shape[1]
        self._at = np.repeat(places, k, axis=1).ravel(), np.tile(places, (1, k)).ravel()

    def run(self, x: Motion, factors: FloatArray, to: Recorder) -> Outcome:
        """Steps between the rows of `factors`; `x` and the rows hold coordinates."""
        m, n, C, e, worst = self.model, self.newmark, self.C, x.energies, 0
        loads = factors @ m.forces
        for k in range(len(to.row)):
            r = from_past(n, m.m * x.v, m.m * x.a, C @ x.v, C @ x.a) - m.k * x.u
            r += n.end * loads[k + 1] + n.start * loads[k] - x.f @ self.J
            dz, turns, residual = self._solve(x.joints, r)
            if turns <= 0:
                return k, turns, residual
            worst, v = max(worst, turns), x.v.copy()
            x.u[:] += dz
            x.v[:], x.a[:] = advanced(n, dz, v, x.a)
            e[KINETIC], e[ELASTIC] = 0.5 * m.m @ x.v**2, 0.5 * m.k @ x.u**2
            e[DAMPED] += 0.5 * dz @ (C @ (v + x.v))
            e[EXTERNAL] += 0.5 * dz @ (loads[k] + loads[k + 1])
            e[STORED], e[LOST] = interface_energies(self.joints, x.w, x.t, x.state)
            to.energies[k], to.jumps[k] = e, x.w
            if to.row[k] >= 0:
                for name in ("u", "v", "a", "w", "t", "state"):
                    getattr(to, name)[to.row[k]] = getattr(x, name)
        return len(to.row), worst, 0.0

    def _solve(self, now: InterfaceState, r: FloatArray) -> tuple[FloatArray, int, float]:
        """The increment (r,), turns (<= 0: none converged), what is out of balance."""
        import scipy.linalg as la

        trial, end, old = self._trial, self.newmark.end, np.inf
        dz, scale = np.zeros(len(r)), np.abs(r).max(initial=0.0)
        for turn in range(1, MOST_TURNS + 1):
            trial.y[:] = self.J @ dz
            trial.delta[:] = now.delta + trial.y
            interface_response(self.joints, now.state, trial.delta, trial)
            held = self.A @ dz
            left = r - held - end * ((trial.f - now.f) @ self.J)
            size = np.abs(left).max() / max(scale + np.abs(held).max(), 1e-300)
            if size <= TOLERANCE:
                accept(trial, now)
                return dz, turn, size
            if not np.isfinite(size):
                break
            if self._factor is None or size * GAIN > old:
                self._factor = la.lu_factor(self.A + end * self._tangent(trial))
            old, dz = size, dz + la.lu_solve(self._factor, left)
        return dz, -MOST_TURNS, float(size)

    def _tangent(self, trial: Trial) -> FloatArray:
        """Tangent (r, r) of the joints."""
        p, q = self.joints, len(self.J)
        D = trial.D * p.weights[:, None, None]
        blocks = np.einsum("pia,pij,pjb->pab", p.B, D, p.B, optimize=True)
        K = sp.coo_array((blocks.ravel(), self._at), shape=(q, q)).tocsr()
        found: FloatArray = self.J.T @ (K @ self.J)
        return found
