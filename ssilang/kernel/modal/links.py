"""Links of a structure on its modes: shocks with gaps, friction, plastic springs, couplings.

A link sees a relative motion `x = P q` (three components) and gives a force `f` on it; on the modes
it is `P^T f`. Forces of contact act along `-n`, n from the point to the obstacle. Where bodies turn
or lines touch, P is that of the place where they are (`Points`).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.modal.link_laws import COLUMNS, CONTACTS, PLASTIC, STIFF, LinkArrays, Points


def segments_of(pairs: IntArray, first: int = 0) -> IntArray:
    """Segments (S, 4) of a line: two points, the segments before and behind, -1 at its ends.

    `first` is the number of the first of them among all segments.
    """
    starts = {int(a): first + i for i, (a, _) in enumerate(pairs)}
    ends = {int(b): first + i for i, (_, b) in enumerate(pairs)}
    rows = [[a, b, ends.get(int(a), -1), starts.get(int(b), -1)] for a, b in pairs]
    return np.array(rows, dtype=np.int64).reshape(-1, 4)


@dataclass(frozen=True, eq=False)
class Link:
    """One link.

    Attributes
    ----------
    kind : int
        PLANE (also between two points), CIRCLE, LINE (a point and a line), RING (a circle about a
        point and a line that goes through it), or a coupling of modes.
    receives : array (3, n)
        P above: the force acts on `P q`.
    sees : array (3, n)
        The motion that the force is made of; the same for contacts.
    numbers : dict
        Values of the columns named in `link_laws`; the others are zero.
    law : array (m, 2) or None
        Points (overlap, force) of the spring; else a line of slope STIFF.
    conditions : dict
        Group of others: whether one must (True) or none may (False) push for this one to act.
    group : int
        Number of those that a script names as one; else the link is its own.
    turns : array (3, n) or None
        Rotation of a circle of the radius RADIUS, whose edge touches.
    ends : tuple of (int, float)
        Points whose bodies turn, by their number among the `Points`, and the sign of their motion
        in x; of LINE and RING the point.
    terms : array (k, 5)
        Of POLYNOMIAL, by mode: its number, exponent and gap of displacement and of velocity.
    """

    kind: int
    receives: FloatArray
    sees: FloatArray
    numbers: dict[int, float]
    law: FloatArray | None = None
    conditions: dict[int, bool] = field(default_factory=dict)
    group: int | None = None
    turns: FloatArray | None = None
    ends: tuple[tuple[int, float], ...] = ()
    terms: FloatArray = field(default_factory=lambda: np.zeros((0, 5)))


def link_arrays(
    links: Sequence[Link], n: int, points: Points | None = None, segments: IntArray | None = None
) -> LinkArrays:
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
    groups = np.array(
        [i if k.group is None else k.group for i, k in enumerate(links)], dtype=np.int64
    )
    conditions = np.zeros((count, int(groups.max(initial=-1)) + 1), dtype=np.int64)
    ends, signs = np.full((count, 2), -1, dtype=np.int64), np.zeros((count, 2))
    terms = np.full((count, max((len(k.terms) for k in links), default=0), 5), -1.0)
    rows = np.zeros((3, count, 3, n))
    for i, link in enumerate(links):
        numbers[i, list(link.numbers)] = list(link.numbers.values())
        if link.law is not None:
            laws[i, : len(link.law)] = link.law
        for other, wanted in link.conditions.items():
            conditions[i, other] = 1 if wanted else -1
        for j, (point, sign) in enumerate(link.ends):
            ends[i, j], signs[i, j] = point, sign
        terms[i, : len(link.terms)] = link.terms
        _check(i, link)
        rows[0, i], rows[1, i] = link.receives, link.sees
        rows[2, i] = 0.0 if link.turns is None else link.turns
    kinds = np.array([k.kind for k in links], dtype=np.int64)
    if points is None:  # of a structure that has no lines and no turning bodies
        none = np.zeros((0, 3))
        points = Points(np.zeros((0, 3, n)), none, np.zeros(0, dtype=np.int64), none, none)
    segments = np.zeros((0, 4), dtype=np.int64) if segments is None else segments
    return LinkArrays(
        kinds, rows[0], rows[1], numbers, sizes, laws, conditions, groups, rows[2], ends, signs,
        terms, points, segments,
    )  # fmt: skip


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
