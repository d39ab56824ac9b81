"""Rigid footings on a no-tension Winkler soil: moment against rotation, onset of uplift.

`k0` is the foundation modulus (Pa/m), N > 0 the compressive resultant, theta > 0 the rotation;
N constant means that the footing finds its settlement by itself.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from .arcs import Array


@dataclass(frozen=True)
class Strip:
    """Rectangle of width B (in the plane of rotation) and length L."""

    width: float
    length: float
    k0: float
    normal: float

    @property
    def stiffness(self) -> float:
        """Rotational stiffness in full contact."""
        return self.k0 * self.length * self.width**3 / 12.0

    @property
    def kern(self) -> float:
        """Eccentricity at which an edge lifts off."""
        return self.width / 6.0

    @property
    def uplift_moment(self) -> float:
        """Moment at which an edge lifts off."""
        return self.normal * self.kern

    @property
    def uplift_rotation(self) -> float:
        """Rotation at which an edge lifts off."""
        return 2.0 * self.normal / (self.k0 * self.length * self.width**2)

    def contact(self, theta: Array) -> Array:
        """Width in contact."""
        ratio = np.maximum(np.asarray(theta, float) / self.uplift_rotation, 1.0)
        return self.width / np.sqrt(ratio)

    def moment(self, theta: Array) -> Array:
        """Moment about the centre."""
        theta = np.asarray(theta, float)
        lifted = self.normal * (self.width / 2.0 - self.contact(theta) / 3.0)
        return np.where(theta <= self.uplift_rotation, self.stiffness * theta, lifted)

    def tangent(self, theta: Array) -> Array:
        """dM/dtheta."""
        theta = np.asarray(theta, float)
        safe = np.maximum(theta, self.uplift_rotation)
        lifted = self.normal * self.contact(theta) / (6.0 * safe)
        return np.where(theta <= self.uplift_rotation, self.stiffness, lifted)

    def lift(self, theta: Array) -> Array:
        """Upward displacement of the centre, counted from the unstressed soil."""
        theta = np.asarray(theta, float)
        settled = -self.normal / (self.k0 * self.length * self.width)
        return np.where(
            theta <= self.uplift_rotation,
            settled,
            theta * (self.width / 2.0 - self.contact(theta)),
        )

    def energy(self, theta: float) -> float:
        """Work of the moment from 0 to theta (nothing is dissipated)."""
        start, ratio = self.uplift_rotation, theta / self.uplift_rotation
        if ratio <= 1.0:
            return 0.5 * self.stiffness * theta**2
        # M/M_u = 3 - 2 ratio^-1/2
        path = 3.0 * (ratio - 1.0) - 4.0 * (np.sqrt(ratio) - 1.0)
        return float(self.uplift_moment * start * (0.5 + path))


@dataclass(frozen=True)
class Disc:
    """Circular footing of radius r."""

    radius: float
    k0: float
    normal: float

    @property
    def stiffness(self) -> float:
        """Rotational stiffness in full contact."""
        return self.k0 * np.pi * self.radius**4 / 4.0

    @property
    def kern(self) -> float:
        """Eccentricity at which the edge lifts off."""
        return self.radius / 4.0

    @property
    def uplift_moment(self) -> float:
        """Moment at which the edge lifts off."""
        return self.normal * self.kern

    @property
    def uplift_rotation(self) -> float:
        """Rotation at which the edge lifts off."""
        return self.normal / (np.pi * self.k0 * self.radius**3)

    def half_angle(self, theta: float) -> float:
        """Half angle of the segment in contact (pi: full contact)."""
        if theta <= self.uplift_rotation:
            return float(np.pi)
        scale = self.k0 * theta * self.radius**3

        def excess(phi: float) -> float:
            lever = np.cos(phi) * (phi - np.sin(phi) * np.cos(phi))
            return float(2.0 / 3.0 * np.sin(phi) ** 3 - lever - self.normal / scale)

        return float(brentq(excess, 1e-12, np.pi, xtol=1e-15, rtol=1e-14))

    def moment(self, theta: float) -> float:
        """Moment about the centre."""
        if theta <= self.uplift_rotation:
            return self.stiffness * theta
        phi = self.half_angle(theta)
        s, c = np.sin(phi), np.cos(phi)
        inertia = (phi - s * c + 2.0 * s**3 * c) / 4.0
        return float(self.k0 * theta * self.radius**4 * (inertia - 2.0 / 3.0 * c * s**3))


def onset_acceleration(kern: float, height: float, gravity: float = 9.81) -> float:
    """Slowly applied base acceleration at which a rigid block of centre height `height` lifts."""
    return gravity * kern / height


def onset_step_acceleration(kern: float, height: float, gravity: float = 9.81) -> float:
    """Suddenly applied and held base acceleration that just reaches lift-off.

    A rigid block on a full-contact Winkler soil answers a step with twice the static rotation.
    """
    return 0.5 * onset_acceleration(kern, height, gravity)


def onset_ramp_time(rise: float, frequency: float) -> float:
    """Lift-off under an acceleration that grows linearly, `onset_acceleration` at `rise` (s).

    The block's rotation over that of onset is `(t - sin(w t)/w)/rise`, w = `frequency` (rad/s).
    """

    def excess(t: float) -> float:
        return float(t - np.sin(frequency * t) / frequency - rise)

    return float(brentq(excess, rise - 1.0 / frequency, rise + 1.0 / frequency, xtol=1e-15))


@dataclass(frozen=True)
class Rectangle:
    """Rigid rectangle B x L on a no-tension bed of modulus k0 under N and two moments.

    Opening `v + theta_x y - theta_y x`; the bed pushes where it is negative.
    """

    width: float
    length: float
    k0: float
    normal: float

    def contact(self, u: Array) -> Array:
        """Corners (n, 2) of the part in contact: the rectangle cut by the line of no opening."""
        b, c = self.width / 2.0, self.length / 2.0
        corners = [(-b, -c), (b, -c), (b, c), (-b, c)]
        opening = [u[0] + u[1] * y - u[2] * x for x, y in corners]
        kept: list[tuple[float, float]] = []
        for i in range(4):
            (p, q), (g, h) = (corners[i], corners[i - 3]), (opening[i], opening[i - 3])
            if g < 0.0:
                kept.append(p)
            if (g < 0.0) != (h < 0.0):
                s = g / (g - h)
                kept.append((p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])))
        return np.array(kept).reshape(-1, 2)

    def forces(self, u: Array) -> tuple[Array, Array]:
        """Forces (N, M_x, M_y) that hold the rectangle at u = (v, theta_x, theta_y); tangent.

        Integrals over triangles from the first corner of the contact, by the rule of the
        mid-sides, which is exact for the quadratic integrand.
        """
        corners, K = self.contact(np.asarray(u, float)), np.zeros((3, 3))
        for p, q in pairwise(corners[1:]):
            one, two = p - corners[0], q - corners[0]
            area = 0.5 * abs(one[0] * two[1] - one[1] * two[0])
            for x, y in ((corners[0] + p) / 2, (p + q) / 2, (q + corners[0]) / 2):
                shape = np.array([1.0, y, -x])
                K += self.k0 * area / 3.0 * np.outer(shape, shape)
        return K @ u, K

    def position(self, mx: float, my: float) -> Array:
        """(v, theta_x, theta_y) under -N and the moments, by Newton's method."""
        wanted = np.array([-self.normal, mx, my])
        u = np.array([-self.normal / (self.k0 * self.width * self.length), 0.0, 0.0])
        for part in np.linspace(0.1, 1.0, 10):
            target = np.array([wanted[0], part * mx, part * my])
            for _ in range(60):
                found, K = self.forces(u)
                step = np.linalg.solve(K, target - found)
                u = u + step
                if np.abs(step).max() <= 1e-15 * np.abs(u).max():
                    break
        return u
