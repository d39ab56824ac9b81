"""Bodies in finite displacements together, and plastic continuous elements among them.

Large strains are those of `finite_flow`. What stands here takes the law of small strains between
Green-Lagrange strains and second Piola-Kirchhoff stresses ('LAGRANGIEN' 'TOTAL'; Bathe, Finite
Element Procedures, section 6.6.3: large displacements, small strains). At each state the zone is an
elastic one with the consistent tangent as moduli and an initial stress that gives the law's: forces
and tangent are then those of `FiniteSolid`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.families import family_of, integration_weights
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.assembly import Numbering
from ssilang.kernel.plasticity.bulk import Answer, Bulk, State, zone_places
from ssilang.kernel.plasticity.finite import FiniteSolid, FiniteZone, finite_zone
from ssilang.kernel.plasticity.points import Fields, PlasticPoints, PointState
from ssilang.kernel.plasticity.zone_points import plastic_points


class InsideOutError(Exception):
    """A displacement under trial turns matter inside out."""


@dataclass(frozen=True, eq=False)
class YieldingSolid:
    """A zone: its kinematics in finite displacements, its law at the points."""

    solid: FiniteSolid
    points: PlasticPoints

    def respond(
        self, before: FloatArray, u: FloatArray, last: PointState, time: float
    ) -> tuple[PointState, FiniteSolid]:
        """The state after a step between displacements (n_cells, n_rows), the zone there."""
        points = self.points
        strain = self.strains(u) - self.strains(before)
        found, whole = points.respond(last.stress, strain, last.variables, time - last.time)
        elastic = found.elastic_strain(points.parameters, last.stress)
        plastic = last.plastic + whole - elastic
        state = PointState(found.stress, plastic, last.free, found.variables, time)
        return state, self.at(u, found.stress, found.tangent)

    def standing(self, u: FloatArray, last: PointState) -> FiniteSolid:
        """The zone where its points have that state, with the moduli at rest."""
        return self.at(u, last.stress, None)

    def shown(self, u: FloatArray, last: PointState) -> FloatArray:
        """Cauchy stresses (n_cells, n_components, n_points)."""
        return self.standing(u, last).shown(u)

    def taken(self, given: FloatArray, u: FloatArray, last: PointState) -> FloatArray:
        """The law's stresses (m, 6) that are shown as the given ones at u."""
        solid = self.solid.stressed(given, u)
        return self.points.spread(np.moveaxis(solid._stress(solid._transformation(u)), -1, 1))

    def stored(self, u: FloatArray, last: PointState) -> float:
        """Elastic energy."""
        return self.points.stored(last)

    def strains(self, u: FloatArray) -> FloatArray:
        """Green-Lagrange strains (m, 6) of the displacements (n_cells, n_rows)."""
        own = self.solid._strain(self.solid._transformation(u))
        return self.points.spread(np.moveaxis(own, -1, 1))

    def at(self, u: FloatArray, stress: FloatArray, tangent: FloatArray | None) -> FiniteSolid:
        """The elastic zone with these stresses (m, 6) and this tangent (m, 6, 6) at u."""
        D = self.solid.moduli
        if tangent is not None:
            chosen = np.array(self.points.components)
            D = tangent[:, chosen[:, None], chosen[None, :]].reshape(D.shape)
        own = self.solid._strain(self.solid._transformation(u))
        wanted = np.moveaxis(self.points.gathered(stress), 1, -1)
        return replace(self.solid, moduli=D, initial=wanted - np.einsum("npij,npj->npi", D, own))


