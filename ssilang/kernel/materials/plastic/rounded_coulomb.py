"""Mohr and Coulomb's criterion with rounded edges and tip, perfect and associated.

    f = sin(PHI) I1/3 + sqrt(J2 k(theta)^2 + (0.05 COHE cos(PHI))^2) - COHE cos(PHI)

k is Coulomb's section up to 25 degrees of Lode's angle and a sine of three times the angle
beyond, with continuous slope (Abbo and Sloan, Computers and Structures 54, 1995). The tip is a
hyperbola. The surface being smooth, the return is the closest point by Newton on stress and
multiplier together, and its tangent is exact.

A step may be integrated in parts (NSUB), halved where Newton's method does not converge soon
(Perez-Foguet, Rodriguez-Ferran and Huerta, Computer Methods in Applied Mechanics and Engineering
190, 2001); the tangent is that of all parts together.
"""

from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.elasticity import PAIRS
from ssilang.kernel.materials.plastic.response import PointParameters, Response

TRANSITION = np.radians(25.0)
TIP = 0.05
TURNS = 30
CUTS = 12
SMALL = 1e-12
FAR = 1e5  # times the cohesion: where only a step that diverges leads
_S = -1.5 * np.sqrt(3.0)

_BASIS = np.zeros((6, 3, 3))
for _a, (_i, _j) in enumerate(PAIRS):
    _BASIS[_a, _i, _j] = _BASIS[_a, _j, _i] = 1.0
_DEVIATORIC = _BASIS - np.einsum("aii->a", _BASIS)[:, None, None] / 3 * np.eye(3)
_PRODUCTS = np.einsum("aij,bjk->abik", _DEVIATORIC, _DEVIATORIC)
_PRODUCTS = _PRODUCTS + _PRODUCTS.transpose(1, 0, 2, 3)
_SECOND = np.einsum("abii->ab", _PRODUCTS) / 2
"""Hessian of J2."""
_MEAN = np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]) / 3


