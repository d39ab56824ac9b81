"""Rigid and flexible bodies that rock on two unilateral springs or on a macro-element."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad

from .arcs import Array, Forcing
from .contact import System, UnilateralSpring
from .footing import Strip


@dataclass(frozen=True)
class TwoSpringBlock:
    """Rigid block on two unilateral springs at +-b, small rotations, base held horizontally.

    Unknowns (v, theta): upward displacement of the base's centre and rotation, theta > 0 lifting
    the side +x. The centre of mass stands at `height`; `inertia` is about it. A base
    acceleration a pushes the block with -m a at the height of the centre: moment + m a h (a
    positive to +x tilts the block backwards and lifts the side +x).
    """

    mass: float
    inertia: float
    height: float
    half_width: float
    k: float
    gravity: float = 9.81

    @property
    def rocking_inertia(self) -> float:
        """Moment of inertia about the base's centre."""
        return self.inertia + self.mass * self.height**2

    @property
    def weight(self) -> float:
        """m g."""
        return self.mass * self.gravity

    @property
    def settlement(self) -> float:
        """Static settlement."""
        return self.weight / (2.0 * self.k)

    def system(self, *pulses: tuple[float, float]) -> System:
        """Event-driven system; `pulses` are (start, base acceleration held from then on)."""
        b = self.half_width
        springs = tuple(UnilateralSpring(np.array([1.0, side * b]), self.k) for side in (-1.0, 1.0))
        lever = self.mass * self.height
        steps = pulses or ((0.0, 0.0),)
        forcings = tuple(Forcing(t, np.array([-self.weight, lever * a])) for t, a in steps)
        mass = np.diag([self.mass, self.rocking_inertia])
        return System(mass, np.zeros((2, 2)), springs, forcings)

    @property
    def rest(self) -> Array:
        """Static position (v, theta)."""
        return np.array([-self.settlement, 0.0])


@dataclass(frozen=True)
class FlexibleTower:
    """Mass on a flexible massless column, fixed to a rigid footing on two unilateral springs.

    Unknowns (q, v, theta): deflection of the column, lift and rotation of the footing. The mass
    moves by q - h theta horizontally (theta > 0 lifts the side +x, so the top goes to -x).
    """

    mass: float
    footing_mass: float
    footing_inertia: float
    height: float
    half_width: float
    column: float
    k: float
    gravity: float = 9.81

    def system(self, amplitude: float, pulsation: float) -> System:
        """Answer to half a sine of base acceleration, then rest."""
        m, h, b = self.mass, self.height, self.half_width
        arm = np.array([1.0, 0.0, -h])
        lift = np.array([0.0, 1.0, 0.0])
        mass = m * np.outer(arm, arm) + (m + self.footing_mass) * np.outer(lift, lift)
        mass += np.diag([0.0, 0.0, self.footing_inertia])
        stiffness = np.diag([self.column, 0.0, 0.0])
        springs = tuple(
            UnilateralSpring(np.array([0.0, 1.0, side * b]), self.k) for side in (-1.0, 1.0)
        )
        weight = -(m + self.footing_mass) * self.gravity * lift
        pulse = Forcing(0.0, weight, -m * amplitude * arm, pulsation, 0.0)
        after = Forcing(np.pi / pulsation, weight)
        return System(mass, stiffness, springs, (pulse, after))

    @property
    def rest(self) -> Array:
        """Static position."""
        settled = (self.mass + self.footing_mass) * self.gravity / (2.0 * self.k)
        return np.array([0.0, -settled, 0.0])


def macro_element_period(strip: Strip, inertia: float, theta: float) -> float:
    """Period of free rocking of `inertia` on a strip under constant N, from rest at `theta`.

    T = 4 int_0^theta d phi / sqrt(2 (W(theta) - W(phi)) / I), the end point's singularity being
    removed by phi = theta sin(a).
    """
    top = strip.energy(theta)

    def integrand(a: float) -> float:
        phi = theta * np.sin(a)
        gap = _energy_below(strip, theta, phi, a, top)
        return float(theta * np.cos(a) / np.sqrt(2.0 * gap / inertia))

    kink = np.arcsin(min(1.0, strip.uplift_rotation / theta))
    value = quad(integrand, 0.0, kink, epsabs=0.0, epsrel=1e-13)[0]
    if kink < np.pi / 2.0:
        value += quad(integrand, kink, np.pi / 2.0, epsabs=0.0, epsrel=1e-12, limit=200)[0]
    return float(4.0 * value)


