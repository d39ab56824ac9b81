"""Forced response and normal modes of oscillators: branches, stability, bifurcations."""

from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.scientific import la
from ssilang.kernel.continuation.arc import Branch, Lengths, Point, Tracer
from ssilang.kernel.continuation.harmonics import Oscillators, crossing, derivative_matrix, unstable

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
        o = self.oscillators
        squares, shapes = la.eigh(o.K, o.M)
        own = int(np.argmax(np.abs(shapes[self.mode])))
        w = float(np.sqrt(max(squares[own], 0.0)))
        Q = np.zeros(o.load.shape)
        Q[1] = shapes[:, own] * np.sqrt(2.0 * energy) / w
        return np.concatenate([Q.ravel(), [w, 0.0]])


@dataclass(frozen=True, eq=False)
class Bifurcation:
    """Where a branch changes: kind (LP BP PD NS), coefficients, frequency, new frequency, vector.

    `vector` (size,) is complex: the perturbation that neither grows nor falls.
    """

    kind: str
    coefficients: FloatArray
    frequency: float
    new_frequency: float
    vector: FloatArray


@dataclass(eq=False)
class Response:
    """Solutions of a branch."""

    frequencies: list[float] = field(default_factory=list)
    coefficients: list[FloatArray] = field(default_factory=list)  # (2 H + 1, n) each
    exponents: list[FloatArray] = field(default_factory=list)  # (2 n,) each
    unstable: list[bool] = field(default_factory=list)
    energies: list[float] = field(default_factory=list)  # of normal modes
    bifurcations: list[Bifurcation] = field(default_factory=list)
    ended: str = ""

    def add(self, system: Oscillators, Q: FloatArray, w: float, energy: float = 0.0) -> None:
        """One more solution."""
        found = system.exponents(Q, w)
        self.frequencies.append(w)
        self.coefficients.append(Q)
        self.exponents.append(found)
        self.unstable.append(unstable(found, w))
        self.energies.append(energy)


def forced_response(
    system: Oscillators, guess: FloatArray, start: float, end: float, sense: float,
    lengths: Lengths, most: int,
) -> Response:  # fmt: skip
    """The branch of forced motions from the frequency `start` on, while between start and end."""
    tracer = Tracer(system, lengths)
    response = Response()
    first = tracer.first(guess.ravel(), start, sense)
    shape = guess.shape
    response.add(system, first.u.reshape(shape), first.t)

    def seen(before: Point, after: Point, ds: float) -> bool:
        response.add(system, after.u.reshape(shape), after.t)
        _note_bifurcation(system, tracer, response, before, after, ds)
        return True

    low, high = min(start, end), max(start, end)
    branch = tracer.follow(first, most, lambda t: low <= t <= high, seen)
    response.ended = branch.ended
    return response


def normal_mode(
    system: Oscillators, mode: int, start: float, end: float, lengths: Lengths, most: int
) -> Response:
    """The branch of free motions from a small energy on; its exponents are those of the motion."""
    free = FreeMotion(system, mode)
    tracer = Tracer(free, lengths)
    first = tracer.first(free.guess(start), start)
    branch: Branch = tracer.follow(first, most, lambda t: t <= end)
    response = Response(ended=branch.ended)
    for point in branch.points:
        Q, w, _ = free.split(point.u)
        response.add(system, Q, w, point.t)
    return response


def _note_bifurcation(
    system: Oscillators, tracer: Tracer, response: Response, before: Point, after: Point, ds: float
) -> None:
    shape = response.coefficients[-1].shape
    if before.tangent[-1] * after.tangent[-1] < 0.0:
        sign = np.sign(after.tangent[-1])
        found = tracer.located(before, ds, lambda p: bool(np.sign(p.tangent[-1]) == sign))
        at = after if found is None else found[1]
        _note(system, response, "LP", at, np.zeros(()))
        return
    kind = crossing(response.exponents[-2], response.exponents[-1], (before.t, after.t))
    if kind == "BP" and _sense(system, before) == _sense(system, after):
        kind = ""  # exponents of too few harmonics cross beside a limit point
    if not kind:
        return
    wanted = int((response.exponents[-1].real > 1e-7 * after.t).sum())

    def beyond(p: Point) -> bool:
        found = system.exponents(p.u.reshape(shape), p.t)
        return int((found.real > 1e-7 * p.t).sum()) == wanted

    found = tracer.located(before, ds, beyond, 1e-6)
    at = after if found is None else found[1]
    exponents = system.exponents(at.u.reshape(shape), at.t)
    near = exponents[int(np.argmin(np.abs(exponents.real)))]
    _note(system, response, kind, at, np.asarray(near))


def _sense(system: Oscillators, at: Point) -> float:
    """Sign of the determinant of equations and tangent, which changes at a branch point."""
    _, J, by_w = system.at(at.u, at.t)
    whole = np.block([[J, by_w[:, None]], [at.tangent[None, :]]])
    return float(np.linalg.slogdet(whole)[0])


def _note(
    system: Oscillators, response: Response, kind: str, at: Point, exponent: FloatArray
) -> None:
    shape = response.coefficients[-1].shape
    turn = {"PD": 0.5 * at.t, "NS": abs(float(np.imag(exponent)))}.get(kind, 0.0)
    vector = _perturbation(system, at, complex(0.0, turn))
    response.bifurcations.append(Bifurcation(kind, at.u.reshape(shape).copy(), at.t, turn, vector))


def _perturbation(system: Oscillators, at: Point, exponent: complex) -> FloatArray:
    """Coefficients of the perturbation `p(t) exp(exponent t)` that the motion leaves (Hill)."""
    b = system.basis
    D = derivative_matrix(b.harmonics)
    one = np.eye(len(D))
    first = np.kron(one, system.C) + 2 * at.t * np.kron(D, system.M)
    fv = system.sampled(at.u.reshape(system.load.shape), at.t)[2]
    drag = np.einsum("at,tij,tb->aibj", b.back, fv, b.values, optimize=True)
    first = first - drag.reshape(first.shape)
    hill = at.jacobian + exponent * first + exponent**2 * np.kron(one, system.M)
    vector = np.linalg.svd(hill)[2][-1].conj()
    return np.asarray(vector)
