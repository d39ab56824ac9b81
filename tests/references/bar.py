"""Elastic bar that falls upright on a rigid wall: exact one-dimensional wave solution.

The case of Doyen, Ern and Piperno (SIAM J. Sci. Comput. 33, 2011): a bar of length L hits the
wall at the velocity V, under gravity or not, its other end being free. With `s` the time since
the first touch, the displacement from the position of first touch is

    u(x, s) = -V s - g s^2/2 + r(s - x/c) + r(s - T + x/c),      T = 2 L/c,

where r is the wave that leaves the wall. Contact fixes the foot, r'(s) = V + g s - r'(s - T);
flight frees it, r'(s) = r'(s - T). So r' is piecewise linear and r piecewise quadratic, and the
instants of release and of impact are roots of polynomials.
"""

from dataclasses import dataclass, field

import numpy as np

from .arcs import Array

TINY = 1e-12
"""Times closer than this are the same instant (the cases last seconds, times are exact to 1e-15).
"""


@dataclass(frozen=True)
class Bar:
    """Data of the bar; the defaults are the article's bounces under gravity."""

    young: float = 900.0
    density: float = 1.0
    length: float = 10.0
    height: float = 5.0
    gravity: float = 10.0
    initial_velocity: float = 0.0

    @property
    def celerity(self) -> float:
        """Speed of the waves, sqrt(E/rho)."""
        return float(np.sqrt(self.young / self.density))

    @property
    def round_trip(self) -> float:
        """T = 2 L/c."""
        return 2.0 * self.length / self.celerity

    @property
    def fall(self) -> float:
        """Time of the first touch."""
        v, g = -self.initial_velocity, self.gravity
        if g == 0.0:
            return self.height / v
        return float((np.sqrt(v**2 + 2.0 * g * self.height) - v) / g)

    @property
    def impact_velocity(self) -> float:
        """Downward velocity at the first touch, positive."""
        return -self.initial_velocity + self.gravity * self.fall

    @property
    def mean_pressure(self) -> float:
        """Pressure of the first instant of contact, V sqrt(E rho)."""
        return self.impact_velocity * float(np.sqrt(self.young * self.density))


@dataclass
class Wave:
    """r on pieces: from each knot, r = value + slope d + curvature d^2/2; zero before s = 0."""

    knots: list[float] = field(default_factory=list)
    values: list[float] = field(default_factory=list)
    slopes: list[float] = field(default_factory=list)
    curvatures: list[float] = field(default_factory=list)

    def __call__(self, s: Array, derivative: int = 0) -> Array:
        """r (or its derivative 1) at s, from the right of the knots."""
        s = np.asarray(s, float)
        knots = np.asarray(self.knots)
        i = np.clip(np.searchsorted(knots, s, side="right") - 1, 0, None)
        d = s - knots[i]
        a, b, c = (np.asarray(x)[i] for x in (self.values, self.slopes, self.curvatures))
        inside = a + b * d + 0.5 * c * d**2 if derivative == 0 else b + c * d
        return np.where(s < 0.0, 0.0, inside)

    def piece(self, s: float) -> tuple[float, float, float]:
        """Value, slope, curvature just right of s."""
        if s < 0.0:
            return 0.0, 0.0, 0.0
        i = int(np.searchsorted(self.knots, s + TINY, side="right")) - 1
        if i < 0:
            return 0.0, 0.0, 0.0
        d = s - self.knots[i]
        c = self.curvatures[i]
        return self.values[i] + self.slopes[i] * d + 0.5 * c * d**2, self.slopes[i] + c * d, c

    def append(self, s: float, value: float, slope: float, curvature: float) -> None:
        """Begin a new piece at s."""
        self.knots.append(s)
        self.values.append(value)
        self.slopes.append(slope)
        self.curvatures.append(curvature)


