"""Return to a cone of revolution `alpha tr(s) + beta q = K(p)`, flow along `gamma tr(s) + delta q`.

q is von Mises' equivalent stress, p the cumulated equivalent plastic strain
`sqrt(2/3 ep : ep)`. Von Mises' cylinder is alpha = gamma = 0. The flow direction does not turn
during the return, so that one scalar equation is left; where the deviator would turn over, the
return goes to the apex. (Simo and Hughes 1998; de Souza Neto, Peric and Owen 2008, chapter 8.)

Drucker and Prager's cone for soils: perfect and associated, or hardening with its own flow.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.response import (
    DEVIATOR,
    UNIT,
    PointParameters,
    Response,
    mises,
)

Hardening = Callable[[IntArray, FloatArray], tuple[FloatArray, FloatArray]]
"""Strength K and its slope at some points (rows) for cumulated strains p."""

TURNS = 60


@dataclass(frozen=True, eq=False)
class Cone:
    """Surface and flow at m points; `kinematic` is the modulus that moves its centre."""

    alpha: FloatArray
    beta: FloatArray
    gamma: FloatArray
    delta: FloatArray
    kinematic: FloatArray
    hardening: Hardening


def cone_return(
    parameters: PointParameters, cone: Cone, trial: FloatArray, p: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return trial stresses to the cone.

    Parameters
    ----------
    trial : array (m, 6)
        Elastic trial stress, relative to the cone's centre.
    p : array (m,)
        Cumulated plastic strain at the start.

    Returns
    -------
    stress : array (m, 6)
        Trial stress less the elastic stress of the plastic strain (relative to the old centre).
    p : array (m,)
    tangent : array (m, 6, 6)
    """
    stress, p = trial.copy(), p.copy()
    tangent = parameters.moduli
    q, deviator = mises(trial)
    trace = trial[:, :3].sum(axis=1)
    everywhere = np.arange(len(trial))
    strength = cone.hardening(everywhere, p)[0]
    size = np.abs(strength) + cone.beta * q + np.abs(cone.alpha * trace)
    over = cone.alpha * trace + cone.beta * q - strength
    rows = np.flatnonzero(over > 1e-14 * size)
    if len(rows) == 0:
        return stress, p, tangent
    flow = _Flow(parameters.at(rows), cone, rows, trace[rows], q[rows], deviator[rows])
    multiplier = flow.multiplier(p[rows])
    apex = (q[rows] < 3 * flow.G * flow.delta * multiplier) & (flow.alpha > 0)
    stress[rows], tangent[rows] = flow.regular(trial[rows], p[rows], multiplier)
    old = p[rows]
    p[rows] = old + flow.growth * multiplier
    if apex.any():
        chosen = rows[apex]
        tip = _Flow(parameters.at(chosen), cone, chosen, trace[chosen], q[chosen], deviator[chosen])
        stress[chosen], p[chosen], tangent[chosen] = tip.apex(old[apex])
    return stress, p, tangent


