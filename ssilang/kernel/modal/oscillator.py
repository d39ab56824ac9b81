"""Damped oscillators under a signal, exactly for a signal linear between its points; spectra.

`x'' + 2 xi w x' + w^2 x = g(t)`, w = 2 pi f (Nigam & Jennings, BSSA 59, 1969: the step is the
exact solution, so the time step only limits where maxima are looked at).
"""

from collections.abc import Iterator

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError

SAME_STEP = 1e-12  # of the last time: the rounding of equally spaced times
CRITICAL = 1e-9  # a damping this near to 1 is moved off it (the step would divide by zero)


class Oscillators:
    """Oscillators of several frequencies and one damping, marched together.

    Parameters
    ----------
    frequencies : array (n,)
        In Hz, positive.
    damping : float
        Fraction of critical.
    """

    def __init__(self, frequencies: FloatArray, damping: float) -> None:
        if (frequencies <= 0.0).any():
            raise KernelError("kernel.modal.frequency-oscillator-must-positive")
        if damping < 0.0:
            raise KernelError("kernel.modal.damping-oscillator-cannot-negative", damping=damping)
        self.w = 2.0 * np.pi * frequencies
        self.xi = damping if abs(damping - 1.0) > CRITICAL else 1.0 - CRITICAL
        self.turning = self.w * np.sqrt(complex(1.0 - self.xi**2))
        self._step: tuple[float, FloatArray, FloatArray] | None = None

    def _free(self, h: float) -> tuple[FloatArray, FloatArray]:
        """`exp(-xi w h)` times cos and sin / wd, each (n,)."""
        if self._step is None or abs(self._step[0] - h) > 1e-12 * h:
            decay, phase = -self.xi * self.w * h, self.turning * h
            # far beyond critical damping cosh overflows where its product with exp does not
            far = np.abs(phase.imag) > 1.0
            near = np.where(far, 0.0, phase)
            up, down = np.exp(decay + 1j * phase), np.exp(decay - 1j * phase)
            cos = np.where(far, (up + down) / 2.0, np.exp(decay) * np.cos(near))
            sin = np.where(far, (up - down) / 2j, np.exp(decay) * np.sin(near)) / self.turning
            self._step = (h, cos.real, sin.real)
        return self._step[1], self._step[2]

    def advance(
        self, x: FloatArray, v: FloatArray, h: float, start: float, end: float
    ) -> tuple[FloatArray, FloatArray]:
        """Displacement and velocity after a step h in which g goes linearly from start to end."""
        w2 = self.w**2
        slope = (end - start) / h / w2
        level = start / w2 - 2.0 * self.xi / self.w * slope
        cos, sin = self._free(h)
        a = x - level
        b = v - slope + self.xi * self.w * a
        free = a * cos + b * sin
        damped = self.w**2 * (1.0 - self.xi**2)  # square of a frequency, negative beyond critical
        rate = b * cos - damped * a * sin - self.xi * self.w * free
        return level + slope * h + free, slope + rate

    def history(self, times: FloatArray, signal: FloatArray, x0: float, v0: float) -> FloatArray:
        """Displacements (n_times,) of a single oscillator.

        Equal steps repeat one linear map, y_i = A y_(i-1) + f_i: all sums of its powers are
        found by doubling, in log2 (n_times) passes over the whole history.
        """
        even = np.linspace(times[0], times[-1], len(times))
        if np.abs(times - even).max() > SAME_STEP * np.abs(even).max():
            return np.array([float(x[0]) for x, _ in self.march(times, signal, x0, v0)])
        h = float(times[-1] - times[0]) / (len(times) - 1)
        one, nil = np.ones(1), np.zeros(1)
        cases = (
            (one, nil, 0.0, 0.0),
            (nil, one, 0.0, 0.0),
            (nil, nil, 1.0, 0.0),
            (nil, nil, 0.0, 1.0),
        )
        columns = np.array([self.advance(x, v, h, a, b) for x, v, a, b in cases])[:, :, 0].T
        power, begin, end = columns[:, :2], columns[:, 2], columns[:, 3]
        states = np.empty((len(times), 2))
        states[0] = x0, v0
        states[1:] = np.outer(signal[:-1], begin) + np.outer(signal[1:], end)
        shift = 1
        while shift < len(times):
            states[shift:] += states[:-shift] @ power.T
            power, shift = power @ power, 2 * shift
        return states[:, 0].copy()

    def march(
        self, times: FloatArray, signal: FloatArray, x0: float = 0.0, v0: float = 0.0
    ) -> Iterator[tuple[FloatArray, FloatArray]]:
        """Displacement and velocity (n,) at each time."""
        x, v = np.full(len(self.w), x0), np.full(len(self.w), v0)
        yield x, v
        for i in range(len(times) - 1):
            h = float(times[i + 1] - times[i])
            x, v = self.advance(x, v, h, float(signal[i]), float(signal[i + 1]))
            yield x, v


