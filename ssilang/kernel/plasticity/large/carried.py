"""Cells in finite displacements that a frame of theirs carries: strains against it are small.

What is left of the displacements and turns against the frame meets a constant stiffness.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.families import family_of, moduli_of
from ssilang.kernel.elements.family import per_cell
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Zone

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
