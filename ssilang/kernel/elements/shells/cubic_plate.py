"""Bending of the triangle COQ3: a deflection of nine cubic terms.

Bazeley, Cheung, Irons, Zienkiewicz, "Triangular elements in plate bending" (1965): ten cubic terms
less one, with the deflection and both slopes at the corners. Slopes across a side differ from one
triangle to the next; constant curvatures pass where the sides run in three directions, elsewhere
the answer is off by some per cent.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.shapes.reference import shape_gradients


def _second(L: FloatArray, powers: tuple[int, int, int]) -> FloatArray:
    """Second derivatives (p, 3, 3) of a monomial of the area coordinates L (p, 3)."""
    out = np.empty((len(L), 3, 3))
    for a in range(3):
        for b in range(3):
            left, factor = list(powers), 1
            for axis in (a, b):
                factor *= left[axis]
                left[axis] -= 1
            out[:, a, b] = factor * np.prod(L ** np.maximum(left, 0), axis=1) if factor else 0.0
    return out


def _of(i: int, twice: int, j: int, once: int) -> tuple[int, int, int]:
    """Powers of the monomial L_i^twice L_j^once."""
    powers = [0, 0, 0]
    powers[i] += twice
    powers[j] += once
    return powers[0], powers[1], powers[2]


def cubic_curvatures(local: FloatArray, points: FloatArray) -> FloatArray:
    """Curvatures (n, 3, p, 9) from w, RX, RY at the corners (own frame).

    Parameters
    ----------
    local : array (n, 3, 2)
        Corners in the own frame.
    points : array (p, 2)
        Places in the reference triangle.
    """
    L = np.column_stack([1 - points.sum(axis=1), points])
    J = np.stack([local[:, 1] - local[:, 0], local[:, 2] - local[:, 0]], axis=1)
    slopes = np.einsum("cij,kj->cik", np.linalg.inv(J), shape_gradients("TRI3", points)[0])
    bubble = _second(L, (1, 1, 1)) / 2
    found = np.zeros((len(local), len(points), 3, 3, 3, 3))  # cell, point, Hessian, node, unknown
    hessians = found.transpose(0, 1, 4, 5, 2, 3)
    for i in range(3):
        for j in ((i + 1) % 3, (i + 2) % 3):
            forth, back = _second(L, _of(i, 2, j, 1)), _second(L, _of(i, 1, j, 2))
            hessians[:, :, i, 0] += (forth - back)[None]
            side = (local[:, j] - local[:, i])[:, None, None, None]
            hessians[:, :, i, 1] += side[..., 1] * (forth + bubble)  # RX = dw/dy
            hessians[:, :, i, 2] -= side[..., 0] * (forth + bubble)  # RY = - dw/dx
    bent = -np.einsum("cia,cpabnu,cjb->cijpnu", slopes, found, slopes, optimize=True)
    rows = np.stack([bent[:, 0, 0], bent[:, 1, 1], 2 * bent[:, 0, 1]], axis=1)
    return rows.reshape(len(local), 3, len(points), 9)
