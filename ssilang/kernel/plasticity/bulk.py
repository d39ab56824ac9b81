"""All plastic zones of a problem together: state, forces, tangent, results."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.elements.catalog import SHELLS, family_name
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.family import element_matrices
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.assembly import Numbering, assemble_terms, block_indices
from ssilang.kernel.matrices.matrix import ElementMatrices
from ssilang.kernel.plasticity.points import Fields, PlasticPoints, PointState
from ssilang.kernel.plasticity.solving.blocks import ZonePass
from ssilang.kernel.plasticity.zone_points import plastic_points, zone_pass

if TYPE_CHECKING:
    from ssilang.kernel.plasticity.solving.positive import Pattern

FreeStrain = Callable[[float], FloatArray]
"""Strain without stress (n_cells, n_strains, n_points) of a zone at a time."""


State = tuple[PointState, ...]


ROUNDING = 1e-6
"""Slip beyond a curve's last strain, over that strain, which is rounding."""
MANY_POINTS = 2_000
"""Points from which a zone is worth the loading of compiled code for a few steps."""


@dataclass(frozen=True, eq=False)
class Answer:
    """What a step of displacement makes of the plastic zones.

    Attributes
    ----------
    force : array (n,)
        Internal forces at the end of the step.
    make_tangent : callable
        Makes `tangent`, csr (n, n), if it is asked for.
    work : float
        Work of the stresses over the step (average of both ends).
    rate : array (n,) or None
        Change of the forces with the time alone, where they have one.
    beyond : tuple of array (n_cells,) or None
        How far cells of each zone are beyond yielding at most, where compiled passes tell.
    make_terms : callable or None
        Makes `terms`, if they are asked for.
    """

    force: FloatArray
    make_tangent: Callable[[], sp.csr_array]
    state: State
    work: float
    rate: FloatArray | None = None
    beyond: tuple[FloatArray | None, ...] = ()
    make_terms: Callable[[], FloatArray] | None = None

    @cached_property
    def terms(self) -> FloatArray:
        """Terms (nnz,) of the tangent in the pattern of the zones."""
        assert self.make_terms is not None
        return self.make_terms()

    @cached_property
    def tangent(self) -> sp.csr_array:
        """Derivative of the forces by the step, csr (n, n)."""
        return self.make_tangent()


@dataclass(frozen=True, eq=False)
class _OfZone:
    """A zone's state after a step, the work over it, and what adds its tangent to terms (nnz,).

    Where the zone is passed by compiled code, `beyond` (n_cells,) as `pass_over` has it.
    """

    state: PointState
    work: float
    add_tangent: Callable[[FloatArray], None]
    beyond: FloatArray | None = None


