"""Parameters of the joint laws: defaults, admissibility."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.laws.columns import Parameter

DEFAULTS: dict[str, float] = {"FROT": -1.0, "ETA": 1.0, "BETA": 0.5}
"""What laws take for the parameters that are not given, if not 0: a joint without tension, the
plainest hysteresis."""

HARD_AREA = 0.1
"""Share of the area of each place under a footing that its hard spots take (PDUR)."""


def check_sdm_parameters(parameters: FloatArray) -> None:
    """Refuse parameters for which the SDM law has no traction or several.

    Parameters
    ----------
    parameters : array (n, N_PARAMETERS)

    Raises
    ------
    MaterialError
        If KN <= 0, KS < 0, FU < 0, GF < 0, FC > 0, a perfectly brittle point (FU > 0 with
        GF = 0), or KN <= FU^2 / GF: softening would be steeper than the elastic unloading, so
        that one opening would have several tractions. The message names the least admissible KN
        and the largest admissible FU.
    """
    columns = {p.name: parameters[:, p] for p in Parameter}
    _refuse(columns["KN"] <= 0, columns["KN"], "KN", "> 0")
    for name in ("KS1", "KS2", "FU", "GF"):
        _refuse(columns[name] < 0, columns[name], name, ">= 0")
    _refuse(columns["FC"] > 0, columns["FC"], "FC", "<= 0 (it is a compression)")
    if not np.isfinite(parameters).all():
        raise MaterialError("kernel.interface.joint-parameter-not-finite")
    brittle = (columns["FU"] > 0) & (columns["GF"] == 0)
    if brittle.any():
        fu, kn = columns["FU"][brittle].max(), columns["KN"][brittle].min()
        raise MaterialError("kernel.interface.joint-fu-gf-perfectly", fu=fu, fu_2=fu * fu / kn)
    _check_snap_back(columns["KN"], columns["FU"], columns["GF"])


def check_mohr_parameters(parameters: FloatArray) -> None:
    """Refuse parameters of a Mohr-Coulomb joint that have no meaning.

    Raises
    ------
    MaterialError
        If KN <= 0, or a shear stiffness, angle, cohesion or strength is negative, or the
        hardening in compression is not below the elastic stiffness.
    """
    columns = {p.name: parameters[:, p] for p in Parameter}
    if not np.isfinite(parameters).all():
        raise MaterialError("kernel.interface.joint-parameter-not-finite-or-steep")
    _refuse(columns["KN"] <= 0, columns["KN"], "KN", "> 0")
    for name in ("KS1", "KS2", "TPHI", "TPSI", "COHE", "FTRC", "EF", "ECN", "FNE", "QT"):
        _refuse(columns[name] < 0, columns[name], name, ">= 0")
    _refuse((columns["FNE"] > 0) & (columns["QT"] >= columns["KN"]), columns["QT"], "QT", "< KN")


def check_macro_parameters(parameters: FloatArray) -> None:
    """Refuse a macro-element without stiffness or size.

    Raises
    ------
    MaterialError
        Naming the parameter.
    """
    if not np.isfinite(parameters).all():
        raise MaterialError("kernel.interface.joint-parameter-not-finite")
    columns = {p.name: parameters[:, p] for p in Parameter}
    _refuse(columns["KN"] <= 0, columns["KN"], "KN", "> 0")
    for name in ("LARG", "LONG", "RAYO"):
        _refuse(columns[name] < 0, columns[name], name, "> 0")
    for name in ("COHE", "QULT"):
        _refuse(columns[name] < 0, columns[name], name, ">= 0")
    spots = columns["PDUR"]
    even = (spots == 0) | ((spots > HARD_AREA) & (spots < 1))
    _refuse(~even, spots, "PDUR", f"0, {HARD_AREA} < ... < 1")
    strong = columns["COHE"] == 0.0
    for name, idle in (("QULT", 0.0), ("FROT", -1.0), ("PDUR", 0.0)):
        if (strong & (columns[name] > idle)).any():
            raise MaterialError("kernel.interface.macro-needs-cohe", name=name)


def check_lead_parameters(parameters: FloatArray) -> None:
    """Refuse a lead and rubber bearing without stiffness, strength or hysteresis.

    Raises
    ------
    MaterialError
        Naming the parameter.
    """
    columns = _bearing_columns(parameters)
    _refuse(columns["QD"] <= 0, columns["QD"], "QD", "> 0")
    _refuse(columns["KPOS"] < 0, columns["KPOS"], "KPOS", ">= 0")
    _refuse(columns["KPOS"] >= columns["KS1"], columns["KPOS"], "KPOS", "< KS")
    _refuse(columns["ETA"] < 1, columns["ETA"], "ETA", ">= 1")
    _refuse((columns["BETA"] < 0.5) | (columns["BETA"] > 1), columns["BETA"], "BETA", "0.5 ... 1")


def check_pendulum_parameters(parameters: FloatArray) -> None:
    """Refuse a friction pendulum without bowl or friction.

    Raises
    ------
    MaterialError
        Naming the parameter.
    """
    columns = _bearing_columns(parameters)
    _refuse(columns["RAYO"] <= 0, columns["RAYO"], "RAYO", "> 0")
    _refuse(columns["FROT"] < 0, columns["FROT"], "FROT", ">= 0")


def _bearing_columns(parameters: FloatArray) -> dict[str, FloatArray]:
    if not np.isfinite(parameters).all():
        raise MaterialError("kernel.interface.joint-parameter-not-finite")
    columns = {p.name: parameters[:, p] for p in Parameter}
    for name in ("KN", "KS1"):
        _refuse(columns[name] <= 0, columns[name], name, "> 0")
    # KS2 is 0 in the plane, where there is no second direction
    other = (columns["KS2"] != columns["KS1"]) & (columns["KS2"] != 0)
    _refuse(other, columns["KS2"], "KS2", "= KS1")
    return columns


def _refuse(wrong: np.ndarray, values: FloatArray, name: str, wanted: str) -> None:
    if wrong.any():
        raise MaterialError(
            "kernel.interface.joint-parameter-must",
            name=name,
            values=values[wrong][0],
            wanted=wanted,
        )


def _check_snap_back(kn: FloatArray, fu: FloatArray, gf: FloatArray) -> None:
    steep = (fu > 0) & (kn * gf <= fu * fu)
    if steep.any():
        at = int(np.flatnonzero(steep)[0])
        least, largest = fu[at] ** 2 / gf[at], np.sqrt(kn[at] * gf[at])
        raise MaterialError(
            "kernel.interface.kn-must-exceed-fu", kn=kn[at], least=least, largest=largest
        )
