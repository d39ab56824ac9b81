"""LU factors of a large interface used on while many points change: they begin iterations.

Where most points slide, their tangents are other numbers at each turn, and near those of the
factors all the same. With A the matrix of the factors and dK what was added to the stiffness since,

    (1 + A^-1 S dK) x = A^-1 b

takes GMRES (Saad and Schultz 1986) a few turns, each a product with S and a solve with the factors.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import later
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import copy_rows, copy_state, dot, is_equal
from ssilang.kernel.interface.factors.lu import LU
from ssilang.kernel.interface.response import Joints, add_stiffness_forces
from ssilang.kernel.solvers.dense import solve_factors

MOST_TURNS = 60
WORTH = 20  # jumps for which new factors cost as much as one turn


class Krylov(NamedTuple):
    """What the iterations hold.

    Attributes
    ----------
    V : array (m + 1, q)
        Directions.
    asked : array (n_points, d, d)
        The tangents that were solved with last.
    spent : array (1,)
        Turns since there are these factors.
    """

    V: FloatArray
    asked: FloatArray
    spent: IntArray


def new_krylov(shape: tuple[int, ...], q: int) -> Krylov:
    """Room for (n_points, d) local jumps and q jumps of pairs (0: none is needed)."""
    turns, points = (min(MOST_TURNS, 8 + q // WORTH), shape[0]) if q else (-1, 0)
    asked = np.full((points, shape[1], shape[1]), np.nan)
    return Krylov(np.zeros((turns + 1, q)), asked, np.zeros(1, np.int64))


@compiled
def pays(krylov: Krylov, D: FloatArray) -> bool:
    """Whether to iterate for D: not if these tangents come again and factors would be cheaper."""
    again = True
    for p in range(len(D)):
        again = again and is_equal(D[p], krylov.asked[p])
        copy_rows(D[p], krylov.asked[p])
    return not (again and krylov.spent[0] * WORTH > krylov.V.shape[1])


@compiled_fast
def _orthogonalise(V: FloatArray, k: int, h: FloatArray) -> None:
    """Row k + 1 of V, made normal to those before and of length one; h (k + 2,) are its parts."""
    w = V[k + 1]
    for i in range(k + 1):
        v = V[i]
        h[i] = dot(v, w)
        for j in range(len(w)):
            w[j] -= h[i] * v[j]
    h[k + 1] = math.sqrt(dot(w, w))
    if h[k + 1] > 0.0:
        for j in range(len(w)):
            w[j] /= h[k + 1]


@compiled_fast
def _rotate(H: FloatArray, k: int, turned: FloatArray, e: FloatArray) -> None:
    """Column k of H, a row here, becomes one of a triangle; so does the right side e."""
    h = H[k]
    for i in range(k):
        c, s = turned[i, 0], turned[i, 1]
        h[i], h[i + 1] = c * h[i] + s * h[i + 1], c * h[i + 1] - s * h[i]
    size = math.hypot(h[k], h[k + 1])
    c, s = (h[k] / size, h[k + 1] / size) if size > 0.0 else (1.0, 0.0)
    turned[k, 0], turned[k, 1] = c, s
    h[k], h[k + 1] = size, 0.0
    e[k], e[k + 1] = c * e[k], -s * e[k]


@compiled_fast
def _combine(H: FloatArray, V: FloatArray, e: FloatArray, count: int, x: FloatArray) -> bool:
    """The combination x of `count` directions that the triangle gives; False if it is singular."""
    for i in range(len(x)):
        x[i] = 0.0
    for k in range(count - 1, -1, -1):
        if H[k, k] == 0.0:
            return False
        for after in range(k + 1, count):
            e[k] -= H[after, k] * e[after]
        e[k] /= H[k, k]
        v = V[k]
        for i in range(len(x)):
            x[i] += e[k] * v[i]
    return True


@later
@compiled
def solve_iterated(
    joints: Joints, condensed: Condensed, D: FloatArray, known: FloatArray, lu: LU,
    krylov: Krylov, x: FloatArray, enough: float,
) -> bool:  # fmt: skip
    """Solve in place with the tangents D by factors of the tangents `known`.

    Parameters
    ----------
    enough : float
        Residual, relative to the right side, both with the factors taken off.

    Returns
    -------
    bool
        False if that takes too many turns: x is what it was.
    """
    n, S, V = len(x), condensed.S, krylov.V
    most = len(V) - 1
    H, turned, e = np.zeros((most, most + 1)), np.zeros((most, 2)), np.zeros(most + 1)
    b, g, change = np.empty(n), np.empty(n), np.empty_like(D)
    for p in range(len(D)):
        for i in range(D.shape[1]):
            for j in range(D.shape[2]):
                change[p, i, j] = D[p, i, j] - known[p, i, j]
    copy_state(x, b)
    solve_factors(lu.A, lu.exchanges, x)
    e[0] = math.sqrt(dot(x, x))
    if e[0] == 0.0:
        return True
    limit = enough * e[0]
    for i in range(n):
        V[0, i] = x[i] / e[0]
    for k in range(most):
        w = V[k + 1]
        for i in range(n):
            g[i] = 0.0
        add_stiffness_forces(joints, condensed.c, change, V[k], g)
        for i in range(n):
            w[i] = dot(S[i], g)
        solve_factors(lu.A, lu.exchanges, w)
        for i in range(n):
            w[i] += V[k, i]
        _orthogonalise(V, k, H[k])
        _rotate(H, k, turned, e)
        krylov.spent[0] += 1
        if abs(e[k + 1]) <= limit and _combine(H, V, e, k + 1, x):
            return True
    copy_state(b, x)
    return False
