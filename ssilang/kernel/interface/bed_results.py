"""Results of macro-elements whose ground yields, from the places of their beds and back.

Beside what all joints show: TASS mean settlement, PART share of the area that presses, and at the
places TASP settlement, GLP1, GLP2 slip, from which a calculation goes on.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.interface.bed import Bed
from ssilang.kernel.interface.laws.columns import LawCode, Variable
from ssilang.kernel.interface.point_state import CLOSED, OPEN, WHOLE, energies_of_points

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
