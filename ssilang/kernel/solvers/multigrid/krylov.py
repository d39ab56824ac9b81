"""Preconditioned iterations: conjugate gradients, minimal residuals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray

RESTART = 40  # vectors that are kept

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


def minimal_residuals(
    multiply: Map, coarser: Map, b: FloatArray, enough: float, most: int
) -> Found:
    """As `conjugate_gradients` for any A (Saad 1993, flexible GMRES), begun anew now and then."""
    x, r, turns = np.zeros_like(b), b.copy(), 0
    size = float(np.linalg.norm(r))
    while size > enough and turns < most:
        V, Z = [r / size], []
        H = np.zeros((RESTART + 1, RESTART))
        for k in range(RESTART):
            Z.append(np.asarray(coarser(V[k]), dtype=float))
            w = multiply(Z[k])
            for _ in range(2):  # Gram and Schmidt, twice
                for i in range(k + 1):
                    part = float(V[i] @ w)
                    H[i, k] += part
                    w -= part * V[i]
            H[k + 1, k] = np.linalg.norm(w)
            turns += 1
            wanted = np.zeros(k + 2)
            wanted[0] = size
            y = np.linalg.lstsq(H[: k + 2, : k + 1], wanted, rcond=None)[0]
            left = float(np.linalg.norm(wanted - H[: k + 2, : k + 1] @ y))
            if left <= 0.5 * enough or turns >= most or H[k + 1, k] <= 1e-15 * size:
                break
            V.append(w / H[k + 1, k])
        for z, part in zip(Z, y, strict=True):
            x += part * z
        r = b - multiply(x)
        before, size = size, float(np.linalg.norm(r))
        if not size < before:
            break  # it leads nowhere
    return Found(x, turns, size, size <= enough)