@dataclass(frozen=True, eq=False)
class Bulk:
    """Plastic zones on the numbering of a problem.

    Attributes
    ----------
    places : tuple of array (n_cells, n_rows)
        Unknown of each row of each element vector.
    size : int
        Number of unknowns.
    free : dict
        Strains without stress in time, by position of the zone.
    least : int
        Points from which a zone is worth the loading of compiled code.
    """

    zones: tuple[PlasticPoints, ...]
    places: tuple[NDArray[np.int32], ...]
    size: int
    free: dict[int, FreeStrain] = field(default_factory=dict)
    least: int = field(default=MANY_POINTS, kw_only=True)

    @property
    def symmetric(self) -> bool:
        """Whether all tangents are."""
        return all(z.law.symmetric for z in self.zones)

    @property
    def words(self) -> str:
        """The laws, for messages."""
        return ", ".join(dict.fromkeys(z.zone.behaviour[-1] for z in self.zones))

    @property
    def searched(self) -> bool:
        """Whether Newton's steps are cut where what is out of balance would grow."""
        return True

    def unloaded(self) -> State:
        """The state of virgin material."""
        found = []
        for zone in self.zones:
            nothing, width = np.zeros((zone.count, zone.width)), len(zone.law.variables)
            found.append(PointState(nothing, nothing, nothing, np.zeros((zone.count, width))))
        return tuple(found)

    def entered(self, before: Bulk, state: State, time: float) -> State:
        """A state of the same zones `before` they had these parameters: elastic strains stay."""
        made = []
        for i, (own, old, known) in enumerate(zip(self.zones, before.zones, state, strict=True)):
            if i in before.free:
                known = replace(known, free=own.spread(before.free[i](time)))
            if own is not old:
                change = (own.parameters.moduli - old.parameters.moduli) @ old.parameters.compliance
                more = np.einsum("mij,mj->mi", change, known.stress)
                known = replace(known, stress=known.stress + more)
            made.append(known)
        return tuple(made)

    def respond(self, state: State, du: FloatArray, time: float, whole: bool = False) -> Answer:
        """Forces and tangent after a step `du` (n,) of displacement that ends at a time.

        Where the tangent will be asked for, one pass finds the `whole`.
        """
        force = np.zeros(self.size)
        found = [self._respond(i, old, du, time, force, whole) for i, old in enumerate(state)]
        return self._gathered(force, found)

    def _gathered(self, force: FloatArray, found: list[_OfZone]) -> Answer:
        """The answer of zones, whose forces are `force` (n,)."""

        def terms() -> FloatArray:
            data = self.terms.blank()
            for one in found:
                one.add_tangent(data)
            return data

        def tangent() -> sp.csr_array:
            return self.terms.matrix(answer.terms)

        states, work = tuple(f.state for f in found), sum(f.work for f in found)
        beyond = tuple(f.beyond for f in found)
        answer = Answer(force, tangent, states, work, beyond=beyond, make_terms=terms)
        return answer

    def predicted(self, state: State, time: float) -> Answer | None:
        """The elastic answer to the strains without stress of a step, None where there are none.

        Newton's method that set out from what they make of bodies that stay would meet the flow of
        bodies that only expand. None beside sections of fibres, too: no one law is theirs.
        """
        if any("SECTION" in zone.zone.behaviour for zone in self.zones):
            return None
        force, found, strained = self.force(state), list[_OfZone](), False
        for i, zone in enumerate(self.zones):
            D, h = zone.parameters.moduli, np.array(zone.held, dtype=int)
            D = D - D[:, :, h] @ np.linalg.solve(D[:, h[:, None], h], D[:, h])
            found.append(_OfZone(state[i], 0.0, self._adding(i, D)))
            if i in self.free:
                freed = zone.spread(self.free[i](time)) - state[i].free
                pressed = zone.forces(np.einsum("mij,mj->mi", D, freed)).ravel()
                force -= np.bincount(self.places[i].ravel(), pressed, self.size)
                strained = strained or bool(freed.any())
        return self._gathered(force, found) if strained else None

    def _adding(self, i: int, D: FloatArray) -> Callable[[FloatArray], None]:
        """Adds the stiffness of a zone to terms, where its points have tangents (m, 6, 6)."""
        return lambda data: self.terms.add(data, i, self.zones[i].stiffness(D))

    def _respond(
        self, i: int, old: PointState, du: FloatArray, time: float, force: FloatArray, whole: bool
    ) -> _OfZone:
        """A zone's answer; its forces are added to `force` (n,)."""
        free, freed = old.free, np.zeros((0, 6))
        if i in self.free:
            free = self.zones[i].spread(self.free[i](time))
            freed = free - old.free
        compiled = self.passes[i]
        if compiled is not None:
            D = compiled.blank_tangents(whole)
            new = compiled.respond(old, du, freed, force, D)

            def add_tangent(data: FloatArray) -> None:
                if not whole:
                    compiled.add_tangent(old, du, freed, self.terms.slots[i], data)
                else:
                    compiled.add_stiffness(D, self.terms.slots[i], data)

            state = PointState(new.stress, new.plastic, free, new.variables, time)
            return _OfZone(state, new.work, add_tangent, new.beyond)
        zone, places = self.zones[i], self.places[i]
        strain = zone.strains(du[places])
        strain = strain - freed if len(freed) else strain
        found, strained = zone.respond(old.stress, strain, old.variables, time - old.time)
        force += np.bincount(places.ravel(), zone.forces(found.stress).ravel(), self.size)
        elastic = found.elastic_strain(zone.parameters, old.stress)
        plastic = old.plastic + strained - elastic
        density = np.einsum("mi,mi->m", 0.5 * (old.stress + found.stress), zone.paired(strain))
        return _OfZone(
            PointState(found.stress, plastic, free, found.variables, time),
            float(density @ zone.weights.ravel()),
            self._adding(i, found.tangent),
        )

    @cached_property
    def passes(self) -> tuple[ZonePass | None, ...]:
        """Compiled passes of the zones that have them."""
        return tuple(
            _pass_of(*each, self.least) for each in zip(self.zones, self.places, strict=True)
        )

    @cached_property
    def terms(self) -> Pattern:
        """Where the terms of the tangent stand."""
        from ssilang.kernel.plasticity.solving.positive import Pattern

        sizes = [p.shape[1] for p in self.places]
        ones = [np.ones((len(p), k, k)) for p, k in zip(self.places, sizes, strict=True)]
        return Pattern.of(self._assembled(ones), self.places)

    def _assembled(self, values: list[FloatArray]) -> sp.csr_array:
        return assemble_terms(list(self.places), values, self.size)

    def force(self, state: State) -> FloatArray:
        """Internal forces (n,) of a state."""
        total = np.zeros(self.size)
        for zone, places, old in zip(self.zones, self.places, state, strict=True):
            total += np.bincount(places.ravel(), zone.forces(old.stress).ravel(), self.size)
        return total

    def stored(self, state: State) -> float:
        """Elastic energy."""
        pairs = zip(self.passes, self.zones, state, strict=True)
        return sum((z if over is None else over).stored(s) for over, z, s in pairs)

    def points_of(self, state: State) -> list[tuple[PlasticPoints, PointState]]:
        """The zones that yield, with what they have of a state."""
        return list(zip(self.zones, state, strict=True))

    def beyond_curves(self, begun: State, state: State) -> dict[str, float]:
        """Share of the points of each law that went beyond the last point of its curve."""
        seen: dict[str, list[NDArray[np.bool_]]] = {}
        pairs = zip(self.points_of(begun), self.points_of(state), strict=True)
        for (zone, first), (_, last) in pairs:
            if zone.law.slid is None:
                continue
            before, after = (
                zone.law.slid(zone.parameters, s.stress, s.plastic, s.variables)
                for s in (first, last)
            )
            beyond: NDArray[np.bool_] = np.any(np.abs(after - before) > ROUNDING, axis=1)
            seen.setdefault(zone.zone.behaviour[-1], []).append(beyond)
        shares = {law: float(np.concatenate(found).mean()) for law, found in seen.items()}
        return {law: share for law, share in shares.items() if share > 0.0}

    def stresses(self, state: State) -> list[CellFieldBlock]:
        """Stresses of the zones (forces in bars and beams)."""
        return [z.stress_block(s) for z, s in self.points_of(state)]

    def variables(self, state: State) -> list[CellFieldBlock]:
        """Internal variables of the zones."""
        return [z.variable_block(s) for z, s in self.points_of(state)]

    def plastic_strains(self, state: State) -> list[CellFieldBlock]:
        """Plastic strains of the zones that have them."""
        blocks = (z.plastic_block(s) for z, s in self.points_of(state))
        return [b for b in blocks if b is not None]

    def pushed(self, state: State) -> FloatArray:
        """Loads (n,) among the forces: none."""
        return np.zeros(self.size)


