"""What solves with Newton's matrix `1 + S (c K - R)`, and is kept while the tangents stay.

Between changes of contact the tangents of successive turns and steps are the same numbers. Few
jumps keep an inverse that points change one by one (`Inverse`); more jumps keep that of the first
tangents, and correct what it gives (`Changed`).
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import apart, seldom
from ssilang.kernel.base.compiled.beside import tell_more
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_rows, copy_state
from ssilang.kernel.interface.factors.changed import (
    WORTH,
    Changed,
    correct_changes,
    new_changed,
    solve_base,
)
from ssilang.kernel.interface.factors.inverse import (
    PLAIN,
    Inverse,
    apply_inverse,
    inverse_of,
    make_by_blocks,
    update_inverse,
)
from ssilang.kernel.interface.response import Joints

FEW = 160  # jumps up to which an inverse is kept
FORCING = 1e-4  # residual of an iterated direction: the turns that it costs are few


class Factors(NamedTuple):
    """The tangents (n_points, d, d) that are factorised (NaN: none yet), and by which record.

    `changed` is empty beside an inverse, `inverse` elsewhere.
    """

    tangents: FloatArray
    inverse: Inverse
    changed: Changed


def new_factors(shape: tuple[int, ...], q: int, few: int = FEW, single: bool = False) -> Factors:
    """Room for (n_points, d) local jumps and q jumps of pairs; nothing is factorised yet.

    `single` is the precision of many jumps.
    """
    own = q if q <= few else 0  # of an inverse
    if own:
        tell_more("inverse" if own <= PLAIN else "blocks")
    return Factors(
        np.full((*shape, shape[1]), np.nan),
        inverse_of(np.zeros((own, own)), shape[1]),
        new_changed(q - own, np.float32 if single and q > own else np.float64),
    )


@compiled
def is_factorised(factors: Factors) -> bool:
    """Whether there are factors of any tangents."""
    return not np.isnan(factors.tangents[0, 0, 0])


@apart
@compiled
def solve_known(joints: Joints, condensed: Condensed, factors: Factors, x: FloatArray) -> None:
    """Solve in place with the matrix of the tangents that are factorised."""
    if len(factors.inverse.Y):
        apply_inverse(joints, condensed, factors.tangents, factors.inverse, x)
    else:
        solve_base(joints, condensed, factors.tangents, factors.changed, x)


@apart
@compiled
def solve_tangent(
    joints: Joints, condensed: Condensed, factors: Factors, D: FloatArray, x: FloatArray,
    enough: float,
) -> bool:  # fmt: skip
    """Solve in place with the matrix of the tangents D; False if it is singular.

    `enough` is the relative residual up to which a solution is iterated.
    """
    if len(factors.inverse.Y):
        if not update_inverse(joints, condensed, D, factors.tangents, factors.inverse):
            return False
        solve_known(joints, condensed, factors, x)
        return True
    return solve_changing(joints, condensed, factors, D, x, enough)


@seldom
@compiled
def solve_changing(
    joints: Joints, condensed: Condensed, factors: Factors, D: FloatArray, x: FloatArray,
    enough: float,
) -> bool:  # fmt: skip
    """`solve_tangent` of many jumps: corrected, or by a new Y where that is cheaper."""
    known, changed, asked = factors.tangents, factors.changed, np.empty(len(x))
    if is_factorised(factors) and changed.spent[0] <= WORTH * len(x) ** 3:
        copy_state(x, asked)
        solve_base(joints, condensed, known, changed, x)
        if correct_changes(joints, condensed, D, known, changed, x, enough):
            return True
        copy_state(asked, x)
    good, changed.spent[0] = make_by_blocks(joints, condensed, D, changed.Y), 0.0
    for p in range(len(D)):
        copy_rows(D[p], known[p])
    if not good:
        known[0, 0, 0] = np.nan
        return False
    solve_base(joints, condensed, known, changed, x)
    return True
