"""Places under macro-elements whose ground yields: where they stand, what they give together.

The macro-element gives forces of the elastic no-tension bed in closed form, its places what
yielding takes from it (`laws/bed_law`). A place sees the rotations and the opening of the
element's own pair and, on a second pair, the motions along the base: `u_t` in 2D (its second row
stays empty), `u_t1, u_t2` and the twist about n in 3D.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.interface.kinematics import JointCells
from ssilang.kernel.interface.laws.columns import N_PARAMETERS, LawCode, Parameter, Variable
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.interface.laws.macro_law import HARD_AREA
from ssilang.kernel.interface.laws.places import n_places, place
from ssilang.kernel.interface.point_state import CLOSED, OPEN, WHOLE, energies_of_points


@dataclass(frozen=True, eq=False)
class Bed:
    """Places under one macro-element."""

    owner: int  # point of the macro-element in the interface
    first: int  # its first place among the points of the interface; the others follow
    arms: FloatArray  # (g, d - 1) along t1 and t2 from the centre; in 2D it opens by `v + theta s`
    areas: FloatArray  # (g,)
    parameters: FloatArray  # (N_PARAMETERS,) means over the area
    # (g,) what the ground bears at each place, pressed or dragged, over the mean
    strengths: FloatArray

    @property
    def table(self) -> FloatArray:
        """Parameters of the places, (g, N_PARAMETERS)."""
        found = np.tile(self.parameters, (len(self.areas), 1))
        found[:, [Parameter.COHE, Parameter.QULT]] *= self.strengths[:, None]
        return found

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
        return np.einsum("g,...gi,gij->...j", self.areas, t, self.operator()[:, :, : t.shape[-1]])

    def in_contact(self, w: FloatArray, t: FloatArray) -> FloatArray:
        """Share (...) of its area that presses, from w, t (..., g, d) at its places."""
        return np.asarray((self.pressures(w, t) > 0.0) @ self.areas / self.areas.sum())

    def tractions(self, w: FloatArray, state: FloatArray) -> FloatArray:
        """What yielding takes (..., g, d) at its places, from w and state (..., g, ...) there."""
        kn, ks = self.parameters[Parameter.BED_KN], self.parameters[Parameter.BED_KS]
        t = np.empty_like(w)
        for i, slip in enumerate((Variable.SLIP1, Variable.SLIP2)[: w.shape[-1] - 1]):
            t[..., i] = -ks * state[..., slip]
        press = kn * np.maximum(state[..., Variable.XI] - w[..., -1], 0.0)
        t[..., -1] = -press - kn * np.minimum(w[..., -1], 0.0)
        return t

    def pressures(self, w: FloatArray, t: FloatArray) -> FloatArray:
        """Pressures (..., g) of the bed itself from jumps and what yielding takes (..., g, d)."""
        elastic = self.parameters[Parameter.BED_KN] * np.minimum(w[..., -1], 0.0)
        return np.asarray(-(t[..., -1] + elastic))


def yields(table: FloatArray) -> bool:
    """Whether the ground below a macro-element of these parameters (N_PARAMETERS,) yields."""
    return bool(table[Parameter.COHE] > 0.0)


def bed_of(code: LawCode, table: FloatArray, dimension: int, owner: int, first: int) -> Bed:
    """The places of a macro-element.

    Parameters
    ----------
    table : array (N_PARAMETERS,)
        Its parameters as given, KN and KS1 those of the whole footing.

    Raises
    ------
    MaterialError
        If both shear stiffnesses differ: slip has no direction of its own.
    """
    if dimension == 3 and table[Parameter.KS1] != table[Parameter.KS2]:
        raise MaterialError("kernel.interface.bed-one-shear-stiffness")
    found = np.array([place(code, dimension, i, table) for i in range(n_places(dimension))])
    arms, areas = found[:, : dimension - 1], found[:, 2]
    strengths = np.ones(len(areas))
    if table[Parameter.PDUR] > 0.0:
        arms, areas, strengths = with_hard_spots(arms, areas, table[Parameter.PDUR])
    p = np.zeros(N_PARAMETERS)
    p[Parameter.COHE], p[Parameter.FROT] = table[Parameter.COHE], table[Parameter.FROT]
    p[Parameter.QULT] = table[Parameter.QULT] or bearing_factor(code, table) * table[Parameter.COHE]
    p[Parameter.BED_KN] = table[Parameter.KN] / areas.sum()
    p[Parameter.BED_KS] = table[Parameter.KS1] / areas.sum()
    return Bed(owner, first, arms, areas, p, strengths)


def with_hard_spots(
    arms: FloatArray, areas: FloatArray, share: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Arms, areas and strengths of places a part of whose area has this share of the strength.

    A place that is turned back over yields against its own hard spots, which still press: its
    loops are wider than an even one's, while stiffness, and strength in whatever direction, are
    the same (all that each part bears grows alike: the sum of such domains is their mean).
    """
    parts = np.array([1.0 - HARD_AREA, HARD_AREA])
    strengths = np.array([1.0 - share, share]) / parts
    n = len(areas)
    return np.repeat(arms, 2, axis=0), np.outer(areas, parts).ravel(), np.tile(strengths, n)


