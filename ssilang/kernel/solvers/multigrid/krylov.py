"""Preconditioned conjugate gradients."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray

Map = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, eq=False)
class Found:
    """What an iteration ends with: x (n,), turns, |b - A x|, whether that is small enough."""

    x: FloatArray
    turns: int
    residual: float
    converged: bool


def conjugate_gradients(
    multiply: Map, coarser: Map, b: FloatArray, enough: float, most: int
) -> Found:
    """Solve A x = b, A symmetric positive, until the norm of the residual is `enough`.

    `coarser` may differ a little from turn to turn (it is of single precision): directions are
    made orthogonal with the change of the residual (Notay 2000).
    """
    x, r = np.zeros_like(b), b.copy()
    size = float(np.linalg.norm(r))
    p, before, old = np.zeros_like(b), 1.0, r
    for turn in range(most + 1):
        if size <= enough:
            return Found(x, turn, size, True)
        if turn == most:
            break
        z = np.asarray(coarser(r), dtype=float)
        now = float(r @ z)
        p *= (now - float(old @ z)) / before if turn else 0.0
        p += z
        Ap = multiply(p)
        curve = float(p @ Ap)
        if not curve > 0.0 or not np.isfinite(curve):
            break  # no positive matrix
        step = float(p @ r) / curve
        x += step * p
        old = r
        r = r - step * Ap
        before, size = now, float(np.linalg.norm(r))
    return Found(x, turn, size, False)
