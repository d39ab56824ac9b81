"""Stability of periodic motions: Floquet exponents, and what becomes of a branch."""

from functools import lru_cache

import numpy as np

from ssilang.kernel.base.arrays import FloatArray

FINE = 128
"""Intervals of a period at least."""
ONE = 1e-7
"""Real part over the frequency, below which an exponent is taken for zero."""


def interpolated(samples: FloatArray, angles: FloatArray) -> FloatArray:
    """A periodic function (N, ...) given at equal instants, at angles (m,): trigonometric."""
    return np.tensordot(interpolation(len(samples), tuple(angles)), samples, axes=(1, 0))


@lru_cache(maxsize=16)
def interpolation(count: int, angles: tuple[float, ...]) -> FloatArray:
    """Weights (m, count) of equal samples of a period in their interpolation at angles (m,)."""
    k = np.arange(count // 2 + 1)
    weights = np.where((k == 0) | (2 * k == count), 1.0, 2.0) / count
    phase = np.asarray(angles)[:, None] - 2 * np.pi * np.arange(count) / count
    return np.asarray(np.cos(phase[..., None] * k) @ weights)


def monodromy(M: FloatArray, C: FloatArray, K: FloatArray, w: float) -> FloatArray:
    """What one period 2 pi/w makes of a perturbation (q, q'), (2 n, 2 n).

    Parameters
    ----------
    M : array (n, n)
    C, K : array (N, n, n)
        Tangent damping and stiffness at equal instants of the period.

    Notes
    -----
    Fourth-order Magnus steps, each exponential by its rational approximation of order (3, 3).
    """
    n, steps = len(M), max(FINE, len(K))
    h = 2 * np.pi / (w * steps)
    edges = 2 * np.pi * np.arange(steps) / steps
    spread = np.sqrt(3.0) / 6.0
    inverse = np.asarray(np.linalg.inv(M))
    A = []
    for offset in (0.5 - spread, 0.5 + spread):
        angles = edges + offset * 2 * np.pi / steps
        matrix = np.zeros((steps, 2 * n, 2 * n))
        matrix[:, :n, n:] = np.eye(n)
        matrix[:, n:, :n] = -inverse @ interpolated(K, angles)
        matrix[:, n:, n:] = -inverse @ interpolated(C, angles)
        A.append(matrix)
    omega = 0.5 * h * (A[0] + A[1]) + np.sqrt(3.0) / 12.0 * h * h * (A[1] @ A[0] - A[0] @ A[1])
    total = np.eye(2 * n)
    one = np.eye(omega.shape[-1])  # for the exponential, by Pade's approximant
    square = omega @ omega
    even, odd = one + square / 10.0, 0.5 * omega + omega @ square / 120.0
    for factor in np.asarray(np.linalg.solve(even - odd, even + odd), dtype=np.float64):
        total = factor @ total
    return total


def exponents(M: FloatArray, C: FloatArray, K: FloatArray, w: float) -> FloatArray:
    """Floquet exponents (2 n,), complex, by falling real part."""
    multipliers = np.linalg.eigvals(monodromy(M, C, K, w))
    size = np.maximum(np.abs(multipliers), 1e-300)
    found = (np.log(size) + 1j * np.angle(multipliers)) * w / (2 * np.pi)
    return np.asarray(found[np.lexsort((-found.imag, -found.real))])


def unstable(found: FloatArray, w: float) -> bool:
    """Whether a motion with these exponents is."""
    return bool((found.real > ONE * w).any())


def crossing(before: FloatArray, after: FloatArray, w: tuple[float, float]) -> str:
    """How exponents cross the imaginary axis: BP (at 0), PD (at w/2), NS (a pair); '' if none.

    Parameters
    ----------
    before, after : array (2 n,)
        Exponents of two neighbours, whose frequencies are `w`.
    """
    grown = [e[e.real > ONE * s] for e, s in zip((before, after), w, strict=True)]
    if len(grown[0]) == len(grown[1]):
        return ""
    which = 0 if len(grown[0]) > len(grown[1]) else 1
    found = grown[which][int(np.argmin(np.abs(grown[which].real)))]
    near = 1e-3 * w[which]
    if abs(found.imag) < near:
        return "BP"
    return "PD" if abs(abs(found.imag) - 0.5 * w[which]) < near else "NS"
