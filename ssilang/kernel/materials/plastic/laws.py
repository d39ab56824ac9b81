"""The plastic laws by the words of MODE: parameters, internal variables, function."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic import (
    creep,
    drucker_prager,
    rounded_coulomb,
    uniaxial,
    von_mises,
)
from ssilang.kernel.materials.plastic.response import PointParameters, Response

Respond = Callable[[PointParameters, FloatArray, FloatArray, FloatArray], Response]
"""Response from parameters, stress (m, 6), step of strain (m, 6), variables (m, k)."""
Columns = Callable[[PointParameters], dict[str, FloatArray]]
"""Numbers (m,) of a cone at m points."""


@dataclass(frozen=True)
class PlasticLaw:
    """One law.

    Attributes
    ----------
    respond : callable
    required : tuple of str
        Parameters beside YOUN and NU.
    variables : tuple of str
        Names of the internal variables, EPSE (cumulated plastic strain) first.
    positive : tuple of str
        Parameters that must be > 0.
    curves : tuple of str
        Parameters that are curves.
    check : callable or None
        Refuses other inadmissible parameters.
    symmetric : bool
        Whether the tangent is symmetric.
    uniaxial : bool
        A law of fibres: its stresses across the fibre are zero by themselves.
    optional : tuple of str
        Parameters that are taken and count for nothing here.
    timed : bool
        The duration of a step counts (parameter DT).
    columns : callable or None
        Of a cone of revolution: its numbers (m,) by the names of `cone_rows.ConeColumn`, for
        compiled passes over many points.
    """

    respond: Respond
    required: tuple[str, ...]
    variables: tuple[str, ...] = ("EPSE",)
    positive: tuple[str, ...] = ()
    curves: tuple[str, ...] = ()
    check: Callable[[PointParameters], None] | None = None
    symmetric: bool = True
    uniaxial: bool = False
    optional: tuple[str, ...] = ()
    timed: bool = False
    columns: Columns | None = None


_CENTRE = ("ALXX", "ALYY", "ALZZ", "ALXY", "ALXZ", "ALYZ")
_CONE = ("ALFA", "BETA", "K", "ETA", "MU", "KL", "H", "GAMM", "DELT")

PLASTIC_LAWS: dict[str, PlasticLaw] = {
    "PARFAIT": PlasticLaw(
        von_mises.perfect, ("SIGY",), positive=("SIGY",), columns=von_mises.perfect_columns
    ),
    "ISOTROPE": PlasticLaw(
        von_mises.isotropic, ("ECRO",), curves=("ECRO",), columns=von_mises.isotropic_columns
    ),
    "CINEMATIQUE": PlasticLaw(
        von_mises.kinematic,
        ("SIGY", "H"),
        ("EPSE", *_CENTRE),
        positive=("SIGY",),
        columns=von_mises.kinematic_columns,
    ),
    "J2": PlasticLaw(
        von_mises.saturating,
        ("SIG0", "SIGI", "KISO", "VELO"),
        positive=("SIG0",),
        check=von_mises.check_saturating,
        columns=von_mises.saturating_columns,
    ),
    "DRUCKER_PARFAIT": PlasticLaw(
        drucker_prager.perfect,
        ("LTR", "LCS"),
        check=drucker_prager.check_perfect,
        columns=drucker_prager.perfect_columns,
    ),
    "DRUCKER_PRAGER": PlasticLaw(
        drucker_prager.hardening,
        _CONE,
        check=drucker_prager.check_hardening,
        symmetric=False,
        columns=drucker_prager.hardening_columns,
    ),
    "RH_COULOMB": PlasticLaw(rounded_coulomb.respond, ("COHE", "PHI"), check=rounded_coulomb.check),
    "PARFAIT_UNI": PlasticLaw(
        uniaxial.kinematic, ("SIGY", "H"), ("EPSE", "ALXX"), positive=("SIGY",), uniaxial=True
    ),
    "BETON_BAEL": PlasticLaw(
        uniaxial.concrete, ("FC",), ("EPSE", "EPSO"), check=uniaxial.check_concrete, uniaxial=True
    ),
    "SECTION": PlasticLaw(uniaxial.elastic, ()),
}
"""By the word after PLASTIQUE; ISOTROPE is meant where there is none."""


CREEP_LAWS: dict[str, PlasticLaw] = {
    "NORTON": PlasticLaw(
        creep.norton, ("AF1", "AF2", "AF3"), check=creep.check, optional=("SMAX",), timed=True
    ),
}
"""By the word after FLUAGE."""


def plastic_law(behaviour: tuple[str, ...]) -> PlasticLaw | None:
    """The plastic (or creep) law in the words of a zone's behaviour, None for an elastic one.

    Raises
    ------
    MaterialError
        If the word after PLASTIQUE names no law.
    """
    if "FLUAGE" in behaviour:
        return CREEP_LAWS[behaviour[-1]]
    if "PLASTIQUE" not in behaviour:
        return None
    after = behaviour[behaviour.index("PLASTIQUE") + 1 :] or ("ISOTROPE",)
    if after[0] not in PLASTIC_LAWS:
        raise MaterialError(
            "kernel.materials.no-plastic-law-bodies", after=after[0], plastic_laws=PLASTIC_LAWS
        )
    return PLASTIC_LAWS[after[0]]


def check_parameters(law: PlasticLaw, parameters: PointParameters) -> None:
    """Refuse inadmissible parameters.

    Raises
    ------
    MaterialError
        Naming the parameter and its value.
    """
    for name in law.positive:
        if (parameters[name] <= 0).any():
            raise MaterialError(
                "kernel.materials.must", name=name, parameters_min=parameters[name].min()
            )
    for name in law.curves:
        for curve in parameters.curves[name][0]:
            if (curve.parts[0].ordinates <= 0).any():
                raise MaterialError("kernel.materials.curve-strengths-not", name=name)
    if law.check is not None:
        law.check(parameters)
