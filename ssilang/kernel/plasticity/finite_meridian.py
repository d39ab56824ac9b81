"""Thin shells COQ2 of the plane in finite displacements: chords that turn, small strains."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.beams.beam_frame import beam_frame
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.families import _moduli, family_of
from ssilang.kernel.elements.family import per_cell
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.plasticity.finite_beam import CARRIED, FiniteBeam, finite_beam


def is_plane_shell(zone: Zone) -> bool:
    """Whether a zone is a strip of shells in plane stress or strain."""
    plane = zone.mode in (Mode.PLANE_STRAIN, Mode.PLANE_STRESS)
    return plane and ELEMENTS[zone.element].family == "meridian"


@dataclass(frozen=True, eq=False)
class FinitePlaneShell:
    """Strips that are carried by their chords like beams of the plane.

    Attributes
    ----------
    chord : FiniteBeam
    seen : array (n, n_stresses, n_points, 3)
        Stresses for one unit of lengthening and of the turns of both ends.
    held : array (n, 3, n_stresses, n_points)
        Forces of the chord that stresses make.
    initial : array (n, n_stresses, n_points)
        Stresses without displacement.
    """

    zone: Zone
    chord: FiniteBeam
    seen: FloatArray
    held: FloatArray
    initial: FloatArray

    def forces(self, u: FloatArray) -> FloatArray:
        """Internal forces."""
        return self.chord.forces(u)

    def tangent(self, u: FloatArray) -> FloatArray:
        """Their derivative."""
        return self.chord.tangent(u)

    def stored(self, u: FloatArray) -> float:
        """Elastic energy."""
        return self.chord.stored(u)

    def shown(self, u: FloatArray) -> FloatArray:
        """Membrane forces and moments per length, in the axes of the present chord."""
        return np.asarray(self.initial + np.einsum("cspi,ci->csp", self.seen, self.chord.small(u)))

    def stressed(self, given: FloatArray, u: FloatArray) -> FinitePlaneShell:
        """Initial stresses from present ones."""
        start = given - np.einsum("cspi,ci->csp", self.seen, self.chord.small(u))
        pulled = np.einsum("cisp,csp->ci", self.held, start)
        return replace(self, chord=replace(self.chord, initial=pulled), initial=start)


def finite_plane_shell(zone: Zone, material: CellField, points: int) -> FinitePlaneShell:
    """A zone of shells without stress."""
    parameters, family = zone_field(zone, material), family_of(zone)
    whole = slice(0, len(zone.cells))
    operator = family.strain_operator(zone, parameters, "STRESSES", whole)
    carried = np.swapaxes(beam_frame(zone, parameters).rotation(zone), 1, 2) @ CARRIED
    strains = np.einsum("cspm,cmi->cspi", operator.matrix, carried)
    D = per_cell(_moduli(zone, parameters, "STRESSES"), whole)
    D = np.broadcast_to(D, (len(strains), points, *D.shape[2:]))
    seen = np.einsum("cpst,ctpi->cspi", D, strains)
    held = np.moveaxis(strains * operator.weights[:, None, :, None], 3, 1)
    return FinitePlaneShell(
        zone, finite_beam(zone, material, points), seen, held, np.zeros(seen.shape[:3])
    )