def sampled(
    times: FloatArray, signal: FloatArray, wanted: FloatArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """The signal at its own times and the wanted ones (zero outside), increasing.

    Raises
    ------
    KernelError
        If the times do not increase or there are less than two.
    """
    if len(times) < 2 or (np.diff(times) <= 0.0).any():
        raise KernelError("kernel.modal.signal-times-must-increase")
    if wanted is None:
        return times, signal
    every = np.union1d(times, wanted)
    every = every[every >= times[0]]
    return every, np.interp(every, times, signal, right=0.0)


def response(
    times: FloatArray,
    signal: FloatArray,
    frequency: float,
    damping: float,
    wanted: FloatArray | None = None,
    x0: float = 0.0,
    v0: float = 0.0,
) -> tuple[FloatArray, FloatArray]:
    """Times and displacements of one oscillator under a signal (OSCI)."""
    every, values = sampled(times, signal, wanted)
    oscillator = Oscillators(np.array([frequency]), damping)
    x = oscillator.history(every, values, x0, v0)
    if wanted is None:
        return every, x
    return wanted, np.interp(wanted, every, x)


def spectrum(
    times: FloatArray, signal: FloatArray, frequencies: FloatArray, damping: float, kind: str,
    wanted: FloatArray | None = None,
) -> FloatArray:  # fmt: skip
    """Largest response (n,) of oscillators whose base follows the acceleration `signal` (SPO).

    Parameters
    ----------
    kind : 'DEPL', 'VITE', 'ACCE' or 'ACCA'
        Relative displacement, pseudo-velocity w x, pseudo-acceleration w^2 x, absolute
        acceleration.
    wanted : array, optional
        Times at which to look (default those of the signal, then half a period of rest).
    """
    if not len(frequencies):
        raise KernelError("kernel.modal.spectrum-needs-frequency-least")
    oscillators = Oscillators(frequencies, damping)
    sampled(times, signal)
    if wanted is None:
        times, signal = rested(times, signal, float(frequencies.min()))
    else:
        times, signal = sampled(times, signal, wanted)
    w = oscillators.w
    largest = np.zeros(len(w))
    looked_at = np.isin(times, times if wanted is None else wanted)
    for (x, v), looks in zip(oscillators.march(times, signal), looked_at, strict=True):
        seen = w**2 * x + 2.0 * damping * w * v if kind == "ACCA" else x
        np.maximum(largest, looks * np.abs(seen), out=largest)
    return np.asarray(largest * w ** {"DEPL": 0, "VITE": 1, "ACCE": 2, "ACCA": 0}[kind])


def rested(times: FloatArray, signal: FloatArray, slowest: float) -> tuple[FloatArray, FloatArray]:
    """The signal followed by zeros for half the longest period."""
    step = float(np.diff(times).mean())
    count = min(int(np.ceil(0.5 / slowest / step)) + 1, 200_000)
    rest = times[-1] + step * np.arange(1, count + 1)
    return np.concatenate([times, rest]), np.concatenate([signal, np.zeros(count)])


def default_frequencies(times: FloatArray, damping: float) -> FloatArray:
    """From 1/T by steps of 1/T, then of xi f, up to 1/(2 dt) (T duration, dt mean step)."""
    times, _ = sampled(times, times)
    duration = float(times[-1] - times[0])
    top = 0.5 / float(np.diff(times).mean())
    low = 1.0 / duration
    found = [low]
    while found[-1] < top:
        found.append(found[-1] + max(low, damping * found[-1]))
        if len(found) > 20_000:
            raise KernelError("kernel.modal.default-list-frequencies-too")
    return np.array([f for f in found if f <= top * (1.0 + 1e-12)])
