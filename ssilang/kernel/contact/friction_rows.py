"""Friction of a time-stepping problem on its numbering: slips, limits, what sticks.

Slips of a step are `H du`; the friction tau pushes by `H^T tau`. Its limit is `coefficient p +
constant` of the unilateral row it belongs to while that is closed, or the value of the row
`watched` (a tension times a coefficient) where it belongs to none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.matrices.assembly import Numbering, constraint_matrix
from ssilang.kernel.matrices.matrix import Matrix, Relations


@dataclass(frozen=True, eq=False)
class Friction:
    """Places that rub, on nodes of a mesh.

    Attributes
    ----------
    slip : Relations
        Slips of the places, `width` rows each, place by place.
    width : int
        1 in the plane and for cables, 2 in space.
    coefficient, constant : arrays (k,)
        Limit of the friction force: `coefficient p + constant` where the unilateral relation of
        the place pushes with p > 0.
    raw_normals : array (k,)
        Multiplier nodes of these relations; empty with `tension`.
    tension : Relations or None
        Instead: rows whose positive values (with `offset`) are the limits.
    offset : array (k,)
    """

    slip: Relations
    width: int
    coefficient: FloatArray
    constant: FloatArray
    raw_normals: IntArray
    tension: Relations | None
    offset: FloatArray

    @property
    def normals(self) -> IntArray:
        """Multiplier nodes of the unilateral relations, after merges."""
        return self.slip.table.resolve(self.raw_normals)


BoolArray = NDArray[np.bool_]
STICKING = 1e-9
"""Share of its limit that a friction must stay under to hold."""


@dataclass(frozen=True, eq=False)
class FrictionRows:
    """Places that rub.

    Attributes
    ----------
    H : csr array (k d, n)
        Slips, d rows a place.
    width : int
        d, 1 in the plane, 2 in space.
    normal : array (k,)
        Unilateral row of each place, -1 for none.
    coefficient, constant : arrays (k,)
    watched : csr array (k, n)
        Rows whose values are the limits where `normal` is -1.
    offset : array (k,)
        Values of these at zero displacement.
    """

    H: sp.csr_array
    width: int
    normal: IntArray
    coefficient: FloatArray
    constant: FloatArray
    watched: sp.csr_array
    offset: FloatArray

    def sticking(self, pushes: FloatArray, tau: FloatArray, u: FloatArray) -> BoolArray:
        """Places (k,) whose friction tau (k d,) stays under its limit."""
        own = self.normal >= 0
        limit = np.where(own, 0.0, self.offset + self.watched @ u)
        p = pushes[self.normal[own]]
        bound = self.coefficient[own] * p + self.constant[own]
        limit[own] = np.where(p > 0.0, bound, 0.0)
        size = np.linalg.norm(tau.reshape(-1, self.width), axis=1)
        found: BoolArray = (limit > 0.0) & (size < (1.0 - STICKING) * limit)
        return found


def friction_rows(
    parts: tuple[Friction, ...], numbering: Numbering, multipliers: IntArray
) -> FrictionRows | None:
    """Friction on a numbering; `multipliers` (m,) are those of the unilateral rows in order."""
    if not parts:
        return None
    n = numbering.size
    H, watched, normal = [], [], []
    order = np.argsort(multipliers)
    for part in parts:
        rows = constraint_matrix(Matrix(part.slip.table, (), (part.slip,)), numbering)
        H.append(rows.C)
        k = len(part.coefficient)
        if part.tension is None:
            place = np.searchsorted(multipliers, part.normals, sorter=order)
            normal.append(order[place].astype(np.int64))
            watched.append(sp.csr_array((k, n)))
        else:
            normal.append(np.full(k, -1))
            found = constraint_matrix(Matrix(part.slip.table, (), (part.tension,)), numbering)
            watched.append(found.C)
    return FrictionRows(
        sp.csr_array(sp.vstack(H)),
        parts[0].width,
        np.concatenate(normal),
        np.concatenate([p.coefficient for p in parts]),
        np.concatenate([p.constant for p in parts]),
        sp.csr_array(sp.vstack(watched)),
        np.concatenate([p.offset for p in parts]),
    )
