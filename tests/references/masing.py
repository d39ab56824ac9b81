"""Shear stress of a soil by Masing's rules, written from the rules: a stack of reversals.

G. Masing, Eigenspannungen und Verfestigung beim Messing, Proc. 2nd Int. Congr. Applied Mechanics
(1926) 332-335; with the two further rules of R. Pyke (1979): a branch that meets an earlier one, or
the first loading, goes on along that one.
"""

from collections.abc import Callable

import numpy as np


class Masing:
    """The stress on a path of shear strains; `first` is the first loading, odd and growing."""

    def __init__(self, first: Callable[[float], float]) -> None:
        self.first = first
        self.turns: list[tuple[float, float]] = []  # strain and stress of the reversals that count
        self.strain, self.stress, self.sense = 0.0, 0.0, 0.0

    def go(self, strain: float) -> float:
        """The stress at the end of a straight piece of the path."""
        sense = float(np.sign(strain - self.strain))
        if sense == 0.0:
            return self.stress
        if self.sense and sense != self.sense:
            self.turns.append((self.strain, self.stress))
        self._forget_closed_loops(strain, sense)
        self.strain, self.sense = strain, sense
        self.stress = self._at(strain)
        return self.stress

    def _at(self, strain: float) -> float:
        if not self.turns:
            return self.first(strain)
        turn, stress = self.turns[-1]
        return stress + 2.0 * self.first(0.5 * (strain - turn))

    def _forget_closed_loops(self, strain: float, sense: float) -> None:
        while self.turns:
            if len(self.turns) == 1:  # the branch meets the first loading at the opposite point
                end = -self.turns[0][0]
                if sense * (strain - end) <= 0.0:
                    return
                self.turns.clear()
            else:
                end = self.turns[-2][0]
                if sense * (strain - end) <= 0.0:
                    return
                del self.turns[-2:]


def polygon(modulus: float, strains: np.ndarray, ratios: np.ndarray) -> Callable[[float], float]:
    """First loading through the points of a curve of G/Gmax; the last stress stays."""
    x = np.concatenate([[0.0], strains])
    y = modulus * x * np.concatenate([[1.0], ratios])
    return lambda g: float(np.sign(g) * np.interp(abs(g), x, y))


def hyperbola_damping(x: float) -> float:
    """Damping ratio of Masing's loops of 1 / (1 + x) at the amplitude x of its reference strain.

    K. Ishihara, Soil Behaviour in Earthquake Geotechnics (1996), section 3.2: the loop's area over
    4 pi times the energy of the secant modulus.
    """
    return 4.0 / np.pi * (1.0 + 1.0 / x) * (1.0 - np.log1p(x) / x) - 2.0 / np.pi
