"""The laws of joints by name: parameters they read, what they refuse, the code they run under."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.interface.laws.columns import N_STATE, LawCode, Parameter, Variable
from ssilang.kernel.interface.laws.parameters import (
    check_lead_parameters,
    check_macro_parameters,
    check_mohr_parameters,
    check_pendulum_parameters,
    check_sdm_parameters,
)


@dataclass(frozen=True)
class Law:
    """What is known of a law beside its equations.

    Attributes
    ----------
    code : int
        Number that compiled code knows it by.
    required, optional : tuple of str
        Parameters as scripts name them (KS stands for KS1 and KS2).
    check : callable or None
        Refuses inadmissible parameters (n, N_PARAMETERS).
    linear : bool
        True if the elastic stiffness says all.
    angles : dict
        Parameters in degrees, with the columns that take their tangents.
    variables : dict
        Internal variables that results show, with their columns of the state, whose sum they are.
    rocking : callable or None
        For a whole footing at a joint of two points, whose jumps are rotations and opening: its
        stiffness in full contact about t1 and t2, each (n,), from the parameters; `turning` has
        what counts in the plane.
    in_space : tuple of str or None
        Parameters that it needs in three dimensions beside; None if it is plane.
    two_points : bool
        Stands between two points alone (JOI1).
    """

    code: LawCode
    required: tuple[str, ...]
    optional: tuple[str, ...] = ()
    check: Callable[[FloatArray], None] | None = None
    linear: bool = False
    angles: dict[str, tuple[str, ...]] = field(default_factory=dict)
    variables: dict[str, tuple[Variable, ...]] = field(default_factory=dict)
    rocking: Callable[[FloatArray], tuple[FloatArray, FloatArray]] | None = None
    in_space: tuple[str, ...] | None = ()
    two_points: bool = False

    @property
    def macro(self) -> bool:
        """True for a whole footing."""
        return self.rocking is not None

    def turning(self, p: FloatArray, dimension: int) -> tuple[FloatArray, FloatArray]:
        """Stiffness (n,) of a whole footing about t1 and t2; in the plane about t2 alone, twice.

        The plane has the side LARG, along t1; LONG is how far the footing goes on behind it.
        """
        assert self.rocking is not None
        about_1, about_2 = self.rocking(p)
        return (about_2 if dimension == 2 else about_1), about_2


def _rocking_rectangle(p: FloatArray) -> tuple[FloatArray, FloatArray]:
    k, width, length = p[:, Parameter.KN], p[:, Parameter.LARG], p[:, Parameter.LONG]
    about_2 = k * width**2 / 12
    return np.where(length > 0, k * length**2 / 12, about_2), about_2


def _rocking_disc(p: FloatArray) -> tuple[FloatArray, FloatArray]:
    both = p[:, Parameter.KN] * p[:, Parameter.RAYO] ** 2 / 4
    return both, both


def _rocking_springs(p: FloatArray) -> tuple[FloatArray, FloatArray]:
    both = p[:, Parameter.KN] * p[:, Parameter.LARG] ** 2 / 4
    return both, both


_PLASTIC = {
    "EPSE": (Variable.CUMULATED,), "STAT": (Variable.STATUS,), "EPOU": (Variable.OPENING,),
    "LAM1": (Variable.DAMAGE,), "PLA1": (Variable.SLIP1,), "PLA2": (Variable.SLIP2,),
    "PLA3": (Variable.XI, Variable.OPENING),
}  # fmt: skip

_SLIPS: dict[str, tuple[Variable, ...]] = {"GLI1": (Variable.SLIP1,), "GLI2": (Variable.SLIP2,)}

LAWS: dict[str, Law] = {
    "ELASTIQUE": Law(LawCode.ELASTIC, ("KN", "KS"), linear=True),
    "JOINT_SDM": Law(
        LawCode.SDM,
        ("KN", "KS"),
        ("FU", "GF", "FC", "FROT"),
        check_sdm_parameters,
        variables={
            "SAUT": (Variable.XI,),
            "GLI1": (Variable.SLIP1,),
            "GLI2": (Variable.SLIP2,),
        },
    ),
    "JOINT_DILATANT": Law(
        LawCode.MOHR,
        ("KN", "KS", "PHI", "MU"),
        ("FTRC", "COHE"),
        check_mohr_parameters,
        angles={"PHI": ("TPHI",), "MU": ("TPSI",)},
        variables=_PLASTIC,
    ),
    "COULOMB": Law(
        LawCode.MOHR,
        ("KN", "KS", "FRIC", "COHE"),
        ("FTRC", "EF", "ECN", "FNE", "QT", "TYPE"),
        check_mohr_parameters,
        angles={"FRIC": ("TPHI", "TPSI")},
        variables=_PLASTIC,
    ),
    "MACRO_SEMELLE": Law(
        LawCode.STRIP,
        ("KN", "KS", "LARG"),
        ("LONG", "COHE", "QULT", "FROT", "PDUR"),
        check_macro_parameters,
        rocking=_rocking_rectangle,
        in_space=("LONG",),
    ),
    "MACRO_DISQUE": Law(
        LawCode.DISC,
        ("KN", "KS", "RAYO"),
        ("COHE", "QULT", "FROT", "PDUR"),
        check_macro_parameters,
        rocking=_rocking_disc,
    ),
    "MACRO_RESSORTS": Law(
        LawCode.SPRINGS,
        ("KN", "KS", "LARG"),
        (),
        check_macro_parameters,
        rocking=_rocking_springs,
        in_space=None,
    ),
    "APPUI_PLOMB": Law(
        LawCode.LEAD,
        ("KN", "KS", "QD", "KPOS"),
        ("ETA", "BETA"),
        check_lead_parameters,
        variables={**_SLIPS, "HYS1": (Variable.HYSTERETIC1,), "HYS2": (Variable.HYSTERETIC2,)},
        two_points=True,
    ),
    "APPUI_PENDULE": Law(
        LawCode.PENDULUM,
        ("KN", "KS", "RAYO", "FROT"),
        (),
        check_pendulum_parameters,
        variables=_SLIPS,
        two_points=True,
    ),
}
"""Laws by the last word of a model's behaviour; the purely elastic joint under 'ELASTIQUE'."""


