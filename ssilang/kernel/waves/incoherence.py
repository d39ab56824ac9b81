"""Motion of a rigid footing under a ground motion that differs below it.

The ground moves by a field of the cross spectral density (Luco and Wong 1986)

    S(x, x') = S0 exp(-(decay |x - x'|)^2) exp(-i k . (x - x')),

decay = gamma w / Vs for the incoherence, k = w / V for the passage of a wave. A rigid massless
footing follows in the mean: its translation is the plain mean of the ground's over the area, its
rotation the slope that fits best (Scanlan 1976; Iguchi 1984 with equal weights). No traction
weights them, so that scattering is left aside. Spectra of both are double integrals over the
area, which depend on the distance s = x - x' alone: with the middle of both points as the other
variable they are single integrals of what two footings shifted by s have in common.

The field is real in the middle of a symmetric footing: the translation of a wave that passes is in
phase with the motion at the centre, its slope a quarter of a period before or behind.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError

#: two rules of Gauss and Legendre, one twice the other, agree by this share of a spectrum ...
RELATIVE = 1e-9
#: ... or by this part of that of a ground that moves as one (rounding)
ABSOLUTE = 2e-15
#: points of the first and of the last rule
FIRST, LAST = 32, 4096
#: values of an integrand that are held at once
AT_ONCE = 1 << 18


@dataclass(frozen=True)
class Factors:
    """Motion of the footing over that of the ground at its centre.

    Attributes
    ----------
    mean : array (n,)
        Translation: root of the ratio of spectral densities. Its sign is that of the wave
        that passes, without incoherence.
    slopes : array (n, 2)
        1/m, along x and y. The slope's Fourier transform (exp(iwt)) is -i times this one times
        that of the motion.
    coherence : array (n, 2)
        Between translation and slopes: 1 in a wave that passes, 0 without one.
    """

    mean: FloatArray
    slopes: FloatArray
    coherence: FloatArray


@dataclass(frozen=True)
class Strip:
    """An endless strip across x (half width in m)."""

    half: float

    def __post_init__(self) -> None:
        _positive(self.half)

    def passage(self, k: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Factors of a wave: mean (n,) and slopes (n, 2), 1/m; k (n, 2) in rad/m."""
        mean, slope = _line(k[:, 0] * self.half)
        return mean, np.stack([slope / self.half, 0 * slope], axis=1)

    def spectra(self, decay: FloatArray, k: FloatArray) -> FloatArray:
        """Columns mean, slope along x, along y, and both of these with the mean (n, 5)."""
        mean, slope, cross = _line_spectra(decay * self.half, k[:, 0] * self.half).T
        zero = 0 * mean
        return np.stack([mean, slope / self.half**2, zero, cross / self.half, zero], axis=1)


