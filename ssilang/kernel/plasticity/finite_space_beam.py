"""Beams in space in finite displacements: frames that turn with the cells, small strains in them.

The first axis of a cell's present frame is its chord, the others follow the mean of the turned
second axes of both ends (Rankin and Nour-Omid 1988; Battini 2002). The rotations RX RY RZ of a node
are the components of one rotation vector, from the mesh at rest; moments are what works on it,
which is a moment about the axes as long as a node turns about one axis.

Beams of the plane in finite displacements: straight chords that turn, small strains along them.

Each cell is carried by its chord: what is left of the displacements, the lengthening and the turns
of the ends against the chord, is small and meets the stiffness of small displacements (Crisfield
1991, chapter 7). Shears follow from the moments at the ends.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.beams.beam_frame import BeamFrame, beam_frame
from ssilang.kernel.elements.catalog import STRAIGHT_BEAMS, family_name
from ssilang.kernel.elements.families import stiffness
from ssilang.kernel.elements.solids.kinematics import on_diagonal
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.plasticity.large.carried import Array, Carried

# displacements of both nodes, in the axes of the chord, for one unit of lengthening and end turns
CARRIED = np.zeros((6, 3))
CARRIED[3, 0] = CARRIED[2, 1] = CARRIED[5, 2] = 1.0


def is_plane_beam(zone: Zone) -> bool:
    """Whether a zone has the unknowns UX UY RZ of beams of the plane."""
    return family_name(zone) in STRAIGHT_BEAMS and zone.mode is not Mode.THREE_DIMENSIONAL


@dataclass(frozen=True, eq=False)
class FiniteBeam(Carried):
    """Beams of the plane: lengthening and turns of both ends against the chord.

    Attributes
    ----------
    span : array (n, 2)
        From end to end at rest.
    points : int
        Where section forces are shown: 1, the middle, or 2, the ends.
    """

    span: FloatArray

    def _measured(self, u: Array) -> tuple[Array, Array]:
        now = self.span + u[:, 3:5] - u[:, :2]
        rest, length = np.linalg.norm(self.span, axis=1), np.linalg.norm(now, axis=1)
        if (length == 0.0).any():
            raise FieldError("kernel.plasticity.beam-shrunk-nothing")
        across = self.span[:, 0] * now[:, 1] - self.span[:, 1] * now[:, 0]
        turn = np.arctan2(across, np.einsum("ni,ni->n", self.span, now))
        # of the angles that differ by whole turns, the one nearest to the ends'
        turn += 2 * np.pi * np.round((0.5 * (u[:, 2] + u[:, 5]) - turn) / (2 * np.pi))
        small = np.stack([length - rest, u[:, 2] - turn, u[:, 5] - turn], axis=1)
        along = now / length[:, None]
        return small, self._variations(along, length)

    def _variations(self, t: FloatArray, length: FloatArray) -> FloatArray:
        across = np.stack([-t[:, 1], t[:, 0]], axis=1) / length[:, None]
        B = np.zeros((len(t), 3, 6))
        B[:, 0, :2], B[:, 0, 3:5] = -t, t
        for row, own in ((1, 2), (2, 5)):
            B[:, row, :2], B[:, row, 3:5], B[:, row, own] = across, -across, 1.0
        return B

    def tangent(self, u: FloatArray) -> FloatArray:
        """Bending and stretching, and the turning of the chord under its forces."""
        d, B = self._measured(u)
        inner, length = self._inner(d), np.linalg.norm(self.span, axis=1) + d[:, 0]
        t, turned = B[:, 0, 3:5], B[:, 1, :2]
        mixed = t[:, :, None] * turned[:, None, :]
        g = (inner[:, 0] * length)[:, None, None] * turned[:, :, None] * turned[:, None, :]
        moments = (inner[:, 1] + inner[:, 2]) / length
        g = g + moments[:, None, None] * (mixed + np.swapaxes(mixed, 1, 2))
        K = np.swapaxes(B, 1, 2) @ self.stiffness @ B
        for rows, i in ((slice(0, 2), -1.0), (slice(3, 5), 1.0)):
            for columns, j in ((slice(0, 2), -1.0), (slice(3, 5), 1.0)):
                K[:, rows, columns] += i * j * g
        return np.asarray(K)

    def shown(self, u: FloatArray) -> FloatArray:
        """Normal force, shear and moment in the axes of the present chord."""
        N, first, second = self._inner(self.small(u)).T
        V = -(first + second) / np.linalg.norm(self.span, axis=1)
        ends = np.stack([[N, V, -first], [N, V, second]], axis=-1)
        if self.points == 1:
            ends = ends.mean(axis=-1, keepdims=True)
        return np.moveaxis(ends, 1, 0)

    def _stretched(self, given: FloatArray) -> FloatArray:
        half = 0.5 * given[:, 1].mean(axis=1) * np.linalg.norm(self.span, axis=1)
        moments = (-given[:, 2, 0], given[:, 2, -1])
        if self.points == 1:
            moments = (-given[:, 2, 0] - half, given[:, 2, 0] - half)
        return np.stack([given[:, 0].mean(axis=1), *moments], axis=1)


def finite_beam(zone: Zone, material: CellField, points: int) -> FiniteBeam:
    """A zone of beams without stress."""
    _, span, inner = _at_rest(zone, material, CARRIED)
    return FiniteBeam(zone, inner, np.zeros((len(span), 3)), points, span[:, :2])


def _at_rest(
    zone: Zone, material: CellField, carried: FloatArray
) -> tuple[BeamFrame, FloatArray, FloatArray]:
    """Frames, spans (n, 3), and stiffness (n, k, k) over what frames do not carry (m, k)."""
    frame, ends = beam_frame(zone, zone_field(zone, material)), zone.cells.coordinates
    moved = np.swapaxes(frame.rotation(zone), 1, 2) @ carried
    inner = np.swapaxes(moved, 1, 2) @ stiffness(zone, material).values @ moved
    return frame, ends[:, -1] - ends[:, 0], inner


SMALL = 1e-3
"""Squared angle below which functions of an angle are their series."""
# displacements of both nodes in the cell's axes for one unit of lengthening and end turns
_CARRIED = np.zeros((12, 7))
_CARRIED[6, 0] = 1.0
for _k in range(3):
    _CARRIED[3 + _k, 1 + _k] = _CARRIED[9 + _k, 4 + _k] = 1.0


def is_space_beam(zone: Zone) -> bool:
    """Whether a zone is one of beams in space."""
    straight = family_name(zone) in STRAIGHT_BEAMS and "SECTION" not in zone.behaviour
    return straight and zone.mode is Mode.THREE_DIMENSIONAL


# --- rotations: arrays (n, 3) and (n, 3, 3), analytic in their entries ---------------------------


def skew(v: Array) -> Array:
    """Matrices of the products `v x`."""
    out = np.zeros((*v.shape, 3), dtype=v.dtype)
    out[:, 0, 1], out[:, 0, 2], out[:, 1, 2] = -v[:, 2], v[:, 1], -v[:, 0]
    return out - np.swapaxes(out, 1, 2)


def _shares(v: Array) -> tuple[Array, Array, Array]:
    """sin(a)/a, (1 - cos a)/a^2, (a - sin a)/a^3 of the angles a."""
    s = (v * v).sum(axis=1)
    near = np.abs(s) < SMALL
    safe = np.where(near, 1.0, s)
    a = np.sqrt(safe)
    first = np.where(near, 1 - s / 6 * (1 - s / 20 * (1 - s / 42)), np.sin(a) / a)
    second = np.where(near, 0.5 - s / 24 * (1 - s / 30 * (1 - s / 56)), (1 - np.cos(a)) / safe)
    third = np.where(
        near, 1 / 6 - s / 120 * (1 - s / 42 * (1 - s / 72)), (a - np.sin(a)) / (safe * a)
    )
    return first[:, None, None], second[:, None, None], third[:, None, None]


def rotation(v: Array) -> Array:
    """Rotation matrices of rotation vectors."""
    first, second, _ = _shares(v)
    S = skew(v)
    return np.asarray(np.eye(3) + first * S + second * (S @ S))


def spin_of(v: Array) -> Array:
    """What a change of the rotation vector is as a turn about the fixed axes."""
    _, second, third = _shares(v)
    S = skew(v)
    return np.asarray(np.eye(3) + second * S + third * (S @ S))


def vector_of(R: Array) -> Array:
    """Rotation vectors of rotations by less than a quarter turn."""
    axial = 0.5 * np.stack(
        [R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], axis=1
    )
    s = (axial * axial).sum(axis=1)
    near = np.abs(s) < SMALL
    sine = np.sqrt(np.where(near, 0.25, s))
    series = 1 + s / 6 + 3 * s**2 / 40 + 15 * s**3 / 336 + 105 * s**4 / 3456
    return axial * np.where(near, series, np.arcsin(sine) / sine)[:, None]


# --- the cells -----------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class FiniteSpaceBeam(Carried):
    """Beams in space: lengthening and turns of both ends against the cell's frame.

    Attributes
    ----------
    span : array (n, 3)
        From end to end at rest.
    axes : array (n, 3, 3)
        Axes at rest, as rows.
    points : int
        Where section forces are shown: 1, the middle, or 2, the ends.
    """

    span: FloatArray
    axes: FloatArray

    def _measured(self, u: Array) -> tuple[Array, Array]:
        now = self.span + u[:, 6:9] - u[:, :3]
        rest = np.linalg.norm(self.span, axis=1)
        # l - L without the rounding of their difference
        length = np.sqrt((now * now).sum(axis=1))
        if (np.abs(length) == 0.0).any():
            raise FieldError("kernel.plasticity.beam-shrunk-nothing")
        stretch = ((now - self.span) * (now + self.span)).sum(axis=1) / (length + rest)
        turns = [rotation(u[:, k : k + 3]) for k in (3, 9)]
        seconds = [np.einsum("cij,cj->ci", R, self.axes[:, 1]) for R in turns]
        mean = 0.5 * (seconds[0] + seconds[1])
        x = now / length[:, None]
        z = np.cross(x, mean)
        z = z / np.sqrt((z * z).sum(axis=1))[:, None]
        frame = np.stack([x, np.cross(z, x), z], axis=1)
        own = [frame @ R @ np.swapaxes(self.axes, 1, 2) for R in turns]
        small = [vector_of(R) for R in own]
        d = np.concatenate([stretch[:, None], *small], axis=1)
        return d, self._variations(u, frame, length, seconds, mean, small)

    def _variations(
        self, u: Array, frame: Array, length: Array, seconds: list[Array], mean: Array,
        small: list[Array],
    ) -> Array:  # fmt: skip
        n = len(u)
        T = on_diagonal(frame, 4)
        for k in (3, 9):
            T[:, k : k + 3, k : k + 3] = frame @ spin_of(u[:, k : k + 3])
        q = np.einsum("cij,cj->ci", frame, mean)
        G = np.zeros((n, 3, 12), dtype=frame.dtype)
        slant = q[:, 0] / q[:, 1]
        G[:, 0, 2], G[:, 0, 8] = slant / length, -slant / length
        for k, second in zip((3, 9), seconds, strict=True):
            own = np.einsum("cij,cj->ci", frame, second)
            G[:, 0, k], G[:, 0, k + 1] = own[:, 1] / (2 * q[:, 1]), -own[:, 0] / (2 * q[:, 1])
        G[:, 1, 2], G[:, 1, 8] = 1 / length, -1 / length
        G[:, 2, 1], G[:, 2, 7] = -1 / length, 1 / length
        B = np.zeros((n, 7, 12), dtype=frame.dtype)
        B[:, 0, 0], B[:, 0, 6] = -1.0, 1.0
        for row, k, v in zip((1, 4), (3, 9), small, strict=True):
            spin = -G
            spin[:, :, k : k + 3] = spin[:, :, k : k + 3] + np.eye(3)
            B[:, row : row + 3] = np.linalg.solve(spin_of(v), spin)
        return B @ T

    def shown(self, u: FloatArray) -> FloatArray:
        """Section forces in the axes of the present frame."""
        inner, L = self._inner(self.small(u)), np.linalg.norm(self.span, axis=1)
        N, first, second = inner[:, 0], inner[:, 1:4], inner[:, 4:7]
        both = (first + second) / L[:, None]
        forces = np.stack([N, -both[:, 2], both[:, 1]], axis=1)
        ends = [np.concatenate([forces, m], axis=1) for m in (-first, second)]
        found = np.stack(ends, axis=-1)
        return found.mean(axis=-1, keepdims=True) if self.points == 1 else found

    def _stretched(self, given: FloatArray) -> FloatArray:
        first, second = -given[:, 3:6, 0], given[:, 3:6, -1]
        if self.points == 1:
            L = np.linalg.norm(self.span, axis=1)
            half = 0.5 * L[:, None] * given[:, (1, 2), 0] * np.array([-1.0, 1.0])
            for m in (first, second):
                m[:, 2] += half[:, 0]
                m[:, 1] += half[:, 1]
        return np.concatenate([given[:, 0].mean(axis=1)[:, None], first, second], axis=1)


def finite_space_beam(zone: Zone, material: CellField, points: int) -> FiniteSpaceBeam:
    """A zone of beams without stress."""
    frame, span, inner = _at_rest(zone, material, _CARRIED)
    return FiniteSpaceBeam(zone, inner, np.zeros((len(span), 7)), points, span, frame.axes)
