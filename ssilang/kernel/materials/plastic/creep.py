"""Creep by Norton's law with strain hardening.

Under a constant stress the equivalent creep strain is `AF1 q^AF2 t^AF3`; where the stress changes
the rate depends on stress and strain alone, the time being the one that the strain would have
taken. Over a step the stress at its end counts (implicit, exact under constant stress).
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.response import (
    DEVIATOR,
    UNIT,
    PointParameters,
    Response,
    mises,
)

DURATION = "DT"
"""Duration of the step among the parameters of a point."""
TURNS = 300


def norton(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Parameters AF1 AF2 AF3; variable EPSE, the equivalent creep strain."""
    moduli, before = parameters.moduli, variables[:, 0]
    trial = stress + np.einsum("mij,mj->mi", moduli, strain)
    top, deviator = mises(trial)
    stiff = 3.0 * parameters.shear
    q = top.copy()
    for _ in range(TURNS):
        strained, slope = _crept(parameters, q, before)
        step = (q + stiff * (strained - before) - top) / (1.0 + stiff * slope)
        # the residual is convex and q at or above its root: Newton falls towards it
        q = np.clip(q - step, 0.0, top)
        if (np.abs(step) <= 1e-14 * top).all():
            break
    strained, slope = _crept(parameters, q, before)
    ratio = np.divide(q, top, out=np.ones_like(q), where=top > 0)
    found = trial - (1.0 - ratio)[:, None] * deviator
    bulk = parameters.bulk[:, None, None] * np.outer(UNIT, UNIT)
    turning = np.divide(
        stiff * (1.0 / (1.0 + stiff * slope) - ratio), top**2, out=np.zeros_like(q), where=top > 0
    )
    tangent = bulk + (2.0 * parameters.shear * ratio)[:, None, None] * DEVIATOR
    tangent = tangent + turning[:, None, None] * deviator[:, :, None] * deviator[:, None, :]
    return Response(found, strained[:, None], tangent)


def pace(parameters: PointParameters, q: FloatArray) -> FloatArray:
    """What the creep strain to the power 1 / AF3 grows by in the step, under the stress q (m,)."""
    power, age = parameters["AF2"], parameters["AF3"]
    return np.asarray((parameters["AF1"] * q**power) ** (1.0 / age) * parameters[DURATION])


def _crept(
    parameters: PointParameters, q: FloatArray, before: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Creep strain at the end of the step under the stress q, and its derivative by q."""
    power, age = parameters["AF2"], parameters["AF3"]
    unit = pace(parameters, q)
    total = before ** (1.0 / age) + unit
    found = total**age
    rise = np.divide(found * power * unit, total * q, out=np.zeros_like(q), where=total * q > 0)
    return np.maximum(found, before), rise


def check(parameters: PointParameters) -> None:
    """Refuse exponents for which a step has no single answer.

    Raises
    ------
    MaterialError
        Unless AF1 >= 0, AF2 >= 1 and 0 < AF3 <= AF2, so that strains are convex in the stress.
    """
    limits = (("AF1", 0.0, np.inf), ("AF2", 1.0, np.inf), ("AF3", 1e-6, parameters["AF2"]))
    for name, low, high in limits:
        wrong = (parameters[name] < low) | (parameters[name] > high)
        if wrong.any():
            raise MaterialError(
                "kernel.materials.norton", name=name, parameters=parameters[name][wrong][0]
            )
