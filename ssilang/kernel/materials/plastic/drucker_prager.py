"""Drucker and Prager's cone for soils: perfect and associated, or hardening with its own flow."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.cone import Cone, cone_return
from ssilang.kernel.materials.plastic.response import PointParameters, Response


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
        raise MaterialError(
            "kernel.materials.drucker-parfait-ltr-lcs",
            tension_min=tension.min(),
            compression_min=compression.min(),
        )


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
        raise MaterialError(
            "kernel.materials.ultimate-cone-drucker-prager",
            eta=(eta / mu).flat[0],
            alpha=(alpha / beta).flat[0],
        )
