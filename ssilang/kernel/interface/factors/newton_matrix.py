"""Newton's matrix `1 + S (c K - R)` of a condensed interface."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.condensed import Condensed
from ssilang.kernel.interface.response import Joints, interface_stiffness


@apart
@compiled
def newton_matrix(
    joints: Joints, condensed: Condensed, D: FloatArray, K: FloatArray, A: FloatArray
) -> None:
    """`A = 1 + S (c K - R)`, K of the tangents D, a row of which has few entries.

    What stands in brackets is left in `K`.
    """
    n, S, R = len(A), condensed.S, condensed.R
    first, count = np.zeros(n + 1, np.int64), 0
    interface_stiffness(joints, D, K)
    for k in range(n):
        for j in range(n):
            K[k, j] *= condensed.c
            if len(R):
                K[k, j] -= R[k, j]
            count += K[k, j] != 0.0
        first[k + 1] = count
    columns, values, count = np.empty(count, np.int64), np.empty(count), 0
    for k in range(n):
        for j in range(n):
            if K[k, j] != 0.0:
                columns[count], values[count] = j, K[k, j]
                count += 1
    row = np.empty(n)
    for i in range(n):
        for j in range(n):
            row[j] = 0.0
        row[i] = 1.0
        for k in range(n):
            for e in range(first[k], first[k + 1]):
                row[columns[e]] += S[i, k] * values[e]
        for j in range(n):
            A[i, j] = row[j]
