"""Continuous wavelet transform by Morlet's wavelet, and its ridge.

`T(a, b) = 1/a integral s(t) conj(psi((t - b) / a)) dt`, psi(x) = exp(i w0 x - x^2 / 2), scaled so
that a sine of amplitude A gives |T| = A on its own frequency (Grossmann & Morlet, SIAM J. Math.
Anal. 15, 1984; ridges: Delprat et al., IEEE Trans. Inf. Theory 38, 1992).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import ComplexArray, FloatArray


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
