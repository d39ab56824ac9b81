"""Laws of fibres: one stress along the fibre; shear stays elastic."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.response import PointParameters, Response


def elastic_shear(p: PointParameters, stress: FloatArray, strain: FloatArray) -> FloatArray:
    """Stresses (m, 6) at the end of a step, XX not yet."""
    found = np.zeros_like(stress)
    found[:, 3:5] = stress[:, 3:5] + p.shear[:, None] * strain[:, 3:5]
    return found


def fibre_tangent(p: PointParameters, along: FloatArray) -> FloatArray:
    """Tangent (m, 6, 6) of fibres from the slope along them."""
    D = np.zeros((len(along), 6, 6))
    D[:, 0, 0] = along
    D[:, 3, 3] = D[:, 4, 4] = p.shear
    return D


def elastic(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """`s = YOUN e`."""
    found = elastic_shear(parameters, stress, strain)
    found[:, 0] = stress[:, 0] + parameters["YOUN"] * strain[:, 0]
    return Response(found, variables, fibre_tangent(parameters, parameters["YOUN"]))


def kinematic(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """`|s - X| <= SIGY`, `dX = H dep`; variables EPSE (cumulated) and X."""
    E, limit, H = (parameters[n] for n in ("YOUN", "SIGY", "H"))
    found = elastic_shear(parameters, stress, strain)
    trial = stress[:, 0] + E * strain[:, 0]
    over = trial - variables[:, 1]
    slip = np.maximum(np.abs(over) - limit, 0.0) / (E + H)
    sense = np.sign(over)
    found[:, 0] = trial - E * slip * sense
    after = np.column_stack([variables[:, 0] + slip, variables[:, 1] + H * slip * sense])
    slope = np.where(slip > 0, E * H / (E + H), E)
    return Response(found, after, fibre_tangent(parameters, slope))


BAEL_PEAK = 2e-3
"""Strain at which BAEL's parabola reaches the strength."""


def concrete(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Concrete of the French rules BAEL: parabola and plateau in compression, no tension.

    The parabola `s = FC x (2 - x)`, x = -e / 0.002, ends in the plateau FC, without crushing.
    Unloading has the slope YOUN down to no stress; variables EPSE (plastic strain) and EPSO
    (strain).
    """
    E, strength = parameters["YOUN"], np.abs(parameters["FC"])
    found = elastic_shear(parameters, stress, strain)
    plastic, e = variables[:, 0], variables[:, 1] + strain[:, 0]
    x = np.clip(-e / BAEL_PEAK, 0.0, 1.0)
    curve, rise = -strength * x * (2 - x), 2 * strength * (1 - x) / BAEL_PEAK
    line = np.minimum(E * (e - plastic), 0.0)
    yields = line < curve
    found[:, 0] = np.where(yields, curve, line)
    slope = np.where(yields, rise, np.where(line < 0, E, 0.0))
    after = np.column_stack([np.where(yields, e - curve / E, plastic), e])
    return Response(found, after, fibre_tangent(parameters, slope))


def check_concrete(parameters: PointParameters) -> None:
    """Refuse concrete without strength.

    Raises
    ------
    MaterialError
        If FC = 0.
    """
    if (parameters["FC"] == 0).any():
        raise MaterialError("kernel.materials.fc-concrete-needs-strength", names=("FC",))
