"""Friction of sides in contact and of cables: what slips, and up to which force it holds."""

from __future__ import annotations

from dataclasses import dataclass

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.matrices.matrix import Relations


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
