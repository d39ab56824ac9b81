"""One-degree-of-freedom oscillators that lift off: the three CLUB CAST3M cases.

Data: column r = 2 m, h = 10 m, E = 20 GPa, I = 0.2 m4, f0 = 10 Hz; the soil's vertical stiffness
k_y is a figure read from the slides and is treated as data.
"""

from dataclasses import dataclass

import numpy as np

from .arcs import Array, Forcing
from .contact import System, UnilateralSpring

STRUCTURE_STIFFNESS = 3.0 * 20e9 * 0.2 / 10.0**3
"""k_s = 3 E I / h^3 = 12e6 N/m."""
PULSATION = 2.0 * np.pi * 10.0
MASS = STRUCTURE_STIFFNESS / PULSATION**2
SOIL_STIFFNESS = 7.3888e6
GRAVITY = 9.81


@dataclass(frozen=True)
class ClubA:
    """`m u'' + k u = p`, `u >= 0`, from u0 at rest, elastic impacts: `u = |u0 cos w t|`."""

    u0: float = 0.01
    w: float = PULSATION

    def motion(self, t: Array) -> tuple[Array, Array]:
        """Displacement and velocity; at an impact the velocity after it."""
        t = np.asarray(t, float)
        wave = np.cos(self.w * t)
        after = -np.sign(np.sin(self.w * t))  # slope's sign of the wave right of a zero
        sign = np.where(wave != 0.0, np.sign(wave), after)
        return self.u0 * np.abs(wave), -self.u0 * self.w * sign * np.sin(self.w * t)

    def impacts(self, end: float) -> Array:
        """Times of impact up to `end`."""
        n = int(np.floor(end * self.w / np.pi + 0.5))
        return np.asarray((np.arange(n) + 0.5) * np.pi / self.w)

    def energy(self, t: Array, mass: float = MASS) -> Array:
        """Kinetic and elastic energy."""
        u, v = self.motion(t)
        return 0.5 * mass * (v**2 + (self.w * u) ** 2)


@dataclass(frozen=True)
class ClubB:
    """Bilinear oscillator `m u'' + k_s u + k_y min(u, 0) = 0` from u0 > 0 at rest.

    This is the exact motion of the structure on a joint of normal stiffness `k_y` whose other
    face is fixed. With a massless soil node between a joint of stiffness `k_joint` and a soil
    spring of stiffness `k_soil`, statics of that node makes the two act in series, and only in
    compression: the motion is again this one, with `series_stiffness(k_joint, k_soil)` as k_y.
    """

    u0: float = 0.01
    k_s: float = STRUCTURE_STIFFNESS
    k_y: float = SOIL_STIFFNESS
    mass: float = MASS

    @property
    def w_open(self) -> float:
        """Pulsation out of contact."""
        return float(np.sqrt(self.k_s / self.mass))

    @property
    def w_closed(self) -> float:
        """Pulsation in contact."""
        return float(np.sqrt((self.k_s + self.k_y) / self.mass))

    @property
    def period(self) -> float:
        """Half a period out of contact and half a period in contact."""
        return np.pi / self.w_open + np.pi / self.w_closed

    def motion(self, t: Array) -> tuple[Array, Array]:
        """Displacement and velocity."""
        w1, w2 = self.w_open, self.w_closed
        # phase counted from the last lift-off; the start is half way through the flight
        s = np.mod(np.asarray(t, float) + 0.5 * np.pi / w1, self.period)
        flying = s < np.pi / w1
        r = s - np.pi / w1
        speed = self.u0 * w1
        u = np.where(flying, self.u0 * np.sin(w1 * s), -speed / w2 * np.sin(w2 * r))
        v = np.where(flying, speed * np.cos(w1 * s), -speed * np.cos(w2 * r))
        return u, v

    def openings(self, end: float) -> Array:
        """Times at which contact ends."""
        first = 0.5 * np.pi / self.w_open + np.pi / self.w_closed
        return np.arange(first, end, self.period)

    @property
    def energy(self) -> float:
        """Total energy."""
        return 0.5 * self.k_s * self.u0**2

    @property
    def system(self) -> System:
        """The same oscillator for the event-driven solver."""
        spring = UnilateralSpring(np.ones(1), self.k_y)
        one = np.ones((1, 1))
        return System(self.mass * one, self.k_s * one, (spring,), (Forcing(0.0, np.zeros(1)),))


@dataclass(frozen=True)
class ClubC:
    """A mass under its weight on a unilateral spring, released below its rest and hopping.

    Contact begins at u = 0 (unstretched position). From `depth` static settlements below it, at
    rest: `u/d = -1 - (depth - 1) cos w t` in contact, a ballistic arc in flight (depth > 2).
    """

    depth: float = 4.0
    k_y: float = SOIL_STIFFNESS
    w: float = PULSATION
    gravity: float = GRAVITY

    @property
    def mass(self) -> float:
        """k_y / w^2."""
        return self.k_y / self.w**2

    @property
    def settlement(self) -> float:
        """Static settlement g / w^2."""
        return self.gravity / self.w**2

    @property
    def half_contact(self) -> float:
        """Time from the lowest point to lift-off."""
        return float(np.arccos(-1.0 / (self.depth - 1.0)) / self.w)

    @property
    def lift_speed(self) -> float:
        """Velocity at lift-off."""
        return self.settlement * self.w * float(np.sqrt((self.depth - 1.0) ** 2 - 1.0))

    @property
    def flight(self) -> float:
        """Duration of a flight."""
        return 2.0 * self.lift_speed / self.gravity

    @property
    def period(self) -> float:
        """One contact and one flight."""
        return 2.0 * self.half_contact + self.flight

    def motion(self, t: Array) -> tuple[Array, Array]:
        """Displacement and velocity."""
        d, w = self.settlement, self.w
        s = np.mod(np.asarray(t, float) + self.half_contact, self.period)
        touching = s < 2.0 * self.half_contact
        phase = w * (s - self.half_contact)
        r = s - 2.0 * self.half_contact
        u = np.where(
            touching,
            -d - (self.depth - 1.0) * d * np.cos(phase),
            self.lift_speed * r - 0.5 * self.gravity * r**2,
        )
        v = np.where(
            touching,
            (self.depth - 1.0) * d * w * np.sin(phase),
            self.lift_speed - self.gravity * r,
        )
        return u, v

    def openings(self, end: float) -> Array:
        """Times of lift-off."""
        return np.arange(self.half_contact, end, self.period)

    @property
    def energy(self) -> float:
        """Total energy, the weight's potential being zero at u = 0."""
        u = -self.depth * self.settlement
        return 0.5 * self.k_y * u**2 + self.mass * self.gravity * u

    @property
    def system(self) -> System:
        """The same hop for the event-driven solver."""
        spring = UnilateralSpring(np.ones(1), self.k_y)
        weight = Forcing(0.0, np.array([-self.mass * self.gravity]))
        return System(self.mass * np.ones((1, 1)), np.zeros((1, 1)), (spring,), (weight,))
