"""Bases of a few vectors for the linear part of a problem, that leave its interface as it is.

The vectors are those of a block rational Krylov space: initial displacement, velocity and
acceleration; static answers to the loads and to the interface's forces; answers of the step's own
matrix; then powers of `(K + sigma M)^-1 M` applied to the same loads and forces, or of the damped
operator (see `reduced_damping`). In the space, M, K and a Rayleigh damping become diagonal together
(Galerkin), so a step costs a few products with the interface's rows, and with those of dashpots.

References: A. Ruhe (1984), rational Krylov; R. W. Freund (2004), structure-preserving projection;
block orthogonalisation by two passes of Gram-Schmidt.
"""

import math
from copy import copy
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.scientific import la, sp
from ssilang.kernel.solvers.cholesky.inverse import Inverse, invert
from ssilang.kernel.stepping.problem.initial import (
    admissible_velocity,
    initial_acceleration,
    joint_state,
)
from ssilang.kernel.stepping.problem.moving_supports import MOST, Columns, MovingSupports
from ssilang.kernel.stepping.problem.problem import Problem, closed_stiffness
from ssilang.kernel.stepping.rests.reduced.damping import States, split
from ssilang.kernel.stepping.state import Motion
from ssilang.messages.message import Refusal, Sentence

# Moving supports of a reduced problem: their loads, and the motion that they add.


@dataclass(frozen=True, eq=False)
class ReducedSupports:
    """Supports whose motions `X c(t)` come on top of what the vectors describe."""

    moving: MovingSupports
    columns: Columns  # on the motions y that the supports leave
    start: FloatArray  # (3, m) c, c', c'' at the start

    @property
    def count(self) -> int:
        """Number m of motions."""
        return int(self.columns.X.shape[1])

    def during(self, problem: Problem, dt: float) -> MovingSupports:
        """The same supports in another motion (its scheme, its loads), for steps dt."""
        moving = copy(self.moving)
        moving.problem, moving.dt = problem, dt
        return moving


def reduced_supports(
    problem: Problem, T: sp.csr_array, u: FloatArray, v: FloatArray, a: FloatArray
) -> ReducedSupports | Sentence:
    """The supports of a problem whose motion starts with u, v, a (n,); or why they are too much."""
    dt = float(problem.times[1] - problem.times[0])
    moving = MovingSupports(problem, dt, T)
    if len(moving.chosen) > MOST:
        return Sentence("kernel.stepping.supports-move-by-too-many", most=MOST)
    none, table = np.zeros(0), np.zeros((0, 1))
    motion = Motion(u, v, a, none, none, table, table, table, none, none, none)
    columns, course = moving.begin(motion, problem.loading.at(problem.times[:2]))
    if columns.X.shape[1] > len(moving.chosen):
        return Sentence("kernel.stepping.initial-motion-of-supports")
    start = np.array([course.c[0], course.v[0], course.a[0]])
    return ReducedSupports(moving, columns, start)


DEPENDENT = 1e-12
"""Squared length, of one, below which what is left of a vector is rounding: it is dropped."""
SHIFT = 4.0  # times the lowest frequency: the shift sqrt(sigma) of the Krylov space, 1/s
HIGHEST_SHIFT = 0.25  # of 2/dt


@dataclass(frozen=True, eq=False)
class ReducedModel:
    """A problem on r coordinates q, `u = V q` with `V = T basis^T X`."""

    T: sp.csr_array  # (n, n_y) motions that the supports leave
    basis: FloatArray  # (r, n_y) one vector a row
    X: FloatArray  # (r, r) from diagonal coordinates to the basis
    m: FloatArray  # (r,) diagonal of mass
    c: FloatArray  # (r,) of damping
    k: FloatArray  # (r,) of stiffness
    J: FloatArray  # (n_interface, r) jumps of the interface
    forces: FloatArray  # (r, n_loads + 3 m) last, those of m moving supports
    start: FloatArray  # (r, 3) displacement, velocity and acceleration at the start
    B: FloatArray  # (d, r) dashpots: what of the damping is not in c is `B^T sense B`
    sense: FloatArray  # (d,)
    supports: ReducedSupports

    @property
    def size(self) -> int:
        """Number r of vectors."""
        return len(self.m)

    def expand(self, q: FloatArray) -> FloatArray:
        """Whole fields (n, k) of coordinates (r, k)."""
        return self.whole(self.X @ q)

    def whole(self, z: FloatArray) -> FloatArray:
        """Whole fields (n, k) of combinations (r, k) of the basis."""
        return self.T @ (self.basis.T @ z)


