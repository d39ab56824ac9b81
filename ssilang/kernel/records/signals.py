"""Fourier transforms, filters, shocks and wavelets of sampled signals.

Broken lines that keep the energy of a signal, mean shocks, inverse Laplace transforms.
"""

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
    parts = []
    for side in (y, -y):
        a, b = side[:-1] - level, side[1:] - level
        span = np.abs(b - a)
        part = np.maximum(a, b) / np.where(span > 0, span, 1.0)
        shares = np.where((a > 0) != (b > 0), part, (a > 0) & (b > 0))
        parts.append(float(np.sum(np.diff(x) * shares)))
    return parts[0] + parts[1]


def scales(low: float, high: float, count: int, pulsation: float) -> FloatArray:
    """`count + 1` scales, evenly spaced, from that of the high frequency to that of the low one."""
    ends = pulsation / (2.0 * np.pi * np.array([high, low]))
    return np.linspace(ends[0], ends[1], count + 1)


def transform(
    values: FloatArray, step: float, n: int, scale: FloatArray, pulsation: float
) -> ComplexArray:
    """Transform (n_scales, n) of a signal on `n` samples (cut, or filled with zeros)."""
    spectrum = np.fft.fft(values, n)
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
