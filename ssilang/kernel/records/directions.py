"""Two horizontal components: turned by an angle, and spectra of all directions.

Boore, Bull. Seism. Soc. Am. 100 (2010): RotDpp is, at each period, percentile pp over all angles
of the largest answers of the two components' sum along them.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.modal.oscillator import Oscillators, rested

ANGLES = np.radians(np.arange(180.0))
"""Angles looked at: each degree of a half turn."""
_CHUNK = 4_000_000
"""Values held at once: angles times frequencies times instants."""


def turned(x: FloatArray, y: FloatArray, degrees: float) -> tuple[FloatArray, FloatArray]:
    """Components (n,) along axes turned by an angle, counter-clockwise."""
    angle = np.radians(degrees)
    c, s = np.cos(angle), np.sin(angle)
    return c * x + s * y, -s * x + c * y


def rotated_spectra(
    times: FloatArray,
    x: FloatArray,
    y: FloatArray,
    frequencies: FloatArray,
    damping: float,
    kind: str,
    percentiles: FloatArray,
) -> FloatArray:
    """Spectra (n_percentiles, n_frequencies) of two components over all directions.

    Parameters
    ----------
    times, x, y : arrays (n,)
        Accelerations of the same instants.
    kind : 'DEPL', 'VITE', 'ACCE' or 'ACCA'
        As for `ssilang.kernel.modal.oscillator.spectrum`.
    percentiles : array (n_percentiles,)
        From 0 to 100; 50 is the median.

    Raises
    ------
    FieldError
        If a percentile is not from 0 to 100.
    """
    if ((percentiles < 0.0) | (percentiles > 100.0)).any():
        wrong = percentiles[(percentiles < 0.0) | (percentiles > 100.0)][0]
        raise FieldError("kernel.records.percentile", percentile=wrong)
    both = []
    for signal in (x, y):
        oscillators = Oscillators(frequencies, damping)
        t, a = rested(times, signal, float(frequencies.min()))
        w = oscillators.w
        pairs = oscillators.march(t, a)
        if kind == "ACCA":
            both.append(np.array([w**2 * u + 2.0 * damping * w * v for u, v in pairs]))
        else:
            both.append(np.array([u for u, _ in pairs]))
    power = {"DEPL": 0, "VITE": 1, "ACCE": 2, "ACCA": 0}[kind]
    largest = np.zeros((len(ANGLES), len(frequencies)))
    size = max(_CHUNK // (len(frequencies) * len(ANGLES)), 1)
    cos, sin = np.cos(ANGLES)[:, None, None], np.sin(ANGLES)[:, None, None]
    for i in range(0, len(both[0]), size):
        along = cos * both[0][i : i + size] + sin * both[1][i : i + size]
        np.maximum(largest, np.abs(along).max(axis=1), out=largest)
    found = np.percentile(largest, percentiles, axis=0)
    return np.asarray(found * (2.0 * np.pi * frequencies) ** power)
