"""Filters and integration of records: Butterworth's, polynomials of the velocity, baselines.

Boore & Akkar, Bull. Seism. Soc. Am. 93 (2003) and Boore, 95 (2005): a filter that runs forth and
back needs zeros before and after the record, 1.5 n / f of its low corner.
"""

import math
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.scientific import signal

_PAD = 1.5
"""Zeros on either side of a record, in periods of its lowest corner times the order."""
_MOST = 2_000_000
"""Zeros at most on either side."""


def butterworth(
    values: FloatArray,
    step: float,
    order: int,
    low: float | None,
    high: float | None,
    *,
    causal: bool,
) -> FloatArray:
    """A record (n,) without what is slower than `low` and faster than `high` (Hz).

    Each corner is a Butterworth filter of its own, in sections of the second order, made by the
    bilinear transformation: `|H|^2 = 1 / (1 + (tan(pi f dt) / tan(pi fc dt))^(2 n))` of a low-pass.
    Causal: it passes once. Else it runs forth and back, with zeros on both sides: no phase, and
    `|H|^2` in place of `|H|`.

    Raises
    ------
    FieldError
        If the order is not from 1 to 12, or corners are not between 0 and half the sampling
        frequency in their order.
    """
    nyquist = 0.5 / step
    corners = [f for f in (low, high) if f is not None]
    if not 1 <= order <= 12:
        raise FieldError("kernel.records.filter-order", order=order)
    for f in corners:
        if not 0.0 < f < nyquist:
            raise FieldError("kernel.records.filter-corner", corner=f, nyquist=nyquist)
    if corners != sorted(set(corners)):
        raise FieldError("kernel.records.filter-corners-cross", low=low, high=high)
    size = 0 if causal else min(math.ceil(_PAD * order / min(corners) / step), _MOST)
    found = np.concatenate([np.zeros(size), values, np.zeros(size)])
    kinds: tuple[tuple[Literal["highpass", "lowpass"], float | None], ...]
    kinds = (("highpass", low), ("lowpass", high))
    for kind, corner in kinds:
        if corner is None:
            continue
        sections = signal.butter(order, corner, kind, fs=1.0 / step, output="sos")
        found = signal.sosfilt(sections, found)
        if not causal:
            found = signal.sosfilt(sections, found[::-1])[::-1]
    return np.array(found[size : size + len(values)])


def without_trend(values: FloatArray, step: float, degree: int, linear: bool = False) -> FloatArray:
    """An acceleration whose velocity has lost its polynomial of least squares.

    The polynomial is 0 at the start, as the velocity is; its derivative is taken off.

    Raises
    ------
    FieldError
        If the degree is not from 1 to 6, or there are too few points.
    """
    if not 1 <= degree <= 6:
        raise FieldError("kernel.records.baseline-degree", degree=degree)
    if len(values) < degree + 2:
        raise FieldError("kernel.records.baseline-points", n=len(values), degree=degree)
    powers = np.arange(1, degree + 1)
    s = np.linspace(0.0, 1.0, len(values))
    duration = step * (len(values) - 1)
    slopes = powers * s[:, None] ** (powers - 1) / duration
    basis = np.stack([integrated(column, step, linear)[0] for column in slopes.T], axis=1)
    speed, _ = integrated(values, step, linear)
    found, *_ = np.linalg.lstsq(basis, speed, rcond=None)
    return np.asarray(values - slopes @ found)


def _trapezoids(values: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Running integral along the first axis, 0 at the start."""
    found = np.zeros(values.shape)
    np.cumsum(0.5 * step * (values[1:] + values[:-1]), axis=0, out=found[1:])
    return found


def integrated(
    acceleration: NDArray[np.float64], step: float, linear: bool = False
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Velocity and displacement of accelerations at a constant step, at rest at the start.

    Parameters
    ----------
    acceleration : array (n, ...)
    linear : bool
        False: trapezoids twice. True: the exact motion of an acceleration linear in the steps.

    Returns
    -------
    velocity, displacement : arrays like `acceleration`
    """
    v = _trapezoids(acceleration, step)
    if not linear:
        return v, _trapezoids(v, step)
    more = step * v[:-1] + step**2 / 6.0 * (2.0 * acceleration[:-1] + acceleration[1:])
    d = np.zeros(acceleration.shape)
    np.cumsum(more, axis=0, out=d[1:])
    return v, d


def displacement_integral(
    acceleration: NDArray[np.float64], step: float, linear: bool = False
) -> NDArray[np.float64]:
    """Integral of the displacement over the record, by the rule that gave the displacement."""
    v, d = integrated(acceleration, step, linear)
    if not linear:
        return np.asarray(_trapezoids(d, step)[-1])
    a = acceleration
    pieces = step * d[:-1] + step**2 / 2.0 * v[:-1] + step**3 / 24.0 * (3.0 * a[:-1] + a[1:])
    return np.asarray(pieces.sum(axis=0))


def end_rows(n: int, step: float, linear: bool = False) -> NDArray[np.float64]:
    """Rows (3, n) whose products with an acceleration are the final velocity, the final
    displacement and the integral of the displacement.

    The rules are linear and do not change with time: a unit at one sample gives what a unit at
    sample 1 gives in a record shortened by its delay. The two ends are computed on their own.
    """
    pulse = np.zeros(n)
    pulse[1] = 1.0
    v, d = integrated(pulse, step, linear)
    rows = np.empty((3, n))
    inner = np.arange(1, n - 1)
    rows[0, inner], rows[1, inner] = v[n - inner], d[n - inner]
    # after the pulse the displacement is linear in time: so is the integral's second difference
    left = n - 1.0 - inner
    start = displacement_integral(pulse[:3], step, linear)
    rows[2, inner] = start + d[2] * step * (left - 1) + v[2] * step**2 * (left - 1) ** 2 / 2.0
    for place in (0, n - 1):
        pulse[:] = 0.0
        pulse[place] = 1.0
        v, d = integrated(pulse, step, linear)
        rows[:, place] = v[-1], d[-1], displacement_integral(pulse, step, linear)
    return rows


def brought_to_rest(
    acceleration: NDArray[np.float64], step: float, linear: bool = False
) -> NDArray[np.float64]:
    """The nearest acceleration (least squares) that ends at rest: final velocity, final
    displacement and mean displacement are zero.

    Raises
    ------
    FieldError
        With fewer than four points.
    """
    n = len(acceleration)
    if n < 4:
        raise FieldError("kernel.records.record-correct-needs-four", n=n)
    rows = end_rows(n, step, linear)
    basis, _ = np.linalg.qr((rows / np.linalg.norm(rows, axis=1)[:, None]).T)
    return np.asarray(acceleration - basis @ (basis.T @ acceleration))