@dataclass
class BarMotion:
    """Exact motion of the bar: wave, impacts and releases in absolute time."""

    bar: Bar
    wave: Wave
    impacts: list[float]
    releases: list[float]

    def displacement(self, x: Array | float, t: Array | float) -> Array:
        """Displacement from the initial position; x (distance from the foot) and t broadcast."""
        b = self.bar
        x, s = np.broadcast_arrays(np.asarray(x, float), np.asarray(t, float) - b.fall)
        rigid = -b.height - b.impact_velocity * s - 0.5 * b.gravity * s**2
        c, w = b.celerity, self.wave
        return rigid + w(s - x / c) + w(s - b.round_trip + x / c)

    def velocity(self, x: Array | float, t: Array | float) -> Array:
        """Velocity."""
        b = self.bar
        x, s = np.broadcast_arrays(np.asarray(x, float), np.asarray(t, float) - b.fall)
        c, w = b.celerity, self.wave
        waves = w(s - x / c, 1) + w(s - b.round_trip + x / c, 1)
        return -b.impact_velocity - b.gravity * s + waves

    def stress(self, x: Array | float, t: Array | float) -> Array:
        """Axial stress, positive in tension."""
        b = self.bar
        x, s = np.broadcast_arrays(np.asarray(x, float), np.asarray(t, float) - b.fall)
        c, w = b.celerity, self.wave
        return b.young / c * (w(s - b.round_trip + x / c, 1) - w(s - x / c, 1))

    def pressure(self, t: Array | float) -> Array:
        """Pressure on the wall, positive."""
        return -self.stress(0.0, t)

    def energy(self, t: float, n: int = 4000) -> float:
        """Kinetic, elastic and gravity energy per unit area (mid-point rule, n cells)."""
        b = self.bar
        x = (np.arange(n) + 0.5) * b.length / n
        kinetic = 0.5 * b.density * self.velocity(x, t) ** 2
        elastic = 0.5 * self.stress(x, t) ** 2 / b.young
        fall = b.density * b.gravity * self.displacement(x, t)
        return float(np.sum(kinetic + elastic + fall) * b.length / n)


def solve_bar(bar: Bar, end: float) -> BarMotion:
    """Follow the bar up to the time `end`, piece by piece of the wave."""
    v, g, period = bar.impact_velocity, bar.gravity, bar.round_trip
    wave = Wave()
    motion = BarMotion(bar, wave, [bar.fall], [])
    s, r, touching = 0.0, 0.0, True
    while s + bar.fall < end:
        old, old_slope, old_curvature = wave.piece(s - period)
        gap, thrust = r + old - v * s - 0.5 * g * s**2, v + g * s - 2.0 * old_slope
        if _switches(touching, gap, thrust, g - 2.0 * old_curvature, v):
            (motion.releases if touching else motion.impacts).append(s + bar.fall)
            touching = not touching
        sign = -1.0 if touching else 1.0
        slope = (v + g * s if touching else 0.0) + sign * old_slope
        curvature = (g if touching else 0.0) + sign * old_curvature
        wave.append(s, r, slope, curvature)
        step = min(k + period for k in wave.knots if k + period > s + TINY) - s
        if touching:
            # pressure times c/E: r'(s) - r'(s - T), linear on the piece
            roots = _roots(0.0, curvature - old_curvature, slope - old_slope)
        else:
            # gap: r(s) + r(s - T) - V s - g s^2/2, quadratic on the piece
            speed = slope + old_slope - v - g * s
            roots = _roots(0.5 * (curvature + old_curvature - g), speed, gap)
        step = min([x for x in roots if TINY < x < step - TINY], default=step)
        r += slope * step + 0.5 * curvature * step**2
        s += step
    return motion


def _switches(touching: bool, gap: float, thrust: float, trend: float, speed: float) -> bool:
    """Whether the state changes at the start of a piece.

    `thrust` is c/E times the pressure that contact would have, `trend` its slope. A touching foot
    leaves when it is about to be pulled; a free one touches when its gap is closed and the wall
    would push it.
    """
    if touching:
        return thrust < -TINY * speed or (thrust < TINY * speed and trend < 0.0)
    return gap < TINY * speed and thrust > TINY * speed


def _roots(a: float, b: float, c: float) -> list[float]:
    """Real roots of `a x^2 + b x + c`, the stable way."""
    if a == 0.0:
        return [] if b == 0.0 else [-c / b]
    square = b * b - 4.0 * a * c
    if square < 0.0:
        return []
    q = -0.5 * (b + np.copysign(np.sqrt(square), b))
    return [float(q / a), float(c / q)] if q != 0.0 else [0.0]
