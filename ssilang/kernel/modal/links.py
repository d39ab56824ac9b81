"""Links of a structure on its modes: shocks with gaps, friction, plastic springs, couplings.

A link sees a relative motion `x = P q` (three components) and gives a force `f` on it; on the modes
it is `P^T f`. Forces of contact act along `-n`, n from the point to the obstacle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError

PLANE, CIRCLE, POWER, SINE, COSINE, COSINE_OF_TIME, SINE_OF_TIME, VELOCITY = range(8)
CONTACTS = (PLANE, CIRCLE)

# columns of the numbers of a link
(
    NX, NY, NZ, GAP, STIFF, DAMP, EX, EY, EZ, OUTSIDE, PERMANENT, PLASTIC, KINEMATIC, FRICTION,
    SLIDE, STICK, TANGENT, TANGENT_DAMP, DX, DY, DZ, FACTOR, EXPONENT, FREQUENCY, COLUMNS,
) = range(25)  # fmt: skip
# columns of the state of a link: plastic part, its cumulated value, contact and adherence,
# anchor of adherence, force there, time there, last sliding direction
XP, CUMULATED, TOUCHES, STICKS, A0, F0, T0, S0, STATES = 0, 1, 2, 3, 4, 7, 10, 11, 14
# columns of what is recorded: relative motion, normal force, tangential force, normal and sliding
# velocities, power of wear, plastic part, its cumulated value, norm of the force
X, FN, FT, VN, VT, WEAR, PLASTIC_PART, PLASTIC_SUM, FORCE, RECORDS = (
    0,
    3,
    4,
    7,
    8,
    9,
    10,
    11,
    12,
    13,
)


@dataclass(frozen=True, eq=False)
class Link:
    """One link.

    Attributes
    ----------
    kind : int
        PLANE (also between two points), CIRCLE, or a coupling of modes.
    receives : array (3, n)
        P above: the force acts on `P q`.
    sees : array (3, n)
        The motion that the force is made of; the same for contacts.
    numbers : dict
        Values of the columns named in this module; the others are zero.
    law : array (m, 2) or None
        Points (overlap, force) of the spring; else a line of slope STIFF.
    conditions : dict
        Number of another link: whether it must (True) or must not (False) push for this one to act.
    """

    kind: int
    receives: FloatArray
    sees: FloatArray
    numbers: dict[int, float]
    law: FloatArray | None = None
    conditions: dict[int, bool] = field(default_factory=dict)


class LinkArrays(NamedTuple):
    """Links as arrays: kinds (L,), rows (L, 3, n), numbers (L, COLUMNS), conditions (L, L)."""

    kinds: IntArray
    receives: FloatArray
    sees: FloatArray
    numbers: FloatArray
    law_sizes: IntArray
    laws: FloatArray
    conditions: IntArray


def link_arrays(links: Sequence[Link], n: int) -> LinkArrays:
    """Links as arrays for the compiled loop.

    Raises
    ------
    KernelError
        For a stiffness or a law that is not positive.
    """
    count = len(links)
    sizes = np.array([0 if k.law is None else len(k.law) for k in links], dtype=np.int64)
    laws = np.zeros((count, int(sizes.max(initial=2)), 2))
    numbers = np.zeros((count, COLUMNS))
    conditions = np.zeros((count, count), dtype=np.int64)
    for i, link in enumerate(links):
        for column, value in link.numbers.items():
            numbers[i, column] = value
        if link.law is not None:
            laws[i, : len(link.law)] = link.law
        for other, wanted in link.conditions.items():
            conditions[i, other] = 1 if wanted else -1
        _check(i, link)
    rows = np.zeros((2, count, 3, n))
    for i, link in enumerate(links):
        rows[0, i], rows[1, i] = link.receives, link.sees
    kinds = np.array([k.kind for k in links], dtype=np.int64)
    return LinkArrays(kinds, rows[0], rows[1], numbers, sizes, laws, conditions)


def _check(place: int, link: Link) -> None:
    if link.kind not in CONTACTS:
        return
    if link.law is None and link.numbers.get(STIFF, 0.0) <= 0.0:
        raise KernelError("kernel.modal.link-no-positive-stiffness", place=place + 1)
    law = link.law
    if law is not None and (len(law) < 2 or (np.diff(law[:, 0]) <= 0.0).any()):
        raise KernelError("kernel.modal.law-link-wants-two", place=place + 1)
    if law is not None and link.numbers.get(PLASTIC):
        slopes = np.diff(law[:, 1]) / np.diff(law[:, 0])
        if slopes[0] <= 0.0 or (slopes[1:] < 0.0).any() or (slopes[1:] >= slopes[0]).any():
            raise KernelError("kernel.modal.law-link-not-elastic", place=place + 1)
