"""Triangles with linear values cut exactly into bands between levels, and into iso-lines."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray


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
