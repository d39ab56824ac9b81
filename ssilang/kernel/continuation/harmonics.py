"""Harmonic balance: a periodic motion as a Fourier series, nonlinear forces by way of time.

`M q'' + C q' + K q = f(q, q') + F(w t)` with `q = Q_0 + sum_k Q_k cos k w t + P_k sin k w t`
becomes `Z(w) Q - F_nl(Q) - F = 0`. Coefficients are arrays (2 H + 1, n): 0, cos 1, sin 1, cos 2 ...
Nonlinear forces are sampled over one period (Cameron and Griffin 1989).

Forces of links at instants of a period, with their derivatives by small differences.

Stability of periodic motions: Floquet exponents, and what becomes of a branch.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.modal.link_laws import (
    COSINE_OF_TIME,
    FRICTION,
    PLASTIC,
    RECORDS,
    SINE_OF_TIME,
    STATES,
    TANGENT,
    LinkArrays,
    link_forces,
)

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


@dataclass(frozen=True, eq=False)
class Basis:
    """H harmonics at N instants of one period."""

    harmonics: int
    values: FloatArray  # (N, 2 H + 1) 1, cos k theta, sin k theta and their derivatives in theta
    rates: FloatArray
    back: FloatArray  # (2 H + 1, N) from samples to coefficients


def basis_at(harmonics: int, angles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values and rates (N, 2 H + 1) at angles (N,)."""
    values, rates = [np.ones_like(angles)], [np.zeros_like(angles)]
    for k in range(1, harmonics + 1):
        c, s = np.cos(k * angles), np.sin(k * angles)
        values += [c, s]
        rates += [-k * s, k * c]
    return np.stack(values, axis=1), np.stack(rates, axis=1)


def basis_of(harmonics: int, samples: int) -> Basis:
    """The basis at equal instants of one period."""
    values, rates = basis_at(harmonics, 2 * np.pi * np.arange(samples) / samples)
    weights = np.full(2 * harmonics + 1, 2.0)
    weights[0] = 1.0
    return Basis(harmonics, values, rates, weights[:, None] * values.T / samples)


