"""Matrices of motions made matrices of Fourier coefficients, with names of their own.

Unknown i of a node (of c) becomes U i for the mean, U (k c + i) for cos k and V (k c + i) for
sin k; forces F and G. `Z(w) = K + w C + w^2 M` of the expanded matrices.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.continuation.harmonics import derivative_matrix
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations

MOST = 6
ORDER = ("UX", "UY", "UZ", "UR", "UT", "RX", "RY", "RZ", "RT")


@dataclass(frozen=True)
class Names:
    """Unknowns of the motion, their duals, and the number of harmonics."""

    unknowns: tuple[str, ...]
    duals: tuple[str, ...]
    harmonics: int

    @property
    def places(self) -> int:
        """Coefficients of an unknown."""
        return 2 * self.harmonics + 1

    def coefficient(self, unknown: str, place: int, dual: bool = False) -> str:
        """Name of a coefficient; place 0 is the mean, 2 k - 1 cos k, 2 k sin k."""
        own = self.unknowns.index(unknown) + 1
        letters = "FG" if dual else "UV"
        sine = place > 0 and place % 2 == 0
        return f"{letters[sine]}{(place + 1) // 2 * len(self.unknowns) + own}"


def names_of(matrices: Sequence[Matrix], harmonics: int) -> Names:
    """Unknowns of matrices: displacements, rotations, then others by name.

    Raises
    ------
    KernelError
        For more than six unknowns a node.
    """
    pairs: dict[str, str] = {}
    for matrix in matrices:
        for block in matrix.blocks:
            pairs |= dict(zip(block.unknowns, block.duals, strict=True))
    if not pairs:
        raise KernelError("kernel.continuation.matrices-no-unknowns")
    if len(pairs) > MOST:
        raise KernelError(
            "kernel.continuation.harmonic-balance-takes-unknowns", most=MOST, pairs=pairs
        )
    order = sorted(pairs, key=lambda u: (ORDER.index(u) if u in ORDER else len(ORDER), u))
    return Names(tuple(order), tuple(pairs[u] for u in order), harmonics)


def expanded(matrix: Matrix, names: Names, terms: FloatArray) -> Matrix:
    """The matrix whose coefficients i and j are coupled by `terms[i, j]` times the given one."""
    blocks = []
    for block in matrix.blocks:
        for i, j in zip(*np.nonzero(np.triu(np.abs(terms) + np.abs(terms.T))), strict=True):
            blocks.append(_coupled(block, names, int(i), int(j), terms))
    relations = tuple(
        _renamed(r, names, place) for r in matrix.relations for place in range(names.places)
    )
    return Matrix(matrix.table, tuple(blocks), relations, matrix.kind)


def _coupled(
    block: ElementMatrices, names: Names, i: int, j: int, terms: FloatArray
) -> ElementMatrices:
    primal, dual = (
        [tuple(names.coefficient(u, place, d) for u in block.unknowns) for place in (i, j)]
        for d in (False, True)
    )
    if i == j:
        values = terms[i, i] * block.values
        return replace(block, unknowns=primal[0], duals=dual[0], values=values, zone=None)
    zero = np.zeros_like(block.values)
    values = np.block([[zero, terms[i, j] * block.values], [terms[j, i] * block.values, zero]])
    return replace(
        block,
        local=np.concatenate([block.local, block.local]),
        unknowns=(*primal[0], *primal[1]),
        duals=(*dual[0], *dual[1]),
        values=values,
        zone=None,
        symmetric=bool(terms[i, j] == terms[j, i]) and block.symmetric,
    )


def _renamed(rows: Relations, names: Names, place: int) -> Relations:
    if rows.sense.any() or rows.dual is not None:
        raise KernelError("kernel.continuation.harmonic-balance-takes-plain")
    nodes: IntArray = rows.table.add(rows.table.coordinates[rows.multipliers].copy())
    unknowns = tuple(names.coefficient(u, place) for u in rows.unknowns)
    return replace(rows, unknowns=unknowns, raw_multipliers=nodes)


def stiffness_terms(harmonics: int) -> FloatArray:
    """K on each coefficient."""
    return np.eye(2 * harmonics + 1)


def damping_terms(harmonics: int) -> FloatArray:
    """C on cosine and sine, for w = 1."""
    return derivative_matrix(harmonics)


def mass_terms(harmonics: int) -> FloatArray:
    """- k^2 M, for w = 1."""
    D = derivative_matrix(harmonics)
    return np.asarray(D @ D)
