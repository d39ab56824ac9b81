"""Nonlinear normal modes: periodic free motions of a conservative system, by their energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.continuation.harmonics import Oscillators, derivative_matrix

GAUSS = 12


@dataclass(frozen=True, eq=False)
class FreeMotion:
    """Unknowns: coefficients, frequency w and a damping that comes out zero; parameter: energy.

    The phase is fixed by the first sine of the mode that starts the branch.
    """

    oscillators: Oscillators
    mode: int

    def split(self, u: FloatArray) -> tuple[FloatArray, float, float]:
        """Coefficients (2 H + 1, n), w, the added damping."""
        return u[:-2].reshape(self.oscillators.load.shape), float(u[-2]), float(u[-1])

    def at(self, u: FloatArray, t: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Residual and its derivatives in u and in the energy t."""
        o = self.oscillators
        Q, w, added = self.split(u)
        n = Q.size
        Z, Zw = o.linear(w)
        F, J, Fw = o.nonlinear(Q, w)
        D = np.kron(derivative_matrix(o.basis.harmonics), o.M)
        R, jacobian, by_t = np.zeros(n + 2), np.zeros((n + 2, n + 2)), np.zeros(n + 2)
        q = Q.ravel()
        R[:n] = Z @ q - F + added * w * (D @ q)
        jacobian[:n, :n] = Z - J + added * w * D
        jacobian[:n, n] = Zw @ q - Fw + added * (D @ q)
        jacobian[:n, n + 1] = w * (D @ q)
        place = 2 * Q.shape[1] + self.mode
        R[n], jacobian[n, place] = q[place], 1.0
        value, slopes, by_w = self.energy(Q, w)
        R[n + 1], by_t[n + 1] = value - t, -1.0
        jacobian[n + 1, :n], jacobian[n + 1, n] = slopes.ravel(), by_w
        return R, jacobian, by_t

    def energy(self, Q: FloatArray, w: float) -> tuple[float, FloatArray, float]:
        """Kinetic, elastic and that of the links at the first instant; derivatives in Q and w.

        The links' energy is their work on the straight way from rest (Gauss points).
        """
        o = self.oscillators
        row, rate = o.basis.values[0], o.basis.rates[0]
        q, v = row @ Q, w * (rate @ Q)
        x, weights = np.polynomial.legendre.leggauss(GAUSS)
        shares, weights = 0.5 * (x + 1.0), 0.5 * weights
        f, fq, _ = o.forces.at(shares[:, None] * q, np.zeros((GAUSS, len(q))))
        stored = -float(weights @ (f @ q))
        pull = -(weights @ f) - np.einsum("t,t,tij,i->j", weights, shares, fq, q)
        value = 0.5 * float(v @ o.M @ v + q @ o.K @ q) + stored
        slopes = np.outer(row, o.K @ q + pull) + w * np.outer(rate, o.M @ v)
        return value, slopes, float((rate @ Q) @ o.M @ v)

    def force(self, t: float) -> float:
        """Size of the forces at play."""
        return float(np.sqrt(2.0 * abs(t) * np.abs(self.oscillators.K).max()))

    def guess(self, energy: float) -> FloatArray:
        """The linear mode with this energy."""
        import scipy.linalg as la

        o = self.oscillators
        squares, shapes = la.eigh(o.K, o.M)
        own = int(np.argmax(np.abs(shapes[self.mode])))
        w = float(np.sqrt(max(squares[own], 0.0)))
        Q = np.zeros(o.load.shape)
        Q[1] = shapes[:, own] * np.sqrt(2.0 * energy) / w
        return np.concatenate([Q.ravel(), [w, 0.0]])
