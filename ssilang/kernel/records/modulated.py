"""Largest responses of oscillators to modulated random signals (PRNS).

The signal is a sum over bands of frequencies, `sum_b m_b(t) s_b(t)`: stationary signals with the
power of a band, each under a modulation of its own. Modulations are taken linear over equal
processes in time. An oscillator at rest at the start then answers to each frequency by an
evolution in closed form; the mean square of the answer, of its rate and
their correlation through time give the rate at which levels are crossed (Vanmarcke, J. Appl.
Mech. 42, 1975, with the non-stationary moments of Di Paola, Eng. Fract. Mech. 21, 1985).

Artificial signals: sums of sines of random phase under a power spectrum, modulated in time.

Shinozuka & Deodatis, Applied Mechanics Reviews 44 (1991): with N sines of amplitude
sqrt(2 S df) the signal is Gaussian as N grows and has the spectrum in the mean.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import ComplexArray, FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.scientific import la
from ssilang.kernel.records.power import gauss_points, largest_value


@dataclass(frozen=True, eq=False)
class ModulatedSignal:
    """A random signal by bands.

    Attributes
    ----------
    frequencies, density : arrays (n,)
        One-sided power density of the acceleration per hertz, linear between its points.
    bands : array (n_bands + 1,)
        Limits of the bands, increasing; nothing of the density counts outside them.
    times : tuple of arrays, modulations : tuple of arrays
        The curve of each band, all from one instant to another.
    """

    frequencies: FloatArray
    density: FloatArray
    bands: FloatArray
    times: tuple[FloatArray, ...]
    modulations: tuple[FloatArray, ...]

    def __post_init__(self) -> None:
        """Refuse what has no meaning."""
        f, y = self.frequencies, self.density
        if (y < 0.0).any() or not (y > 0.0).any() or (np.diff(f) <= 0.0).any():
            raise FieldError("kernel.records.power-spectrum-positive-over")
        if len(self.bands) != len(self.times) + 1 or (np.diff(self.bands) <= 0.0).any():
            told = {"n_times": len(self.times), "n_times_2": len(self.times) + 1}
            told |= {"n_bands": len(self.bands)}
            raise FieldError("kernel.records.modulations-need-increasing-limits", **told)
        ends = np.array([[t[0], t[-1]] for t in self.times])
        if np.ptp(ends, axis=0).max() > 1e-6 * max(self.duration, 1e-300) or self.duration <= 0.0:
            raise FieldError("kernel.records.modulations-not-go-instant")

    @property
    def duration(self) -> float:
        """From the start to the end of the modulations."""
        return float(self.times[0][-1] - self.times[0][0])

    def levels(self, count: int) -> FloatArray:
        """Each modulation at the ends of `count` equal parts of time, (n_bands, count + 1)."""
        return np.array(
            [
                np.interp(np.linspace(t[0], t[-1], count + 1), t, m)
                for t, m in zip(self.times, self.modulations, strict=True)
            ]
        )


@dataclass(frozen=True)
class Resolution:
    """How finely time is taken: processes, instants in each, time added, precision of levels."""

    processes: int
    instants: int = 10
    added: float = 20.0
    precision: float = 1e-3


def _points(
    signal: ModulatedSignal, natural: float, damping: float
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Frequencies, weights times density, band of each point: finer near the resonance."""
    near = natural + damping * natural * np.sinh(np.linspace(-6.0, 6.0, 61))
    edges = np.union1d(np.union1d(signal.frequencies, signal.bands), near)
    low = max(signal.frequencies[0], signal.bands[0])
    high = min(signal.frequencies[-1], signal.bands[-1])
    edges = edges[(edges >= low) & (edges <= high)]
    x, power = gauss_points(signal.frequencies, signal.density, edges)
    band = np.searchsorted(signal.bands, x, side="right") - 1
    return x, power, np.clip(band, 0, len(signal.times) - 1)


Piece = tuple[float, FloatArray | float, FloatArray | float]
"""Length of a piece of time, modulation at its ends: of each frequency, or of all."""


