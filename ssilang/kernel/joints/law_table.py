"""The laws of joints by name: parameters they read, what they refuse, the code they run under."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.errors import MaterialError
from ssilang.kernel.joints.columns import CUMULATED, DAMAGE, OPENING, SLIP1, SLIP2, STATUS, XI
from ssilang.kernel.joints.parameters import (
    Parameter,
    check_macro_parameters,
    check_mohr_parameters,
    check_sdm_parameters,
)
from ssilang.kernel.mesh.nodes import FloatArray

ELASTIC, SDM, MOHR = 0, 1, 2


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
        Internal variables that results show, with their column of the state.
    macro : bool
        True for a whole footing at a joint of two points: its jumps are rotations and opening.
    """

    code: int
    required: tuple[str, ...]
    optional: tuple[str, ...] = ()
    check: Callable[[FloatArray], None] | None = None
    linear: bool = False
    angles: dict[str, tuple[str, ...]] = field(default_factory=dict)
    variables: dict[str, int] = field(default_factory=dict)
    macro: bool = False


_PLASTIC = {
    "EPSE": CUMULATED, "STAT": STATUS, "EPOU": OPENING, "LAM1": DAMAGE, "PLA1": SLIP1,
    "PLA2": SLIP2, "PLA3": XI,
}  # fmt: skip

LAWS: dict[str, Law] = {
    "ELASTIQUE": Law(ELASTIC, ("KN", "KS"), linear=True),
    "JOINT_SDM": Law(
        SDM,
        ("KN", "KS"),
        ("FU", "GF", "FC", "FROT"),
        check_sdm_parameters,
        variables={"SAUT": XI, "GLI1": SLIP1, "GLI2": SLIP2},
    ),
    "JOINT_DILATANT": Law(
        MOHR,
        ("KN", "KS", "PHI", "MU"),
        ("FTRC", "COHE"),
        check_mohr_parameters,
        angles={"PHI": ("TPHI",), "MU": ("TPSI",)},
        variables=_PLASTIC,
    ),
    "COULOMB": Law(
        MOHR,
        ("KN", "KS", "FRIC", "COHE"),
        ("FTRC", "EF", "ECN", "FNE", "QT", "TYPE"),
        check_mohr_parameters,
        angles={"FRIC": ("TPHI", "TPSI")},
        variables=_PLASTIC,
    ),
    "MACRO_SEMELLE": Law(3, ("KN", "KS", "LARG"), ("LONG",), check_macro_parameters, macro=True),
    "MACRO_DISQUE": Law(4, ("KN", "KS", "RAYO"), (), check_macro_parameters, macro=True),
    "MACRO_RESSORTS": Law(5, ("KN", "KS", "LARG"), (), check_macro_parameters, macro=True),
}
"""Laws by the last word of a model's behaviour; the purely elastic joint under 'ELASTIQUE'."""


OTHER_WORDS = (
    "ISOTROPE", "ORTHOTROPE", "UNIDIRECTIONNEL", "CISAILLEMENT_ELASTIQUE", "PLASTIQUE",
    "FROTTEMENT_SYMETRIQUE",
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


def elastic_tangent(parameters: FloatArray, dimension: int) -> FloatArray:
    """Stiffness diag(KS1[, KS2], KN) of closed points, shape (n, d, d)."""
    columns = (*(Parameter.KS1, Parameter.KS2)[: dimension - 1], Parameter.KN)
    tangent = np.zeros((len(parameters), dimension, dimension))
    for i, column in enumerate(columns):
        tangent[:, i, i] = parameters[:, column]
    return tangent


def rocking_stiffness(code: int, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Stiffness of a macro-element in full contact about t1 and t2 (the same in 2D), each (n,)."""
    k, b = parameters[:, Parameter.KN], parameters[:, Parameter.LARG]
    if code == 4:
        both = k * parameters[:, Parameter.RAYO] ** 2 / 4
        return both, both
    if code == 5:
        return k * b**2 / 4, k * b**2 / 4
    other = parameters[:, Parameter.LONG]
    about_1 = np.where(other > 0, k * other**2 / 12, k * b**2 / 12)
    return about_1, k * b**2 / 12
