"""The integration points of a plastic zone: strain operator, parameters, law."""

from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.elements.catalog import family_name
from ssilang.kernel.elements.families import family_of, plastic_strain_names
from ssilang.kernel.elements.family import Layout, cell_block
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.elements.zone_fields import (
    ZoneField,
    missing_parameter,
    n_points,
    zone_field,
)
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.materials.elasticity import check_isotropic
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.materials.plastic.creep import DURATION
from ssilang.kernel.materials.plastic.held_stress import respond_held
from ssilang.kernel.materials.plastic.laws import (
    PlasticLaw,
    check_parameters,
    different_curves,
    plastic_law,
)
from ssilang.kernel.materials.plastic.response import PointParameters, Response

_PLANE, _SPACE = (0, 1, 2, 3), (0, 1, 2, 3, 4, 5)
COMPONENTS: dict[Mode, tuple[int, ...]] = {
    Mode.PLANE_STRAIN: _PLANE,
    Mode.PLANE_STRESS: _PLANE,
    Mode.GENERALISED_PLANE_STRAIN: _PLANE,
    Mode.AXISYMMETRIC: _PLANE,
    Mode.THREE_DIMENSIONAL: _SPACE,
    Mode.UNIDIMENSIONAL: (0, 1, 2),
}
"""Components of the tensor XX YY ZZ XY XZ YZ that a hypothesis has (RR ZZ TT RZ likewise)."""


@dataclass(eq=False)
class PointState:
    """State of one zone's points; never changed in place.

    Attributes
    ----------
    stress, plastic, free : array (m, 6)
        Stress, plastic strain, strain without stress (expansion) already taken up.
    variables : array (m, k)
    """

    stress: FloatArray
    plastic: FloatArray
    free: FloatArray
    variables: FloatArray
    time: float = 0.0


def law_support(zone: Zone) -> Support:
    """The points at which a zone's law is asked: those of its stresses.

    COQ3 shows stresses at its middle alone: a law there leaves it motions without stiffness.
    """
    return "RIGIDITE" if zone.element == "COQ3" else "STRESSES"


Fields = tuple[CellField | None, CellField | None, CellField | None]
"""Stresses, internal variables, plastic strains; None: none."""


