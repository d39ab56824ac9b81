"""Places under macro-elements whose ground yields: where they stand, what they give together.

The macro-element gives forces of the elastic no-tension bed in closed form, its places what
yielding takes from it (`laws/bed_law`). A place sees the rotations and the opening of the
element's own pair and, on a second pair, the motions along the base: `u_t` in 2D (its second row
stays empty), `u_t1, u_t2` and the twist about n in 3D.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.kinematics import JointCells
from ssilang.kernel.interface.laws.columns import N_PARAMETERS, LawCode, Parameter
from ssilang.kernel.interface.laws.law_table import law_of

STRIPES = 64
"""Places across a footing in the plane.

Where the edge of contact lies between two of them, the force errs by up to
`k theta B^2/(8 STRIPES^2)`: 5e-4 of the capacity at a rotation of 16 q/(k B), nothing while
the ground is elastic.
"""

ACROSS = 16
"""Places along each side of a rectangle, and twice the rings of a disc, in space."""


@dataclass(frozen=True, eq=False)
class Bed:
    """Places under one macro-element.

    Attributes
    ----------
    owner : int
        Point of the macro-element in the interface.
    first : int
        Its first place among the points of the interface; the others follow.
    arms : array (g, d - 1)
        Where they are, along t1 and t2 from the centre; in 2D along the base, so that the place
        opens by `v + theta s`.
    areas : array (g,)
    parameters : array (N_PARAMETERS,)
        The same at all places.
    """

    owner: int
    first: int
    arms: FloatArray
    areas: FloatArray
    parameters: FloatArray

    @property
    def points(self) -> slice:
        """Its places among the points of the interface."""
        return slice(self.first, self.first + len(self.areas))

    @property
    def capacity(self) -> float:
        """Vertical force that the ground bears (N)."""
        return float(self.parameters[Parameter.QULT] * self.areas.sum())

    def operator(self) -> FloatArray:
        """Local jumps of the places from those of both pairs, (g, d, 2 d)."""
        g, m = self.arms.shape
        B, one = np.zeros((g, m + 1, 2 * (m + 1))), np.ones(g)
        if m == 1:
            B[:, 0, 2] = one
            B[:, 1, 0], B[:, 1, 1] = self.arms[:, 0], one
            return B
        s1, s2 = self.arms.T
        B[:, 0, 3], B[:, 0, 5] = one, -s2
        B[:, 1, 4], B[:, 1, 5] = one, s1
        B[:, 2, 0], B[:, 2, 1], B[:, 2, 2] = s2, -s1, one
        return B

    def taken(self, t: FloatArray) -> FloatArray:
        """Moments and force (..., d) that yielding takes, from tractions (..., g, d) there."""
        found: FloatArray = np.einsum(
            "g,...gi,gij->...j", self.areas, t, self.operator()[:, :, : t.shape[-1]]
        )
        return found

    def in_contact(self, w: FloatArray, t: FloatArray) -> FloatArray:
        """Share (...) of its area that presses, from w, t (..., g, d) at its places."""
        return np.asarray((self.pressures(w, t) > 0.0) @ self.areas / self.areas.sum())

    def pressures(self, w: FloatArray, t: FloatArray) -> FloatArray:
        """Pressures (..., g) of the bed itself from jumps and what yielding takes (..., g, d)."""
        elastic = self.parameters[Parameter.BED_KN] * np.minimum(w[..., -1], 0.0)
        return np.asarray(-(t[..., -1] + elastic))


def yields(table: FloatArray) -> bool:
    """Whether the ground below a macro-element of these parameters (N_PARAMETERS,) yields."""
    return bool(table[Parameter.COHE] > 0.0)


def bed_of(code: int, table: FloatArray, dimension: int, owner: int, first: int) -> Bed:
    """The places of a macro-element.

    Parameters
    ----------
    code : int
        Its law.
    table : array (N_PARAMETERS,)
        Its parameters as given, KN and KS1 those of the whole footing.

    Raises
    ------
    MaterialError
        If both shear stiffnesses differ: slip has no direction of its own.
    """
    if dimension == 3 and table[Parameter.KS1] != table[Parameter.KS2]:
        raise MaterialError("kernel.interface.bed-one-shear-stiffness")
    arms, areas, factor = _PLACES[code, dimension](table)
    p = np.zeros(N_PARAMETERS)
    p[Parameter.COHE], p[Parameter.FROT] = table[Parameter.COHE], table[Parameter.FROT]
    p[Parameter.QULT] = table[Parameter.QULT] or factor * table[Parameter.COHE]
    p[Parameter.BED_KN] = table[Parameter.KN] / areas.sum()
    p[Parameter.BED_KS] = table[Parameter.KS1] / areas.sum()
    return Bed(owner, first, arms, areas, p)


def twisting_stiffness(code: int, table: FloatArray) -> float:
    """Stiffness against twist of the places of a macro-element in space."""
    bed = bed_of(code, table, 3, 0, 0)
    return float(bed.parameters[Parameter.BED_KS] * (bed.areas @ (bed.arms**2).sum(axis=1)))


# --- where the places are --------------------------------------------------------------------

PRANDTL = 2.0 + np.pi
"""Bearing pressure of a strip on clay over its cohesion (Prandtl 1920)."""

DISC = 6.05
"""The same of a rough disc (Eason and Shield 1960)."""

SHAPE = 0.2
"""A rectangle bears 1 + SHAPE B/L times what a strip does (Skempton 1951; Eurocode 7)."""

_Places = tuple[FloatArray, FloatArray, float]


def _rectangle_factor(width: float, length: float) -> float:
    return PRANDTL * (1.0 + SHAPE * min(width, length) / max(width, length))


def _strip(table: FloatArray) -> _Places:
    """Stripes of a strip of unit length, or of a rectangle LONG out of the plane."""
    width, length = table[Parameter.LARG], table[Parameter.LONG]
    s = width * ((np.arange(STRIPES) + 0.5) / STRIPES - 0.5)
    factor = _rectangle_factor(width, length) if length > 0.0 else PRANDTL
    areas = np.full(STRIPES, width * (length or 1.0) / STRIPES)
    return s[:, None], areas, factor


def _stripes_of_disc(table: FloatArray) -> _Places:
    """Stripes of equal width, each at its centre of area."""
    r = table[Parameter.RAYO]
    x = np.linspace(-1.0, 1.0, STRIPES + 1)
    rest = np.sqrt(np.maximum(1.0 - x**2, 0.0))
    areas = np.diff(np.arcsin(x) + x * rest)
    moments = np.diff(-2.0 / 3.0 * rest**3)
    return (r * moments / areas)[:, None], r**2 * areas, DISC


def _rectangle(table: FloatArray) -> _Places:
    width, length = table[Parameter.LARG], table[Parameter.LONG]
    x = (np.arange(ACROSS) + 0.5) / ACROSS - 0.5
    s1, s2 = np.meshgrid(width * x, length * x, indexing="ij")
    areas = np.full(ACROSS**2, width * length / ACROSS**2)
    factor = _rectangle_factor(width, length)
    return np.column_stack([s1.ravel(), s2.ravel()]), areas, factor


def _disc(table: FloatArray) -> _Places:
    """Rings of equal width cut into parts of one area, each at its centre of area."""
    r, rings = table[Parameter.RAYO], ACROSS // 2
    arms = []
    for i in range(rings):
        n = 4 * (2 * i + 1)
        half, inner, outer = np.pi / n, r * i / rings, r * (i + 1) / rings
        middle = 2.0 / 3.0 * (outer**3 - inner**3) / (outer**2 - inner**2) * np.sin(half) / half
        angle = (2.0 * np.arange(n) + 1.0) * half
        arms.append(middle * np.column_stack([np.cos(angle), np.sin(angle)]))
    places = np.concatenate(arms)
    return places, np.full(len(places), np.pi * r**2 / len(places)), DISC


_PLACES = {
    (LawCode.STRIP, 2): _strip,
    (LawCode.STRIP, 3): _rectangle,
    (LawCode.DISC, 2): _stripes_of_disc,
    (LawCode.DISC, 3): _disc,
}


def beds_of(joints: list[JointCells], tables: list[FloatArray]) -> tuple[Bed, ...]:
    """The beds of the macro-elements of zones, whose tables (n, N_PARAMETERS) are as given."""
    first = sum(len(t) for t in tables)
    found: list[Bed] = []
    owner = 0
    for j, table in zip(joints, tables, strict=True):
        law = law_of(j.zone.behaviour)
        for i in np.flatnonzero([yields(row) for row in table]) if law.macro else ():
            bed = bed_of(law.code, table[i], j.element.dimension, owner + int(i), first)
            found.append(bed)
            first += len(bed.areas)
        owner += len(table)
    return tuple(found)
