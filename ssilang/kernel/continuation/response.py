"""Forced response and normal modes of oscillators: branches, stability, bifurcations."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.continuation.arc import Branch, Lengths, Point, Tracer
from ssilang.kernel.continuation.floquet import crossing, unstable
from ssilang.kernel.continuation.harmonics import Oscillators, derivative_matrix
from ssilang.kernel.continuation.normal_modes import FreeMotion


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
    """Solutions of a branch.

    Attributes
    ----------
    frequencies : list of float
    coefficients : list of array (2 H + 1, n)
    exponents : list of array (2 n,)
    unstable : list of bool
    energies : list of float
        Of normal modes.
    """

    frequencies: list[float] = field(default_factory=list)
    coefficients: list[FloatArray] = field(default_factory=list)
    exponents: list[FloatArray] = field(default_factory=list)
    unstable: list[bool] = field(default_factory=list)
    energies: list[float] = field(default_factory=list)
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