def _pass_of(points: PlasticPoints, places: NDArray[np.int32], least: int) -> ZonePass | None:
    law = points.law
    plain = type(points) is PlasticPoints and (law.cone is not None or law.parts is not None)
    if not plain or points.count < least:
        return None

    return zone_pass(points, places)


def bulk_of(zones: tuple[Zone, ...], characteristics: CellField, numbering: Numbering) -> Bulk:
    """Plastic zones placed on a numbering."""
    points = tuple(plastic_points(z, characteristics) for z in zones)
    return Bulk(points, tuple(zone_places(z, numbering) for z in zones), numbering.size)


def zone_places(zone: Zone, numbering: Numbering) -> NDArray[np.int32]:
    """Unknown (n_cells, n_rows) of each row of each element vector of a zone."""
    return block_indices(without_stiffness(zone), numbering).astype(np.int32)


def stiffness_beside(zone: Zone, characteristics: CellField) -> ElementMatrices:
    """What of a plastic zone's stiffness is not its law's: that about the normals of shells."""
    blank, family = without_stiffness(zone), family_of(zone)
    if family_name(zone) not in SHELLS:
        return blank
    given = zone_field(zone, characteristics)
    moduli = family.moduli(zone, given, "RIGIDITE")
    return replace(blank, values=family.held_about_normals(zone, blank.values, moduli, given))


def without_stiffness(zone: Zone) -> ElementMatrices:
    """A block of zeros that has the unknowns of a zone."""
    layout = family_of(zone).layout(zone)
    k = len(layout.unknowns)
    zeros = np.zeros((len(layout.raw_nodes), k, k))
    return element_matrices(zone, layout, zeros, "RIGIDITE", keep_zone=False)


# --- fields ----------------------------------------------------------------------------------


def state_from_fields(bulk: Bulk, given: Fields) -> State | None:
    """The state that an earlier calculation left; None if they say nothing of the zones."""
    pairs = [
        zone.restored(blank, given) for zone, blank in zip(bulk.zones, bulk.unloaded(), strict=True)
    ]
    return tuple(state for state, _ in pairs) if any(known for _, known in pairs) else None
