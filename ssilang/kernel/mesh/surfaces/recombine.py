"""Triangles paired into quadrangles."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray

_WORST = 0.15  # quadrangles with a corner further than this part of 90 degrees from flat are made


def pair_triangles(points: FloatArray, triangles: IntArray) -> tuple[IntArray, IntArray]:
    """Quadrangles (q, 4) from pairs of adjacent triangles, squarest first, and the rest.

    Parameters
    ----------
    points : array (m, 2)
    triangles : array (t, 3)
        Anticlockwise.

    Returns
    -------
    quadrangles : array (q, 4)
    triangles : array (r, 3)
    """
    left, right, quads = _pairs(triangles)
    if not len(quads):
        return np.empty((0, 4), dtype=np.int64), triangles
    shape = squareness(points, quads)
    free = np.ones(len(triangles), dtype=bool)
    chosen = []
    for k in np.argsort(-shape, kind="stable").tolist():
        if shape[k] < _WORST:
            break
        if free[left[k]] and free[right[k]]:
            free[left[k]] = free[right[k]] = False
            chosen.append(k)
    return quads[chosen], triangles[free]


def squareness(points: FloatArray, quads: IntArray) -> FloatArray:
    """1 for rectangles, 0 or less when a corner is flat or re-entrant, shape (q,)."""
    x = points[quads]
    before, after = np.roll(x, 1, axis=1) - x, np.roll(x, -1, axis=1) - x
    sine = after[..., 0] * before[..., 1] - after[..., 1] * before[..., 0]
    cosine = (after * before).sum(axis=2)
    angle = np.arctan2(sine, cosine) % (2 * np.pi)
    shape: FloatArray = 1.0 - np.abs(angle - np.pi / 2).max(axis=1) / (np.pi / 2)
    return shape


def _pairs(triangles: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Adjacent triangles (numbers, numbers) and the quadrangle that each pair makes."""
    n = int(triangles.max(initial=0)) + 1
    sides = np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    apex = np.concatenate([triangles[:, 2], triangles[:, 0], triangles[:, 1]])
    owner = np.tile(np.arange(len(triangles)), 3)
    code, reverse = sides @ [n, 1], sides @ [1, n]
    order = np.argsort(code)
    twin = order[np.minimum(np.searchsorted(code[order], reverse), len(code) - 1)]
    pick = np.flatnonzero((code[twin] == reverse) & (owner < owner[twin]))
    other = twin[pick]
    quads = np.column_stack([sides[pick, 0], apex[other], sides[pick, 1], apex[pick]])
    return owner[pick], owner[other], quads