def _energy_below(strip: Strip, theta: float, phi: float, a: float, top: float) -> float:
    """W(theta) - W(phi) without cancellation close to the turning point."""
    drop = theta * 2.0 * np.sin(0.5 * (np.pi / 2.0 - a)) ** 2  # theta - phi
    if drop > 1e-4 * theta:
        return top - strip.energy(phi)
    x, w = np.polynomial.legendre.leggauss(8)
    nodes = theta - 0.5 * drop * (1.0 + x)
    return float(0.5 * drop * (w @ strip.moment(nodes)))


@dataclass(frozen=True)
class HousnerBlock:
    """Slender rigid block rocking on a rigid base (Housner 1963).

    `radius` R is the distance from a corner to the centre of mass, `alpha` its angle to the
    vertical; p^2 = W R / I_corner, 3 g / 4 R for a homogeneous block.
    """

    radius: float
    alpha: float
    gravity: float = 9.81

    @property
    def p(self) -> float:
        """Frequency parameter."""
        return float(np.sqrt(3.0 * self.gravity / (4.0 * self.radius)))

    def period(self, theta: float) -> float:
        """Period of free rocking from rest at theta < alpha, slender (linearised) equation."""
        return 4.0 / self.p * float(np.arccosh(1.0 / (1.0 - theta / self.alpha)))

    @property
    def restitution(self) -> float:
        """Ratio of the angular velocities after and before an impact, from angular momentum."""
        return 1.0 - 1.5 * float(np.sin(self.alpha)) ** 2

    def amplitudes(self, theta: float, n: int) -> Array:
        """Amplitudes after 0..n impacts (slender equation), starting at theta."""
        k = 1.0 - (1.0 - theta / self.alpha) ** 2
        powers = self.restitution ** (2.0 * np.arange(n + 1))
        return np.asarray(self.alpha * (1.0 - np.sqrt(1.0 - powers * k)))


@dataclass(frozen=True)
class RigidTower:
    """Rigid tower in space on four unilateral springs at (+-b, +-c), small rotations.

    Unknowns (v, theta_x, theta_y): upward displacement of the base's centre and rotations. The
    base does not slide; `inertia` is about horizontal axes through the base's centre, the mass
    stands at `height`. Gaps are `v + theta_x y - theta_y x`.
    """

    mass: float
    inertia: float
    height: float
    b: float
    c: float
    k: float
    gravity: float = 9.81

    def push(self, ax: float, ay: float, az: float) -> Array:
        """Forces of a base acceleration."""
        lever = self.mass * self.height
        return np.array([-self.mass * az, lever * ay, -lever * ax])

    def system(self, pulsation: float, *accelerations: tuple[float, float, float]) -> System:
        """One vector of accelerations, times sin(pulsation t), for each half period; then rest."""
        weight = np.array([-self.mass * self.gravity, 0.0, 0.0])
        half = np.pi / pulsation
        forcings = [
            Forcing(i * half, weight, self.push(*a), pulsation, 0.0)
            for i, a in enumerate(accelerations)
        ]
        forcings.append(Forcing(len(accelerations) * half, weight))
        corners = [(x, y) for x in (-self.b, self.b) for y in (-self.c, self.c)]
        springs = tuple(UnilateralSpring(np.array([1.0, y, -x]), self.k) for x, y in corners)
        mass = np.diag([self.mass, self.inertia, self.inertia])
        return System(mass, np.zeros((3, 3)), springs, tuple(forcings))

    @property
    def rest(self) -> Array:
        """Static position."""
        return np.array([-self.mass * self.gravity / (4.0 * self.k), 0.0, 0.0])
