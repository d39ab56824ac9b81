"""The problem of harmonic balance on expanded matrices, nonlinear forces given by samples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.continuation.harmonics import Basis
from ssilang.kernel.matrices.assembly import Numbering
from ssilang.kernel.stepping.problem.loading import Loading

Samples = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Forces (N, m) and the derivatives of -f (N, m, m) at motions (N, m) of a few unknowns."""
CURVE_STEP = 1e-6


@dataclass(eq=False)
class FrequencyProblem:
    """`Z(w(t)) U - F_nl(U) - F(t) = 0` on the coefficients U = T q that supports leave.

    Attributes
    ----------
    K, C, M : csr arrays (n, n)
        `Z = K + w C + w^2 M`.
    T : csr array (n, r)
    loading : Loading
        F in pseudo-time.
    frequency : callable
        w of t.
    places : array (2 H + 1, m)
        Where the coefficients of the unknowns with nonlinear forces stand in U.
    samples : callable or None
    """

    numbering: Numbering
    K: sp.csr_array
    C: sp.csr_array
    M: sp.csr_array
    T: sp.csr_array
    loading: Loading
    frequency: Callable[[float], float]
    basis: Basis
    places: IntArray
    samples: Samples | None = None
    size: float = 0.0
    parts: tuple[FloatArray, FloatArray, FloatArray] = field(init=False)

    def __post_init__(self) -> None:
        T = self.T
        K, C, M = (np.asarray((T.T @ A @ T).toarray()) for A in (self.K, self.C, self.M))
        self.parts = (K, C, M)

    def load(self, t: float) -> FloatArray:
        """F at t on the motions that supports leave (r,)."""
        found: FloatArray = self.T.T @ (self.loading.forces @ self.loading.at(np.array([t]))[0])
        return found

    def _slopes(self, t: float) -> tuple[FloatArray, float]:
        h = CURVE_STEP * max(abs(t), 1e-3)
        load = (self.load(t + h) - self.load(t - h)) / (2 * h)
        return load, (self.frequency(t + h) - self.frequency(t - h)) / (2 * h)

    def at(self, u: FloatArray, t: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Residual and derivatives in q (r,) and t."""
        K, C, M = self.parts
        w = self.frequency(t)
        Z = K + w * C + w * w * M
        load, (load_rate, rate) = self.load(t), self._slopes(t)
        linear = Z @ u
        R, J = linear - load, Z
        if self.samples is not None:
            force, tangent = self._nonlinear(u)
            R, J = R - force, Z + tangent
        self.size = max(float(np.linalg.norm(load)), float(np.linalg.norm(linear)))
        return R, J, rate * ((C + 2 * w * M) @ u) - load_rate

    def coefficients(self, u: FloatArray) -> FloatArray:
        """Coefficients (2 H + 1, m) of the unknowns with nonlinear forces."""
        return np.asarray((self.T @ u)[self.places])

    def sampled(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Forces and stiffnesses at the instants of the basis."""
        assert self.samples is not None
        return self.samples(self.basis.values @ self.coefficients(u))

    def _nonlinear(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        f, k = self.sampled(u)
        b, n = self.basis, self.T.shape[0]
        force = np.zeros(n)
        np.add.at(force, self.places, b.back @ f)
        block = np.einsum("at,tij,tb->aibj", b.back, k, b.values, optimize=True)
        at = self.places.ravel()
        rows, columns = np.repeat(at, len(at)), np.tile(at, len(at))
        tangent = sp.csr_array((block.ravel(), (rows, columns)), shape=(n, n))
        return self.T.T @ force, np.asarray((self.T.T @ tangent @ self.T).toarray())

    def force(self, t: float) -> float:
        """Size of the forces of the last residual."""
        return self.size