@dataclass(frozen=True)
class Rectangle:
    """Half sides along x and y (m)."""

    half_x: float
    half_y: float

    def __post_init__(self) -> None:
        _positive(self.half_x, self.half_y)

    def passage(self, k: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See Strip."""
        mean_x, slope_x = _line(k[:, 0] * self.half_x)
        mean_y, slope_y = _line(k[:, 1] * self.half_y)
        slopes = [slope_x * mean_y / self.half_x, slope_y * mean_x / self.half_y]
        return mean_x * mean_y, np.stack(slopes, axis=1)

    def spectra(self, decay: FloatArray, k: FloatArray) -> FloatArray:
        """See Strip: Gauss's bell is a product along the axes."""
        a, b = self.half_x, self.half_y
        mean_x, slope_x, cross_x = _line_spectra(decay * a, k[:, 0] * a).T
        mean_y, slope_y, cross_y = _line_spectra(decay * b, k[:, 1] * b).T
        columns = [mean_x * mean_y, slope_x * mean_y / a**2, mean_x * slope_y / b**2]
        return np.stack([*columns, cross_x * mean_y / a, mean_x * cross_y / b], axis=1)

    def torsion(self) -> tuple[float, float]:
        """What slopes along x (of motion along y) and along y (along x) turn the footing by:
        shares of the polar moment of inertia."""
        a2, b2 = self.half_x**2, self.half_y**2
        return a2 / (a2 + b2), b2 / (a2 + b2)


@dataclass(frozen=True)
class Disc:
    """A disc (radius in m)."""

    radius: float

    def __post_init__(self) -> None:
        _positive(self.radius)

    def passage(self, k: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See Strip: 2 J1(z)/z and 8 J2(z)/z."""
        from scipy.special import jv

        length = np.hypot(k[:, 0], k[:, 1])
        z = np.maximum(length * self.radius, 1e-9)
        way = k / np.maximum(length, 1e-300)[:, None]
        return 2 * jv(1, z) / z, (8 * jv(2, z) / z / self.radius)[:, None] * way

    def spectra(self, decay: FloatArray, k: FloatArray) -> FloatArray:
        """See Strip."""
        length = np.hypot(k[:, 0], k[:, 1])
        way = k / np.maximum(length, 1e-300)[:, None]
        pairs = np.stack([decay, length], axis=1) * self.radius
        mean, even, odd, cross = _integrated(_disc_integrand, pairs, np.array([1.0, 4, 4, 2])).T
        turned = way[:, 0] ** 2 - way[:, 1] ** 2
        r = self.radius
        columns = [mean, (even - odd * turned) / r**2, (even + odd * turned) / r**2]
        return np.stack([*columns, cross * way[:, 0] / r, cross * way[:, 1] / r], axis=1)

    def torsion(self) -> tuple[float, float]:
        """See Rectangle."""
        return 0.5, 0.5


Footing = Strip | Rectangle | Disc


def factors(footing: Footing, decay: FloatArray, k: FloatArray) -> Factors:
    """Motion of a rigid footing on a ground whose motion differs below it.

    Parameters
    ----------
    footing : Footing
    decay : array (n,)
        gamma w / Vs, 1/m.
    k : array (n, 2)
        Wave numbers along x and y, w / V times the direction of the way, 1/m.
    """
    mean, slopes = footing.passage(k)
    coherence = (np.abs(slopes) > 0).astype(float)
    some = decay > 0
    if np.any(some):
        spectra = np.maximum(footing.spectra(decay[some], k[some]), [0, 0, 0, -np.inf, -np.inf])
        roots = np.sqrt(spectra[:, :3])
        both = roots[:, :1] * roots[:, 1:]
        share = np.abs(spectra[:, 3:]) / np.where(both > 0, both, 1.0)
        coherence[some] = np.minimum(np.where(both > 0, share, 0.0), 1.0)
        mean[some] = np.where(mean[some] < 0, -1, 1) * roots[:, 0]
        slopes[some] = np.where(slopes[some] < 0, -1, 1) * roots[:, 1:]
    return Factors(mean, slopes, coherence)


@dataclass(frozen=True)
class Filtered:
    """Records of the footing: translation (n,), slopes (n, 2) in 1/m, and what was cut off.

    Attributes
    ----------
    lost : float
        Largest translation before the record begins, over the largest of all.
    early : float
        Seconds by which the translation begins before the record.
    """

    mean: FloatArray
    slopes: FloatArray
    lost: float
    early: float


#: share of the peak above which a record has begun
BEGUN = 0.01


def filtered(record: FloatArray, step: float, at: Callable[[FloatArray], Factors]) -> Filtered:
    """Translation and slopes of the footing from the motion at its centre.

    Parameters
    ----------
    record : array (n,)
        Motion by equal steps, at rest before and behind.
    step : float
        s.
    at : callable
        Factors at frequencies (Hz).

    Notes
    -----
    By Fourier's transform, as long a rest put behind as the record lasts. What the footing does
    before the record's first instant stands at the end of that rest.
    """
    n = len(record)
    size = 1 << int(np.ceil(np.log2(2 * n)))
    frequencies = np.arange(size // 2 + 1) / (size * step)
    spectrum = np.fft.rfft(record, size)
    of = at(frequencies)
    mean = np.fft.irfft(spectrum * of.mean, size)
    slopes = [np.fft.irfft(-1j * spectrum * of.slopes[:, i], size)[:n] for i in range(2)]
    before = np.abs(mean[size - (size - n) // 2 :])
    largest = float(np.abs(mean).max()) or 1.0
    begun = np.flatnonzero(before > BEGUN * largest)
    early = float(len(before) - begun[0]) * step if len(begun) else 0.0
    lost = float(before.max(initial=0.0)) / largest
    return Filtered(mean[:n], np.stack(slopes, axis=1), lost, early)


def _positive(*lengths: float) -> None:
    if not all(length > 0 for length in lengths):
        raise MaterialError("kernel.waves.footing-not-positive")


def _line(z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A wave over a line of half length 1: sin(z)/z, and its slope 3 (sin z - z cos z)/z^2."""
    from scipy.special import spherical_jn

    mean, slope = spherical_jn(0, np.abs(z)), 3 * spherical_jn(1, np.abs(z))
    return mean, np.where(z < 0, -slope, slope)


def _line_spectra(decay: FloatArray, z: FloatArray) -> FloatArray:
    """Mean, slope and both (n, 3) of a line of half length 1; z its wave number."""
    pairs = np.stack([decay, z], axis=1)
    return _integrated(_line_integrand, pairs, np.array([1.0, 3, 1]))


def _line_integrand(u: FloatArray, decay: FloatArray, z: FloatArray) -> list[FloatArray]:
    """Integrands (n, points) over u from 0 to 1, the distance being s = 2 u.

    What two lines shifted by s have in common is 2 m long, m = 1 - u, and the product of both
    positions about its middle p is p^2 - u^2, whose integral is 2/3 m^3 - 2 m u^2. Its mean over
    all shifts is zero: 1 is taken from the coherency, so that slow motion keeps its digits.
    """
    s, m = 2 * u, 1 - u
    less = np.expm1(-((decay * s) ** 2))
    bell, angle = 1 + less, z * s
    mean = 2 * m * bell * np.cos(angle)
    reduced = less * np.cos(angle) - 2 * np.sin(angle / 2) ** 2
    slope = 9 * (2 * m**3 / 3 - 2 * m * u**2) * reduced
    return [mean, slope, 6 * u * m * bell * np.sin(angle)]


def _disc_integrand(u: FloatArray, decay: FloatArray, z: FloatArray) -> list[FloatArray]:
    """Integrands (n, points) over u from 0 to 1, for radius 1.

    The distance is r = 2 cos(a), a = pi u / 2 being half the angle of what two discs shifted by r
    have in common: twice a segment, whose area and second moments about its chord (`along` the
    shift) and across it are textbook ones (Bronstein). Directions of the shift are integrated to
    Bessel's functions. The slope along a direction is `even` less `odd` times the cosine of twice
    its angle to the wave's way.
    """
    from scipy.special import jv

    a = np.pi * u / 2
    sin, cos = np.sin(a), np.cos(a)
    sector, cube = a - sin * cos, sin**3
    area = 2 * sector
    across = (3 * sector - 2 * cube * cos) / 6
    from_centre = (sector + 2 * cube * cos) / 4
    along = 2 * (from_centre - 4 * cos * cube / 3 + cos**2 * sector) - cos**2 * area
    r = 2 * cos
    jacobian = np.pi * sin * r  # r dr
    less, x = np.expm1(-((decay * r) ** 2)), z * r
    bell, j0 = 1 + less, jv(0, x)
    reduced = less * j0 + np.where(np.abs(x) < 0.1, _j0_less_one(x), j0 - 1)
    mean = 2 / np.pi * area * bell * j0 * jacobian
    even = 16 / np.pi * (along + across) * reduced * jacobian
    odd = 16 / np.pi * (along - across) * bell * jv(2, x) * jacobian
    return [mean, even, odd, 4 / np.pi * r * area * bell * jv(1, x) * jacobian]


def _j0_less_one(x: FloatArray) -> FloatArray:
    q = x * x / 4
    return -q * (1 - q / 4 * (1 - q / 9 * (1 - q / 16)))


Integrand = Callable[[FloatArray, FloatArray, FloatArray], list[FloatArray]]


def _integrated(integrand: Integrand, pairs: FloatArray, scale: FloatArray) -> FloatArray:
    """Integrals (n, columns) over 0 to 1 by rules that double until they agree.

    Parameters
    ----------
    integrand : callable
        Of points (points,), decays and wave numbers (n, 1).
    pairs : array (n, 2)
        Decays and wave numbers.
    scale : array (columns,)
        What the integrals are of the order of, for rounding.
    """
    result = np.empty((len(pairs), len(scale)))
    left = np.arange(len(pairs))
    count, before = FIRST, _by_rule(integrand, pairs, FIRST, len(scale))
    while len(left):
        count *= 2
        if count > LAST:
            raise MaterialError("kernel.waves.footing-too-wide", extent=float(pairs[left].max()))
        now = _by_rule(integrand, pairs[left], count, len(scale))
        # the larger ones of a row bear the rounding of the small ones
        wrong = np.abs(now - before) > RELATIVE * np.abs(now) + ABSOLUTE * scale
        done = ~np.any(wrong, axis=1)
        result[left[done]] = now[done]
        left, before = left[~done], now[~done]
    return result


def _by_rule(integrand: Integrand, pairs: FloatArray, count: int, columns: int) -> FloatArray:
    nodes, weights = np.polynomial.legendre.leggauss(count)
    points, weights = (nodes + 1) / 2, weights / 2
    result = np.empty((len(pairs), columns))
    rows = max(1, AT_ONCE // count)
    for start in range(0, len(pairs), rows):
        part = pairs[start : start + rows]
        of = integrand(points, part[:, :1], part[:, 1:])
        result[start : start + rows] = np.stack([values @ weights for values in of], axis=1)
    return result
