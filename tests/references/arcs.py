"""Exact arcs of a linear system and the first root of a linear function along them.

Between two events a piecewise linear system is linear, and its motion is a sum of modes that is
written down in closed form. Events are found without any bracket or scan: along an arc the second
derivative of a gap is bounded by its modal amplitudes, so that a parabola bounds the gap from
below and says how far one may go without meeting a root. Near a root that step becomes Newton's,
from the safe side: convergence is quadratic and the first root cannot be missed.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

Array = NDArray[np.float64]

ZERO_PULSATION = 1e-6
"""Relative to the largest pulsation: below it a mode is taken as a rigid-body one.

Its square, 1e-12, stands well above the rounding of the eigenvalues (1e-15)."""


@dataclass(frozen=True)
class Forcing:
    """Force `constant + amplitude sin(pulsation t + phase)` from the time `start` on."""

    start: float
    constant: Array
    amplitude: Array | float = 0.0
    pulsation: float = 1.0
    phase: float = 0.0


class Arc:
    """Motion of `M u'' + K u = forcing(t)` from `u, v` at the time `start`, in closed form.

    Parameters
    ----------
    mass, stiffness : array (n, n)
        Symmetric, positive definite and positive semi-definite.
    forcing : Forcing
    start : float
    u, v : array (n,)
    """

    def __init__(
        self, mass: Array, stiffness: Array, forcing: Forcing, start: float, u: Array, v: Array
    ) -> None:
        squares, self.modes = eigh(stiffness, mass)
        largest = max(float(np.sqrt(np.max(np.abs(squares)))), 1e-300)
        if np.min(squares) < -((1e-6 * largest) ** 2):
            raise ValueError("the stiffness has a negative mode")
        w = np.sqrt(np.clip(squares, 0.0, None))
        self.w = np.where(w > ZERO_PULSATION * largest, w, 0.0)
        self.start = start
        n = len(self.w)
        self.a = self.modes.T @ np.broadcast_to(np.asarray(forcing.constant, float), (n,))
        b = self.modes.T @ np.broadcast_to(np.asarray(forcing.amplitude, float), (n,))
        self.pulsation = forcing.pulsation
        self.phase = forcing.pulsation * start + forcing.phase
        detuning = self.w**2 - self.pulsation**2
        if np.any((np.abs(detuning) < 1e-6 * self.pulsation**2) & (b != 0.0)):
            raise ValueError("resonant forcing is not covered")
        self.b = np.divide(b, detuning, out=np.zeros(n), where=b != 0.0)
        q, dq = self.modes.T @ (mass @ u), self.modes.T @ (mass @ v)
        q = q - self.b * np.sin(self.phase)
        dq = dq - self.b * self.pulsation * np.cos(self.phase)
        moving = self.w > 0.0
        safe = np.where(moving, self.w, 1.0)
        self.centre = np.where(moving, self.a / safe**2, 0.0)
        self.cosine = np.where(moving, q - self.centre, q)
        self.sine = np.where(moving, dq / safe, dq)

    def state(self, t: Array | float) -> tuple[Array, Array]:
        """Displacement and velocity at the times `t`, shapes (..., n)."""
        s = np.asarray(t, float)[..., None] - self.start
        moving = self.w > 0.0
        c, d = np.cos(self.w * s), np.sin(self.w * s)
        q = np.where(
            moving,
            self.centre + self.cosine * c + self.sine * d,
            self.cosine + self.sine * s + 0.5 * self.a * s**2,
        )
        dq = np.where(moving, self.w * (self.sine * c - self.cosine * d), self.sine + self.a * s)
        q = q + self.b * np.sin(self.pulsation * s + self.phase)
        dq = dq + self.b * self.pulsation * np.cos(self.pulsation * s + self.phase)
        return q @ self.modes.T, dq @ self.modes.T

    def curvature_bound(self, c: Array) -> float:
        """A number that |d2/dt2 (c.u)| never exceeds on this arc."""
        free = np.where(self.w > 0.0, self.w**2 * np.hypot(self.cosine, self.sine), np.abs(self.a))
        forced = np.abs(self.b) * self.pulsation**2
        return float(np.abs(c @ self.modes) @ (free + forced))

    def first_root(self, c: Array, offset: float, sign: float, end: float) -> float:
        """First time in [start, end] at which `sign (c.u + offset)` stops being positive.

        The function is taken as zero or positive at the start. Returns `inf` if it has no root.
        """
        bound = self.curvature_bound(c)
        t = self.start
        while t <= end:
            u, v = self.state(t)
            height = max(sign * float(c @ u + offset), 0.0)
            slope = sign * float(c @ v)
            if bound == 0.0 and slope >= 0.0:
                return np.inf
            step = safe_step(height, slope, bound)
            t += step
            if step <= 4e-16 * max(1.0, abs(t)):
                return t
        return np.inf


def safe_step(height: float, slope: float, bound: float) -> float:
    """How far `height + slope s - bound s^2/2` stays positive (its larger root)."""
    if bound == 0.0:
        return height / -slope
    root = float(np.sqrt(slope**2 + 2.0 * bound * height))
    if slope >= 0.0:
        return (slope + root) / bound
    return 2.0 * height / (root - slope)
