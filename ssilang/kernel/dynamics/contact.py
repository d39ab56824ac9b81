"""Unilateral relations (MINI, MAXI) of a time-stepping problem.

All rows are written `gap = G u - d >= 0` with a reaction p >= 0 that pushes by `G^T p`; rows of
sense -1 (MAXI) are turned round.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.errors import KernelError
from ssilang.kernel.matrices.assembly import ConstraintRows
from ssilang.kernel.mesh.nodes import FloatArray, IntArray
from ssilang.kernel.sparse import sp

BoolArray = NDArray[np.bool_]
TOUCHING = 1e-12  # of the largest gap or displacement: closed at the start


@dataclass(frozen=True, eq=False)
class ContactRows:
    """Unilateral conditions on one numbering.

    Attributes
    ----------
    G : csr array (m, n)
        Rows times their sense.
    sense : array (m,)
        +1 MINI, -1 MAXI.
    multipliers : array (m,)
        Multiplier nodes.
    imposed : array (m, k)
        Imposed values times the sense, by load curve.
    """

    G: sp.csr_array
    sense: FloatArray
    multipliers: IntArray
    imposed: FloatArray

    def __len__(self) -> int:
        return len(self.sense)

    def gaps(self, u: FloatArray, factors: FloatArray) -> FloatArray:
        """Gaps (m,) at displacement u (n,) and load factors (k,)."""
        found: FloatArray = self.G @ u - self.imposed @ factors
        return found

    def penalty_energy(self, gaps: FloatArray, coefficient: float | None) -> float:
        """Energy stored in the springs of a penalty at gaps (m,)."""
        return 0.5 * (coefficient or 0.0) * float(np.sum(np.minimum(gaps, 0.0) ** 2))

    def lagrange(self, p: FloatArray) -> FloatArray:
        """Multipliers LX (m,) as solutions carry them: K u + C^T LX = F."""
        return -self.sense * p


def split_rows(
    rows: ConstraintRows, imposed: FloatArray
) -> tuple[ConstraintRows, FloatArray, ContactRows | None]:
    """Equalities with their imposed values (n_rows, k), and unilateral rows if there are any.

    Raises
    ------
    KernelError
        For unilateral relations that push by other rows than their own.
    """
    unilateral = rows.sense != 0
    if not unilateral.any():
        return rows, imposed, None
    keep, turn = np.flatnonzero(~unilateral), np.flatnonzero(unilateral)
    C = sp.csr_array(rows.C[keep])
    D = C if rows.associated or _same(C, rows.D[keep]) else sp.csr_array(rows.D[keep])
    if not rows.associated and not _same(rows.C[turn], rows.D[turn]):
        raise KernelError(
            "unilateral relations (MINI, MAXI) with a dual are solved by RESO only",
            "leave the 'DUAL' of these relations",
        )
    equalities = ConstraintRows(C, rows.multipliers[keep], rows.sense[keep], D)
    sense = rows.sense[turn].astype(float)
    contact = ContactRows(
        sp.csr_array(sp.diags_array(sense) @ rows.C[turn]),
        sense,
        rows.multipliers[turn],
        sense[:, None] * imposed[turn],
    )
    return equalities, imposed[keep], contact


def _same(C: sp.csr_array, D: sp.csr_array) -> bool:
    return bool(abs(C - D).sum() == 0.0)
