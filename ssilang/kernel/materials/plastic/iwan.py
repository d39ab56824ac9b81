"""Cyclic soil by nested surfaces: Iwan's parts side by side, von Mises in each.

The soil is a bundle of elastic, perfectly plastic parts that share the strain. In simple shear the
first loading follows a polygon through the points of a curve of G/Gmax, unloading and reloading
twice that polygon (Masing); the volume stays elastic. W. D. Iwan, On a class of models for the
yielding behavior of continuous and composite systems, J. Appl. Mech. 34 (1967) 612-617; in space,
surfaces of von Mises one inside the other as in Z. Mroz (1967) and J. H. Prevost (1978). The parts
have associated flow and no hardening: dissipation is never negative, the tangent symmetric.

Where pressure counts, all strengths are in proportion to it: cones one inside the other, with flow
that keeps the volume; the modulus stays.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.materials.plastic.backbone import Backbones, backbones, break_points
from ssilang.kernel.materials.plastic.response import PointParameters, Response, mises

CURVE = "GGAM"
"""The parameter: a curve of G/Gmax over the shear strain."""
PRESSURE = "PREF"
"""The pressure at which the curve holds."""
LEAST = 0.01
"""Share of the strengths that no loss of pressure takes away: a stiffness is left in tension."""
_COMPONENTS = ("XX", "YY", "XY", "XZ", "YZ")


def check(parameters: PointParameters) -> None:
    """Refuse curves that no soil has.

    Raises
    ------
    MaterialError
    """
    for curve in parameters.curves[CURVE][0]:
        break_points(curve)


def variables(parts: Backbones) -> tuple[str, ...]:
    """EPSE, then the deviators of the parts: XX01 YY01 XY01 XZ01 YZ01 XX02 ..."""
    n = parts.shares.shape[1]
    inner = [f"{c}{i:02d}" for i in range(1, n + 1) for c in _COMPONENTS]
    return ("EPSE", *inner)


def parts_of(parameters: PointParameters) -> Backbones:
    """The parts that the curves ask for."""
    return backbones(*parameters.curves[CURVE])


def respond(
    parts: Backbones,
    parameters: PointParameters,
    stress: FloatArray,
    strain: FloatArray,
    variables: FloatArray,
) -> Response:
    """The deviator is the sum over the parts; variables EPSE and the parts' deviators.

    A stress that no part bears (given from outside) stays as it is.
    """
    from ssilang.kernel.materials.plastic.iwan_return import return_to_surfaces

    m = len(stress)
    moduli = np.column_stack([parameters.shear, parameters.bulk])
    strength = _strength(parameters, stress, strain)
    after, inner, tangent = stress.copy(), variables.copy(), np.empty((m, 6, 6))
    return_to_surfaces(
        moduli, parts.strains, parts.shares, parts.which, np.ascontiguousarray(strain), strength,
        after, inner, tangent, np.empty((2, 6)),
    )  # fmt: skip
    return Response(after, inner, tangent)


def _strength(parameters: PointParameters, stress: FloatArray, strain: FloatArray) -> FloatArray:
    """Factor of the strengths at the end of a step, its derivative by the trace of the strain."""
    found = np.zeros((len(stress), 2))
    found[:, 0] = 1.0
    if PRESSURE in parameters.values:
        traces = stress[:, :3].sum(axis=1) / 3 + parameters.bulk * strain[:, :3].sum(axis=1)
        share = -traces / parameters[PRESSURE]
        found[:, 0] = np.maximum(share, LEAST)
        found[:, 1] = np.where(share > LEAST, -parameters.bulk / parameters[PRESSURE], 0.0)
    return found


def locked(
    parts: Backbones, parameters: PointParameters, stress: FloatArray, variables: FloatArray
) -> FloatArray:
    """Elastic energy (m,) of the parts beyond that of the stress that they make together."""
    m, n = len(stress), parts.shares.shape[1]
    inner = variables[:, 1:].reshape(m, n, 5)
    zz = inner[..., 0] + inner[..., 1]
    square = inner[..., 0] ** 2 + inner[..., 1] ** 2 + zz**2
    square = square + 2.0 * (inner[..., 2:] ** 2).sum(axis=-1)
    shares = parts.shares[parts.which]
    own = np.divide(square, shares, out=np.zeros_like(square), where=shares > 0).sum(axis=1)
    return (0.25 * own - mises(_sum(inner))[0] ** 2 / 6.0) / parameters.shear


def slid_last(
    parts: Backbones,
    parameters: PointParameters,
    stress: FloatArray,
    plastic: FloatArray,
    variables: FloatArray,
) -> FloatArray:
    """Slip (m, 5) of the last part to yield, in shear strains over its threshold.

    Other than before a run where the strain was beyond the last point of the curve on the way.
    """
    last = np.array([np.flatnonzero(share)[-1] for share in parts.shares])[parts.which]
    m = np.arange(len(stress))
    bears = variables[:, 1:].reshape(len(stress), -1, 5)[m, last]
    own = parts.shares[parts.which, last] * parameters.shear
    kept = [0, 1, 3, 4, 5]
    mean = np.array([1.0, 1.0, 0.0, 0.0, 0.0]) / 3.0
    elastic = stress[:, kept] - stress[:, :3].sum(axis=1)[:, None] * mean
    flown = plastic[:, kept] - plastic[:, :3].sum(axis=1)[:, None] * mean
    flown[:, 2:] *= 0.5
    slip = elastic / (2.0 * parameters.shear)[:, None] + flown - bears / (2.0 * own)[:, None]
    return 2.0 * slip / parts.strains[parts.which, last][:, None]


def _sum(inner: FloatArray) -> FloatArray:
    """Stresses (m, 6) of the parts together."""
    total = inner.sum(axis=1)
    zz = -total[:, :1] - total[:, 1:2]
    return np.concatenate([total[:, :2], zz, total[:, 2:]], axis=1)
