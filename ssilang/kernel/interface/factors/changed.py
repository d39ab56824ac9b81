"""Directions of tangents other than those that a response `Y` was made of.

With K the stiffness of the tangents that Y belongs to (less what S holds in excess), and dK what
was added to it since, on the jumps that changed points join,

    (1 + S (K + dK))^-1 x = z - Y v ,   z = x - Y K x ,   (1 + dK Y) v = dK z

z is made of these jumps alone, and v, no larger, is iterated on (GMRES, Saad and Schultz 1986): to
the last digit where that reads fewer numbers than Y has, since laws of straight lines then end in
one turn. Then `x - Y (K x + v)` reads Y once.
"""

import math
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import later, seldom
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import add_product, copy_state, dot, is_equal
from ssilang.kernel.interface.factors.inverse import (
    Inverse,
    stiffness_forces,
    subtract_jumps,
)
from ssilang.kernel.interface.response import Joints, add_stiffness_forces
from ssilang.kernel.solvers.low_rank import add_low_rank_product

MOST_TURNS = 60
FEW_TURNS = 10
LAST_DIGIT = 1e-13
ROUGH = 1e-2  # residual of directions by blocks: a turn costs no more than two iterations
CALLS = 5e4  # numbers that could be read while a correction's calls take place
LONG, ALL = 0, 1  # places of `spent`


class Changed(NamedTuple):
    """What is overwritten, and what iterations cost; none for few jumps."""

    own: FloatArray  # (q q,) Y of the changed jumps, of the precision of Y
    jumps: IntArray  # (q,) the changed jumps
    V: FloatArray  # (m + 1, q) directions of the iteration
    # (2,) numbers read by long iterations since Y was made, by all of them since a point was taken
    spent: FloatArray


def new_changed(q: int, Y: FloatArray) -> Changed:
    """Room for q jumps of pairs (0: none is needed) beside the response Y."""
    return Changed(
        np.zeros(q * q, Y.dtype), np.zeros(q, np.int64), np.zeros((min(MOST_TURNS, q) + 1, q)),
        np.zeros(2),
    )  # fmt: skip


@compiled
def _find_changes(joints: Joints, D: FloatArray, known: FloatArray, jumps: IntArray) -> int:
    """How many jumps are those of points whose tangent changed: the first ones of `jumps`."""
    pairs, d, count = joints.pairs, D.shape[1], 0
    seen = np.zeros(len(jumps), np.bool_)
    for p in range(len(D)):
        if not is_equal(D[p], known[p]):
            for a in range(pairs.shape[1]):
                for i in range(d):
                    seen[pairs[p, a] * d + i] = True
    for j in range(len(jumps)):
        if seen[j]:
            jumps[count] = j
            count += 1
    return count


@compiled_fast
def _changed_forces(
    joints: Joints, c: float, change: FloatArray, changed: Changed, inverse: Inverse,
    g: FloatArray, v: FloatArray,
) -> None:  # fmt: skip
    """v += dK Y v of the changed jumps; g is room, zero on the others."""
    n = len(v)
    C, x, y = changed.own[: n * n].reshape((n, n)), inverse.x[:n], np.zeros(n)
    copy_state(v, x)
    add_product(1.0, C, x, y)
    forces = np.zeros(len(g))
    for a in range(n):
        g[changed.jumps[a]] = y[a]
    add_stiffness_forces(joints, c, change, g, forces)
    for a in range(n):
        v[a] += forces[changed.jumps[a]]


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


@compiled
def _iterate(
    joints: Joints, c: float, change: FloatArray, changed: Changed, inverse: Inverse,
    g: FloatArray, v: FloatArray, enough: float,
) -> bool:  # fmt: skip
    """`(1 + dK Y)^-1 v` in place by iterations; False if that takes too many turns."""
    n, most = len(v), len(changed.V) - 1
    V = changed.V[:, :n]
    H, turned, e = np.zeros((most, most + 1)), np.zeros((most, 2)), np.zeros(most + 1)
    e[0] = math.sqrt(dot(v, v))
    if e[0] == 0.0:
        return True
    size, limit = e[0], enough * e[0]
    for i in range(n):
        V[0, i] = v[i] / size
    for k in range(most):
        copy_state(V[k], V[k + 1])
        _changed_forces(joints, c, change, changed, inverse, g, V[k + 1])
        _orthogonalise(V, k, H[k])
        _rotate(H, k, turned, e)
        changed.spent[ALL] += n * n
        if k >= FEW_TURNS:
            changed.spent[LONG] += n * n
        last = k + 1 == n or (k + 1) * n * n > len(g) ** 2
        good = abs(e[k + 1]) <= (limit if last else LAST_DIGIT * size)
        if good and _combine(H, V, e, k + 1, v):
            return True
    return False


@seldom
@compiled
def solve_by_blocks(joints: Joints, condensed: Condensed, D: FloatArray, x: FloatArray) -> bool:
    """`x := (1 + S c K)^-1 x` by iterations on few vectors of the blocks of S, for soft joints.

    False, and x as it was, if that takes too many turns.
    """
    q, most = len(x), min(MOST_TURNS, len(x))
    V, H = np.empty((most + 1, q)), np.zeros((most, most + 1))
    turned, e = np.zeros((most, 2)), np.zeros(most + 1)
    size = e[0] = math.sqrt(dot(x, x))
    if size == 0.0:
        return True
    for i in range(q):
        V[0, i] = x[i] / size
    for k in range(most):
        forces = np.zeros(q)
        add_stiffness_forces(joints, condensed.c, D, V[k], forces)
        copy_state(V[k], V[k + 1])
        add_low_rank_product(condensed.blocks, True, forces, V[k + 1])
        _orthogonalise(V, k, H[k])
        _rotate(H, k, turned, e)
        if abs(e[k + 1]) <= ROUGH * size and _combine(H, V, e, k + 1, x):
            return True
    return False


@later
@compiled
def correct_changes(
    joints: Joints, condensed: Condensed, D: FloatArray, known: FloatArray, inverse: Inverse,
    changed: Changed, x: FloatArray, enough: float,
) -> bool:  # fmt: skip
    """`apply_inverse` of the tangents D; False, and x as it was, if that takes too many turns.

    `enough` is the residual of v that is left, relative to that of none.
    """
    q, jumps, Y, forces = len(x), changed.jumps, inverse.Y, inverse.room
    n = _find_changes(joints, D, known, jumps)
    stiffness_forces(joints, condensed, known, inverse, x)
    change, g, dK = np.empty(D.shape), np.zeros(q), np.zeros(q)
    for p in range(len(D)):
        for i in range(D.shape[1]):
            for j in range(D.shape[2]):
                change[p, i, j] = D[p, i, j] - known[p, i, j]
    C, v = changed.own[: n * n].reshape((n, n)), np.empty(n)
    copy_state(forces, inverse.x)
    for a in range(n):
        row = Y[jumps[a]]
        g[jumps[a]] = x[jumps[a]] - dot(row, inverse.x)
        for b in range(n):
            C[a, b] = row[jumps[b]]
    add_stiffness_forces(joints, condensed.c, change, g, dK)
    for a in range(n):
        v[a] = dK[jumps[a]]
    changed.spent[ALL] += n * (q + n) + CALLS
    if not _iterate(joints, condensed.c, change, changed, inverse, g, v, enough):
        return False
    for a in range(n):
        forces[jumps[a]] += v[a]
    subtract_jumps(inverse, forces, x)
    return True
