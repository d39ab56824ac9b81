"""Beams of the plane in finite displacements: straight chords that turn, small strains along them.

Each cell is carried by its chord: what is left of the displacements, the lengthening and the turns
of the ends against the chord, is small and meets the stiffness of small displacements (Crisfield
1991, chapter 7). Shears follow from the moments at the ends.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.beams.beam_frame import beam_frame
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.families import stiffness
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode, Zone

_BEAMS = ("beam", "timoshenko")
# displacements of both nodes, in the axes of the chord, for one unit of lengthening and end turns
CARRIED = np.zeros((6, 3))
CARRIED[3, 0] = CARRIED[2, 1] = CARRIED[5, 2] = 1.0


def is_plane_beam(zone: Zone) -> bool:
    """Whether a zone has the unknowns UX UY RZ of beams of the plane."""
    space = zone.mode in (Mode.THREE_DIMENSIONAL, Mode.FOURIER, Mode.AXISYMMETRIC)
    return ELEMENTS[zone.element].family in _BEAMS and not space


@dataclass(frozen=True, eq=False)
class FiniteBeam:
    """Beams of the plane.

    Attributes
    ----------
    span : array (n, 2)
        From end to end at rest.
    stiffness : array (n, 3, 3)
        Of the normal force and the moments at both ends over lengthening and turns of the ends.
    initial : array (n, 3)
        The same forces without displacement.
    points : int
        Where section forces are shown: 1, the middle, or 2, the ends.
    """

    zone: Zone
    span: FloatArray
    stiffness: FloatArray
    initial: FloatArray
    points: int

    def _present(self, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Lengthening and turns of the ends (n, 3), present lengths (n,), directions (n, 2)."""
        now = self.span + u[:, 3:5] - u[:, :2]
        rest, length = np.linalg.norm(self.span, axis=1), np.linalg.norm(now, axis=1)
        if (length == 0.0).any():
            raise FieldError("kernel.plasticity.beam-shrunk-nothing")
        across = self.span[:, 0] * now[:, 1] - self.span[:, 1] * now[:, 0]
        turn = np.arctan2(across, np.einsum("ni,ni->n", self.span, now))
        # of the angles that differ by whole turns, the one nearest to the ends'
        turn += 2 * np.pi * np.round((0.5 * (u[:, 2] + u[:, 5]) - turn) / (2 * np.pi))
        small = np.stack([length - rest, u[:, 2] - turn, u[:, 5] - turn], axis=1)
        return small, length, now / length[:, None]

    def small(self, u: FloatArray) -> FloatArray:
        """Lengthening and turns of both ends against the chord (n, 3)."""
        return self._present(u)[0]

    def _inner(self, u: FloatArray) -> FloatArray:
        """Normal force and moments at both ends (n, 3)."""
        elastic = np.einsum("nij,nj->ni", self.stiffness, self._present(u)[0])
        return np.asarray(self.initial + elastic)

    def _variations(self, length: FloatArray, t: FloatArray) -> FloatArray:
        """Lengthening and turns of the ends (n, 3, 6) for one unit of each unknown."""
        across = np.stack([-t[:, 1], t[:, 0]], axis=1) / length[:, None]
        B = np.zeros((len(t), 3, 6))
        B[:, 0, :2], B[:, 0, 3:5] = -t, t
        for row, own in ((1, 2), (2, 5)):
            B[:, row, :2], B[:, row, 3:5], B[:, row, own] = across, -across, 1.0
        return B

    def forces(self, u: FloatArray) -> FloatArray:
        """Internal forces."""
        _, length, t = self._present(u)
        return np.asarray(np.einsum("nij,ni->nj", self._variations(length, t), self._inner(u)))

    def tangent(self, u: FloatArray) -> FloatArray:
        """Bending and stretching, and the turning of the chord under its forces."""
        _, length, t = self._present(u)
        B, inner = self._variations(length, t), self._inner(u)
        n = np.stack([-t[:, 1], t[:, 0]], axis=1)
        mixed = t[:, :, None] * n[:, None, :]
        g = (inner[:, 0] / length)[:, None, None] * n[:, :, None] * n[:, None, :]
        moments = (inner[:, 1] + inner[:, 2]) / length**2
        g = g + moments[:, None, None] * (mixed + np.swapaxes(mixed, 1, 2))
        K = np.swapaxes(B, 1, 2) @ self.stiffness @ B
        for rows, i in ((slice(0, 2), -1.0), (slice(3, 5), 1.0)):
            for columns, j in ((slice(0, 2), -1.0), (slice(3, 5), 1.0)):
                K[:, rows, columns] += i * j * g
        return np.asarray(K)

    def stored(self, u: FloatArray) -> float:
        """Elastic energy."""
        mean = 0.5 * (self.initial + self._inner(u))
        return float(np.einsum("ni,ni->", mean, self._present(u)[0]))

    def shown(self, u: FloatArray) -> FloatArray:
        """Normal force, shear and moment in the axes of the present chord."""
        N, first, second = self._inner(u).T
        V = -(first + second) / np.linalg.norm(self.span, axis=1)
        ends = np.stack([[N, V, -first], [N, V, second]], axis=-1)
        if self.points == 1:
            ends = ends.mean(axis=-1, keepdims=True)
        return np.moveaxis(ends, 1, 0)

    def stressed(self, given: FloatArray, u: FloatArray) -> FiniteBeam:
        """Initial forces from present ones."""
        half = 0.5 * given[:, 1].mean(axis=1) * np.linalg.norm(self.span, axis=1)
        moments = (-given[:, 2, 0], given[:, 2, -1])
        if self.points == 1:
            moments = (-given[:, 2, 0] - half, given[:, 2, 0] - half)
        wanted = np.stack([given[:, 0].mean(axis=1), *moments], axis=1)
        zero = replace(self, initial=np.zeros_like(self.initial))
        return replace(self, initial=wanted - zero._inner(u))


def finite_beam(zone: Zone, material: CellField, points: int) -> FiniteBeam:
    """A zone of beams without stress."""
    frame = beam_frame(zone, zone_field(zone, material))
    T = frame.rotation(zone)
    local = T @ stiffness(zone, material).values @ np.swapaxes(T, 1, 2)
    ends = zone.cells.coordinates
    span = (ends[:, -1] - ends[:, 0])[:, :2]
    inner = CARRIED.T @ local @ CARRIED
    return FiniteBeam(zone, span, inner, np.zeros((len(span), 3)), points)
