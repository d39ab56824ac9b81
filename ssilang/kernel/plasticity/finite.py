"""Elastic bodies in finite displacements: continuous elements, bars (total Lagrangian), beams.

Continuous elements: `E = (F^T F - 1)/2`, `S = S0 + D E` (second Piola-Kirchhoff), dead loads. Bars
turn with their ends: force `N = N0 + ES (l/L - 1)` along the present direction. Stresses given and
shown are Cauchy's (of bars: the present force).
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.beams.beam_frame import beam_frame
from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.catalog import family_name
from ssilang.kernel.elements.families import family_of, integration_weights, moduli_of
from ssilang.kernel.elements.solids.kinematics import as_components, as_tensor, harmonic
from ssilang.kernel.elements.solids.solid import REVOLUTION, kinematics, radius, zone_geometry
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.plasticity.finite_space_beam import (
    CARRIED,
    FiniteBeam,
    finite_beam,
    finite_space_beam,
    is_plane_beam,
    is_space_beam,
)
from ssilang.kernel.plasticity.large.carried import Array, Carried, CarriedShell, seen_and_held
from ssilang.kernel.plasticity.large.finite_plate import finite_plate, is_facet_shell


@dataclass(frozen=True, eq=False)
class FinitePlaneShell(CarriedShell, FiniteBeam):
    """Strips that are carried by their chords like beams of the plane."""


def finite_plane_shell(zone: Zone, material: CellField, points: int) -> FinitePlaneShell:
    """A zone of shells without stress."""
    turn = beam_frame(zone, zone_field(zone, material)).rotation(zone)
    seen, held = seen_and_held(zone, material, points, np.swapaxes(turn, 1, 2) @ CARRIED)
    chord, start = finite_beam(zone, material, points), np.zeros(seen.shape[:3])
    return FinitePlaneShell(zone, chord.stiffness, start, points, chord.span, seen, held)


class FiniteZone(Protocol):
    """A zone whose forces follow from the displacements of its cells, u (n_cells, n_rows)."""

    @property
    def zone(self) -> Zone:
        """Where it stands."""

    def forces(self, u: FloatArray) -> FloatArray:
        """Internal forces (n_cells, n_rows)."""

    def tangent(self, u: FloatArray) -> FloatArray:
        """Their derivative (n_cells, n_rows, n_rows)."""

    def stored(self, u: FloatArray) -> float:
        """Elastic energy, from the state without displacement on."""

    def shown(self, u: FloatArray) -> FloatArray:
        """Cauchy stresses (n_cells, n_components, n_points)."""

    def stressed(self, given: FloatArray, u: FloatArray) -> "FiniteZone":
        """The zone whose Cauchy stresses at the displacement u are the given ones."""


@dataclass(frozen=True, eq=False)
class FiniteSolid:
    """Continuous elements.

    Attributes
    ----------
    slopes : array (n_cells, n_points, n_rows, 3, 3)
        Gradient of the displacement for one unit of each unknown.
    moduli : array (n_cells, n_points, n_strains, n_strains)
    weights : array (n_cells, n_points)
    initial : array (n_cells, n_points, n_strains)
        Second Piola-Kirchhoff stress without displacement.
    """

    zone: Zone
    slopes: FloatArray
    moduli: FloatArray
    weights: FloatArray
    initial: FloatArray

    def _transformation(self, u: FloatArray) -> FloatArray:
        return np.asarray(np.eye(3) + np.einsum("na,npaij->npij", u, self.slopes))

    def _strain(self, F: FloatArray) -> FloatArray:
        E = 0.5 * (np.swapaxes(F, -1, -2) @ F - np.eye(3))
        count = self.moduli.shape[-1]
        return np.moveaxis(as_components(E, count, True), 1, -1)

    def _stress(self, F: FloatArray) -> FloatArray:
        elastic = np.einsum("npij,npj->npi", self.moduli, self._strain(F))
        return np.asarray(self.initial + elastic)

    def _variations(self, F: FloatArray) -> FloatArray:
        """Strain components (n, p, n_rows, n_strains) for one unit of each unknown."""
        turned = np.einsum("npki,npakj->npaij", F, self.slopes)
        tensors = 0.5 * (turned + np.swapaxes(turned, -1, -2))
        n, p, a = tensors.shape[:3]
        rows = as_components(tensors.reshape(n, p * a, 3, 3), self.moduli.shape[-1], True)
        return np.moveaxis(rows, 1, -1).reshape(n, p, a, -1)

    def forces(self, u: FloatArray) -> FloatArray:
        """Internal forces."""
        F = self._transformation(u)
        S = self._stress(F) * self.weights[..., None]
        return np.asarray(np.einsum("npac,npc->na", self._variations(F), S))

    def tangent(self, u: FloatArray) -> FloatArray:
        """Material and geometric parts."""
        F = self._transformation(u)
        B, S = self._variations(F), self._stress(F)
        weighted = self.moduli * self.weights[..., None, None]
        material = np.einsum("npac,npcd,npbd->nab", B, weighted, B, optimize=True)
        tensor = as_tensor(np.moveaxis(S, -1, 1), False) * self.weights[..., None, None]
        pulled = np.einsum("npaki,npij->npakj", self.slopes, tensor)
        n, a = len(pulled), pulled.shape[2]
        rows = np.moveaxis(pulled, 2, 1).reshape(n, a, -1)
        columns = np.moveaxis(self.slopes, 2, 1).reshape(n, a, -1)
        return np.asarray(material + rows @ np.swapaxes(columns, 1, 2))

    def stored(self, u: FloatArray) -> float:
        """Elastic energy."""
        F = self._transformation(u)
        mean = 0.5 * (self.initial + self._stress(F))
        return float(np.einsum("npc,npc,np->", mean, self._strain(F), self.weights))

    def shown(self, u: FloatArray) -> FloatArray:
        """Cauchy stresses."""
        F = self._transformation(u)
        S = as_tensor(np.moveaxis(self._stress(F), -1, 1), False)
        cauchy = F @ S @ np.swapaxes(F, -1, -2) / np.linalg.det(F)[..., None, None]
        return as_components(cauchy, self.moduli.shape[-1], False)

    def stressed(self, given: FloatArray, u: FloatArray) -> "FiniteSolid":
        """Initial stresses from Cauchy stresses."""
        F = self._transformation(u)
        back = np.linalg.inv(F)
        S = back @ as_tensor(given, False) @ np.swapaxes(back, -1, -2)
        S = S * np.linalg.det(F)[..., None, None]
        flat = np.moveaxis(as_components(S, self.moduli.shape[-1], False), 1, -1)
        elastic = np.einsum("npij,npj->npi", self.moduli, self._strain(F))
        return FiniteSolid(self.zone, self.slopes, self.moduli, self.weights, flat - elastic)


@dataclass(frozen=True, eq=False)
class FiniteBar(Carried):
    """Bars: their lengthening; span (n, d) from end to end at rest."""

    span: FloatArray

    def _measured(self, u: Array) -> tuple[Array, Array]:
        d = self.span.shape[1]
        now = self.span + u[:, d:] - u[:, :d]
        length = np.linalg.norm(now, axis=1)
        if (length == 0.0).any():
            raise FieldError("kernel.plasticity.bar-shrunk-nothing")
        rest, t = np.linalg.norm(self.span, axis=1), now / length[:, None]
        return (length - rest)[:, None], np.concatenate([-t, t], axis=1)[:, None]

    def tangent(self, u: FloatArray) -> FloatArray:
        """Stretching and turning parts."""
        d, B = self._measured(u)
        length, t = np.linalg.norm(self.span, axis=1) + d[:, 0], B[:, 0, self.span.shape[1] :]
        across = np.eye(t.shape[1]) - t[:, :, None] * t[:, None, :]
        k = (self._inner(d)[:, 0] / length)[:, None, None] * across
        return np.asarray(np.swapaxes(B, 1, 2) @ self.stiffness @ B + np.block([[k, -k], [-k, k]]))

    def shown(self, u: FloatArray) -> FloatArray:
        """Present forces."""
        return np.repeat(self._inner(self.small(u))[:, :, None], self.points, axis=2)

    def _stretched(self, given: FloatArray) -> FloatArray:
        return np.asarray(given[:, :1].mean(axis=2))


def finite_zone(zone: Zone, material: CellField) -> FiniteZone:
    """A zone in finite displacements, without stress.

    Raises
    ------
    FieldError
        For an element or a hypothesis that has none.
    """
    weights = integration_weights(zone, "STRESSES", material)
    if is_plane_beam(zone):
        return finite_beam(zone, material, weights.shape[1])
    if is_space_beam(zone):
        return finite_space_beam(zone, material, weights.shape[1])
    plane = zone.mode in (Mode.PLANE_STRAIN, Mode.PLANE_STRESS)
    if plane and family_name(zone) == "meridian":
        return finite_plane_shell(zone, material, weights.shape[1])
    if is_facet_shell(zone):
        return finite_plate(zone, material, weights.shape[1])
    moduli = moduli_of(zone, zone_field(zone, material), "STRESSES")
    if zone.element == "BARR":
        d = len(set(family_of(zone).layout(zone).unknowns))
        ends = zone.cells.coordinates[..., :d]
        span = ends[:, 1] - ends[:, 0]
        stiffness = moduli[:, 0, 0, 0] / np.linalg.norm(span, axis=1)
        start = np.zeros((len(ends), 1))
        return FiniteBar(zone, stiffness[:, None, None], start, weights.shape[1], span)
    turning = zone.mode is Mode.FOURIER or (zone.mode in REVOLUTION and harmonic(zone))
    if not is_solid(zone) or turning:
        raise FieldError("kernel.plasticity.finite-displacements-not-built", element=zone.element)
    count = moduli.shape[-1]
    D = np.broadcast_to(moduli, (*weights.shape, count, count)).copy()
    return FiniteSolid(zone, _slopes(zone), D, weights, np.zeros((*weights.shape, count)))


def _slopes(zone: Zone) -> FloatArray:
    geometry = zone_geometry(zone, "STRESSES", slice(None))
    n, p, d, m = geometry.gradients.shape
    nu = len(kinematics(zone).unknowns)
    out = np.zeros((n, p, m, nu, 3, 3))
    for k in range(nu):
        out[:, :, :, k, k, :d] = np.swapaxes(geometry.gradients, 2, 3)
    if zone.mode is Mode.AXISYMMETRIC:
        r = radius(zone, geometry.shapes, slice(None))
        out[:, :, :, 0, 2, 2] = geometry.shapes / r[..., None]
    return out.reshape(n, p, m * nu, 3, 3)