@dataclass(frozen=True, eq=False)
class PlasticPoints:
    """One zone.

    Attributes
    ----------
    B : array (n_cells, n_strains, n_points, n_rows)
        Strain operator at the points of the law.
    weights : array (n_cells, n_points)
        With the section of bars.
    section : array (n_cells, n_points) or None
        Section of bars: results are forces.
    components : tuple of int
        Where the strains stand in the tensor.
    held : tuple of int
        Components whose stress is zero whatever the strain.
    """

    zone: Zone
    law: PlasticLaw
    layout: Layout
    B: FloatArray
    weights: FloatArray
    section: FloatArray | None
    components: tuple[int, ...]
    held: tuple[int, ...]
    parameters: PointParameters

    @property
    def count(self) -> int:
        """Number of points."""
        return self.weights.size

    @property
    def width(self) -> int:
        """Stresses of a point: those of a tensor, eight forces of a shell with shear."""
        return max(6, *(c + 1 for c in self.components))

    @property
    def roots(self) -> FloatArray:
        """What the law's stresses (6,) are multiplied by in fields, and its strains divided by."""
        return np.ones(self.width)

    def strains(self, vectors: FloatArray) -> FloatArray:
        """Strains (m, 6) of element vectors (n_cells, n_rows)."""
        n, s, p, _ = self.B.shape
        own = np.matmul(self.B.reshape(n, s * p, -1), vectors[..., None]).reshape(n, s, p)
        return self.spread(own)

    def spread(self, own: FloatArray) -> FloatArray:
        """Components of the hypothesis (n_cells, n_strains, n_points) as tensors (m, 6)."""
        full = np.zeros((self.count, self.width))
        for i, c in enumerate(self.components):
            full[:, c] = np.broadcast_to(own[:, i], self.weights.shape).ravel()
        return full

    def gathered(self, full: FloatArray) -> FloatArray:
        """Tensors (m, 6) as the hypothesis' components (n_cells, n_strains, n_points)."""
        n, p = self.weights.shape
        return np.stack([full[:, c].reshape(n, p) for c in self.components], axis=1)

    def respond(
        self, stress: FloatArray, strain: FloatArray, variables: FloatArray, duration: float = 0.0
    ) -> tuple[Response, FloatArray]:
        """The law at the points, and the strains with those across held stresses."""
        given = self.parameters
        if self.law.timed:
            steps = np.full(self.count, max(duration, 0.0))
            given = replace(given, values={**given.values, DURATION: steps})
        return respond_held(self.law, given, stress, strain, variables, self.held)

    def stored(self, state: PointState) -> float:
        """Elastic energy, with what a law locks in."""
        density = self.parameters.elastic_energy(state.stress)
        if self.law.locked is not None:
            density = density + self.law.locked(self.parameters, state.stress, state.variables)
        return float(density @ self.weights.ravel())

    def paired(self, full: FloatArray) -> FloatArray:
        """Values (m, ...) of stresses or strains as they count in forces and work."""
        return full

    def forces(self, stress: FloatArray) -> FloatArray:
        """Element vectors (n_cells, n_rows) in balance with stresses (m, 6)."""
        n, s, p, rows = self.B.shape
        weighted = (self.gathered(self.paired(stress)) * self.weights[:, None]).reshape(n, 1, s * p)
        return np.matmul(weighted, self.B.reshape(n, s * p, rows))[:, 0]

    def stiffness(self, tangent: FloatArray) -> FloatArray:
        """Element matrices (n_cells, n_rows, n_rows) of tangents (m, 6, 6)."""
        n, s, p, rows = self.B.shape
        chosen = np.array(self.components)
        D = tangent[:, chosen[:, None], chosen[None, :]].reshape(n, p, s, s)
        D = D * self.weights[:, :, None, None]
        values = np.empty((n, rows, rows))
        for cells in chunks(n):
            B = self.B[cells].transpose(0, 2, 1, 3)
            left = self.paired(B.reshape(-1, s, rows)).reshape(len(B), p * s, rows)
            left = left.transpose(0, 2, 1)
            values[cells] = np.matmul(left, np.matmul(D[cells], B).reshape(len(B), p * s, rows))
        return values

    # ---- fields: what a state looks like from outside, and back

    def stress_block(self, state: PointState) -> CellFieldBlock:
        """Stresses (forces in bars)."""
        values = self.gathered(state.stress * self.roots)
        values = values if self.section is None else values * self.section[:, None]
        return cell_block(
            self.zone, family_of(self.zone).stress_names(self.zone), values, law_support(self.zone)
        )

    def variable_block(self, state: PointState) -> CellFieldBlock:
        """Internal variables."""
        n, p = self.weights.shape
        values = state.variables.reshape(n, p, -1).transpose(0, 2, 1)
        return cell_block(self.zone, self.law.variables, values, law_support(self.zone))

    def plastic_block(self, state: PointState) -> CellFieldBlock | None:
        """Plastic strains."""
        names, values = plastic_strain_names(self.zone), self.gathered(state.plastic / self.roots)
        return cell_block(self.zone, names, values, law_support(self.zone))

    def restored(self, blank: PointState, given: Fields) -> tuple[PointState, bool]:
        """The state that fields hold (what they lack as in `blank`), and whether they hold any."""
        names, at = family_of(self.zone).stress_names(self.zone), law_support(self.zone)
        seen, inner, strains = (zone_field(self.zone, f) for f in given)
        state, known = blank, False
        if any(n in seen for n in names):
            known = True
            values = seen.matrix(names, at)
            if self.section is not None:
                values = values / self.section[:, None]
            state = replace(state, stress=self.spread(values) / self.roots)
        if any(n in inner for n in self.law.variables):
            known = True
            kept = inner.matrix(self.law.variables, at).transpose(0, 2, 1)
            state = replace(state, variables=kept.reshape(self.count, -1))
        names = plastic_strain_names(self.zone)
        if any(n in strains for n in names):
            known = True
            state = replace(state, plastic=self.spread(strains.matrix(names, at)) * self.roots)
        return state, known


def is_plastic(zone: Zone) -> bool:
    """Whether a zone of bodies has a plastic law."""
    return family_name(zone) != "joint" and plastic_law(zone.behaviour) is not None


def plastic_zones(model: Model | None) -> tuple[Zone, ...]:
    """Zones of bodies with a plastic law."""
    zones = () if model is None else model.zones
    return tuple(z for z in zones if z.formulation == "MECANIQUE" and is_plastic(z))


def law_parameters(zone: Zone, law: PlasticLaw, given: ZoneField) -> PointParameters:
    """Parameters of a law at its points.

    Raises
    ------
    MaterialError
        For missing or inadmissible ones.
    """
    at = law_support(zone)
    shape = (len(zone.cells), n_points(zone.element, at))

    def at_points(name: str, default: float | None = None) -> FloatArray:
        return np.broadcast_to(given.at(name, at, default), shape).ravel()

    names = [n for n in ("YOUN", "NU", *law.required) if n not in law.curves]
    values = {name: at_points(name) for name in names}
    values |= {name: at_points(name, default) for name, default in law.defaults.items()}
    check_isotropic(values["YOUN"], values["NU"])
    if (values["YOUN"] <= 0).any():
        raise MaterialError(
            "kernel.plasticity.youn-plastic-law-needs", youn_min=values["YOUN"].min()
        )
    curves = {name: _curves(given, name, shape) for name in law.curves}
    found = PointParameters(values, curves)
    check_parameters(law, found)
    return found


def _curves(given: ZoneField, name: str, shape: tuple[int, int]) -> tuple[list[Curve], IntArray]:
    """The different curves of a parameter, and which each point has."""
    if name not in given:
        raise missing_parameter(given.zone, name, given.names)
    return different_curves(name, np.broadcast_to(given.raw(name)[0], shape).ravel())