def twisting_stiffness(code: LawCode, table: FloatArray) -> float:
    """Stiffness against twist of the places of a macro-element in space."""
    bed = bed_of(code, table, 3, 0, 0)
    return float(bed.parameters[Parameter.BED_KS] * (bed.areas @ (bed.arms**2).sum(axis=1)))


# --- what they bear --------------------------------------------------------------------------

PRANDTL = 2.0 + np.pi
"""Bearing pressure of a strip on clay over its cohesion (Prandtl 1920)."""

DISC = 6.05
"""The same of a rough disc (Eason and Shield 1960)."""

SHAPE = 0.2
"""A rectangle bears 1 + SHAPE B/L times what a strip does (Skempton 1951; Eurocode 7)."""


def bearing_factor(code: LawCode, table: FloatArray) -> float:
    """Pressure that clay bears under a footing, over its cohesion."""
    if code == LawCode.DISC:
        return DISC
    width, length = table[Parameter.LARG], table[Parameter.LONG]
    if not length > 0.0:
        return PRANDTL
    return float(PRANDTL * (1.0 + SHAPE * min(width, length) / max(width, length)))


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


# Results of macro-elements whose ground yields, from the places of their beds and back.
#
# Beside what all joints show: TASS mean settlement, PART share of the area that presses, and at
# the places TASP settlement, GLP1, GLP2 slip, from which a calculation goes on.

AT_PLACES = {
    "TASP": (Variable.XI, -1.0), "GLP1": (Variable.SLIP1, 1.0), "GLP2": (Variable.SLIP2, 1.0)
}  # fmt: skip
"""Variables at the places: column of the state and sign; GLP2 in space only."""

OF_WHOLE = ("TASS", "PART")
"""Variables of the whole footing."""


def common_results(
    bed: Bed, energies: FloatArray, w: FloatArray, t: FloatArray, state: FloatArray
) -> FloatArray:
    """State and energies (3, k) of a macro-element at k instants.

    Parameters
    ----------
    energies : array (2, k)
        Stored and lost by the elastic bed.
    w, t, state : arrays (k, g, ...)
        Of its places.
    """
    k, g, d = w.shape
    p = np.tile(bed.table, (k, 1))
    codes = np.full(k * g, LawCode.BED)
    at_places = energies_of_points(
        codes, w.reshape(-1, d), t.reshape(-1, d), state.reshape(k * g, -1), p
    ).reshape(2, k, g)
    share = bed.in_contact(w, t)
    states = np.where(share >= 1.0 - WHOLE, CLOSED, OPEN)
    return np.vstack([states, energies + at_places @ bed.areas])


def whole_variables(
    bed: Bed, w: FloatArray, t: FloatArray, state: FloatArray
) -> dict[str, FloatArray]:
    """TASS and PART (k,) from the places at k instants, (k, g, ...)."""
    mean = -state[..., Variable.XI] @ bed.areas / bed.areas.sum()
    return {"TASS": mean, "PART": bed.in_contact(w, t)}


def zone_variables(
    beds: dict[int, Bed], n: int, values: tuple[FloatArray, FloatArray, FloatArray]
) -> dict[str, FloatArray]:
    """Variables of a zone of n macro-elements, some of whose cells have beds.

    Parameters
    ----------
    values : w, t, state
        At all points of the interface.
    """
    w, t, state = values
    any_bed = next(iter(beds.values()))
    names = list(AT_PLACES)[: w.shape[1]]
    found = {"TASS": np.zeros((n, 1)), "PART": np.ones((n, 1))}
    found |= {name: np.zeros((n, len(any_bed.areas))) for name in names}
    for cell, bed in beds.items():
        here = bed.points
        for name, value in whole_variables(
            bed, w[None, here], t[None, here], state[None, here]
        ).items():
            found[name][cell] = value
        for name in names:
            column, sign = AT_PLACES[name]
            found[name][cell] = sign * state[here, column] + 0.0  # no minus zero
    return found


def places_from(given: ZoneField, cell: int, state: FloatArray) -> None:
    """Settlement and slip at the places of a bed (g, N_STATE) from a field, in place."""
    for name, (column, sign) in AT_PLACES.items():
        if name in given:
            values = given.at(name, "STRESSES")
            state[:, column] = sign * values[min(cell, len(values) - 1)]
