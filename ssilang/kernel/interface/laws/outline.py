"""The base of a macro-element as a plane that opens: where it presses, how far its edges move.

A point at s opens by `v + theta s` in the plane, by `v + theta_1 s_2 - theta_2 s_1` in space.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.interface.laws.columns import LawCode, Parameter

FLAT = 1e-6
"""Slope across a rectangle, over that along it, below which it opens as a strip does."""


@dataclass(frozen=True, eq=False)
class Outline:
    """Base of a macro-element.

    Attributes
    ----------
    code : LawCode
    halves : array (d - 1,)
        Half of its widths, along t1 and t2; its radius, of a disc.
    area : float
        In the plane that of the footing's whole length (1 m without LONG); 1 of two springs.
    stiffness : float
        Per unit area (Pa/m); of each of two springs (N/m).
    """

    code: LawCode
    halves: FloatArray
    area: float
    stiffness: float

    def levers(self) -> FloatArray:
        """Levers (d - 1, 2) of the edges about the axes, the lowest and the highest."""
        across = self.halves if len(self.halves) == 1 else self.halves[::-1]
        found: FloatArray = across[:, None] * np.array([-1.0, 1.0])
        return found

    def reach(self, w: FloatArray) -> FloatArray:
        """What turning adds (...) to the opening of the edge that opens most, from w (..., d)."""
        turns = np.abs(w[..., :-1])
        if self.code == LawCode.DISC:
            found: FloatArray = self.halves[0] * np.linalg.norm(turns, axis=-1)
        else:
            found = turns @ self.levers()[:, 1]
        return found

    def opening(self, w: FloatArray) -> FloatArray:
        """Largest opening (...), 0 where nothing is open."""
        return np.maximum(w[..., -1] + self.reach(w), 0.0)

    def pressure(self, w: FloatArray) -> FloatArray:
        """Largest pressure (...) of the elastic bed; force of a spring."""
        return self.stiffness * np.maximum(self.reach(w) - w[..., -1], 0.0)

    def share(self, w: FloatArray) -> FloatArray:
        """Share (...) of the area that presses on the elastic bed."""
        reach, v = self.reach(w), w[..., -1]
        turned = np.where(reach > 0.0, reach, 1.0)
        found: FloatArray
        if self.code == LawCode.DISC:
            x = np.clip(v / turned, -1.0, 1.0)
            found = (np.arccos(x) - x * np.sqrt(1.0 - x * x)) / np.pi
        elif self.code == LawCode.SPRINGS:
            found = 0.5 * ((v < reach).astype(float) + (v < -reach))
        else:
            found = _of_rectangle(np.abs(w[..., :-1]) * self.levers()[:, 1], v)
        return np.where(v + reach <= 0.0, 1.0, np.where(v - reach >= 0.0, 0.0, found))


def _of_rectangle(slopes: FloatArray, v: FloatArray) -> FloatArray:
    """Share (...) of the square [-1, 1]^2 where v + a x + b y < 0, slopes (..., 1 or 2) a, b >= 0.

    Second differences of half the square of what is positive; of what is positive for a strip.
    """
    large, small = slopes.max(axis=-1), slopes.min(axis=-1)
    if slopes.shape[-1] == 1:
        small = np.zeros_like(large)
    a, flat = np.where(large > 0.0, large, 1.0), small <= FLAT * large
    b = np.where(flat, a, small)
    ends = ((a + b - v, 1.0), (a - b - v, -1.0), (b - a - v, -1.0), (-a - b - v, 1.0))
    cut = sum(sign * np.maximum(x, 0.0) ** 2 for x, sign in ends) / (8.0 * a * b)
    found: FloatArray = np.clip(np.where(flat, (a - v) / (2.0 * a), cut), 0.0, 1.0)
    return found


def outline_of(code: LawCode, p: FloatArray, dimension: int) -> Outline:
    """The outline of a macro-element from its parameters (N_PARAMETERS,)."""
    width, length = p[Parameter.LARG], p[Parameter.LONG]
    if code == LawCode.DISC:
        radius = p[Parameter.RAYO]
        halves, area = np.full(dimension - 1, radius), float(np.pi * radius**2)
    elif code == LawCode.SPRINGS:
        return Outline(code, np.array([0.5 * width]), 1.0, float(0.5 * p[Parameter.KN]))
    else:
        halves = 0.5 * np.array([width, length][: dimension - 1])
        area = float(width * (length if length > 0.0 else 1.0))
    return Outline(code, halves, area, float(p[Parameter.KN] / area))
