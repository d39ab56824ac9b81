"""Power spectra (one-sided, per hertz): of a signal, and the largest responses that they cause.

The largest responses follow Vanmarcke (J. Appl. Mech. 42, 1975) and the Poisson law of rare
crossings (Cramer & Leadbetter, Stationary and related stochastic processes, 1967).
"""

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.records.signals import fourier

EULER = 0.5772156649015329


def power_density(values: FloatArray, step: float, n: int) -> tuple[FloatArray, FloatArray]:
    """Frequencies (n // 2 + 1,) and one-sided power density of a signal on `n` samples.

    Its sum times the frequency step is the mean square of the `n` samples.
    """
    f, amplitudes = fourier(values, step, n)
    density = np.abs(amplitudes) ** 2 / (n * step)
    density[1:-1] *= 2.0
    return f, density


def _gain(kind: str, omega: FloatArray, natural: float, damping: float) -> FloatArray:
    """Square of the transfer function from the base acceleration to the response."""
    below = (natural**2 - omega**2) ** 2 + (2.0 * damping * omega * natural) ** 2
    above = {
        "ACCE": natural**4 + (2.0 * damping * omega * natural) ** 2,
        "VITE": omega**2,
        "DEPL": np.ones_like(omega),
    }[kind]
    return np.asarray(above / below)


def gauss_points(
    f: FloatArray, density: FloatArray, edges: FloatArray, count: int = 4
) -> tuple[FloatArray, FloatArray]:
    """Frequencies, and weights times density: so many points between each two edges."""
    points, weights = np.polynomial.legendre.leggauss(count)
    half = 0.5 * np.diff(edges)
    x = ((edges[:-1] + half)[:, None] + half[:, None] * points).ravel()
    return x, (half[:, None] * weights).ravel() * np.interp(x, f, density)


def response_moments(
    f: FloatArray, density: FloatArray, natural: float, damping: float, kind: str
) -> tuple[float, float, float]:
    """Spectral moments 0, 1, 2 (circular frequency) of an oscillator's stationary response.

    Parameters
    ----------
    f, density : arrays (n,)
        One-sided power density of the base acceleration per hertz, linear between its points.
    natural : float
        Natural frequency (Hz).
    damping : float
        Fraction of critical, positive.
    kind : 'ACCE', 'VITE', 'DEPL'
        Absolute acceleration, relative velocity, relative displacement.
    """
    width = damping * natural
    near = natural + width * np.sinh(np.linspace(-6.0, 6.0, 61))
    inside = near[(near > f[0]) & (near < f[-1])]
    points = np.union1d(f, inside)
    x, power = gauss_points(f, density, points, 8)
    omega = 2.0 * np.pi * x
    power = power * _gain(kind, omega, 2.0 * np.pi * natural, damping)
    m = [float(np.sum(power * omega**k)) for k in range(3)]
    return m[0], m[1], m[2]


def median_peak(moments: tuple[float, float, float], duration: float) -> float:
    """Median of the largest value, up-crossings being independent events (Poisson)."""
    m0, _, m2 = moments
    crossings = duration * np.sqrt(m2 / m0) / (2.0 * np.pi) / np.log(2.0)
    return float(np.sqrt(2.0 * m0 * np.log(max(crossings, 1.0))))


def _level(probability: float, law: Callable[[float], float], start: float, tol: float) -> float:
    low, high = 0.0, start
    while law(high) < probability:
        low, high = high, 2.0 * high
        if high > 1e3 * start:
            raise FieldError("kernel.records.largest-response-spectrum-no")
    while high - low > tol * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if law(middle) < probability else (low, middle)
    return 0.5 * (low + high)


def gumbel_mean(law: Callable[[float], float], start: float, tol: float) -> float:
    """Mean of Gumbel's law through the fractiles of 5 % and 95 % of another.

    Parameters
    ----------
    law : callable
        Probability to stay below a level, by the level.
    start : float
        A level of the size of the fractiles.
    tol : float
        Relative precision of the fractiles.
    """
    fractiles = (0.05, 0.95)
    low, high = (_level(p, law, start, tol) for p in fractiles)
    rank_low, rank_high = (-np.log(-np.log(p)) for p in fractiles)
    scale = (high - low) / (rank_high - rank_low)
    return float(low - scale * rank_low + EULER * scale)


def _below(level: float, times: FloatArray, moments: FloatArray) -> float:
    """Vanmarcke's probability that the absolute answer never passes a level.

    The envelope is below it at the worst instant, and the level is not crossed at others.
    """
    m0, m1, m2 = moments.T
    alive = (m0 > 0.0) & (m2 > 0.0)
    m0, m1, m2 = (np.where(alive, m, 1.0) for m in (m0, m1, m2))
    reduced = level / np.sqrt(m0)
    spread = np.sqrt(np.clip(1.0 - m1**2 / (m0 * m2), 0.0, 1.0))
    clump = -np.expm1(-np.sqrt(np.pi / 2.0) * spread**1.2 * reduced)
    seldom = np.expm1(np.minimum(0.5 * reduced**2, 700.0))
    rate = np.where(alive, np.sqrt(m2 / m0) / np.pi * clump / np.maximum(seldom, 1e-300), 0.0)
    start = -np.expm1(-0.5 * float(reduced[alive].min()) ** 2) if alive.any() else 1.0
    return float(start * np.exp(-np.trapezoid(rate, times)))


def largest_value(times: FloatArray, moments: FloatArray, precision: float = 1e-3) -> float:
    """Mean of the largest absolute value of a random motion of which moments are known.

    Parameters
    ----------
    times : array (n,); moments : array (n, 3)
        Moments 0, 1, 2 (circular frequency).
    precision : float
        Relative, of the fractiles of 5 % and 95 % that Gumbel's law goes through.
    """
    size = float(np.sqrt(moments[:, 0].max()))
    if size == 0.0:
        return 0.0
    return gumbel_mean(lambda x: _below(x, times, moments), size, precision)


def mean_peak(moments: tuple[float, float, float], duration: float) -> float:
    """Mean of the largest value of a stationary response."""
    return largest_value(np.array([0.0, duration]), np.array([moments, moments]), 1e-14)


PEAKS = {"CRAM": median_peak, "NEWG": mean_peak}


def response_spectrum(
    f: FloatArray, density: FloatArray, duration: float, periods: FloatArray, damping: float,
    kind: str, law: str,
) -> FloatArray:  # fmt: skip
    """Largest responses (n,) of oscillators of given periods over a stationary signal (PSRS).

    Raises
    ------
    FieldError
        If the density is negative or zero everywhere, or damping, periods or duration are not
        positive.
    """
    if not 0.0 < damping < 1.0:
        raise FieldError("kernel.records.damping-between-not", damping=damping)
    if duration <= 0.0 or (periods <= 0.0).any():
        raise FieldError("kernel.records.duration-periods-must-positive")
    if (density < 0.0).any() or not (density > 0.0).any() or (np.diff(f) <= 0.0).any():
        raise FieldError("kernel.records.power-spectrum-positive-over")
    peak = PEAKS[law]
    found = [response_moments(f, density, 1.0 / t, damping, kind) for t in periods]
    return np.array([peak(m, duration) for m in found])
