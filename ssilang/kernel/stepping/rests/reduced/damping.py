"""A damping matrix on reduced vectors: a diagonal, and rows of what is left of it.

Where `C = alpha M + beta K + C'`, C' are dashpots, or bodies whose damping differs from that of
most. C' is no small perturbation (the edge of a soil absorbs waves by it): the Krylov space that
goes with it is that of the damped operator. With states of displacement u and w = u', powers of

    u+ = (K + s C + s^2 M)^-1 ((s M + C) u + M w) ,   w+ = s u+ - u

match the response and its derivatives at the shift s. Both halves of all states lie in the space
of the displacements alone, so states are kept as coefficients on its vectors, where
orthonormalising them costs little.

References: Z. Bai, Y. Su (2005), SOAR, second-order Krylov spaces; D. Lu, Y. Su, Z. Bai (2016),
stability of the two-level orthogonal Arnoldi process.
"""

from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.problem.constraints import split_damping

ROUNDING = 1e-15  # of the largest eigenvalue of C': a direction without dashpot
DEPENDENT = 1e-10  # length, of one, below which what is left of a state is rounding
ASYMMETRIC = 1e-10  # of the largest term


@dataclass(frozen=True, eq=False)
class SplitDamping:
    """`C = alpha M + beta K + rest` on the motions y."""

    alpha: float
    beta: float
    C: sp.csr_array  # (n_y, n_y)
    rest: sp.csr_array  # (n_y, n_y)
    touched: IntArray  # unknowns that the rest acts on
    few: tuple[FloatArray, FloatArray] | None  # rows (d, t), sense (d,) of rest on t touched

    def on(self, V: FloatArray, rest: FloatArray | None = None) -> tuple[FloatArray, FloatArray]:
        """Rows B (d, r) and senses (d,) of the rest on the vectors V (r, n_y), one a row.

        `rest` (r, r) is what it is on them, if that is known.
        """
        if self.few is not None:
            rows, sense = self.few
            return rows @ V[:, self.touched].T, sense
        return square_roots(V @ (self.rest @ V.T) if rest is None else rest)


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


@dataclass(eq=False)
class States:
    """Orthonormal states of the damped Krylov space, as coefficients on the basis.

    Attributes
    ----------
    s : float
        The shift; the second half holds `w / s`.
    blocks : list of arrays (2, r, b)
        r vectors were there when a block was made.
    """

    s: float
    blocks: list[FloatArray] = field(default_factory=list)

    @property
    def last(self) -> FloatArray:
        """The newest block."""
        return self.blocks[-1]

    def add(self, u: FloatArray, old: FloatArray | None) -> None:
        """Append states with displacements u (r, b), made from displacements `old` (r', b).

        None: the first states, whose displacements are `s` times nothing before them.
        """
        w = u.copy()
        if old is not None:
            w[: len(old)] -= old / self.s
        x = np.stack([u, w])
        x /= np.sqrt(np.maximum(np.einsum("hrb,hrb->b", x, x), 1e-300))
        for _ in range(2):
            for block in self.blocks:
                r = block.shape[1]
                part = np.einsum("hrb,hrc->bc", block, x[:, :r])
                x[:, :r] -= block @ part
            found, lengths, _ = np.linalg.svd(np.concatenate(x), full_matrices=False)
            x = np.stack(np.split(found[:, lengths > DEPENDENT], 2))
        self.blocks.append(x)
