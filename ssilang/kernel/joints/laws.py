"""The laws of joints behind one interface: by name, by code, on one point or on many.

A law is one file with a compiled function of one point::

    law(w, state, p, t, new, D)      # traction t, new state and tangent D, written in place

To add a law: write it, give it a code in `LAWS` and a line in `point_response`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.compiled import compiled
from ssilang.kernel.errors import MaterialError
from ssilang.kernel.joints.parameters import N_PARAMETERS, Parameter, check_sdm_parameters
from ssilang.kernel.joints.sdm_law import (
    FC,
    FU,
    GF,
    KN,
    KS1,
    N_STATE,
    SHEAR_ENERGY,
    SHEAR_LOSS,
    XI,
    normal_energy,
    opening_loss,
    sdm_point,
)
from ssilang.kernel.mesh.nodes import FloatArray, IntArray

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


@compiled
def elastic_point(
    w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray, D: FloatArray
) -> None:
    """Bonded joint: t = diag(KS1, KS2, KN) w, no state."""
    n = w.shape[0] - 1
    D[:, :] = 0.0
    new[:] = state
    for i in range(n):
        D[i, i] = p[KS1 + i]
        t[i] = p[KS1 + i] * w[i]
    D[n, n] = p[KN]
    t[n] = p[KN] * w[n]


@compiled
def point_response(
    code: int,
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
) -> None:
    """Traction, new state and tangent of one point by the law of this code."""
    if code == 1:
        sdm_point(w, state, p, t, new, D)
    else:
        elastic_point(w, state, p, t, new, D)


@compiled
def respond(
    codes: IntArray,
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
) -> None:
    """`point_response` on n points: w, t (n, d), state, new (n, N_STATE), D (n, d, d)."""
    for i in range(w.shape[0]):
        point_response(codes[i], w[i], state[i], p[i], t[i], new[i], D[i])


@compiled
def point_energies(
    code: int, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray
) -> tuple[float, float]:
    """Stored energy and energy lost so far of one point, per unit area, at its own state."""
    n = w.shape[0] - 1
    if code == 1:
        stored = normal_energy(w[n], t[n], state[XI], p[KN], p[FC]) + state[SHEAR_ENERGY]
        return stored, opening_loss(state[XI], p[FU], p[GF]) + state[SHEAR_LOSS]
    stored = 0.0
    for i in range(n + 1):
        stored += 0.5 * w[i] * t[i]
    return stored, 0.0


def elastic_tangent(parameters: FloatArray, dimension: int) -> FloatArray:
    """Stiffness diag(KS1[, KS2], KN) of closed points, shape (n, d, d)."""
    columns = (*(Parameter.KS1, Parameter.KS2)[: dimension - 1], Parameter.KN)
    tangent = np.zeros((len(parameters), dimension, dimension))
    for i, column in enumerate(columns):
        tangent[:, i, i] = parameters[:, column]
    return tangent


__all__ = [
    "ELASTIC", "LAWS", "N_PARAMETERS", "N_STATE", "SDM", "Law", "elastic_tangent", "law_of",
    "point_energies", "point_response", "respond",
]  # fmt: skip
