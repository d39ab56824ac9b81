"""What solves with Newton's matrix `1 + S (c K - R)`, and is kept while the tangents stay.

Between changes of contact the tangents of successive turns and steps are the same numbers. Few
jumps keep an inverse that points change one by one (`Inverse`); more jumps keep LU factors (`LU`);
many jumps correct the solutions of these factors, not the factors (`Changes`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.changed import (
    DONE,
    MOST_CHANGED,
    TOO_MANY,
    Changes,
    forget_changes,
    solve_changed,
)
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_rows, is_equal
from ssilang.kernel.interface.inverse import (
    Inverse,
    apply_inverse,
    update_inverse,
)
from ssilang.kernel.interface.lu import LU, factorise
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.solvers.dense import (
    solve_factors,
)

FEW = 160  # jumps up to which an inverse is kept
LARGE = 300  # jumps from which factors are changed rather than made again


class Factors(NamedTuple):
    """The tangents (n_points, d, d) that are factorised (NaN: none yet), and by which record.

    `lu` is empty beside an inverse, `changes` where factors are made again, `inverse` elsewhere.
    """

    tangents: FloatArray
    lu: LU
    inverse: Inverse
    changes: Changes


def new_factors(shape: tuple[int, ...], q: int, few: int = FEW, large: int = LARGE) -> Factors:
    """Room for (n_points, d) local jumps and q jumps of pairs; nothing is factorised yet."""
    own = q if q <= few else 0  # of an inverse
    whole, changing = q - own, q if own == 0 and q >= large else 0
    return Factors(
        np.full((*shape, shape[1]), np.nan),
        LU(np.zeros((whole, whole)), np.zeros(whole, np.int64)),
        Inverse(np.zeros((own, own)), np.zeros(own), np.zeros(1, np.int64)),
        Changes(
            np.zeros((changing // MOST_CHANGED, changing)),
            np.full(changing, -1, np.int64),
            np.zeros(1, np.int64),
        ),
    )


@compiled
def is_factorised(factors: Factors) -> bool:
    """Whether there are factors of any tangents."""
    return not np.isnan(factors.tangents[0, 0, 0])


@compiled
def solve_known(joints: Joints, condensed: Condensed, factors: Factors, x: FloatArray) -> None:
    """Solve in place with the matrix of the tangents that are factorised."""
    if len(factors.inverse.Y):
        apply_inverse(joints, condensed, factors.tangents, factors.inverse, x)
    else:
        solve_factors(factors.lu.A, factors.lu.exchanges, x)


@apart
@compiled
def solve_tangent(
    joints: Joints, condensed: Condensed, factors: Factors, D: FloatArray, x: FloatArray
) -> bool:
    """Solve in place with the matrix of the tangents D; False if it is singular."""
    known = factors.tangents
    if len(factors.inverse.Y):
        if not update_inverse(joints, condensed, D, known, factors.inverse):
            return False
        apply_inverse(joints, condensed, known, factors.inverse, x)
        return True
    same = True
    for p in range(len(D)):
        same = same and is_equal(D[p], known[p])
    if not same and len(factors.changes.row) and is_factorised(factors):
        found = solve_changed(joints, condensed, D, known, factors.lu, factors.changes, x)
        if found != TOO_MANY:
            return found == DONE
    if not same:
        good = factorise(joints, condensed, D, factors.lu)
        forget_changes(factors.changes)
        for p in range(len(D)):
            copy_rows(D[p], known[p])
        if not good:
            known[0, 0, 0] = np.nan
            return False
    solve_factors(factors.lu.A, factors.lu.exchanges, x)
    return True
