"""Laws of fibres: one stress along the fibre; shear stays elastic."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.response import PointParameters, Response


class Along(NamedTuple):
    """Stress, internal variables (m, k) and slope along fibres at the end of a step."""

    stress: FloatArray
    variables: FloatArray
    slope: FloatArray


@dataclass(frozen=True)
class Fibres:
    """A law along fibres as a law of points, with elastic shear beside it.

    Attributes
    ----------
    along : callable
        `along(parameters, stress, strain, variables)` of stresses and steps of strain (m,).
    """

    along: Callable[[PointParameters, FloatArray, FloatArray, FloatArray], Along]

    def __call__(
        self, p: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
    ) -> Response:
        along = self.along(p, stress[:, 0].copy(), strain[:, 0].copy(), variables)
        found, D = np.zeros_like(stress), np.zeros((len(stress), 6, 6))
        found[:, 0] = along.stress
        found[:, 3:5] = stress[:, 3:5] + p.shear[:, None] * strain[:, 3:5]
        D[:, 0, 0] = along.slope
        D[:, 3, 3] = D[:, 4, 4] = p.shear
        return Response(found, along.variables, D)


@dataclass(frozen=True)
class Points:
    """A law along fibres that goes point by point, compiled.

    Attributes
    ----------
    step : callable
        `step(table, strain, stress, variables, slope)` brings stress (m,) and variables (m, k) up
        to date, and fills slope (m,), the derivative by the step of strain (m,).
    table : callable
        Parameters (n, m) as `step` reads them.
    """

    step: Callable[[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray], None]
    table: Callable[[PointParameters], FloatArray]

    def __call__(
        self, p: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
    ) -> Along:
        along = Along(stress.copy(), variables.copy(), np.empty(len(stress)))
        self.step(p.once(self.table), strain, *along)
        return along


def elastic(
    p: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Along:
    """`s = YOUN e`."""
    return Along(stress + p["YOUN"] * strain, variables, p["YOUN"])


def kinematic(
    p: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Along:
    """`|s - X| <= SIGY`, `dX = H dep`; variables EPSE (cumulated) and X."""
    E, limit, H = (p[n] for n in ("YOUN", "SIGY", "H"))
    trial = stress + E * strain
    over = trial - variables[:, 1]
    slip = np.maximum(np.abs(over) - limit, 0.0) / (E + H)
    sense = np.sign(over)
    after = np.column_stack([variables[:, 0] + slip, variables[:, 1] + H * slip * sense])
    return Along(trial - E * slip * sense, after, np.where(slip > 0, E * H / (E + H), E))


BAEL_PEAK = 2e-3
"""Strain at which BAEL's parabola reaches the strength."""


def concrete(
    p: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Along:
    """Concrete of the French rules BAEL: parabola and plateau in compression, no tension.

    The parabola `s = FC x (2 - x)`, x = -e / 0.002, ends in the plateau FC, without crushing.
    Unloading has the slope YOUN down to no stress; variables EPSE (plastic strain) and EPSO
    (strain).
    """
    E, strength = p["YOUN"], np.abs(p["FC"])
    plastic, e = variables[:, 0], variables[:, 1] + strain
    x = np.clip(-e / BAEL_PEAK, 0.0, 1.0)
    curve, rise = -strength * x * (2 - x), 2 * strength * (1 - x) / BAEL_PEAK
    line = np.minimum(E * (e - plastic), 0.0)
    yields = line < curve
    slope = np.where(yields, rise, np.where(e <= plastic, E, 0.0))  # closed at no stress too
    after = np.column_stack([np.where(yields, e - curve / E, plastic), e])
    return Along(np.where(yields, curve, line), after, slope)


def check_concrete(parameters: PointParameters) -> None:
    """Refuse concrete without strength."""
    if (parameters["FC"] == 0).any():
        raise MaterialError("kernel.materials.fc-concrete-needs-strength").about("FC")
