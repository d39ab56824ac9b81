"""Fourier transforms, filters, shocks and wavelets of sampled signals."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.modal.oscillator import Oscillators, rested


def constant_step(x: FloatArray) -> float:
    """Step of regularly spaced abscissas.

    Raises
    ------
    FieldError
        With fewer than two points, or when a step differs by more than 1e-4 from the mean.
    """
    if len(x) < 2:
        raise FieldError("kernel.records.signal-needs-two-points", n_x=len(x))
    step = float(x[-1] - x[0]) / (len(x) - 1)
    worst = float(np.max(np.abs(np.diff(x) - step)))
    if step <= 0 or worst > 1e-4 * step:
        raise FieldError("kernel.records.abscissas-not-regularly-spaced", worst=worst, step=step)
    return step


def fourier(values: NDArray[np.float64], step: float, n: int) -> tuple[FloatArray, ComplexArray]:
    """Frequencies and Fourier transform of real signals along the first axis.

    `F(f) = step * sum x_k exp(-2 i pi f k step)` on `n` samples (cut, or filled with zeros): the
    integral that the continuous transform is, so that F has the unit of x times that of time.
    Returns the `n // 2 + 1` frequencies from 0 to `1 / (2 step)`.
    """
    found = np.fft.rfft(values[:n], n, axis=0) * step
    return np.arange(n // 2 + 1) / (n * step), found


def inverse_fourier(frequencies: FloatArray, values: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Times and real signal whose transform is given from 0 to the highest frequency."""
    spacing = constant_step(frequencies)
    n = 2 * (len(frequencies) - 1)
    step = 1.0 / (n * spacing)
    signal: FloatArray = np.fft.irfft(values, n) / step
    times: FloatArray = step * np.arange(n, dtype=float)
    return times, signal


def smoothed(values: FloatArray, passes: int) -> FloatArray:
    """Hanning's mean (1/4, 1/2, 1/4) applied `passes` times; ends by (1/2, 1/2)."""
    y = np.array(values, dtype=float)
    for _ in range(passes):
        if len(y) < 2:
            break
        inner = 0.25 * y[:-2] + 0.5 * y[1:-1] + 0.25 * y[2:]
        y = np.concatenate(([0.5 * (y[0] + y[1])], inner, [0.5 * (y[-2] + y[-1])]))
    return y


def shocks(
    values: FloatArray, percent: float
) -> tuple[FloatArray, NDArray[np.int64], NDArray[np.int64]]:
    """Peaks of the stretches above a threshold, and the places (from 1) where they begin and end.

    The threshold is `percent` of the largest absolute value. A stretch begins at i when value i
    is below and i + 1 above, and ends at i when value i is above and i + 1 below.
    """
    size = np.abs(values)
    above = size > percent / 100.0 * (size.max() if len(size) else 0.0)
    begins = np.flatnonzero(~above[:-1] & above[1:]) + 1
    ends = np.flatnonzero(above[:-1] & ~above[1:]) + 1
    peaks = []
    for i in begins:
        after = ends[ends > i]
        stop = int(after[0]) if len(after) else len(values)
        part = values[i:stop]
        peaks.append(part[np.argmax(np.abs(part))])
    return np.asarray(peaks, dtype=float), begins, ends


def time_above(x: FloatArray, y: FloatArray, level: float) -> float:
    """Length of the abscissas where a curve linear between its points is above +-level."""
    return _time_above(x, y, level) + _time_above(x, -y, level)


def _time_above(x: FloatArray, y: FloatArray, level: float) -> float:
    a, b = y[:-1] - level, y[1:] - level
    steps = np.diff(x)
    share = np.where((a > 0) & (b > 0), 1.0, 0.0)
    crossing = (a > 0) != (b > 0)
    span = np.abs(b - a)
    part = np.maximum(a, b) / np.where(span > 0, span, 1.0)
    return float(np.sum(steps * np.where(crossing, part, share)))


def scales(low: float, high: float, count: int, pulsation: float) -> FloatArray:
    """`count + 1` scales, evenly spaced, from that of the high frequency to that of the low one."""
    ends = pulsation / (2.0 * np.pi * np.array([high, low]))
    return np.linspace(ends[0], ends[1], count + 1)


def transform(
    values: FloatArray, step: float, n: int, scale: FloatArray, pulsation: float
) -> ComplexArray:
    """Transform (n_scales, n) of a signal on `n` samples (cut, or filled with zeros)."""
    signal = np.zeros(n)
    kept = min(n, len(values))
    signal[:kept] = values[:kept]
    spectrum = np.fft.fft(signal)
    omega = 2.0 * np.pi * np.fft.fftfreq(n, step)
    window = np.exp(-0.5 * (np.outer(scale, omega) - pulsation) ** 2)
    return np.asarray(2.0 * np.fft.ifft(spectrum * window, axis=1))


def settled(times: FloatArray, scale: float) -> NDArray[np.bool_]:
    """Times farther than two scales from both ends, where the ends do not count."""
    inside: NDArray[np.bool_] = times >= times[0] + 2.0 * scale
    inside &= times <= times[-1] - 2.0 * scale
    return inside


def modulus_ridge(
    times: FloatArray, found: ComplexArray, scale: FloatArray, pulsation: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Times, frequency and amplitude of the largest modulus at each time."""
    inside = settled(times, float(scale[-1]))
    size = np.abs(found[:, inside])
    best = size.argmax(axis=0)
    f = pulsation / (2.0 * np.pi * scale[best])
    return times[inside], f, size[best, np.arange(size.shape[1])]


def phase_ridge(
    times: FloatArray, found: ComplexArray, scale: FloatArray, pulsation: float, epsilon: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Points where the phase turns at the wavelet's own pulsation, to `epsilon` (relative)."""
    step = float(times[1] - times[0])
    rows: list[FloatArray] = []
    for row, a in zip(found, scale, strict=True):
        turn = np.angle(row[1:] * np.conj(row[:-1])) / step
        rate = np.concatenate([[turn[0]], 0.5 * (turn[1:] + turn[:-1]), [turn[-1]]])
        own = pulsation / a
        hit = np.flatnonzero((np.abs(rate - own) < epsilon * own) & settled(times, float(a)))
        frequency = np.full(len(hit), own / (2.0 * np.pi))
        rows.append(np.stack([times[hit], frequency, np.abs(row[hit])], axis=1))
    t, f, size = np.concatenate(rows).T
    return t, f, size


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
