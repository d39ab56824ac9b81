"""Artificial signals: sums of sines of random phase under a power spectrum, modulated in time.

Shinozuka & Deodatis, Applied Mechanics Reviews 44 (1991): with N sines of amplitude
sqrt(2 S df) the signal is Gaussian as N grows and has the spectrum in the mean.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError

CHUNK = 200_000  # values held at once: sines times instants


@dataclass(frozen=True)
class Band:
    """A band of frequencies and the modulation (linear between its points) of its sines."""

    low: float
    high: float
    times: FloatArray
    values: FloatArray


def sines(f: FloatArray, density: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
    """Frequencies, in the middle of equal slices, and amplitudes of the sines of a spectrum.

    The sum of the half squares of the amplitudes is the power of the slices.
    """
    width = (f[-1] - f[0]) / count
    middle = f[0] + width * (np.arange(count) + 0.5)
    level = np.interp(middle, f, density)
    if (level < 0.0).any():
        raise FieldError("kernel.records.power-spectrum-not-negative")
    return middle, np.sqrt(2.0 * level * width)


def _pieces(bands: tuple[Band, ...], start: float) -> Iterator[tuple[Band, FloatArray, FloatArray]]:
    """Band, abscissas and values of its modulation from `start` on."""
    for band in bands:
        later = band.times > start
        t = np.concatenate([[start], band.times[later]])
        m0 = np.interp(start, band.times, band.values)
        yield band, t, np.concatenate([[m0], band.values[later]])


def motion(
    times: FloatArray, f: FloatArray, amplitudes: FloatArray, phases: FloatArray,
    bands: tuple[Band, ...], start: float,
) -> tuple[FloatArray, FloatArray, FloatArray]:  # fmt: skip
    """Acceleration, velocity and displacement (n,) at `times` of modulated sines.

    The motion is at rest at `start`; velocity and displacement are the exact integrals of
    `sum m(t) a cos(w t + phase)` for a modulation m linear between its points.
    """
    total = np.zeros((3, len(times)))
    for band, t, m in _pieces(bands, start):
        last = band is bands[-1]
        mine = (f >= band.low) & ((f < band.high) | last)
        wave = _Waves(f[mine], amplitudes[mine], phases[mine])
        speed = place = 0.0
        for i in range(len(t) - 1):
            slope = (m[i + 1] - m[i]) / (t[i + 1] - t[i])
            inside = (times >= t[i]) & ((times < t[i + 1]) | (i == len(t) - 2))
            own = wave.integrals(np.array([t[i], t[i + 1]]), t[i], m[i], slope)
            free = speed - own[1, 0], place - own[2, 0]
            seen = wave.integrals(times[inside], t[i], m[i], slope)
            seen[1] += free[0]
            seen[2] += free[1] + free[0] * (times[inside] - t[i])
            total[:, inside] += seen
            place = float(own[2, 1] + free[1] + free[0] * (t[i + 1] - t[i]))
            speed = float(own[1, 1] + free[0])
    return total[0], total[1], total[2]


class _Waves:
    """Sines of one band."""

    def __init__(self, f: FloatArray, amplitudes: FloatArray, phases: FloatArray) -> None:
        self.w = 2.0 * np.pi * f
        self.a, self.phases = amplitudes, phases

    def integrals(
        self, times: FloatArray, origin: float, level: float, slope: float
    ) -> NDArray[np.float64]:
        """`s = (level + slope (t - origin)) a cos(w t + phase)` and its first two primitives."""
        found = np.zeros((3, len(times)))
        if len(self.w) == 0:
            return found
        size = max(CHUNK // len(self.w), 1)
        for i in range(0, len(times), size):
            t = times[i : i + size]
            angle = np.outer(self.w, t) + self.phases[:, None]
            cos, sin = np.cos(angle), np.sin(angle)
            m = level + slope * (t - origin)
            a1, a2, a3 = (self.a / self.w**k for k in (1, 2, 3))
            found[0, i : i + size] = m * (self.a @ cos)
            found[1, i : i + size] = m * (a1 @ sin) + slope * (a2 @ cos)
            found[2, i : i + size] = -m * (a2 @ cos) + 2.0 * slope * (a3 @ sin)
        return found


def perturbed(
    values: FloatArray, generator: np.random.Generator, signs: bool, degrees: float | None
) -> FloatArray:
    """Values whose squares partly move to their neighbours, then whose signs are drawn (PERT).

    Each square keeps the share cos^2 of an angle drawn between 0 and `degrees` and gives the rest
    to its neighbours, half each (all of it at the ends): the sum of squares stays.
    """
    made = np.array(values, dtype=float)
    if degrees is not None and len(made) > 1:
        square = made**2
        kept = np.cos(np.radians(degrees) * generator.random(len(made))) ** 2
        given = square * (1.0 - kept)
        power = square * kept
        power[1] += given[0]
        power[-2] += given[-1]
        power[2:] += 0.5 * given[1:-1]
        power[:-2] += 0.5 * given[1:-1]
        made = np.sqrt(power) * np.where(made < 0.0, -1.0, 1.0)
    if signs:
        made = made * np.where(generator.random(len(made)) < 0.5, -1.0, 1.0)
    return made
