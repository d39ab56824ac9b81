"""Iso-values: their levels and colours."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray

_WANTED = 14


@dataclass(frozen=True, eq=False)
class Levels:
    """Bounds of the colour bands (n + 1,), and what colours values."""

    bounds: FloatArray
    colours: Any  # matplotlib ListedColormap
    norm: Any  # matplotlib BoundaryNorm

    def rgba(self, values: FloatArray) -> FloatArray:
        """Colours (n, 4) of values (n,)."""
        made: FloatArray = self.colours(self.norm(values))
        return made


def choose_levels(
    values: FloatArray, count: int | None = None, given: FloatArray | None = None
) -> Levels:
    """Levels for the values of a picture: round numbers, `count` equal bands, or those given.

    Values that lie on both sides of zero are shown from blue (negative) to red (positive) with
    zero in the middle, others, and given levels, from dark to bright.
    """
    from matplotlib import colormaps
    from matplotlib.colors import BoundaryNorm, ListedColormap

    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    bounds = _bounds(low, high, count, given)
    middles = (bounds[1:] + bounds[:-1]) / 2
    both = bounds[0] < 0 < bounds[-1] and 0.15 < -bounds[0] / bounds[-1] < 1 / 0.15
    if given is not None and len(given) and len(middles) > 1:
        # levels chosen by hand may be far from even: one step of colour a band
        shades = colormaps["viridis"](np.linspace(0.04, 0.98, len(middles)))
    elif both:
        reach = np.abs(bounds).max()
        shades = colormaps["RdBu_r"](0.5 + 0.46 * middles / reach)
    else:
        place = (middles - middles[0]) / max(np.ptp(middles), 1e-300)
        shades = colormaps["viridis"](0.04 + 0.94 * place)
    return Levels(bounds, ListedColormap(shades), BoundaryNorm(bounds, len(middles), clip=True))


def _bounds(low: float, high: float, count: int | None, given: FloatArray | None) -> FloatArray:
    from matplotlib.ticker import MaxNLocator

    if given is not None and len(given):
        inner = np.unique(given)
        ends = [low] if low < inner[0] else [], [high] if high > inner[-1] else []
        bounds = np.concatenate([ends[0], inner, ends[1]])
        if len(bounds) > 1:
            return np.asarray(bounds, dtype=float)
    # differences below round-off are no variation
    if high - low <= 1e-12 * max(abs(low), abs(high), 1e-300):
        width = max(abs(low) * 1e-3, 1e-12)
        low, high = low - width, high + width
        return np.array([low, high])
    if count:
        return np.linspace(low, high, count + 1)
    ticks = np.asarray(MaxNLocator(_WANTED, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high))
    # the ends are the round numbers next to the extremes
    first = max(int(np.searchsorted(ticks, low, side="right")) - 1, 0)
    last = min(int(np.searchsorted(ticks, high, side="left")), len(ticks) - 1)
    return np.asarray(ticks[first : last + 1], dtype=float)
