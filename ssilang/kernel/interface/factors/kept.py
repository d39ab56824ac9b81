"""What solves with Newton's matrix `1 + S (c K - R)`, and is kept while the tangents stay.

Between changes of contact the tangents of successive turns and steps are the same numbers. Few
jumps keep an inverse that points change one by one (`Inverse`); more jumps keep LU factors (`LU`);
many jumps correct the solutions of these factors, not the factors: directly for few points that
changed (`Changes`), else by iterations (`Krylov`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import apart, seldom
from ssilang.kernel.base.compiled.beside import tell_more
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_rows, is_equal
from ssilang.kernel.interface.factors.changed import (
    DONE,
    MOST_CHANGED,
    TOO_MANY,
    Changes,
    forget_changes,
    solve_changed,
)
from ssilang.kernel.interface.factors.inverse import (
    PLAIN,
    Inverse,
    apply_inverse,
    inverse_of,
    update_inverse,
)
from ssilang.kernel.interface.factors.krylov import Krylov, new_krylov, pays, solve_iterated
from ssilang.kernel.interface.factors.lu import LU, factorise
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.solvers.dense import solve_factors

FEW = 160  # jumps up to which an inverse is kept
LARGE = 300  # jumps from which factors are changed rather than made again
FORCING = 1e-4  # residual of an iterated direction: the turns that it costs are few


class Factors(NamedTuple):
    """The tangents (n_points, d, d) that are factorised (NaN: none yet), and by which record.

    `lu` and `krylov` are empty beside an inverse, `inverse` elsewhere, `changes` of few jumps.
    """

    tangents: FloatArray
    lu: LU
    inverse: Inverse
    changes: Changes
    krylov: Krylov


def new_factors(shape: tuple[int, ...], q: int, few: int = FEW, large: int = LARGE) -> Factors:
    """Room for (n_points, d) local jumps and q jumps of pairs; nothing is factorised yet."""
    own = q if q <= few else 0  # of an inverse
    whole, changing = q - own, q if own == 0 and q >= large else 0
    tell_more("iterated" if own == 0 else "inverse" if own <= PLAIN else "blocks")
    return Factors(
        np.full((*shape, shape[1]), np.nan),
        LU(np.zeros((whole, whole)), np.zeros(whole, np.int64)),
        inverse_of(np.zeros((own, own)), shape[1]),
        Changes(
            np.zeros((changing // MOST_CHANGED, changing)),
            np.full(changing, -1, np.int64),
            np.zeros(1, np.int64),
        ),
        new_krylov(shape, whole),
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
        solve_factors(factors.lu.A, factors.lu.exchanges, x)


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
    """`solve_tangent` of many jumps: by LU factors, changed or iterated on where that pays."""
    known, lu, same = factors.tangents, factors.lu, True
    for p in range(len(D)):
        same = same and is_equal(D[p], known[p])
    if not same and is_factorised(factors):
        if len(factors.changes.row):
            found = solve_changed(joints, condensed, D, known, lu, factors.changes, x)
            if found != TOO_MANY:
                return found == DONE
        if pays(factors.krylov, D) and solve_iterated(
            joints, condensed, D, known, lu, factors.krylov, x, enough
        ):
            return True
    if not same:
        good = factorise(joints, condensed, D, lu)
        forget_changes(factors.changes)
        factors.krylov.spent[0] = 0
        for p in range(len(D)):
            copy_rows(D[p], known[p])
        if not good:
            known[0, 0, 0] = np.nan
            return False
    solve_known(joints, condensed, factors, x)
    return True
