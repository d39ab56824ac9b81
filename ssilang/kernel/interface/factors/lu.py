"""LU factors of Newton's matrix `1 + S (c K - R)` of a condensed interface."""

from __future__ import annotations

from typing import NamedTuple

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart, seldom
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.copies import clear
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.solvers.dense import factorise_dense, multiply


class LU(NamedTuple):
    """Factors A (q, q) and their row exchanges (q,), see `factorise_dense`."""

    A: FloatArray
    exchanges: IntArray


@compiled_fast
def _add_point(
    pairs: IntArray, B: FloatArray, D: FloatArray, weight: float, S: FloatArray, A: FloatArray
) -> None:
    """`A += weight S B^T D B` of one point."""
    d = len(B)
    for i in range(len(S)):
        for column in range(d):
            total = 0.0
            for row in range(d):
                if D[row, column] != 0.0:
                    felt = 0.0
                    for a in range(len(pairs)):
                        for j in range(d):
                            felt += S[i, pairs[a] * d + j] * B[row, a * d + j]
                    total += felt * D[row, column]
            if total != 0.0:
                total *= weight
                for a in range(len(pairs)):
                    for j in range(d):
                        A[i, pairs[a] * d + j] += total * B[column, a * d + j]


@seldom
@compiled
def _hold_less(S: FloatArray, R: FloatArray, A: FloatArray) -> None:
    """A = -S R."""
    multiply(S, R, A)
    for i in range(len(A)):
        for j in range(len(A)):
            A[i, j] = -A[i, j]


@compiled
def newton_matrix(joints: Joints, condensed: Condensed, D: FloatArray, A: FloatArray) -> None:
    """`A = 1 + S (c K - R)`, K of the tangents D."""
    if len(condensed.R):
        _hold_less(condensed.S, condensed.R, A)
    else:
        clear(A)
    for i in range(len(A)):
        A[i, i] += 1.0
    for p in range(len(D)):
        weight = condensed.c * joints.weights[p]
        _add_point(joints.pairs[p], joints.B[p], D[p], weight, condensed.S, A)


@apart
@compiled
def factorise(joints: Joints, condensed: Condensed, D: FloatArray, lu: LU) -> bool:
    """Factors of `1 + S (c K - R)`, K of the tangents D; False if it is singular."""
    newton_matrix(joints, condensed, D, lu.A)
    return factorise_dense(lu.A, lu.exchanges)
