"""Broken lines that keep the energy of a signal, mean shocks, inverse Laplace transforms."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError


def energy_envelope(x: FloatArray, y: FloatArray, intervals: int) -> tuple[FloatArray, FloatArray]:
    """A positive broken line with the sum of squares of a signal on each of its intervals.

    The line starts at |y[0]|; each next point is the value that gives, over the samples of its
    interval, the signal's sum of squares. Where no positive value does, the interval is shortened.
    A signal of fewer intervals than asked for gives its absolute values.

    Parameters
    ----------
    x, y : arrays (n,)
        Regular samples.
    intervals : int
        Number of intervals aimed at.
    """
    last = len(x) - 1
    if last <= intervals:
        return x, np.abs(y)
    size = -(-last // intervals)
    squares = np.concatenate([[0.0], np.cumsum(y**2)])
    places, values = [0], [abs(float(y[0]))]
    while places[-1] < last:
        begin = places[-1]
        end = min(begin + size - begin % size, last)
        level = None
        while level is None:
            energy = float(squares[end + 1] - squares[begin + 1])
            level = _end_level(values[-1], end - begin, energy, abs(float(y[end])))
            end -= level is None
        places.append(end)
        values.append(level)
    return x[places], np.array(values)


def _end_level(start: float, n: int, energy: float, single: float) -> float | None:
    """End value, not negative, of a line over samples 1 to n whose squares sum to `energy`."""
    if n == 1:
        return single
    k = np.arange(1, n + 1) / n
    a, b = float(np.sum(k**2)), float(np.sum(k * (1.0 - k)))
    c = start**2 * float(np.sum((1.0 - k) ** 2)) - energy
    # sum (start (1 - k) + end k)^2 = energy
    root = (start * b) ** 2 - a * c
    if root < 0.0:
        return None
    end = (-start * b + np.sqrt(root)) / a
    if end >= 0.0:
        return float(end)
    return 0.0 if end > -1e-5 * start else None


def mean_shock(
    x: FloatArray, y: FloatArray, percent: float, duration: float, count: int | None
) -> tuple[FloatArray, FloatArray]:
    """Mean of the shocks of a record, each recorded for a duration from where it begins.

    A shock begins where |y| passes a threshold, in percent of its largest value; the next one
    is looked for when the recording of the last one has ended. A shock whose recording the end of
    the record cuts does not count.

    Raises
    ------
    FieldError
        Without any whole shock.
    """
    step = float(x[-1] - x[0]) / max(len(x) - 1, 1)
    if duration <= 0.0 or step <= 0.0:
        raise FieldError("kernel.records.recording-time-shock-must")
    length = round(duration / step)
    size = np.abs(y)
    above = size > percent / 100.0 * (size.max() if len(size) else 0.0)
    taken: list[NDArray[np.float64]] = []
    i = 0
    while i < len(y) and (count is None or len(taken) < count):
        if not above[i]:
            i += 1
            continue
        if i + length >= len(y):
            break
        taken.append(y[i : i + length + 1])
        i += length + 1
        while i < len(y) and above[i]:
            i += 1  # the same shock, longer than its recording
    if not taken:
        raise FieldError("kernel.records.record-no-whole-shock")
    return step * np.arange(length + 1.0), np.asarray(np.mean(taken, axis=0))


def inverse_laplace(
    omega: FloatArray, values: NDArray[np.complex128], shift: float, group: int
) -> tuple[FloatArray, FloatArray]:
    """Times and values of f from F(shift + i omega), by Durbin's series.

    Durbin, The Computer Journal 17 (1974): `f(t) = 2 e^(at)/T (F(a)/2 + sum Re(F_k e^(i w_k t)))`
    on [0, T], T = 2 pi / step of omega, at `len(omega) / group` times.

    Raises
    ------
    FieldError
        If omega does not start at 0 with a constant step, or the sizes do not fit.
    """
    if len(omega) < 2 or len(values) != len(omega):
        raise FieldError(
            "kernel.records.frequencies-values-function", n_omega=len(omega), n_values=len(values)
        )
    steps = np.diff(omega)
    if abs(omega[0]) > 1e-9 * omega[-1] or np.ptp(steps) > 1e-4 * steps[0]:
        raise FieldError("kernel.records.frequencies-begin-constant-step")
    if group < 1 or len(omega) % group:
        raise FieldError(
            "kernel.records.frequencies-not-split-groups", n_omega=len(omega), group=group
        )
    n = len(omega) // group
    period = 2.0 * np.pi / steps[0]
    times = period / n * np.arange(n)
    folded = values.reshape(group, n).sum(axis=0)
    series = np.fft.ifft(folded).real * n - 0.5 * values[0].real
    return times, 2.0 / period * np.exp(shift * times) * series
