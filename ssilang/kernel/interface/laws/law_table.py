"""The laws of joints by name, gathered from their files."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.interface.laws import (
    bearing_law,
    elastic_law,
    macro_law,
    mohr_law,
    sdm_law,
)
from ssilang.kernel.interface.laws.columns import N_STATE, Parameter
from ssilang.kernel.interface.laws.law import Law

LAWS: dict[str, Law] = {
    **elastic_law.LAWS,
    **sdm_law.LAWS,
    **mohr_law.LAWS,
    **macro_law.LAWS,
    **bearing_law.LAWS,
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
    names = (name for name in law.variables if dimension == 3 or not name.endswith("2"))
    shown = {name: state[..., list(law.variables[name])].sum(axis=-1) for name in names}
    return shown | {name: -shown[other] for name, other in law.opposite.items()}


def state_of(law: Law, given: ZoneField, shape: tuple[int, int]) -> FloatArray:
    """State (n g, N_STATE) of the points (n, g) of a zone from internal variables by name.

    Variables that are not given are zero.
    """
    state = np.zeros((shape[0] * shape[1], N_STATE))
    known = {name: columns for name, columns in law.variables.items() if name in given}
    for name, columns in known.items():
        state[:, columns[0]] = np.broadcast_to(given.at(name, "STRESSES"), shape).ravel()
    for first, *others in known.values():
        state[:, first] -= state[:, others].sum(axis=1)
    return state


def elastic_tangent(parameters: FloatArray, dimension: int) -> FloatArray:
    """Stiffness diag(KS1[, KS2], KN) of closed points, shape (n, d, d)."""
    columns = (*(Parameter.KS1, Parameter.KS2)[: dimension - 1], Parameter.KN)
    tangent = np.zeros((len(parameters), dimension, dimension))
    for i, column in enumerate(columns):
        tangent[:, i, i] = parameters[:, column]
    return tangent
