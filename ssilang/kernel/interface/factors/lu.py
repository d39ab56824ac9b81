"""LU factors of Newton's matrix `1 + S (c K - R)` of a condensed interface."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.condensed import Condensed, jump_stiffness
from ssilang.kernel.interface.response import Joints
from ssilang.kernel.solvers.dense import factorise_dense, multiply


class LU(NamedTuple):
    """Factors A (q, q) and their row exchanges (q,), see `factorise_dense`."""

    A: FloatArray
    exchanges: IntArray


@compiled
def _times_stiffness(S: FloatArray, K: FloatArray, A: FloatArray) -> None:
    """A = 1 + S K, K being dense or with few terms a row."""
    n, terms = len(S), 0
    for k in range(n):
        for j in range(n):
            if K[k, j] != 0.0:
                terms += 1
    if 4 * terms > n * n:
        multiply(S, K, A)
    else:
        # rows of K as a sparse matrix
        start, column, value = np.zeros(n + 1, np.int64), np.empty(terms, np.int64), np.empty(terms)
        terms = 0
        for k in range(n):
            for j in range(n):
                if K[k, j] != 0.0:
                    column[terms], value[terms] = j, K[k, j]
                    terms += 1
            start[k + 1] = terms
        # each row of S spreads over them
        for i in range(n):
            for j in range(n):
                A[i, j] = 0.0
            for k in range(n):
                for e in range(start[k], start[k + 1]):
                    A[i, column[e]] += S[i, k] * value[e]
    for i in range(n):
        A[i, i] += 1.0


@apart
@compiled
def factorise(joints: Joints, condensed: Condensed, D: FloatArray, lu: LU) -> bool:
    """Factors of `1 + S (c K - R)`, K of the tangents D; False if it is singular."""
    n = len(condensed.S)
    K = np.empty((n, n))
    jump_stiffness(joints, condensed, D, K)
    _times_stiffness(condensed.S, K, lu.A)
    return factorise_dense(lu.A, lu.exchanges)
