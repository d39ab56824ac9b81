"""Beams: infinite weightless beam pressed on a tensionless Winkler soil, cantilever, bar modes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import brentq

from .arcs import Array


@dataclass(frozen=True)
class TensionlessBeam:
    """Infinite weightless beam under a point force P (downwards) on springs that only push.

    `k` is the soil's stiffness per unit length (N/m2). By symmetry half the beam is enough:
    zero slope and shear P/2 at the force, no moment and no shear at the end of contact, beyond
    which the beam is straight. The length of contact does not depend on P.
    """

    force: float
    bending: float
    k: float

    @property
    def wave_number(self) -> float:
        """lambda = (k / 4 E I)^(1/4)."""
        return float((self.k / (4.0 * self.bending)) ** 0.25)

    def _basis(self, x: float, order: int) -> Array:
        """Derivatives of e^{+-z} cos z, e^{+-z} sin z, z = lambda x, shape (4,)."""
        lam = self.wave_number
        rows = []
        for sign in (-1.0, 1.0):
            root = lam * (sign + 1j)
            value = root**order * np.exp(root * x)
            rows += [value.real, value.imag]
        return np.array(rows)

    def _coefficients(self, half: float) -> Array:
        """Combination that meets the four conditions for a given half length."""
        matrix = np.array(
            [self._basis(0.0, 1), self._basis(0.0, 3), self._basis(half, 2), self._basis(half, 3)]
        )
        # settlement w positive downwards: E I w'''(0+) = P/2
        return np.linalg.solve(matrix, np.array([0.0, self.force / (2 * self.bending), 0.0, 0.0]))

    @cached_property
    def half_length(self) -> float:
        """Half the length in contact, where the settlement vanishes: pi/(2 lambda)."""
        lam = self.wave_number

        def edge(z: float) -> float:
            return float(self._basis(z / lam, 0) @ self._coefficients(z / lam))

        return float(brentq(edge, 0.5, 2.5, xtol=1e-14)) / lam

    def settlement(self, x: Array) -> Array:
        """Settlement (downwards) at the distance x from the force; negative where it lifts."""
        x = np.abs(np.atleast_1d(np.asarray(x, float)))
        coefficients, half = self._coefficients(self.half_length), self.half_length
        slope = float(self._basis(half, 1) @ coefficients)
        inside = np.array([self._basis(min(z, half), 0) @ coefficients for z in x])
        return np.where(x <= half, inside, slope * (x - half))

    def reaction(self, n: int = 200) -> float:
        """Resultant of the soil's reaction (Gauss-Legendre, n points): must be P."""
        z, w = np.polynomial.legendre.leggauss(n)
        x = 0.5 * self.half_length * (z + 1.0)
        return float(self.half_length * self.k * (w @ self.settlement(x)))


def cantilever_tip(force: float, length: float, bending: float, shear: float = np.inf) -> float:
    """Deflection under a force at the tip; `shear` = G A' adds the shear's part."""
    return force * length**3 / (3.0 * bending) + force * length / shear


def cantilever_frequencies(length: float, bending: float, line_mass: float, n: int) -> Array:
    """First n bending frequencies (Hz) of a clamped-free beam."""

    def characteristic(z: float) -> float:
        return float(np.cos(z) + 1.0 / np.cosh(z))

    centres = (np.arange(n) + 0.5) * np.pi
    roots = np.array([brentq(characteristic, z - 0.6, z + 0.6, xtol=1e-14) for z in centres])
    scale = float(np.sqrt(bending / line_mass)) / (2.0 * np.pi * length**2)
    return np.asarray(roots**2 * scale)


def bar_frequencies(length: float, young: float, density: float, n: int) -> Array:
    """First n axial frequencies (Hz) of a bar fixed at one end."""
    return np.asarray((2.0 * np.arange(n) + 1.0) / (4.0 * length) * np.sqrt(young / density))
