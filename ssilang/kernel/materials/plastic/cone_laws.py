"""Numbers of the laws on a cone: von Mises' cylinder, the cones of Drucker and Prager for soils."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.response import PointParameters


def mises(parameters: PointParameters) -> dict[str, FloatArray]:
    """Elastic, perfectly plastic: `q <= SIGY`; variable EPSE."""
    return {"FIRST": parameters["SIGY"]}


def isotropic(parameters: PointParameters) -> dict[str, FloatArray]:
    """`q <= ECRO(p)`: all is in its curve; variable EPSE."""
    return {}


def check_strengths(parameters: PointParameters) -> None:
    """Refuse hardening curves with strengths that are not positive."""
    for curve in parameters.curves["ECRO"][0]:
        if (curve.parts[0].ordinates <= 0).any():
            raise MaterialError("kernel.materials.curve-strengths-not", name="ECRO")


def kinematic(parameters: PointParameters) -> dict[str, FloatArray]:
    """`q(s - X) <= SIGY`, `dX = 2/3 H dep` (Prager); variables EPSE and X."""
    return {"FIRST": parameters["SIGY"], "KINEMATIC": parameters["H"]}


def saturating(parameters: PointParameters) -> dict[str, FloatArray]:
    """Law J2: `q <= SIG0 + KISO p + (SIGI - SIG0) (1 - exp(-VELO p))`; variable EPSE.

    Simo and Hughes, Computational Inelasticity (1998), section 3.3: saturation and a line.
    """
    return {
        "FIRST": parameters["SIG0"],
        "SLOPE": parameters["KISO"],
        "RISE": parameters["SIGI"] - parameters["SIG0"],
        "RATE": parameters["VELO"],
    }


def check_saturating(parameters: PointParameters) -> None:
    """Refuse strengths that sink."""
    slope, rate = parameters["KISO"], parameters["VELO"]
    falls = (rate > 0) & (parameters["SIGI"] < parameters["SIG0"])
    if (falls | (slope < 0) | (rate < 0)).any():
        raise MaterialError("kernel.materials.saturation-sinks").about("SIGI", "KISO", "VELO")


def drucker(parameters: PointParameters) -> dict[str, FloatArray]:
    """Cone through the simple strengths LTR (tension) and LCS (compression); variable EPSE."""
    tension, compression = parameters["LTR"], np.abs(parameters["LCS"])
    alpha = (compression - tension) / (compression + tension)
    limit = 2 * compression * tension / (compression + tension)
    return {"ALPHA": alpha, "GAMMA": alpha, "FIRST": limit}


def check_drucker(parameters: PointParameters) -> None:
    """Refuse strengths without a cone: it needs LTR > 0 and |LCS| >= LTR."""
    tension, compression = parameters["LTR"], np.abs(parameters["LCS"])
    if (tension <= 0).any() or (compression < tension).any():
        told = {"tension_min": tension.min(), "compression_min": compression.min()}
        raise MaterialError("kernel.materials.drucker-parfait-ltr-lcs", **told)


def drucker_prager(parameters: PointParameters) -> dict[str, FloatArray]:
    """`ALFA tr(s) + BETA q <= K + H p`, up to the ultimate cone; flow by GAMM and DELT.

    The ultimate strength bounds K from above. One that falls (H < 0) ends at an ultimate strength
    below the first, else at zero.
    """
    limit, slope = parameters["K"], parameters["H"]
    last = parameters["KL"] * parameters["BETA"] / parameters["MU"]
    falls = slope < 0
    last = np.where(falls & (last >= limit), 0.0, last)
    numbers = {"FIRST": limit, "SLOPE": slope, "LAST": last, "SINKS": falls.astype(float)}
    words = {"ALPHA": "ALFA", "BETA": "BETA", "GAMMA": "GAMM", "DELTA": "DELT"}
    return numbers | {column: parameters[word] for column, word in words.items()}


def check_drucker_prager(parameters: PointParameters) -> None:
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