def respond(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Parameters COHE and PHI (radians); variable EPSE."""
    trial = stress + np.einsum("mij,mj->mi", parameters.moduli, strain)
    found, p, tangent, _ = _returned(parameters, trial, variables[:, 0])
    return Response(found, p[:, None], tangent)


def _returned(
    parameters: PointParameters, trial: FloatArray, p: FloatArray, most: int = 0
) -> tuple[FloatArray, FloatArray, FloatArray, IntArray]:
    """Stresses, EPSE, tangents, turns of Newton's method (0: elastic).

    With `most` turns at most those are -1 where these do not do.
    """
    found, tangent, p = trial.copy(), parameters.moduli, p.copy()
    turns = np.zeros(len(p), dtype=np.int64)
    size = np.abs(trial).max(axis=1) + parameters["COHE"]
    rows = np.flatnonzero(_surface(parameters, trial)[0] > 1e-13 * size)
    if len(rows):
        some = parameters.at(rows)
        compliance = some.compliance
        points = _Return(some, compliance, trial[rows])
        if most:
            unknown = np.pad(points.trial, ((0, 0), (0, 1)))
            jacobian, lost, took = points.newton(unknown, most)
            found[rows], tangent[rows] = unknown[:, :6], np.linalg.inv(jacobian)[:, :6, :6]
            turns[rows] = np.where(lost, -1, took)
        else:
            found[rows], tangent[rows] = _closest_point(points)
        plastic = np.einsum("mij,mj->mi", compliance, trial[rows] - found[rows])
        square = (plastic[:, :3] ** 2).sum(axis=1) + 0.5 * (plastic[:, 3:] ** 2).sum(axis=1)
        p[rows] += np.sqrt(2 / 3 * square)
    return found, p, tangent, turns


def respond_in_parts(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """The response over parts of the step, the first as long as the last of the step before.

    A part whose return takes NITE turns and more is halved, down to a step's NSUB-th; one that
    takes few leads to longer ones in the next step. Variables EPSE and NSUB (length of a part).
    """
    many, most, stress = np.rint(parameters["NSUB"]), int(parameters["NITE"].max()), stress.copy()
    trial = np.einsum("mij,mj->mi", parameters.moduli, strain)
    elastic, compliance = parameters.moduli, parameters.compliance
    p, tangent = variables[:, 0].copy(), np.zeros_like(elastic)
    length = np.where(variables[:, 1] > 0, variables[:, 1], many)
    at, parts, turns = np.zeros((3, len(stress)))
    while len(rows := np.flatnonzero(at < many)):
        shortest = bool((length[rows] <= 1).any())  # those, first, whatever turns they take
        rows = rows[length[rows] <= 1] if shortest else rows
        share = (length / many)[rows, None]
        tried, turns_given = stress[rows] + share * trial[rows], 0 if shortest else max(most - 1, 1)
        new, q, part, took = _returned(parameters.at(rows), tried, p[rows], turns_given)
        done = took >= 0
        length[rows[~done]] //= 2
        rows, share = rows[done], share[done, None]
        tangent[rows] = part[done] @ compliance[rows] @ (tangent[rows] + share * elastic[rows])
        stress[rows], p[rows] = new[done], q[done]
        at[rows] += length[rows]
        parts[rows] += 1
        turns[rows] += most if shortest else took[done] + (took[done] > 0)
    easy = (turns < 4 * parts) & (parts > 1)
    longer = np.minimum(np.rint(length * (5 - turns / parts)), many)
    return Response(stress, np.stack([p, np.where(easy, longer, length)], axis=1), tangent)


def criterion(parameters: PointParameters, stress: FloatArray) -> FloatArray:
    """The function f (m,) of stresses (m, 6): negative inside."""
    return _surface(parameters, stress)[0]


@dataclass(frozen=True)
class _Return:
    """Equations of the closest points to trial stresses, on a surface with a tip of some size."""

    parameters: PointParameters
    compliance: FloatArray
    trial: FloatArray
    tip: float = TIP

    def at(self, rows: IntArray) -> "_Return":
        some = self.parameters.at(rows)
        return _Return(some, self.compliance[rows], self.trial[rows], self.tip)

    def far(self) -> FloatArray:
        """Stress of the trial over cohesion (m,)."""
        return np.abs(self.trial).max(axis=1) / self.parameters["COHE"]

    def equations(self, unknown: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Residual (m, 7), its derivative (m, 7, 7), its size (m,).

        The size is over strain and stress of first yield, or what rounds as much far beyond it.
        """
        stress, multiplier = unknown[:, :6], unknown[:, 6]
        f, gradient, hessian = _surface(self.parameters, stress, self.tip)
        rest = np.empty_like(unknown)
        rest[:, :6] = np.einsum("mij,mj->mi", self.compliance, stress - self.trial)
        rest[:, :6] += multiplier[:, None] * gradient
        rest[:, 6] = f
        jacobian = np.zeros((len(f), 7, 7))
        jacobian[:, :6, :6] = self.compliance + multiplier[:, None, None] * hessian
        jacobian[:, :6, 6] = jacobian[:, 6, :6] = gradient
        strain = np.abs(rest[:, :6]).max(axis=1) * self.parameters["YOUN"]
        scale = np.maximum(np.cos(self.parameters["PHI"]), 0.01 * self.far())
        return rest, jacobian, np.maximum(strain, np.abs(f)) / (scale * self.parameters["COHE"])

    def newton(
        self, unknown: FloatArray, most: int = TURNS
    ) -> tuple[FloatArray, BoolArray, IntArray]:
        """Changes stress and multiplier `unknown`; Jacobian, which points are lost, turns."""
        rest, jacobian, norm = self.equations(unknown)
        norm[self.far() > FAR] = np.nan
        turns = np.zeros(len(norm), dtype=np.int64)
        for _ in range(most):
            rows = np.flatnonzero(norm > SMALL)
            if not len(rows):
                break
            turns[rows] += 1
            step = np.linalg.solve(jacobian[rows], -rest[rows, :, None])[..., 0].astype(float)
            unknown[rows], rest[rows], jacobian[rows], norm[rows] = self.at(rows).searched(
                unknown[rows], step, norm[rows]
            )
        return jacobian, ~(norm <= SMALL), turns

    def searched(
        self, unknown: FloatArray, step: FloatArray, norm: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """A step, halved where the residual would grow."""
        length = np.ones(len(norm))
        for _ in range(CUTS):
            new = unknown + length[:, None] * step
            rest, jacobian, found = self.equations(new)
            worse = ~(found <= (1 - 0.1 * length) * norm) & ~(found <= SMALL)
            if not worse.any():
                break
            length = np.where(worse, 0.5 * length, length)
        return new, rest, jacobian, found


def _closest_point(points: _Return) -> tuple[FloatArray, FloatArray]:
    """Stresses (m, 6), NaN where none is found, and tangents (m, 6, 6)."""
    unknown = np.pad(points.trial, ((0, 0), (0, 1)))
    jacobian, lost, _ = points.newton(unknown)
    rows = np.flatnonzero(lost & (points.far() <= FAR))
    if len(rows):  # far beyond a sharp tip: along ever sharper ones
        some = points.at(rows)
        found = np.pad(some.trial, ((0, 0), (0, 1)))
        for halvings in range(int(np.log2(some.far().max() / TIP)), -1, -1):
            tipped = replace(some, tip=TIP * 2.0**halvings)
            jacobian[rows], lost[rows], _ = tipped.newton(found)
        unknown[rows] = found
    unknown[lost], jacobian[lost] = np.nan, np.eye(7)
    return unknown[:, :6], np.linalg.inv(jacobian)[:, :6, :6].astype(float)


def _surface(
    parameters: PointParameters, stress: FloatArray, tip: float = TIP
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Yield function (m,), gradient (m, 6), Hessian (m, 6, 6)."""
    c, phi = parameters["COHE"], parameters["PHI"]
    sine, limit = np.sin(phi), c * np.cos(phi)
    tensor = np.einsum("ma,aij->mij", stress, _DEVIATORIC)
    J2 = 0.5 * np.einsum("mij,mij->m", tensor, tensor)
    J2 = np.maximum(J2, 1e-24 * limit**2 + 1e-300)
    square = np.einsum("mij,mjk->mik", tensor, tensor)
    J3 = np.einsum("mij,mij->m", square, tensor) / 3
    g2 = np.einsum("mij,aij->ma", tensor, _DEVIATORIC)
    g3 = np.einsum("mij,aij->ma", square, _DEVIATORIC)
    h3 = np.einsum("mij,abij->mab", tensor, _PRODUCTS)
    h, d2, d3, d22, d23, d33 = _section(J2, J3, sine)
    root = np.sqrt(h + (tip * limit) ** 2)
    inner = d2[:, None] * g2 + d3[:, None] * g3
    cross = g2[:, :, None] * g3[:, None, :]
    bend = d22[:, None, None] * g2[:, :, None] * g2[:, None, :]
    bend += d23[:, None, None] * (cross + cross.transpose(0, 2, 1))
    bend += d33[:, None, None] * g3[:, :, None] * g3[:, None, :]
    bend += d2[:, None, None] * _SECOND + d3[:, None, None] * h3
    f = sine * (stress @ _MEAN) - limit + root
    gradient = sine[:, None] * _MEAN + inner / (2 * root[:, None])
    hessian = bend / (2 * root[:, None, None])
    hessian -= inner[:, :, None] * inner[:, None, :] / (4 * root[:, None, None] ** 3)
    return f, gradient, hessian


def _section(J2: FloatArray, J3: FloatArray, sine: FloatArray) -> tuple[FloatArray, ...]:
    """`J2 k^2` and its derivatives by J2, J3: h, h_2, h_3, h_22, h_23, h_33, each (m,)."""
    lode = np.clip(_S * J3 / J2**1.5, -1.0, 1.0)
    k, k1, k2 = _shape(lode, sine)
    by2, by3 = -1.5 * lode / J2, _S / J2**1.5
    turn = k1**2 + k * k2
    mixed = -k * k1 - 3 * turn * lode
    return (
        J2 * k**2,
        k**2 - 3 * k * k1 * lode,
        2 * J2 * k * k1 * by3,
        mixed * by2,
        mixed * by3,
        2 * J2 * turn * by3**2,
    )


def _shape(lode: FloatArray, sine: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """k and its derivatives by sin(3 theta)."""
    angle = np.arcsin(lode) / 3
    side = np.where(lode >= 0, 1.0, -1.0)
    t, r = TRANSITION, np.sqrt(3.0)
    tan, tan3 = np.tan(t), np.tan(3 * t)
    A = np.cos(t) / 3 * (3 + tan * tan3 + side * (tan3 - 3 * tan) * sine / r)
    B = (side * np.sin(t) + sine * np.cos(t) / r) / (3 * np.cos(3 * t))
    inside = np.abs(angle) <= t
    a = np.where(inside, angle, 0.0)
    k = np.cos(a) - sine * np.sin(a) / r
    first = -np.sin(a) - sine * np.cos(a) / r
    cos3 = 3 * np.cos(3 * a)
    k1 = first / cos3
    k2 = (-k + 3 * np.tan(3 * a) * first) / cos3**2
    return (
        np.where(inside, k, A - B * lode),
        np.where(inside, k1, -B),
        np.where(inside, k2, 0.0),
    )


def check(parameters: PointParameters) -> None:
    """Refuse a material without cohesion or with an angle in degrees."""
    if (parameters["COHE"] <= 0).any():
        raise MaterialError("kernel.materials.rh-coulomb-needs-cohesion")
    phi = parameters["PHI"]
    if (phi <= 0).any() or (phi >= np.pi / 2).any():
        raise MaterialError("kernel.materials.rh-coulomb-phi", phi=phi.flat[0])
