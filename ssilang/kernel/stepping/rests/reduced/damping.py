"""A damping matrix on reduced vectors: a diagonal, and rows of what is left of it.

Where `C = alpha M + beta K + C'`, C' are dashpots, or bodies whose damping differs from that of
most.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.problem.constraints import split_damping

ROUNDING = 1e-15  # of the largest eigenvalue of C': a direction without dashpot
ASYMMETRIC = 1e-10  # of the largest term


@dataclass(frozen=True, eq=False)
class SplitDamping:
    """`C = alpha M + beta K + rest` on the motions y.

    Attributes
    ----------
    C, rest : csr arrays (n_y, n_y)
    touched : array of int
        Unknowns that the rest acts on.
    rows, sense : arrays (d, n_touched), (d,) or None
        `rest = rows^T sense rows` on them, made where they are few.
    """

    alpha: float
    beta: float
    C: sp.csr_array
    rest: sp.csr_array
    touched: IntArray
    few: tuple[FloatArray, FloatArray] | None

    def on(self, V: FloatArray, known: FloatArray | None = None) -> tuple[FloatArray, FloatArray]:
        """Rows B (d, r) and senses (d,) of the rest on the vectors V (r, n_y), one a row.

        `known` (r, r) is the rest on them, where it has been made.
        """
        if self.few is not None:
            rows, sense = self.few
            return rows @ V[:, self.touched].T, sense
        return square_roots(V @ (self.rest @ V.T) if known is None else known)


def split(C: sp.csr_array, M: sp.csr_array, K: sp.csr_array, most: int) -> SplitDamping | None:
    """The parts of a damping; None if it is not symmetric.

    Its rows are made at once if it touches at most `most` unknowns.
    """
    if C.nnz and abs(C - C.T).max() > ASYMMETRIC * abs(C).max():
        return None
    alpha, beta, rest = split_damping(C, M, K)
    rest = sp.csr_array(0.5 * (rest + rest.T))
    touched = np.unique(rest.indices).astype(np.int64)
    few = None
    if len(touched) <= most:
        few = square_roots(rest[touched][:, touched].toarray())
    return SplitDamping(alpha, beta, C, rest, touched, few)


def square_roots(A: FloatArray) -> tuple[FloatArray, FloatArray]:
    """R (d, n) and s (d,) of a symmetric `A = R^T s R`, s = 1 or -1; d is its rank."""
    values, vectors = np.linalg.eigh(0.5 * (A + A.T))
    kept = np.abs(values) > ROUNDING * np.abs(values).max(initial=0.0)
    found: FloatArray = np.sqrt(np.abs(values[kept]))[:, None] * vectors[:, kept].T
    return np.ascontiguousarray(found), np.sign(values[kept])
