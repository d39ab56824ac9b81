"""The plastic points of a zone by its kind, and the compiled passes over them by its law.

Plastic shells and beams by the forces of their sections: DKT, COQ2, POUT, TIMO, TUYA.

A section yields as a whole when its equivalent stress (VMIS) reaches the strength.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError, MaterialError
from ssilang.kernel.elements import catalog, zone_fields
from ssilang.kernel.elements.beams.beam import paired
from ssilang.kernel.elements.beams.beam_frame import beam_frame, kept_rows
from ssilang.kernel.elements.beams.pipe import pipe_parameters
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.tensors import LEVERS, section_form
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.behaviours import SECTION_FAMILIES
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.materials.plastic import section_flow
from ssilang.kernel.materials.plastic.iwan import nested_of
from ssilang.kernel.materials.plastic.laws import PlasticLaw, law_at, plastic_law
from ssilang.kernel.plasticity.fibre_points import fibre_points
from ssilang.kernel.plasticity.layered_points import (
    ROOTS,
    THICK,
    ThickPoints,
    is_layered,
    layered_points,
)
from ssilang.kernel.plasticity.points import (
    COMPONENTS,
    PlasticPoints,
    PointState,
    law_parameters,
    law_support,
)
from ssilang.kernel.plasticity.solving.blocks import ZonePass, cells_of
from ssilang.kernel.plasticity.solving.cones import ConePass
from ssilang.kernel.plasticity.solving.nested import NestedPass


@dataclass(frozen=True, eq=False)
class EndPoints(PlasticPoints):
    """Points at both ends of beams; forces and work are those of what is linear between them."""

    characteristics: zone_fields.ZoneField

    def paired(self, full: FloatArray) -> FloatArray:
        """Two thirds of an end's values (m, ...) and one of the other end's."""
        return paired(full.reshape(-1, 2, *full.shape[1:]), 1).reshape(full.shape)

    def stored(self, state: PointState) -> float:
        """Elastic energy of forces that are linear between the ends."""
        strains = np.einsum("mij,mj->mi", self.parameters.compliance, self.paired(state.stress))
        return float(0.5 * np.vecdot(state.stress, strains) @ self.weights.ravel())

    def stress_block(self, state: PointState) -> CellFieldBlock:
        """Forces of the sections, shear forces as the moments at both ends ask for them."""
        block = super().stress_block(state)
        turn = beam_frame(self.zone, self.characteristics).rotation(self.zone)
        local = np.einsum("cij,cj->ci", turn, self.forces(state.stress)).reshape(len(turn), 2, -1)
        local[:, 0] *= -1.0
        names, kept = family_of(self.zone).stress_names(self.zone), kept_rows(self.zone)
        shears = {names[i]: local[:, :, i].copy() for i, row in enumerate(kept) if row in (1, 2)}
        return replace(block, components={**block.components, **shears})


def section_points(zone: Zone, characteristics: CellField) -> PlasticPoints:
    """The sections of a zone.

    Raises
    ------
    KernelError
        In Fourier harmonics.
    MaterialError
        For missing or inadmissible parameters, beams without a distance for their moments.
    """
    kind, family, law = catalog.family_name(zone), family_of(zone), plastic_law(zone.behaviour)
    assert law is not None
    given = zone_fields.zone_field(zone, characteristics)
    if zone.mode is Mode.FOURIER:
        raise KernelError("kernel.plasticity.plastic-laws-not-exist", value=zone.mode.value)
    if kind in catalog.STRAIGHT_BEAMS and not any(d in given for d, _ in LEVERS.values()):
        raise MaterialError("kernel.plasticity.moments-without-distances", element=zone.element)
    if kind == "beam" and ("SECY" in given or "SECZ" in given):
        raise MaterialError("kernel.plasticity.sheared-beam-is-elastic").about("SECY", "SECZ")
    at = law_support(zone)
    operator = family.strain_operator(zone, given, at, slice(None))
    n, s, p, _ = operator.matrix.shape
    thin, bent = kind in catalog.THIN_SHELLS, kind in catalog.CUBIC_BEAMS
    slots = {4: (0, 1, 3, 4)}.get(s, tuple(range(s))) if thin else kept_rows(zone)
    width = max(6, s)
    sized = pipe_parameters(zone, given) if kind == "pipe" else given
    size = sized.at("EPAI" if thin else "SECT", at)

    def placed(matrix: FloatArray) -> FloatArray:
        full = np.zeros((n, p, width, width))
        full[..., np.array(slots)[:, None], np.array(slots)] = matrix
        return full.reshape(-1, width, width)

    D = placed(family.moduli(zone, given, at))
    own = law_parameters(zone, law, given)
    kind_of = section_flow.CreepingSections if law.timed else section_flow.SectionParameters
    parameters = kind_of(
        own.values, own.curves, D, np.asarray(np.linalg.pinv(D, hermitian=True), dtype=np.float64),
        placed(section_form(zone, given, at)), np.broadcast_to(size, (n, p)).ravel(),
    )  # fmt: skip
    flowing: PlasticLaw = replace(law, respond=section_flow.respond, symmetric=not bent)
    weights = np.broadcast_to(operator.weights, (n, p))
    common = (zone, flowing, family.layout(zone), operator.matrix, weights, None, slots, ())
    if bent:
        return EndPoints(*common, parameters, given)
    return PlasticPoints(*common, parameters)


def plastic_points(zone: Zone, characteristics: CellField) -> PlasticPoints:
    """Everything that does not change during a calculation.

    Raises
    ------
    KernelError
        In hypotheses without plastic laws.
    MaterialError
        For missing or inadmissible parameters.
    """
    kind = catalog.family_name(zone)
    if "SECTION" in zone.behaviour:
        return fibre_points(zone, characteristics)
    if is_layered(zone):
        return layered_points(zone, characteristics)
    if kind in SECTION_FAMILIES:
        return section_points(zone, characteristics)
    law, family = plastic_law(zone.behaviour), family_of(zone)
    assert law is not None
    given = zone_fields.zone_field(zone, characteristics)
    bar, thick = kind in catalog.BARS, kind == "thick"
    if not bar and zone.mode not in COMPONENTS:
        raise KernelError("kernel.plasticity.plastic-laws-not-exist", value=zone.mode.value)
    parts = [
        family.strain_operator(zone, given, "STRESSES", cells) for cells in chunks(len(zone.cells))
    ]
    B = np.concatenate([part.matrix for part in parts])
    B = B * ROOTS[np.array(THICK)][:, None, None] if thick else B
    weights = np.concatenate([np.broadcast_to(p.weights, (len(p.matrix), p.matrix.shape[2]))
                              for p in parts])  # fmt: skip
    section: FloatArray | None = None
    if bar:
        section = np.broadcast_to(given.at("SECT", "STRESSES"), weights.shape)
        weights = weights * section
    parameters = law_parameters(zone, law, given)
    held: tuple[int, ...] = (1, 2, 3, 4, 5) if bar and not law.uniaxial else ()
    if thick or (zone.mode is Mode.PLANE_STRESS and not bar):
        held = (2,)
    components = (0,) if bar else THICK if thick else COMPONENTS[zone.mode]
    return (ThickPoints if thick else PlasticPoints)(
        zone, law_at(law, parameters), family.layout(zone), B, weights, section, components, held,
        parameters,
    )  # fmt: skip


def zone_pass(points: PlasticPoints, places: NDArray[np.int32]) -> ZonePass | None:
    """The compiled passes of a zone, None where its law or stresses have none."""
    if points.held:
        return None
    if points.law.parts is not None:
        nested = nested_of(points.law.parts, points.parameters)
        return NestedPass(cells_of(points, places), nested)
    cone = points.law.cone
    if cone is None:
        return None
    return ConePass(cells_of(points, places), points.parameters.once(cone.rows))
