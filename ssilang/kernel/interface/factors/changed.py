"""LU factors of a large interface used on while few points change (Woodbury's formula).

With A the matrix of the factors and E the columns of the jumps whose points changed,

    (A + S E dK E^T)^-1 x = z - Z (1 + dK E^T Z)^-1 dK E^T z ,   z = A^-1 x ,  Z = A^-1 S E

Columns of Z are kept as long as the factors are.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import later
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import is_equal
from ssilang.kernel.interface.factors.lu import LU
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.solvers.dense import (
    factorise_dense,
    multiply,
    solve_factors,
    solve_factors_together,
)

MOST_CHANGED = 4  # one of so many jumps may have changed

DONE, SINGULAR, TOO_MANY = range(3)


class Changes(NamedTuple):
    """Columns of Z that are known.

    Attributes
    ----------
    Z : array (m, q)
        One column a row.
    row : array (q,)
        Row of each jump, -1 for none.
    held : array (1,)
        Rows in use.
    """

    Z: FloatArray
    row: IntArray
    held: IntArray


@compiled
def forget_changes(changes: Changes) -> None:
    """New factors: no column is known."""
    changes.held[0] = 0
    for j in range(len(changes.row)):
        changes.row[j] = -1


@compiled
def _changed_jumps(
    pairs: IntArray, D: FloatArray, known: FloatArray, n: int
) -> tuple[IntArray, int]:
    """Place (n,) of each jump among those of points whose tangent changed, -1 elsewhere."""
    place, count, d = np.full(n, -1, np.int64), 0, D.shape[1]
    for p in range(D.shape[0]):
        if not is_equal(D[p], known[p]):
            for a in range(pairs.shape[1]):
                for i in range(d):
                    if place[pairs[p, a] * d + i] < 0:
                        place[pairs[p, a] * d + i] = count
                        count += 1
    return place, count


@compiled
def _stiffness_change(
    joints: Joints, c: float, D: FloatArray, known: FloatArray, place: IntArray, count: int
) -> FloatArray:
    """Change (count, count) of `c K` since the factors, on the changed jumps."""
    pairs, B = joints.pairs, joints.B
    change, d, m = np.zeros((count, count)), D.shape[1], pairs.shape[1]
    for p in range(D.shape[0]):
        if is_equal(D[p], known[p]):
            continue
        for i in range(d):
            for j in range(d):
                value = c * joints.weights[p] * (D[p, i, j] - known[p, i, j])
                if value != 0.0:
                    for a in range(m * d):
                        row = place[pairs[p, a // d] * d + a % d]
                        part = value * B[p, i, a]
                        for b in range(m * d):
                            change[row, place[pairs[p, b // d] * d + b % d]] += part * B[p, j, b]
    return change


@compiled
def _complete(S: FloatArray, lu: LU, changes: Changes, place: IntArray) -> bool:
    """Columns of Z for all changed jumps; False if there is no room left."""
    n, wanted = len(S), 0
    for j in range(n):
        if place[j] >= 0 and changes.row[j] < 0:
            wanted += 1
    held = changes.held[0]
    if held + wanted > len(changes.Z):
        return False
    if wanted == 0:
        return True
    X, fresh = np.empty((n, wanted)), 0
    for j in range(n):
        if place[j] >= 0 and changes.row[j] < 0:
            for i in range(n):
                X[i, fresh] = S[i, j]
            changes.row[j] = held + fresh
            fresh += 1
    solve_factors_together(lu.A, lu.exchanges, X)
    for e in range(wanted):
        for i in range(n):
            changes.Z[held + e, i] = X[i, e]
    changes.held[0] = held + wanted
    return True


@compiled
def _correct(changes: Changes, place: IntArray, change: FloatArray, x: FloatArray) -> bool:
    """x := x - Z (1 + dK E^T Z)^-1 dK E^T x; False if that matrix is singular."""
    n, count = len(x), len(change)
    jumps = np.empty(count, np.int64)
    for j in range(n):
        if place[j] >= 0:
            jumps[place[j]] = j
    right, own = np.empty((count, 1)), np.empty((count, count))
    for a in range(count):
        right[a, 0] = x[jumps[a]]
        for b in range(count):
            own[a, b] = changes.Z[changes.row[jumps[b]], jumps[a]]
    small, turned = np.empty((count, count)), np.empty((count, 1))
    multiply(change, own, small)
    multiply(change, right, turned)
    for a in range(count):
        small[a, a] += 1.0
    order = np.empty(count, np.int64)
    if not factorise_dense(small, order):
        return False
    solve_factors_together(small, order, turned)
    for a in range(count):
        row = changes.row[jumps[a]]
        for i in range(n):
            x[i] -= turned[a, 0] * changes.Z[row, i]
    return True


@later
@compiled
def solve_changed(
    joints: Joints, condensed: Condensed, D: FloatArray, known: FloatArray, lu: LU,
    changes: Changes, x: FloatArray,
) -> int:  # fmt: skip
    """Solve in place with the tangents D by factors of the tangents `known`.

    Returns
    -------
    int
        DONE, SINGULAR, or TOO_MANY: x is what it was, factors are made anew more cheaply.
    """
    n = len(x)
    place, count = _changed_jumps(joints.pairs, D, known, n)
    if count > n // MOST_CHANGED or not _complete(condensed.S, lu, changes, place):
        return TOO_MANY
    change = _stiffness_change(joints, condensed.c, D, known, place, count)
    solve_factors(lu.A, lu.exchanges, x)
    return DONE if _correct(changes, place, change, x) else SINGULAR