class NoReduction(Refusal):
    """Why a problem that could be reduced is not: the whole model runs instead."""


@dataclass(frozen=True)
class Reduction:
    """What a reduced run says of itself.

    Attributes
    ----------
    vectors : int
        0 if the whole model was run.
    estimate : float
        Estimated error of displacements and jumps, relative to the largest.
    refused : NoReduction or None
        Why the whole model was run.
    prepared : float
        Seconds spent on bases that did not give the result, and on building it.
    velocity, acceleration : float
        The same difference of velocities and accelerations, which no tolerance holds: they
        follow higher frequencies and converge more slowly.
    swing : float
        How far loads that are stronger by the tolerance move the motion, relative to the largest;
        0 where the footings hardly lift.
    """

    vectors: int = 0
    estimate: float = math.nan
    refused: NoReduction | None = None
    prepared: float = 0.0
    velocity: float = math.nan
    acceleration: float = math.nan
    swing: float = 0.0


def refuse_reduction(problem: Problem) -> None:
    """Refuse what reduced models do not do.

    Raises
    ------
    KernelError
        For unilateral and non-associated relations, adaptive or conserving steps.
    """
    if problem.contact is not None:
        raise KernelError("kernel.stepping.reduction-unilateral")
    if not problem.constraints.associated:
        raise KernelError("kernel.stepping.reduction-not-associated")
    if problem.scheme.conserving or problem.scheme.adaptive:
        raise KernelError("kernel.stepping.reduction-steps")


def on_motions(T: sp.csr_array, fields: FloatArray) -> FloatArray:
    """Fields (n, k) that the supports allow on the motions y that they leave, (n_y, k)."""
    return invert(sp.csr_array(T.T @ T), True).solve(T.T @ fields)