class Forces(Protocol):
    """Nonlinear forces at instants."""

    def at(self, q: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """f (N, n), df/dq and df/dv (N, n, n) at motions q and velocities v (N, n)."""


def derivative_matrix(harmonics: int) -> FloatArray:
    """D with `(D Q)` the coefficients of the derivative in theta (2 H + 1, 2 H + 1)."""
    D = np.zeros((2 * harmonics + 1, 2 * harmonics + 1))
    for k in range(1, harmonics + 1):
        D[2 * k - 1, 2 * k], D[2 * k, 2 * k - 1] = k, -k
    return D


@dataclass(frozen=True, eq=False)
class Oscillators:
    """M, C, K (n, n) and the forces of `M q'' + C q' + K q = f(q, q') + F`."""

    M: FloatArray
    C: FloatArray
    K: FloatArray
    basis: Basis
    forces: Forces
    load: FloatArray  # (2 H + 1, n) coefficients of F; times w^2 where `unbalance`
    unbalance: bool = False

    @property
    def size(self) -> int:
        """Coefficients in all."""
        return int(self.load.size)

    def linear(self, w: float) -> tuple[FloatArray, FloatArray]:
        """Z(w) and dZ/dw on the coefficients in their order (size, size)."""
        D = derivative_matrix(self.basis.harmonics)
        one, square = np.eye(len(D)), D @ D
        Z = np.kron(one, self.K) + w * np.kron(D, self.C) + w * w * np.kron(square, self.M)
        return Z, np.kron(D, self.C) + 2 * w * np.kron(square, self.M)

    def sampled(self, Q: FloatArray, w: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """f, df/dq, df/dv at the instants of the basis; Q (2 H + 1, n)."""
        return self.forces.at(self.basis.values @ Q, w * (self.basis.rates @ Q))

    def nonlinear(self, Q: FloatArray, w: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """F_nl (size,), dF_nl/dQ (size, size), dF_nl/dw (size,)."""
        b = self.basis
        f, fq, fv = self.sampled(Q, w)
        tangent = np.einsum("at,tij,tb->aibj", b.back, fq, b.values, optimize=True)
        tangent += w * np.einsum("at,tij,tb->aibj", b.back, fv, b.rates, optimize=True)
        by_w = b.back @ np.einsum("tij,tj->ti", fv, b.rates @ Q)
        n = Q.size
        return (b.back @ f).ravel(), tangent.reshape(n, n), by_w.ravel()

    def at(self, u: FloatArray, t: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Residual, its derivatives in the coefficients and in w = t."""
        Z, Zw = self.linear(t)
        F, J, Fw = self.nonlinear(u.reshape(self.load.shape), t)
        load, by_w = self.load.ravel(), np.zeros(self.size)
        if self.unbalance:
            load, by_w = t * t * load, 2 * t * load
        return Z @ u - F - load, Z - J, Zw @ u - Fw - by_w

    def force(self, t: float) -> float:
        """Size of the load."""
        return float(np.linalg.norm(self.load)) * (t * t if self.unbalance else 1.0)

    def exponents(self, Q: FloatArray, w: float) -> FloatArray:
        """Floquet exponents (2 n,) of the motion."""
        _, fq, fv = self.sampled(Q, w)
        return exponents(self.M, self.C - fv, self.K - fq, w)


SMALL = 1e-6
"""Difference over the size of the motion."""


@dataclass(frozen=True, eq=False)
class LinkForces:
    """Links whose forces follow from motion and velocity at the same instant."""

    links: LinkArrays

    def __post_init__(self) -> None:
        table = self.links.numbers
        past = (table[:, PLASTIC] != 0.0) | ((table[:, FRICTION] != 0.0) & (table[:, TANGENT] >= 0))
        if past.any():
            raise KernelError(
                "kernel.continuation.link-remembers-past-plastic",
                past=int(np.flatnonzero(past)[0]) + 1,
            )
        timed = np.isin(self.links.kinds, (COSINE_OF_TIME, SINE_OF_TIME))
        if timed.any():
            raise KernelError(
                "kernel.continuation.link-changes-time-frequency",
                timed=int(np.flatnonzero(timed)[0]) + 1,
            )

    def at(self, q: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """f (N, n), df/dq and df/dv (N, n, n)."""
        k = self.links
        f, (fq, fv) = np.zeros(q.shape), np.zeros((2, *q.shape, q.shape[1]))
        if not len(k.kinds):
            return f, fq, fv
        steps = [SMALL * max(float(np.abs(x).max(initial=0.0)), 1e-9) for x in (q, v)]
        sample_links(
            np.ascontiguousarray(q), np.ascontiguousarray(v), (steps[0], steps[1]), k, f, fq, fv,
        )  # fmt: skip
        return f, fq, fv


@compiled
def sample_links(
    q: FloatArray, v: FloatArray, steps: tuple[float, float], links: LinkArrays,
    f: FloatArray, fq: FloatArray, fv: FloatArray,
) -> None:  # fmt: skip
    """Fill f, fq and fv: central differences by `steps` of q and v, an instant after the other."""
    count, n = q.shape
    up, down = np.zeros(n), np.zeros(n)
    state = np.zeros((len(links.kinds), STATES))
    record = np.zeros((len(links.kinds), RECORDS))
    for i in range(count):
        x, y = q[i].copy(), v[i].copy()
        state[:] = 0.0
        link_forces(x, y, 0.0, links, state, record, up)
        for m in range(n):
            f[i, m] = up[m]
        for j in range(n):
            for which in range(2):
                moved = x if which == 0 else y
                h = steps[which]
                old = moved[j]
                moved[j] = old + h
                state[:] = 0.0
                link_forces(x, y, 0.0, links, state, record, up)
                moved[j] = old - h
                state[:] = 0.0
                link_forces(x, y, 0.0, links, state, record, down)
                moved[j] = old
                for m in range(n):
                    slope = (up[m] - down[m]) / (2.0 * h)
                    if which == 0:
                        fq[i, m, j] = slope
                    else:
                        fv[i, m, j] = slope
