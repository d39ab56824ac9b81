"""The laws of joints by name: parameters they read, what they refuse, the code they run under."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.errors import MaterialError
from ssilang.kernel.joints.parameters import Parameter, check_sdm_parameters
from ssilang.kernel.mesh.nodes import FloatArray

ELASTIC, SDM = 0, 1


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
    """

    code: int
    required: tuple[str, ...]
    optional: tuple[str, ...] = ()
    check: Callable[[FloatArray], None] | None = None
    linear: bool = False


LAWS: dict[str, Law] = {
    "ELASTIQUE": Law(ELASTIC, ("KN", "KS"), linear=True),
    "JOINT_SDM": Law(SDM, ("KN", "KS"), ("FU", "GF", "FC", "FROT"), check_sdm_parameters),
}
"""Laws by the last word of a model's behaviour; the purely elastic joint under 'ELASTIQUE'."""


def law_of(behaviour: tuple[str, ...]) -> Law:
    """The law named by the words of a model zone.

    Raises
    ------
    MaterialError
        If a word names a law that joints do not have.
    """
    known = {"ELASTIQUE", "ISOTROPE", "ORTHOTROPE", "UNIDIRECTIONNEL", "CISAILLEMENT_ELASTIQUE"}
    for word in behaviour:
        if word in LAWS and word != "ELASTIQUE":
            return LAWS[word]
    strange = [w for w in behaviour if w not in known and w not in LAWS]
    if strange:
        raise MaterialError(
            f"no joint law is called {strange[0]}", "joints have ELASTIQUE and JOINT_SDM"
        )
    return LAWS["ELASTIQUE"]


def elastic_tangent(parameters: FloatArray, dimension: int) -> FloatArray:
    """Stiffness diag(KS1[, KS2], KN) of closed points, shape (n, d, d)."""
    columns = (*(Parameter.KS1, Parameter.KS2)[: dimension - 1], Parameter.KN)
    tangent = np.zeros((len(parameters), dimension, dimension))
    for i, column in enumerate(columns):
        tangent[:, i, i] = parameters[:, column]
    return tangent
