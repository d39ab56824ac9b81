"""Filters of records: Butterworth's, causal or without phase, and polynomials of the velocity.

Boore & Akkar, Bull. Seism. Soc. Am. 93 (2003) and Boore, 95 (2005): a filter that runs forth and
back needs zeros before and after the record, 1.5 n / f of its low corner.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.records.integration import integrated

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
    from scipy.signal import butter, sosfilt

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
        sections = butter(order, corner, kind, fs=1.0 / step, output="sos")
        found = sosfilt(sections, found)
        if not causal:
            found = sosfilt(sections, found[::-1])[::-1]
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
