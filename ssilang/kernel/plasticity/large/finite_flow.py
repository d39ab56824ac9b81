"""Plastic continuous elements in large strains: updated Lagrangian, in axes that turn with matter.

With F = R U the law works in axes turned by R (Green and Naghdi's rate), between the stress there
and the logarithmic strain of a step. With X = U0^-1 U1 that strain is the mean of ln (X X^T)^(1/2)
and ln (X^T X)^(1/2): its trace is the logarithm of the change of volume, which flow without change
of volume thus keeps; it is exact where the axes of stretch stay, else of second order in the step
(Simo and Hughes, Computational Inelasticity, sections 7.2 and 8.3). Forces follow from the second
Piola-Kirchhoff stress `S = J U^-1 sigma U^-1` by `FiniteSolid`, whose moduli are its derivative by
the Green-Lagrange strain.

Words of LAGRANGIEN: with 'FIN_PAS' the law's stress s is Cauchy's. With 'MI_PAS' the law is taken
half-way of the elastic stretch e = D^-1 s and its stress carried on (Truesdell's rate of elastic
strains): `sigma = exp(e/2) s exp(e/2) / exp(tr e/2)`. They differ by the elastic strain; neither
depends on the steps where the axes of stretch stay.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.solids.kinematics import as_components, as_tensor
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.plasticity.finite import FiniteSolid
from ssilang.kernel.plasticity.large.finite_yielding import InsideOutError, YieldingSolid
from ssilang.kernel.plasticity.points import PlasticPoints, PointState

Function = tuple[Callable[[FloatArray], FloatArray], Callable[[FloatArray, FloatArray], FloatArray]]
"""A function of a number, and its divided difference (f(a) - f(b)) / (a - b)."""
TURNS = 50


def _per(numerator: Callable[[FloatArray], FloatArray], x: FloatArray) -> FloatArray:
    """numerator(x) / x, 1 at x = 0."""
    still = x == 0.0
    safe = np.where(still, 1.0, x)
    return np.where(still, 1.0, numerator(safe) / safe)


ROOT: Function = (np.sqrt, lambda a, b: 1.0 / (np.sqrt(a) + np.sqrt(b)))
LOGARITHM: Function = (np.log, lambda a, b: _per(np.log1p, (a - b) / b) / b)
EXPONENTIAL: Function = (np.exp, lambda a, b: np.exp(b) * _per(np.expm1, a - b))


class _Eigen:
    """Functions of symmetric tensors (m, 3, 3) and their derivatives (Daleckii and Krein)."""

    def __init__(self, A: FloatArray) -> None:
        self.values, self.axes = np.linalg.eigh(A)

    def of(self, function: Callable[[FloatArray], FloatArray]) -> FloatArray:
        return (self.axes * function(self.values)[:, None]) @ self.axes.swapaxes(1, 2)

    def change(self, function: Function, dA: FloatArray) -> FloatArray:
        """Derivatives (m, k, 3, 3) of a function by changes dA (m, k, 3, 3)."""
        Q = self.axes[:, None]
        slopes = function[1](self.values[:, :, None], self.values[:, None, :])[:, None]
        return Q @ (slopes * (Q.swapaxes(2, 3) @ dA @ Q)) @ Q.swapaxes(2, 3)


def _tensors(flat: FloatArray, strains: bool) -> FloatArray:
    """(..., 3, 3) of components (..., 6)."""
    own = flat.reshape(-1, 6, 1)
    return as_tensor(own, strains).reshape(*flat.shape[:-1], 3, 3)


def _components(T: FloatArray, strains: bool) -> FloatArray:
    """(..., 6) of tensors (..., 3, 3)."""
    return as_components(T.reshape(-1, 1, 3, 3), 6, strains).reshape(*T.shape[:-2], 6)


def _twice(A: FloatArray) -> FloatArray:
    """A tensor and its transposed added."""
    return np.asarray(A + A.swapaxes(-1, -2))


@dataclass(frozen=True, eq=False)
class FlowingSolid(YieldingSolid):
    """A zone in large strains; its points' stresses are the law's, in axes that turn with them.

    Attributes
    ----------
    halfway : bool
        Whether the law is taken half-way of the elastic stretch ('MI_PAS').
    """

    halfway: bool = True

    def respond(
        self, before: FloatArray, u: FloatArray, last: PointState, time: float
    ) -> tuple[PointState, FiniteSolid]:
        """The state after a step between displacements (n_cells, n_rows), the zone there."""
        C0, C1 = self._squared(before, last), self._squared(u, last)
        first, second = _Eigen(C0), _Eigen(C1)
        back, now = first.of(lambda c: c**-0.5), second.of(np.sqrt)
        one = _Eigen(back @ C1 @ back)
        start = back @ back
        other = _Eigen(now @ start @ now)
        step = _components(0.25 * (one.of(np.log) + other.of(np.log)), True)
        points = self.points
        found, whole = points.respond(last.stress, step, last.variables, time - last.time)
        elastic = found.elastic_strain(points.parameters, last.stress)
        state = PointState(
            found.stress, last.plastic + whole - elastic, last.free, found.variables, time
        )
        # changes for one unit of each component of the Green-Lagrange strain
        dC = np.broadcast_to(2.0 * _tensors(np.eye(6), True), (len(C1), 6, 3, 3))
        dU = second.change(ROOT, dC)
        B, dB = back[:, None], dU @ (start @ now)[:, None]
        logs = one.change(LOGARITHM, B @ dC @ B) + other.change(LOGARITHM, _twice(dB))
        strains = _components(0.25 * logs, True)
        across = self._across(last, whole, strains)
        return state, self._zone(u, state, dU, dC, strains @ found.tangent, across)

    def standing(self, u: FloatArray, last: PointState) -> FiniteSolid:
        """The zone where its points have that state, with the moduli at rest."""
        return self._zone(u, last)

    def shown(self, u: FloatArray, last: PointState) -> FloatArray:
        """Cauchy stresses (n_cells, n_components, n_points)."""
        turn = self._turn(u, last)
        sigma = turn @ self._cauchy(last.stress)[0] @ turn.swapaxes(1, 2)
        return self.points.gathered(_components(sigma, False))

    def taken(self, given: FloatArray, u: FloatArray, last: PointState) -> FloatArray:
        """The law's stresses (m, 6) that are shown as the given ones at u."""
        turn = self._turn(u, last)
        sigma = turn.swapaxes(1, 2) @ _tensors(self.points.spread(given), False) @ turn
        if not self.halfway:
            return _components(sigma, False)
        s = sigma
        for _ in range(TURNS):
            back = _Eigen(self._carrier(_components(s, False))).of(lambda g: np.exp(-0.5 * g))
            before, s = s, back @ sigma @ back
            if np.abs(s - before).max(initial=0.0) <= 1e-15 * np.abs(s).max(initial=0.0):
                break
        return _components(s, False)

    def stored(self, u: FloatArray, last: PointState) -> float:
        """Elastic energy: that of a unit of present volume."""
        J = np.sqrt(np.linalg.det(self._squared(u, last)))
        points = self.points
        return replace(points, weights=points.weights * J.reshape(points.weights.shape)).stored(
            last
        )

    # ---- the parts

    def _squared(self, u: FloatArray, last: PointState) -> FloatArray:
        """F^T F (m, 3, 3); thickness under plane stress is what the points' strains make of it.

        A body turned inside out has none: no numbers, so that the step is cut.
        """
        F = self.solid._transformation(u).reshape(-1, 3, 3)
        C: FloatArray = F.swapaxes(1, 2) @ F
        C[np.linalg.det(F) <= 0.0] = np.nan
        if self._thin:
            law, plastic = self.points.parameters, last.plastic[:, 2]
            across = plastic + np.einsum("mj,mj->m", law.compliance[:, 2], last.stress)
            C[:, 2, 2] = np.exp(2.0 * across)
        if not np.isfinite(C).all():
            raise InsideOutError
        return C

    @property
    def _thin(self) -> bool:
        return self.points.zone.mode is Mode.PLANE_STRESS

    def _turn(self, u: FloatArray, last: PointState) -> FloatArray:
        """R (m, 3, 3)."""
        F = self.solid._transformation(u).reshape(-1, 3, 3)
        C = self._squared(u, last)
        F[:, 2, 2] = np.sqrt(C[:, 2, 2]) if self._thin else F[:, 2, 2]
        return F @ _Eigen(C).of(lambda c: c**-0.5)

    def _across(self, last: PointState, whole: FloatArray, strains: FloatArray) -> FloatArray:
        """Changes (m, 6) of the logarithm of the thickness under plane stress."""
        if not self._thin:
            return np.zeros(strains.shape[:2])
        points = self.points
        full = points.law.respond(points.parameters, last.stress, whole, last.variables).tangent
        rows = full[:, 2] / full[:, 2, 2][:, None]
        rows[:, 2] = 0.0
        return np.asarray(-np.einsum("mks,ms->mk", strains, rows))

    def _carrier(self, flat: FloatArray) -> FloatArray:
        """ln of what carries stresses s (..., 6) to Cauchy's: e - tr e / 2."""
        e = np.einsum("mij,m...j->m...i", self.points.parameters.compliance, flat)
        e = _tensors(e, True)
        return np.asarray(e - 0.5 * np.trace(e, axis1=-2, axis2=-1)[..., None, None] * np.eye(3))

    def _cauchy(
        self, s: FloatArray, ds: FloatArray | None = None
    ) -> tuple[FloatArray, FloatArray | None]:
        """Cauchy's stress (m, 3, 3) in the turning axes, and its change (m, k, 3, 3)."""
        own = _tensors(s, False)
        change = None if ds is None else _tensors(ds, False)
        if not self.halfway:
            return own, change
        carrier = _Eigen(self._carrier(s))
        carried = carrier.of(np.exp)  # has the axes of s: the law is isotropic
        if ds is not None and change is not None:
            more = carrier.change(EXPONENTIAL, self._carrier(ds))
            change = 0.5 * _twice(more @ own[:, None] + carried[:, None] @ change)
        return 0.5 * _twice(carried @ own), change

    def _zone(
        self,
        u: FloatArray,
        state: PointState,
        dU: FloatArray | None = None,
        dC: FloatArray | None = None,
        ds: FloatArray | None = None,
        across: FloatArray | None = None,
    ) -> FiniteSolid:
        """The elastic zone with the forces of a state; with its tangent where changes are given."""
        C = self._squared(u, state)
        eigen = _Eigen(C)
        back = eigen.of(lambda c: c**-0.5)
        J = np.sqrt(np.prod(eigen.values, axis=1))[:, None, None]
        sigma, change = self._cauchy(state.stress, ds)
        S = J * (back @ sigma @ back)
        tangent = None
        if dU is not None and dC is not None and change is not None and across is not None:
            B = back[:, None]
            inward = B @ dU @ S[:, None]
            grown = 0.5 * np.einsum("mij,mkji->mk", back @ back, dC) + across
            dS = grown[..., None, None] * S[:, None] - _twice(inward)
            dS = dS + J[:, None] * (B @ change @ B)
            tangent = _components(dS, False).swapaxes(1, 2)
        return self.at(u, _components(S, False), tangent)


LAGRANGIAN: dict[str, Callable[[FiniteSolid, PlasticPoints], YieldingSolid]] = {
    "MI_PAS": FlowingSolid,
    "FIN_PAS": partial(FlowingSolid, halfway=False),
    "TOTAL": YieldingSolid,
}
"""Zones by the words of LAGRANGIEN."""
