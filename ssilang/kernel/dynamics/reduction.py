"""Bases of a few vectors for the linear part of a problem, that leave its interface as it is.

The vectors are those of a block rational Krylov space: initial displacement, velocity and
acceleration; static answers to the loads and to the interface's forces; answers of the step's own
matrix; then powers of `(K + sigma M)^-1 M` applied to the same loads and forces. In the space, M, K
and a Rayleigh damping become diagonal together (Galerkin), so a step costs a few products with
the interface's rows.

References: A. Ruhe (1984), rational Krylov; R. W. Freund (2004), structure-preserving projection;
block orthogonalisation by two passes of Gram-Schmidt.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.dynamics.initial import (
    admissible_velocity,
    initial_acceleration,
    joint_state,
)
from ssilang.kernel.dynamics.problem import Problem
from ssilang.kernel.errors import KernelError
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.solvers.inverse import Inverse, invert
from ssilang.kernel.sparse import sp

DEPENDENT = 1e-12
"""Squared length, of one, below which what is left of a vector is rounding: it is dropped."""
PROPORTIONAL = 1e-10  # damping that differs less than this from a Rayleigh one is one
SHIFT = 4.0  # times the lowest frequency: the shift sqrt(sigma) of the Krylov space, 1/s
HIGHEST_SHIFT = 0.25  # of 2/dt


@dataclass(frozen=True, eq=False)
class ReducedModel:
    """A problem on r coordinates q, `u = V q` with `V = T basis^T X`.

    Attributes
    ----------
    T : csr array (n, n_y)
        Motions that the supports leave.
    basis : array (r, n_y)
        One vector a row.
    X : array (r, r)
        From diagonal coordinates to the basis.
    m, c, k : arrays (r,)
        Diagonals of mass, damping and stiffness.
    J : array (n_interface, r)
        Jumps of the interface.
    forces : array (r, n_loads)
    start : array (r, 3)
        Displacement, velocity and acceleration at the start.
    """

    T: sp.csr_array
    basis: FloatArray
    X: FloatArray
    m: FloatArray
    c: FloatArray
    k: FloatArray
    J: FloatArray
    forces: FloatArray
    start: FloatArray

    @property
    def size(self) -> int:
        """Number r of vectors."""
        return len(self.m)

    def expand(self, q: FloatArray) -> FloatArray:
        """Whole fields (n, k) of coordinates (r, k)."""
        return self.whole(self.X @ q)

    def whole(self, z: FloatArray) -> FloatArray:
        """Whole fields (n, k) of combinations (r, k) of the basis."""
        found: FloatArray = self.T @ (self.basis.T @ z)
        return found


@dataclass(frozen=True)
class Reduction:
    """What a reduced run says of itself.

    Attributes
    ----------
    vectors : int
        0 if the whole model was run.
    estimate : float
        Estimated error of displacements and jumps, relative to the largest.
    refused : str
        Why the whole model was run.
    prepared : float
        Seconds spent on bases that did not give the result, and on building it.
    velocity, acceleration : float
        The same difference of velocities and accelerations, which no tolerance holds: they
        follow higher frequencies and converge more slowly.
    """

    vectors: int = 0
    estimate: float = math.nan
    refused: str = ""
    prepared: float = 0.0
    velocity: float = math.nan
    acceleration: float = math.nan


class NoReduction(Exception):
    """Why a problem that could be reduced is not: the whole model runs instead."""


def refuse_reduction(problem: Problem) -> None:
    """Refuse what reduced models do not do.

    Raises
    ------
    KernelError
        For unilateral relations, supports that move, adaptive or conserving steps.
    """
    hint = "leave 'REDUCTION'"
    if problem.contact is not None:
        raise KernelError(
            "'REDUCTION' does not take unilateral relations (MINI, MAXI)",
            hint + ", or describe contact by joints (JOINT_SDM)",
        )
    if not problem.constraints.associated:
        raise KernelError("'REDUCTION' does not take non-associated relations (DUAL)", hint)
    if problem.loading.imposed.any() or np.any(problem.constraints.C @ problem.u):
        raise KernelError(
            "'REDUCTION' does not take imposed displacements (DIMP): supports must stay still",
            hint + ", or shake the model by inertia forces in the frame of its base",
        )
    if problem.scheme.conserving or problem.scheme.adaptive:
        raise KernelError("'REDUCTION' goes with neither 'CONSERVATIF' nor 'PAS_ADAPTE'", hint)


def rayleigh(problem: Problem) -> tuple[float, float]:
    """alpha, beta of `C = alpha M + beta K`.

    Raises
    ------
    NoReduction
        If the damping is no such sum (dashpots, different materials).
    """
    if problem.C.nnz == 0 or not problem.C.data.any():
        return 0.0, 0.0
    A = [
        sp.csr_array(problem.constraints.T.T @ X @ problem.constraints.T)
        for X in _matrices(problem)
    ]
    K, M, C = A
    size = [float(np.sqrt((X.multiply(X)).sum())) or 1.0 for X in A]
    km = float(K.multiply(M).sum()) / (size[0] * size[1])
    right = [float(C.multiply(M).sum()) / size[1], float(C.multiply(K).sum()) / size[0]]
    gram = np.array([[1.0 if M.nnz else 0.0, km], [km, 1.0]])
    found = np.linalg.lstsq(gram, np.array(right), rcond=None)[0]
    alpha, beta = float(found[0] / size[1]), float(found[1] / size[0])
    rest = sp.csr_array(C - alpha * M - beta * K)
    largest = float(abs(C).max())
    if float(abs(rest).max()) > PROPORTIONAL * largest:
        raise NoReduction("the damping is not alpha M + beta K")
    return alpha, beta


def _matrices(problem: Problem) -> tuple[sp.csr_array, sp.csr_array, sp.csr_array]:
    return problem.K, problem.M, problem.C


class Basis:
    """A growing basis, on the motions y that the supports leave (`u = T y`).

    Vectors are orthonormal in `N = M + K / s**2`, which is regular also where M alone is not.
    """

    def __init__(self, problem: Problem, dt: float, largest: int) -> None:
        T = problem.constraints.T
        self.problem, self.T = problem, T
        self.alpha, self.beta = rayleigh(problem)
        self.K, self.M = (sp.csr_array(T.T @ X @ T) for X in (problem.K, problem.M))
        joints = problem.interface
        ports = sp.csr_array((0, T.shape[1])) if joints is None else sp.csr_array(joints.J @ T)
        self.J, self.F = ports, np.asarray(T.T @ problem.loading.forces)
        self.inputs = np.column_stack([ports.T.toarray(), self.F])
        self._store = np.zeros((largest, T.shape[1]))  # one vector a row
        self._KV = np.zeros((largest, largest))
        self.size = self._fixed = 0
        static = self._static()
        s = self.shift = min(HIGHEST_SHIFT * 2.0 / dt, SHIFT * self._lowest(static))
        self.N = sp.csr_array(self.M + self.K / s**2)
        self._inverse = self._inverted(s**2)
        self._last = np.zeros((T.shape[1], 0))
        self._start = self._initial()
        self._first_vectors(static, 2.0 / dt)

    @property
    def vectors(self) -> FloatArray:
        """The basis, one vector a row."""
        return self._store[: self.size]

    def _inverted(self, sigma: float) -> Inverse:
        inverse = invert(sp.csr_array(self.K + sigma * self.M), True)
        if inverse.singular:
            raise NoReduction("a body without mass is held by joints alone")
        return inverse

    def _initial(self) -> FloatArray:
        """Displacement, velocity, acceleration at the start on the motions y, (n_y, 3)."""
        p = self.problem
        v = admissible_velocity(p)
        a = initial_acceleration(p, v, joint_state(p))
        fields = np.column_stack([p.u, v, a])
        gram = invert(sp.csr_array(self.T.T @ self.T), True)
        found: FloatArray = gram.solve(self.T.T @ fields)
        return found

    def _static(self) -> Inverse:
        """Inverse of the stiffness with closed joints."""
        joints, closed = self.problem.interface, self.K
        if joints is not None:
            R = sp.csr_array(joints.closed_stiffness())
            closed = sp.csr_array(closed + self.J.T @ R @ self.J)
        return invert(closed, True)

    def _lowest(self, static: Inverse) -> float:
        """About the lowest frequency with closed joints, rad/s; infinite if a body is free."""
        if static.singular or self.inputs.shape[1] == 0:
            return math.inf
        x = self.inputs @ np.random.default_rng(0).standard_normal(self.inputs.shape[1])
        size = 0.0
        for _ in range(6):
            x = static.solve(self.M @ x if size else x)
            size = float(np.sqrt(x @ (self.M @ x)))
            if not size > 0.0:
                return math.inf
            x = x / size
        return 1.0 / math.sqrt(size)

    def _first_vectors(self, static: Inverse, rate: float) -> None:
        """Initial fields; static answers (joints closed), answers of the step's matrix."""
        self._add(self._start[:, self._start.any(axis=0)])
        if not static.singular:
            self._add(static.solve(self.inputs))
        self._add(self._inverted(rate**2).solve(self.inputs))
        self._fixed = self.size
        self._last = self._add(self._inverse.solve(self.inputs))

    def grow(self) -> None:
        """One more power of the Krylov space."""
        if self._last.shape[1] == 0:
            return
        self._last = self._add(self._inverse.solve(self.M @ self._last))

    def _add(self, W: FloatArray) -> FloatArray:
        """Orthonormalise W (n_y, b) against the basis and itself, append; the new vectors.

        A first pass takes off what exact arithmetic leaves: the parts along the first vectors and
        the last two blocks (the Krylov operator is symmetric in N); a second one takes off the
        rounding along all.
        """
        W = W / np.sqrt(np.maximum(np.einsum("ij,ij->j", W, self.N @ W), 1e-300))
        V, late = self.vectors, max(self.size - 2 * W.shape[1], self._fixed)
        NW = self.N @ W
        for part in (V[: self._fixed], V[late:]):
            W = W - part.T @ (part @ NW)
        W = _whiten(W, self.N)
        W = W - V.T @ (V @ (self.N @ W))
        W = _whiten(W, self.N)
        r, b = self.size, W.shape[1]
        if r + b > len(self._store):
            raise NoReduction(f"{len(self._store)} vectors do not reach the tolerance")
        self._store[r : r + b] = W.T
        part = self._store[: r + b] @ (self.K @ W)
        self._KV[: r + b, r : r + b] = part
        self._KV[r : r + b, : r + b] = part.T
        self.size = r + b
        return W

    def model(self) -> ReducedModel:
        """The problem on the space of the basis, in diagonal coordinates."""
        import scipy.linalg as la

        r, V = self.size, self.vectors
        values, X = la.eigh(self._KV[:r, :r])
        k = np.maximum(values, 0.0)
        m = np.maximum(1.0 - k / self.shift**2, 0.0)  # m + k / s**2 = 1: the vectors' length
        J, F, start = self.J @ V.T, V @ self.F, V @ (self.N @ self._start)
        return ReducedModel(
            self.T, V, X, m, self.alpha * m + self.beta * k, k, np.ascontiguousarray(J @ X),
            X.T @ F, X.T @ start,
        )  # fmt: skip


def _whiten(W: FloatArray, N: sp.csr_array) -> FloatArray:
    """Orthonormal in N; directions that are rounding are dropped."""
    gram = W.T @ (N @ W)
    values, vectors = np.linalg.eigh(0.5 * (gram + gram.T))
    kept = values > DEPENDENT
    found: FloatArray = (W @ vectors[:, kept]) / np.sqrt(values[kept])
    return found