class Basis:
    """A growing basis, on the motions y that the supports leave (`u = T y`).

    Vectors are orthonormal in `N = M + K / s**2`, which is regular also where M alone is not.
    """

    _states: States | None = None

    def __init__(self, problem: Problem, dt: float, largest: int) -> None:
        self._project(problem, largest)
        q = self.J.shape[0]
        if min(2 * q, self.T.shape[1]) > largest:  # static answers and the step's own
            raise NoReduction("kernel.stepping.interface-of-too-many", q=q, n_vectors=largest)
        self.meet(problem)
        self.inputs = np.column_stack([self.J.T.toarray(), self.F])
        static = invert(closed_stiffness(problem), True, problem.solver)
        self._make_room(largest, min(HIGHEST_SHIFT * 2.0 / dt, SHIFT * self._lowest(static)))
        self._inverse = self._inverted(self.shift**2)
        self._last = np.zeros((self.T.shape[1], 0))
        self._first_vectors(static, 2.0 / dt)

    def _project(self, problem: Problem, largest: int) -> None:
        """Matrices on the motions."""
        T, joints = problem.constraints.T, problem.interface
        self.problem, self.T = problem, T
        self.K, self.M, C = (sp.csr_array(T.T @ X @ T) for X in (problem.K, problem.M, problem.C))
        damping = split(C, self.M, self.K, largest)
        if damping is None:
            raise NoReduction("kernel.stepping.damping-not-symmetric")
        self.damping = damping
        self.J = sp.csr_array((0, T.shape[1]) if joints is None else joints.J @ T)

    def meet(self, problem: Problem) -> None:
        """Take the loads and the start of a motion."""
        T = self.T
        v = admissible_velocity(problem)
        a = initial_acceleration(problem, v, joint_state(problem))
        supports = reduced_supports(problem, T, problem.u, v, a)
        if isinstance(supports, Sentence):
            raise NoReduction(supports.code, **supports.data)
        self.supports = supports
        forces = T.T @ problem.loading.forces
        self.F = np.hstack([forces, supports.columns.forces.T])
        start = np.column_stack([problem.u, v, a]) - supports.columns.X @ supports.start.T
        self._start = on_motions(T, start)

    def _make_room(self, largest: int, s: float) -> None:
        """Room for vectors that the shift s (1/s) measures."""
        self.shift, self.N = s, sp.csr_array(self.M + self.K / s**2)
        self._store = np.zeros((largest, self.T.shape[1]))  # one vector a row
        self._KV, self._RV = np.zeros((2, largest, largest))
        self.size = self._fixed = 0

    @property
    def vectors(self) -> FloatArray:
        """The basis, one vector a row."""
        return self._store[: self.size]

    def _inverted(self, sigma: float, damped: float = 0.0) -> Inverse:
        """Inverse of `K + sigma M`, and `damped` times the damping that is no sum of these."""
        A = self.K + sigma * self.M
        if damped and self.damping.rest.nnz:
            A = A + damped * self.damping.C
        inverse = invert(sp.csr_array(A), True, self.problem.solver)
        if inverse.singular:
            raise NoReduction("kernel.stepping.massless-body-on-joints")
        return inverse

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
        self._add(self._inverted(rate**2, rate).solve(self.inputs))
        self._fixed = self.size
        if self.damping.rest.nnz:
            self._states = States(self.shift)
            self._inverse = self._inverted(self.shift**2, self.shift)
            self._enter(self._states, self._inverse.solve(self.inputs), None)
            return
        self._last = self._add(self._inverse.solve(self.inputs))

    def _enter(self, states: States, u: FloatArray, old: FloatArray | None) -> None:
        """States with displacements u (n_y, b) made from those of coefficients `old`."""
        self._add(u)
        states.add(self.vectors @ (self.N @ u), old)

    def _grow_damped(self, states: States) -> None:
        s, V, (u, w) = self.shift, self.vectors, states.last
        if u.shape[1] == 0:
            return
        U, W = (V[: len(u)].T @ x for x in (u, w))
        r = self.damping.C @ U + s * (self.M @ (U + W))
        self._enter(states, self._inverse.solve(r), u)

    def grow(self) -> None:
        """One more power of the Krylov space."""
        if self._states is not None:
            self._grow_damped(self._states)
            return
        if self._last.shape[1] == 0:
            return
        self._last = self._add(self._inverse.solve(self.M @ self._last))

    def _add(self, W: FloatArray) -> FloatArray:
        """Orthonormalise W (n_y, b) against the basis and itself, append; the new vectors.

        A first pass takes off what exact arithmetic leaves: the parts along the first vectors and
        the last two blocks (the Krylov operator is symmetric in N, but for the damped one); a
        second one takes off the rounding along all.
        """
        W = W / np.sqrt(np.maximum(np.einsum("ij,ij->j", W, self.N @ W), 1e-300))
        V, late = self.vectors, max(self.size - 2 * W.shape[1], self._fixed)
        late = self._fixed if self._states is not None else late
        NW = self.N @ W
        for part in (V[: self._fixed], V[late:]):
            W = W - part.T @ (part @ NW)
        W = _whiten(W, self.N)
        W = W - V.T @ (V @ (self.N @ W))
        W = _whiten(W, self.N)
        r, b = self.size, W.shape[1]
        if r + b > len(self._store):
            raise NoReduction("kernel.stepping.vectors-not-enough", n_vectors=len(self._store))
        self._store[r : r + b] = W.T
        spread = self.damping.few is None  # a damping of all bodies, each with its own
        for small, A in ((self._KV, self.K), (self._RV, self.damping.rest))[: 1 + spread]:
            part = self._store[: r + b] @ (A @ W)
            small[: r + b, r : r + b] = part
            small[r : r + b, : r + b] = part.T
        self.size = r + b
        return W

    def model(self, size: int | None = None) -> ReducedModel:
        """The problem on the first vectors of the basis (all), in diagonal coordinates."""
        r = self.size if size is None else size
        V = self.vectors[:r]
        values, X = la.eigh(self._KV[:r, :r])
        k = np.maximum(values, 0.0)
        m = np.maximum(1.0 - k / self.shift**2, 0.0)  # m + k / s**2 = 1: the vectors' length
        felt = np.unique(self.J.indices)
        J, F, start = self.J[:, felt] @ V[:, felt].T, V @ self.F, V @ (self.N @ self._start)
        d = self.damping
        B, sense = d.on(V, self._RV[:r, :r])
        return ReducedModel(
            self.T, V, X, m, d.alpha * m + d.beta * k, k, np.ascontiguousarray(J @ X),
            X.T @ F, X.T @ start, B @ X, sense, self.supports,
        )  # fmt: skip


def _whiten(W: FloatArray, N: sp.csr_array) -> FloatArray:
    """Orthonormal in N; directions that are rounding are dropped."""
    gram = W.T @ (N @ W)
    values, vectors = np.linalg.eigh(0.5 * (gram + gram.T))
    kept = values > DEPENDENT
    return (W @ vectors[:, kept]) / np.sqrt(values[kept])
