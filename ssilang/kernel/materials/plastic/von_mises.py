"""Von Mises' plasticity: perfect, with isotropic, saturating or linear kinematic hardening."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.cone import Cone, Hardening, cone_return
from ssilang.kernel.materials.plastic.response import PointParameters, Response, mises


def _cylinder(m: int, hardening: Hardening, kinematic: FloatArray | None = None) -> Cone:
    one, zero = np.ones(m), np.zeros(m)
    return Cone(zero, one, zero, one, zero if kinematic is None else kinematic, hardening)


def perfect(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Elastic, perfectly plastic: `q <= SIGY`; variable EPSE."""
    limit = parameters["SIGY"]

    def strength(rows: IntArray, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        return limit[rows], np.zeros(len(rows))

    return _isotropic(parameters, stress, strain, variables, strength)


def perfect_columns(parameters: PointParameters) -> dict[str, FloatArray]:
    """`perfect` in numbers."""
    return {"FIRST": parameters["SIGY"]}


def isotropic_columns(parameters: PointParameters) -> dict[str, FloatArray]:
    """`isotropic` in numbers: all is in its curve."""
    return {}


def kinematic_columns(parameters: PointParameters) -> dict[str, FloatArray]:
    """`kinematic` in numbers."""
    return {"FIRST": parameters["SIGY"], "KINEMATIC": parameters["H"]}


def saturating_columns(parameters: PointParameters) -> dict[str, FloatArray]:
    """`saturating` in numbers."""
    return {
        "FIRST": parameters["SIG0"],
        "SLOPE": parameters["KISO"],
        "RISE": parameters["SIGI"] - parameters["SIG0"],
        "RATE": parameters["VELO"],
    }


def isotropic(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """`q <= ECRO(p)`; variable EPSE."""

    def strength(rows: IntArray, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        return parameters.at(rows).curve("ECRO", p)

    return _isotropic(parameters, stress, strain, variables, strength)


def check_strengths(parameters: PointParameters) -> None:
    """Refuse hardening curves with strengths that are not positive.

    Raises
    ------
    MaterialError
    """
    for curve in parameters.curves["ECRO"][0]:
        if (curve.parts[0].ordinates <= 0).any():
            raise MaterialError("kernel.materials.curve-strengths-not", name="ECRO")


def saturating(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Law J2: `q <= SIG0 + KISO p + (SIGI - SIG0) (1 - exp(-VELO p))`; variable EPSE.

    Simo and Hughes, Computational Inelasticity (1998), section 3.3: saturation and a line.
    """
    first, last = parameters["SIG0"], parameters["SIGI"]
    slope, rate = parameters["KISO"], parameters["VELO"]

    def strength(rows: IntArray, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        rise, left = (last - first)[rows], np.exp(-rate[rows] * p)
        limit = first[rows] + slope[rows] * p + rise * (1.0 - left)
        return limit, slope[rows] + rise * rate[rows] * left

    return _isotropic(parameters, stress, strain, variables, strength)


def check_saturating(parameters: PointParameters) -> None:
    """Refuse strengths that sink.

    Raises
    ------
    MaterialError
    """
    slope, rate = parameters["KISO"], parameters["VELO"]
    falls = (rate > 0) & (parameters["SIGI"] < parameters["SIG0"])
    if (falls | (slope < 0) | (rate < 0)).any():
        raise MaterialError("kernel.materials.saturation-sinks").about("SIGI", "KISO", "VELO")


def _isotropic(
    parameters: PointParameters,
    stress: FloatArray,
    strain: FloatArray,
    variables: FloatArray,
    strength: Hardening,
) -> Response:
    trial = stress + np.einsum("mij,mj->mi", parameters.moduli, strain)
    cone = _cylinder(len(stress), strength)
    found, p, tangent = cone_return(parameters, cone, trial, variables[:, 0])
    return Response(found, p[:, None], tangent)


def kinematic(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """`q(s - X) <= SIGY`, `dX = 2/3 H dep` (Prager); variables EPSE and X."""
    limit, H = parameters["SIGY"], parameters["H"]

    def strength(rows: IntArray, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        return limit[rows], np.zeros(len(rows))

    centre = variables[:, 1:7]
    trial = stress + np.einsum("mij,mj->mi", parameters.moduli, strain) - centre
    cone = _cylinder(len(stress), strength, H)
    found, p, tangent = cone_return(parameters, cone, trial, variables[:, 0])
    q, deviator = mises(trial)
    N = deviator / np.maximum(q, 1e-300)[:, None]
    moved = centre + (H * (p - variables[:, 0]))[:, None] * N
    return Response(found + centre, np.column_stack([p, moved]), tangent)
