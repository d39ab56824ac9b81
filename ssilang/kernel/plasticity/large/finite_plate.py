"""Flat triangular shells in finite displacements: frames that turn with the cells, small strains.

The first axis of a cell's present frame is its first side, the third its normal; displacements and
rotations against that frame go through the stiffness at rest (Rankin and Brogan 1986; Nour-Omid and
Rankin 1991). The rotations RX RY RZ of a node are the components of one rotation vector, from the
mesh at rest, as those of beams in space.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.catalog import family_name
from ssilang.kernel.elements.families import stiffness
from ssilang.kernel.elements.shells.flat_shell import flat_frames
from ssilang.kernel.elements.solids.kinematics import on_diagonal
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.plasticity.finite_space_beam import rotation, skew, spin_of, vector_of
from ssilang.kernel.plasticity.large.carried import Array, CarriedShell, seen_and_held


def is_facet_shell(zone: Zone) -> bool:
    """Whether a zone is one of flat triangular shells (DKT, COQ3)."""
    return family_name(zone) == "plate" and zone.mode is Mode.THREE_DIMENSIONAL


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
    T = on_diagonal(axes, 6)
    back = np.swapaxes(T, 1, 2)
    seen, held = seen_and_held(zone, material, points, back)
    local = T @ stiffness(zone, material).values @ back
    ends = zone.cells.coordinates
    start = np.zeros(seen.shape[:3])
    return FinitePlate(zone, local, start, points, seen, held, ends, axes)