class _Flow:
    """Points that flow."""

    def __init__(
        self,
        parameters: PointParameters,
        cone: Cone,
        rows: IntArray,
        trace: FloatArray,
        q: FloatArray,
        deviator: FloatArray,
    ) -> None:
        self.G, self.B, self.moduli = parameters.shear, parameters.bulk, parameters.moduli
        self.alpha, self.beta = cone.alpha[rows], cone.beta[rows]
        self.gamma, self.delta = cone.gamma[rows], cone.delta[rows]
        self.kinematic, self.rows, self.hardening = cone.kinematic[rows], rows, cone.hardening
        self.trace, self.q, self.deviator = trace, q, deviator
        self.growth = np.sqrt(self.delta**2 + 2 * self.gamma**2)

    def _stiffness(self, slope: FloatArray) -> FloatArray:
        """Decrease of the yield function per unit of the multiplier."""
        shear = self.beta * self.delta * (3 * self.G + self.kinematic)
        return shear + 9 * self.B * self.alpha * self.gamma + slope * self.growth

    def multiplier(self, p: FloatArray) -> FloatArray:
        """Plastic multiplier (m,) by Newton on a function without kinks but the curve's own."""
        x = np.zeros(len(p))
        elastic = self._stiffness(np.zeros(len(p)))
        rounding = 4e-16 * (np.abs(self.alpha * self.trace) + self.beta * self.q) / elastic
        for _ in range(TURNS):
            strength, slope = self.hardening(self.rows, p + self.growth * x)
            f = self.alpha * self.trace + self.beta * self.q - elastic * x - strength
            step = f / np.maximum(self._stiffness(slope), 1e-9 * elastic)
            x = np.maximum(x + step, 0.0)
            if (np.abs(step) <= 1e-15 * np.abs(x) + rounding).all():
                break
        return x

    def regular(
        self, trial: FloatArray, p: FloatArray, x: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Stress and tangent on the smooth part."""
        slope = self.hardening(self.rows, p + self.growth * x)[1]
        N = 1.5 * self.deviator / np.maximum(self.q, 1e-300)[:, None]
        G = self.G[:, None]
        back = 3 * (self.B * self.gamma)[:, None] * UNIT + 2 * G * self.delta[:, None] * N
        stress = trial - x[:, None] * back
        normal = 3 * (self.B * self.alpha)[:, None] * UNIT + 2 * G * self.beta[:, None] * N
        stiff = self._stiffness(slope)[:, None, None]
        turn = (6 * self.G**2 * self.delta * x / np.maximum(self.q, 1e-300))[:, None, None]
        tangent = self.moduli - back[:, :, None] * normal[:, None, :] / stiff
        tangent -= turn * (DEVIATOR - (2 / 3) * N[:, :, None] * N[:, None, :])
        return stress, tangent

    def apex(self, p: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Stress, cumulated strain and tangent where the return ends at the tip."""
        shear = self.q / (3 * self.G)  # equivalent strain of the lost deviator
        trace, grown, rate = self.trace.copy(), p.copy(), np.zeros(len(p))
        for _ in range(TURNS):
            volume = (self.trace - trace) / (3 * self.B)
            dp = np.sqrt(2 / 9 * volume**2 + shear**2)
            grown = p + dp
            strength, slope = self.hardening(self.rows, grown)
            rate = (2 / 9) * volume / np.maximum(dp, 1e-300)
            step = (strength - self.alpha * trace) / (self.alpha + slope * rate / (3 * self.B))
            trace = trace + step
            if (np.abs(step) <= 1e-14 * (np.abs(trace) + np.abs(self.trace))).all():
                break
        slope = self.hardening(self.rows, grown)[1]
        found: FloatArray = trace[:, None] / 3 * UNIT
        return found, grown, self._apex_tangent(slope, rate, shear, grown - p)

    def _apex_tangent(
        self, slope: FloatArray, rate: FloatArray, shear: FloatArray, dp: FloatArray
    ) -> FloatArray:
        """`alpha dI = K' dp(I, strain)`, all stress being I/3."""
        N = 1.5 * self.deviator / np.maximum(self.q, 1e-300)[:, None]
        by_shear = (2 / 3) * (shear / np.maximum(dp, 1e-300))[:, None] * N
        strain = rate[:, None] * UNIT + by_shear
        change = slope / (self.alpha + slope * rate / (3 * self.B))
        return UNIT[:, None] / 3 * (change[:, None] * strain)[:, None, :]


def perfect(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Cone through the simple strengths LTR (tension) and LCS (compression); variable EPSE."""
    numbers = perfect_columns(parameters)
    alpha, limit = numbers["ALPHA"], numbers["FIRST"]
    one = np.ones(len(stress))

    def strength(rows: IntArray, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        return limit[rows], np.zeros(len(rows))

    cone = Cone(alpha, one, alpha, one, 0 * one, strength)
    return _respond(parameters, cone, stress, strain, variables)


def perfect_columns(parameters: PointParameters) -> dict[str, FloatArray]:
    """`perfect` in numbers."""
    tension, compression = parameters["LTR"], np.abs(parameters["LCS"])
    alpha = (compression - tension) / (compression + tension)
    limit = 2 * compression * tension / (compression + tension)
    return {"ALPHA": alpha, "GAMMA": alpha, "FIRST": limit}


def hardening(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """`ALFA tr(s) + BETA q <= K + H p`, up to the ultimate cone; flow by GAMM and DELT.

    The ultimate strength bounds K from above. One that falls (H < 0) ends at an ultimate strength
    below the first, else at zero.
    """
    limit, slope, last, falls = _strengths(parameters)

    def strength(rows: IntArray, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        value = limit[rows] + slope[rows] * p
        end = last[rows]
        ended = np.where(falls[rows], value <= end, value >= end)
        return np.where(ended, end, value), np.where(ended, 0.0, slope[rows])

    zero = np.zeros(len(stress))
    names = ("ALFA", "BETA", "GAMM", "DELT")
    alpha, beta, gamma, delta = (parameters[n] for n in names)
    cone = Cone(alpha, beta, gamma, delta, zero, strength)
    return _respond(parameters, cone, stress, strain, variables)


def _strengths(
    parameters: PointParameters,
) -> tuple[FloatArray, FloatArray, FloatArray, BoolArray]:
    """First strength, its slope, the last one, and where it falls."""
    limit, slope = parameters["K"], parameters["H"]
    last = parameters["KL"] * parameters["BETA"] / parameters["MU"]
    falls = slope < 0
    return limit, slope, np.where(falls & (last >= limit), 0.0, last), falls


def hardening_columns(parameters: PointParameters) -> dict[str, FloatArray]:
    """`hardening` in numbers."""
    limit, slope, last, falls = _strengths(parameters)
    numbers = {"FIRST": limit, "SLOPE": slope, "LAST": last, "SINKS": falls.astype(float)}
    words = {"ALPHA": "ALFA", "BETA": "BETA", "GAMMA": "GAMM", "DELTA": "DELT"}
    return numbers | {column: parameters[word] for column, word in words.items()}


def _respond(
    parameters: PointParameters,
    cone: Cone,
    stress: FloatArray,
    strain: FloatArray,
    variables: FloatArray,
) -> Response:
    trial = stress + np.einsum("mij,mj->mi", parameters.moduli, strain)
    found, p, tangent = cone_return(parameters, cone, trial, variables[:, 0])
    return Response(found, p[:, None], tangent)


def check_perfect(parameters: PointParameters) -> None:
    """Refuse strengths without a cone.

    Raises
    ------
    MaterialError
        Unless LTR > 0 and |LCS| >= LTR.
    """
    tension, compression = parameters["LTR"], np.abs(parameters["LCS"])
    if (tension <= 0).any() or (compression < tension).any():
        told = {"tension_min": tension.min(), "compression_min": compression.min()}
        raise MaterialError("kernel.materials.drucker-parfait-ltr-lcs", **told)


def check_hardening(parameters: PointParameters) -> None:
    """Refuse an ultimate cone of another slope than the first.

    Raises
    ------
    MaterialError
        Unless ETA / MU = ALFA / BETA, with BETA, MU and DELT positive.
    """
    alpha, beta, eta, mu = (parameters[n] for n in ("ALFA", "BETA", "ETA", "MU"))
    if (beta <= 0).any() or (mu <= 0).any() or (parameters["DELT"] < 0).any():
        raise MaterialError("kernel.materials.drucker-prager-needs-beta")
    if (np.abs(eta * beta - alpha * mu) > 1e-9 * np.abs(alpha * mu) + 1e-30).any():
        told = {"eta": (eta / mu).flat[0], "alpha": (alpha / beta).flat[0]}
        raise MaterialError("kernel.materials.ultimate-cone-drucker-prager", **told)
