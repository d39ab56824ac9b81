"""Cells in finite displacements that a frame of theirs carries: strains against it are small.

What is left of the displacements and turns against the frame meets a constant stiffness.

Flat triangular shells in finite displacements: frames that turn with the cells, small strains.

The first axis of a cell's present frame is its first side, the third its normal; displacements and
rotations against that frame go through the stiffness at rest (Rankin and Brogan 1986; Nour-Omid and
Rankin 1991). The rotations RX RY RZ of a node are the components of one rotation vector, from the
mesh at rest, as those of beams in space.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.families import family_of, moduli_of, stiffness
from ssilang.kernel.elements.family import per_cell
from ssilang.kernel.elements.shells.flat_shell import flat_frames
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.plasticity.finite_space_beam import rotation, skew, spin_of, vector_of

Array = NDArray[Any]
"""Real, or complex where it is differentiated by a step along the imaginary axis."""

_STEP = 1e-30


def derivative(forces: Callable[[Array], Array], u: FloatArray) -> FloatArray:
    """Derivative (n, m, m) of an energy's forces (n, m): steps along the imaginary axis."""
    n, size = u.shape
    K = np.empty((n, size, size))
    for k in range(size):
        moved = u.astype(complex)
        moved[:, k] += 1j * _STEP
        K[:, :, k] = forces(moved).imag / _STEP
    return 0.5 * (K + np.swapaxes(K, 1, 2))


@dataclass(frozen=True, eq=False)
class Carried:
    """Cells of a zone.

    Attributes
    ----------
    stiffness : array (n, k, k)
        Forces over what is left of the displacements.
    initial : array (n, k)
        Forces without displacement; of shells the stresses that make them.
    points : int
        Where a cell's stresses are shown.
    """

    zone: Zone
    stiffness: FloatArray
    initial: FloatArray
    points: int

    def _measured(self, u: Array) -> tuple[Array, Array]:
        """What is left (n, k) of displacements, and (n, k, n_rows) for one of each unknown."""
        raise NotImplementedError

    def _stretched(self, given: FloatArray) -> FloatArray:
        """Forces (n, k) of stresses (n, n_stresses, n_points) as they are shown."""
        raise NotImplementedError

    def _start(self) -> FloatArray:
        """Forces (n, k) without displacement."""
        return self.initial

    def small(self, u: FloatArray) -> FloatArray:
        """Displacements and turns against the present frame (n, k)."""
        return np.asarray(self._measured(u)[0], dtype=float)

    def _inner(self, d: Array) -> Array:
        """Forces (n, k) of what is left of displacements."""
        return np.asarray(self._start() + np.einsum("cij,cj->ci", self.stiffness, d))

    def _balanced(self, u: Array) -> Array:
        d, B = self._measured(u)
        return np.asarray(np.einsum("cij,ci->cj", B, self._inner(d)))

    def forces(self, u: FloatArray) -> FloatArray:
        """Internal forces."""
        return np.asarray(self._balanced(u), dtype=float)

    def tangent(self, u: FloatArray) -> FloatArray:
        """Their derivative, exact to rounding."""
        return derivative(self._balanced, u)

    def stored(self, u: FloatArray) -> float:
        """Elastic energy."""
        d = self.small(u)
        return float(np.einsum("ci,ci->", 0.5 * (self._start() + self._inner(d)), d))

    def stressed(self, given: FloatArray, u: FloatArray) -> Self:
        """The zone whose present stresses are the given ones."""
        elastic = np.einsum("cij,cj->ci", self.stiffness, self.small(u))
        return replace(self, initial=self._stretched(given) - elastic)


@dataclass(frozen=True, eq=False)
class CarriedShell(Carried):
    """Shells: their stresses are not all forces of what is left of the displacements.

    Attributes
    ----------
    seen : array (n, n_stresses, n_points, k)
        Stresses for one unit of what is left of each displacement.
    held : array (n, k, n_stresses, n_points)
        Forces that stresses make.
    """

    seen: FloatArray
    held: FloatArray

    def _start(self) -> FloatArray:
        return np.asarray(np.einsum("cisp,csp->ci", self.held, self.initial))

    def shown(self, u: FloatArray) -> FloatArray:
        """Membrane forces and moments per length, in the axes of the present frame."""
        return np.asarray(self.initial + np.einsum("cspi,ci->csp", self.seen, self.small(u)))

    def stressed(self, given: FloatArray, u: FloatArray) -> Self:
        """The zone whose present stresses are the given ones."""
        return replace(self, initial=self.initial + given - self.shown(u))


