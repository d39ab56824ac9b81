"""The plastic laws by the words of MODE: parameters, internal variables, function."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.cloud import Cloud
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.materials.plastic import (
    cam_clay,
    cone_laws,
    creep,
    hognestad,
    iwan,
    mazars,
    menegotto_pinto,
    rounded_coulomb,
    uniaxial,
)
from ssilang.kernel.materials.plastic.backbone import Backbones
from ssilang.kernel.materials.plastic.cone import Cone
from ssilang.kernel.materials.plastic.response import PointParameters, Response

Respond = Callable[[PointParameters, FloatArray, FloatArray, FloatArray], Response]
"""Response from parameters, stress (m, 6), step of strain (m, 6), variables (m, k)."""


@dataclass(frozen=True)
class PlasticLaw:
    """One law.

    Attributes
    ----------
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
    optional : tuple of str
        Parameters that are taken and count for nothing here.
    defaults : mapping of str to float
        Parameters that need not be given, and what they are then.
    timed : bool
        The duration of a step counts (parameter DT).
    locked : callable or None
        Energy density (m,) that stress (m, 6) and variables store beyond the elastic energy of
        the stress.
    shaped : callable or None
        The law as its parameters shape it: how many variables there are, what of them is the same
        at all steps. See `law_at`.
    parts : Backbones or None
        Parts side by side, of a law that is shaped to have them.
    slid : callable or None
        Slip (m, n) beyond the last point of the curve, from stress, plastic strain, variables.
    """

    respond: Respond
    required: tuple[str, ...]
    variables: tuple[str, ...] = ("EPSE",)
    positive: tuple[str, ...] = ()
    curves: tuple[str, ...] = ()
    check: Callable[[PointParameters], None] | None = None
    symmetric: bool = True
    optional: tuple[str, ...] = ()
    defaults: Mapping[str, float] = field(default_factory=dict)
    timed: bool = False
    locked: Callable[[PointParameters, FloatArray, FloatArray], FloatArray] | None = None
    shaped: "Callable[[PlasticLaw, PointParameters], PlasticLaw] | None" = None
    parts: Backbones | None = None
    slid: Callable[[PointParameters, FloatArray, FloatArray, FloatArray], FloatArray] | None = None

    @property
    def uniaxial(self) -> bool:
        """Whether it is a law along fibres."""
        return isinstance(self.respond, uniaxial.Fibres)

    @property
    def cone(self) -> Cone | None:
        """The cone that it is."""
        return self.respond if isinstance(self.respond, Cone) else None


def _iwan(law: PlasticLaw, parameters: PointParameters) -> PlasticLaw:
    parts = iwan.parts_of(parameters)
    return replace(
        law,
        variables=iwan.variables(parts),
        parts=parts,
        respond=partial(iwan.respond, parts),
        locked=partial(iwan.locked, parts),
        slid=partial(iwan.slid_last, parts),
    )


def _in_parts(law: PlasticLaw, parameters: PointParameters) -> PlasticLaw:
    if np.all(parameters.values.get("NSUB", 1.0) <= 1):
        return law
    return replace(law, variables=("EPSE", "NSUB"), respond=rounded_coulomb.respond_in_parts)


def _of_its_shape(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    return law_at(PLASTIC_LAWS["IWAN"], parameters).respond(parameters, stress, strain, variables)


_CENTRE = ("ALXX", "ALYY", "ALZZ", "ALXY", "ALXZ", "ALYZ")
_CONE = ("ALFA", "BETA", "K", "ETA", "MU", "KL", "H", "GAMM", "DELT")

PLASTIC_LAWS: dict[str, PlasticLaw] = {
    "PARFAIT": PlasticLaw(Cone(cone_laws.mises), ("SIGY",), positive=("SIGY",)),
    "ISOTROPE": PlasticLaw(
        Cone(cone_laws.isotropic, "ECRO"),
        ("ECRO",),
        curves=("ECRO",),
        check=cone_laws.check_strengths,
    ),
    "CINEMATIQUE": PlasticLaw(
        Cone(cone_laws.kinematic), ("SIGY", "H"), ("EPSE", *_CENTRE), positive=("SIGY",)
    ),
    "J2": PlasticLaw(
        Cone(cone_laws.saturating),
        ("SIG0", "SIGI", "KISO", "VELO"),
        positive=("SIG0",),
        check=cone_laws.check_saturating,
    ),
    "DRUCKER_PARFAIT": PlasticLaw(
        Cone(cone_laws.drucker), ("LTR", "LCS"), check=cone_laws.check_drucker
    ),
    "DRUCKER_PRAGER": PlasticLaw(
        Cone(cone_laws.drucker_prager),
        _CONE,
        check=cone_laws.check_drucker_prager,
        symmetric=False,
    ),
    "RH_COULOMB": PlasticLaw(
        rounded_coulomb.respond,
        ("COHE", "PHI"),
        check=rounded_coulomb.check,
        defaults={"NSUB": 1.0, "NITE": 15.0},
        shaped=_in_parts,
    ),
    "IWAN": PlasticLaw(
        _of_its_shape, (iwan.CURVE,), curves=(iwan.CURVE,), check=iwan.check, shaped=_iwan
    ),
    "IWAN_PRESSION": PlasticLaw(
        _of_its_shape,
        (iwan.CURVE, iwan.PRESSURE),
        positive=(iwan.PRESSURE,),
        curves=(iwan.CURVE,),
        check=iwan.check,
        symmetric=False,
        shaped=_iwan,
    ),
    "CAM_CLAY": PlasticLaw(
        cam_clay.respond,
        cam_clay.REQUIRED,
        cam_clay.VARIABLES,
        positive=("M", "P0", "KAPA", "LAMD", "G1"),
        check=cam_clay.check,
        symmetric=False,
        defaults={"COHE": 0.0},
        locked=cam_clay.locked,
    ),
    "PARFAIT_UNI": PlasticLaw(
        uniaxial.Fibres(uniaxial.kinematic), ("SIGY", "H"), ("EPSE", "ALXX"), positive=("SIGY",)
    ),
    "BETON_BAEL": PlasticLaw(
        uniaxial.Fibres(uniaxial.concrete), ("FC",), ("EPSE", "EPSO"), check=uniaxial.check_concrete
    ),
    "ACIER_UNI": PlasticLaw(
        uniaxial.Fibres(menegotto_pinto.STEEL),
        menegotto_pinto.REQUIRED,
        menegotto_pinto.VARIABLES,
        positive=("STSY",),
        check=menegotto_pinto.check,
        defaults=dict.fromkeys(menegotto_pinto.BUCKLING, 0.0),
    ),
    "BETON_UNI": PlasticLaw(
        uniaxial.Fibres(hognestad.CONCRETE),
        hognestad.REQUIRED,
        hognestad.VARIABLES,
        positive=("STFC", "EZER"),
        check=hognestad.check,
        optional=hognestad.UNUSED,
        defaults=hognestad.DEFAULTS,
    ),
    "SECTION": PlasticLaw(uniaxial.Fibres(uniaxial.elastic), ()),
}
"""By the word after PLASTIQUE; ISOTROPE is meant where there is none."""


CREEP_LAWS: dict[str, PlasticLaw] = {
    "NORTON": PlasticLaw(
        creep.norton, ("AF1", "AF2", "AF3"), check=creep.check, optional=("SMAX",), timed=True
    ),
}
"""By the word after FLUAGE."""

DAMAGE_LAWS: dict[str, PlasticLaw] = {
    "MAZARS": PlasticLaw(
        mazars.respond,
        mazars.REQUIRED,
        mazars.VARIABLES,
        positive=("KTR0", "BTRA", "BCOM"),
        check=mazars.check,
        symmetric=False,
        defaults=mazars.DEFAULTS,
        locked=mazars.locked,
    ),
}
"""By the word after ENDOMMAGEMENT."""


def plastic_law(behaviour: tuple[str, ...]) -> PlasticLaw | None:
    """The law of flow, creep or damage in the words of a zone's behaviour, None for an elastic one.

    Raises
    ------
    MaterialError
        If the word after PLASTIQUE names no law.
    """
    for group, laws in (("FLUAGE", CREEP_LAWS), ("ENDOMMAGEMENT", DAMAGE_LAWS)):
        if group in behaviour:
            return laws[behaviour[-1]]
    if "PLASTIQUE" not in behaviour:
        return None
    after = behaviour[behaviour.index("PLASTIQUE") + 1 :] or ("ISOTROPE",)
    if after[0] not in PLASTIC_LAWS:
        raise MaterialError(
            "kernel.materials.no-plastic-law-bodies", after=after[0], plastic_laws=PLASTIC_LAWS
        )
    return PLASTIC_LAWS[after[0]]


def law_at(law: PlasticLaw, parameters: PointParameters) -> PlasticLaw:
    """A law as these parameters shape it."""
    return law if law.shaped is None else law.shaped(law, parameters)


def check_parameters(law: PlasticLaw, parameters: PointParameters) -> None:
    """Refuse inadmissible parameters."""
    for name in law.positive:
        if (parameters[name] <= 0).any():
            raise MaterialError(
                "kernel.materials.must", name=name, parameters_min=parameters[name].min()
            )
    if law.check is not None:
        law.check(parameters)


def check_given(law: PlasticLaw, values: Mapping[str, NDArray[Any]]) -> None:
    """Let a law look at its parameters as soon as they are given.

    Nothing is checked while a required parameter is still missing, or depends on a field.

    Parameters
    ----------
    values : mapping of str to array (n, p)
        Parameters on the cells, p = 1 where they are constant in a cell.

    Raises
    ------
    MaterialError
        If the law refuses the values.
    """
    numbers = {"YOUN", "NU", *law.required, *law.defaults} - set(law.curves)
    given = {n: np.asarray(values[n]) for n in (*numbers, *law.curves) if n in values}
    wanted = {"YOUN", "NU", *law.required}
    if not wanted <= set(given) or any(given[n].dtype == object for n in numbers & set(given)):
        return
    if any(isinstance(v, Cloud) for n in {*law.curves} & set(given) for v in given[n].flat):
        return  # it becomes a curve where fields are known
    if len({v.shape[1] for v in given.values()} - {1}) > 1:
        return
    shape = np.broadcast_shapes(*(v.shape for v in given.values()))
    flat = {n: np.broadcast_to(v, shape).ravel() for n, v in given.items()}
    for name, default in law.defaults.items():
        flat.setdefault(name, np.full(shape[0] * shape[1], default))
    curves = {n: different_curves(n, flat.pop(n)) for n in law.curves}
    check_parameters(law, PointParameters(flat, curves))


def different_curves(name: str, values: NDArray[Any]) -> tuple[list[Curve], IntArray]:
    """The different curves (m,) of a parameter, and which each point has.

    Raises
    ------
    MaterialError
        If one is no curve.
    """
    different = list({id(v): v for v in values}.values())
    if not all(isinstance(v, Curve) for v in different):
        raise MaterialError("kernel.plasticity.parameter-curve", name=name)
    place = {id(v): i for i, v in enumerate(different)}
    return different, np.array([place[id(v)] for v in values], dtype=np.int64)
