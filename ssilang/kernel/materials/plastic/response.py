"""What a plastic law receives and gives, at many points at once.

Stresses are XX YY ZZ XY XZ YZ, strains the same with engineering shears (GAXY = 2 EPXY), so that
`stress . strain` is the work.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.materials.elasticity import isotropic_compliance, isotropic_moduli

Made = TypeVar("Made")
UNIT = np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])
"""The unit tensor."""
DEVIATOR = np.diag([1.0, 1.0, 1.0, 0.5, 0.5, 0.5])
DEVIATOR[:3, :3] -= 1 / 3
"""Deviatoric part, as a stress, of a strain."""


@dataclass(frozen=True, eq=False)
class PointParameters:
    """Parameters of a law at m points.

    Attributes
    ----------
    values : mapping of str to array (m,)
        YOUN, NU and those of the law.
    curves : mapping of str to (list of Curve, array (m,))
        Curves, and which of them each point has.
    """

    values: Mapping[str, FloatArray]
    curves: Mapping[str, tuple[list[Curve], IntArray]]

    @cached_property
    def kept(self) -> dict[Any, Any]:
        """What `once` made."""
        return {}

    def once(self, make: Callable[["PointParameters"], Made]) -> Made:
        """What a law makes of its parameters, made when it is first asked for."""
        if make not in self.kept:
            self.kept[make] = make(self)
        found: Made = self.kept[make]
        return found

    def __getitem__(self, name: str) -> FloatArray:
        return self.values[name]

    @property
    def shear(self) -> FloatArray:
        """Shear modulus (m,)."""
        return self["YOUN"] / (2 * (1 + self["NU"]))

    @property
    def bulk(self) -> FloatArray:
        """Bulk modulus (m,)."""
        return self["YOUN"] / (3 * (1 - 2 * self["NU"]))

    @property
    def moduli(self) -> FloatArray:
        """Elastic moduli (m, 6, 6)."""
        return isotropic_moduli(self["YOUN"], self["NU"])

    @property
    def compliance(self) -> FloatArray:
        """Elastic compliance (m, 6, 6)."""
        return isotropic_compliance(self["YOUN"], self["NU"])

    def elastic_energy(self, stress: FloatArray) -> FloatArray:
        """Energy (m,) that stresses (m, 6) store in a unit of volume."""
        trace = stress[:, 0] + stress[:, 1] + stress[:, 2]
        square = np.vecdot(stress, stress) + np.vecdot(stress[:, 3:], stress[:, 3:])
        return (square - trace**2 / 3) / (4 * self.shear) + trace**2 / (18 * self.bulk)

    def at(self, points: IntArray) -> "PointParameters":
        """The same for some of the points."""
        values = {name: v[points] for name, v in self.values.items()}
        curves = {name: (all_, which[points]) for name, (all_, which) in self.curves.items()}
        return PointParameters(values, curves)

    def curve(self, name: str, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Ordinate and slope (m,) of a curve at x (m,); constant beyond its ends."""
        all_, which = self.curves[name]
        y, slope = np.zeros(len(x)), np.zeros(len(x))
        for i, curve in enumerate(all_):
            a, b = curve.parts[0].abscissas, curve.parts[0].ordinates
            rows = which == i
            y[rows] = np.interp(x[rows], a, b)
            if len(a) > 1:
                inside = (x[rows] >= a[0]) & (x[rows] < a[-1])
                place = np.clip(np.searchsorted(a, x[rows], side="right"), 1, len(a) - 1)
                rise = np.diff(b)[place - 1] / np.maximum(np.diff(a)[place - 1], 1e-300)
                slope[rows] = np.where(inside, rise, 0.0)
        return y, slope


@dataclass(frozen=True, eq=False)
class Response:
    """A law's answer to a step of strain."""

    stress: FloatArray  # (m, 6) at the end of the step
    variables: FloatArray  # (m, k) internal variables at the end
    # (m, 6, 6) derivative of the stress by the strain of the step (consistent with the integration)
    tangent: FloatArray
    # (m, 6) elastic strain of the step, where YOUN and NU do not give it
    elastic: FloatArray | None = None

    def elastic_strain(self, parameters: PointParameters, before: FloatArray) -> FloatArray:
        """Elastic strain (m, 6) of a step from the stress `before`."""
        if self.elastic is not None:
            return self.elastic
        return np.einsum("mij,mj->mi", parameters.compliance, self.stress - before)


def mises(stress: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Equivalent stress of von Mises (m,) and deviator (m, 6)."""
    deviator = stress - (stress[:, :3].sum(axis=1) / 3)[:, None] * UNIT
    square = (deviator[:, :3] ** 2).sum(axis=1) + 2 * (deviator[:, 3:] ** 2).sum(axis=1)
    return np.sqrt(1.5 * square), deviator
