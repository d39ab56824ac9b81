"""Triangles with linear values cut exactly into bands between levels, and into iso-lines.

Levels of iso-values, and their colours.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray

_WANTED = 14


@dataclass(frozen=True, eq=False)
class Levels:
    """Bounds of the colour bands (n + 1,), and what colours values."""

    bounds: FloatArray
    colours: Any  # matplotlib ListedColormap
    norm: Any  # matplotlib BoundaryNorm

    def rgba(self, values: FloatArray) -> FloatArray:
        """Colours (n, 4) of values (n,)."""
        return self.colours(self.norm(values))


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


def cut_bands(
    points: FloatArray, values: FloatArray, bounds: FloatArray
) -> tuple[FloatArray, IntArray, IntArray]:
    """The part of each triangle in each band.

    Parameters
    ----------
    points : array (n, 3, d)
    values : array (n, 3)
    bounds : array (m + 1,)
        Increasing; values outside belong to the first or last band.

    Returns
    -------
    polygons : array (p, 5, d)
        Corners in order around; some may coincide.
    owner, band : arrays (p,)
        Triangle and band of each polygon.
    """
    points, values = _sorted(points, values)
    inner = bounds[1:-1]
    first = np.searchsorted(inner, values[:, 0], side="right")
    last = np.maximum(np.searchsorted(inner, values[:, 2], side="left"), first)
    owner, band = _spread(first, last - first + 1)
    ends = np.concatenate([[-np.inf], inner, [np.inf]])
    corners, heights = points[owner], values[owner]
    low, middle, high = heights.T
    lower = np.clip(ends[band], low, high)
    upper = np.clip(ends[band + 1], low, high)
    bend = np.clip(middle, lower, upper)
    around = [
        _long(corners, heights, lower, 0.0),
        _long(corners, heights, upper, 1.0),
        _short(corners, heights, upper, 1.0),
        np.where((bend == middle)[:, None], corners[:, 1], _short(corners, heights, bend)),
        _short(corners, heights, lower),
    ]
    return np.stack(around, axis=1), owner, band


def cut_lines(
    points: FloatArray, values: FloatArray, bounds: FloatArray
) -> tuple[FloatArray, IntArray, IntArray]:
    """Segments of the iso-lines: array (p, 2, d), triangle and level of each."""
    points, values = _sorted(points, values)
    first = np.searchsorted(bounds, values[:, 0], side="right")
    owner, level = _spread(first, np.searchsorted(bounds, values[:, 2], side="left") - first)
    at = bounds[level]
    corners, heights = points[owner], values[owner]
    ends = [_long(corners, heights, at), _short(corners, heights, at)]
    return np.stack(ends, axis=1), owner, level


def _sorted(points: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    order = np.argsort(values, axis=1)
    return (
        np.take_along_axis(points, order[:, :, None], axis=1),
        np.take_along_axis(values, order, axis=1),
    )


def _spread(first: IntArray, count: IntArray) -> tuple[IntArray, IntArray]:
    """Rows repeated `count` times, with first, first + 1 ... beside them."""
    count = np.maximum(count, 0)
    owner = np.repeat(np.arange(len(first)), count)
    start = np.repeat(np.cumsum(count) - count, count)
    return owner, first[owner] + np.arange(len(owner)) - start


def _long(points: FloatArray, values: FloatArray, at: FloatArray, level: float = 0.0) -> FloatArray:
    """Point of the side from the lowest to the highest corner where the value is `at`.

    `level` is the place (0 to 1) on a side of equal values: a triangle of one value is one band.
    """
    return _between(points, values, 0, 2, at, level)


def _short(
    points: FloatArray, values: FloatArray, at: FloatArray, level: float = 0.0
) -> FloatArray:
    """Point of the path over the middle corner where the value is `at`; `level` as in `_long`."""
    upper = (at > values[:, 1])[:, None]
    high = _between(points, values, 1, 2, at)
    return np.where(upper, high, _between(points, values, 0, 1, at, level))


def _between(
    points: FloatArray, values: FloatArray, i: int, j: int, at: FloatArray, level: float = 0.0
) -> FloatArray:
    span = values[:, j] - values[:, i]
    share = np.where(span > 0, (at - values[:, i]) / np.where(span > 0, span, 1.0), level)
    share = np.clip(share, 0.0, 1.0)[:, None]
    return np.asarray((1 - share) * points[:, i] + share * points[:, j])
