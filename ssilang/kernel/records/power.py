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
_GAUSS = np.polynomial.legendre.leggauss(8)


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
    half = 0.5 * np.diff(points)
    middle = points[:-1] + half
    x = (middle[:, None] + half[:, None] * _GAUSS[0]).ravel()
    w = (half[:, None] * _GAUSS[1]).ravel()
    omega = 2.0 * np.pi * x
    response = np.interp(x, f, density) * _gain(kind, omega, 2.0 * np.pi * natural, damping)
    m = [float(np.sum(w * response * omega**k)) for k in range(3)]
    return m[0], m[1], m[2]


def median_peak(moments: tuple[float, float, float], duration: float) -> float:
    """Median of the largest value, up-crossings being independent events (Poisson)."""
    m0, _, m2 = moments
    crossings = duration * np.sqrt(m2 / m0) / (2.0 * np.pi) / np.log(2.0)
    return float(np.sqrt(2.0 * m0 * np.log(max(crossings, 1.0))))


def _below(level: float, moments: tuple[float, float, float], duration: float) -> float:
    """Vanmarcke's probability that the absolute response stays below a level (in deviations)."""
    m0, m1, m2 = moments
    spread = max(1.0 - m1**2 / (m0 * m2), 0.0) ** 0.5
    rate = np.sqrt(m2 / m0) / np.pi
    start = -np.expm1(-0.5 * level**2)
    clump = -np.expm1(-np.sqrt(np.pi / 2.0) * spread**1.2 * level)
    return float(start * np.exp(-rate * duration * clump / np.expm1(0.5 * level**2)))


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


def mean_peak(moments: tuple[float, float, float], duration: float) -> float:
    """Mean of the largest value by Vanmarcke's law."""
    mean = gumbel_mean(lambda x: _below(x, moments, duration), 4.0, 1e-14)
    return float(np.sqrt(moments[0])) * mean


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