@dataclass(frozen=True, eq=False)
class FiniteBulk(Bulk):
    """Bodies in finite displacements; their state: u (n,), then the points of those that yield.

    Attributes
    ----------
    finite : tuple of FiniteZone
        Elastic bodies, at `places`.
    at : tuple of array (n_cells, n_rows)
        Unknown of each row of each element vector of these.
    """

    finite: tuple[FiniteZone, ...] = ()
    yielding: tuple[YieldingSolid, ...] = ()
    at: tuple[NDArray[np.int32], ...] = ()

    @property
    def words(self) -> str:
        """What is said of them."""
        return "finite displacements"

    @property
    def searched(self) -> bool:
        """Where all is elastic Newton's steps are whole."""
        return bool(self.yielding)

    def points_of(self, state: State) -> list[tuple[PlasticPoints, PointState]]:
        """The zones that yield, with what they have of a state."""
        return [(z.points, s) for z, s in zip(self.yielding, _parts(state)[1], strict=True)]

    def respond(self, state: State, du: FloatArray, time: float, whole: bool = False) -> Answer:
        """Forces and tangent after a step `du` (n,)."""
        before, old = _parts(state)
        u = before + du
        force = self._elastic(u)
        tangents = [z.tangent(u[p]) for z, p in zip(self.finite, self.places, strict=True)]
        after = []
        for zone, places, last in zip(self.yielding, self.at, old, strict=True):
            try:
                reached, now = zone.respond(before[places], u[places], last, time)
                moved = now.forces(u[places]).ravel()
            except InsideOutError:  # no force balances anything: the step is cut
                reached, now = last, zone.standing(before[places], last)
                moved = np.full(places.size, np.nan)
            after.append(reached)
            force += np.bincount(places.ravel(), moved, self.size)
            tangents.append(now.tangent((u if np.isfinite(moved).all() else before)[places]))
        whole_answer = replace(self, places=(*self.places, *self.at))
        work = 0.5 * float((self.force(state) + force) @ du)
        return Answer(force, lambda: whole_answer._assembled(tangents), _state(u, after), work)

    def force(self, state: State) -> FloatArray:
        """Internal forces (n,) of a state."""
        u, points = _parts(state)
        total = self._elastic(u)
        for zone, places, last in zip(self.yielding, self.at, points, strict=True):
            now = zone.standing(u[places], last)
            total += np.bincount(places.ravel(), now.forces(u[places]).ravel(), self.size)
        return total

    def _elastic(self, u: FloatArray) -> FloatArray:
        """Internal forces (n,) of the elastic bodies."""
        total = np.zeros(self.size)
        for zone, places in zip(self.finite, self.places, strict=True):
            total += np.bincount(places.ravel(), zone.forces(u[places]).ravel(), self.size)
        return total

    def stored(self, state: State) -> float:
        """Elastic energy."""
        u, points = _parts(state)
        elastic = sum(z.stored(u[p]) for z, p in zip(self.finite, self.places, strict=True))
        three = zip(self.yielding, self.at, points, strict=True)
        return elastic + sum(z.stored(u[p], last) for z, p, last in three)

    def stresses(self, state: State) -> list[CellFieldBlock]:
        """Cauchy stresses."""
        u, points = _parts(state)
        pairs = zip(self.finite, self.places, strict=True)
        shown = [(z.zone, z.shown(u[p])) for z, p in pairs]
        three = zip(self.yielding, self.at, points, strict=True)
        shown += [(z.points.zone, z.shown(u[p], last)) for z, p, last in three]
        return [cell_block(z, family_of(z).stress_names(z), values) for z, values in shown]


def _state(u: FloatArray, points: Sequence[PointState]) -> State:
    return cast(State, (u.copy(), *points))


def _parts(state: State) -> tuple[FloatArray, tuple[PointState, ...]]:
    u, *points = cast("tuple[Any, ...]", state)
    return u, tuple(points)


def finite_bulk(
    elastic: Sequence[Zone],
    plastic: Sequence[Zone],
    material: CellField,
    numbering: Numbering,
    u: FloatArray,
    given: Fields,
    time: float,
    made_of: Callable[[FiniteSolid, PlasticPoints], YieldingSolid],
) -> tuple[FiniteBulk, State]:
    """Zones placed on a numbering, and their state at the displacement u (n,).

    `given` has Cauchy stresses at u. `made_of` makes a zone that yields of its kinematics and its
    law: `YieldingSolid`, or one of `finite_flow`.

    Raises
    ------
    FieldError
        For elements and hypotheses that have none; where zones yield for elements other than
        continuous ones, and creep.
    """
    bodies, zones, states = [], [], []
    places = [zone_places(z, numbering) for z in elastic]
    at = [zone_places(z, numbering) for z in plastic]
    for zone, own in zip(elastic, places, strict=True):
        finite = finite_zone(zone, material)
        if given[0] is not None:
            values = zone_field(zone, given[0]).matrix(
                family_of(zone).stress_names(zone), "STRESSES"
            )
            count = integration_weights(zone, "STRESSES", material).shape[1]
            finite = finite.stressed(np.broadcast_to(values, (*values.shape[:2], count)), u[own])
        bodies.append(finite)
    for zone, own in zip(plastic, at, strict=True):
        solid, points = finite_zone(zone, material), plastic_points(zone, material)
        if not isinstance(solid, FiniteSolid) or points.law.timed:
            raise FieldError("kernel.plasticity.finite-yielding-not-built", element=zone.element)
        made = made_of(solid, points)
        zones.append(made)
        states.append(_start(made, u[own], given, time))
    whole = (tuple(bodies), tuple(zones), tuple(at))
    return FiniteBulk((), tuple(places), numbering.size, {}, *whole), _state(u, states)


def _start(made: YieldingSolid, u: FloatArray, given: Fields, time: float) -> PointState:
    """The state of one zone's points: what fields hold, else virgin."""
    points = made.points
    zero = np.zeros((points.count, 6))
    blank = PointState(zero, zero, zero, np.zeros((points.count, len(points.law.variables))), time)
    state, _ = points.restored(blank, (None, *given[1:]))
    names = family_of(points.zone).stress_names(points.zone)
    values = zone_field(points.zone, given[0]).matrix(names, "STRESSES")
    return replace(state, stress=made.taken(values, u, state))