OTHER_WORDS = (
    "ISOTROPE", "ORTHOTROPE", "ANISOTROPE", "UNIDIRECTIONNEL", "PLASTIQUE",
    "CISAILLEMENT_ELASTIQUE", "FROTTEMENT_SYMETRIQUE",
)  # fmt: skip
"""Words of a joint's behaviour that name no law."""


def law_of(behaviour: tuple[str, ...]) -> Law:
    """The law named by the words of a model zone.

    Raises
    ------
    MaterialError
        If a word names a law that joints do not have.
    """
    for word in behaviour:
        if word in LAWS and word != "ELASTIQUE":
            return LAWS[word]
    strange = [w for w in behaviour if w not in OTHER_WORDS and w not in LAWS]
    if strange:
        raise MaterialError("kernel.interface.no-joint-law-called", strange=strange[0], laws=LAWS)
    return LAWS["ELASTIQUE"]


def shown_variables(law: Law, state: FloatArray, dimension: int) -> dict[str, FloatArray]:
    """Internal variables by name, each (...), of a state (..., N_STATE); no second slip in 2D."""
    return {
        name: state[..., list(columns)].sum(axis=-1)
        for name, columns in law.variables.items()
        if dimension == 3 or not name.endswith("2")
    }


def state_of(law: Law, given: ZoneField, shape: tuple[int, int]) -> FloatArray:
    """State (n g, N_STATE) of the points (n, g) of a zone from internal variables by name.

    Variables that are not given are zero.
    """
    state = np.zeros((shape[0] * shape[1], N_STATE))
    known = [columns for name, columns in law.variables.items() if name in given]
    for name, columns in law.variables.items():
        if name in given:
            state[:, columns[0]] = np.broadcast_to(given.at(name, "STRESSES"), shape).ravel()
    for first, *others in known:
        state[:, first] -= state[:, others].sum(axis=1)
    return state


def elastic_tangent(parameters: FloatArray, dimension: int) -> FloatArray:
    """Stiffness diag(KS1[, KS2], KN) of closed points, shape (n, d, d)."""
    columns = (*(Parameter.KS1, Parameter.KS2)[: dimension - 1], Parameter.KN)
    tangent = np.zeros((len(parameters), dimension, dimension))
    for i, column in enumerate(columns):
        tangent[:, i, i] = parameters[:, column]
    return tangent