def answers(
    A: FloatArray, b: FloatArray, f: FloatArray, pieces: Iterable[Piece]
) -> Iterator[ComplexArray]:
    """States (n, n_f) of `x' = A x + b a`, at rest first, at the end of each piece of time.

    `a` is `m(t) e^(2 i pi f t)` with m linear in each piece. Phases are counted from each end:
    moments do not see them.
    """
    s = 2j * np.pi * f
    # answers H e^(st) to e^(st) and (H' + H t) e^(st) to t e^(st)
    inverse = np.linalg.inv(s[:, None, None] * np.eye(len(b)) - A)
    steady = (inverse @ b).T
    grown = -np.einsum("kij,jk->ik", inverse, steady)
    x, kept = np.zeros_like(steady), dict[float, tuple[FloatArray, ComplexArray]]()
    for length, first, last in pieces:
        step = float(f"{length:.12g}")  # those that rounding alone tells apart are one
        if step not in kept:
            kept[step] = la.expm(A * step), np.exp(-s * step)
        free, back = kept[step]
        slope = (last - first) / step
        x = free @ (x - (first * steady + slope * grown)) * back
        x = x + (last * steady + slope * grown)
        yield x


def moments_of(power: FloatArray, y: ComplexArray, rate: ComplexArray) -> FloatArray:
    """Moments 0, 1, 2 of a quantity (n_f,) and its rate, by the power of each frequency."""
    cross = np.sum(power * (np.conj(y) * rate).imag)
    return np.array([np.sum(power * np.abs(y) ** 2), cross, np.sum(power * np.abs(rate) ** 2)])


def _observed(
    kind: str,
    u: ComplexArray,
    v: ComplexArray,
    push: FloatArray | float,
    w0: float,
    damping: float,
) -> tuple[ComplexArray, ComplexArray]:
    """The quantity and its rate: relative DEPL or VITE, absolute ACCE."""
    acceleration = -push - 2.0 * damping * w0 * v - w0 * w0 * u
    if kind == "DEPL":
        return u, v
    if kind == "VITE":
        return v, acceleration
    return (
        -(2.0 * damping * w0 * v + w0 * w0 * u),
        -(2.0 * damping * w0 * acceleration + w0 * w0 * v),
    )


def evolution(
    signal: ModulatedSignal, natural: float, damping: float, kind: str, resolution: Resolution
) -> tuple[FloatArray, FloatArray]:
    """Times (n,) from the start and moments 0, 1, 2 (n, 3) of an oscillator's answer.

    Parameters
    ----------
    natural : float
        Natural frequency (Hz).
    damping : float
        Fraction of critical, between 0 and 1.
    kind : 'ACCE', 'VITE', 'DEPL'
    """
    f, power, band = _points(signal, natural, damping)
    w0, (whole, parts) = 2.0 * np.pi * natural, (resolution.processes, resolution.instants)
    length = signal.duration / whole
    at = np.arange(whole * parts + 1) / parts
    levels = [np.interp(at, np.arange(whole + 1), m) for m in signal.levels(whole)]
    pushes: list[FloatArray | float] = [*np.array(levels).T[:, band]]
    pieces = [(length / parts, *ends) for ends in pairwise(pushes)]
    after = int(np.ceil(resolution.added / length - 1e-9)) if resolution.added > 0.0 else 0
    pieces += [(length / parts, 0.0, 0.0)] * (after * parts)
    A = np.array([[0.0, 1.0], [-w0 * w0, -2.0 * damping * w0]])
    moments = [np.zeros(3)]
    states = answers(A, np.array([0.0, -1.0]), f, pieces)
    for (u, v), (_, _, push) in zip(states, pieces, strict=True):
        moments.append(moments_of(power, *_observed(kind, u, v, push, w0, damping)))
    times: FloatArray = length / parts * np.arange(len(moments), dtype=float)
    return times, np.array(moments)


def modulated_response_spectrum(
    signal: ModulatedSignal, periods: FloatArray, damping: float, kind: str, resolution: Resolution
) -> FloatArray:
    """Mean largest answers (n,) of oscillators of given periods: Gumbel's law, from Vanmarcke's.

    The law goes through the 5 % and 95 % fractiles.

    Raises
    ------
    FieldError
        If damping, periods, or the numbers of processes and instants are out of their range.
    """
    if not 0.0 < damping < 1.0:
        raise FieldError("kernel.records.damping-between-not", damping=damping)
    if (periods <= 0.0).any():
        raise FieldError("kernel.records.duration-periods-must-positive")
    if resolution.processes < 1 or resolution.instants < 1 or resolution.precision <= 0.0:
        raise FieldError("kernel.records.least-process-instant-needed")
    found = []
    for period in periods:
        times, moments = evolution(signal, 1.0 / float(period), damping, kind, resolution)
        found.append(largest_value(times, moments, resolution.precision))
    return np.array(found)


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
