"""Beams with sections of fibres as plastic points: each beam has the points of its section."""

from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.beams import fibre_section
from ssilang.kernel.elements.beams.beam_frame import beam_frame, kept_rows
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.materials.plastic.held_stress import respond_held
from ssilang.kernel.materials.plastic.laws import PlasticLaw, plastic_law
from ssilang.kernel.materials.plastic.response import PointParameters, Response
from ssilang.kernel.materials.plastic.uniaxial import Along, Fibres, elastic
from ssilang.kernel.plasticity.points import Fields, PlasticPoints, PointState, law_parameters

COMPONENTS = (0, 3, 4)
"""XX XY XZ in the tensor."""
ELASTIC = PlasticLaw(Fibres(elastic), (), ())
STRESS_FIELD, VARIABLE_FIELD = "VONS", "VAIS"
"""Internal variables of a beam: fields of stresses and of internal variables on its section."""


@dataclass(frozen=True, eq=False)
class FibreGroup:
    """Fibres of one law.

    Attributes
    ----------
    parameters : PointParameters
        At the fibres of one section.
    shear : array (n_fibres, 2)
        ALPY and ALPZ.
    kept : dict
        What `tiled` made.
    """

    part: fibre_section.SectionZone
    law: PlasticLaw
    parameters: PointParameters
    shear: FloatArray
    kept: dict[int, tuple[PointParameters, FloatArray]] = field(default_factory=dict)

    def respond(
        self, stress: FloatArray, strain: FloatArray, variables: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Stress, variables, tangent of some sections: arrays (n, n_fibres, ...)."""
        n, f, _ = stress.shape
        parameters, share = self.tiled(n)
        own, step = stress.reshape(n * f, 6).copy(), strain.reshape(n * f, 6).copy()
        step[:, 3:5] *= share > 0
        own[:, 3:5] = np.divide(own[:, 3:5], share, out=np.zeros_like(share), where=share > 0)
        k = len(self.law.variables)
        held = () if self.law.uniaxial else (1, 2, 5)
        inner = variables.reshape(n * f, -1)[:, :k]
        found, _ = respond_held(self.law, parameters, own, step, inner, held)
        after, tangent = found.stress, found.tangent
        after[:, 3:5] *= share
        tangent[:, 3:5] *= share[:, :, None]
        kept = variables.copy()
        kept[..., :k] = found.variables.reshape(n, f, k)
        return after.reshape(n, f, 6), kept, tangent.reshape(n, f, 6, 6)

    def along(self, stress: FloatArray, strain: FloatArray, variables: FloatArray) -> Along:
        """Stress, variables and slope along the fibres of one section that is not sheared."""
        law = self.law.respond
        if isinstance(law, Fibres):
            return law.along(self.parameters, stress, strain, variables)
        s, e = np.zeros((2, 1, len(stress), 6))
        s[0, :, 0], e[0, :, 0] = stress, strain
        after, kept, tangent = self.respond(s, e, variables[None])
        return Along(after[0, :, 0], kept[0], tangent[0, :, 0, 0])

    def tiled(self, n: int) -> tuple[PointParameters, FloatArray]:
        """Parameters and shares of shear (n n_fibres, 2) at n sections; the last n is kept."""
        if n not in self.kept:
            rows = np.tile(np.arange(len(self.shear)), n)
            self.kept.clear()
            self.kept[n] = self.parameters.at(rows), self.shear[rows]
        return self.kept[n]


def fibre_groups(section: fibre_section.FibreSection) -> tuple[FibreGroup, ...]:
    """The fibres of a section by zone, with the law of each."""
    groups = []
    for part in section.zones:
        law = plastic_law(part.zone.behaviour) or ELASTIC
        plane = 0.0 if part.zone.mode.dimension == 2 else None
        shear = np.stack([part.each("ALPY"), part.each("ALPZ", plane)], axis=1)
        groups.append(FibreGroup(part, law, law_parameters(part.zone, law, part.parameters), shear))
    return tuple(groups)


@dataclass(frozen=True, eq=False)
class SectionLaw:
    """The laws of a section's fibres at the points of several beams, in the guise of one law."""

    groups: tuple[FibreGroup, ...]
    n_fibres: int

    @property
    def width(self) -> int:
        """Number of internal variables that a fibre is given."""
        return max(len(g.law.variables) for g in self.groups)

    def along(self, stress: FloatArray, strain: FloatArray, variables: FloatArray) -> Along:
        """Stress, variables and slope along the fibres of one section that is not sheared."""
        found = Along(np.empty_like(stress), variables.copy(), np.empty_like(stress))
        for group in self.groups:
            rows, k = group.part.rows, len(group.law.variables)
            made = group.along(stress[rows], strain[rows], variables[rows, :k])
            found.stress[rows], found.variables[rows, :k], found.slope[rows] = made
        return found

    def __call__(
        self,
        parameters: PointParameters,
        stress: FloatArray,
        strain: FloatArray,
        variables: FloatArray,
    ) -> Response:
        f = self.n_fibres
        n = len(stress) // f
        s, e = stress.reshape(n, f, 6), strain.reshape(n, f, 6)
        q = variables.reshape(n, f, -1)
        after, kept, tangent = np.zeros_like(s), q.copy(), np.zeros((n, f, 6, 6))
        for group in self.groups:
            rows = group.part.rows
            made = group.respond(s[:, rows], e[:, rows], q[:, rows])
            after[:, rows], kept[:, rows], tangent[:, rows] = made
        return Response(after.reshape(-1, 6), kept.reshape(n * f, -1), tangent.reshape(-1, 6, 6))


def section_fields(
    groups: tuple[FibreGroup, ...], stress: FloatArray, variables: FloatArray
) -> tuple[CellField, CellField]:
    """Stresses (n_fibres, 6) and internal variables (n_fibres, k) as fields on a section."""
    stresses, inner = [], []
    for group in groups:
        rows, zone = group.part.rows, group.part.zone
        shape = (len(zone.cells), -1)
        own = [stress[rows, c].reshape(shape) for c in COMPONENTS]
        stresses.append(cell_block(zone, fibre_section.STRESSES, np.stack(own, axis=1)))
        names = group.law.variables
        if names:
            kept = [variables[rows, k].reshape(shape) for k in range(len(names))]
            inner.append(cell_block(zone, names, np.stack(kept, axis=1)))
    whole = CellField(tuple(inner), "VARIABLES INTERNES")
    return CellField(tuple(stresses), "CONTRAINTES"), whole


class FibreParameters(PointParameters):
    """Parameters of fibres: stresses across the fibre are zero."""

    @property
    def compliance(self) -> FloatArray:
        """Elastic compliance (m, 6, 6) with ALPY, ALPZ."""
        moduli = np.stack([self["YOUN"], self["GY"], self["GZ"]], axis=1)
        found = np.zeros((len(moduli), 6, 6))
        inverse = np.divide(1.0, moduli, out=np.zeros_like(moduli), where=moduli > 0)
        for i, c in enumerate(COMPONENTS):
            found[:, c, c] = inverse[:, i]
        return found

    def elastic_energy(self, stress: FloatArray) -> FloatArray:
        """Energy (m,) that stresses (m, 6) store in a unit of volume."""
        return 0.5 * np.einsum("mi,mij,mj->m", stress, self.compliance, stress)


@dataclass(frozen=True, eq=False)
class FibrePoints(PlasticPoints):
    """Points (n_cells, n_fibres) of beams; results are forces of sections."""

    fibres: fibre_section.FibreSection

    def stress_block(self, state: PointState) -> CellFieldBlock:
        """Forces and moments of the sections."""
        sigma = self.gathered(state.stress)
        kept = list(kept_rows(self.zone))
        A = self.fibres.operator[..., kept]
        forces = np.einsum("f,csf,fsi->ci", self.fibres.areas, sigma, A)
        return cell_block(
            self.zone, family_of(self.zone).stress_names(self.zone), forces[..., None]
        )

    def variable_block(self, state: PointState) -> CellFieldBlock:
        """Fields VONS and VAIS of each section."""
        n, f = self.weights.shape
        stress, inner = state.stress.reshape(n, f, 6), state.variables.reshape(n, f, -1)
        fields = {name: np.empty((n, 1), dtype=object) for name in (STRESS_FIELD, VARIABLE_FIELD)}
        for c in range(n):
            made = section_fields(_groups(self), stress[c], inner[c])
            fields[STRESS_FIELD][c, 0], fields[VARIABLE_FIELD][c, 0] = made
        zone = self.zone
        return zone.block(fields)

    def plastic_block(self, state: PointState) -> CellFieldBlock | None:
        """None: the strains that stay are those of the fibres."""
        return None

    def restored(self, blank: PointState, given: Fields) -> tuple[PointState, bool]:
        """The state of the fibres from VONS and VAIS."""
        seen = zone_field(self.zone, given[1])
        if STRESS_FIELD not in seen:
            return blank, False
        n, f = self.weights.shape
        sigma, inner = np.zeros((n, 3, f)), np.zeros((n, f, blank.variables.shape[1]))
        fields = [np.broadcast_to(seen.raw(w)[0], (n, 1)) for w in (STRESS_FIELD, VARIABLE_FIELD)]
        for c in range(n):
            for group in _groups(self):
                zone, rows = group.part.zone, group.part.rows
                own = zone_field(zone, fields[0][c, 0]).matrix(fibre_section.STRESSES, "STRESSES")
                sigma[c, :, rows] = own.transpose(1, 0, 2).reshape(3, -1)
                names = group.law.variables
                if names:
                    kept = zone_field(zone, fields[1][c, 0]).matrix(names, "STRESSES")
                    inner[c, rows, : len(names)] = kept.transpose(0, 2, 1).reshape(-1, len(names))
        state = PointState(self.spread(sigma), blank.plastic, blank.free, inner.reshape(n * f, -1))
        return state, True


def _groups(points: FibrePoints) -> tuple[FibreGroup, ...]:
    law = points.law.respond
    assert isinstance(law, SectionLaw)
    return law.groups


def fibre_points(zone: Zone, characteristics: CellField) -> FibrePoints:
    """The fibres of all beams of a zone.

    Raises
    ------
    MaterialError
        For missing or inadmissible parameters.
    """
    given = zone_field(zone, characteristics)
    family = family_of(zone)
    section = fibre_section.section_of_beam(given)
    groups = fibre_groups(section)
    law = SectionLaw(groups, len(section.areas))
    inner = tuple(f"V{i}" for i in range(law.width))
    n = len(zone.cells)
    general = family.strain_operator(zone, given, "STRESSES", slice(None)).matrix[:, :, 0]
    B = np.einsum("fsi,cim->csfm", section.operator[..., list(kept_rows(zone))], general)
    weights = beam_frame(zone, given).lengths[:, None] * section.areas
    tiled = np.tile(section.moduli, (n, 1))
    values = dict(zip(("YOUN", "GY", "GZ"), tiled.T, strict=True))
    return FibrePoints(
        zone, PlasticLaw(law, (), inner), family.layout(zone), B, weights, None, COMPONENTS, (),
        FibreParameters(values, {}), section,
    )  # fmt: skip
