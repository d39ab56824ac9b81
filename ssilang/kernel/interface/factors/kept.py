"""What solves with Newton's matrix `1 + S (c K - R)`, and is kept while the tangents stay.

Between changes of contact the tangents of successive turns and steps are the same numbers, so a
response is kept (`Inverse`). A point whose tangent was asked for twice is taken into it, several
when corrections (`Changed`) have cost as much; sliding in space turns tangents at every turn, which
are corrected for. A few jumps follow each change at once.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart, seldom
from ssilang.kernel.base.compiled.beside import tell_more
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_rows, is_equal
from ssilang.kernel.interface.factors.changed import (
    ALL,
    LONG,
    Changed,
    correct_changes,
    new_changed,
    solve_by_blocks,
)
from ssilang.kernel.interface.factors.inverse import (
    PLAIN,
    Inverse,
    apply_inverse,
    make_by_blocks,
    make_plain,
    new_inverse,
    update_point,
)
from ssilang.kernel.interface.response import Joints

FEW = 20  # jumps up to which a new Y costs no more than a correction
FORCING = 1e-4  # residual of an iterated direction: the turns that it costs are few
UPDATES = 64  # between two times that Y is made anew: rounding does not grow
AT_ONCE = 2e6  # numbers that points are taken for without waiting: a correction costs calls, too
ANEW = 1.3  # numbers read, over q^3, for which a new Y costs as much
LONG_WORTH = 0.5  # of those, read by long iterations


class Factors(NamedTuple):
    """The tangents (n_points, d, d) that Y belongs to (NaN: none yet), those asked for at last.

    `changed` is empty beside few jumps.
    """

    tangents: FloatArray
    asked: FloatArray
    other: IntArray  # (n_points,) room for the points whose tangents are not those of Y
    updates: IntArray  # (1,) how many points were changed since Y was made
    inverse: Inverse
    changed: Changed


def new_factors(shape: tuple[int, ...], q: int, few: int = FEW, single: bool = False) -> Factors:
    """Room for (n_points, d) local jumps and q jumps of pairs; nothing is factorised yet.

    `single` is the precision of their response.
    """
    tell_more("inverse" if q <= PLAIN else "blocks")
    inverse = new_inverse(q, shape[1], np.float32 if single else np.float64, q <= min(few, PLAIN))
    return Factors(
        np.full((*shape, shape[1]), np.nan), np.full((*shape, shape[1]), np.nan),
        np.zeros(shape[0], np.int64), np.zeros(1, np.int64), inverse,
        new_changed(q if q > few else 0, inverse.Y),
    )  # fmt: skip


@compiled
def is_factorised(factors: Factors) -> bool:
    """Whether there are factors of any tangents."""
    return not np.isnan(factors.tangents[0, 0, 0])


@compiled
def has_tangents(condensed: Condensed, factors: Factors) -> bool:
    """Whether a direction can be had before the laws are looked at."""
    return len(condensed.blocks.values) > 0 or is_factorised(factors)


@seldom
@compiled
def make_anew(joints: Joints, condensed: Condensed, factors: Factors, D: FloatArray) -> bool:
    """Y of the tangents D; False if there is none."""
    known, Y = factors.tangents, factors.inverse.Y
    if len(Y) <= PLAIN:
        good = make_plain(joints, condensed, D, factors.inverse)
    else:
        good = make_by_blocks(joints, condensed, D, Y)
    for p in range(len(D)):
        copy_rows(D[p], known[p])
        copy_rows(D[p], factors.asked[p])
    if not good:
        known[0, 0, 0] = np.nan
    factors.updates[0] = 0
    factors.changed.spent[ALL] = factors.changed.spent[LONG] = 0.0
    return good


@compiled
def list_others(factors: Factors, D: FloatArray) -> int:
    """How many points have other tangents than Y: the first ones of `factors.other`."""
    count = 0
    for p in range(len(D)):
        if not is_equal(D[p], factors.tangents[p]):
            factors.other[count] = p
            count += 1
    return count


@seldom
@compiled
def follow_points(
    joints: Joints, condensed: Condensed, factors: Factors, D: FloatArray, left: int
) -> int:
    """Y takes points whose tangents stay, if that pays: how many are left, negative if none is.

    `left` is what `list_others` found.
    """
    known, asked, inverse, other = factors.tangents, factors.asked, factors.inverse, factors.other
    q, d, spent = len(inverse.Y), D.shape[1], factors.changed.spent
    few, staying = len(factors.changed.jumps) == 0, 0
    for k in range(left):
        staying += few or is_equal(D[other[k]], asked[other[k]])
    cost = 2.0 * d * q * q
    anew = staying * cost > ANEW * q**3 or factors.updates[0] + staying > UPDATES
    enough = few or min(staying * cost, ANEW * q**3) <= spent[ALL] + cost + AT_ONCE
    if not is_factorised(factors) or (staying and anew and enough):
        return 0 if make_anew(joints, condensed, factors, D) else -1
    if staying and enough:
        for k in range(left):
            p = other[k]
            if few or is_equal(D[p], asked[p]):
                weight = condensed.c * joints.weights[p]
                if not update_point(joints.pairs[p], joints.B[p], weight, D[p], known[p], inverse):
                    return 0 if make_anew(joints, condensed, factors, D) else -1
                copy_rows(D[p], known[p])
        left -= staying
        factors.updates[0] += staying
        spent[ALL] = 0.0
    if not few:
        for p in range(len(D)):
            copy_rows(D[p], asked[p])
    return left


@apart
@compiled
def solve_tangent(
    joints: Joints, condensed: Condensed, factors: Factors, D: FloatArray, x: FloatArray,
    enough: float,
) -> bool:  # fmt: skip
    """Solve in place with the matrix of the tangents D; False if it is singular.

    `enough` is the relative residual up to which a solution is iterated.
    """
    if len(condensed.blocks.values) and solve_by_blocks(joints, condensed, D, x):
        return True
    known, left = factors.tangents, list_others(factors, D)
    if left:
        left = follow_points(joints, condensed, factors, D, left)
    if left > 0:
        return solve_changing(joints, condensed, factors, D, x, enough)
    if left == 0:
        apply_inverse(joints, condensed, known, factors.inverse, x)
    return left == 0


@seldom
@compiled
def solve_changing(
    joints: Joints, condensed: Condensed, factors: Factors, D: FloatArray, x: FloatArray,
    enough: float,
) -> bool:  # fmt: skip
    """`solve_tangent` of some other tangents: corrected, or by a new Y where that is cheaper."""
    known, inverse, changed = factors.tangents, factors.inverse, factors.changed
    if changed.spent[LONG] <= LONG_WORTH * len(x) ** 3 and correct_changes(
        joints, condensed, D, known, inverse, changed, x, enough
    ):
        return True
    good = make_anew(joints, condensed, factors, D)
    if good:
        apply_inverse(joints, condensed, known, inverse, x)
    return good