def seen_and_held(
    zone: Zone, material: CellField, points: int, carried: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """`CarriedShell.seen` and `held`, by a cell's displacements (n, n_rows, k) for each unit."""
    parameters, whole = zone_field(zone, material), slice(0, len(zone.cells))
    operator = family_of(zone).strain_operator(zone, parameters, "STRESSES", whole)
    strains = np.einsum("cspm,cmi->cspi", operator.matrix, carried)
    D = per_cell(moduli_of(zone, parameters, "STRESSES"), whole)
    D = np.broadcast_to(D, (len(strains), points, *D.shape[2:]))
    seen = np.einsum("cpst,ctpi->cspi", D, strains)
    return seen, np.moveaxis(strains * operator.weights[:, None, :, None], 3, 1)


def is_facet_shell(zone: Zone) -> bool:
    """Whether a zone is one of flat triangular shells (DKT, COQ3)."""
    return ELEMENTS[zone.element].family == "plate" and zone.mode is Mode.THREE_DIMENSIONAL


@dataclass(frozen=True, eq=False)
class FinitePlate(CarriedShell):
    """Flat triangular shells.

    Attributes
    ----------
    ends : array (n, 3, 3)
        Corners at rest.
    axes : array (n, 3, 3)
        Axes at rest, as rows.
    """

    ends: FloatArray
    axes: FloatArray

    def _measured(self, u: Array) -> tuple[Array, Array]:
        moved = u.reshape(len(u), 3, 2, 3)
        now = self.ends + moved[:, :, 0]
        first, second = now[:, 1] - now[:, 0], now[:, 2] - now[:, 0]
        normal = np.cross(first, second)
        x, z = (v / np.sqrt((v * v).sum(axis=1))[:, None] for v in (first, normal))
        frame = np.stack([x, np.cross(z, x), z], axis=1)
        stands = np.einsum("cij,ckj->cki", frame, now - now[:, :1])
        rest = np.einsum("cij,ckj->cki", self.axes, self.ends - self.ends[:, :1])
        turns = [rotation(moved[:, k, 1]) for k in range(3)]
        small = [vector_of(frame @ R @ np.swapaxes(self.axes, 1, 2)) for R in turns]
        d = np.stack([stands - rest, np.stack(small, axis=1)], axis=2).reshape(u.shape)
        return d, self._variations(moved, frame, stands, small)

    def _variations(self, moved: Array, frame: Array, stands: Array, small: list[Array]) -> Array:
        n = len(moved)
        G = np.zeros((n, 3, 18), dtype=frame.dtype)  # turn of the frame, in its own axes
        across, along, high = stands[:, 1, 0], stands[:, 2, 0], stands[:, 2, 1]
        G[:, 2, 1], G[:, 2, 7] = -1 / across, 1 / across
        G[:, 1, 2], G[:, 1, 8] = 1 / across, -1 / across
        G[:, 0, 14] = 1 / high
        G[:, 0, 8] = -along / across / high
        G[:, 0, 2] = (along / across - 1) / high
        B = np.zeros((n, 18, 18), dtype=frame.dtype)
        T = np.zeros((n, 18, 18), dtype=frame.dtype)
        for k in range(3):
            place, turn = slice(6 * k, 6 * k + 3), slice(6 * k + 3, 6 * k + 6)
            T[:, place, place] = frame
            T[:, turn, turn] = frame @ spin_of(moved[:, k, 1])
            B[:, place, place] += np.eye(3)
            B[:, place, 0:3] -= np.eye(3)
            B[:, place] += skew(stands[:, k]) @ G
            spin = -G
            spin[:, :, turn] = spin[:, :, turn] + np.eye(3)
            B[:, turn] = np.linalg.solve(spin_of(small[k]), spin)
        return B @ T


def finite_plate(zone: Zone, material: CellField, points: int) -> FinitePlate:
    """A zone of flat triangular shells without stress."""
    axes, _ = flat_frames(zone)
    T = np.zeros((len(axes), 18, 18))
    for k in range(0, 18, 3):
        T[:, k : k + 3, k : k + 3] = axes
    back = np.swapaxes(T, 1, 2)
    seen, held = seen_and_held(zone, material, points, back)
    local = T @ stiffness(zone, material).values @ back
    ends = zone.cells.nodes.coordinates[zone.cells.connectivity]
    start = np.zeros(seen.shape[:3])
    return FinitePlate(zone, local, start, points, seen, held, ends, axes)
