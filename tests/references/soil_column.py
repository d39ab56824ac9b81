"""A column of soil sheared by its base, by explicit steps: masses and bundles of springs."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Column:
    """Layers between masses, from the base up; unit area, displacements relative to the base.

    Attributes
    ----------
    heights, densities, moduli : array (n,)
    strains, shares : array (n, k)
        Each layer is a bundle of elastic, perfectly plastic springs: strain at which a spring
        slips, and its share of the modulus.
    mass_factor, stiffness_factor : float
        Rayleigh's damping, on the elastic stiffness.
    """

    heights: np.ndarray
    densities: np.ndarray
    moduli: np.ndarray
    strains: np.ndarray
    shares: np.ndarray
    mass_factor: float = 0.0
    stiffness_factor: float = 0.0

    def mass(self) -> np.ndarray:
        """Consistent masses (n, n), linear between the ends of layers."""
        n = len(self.heights)
        M = np.zeros((n + 1, n + 1))
        for i, m in enumerate(self.heights * self.densities):
            M[i : i + 2, i : i + 2] += m / 6 * np.array([[2.0, 1.0], [1.0, 2.0]])
        return M[1:, 1:]

    def shaken(
        self, acceleration: np.ndarray, step: float
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Displacements, shear strains and stresses (steps + 1, n) under a base acceleration.

        Central differences; damping at the speed half a step back.
        """
        n, M = len(self.heights), self.mass()
        inverse, pushed = np.linalg.inv(M), self._row_sums(M)
        rise = self.moduli * self.stiffness_factor
        u, v, springs = np.zeros(n), np.zeros(n), np.zeros(self.shares.shape)
        limits = self.moduli[:, None] * self.shares * self.strains
        stiff = self.moduli[:, None] * self.shares
        strain, found = np.zeros(n), []
        for a in acceleration:
            stress = springs.sum(axis=1)
            found.append((u.copy(), strain, stress))
            rate = np.diff(v, prepend=0.0) / self.heights
            total = stress + rise * rate
            force = np.append(total[1:], 0.0) - total - pushed * a - self.mass_factor * (M @ v)
            v = v + step * (inverse @ force)
            u = u + step * v
            after = np.diff(u, prepend=0.0) / self.heights
            springs = np.clip(springs + stiff * (after - strain)[:, None], -limits, limits)
            strain = after
        columns = [np.array(c) for c in zip(*found, strict=True)]
        return columns[0], columns[1], columns[2]

    def _row_sums(self, M: np.ndarray) -> np.ndarray:
        """Inertia (n,) of a unit acceleration of all, that of the base included."""
        sums = M.sum(axis=1)
        sums[0] += self.heights[0] * self.densities[0] / 6
        return sums


def bundle(strains: np.ndarray, ratios: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Springs of a polygon of G/Gmax: where they slip, their shares of the modulus."""
    x, y = np.append(0.0, strains), np.append(0.0, strains * ratios)
    slopes = np.append(np.diff(y) / np.diff(x), 0.0)
    return np.asarray(strains, float), slopes[:-1] - slopes[1:]
